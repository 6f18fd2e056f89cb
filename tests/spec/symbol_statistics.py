"""How degrees and valences are read, by profile: EXTENSION_SPEC.md, B.6 (paper) and B.8 (fast, default, small)."""
from models import Bit, Match, Mixer, Number, Symbol
from symbol_contexts import FACE, PROFILES, TABLE_BITS, VERTEX, FaceFeatures, VertexFeatures


def compared(value, regular):
    return (value > regular) - (value < regular)


class Paper:
    def __init__(self, section):
        self.section = section
        self.dummy = [Bit() for _ in range(7)]
        self.degree = [Symbol() for _ in range(7)]
        self.valence = [Symbol() for _ in range(8)]
        self.dummy_degree, self.large_degree, self.large_valence = Number(), Number(), Number()

    def face(self, stream, walk, start, edges, closed):
        context = self.face_context(walk.gaps, start)
        degree = edges if closed else self.section.uniform_degree
        if degree:
            dummy = self.section.dummy_faces and start is not None and self.dummy[context].read(stream)
            if dummy and not closed:
                degree = 3 + self.dummy_degree.read(stream)
            return degree, bool(dummy)
        symbol = self.degree[context].read(stream)
        if symbol == 1:
            return 16 + self.large_degree.read(stream), False
        if symbol == 2:
            return 3 + self.dummy_degree.read(stream), True
        return symbol, False

    @staticmethod
    def face_context(gaps, start):
        if start is None:
            return 0
        behind = gaps[start].degree_behind
        if behind not in (3, 4):
            return 0
        valences = gaps[start].valence + gaps[gaps[start].next].valence
        return (2 if behind == 3 else 5) + compared(valences, 12 if behind == 3 else 8)

    def vertex(self, stream, walk):
        degree = 0 if walk.dummy else walk.degree
        context = 0
        if degree == 5:
            context = 1
        elif degree == 3:
            context = 3 + compared(walk.valence_sum, 6 * walk.known)
        elif degree == 4:
            context = 6 + compared(walk.valence_sum, 4 * walk.known)
        symbol = self.valence[context].read(stream)
        return 16 + self.large_valence.read(stream) if symbol == 1 else symbol


