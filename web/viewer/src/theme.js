const order = ['', 'light', 'dark'];
const titles = {'': 'as the system', light: 'light', dark: 'dark'};

/** Lets a button go through the themes; remembers the choice. @param {HTMLElement} button @param {() => void} changed */
export function startTheme(button, changed) {
  const root = document.documentElement;
  const set = (/** @type {string} */ theme) => {
    if (theme) root.dataset.theme = theme;
    else delete root.dataset.theme;
    button.dataset.theme = theme;
    button.setAttribute('aria-label', `Theme: ${titles[theme]}`);
    button.title = `Theme: ${titles[theme]}`;
    changed();
  };
  const stored = localStorage.getItem('theme') ?? '';
  set(order.includes(stored) ? stored : '');
  button.addEventListener('click', () => {
    const next = order[(order.indexOf(button.dataset.theme ?? '') + 1) % order.length];
    localStorage.setItem('theme', next);
    set(next);
  });
  matchMedia('(prefers-color-scheme: dark)').addEventListener('change', changed);
}
