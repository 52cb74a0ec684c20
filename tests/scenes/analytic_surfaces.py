#!/usr/bin/env python3
"""V13 to V16: gradients, surfaces of equal value and projections, along oblique rays in closed form."""

import math
import random

from analytic_data import (EXACT, HALVINGS, KINKED, MIDPOINT, OBLIQUE, RAMP_GRADIENT, Case, Sheet,
                           add_cases, check_backends, check_exact, check_order, image3d, oblique_box, on_ramp,
                           ramp_value)
from analytic_grid import Grid
from analytic_page import Analytic
from analytic_rays import Box, Parallel, Transform, centres, words
from harness import CaseError, dot, unit
from scenes import effect, volume

suite = Analytic()

DIMENSIONS = (0.64, 0.5, 0.56)
VIEW = Parallel(0.5)
ALWAYS = dict.fromkeys(("midpoint", "preintegrated", "cells"), EXACT)


# ---- V14: gradients. An effect shows normal * magnitude of the first sample, half a step behind the entry.

SCALE = 0.1
GRADIENT = effect(f"""void PLUG_volume_classify(inout vec4 color, const in VolumeSample s)
{{ color = vec4(0.5 + {SCALE} * s.gradient * s.normal_eye, 1.0); }}""")


def quadratic(place):
    x, y, z = place
    return 0.3 + 2 * (x * x + y * y + z * z + x * y)


def quadratic_gradient(place):
    x, y, z = place
    return 2 * (2 * x + y), 2 * (2 * y + x), 4 * z


def gradient_case(name, box, grid, gradient, step):
    """`gradient(place)` in own coordinates; seen from outside of the denser side."""
    def truth(chord):
        own = gradient(chord.at(min(step, chord.length) / 2))
        normal = unit(box.place.map.normal([-g for g in own]))
        size = math.sqrt(dot(own, own))
        return tuple(0.5 + SCALE * size * n for n in normal) + (1.0,)

    content = box.place.around(volume(image3d(name + ".nrrd"), "", GRADIENT,
                                      f"valueRange 0 1 {box.fields()}", box.dimensions))
    return Case(name, content, truth, box, {name + ".nrrd": grid.file()})


SHEARED = Transform(rotation=(1, 2, 0.5, 0.5), inside=Transform(
    scale=(1.3, 0.7, 0.9), rotation=(0.3, 1, -0.2, 0.7)))
MIRRORED = Transform(rotation=(1, 2, 0.5, 0.5), scale=(-1, 1, 1))


@suite.case
def V14():
    "V14 gradients"
    size = (8, 7, 9)
    for step in (0.4, 1.7):
        cases = []
        for name, place in (("turned", OBLIQUE), ("sheared", SHEARED), ("mirrored", MIRRORED)):
            box = Box(DIMENSIONS, size, *centres(size, 1.0), place)
            cases.append(gradient_case(name, box, Grid(box, quadratic), quadratic_gradient, step * box.voxel()))
        # up to the sides the gradient is what design says: differences of centres, clamped to the outermost
        numbers = random.Random(14)
        box = Box(DIMENSIONS, (5, 4, 3), place=OBLIQUE)
        noise = Grid(box, values=[0.4 + 0.2 * numbers.random() for _ in range(60)])
        cases.append(gradient_case("noise", box, noise, noise.gradient, step * box.voxel()))
        sheet = Sheet(suite, cases, VIEW)
        for case in cases:
            error = sheet.error(case, MIDPOINT, step)
            met = sheet.expected(case)[1]
            suite.check(f"{met} rays", met >= 64)
            check_exact(suite, MIDPOINT, [error / SCALE], [1], 5e-6,
                        f"V14 gradients, {case.name}, {step / 2} voxels behind the entry")


# ---- V15: surfaces. An effect shows how far it is, and the normal.

DEPTH = effect("""void PLUG_volume_shade(inout vec4 color, const in VolumeSample s)
{ color = vec4(-0.5 * s.position_eye.z, 0.5 + 0.5 * s.normal_eye.xy, 1.0); }""")


def surface_content(box, data, value, effects):
    return box.place.around(
        f"IsoSurfaceVolumeData {{ surfaceValues {value!r} dimensions {words(box.dimensions)} valueRange 0 1 "
        f"{box.fields()} voxels {data} effects [ {effects} ] }}\n")


