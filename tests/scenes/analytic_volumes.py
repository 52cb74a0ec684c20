#!/usr/bin/env python3
"""V12 and V17 to V19: several volumes, early ends of rays, transformed boxes, eyes and surfaces inside."""

import math
import os
import random
import sys

import analytic_truth as truth
from analytic_data import (CELLS, EXACT, HALVINGS, KINKED, MIDPOINT, OBLIQUE, TABLE, Case, Sheet, add_cases,
                           check_backends, check_bounded, check_planned, function_file, greatest_error, image3d,
                           integrated, mapped_case, offered, on_ramp, opacity_map, ramp_value, sampled, table)
from analytic_grid import Grid
from analytic_page import Analytic
from analytic_rays import Box, Parallel, Perspective, Transform, centres
from harness import over
from scenes import constant, quad, volume

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "reference"))
import reference as raycaster

suite = Analytic()
raycaster.beside(sys.argv[1])

DIMENSIONS = (0.64, 0.5, 0.56)
ALWAYS = dict.fromkeys((MIDPOINT, TABLE, CELLS), EXACT)
SECOND = {MIDPOINT: 2, TABLE: 2}
VIEW = Parallel(0.5)


# ---- V17: volumes that overlap mix as physics does: extinctions add up, colours weigh as they do

ONE, TWO = ((0.9, 0.5, 0.2), 3.0), ((0.1, 0.3, 0.8), 5.0)  # colour and extinction
APART = Transform(translation=(0.06, -0.09, 0.21), rotation=(1, 2, 0.5, 0.5))


def homogeneous(box, color, extinction):
    """A volume of one colour; its voxels have sides of their own."""
    name = f"function-{extinction:g}.nrrd"
    files = {name: function_file(table(lambda s: extinction, lambda s: color, 0.1, 1))}
    text = volume(constant(100, box.size), opacity_map(name), "", f"opacityUnitDistance .1 {box.fields()}",
                  box.dimensions)
    return box.place.around(text), files


def mixed_truth(boxes, parts):
    """Of a ray through several homogeneous boxes: between two borders nothing changes."""
    def exact(ray):
        chords = [(box.chord(ray), part) for box, part in zip(boxes, parts)]
        chords = [(chord, part) for chord, part in chords if chord]
        borders = sorted({t for chord, _ in chords for t in (chord.distance, chord.end())})
        color = (0.0,) * 4
        for start, end in zip(borders, borders[1:]):
            here = [part for chord, part in chords if chord.distance <= start and end <= chord.end()]
            total = sum(extinction for _, extinction in here)
            if total:
                mean = [sum(c[i] * e for c, e in here) / total for i in range(3)]
                color = over(color, truth.homogeneous(total, mean, end - start))
        return color

    return exact


class Rays:
    """Stands for a box where the truth is that of a whole ray."""

    def __init__(self, box):
        self.box, self.voxel = box, box.voxel

    def chord(self, ray):
        chord = self.box.chord(ray)
        if chord:
            chord.ray = ray
        return chord


def mixed_case(name, boxes, parts, order=(0, 1)):
    pieces = [homogeneous(box, *part) for box, part in zip(boxes, parts)]
    exact = mixed_truth(boxes, parts)
    return Case(name, "".join(pieces[i][0] for i in order), lambda chord: exact(chord.ray), Rays(boxes[0]),
                {k: v for _, files in pieces for k, v in files.items()}, ALWAYS, (1, 1 / 8))


def turned_box(size, place=OBLIQUE):
    return Box(DIMENSIONS, size, place=place)


SAME = [turned_box((3, 2, 4)), turned_box((3, 2, 4))]
FINER = [turned_box((3, 2, 4)), turned_box((31, 23, 40))]
HALF = [turned_box((3, 2, 4)), turned_box((5, 4, 3), APART)]
MIXED = [mixed_case("V17 two volumes in one box", SAME, (ONE, TWO)),
         mixed_case("V17 one of them of small voxels", FINER, (ONE, TWO)),
         mixed_case("V17 half overlapping", HALF, (ONE, TWO)),
         mixed_case("V17 half overlapping, listed the other way", HALF, (ONE, TWO), (1, 0)),
         mixed_case("V17 half overlapping, swapped", HALF, (TWO, ONE))]


def ramps_case():
    """One is white and denser the deeper, the other one black and thinner: tau is constant in all."""
    size = (5, 4, 6)
    box = Box(DIMENSIONS, size, *centres(size), OBLIQUE)
    up = mapped_case("V17 up", image3d("ramp.nrrd"), {"ramp.nrrd": sampled(box, ramp_value)}, box,
                     lambda s: 12 * s, lambda s: 1.0, None)
    down = mapped_case("V17 down", image3d("ramp.nrrd"), {}, box, lambda s: 12 * (1 - s), lambda s: 0.0, None)

    def exact(chord):
        s0, s1, length = on_ramp(chord)
        # C tau = 12 s in all, tau = 12: the integral of s T by parts
        through = math.exp(-12 * length)
        slope = (s1 - s0) / length
        bright = s0 - s1 * through + slope / 12 * (1 - through)
        return (bright,) * 3 + (1 - through,)

    return Case("V17 ramps against each other", up.content + down.content, exact, box,
                {**up.files, **down.files}, SECOND)


