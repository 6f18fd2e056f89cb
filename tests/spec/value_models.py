"""Streams and statistics of values: EXTENSION_SPEC.md, D.4.4, D.4.5 and D.4.8."""
import math

from models import Slot, clamp, require, squashed

FAST, DEFAULT, SMALL = range(3)  # profiles


def bit_length(x):
    return x.bit_length()


def cut(a, b):
    """a / b, rounded towards 0."""
    return abs(a) // abs(b) * (1 if (a < 0) == (b < 0) else -1)


def log4(x):
    x = min(x, 2**31 - 16) + 4
    high = x.bit_length() - 1
    return 4 * (high - 2) + (x >> (high - 2) & 3)


def varint(data, at):
    value = shift = 0
    while True:
        require(at < len(data), 'the stream ends in its head')
        value |= (data[at] & 0x7F) << shift
        at, shift = at + 1, shift + 7
        if data[at - 1] < 0x80:
            return value, at


# D.4.4 Streams

class ValueStream:
    def __init__(self, data, at):
        size = len(data) - at
        head = size if size < 8 else size % 4 + 4 if size % 4 else 8
        self.state = int.from_bytes(data[at:at + head], 'big')
        self.words = [int.from_bytes(data[k:k + 4], 'big') for k in range(at + head, at + size, 4)]
        self.words.reverse()

    def take(self, begin, size):
        self.state = size * (self.state >> 16) + self.state % 65536 - begin
        self.renew()

    def renew(self):
        if self.state < 2**31 and self.words:
            self.state = self.state << 32 | self.words.pop()

    def bit(self, p):
        one = self.state % 65536 < p
        self.take(0, p) if one else self.take(p, 65536 - p)
        return int(one)

    def symbol(self, above):
        position = self.state % 65536 >> 1
        symbol = sum(x > position for x in above)
        begin, end = (above + [0])[symbol], ([32768] + above)[symbol]
        self.take(2 * begin, 2 * (end - begin))
        return symbol

    def plain(self, count):
        value = self.state % 2**count
        self.state >>= count
        self.renew()
        return value

    def finish(self):
        require(not self.words and self.state == 0, 'the stream does not end with the state 0')


# D.4.5 Chances

