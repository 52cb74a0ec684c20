#!/usr/bin/env python3
"""V1 to V5 and V9 to V11: constant volumes and ramps behind transfer functions, by every method."""

import math

import analytic_truth as truth
from analytic_data import (BOUNDED, CELLS, EXACT, HALVINGS, KINKED, MIDPOINT, PLANNED, TABLE, Sheet,
                           add_cases, check_backends, check_denser, check_exact, greatest_error, image3d, is_physical,
                           mapped_case, oblique_box, offered, on_ramp, ramp_case, sampled)
from analytic_page import Analytic
from analytic_rays import Box, Parallel

suite = Analytic()

EVERY = {MIDPOINT: 2, TABLE: 2, CELLS: PLANNED}
ALWAYS = dict.fromkeys(EVERY, EXACT)
# Integrals over a value are read from a table: what floats make of small differences in it.
READ = {TABLE: 2e-5, CELLS: 2e-5}

# ---- V1, V2: a constant volume

COLOR = (0.9, 0.5, 0.2)
EXTINCTIONS = (0.01, 0.3, 3.0, 10.0, math.inf)


def constant_case(extinction):
    box = Box((0.64, 0.5, 0.56), (3, 2, 4), place=oblique_box().place)
    return mapped_case(
        f"V1 extinction {extinction:g}", image3d("constant.nrrd"),
        {"constant.nrrd": sampled(box, lambda place: 0.4)}, box, lambda s: extinction, lambda s: COLOR,
        lambda chord: truth.homogeneous(extinction, COLOR, chord.length), reference=0.1, texels=1,
        orders=ALWAYS)


# ---- V3 to V5, V11: smooth functions on a ramp

LINEAR, BOTH, MANUFACTURED, WAVES = 6.0, 24.0, (9.0, 2.0), (4.0, 3)


def wave_case(name, kappa, q, **more):
    return ramp_case(name, lambda s: kappa * (1 + math.cos(2 * math.pi * q * s)), lambda s: 1.0,
                     truth.waves(kappa, q), **more)


def both_case(name, kappa, **more):
    return ramp_case(name, lambda s: kappa * s, lambda s: s, truth.linear_both(kappa), **more)


def manufactured_case(a, k):
    return ramp_case("V5 manufactured solution", lambda s: a / (1 + a * s), lambda s: (1 + a * s) ** -k,
                     truth.manufactured(a, k), steps=[1.4 * s for s in HALVINGS],
                     orders={**EVERY, TABLE: BOUNDED}, bound=0.1)


# ---- V9, V10: functions that jump, within a texel

ONE, TWO = (0.8, 4.0), (0.3, 9.0)  # colour and extinction
BAND = (1800, 1900)                # texels; the function falls to 0 within the next ones
DEEP = 45.0


def slab_case(name, first, second):
    # half a step may count on the wrong side of the jump
    return ramp_case(name, lambda s: (first if s < 0.5 else second)[1],
                     lambda s: (first if s < 0.5 else second)[0], truth.two_slabs(first, second),
                     orders={MIDPOINT: BOUNDED, TABLE: BOUNDED, CELLS: PLANNED}, bound=abs(first[1] - second[1]) / 2)


def sheet_case():
    low, high = ((texel - side) / 4095 for texel, side in zip(BAND, (0.5, -0.5)))
    # a sheet is as deep for any step, if it is met; what shines through it is about a half
    return ramp_case("V10 thin sheet", lambda s: DEEP if low < s < high else 0.0, lambda s: 1.0,
                     truth.thin_sheet(DEEP, low, high), reference=0.002, bound=DEEP / 2,
                     steps=[s / 4 for s in HALVINGS],
                     orders={MIDPOINT: BOUNDED, TABLE: BOUNDED, CELLS: PLANNED})


CASES = [
    *map(constant_case, EXTINCTIONS),
    ramp_case("V3 linear extinction", lambda s: LINEAR * s, lambda s: 1.0,
              truth.linear_extinction(LINEAR), orders={**ALWAYS, TABLE: KINKED}, bound=1, tolerance=READ),
    both_case("V4 linear extinction and colour", BOTH, orders=EVERY),
    manufactured_case(*MANUFACTURED),
    slab_case("V9 two slabs", ONE, TWO),
    slab_case("V9 two slabs, swapped", TWO, ONE),
    sheet_case(),
    wave_case("V11 waves", *WAVES, orders={MIDPOINT: 2, TABLE: KINKED, CELLS: PLANNED}, bound=20),
]
DENSER = [both_case("V4 denser", 1.2 * BOTH), wave_case("V11 denser", 1.2 * WAVES[0], WAVES[1])]
VIEW = Parallel(0.5)
sheet = Sheet(suite, CASES + DENSER, VIEW)


