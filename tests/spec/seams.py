"""A payload's section SEAMS (EXTENSION_SPEC.md, C.2)."""
from models import Bit, GatedFlag, Number, RangeDecoder, clamp, require


# C.2 SEAMS

class Ends:
    def __init__(self, mesh):
        self.twins, self.umbrellas = mesh.twins, mesh.umbrellas
        self.across, self.back, self.open, corner = {}, {}, set(), 0
        self.following, self.preceding, self.degree = {}, {}, {}
        for degree in mesh.degrees:
            for c in range(corner, corner + degree):
                following = c + 1 if c + 1 < corner + degree else corner
                self.following[c], self.preceding[following], self.degree[c] = following, c, degree
                if mesh.twins[c] is None:
                    self.open.add(mesh.umbrellas[c])
                else:
                    self.across[mesh.twins[c]] = following
                    self.back[following] = mesh.twins[c]
            corner += degree
        self.all = set(self.across)
        firsts = {}
        for c, u in enumerate(mesh.umbrellas):
            if u not in firsts or mesh.twins[c] is None:
                firsts[u] = c
        self.rings = [list(self.round(firsts[u])) for u in range(len(firsts))]

    def round(self, first):
        """The corners of an umbrella."""
        yield first
        c = self.back.get(first)
        while c is not None and c != first:
            yield c
            c = self.back.get(c)

    def edges(self, u):
        """Per edge of an umbrella: a corner of it, one at the far end, that across the face if it is a quad, and that behind the neighbour."""
        ring = self.rings[u]
        for c in ring:
            x = self.following[c]
            side = self.across.get(x)
            yield c, x, self.following[x] if self.degree[c] == 4 else None, None if side is None else self.following[side]
        if u in self.open:
            x = self.preceding[ring[-1]]
            side = self.back.get(x)
            yield ring[-1], x, None, None if side is None else self.preceding[side]


UNKNOWN, QUIET, TOUCHED, NOWHERE = range(4)


