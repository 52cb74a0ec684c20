"""The volumes and transfer functions that are measured, made anew on each machine.

A volume is bytes, x fastest; a transfer function is a list of points between which it is linear.
"""

import array
import collections
import hashlib
import math
import operator
import os
import random
import sys

Volume = collections.namedtuple("Volume", "name side kind top color opacity texels make")
# kind: the NRRD's type; top: the value that is 1 in the engine; texels: so many that every point of
# the functions is the centre of one

ML_COLOR = ((0, (0, 0, 1)), (0.5, (0.9, 0.8, 0.3)), (1, (1, 0.2, 0)))
ML_OPACITY = ((0, 0), (0.45, 0), (0.5, 0.6), (0.55, 0), (1, 0))
CT_COLOR = ((0, (0, 0, 0)), (70, (0.9, 0.6, 0.5)), (110, (0.8, 0.3, 0.25)), (150, (0.3, 0.5, 0.9)),
            (190, (1, 0.95, 0.85)), (255, (1, 1, 1)))
CT_OPACITY = ((0, 0), (50, 0), (70, 0.010), (90, 0.002), (120, 0.002), (150, 0.012), (175, 0.010),
              (200, 0.020), (215, 0.05), (230, 0.40), (255, 0.90))
SMOOTH_OPACITY = ((0, 0.002), (1, 0.06))
SPHERE_COLOR = ((0, (0.2, 0.4, 0.9)), (255, (1, 0.7, 0.2)))
SPHERE_OPACITY = ((0, 0), (85, 0), (170, 0.05), (255, 0.2))


# ---- Marschner and Lobb ----

def marschner_lobb(side):
    """The test signal of Marschner and Lobb (1994) with fM = 6, alpha = 0.25, on [-1,1]^3."""
    axis = [2 * i / (side - 1) - 1 for i in range(side)]
    rings = [0.25 * (1 + math.cos(12 * math.pi * math.cos(math.pi / 2 * math.hypot(x, y))))
             for y in axis for x in axis]
    values = array.array("f")
    for z in axis:
        sine = math.sin(math.pi / 2 * z)
        values.extend((1 - sine + ring) / 2.5 for ring in rings)
    return values.tobytes()


# ---- A head, as a scanner would see it ----

SHELLS = ((1, 70), (0.965, 95), (0.86, 200), (0.80, 110), (0.55, 150), (0.52, 60))
AXES = (0.80, 0.95, 0.88)  # of the outermost shell, half edges of the volume
SHEETS = (((0.62, 0.70, 0.35), 0.10), ((0.85, -0.30, 0.43), -0.15), ((0.55, 0.25, -0.80), 0.05))
SHEET_VALUE, SHEET_HALF = 230, 0.75   # voxels
WIRE_VALUE, WIRE_RADIUS = 255, 2      # voxels
WIRE_TURNS, WIRE_AROUND, WIRE_REACH = 7, 0.38, 0.55  # half edges
NOISE = 1.5


def mix(row, x, value, part):
    part = min(max(part, 0.0), 1.0)
    row[x] = round(row[x] + part * (value - row[x]))


def shell_row(row, half, rest):
    """What the shells make of a row whose other two coordinates give `rest` of the squared radius."""
    width = 1 / (half * sum(AXES) / 3)  # an edge is a voxel wide
    for radius, value in SHELLS:
        outer, inner = radius + width / 2, radius - width / 2
        if outer * outer <= rest:
            return
        reach = AXES[0] * half * math.sqrt(outer * outer - rest)
        full = AXES[0] * half * math.sqrt(max(inner * inner - rest, 0.0))
        first, last = math.ceil(half - reach), math.floor(half + reach)
        start, stop = math.ceil(half - full), math.floor(half + full)
        if inner * inner <= rest:
            start, stop = last + 1, last
        for x in (*range(first, start), *range(stop + 1, last + 1)):
            q = math.sqrt(((x - half) / (AXES[0] * half)) ** 2 + rest)
            mix(row, x, value, (radius - q) / width + 0.5)
        if stop >= start:
            row[start:stop + 1] = bytes((value,)) * (stop + 1 - start)


