"""The walk and its symbols: EXTENSION_SPEC.md, B.5 and B.6."""
from models import Bit, Number, RangeDecoder, require
from symbol_statistics import Mixed, Paper


class Mesh:
    def __init__(self):
        self.degrees, self.umbrellas, self.twins = [], [], []
        self.copies = []  # of components: first corner, first corner of the original, number of corners
        self.umbrella_count = 0
        self.vertices, self.vertex_count = [], 0
        self.flipped = []

    def polygons(self):
        """The faces, as lists of vertices in the mesh's own orientation."""
        faces, corner = [], 0
        for face, degree in enumerate(self.degrees):
            polygon = [self.vertices[u] for u in self.umbrellas[corner:corner + degree]]
            faces.append(polygon[:1] + polygon[:0:-1] if self.flipped[face] else polygon)
            corner += degree
        return faces


class Gap:
    def __init__(self, umbrella=None, valence=0, free=0):
        self.umbrella, self.valence, self.free = umbrella, valence, free
        self.next = self.prev = self.behind = None
        self.degree_behind = 0
        # What only the mixed profiles ask for.
        self.dummy = self.opposite_next = self.opposite_own = 0
        self.neighbours = self.neighbour_valences = self.angle = 0

    def copy(self):
        gap = Gap()
        gap.__dict__.update(self.__dict__)
        return gap

    def excess(self, regular):
        return max(-7, min(self.neighbour_valences - regular * self.neighbours, 7)) + 8

    def meet(self, other):
        self.neighbours += 1
        self.neighbour_valences += other.valence


def capped(gap):
    return min(gap.valence, 14)


def flat_angle(sides):
    return 65536 - 131072 // sides


