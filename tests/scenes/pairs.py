#!/usr/bin/env python3
"""Effects compose: every pair of the examples' effects on one shape under two lights with two textures. Each
pair compiles, and each effect of it still does what its own assertion says: pairs.py PLUGRAY

One cell a pair, in several pictures: with both effects, with the one of the column alone, with the one of the row
alone, and with none. So cells differ by what one effect adds to the other and by nothing else, not even by
their places. Which of the two stands first in the list changes from cell to cell."""

import os
import sys

from harness import HEADER, Picture, Suite

EFFECTS = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "examples", "compositing", "effects")
EXAMPLES = os.path.realpath(os.path.join(EFFECTS, ".."))
CELL = 28  # pixels

suite = Suite()

# ---- What is measured: of the pixels of a cell, (r, g, b, a) each ----


def luminance(p):
    return 0.2126 * p[0] + 0.7152 * p[1] + 0.0722 * p[2]


def covered(cell):
    return [p for row in cell for p in row if p[3] > 0.5]


def mean(values):
    values = list(values)
    return sum(values) / len(values) if values else 0.0


def brightness(cell):
    return mean(luminance(p) for p in covered(cell))


def spread_of_hues(cell):
    """Deviation of red from blue over the cell: what is one tint all over has none."""
    differences = [p[0] - p[2] for p in covered(cell)]
    middle = mean(differences)
    return mean((d - middle) ** 2 for d in differences) ** 0.5


def part_of(cell, channel):
    """How much of the colour is in a channel."""
    return mean(p[channel] for p in covered(cell)) / max(1e-6, mean(sum(p[:3]) for p in covered(cell)))


def roughness(cell):
    """Mean difference of neighbours in brightness, over the brightness."""
    steps = [abs(luminance(row[i]) - luminance(row[i + 1])) for row in cell for i in range(len(row) - 1)
             if row[i][3] > 0.5 and row[i + 1][3] > 0.5]
    steps += [abs(luminance(a[i]) - luminance(b[i])) for a, b in zip(cell, cell[1:]) for i in range(len(a))
              if a[i][3] > 0.5 and b[i][3] > 0.5]
    return mean(steps) / max(1e-6, brightness(cell))


def changed(a, b, least=0.01):
    """Part of the pixels that both cells cover and that differ."""
    pairs = [(p, q) for ra, rb in zip(a, b) for p, q in zip(ra, rb) if p[3] > 0.5 and q[3] > 0.5]
    return mean(max(abs(x - y) for x, y in zip(p[:3], q[:3])) > least for p, q in pairs)


def levels(cell):
    """How many steps of brightness it takes to hold nine tenths of the pixels."""
    counts = {}
    pixels = covered(cell)
    for p in pixels:
        step = round(64 * max(p[:3]))
        counts[step] = counts.get(step, 0) + 1
    held, used = 0, 0
    for count in sorted(counts.values(), reverse=True):
        if held >= 0.9 * len(pixels):
            break
        held, used = held + count, used + 1
    return used


