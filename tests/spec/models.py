"""Range decoder and models: EXTENSION_SPEC.md, B.3, B.4 and B.7."""


class Invalid(Exception):
    pass


def require(condition, rule):
    if not condition:
        raise Invalid(rule)


def clamp(value, low, high):
    return max(low, min(value, high))


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
        bit = stream.bit(clamp(self.p, 32, 65504))
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


# B.7 Mixing

def tables():
    def times(a, b):
        a_high, a_low, b_high, b_low = a >> 31, a & 0x7FFFFFFF, b >> 31, b & 0x7FFFFFFF
        return a_high * b_high + ((a_high * b_low + a_low * b_high) >> 31)

    squash, stretch, half = [1] * 4096, [0] * 4096, []
    power = 2**62
    for k in range(2048):
        one = 2**63 // ((2**48 + (power >> 14)) >> 1)
        squash[2048 + k] = min(one, 65535)
        if k > 0:
            squash[2048 - k] = max(65536 - one, 1)
        half.append(times(power, 4598142163217826931) >> 14)
        power = times(power, 4584638084353230594)
    steps = 2047
    for i in range(2048):
        odds = 2 * i + 1
        while steps > 0 and odds << 48 >= half[steps - 1] * (8192 - odds):
            steps -= 1
        stretch[i], stretch[4095 - i] = -4 * steps, 4 * steps
    return squash, stretch


SQUASH, STRETCH = tables()


def squashed(value):
    return SQUASH[value + 2048]


class Slot:
    def __init__(self):
        self.p, self.rate = 32768, 32767

    def stretched(self):
        return STRETCH[self.p >> 4]

    def update(self, bit):
        other = 65535 - self.p if bit else self.p
        other -= other * self.rate >> 16
        self.p = 65535 - other if bit else other
        self.rate = max(self.rate - (self.rate * self.rate >> 17), 257)


class LearningRate:
    """What a stream's weights learn at a time, by how many decisions they learned from."""

    def __init__(self):
        self.decisions = self.rate = 0

    def advance(self):
        self.decisions += 1
        if (self.decisions - 1) % 64 == 0:
            self.rate = 200 + 6000000 // (4000 + self.decisions)

    def learn(self, weights, inputs, error):
        step = error * self.rate >> 13
        for i, value in enumerate(inputs):
            weights[i] = clamp(weights[i] + (value * step + 16384 >> 15), -32768, 32767)


class Mixer:
    """The decisions of one kind of symbol, in `contexts` contexts at once."""

    def __init__(self, contexts, rich, line_bits):
        self.contexts, self.rich, self.line_bits = contexts, rich, line_bits
        self.slots, self.places = {}, []
        weight = min(27 * 16384 // 100, 189 * 16384 // (100 * (contexts + 1)))
        self.weights = {}
        self.initial = [weight] * (contexts + 1)
        self.final = [[squashed(clamp(128 * i - 2048, -2047, 2047)) for i in range(33)] for _ in range(16)]
        self.learned = LearningRate()

    def enter(self, keys):
        self.places = [(key * 0x9E3779B97F4A7C15 + i * 0xD1B54A32D192ED03) % 2**64 >> (60 - self.line_bits)
                       for i, key in enumerate(keys)]

    def read(self, stream, node, situation, match, match_length):
        slots = [self.slots.setdefault(place ^ node, Slot()) for place in self.places]
        if self.contexts == 1:
            bit = stream.bit(clamp(slots[0].p, 16, 65520))
            slots[0].update(bit)
            return bit
        inputs = [slot.stretched() for slot in slots] + [match.stretched() if match else 0]
        sets = [self.weights_of('node', node)]
        if self.rich:
            sets += [self.weights_of('situation', situation), self.weights_of('match', match_length)]
        opinions = [clamp(sum(i * w for i, w in zip(inputs, weights)) >> 16, -2047, 2047) for weights in sets]
        bit, probability = self.decide(stream, node, opinions)
        if abs((bit << 16) - probability) < 1024:
            return bit
        self.learned.advance()
        for weights, opinion in zip(sets, opinions):
            self.learned.learn(weights, inputs, (bit << 16) - squashed(opinion))
        for slot in {id(slot): slot for slot in slots + ([match] if match else [])}.values():
            slot.update(bit)
        return bit

    def weights_of(self, kind, number):
        return self.weights.setdefault((kind, number), list(self.initial))

    def decide(self, stream, node, opinions):
        if not self.rich:
            return stream.bit(squashed(opinions[0])), squashed(opinions[0])
        average = sum(opinions) * 21845 >> 16
        points, i, part = self.final[node], average + 2048 >> 7, average + 2048 & 127
        refined = (points[i] * (128 - part) + points[i + 1] * part) >> 7
        probability = clamp(squashed(average) + refined + 1 >> 1, 2, 65534)
        bit = stream.bit(probability)
        target = 65535 if bit else 0
        points[i] += (target - points[i]) * (128 - part) >> 13
        points[i + 1] += (target - points[i + 1]) * part >> 13
        return bit, probability


class Match:
    """Predicts that what followed the last symbols before will follow them again."""

    def __init__(self, used):
        self.used, self.history, self.latest = used, [], {}
        self.key = self.position = self.length = 0
        self.slots = [Slot() for _ in range(16)]

    def expected(self):
        return self.history[self.position] if self.length else None

    def length_class(self):
        return sum(self.length >= least for least in (1, 8, 12, 16, 24, 32, 64))

    def opinion(self, bit):
        return self.slots[2 * self.length_class() + bit]

    def add(self, symbol):
        if not self.used:
            return
        if self.length and self.history[self.position] == symbol:
            self.position += 1
            self.length = min(self.length + 1, 64)
        else:
            self.length = 0
        self.history.append(symbol)
        self.key = (self.key << 8 | symbol + 1) % 2**48
        if len(self.history) < 6:
            return
        place = (self.key * 65536 * 0x9E3779B97F4A7C15 % 2**64) >> 51
        if not self.length and place in self.latest:
            self.find(self.latest[place])
        self.latest[place] = len(self.history)

    def find(self, candidate):
        length, end = 0, len(self.history)
        while length < min(32, candidate) and self.history[candidate - 1 - length] == self.history[end - 1 - length]:
            length += 1
        if length >= 6:
            self.position, self.length = candidate, length


# C.1 Gated flags

class GatedFlag:
    def __init__(self, inputs, weight_sets):
        self.gates, self.tables = {}, [{} for _ in range(inputs)]
        self.weights = [[16384 * 13 // (10 * inputs)] * inputs for _ in range(weight_sets)]
        self.learned = LearningRate()

    def read(self, stream, gate, contexts, weight_set):
        slot = self.gates.setdefault(gate, Slot())
        certain = slot.p < 4096 or slot.p > 61440
        flag = stream.bit(slot.p) if certain else self.mix(stream, contexts, self.weights[weight_set])
        slot.update(flag)
        return flag

    def mix(self, stream, contexts, weights):
        slots = [table.setdefault(x, Slot()) for table, x in zip(self.tables, contexts)]
        inputs = [slot.stretched() for slot in slots]
        probability = squashed(clamp(sum(i * w for i, w in zip(inputs, weights)) >> 16, -2047, 2047))
        bit = stream.bit(probability)
        error = (bit << 16) - probability
        if abs(error) >= 1024:
            self.learned.advance()
            self.learned.learn(weights, inputs, error)
            for slot in slots:
                slot.update(bit)
        return bit
