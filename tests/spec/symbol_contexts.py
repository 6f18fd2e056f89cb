"""What the mixed profiles see of the mesh, and the contexts that they make of it: EXTENSION_SPEC.md, B.8."""
from models import clamp


def packed(*fields):
    key = shift = 0
    for value, bits in fields:
        key |= value << shift
        shift += bits
    return key


def sides(angle):
    return min(30, 4096 // (1024 - clamp(angle >> 6, 0, 1023)))


def quotient(a, b):
    return a // b if a >= 0 else 0  # what is negative counts as 0 anyway


class VertexFeatures:
    def __init__(self, walk, usual, valences, degrees):
        gap = lambda number: walk.no_gap if number is None else walk.gaps[number]
        head, current, edge = gap(walk.head), gap(walk.current), gap(walk.before_tail)
        after, before = gap(current.next), gap(head.prev)
        regular = 6 if walk.degree == 3 else 4
        valence, slots = (lambda g: min(g.valence, 14)), (lambda g: g.free % 8)
        self.face = 1 if walk.dummy else min(walk.degree, 15)
        self.missing, self.usual = min(walk.missing, 7), usual
        self.h, self.c, self.b, self.a = valence(head), valence(current), valence(before), valence(after)
        self.hs, self.cs, self.bs, self.as_ = slots(head), slots(current), slots(before), slots(after)
        self.hx, self.cx = head.excess(regular), current.excess(regular)
        self.o = edge.opposite_next if walk.index == 0 and walk.before_tail is not None else 15
        self.oh = head.opposite_own if walk.missing == 1 and walk.head is not None else 15
        self.p = sides(quotient(131072 - walk.angle, walk.missing))
        self.da = current.degree_behind % 16
        self.ca, self.hb = (self.a if self.cs == 1 else 0), (self.b if self.hs == 1 else 0)
        self.valences, self.degrees = valences, degrees


VERTEX = {
    'predicted': lambda f: packed((f.p, 5)),
    'head ring': lambda f: packed((f.h, 4), (f.hx, 4), (f.hs, 3)),
    'nothing': lambda f: 0,
    'ends': lambda f: packed((f.h, 4), (f.c, 4), (f.ca, 4), (f.hb, 4), (f.o, 4)),
    'slots': lambda f: packed((f.hs, 3), (f.cs, 3), (f.as_, 3), (f.bs, 3)),
    'history': lambda f: packed(*((v, 8) for v in f.valences)),
    'sums': lambda f: packed((f.h + f.c, 5), (f.o, 4), (f.oh, 4), (f.hx + f.cx, 5)),
    'predicted sums': lambda f: packed((f.p, 5), (f.hx + f.cx, 5), (f.oh if f.missing == 1 else f.o, 4)),
    'beyond': lambda f: packed((f.a, 4), (f.b, 4), (int(f.cs == 1), 1), (int(f.hs == 1), 1)),
    'current ring': lambda f: packed((f.c, 4), (f.cx, 4), (f.cs, 3)),
    'degrees': lambda f: packed(*((d, 8) for d in f.degrees), (f.valences[0], 8)),
    'ends and slots': lambda f: packed((f.h, 4), (f.c, 4), (f.ca, 4), (f.hb, 4), (f.hs, 3), (f.cs, 3)),
    'degree after': lambda f: packed((f.c, 4), (f.cs, 3), (f.da, 4)),
    'sums and slots': lambda f: packed((f.h + f.c, 5), (f.o, 4), (f.hx // 3, 3), (f.cx // 3, 3), (f.hs, 3), (f.cs, 3)),
    'predicted slots': lambda f: packed((f.p, 5), (f.hs, 3), (f.cs, 3)),
}


class FaceFeatures:
    def __init__(self, walk, start, edges, head, tail, valences, degrees):
        gap = lambda number: walk.no_gap if number is None else walk.gaps[number]
        near, far = gap(start), gap(gap(start).next)
        head, tail = gap(head), gap(tail)
        before = gap(head.prev)
        valence, slots, degree = (lambda g: min(g.valence, 14)), (lambda g: g.free % 8), (
            lambda g: g.degree_behind % 16)
        self.known, self.least = edges % 16, min(max(3, edges + 1), 9)
        self.n, self.f, self.h, self.t = valence(near), valence(far), valence(head), valence(tail)
        self.ns, self.hs, self.ts = slots(near), slots(head), slots(tail)
        self.behind, self.bt, self.bh = degree(near), degree(tail), degree(before)
        self.pn, self.pf = self.predicted(near), self.predicted(far)
        self.dummies = near.dummy | far.dummy << 1 | head.dummy << 2 | tail.dummy << 3
        self.x = (head.excess(4) + tail.excess(4)) // 2
        self.valences, self.degrees = valences, degrees

    @staticmethod
    def predicted(gap):
        return sides(quotient(131072 - gap.angle, gap.free + 1))


FACE = {
    'ends': lambda f: packed((f.h, 4), (f.t, 4), (f.known, 4)),
    'near angle': lambda f: packed((f.pn, 5), (min(f.ns, 2), 2), (f.behind, 4)),
    'history': lambda f: packed((f.degrees[0], 8), (f.degrees[1], 8)),
    'around': lambda f: packed((f.h, 4), (f.t, 4), (f.hs, 3), (f.ts, 3), (f.behind, 4), (f.bh, 4), (f.known, 4)),
    'edge': lambda f: packed((f.behind, 4), (f.n, 4), (f.f, 4)),
    'least': lambda f: packed((f.least, 4), (f.dummies, 4)),
    'angles': lambda f: packed((f.pn, 5), (f.pf, 5), (f.known, 4), (f.least, 4)),
    'degrees': lambda f: packed((f.behind, 4), (f.bh, 4), (f.bt, 4)),
    'behind': lambda f: packed((f.behind, 4)),
    'sums': lambda f: packed((f.x, 4), (f.known, 4), (f.behind, 4), (f.least, 4)),
    'slots': lambda f: packed((f.known, 4), (f.hs, 3), (f.ts, 3), (f.behind, 4)),
    'both': lambda f: packed(*(pair for d, v in zip(f.degrees, f.valences) for pair in ((min(d, 127), 7), (min(v, 127), 7)))),
    'edge and degrees': lambda f: packed((f.n, 4), (f.f, 4), (f.known, 4), (f.behind, 4), (f.bt, 4)),
    'dummies': lambda f: packed((f.dummies, 4), (f.behind, 4), (f.bh, 4), (f.bt, 4)),
    'nothing': lambda f: 0,
}

DEFAULT_VERTEX = ['predicted', 'head ring', 'nothing', 'ends', 'slots', 'history', 'sums']
PROFILES = {
    1: (['predicted'], ['ends'], False),
    2: (DEFAULT_VERTEX, ['ends', 'near angle', 'edge'], False),
    3: (DEFAULT_VERTEX + ['predicted sums', 'beyond', 'current ring', 'degrees', 'ends and slots', 'degree after',
                          'sums and slots', 'predicted slots'],
        ['ends', 'near angle', 'history', 'around', 'edge', 'least', 'angles', 'degrees', 'behind', 'sums', 'slots', 'both',
         'edge and degrees', 'dummies', 'nothing'], True),
}

# What the tables of valences and degrees have besides the section's table bits.
TABLE_BITS = {1: (0, 0), 2: (2, 0), 3: (3, 1)}
