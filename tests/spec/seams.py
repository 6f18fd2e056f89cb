"""A payload's head (EXTENSION_SPEC.md, Appendix A) and its section SEAMS (C.1 and C.2)."""
import zlib

from models import Bit, RangeDecoder, clamp, require
from value_models import SQUASH, Chance, Chances, varint


# Appendix A

class Payload:
    def __init__(self, data):
        require(data[:5] == b'TUTT\0', 'no payload of version 0')
        flags, at = varint(data, 5)
        require(flags < 256 and flags & 1, 'flags')
        self.welded = flags >> 7
        require(not self.welded or flags >> 1 & 1, 'a welded payload without SEAMS')

        def count(present, otherwise):
            nonlocal at
            if not present:
                return otherwise
            value, at = varint(data, at)
            return value

        self.vertices = count(True, 0)
        self.points = self.vertices - count(self.welded, -1) - 1
        self.wedges = self.vertices + count(flags >> 1 & 1, 0)
        self.faces = count(True, 0)
        self.corners = count(True, 0)
        usual = max(0, self.corners - 2 * self.faces)
        self.triangles = count(flags >> 6 & 1, usual)
        self.groups = count(flags >> 2 & 1, 0) + 1
        self.attributes = count(flags >> 5 & 1, -1) + 1
        require(not self.welded or 0 < self.points < self.vertices, 'counts')
        self.sections = self.read_sections(data, at, [s for s in range(6) if flags >> s & 1])

    @staticmethod
    def read_sections(data, at, present):
        head, lengths, sections, table = data[:at], b'', {}, []
        for section in present:
            size, end = varint(data, at)
            lengths += data[at:end]
            table.append((section, size, int.from_bytes(data[end:end + 4], 'little')))
            at = end + 4
        for section, size, checksum in table:
            sections[section] = data[at:at + size]
            require(zlib.crc32(head + lengths + sections[section]) == checksum, 'a checksum')
            at += size
        require(at == len(data), 'bytes behind the payload')
        return sections


# C.1 Mixed decisions

