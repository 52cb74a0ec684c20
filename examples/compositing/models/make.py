#!/usr/bin/env python3
"""Makes models.x3dv, anew and always the same: make.py [FILE]"""

import math
import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "textures"))
from draw import turbulence  # noqa: E402


def numbers(rows, digits=3):
    def short(value):
        text = f"{value:.{digits}f}".rstrip("0").rstrip(".")
        return "0" if text == "-0" else text
    lines = [", ".join(" ".join(short(v) for v in row) for row in rows[i:i + 6]) for i in range(0, len(rows), 6)]
    return ",\n      ".join(lines)


def proto(name, what, body):
    return f"# {what}\nPROTO {name} [ ] {{\n{body}}}\n"


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def unit(v):
    length = math.sqrt(sum(c * c for c in v))
    return tuple(c / length for c in v)


# ---- A trefoil knot as a tube ----

ALONG, AROUND = 120, 16


def knot_center(u):
    t = 2 * math.pi * u
    r = 2 + math.cos(3 * t)
    return (0.36 * r * math.cos(2 * t), 0.36 * r * math.sin(2 * t), 0.36 * 1.2 * math.sin(3 * t))


def knot_point(u, v):
    c = knot_center(u)
    d = unit([b - a for a, b in zip(knot_center(u - 1e-4), knot_center(u + 1e-4))])
    side = unit(cross(d, unit(c)))
    up = cross(side, d)
    a = 2 * math.pi * v
    n = tuple(math.cos(a) * s + math.sin(a) * w for s, w in zip(side, up))
    return tuple(p + 0.24 * q for p, q in zip(c, n)), n


def knot():
    points, normals, coords, index = [], [], [], []
    for i in range(ALONG + 1):
        for j in range(AROUND + 1):
            p, n = knot_point(i / ALONG, j / AROUND)
            points.append(p)
            normals.append(n)
            coords.append((8 * i / ALONG, j / AROUND))
    row = AROUND + 1
    for i in range(ALONG):
        for j in range(AROUND):
            a = i * row + j
            index += [(a, a + row + 1, a + 1), (a, a + row, a + row + 1)]
    return proto("Knot", "A trefoil knot, two wide, with texture coordinates along and around the tube.",
                 f"""  IndexedTriangleSet {{
    solid FALSE
    index [ {' '.join(str(k) for t in index for k in t)} ]
    coord Coordinate {{ point [
      {numbers(points)} ] }}
    normal Normal {{ vector [
      {numbers(normals, 2)} ] }}
    texCoord TextureCoordinate {{ point [
      {numbers(coords)} ] }}
  }}
""")


# ---- Mountains ----

GRID = 80


def height(i, j):
    u, v = i / GRID, j / GRID
    ridge = 1 - abs(2 * turbulence(u * 0.49, v * 0.49, 8, 5, 3) - 1)
    hill = max(0.0, 1 - 2.1 * math.hypot(u - 0.55, v - 0.42))
    return 1.15 * max(0.0, (ridge - 0.55) * 1.6) * (0.35 + 0.9 * hill) + 0.35 * hill * hill


def terrain():
    heights = [[height(i, j)] for j in range(GRID + 1) for i in range(GRID + 1)]
    return proto("Mountains", "Mountains of four by four, about one high.",
                 f"""  ElevationGrid {{
    xDimension {GRID + 1} zDimension {GRID + 1} xSpacing {4 / GRID} zSpacing {4 / GRID}
    creaseAngle 3.2 solid FALSE
    height [
      {numbers(heights)} ]
  }}
""")


# ---- A flower ----


def flower():
    points, colors, index = [], [], []

    def add(point, color):
        points.append(point)
        colors.append(color)
        return len(points) - 1

    stem, leaf = (0.16, 0.36, 0.08), (0.24, 0.50, 0.12)
    rows = []
    for k in range(5):
        y = 0.9 * k / 4
        rows.append((add((-0.012, y, 0), stem), add((0.012, y, 0), leaf)))
    for (a, b), (c, d) in zip(rows, rows[1:]):
        index += [(a, b, d), (a, d, c)]
    for side, y in ((1, 0.22), (-1, 0.36)):
        a, b, c = add((0, y, 0), stem), add((side * 0.13, y + 0.14, 0.05), leaf), add((0, y + 0.12, 0), leaf)
        index.append((a, b, c))
    middle = add((0, 0.93, 0.03), (0.95, 0.70, 0.10))
    count = 6
    for k in range(count):
        a = 2 * math.pi * k / count
        tip, half = 0.17, math.pi / count
        left = add((0.10 * math.sin(a - half * 0.8), 0.93 + 0.10 * math.cos(a - half * 0.8), 0.045), (1, 1, 1))
        end = add((tip * math.sin(a), 0.93 + tip * math.cos(a), 0.0), (0.92, 0.92, 0.92))
        right = add((0.10 * math.sin(a + half * 0.8), 0.93 + 0.10 * math.cos(a + half * 0.8), 0.045), (1, 1, 1))
        index += [(middle, left, end), (middle, end, right)]
    return proto("Flower", "A flower one high: stem, two leaves, six petals that are white.",
                 f"""  IndexedTriangleSet {{
    solid FALSE normalPerVertex TRUE
    index [ {' '.join(str(k) for t in index for k in t)} ]
    coord Coordinate {{ point [
      {numbers(points)} ] }}
    color Color {{ color [
      {numbers(colors, 2)} ] }}
  }}
""")


if __name__ == "__main__":
    target = sys.argv[1] if len(sys.argv) > 1 else os.path.join(os.path.dirname(os.path.abspath(__file__)), "models.x3dv")
    with open(target, "w") as file:
        file.write("#X3D V4.0 utf8\nPROFILE Immersive\n# Made by make.py.\n" + knot() + terrain() + flower())
