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