class MixedFlag:
    def __init__(self, inputs, weight_sets):
        self.tables = [Chances() for _ in range(inputs)]
        self.weights = [[65536 * 13 // (10 * inputs)] * inputs for _ in range(weight_sets)]

    def read(self, stream, contexts, weight_set):
        chances, weights = [table[x] for table, x in zip(self.tables, contexts)], self.weights[weight_set]
        inputs = [chance.trusted() for chance in chances]
        one = SQUASH[clamp(sum(t * w for t, w in zip(inputs, weights)) >> 16, -2047, 2047) + 2048]
        bit = stream.bit(clamp(one, 24, 65512))
        error = ((65535 if bit else 0) - one) >> 4
        for i, value in enumerate(inputs):
            weights[i] = clamp(weights[i] + (value * error + 512 >> 10), -2**20, 2**20)
            chances[i].update(bit)
        return bit


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


class FlagPass:
    def __init__(self, ends, candidates, given=frozenset()):
        self.ends, self.candidates, self.history = ends, candidates, 0
        self.quiet, self.touches, self.flags = [Chance(4096) for _ in range(2)], MixedFlag(3, 1), MixedFlag(6, 3)
        self.known = {end: 2 for end in given}
        self.left, self.parted, self.required, self.states = {}, {}, {}, {}
        for c, u in enumerate(ends.umbrellas):
            self.left[u] = self.left.get(u, 0) + (c in candidates)
            self.parted[u] = max(self.parted.get(u, 0), 2 * (c in given))
        for u, parted in self.parted.items():
            self.required[u] = 1 if u in ends.open or parted else 2

    def run(self, stream):
        """The ends whose flag is 1."""
        self.read_touched(stream)
        for c, t in enumerate(self.ends.twins):
            for end, far in ((c, t), (t, c)):
                if not self.wanted(c):
                    break
                if self.wanted(end) and self.known.get(end, 0) == 0:
                    self.read(stream, end, far)
        return {end for end, known in self.known.items() if known == 2}

    def wanted(self, end):
        return end in self.candidates and self.state(end) == 2

    def state(self, corner):
        return self.states.get(self.ends.umbrellas[corner], 0)

    def read_touched(self, stream):
        row, following, preceding, twins = 0, self.ends.following, self.ends.preceding, self.ends.twins
        for c, u in enumerate(self.ends.umbrellas):
            if c in self.candidates and u not in self.states:
                p, n, o = self.state(preceding[c]), self.state(following[c]), self.state(following[following[c]])
                left, r = twins[preceding[c]], self.state(preceding[twins[c]])
                l = 3 if left is None else self.state(following[following[left]])
                if row == 0 and n != 2:
                    touched = self.quiet[n].read(stream)
                else:
                    touched = self.touches.read(stream, [(((p * 3 + n) * 3 + o) * 4 + l) * 4 + r, (row * 3 + n) * 3 + o,
                                                         ((p * 3 + n) * 2 + (l == 3)) * 16 + (row & 15)], 0)
                self.states[u] = 1 + touched
            row = (2 * row + (self.state(c) == 2)) & 255

    def read(self, stream, e, far):
        u, v = self.ends.umbrellas[e], self.ends.umbrellas[far]
        if self.left[u] == self.required[u]:
            flag = 1
        else:
            flag = int(self.flags.read(stream, self.contexts(e, far, u, v), self.flag(far)))
        self.parted[u] = min(2, self.parted[u] + flag)
        self.required[u] = max(0, self.required[u] - flag)
        self.left[u] -= 1
        self.known[e] = 1 + flag
        self.history = (2 * self.history + flag) & 15

    def flag(self, end):
        return self.known.get(end, 0)

    def contexts(self, e, far, u, v):
        across, back, known = self.ends.across.get, self.ends.back.get, self.flag
        sides = known(across(e)) * 3 + known(back(e))
        far_sides = known(across(far)) * 3 + known(back(far))
        parted, left = (self.parted[v], self.left[v]) if self.states.get(v) == 2 else (3, 0)
        seen = (known(far) * 3 + self.parted[u]) * 4 + parted
        return [(sides * 9 + known(across(across(e))) * 3 + known(back(back(e)))) * 36 + seen,
                (self.straight(e) * 3 + self.straight(far)) * 36 + seen,
                ((min(self.left[u], 8) - 1) * 8 + min(left, 7)) * 36 + seen,
                (far_sides * 9 + sides) * 36 + seen,
                ((self.facing(e) * 3 + self.facing(far)) * 16 + self.history) * 36 + seen,
                (self.beside(e) * 9 + self.beside(far)) * 36 + seen]

    def straight(self, x):
        forwards = self.ends.across.get(self.ends.across.get(x))
        return self.flag(forwards) if forwards == self.ends.back.get(self.ends.back.get(x)) else 0

    def edge(self, x):
        twin = self.ends.twins[x]
        return 0 if twin is None else max(self.flag(x), self.flag(twin))

    def facing(self, x):
        following = self.ends.following
        return self.edge(following[following[x]]) if self.ends.degree[x] == 4 else 0

    def beside(self, x):
        return self.edge(self.ends.following[x]) * 3 + self.edge(self.ends.preceding[x])


def runs(ends, parted):
    """Per corner the first corner of its run."""
    first = {}
    for corner in range(len(ends.umbrellas)):
        c = corner
        while c is not None and c not in first:
            first[c] = corner
            c = None if c in parted else ends.across.get(c)
        c = ends.back.get(corner)
        while c is not None and c not in parted and c not in first:
            first[c] = corner
            c = ends.back.get(c)
    return first


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
    first, used, seen, models = runs(ends, parted), [0] * count, set(), [PartModels(), PartModels()]
    neighbours, local = {}, {}
    for end in parted:
        neighbours.setdefault(first[end], set()).add(first[ends.across[end]])
        neighbours.setdefault(first[ends.across[end]], set()).add(first[end])
    for c in sorted(set(first.values())):
        whole, umbrella = wholes[c], ends.umbrellas[c]
        barred = {local[run] for run in neighbours.get(c, ()) if run in local and wholes[run] == whole}
        choices = [number for number in range(used[whole]) if number not in barred]
        chosen = models[umbrella in seen].read(stream, len(choices))
        local[c] = used[whole] if chosen is None else choices[chosen]
        used[whole] += chosen is None
        seen.add(umbrella)
    base, total = [], 0
    for parts in used:
        base.append(total)
        total += max(parts, 1)
    parts = [base[wholes[c]] + local[first[c]] for c in range(len(wholes))]
    return parts, total, parted


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
