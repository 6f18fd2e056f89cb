"""The walk: EXTENSION_SPEC.md, B.5."""
from models import require
from symbols import Symbols


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
        self.surroundings = self.angle = 0

    def copy(self):
        gap = Gap()
        gap.__dict__.update(self.__dict__)
        return gap

    def excess(self, regular):
        return (self.surroundings - (regular - 4) * (self.surroundings >> 16)) % 16

    def meet(self, other):
        self.surroundings = (self.surroundings + 65548 + other.valence) % 2**32


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