class Mixed:
    def __init__(self, section):
        self.section = section
        self.vertex_contexts, self.face_contexts, rich = PROFILES[section.profile]
        more_vertex_bits, more_face_bits = TABLE_BITS[section.profile]
        self.vertices = Mixer(len(self.vertex_contexts), rich, section.table_bits + more_vertex_bits)
        self.faces = Mixer(len(self.face_contexts), rich, section.table_bits + more_face_bits)
        self.rich, self.runs, self.plain_runs, self.sure = rich, {}, [0] * 16, 31 if rich else 15
        self.match = Match(section.match)
        self.valences, self.degrees = [0, 0, 0], [0, 0, 0]
        self.counts = [[0] * 16 for _ in range(16)]
        self.usual = [6 if i == 3 else 4 for i in range(16)]
        self.degree_counts, self.usual_degree = [0] * 16, 4
        self.dummy_degree, self.large_degree, self.large_valence = Number(), Number(), Number()

    def run_place(self, key):
        return key * 0x9E3779B97F4A7C15 % 2**64 >> (64 - self.section.table_bits)

    def decide(self, stream, mixer, node, situation, answer):
        """`answer` maps the expected symbol to the bit that it means, or to None."""
        expected = None if self.contradicted else self.match.expected()
        told = None if expected is None else answer(expected)
        opinion = None if told is None else self.match.opinion(told)
        bit = mixer.read(stream, node, situation, opinion, self.match.length_class() if opinion else 0)
        if told is not None and bit != told:
            self.contradicted = True
        return bit

    def face(self, stream, walk, start, edges, closed):
        self.contradicted, self.plainly = False, False
        degree, dummy = self.read_face(stream, walk, start, edges, closed)
        if not self.section.degrees_known:
            symbol = 1 if dummy else degree
            self.degrees = [symbol % 256] + self.degrees[:2]
            if not self.plainly:
                self.match.add(128 + min(symbol, 100))
        return degree, dummy

    def read_face(self, stream, walk, start, edges, closed):
        degree = edges if closed else self.section.uniform_degree
        gaps = walk.gaps
        may_be_dummy = self.section.dummy_faces and start is not None and not any(
            gaps[g].dummy for g in (start, gaps[start].next, walk.face_head, walk.face_tail))
        if degree and not may_be_dummy:
            return degree, False
        least, usual = max(self.section.least_degree, edges + 1), self.usual_degree
        if not degree and usual < least:
            return self.read_unknown(stream, walk, start, edges, closed, degree, least, may_be_dummy, False)
        expected = degree or usual
        place = self.plain_place(walk, start, edges, expected, may_be_dummy)
        run, matched = self.plain_runs[place], self.match.expected()
        sure = run >= (127 if self.rich else 63) and (matched is None or matched < 128 or matched == 128 + expected)
        if sure and stream.bit(65536 - 65536 // (run + 2)):
            self.plainly = True
            answer = (expected if degree else self.counted_degree(expected)), False
        else:
            answer = self.read_unknown(stream, walk, start, edges, closed, degree, least, may_be_dummy, sure)
        self.plain_runs[place] = min(run + 1, 16383) if answer == (expected, False) else run // 4
        return answer

    @staticmethod
    def plain_place(walk, start, edges, expected, may_be_dummy):
        if start is None:
            return 0
        gaps = walk.gaps
        beside = (start, walk.face_tail, gaps[walk.face_head].prev)
        return 8 * (edges > 1) + 2 * sum(gaps[g].degree_behind == expected for g in beside) + may_be_dummy

    def read_unknown(self, stream, walk, start, edges, closed, degree, least, may_be_dummy, not_plain):
        f = FaceFeatures(walk, start, edges, walk.face_head, walk.face_tail, self.valences, self.degrees)
        usual = 0 if self.rich else self.usual_degree
        self.faces.enter([FACE[name](f) | min(usual, 15) << 44 for name in self.face_contexts])
        situation = f.behind * 3 + min(f.known, 3) - (f.known > 0)

        def decide(node, step, told):
            return self.decide(stream, self.faces, node, situation + 64 * step,
                               lambda s: int(told(s - 128)) if s >= 128 else None)

        if not degree and usual >= least and not not_plain and decide(0, 0, lambda x: x == usual):
            return self.counted_degree(usual), False
        if (not_plain and degree) or (may_be_dummy and decide(1, 1, lambda x: x == 1)):
            return (degree if closed else 3 + self.dummy_degree.read(stream)), True
        if degree:
            return degree, False
        return self.counted_degree(self.read_unusual_degree(stream, usual, least, decide)), False

    def read_unusual_degree(self, stream, usual, least, decide):
        if usual > least and decide(2, 2, lambda x: x < usual):
            for degree in range(usual - 1, least, -1):
                if decide(min(2 + usual - degree, 6), 3, lambda x: x == degree):
                    return degree
            return least
        first = max(usual + 1, least)
        for degree in range(first, first + 20):
            if decide(min(6 + degree - usual, 15), 4, lambda x: x == degree):
                return degree
        return first + 20 + self.large_degree.read(stream)

    def counted_degree(self, degree):
        if 3 <= degree <= 15:
            self.degree_counts[degree] += 1
            if self.degree_counts[degree] > self.degree_counts[self.usual_degree]:
                self.usual_degree = degree
        return degree

    def vertex(self, stream, walk):
        face = 1 if walk.dummy else min(walk.degree, 15)
        usual = self.usual[face]
        f = VertexFeatures(walk, usual, self.valences, self.degrees)
        shared = (f.face | f.missing << 4 | f.usual << 7) << 44
        self.vertices.enter([VERTEX[name](f) | shared for name in self.vertex_contexts])
        self.contradicted = False
        place = self.run_place(VERTEX['sums'](f) | shared) if len(self.vertex_contexts) > 1 else None
        situation = face * 4 + (walk.missing > 1) * 2 + (walk.index > 0)
        valence = self.read_valence(stream, usual, situation, walk.head is None, place)
        self.count(face, valence)
        self.valences = [valence % 256] + self.valences[:2]
        if not self.surely:
            self.match.add(min(valence, 100))
        return valence

    def read_first(self, stream, usual, decide, place):
        """Is it the usual valence? Where it was so often enough in a row, that is nearly certain."""
        self.surely = False
        if place is None:
            return decide(0, 0, lambda s: s == usual)
        run = self.runs.get(place, 0)
        if run >= self.sure:
            answer = stream.bit(65536 - 65536 // (run + 2))
            self.contradicted = not answer and self.match.expected() == usual
            self.surely = answer and self.sure == 15
        else:
            answer = decide(0, 0, lambda s: s == usual)
        self.runs[place] = min(run + 1, 16383) if answer else run // 8
        return answer

    def read_valence(self, stream, usual, situation, seed, place):
        def decide(node, step, told):
            return self.decide(stream, self.vertices, node, situation + 64 * step,
                               lambda s: int(told(s)) if s < 128 else None)

        if self.read_first(stream, usual, decide, place):
            return usual
        if decide(1, 1, lambda s: s < usual):
            for v in range(usual - 1, 2, -1):
                if decide(min(1 + usual - v, 6), 2, lambda s: s == v):
                    return v
            return 2 if seed or decide(7, 3, lambda s: s == 2) else 0
        for v in range(usual + 1, usual + 25):
            if decide(min(7 + v - usual, 15), 4, lambda s: s == v):
                return v
        return usual + 25 + self.large_valence.read(stream)

    def count(self, face, valence):
        if 3 <= valence <= 15:
            counts = self.counts[face]
            counts[valence] += 1
            if counts[valence] > counts[self.usual[face]]:
                self.usual[face] = valence
