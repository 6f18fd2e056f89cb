"""Sites and their order: EXTENSION_SPEC.md, D.4.2 and D.4.3."""
from models import clamp


# D.4.2 Sites

class Graph:
    def __init__(self, mesh, sites, site_count):
        self.mesh, self.site, self.site_count, self.twin = mesh, sites, site_count, list(mesh.twins)
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
        for site, fan in self.fans():
            for k, c in enumerate(fan[:60 - len(self.around[site])]):
                self.around[site].append((c, k + 1 == len(fan)))

    def fans(self):
        listed = set()
        counted = [c for c in range(len(self.site)) if self.degree[c] >= 3]
        for first in [c for c in counted if self.twin[c] is None] + counted:
            fan, c = [], first
            while c is not None and c not in listed and self.site[c] == self.site[first] and self.degree[c] >= 3:
                listed.add(c)
                fan.append(c)
                c = self.twin[self.prev[c]]
            if fan:
                yield self.site[first], fan

    def corners(self, site):
        return [c for c, _ in self.around[site]]


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

    def urgencies(self, fan):
        graph, known = self.graph, self.known
        sides = [graph.site[graph.next[c]] for c in fan] + [graph.site[graph.prev[fan[-1]]]]
        amounts, opposite = [0] * len(sides), []
        for i, c in enumerate(fan):
            following, before, degree = graph.next[c], graph.prev[c], graph.degree[c]
            a, b, c2, d = (known[graph.site[x]] for x in (following, before, graph.next[following], graph.prev[before]))
            if degree == 3:
                more = 2 * b, 2 * a
            elif degree == 4:
                more = ((0, 2, 16, 0)[a + b + c2],) * 2
                if a + b + c2 == 2 and not c2:
                    opposite.append((graph.site[graph.next[following]], 16))
            else:
                more = 8 if c2 else 2 if b else 0, 8 if d else 2 if a else 0
            amounts[i] += more[0]
            amounts[i + 1] += more[1]
        entries = list(zip(sides, amounts))
        if graph.twin[graph.prev[fan[-1]]] == fan[0]:
            entries = [(sides[0], amounts[0] + amounts[-1])] + entries[1:-1]
        return opposite + [(s, amount) for s, amount in reversed(entries) if not known[s]]

    def all_urgencies(self, site):
        fan = []
        for corner, last in self.graph.around[site]:
            fan.append(corner)
            if last:
                yield from self.urgencies(fan)
                fan = []
        if fan:
            yield from self.urgencies(fan)

    def learn(self, site):
        for other, amount in list(self.all_urgencies(site)):
            before = self.scores[other]
            now = self.scores[other] = clamp(before + amount, 1, 253)
            if self.level(now) != self.level(before):
                self.stacks[self.level(now)].append(other)
        self.known[site] = True