class Chance:
    def __init__(self, p=32768):
        self.p, self.seen = p << 6, 0

    def read(self, stream):
        bit = stream.bit(self.p >> 6)
        self.update(bit)
        return bit

    def update(self, bit):
        self.p += ((2**22 - 1 - 2048 if bit else 2048) - self.p) * (655360 // (10 * self.seen + 16)) >> 16
        self.seen = min(self.seen + 1, 255)


class Chances(dict):
    """Chances by context, made when they are first asked for."""

    def __init__(self, p=32768):
        super().__init__()
        self.initial = p

    def __missing__(self, key):
        self[key] = Chance(self.initial)
        return self[key]


# D.4.7 Values

class ErrorScale:
    """How large the errors of a site's m components may be: `near` of each, `all` on average; by those at its neighbours."""

    def per_component(self, total):
        return total * 21845 >> 16 if self.m == 3 else total // self.m

    def scale(self, around):
        count = len(around.neighbours)
        self.near, self.all = [self.typical] * self.m, self.typical
        if count:
            reciprocal = (65536 + count // 2) // count
            self.near = [sum(self.errors[s][i] for s in around.neighbours) * reciprocal >> 16 for i in range(self.m)]
            self.all = self.per_component(sum(self.near))
            if count == 1:
                self.all = self.all + self.typical >> 1

    def adapt_scale(self, errors):
        now = min(self.per_component(sum(errors)), 4 * self.typical)
        self.typical = max(self.typical + (now - self.typical >> 5), 16)


# D.4.8 Residuals

LEAST = (0, 1, 2, 3, 5, 7, 11, 15)
DIGITS = (0, 0, 0, 1, 1, 2, 2)


def prior(power, halved, fraction):
    size = power * 102 - 65536 * 51 >> 16 + halved

    def beyond(limit):
        ratio = (4 * size << 16) // (4 * size + 32 * abs(limit))
        tail = (ratio * ratio >> 16) ** 2 >> 18
        return 32768 - tail if limit < 0 else tail

    outside, last, above = 32768 - beyond(-124 - fraction), 32768, []
    for i in range(15):
        most = -1 - LEAST[6 - i] if i < 7 else LEAST[i - 7]
        last = max(min(beyond(8 * most + 4 - fraction) + outside, last - 3), 3 * (15 - i))
        above.append(last)
    return above


def priors():
    result, power = [], 84990
    for _ in range(10):
        result.append([prior(power, 0, 2 * part - 3) for part in range(4)])
        power = power * 92682 >> 16
    return result + [[prior((9 + 2 * part) << 18, 1, 0) for part in range(4)]]


PRIORS = priors()


class Habit:
    def __init__(self, prior, last_rate=350):
        self.above, self.rate, self.last_rate = list(prior), 5461, last_rate

    def learn(self, symbol):
        for i, x in enumerate(self.above):
            target = 3 * (15 - i) + (32720 if i < symbol else 0)
            self.above[i] += (target - x) * self.rate >> 16
        self.rate -= (self.rate - self.last_rate) * self.rate >> 16


class Classes:
    def __init__(self, fast):
        self.fast = fast
        self.first, self.second, self.longer = {}, {}, Chance()
        self.outside = [Habit([2048 * (15 - i) for i in range(15)]) for _ in range(2)]

    def read(self, stream, level, part, rank, members, spread, near):
        """level: of the estimate; spread, near: sizes."""
        shift = max(level // 4 - 4, 0)
        cell, columns = min(level // 2, 10), []
        for size, most in ((spread, 6), (near, 4)):
            columns.append(min(log4((size >> 1) >> shift) // 4, most))
        coarse = (cell // 5, 0 if shift else part)
        if shift:
            part = level % 4
        first = self.first.setdefault((cell, part, rank, members), Habit(PRIORS[cell][part]))
        second = self.second.setdefault((*coarse, *columns), Habit(PRIORS[5 * coarse[0]][1 if shift else part]))
        if self.fast:
            symbol = stream.symbol(first.above)
        else:
            symbol = stream.symbol([a + b + 1 >> 1 for a, b in zip(first.above, second.above)])
            second.learn(symbol)
        first.learn(symbol)
        if symbol == 7:
            return 0
        if symbol < 15:
            row = abs(symbol - 7) - 1
            offset = stream.plain(DIGITS[row] + shift)
            if symbol > 7:
                return 1 + (LEAST[row] << shift) + offset
            return offset - (LEAST[row] + (1 << DIGITS[row]) << shift)
        habit = self.outside[min(shift, 1)]
        found = stream.symbol(habit.above)
        habit.learn(found)
        length = found >> 1
        while 7 <= length < 28 - shift and self.longer.read(stream):
            length += 1
        residual = 1 + (2**length + stream.plain(length) + 14 << shift) + stream.plain(shift)
        return -residual if found & 1 else residual


# Of each context of Lengths, how many values its features have.
LENGTHS = ((64, 3, 4), (15, 4, 19), (12, 16, 19), (3, 4, 16, 19), (16, 3, 19), (16, 3, 19), (16, 4, 19), (16, 3, 19))


class Lengths:
    def __init__(self, sites):
        bits = bit_length(sites)
        self.shift = 28 - clamp(bits - 2, clamp(bits, 5, 9), 12)
        self.slots, self.weights, self.decisions, self.rate = {}, {}, 0, 0
        self.signs, self.digits, self.last = Chances(), Chances(), [0, 0, 0]

    def places(self, contexts):
        start, places = 0, []
        for counts, context in zip(LENGTHS, contexts):
            number = 0
            for count, feature in zip(counts, context):
                number = number * count + feature
            places.append((start + number) * 0x9E3779B1 % 2**32 >> self.shift)
            start += math.prod(counts)
        return places

    def decide(self, stream, rank, bin_, places):
        slots = [self.slots.setdefault(place ^ bin_, Slot()) for place in places]
        weights = self.weights.setdefault((rank, bin_), [3440] * 8)
        inputs = [slot.stretched() for slot in slots]
        opinion = squashed(clamp(sum(i * w for i, w in zip(inputs, weights)) >> 16, -2047, 2047))
        bit = stream.bit(clamp(opinion, 24, 65512))
        if self.decisions % 64 == 0:
            self.rate = 200 + 6000000 // (4000 + self.decisions + 1)
        self.decisions += 1
        step = ((bit << 16) - opinion) * self.rate >> 13
        for k, value in enumerate(inputs):
            weights[k] = clamp(weights[k] + (value * step + 16384 >> 15), -32768, 32767)
        for slot in {id(slot): slot for slot in slots}.values():
            slot.update(bit)
        return bit

    def read(self, stream, expected, rank, contexts, sign):
        contexts = self.places(contexts + ((self.last[rank], rank, expected),))
        length = expected
        if self.decide(stream, rank, 0, contexts):
            length += 1
            step = 1
            while length < 30 and self.decide(stream, rank, step, contexts):
                length, step = length + 1, min(step + 1, 8)
        else:
            step = 9
            while length > 0 and self.decide(stream, rank, step, contexts):
                length, step = length - 1, min(step + 1, 15)
        self.last[rank] = min(length, 15)
        if length == 0:
            return 0
        negative = self.signs[sign, min(length, 3)].read(stream)
        value, rest, off = 1, length - 1, clamp(length - expected, -3, 4)
        if rest > 0:
            value, rest = 2 | self.digits[rank, off].read(stream), rest - 1
        if rest > 0:
            value, rest = value << 1 | self.digits[rank, off, value & 1].read(stream), rest - 1
        value = value << rest | stream.plain(rest)
        return -value if negative else value