mixed = Sheet(suite, MIXED, VIEW)
add_cases(mixed, MIXED)
ramps = Sheet(suite, [ramps_case()], VIEW)
add_cases(ramps, ramps.cases)


@suite.case
def listed():
    "V17 the order of volumes in the file says nothing"
    for method in offered(suite):
        for step in (1, 1 / 8):
            pair = [mixed.picture(MIXED[i], method, step).values.tobytes() for i in (2, 3)]
            suite.check(f"{method}, step {step}: alike to the bit", pair[0] == pair[1])


# ---- V18: rays that end early

SLABS = (0.5, 0.95, 0.99, 0.996, 0.9985, 0.9999)
LEFT = 1 / 8 / 255  # what a ray may leave unseen: an eighth of the error


def black_case(opacity):
    """A black slab of a given opacity before something white."""
    box = Box((0.9, 0.9, 0.5), (2, 2, 4))
    extinction = -math.log(1 - opacity) / 0.5
    white = "Transform { translation 0 0 -.4 children " + quad("UnlitMaterial { emissiveColor 1 1 1 }") + "}\n"
    case = mapped_case(f"V18 opacity {opacity}", constant(100, box.size), {}, box, lambda s: extinction,
                       lambda s: 0.0, lambda chord: (1 - opacity,) * 3 + (1.0,), texels=1)
    case.content += white
    return case


@suite.case
def V18():
    "V18 early ends: what is left away is no more than an eighth of 1/255"
    sheet = Sheet(suite, [black_case(a) for a in SLABS], VIEW, pixels=8)
    for method in offered(suite):
        for case, opacity in zip(sheet.cases, SLABS):
            picture = sheet.picture(case, method, 1 / 16)
            seen = [v for i, v in enumerate(picture.values) if i % 4 < 3]
            worst = max(abs(v - (1 - opacity)) for v in seen)
            allowed = LEFT if 1 - opacity < LEFT else 2e-6
            suite.result(case.name, method, f"at most {allowed:.1e}", f"{worst:.1e}", worst <= allowed)


# ---- V19: boxes anywhere, the eye and surfaces inside

KAPPA, COLOR = 5.0, (0.9, 0.5, 0.2)


def placed_case(name, place, dimensions=DIMENSIONS, span=None, behind=None, content="", kappa=KAPPA,
                reference=0.02):
    """A ramp; lengths for its extinction are its own, whatever the place does to its shape."""
    size = (5, 4, 6)
    box = Box(dimensions, size, *centres(size), place, span)

    def value(position):
        return 0.5 + 0.8 * sum(w * x / d for w, x, d in zip((0.3, -0.25, 0.45), position, dimensions))

    def exact(chord):
        s0, s1 = value(chord.entry), value(chord.at(chord.length))
        alpha = truth.linear_extinction(kappa)(s0, s1, chord.length)[1]
        color = tuple(alpha * c for c in COLOR) + (alpha,)
        return over(color, behind) if behind else color

    file = f"placed-{name.replace(' ', '-')}.nrrd"
    case = mapped_case(f"V19 {name}", image3d(file), {file: sampled(box, value)}, box, lambda s: kappa * s,
                       lambda s: COLOR, exact, reference, orders={**ALWAYS, TABLE: KINKED if kappa == KAPPA else EXACT}, bound=0.5, steps=(1, 0.1),
                       tolerance={TABLE: 2e-5, CELLS: 2e-5})
    case.content += content
    case.beside = behind or case.beside
    return case


TURN = (1, 2, 0.5, 0.5)
SHEAR = Transform(scale=(1.4, 0.6, 1), rotation=(0, 1, 1, 0.6))  # and what is turned inside of it is sheared
PLACES = {
    "turned": Transform(rotation=TURN),
    "sheared": Transform(rotation=TURN, inside=SHEAR),
    "mirrored": Transform(rotation=TURN, scale=(-1, 1, 1)),
    "mirrored and stretched": Transform(rotation=TURN, scale=(0.8, -1.3, 0.5), inside=SHEAR),
    "moved": Transform(translation=(0.1, -0.07, 0.3), rotation=TURN),
    "through two scales": Transform(rotation=TURN, scale=(1e3,) * 3, inside=Transform(scale=(1e-3,) * 3)),
}
EYE = Perspective(1.1, 0.5)
BEHIND = (0.2, 0.6, 0.4, 1.0)


def until_plane(origin, direction):
    """An opaque plane at z = 0.03."""
    return 0.0, (0.03 - origin[2]) / direction[2]


