"""Values that come again: EXTENSION_SPEC.md, D.4.9."""
from value_models import Chances, bit_length


# D.4.9 Echoes

class Echoes:
    def __init__(self, coder):
        self.coder, self.last, self.same = coder, {}, {}
        self.bits = min(bit_length(coder.graph.site_count), 28)
        self.hits, self.longer, self.history = Chances(), Chances(), 0

    def slot(self, value):
        h = 0
        for x in value:
            h = ((h ^ x) * 0x9E3779B1 + 0x7F4A7C15) % 2**32
        return ((h ^ h >> 15) * 0x85EBCA6B % 2**32) >> (32 - self.bits)

    def read(self, stream, site, has_neighbours):
        if not has_neighbours:
            return self.read_place(stream, site)
        candidate = self.candidate(site)
        if candidate is None:
            return None
        same = self.hits[self.history].read(stream)
        self.history = (self.history << 1 | same) & 7
        return candidate if same else None

    def candidate(self, site):
        graph = self.coder.graph
        for corner in graph.corners(site):
            for edge, end, onwards in ((corner, graph.next[corner], True), (graph.prev[corner],) * 2 + (False,)):
                if graph.twin[edge] is None:
                    found = self.beside(graph.site[end], onwards)
                    if found is not None:
                        return found
        return None

    def beside(self, neighbour, onwards):
        graph, known = self.coder.graph, self.coder.known
        same = self.same.get(neighbour) if known(neighbour) else None
        for _ in range(4):
            if same is None:
                return None
            for corner in graph.corners(same):
                edge = corner if onwards else graph.prev[corner]
                other = graph.site[graph.next[corner] if onwards else edge]
                if graph.twin[edge] is None and known(other):
                    return other
            same = self.same.get(same)
        return None

    def read_place(self, stream, site):
        length, most = 0, bit_length(site)
        while length < most and self.longer[length].read(stream):
            length += 1
        if length == 0:
            return None
        ago = 1 << (length - 1) | stream.plain(length - 1)
        return site - min(ago, site)

    def learn(self, site):
        value = self.coder.values[site]
        slot = self.slot(value)
        if slot in self.last and self.coder.values[self.last[slot]] == value:
            self.same[site] = self.last[slot]
        self.last[slot] = site