def shown(box, chord, way, gradient):
    """What DEPTH shows of a surface so far behind the entry."""
    normal = unit(box.place.map.normal([-g for g in gradient]))
    return (0.5 * (chord.distance + way / chord.speed), 0.5 + 0.5 * normal[0], 0.5 + 0.5 * normal[1], 1.0)


def plane_case(value, place, name):
    size = (9, 8, 10)
    box = Box(DIMENSIONS, size, *centres(size, 1.0), place)
    grid = Grid(box, ramp_value)

    def truth(chord):
        s0, s1, length = on_ramp(chord)
        if not min(s0, s1) < value < max(s0, s1):
            return (0.0,) * 4
        return shown(box, chord, (value - s0) / (s1 - s0) * length, RAMP_GRADIENT)

    return Case(f"V15 plane, {name}", surface_content(box, image3d("plane.nrrd"), value, DEPTH), truth, box,
                {"plane.nrrd": grid.file()}, orders=ALWAYS, steps=(0.3, 1.1, 3.7))


MIDDLE, RADIUS = (0.03, 0.01, -0.02), 0.2
ISO = 3 * RADIUS**2


def squared(place):
    return 3 * sum((p - c) ** 2 for p, c in zip(place, MIDDLE))


def sphere_way(chord):
    """Where the ray meets the sphere, and the cosine there; None without."""
    offset = tuple(e - c for e, c in zip(chord.entry, MIDDLE))
    b, c = dot(offset, chord.direction), dot(offset, offset) - RADIUS**2
    if b * b <= c:
        return None
    return -b - math.sqrt(b * b - c), math.sqrt(b * b - c) / RADIUS


def sphere_truth(box, least_cosine):
    def truth(chord):
        found = sphere_way(chord)
        if not found or found[1] < least_cosine:
            return None
        outward = tuple(p - c for p, c in zip(chord.at(found[0]), MIDDLE))
        return shown(box, chord, found[0], outward)

    return truth


COMPUTED = effect(f"""void PLUG_volume_sample(inout VolumeSample s)
{{
    vec3 place = (s.position - 0.5) * vec3({', '.join(map(repr, DIMENSIONS))}) - vec3({', '.join(map(repr, MIDDLE))});
    s.value = vec4(3.0 * dot(place, place));
}}""")


def sphere_errors(case, step):
    """Of distances and of normals, over rays that do not graze."""
    alone = Sheet(suite, [case], VIEW, pixels=16)
    picture = alone.picture(case, MIDPOINT, step)
    way, normal, met = 0.0, 0.0, 0
    for i, color in enumerate(alone.expected(case)[0]):
        if color and color[3]:
            got = picture.values[4 * i:4 * i + 4]
            met += 1
            way = max(way, 2 * abs(got[0] - color[0]) + (got[3] != 1))
            normal = max(normal, *(2 * abs(a - b) for a, b in zip(got[1:3], color[1:3])))
    if met < 64:
        raise CaseError(f"{met} rays")
    return way, normal


def sphere_case(size, effects=DEPTH, field=squared):
    box = Box(DIMENSIONS, (size,) * 3, place=OBLIQUE)
    return Case(f"V15 sphere, {size}^3 voxels", surface_content(box, image3d("r2.nrrd"), ISO, effects),
                sphere_truth(box, 0.5), box, {"r2.nrrd": Grid(box, field).file()})


planes = Sheet(suite, [plane_case(0.43, OBLIQUE, "turned"), plane_case(0.61, SHEARED, "sheared"),
                       plane_case(0.52, MIRRORED, "mirrored")], VIEW)
add_cases(planes, planes.cases)


@suite.case
def V15_spheres():
    "V15 sphere"
    case = sphere_case(6, COMPUTED + DEPTH, lambda place: 0.0)
    check_exact(suite, MIDPOINT, [sphere_errors(case, step)[0] for step in (0.05, 0.3, 0.7)], [1] * 3, 0,
                "V15 sphere, computed")
    found = [sphere_errors(sphere_case(n), 0.5) for n in (6, 12, 24, 48, 96)]
    for name, errors in zip(("distances", "normals"), zip(*found)):
        check_order(suite, MIDPOINT, errors, [1] * len(errors), 2, 4, f"V15 sphere, finer grids, {name}")


