#!/usr/bin/env python3
"""A second decoder of the CONNECTIVITY section, written from EXTENSION_SPEC.md, Appendix B, alone and laid out like it.

decode(section) -> Mesh. As a program: decode.py FOLDER checks every FOLDER/*.section against FOLDER/*.mesh, both made by
the encoder's tests (tests/spec/vectors.cpp), and the worked example in EXTENSION_SPEC.md against FOLDER/cube.section.
"""
import re
import sys
from pathlib import Path


class Invalid(Exception):
    pass


def require(condition, rule):
    if not condition:
        raise Invalid(rule)


# B.3 The range decoder

class RangeDecoder:
    def __init__(self, data):
        self.data, self.position, self.range = data, 0, 2**64 - 1
        self.code = self.word() << 32
        self.code |= self.word()

    def word(self):
        chunk = self.data[self.position:self.position + 4]
        self.position += 4
        require(self.position <= len(self.data) + 8, 'the stream ends too early')
        return int.from_bytes(chunk.ljust(4, b'\0'), 'big')

    def renew(self):
        while self.range < 2**32:
            self.code = self.code << 32 | self.word()
            self.range <<= 32

    def bit(self, p):
        split = (self.range >> 16) * p
        one = self.code < split
        if one:
            self.range = split
        else:
            self.code -= split
            self.range -= split
        self.renew()
        return int(one)

    def part(self, total, choose):
        unit = self.range // total
        at = min(self.code // unit, total - 1)
        start, size = choose(at)
        self.code -= unit * start
        self.range = unit * size
        self.code = min(self.code, self.range - 1)
        self.renew()
        return at

    def uniform(self, n):
        return self.part(n, lambda at: (at, 1))

    def finish(self):
        require(len(self.data) <= self.position, 'bytes are left in a stream')


# B.4 Models

class Bit:
    def __init__(self):
        self.p, self.seen = 32768, 0

    def read(self, stream):
        bit = stream.bit(max(32, min(self.p, 65504)))
        self.p += ((65535 if bit else 0) - self.p) * (655360 // (10 * self.seen + 19)) >> 16
        self.seen = min(self.seen + 1, 255)
        return bit


class Symbol:
    def __init__(self):
        self.counts = [1] * 16

    def read(self, stream):
        symbol = 0

        def choose(at):
            nonlocal symbol
            start = 0
            while at >= start + self.counts[symbol]:
                start += self.counts[symbol]
                symbol += 1
            return start, self.counts[symbol]

        stream.part(sum(self.counts), choose)
        self.counts[symbol] += 12
        if sum(self.counts) > 8192:
            self.counts = [(count + 1) // 2 for count in self.counts]
        return symbol


class Number:
    def __init__(self):
        self.length = [Bit() for _ in range(30)]
        self.first = [Bit() for _ in range(31)]

    def read(self, stream):
        k = 0
        while k < 30 and self.length[k].read(stream):
            k += 1
        value = 1
        for i in range(k):
            value = value << 1 | (self.first[k].read(stream) if i == 0 else stream.bit(32768))
        return value - 1


# B.2 Layout

def varint(data, at):
    value = shift = 0
    while True:
        require(at < len(data), 'the section ends in its head')
        value |= (data[at] & 0x7F) << shift
        at, shift = at + 1, shift + 7
        if data[at - 1] < 0x80:
            return value, at


class Section:
    def __init__(self, data):
        require(len(data) >= 1, 'the section is empty')
        flags, at = data[0], 1
        self.uniform_degree = flags & 15
        self.closed, self.newest_first, self.repairs = flags >> 4 & 1, flags >> 5 & 1, flags >> 6 & 1
        require(flags < 128 and self.uniform_degree not in (1, 2), 'flags')
        degrees = repairs = 0
        if not (self.closed and self.uniform_degree):
            degrees, at = varint(data, at)
        if self.repairs:
            repairs, at = varint(data, at)
        require(at + degrees + repairs <= len(data), 'the section ends in a stream')
        self.degree_stream = data[at:at + degrees]
        self.repair_stream = data[at + degrees:at + degrees + repairs]
        self.valence_stream = data[at + degrees + repairs:]


# B.1 Result

class Mesh:
    def __init__(self):
        self.degrees, self.umbrellas, self.twins = [], [], []
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


# B.5 The walk

class Gap:
    def __init__(self, umbrella=None, valence=0, free=0):
        self.umbrella, self.valence, self.free = umbrella, valence, free
        self.next = self.prev = self.behind = None
        self.degree_behind = 0


class Walk:
    def __init__(self, section, trace=None):
        self.section, self.trace = section, trace or (lambda *_: None)
        self.mesh = Mesh()
        self.on_boundary = set()
        self.gaps, self.released = [], []
        self.lists = [[] for _ in range(64)]
        self.queued = set()
        self.symbols = Symbols(section, self)
        self.split_read = False

    def run(self):
        while self.symbols.component():
            self.seed()
            while (start := self.first()) is not None:
                self.attach(start)
        require(not (self.split_read and self.repeats_umbrella()), 'a face visits an umbrella twice')
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
        self.begin_face(None, 0, False)
        require(not self.dummy, 'a seed is a dummy')
        self.touched, self.current, self.missing = [], None, self.degree
        while self.missing > 0:
            valence = self.symbols.vertex()
            require(valence, 'a split in a seed')
            self.add_vertex(valence)
        self.link(self.touched[0], self.current, self.last_corner())
        self.requeue()

    def attach(self, start):
        gaps = self.gaps
        self.touched, ahead, behind = [], [], []
        self.known, self.valence_sum = 0, 0
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
        self.begin_face(start, edges, closed)
        for g in [start] + ahead:
            self.emit(g)
            self.pair(g)
        if not closed:
            self.touched.append(tail)
            self.emit(tail)
            self.current, self.missing = tail, self.degree - edges - 1
            while self.missing > 0:
                valence = self.symbols.vertex()
                if valence:
                    self.add_vertex(valence)
                else:
                    self.split()
            require(gaps[self.current].free > 0, 'a vertex without a free slot')
            corner = self.last_corner()
            for g in reversed(behind):
                self.emit(g)
                self.pair(g)
            self.link(head, self.current, corner)
            self.touched.append(head)
        if closed or start != head:
            self.release(start)
        for g in ahead:
            self.release(g)
        for g in behind:
            if g != head:
                self.release(g)
        self.requeue()

    def begin_face(self, start, edges, closed):
        if start is None:
            self.known, self.valence_sum = 0, 0
        self.degree, self.dummy = self.symbols.face(start, edges, closed)
        self.trace('face', start, edges, closed, self.degree, self.dummy)
        require(self.degree >= 3 and self.degree >= edges, 'a degree is too small')
        require(start is None or closed == (self.degree == edges), 'a degree contradicts the boundary')
        if not self.dummy:
            self.mesh.degrees.append(self.degree)

    def add_vertex(self, valence):
        g = self.new_gap(Gap(self.mesh.umbrella_count, valence, valence - 1))
        self.mesh.umbrella_count += 1
        if self.current is not None:
            self.link(g, self.current, self.last_corner())
        self.become(g)
        self.know(g)

    def split(self):
        self.split_read = True
        g, after = self.symbols.split()
        self.trace('split', g, after)
        gap = self.gaps[g]
        require(g in self.queued, 'a split into a gap in use')
        self.leave(g)
        half = Gap(gap.umbrella, gap.valence, gap.free - 1 - after)
        half.next, half.prev, half.behind, half.degree_behind = gap.next, gap.prev, gap.behind, gap.degree_behind
        b = self.new_gap(half)
        self.gaps[half.prev].next = b
        gap.free = after
        self.link(b, self.current, self.last_corner())
        self.touched.append(b)
        self.become(g)
        self.know(g)
        while self.gaps[self.current].free == 0:
            require(self.missing > 0, 'a face ends too early')
            n = self.gaps[self.current].next
            self.take(n)
            self.pair(self.current)
            self.release(self.current)
            self.become(n)

    def become(self, g):
        self.current = g
        self.touched.append(g)
        self.emit(g)
        self.missing -= 1

    def know(self, g):
        self.known += 1
        self.valence_sum += self.gaps[g].valence

    def take(self, g):
        require(g in self.queued, 'a gap is used twice')
        self.leave(g)
        self.gaps[g].free -= 1
        self.know(g)

    def link(self, g, current, corner):
        gap = self.gaps[g]
        gap.next, self.gaps[current].prev = current, g
        gap.behind = None if self.dummy else corner
        gap.degree_behind = 0 if self.dummy else self.degree

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
        for g in self.touched:
            if self.gaps[g].free != 0 and g not in self.queued:
                self.join(g)

    def repeats_umbrella(self):
        corner = 0
        for degree in self.mesh.degrees:
            face = self.mesh.umbrellas[corner:corner + degree]
            if len(set(face)) != degree:
                return True
            corner += degree
        return False


# B.6 Symbols

def compared(value, regular):
    return (value > regular) - (value < regular)


class Symbols:
    def __init__(self, section, walk):
        self.section, self.walk = section, walk
        self.degrees = RangeDecoder(section.degree_stream)
        self.valences = RangeDecoder(section.valence_stream)
        self.component_model = Bit()
        self.dummy = [Bit() for _ in range(7)]
        self.degree = [Symbol() for _ in range(7)]
        self.valence = [Symbol() for _ in range(8)]
        self.dummy_degree, self.large_degree, self.large_valence = Number(), Number(), Number()

    def component(self):
        return self.component_model.read(self.valences)

    def face(self, start, edges, closed):
        context = self.face_context(start)
        degree = edges if closed else self.section.uniform_degree
        if degree:
            dummy = not self.section.closed and start is not None and self.dummy[context].read(self.degrees)
            if dummy and not closed:
                degree = 3 + self.dummy_degree.read(self.degrees)
            return degree, bool(dummy)
        symbol = self.degree[context].read(self.degrees)
        require(symbol != 0, 'a face without a degree')
        if symbol == 1:
            return 16 + self.large_degree.read(self.degrees), False
        if symbol == 2:
            return 3 + self.dummy_degree.read(self.degrees), True
        return symbol, False

    def face_context(self, start):
        if start is None:
            return 0
        gaps = self.walk.gaps
        behind = gaps[start].degree_behind
        if behind not in (3, 4):
            return 0
        valences = gaps[start].valence + gaps[gaps[start].next].valence
        return (2 if behind == 3 else 5) + compared(valences, 12 if behind == 3 else 8)

    def vertex(self):
        walk = self.walk
        degree = 0 if walk.dummy else walk.degree
        context = 0
        if degree == 5:
            context = 1
        elif degree == 3:
            context = 3 + compared(walk.valence_sum, 6 * walk.known)
        elif degree == 4:
            context = 6 + compared(walk.valence_sum, 4 * walk.known)
        symbol = self.valence[context].read(self.valences)
        walk.trace('vertex', context, symbol)
        return 16 + self.large_valence.read(self.valences) if symbol == 1 else symbol

    def split(self):
        g = self.valences.uniform(len(self.walk.gaps))
        least = 1 if self.walk.missing == 1 else 0
        free = self.walk.gaps[g].free
        require(free >= 2 + least, 'a split where there is no room')
        return g, least + self.valences.uniform(free - 1 - least)


# B.7 Repairs

def repair(stream, mesh, on_boundary):
    count = Number()
    walk_umbrellas = mesh.umbrella_count
    if stream.bit(32768):
        read_flips(stream, mesh)
    for _ in range(count.read(stream)):
        degree = stream.uniform(3)
        mesh.degrees.append(degree)
        mesh.flipped.append(0)
        for _ in range(degree):
            mesh.umbrellas.append(mesh.umbrella_count)
            mesh.twins.append(None)
            mesh.umbrella_count += 1
    mesh.vertices, mesh.vertex_count = list(range(mesh.umbrella_count)), mesh.umbrella_count
    if stream.bit(32768):
        read_vertices(stream, mesh, on_boundary, walk_umbrellas)
    mesh.vertex_count += count.read(stream)


def read_flips(stream, mesh):
    flip = [Bit() for _ in range(3)]
    face_of, corner = {}, 0
    for face, degree in enumerate(mesh.degrees):
        twin = mesh.twins[corner]
        context = mesh.flipped[face_of[twin]] if twin is not None and twin < corner else 2
        mesh.flipped[face] = flip[context].read(stream)
        for c in range(corner, corner + degree):
            face_of[c] = face
        corner += degree


def read_vertices(stream, mesh, on_boundary, walk_umbrellas):
    join = [[Bit(), Bit()] for _ in range(3)]
    backwards, distance = [Bit(), Bit()], [Number(), Number()]
    known = expected = before = 0
    for u in range(mesh.umbrella_count):
        kind = 2 if u >= walk_umbrellas else int(u in on_boundary)
        joined = join[kind][before].read(stream) if known > 0 else 0
        if joined:
            if backwards[before].read(stream):
                vertex = expected - 1 - distance[before].read(stream)
            else:
                vertex = expected + distance[before].read(stream)
            require(0 <= vertex < known, 'an umbrella of a vertex to come')
            mesh.vertices[u] = vertex
            expected = vertex + 1
        else:
            mesh.vertices[u] = known
            known += 1
        before = joined
    mesh.vertex_count = known


def decode(data, trace=None):
    section = Section(data)
    walk = Walk(section, trace)
    mesh = walk.run()
    mesh.flipped = [0] * len(mesh.degrees)
    repairs = RangeDecoder(section.repair_stream)
    if section.repairs:
        repair(repairs, mesh, walk.on_boundary)
    else:
        mesh.vertices, mesh.vertex_count = list(range(mesh.umbrella_count)), mesh.umbrella_count
    for stream in (walk.symbols.valences, walk.symbols.degrees, repairs):
        stream.finish()
    return mesh


def described(mesh):
    """The text that vectors.cpp writes about a mesh."""
    lines = [f'vertices {mesh.vertex_count}']
    lines += ['face' + ''.join(f' {vertex}' for vertex in face) for face in mesh.polygons()]
    lines.append('twins' + ''.join(f' {-1 if twin is None else twin}' for twin in mesh.twins))
    return '\n'.join(lines) + '\n'


def example_bytes(document):
    """The worked example of the document: the hexadecimal bytes behind its marker."""
    return bytes.fromhex(re.search(r'The section of the cube:\s*```\n([0-9a-f\s]*)```', document).group(1))


def main(folder):
    sections = sorted(Path(folder).glob('*.section'))
    wrong = [path.stem for path in sections
             if described(decode(path.read_bytes())) != path.with_suffix('.mesh').read_text()]
    print(f'{len(sections) - len(wrong)} of {len(sections)} sections decode to the same mesh')
    document = Path(__file__).resolve().parents[2] / 'EXTENSION_SPEC.md'
    if example_bytes(document.read_text()) != (Path(folder) / 'cube.section').read_bytes():
        wrong.append('the worked example of EXTENSION_SPEC.md')
    for name in wrong:
        print(f'WRONG: {name}', file=sys.stderr)
    return 1 if wrong or not sections else 0


if __name__ == '__main__':
    sys.exit(main(sys.argv[1]))