def sheet_row(row, half, y, z, rest):
    """Thin oblique sheets inside of the innermost bone."""
    room = 0.8 * 0.8 - rest
    if room <= 0:
        return
    reach = AXES[0] * half * math.sqrt(room)
    for normal, offset in SHEETS:
        length = math.hypot(*normal)
        a, b, c = (n / length for n in normal)
        plane = offset * half - b * (y - half) - c * (z - half)
        width = (SHEET_HALF + 0.5) / abs(a)
        low = max(plane / a - width, -reach)
        high = min(plane / a + width, reach)
        for x in range(math.ceil(half + low), math.floor(half + high) + 1):
            mix(row, x, SHEET_VALUE, SHEET_HALF + 0.5 - abs(a * (x - half) - plane))


def wire(side, half):
    """The voxels of a helix: place in the volume -> how much of them it fills."""
    found = {}
    count = round(4 * math.pi * WIRE_TURNS * WIRE_AROUND * half)
    reach = WIRE_RADIUS + 1
    for i in range(count + 1):
        t = i / count
        angle = 2 * math.pi * WIRE_TURNS * t
        centre = (half * (1 + WIRE_AROUND * math.cos(angle)), half * (1 + WIRE_AROUND * math.sin(angle)),
                  half * (1 + WIRE_REACH * (2 * t - 1)))
        corner = [math.floor(c) - reach + 1 for c in centre]
        for z in range(corner[2], corner[2] + 2 * reach):
            for y in range(corner[1], corner[1] + 2 * reach):
                for x in range(corner[0], corner[0] + 2 * reach):
                    part = WIRE_RADIUS + 0.5 - math.dist(centre, (x, y, z))
                    if part > 0:
                        at = (z * side + y) * side + x
                        found[at] = max(found.get(at, 0), part)
    return found


def head(side):
    half = (side - 1) / 2
    values = bytearray(side ** 3)
    for z in range(side):
        for y in range(side):
            rest = ((y - half) / (AXES[1] * half)) ** 2 + ((z - half) / (AXES[2] * half)) ** 2
            if rest > 1.1:
                continue
            row = bytearray(side)
            shell_row(row, half, rest)
            sheet_row(row, half, y, z, rest)
            start = (z * side + y) * side
            values[start:start + side] = row
    for at, part in wire(side, half).items():
        mix(values, at, WIRE_VALUE, part)
    return noisy(values)


