"""The symbols of the walk: EXTENSION_SPEC.md, B.6."""
from models import Bit, Number, RangeDecoder, require
from symbol_statistics import Mixed, Paper


class Symbols:
    def __init__(self, section, walk):
        self.section, self.walk = section, walk
        self.stream = RangeDecoder(section.symbols)
        self.statistics = Mixed(section) if section.profile else Paper(section)
        self.component_model = Bit()
        self.dummy = [Bit() for _ in range(16)]
        self.near, self.backward, self.distance = ([model() for _ in range(2)] for model in (Bit, Bit, Number))
        self.first = [[Bit() for _ in range(5)] for _ in range(2)]
        self.copy, self.rank = Bit(), Number()
        self.log, self.recent, self.replayed = [], [], None
        self.components, self.original = 0, None

    def component(self):
        if not self.component_model.read(self.stream):
            return False
        self.replayed = self.original = None
        if self.section.copies:
            self.begin_copy()
        self.components += 1
        return True

    def begin_copy(self):
        if self.recent and self.copy.read(self.stream):
            rank = self.rank.read(self.stream)
            require(rank < len(self.recent), 'a copy of no component')
            self.recent.insert(0, self.recent.pop(rank))
            self.original, self.replayed = self.recent[0]
        else:
            self.recent = [(self.components, len(self.log))] + self.recent[:63]

    def coded(self, read):
        """A symbol: from the component that is repeated, or read and remembered."""
        if self.replayed is not None:
            require(self.replayed < len(self.log), 'a copy goes on behind its original')
            self.replayed += 1
            return self.log[self.replayed - 1]
        self.log.append(read())
        return self.log[-1]

    def face(self, start, edges, closed):
        return self.coded(lambda: self.statistics.face(self.stream, self.walk, start, edges, closed))

    def vertex(self):
        return self.coded(self.read_vertex)

    def read_vertex(self):
        valence = self.statistics.vertex(self.stream, self.walk)
        dummy = self.section.dummy_umbrellas and valence and self.dummy[min(valence, 15)].read(self.stream)
        self.walk.trace('vertex', valence, dummy)
        return valence, bool(dummy)

    def split(self):
        return self.coded(self.read_split)

    def read_split(self):
        last = int(self.walk.missing == 1)
        least = 2 + last
        if self.near[last].read(self.stream):
            g = self.gap_at(self.backward[last].read(self.stream), self.distance[last].read(self.stream), least)
        else:
            g = self.stream.uniform(len(self.walk.gaps))
        require(self.walk.gaps[g].free >= least, 'a split where there is no room')
        choices = self.walk.gaps[g].free - least + 1
        if choices == 1 or self.first[last][min(choices, 4)].read(self.stream):
            return g, last
        return g, last + 1 + self.stream.uniform(choices - 1)

    def gap_at(self, backward, distance, least):
        walk = self.walk
        g = walk.head if backward else walk.current
        for _ in range(1024):
            g = walk.gaps[g].prev if backward else walk.gaps[g].next
            require(g in walk.queued, 'a split beyond the boundary')
            if walk.gaps[g].free >= least:
                if distance == 0:
                    return g
                distance -= 1
        require(False, 'a split out of reach')
