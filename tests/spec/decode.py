#!/usr/bin/env python3
"""A second decoder, written from EXTENSION_SPEC.md alone and laid out like it; here of the CONNECTIVITY section, Appendix B.

decode(section) -> Mesh. As a program: decode.py FOLDER checks every FOLDER/*.section against FOLDER/*.mesh, both made by
the encoder's tests (tests/spec/vectors.cpp), the worked example in EXTENSION_SPEC.md against FOLDER/cube.paper.section, and
the streams of attribute values in FOLDER/*.values (values.py) and of lossless floats in FOLDER/*.numerals (numerals.py),
and vertices, wedges and seams of FOLDER/*.payload (payload.py, seams.py).
"""
import re
import sys
from pathlib import Path

import numerals
import seams
import values
from models import Bit, Number, require
from payload import Payload
from walk import Mesh, Walk


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
        require(len(data) >= 2, 'the section ends in its head')
        flags, statistics, at = data[0], data[1], 2
        self.uniform_degree = flags & 15
        self.closed, self.newest_first, self.repairs, self.copies = (flags >> i & 1 for i in (4, 5, 6, 7))
        self.profile, self.match, self.dual = statistics & 3, statistics >> 2 & 1, statistics >> 6 & 1
        self.table_bits = 5 + (statistics >> 3 & 7)
        self.least_degree = 2 if self.dual else 3
        self.dummy_faces = not self.closed and not self.dual
        self.dummy_umbrellas = not self.closed and self.dual
        self.degrees_known = not self.dummy_faces and self.uniform_degree
        require(statistics < 128 and not 0 < self.uniform_degree < self.least_degree, 'flags')
        require(self.table_bits <= min(max(len(data).bit_length(), 7), 12), 'tables too large for the section')
        self.symbols = data[at:]


# B.9 Duals

def primal(dual, dummies):
    """The mesh whose dual was walked, and its umbrellas at the boundary."""
    face_of, following, preceding, corner = [], [], [], 0
    for face, degree in enumerate(dual.degrees):
        face_of += [face] * degree
        following += [corner + (i + 1) % degree for i in range(degree)]
        preceding += [corner + (i - 1) % degree for i in range(degree)]
        corner += degree
    start_of = {}
    for c, umbrella in enumerate(dual.umbrellas):
        start_of.setdefault(umbrella, c)
    mesh, number, corners, begin = Mesh(), {}, [], []
    for umbrella in range(dual.umbrella_count):
        require(umbrella in start_of, 'a face without corners')
        begin.append(len(corners))
        if umbrella in dummies:
            continue
        c, degree = start_of[umbrella], 0
        while c not in number:
            number[c] = len(corners)
            corners.append(c)
            mesh.umbrellas.append(face_of[c])
            degree += 1
            c = dual.twins[preceding[c]]
        require(degree >= 3, 'a face of degree below 3')
        mesh.degrees.append(degree)
    mesh.twins = [number.get(following[dual.twins[preceding[c]]]) for c in corners]
    first_of = [begin[u] for u in dual.umbrellas] + [len(corners)]
    mesh.copies = [(first_of[c], first_of[original], first_of[c + count] - first_of[c])
                   for c, original, count in dual.copies]
    mesh.umbrella_count = len(dual.degrees)
    on_boundary, real = set(), set(mesh.umbrellas)
    for c, umbrella in enumerate(dual.umbrellas):
        if umbrella in dummies:
            require(face_of[c] not in on_boundary and face_of[c] in real, 'dummy faces at an umbrella')
            on_boundary.add(face_of[c])
    return mesh, on_boundary


def repeats_umbrella(mesh):
    corner = 0
    for degree in mesh.degrees:
        face = mesh.umbrellas[corner:corner + degree]
        if len(set(face)) != degree:
            return True
        corner += degree
    return False


# B.10 Repairs

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
    flip, alike = [Bit() for _ in range(3)], stream.bit(32768)
    face_of, corner = {}, 0
    for face, degree in enumerate(mesh.degrees):
        twin = mesh.twins[corner]
        follows = twin is not None and twin < corner
        if alike and follows:
            mesh.flipped[face] = mesh.flipped[face - 1]
        else:
            mesh.flipped[face] = flip[mesh.flipped[face_of[twin]] if follows else 2].read(stream)
        for c in range(corner, corner + degree):
            face_of[c] = face
        corner += degree


