"""Values of components that repeat earlier ones: EXTENSION_SPEC.md, D.4.13."""


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def largest(*vectors):
    return max(abs(x) for vector in vectors for x in vector)


def quotient(a, b):
    size = min(abs(a) // abs(b), 2**20)
    rest = abs(a) % abs(b)
    size = (size << 16) + (rest << 16) // abs(b)
    return -size if (a < 0) != (b < 0) else size


class Motion:
    def __init__(self, turns):
        self.turns, self.ends, self.basis, self.reach = turns, None, [], 0
        self.turned, self.rows, self.shift = False, None, 0

    def image(self, value):
        steps = [x - y for x, y in zip(value, self.ends[0])]
        if self.rows:
            moved = [dot(row, steps) >> 12 + self.shift for row in self.rows]
        else:
            moved = [16 * x for x in steps]
        image = [16 * x + y for x, y in zip(self.ends[1], moved)]
        return [min(max(x, -2**25), 2**25) for x in image] if self.turns else image

    def learn(self, value, image):
        if self.ends is None:
            self.ends = value, image
        elif self.turns:
            pair = [[x - y for x, y in zip(point, end)] for point, end in zip((value, image), self.ends)]
            before, changed = self.turned, self.extend(pair)
            self.turned |= any(abs(x - y) > 1 for x, y in zip(*pair))
            if self.turned and (changed or not before) and len(self.basis) > 1:
                self.solve()

    @staticmethod
    def span(basis):
        ways = [pair[0] for pair in basis]
        if len(ways) == 1:
            return largest(ways[0])
        area = cross(*ways[:2])
        return largest(area) if len(ways) == 2 else abs(dot(area, ways[2]))

    def extend(self, pair):
        if len(self.basis) < 3 and self.span(self.basis + [pair]) > 6 * self.reach:
            self.basis = self.basis + [pair]
            self.reach = self.span(self.basis)
            return True
        best, widest = None, self.reach
        for place in range(len(self.basis)):
            tried = self.basis[:place] + [pair] + self.basis[place + 1:]
            here = self.span(tried)
            if here > widest and here // 2 >= self.reach:
                best, widest = tried, here
        if best is None:
            return False
        self.basis, self.reach = best, widest
        return True

    def solve(self):
        sources, images = [pair[0] for pair in self.basis], [pair[1] for pair in self.basis]
        if len(self.basis) == 2:
            upright = [cross(*sources), cross(*images)]
            while largest(*upright) >= 2**18:
                upright = [[x >> 1 for x in vector] for vector in upright]
            sources, images = sources + upright[:1], images + upright[1:]
        self.shift = 0
        while largest(*sources) >= 2**18:
            sources = [[x >> 1 for x in way] for way in sources]
            self.shift += 1
        adjoint = [cross(sources[1], sources[2]), cross(sources[2], sources[0]), cross(sources[0], sources[1])]
        volume = dot(adjoint[0], sources[0])
        self.rows = None
        if volume != 0:
            sums = [[sum(images[k][i] * adjoint[k][j] for k in range(3)) for j in range(3)] for i in range(3)]
            self.rows = [[min(max(quotient(x, volume), -2**20), 2**20) for x in row] for row in sums]


class State:
    def __init__(self, turns):
        self.motion, self.errors = Motion(turns), None


class Copies:
    """`values` has those of the known sites."""

    def __init__(self, mesh, sites, values, turns):
        self.values, self.links, self.usual = values, {}, [0, 0]
        self.state = self.prediction = None
        for corner, original, count in mesh.copies:
            state = State(turns)
            for site, source in zip(sites[corner:corner + count], sites[original:original + count]):
                if site != source:
                    self.links.setdefault(site, (source, state))

    def look(self, site, own):
        """What the original says in 1/16 if that is to be trusted more than `own`."""
        self.source, self.state = self.links.get(site, (None, None))
        if self.source not in self.values:
            self.state = None
        if self.state is None or self.state.motion.ends is None:
            self.prediction = None
            return None
        if self.state.errors is None:
            self.state.errors = list(self.usual)
        self.own, self.prediction = own, self.state.motion.image(self.values[self.source])
        return self.prediction if self.state.errors[0] <= self.state.errors[1] else None

    def scale(self, width):
        return min(self.state.errors[0] // (4 * width), 2**20)

    def learn(self, value):
        if self.state is None:
            return
        if self.prediction is not None:
            for i, prediction in enumerate((self.prediction, self.own)):
                error = sum(min(abs(16 * x - y), 2**14) for x, y in zip(value, prediction))
                self.state.errors[i] += error - (self.state.errors[i] >> 2)
                self.usual[i] += 4 * error - self.usual[i] >> 4
        self.state.motion.learn(self.values[self.source], value)
