"""A second decoder of attribute values, written from EXTENSION_SPEC.md, D.4, alone and laid out like it.

decode(mesh, sites, site_count, m, maximum, head, data, places) -> the numbers, m per site.
"""
from models import clamp, require
from value_models import (Chances, Classes, Lengths, MixedChance, ValueStream, bit_length, cut, log4, varint)
from value_geometry import Directions, Textures, mean

FAST, DEFAULT, SMALL = range(3)
PLAIN, POINTS, TEXTURE, DIRECTION, LABEL = range(5)
WITHIN, ACROSS, FACE, STRAIGHT, AROUND, LAST = range(6)
POLYGONS = {4: (4096, 4096), 5: (6627, 2531), 6: (8192, 2048), 7: (9204, 1823), 8: (9889, 1697), 9: (10371, 1618),
            10: (10723, 1565), 11: (10988, 1527), 12: (11190, 1499), 13: (11350, 1478), 14: (11477, 1462),
            15: (11580, 1449), 16: (11664, 1438)}


# D.4.2 Sites

class Graph:
    def __init__(self, mesh, sites, site_count):
        self.site, self.site_count, self.twin = sites, site_count, list(mesh.twins)
        self.next, self.prev, self.degree, corner = [], [], [], 0
        self.faces = []
        for degree in mesh.degrees:
            self.faces.append((corner, degree))
            ring = range(corner, corner + degree)
            self.next += [c + 1 for c in ring][:-1] + [corner if degree <= 2048 else corner + degree - 1] * (degree > 0)
            self.prev += [corner + degree - 1 if degree <= 2048 else corner] * (degree > 0) + [c - 1 for c in ring][1:]
            self.degree += [min(degree, 255)] * degree
            corner += degree
        for c, t in enumerate(mesh.twins):
            if t is not None and (sites[t] != sites[self.next[c]] or sites[self.next[t]] != sites[c]):
                self.twin[c] = None
        self.around = [[] for _ in range(site_count)]
        for c, site in enumerate(sites):
            if self.degree[c] >= 3 and len(self.around[site]) < 64:
                self.around[site].append(c)


# D.4.3 Order

class Order:
    def __init__(self, graph):
        self.graph, self.seed = graph, 0
        self.scores, self.known = [0] * graph.site_count, [False] * graph.site_count
        self.stacks = [[] for _ in range(6)]

    @staticmethod
    def level(score):
        return min(score.bit_length(), 6) - 1

    def next(self):
        for stack in reversed(self.stacks):
            while stack:
                site = stack.pop()
                if not self.known[site]:
                    return site
        while self.known[self.seed]:
            self.seed += 1
        return self.seed

    def urgencies(self, corner):
        graph, known = self.graph, self.known
        following, before = graph.next[corner], graph.prev[corner]
        a, b, c, d = (graph.site[x] for x in (following, before, graph.next[following], graph.prev[before]))
        if graph.degree[corner] == 3:
            return [(a, 2 * known[b])] * (not known[a]) + [(b, 2 * known[a])] * (not known[b])
        if graph.degree[corner] == 4:
            others = known[a] + known[b] + known[c]
            amount = (0, 2, 16, 0)[others]
            return [(s, amount) for s in (a, b) if not known[s]] + [(c, amount)] * (others == 2 and not known[c])
        amount_a = 8 if known[c] else 2 if known[b] else 0
        amount_b = 8 if known[d] else 2 if known[a] else 0
        return [(a, amount_a)] * (not known[a]) + [(b, amount_b)] * (not known[b])

    def learn(self, site):
        for other, amount in [entry for corner in self.graph.around[site] for entry in self.urgencies(corner)]:
            before = self.scores[other]
            now = self.scores[other] = clamp(before + amount, 1, 253)
            if self.level(now) != self.level(before):
                self.stacks[self.level(now)].append(other)
        self.known[site] = True


# D.4.6 Surroundings

