#!/usr/bin/env python3
"""Computes the small volumes of the examples: 8-bit NRRD files, compressed. Run without arguments; the
files that lie here are what it writes."""

import gzip
import math
import os

HERE = os.path.dirname(os.path.abspath(__file__))


def write(name, comment, size, value):
    """`value` of x, y, z in -1..1 gives 0..1."""
    data = bytearray()
    at = [(2 * i + 1) / size - 1 for i in range(size)]
    for z in at:
        for y in at:
            data += bytes(round(255 * min(max(value(x, y, z), 0.0), 1.0)) for x in at)
    header = (
        f"NRRD0004\n# {comment}\ntype: uint8\ndimension: 3\nsizes: {size} {size} {size}\n"
        "encoding: gzip\n\n"
    )
    with open(os.path.join(HERE, name), "wb") as file:
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


def empty(x, y, z):
    return 0.0


if __name__ == "__main__":
    write("orbital.nrrd", "hydrogen, 4f, m = 2: 1/2 is zero", 40, orbital)
    write("knot.nrrd", "a tube around a trefoil knot", 40, knot)
    write("grid.nrrd", "nothing: a grid for volumes that an effect computes", 64, empty)
