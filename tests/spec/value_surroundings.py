"""What is known around a site: EXTENSION_SPEC.md, D.4.6."""
from value_geometry import mean
from value_models import bit_length, cut

POINTS, DIRECTION, ANGULAR = 1, 3, 5
WITHIN, ACROSS, FACE, STRAIGHT, AROUND, LAST = range(6)
POLYGONS = {4: (4096, 4096), 5: (6627, 2531), 6: (8192, 2048), 7: (9204, 1823), 8: (9889, 1697), 9: (10371, 1618),
            10: (10723, 1565), 11: (10988, 1527), 12: (11190, 1499), 13: (11350, 1478), 14: (11477, 1462),
            15: (11580, 1449), 16: (11664, 1438)}


# D.4.6 Surroundings

class Surroundings:
    def __init__(self, coder, site):
        self.coder, self.m, self.site = coder, coder.m, site
        graph, known, values = coder.graph, coder.known, coder.values
        self.neighbours, self.normal = [], [0, 0, 0]
        polygons, quads, triangles, normals = [], [], [], []
        for corner in graph.corners(site):
            n, p = graph.next[corner], graph.prev[corner]
            a, b, c, d = (graph.site[x] for x in (n, p, graph.next[n], graph.prev[p]))
            if known(a):
                self.neighbours.append(a)
            if known(b) and graph.twin[p] is None:
                self.neighbours.append(b)
            degree = graph.degree[corner] if coder.kind != DIRECTION else 0
            if degree == 3 and known(a) and known(b) and graph.twin[n] is not None:
                twin = graph.twin[n]
                x = graph.site[graph.prev[twin]]
                y = x if graph.degree[twin] == 3 else graph.site[graph.next[graph.next[twin]]]
                if known(x) and known(y):
                    triangles.append((graph.site[graph.next[twin]], graph.site[twin], x, y))
            elif degree == 4 and known(a) and known(b) and known(c):
                quads.append((a, b, c, c))
            elif degree > 4:
                self.polygon(polygons, normals, degree, a, b, c, d, n, p)
        self.source = WITHIN if polygons or quads else ACROSS if triangles else LAST
        chosen = (quads if self.source == WITHIN else triangles)[:max(4 - len(polygons), 0)]
        self.members = polygons[:4] + [self.parallelogram(*f) for f in chosen]
        if coder.kind == ANGULAR and self.source == ACROSS:
            for member, (a, b, x, y) in zip(self.members, chosen):
                if x == y:
                    self.shift(member, a, b, x, site)
        if coder.kind in (POINTS, ANGULAR):
            for origin, first, second in normals + [(b, a, x) for a, b, x, _ in chosen]:
                self.add_normal(values[origin], values[first], values[second])
        self.settle(site)

    def polygon(self, members, normals, degree, a, b, c, d, n, p):
        graph, known = self.coder.graph, self.coder.known
        k, inverse = POLYGONS[min(degree, 16)]
        if known(a) and known(b):
            if known(d):
                self.scaled(members, b, a, d, inverse)
            if known(c):
                self.scaled(members, a, b, c, inverse)
                normals.append((b, a, c))
        elif known(b) and known(d):
            e = graph.site[graph.prev[graph.prev[p]]]
            if known(e):
                self.scaled(members, e, b, d, k)
        elif known(a) and known(c):
            e = graph.site[graph.next[graph.next[n]]]
            if known(e):
                self.scaled(members, e, a, c, k)

    def scaled(self, members, at, to, origin, factor):
        v = self.coder.values
        members.append([16 * v[at][i] + ((v[to][i] - v[origin][i]) * factor >> 8) for i in range(self.m)])

    def parallelogram(self, a, b, x, y):
        v = self.coder.values
        return [(2 * (v[a][i] + v[b][i]) - v[x][i] - v[y][i]) * self.coder.one >> 1 for i in range(self.m)]

    def shift(self, member, a, b, x, site):
        def shape(o):
            u = l * r + l * o + r * o
            first, second = (cut((u - 2 * s) * u * 65536, s * (u - s)) for s in (r * o, l * o))
            return first + second, cut(first * 4096, first + second)

        l, r = (self.valence(s) for s in (a, b))
        (flat1, foot1), (flat2, foot2) = shape(self.valence(x)), shape(self.valence(site))
        h = (flat1 * 4096 + flat2 // 2) // flat2
        k = h * foot1 >> 12
        f, g = h - k - foot2 >> 4, foot2 + k - 4096 >> 4
        v = self.coder.values
        for i in range(3):
            member[i] += (v[a][i] - v[x][i]) * f + (v[b][i] - v[x][i]) * g >> 4

    def valence(self, site):
        corners = self.coder.graph.corners(site)
        is_open = bool(corners) and self.coder.graph.twin[corners[0]] is None
        return min(max(len(corners) * (2 if is_open else 1), 3), 10)

    def add_normal(self, origin, first, second):
        n = max(bit_length(self.coder.max) - 14, 0)
        u = [first[i] - origin[i] >> n for i in range(3)]
        w = [second[i] - origin[i] >> n for i in range(3)]
        for i in range(3):
            j, k = (i + 1) % 3, (i + 2) % 3
            self.normal[i] = (self.normal[i] + u[j] * w[k] - u[k] * w[j] + 2**31) % 2**32 - 2**31

    def replace(self, prediction):
        self.base = self.lean = prediction
        self.members, self.spread, self.normal = [], [0] * self.m, [0, 0, 0]

    def settle(self, site):
        m, members = self.m, self.members
        self.spread = [0] * m
        if members:
            self.lean = self.base = self.average(members)
        if len(members) > 1:
            self.spread = [max(abs(x[i] - members[0][i]) for x in members) for i in range(m)]
            return
        offers = self.far(site) if len(members) <= self.coder.far_limit else []
        if self.neighbours:
            offers.append((AROUND, self.around()))
        if not members:
            self.source, self.base = offers.pop(0) if offers else (LAST, [self.coder.one * x for x in self.coder.last])
            self.lean = self.base
        if offers:
            self.lean = offers[0][1]
            self.spread = [abs(self.lean[i] - self.base[i]) for i in range(m)]

    def around(self):
        v, count = self.coder.values, len(self.neighbours)
        return [mean(16 * sum(v[s][i] for s in self.neighbours), count) for i in range(self.m)]

    def average(self, predictions):
        weighed = predictions + predictions[2:] if len(predictions) == 3 else predictions
        return [mean(sum(x[i] for x in weighed), len(weighed)) for i in range(self.m)]

    def far(self, site):
        graph, known, v, across, straight = self.coder.graph, self.coder.known, self.coder.values, [], []
        one, beside = self.coder.one, self.m == 3 or self.coder.beside

        def look(a, c, degree, y, x):
            if degree > 3 and known(x) and known(c) and len(across) < 4 and not (beside and both):
                across.append([(v[a][i] + v[c][i] - v[x][i]) * one for i in range(self.m)])
            if degree > 3 and known(y) and len(straight) < 4:
                straight.append([(2 * v[a][i] - v[y][i]) * one for i in range(self.m)])

        for corner in graph.corners(site):
            if graph.degree[corner] <= 3:
                continue
            n, p = graph.next[corner], graph.prev[corner]
            q = graph.prev[p]
            both = known(graph.site[n]) and known(graph.site[p])
            a, b, t, u = graph.site[n], graph.site[p], graph.twin[n], graph.twin[q]
            if known(a) and t is not None:
                look(a, graph.site[graph.next[n]], graph.degree[t], graph.site[graph.next[graph.next[t]]],
                     graph.site[graph.prev[t]])
            if known(b) and u is not None:
                look(b, graph.site[q], graph.degree[u], graph.site[graph.prev[u]],
                     graph.site[graph.next[graph.next[u]]])
        return [(source, self.average(found)) for source, found in ((FACE, across), (STRAIGHT, straight)) if found]
