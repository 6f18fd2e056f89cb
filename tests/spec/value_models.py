"""Streams and statistics of values: EXTENSION_SPEC.md, D.4.4, D.4.5 and D.4.8."""
from models import Slot, clamp, require, squashed


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
        size, at = varint(data, at)
        require(at + size <= len(data), 'the decisions end too early')
        self.decisions, self.rest = data[at:at + size], data[at + size:]
        self.range, self.taken, self.plain_taken = 65535, 16, 0
        self.number = int.from_bytes(self.decisions[:2].ljust(2, b'\0'), 'big')

    def take(self, start, size):
        self.number -= start
        self.range = size
        while self.range < 32768:
            self.range *= 2
            byte = self.decisions[self.taken // 8] if self.taken // 8 < len(self.decisions) else 0
            self.number = self.number << 1 | byte >> (7 - self.taken % 8) & 1
            self.taken += 1
        require(self.taken <= 8 * len(self.decisions) + 64, 'the decisions end too early')

    def bit(self, p):
        split = self.range * p >> 16
        one = self.number < split
        self.take(0, split) if one else self.take(split, self.range - split)
        return int(one)

    def symbol(self, above):
        ends = [self.range] + [2 * x * self.range >> 16 for x in above] + [0]
        symbol = sum(self.number < end for end in ends[1:])
        self.take(ends[symbol + 1], ends[symbol] - ends[symbol + 1])
        return symbol

    def plain(self, count):
        value = 0
        for i in range(count):
            at = self.plain_taken
            require(at < 8 * len(self.rest), 'the plain bits end too early')
            value |= (self.rest[at // 8] >> at % 8 & 1) << i
            self.plain_taken += 1
        return value

    def finish(self):
        require(8 * len(self.decisions) <= self.taken + 7, 'bytes are left in the decisions')
        require(8 * len(self.rest) <= self.plain_taken + 7, 'bytes are left in the plain bits')


# D.4.5 Chances

def curve():
    squash, power = [0] * 4096, 2**31
    for k in range(2049):
        one = min((2**47 + (power >> 16)) // (2**31 + power), 65535)
        if k < 2048:
            squash[2048 + k] = one
        squash[2048 - k] = 65536 - one
        power = power * 2139111403 + 2**30 >> 31
    stretch, x = [], 1
    for i in range(4096):
        while x < 4095 and squash[x] < 16 * i + 8:
            x += 1
        stretch.append(x - 2048)
    return squash, stretch


SQUASH, STRETCH = curve()


class Chance:
    def __init__(self, p=32768):
        self.p, self.seen = p << 6, 0

    def read(self, stream):
        bit = stream.bit(self.p >> 6)
        self.update(bit)
        return bit

    def trusted(self):
        confidence = 256 if self.seen >= 5 else 256 * (10 * self.seen + 4) // 50
        return STRETCH[self.p >> 10] * confidence >> 8

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


class MixedChance:
    """Five chances of one decision, with a set of weights per `key`."""

    def __init__(self):
        self.weights = {}

    def read(self, stream, key, chances):
        weights = self.weights.setdefault(key, [17039] * 5)
        inputs = [chance.trusted() for chance in chances]
        one = SQUASH[clamp(sum(i * w for i, w in zip(inputs, weights)) >> 16, -2047, 2047) + 2048]
        bit = stream.bit(clamp(one, 24, 65512))
        error = (65535 * bit - one) >> 4
        for k, value in enumerate(inputs):
            weights[k] = clamp(weights[k] + (value * error * 10 + 8192 >> 14), -2**20, 2**20)
            chances[k].update(bit)
        return bit


# D.4.8 Residuals

def shift_of(level):
    return 0 if level < 28 else level - 24 >> 2


def priors():
    result, power = [], 84990
    for scale in range(32):
        size, shift, last, above = power * 102 - 65536 * 51 >> 16, shift_of(2 * scale), 32768, []
        for i in range(15):
            k = i + 1 + (2 * shift - 1 if shift else 0)
            least = k if k < 2 else (2 + k % 2) << (k // 2 - 1)
            ratio = (4 * size << 16) // (4 * size + 256 * least - 128)
            square = ratio * ratio >> 16
            last = max(min(square * square >> 17, last - 3), 3 * (15 - i))
            above.append(last)
        result.append(above)
        power = power * 92682 >> 16
    return result


PRIORS = priors()


class Habit:
    def __init__(self, prior):
        self.above, self.seen = list(prior), 0

    def learn(self, symbol):
        rate = 655360 // (10 * self.seen + 160)
        for i, x in enumerate(self.above):
            target = 3 * (15 - i) + (32720 if i < symbol else 0)
            self.above[i] += (target - x) * rate >> 16
        self.seen = min(self.seen + 1, 127)


class Classes:
    def __init__(self, contexts_less_one):
        self.two = contexts_less_one == 1
        self.first, self.second, self.signs, self.longer = {}, {}, Chances(), Chances()

    def read(self, stream, level, first, second, sign):
        habit = self.first.setdefault(first, Habit(PRIORS[first[0]]))
        if self.two:
            other = self.second.setdefault(second, Habit(PRIORS[2 * second[2]]))
            symbol = stream.symbol([a + ((b - a) * 32767 >> 16) for a, b in zip(habit.above, other.above)])
            other.learn(symbol)
        else:
            symbol = stream.symbol(habit.above)
        habit.learn(symbol)
        shift = shift_of(level)
        base = 2 * shift - 1 if shift else 0
        if symbol == 0:
            magnitude = stream.plain(shift)
        else:
            if symbol == 15:
                while symbol + base < 59 and self.longer[min(symbol - 15, 7)].read(stream):
                    symbol += 1
            magnitude = k = symbol + base
            if k >= 4:
                magnitude = (2 + k % 2) << (k // 2 - 1) | stream.plain(k // 2 - 1)
        if magnitude == 0:
            return 0
        return -magnitude if self.signs[sign, min(symbol, 3)].read(stream) else magnitude


class Lengths:
    def __init__(self):
        self.slots, self.weights, self.decisions, self.rate = [{} for _ in range(8)], {}, 0, 0
        self.signs, self.digits, self.last = Chances(), Chances(), [0, 0, 0]

    def decide(self, stream, rank, bin_, contexts):
        slots = [self.slots[k].setdefault((c, bin_), Slot()) for k, c in enumerate(contexts)]
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
            slots[k].update(bit)
        return bit

    def read(self, stream, expected, rank, contexts, sign):
        contexts = contexts + ((self.last[rank], rank, expected),)
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