def neighbours_of(mesh):
    """Per umbrella: the umbrellas at the far ends of its edges, in the order round it."""
    next_corner, prev_corner, first = {}, {}, 0
    for degree in mesh.degrees:
        for corner in range(first, first + degree):
            next_corner[corner] = first + (corner + 1 - first) % degree
            prev_corner[next_corner[corner]] = corner
        first += degree
    begin = {}
    for corner, umbrella in enumerate(mesh.umbrellas):
        if umbrella not in begin or mesh.twins[corner] is None:
            begin[umbrella] = corner
    neighbours = [[] for _ in range(mesh.umbrella_count)]
    for umbrella, first in begin.items():
        neighbours[umbrella].append(mesh.umbrellas[next_corner[first]])
        corner = first
        while corner is not None:
            before, corner = prev_corner[corner], mesh.twins[prev_corner[corner]]
            if corner == first:
                break
            neighbours[umbrella].append(mesh.umbrellas[before])
    return neighbours


def join_candidates(u, neighbours, vertices, umbrellas_of):
    """Vertices that umbrella u may belong to, with their votes, likeliest first; None for those of its neighbours."""
    near = [w for w in neighbours[u][:32] if w < u][:8]
    beside = list(dict.fromkeys(vertices[w] for w in near))
    votes = {}
    for w in near:
        for x in umbrellas_of[vertices[w]][:-4:-1]:
            for y in [y for y in neighbours[x][:32] if y < u][:12] if x != w else []:
                if vertices[y] not in beside and (vertices[y] in votes or len(votes) < 16):
                    votes[vertices[y]] = votes.get(vertices[y], 0) + 1
    own = [(v, None) for v in sorted(beside, key=lambda v: len(umbrellas_of[v]))] if len(neighbours[u]) == 2 else []
    return own + sorted(votes.items(), key=lambda candidate: (-candidate[1], len(umbrellas_of[candidate[0]])))


def read_vertices(stream, mesh, on_boundary, walk_umbrellas):
    join = [[[Bit() for _ in range(4)] for _ in range(2)] for _ in range(3)]
    hit = [[Bit() for _ in range(6)] for _ in range(4)]
    backwards, distance = [Bit() for _ in range(3)], [Number() for _ in range(3)]
    neighbours, umbrellas_of = neighbours_of(mesh), []
    expected = expected_start = before = 0
    for u in range(mesh.umbrella_count):
        starts = not any(w < u for w in neighbours[u][:32])
        kind = 2 if u >= walk_umbrellas else int(u in on_boundary)
        candidates = join_candidates(u, neighbours, mesh.vertices, umbrellas_of)
        evidence = (3 if len(neighbours[u]) == 2 else min(candidates[0][1], 2)) if candidates else 0
        joined = join[kind][before][evidence].read(stream) if umbrellas_of else 0
        if joined:
            for rank, (vertex, _) in enumerate(candidates[:6]):
                if hit[evidence][rank].read(stream):
                    break
            else:
                context, base = (2, expected_start) if starts else (before, expected)
                if backwards[context].read(stream):
                    vertex = base - 1 - distance[context].read(stream)
                else:
                    vertex = base + distance[context].read(stream)
            require(0 <= vertex < len(umbrellas_of), 'an umbrella of a vertex to come')
            mesh.vertices[u] = vertex
            expected = vertex + 1
            expected_start = vertex if starts else expected_start
        else:
            mesh.vertices[u] = len(umbrellas_of)
            umbrellas_of.append([])
        umbrellas_of[mesh.vertices[u]].append(u)
        before = joined
    mesh.vertex_count = len(umbrellas_of)


def decode(data, trace=None):
    section = Section(data)
    walk = Walk(section, trace)
    mesh, on_boundary = walk.run(), walk.on_boundary
    if section.dual:
        mesh, on_boundary = primal(mesh, walk.dummy_umbrellas)
    require(not (walk.split_read and repeats_umbrella(mesh)), 'a face visits an umbrella twice')
    mesh.flipped = [0] * len(mesh.degrees)
    if section.repairs:
        repair(walk.symbols.stream, mesh, on_boundary)
    else:
        mesh.vertices, mesh.vertex_count = list(range(mesh.umbrella_count)), mesh.umbrella_count
    walk.symbols.stream.finish()
    return mesh