# ---- V13, V16: projections

AXIS = unit((0.3, -0.4, -1.1))


def along(place):
    return dot(AXIS, place)


def projection_case(name, kind, truth, *, grid=None, code="", threshold=0.0, box=None, orders=ALWAYS, **more):
    box = box or oblique_box()
    grid = grid or Grid(box, ramp_value)
    file = name.replace(" ", "-") + ".nrrd"
    style = f'ProjectionVolumeStyle {{ type "{kind}" intensityThreshold {threshold} }}'
    content = box.place.around(volume(image3d(file), style, effect(code) if code else "",
                                      f"valueRange 0 1 {box.fields()}", box.dimensions))

    def exact(chord):
        value = truth(chord)
        return None if value is None else (value,) * 3 + (1.0,)

    return Case(name, content, exact, box, {file: grid.file()}, orders=orders, **more)


def field_code(expression):
    """A field of x, how far a place is along AXIS."""
    return (f"void PLUG_volume_sample(inout VolumeSample s) {{ float x = dot((s.position - 0.5) * "
            f"vec3({', '.join(map(repr, DIMENSIONS))}), vec3({', '.join(map(repr, AXIS))})); "
            f"s.value = vec4({expression}); }}")


def hill_truth(chord):
    """1 - ((x - c) / w)^2 where it is greatest on the ray."""
    x0, x1 = along(chord.entry), along(chord.at(chord.length))
    nearest = min(max(0.04, min(x0, x1)), max(x0, x1))
    return 1 - ((nearest - 0.04) / 0.7) ** 2


def peaks_truth(chord):
    """Of two peaks the first one, where the ray runs over both."""
    return 0.6 if along(chord.entry) < -0.1 and along(chord.at(chord.length)) > 0.12 else None


def half_texel_case(count):
    box = Box((1, 1, 1), (count, 1, 1), place=Transform(rotation=(0, 1, 0, math.pi / 2)))
    row = Grid(box, values=[i / (count - 1) for i in range(count)])
    code = "void PLUG_volume_sample(inout VolumeSample s) { s.value *= s.value; }"
    mean = (2 * count + 1) / (6 * count)
    return projection_case(f"V13 mean of squares, {count} voxels", "AVERAGE", lambda chord: mean, grid=row,
                           code=code, box=box, orders={MIDPOINT: KINKED}, bound=1.2,
                           steps=[0.9137 * s * count / 8 for s in HALVINGS])


PEAKS = field_code("max(0.0, max(0.6 - 36.0 * (x + 0.08) * (x + 0.08), 0.9 - 49.0 * (x - 0.1) * (x - 0.1)))")
EXACT_ONCE = {MIDPOINT: EXACT}
PROJECTIONS = [
    projection_case("V16 greatest of a ramp", "MAX", lambda chord: max(on_ramp(chord)[:2])),
    projection_case("V16 least of a ramp", "MIN", lambda chord: min(on_ramp(chord)[:2])),
    projection_case("V16 mean of a ramp", "AVERAGE", lambda chord: sum(on_ramp(chord)[:2]) / 2),
    projection_case("V16 greatest of a hill", "MAX", hill_truth, orders=EXACT_ONCE,
                    code=field_code("1.0 - (x - 0.04) * (x - 0.04) / 0.49")),
    projection_case("V16 least of a valley", "MIN", lambda chord: 1 - hill_truth(chord),
                    code=field_code("(x - 0.04) * (x - 0.04) / 0.49"), orders=EXACT_ONCE),
    projection_case("V16 first peak above a threshold", "MAX", peaks_truth, code=PEAKS, threshold=0.5,
                    orders=EXACT_ONCE, steps=HALVINGS[1:], tolerance={MIDPOINT: 1e-5}),
]
projected = Sheet(suite, PROJECTIONS, VIEW)
add_cases(projected, PROJECTIONS)
for rows in [Sheet(suite, [half_texel_case(n)], VIEW, pixels=8) for n in (2, 3, 5)]:
    add_cases(rows, rows.cases)


@suite.case
def backends():
    "both backends"
    for one in (planes, projected):
        check_backends(one, 0.5)


suite.main(__name__)
