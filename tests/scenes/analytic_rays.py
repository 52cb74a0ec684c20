"""Where rays run in boxes: affine maps and chords, in double precision, for the analytic cases."""

import math

from harness import dot, rotate, unit


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


class Affine:
    """x -> M x + shift; three columns and a shift."""

    def __init__(self, columns=((1, 0, 0), (0, 1, 0), (0, 0, 1)), shift=(0, 0, 0)):
        self.columns = [tuple(map(float, c)) for c in columns]
        self.shift = tuple(map(float, shift))

    def vector(self, v):
        return tuple(sum(c[i] * x for c, x in zip(self.columns, v)) for i in range(3))

    def point(self, p):
        return tuple(a + b for a, b in zip(self.vector(p), self.shift))

    def then(self, outer):
        """First this one, then the outer one."""
        return Affine([outer.vector(c) for c in self.columns], outer.point(self.shift))

    def determinant(self):
        a, b, c = self.columns
        return dot(a, cross(b, c))

    def inverse(self):
        a, b, c = self.columns
        scale = 1 / self.determinant()
        rows = [tuple(scale * x for x in v) for v in (cross(b, c), cross(c, a), cross(a, b))]
        back = Affine(list(zip(*rows)))
        back.shift = tuple(-x for x in back.vector(self.shift))
        return back

    def normal(self, n):
        """Where a covector (a gradient, a normal) goes: the inverse transposed."""
        back = self.inverse()
        return tuple(dot(c, n) for c in back.columns)


class Transform:
    """A Transform node and the map that it is; boxes are put into it."""

    def __init__(self, translation=(0, 0, 0), rotation=(0, 0, 1, 0), scale=(1, 1, 1), inside=None):
        self.fields = (("translation", translation), ("rotation", rotation), ("scale", scale))
        self.inside = inside
        axes = ((scale[0], 0, 0), (0, scale[1], 0), (0, 0, scale[2]))
        own = Affine([rotate(rotation[:3], rotation[3], a) for a in axes], translation)
        self.map = inside.map.then(own) if inside else own

    def around(self, content):
        if self.inside:
            content = self.inside.around(content)
        fields = " ".join(f"{name} {words(value)}" for name, value in self.fields)
        return f"Transform {{ {fields} children [\n{content}] }}\n"


def words(values):
    return " ".join(repr(float(v)) for v in values)


class Chord:
    """A ray in a box, in the box's own coordinates: where it enters, its direction of length 1, how
    long it is; and how far the entry is from the eye, in lengths of the ray outside."""

    def __init__(self, entry, direction, length, distance=0.0, speed=1.0):
        self.entry, self.direction, self.length = entry, direction, length
        self.distance, self.speed = distance, speed

    def at(self, way):
        return tuple(e + way * d for e, d in zip(self.entry, self.direction))

    def part(self, start, end):
        """Between two lengths of the ray outside."""
        way = (start - self.distance) * self.speed
        return Chord(self.at(way), self.direction, (end - start) * self.speed, start, self.speed)

    def end(self):
        return self.distance + self.length / self.speed


class Box:
    """A box of `size` voxels, of which what lies between `low` and `high` (fractions) is drawn."""

    def __init__(self, dimensions=(1, 1, 1), size=(1, 1, 1), low=(0, 0, 0), high=(1, 1, 1), place=None,
                 span=None):
        self.dimensions, self.size, self.low, self.high = dimensions, size, low, high
        self.place = place or Transform()
        self.span = span  # where a ray (origin, direction) begins and ends, if not at the eye and never

    def voxel(self):
        """The length that --step counts in: the geometric mean of a voxel's sides."""
        return math.prod(d / n for d, n in zip(self.dimensions, self.size)) ** (1 / 3)

    def fields(self):
        return f"cropMin {words(self.low)} cropMax {words(self.high)}"

    def own(self, texture):
        """Own coordinates of a place in texture coordinates."""
        return tuple((t - 0.5) * d for t, d in zip(texture, self.dimensions))

    def texture(self, own):
        return tuple(x / d + 0.5 for x, d in zip(own, self.dimensions))

    def chord(self, ray):
        """Of a ray (origin, direction of length 1) in the coordinates that the box is placed in."""
        back = self.place.map.inverse()
        origin, direction = back.point(ray[0]), back.vector(ray[1])
        speed = math.sqrt(dot(direction, direction))
        direction = unit(direction)
        enter, leave = (speed * t for t in (self.span(*ray) if self.span else (0.0, math.inf)))
        for o, d, a, b in zip(origin, direction, self.own(self.low), self.own(self.high)):
            if abs(d) < 1e-14:
                if not a <= o <= b:
                    return None
                continue
            near, far = sorted(((a - o) / d, (b - o) / d))
            enter, leave = max(enter, near), min(leave, far)
        if not enter < leave:
            return None
        entry = tuple(o + enter * d for o, d in zip(origin, direction))
        return Chord(entry, direction, leave - enter, enter / speed, speed)


# Keeps a box within what a ramp or a cell is exact in: from the outermost texels' centres on.
def centres(size, further=0.0):
    return tuple((0.5 + further) / n for n in size), tuple(1 - (0.5 + further) / n for n in size)


class Parallel:
    """Parallel rays along -z from z = 1; the picture is a square of side `side` around the axis."""

    def __init__(self, side=1.0):
        self.side = side

    def text(self, fields=""):
        half = self.side / 2
        return (f"OrthoViewpoint {{ position 0 0 1 fieldOfView {-half} {-half} {half} {half} "
                f"{fields} }}\n")

    def ray(self, x, y, pixels):
        place = [self.side * ((v + 0.5) / pixels - 0.5) for v in (x, y)]
        return (place[0], -place[1], 1.0), (0.0, 0.0, -1.0)


class Perspective:
    """Rays from (0, 0, distance) along -z."""

    def __init__(self, distance=2.0, angle=0.6):
        self.distance, self.angle = distance, angle

    def text(self, fields=""):
        return f"Viewpoint {{ position 0 0 {self.distance} fieldOfView {self.angle} {fields} }}\n"

    def ray(self, x, y, pixels):
        half = math.tan(self.angle / 2)
        place = [half * (2 * (v + 0.5) / pixels - 1) for v in (x, y)]
        return (0.0, 0.0, float(self.distance)), unit((place[0], -place[1], -1.0))