class Surroundings:
    def __init__(self, coder, site):
        self.coder, self.m = coder, coder.m
        graph, known, values = coder.graph, coder.order.known, coder.values
        self.neighbours, self.normal = [], [0, 0, 0]
        polygons, quads, triangles, normals = [], [], [], []
        for corner in graph.around[site]:
            n, p = graph.next[corner], graph.prev[corner]
            a, b, c, d = (graph.site[x] for x in (n, p, graph.next[n], graph.prev[p]))
            if known[a]:
                self.neighbours.append(a)
            if known[b] and graph.twin[p] is None:
                self.neighbours.append(b)
            degree = graph.degree[corner]
            if degree == 3 and known[a] and known[b] and graph.twin[n] is not None:
                twin = graph.twin[n]
                x = graph.site[graph.prev[twin]]
                y = x if graph.degree[twin] == 3 else graph.site[graph.next[graph.next[twin]]]
                if known[x] and known[y]:
                    triangles.append((graph.site[graph.next[twin]], graph.site[twin], x, y))
            elif degree == 4 and known[a] and known[b] and known[c]:
                quads.append((a, b, c, c))
            elif degree > 4:
                self.polygon(polygons, normals, degree, a, b, c, d, n, p)
        self.source = WITHIN if polygons or quads else ACROSS if triangles else LAST
        for a, b, x, y in quads + triangles:
            normals.append((b, a, x))
        chosen = quads if self.source == WITHIN else triangles
        self.members = (polygons + [self.parallelogram(*f) for f in chosen])[:8]
        if coder.kind == POINTS:
            for origin, first, second in normals:
                self.add_normal(values[origin], values[first], values[second])
        self.settle(site)

    def polygon(self, members, normals, degree, a, b, c, d, n, p):
        graph, known = self.coder.graph, self.coder.order.known
        k, inverse = POLYGONS[min(degree, 16)]
        if known[a] and known[b]:
            if known[d]:
                self.scaled(members, b, a, d, inverse)
            if known[c]:
                self.scaled(members, a, b, c, inverse)
                normals.append((b, a, c))
        elif known[b] and known[d]:
            e = graph.site[graph.prev[graph.prev[p]]]
            if known[e]:
                self.scaled(members, e, b, d, k)
        elif known[a] and known[c]:
            e = graph.site[graph.next[graph.next[n]]]
            if known[e]:
                self.scaled(members, e, a, c, k)

    def scaled(self, members, at, to, origin, factor):
        v = self.coder.values
        members.append([16 * v[at][i] + ((v[to][i] - v[origin][i]) * factor >> 8) for i in range(self.m)])

    def parallelogram(self, a, b, x, y):
        v = self.coder.values
        return [(2 * (v[a][i] + v[b][i]) - v[x][i] - v[y][i]) * 8 for i in range(self.m)]

    def add_normal(self, origin, first, second):
        u = [first[i] - origin[i] for i in range(3)]
        w = [second[i] - origin[i] for i in range(3)]
        for i in range(3):
            j, k = (i + 1) % 3, (i + 2) % 3
            self.normal[i] += u[j] * w[k] - u[k] * w[j]

    def settle(self, site):
        m, members = self.m, self.members
        self.spread = [0] * m
        if members:
            self.base = [mean(sum(x[i] for x in members), len(members)) for i in range(m)]
            self.lean = self.base
        if len(members) > 1:
            self.spread = [max(abs(x[i] - members[0][i]) for x in members) for i in range(m)]
            return
        offers, v = self.far(site), self.coder.values
        if self.neighbours:
            offers.append((AROUND, [mean(16 * sum(v[s][i] for s in self.neighbours), len(self.neighbours))
                                    for i in range(m)]))
        if not members:
            self.source, self.base = offers.pop(0) if offers else (LAST, [16 * x for x in self.coder.last])
            self.lean = self.base
        if offers:
            self.lean = offers[0][1]
            self.spread = [abs(self.lean[i] - self.base[i]) for i in range(m)]

    def far(self, site):
        graph, known, v, across, straight = self.coder.graph, self.coder.order.known, self.coder.values, [], []

        def look(a, c, degree, y, x):
            if known[x] and known[c] and len(across) < 8:
                across.append([(3 * v[a][i] + v[c][i] - 2 * v[x][i]) * 8 if degree == 3 else
                               (v[a][i] + v[c][i] - v[x][i]) * 16 for i in range(self.m)])
            if degree > 3 and known[y] and len(straight) < 8:
                straight.append([(2 * v[a][i] - v[y][i]) * 16 for i in range(self.m)])

        for corner in graph.around[site]:
            if graph.degree[corner] <= 3:
                continue
            n, p = graph.next[corner], graph.prev[corner]
            q = graph.prev[p]
            a, b, t, u = graph.site[n], graph.site[p], graph.twin[n], graph.twin[q]
            if known[a] and t is not None:
                look(a, graph.site[graph.next[n]], graph.degree[t], graph.site[graph.next[graph.next[t]]],
                     graph.site[graph.prev[t]])
            if known[b] and u is not None:
                look(b, graph.site[q], graph.degree[u], graph.site[graph.prev[u]],
                     graph.site[graph.next[graph.next[u]]])
        return [(source, [mean(sum(x[i] for x in found), len(found)) for i in range(self.m)])
                for source, found in ((FACE, across), (STRAIGHT, straight)) if found]