def from_near(origin, direction):
    return 1.13 / -direction[2], math.inf


SURFACE = ("Transform { translation 0 0 .03 scale 4 4 1 children "
           + quad("UnlitMaterial { emissiveColor .2 .6 .4 }") + "}\n")
placed = Sheet(suite, [placed_case(name, place) for name, place in PLACES.items()]
               + [placed_case("1 to 1000", Transform(rotation=TURN, scale=(1, 1, 1e-3)), (0.6, 0.5, 500.0),
                              kappa=0.01, reference=1.0),
                  placed_case("a surface inside", PLACES["turned"], span=until_plane, behind=BEHIND, content=SURFACE),
                  placed_case("a surface inside what is sheared", PLACES["sheared"], span=until_plane, behind=BEHIND,
                              content=SURFACE)], EYE)
add_cases(placed, placed.cases)

SIDES = {"front": (0, 1, 0, 0.2), "right": (0, 1, 0, 1.5), "left": (0, 1, 0, -1.4), "back": (0, 1, 0, 3.0),
         "top": (1, 0, 0, 1.5), "bottom": (1, 0, 0, -1.7)}
inside = Sheet(suite, [placed_case(f"eye inside, {name}", Transform(rotation=turn)) for name, turn in SIDES.items()]
               + [placed_case("eye inside what is sheared", PLACES["sheared"])], Perspective(0.07, 1.2))
add_cases(inside, inside.cases)
for scale in (1e-4, 1e4):
    near = Sheet(suite, [placed_case(f"all {scale:g} times as large", Transform(rotation=TURN, scale=(scale,) * 3))],
                 Perspective(1.1 * scale, 0.5))
    add_cases(near, near.cases)


class Cut(Perspective):
    """With a near plane inside of the box."""

    def text(self, fields=""):
        return super().text("nearDistance 1.13")


cut = Sheet(suite, [placed_case("near plane inside", PLACES["turned"], span=from_near),
                    placed_case("near plane inside what is sheared", PLACES["sheared"], span=from_near)],
            Cut(1.1, 0.5))
add_cases(cut, cut.cases)

# ---- V12 and whatever chance makes, against the raycaster in double precision

def random_places(seed):
    """Random voxels behind a random function, from somewhere in perspective."""
    numbers = random.Random(seed)
    size = (2, 2, 2) if seed < 4 else tuple(numbers.randint(1, 7) for _ in range(3))
    dimensions = tuple(numbers.uniform(0.5, 0.9) for _ in range(3))
    turn = tuple(numbers.uniform(-1, 1) for _ in range(3)) + (numbers.uniform(0, 3),)
    # far from opaque: where the extinction of the default ramp has no bound, no order holds
    values = [0.8 * numbers.random() for _ in range(math.prod(size))]
    texels = [tuple(numbers.random() for _ in range(3)) + (0.7 * numbers.random(),)
              for _ in range(numbers.randint(2, 9))]
    return size, dimensions, turn, values, texels if seed % 2 else None


def random_case(seed):
    size, dimensions, turn, values, texels = random_places(seed)
    box = Box(dimensions, size, place=Transform(rotation=turn))
    data = Grid(box, values=values)
    name = f"random-{seed}.nrrd"
    files = {name: data.file()}
    if texels:
        files[f"function-{seed}.nrrd"] = function_file(texels)
    content = box.place.around(volume(
        image3d(name), opacity_map(f"function-{seed}.nrrd") if texels else "", "",
        "valueRange 0 1 opacityUnitDistance .2", dimensions))
    case = Case(f"V12 random volume {seed}, against the reference", content, None, box, files)
    case.job = raycaster.volume(size, list(data.values), "f32", dimensions=dimensions, value_range=(0, 1),
                                matrix=raycaster.transform(rotation=turn), opacity_unit=0.2,
                                transfer=raycaster.texels(texels) if texels else None)
    return case


@suite.case
def V12():
    "V12 against the reference"
    sheet = Sheet(suite, [random_case(seed) for seed in range(10)], EYE)
    camera = raycaster.camera(position=(0, 0, EYE.distance), fieldOfView=EYE.angle)
    for case in sheet.cases:
        true, bars = raycaster.truth([case.job], camera, (sheet.pixels, sheet.pixels))
        colors = [true.data[i:i + 4] for i in range(0, len(true.data), 4)]
        suite.check(f"{case.name}: the reference is sure", max(bars.data) < 1e-6, max(bars.data))
        check_planned(sheet, case, colors, case.name)
        for method in integrated(suite):
            errors = [greatest_error(sheet.picture(case, method, step), colors) for step in HALVINGS]
            # in voxels: the square of a step, less at the kinks between them
            check_bounded(suite, method, errors, HALVINGS, [5 / s for s in HALVINGS], 1.0, KINKED, case.name)


@suite.case
def backends():
    "both backends"
    for one in (mixed, ramps, placed, inside):
        check_backends(one, 1)


suite.main(__name__)
