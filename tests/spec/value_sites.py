"""Sites: EXTENSION_SPEC.md, D.4.2."""


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
        for first, degree in self.faces:
            if degree > 2048:
                self.cut(first)
                self.cut(first + degree - 1)
        for c, t in enumerate(mesh.twins):
            if t is not None and (sites[t] != sites[self.next[c]] or sites[self.next[t]] != sites[c]):
                self.cut(c)
        self.around = [[] for _ in range(site_count)]
        for site, fan in self.fans():
            for k, c in enumerate(fan[:60 - len(self.around[site])]):
                self.around[site].append((c, k + 1 == len(fan)))

    def cut(self, corner):
        if self.twin[corner] is not None:
            self.twin[self.twin[corner]] = None
        self.twin[corner] = None

    def fans(self):
        counted = [c for c in range(len(self.site)) if self.degree[c] >= 3]
        lowest = {}
        for c in counted:
            lowest.setdefault(self.mesh.umbrellas[c], c)
        open_ones = [c for c in counted if self.twin[c] is None]
        cut = {self.mesh.umbrellas[c] for c in open_ones}
        for first in open_ones + [c for u, c in sorted(lowest.items()) if u not in cut]:
            fan, c = [first], self.twin[self.prev[first]]
            while c is not None and c != first:
                fan.append(c)
                c = self.twin[self.prev[c]]
            yield self.site[first], fan

    def corners(self, site):
        return [c for c, _ in self.around[site]]