def described(mesh):
    """The text that vectors.cpp writes about a mesh."""
    lines = [f'vertices {mesh.vertex_count}']
    lines += ['face' + ''.join(f' {vertex}' for vertex in face) for face in mesh.polygons()]
    lines.append('twins' + ''.join(f' {-1 if twin is None else twin}' for twin in mesh.twins))
    return '\n'.join(lines) + '\n'


def example_bytes(document):
    """The worked example of the document: the hexadecimal bytes behind its marker."""
    return bytes.fromhex(re.search(r'The section of the cube, in profile paper:\s*```\n([0-9a-f\s]*)```', document).group(1))


def read_values(mesh, sites, line):
    m, maximum, head, data, numbers, *places = line.split()
    places = [int(x) for x in places[0].split(',')] if places else []
    return values.decode(mesh, sites, mesh.vertex_count, int(m), int(maximum), int(head), bytes.fromhex(data), places), numbers


def read_numerals(mesh, sites, line):
    relation, systems, data, floats = line.split()
    systems = [[int(x) for x in system.split(',')] for system in systems.split(';')]
    return numerals.decode(mesh, sites, mesh.vertex_count, int(relation), systems, bytes.fromhex(data)), floats


def check_streams(path, read):
    """How many streams there are, one per line, and which of them decode to other numbers."""
    mesh = decode(path.with_suffix('.section').read_bytes())
    sites = [mesh.vertices[umbrella] for umbrella in mesh.umbrellas]
    lines = path.read_text().splitlines()
    read_all = ((k, *read(mesh, sites, line)) for k, line in enumerate(lines))
    return len(lines), [f'{path.name}, line {k + 1}' for k, found, numbers in read_all
                        if found != [int(x) for x in numbers.split(',')]]


def described_seams(data):
    """The text that vectors.cpp writes about a payload's seams."""
    payload = Payload(data)
    mesh = decode(payload.sections[0])
    require((mesh.vertex_count, len(mesh.degrees), len(mesh.umbrellas)) == (payload.points, payload.faces, payload.corners),
            'counts')
    vertices, wedges, attributes = seams.decode(mesh, payload.welded, payload.attributes, payload.sections[1])
    require((vertices[1], wedges[1]) == (payload.vertices, payload.wedges), 'counts')
    lines = [('counts', [payload.vertices, payload.points, payload.wedges]), ('vertices', vertices[0]), ('wedges', wedges[0])]
    for parted in attributes[1:]:
        lines.append(('seam', [c for c, twin in enumerate(mesh.twins) if twin is not None and {c, twin} & parted]))
    return ''.join(name + ''.join(f' {number}' for number in numbers) + '\n' for name, numbers in lines)


def main(folder):
    sections = sorted(Path(folder).glob('*.section'))
    wrong = [path.stem for path in sections
             if described(decode(path.read_bytes())) != path.with_suffix('.mesh').read_text()]
    print(f'{len(sections) - len(wrong)} of {len(sections)} sections decode to the same mesh')
    document = Path(__file__).resolve().parents[2] / 'EXTENSION_SPEC.md'
    if example_bytes(document.read_text()) != (Path(folder) / 'cube.paper.section').read_bytes():
        wrong.append('the worked example of EXTENSION_SPEC.md')
    streams = 0
    for suffix, read in (('values', read_values), ('numerals', read_numerals)):
        for path in sorted(Path(folder).glob('*.' + suffix)):
            count, bad = check_streams(path, read)
            streams += count
            wrong += bad
    print(f'{streams} streams of values and numerals read')
    payloads = sorted(Path(folder).glob('*.payload'))
    torn = [path.stem for path in payloads if described_seams(path.read_bytes()) != path.with_suffix('.seams').read_text()]
    print(f'{len(payloads) - len(torn)} of {len(payloads)} payloads have the same vertices, wedges and seams')
    wrong += torn
    for name in wrong:
        print(f'WRONG: {name}', file=sys.stderr)
    return 1 if wrong or not sections or not streams or not payloads else 0


if __name__ == '__main__':
    sys.exit(main(sys.argv[1]))
