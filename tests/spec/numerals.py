"""A second decoder of lossless floats, written from EXTENSION_SPEC.md, D.5, alone and laid out like it.

decode(mesh, sites, site_count, relation, systems, data) -> the floats' bits, one per component and site.
"""
import struct
from math import isqrt

from models import clamp, require
from value_models import Chances, ErrorScale, Habit, ValueStream, bit_length
from value_sites import Graph
from value_surroundings import Surroundings

NONE, UNIT_VECTOR, UNIT_SUM = range(3)
LARGEST_ERROR = 2**24


# Systems

class System:
    def __init__(self, radix, digits, least, top):
        self.radix, self.digits, self.least, self.top = radix, digits, least, top
        self.all = 27 if radix == 2 else 8
        self.spare = self.all - digits
        self.limit = radix**self.all - 1

    def digits_of(self, number):
        count = 0
        while number >= self.radix**count:
            count += 1
        return count

    def bits_of(self, n, x):
        if self.radix == 2:
            value = n * 2.0**x
        else:
            value = float(n) / float(10**-x) if x < 0 else float(n) * float(10**x)
        return struct.unpack('>I', struct.pack('>f', value))[0]

    def units(self, n, x):
        up = x - self.top + self.spare
        return n * self.radix**up if up >= 0 else n // self.radix**-up


# Prediction

class NumeralSurroundings(Surroundings):
    def scaled(self, members, at, to, origin, factor):
        v = self.coder.values
        members.append([clamp(v[at][i] + ((v[to][i] - v[origin][i]) * factor >> 12), -2**28, 2**28) for i in range(self.m)])

    def around(self):
        graph, fans, ended = self.coder.graph, [], True
        for corner, ends in graph.around[self.site]:
            if ended:
                fans.append([])
            fans[-1].append(corner)
            ended = ends
        beside = []
        for fan in fans:
            beyond = graph.twin[graph.prev[fan[-1]]]
            beside += [graph.prev[c] for c in (fan if beyond in (None, fan[0]) else fan[:-1])]
            beside += [graph.next[fan[0]]] * (beyond != fan[0])
        known = [self.coder.values[graph.site[c]] for c in beside if self.coder.known(graph.site[c])]
        return self.average(known[:4])


# Differences

def priors():
    w, result = 77936, []
    for _ in range(19):
        z, last, above = (w - 65536) * 3 >> 9, 32768, []
        for i in range(15):
            g = (z << 16) // (z + 2**(8 + i) - 128)
            t = ((g * g >> 16) * g >> 16) * 32112 // 65536 + 656
            last = max(min(t, last - 3), 3 * (15 - i))
            above.append(last)
        result.append(above)
        w = w * 92682 >> 16
    return result


PRIORS = priors()
EVEN = [2048 * (15 - i) for i in range(15)]


def small_prior(length):
    return [max(2**(15 - length) * (2**length - 1 - i), 3 * (15 - i)) for i in range(15)]


class NumeralHabit(Habit):
    def __init__(self, prior, rate=14000):
        super().__init__(prior, 1300)
        self.rate = rate

    def read(self, stream):
        symbol = stream.symbol(self.above)
        self.learn(symbol)
        return symbol


