#!/usr/bin/env python3
"""Computes the small volumes of the examples: 8-bit NRRD files, compressed. Run without arguments; the
files that lie in the folders `data` of the examples are what it writes. A scene reads its own folder alone, so
that some lie in several."""

import gzip
import math
import os

HERE = os.path.dirname(os.path.abspath(__file__))


KINDS = {2: "2-vector", 3: "RGB-color"}


def byte(value):
    return round(255 * min(max(value, 0.0), 1.0))


VOLUMES = ("volumes/data",)
ALL = ("data", "volumes/data", "volumes/compositions/data")


def write(name, comment, size, value, components=1, folders=VOLUMES, low=(-1, -1, -1), high=(1, 1, 1)):
    """`value` of x, y, z from `low` to `high` gives a number from 0 to 1, or several."""
    data = bytearray()
    xs, ys, zs = ([a + (b - a) * (2 * i + 1) / (2 * size) for i in range(size)] for a, b in zip(low, high))
    for z in zs:
        for y in ys:
            for x in xs:
                found = value(x, y, z)
                data += bytes(map(byte, found)) if components > 1 else bytes([byte(found)])
    if components > 1:
        shape = (
            f"dimension: 4\nsizes: {components} {size} {size} {size}\n"
            f"kinds: {KINDS[components]} domain domain domain\n"
        )
    else:
        shape = f"dimension: 3\nsizes: {size} {size} {size}\n"
    header = f"NRRD0004\n# {comment}\ntype: uint8\n{shape}encoding: gzip\n\n"
    for folder in folders:
        with open(os.path.join(HERE, "..", folder, name), "wb") as file:
            file.write(header.encode() + gzip.compress(bytes(data), 9, mtime=0))


def orbital(x, y, z):
    """The 4f state of hydrogen with m = 2: its wave function is r^3 exp(-r/4) times xyz / r^3."""
    reach = 24
    x, y, z = x * reach, y * reach, z * reach
    r = math.sqrt(x * x + y * y + z * z)
    return 0.5 + 0.5 * x * y * z * math.exp(-r / 4) / 16.6


def knot(x, y, z):
    """A tube around a trefoil knot: 1 on its axis, falling off linearly."""
    best = 9.0
    for px, py, pz in KNOT:
        best = min(best, (x - px) ** 2 + (y - py) ** 2 + (z - pz) ** 2)
    return 1.0 - math.sqrt(best) / 0.36


def knot_point(t):
    return (
        0.27 * (math.sin(t) + 2 * math.sin(2 * t)),
        0.27 * (math.cos(t) - 2 * math.cos(2 * t)),
        0.36 * -math.sin(3 * t),
    )


KNOT = [knot_point(2 * math.pi * i / 240) for i in range(240)]


def negative(x, y, z):
    """The knot on a negative: 1 is nothing."""
    return 1.0 - max(0.0, knot(x, y, z) - 0.4) / 0.6


def turns(x, y, z):
    """The knot, and how far along the tube a place is."""
    nearest = min(range(240), key=lambda i: sum((a - b) ** 2 for a, b in zip((x, y, z), KNOT[i])))
    away = math.dist((x, y, z), KNOT[nearest])
    return 1.0 - away / 0.36, nearest / 239


def cells(x, y, z):
    """Eight balls that press against each other, 1 inside, with soft skins; and the number of the ball, 0 outside."""
    distances = [math.dist((x, y, z), c) for c in CELLS]
    cell = min(range(8), key=distances.__getitem__)
    others = min(d for i, d in enumerate(distances) if i != cell)
    inside = min((0.52 - distances[cell]) / 0.16, (others - distances[cell]) / 0.2)
    return inside, (cell + 1) / 255 if inside > 0 else 0.0


CELLS = [
    (0.42 * (2 * (i & 1) - 1), 0.42 * (2 * (i >> 1 & 1) - 1), 0.42 * (2 * (i >> 2) - 1)) for i in range(8)
]


def stains(x, y, z):
    """A cell in three stains: two kinds of fibres, which meet in places, and its body."""
    radius = math.sqrt(x * x + y * y + z * z)
    angle = math.atan2(y, x)
    ring = math.hypot(x, y)
    red = math.hypot(ring - 0.55, z - 0.25 * math.sin(3 * angle))
    green = math.hypot(ring - 0.55, z + 0.25 * math.sin(3 * angle))
    return 1.35 - red / 0.11, 1.35 - green / 0.11, (0.95 - radius) / 0.25


def empty(x, y, z):
    return 0.0


def octants():
    """The knot in eight parts, x changing fastest, and the whole in the size of one."""
    for i in range(8):
        low = [(i >> axis & 1) - 1 for axis in range(3)]
        write(f"knot-{i}.nrrd", f"an eighth of the knot, finer: {low}", 24, knot, 1, VOLUMES, low, [a + 1 for a in low])
    write("knot-coarse.nrrd", "the knot, coarse", 12, knot)


if __name__ == "__main__":
    write("orbital.nrrd", "hydrogen, 4f, m = 2: 1/2 is zero", 40, orbital, folders=ALL)
    write("knot.nrrd", "a tube around a trefoil knot", 40, knot, folders=ALL)
    write("grid.nrrd", "nothing: a grid for volumes that an effect computes", 64, empty, folders=("data",))
    write("negative.nrrd", "a knot: 1 is nothing", 40, negative)
    write("negative-half.nrrd", "the same, half the size", 20, negative)
    write("turns.nrrd", "a knot, and how far along it", 40, turns, 2)
    write("cells.nrrd", "eight cells, and their numbers", 40, cells, 2)
    write("stains.nrrd", "a cell in three stains", 40, stains, 3)
    octants()
