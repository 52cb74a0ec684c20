#!/usr/bin/env python3
"""V1, V3 and V9 once more, by labels: segments of one volume, each behind a transfer function of its own."""

import math

import analytic_truth as truth
from analytic_data import (BOUNDED, CELLS, EXACT, MIDPOINT, Case, Sheet, check_backends, check_case,
                           function_file, image3d, nrrd, oblique_box, opacity_map, ramp_value, sampled, table)
from analytic_page import Analytic
from analytic_rays import Box, Parallel, Perspective, Transform
from harness import over

suite = Analytic()

SIZE, REFERENCE = (5, 4, 6), 0.02
OUTER = Box((0.64, 0.5, 0.56), SIZE, place=oblique_box().place)  # to its sides: the outer half voxels, too
ONE, TWO = ((0.8, 0.2, 0.5), 4.0), ((0.3, 0.9, 0.1), 9.0)  # colour and extinction
BROWN, SLOPES = (0.7, 0.5, 0.2), (6.0, 14.0)


def labels_file(name, label):
    """`label` of a voxel's number along x, y, z."""
    w, h, d = SIZE
    return {name: nrrd(SIZE, [label(i, j, k) for k in range(d) for j in range(h) for i in range(w)])}


def parts(chord, borders, axis=2):
    """The ray between planes across an axis; and in which gap it lies."""
    at, slope = chord.entry[axis], chord.direction[axis]
    cuts = sorted(w for w in ((b - at) / slope for b in borders) if 0 < w < chord.length)
    ends = [0.0] + cuts + [chord.length]
    for start, end in zip(ends, ends[1:]):
        place = at + slope * 0.5 * (start + end)
        yield chord.at(start), chord.at(end), end - start, sum(place > b for b in borders)


def segmented_case(name, data, files, box, labels, functions, exact, fields="", **more):
    """`functions`: extinction and colour of values, one a segment."""
    files = {**files, **labels}
    maps = []
    for i, (extinction, color, texels) in enumerate(functions):
        map_ = f"{name.replace(' ', '-')}-{i}.nrrd"
        files[map_] = function_file(table(extinction, color, REFERENCE, texels))
        maps.append(opacity_map(map_))
    content = box.place.around(
        f"SegmentedVolumeData {{ dimensions {' '.join(map(str, box.dimensions))} voxels {data}\n"
        f"  segmentIdentifiers {image3d(next(iter(labels)))} valueRange 0 1 opacityUnitDistance {REFERENCE!r}\n"
        f"  renderStyle [ {' '.join(maps)} ] {box.fields()} {fields} }}\n")
    return Case(name, content, exact, box, files, **more)


def even(part):
    color, extinction = part
    return (lambda s: extinction, lambda s: color, 1)


def slab_case(name, pair, box=OUTER, fields="", hidden=None):
    """Two slabs: z below 0 and above."""
    def exact(chord):
        color = (0.0,) * 4
        for _, _, length, side in parts(chord, [0.0]):
            if side != hidden:
                color = over(color, truth.homogeneous(pair[side][1], pair[side][0], length))
        return color

    bound = max(pair[0][1], pair[1][1]) / 2  # half a step may count in the wrong slab, of another colour
    return segmented_case(name, image3d("even.nrrd"), {"even.nrrd": sampled(box, lambda place: 0.4)}, box,
                          labels_file("slabs.nrrd", lambda i, j, k: k // 3), list(map(even, pair)), exact, fields,
                          orders={MIDPOINT: BOUNDED, CELLS: EXACT}, bound=bound)


def cropped_case(side):
    """One slab, cropped where the other one, which is opaque, begins: not even a sliver of it is seen."""
    low, high = (0, 0, side / 2), (1, 1, (side + 1) / 2)
    box = Box(OUTER.dimensions, SIZE, low, high, OUTER.place)
    pair = [TWO if i == side else ((1, 0, 0), math.inf) for i in range(2)]
    return segmented_case(f"V1 one slab of two, cropped {('above', 'below')[side]}", image3d("even.nrrd"),
                          {"even.nrrd": sampled(box, lambda place: 0.4)}, box,
                          labels_file("slabs.nrrd", lambda i, j, k: k // 3), list(map(even, pair)),
                          lambda chord: truth.homogeneous(TWO[1], TWO[0], chord.length), orders={CELLS: EXACT})


def ramp_case():
    """Extinctions linear in a ramp, one slope a segment; three slabs across y, of labels 1 0 1."""
    box = oblique_box()
    borders = [box.own((0, 0.25, 0))[1], box.own((0, 0.75, 0))[1]]

    def exact(chord):
        color = (0.0,) * 4
        for start, end, length, gap in parts(chord, borders, 1):
            alpha = truth.linear_extinction(SLOPES[gap != 1])(ramp_value(start), ramp_value(end), length)
            color = over(color, tuple(c * alpha[1] for c in BROWN) + (alpha[1],))
        return color

    functions = [(lambda s, k=k: k * s, lambda s: BROWN, 4096) for k in SLOPES]
    return segmented_case("V3 linear extinction in segments", image3d("ramp.nrrd"),
                          {"ramp.nrrd": sampled(box, ramp_value)}, box,
                          labels_file("layers.nrrd", lambda i, j, k: int(j in (0, 3))), functions, exact,
                          orders={MIDPOINT: BOUNDED, CELLS: EXACT}, bound=abs(SLOPES[0] - SLOPES[1]) / 2,
                          tolerance={CELLS: 2e-5})


CASES = [slab_case("V9 two slabs of segments", (ONE, TWO)),
         slab_case("V9 two slabs of segments, swapped", (TWO, ONE)),
         slab_case("V9 two slabs of segments, one hidden", (ONE, TWO), fields="segmentEnabled [ FALSE ]", hidden=0),
         cropped_case(0), cropped_case(1), ramp_case()]
sheet = Sheet(suite, CASES, Parallel(0.5))
TILTED = Box(OUTER.dimensions, SIZE, place=Transform(translation=(0.02, 0.01, 0), rotation=(0.3, 1, -0.4, 1.1)))
FAR = [slab_case("V9 two slabs of segments, in perspective", (ONE, TWO), TILTED)]
perspective = Sheet(suite, FAR, Perspective(1.4, 0.35))


@suite.case
def V9_V3():
    "by labels"
    for drawn in (sheet, perspective):
        for case in drawn.cases:
            suite.title = case.name
            check_case(drawn, case)


@suite.case
def backends():
    "both backends"
    check_backends(sheet, 1 / 4, (MIDPOINT, CELLS))


suite.main(__name__)