class Walk:
    no_gap = Gap()

    def __init__(self, section, trace=None):
        self.section, self.trace = section, trace or (lambda *_: None)
        self.mesh = Mesh()
        self.on_boundary, self.dummy_umbrellas = set(), set()
        self.lists = [[] for _ in range(64)]
        self.queued = set()
        self.symbols = Symbols(section, self)
        self.split_read = False

    def run(self):
        starts = []
        while self.symbols.component():
            starts.append(len(self.mesh.umbrellas))
            self.seed()
            while (start := self.first()) is not None:
                self.attach(start)
            if self.symbols.original is not None:
                original = starts[self.symbols.original]
                self.mesh.copies.append((starts[-1], original, len(self.mesh.umbrellas) - starts[-1]))
        return self.mesh

    def new_gap(self, gap):
        if self.released:
            number = self.released.pop()
            self.gaps[number] = gap
        else:
            number = len(self.gaps)
            self.gaps.append(gap)
        return number

    def release(self, g):
        self.gaps[g].free = 0
        self.released.append(g)

    def first(self):
        return next((entries[0] for entries in self.lists if entries), None)

    def list_of(self, g):
        return self.lists[min(self.gaps[g].free, 63)]

    def join(self, g):
        self.list_of(g).insert(0 if self.section.newest_first else len(self.list_of(g)), g)
        self.queued.add(g)

    def leave(self, g):
        self.list_of(g).remove(g)
        self.queued.remove(g)

    def seed(self):
        self.gaps, self.released = [], []
        self.begin_attaching()
        self.begin_face(None, 0, False)
        require(not self.dummy, 'a seed is a dummy')
        self.missing = self.degree
        while self.missing > 0:
            valence, dummy = self.symbols.vertex()
            require(valence, 'a split in a seed')
            self.add_vertex(valence, dummy)
        self.link(self.touched[0], self.current, self.last_corner())
        self.requeue()

    def begin_attaching(self):
        self.touched = []
        self.known = self.valence_sum = self.angle = self.index = 0
        self.current = self.head = self.before_tail = self.face_head = self.face_tail = None
        self.before_valence, self.current_is_new = 0, False

    def attach(self, start):
        gaps = self.gaps
        self.begin_attaching()
        ahead, behind = [], []
        self.take(start)
        tail, head, closed = gaps[start].next, start, False
        self.take(tail)
        while gaps[tail].free == 0:
            ahead.append(tail)
            if gaps[tail].next == start:
                require(gaps[start].free == 0, 'a closed face leaves a free slot')
                closed = True
                break
            tail = gaps[tail].next
            self.take(tail)
        while not closed and gaps[head].free == 0:
            head = gaps[head].prev
            self.take(head)
            behind.append(head)
        edges = 1 + len(ahead) + len(behind)
        self.face_head, self.face_tail = head, tail
        self.begin_face(start, edges, closed)
        for g in [start] + ahead:
            self.emit(g)
            self.pair(g)
        if not closed:
            self.fill(head, tail, behind, edges)
        if closed or start != head:
            self.release(start)
        for g in ahead:
            self.release(g)
        for g in behind:
            if g != head:
                self.release(g)
        self.requeue()

    def fill(self, head, tail, behind, edges):
        gaps = self.gaps
        self.head, self.before_tail = head, gaps[tail].prev
        after_head = capped(gaps[gaps[head].next])
        self.before_valence = capped(gaps[self.before_tail])
        self.touched.append(tail)
        self.emit(tail)
        self.current, self.missing = tail, self.degree - edges - 1
        while self.missing > 0:
            valence, dummy = self.symbols.vertex()
            if valence:
                self.add_vertex(valence, dummy)
            else:
                self.split()
        require(gaps[self.current].free > 0, 'a vertex without a free slot')
        corner = self.last_corner()
        for g in reversed(behind):
            self.emit(g)
            self.pair(g)
        if self.current_is_new:
            gaps[self.current].opposite_own = capped(gaps[head])
        self.link(head, self.current, corner)
        gaps[head].opposite_own = after_head
        self.touched.append(head)

    def begin_face(self, start, edges, closed):
        self.degree, self.dummy = self.symbols.face(start, edges, closed)
        self.trace('face', start, edges, closed, self.degree, self.dummy)
        require(self.degree >= self.section.least_degree and self.degree >= edges, 'a degree is too small')
        require(start is None or closed == (self.degree == edges), 'a degree contradicts the boundary')
        if not self.dummy:
            self.mesh.degrees.append(self.degree)

    def add_vertex(self, valence, dummy):
        umbrella = self.mesh.umbrella_count
        self.mesh.umbrella_count += 1
        g = self.new_gap(Gap(umbrella, valence, valence - 1))
        if self.current is not None:
            self.link(g, self.current, self.last_corner())
        if dummy:
            self.dummy_umbrellas.add(umbrella)
        self.become(g, True)
        self.index += 1
        self.know(g)

    def split(self):
        self.split_read = True
        g, after = self.symbols.split()
        self.trace('split', g, after)
        require(g in self.queued and after <= self.gaps[g].free - 2, 'a split where there is no room')
        self.leave(g)
        b = self.new_gap(self.gaps[g].copy())
        self.gaps[b].free -= 1 + after
        self.gaps[self.gaps[b].prev].next = b
        self.gaps[g].free = after
        self.link(b, self.current, self.last_corner())
        self.touched.append(b)
        self.become(g, False)
        self.index += 1
        self.know(g)
        while self.gaps[self.current].free == 0:
            require(self.missing > 0, 'a face ends too early')
            n = self.gaps[self.current].next
            self.take(n)
            self.pair(self.current)
            self.release(self.current)
            self.become(n, False)

    def become(self, g, is_new):
        gaps = self.gaps
        if self.current is not None:
            if self.current_is_new:
                gaps[self.current].opposite_own = capped(gaps[g])
            self.before_valence = capped(gaps[self.current])
        self.current, self.current_is_new = g, is_new
        self.touched.append(g)
        self.emit(g)
        self.missing -= 1

    def know(self, g):
        self.known += 1
        self.valence_sum += self.gaps[g].valence
        self.angle += flat_angle(self.gaps[g].valence)

    def take(self, g):
        require(g in self.queued, 'a gap is used twice')
        self.leave(g)
        self.gaps[g].free -= 1
        self.know(g)

    def link(self, g, current, corner):
        gap, other = self.gaps[g], self.gaps[current]
        gap.next, other.prev = current, g
        gap.behind = None if self.dummy else corner
        gap.degree_behind = 0 if self.dummy else self.degree
        gap.opposite_next = self.before_valence
        gap.meet(other)
        other.meet(gap)

    def emit(self, g):
        umbrella = self.gaps[g].umbrella
        if self.dummy:
            require(umbrella not in self.on_boundary, 'two dummy faces at an umbrella')
            self.on_boundary.add(umbrella)
            return
        self.mesh.umbrellas.append(umbrella)
        self.mesh.twins.append(None)

    def pair(self, g):
        behind = self.gaps[g].behind
        if not self.dummy and behind is not None:
            self.mesh.twins[self.last_corner()] = behind
            self.mesh.twins[behind] = self.last_corner()

    def last_corner(self):
        return len(self.mesh.umbrellas) - 1

    def requeue(self):
        for i, g in enumerate(self.touched):
            gap = self.gaps[g]
            if gap.free != 0 and g not in self.touched[i + 1:]:
                gap.angle += 0 if self.dummy else flat_angle(self.degree)
                gap.dummy |= int(self.dummy)
                self.join(g)


# B.6 Symbols

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