class Differences:
    def __init__(self, stream):
        self.stream, self.first, self.second, self.far, self.rest, self.small = stream, {}, {}, {}, {}, {}

    def read(self, solved, k, several, size, apart, close):
        """None: there is none."""
        cell, below = min(size // 2, 18), max(size // 4 - 9, 0)
        first = self.first.setdefault((k, several, cell), NumeralHabit(PRIORS[cell]))
        second = self.second.setdefault((apart, close, cell), NumeralHabit(PRIORS[cell]))
        symbol = self.stream.symbol([a + b + 1 >> 1 for a, b in zip(first.above, second.above)])
        first.learn(symbol)
        second.learn(symbol)
        length = below + symbol if symbol else 0
        if symbol == 15:
            four = self.far.setdefault(k, NumeralHabit(EVEN, 5461)).read(self.stream)
            if four >= 14:
                return None
            length = 4 * four + self.rest.setdefault(four, NumeralHabit(EVEN, 5461)).read(self.stream) % 4
        if length == 0:
            return 0
        first_digit = 2**(length - 1)
        if solved and length <= 3:
            y = self.small.setdefault(length, NumeralHabit(small_prior(length))).read(self.stream)
            magnitude = first_digit + y % first_digit
            return -magnitude if y // first_digit % 2 else magnitude
        high = self.stream.plain(length - 24) if length > 24 else 0
        y = high << 24 | self.stream.plain(min(length, 24))
        return -(first_digit + y // 2) if y % 2 else first_digit + y // 2


# Components

NINTHS = [3640 * (8 - i) + 7 if i < 8 else 15 - i for i in range(15)]


def quarter_log(y):
    h = bit_length(y) - 1
    return 4 * h + (y >> h - 2 & 3)


class Coder(ErrorScale):
    kind, one, far_limit, beside = 0, 1, 0, True

    def __init__(self, graph, relation, systems, stream):
        self.graph, self.relation, self.systems, self.stream = graph, relation, systems, stream
        self.m, self.coded, self.values, self.errors = len(systems), 0, {}, {}
        self.last, self.typical = [0] * self.m, 2**20
        self.deviation = 16 * systems[0].radix**systems[0].spare
        self.differences, self.zero, self.minus, self.digit = Differences(stream), Chances(), Chances(), Chances()

    def known(self, site):
        return site < self.coded

    def run(self):
        bits = []
        while self.coded < self.graph.site_count:
            bits += self.site(self.coded)
            self.coded += 1
        return bits

    def site(self, site):
        around = NumeralSurroundings(self, site)
        self.scale(around)
        order, solved = self.order(around.base)
        value, errors, bits = [0] * self.m, [0] * self.m, [0] * self.m
        weighed = self.all + self.near[order[0]]
        for rank, i in enumerate(order):
            value[i], bits[i] = self.component(i, rank == solved, around, [value[k] for k in order[:rank]], weighed)
            errors[i] = min(abs(value[i] - around.base[i]), LARGEST_ERROR)
            weighed = (weighed >> 1) + errors[i] if rank else 2 * errors[i]
        self.values[site], self.errors[site], self.last = value, errors, value
        self.adapt_scale(errors)
        return bits

    def order(self, base):
        order = list(range(self.m))
        if self.relation == NONE:
            return order, None
        solved = 2 if self.relation == UNIT_VECTOR else self.m - 1
        largest = max(range(solved + 1), key=lambda i: (abs(base[i]), -i))
        order[largest], order[solved] = order[solved], order[largest]
        return order, solved

    def solve(self, i, base, others):
        system = self.systems[0]
        one = system.radix**(system.spare - system.top)
        if self.relation == UNIT_SUM:
            return one - sum(others)
        root = isqrt(max(0, one * one - sum(x * x for x in others)))
        return -root if base[i] < 0 else root

    def component(self, i, solved, around, others, weighed):
        system, several = self.systems[i], len(around.members) > 1
        limit, spread = system.limit, min(around.spread[i], LARGEST_ERROR)
        if solved:
            prediction, estimate = clamp(self.solve(i, around.base, others), -limit, limit), self.deviation // 16
        else:
            prediction = around.base[i]
            estimate = self.all + self.near[i] + weighed
            estimate = estimate + 4 * spread >> 3 if several else estimate >> 2
        estimate = min(estimate, limit)
        extent = min(abs(prediction) + estimate, limit)
        finer = clamp(system.all - system.digits_of(extent), 0, system.top - system.least)
        u, w = system.radix**max(system.spare - finer, 0), system.radix**max(finer - system.spare, 0)
        guess = (prediction + u // 2) // u * w

        def wide(size):
            return 8 * size * w + 4 * u

        size = quarter_log(wide(estimate)) - quarter_log(4 * u)
        octaves = bit_length(wide(estimate))
        apart = 5 if solved else clamp(bit_length(wide(spread)) - octaves + 5, 0, 7)
        close = clamp(bit_length(wide(self.near[i])) - octaves + 2, 0, 3)
        difference = self.differences.read(solved, 4 if solved else i, several, size, apart, close)
        if difference is None:
            value, bits = clamp(prediction, -limit, limit), self.plain()
        elif guess + difference == 0:
            value, bits = 0, self.nothing(i)
        else:
            value, bits = self.number(i, system, system.top - finer, guess + difference)
        if solved:
            now = min(16 * min(abs(value - prediction), LARGEST_ERROR), 4 * self.deviation)
            self.deviation = max(1, self.deviation + (now - self.deviation >> 5))
        return value, bits

    def plain(self):
        high = self.stream.plain(16)
        return high << 16 | self.stream.plain(16)

    def nothing(self, i):
        if self.zero[i].read(self.stream):
            return 0
        return 2**31 if self.minus[i].read(self.stream) else self.plain()

    def number(self, i, system, x, number):
        n = abs(number)
        require(n < 2**44, 'a number that is too large')
        extra = system.digits_of(n) - system.digits
        if extra > 0:
            require(n % system.radix**extra == 0 and x + extra <= system.top, 'a number with too many digits')
            n, x = n // system.radix**extra, x + extra
        zeros = 1
        for at in range(min(-extra, x - system.least)):
            digit = 0
            if not self.digit[i, at, zeros].read(self.stream):
                digit, zeros = 1 if system.radix == 2 else 1 + self.stream.symbol(NINTHS) % 9, 0
            n, x = n * system.radix + digit, x - 1
        value, bits = system.units(n, x), system.bits_of(n, x)
        return (-value, bits | 2**31) if number < 0 else (value, bits)


def decode(mesh, sites, site_count, relation, systems, data):
    stream = ValueStream(data, 0)
    bits = Coder(Graph(mesh, sites, site_count), relation, [System(*s) for s in systems], stream).run()
    stream.finish()
    return bits
