#!/usr/bin/env python3
"""V6 to V8, V12, V13: curved fields, computed and on grids; refinement of grids and of pixels."""

import math
import random

import analytic_truth as truth
from analytic_data import (BOUNDED, CELLS, HALVINGS, KINKED, MIDPOINT, OBLIQUE, PLANNED, TABLE, Sheet, add_cases,
                           check_backends, check_denser, check_order, grey, image3d, integrated,
                           mapped_case, offered)
from analytic_grid import Grid
from analytic_page import Analytic
from analytic_rays import Box, Parallel, Transform, centres, words
from analytic_shapes import (AXIS, BREADTH, CENTRE, MIDDLE, RADIUS, WIDTH, bell, exponential, nearest,
                             parabola)
from harness import dot
from scenes import effect

suite = Analytic()

DIMENSIONS = (0.64, 0.5, 0.56)
COARSE = [2 * s for s in HALVINGS]
VIEW = Parallel(0.5)
EVERY = {MIDPOINT: 2, TABLE: KINKED, CELLS: PLANNED}
ROUGH = {**EVERY, MIDPOINT: KINKED}

KAPPAS = {"V6": 25.0, "V7": 24.0, "V8b": 18.0, "V8a": 6.0}


def exponential_truth(chord):
    return truth.exponential(KAPPAS["V6"], WIDTH / dot(AXIS, chord.direction))(
        exponential(chord.entry), chord.length)


def bell_truth(chord, kappa=KAPPAS["V7"], centre=CENTRE, breadth=BREADTH):
    return truth.bell(kappa, breadth)(*nearest(chord, centre), chord.length)


def ball_truth(kappa, parabolic):
    return lambda chord: truth.ball(kappa, RADIUS, parabolic)(nearest(chord, MIDDLE)[0])


# ---- computed by an effect: an author's effect has its samples in the middle of steps

COMPUTED = """void PLUG_volume_sample(inout VolumeSample s)
{
    vec3 place = (s.position - 0.5) * vec3(%s);
    float r = length(place - middle);
    float value = 0.0;
    if (kind == 0)
        value = exp(-(dot(middle, place) + 0.45) / size);
    else if (kind == 1)
        value = exp(-0.5 * r * r / (size * size));
    else if (kind == 2)
        value = max(1.0 - r * r / (size * size), 0.0);
    else
        value = r < size ? 1.0 : 0.0;
    s.value = vec4(value);
}
uniform int kind;
uniform vec3 middle;
uniform float size;""" % words(DIMENSIONS).replace(" ", ", ")


def computed(name, kind, middle, size, kappa, exact, **more):
    box = Box(DIMENSIONS, (5, 4, 6), place=OBLIQUE)
    code = effect(COMPUTED, f"initializeOnly SFInt32 kind {kind} initializeOnly SFVec3f middle "
                            f"{words(middle)} initializeOnly SFFloat size {size}")
    return mapped_case(name + ", computed", image3d("any.nrrd"), {"any.nrrd": Grid(box, lambda p: 0.0).file()},
                       box, lambda s: kappa * s, lambda s: 1.0, lambda chord: grey(exact(chord)),
                       effects=code, **more)


FIELDS = [
    computed("V6 exponential", 0, AXIS, WIDTH, KAPPAS["V6"], exponential_truth, orders={MIDPOINT: 2}, steps=COARSE),
    computed("V7 bell", 1, CENTRE, BREADTH, KAPPAS["V7"], bell_truth,
             orders={MIDPOINT: 2}, steps=COARSE),
    # a step more or less may lie in the ball
    computed("V8 ball", 3, MIDDLE, RADIUS, KAPPAS["V8a"], ball_truth(KAPPAS["V8a"], False),
             orders={MIDPOINT: BOUNDED}, bound=KAPPAS["V8a"]),
    computed("V8 parabolic ball", 2, MIDDLE, RADIUS, KAPPAS["V8b"], ball_truth(KAPPAS["V8b"], True),
             orders={MIDPOINT: 2}, steps=COARSE),
]


# ---- on grids: the interpolant is a cubic in each cell, and integrated exactly


def gridded(name, grid, kappa, **more):
    def exact(chord):
        alpha = -math.expm1(-kappa * grid.integral(chord))
        return (alpha,) * 4

    # of midpoint: h^2/24 |s''|, and h^2/8 of each kink; of trapezoids, which a table makes, twice the first
    chords = filter(None, (grid.box.chord(VIEW.ray(x, y, 12)) for x in range(12) for y in range(12)))
    bound = kappa * max(curved / 12 + jumps / 8 for curved, jumps in map(grid.roughness, chords))
    file = name.split(",")[0].replace(" ", "-") + ".nrrd"
    return mapped_case(name, image3d(file), {file: grid.file()}, grid.box, lambda s: kappa * s,
                       lambda s: 1.0, exact, bound=bound, **more)


def cell(seed):
    """V12: eight voxels, drawn between their centres."""
    numbers = random.Random(seed)
    box = Box(DIMENSIONS, (2, 2, 2), *centres((2, 2, 2)), place=OBLIQUE)
    grid = Grid(box, values=[numbers.random() for _ in range(8)])
    return gridded(f"V12 cell {seed}", grid, 20.0, orders=EVERY)


def uneven(name, field, kappa):
    box = Box(DIMENSIONS, (6, 5, 7), place=OBLIQUE)
    return gridded(name + ", of voxels", Grid(box, field), kappa, orders=ROUGH)