class FlagPass:
    def __init__(self, ends, candidates, given=frozenset()):
        self.ends, self.candidates, self.row, self.gap = ends, candidates, 0, None
        self.gaps, self.touches, self.flags = Number(), GatedFlag(4, 1), GatedFlag(5, 3)
        self.given, self.told, self.touched, self.suggested = given, {}, [], set()
        self.is_touched, self.settled = set(), set()
        self.left, self.parted, self.required = {}, {}, {}

    def run(self, stream):
        """The ends whose flag is 1, and the touched umbrellas."""
        for u, ring in enumerate(self.ends.rings):
            if any(c in self.candidates for c in ring):
                self.read_umbrella(stream, u)
        for u in self.touched:
            for c in self.ends.rings[u]:
                self.read_end(stream, c)
            for c in self.ends.rings[u]:
                self.read_end(stream, self.ends.twins[c])
        return {end for end, told in self.told.items() if told == 2} | set(self.given)

    def read_umbrella(self, stream, u):
        if u in self.suggested:
            touched = self.read_suggested(stream, u)
            self.settled.add(u)
        else:
            if self.gap is None:
                self.gap = self.gaps.read(stream)
            touched = self.gap == 0
            self.gap = None if touched else self.gap - 1
        self.row = (2 * self.row + touched) & 15
        if not touched:
            return
        ring = self.ends.rings[u]
        self.touched.append(u)
        self.is_touched.add(u)
        self.suggested.update(self.ends.umbrellas[x] for _, x, far, _ in self.ends.edges(u) for x in (x, far) if x is not None)
        self.left[u] = sum(c in self.candidates for c in ring)
        self.parted[u] = 2 * any(c in self.given for c in ring)
        self.required[u] = 1 if u in self.ends.open or self.parted[u] else 2

    def state(self, corner, u):
        if corner is None:
            return NOWHERE
        other = self.ends.umbrellas[corner]
        return UNKNOWN if other > u else TOUCHED if other in self.is_touched else QUIET

    def need(self, v):
        neighbours = [self.ends.umbrellas[x] for _, x, _, _ in self.ends.edges(v)]
        touched = sum(w in self.is_touched and w != v for w in neighbours)
        unknown = sum(w > v and w not in self.settled for w in neighbours)
        return min(touched, 2) * 5 + min(unknown, 4)

    def read_suggested(self, stream, u):
        edges = list(self.ends.edges(u))
        states = [self.state(x, u) for _, x, _, _ in edges]
        far = [self.state(f, u) for _, _, f, _ in edges]
        near = [(self.need(self.ends.umbrellas[x]), self.state(beyond, u))
                for _, x, _, beyond in edges if self.state(x, u) == TOUCHED]
        need = min((n for n, _ in near), default=15)
        touched, quiet, unknown = (min(states.count(state), 3) for state in (TOUCHED, QUIET, UNKNOWN))
        far_touched, far_quiet = min(far.count(TOUCHED), 2), min(far.count(QUIET), 2)
        lines, line = sum(state == TOUCHED for _, state in near), 0
        for n, state in near:
            if n == need and line != TOUCHED:
                line = state
        gate = (touched * 4 + quiet) * 4 + unknown
        return int(self.touches.read(stream, gate, [
            need * 64 + gate, ((self.row * 4 + line) * 4 + need // 5) * 4 + touched,
            (((need * 4 + line) * 3 + far_touched) * 3 + far_quiet) * 4 + touched,
            ((((min(lines, 2) * 4 + quiet) * 4 + touched) * 3 + far_touched) * 4 + unknown) * 4 + self.row % 4], 0))

    def read_end(self, stream, e):
        if e not in self.candidates or e in self.told or self.ends.umbrellas[e] not in self.is_touched:
            return
        u = self.ends.umbrellas[e]
        flag = 1 if self.left[u] == self.required[u] else self.decide(stream, e, u)
        self.parted[u] = min(2, self.parted[u] + flag)
        self.required[u] = max(0, self.required[u] - flag)
        self.left[u] -= 1
        self.told[e] = 1 + flag

    def decide(self, stream, e, u):
        far = self.ends.twins[e]
        v = self.ends.umbrellas[far]
        far_parted, far_left = (self.parted[v], self.left[v]) if v in self.is_touched else (3, 0)
        known_far = self.known(far)
        seen = (known_far * 3 + self.parted[u]) * 4 + far_parted
        corners, required = len(self.ends.rings[u]), self.required[u]
        opposite = 0 if u in self.ends.open or corners < 4 else self.known(self.step(e, 2 if corners < 6 else 3))
        return int(self.flags.read(stream, seen, [
            self.around(e) * 36 + seen,
            ((min(self.left[u], 4) - 1) * 8 + min(far_left, 7)) * 36 + seen,
            (self.facing(e) * 3 + self.facing(far)) * 36 + seen,
            (self.beside(e) * 9 + self.beside(far)) * 36 + seen,
            ((min(corners, 9) * 3 + opposite) * 3 + required) * 36 + seen], known_far))

    def step(self, e, count):
        """So many corners back; forwards for negative counts."""
        for _ in range(abs(count)):
            e = (self.ends.back if count > 0 else self.ends.across).get(e)
        return e

    def known(self, end):
        if end is None or self.ends.umbrellas[end] not in self.is_touched:
            return 0
        return 2 if end in self.given else self.told.get(end, 0)

    def around(self, e):
        known = [self.known(self.step(e, count)) for count in (-1, 1, -2, 2)]
        return ((known[0] * 3 + known[1]) * 3 + known[2]) * 3 + known[3]

    def edge(self, x):
        return max(self.told.get(x, 0), self.told.get(self.ends.twins[x], 0))

    def facing(self, x):
        following = self.ends.following
        return self.edge(following[following[x]]) if self.ends.degree[x] == 4 else 0

    def beside(self, x):
        return self.edge(self.ends.following[x]) * 3 + self.edge(self.ends.preceding[x])


def runs(ends, parted, u):
    """The runs of an umbrella as lists of corners, and whether the last one meets the first."""
    ring = ends.rings[u]
    starts = [i for i, c in enumerate(ring) if i == 0 or c in parted]
    found = [ring[i:j] for i, j in zip(starts, starts[1:] + [len(ring)])]
    closed = u not in ends.open
    if closed and ring[0] not in parted and len(found) > 1:
        found[0] += found.pop()
    return found, closed


class PartModels:
    def __init__(self):
        self.runs = self.latest = 0
        self.reuse, self.pick = {}, {}

    def read(self, stream, choices):
        """The rank of an earlier part, or None."""
        if not choices:
            return None
        reused = self.reuse.setdefault((min(choices, 3), self.runs), Bit()).read(stream)
        self.runs = (2 * self.runs + reused) & 7
        if not reused:
            return None
        if choices == 1:
            return 0
        r = 0
        while r < 3 and r + 1 < choices and not self.pick.setdefault((min(choices, 4), r, self.latest), Bit()).read(stream):
            r += 1
        self.latest = r
        return 3 + stream.uniform(choices - 3) if r == 3 and choices > 4 else r


def part(stream, ends, wholes, count):
    """Per corner its part, how many there are, and the parted ends."""
    given = {c for c in ends.all if wholes[c] != wholes[ends.across[c]]}
    parted = FlagPass(ends, ends.all - given, given).run(stream)
    used, models, local = [0] * count, [PartModels(), PartModels()], {}
    for u in range(len(ends.rings)):
        found, closed = runs(ends, parted, u)
        for i, run in enumerate(found):
            whole = wholes[run[0]]
            neighbours = found[max(i - 1, 0):i] + (found[:1] if closed and i + 1 == len(found) and i > 0 else [])
            barred = {local[other[0]] for other in neighbours if wholes[other[0]] == whole}
            choices = [number for number in range(used[whole]) if number not in barred]
            chosen = models[i > 0].read(stream, len(choices))
            number = used[whole] if chosen is None else choices[chosen]
            used[whole] += chosen is None
            for c in run:
                local[c] = number
    base, total = [], 0
    for parts in used:
        base.append(total)
        total += max(parts, 1)
    numbers = {}
    for c, whole in enumerate(wholes):  # parts are numbered by their first corners
        if (whole, local[c]) not in numbers:
            numbers[whole, local[c]] = base[whole]
            base[whole] += 1
    return [numbers[whole, local[c]] for c, whole in enumerate(wholes)], total, parted


def decode(mesh, welded, attributes, data):
    """Vertices and wedges per coded corner, how many there are of each, and per attribute the ends where it differs."""
    stream, ends = RangeDecoder(data), Ends(mesh)
    vertices, vertex_count = [mesh.vertices[u] for u in mesh.umbrellas], mesh.vertex_count
    parted = set()
    if welded:
        vertices, vertex_count, parted = part(stream, ends, vertices, vertex_count)
    wedges, wedge_count = vertices, vertex_count
    if not welded or stream.bit(32768):
        wedges, wedge_count, parted = part(stream, ends, vertices, vertex_count)
    seams = [set()]
    for _ in range(1, attributes):
        if not stream.bit(32768):
            seams.append(set())
        elif not stream.bit(32768):
            seams.append(parted)
        else:
            seams.append(FlagPass(ends, parted).run(stream))
    stream.finish()
    return (vertices, vertex_count), (wedges, wedge_count), seams