def rows_alternate(cell, plain):
    """Ratio of the rows that the scan lines darken to the others, compared with the plain cell."""
    def ratio(c):
        sums = [0.0, 0.0]
        for y, row in enumerate(c):
            for p in row:
                if p[3] > 0.5:
                    sums[(len(c) - 1 - y) // 2 % 2] += luminance(p)
        return sums[0] / max(1e-6, sums[1])
    return ratio(cell) / max(1e-6, ratio(plain))


# ---- Effects: the files, fields of their own, and what each does to a cell that has it not ----

BLUE = {"swap-channels", "fresnel"}  # what was red is blue
INVERTED = {"negative"}  # what is brighter before it is darker after it


def brighter(factor):
    """Brighter by at least this factor (darker where the partner turns brightness round after it)."""
    def test(with_it, without, partner):
        a, b = brightness(with_it), brightness(without)
        return a < b - 0.01 if partner in INVERTED else a > factor * b
    return test


def darker(factor):
    def test(with_it, without, partner):
        a, b = brightness(with_it), brightness(without)
        return a > b + 0.01 if partner in INVERTED else a < factor * b
    return test


def dimmed(with_it, without, _):
    return brightness(with_it) < 0.97 * brightness(without)  # the last step: nobody turns it round


def size_grows(with_it, without, _):
    return len(covered(with_it)) > 1.1 * len(covered(without))


def size_shrinks(with_it, without, _):
    return len(covered(with_it)) < 0.985 * len(covered(without))


def outline_moves(with_it, without, _):
    moved = sum((p[3] > 0.5) != (q[3] > 0.5) for ra, rb in zip(with_it, without) for p, q in zip(ra, rb))
    return moved > 0.05 * len(covered(without))


def changes_between(least, most):
    return lambda with_it, without, _: least < changed(with_it, without) < most


def paler(with_it, without, partner):
    return spread_of_hues(with_it) < 0.7 * spread_of_hues(without)


def towards(color):
    """Nearer to a colour on average."""
    def distance(c):
        return mean(sum((a - b) ** 2 for a, b in zip(p, color)) ** 0.5 for p in covered(c))
    return lambda with_it, without, _: distance(with_it) < 0.9 * distance(without)


def more_of(channel, by):
    def test(with_it, without, partner):
        difference = part_of(with_it, channel) - part_of(without, channel)
        return -difference > by if partner in INVERTED else difference > by
    return test


def fewer_levels(with_it, without, _):
    return levels(with_it) < levels(without)


def rougher(with_it, without, _):
    return roughness(with_it) > 1.05 * roughness(without)


def lines(with_it, without, _):
    return rows_alternate(with_it, without) < 0.9 or rows_alternate(with_it, without) > 1.1


def complementary(with_it, without, partner):
    """What was red of bricks is blue then (and the other way round where the partner made them blue)."""
    def red_over_blue(c):
        return mean(p[0] - p[2] for p in covered(c))
    change = red_over_blue(with_it) - red_over_blue(without)
    return change > 0.005 if partner in BLUE else change < -0.005


class Case:
    def __init__(self, name, test, vertex=None, fields=""):
        self.name, self.test, self.vertex, self.fields = name, test, vertex, fields

    def text(self):
        units = [("VERTEX", self.vertex)] if self.vertex else []
        if os.path.exists(os.path.join(EFFECTS, self.name + ".glsl")):
            units.append(("FRAGMENT", self.name + ".glsl"))
        parts = " ".join(f'EffectPart {{ type "{stage}" url "effects/{file}" }}' for stage, file in units)
        return f'Effect {{ language "GLSL" {self.fields} parts [ {parts} ] }}'


PLACE = "place.vert.glsl"
CASES = [
    Case("brightness", brighter(1.1)),
    Case("stripes", changes_between(0.15, 0.85), PLACE),
    Case("desaturate", paler),
    Case("vignette", dimmed),
    Case("twist", outline_moves, "twist.vert.glsl"),
    Case("inflate", size_grows, "inflate.vert.glsl"),
    Case("contours", changes_between(0.05, 0.9), PLACE, "initializeOnly SFFloat lines 2"),
    Case("halftone", rougher),
    Case("warm-light", brighter(1.03)),
    Case("dissolve", size_shrinks, PLACE),
    Case("swap-channels", more_of(2, 0.02)),
    Case("gloss", brighter(1.01)),
    Case("glow", more_of(1, 0.02)),
    Case("soot", darker(0.95), PLACE),
    Case("scroll", changes_between(0.1, 1.01)),
    Case("dents", changes_between(0.3, 1.01), PLACE),
    Case("depth-tint", towards((0.35, 0.5, 0.8)), "depth-tint.vert.glsl", "initializeOnly SFFloat start 2"),
    Case("scan-lines", lines),
    Case("negative", complementary),
    Case("toon", fewer_levels),
    Case("fresnel", brighter(1.02)),
]

# ---- Pictures ----


def shape(effects, x, y):
    material = "Material { diffuseColor 0.8 0.75 0.7 specularColor 0.1 0.1 0.1 ambientIntensity 0.3 }"
    bricks, snow = ('ImageTexture { url "textures/%s.png" }' % name for name in ("bricks", "snow"))
    textures = f"MultiTexture {{ texture [ {bricks} {snow} ] }}"
    return (f"Transform {{ translation {x} {y} 0 rotation 1 1 0 0.5 scale 0.4 0.4 0.4 children Shape {{ appearance Appearance {{ material {material} "
            f"texture {textures} effects [ {' '.join(e.text() for e in effects)} ] }} geometry USE K }} }}")


def picture(which):
    n = len(CASES)
    parts = [HEADER, 'EXTERNPROTO Knot [ ] "models/models.x3dv#Knot"\nNavigationInfo { headlight FALSE }\n',
             "DirectionalLight { direction -0.5 -0.6 -0.7 ambientIntensity 0.3 global TRUE }\n",
             f"PointLight {{ location {n / 4} {n} 20 color 0.7 0.8 1 intensity 0.4 radius 100 global TRUE }}\n",
             f"OrthoViewpoint {{ position 0 0 4 fieldOfView [ {-n / 2} {-n / 2} {n / 2} {n / 2} ] }}\n",
             "Switch { children Shape { geometry DEF K Knot { } } }\n"]
    for row in range(n):
        for column in range(row + 1):
            chosen = [CASES[k] for k in which(column, row)]
            parts.append(shape(chosen, column - n / 2 + 0.5, n / 2 - row - 0.5) + "\n")
    return "".join(parts)


def draw(which):
    """The picture, and what the program had to say of it."""
    folder = suite.new_folder()
    for name in ("effects", "models", "textures"):
        os.symlink(os.path.join(EXAMPLES, name), os.path.join(folder, name))
    size = CELL * len(CASES)
    result = suite.render(picture(which), "-o", "picture.npy", "--allow", EXAMPLES, size=f"{size}x{size}", folder=folder,
                          timeout=600)
    return Picture(os.path.join(folder, "picture.npy")), result.messages()


def cell(drawn, column, row):
    return [[drawn.at(x, y) for x in range(column * CELL, (column + 1) * CELL)]
            for y in range(row * CELL, (row + 1) * CELL)]


@suite.case
def every_pair():
    "every pair compiles, and both effects are seen in it"
    both, said = draw(lambda column, row: (column, row) if (column + row) % 2 else (row, column))
    suite.check("nothing to complain of", not said, *said)
    columns, _ = draw(lambda column, row: (column,))
    rows, _ = draw(lambda column, row: (row,))
    bare, _ = draw(lambda column, row: ())
    for row, second in enumerate(CASES):
        suite.check(f"{second.name} alone", second.test(cell(rows, row, row), cell(bare, row, row), ""))
        for column, first in enumerate(CASES[:row]):
            pair = cell(both, column, row)
            suite.check(f"{first.name} with {second.name}", first.test(pair, cell(rows, column, row), second.name))
            suite.check(f"{second.name} with {first.name}", second.test(pair, cell(columns, column, row), first.name))


suite.run()
