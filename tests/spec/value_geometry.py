"""Predictions from positions: EXTENSION_SPEC.md, D.4.10."""
from math import isqrt

from models import clamp
from value_models import bit_length

BY_ANGLE, BY_AREA = 1, 2


def mean(total, count):
    if count == 1:
        return total
    if count in (2, 4):
        return (total + count // 2) // count
    return total * ((65536 + count // 2) // count) + 32768 >> 16


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def cross(a, b):
    return [a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3] for i in range(3)]


def minus(a, b):
    return [x - y for x, y in zip(a, b)]


def largest(v):
    return bit_length(max(abs(x) for x in v))


def shortened(v, bits):
    return [x >> max(largest(v) - bits, 0) for x in v]


def unit(v):
    v = shortened(v, 24)
    length = isqrt(dot(v, v))
    return [x * (2**45 // length) >> 31 for x in v] if length else [0, 0, 0]


def angle(a, b):
    product = cross(a, b)
    shift = max(largest(product) - 30, 0)
    product = [x >> shift for x in product]
    sine, cosine = isqrt(dot(product, product)), dot(a, b) >> shift
    flat = abs(cosine)
    if sine == 0 and flat == 0:
        return 0
    t = (flat << 12) // sine if sine > flat else (sine << 12) // flat
    eighth = t * (4096 + (1424 * (4096 - t) >> 12)) >> 12
    quarter = 8192 - eighth if sine > flat else eighth
    return 16384 - quarter if cosine < 0 else quarter


def distance(a, b):
    return min(abs(a[0] - b[0]) + abs(a[1] - b[1]), 2**20)


def near_root(x):
    half = max(bit_length(x) - 7 >> 1, 0)
    begin = (x >> 2 * half) + 1
    first = ((isqrt(256 * begin - 1) + 1 << half) >> 4) + 1
    return first + x // first >> 1


class Textures:
    def __init__(self, coder, places):
        self.coder, self.places, self.limit = coder, places, coder.max << 4
        self.here, self.given, self.turns, self.last_turn = {}, {}, {}, 1

    def refine(self, site, around):
        graph, known = self.coder.graph, self.coder.known
        self.members, self.first, developed = [], None, 0
        here = given = 0
        for corner in graph.corners(site):
            n, p = graph.next[corner], graph.prev[corner]
            a, b, c, d = (graph.site[x] for x in (n, p, graph.next[n], graph.prev[p]))
            weighed = [a] * known(a) + [b] * (known(b) and graph.twin[p] is None)
            here += sum(self.here[s] for s in weighed)
            given += sum(self.given[s] for s in weighed)
            edges = [(a, b)] + ([(a, c), (d, b)] if graph.degree[corner] > 3 else [])
            for start, end in edges:
                if known(start) and known(end) and developed < 4:
                    self.develop(site, start, end)
                    developed += 1
        self.given_base = self.here_base = around.base
        if not self.members:
            return
        count = len(self.members)
        self.here_base = [mean(sum(x[i] for x in self.members), count) for i in range(2)]
        weak = not around.members
        if not weak and here > given:
            around.lean = self.here_base
            if len(around.members) == 1:
                around.spread = [abs(x) for x in minus(self.given_base, self.here_base)]
            return
        around.source, around.base, around.members, around.lean = 1, self.here_base, self.members, self.here_base
        around.spread = [max(abs(x[i] - self.members[0][i]) for x in self.members) for i in range(2)]
        if not weak:
            around.lean = self.given_base
            if count == 1:
                around.spread = [abs(x) for x in minus(self.given_base, self.here_base)]

    def develop(self, site, start, end):
        at = [self.places[3 * s:3 * s + 3] for s in (start, end, site)]
        edge, leg = minus(at[1], at[0]), minus(at[2], at[0])
        shift = max(largest(edge + leg) - 14, 0)
        edge, leg = [x >> shift for x in edge], [x >> shift for x in leg]
        square, along = dot(edge, edge), dot(edge, leg)
        if square == 0:
            return
        height = near_root(dot(leg, leg) * square - along * along)
        if (self.turns.get(start) or self.turns.get(end) or self.last_turn) < 0:
            height = -height
        origin = self.coder.values[start]
        dx, dy = minus(self.coder.values[end], origin)
        forth, aside = (x * (2**45 // square) >> 25 for x in (along, height))
        steps = forth * dx - aside * dy, forth * dy + aside * dx
        self.members.append([clamp(16 * origin[i] + (steps[i] + 2**15 >> 16), -self.limit, 2 * self.limit)
                             for i in range(2)])
        if self.first is None:
            self.first = origin, dx, dy

    def learn(self, site, value):
        truth = [16 * x for x in value]
        self.here[site], self.given[site] = distance(truth, self.here_base), distance(truth, self.given_base)
        if self.first is None:
            return
        origin, dx, dy = self.first
        side = dx * (value[1] - origin[1]) - dy * (value[0] - origin[0])
        if side:
            self.last_turn = 1 if side > 0 else -1
        self.turns[site] = self.last_turn


def surface_normals(graph, places, weighting):
    sums = [[0] * 3 for _ in range(graph.site_count)]

    def between(start, end):
        return minus(places[3 * end:3 * end + 3], places[3 * start:3 * start + 3])

    for begin, degree in graph.faces:
        if degree < 3:
            continue
        normal = [0, 0, 0]
        for c in range(begin + 1, begin + min(degree, 2**20) - 1):
            part = cross(*(between(graph.site[begin], graph.site[x]) for x in (c, c + 1)))
            normal = [x + y for x, y in zip(normal, part)]
        normal = shortened(normal, 46) if weighting == BY_AREA else unit(normal)
        for c in range(begin, begin + degree):
            site, weight = graph.site[c], 1
            if weighting == BY_ANGLE:
                weight = angle(*(between(site, graph.site[x]) for x in (graph.next[c], graph.prev[c])))
            sums[site] = [(x + y * weight + 2**63) % 2**64 - 2**63 for x, y in zip(sums[site], normal)]
    return [unit(normal) for normal in sums]


class Directions:
    def __init__(self, coder, places):
        self.coder, self.centre, graph = coder, coder.max // 2, coder.graph
        self.surface = [[0] * 3] * graph.site_count
        if places:
            self.surface = surface_normals(graph, places, coder.weighting)
        self.inward, self.last_inward = [False] * graph.site_count, False
        self.direction, self.errors = {}, {}

    def turn(self, site, inward):
        if self.inward[site] != inward:
            self.inward[site] = inward
            self.surface[site] = [-x for x in self.surface[site]]

    def refine(self, site, around):
        neighbours = around.neighbours
        count = len(neighbours)
        total = [sum(self.direction[s][i] for s in neighbours) for i in range(3)]
        deviation = [sum(self.direction[s][i] - self.surface[s][i] for s in neighbours) for i in range(3)]
        errors = [sum(self.errors[s][k] for s in neighbours) for k in range(3)]
        inward = sum(self.inward[s] for s in neighbours)
        self.turn(site, 2 * inward > count if count else self.last_inward)
        normal = self.surface[site]
        deviating = [x + (mean(y, count) if count else 0) for x, y in zip(normal, deviation)]
        wanted = [normal if any(normal) else total, deviating, total if count else deviating]
        self.bases = [self.projected(v, around.base) for v in wanted]
        if not count and not any(normal):
            return
        best, second = sorted(range(3), key=lambda k: errors[k])[:2]
        around.source, around.members, around.base = 1, [self.bases[best]], self.bases[best]
        around.lean = self.bases[second]
        around.spread = [abs(x) for x in minus(around.lean, around.base)]

    def projected(self, v, fallback):
        if not any(v):
            return fallback
        middle = self.centre << 4
        scale = (middle << 24) // sum(abs(x) for x in v)
        y, z = v[1] * scale >> 24, v[2] * scale >> 24
        if v[0] >= 0:
            return [y + middle, z + middle]
        return [abs(z) if y < 0 else 2 * middle - abs(z), abs(y) if z < 0 else 2 * middle - abs(y)]

    def learn(self, site, value):
        truth = [16 * x for x in value]
        self.errors[site] = [distance(truth, base) for base in self.bases]
        y, z = (x - self.centre for x in value)
        x = self.centre - abs(y) - abs(z)
        fold = max(-x, 0)
        self.direction[site] = unit([x, y + (fold if y < 0 else -fold), z + (fold if z < 0 else -fold)])
        along = dot(self.direction[site], self.surface[site])
        if along < 0:
            self.turn(site, not self.inward[site])
        if along:
            self.last_inward = self.inward[site]
