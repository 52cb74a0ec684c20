"""Rays and the surfaces of equal value that they meet: what cell-roots (cell_roots.c) finds in double precision,
compared with pictures."""

import array
import math
import os
import random
import subprocess
import tempfile

from harness import CaseError, rotate
from scenes import NO_HEADLIGHT, effect, scene

SLACK = 2e-6  # of the value: what is decided by less than this may be decided either way


class Field:
    """Voxels of 8 bits."""

    def __init__(self, name, size, function):
        self.name = name
        self.size = size
        w, h, d = size
        self.bytes = bytes(min(255, max(0, round(255 * function((i + 0.5) / w, (j + 0.5) / h, (k + 0.5) / d))))
                           for k in range(d) for j in range(h) for i in range(w))

    def nrrd(self):
        size = " ".join(map(str, self.size))
        return (f"NRRD0004\ntype: uint8\ndimension: 3\nsizes: {size}\nencoding: raw\n\n").encode() + self.bytes


def marschner_lobb(x, y, z):
    """The test signal of Marschner and Lobb (Visualization '94)."""
    x, y, z = 2 * x - 1, 2 * y - 1, 2 * z - 1
    wave = math.cos(12 * math.pi * math.cos(math.pi * math.hypot(x, y) / 2))
    return (1 - math.sin(math.pi * z / 2) + 0.25 * (1 + wave)) / 2.5


def shells(x, y, z):
    """Thin where the value is near 1."""
    r = 32 * math.dist((x, y, z), (0.5, 0.5, 0.5))
    return math.exp(-((math.fmod(r, 5) - 2.5) / 1.5) ** 2)


def noise(seed=1):
    source = random.Random(seed)
    return lambda x, y, z: source.random()


class View:
    """A camera on the +Z axis, and a box of side 1 that is turned in front of it."""

    far = 0.9  # half of the field, in parallel projection

    def __init__(self, axis, angle, perspective=False, pixels=96):
        self.turn = (axis, angle)
        self.perspective = perspective
        self.pixels = pixels
        self.size = f"{pixels}x{pixels}"

    def scene(self, field, value, code):
        view = ("Viewpoint { position 0 0 2 fieldOfView .9 }\n" if self.perspective
                else f"OrthoViewpoint {{ position 0 0 2 fieldOfView {-self.far} {-self.far} {self.far} {self.far} }}\n")
        axis, angle = self.turn
        shade = "void PLUG_volume_shade(inout vec4 color, const in VolumeSample s) { color = " + code + "; }"
        return scene(
            view, NO_HEADLIGHT, f"Transform {{ rotation {axis[0]} {axis[1]} {axis[2]} {angle} children [\n",
            f"IsoSurfaceVolumeData {{ surfaceValues [ {value} ] voxels ImageTexture3D {{ url \"{field.name}\" }}\n"
            f"effects [ {effect(shade)} ] }} ] }}\n")

    def rays(self):
        """Six numbers each, in texture coordinates; directions are of length 1 in the box."""
        numbers = array.array("d")
        axis, angle = self.turn
        far = math.tan(0.45) if self.perspective else self.far
        columns = [rotate(axis, -angle, unit) for unit in ((1, 0, 0), (0, 1, 0), (0, 0, 1))]
        for row in range(self.pixels):
            y = far * (1 - (2 * row + 1) / self.pixels)
            for column in range(self.pixels):
                x = far * ((2 * column + 1) / self.pixels - 1)
                origin, way = ((0, 0, 2), (x, y, -1)) if self.perspective else ((x, y, 2), (0, 0, -1))
                length = math.hypot(*way)
                for vector, shift, scale in ((origin, 0.5, 1), (way, 0, 1 / length)):
                    numbers.extend(shift + scale * sum(columns[a][i] * vector[a] for a in range(3)) for i in range(3))
        return numbers


def cell_roots(plugray, field, value, rays):
    """Eight numbers a ray, see cell_roots.c; the program is in the same build as plugray."""
    program = os.path.join(os.path.dirname(plugray), "..", "tests", "scenes", "cell-roots")
    if not os.path.exists(program):
        raise CaseError(f"there is no {program}")
    with tempfile.NamedTemporaryFile() as file:
        array.array("d", (b / 255 for b in field.bytes)).tofile(file)
        file.flush()
        done = subprocess.run([program, file.name, *map(str, field.size), repr(value), repr(SLACK)],
                              input=rays.tobytes(), stdout=subprocess.PIPE, timeout=60, check=True)
    roots = array.array("d")
    roots.frombytes(done.stdout)
    return roots


class Comparison:
    """Of the places in a picture with those of the cells' cubics."""

    def __init__(self, field, rays, roots, picture):
        self.missed = self.false = self.unsure = self.hits = 0
        self.farthest = 0.0
        self.worst = []
        for i in range(len(roots) // 8):
            first, _, _, _, _, low, high, count = roots[8 * i : 8 * i + 8]
            *place, alpha = picture.values[4 * i : 4 * i + 4]
            self.unsure += count < 0
            self.hits += first < math.inf
            if alpha == 0:
                self.missed += high < math.inf
                continue
            origin, way = rays[6 * i : 6 * i + 3], rays[6 * i + 3 : 6 * i + 6]
            speed = math.hypot(*(w * n for w, n in zip(way, field.size)))
            t = sum((p - o) * w for p, o, w in zip(place, origin, way)) / sum(w * w for w in way)
            distance = max(low - t, t - high, 0.0) * speed if low < math.inf else math.inf
            self.false += distance == math.inf or t < low and distance > 0.1
            self.missed += distance < math.inf and t > high and distance > 0.1
            if distance <= 0.1:
                self.farthest = max(self.farthest, distance)
            elif len(self.worst) < 5:
                self.worst.append((i, t, low, high))