# D.4.9 Echoes

class Echoes:
    def __init__(self, coder):
        self.coder, self.places, self.coded, self.last, self.same = coder, {}, [], {}, {}
        self.bits = min(bit_length(coder.graph.site_count) + 2, 28)
        self.hits, self.longer, self.history = Chances(), Chances(), 0

    def slot(self, value):
        h = 0
        for x in value:
            h = ((h ^ x) * 0x9E3779B1 + 0x7F4A7C15) % 2**32
        return ((h ^ h >> 15) * 0x85EBCA6B % 2**32) >> (32 - self.bits)

    def read(self, stream, site, has_neighbours):
        if not has_neighbours:
            return self.read_place(stream)
        candidate = self.candidate(site)
        if candidate is None:
            return None
        same = self.hits[self.history].read(stream)
        self.history = (self.history << 1 | same) & 7
        return candidate if same else None

    def candidate(self, site):
        graph = self.coder.graph
        for corner in graph.around[site]:
            for edge, end, onwards in ((corner, graph.next[corner], True), (graph.prev[corner],) * 2 + (False,)):
                if graph.twin[edge] is None:
                    found = self.beside(graph.site[end], onwards)
                    if found is not None:
                        return found
        return None

    def beside(self, neighbour, onwards):
        graph, known = self.coder.graph, self.coder.order.known
        same = self.same.get(neighbour) if known[neighbour] else None
        for _ in range(4):
            if same is None:
                return None
            for corner in graph.around[same]:
                edge = corner if onwards else graph.prev[corner]
                other = graph.site[graph.next[corner] if onwards else edge]
                if graph.twin[edge] is None and known[other]:
                    return other
            same = self.same.get(same)
        return None

    def read_place(self, stream):
        length, most = 0, bit_length(len(self.coded))
        while length < most and self.longer[length].read(stream):
            length += 1
        if length == 0:
            return None
        ago = 1 << (length - 1) | stream.plain(length - 1)
        return self.coded[len(self.coded) - min(ago, len(self.coded))]

    def learn(self, site):
        value = self.coder.values[site]
        slot = self.slot(value)
        if slot in self.last and self.coder.values[self.last[slot]] == value:
            self.same[site] = self.last[slot]
        self.last[slot] = site
        self.coded.append(site)


# D.4.7 Values