def noisy(values):
    """Adds noise, and clamps."""
    dice = random.Random(1)
    reach = 8
    noise = bytes(min(max(round(dice.gauss(0, NOISE)), -reach), reach) + reach for _ in range(1 << 18))
    clamped = bytes(min(max(v - reach, 0), 255) for v in range(256 + 2 * reach))
    out = bytearray()
    for start in range(0, len(values), len(noise) // 2):
        part = values[start:start + len(noise) // 2]
        shift = dice.randrange(len(noise) // 2)
        out += bytes(map(clamped.__getitem__, map(operator.add, part, noise[shift:shift + len(part)])))
    return bytes(out)


# ---- Spheres in a void ----

def blocks_of(places, side):
    """The blocks of 8^3 voxels that a value other than 0 reaches, its neighbours' values included."""
    found = set()
    for x, y, z in places:
        found.update((i, j, k) for i in {(x - 1) // 8, (x + 1) // 8} for j in {(y - 1) // 8, (y + 1) // 8}
                     for k in {(z - 1) // 8, (z + 1) // 8} if min(i, j, k) >= 0 and max(i, j, k) < side // 8)
    return found


def ball(centre, radius, side):
    """Its voxels and their values: 255 inside, 0 outside, an edge of two voxels."""
    around = [range(max(0, math.ceil(c - radius - 1)), min(side, math.floor(c + radius + 1) + 1)) for c in centre]
    for z in around[2]:
        for y in around[1]:
            for x in around[0]:
                value = round(255 * min(max((radius + 1 - math.dist(centre, (x, y, z))) / 2, 0), 1))
                if value:
                    yield x, y, z, value


def spheres(side, occupied):
    """Spheres at random until this part of the blocks is occupied."""
    dice = random.Random(side + round(1000 * occupied))
    values = bytearray(side ** 3)
    blocks, wanted = set(), occupied * (side // 8) ** 3
    while len(blocks) < wanted:
        radius = dice.uniform(3, 7) if occupied < 0.5 else dice.uniform(2, 4)
        centre = [dice.uniform(0, side - 1) for _ in range(3)]
        voxels = list(ball(centre, radius, side))
        new = blocks_of((v[:3] for v in voxels), side) - blocks
        if len(new) > wanted - len(blocks) + 2:
            continue
        blocks |= new
        for x, y, z, value in voxels:
            at = (z * side + y) * side + x
            values[at] = max(values[at], value)
    return bytes(values)


# ---- Tables and files ----

def lobb_volume(side):
    return Volume(f"ml{side}", side, "float", 1, ML_COLOR, ML_OPACITY, 21, lambda: marschner_lobb(side))


def head_volume(side):
    return Volume(f"ct{side}", side, "uint8", 255, CT_COLOR, CT_OPACITY, 52, lambda: head(side))


def smooth_volume(side):
    """The same data under a function without edges: here plain steps are hard to beat."""
    return Volume(f"smooth{side}", side, "float", 1, ML_COLOR, SMOOTH_OPACITY, 21,
                  lambda: marschner_lobb(side))


def sphere_volume(side, percent):
    return Volume(f"spheres{percent}", side, "uint8", 255, SPHERE_COLOR, SPHERE_OPACITY, 4,
                  lambda: spheres(side, percent / 100))


def between(points, x):
    for (low, first), (high, second) in zip(points, points[1:]):
        if x <= high:
            part = (x - low) / (high - low)
            pair = (first, second) if isinstance(first, tuple) else ((first,), (second,))
            return [(1 - part) * a + part * b for a, b in zip(*pair)]
    raise ValueError(x)


def function_texels(volume):
    texels = array.array("f")
    for i in range(volume.texels):
        x = volume.top * i / (volume.texels - 1)
        texels.extend(between(volume.color, x) + between(volume.opacity, x))
    return texels.tobytes()


def write_nrrd(path, kind, sizes, values, more=()):
    lines = ["NRRD0004", f"type: {kind}", f"dimension: {len(sizes)}",
             "sizes: " + " ".join(map(str, sizes)), "encoding: raw", f"endian: {sys.byteorder}", *more]
    with open(path, "wb") as file:
        file.write("\n".join(lines).encode("ascii") + b"\n\n" + values)


def write(volume, folder):
    """Its data, as NRRD and bare, and its transfer function; what is there is kept."""
    path = os.path.join(folder, volume.name)
    if not os.path.exists(path + ".raw"):
        values = volume.make()
        write_nrrd(path + ".nrrd", volume.kind, (volume.side,) * 3, values,
                   ("min: 0", f"max: {volume.top}"))
        write_nrrd(path + "-function.nrrd", "float", (4, volume.texels, 1), function_texels(volume),
                   ("kinds: RGBA-color domain domain", "min: 0", "max: 1"))
        with open(path + ".part", "wb") as file:
            file.write(values)
        os.rename(path + ".part", path + ".raw")
    return path


def digest(volume, folder):
    with open(os.path.join(folder, volume.name + ".raw"), "rb") as file:
        return hashlib.sha256(file.read()).hexdigest()[:16]