def named(name):
    return next(case for case in sheet.cases if case.name.startswith(name))


@suite.case
def closed_forms():
    "closed forms: as quadrature finds them"
    for chord in (named("V3").box.chord(VIEW.ray(x, 5, 12)) for x in (3, 8)):
        s0, s1, length = on_ramp(chord)
        slope = (s1 - s0) / length
        a, k = MANUFACTURED
        for name, extinction, color, found in (
            ("V3", lambda s: LINEAR * s, lambda s: 1, truth.linear_extinction(LINEAR)),
            ("V4", lambda s: BOTH * s, lambda s: s, truth.linear_both(BOTH)),
            ("V5", lambda s: a / (1 + a * s), lambda s: (1 + a * s) ** -k, truth.manufactured(a, k)),
            ("V9", lambda s: (ONE, TWO)[s > 0.5][1], lambda s: (ONE, TWO)[s > 0.5][0],
             truth.two_slabs(ONE, TWO)),
            ("V10", lambda s: DEEP if 0.41 < s < 0.44 else 0, lambda s: 1, truth.thin_sheet(DEEP, 0.41, 0.44)),
            ("V11", lambda s: 4 * (1 + math.cos(6 * math.pi * s)), lambda s: 1, truth.waves(4, 3)),
        ):
            breaks = [(s - s0) / slope for s in (0.41, 0.44, 0.5)]
            expected = truth.integrated(lambda t, f=extinction: f(s0 + slope * t),
                                        lambda t, f=color: f(s0 + slope * t), length, breaks, parts=8)
            suite.close(f"{name}, length {length:.2f}", found(s0, s1, length), expected, 1e-10)


add_cases(sheet, CASES)


few = Sheet(suite, CASES[:len(EXTINCTIONS)], VIEW)
BACKGROUND = (0.2, 0.6, 0.4)
behind = Sheet(suite, few.cases, VIEW, head=f"Background {{ skyColor {' '.join(map(str, BACKGROUND))} }}\n")


@suite.case
def V1_any_step():
    "V1 one step, or a thousand"
    for method in offered(suite):
        errors, counts = [], []
        for case in few.cases:
            for step in (50, 1 / 320)[method == CELLS:]:
                counts.append(few.counts(case, [step])[0])
                errors.append(few.error(case, method, step))
        check_exact(suite, method, errors, counts, 0)


@suite.case
def V2():
    "V2 a background behind constant volumes"
    for method in offered(suite):
        worst = 0.0
        for case in behind.cases:
            colors = [[c + (1 - color[3]) * b for c, b in zip(color[:3], BACKGROUND)] + [1.0]
                      for color in behind.expected(case)[0]]
            worst = max(worst, greatest_error(behind.picture(case, method, 1), colors))
        check_exact(suite, method, [worst], [1], 0)


@suite.case
def orders_of_slabs():
    "V9 swapped slabs look different"
    for method in offered(suite):
        one, other = (sheet.picture(case, method, 1 / 8) for case in CASES if case.name.startswith("V9"))
        suite.check(method, max(abs(a - b) for a, b in zip(one.values, other.values)) > 0.1)


@suite.case
def denser():
    "more extinction is never more transparent"
    for method in offered(suite):
        for thin, dense in zip(CASES, CASES[1:len(EXTINCTIONS)]):
            check_denser(suite, f"{method}, {thin.name}", *(sheet.picture(c, method, 1) for c in (thin, dense)))
        for dense in DENSER:
            thin = named(dense.name.split()[0])
            check_denser(suite, f"{method}, {thin.name}", *(sheet.picture(c, method, 1) for c in (thin, dense)))
            suite.check(f"{method}, {dense.name}: physical", is_physical(sheet.picture(dense, method, 1)))


@suite.case
def backends():
    "both backends"
    check_backends(sheet, 1 / 4)


suite.main(__name__)
