/** The figures beside the picture. */

const number = new Intl.NumberFormat('en');

/** @param {number} bytes */
export function bytesText(bytes) {
  if (bytes < 1000) return `${bytes} B`;
  const [value, unit] = bytes < 1e6 ? [bytes / 1e3, 'kB'] : [bytes / 1e6, 'MB'];
  return `${value.toFixed(value < 100 ? 1 : 0)} ${unit}`;
}

/** @param {number} ms */
function timeText(ms) {
  return `${ms.toFixed(ms < 10 ? 2 : ms < 100 ? 1 : 0)} ms`;
}

/** @param {number} part @param {number} whole */
function percent(part, whole) {
  const share = (100 * part) / whole;
  if (share >= 1000) return `${(share / 100).toFixed(0)} ×`;
  return `${share < 10 ? share.toFixed(1) : share.toFixed(0)} %`;
}

/** @param {string} id */
function byId(id) {
  return /** @type {any} */ (document.getElementById(id));
}

/** @param {string} tag @param {Record<string, any>} [properties] @param {(Node | string)[]} children */
function element(tag, properties = {}, ...children) {
  const made = Object.assign(document.createElement(tag), properties);
  made.append(...children);
  return made;
}

/** Nothing for nothing. @param {number} count @param {string} one */
function counted(count, one, many = `${one}s`) {
  return count === 0 ? '' : `${number.format(count)} ${count === 1 ? one : many}`;
}

/** @param {string} name @param {number} vertices @param {Map<number, number>} degrees  faces by corners */
export function showFacts(name, vertices, degrees) {
  byId('name').textContent = name;
  const faces = [...degrees.values()].reduce((sum, count) => sum + count, 0);
  const triangles = degrees.get(3) ?? 0,
    quads = degrees.get(4) ?? 0;
  const large = [...degrees.keys()].filter((degree) => degree > 4);
  const least = Math.min(...large),
    most = Math.max(...large);
  const corners = `of ${least}${most > least ? ` to ${most}` : ''} corners`;
  byId('facts').textContent = [
    counted(vertices, 'vertex', 'vertices'),
    counted(triangles, 'triangle'),
    counted(quads, 'quad'),
    counted(faces - triangles - quads, `n\u2011gon ${corners}`, `n\u2011gons ${corners}`),
  ]
    .filter(Boolean)
    .join(' · ');
}

/**
 * What a way to store the model came to.
 * @typedef {{id: string, title: string, note: string, size?: number, zipped?: number, failed?: string}} Version
 */

/**
 * One bar per version; choosing one shows it.
 * @param {Version[]} versions @param {'size' | 'zipped'} measure
 * @param {string} chosen @param {(id: string) => void} choose
 */
export function showSizes(versions, measure, chosen, choose) {
  byId('sizes').hidden = false;
  const most = Math.max(...versions.map((version) => version[measure] ?? 0));
  const rows = byId('sizes').querySelector('.rows'),
    focused = rows.contains(document.activeElement);
  rows.replaceChildren(
    ...versions.map((version) => {
      const bytes = version[measure];
      const input = element('input', {
        type: 'radio',
        name: 'version',
        value: version.id,
        checked: version.id === chosen,
        disabled: bytes === undefined,
      });
      input.addEventListener('change', () => choose(version.id));
      const share = bytes !== undefined && version !== versions[0] ? percent(bytes, versions[0][measure]) : '';
      return element(
        'label',
        {className: `row ${version.id}`},
        input,
        element(
          'span',
          {className: 'what'},
          element('b', {}, version.title),
          ' ',
          element('span', {className: 'fine'}, version.note)
        ),
        element(
          'span',
          {className: 'value'},
          version.failed ?? (bytes === undefined ? '…' : bytesText(bytes)),
          ' ',
          element('span', {className: 'share'}, share)
        ),
        bar((bytes ?? 0) / most)
      );
    })
  );
  if (focused) rows.querySelector(':checked')?.focus();
}

/** @param {string} text */
export function showSizeNote(text) {
  byId('size-note').textContent = text;
}

/** @param {number} share  of the longest bar */
function bar(share) {
  const svg = document.createElementNS('http://www.w3.org/2000/svg', 'svg');
  svg.setAttribute('class', 'bar');
  svg.setAttribute('aria-hidden', 'true');
  for (const [name, width] of [
    ['track', 1],
    ['fill', share],
  ]) {
    const rect = document.createElementNS('http://www.w3.org/2000/svg', 'rect');
    rect.setAttribute('class', String(name));
    rect.setAttribute('width', `${100 * Number(width)}%`);
    rect.setAttribute('height', '100%');
    svg.append(rect);
  }
  return svg;
}

/** @param {{id: string, title: string, ms: number}[]} times */
export function showTimes(times) {
  byId('times').hidden = times.length === 0;
  const most = Math.max(...times.map(({ms}) => ms));
  byId('times')
    .querySelector('.rows')
    .replaceChildren(
      ...times.map(({id, title, ms}) =>
        element(
          'div',
          {className: `row plain ${id}`},
          element('span', {className: 'what'}, element('b', {}, title)),
          element('span', {className: 'value'}, timeText(ms)),
          bar(ms / most)
        )
      )
    );
}

const sectionTitles = {
  HEADER: 'Header',
  CONNECTIVITY: 'Connectivity',
  SEAMS: 'Seams',
  GROUPS: 'Face groups',
  RINGS: 'Holes',
  TRIANGULATION: 'Triangulation',
  ATTRIBUTES: 'Attributes',
};

/** @param {Map<string, number>} sections  bytes by name @param {number} vertices */
export function showSections(sections, vertices) {
  const box = byId('sections');
  box.hidden = sections.size === 0;
  const used = [...sections].filter(([, bytes]) => bytes > 0);
  box.querySelector('.stack').replaceChildren(
    ...used.map(([name, bytes]) => {
      const piece = element('i', {className: name.toLowerCase()});
      piece.style.flexGrow = String(bytes);
      return piece;
    })
  );
  box
    .querySelector('tbody')
    .replaceChildren(
      ...used.map(([name, bytes]) =>
        element(
          'tr',
          {},
          element(
            'th',
            {scope: 'row'},
            element('i', {className: `dot ${name.toLowerCase()}`}),
            sectionTitles[name] ?? name
          ),
          element('td', {}, number.format(bytes)),
          element('td', {}, ((8 * bytes) / vertices).toFixed(2))
        )
      )
    );
}

/** Whether more is to come. @param {boolean} yes */
export function busy(yes) {
  byId('report').setAttribute('aria-busy', String(yes));
}

/** @param {string} text */
export function say(text) {
  byId('status').textContent = text;
}

/** An error, or nothing. @param {string} text */
export function complain(text) {
  byId('alert').hidden = text === '';
  byId('alert').textContent = text;
}

/** Says that a file is being made. */
export function promiseDownload() {
  link('Compressing…');
}

/** Says that there is none. */
export function withdrawDownload() {
  link('Not compressed');
}

/** @param {Uint8Array} bytes @param {string} name */
export function offerDownload(bytes, name) {
  const made = link(`Download the .glb, ${bytesText(bytes.length)}`);
  made.href = URL.createObjectURL(new Blob([bytes], {type: 'model/gltf-binary'}));
  made.download = name;
  made.removeAttribute('aria-disabled');
}

/** The link for downloads, leading nowhere. @param {string} text */
function link(text) {
  const made = byId('download');
  if (made.href) URL.revokeObjectURL(made.href);
  made.removeAttribute('href');
  made.setAttribute('aria-disabled', 'true');
  made.textContent = text;
  byId('actions').hidden = false;
  return made;
}
