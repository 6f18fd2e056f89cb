"""A second decoder of attribute values, written from EXTENSION_SPEC.md, D.4, alone and laid out like it.

decode(mesh, sites, site_count, m, maximum, head, data, places) -> the numbers, m per site.
"""
from models import GatedFlag, clamp, require
from value_copies import Copies
from value_models import (FAST, SMALL, Chances, Classes, ErrorScale, Lengths, ValueStream, bit_length, cut, log4, varint)
from value_echoes import Echoes
from value_geometry import Directions, Textures
from value_sites import Graph
from value_surroundings import WITHIN, Surroundings

PLAIN, POINTS, TEXTURE, DIRECTION, LABEL, ANGULAR = range(6)


# D.4.7 Values

class Coder(ErrorScale):
    one, beside = 16, False

    def __init__(self, graph, m, maximum, kind, profile, echoes, copies, stream, places, weighting):
        self.graph, self.m, self.max, self.kind, self.stream = graph, m, maximum, kind, stream
        self.profile, self.coded = profile, 0
        self.values, self.errors, self.last_picked = {}, {}, False
        self.last, self.typical = [0] * m, 64
        self.picks, self.indices, self.gains = Chances(6160), Chances(), {}
        self.residuals = Lengths(graph.site_count) if profile == SMALL else Classes(profile == FAST)
        self.echoes = Echoes(self) if echoes else None
        self.copies = Copies(graph.mesh, graph.site, self.values, m == 3 and maximum < 2**20) if copies else None
        self.weighting = weighting
        self.far_limit = -1 if kind == DIRECTION else 0 if kind == TEXTURE or profile == FAST else 1
        self.guide = {TEXTURE: Textures, DIRECTION: Directions}.get(kind, lambda *_: None)(self, places)

    def run(self):
        while self.coded < self.graph.site_count:
            self.site(self.coded)
            self.coded += 1
        return [x for site in range(self.graph.site_count) for x in self.values[site]]

    def known(self, site):
        return site < self.coded

    def site(self, site):
        around = Surroundings(self, site)
        if self.guide:
            self.guide.refine(site, around)
        self.scale(around)
        if self.copies and (prediction := self.copies.look(site, around.base)):
            around.replace(prediction)
            self.all = self.copies.scale(self.m)
            self.near = [self.all] * self.m
        earlier = self.echoes.read(self.stream, site, bool(around.neighbours)) if self.echoes else None
        if earlier is None:
            value, errors = self.components(around, *self.pick(around))
        else:
            value = self.values[earlier]
            errors = [min(abs(16 * value[i] - around.base[i]), 2**20) for i in range(self.m)]
        self.values[site], self.errors[site], self.last = value, errors, value
        if self.guide:
            self.guide.learn(site, value)
        if self.echoes:
            self.echoes.learn(site)
        if self.copies:
            self.copies.learn(value)
        self.adapt_scale(errors)

    def pick(self, around):
        count = len(around.members)
        if count < 2:
            return around.base, min(count, 3), False
        level, row = min(bit_length(sum(around.spread) + 4) - 3 >> 1, 5), min(count, 4)
        self.last_picked = self.picks[around.source == WITHIN, row, self.last_picked, level].read(self.stream)
        if not self.last_picked:
            return around.base, min(count, 3), False
        k = 0
        while k + 1 < count and not self.indices[row, k].read(self.stream):
            k += 1
        return around.members[k], 0, True

    def components(self, around, base, members, picked):
        order, normal = list(range(self.m)), None
        if any(around.normal) and self.profile != FAST:
            largest = max(range(3), key=lambda i: (abs(around.normal[i]), i))
            order.append(order.pop(largest))
            shift = bit_length(abs(around.normal[largest])) - 12
            normal = [x >> shift if shift > 0 else x << -shift for x in around.normal]
        value, errors, raw = [0] * self.m, [0] * self.m, [0] * self.m
        so_far = weighed = 0
        for rank, i in enumerate(order):
            prediction, gain = base[i], None
            if rank == 2 and normal:
                s = min(around.source, 2) if around.members else 2
                gain = (min(bit_length(self.all), 15), s, len(around.members) > 1)
                inverse = cut(2**24, normal[i])
                correction = -sum(normal[k] * raw[k] for k in order[:2]) * inverse >> 24
                prediction += self.gains.setdefault(gain, 2048) * correction >> 12
            side = normal[i] if normal else around.lean[i] - prediction
            down = self.profile != SMALL and (side < 0 or side == 0 and (prediction + 8) % 16 < 8)
            turned = -prediction if down else prediction
            number = (turned + 8 >> 4) + self.residual(around, i, min(rank, 2), so_far, weighed, turned, side, members,
                                                       picked)
            number = -number if down else number
            require(0 <= number <= self.max, 'a value outside its range')
            value[i], raw[i] = number, 16 * number - base[i]
            errors[i] = min(abs(16 * number - prediction), 2**20)
            so_far += errors[i]
            weighed = (weighed >> 1) + errors[i] if rank else 2 * errors[i]
            if gain:
                self.adapt(gain, raw[i], correction)
        return value, errors

    def adapt(self, gain, off, correction):
        limit = 4 * self.all + 64
        if abs(off) > limit or abs(correction) > limit:
            return
        error = off - (self.gains[gain] * correction >> 12)
        step = error * correction * 64 >> 2 * bit_length(self.all)
        self.gains[gain] = clamp(self.gains[gain] + clamp(step, -512, 512), -512, 4608)

    def residual(self, around, i, rank, so_far, weighed, turned, side, members, picked):
        near, count = self.near[i], len(around.members)
        spread = min(around.spread[i], 2**28)
        estimate = self.all + near + (weighed if rank else self.all + near) + 4 * spread * (count > 1)
        estimate >>= 2 + (count > 1) + picked
        level = log4(estimate >> 1)
        if self.profile != SMALL:
            return self.residuals.read(self.stream, level, (turned + 8) % 16 >> 2, rank, members, spread, near)
        level, sign = min(level, 63), ((turned & 15) >> 1, (side > 0) - (side < 0), rank)

        def relative(size, low, high):
            return clamp(log4(size >> 1) - level >> 1, low, high)

        def relative16(size):
            return relative(min(size, 2**25), -7, 8) + 7

        e = min(bit_length(estimate * 3 >> 6), 18)
        source = min(around.source, 1) if count else 2
        contexts = ((level, rank, members), (relative(spread, -7, 7) + 7, members, e),
                    (relative(near, -5, 6) + 5, relative16(max(around.spread)), e),
                    (source, members, relative16(self.all), e), (relative16(so_far), rank, e),
                    (relative16(abs(around.lean[i] - turned)), rank, e), (turned + 8 & 15, members, e))
        return self.residuals.read(self.stream, e, rank, contexts, sign)