GRIDS = [uneven("V6 exponential", exponential, KAPPAS["V6"]), uneven("V7 bell", bell, KAPPAS["V7"]),
         uneven("V8 parabolic ball", parabola, KAPPAS["V8b"]), *map(cell, range(1, 6))]


def half_texels(count):
    """V13: a row of voxels from 0 to 1, whose outer half texels have the value of their centres, seen
    along the row. The mean of s^2 is (2 N + 1) / (6 N)."""
    box = Box((1, 1, 1), (count, 1, 1), place=Transform(rotation=(0, 1, 0, math.pi / 2)))
    row = Grid(box, values=[i / (count - 1) for i in range(count)])
    alpha = -math.expm1(-3.0 * (2 * count + 1) / (6 * count))
    return mapped_case(f"V13 {count} voxels in a row", image3d(f"row{count}.nrrd"), {f"row{count}.nrrd": row.file()},
                       box, lambda s: 3 * s * s, lambda s: 1.0, lambda chord: (alpha,) * 4, bound=3 * count,
                       steps=[s * count / 16 for s in HALVINGS], orders={**ROUGH, TABLE: BOUNDED})


def denser(case, kappa):
    return gridded(case.name + ", denser", Grid(case.box, bell), kappa)


sheet = Sheet(suite, FIELDS, VIEW)
dense = denser(GRIDS[1], 1.2 * KAPPAS["V7"])
voxel_sheet = Sheet(suite, GRIDS + [dense], VIEW)
row_sheets = [Sheet(suite, [half_texels(n)], VIEW, pixels=8) for n in (2, 3, 5)]
add_cases(sheet, FIELDS)
add_cases(voxel_sheet, GRIDS)
for rows in row_sheets:
    add_cases(rows, rows.cases)


@suite.case
def opacity():
    "V7 more extinction is never more transparent"
    for method in offered(suite):
        check_denser(suite, method, *(voxel_sheet.picture(case, method, 1) for case in (GRIDS[1], dense)))


# ---- finer grids, finer pictures

SMOOTH = (0.03, -0.02, 0.05), 0.16, 10.0  # centre, breadth, kappa


def smooth_case(size, place=OBLIQUE):
    """A bell on voxels, cut to what lies between the centres of the coarsest."""
    centre, breadth, kappa = SMOOTH
    box = Box(DIMENSIONS, size, (0.2,) * 3, (0.8,) * 3, place)
    shares = [[math.exp(-(((i + 0.5) / count - 0.5) * side - c) ** 2 / (2 * breadth**2)) for i in range(count)]
              for count, side, c in zip(size, DIMENSIONS, centre)]
    grid = Grid(box, values=[x * y * z for z in shares[2] for y in shares[1] for x in shares[0]])
    return mapped_case(f"V7 bell of {size[0]}^3 voxels", image3d("bell.nrrd"), {"bell.nrrd": grid.file()}, box,
                       lambda s: kappa * s, lambda s: 1.0,
                       lambda chord: grey(bell_truth(chord, kappa, centre, breadth)))


@suite.case
def finer_grids():
    "V7 refinement of the grid"
    cases = [smooth_case((n,) * 3) for n in (3, 6, 12, 24, 48, 96)]
    step = 1 / 400
    for method in integrated(suite):
        errors, counts = [], []
        for case in cases:
            alone = Sheet(suite, [case], Parallel(0.4))
            errors.append(alone.error(case, method, step / case.box.voxel()))
            counts.append(alone.expected(case)[2] / step)
        check_order(suite, method, errors, counts, 2)


def between(picture, pixels, x, y):
    """Bilinear, at a place in fractions of the picture."""
    x, y = x * pixels - 0.5, y * pixels - 0.5
    i, j = math.floor(x), math.floor(y)
    return sum(picture.at(i + a, j + b)[3] * (x - i if a else i + 1 - x) * (y - j if b else j + 1 - y)
               for a in (0, 1) for b in (0, 1))


@suite.case
def finer_pixels():
    "V7 refinement of pixels"
    case = smooth_case((256, 256, 6), Transform())  # across the picture no kinks to be seen
    fine, view = 144, Parallel(0.3)
    sizes = (3, 6, 12, 24, 48)
    for method in integrated(suite):
        found = [Sheet(suite, [case], view, pixels=n).picture(case, method, 1) for n in (*sizes, fine)]
        bilinear, nearest = [], []
        for size, picture in zip(sizes, found):
            # places between the centres of the outermost pixels of the coarsest picture
            places = [(i, j) for i in range(fine // 6, fine * 5 // 6) for j in range(fine // 6, fine * 5 // 6, 7)]
            pairs = [(found[-1].at(i, j)[3], (i + 0.5) / fine, (j + 0.5) / fine) for i, j in places]
            bilinear.append(max(abs(a - between(picture, size, x, y)) for a, x, y in pairs))
            nearest.append(max(abs(a - picture.at(int(x * size), int(y * size))[3]) for a, x, y in pairs))
        check_order(suite, method, bilinear, [1] * len(sizes), 2, 4, "V7 refinement of pixels, bilinear")
        check_order(suite, method, nearest, [1] * len(sizes), 1, 4, "V7 refinement of pixels, nearest")


@suite.case
def backends():
    "both backends"
    for one in (sheet, voxel_sheet):
        check_backends(one, 1 / 4)


suite.main(__name__)