class Coder:
    def __init__(self, graph, m, maximum, kind, profile, echoes, stream, places):
        self.graph, self.m, self.max, self.kind, self.stream = graph, m, maximum, kind, stream
        self.order, self.profile = Order(graph), profile
        self.values, self.errors, self.picked = {}, {}, {}
        self.last, self.typical = [0] * m, 64
        self.picks, self.indices, self.gains = Chances(6160), Chances(), {}
        self.residuals = Lengths() if profile == SMALL else Classes(profile)
        self.echoes = Echoes(self) if echoes else None
        self.guide = {TEXTURE: Textures, DIRECTION: Directions}.get(kind, lambda *_: None)(self, places)

    def run(self):
        for _ in range(self.graph.site_count):
            site = self.order.next()
            self.site(site)
            self.order.learn(site)
        return [x for site in range(self.graph.site_count) for x in self.values[site]]

    def site(self, site):
        around = Surroundings(self, site)
        if self.guide:
            self.guide.refine(site, around)
        self.scale(around)
        earlier = self.echoes.read(self.stream, site, bool(around.neighbours)) if self.echoes else None
        if earlier is None:
            value, errors, picked = self.components(around, *self.pick(around))
        else:
            value, picked = self.values[earlier], False
            errors = [min(abs(16 * value[i] - around.base[i]), 2**20) for i in range(self.m)]
        self.values[site], self.errors[site], self.picked[site], self.last = value, errors, picked, value
        if self.guide:
            self.guide.learn(site, value)
        if self.echoes:
            self.echoes.learn(site)
        now = min(sum(errors) // self.m, 4 * self.typical)
        self.typical = max(self.typical + (now - self.typical >> 5), 16)

    def scale(self, around):
        count = len(around.neighbours)
        self.near, self.all = [self.typical] * self.m, self.typical
        if count:
            reciprocal = (65536 + count // 2) // count
            self.near = [sum(self.errors[s][i] for s in around.neighbours) * reciprocal >> 16 for i in range(self.m)]
            self.all = sum(self.near) * 21845 >> 16 if self.m == 3 else sum(self.near) // self.m
            if count == 1:
                self.all = self.all + self.typical >> 1

    def pick(self, around):
        count = len(around.members)
        if count < 2:
            return around.base, min(count, 3), False
        level = min(log4(sum(around.spread)) // 4, 11)
        flagged = min(sum(self.picked[s] for s in around.neighbours), 3)
        row = min(count, 4)
        if not self.picks[around.source == WITHIN, row, flagged, level].read(self.stream):
            return around.base, min(count, 3), False
        k = 0
        while k + 1 < count and not self.indices[row, k].read(self.stream):
            k += 1
        return around.members[k], 0, True

    def components(self, around, base, members, picked):
        order, normal = list(range(self.m)), None
        if any(around.normal):
            order.sort(key=lambda i: abs(around.normal[i]))
            shift = max(bit_length(abs(around.normal[order[2]])) - 12, 0)
            normal = [x >> shift for x in around.normal]
        value, errors, raw, so_far = [0] * self.m, [0] * self.m, [0] * self.m, 0
        for rank, i in enumerate(order):
            prediction, gain = base[i], None
            if rank == 2 and normal:
                s = min(around.source, 2) if around.members else 2
                gain = (min(bit_length(self.all), 15), s, len(around.members) > 1)
                correction = cut(-(normal[order[0]] * raw[order[0]] + normal[order[1]] * raw[order[1]]), normal[i])
                prediction += self.gains.setdefault(gain, 2048) * correction >> 12
            rounded = clamp(prediction + 8 >> 4, 0, self.max)
            side = normal[i] if normal else around.lean[i] - prediction
            number = rounded + self.residual(around, i, min(rank, 2), so_far, prediction, side, base, members, picked)
            require(0 <= number <= self.max, 'a value outside its range')
            value[i], raw[i] = number, 16 * number - base[i]
            errors[i] = min(abs(16 * number - prediction), 2**20)
            so_far += errors[i]
            if gain:
                self.adapt(gain, raw[i], correction)
        return value, errors, picked

    def adapt(self, gain, off, correction):
        limit = 4 * self.all + 64
        if abs(off) > limit or abs(correction) > limit:
            return
        error = off - (self.gains[gain] * correction >> 12)
        shift = 2 * bit_length(self.all) - 6
        step = error * correction >> shift if shift >= 0 else error * correction << -shift
        self.gains[gain] = clamp(self.gains[gain] + clamp(step, -512, 512), -512, 4608)

    def residual(self, around, i, rank, so_far, prediction, side, base, members, picked):
        near, count = self.near[i], len(around.members)
        spread = min(around.spread[i], 2**25)
        estimate = (near if self.m == 1 else (2 * self.all + near) // 3 if rank == 0 else
                    self.all + near + (2 if rank == 1 else 1) * so_far >> 2)
        if count > 1:
            estimate = estimate + spread >> 1
        elif count == 1:
            estimate = 7 * estimate + min(spread, 2 * estimate) >> 3
        if picked:
            estimate >>= 1
        level = min(log4(estimate >> 1), 63)
        sign = ((prediction & 15) >> 1, (side > 0) - (side < 0), rank)

        def relative(size, low, high):
            return clamp(log4(size >> 1) - level >> 1, low, high)

        if self.profile != SMALL:
            second = relative(spread, -7, 7), relative(near, -3, 2), level // 4
            return self.residuals.read(self.stream, level, (level // 2, rank, members), second, sign)
        e = min(bit_length(estimate * 3 >> 6), 18)
        widest = min(max(around.spread), 2**25)
        source = min(around.source, 1) if count else 2
        contexts = ((level, rank, members), (relative(spread, -7, 7), members, e),
                    (relative(near, -5, 6), relative(widest, -7, 8), e),
                    (source, members, e, min(log4(self.all >> 1) // 2, 31)), (min(log4(so_far) // 2, 31), e, rank))
        return self.residuals.read(self.stream, e, rank, contexts, sign)


# D.4.12 Labels

def labels(graph, count, stream):
    order, label_of, last, mixed = Order(graph), {}, 0, MixedChance()
    slots = [Chances() for _ in range(5)]
    none = 2**32 - 1
    for _ in range(graph.site_count):
        site = order.next()
        around, found, agreeing = [none] * 3, 0, 0
        for corner in graph.around[site]:
            for other in (graph.next[corner], graph.prev[corner]):
                label = label_of.get(graph.site[other], none)
                if label == none:
                    continue
                if found < 2 and (found == 0 or label != around[0]):
                    around[found] = label
                    found += 1
                agreeing += label == around[0]
            opposite = label_of.get(graph.site[graph.next[graph.next[corner]]], none)
            if around[2] == none:
                around[2] = opposite
        contexts = (0, around[0] * 4 + min(agreeing, 3), around[0] * 0x10001 + around[1] * 3,
                    around[2] * 0x8003 + around[0], last)
        bits, node = bit_length(count - 1), 1
        for i in reversed(range(bits)):
            bit = 0
            if ((node << 1 | 1) << i) - (1 << bits) < count:
                hashes = [((c * 0x9E3779B1 ^ node * 0x85EBCA6B) * 0xC2B2AE35 % 2**32) >> 18 for c in contexts]
                bit = mixed.read(stream, bit_length(node), [slots[k][h] for k, h in enumerate(hashes)])
            node = node << 1 | bit
        label_of[site] = last = node - (1 << bits)
        order.learn(site)
    return [label_of[site] for site in range(graph.site_count)]


# D.4.1 Streams

def decode(mesh, sites, site_count, m, maximum, head, data, places):
    profile, kind, ranked, echoes = head & 3, head >> 2 & 7, head >> 5 & 1, head >> 6 & 1
    require(head < 128 and profile <= SMALL and kind <= LABEL, 'head')
    graph, at = Graph(mesh, sites, site_count), 0
    if kind == LABEL:
        return read_labels(graph, m, maximum, data)
    lists = None
    if ranked:
        lists, at = read_ranks(data, m, maximum)
        maximum = max(len(ranks) for ranks in lists) - 1
    stream = ValueStream(data, at)
    values = Coder(graph, m, maximum, kind, profile, echoes, stream, places).run()
    stream.finish()
    if not lists:
        return values
    require(all(x < len(lists[i % m]) for i, x in enumerate(values)), 'a rank too large')
    return [lists[i % m][x] for i, x in enumerate(values)]


# D.4.11 Ranks

def read_ranks(data, m, maximum):
    lists, at = [], 0
    for _ in range(m):
        count, at = varint(data, at)
        ranks, value = [], -1
        for _ in range(count + 1):
            step, at = varint(data, at)
            value += step + 1
            require(value <= maximum, 'a value outside its range')
            ranks.append(value)
        lists.append(ranks)
    return lists, at


def read_labels(graph, m, maximum, data):
    count, at = varint(data, 0)
    require(1 <= count <= 4096, 'number of names')
    names = []
    for i in range(count):
        name = []
        for k in range(m):
            step, at = varint(data, at)
            name.append(step + (names[-1][0] if k == 0 and i > 0 else 0))
        require(max(name) <= maximum, 'a value outside its range')
        names.append(name)
    stream = ValueStream(data, at)
    found = labels(graph, count, stream)
    stream.finish()
    return [x for label in found for x in names[label]]