# D.4.12 Labels

def labels(graph, count, stream):
    label_of, last, flags = {}, 0, GatedFlag(5, 13)
    none, bits = 2**32 - 1, bit_length(count - 1)
    table_bits = clamp(bit_length(graph.site_count) + 1, 6, 14)

    def read(node):
        lines = [(c * 0x9E3779B1 ^ node * 0x85EBCA6B) * 0xC2B2AE35 % 2**32 >> 32 - table_bits for c in contexts]
        return flags.read(stream, lines[1], lines, bit_length(node))

    for site in range(graph.site_count):
        around, found, agreeing = [none] * 3, 0, 0
        for corner in graph.corners(site):
            for other in (graph.next[corner], graph.prev[corner]):
                label = label_of.get(graph.site[other], none)
                if label == none:
                    continue
                if found < 2 and (found == 0 or label != around[0]):
                    around[found] = label
                    found += 1
                agreeing += label == around[0]
            opposite = label_of.get(graph.site[graph.next[graph.next[corner]]], none)
            if around[2] == none:
                around[2] = opposite
        contexts = (0, around[0] * 4 + min(agreeing, 3), around[0] * 0x10001 + around[1] * 3,
                    around[2] * 0x8003 + around[0], last)
        if around[0] != none and read(0):
            label_of[site] = last = around[0]
            continue
        node = 1
        for i in reversed(range(bits)):
            node = node << 1 | (read(node) if ((node << 1 | 1) << i) - (1 << bits) < count else 0)
        label_of[site] = last = node - (1 << bits)
    return [label_of[site] for site in range(graph.site_count)]


# D.4.1 Streams

def decode(mesh, sites, site_count, m, maximum, head, data, places):
    profile, kind, ranked, echoes, copies = head & 3, head >> 2 & 7, head >> 5 & 1, head >> 6 & 1, head >> 7
    require(profile <= SMALL and kind <= ANGULAR, 'head')
    graph, at = Graph(mesh, sites, site_count), 0
    if kind == LABEL:
        return read_labels(graph, m, maximum, data)
    lists = None
    if ranked:
        lists, at = read_ranks(data, m, maximum)
        maximum = max(len(ranks) for ranks in lists) - 1
    weighting = 0
    if kind == DIRECTION:
        require(data and data[0] < 3, 'weighting')
        weighting, at = data[0], 1
    stream = ValueStream(data, at)
    values = Coder(graph, m, maximum, kind, profile, echoes, copies, stream, places, weighting).run()
    stream.finish()
    if not lists:
        return values
    require(all(x < len(lists[i % m]) for i, x in enumerate(values)), 'a rank too large')
    return [lists[i % m][x] for i, x in enumerate(values)]


# D.4.11 Ranks

def read_ranks(data, m, maximum):
    lists, at = [], 0
    for _ in range(m):
        count, at = varint(data, at)
        ranks, value = [], -1
        for _ in range(count + 1):
            step, at = varint(data, at)
            value += step + 1
            require(value <= maximum, 'a value outside its range')
            ranks.append(value)
        lists.append(ranks)
    return lists, at


def read_labels(graph, m, maximum, data):
    count, at = varint(data, 0)
    require(1 <= count <= 4096, 'number of names')
    names = []
    for i in range(count):
        name = []
        for k in range(m):
            step, at = varint(data, at)
            name.append(step + (names[-1][0] if k == 0 and i > 0 else 0))
        require(max(name) <= maximum, 'a value outside its range')
        names.append(name)
    stream = ValueStream(data, at)
    found = labels(graph, count, stream)
    stream.finish()
    return [x for label in found for x in names[label]]
