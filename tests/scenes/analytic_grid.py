"""Voxels on a grid in double precision: trilinear values, the pieces of a ray in which they are cubic,
and what the engine's gradient is defined as."""

import array
import math

from analytic_data import nrrd


class Grid:
    """The values of a field at the centres of a box's voxels, or given ones; x runs fastest."""

    def __init__(self, box, field=None, values=None):
        self.box = box
        w, h, d = box.size
        if values is None:
            values = [field(box.own(((i + 0.5) / w, (j + 0.5) / h, (k + 0.5) / d)))
                      for k in range(d) for j in range(h) for i in range(w)]
        self.values = array.array("f", values)  # as the file has them

    def file(self):
        return nrrd(self.box.size, self.values)

    def voxel(self, index):
        """Beyond the outermost centres the value is that of the centre."""
        i, j, k = (min(max(a, 0), n - 1) for a, n in zip(index, self.box.size))
        return self.values[(k * self.box.size[1] + j) * self.box.size[0] + i]

    def value(self, place, voxel=None):
        """Trilinear, at own coordinates; of the voxels, or of something else at their centres."""
        voxel = voxel or self.voxel
        at = [t * n - 0.5 for t, n in zip(self.box.texture(place), self.box.size)]
        low = [math.floor(a) for a in at]
        total = 0.0
        for corner in range(8):
            index = [a + (corner >> axis & 1) for axis, a in enumerate(low)]
            weight = math.prod(a - b if corner >> axis & 1 else 1 - (a - b)
                               for axis, (a, b) in enumerate(zip(at, low)))
            if weight:
                total += weight * voxel(index)
        return total

    def gradient(self, place):
        """The trilinear interpolation of central differences at voxels' centres, in own coordinates."""
        found = []
        for axis in range(3):
            def difference(index, axis=axis):
                ends = [[a + side * (b == axis) for b, a in enumerate(index)] for side in (1, -1)]
                return self.voxel(ends[0]) - self.voxel(ends[1])
            inside = [min(max(t, 0.5 / n), 1 - 0.5 / n)
                      for t, n in zip(self.box.texture(place), self.box.size)]
            scale = self.box.size[axis] / (2 * self.box.dimensions[axis])
            found.append(scale * self.value(self.box.own(inside), difference))
        return tuple(found)

    def pieces(self, chord):
        """Where the ray enters, crosses planes of voxels' centres, and leaves."""
        ways = {0.0, chord.length}
        for axis in range(3):
            speed = chord.direction[axis]
            if abs(speed) < 1e-12:
                continue
            n, side = self.box.size[axis], self.box.dimensions[axis]
            for i in range(n):
                way = ((i + 0.5) / n * side - side / 2 - chord.entry[axis]) / speed
                if 0 < way < chord.length:
                    ways.add(way)
        return sorted(ways)

    def integral(self, chord):
        """Of the value along the ray: in each piece Gauss' rule of two points is exact for a cubic."""
        total, node = 0.0, 1 / math.sqrt(3)
        ways = self.pieces(chord)
        for a, b in zip(ways, ways[1:]):
            middle, half = (a + b) / 2, (b - a) / 2
            total += half * sum(self.value(chord.at(middle + half * x)) for x in (-node, node))
        return total

    def roughness(self, chord):
        """The integral of |s''| along the ray, and the sum of the jumps of s' where it crosses faces."""
        curved, jumps, before = 0.0, 0.0, None
        ways = self.pieces(chord)
        for a, b in zip(ways, ways[1:]):
            third = (b - a) / 3
            p, q, r, s = (self.value(chord.at(a + i * third)) for i in range(4))
            # the cubic through four points: its derivatives at both ends
            first = (-11 * p + 18 * q - 9 * r + 2 * s) / (6 * third)
            last = (11 * s - 18 * r + 9 * q - 2 * p) / (6 * third)
            bend = (2 * p - 5 * q + 4 * r - s) / third**2, (2 * s - 5 * r + 4 * q - p) / third**2
            curved += (b - a) * max(map(abs, bend))
            jumps += abs(first - before) if before is not None else 0.0
            before = last
        return curved, jumps
