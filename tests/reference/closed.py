#!/usr/bin/env python3
"""The reference against closed forms. Rays run along -z through one column of voxels unless said otherwise."""

import math
import os
import random
import sys

folder = os.path.dirname(os.path.abspath(__file__))
sys.path[:0] = [folder, os.path.join(folder, "..", "scenes")]

import reference
from harness import Suite, box_interval, over, premultiplied

suite = Suite()
if len(sys.argv) > 1:
    reference.use(sys.argv[1])

EXACT, FINE = 1e-11, 1e-6
FRONT = reference.camera(fieldOfView=(-0.5, -0.5, 0.5, 0.5))


def ray(*volumes, camera=FRONT, shift=(0, 0), **more):
    """The colour of a picture of one pixel; the error bar has to hold what the program promises."""
    values, errors = reference.truth(list(volumes), camera, (1, 1), pixels=[(0, 0, *shift)],
                                     tolerance=1e-14, **more)
    suite.check("error bar", errors[0] <= 1e-7, errors[0])
    return values[0]


def column(numbers, transfer, size_z=1.0, **more):
    """A volume of one column, the first number is nearest, cropped to the outermost centres, between which it is
    `size_z` deep; opacities are of unit length."""
    count = len(numbers)
    half = 0.5 / count
    return reference.volume((1, 1, count), list(numbers)[::-1], "f64", value_range=(0, 1),
                            dimensions=(1, 1, size_z * count / (count - 1)), transfer=transfer,
                            crop=((0, 0, half), (1, 1, 1 - half)), **{"opacity_unit": 1, **more})


def constant(color, extinction, **more):
    alpha = -math.expm1(-extinction)
    return reference.volume((1, 1, 1), [7], transfer=reference.texels([(*color, alpha)]),
                            **{"opacity_unit": 1, **more})


def functions(extinction, color=lambda v: 1.0, count=6000):
    """A transfer function that follows others closely: extinction and grey by value."""
    rows = []
    for i in range(count + 1):
        v = i / count
        rows.append((v, *[color(v)] * 3, -math.expm1(-extinction(v))))
    return reference.points(rows)


RAMP = (0, 1)


@suite.case
def constant_extinction():
    "V1, V2: one extinction, over a background"
    for extinction in (0.01, 0.3, 3, 30):
        got = ray(constant((0.2, 0.5, 1), extinction))
        suite.close(f"{extinction}", got, premultiplied((0.2, 0.5, 1), -math.expm1(-extinction)),
                    EXACT)
        back = (0.9, 0.1, 0.3, 0.5)
        got = ray(constant((0.2, 0.5, 1), extinction), background=back)
        front = premultiplied((0.2, 0.5, 1), -math.expm1(-extinction))
        suite.close(f"{extinction} over", got, over(front, premultiplied(back[:3], back[3])), EXACT)
    got = ray(reference.volume((1, 1, 1), [7], transfer=reference.texels([(0.2, 0.5, 1, 1)])))
    suite.close("opaque", got, (0.2, 0.5, 1, 1), 0)


@suite.case
def linear_extinction():
    "V3: extinction that grows linearly"
    for kappa in (0.5, 4):
        got = ray(column(RAMP, functions(lambda v, k=kappa: k * v)))
        suite.close(f"kappa {kappa}", got[3], 1 - math.exp(-kappa / 2), FINE)


@suite.case
def linear_alpha():
    "alpha that grows linearly: the optical depth is exact"
    for top in (0.3, 0.9, 0.999999, 1):
        for length in (0.1, 1, 7):
            transfer = reference.points([(0, 0.5, 0.25, 1, 0), (1, 0.5, 0.25, 1, top)])
            left = (1 - top) * math.log(1 - top) if top < 1 else 0
            alpha = -math.expm1(-length * (left + top) / top)
            got = ray(column(RAMP, transfer, length))
            suite.close(f"to {top}, length {length}", got,
                        premultiplied((0.5, 0.25, 1), alpha), EXACT)


@suite.case
def linear_colour():
    "V4: colour and extinction linear"
    for kappa in (4, 30):
        m = kappa / 2
        exact = math.sqrt(math.pi) * math.erf(math.sqrt(m)) / (2 * math.sqrt(m)) - math.exp(-m)
        got = ray(column(RAMP, functions(lambda v, k=kappa: k * v, lambda v: v)))
        suite.close(f"kappa {kappa}", got[0], exact, FINE)


@suite.case
def manufactured():
    "V5: transmittance 1 / (1 + a s), colour a power of it"
    a, k = 6, 2
    got = ray(column(RAMP, functions(lambda v: a / (1 + a * v), lambda v: (1 + a * v) ** -k)))
    suite.close("colour", got[0], (1 - (1 + a) ** (-k - 1)) / (k + 1), FINE)
    suite.close("alpha", got[3], 1 - 1 / (1 + a), FINE)


@suite.case
def sampled_fields():
    "V6, V7, V8: fields sampled on a fine grid"
    count = 3000
    at = [i / (count - 1) for i in range(count)]
    kappa, length = 5, 0.3
    linear = functions(lambda v: kappa * v)
    got = ray(column([math.exp(-t / length) for t in at], linear))
    suite.close("exponential", got[3],
                -math.expm1(-kappa * length * -math.expm1(-1 / length)), FINE)
    c, w = 0.7, 0.3
    root = math.sqrt(2) * w
    for b in (0, 0.2):
        got = ray(column([math.exp(-(b * b + (t - c) ** 2) / (2 * w * w)) for t in at], linear))
        depth = kappa * w * math.sqrt(math.pi / 2) * math.exp(-b * b / (2 * w * w)) * (
            math.erf((1 - c) / root) + math.erf(c / root))
        suite.close(f"bell, {b} beside", got[3], -math.expm1(-depth), FINE)
    radius = 0.5
    for b in (0, 0.3):
        got = ray(column([max(0, 1 - (b * b + (t - 0.5) ** 2) / radius**2) for t in at], linear))
        depth = 4 * kappa * (radius**2 - b * b) ** 1.5 / (3 * radius**2)
        suite.close(f"ball, {b} beside", got[3], -math.expm1(-depth), FINE)


def slabs(*parts):
    """A transfer function of steps: (up to value, grey, extinction)."""
    rows, before = [], 0.0
    for to, grey, extinction in parts:
        alpha = -math.expm1(-extinction)
        rows += [(before, grey, grey, grey, alpha), (to, grey, grey, grey, alpha)]
        before = to
    return reference.points(rows)


@suite.case
def two_slabs():
    "V9: two slabs by a jump; swapped, they look different"
    for one, two in (((0.8, 2.0), (0.3, 5.0)), ((0.3, 5.0), (0.8, 2.0))):
        first = math.exp(-one[1] * 0.37)
        exact = one[0] * (1 - first) + first * two[0] * -math.expm1(-two[1] * 0.63)
        got = ray(column(RAMP, slabs((0.37, *one), (1, *two))))
        suite.close(f"{one} before {two}", got[0], exact, EXACT)


@suite.case
def thin_sheet():
    "V10: thin sheets, met whatever they measure"
    for width in (0.05, 1e-4, 1e-8):
        extinction = 2 / width
        alpha_limit = extinction < 30
        if alpha_limit:
            got = ray(column(RAMP, slabs((0.4, 1, 0), (0.4 + width, 1, extinction), (1, 1, 0))))
            suite.close(f"width {width}", got[3], -math.expm1(-2), EXACT)
        # a tent of alpha: twice a ramp
        top = 0.8
        rows = [(0, 1, 1, 1, 0), (0.4, 1, 1, 1, 0), (0.4 + width / 2, 1, 1, 1, top),
                (0.4 + width, 1, 1, 1, 0), (1, 1, 1, 1, 0)]
        depth = ((1 - top) * math.log(1 - top) + top) / top
        got = ray(column(RAMP, reference.points(rows), opacity_unit=width))
        suite.close(f"tent, width {width}", got[3], -math.expm1(-depth), 1e-8)


@suite.case
def waves():
    "V11: extinction in waves"
    kappa, q = 3, 7
    got = ray(column(RAMP, functions(lambda v: kappa * (1 + math.cos(2 * math.pi * q * v)),
                                     count=20000)))
    suite.close("", got[3], -math.expm1(-kappa), FINE)


# ---- opaque values


@suite.case
def towards_opaque():
    "a ramp up to alpha 1 has a finite integral, then the surface ends the ray"
    rows = [(0, 1, 0, 0, 0), (0.5, 1, 0, 0, 1), (0.5, 0, 1, 0, 1), (1, 0, 0, 1, 1)]
    for length in (0.1, 1, 3):
        got = ray(column(RAMP, reference.points(rows), length))
        through = math.exp(-length / 2)
        suite.close(f"length {length}", got, (1 - through, through, 0, 1), EXACT)
    # a jump to opaque
    got = ray(column(RAMP, slabs((0.25, 0.5, 2.0), (1, 1.0, math.inf))))
    suite.close("jump", got, [0.5 * -math.expm1(-0.5) + math.exp(-0.5)] * 3 + [1], EXACT)


@suite.case
def touching():
    "alpha 1 in one point of a ray ends it, unless touches pass"
    rows = [(0, 1, 0, 0, 0), (0.5, 1, 0, 0, 1), (1, 1, 0, 0, 0)]
    tent = reference.points(rows)
    suite.close("ends", ray(column(RAMP, tent), background=(0, 0, 1, 1)),
                (1, 0, 0, 1), EXACT)
    suite.close("passes", ray(column(RAMP, tent), touches_pass=True),
                premultiplied((1, 0, 0), -math.expm1(-1)), EXACT)
    # the value turns where alpha would be 1, or nearly
    for peak in (0.5, 0.5 - 1e-11):
        values, errors = reference.truth([column((0, peak, 0), tent)], FRONT, (1, 1),
                                         background=(0, 0, 1, 1))
        got, error = values.at(0, 0), errors.at(0, 0)
        ends = peak == 0.5
        suite.check(f"turns at {peak}", (got[0] > 0.999) == ends and (error > 0.1) == (not ends),
                    got, error)


@suite.case
def black_slab():
    "V18: what shines through before an opaque wall"
    for alpha in (0.95, 0.999, 1 - 1e-9):
        wall = [reference.plane(0, 0, 1, 2, (1, 1, 1))]
        got = ray(constant((0, 0, 0), -math.log(1 - alpha)), opaque=wall)
        suite.close(f"{alpha}", got, (1 - alpha,) * 3 + (1,), 1e-14)


# ---- several volumes


@suite.case
def same_box():
    "V17: two volumes in one box mix by extinction"
    one, two = ((0.9, 0.1, 0.2), 2.0), ((0.1, 0.3, 1.0), 0.7)
    total = one[1] + two[1]
    color = [(a * one[1] + b * two[1]) / total for a, b in zip(one[0], two[0])]
    for pair in ((one, two), (two, one)):
        got = ray(*(constant(*p) for p in pair))
        suite.close("", got, premultiplied(color, -math.expm1(-total)), EXACT)
    # own units of length
    got = ray(constant(*one), constant(two[0], two[1] / 4, opacity_unit=0.25))
    suite.close("own unit", got, premultiplied(color, -math.expm1(-total)), EXACT)


@suite.case
def half_overlapping():
    "V17: three parts, one volume, both, the other"
    one, two = ((0.9, 0.1, 0.2), 2.0), ((0.1, 0.3, 1.0), 0.7)
    total = one[1] + two[1]
    color = [(a * one[1] + b * two[1]) / total for a, b in zip(one[0], two[0])]
    want = premultiplied(one[0], -math.expm1(-one[1] * 0.4))
    want = over(want, premultiplied(color, -math.expm1(-total * 0.6)))
    want = over(want, premultiplied(two[0], -math.expm1(-two[1] * 0.4)))
    pair = [constant(*one), constant(*two, matrix=reference.transform((0, 0, -0.4)))]
    for volumes in (pair, pair[::-1]):
        suite.close("", ray(*volumes), want, EXACT)
    far = constant(*two, matrix=reference.transform((0, 0, -3)))
    want = over(premultiplied(one[0], -math.expm1(-one[1])),
                premultiplied(two[0], -math.expm1(-two[1])))
    suite.close("apart", ray(far, constant(*one)), want, EXACT)


@suite.case
def opaque_together():
    "opaque volumes hide translucent ones; in the same place their colours are averaged"
    red, blue, veil = (constant(c, math.inf) for c in ((1, 0, 0), (0, 0, 1), (0, 1, 0)))
    veil = constant((0, 1, 0), 2)
    suite.close("one", ray(red, veil), (1, 0, 0, 1), 0)
    suite.close("two", ray(veil, red, blue), (0.5, 0, 0.5, 1), EXACT)
    turned = constant((0, 0, 1), math.inf,
                      matrix=reference.transform(rotation=(0, 0, 1, 0.7), scale=(2, 2, 1)))
    suite.close("entries that differ by rounding", ray(red, turned), (0.5, 0, 0.5, 1), EXACT)
    later = constant((0, 0, 1), math.inf, matrix=reference.transform((0, 0, -0.25)))
    suite.close("one first", ray(later, red, veil), (1, 0, 0, 1), EXACT)
    got = ray(later, veil)
    through = math.exp(-0.5)
    suite.close("behind", got, (0, 1 - through, through, 1), EXACT)


# ---- rays, boxes, transforms


def slanted(position, angle, **more):
    """A perspective ray through the middle, seen from `position` and turned around y."""
    return reference.camera(position, (0, 1, 0, angle), 0.5, **more)


@suite.case
def chords():
    "V19: lengths are those in the volume's own coordinates"
    fog = ((1, 0.5, 0.25), 1.3)
    angle = 0.4
    got = ray(constant(*fog), camera=slanted((0, 0, 0), angle))
    suite.close("from inside", got, premultiplied(fog[0], -math.expm1(-1.3 * 0.5 / math.cos(angle))),
                EXACT)
    place = (2 * math.sin(angle), 0, 2 * math.cos(angle))
    whole = 1 / math.cos(angle)
    camera = slanted(place, angle)
    suite.close("across", ray(constant(*fog), camera=camera)[3], -math.expm1(-1.3 * whole), EXACT)
    camera = slanted(place, angle, nearDistance=2.0)
    suite.close("near", ray(constant(*fog), camera=camera)[3], -math.expm1(-1.3 * whole / 2), EXACT)
    camera = slanted(place, angle, farDistance=2.25)
    suite.close("far", ray(constant(*fog), camera=camera)[3],
                -math.expm1(-1.3 * (whole / 2 + 0.25)), EXACT)
    wall = [reference.plane(0, 0, 1, -0.25, (0, 1, 1))]
    want = over(premultiplied(fog[0], -math.expm1(-1.3 * whole / 4)), (0, 1, 1, 1))
    suite.close("wall", ray(constant(*fog), camera=slanted(place, angle), opaque=wall), want, EXACT)


@suite.case
def transforms():
    "V19: turned, scaled, mirrored, sheared"
    fog = ((1, 0.5, 0.25), 1.3)
    shear = (1, 0.3, 0.5, 0, 0, 1, 0.2, 0, 0, 0, 1, 0, 0, 0, 0, 1)
    for name, matrix in (
            ("scaled", reference.transform(scale=(3, 2, 1000))),
            ("tiny", reference.transform(scale=(1e-3,) * 3)),
            ("mirrored", reference.transform(scale=(1, 1, -1))),
            ("sheared", shear),
            ("far away", reference.transform(translation=(1e3, 0, 0)))):
        shift = matrix[3]
        got = ray(constant(*fog, matrix=matrix),
                  camera=reference.camera((shift, 0, 2000), fieldOfView=(-1, -1, 1, 1)))
        # along z in the world is along z and a little of x and y in a sheared box
        own = 1 if name != "sheared" else math.sqrt(1 + 0.2**2 + (0.5 - 0.3 * 0.2) ** 2)
        suite.close(name, got[3], -math.expm1(-1.3 * own), 1e-9)


@suite.case
def cuts():
    "crop boxes, clip planes, dimensions"
    fog = ((1, 0.5, 0.25), 1.3)
    got = ray(constant(*fog, crop=((0, 0, 0.25), (1, 1, 0.5))))
    suite.close("crop", got[3], -math.expm1(-1.3 * 0.25), EXACT)
    got = ray(constant(*fog, crop=((0.6, 0, 0), (1, 1, 1))))
    suite.close("cropped away", got[3], 0, 0)
    got = ray(constant(*fog, clip_planes=[(0, 0, 2, 0.2), (0, 0, -1, 0.3), (1, 0, 0, 1)]))
    suite.close("planes", got[3], -math.expm1(-1.3 * 0.4), EXACT)
    got = ray(constant(*fog, clip_planes=[(1, 0, 0, -0.1)]))
    suite.close("clipped away", got[3], 0, 0)
    got = ray(constant(*fog, dimensions=(1, 1, 3)))
    suite.close("dimensions", got[3], -math.expm1(-1.3 * 3), EXACT)
    got = ray(constant(*fog, dimensions=(2, 4, 1), opacity_unit=0))
    suite.close("reference length", got[3], -math.expm1(-1.3 / 2), EXACT)


@suite.case
def solids():
    "spheres, boxes, parallelograms"
    fog = constant((1, 0, 0), 2.0)
    near = reference.transform((0, 0, 0.1), (1, 0, 0, 0.3))
    tilted = reference.transform((0, 0, 0.1), scale=(1, 1, 0.5))
    for name, solid, place in (
            ("sphere", reference.sphere((0, 0, 0), 0.25, (0, 1, 0)), 0.25),
            ("ellipsoid", reference.sphere((0, 0, 0), 0.4, (0, 1, 0), tilted), 0.3),
            ("box", reference.box((-1, -1, -1), (1, 1, 0.3), (0, 1, 0)), 0.3),
            ("square", reference.parallelogram((-1, -1, 0), (2, 0, 0), (0, 2, 0), (0, 1, 0), near),
             0.1)):
        through = math.exp(-2 * (0.5 - place))
        suite.close(name, ray(fog, opaque=[solid]), (1 - through, through, 0, 1), EXACT)
    beside = reference.parallelogram((0.1, -1, 0), (2, 0, 0), (0, 2, 0), (0, 1, 0))
    suite.close("beside", ray(fog, opaque=[beside]), ray(fog), 0)


# ---- cells


def gauss(function, start, stop, pieces):
    """Gauss and Legendre's rule of five points in each piece."""
    nodes = ((0, 128 / 225), (1, (322 + 13 * 70**0.5) / 900), (-1, (322 + 13 * 70**0.5) / 900),
             (2, (322 - 13 * 70**0.5) / 900), (-2, (322 - 13 * 70**0.5) / 900))
    places = {0: 0.0, 1: math.sqrt(5 - 2 * math.sqrt(10 / 7)) / 3,
              2: math.sqrt(5 + 2 * math.sqrt(10 / 7)) / 3}
    half = (stop - start) / pieces / 2
    return sum(weight * half * function(start + half * (2 * i + 1 + math.copysign(places[abs(k)], k)))
               for i in range(pieces) for k, weight in nodes)


@suite.case
def one_cell():
    "V12: eight voxels, an oblique ray between the centres"
    chance = random.Random(5)
    corners = [chance.random() * 0.9 for _ in range(8)]
    one = (0.3, 0.3, 0.71)  # texture coordinates, in the cell
    two = (0.62, 0.7, 0.26)
    eye = [3 * (a - 0.5) - 2 * (b - 0.5) for a, b in zip(one, two)]
    way = [b - a for a, b in zip(one, two)]
    length = math.sqrt(sum(w * w for w in way))

    def value(t):
        at = [2 * (e + t * w / length + 0.5) - 0.5 for e, w in zip(eye, way)]
        return sum(corners[i] * math.prod(at[k] if i >> k & 1 else 1 - at[k] for k in range(3))
                   for i in range(8))

    enter = max((0.25 - 0.5 - e) / w if w > 0 else (0.25 - e) / w for e, w in zip(eye, way)) * length
    leave = min((0.25 - e) / w if w > 0 else (-0.25 - e) / w for e, w in zip(eye, way)) * length
    depth = gauss(lambda t: -math.log1p(-value(t)), enter, leave, 40) / 0.5
    # a camera at `eye` that looks along `way`: -z turned to it
    axis = (way[1], -way[0], 0)
    angle = math.acos(-way[2] / length)
    ramp = reference.points([(0, 1, 1, 1, 0), (1, 1, 1, 1, 1)])
    got = ray(reference.volume((2, 2, 2), corners, "f64", value_range=(0, 1), transfer=ramp,
                               crop=((0.25,) * 3, (0.75,) * 3)),
              camera=reference.camera(eye, (*axis, angle), 0.3))
    suite.close("", got[3], -math.expm1(-depth), 1e-10)


@suite.case
def clamped_sides():
    "V13: beyond the outermost centres values are those of the centres, outside there is nothing"
    ramp = reference.points([(0, 1, 1, 1, 0), (1, 1, 1, 1, 0.5)])
    for count in (2, 5):
        got = ray(reference.volume((1, 1, count), [i / (count - 1) for i in range(count)], "f64",
                                   value_range=(0, 1), transfer=ramp, opacity_unit=1))
        inner = (0.5 * math.log(0.5) + 0.5) / 0.5
        depth = 0.5 / count * math.log(2) + (1 - 1 / count) * inner
        suite.close(f"{count} voxels", got[3], -math.expm1(-depth), EXACT)


@suite.case
def by_steps():
    "random voxels, a rough transfer function, oblique rays: the same as very many plain steps"
    chance = random.Random(11)
    size, dimensions = (4, 3, 5), (1.1, 0.9, 1)
    numbers = [chance.randrange(256) for _ in range(60)]
    colors = [[chance.random() for _ in range(3)] + [chance.choice((0, 0, 0.3, 0.7)) * chance.random()]
              for _ in range(24)]
    eye, pixels = (0.3, 0.2, 2.0), [(2, 3), (4, 5), (6, 2)]
    values, errors = reference.truth(
        [reference.volume(size, numbers, dimensions=dimensions, transfer=reference.texels(colors))],
        reference.camera(eye, fieldOfView=0.6), (8, 8), pixels=pixels)
    voxel = (math.prod(dimensions) / math.prod(size)) ** (1 / 3)

    def sample(at):
        """The color at a place: trilinear, then the function."""
        cell, part = [], []
        for p, d, n in zip(at, dimensions, size):
            x = min(max((p / d + 0.5) * n - 0.5, 0), n - 1)
            cell.append(min(int(x), max(n - 2, 0)))
            part.append(x - cell[-1])
        v = 0
        for i in range(8):
            k = [min(c + (i >> a & 1), n - 1) for a, (c, n) in enumerate(zip(cell, size))]
            w = math.prod(part[a] if i >> a & 1 else 1 - part[a] for a in range(3))
            v += w * numbers[k[0] + size[0] * (k[1] + size[1] * k[2])] / 255
        u = v * (len(colors) - 1)
        j = min(int(u), len(colors) - 2)
        return [a + (u - j) * (b - a) for a, b in zip(colors[j], colors[j + 1])]

    for (x, y), got, error in zip(pixels, values, errors):
        half = math.tan(0.3)
        way = ((2 * (x + 0.5) / 8 - 1) * half, (1 - 2 * (y + 0.5) / 8) * half, -1)
        length = math.sqrt(sum(w * w for w in way))
        steps, total, through = 12000, [0, 0, 0], 1.0
        enter, leave = box_interval(eye, way, dimensions)
        step = (leave - enter) / steps
        for i in range(steps):
            t = enter + (i + 0.5) * step
            at = [e + t * w for e, w in zip(eye, way)]
            color = sample(at)
            alpha = 1 - (1 - color[3]) ** (step * length / voxel)
            total = [a + through * alpha * c for a, c in zip(total, color)]
            through *= 1 - alpha
        suite.close(f"pixel {x},{y}", got, (*total, 1 - through), 1e-6)
        suite.check("error bar", error < 1e-8, error)


@suite.case
def error_bars():
    "error bars hold what they promise"
    chance = random.Random(3)
    size = (6, 5, 7)
    numbers = [chance.random() for _ in range(210)]
    rough = reference.texels([[chance.random() for _ in range(4)] for _ in range(40)])
    camera = reference.camera((0.5, 0.4, 2), (-0.5, 0.6, 0, 0.3), 0.6)
    for name, more in (("", {}), ("shaded", {"shading": reference.vtk_shading()})):
        one = reference.volume(size, numbers, "f64", value_range=(0, 1), transfer=rough, opacity_unit=0.5,
                               **more)
        results = [reference.truth([one], camera, (16, 16), tolerance=t) for t in (1e-4, None, 1e-14)]
        (best, _), (_, usual) = results[2], results[1]
        for values, errors in results[:2]:
            worst = max(abs(a - b) - 1e-13 - errors.data[i // 4]
                        for i, (a, b) in enumerate(zip(values.data, best.data)))
            suite.check(f"within {max(errors.data):.1e} {name}", worst <= 0, worst)
        suite.check(f"small {name}", max(usual.data) < 1e-7, max(usual.data))
        several, bars = reference.truth([one], camera, (16, 16), threads=3)
        suite.check(f"threads change nothing {name}",
                    several.data == results[1][0].data and bars.data == usual.data)
        suite.equal(f"counted {name}", [reference.report[k] for k in ("pixels", "not_converged")],
                    [256, 0])


@suite.case
def undecided():
    "where rounding decides on the whole pixel, the error bar says so"
    wall = constant((1, 0, 0), math.inf)
    labelled = reference.volume((2, 1, 1), [9, 9], labels=((2, 1, 1), [0, 1], "u8"), segments=[
        reference.texels([(1, 0, 0, 1)]), reference.texels([(0, 1, 0, 1)])])
    ball = [reference.sphere((0, 0, 0), 0.5, (0, 1, 0))]
    for name, volumes, x, solids in (
            ("beside", [wall], 0.6, ()), ("inside", [wall], 0.4, ()), ("face", [wall], 0.5, ()),
            ("segments", [labelled], 0.0, ()), ("segment", [labelled], 0.1, ()),
            ("ball", [], 0.5, ball), ("beside the ball", [], 0.51, ball)):
        camera = reference.camera((x, 0, 10), fieldOfView=(-0.5, -0.5, 0.5, 0.5))
        _, errors = reference.truth(volumes, camera, (1, 1), opaque=solids)
        unsure = name in ("face", "segments", "ball")
        suite.check(name, (errors.at(0, 0) == 1) == unsure, errors.at(0, 0))
        suite.equal(f"{name}, counted", reference.report["not_converged"], int(unsure))


@suite.case
def faulty_jobs():
    "what is wrong with a job is said"
    one = reference.volume((2, 1, 1), [1, 2])
    for name, words, volume in (
            ("unknown field", "colour", dict(one, colour=1)),
            ("too short", "too short", dict(one, size=[3, 1, 1])),
            ("no such type", "'type'", dict(one, type="u8", labels={"file": "x", "type": "i9"})),
            ("singular matrix", "singular", dict(one, matrix=[0] * 16)),
            ("falling points", "ascending",
             dict(one, transfer=reference.points([(1, 0, 0, 0, 0), (0, 1, 1, 1, 1)])))):
        try:
            reference.truth([volume], FRONT, (1, 1))
            suite.check(name, False)
        except reference.Failed as fault:
            suite.check(name, words in str(fault), fault)


# ---- labels, styles, pixels


@suite.case
def segments():
    "labels are those of the nearest voxel, each with a function of its own"
    red, green, blue = (reference.texels([(*c, -math.expm1(-e))])
                        for c, e in (((1, 0, 0), 1), ((0, 1, 0), 2), ((0, 0, 1), 3)))

    def labelled(numbers, chosen, kind="u8", size=None):
        return ray(reference.volume(
            (1, 1, 3), [9, 9, 9], opacity_unit=1, segments=chosen[:-1], other_segments=chosen[-1],
            labels=(size or (1, 1, len(numbers)), numbers, kind)))

    def want(*parts):
        result = (0, 0, 0, 0)
        for color, depth in parts:
            result = over(result, premultiplied(color, -math.expm1(-depth)))
        return result

    r, g, b = (1, 0, 0), (0, 1, 0), (0, 0, 1)
    # slice 0 is the farthest
    suite.close("three", labelled([0, 1, 2], [red, green, blue]),
                want((b, 1), (g, 2 / 3), (r, 1 / 3)), EXACT)
    suite.close("beyond the list", labelled([0, 1, 700], [red, green, blue], "u16"),
                want((b, 1), (g, 2 / 3), (r, 1 / 3)), EXACT)
    suite.close("hidden", labelled([0, 1, 2], [red, reference.HIDDEN, blue]),
                want((b, 1), (r, 1 / 3)), EXACT)
    suite.close("a grid of its own", labelled([0, 0, 0, 1], [red, green, blue]),
                want((g, 0.5), (r, 0.75)), EXACT)
    suite.close("numbers 1 and 3, never 2", labelled([1, 3], [red, green, blue, reference.HIDDEN]),
                want((g, 1)), EXACT)


@suite.case
def one_opaque_value():
    "all of one value, which alone is opaque: however short it is, from the entry on"
    tip = reference.texels([(0.2, 0.4, 0.6, 1), (0.2, 0.4, 0.6, 0)])
    for touches_pass in (False, True):
        got = ray(column((0, 0), tip, 1e-6), touches_pass=touches_pass)
        suite.close("a tip", got, (0.2, 0.4, 0.6, 1), 0)


@suite.case
def opaque_at_a_label():
    "a value that is opaque alone in one of two labels, where they meet: nobody can tell; a range of values ends the ray"
    tent = [(0, 1, 1, 1, 0), (0.5, 1, 1, 1, 1), (1, 1, 1, 1, 0)]
    for name, rows, expected in (("a tip", tent, 1), ("opaque from there on", tent[:2] + [(1, 1, 1, 1, 1)], 0)):
        for other in (reference.HIDDEN, reference.points([(0, 1, 0, 0, 0.1), (1, 1, 0, 0, 0.1)])):
            made = column((0, 1), reference.HIDDEN)
            made.update(labels={"size": [1, 1, 2], "type": "u8", "numbers": [0, 1]}, segments=[reference.points(rows), other])
            bar = reference.truth([made], FRONT, (1, 1), pixels=[(0, 0)])[1][0]
            suite.check(name, bar > 0.1 if expected else bar < 1e-6, bar)


@suite.case
def factors():
    "constant factors on opacity and colour are clamped"
    rows = [(0, 0.4, 0.4, 0.4, 0), (1, 0.4, 0.4, 0.4, 0.5)]
    got = ray(column((0.5, 0.5), reference.points(rows, opacity=1.6, tint=(1, 2, 3))))
    suite.close("half", got, premultiplied((0.4, 0.8, 1), 0.4), EXACT)
    # alpha 3 v, 1 from a third on
    got = ray(column(RAMP, reference.points(rows[:1] + [(1, 1, 1, 1, 0.5)], opacity=6)), )
    suite.check("opaque from a third on", got[3] == 1 and got[0] < 0.6, got)


@suite.case
def shaded():
    "a constant gradient is a constant factor"
    size = (2, 2, 2)
    ramp = [0.2 + 0.4 * (i & 1) + 0.2 * (i >> 2) for i in range(8)]
    flat = reference.points([(0, 0.5, 0.4, 0.3, 0.5), (1, 0.5, 0.4, 0.3, 0.5)])
    one = reference.volume(size, ramp, "f64", value_range=(0, 1), dimensions=(1, 1, 2),
                           transfer=flat, opacity_unit=1, crop=((0.25,) * 3, (0.75,) * 3),
                           shading=reference.vtk_shading())
    # per voxel .4 and .2; central differences that are clamped halve them; voxels are .5, .5, 1 long
    gradient = (0.4, 0, 0.1)
    facing = gradient[2] / math.hypot(*gradient)
    alpha = 1 - 0.5
    want = [(0.2 + 0.7 * facing) * c + 0.3 * facing**20 for c in (0.5, 0.4, 0.3)]
    suite.close("parallel", ray(one), premultiplied(want, alpha), 1e-10)
    turned = dict(one, matrix=reference.transform(rotation=(0, 1, 0, 0.3), scale=(1, 1, 2)))
    normal = (0.4, 0, 0.05)
    normal = (normal[0] * math.cos(0.3) + normal[2] * math.sin(0.3),
              normal[2] * math.cos(0.3) - normal[0] * math.sin(0.3))
    facing = abs(normal[1]) / math.hypot(*normal)
    bright = ray(turned)
    want = [(0.2 + 0.7 * facing) * c + 0.3 * facing**20 for c in (0.5, 0.4, 0.3)]
    suite.close("normals are covectors", [c / bright[3] for c in bright[:3]], want, 1e-9)
    none = dict(one, numbers=[0.5] * 8)
    suite.close("without gradient", ray(none),
                premultiplied([0.2 * c for c in (0.5, 0.4, 0.3)], alpha), 1e-10)


@suite.case
def pixels():
    "rows begin at the top; parts of a pixel; both kinds of cameras fit their window"
    numbers = [0.1 * (x + 1) + 0.4 * y for y in range(2) for x in range(2)]
    one = reference.volume((2, 2, 1), numbers, "f64", value_range=(0, 1), transfer=reference.points(
        [(0, 1, 1, 1, 0.0), (1, 1, 1, 1, 0.9)]), opacity_unit=1)
    values, _ = reference.truth([one], FRONT, (4, 4))
    want = {(0, 3): 0.1, (3, 3): 0.2, (0, 0): 0.5, (3, 0): 0.6}
    for (x, y), value in want.items():
        suite.close(f"corner {x},{y}", values.at(x, y)[3], 0.9 * value, EXACT)
    small, _ = reference.truth([one], FRONT, (2, 2), pixels=[(0, 0, 0.25, 0.25), (1, 1, -0.25, 0.25)])
    suite.close("shifted", [c[3] for c in small], (values.at(1, 1)[3], values.at(2, 3)[3]), EXACT)
    wide, _ = reference.truth([one], FRONT, (8, 4))
    suite.close("wide", wide.at(2, 0), values.at(0, 0), EXACT)
    tall, _ = reference.truth([one], reference.camera((0, 0, 2.5), fieldOfView=2 * math.atan(0.25)),
                              (4, 8))
    axis = math.hypot(0.75 * 0.25, 0.25 * 0.25, 1)
    suite.check("tall", 0 < tall.at(0, 2)[3] < 1 and axis > 1, tall.at(0, 2))


@suite.case
def changed_voxels():
    "all voxels a little more or less"
    flat = reference.points([(0, 1, 1, 1, 0), (1, 1, 1, 1, 0.5)])
    for change, value in ((0, 0.5), (0.25, 0.75), (-0.125, 0.375), (0.75, 1)):
        got = ray(reference.volume((1, 1, 1), [30000], "u16", value_range=(0, 60000), transfer=flat,
                                   opacity_unit=1, voxel_change=change))
        suite.close(f"by {change}", got[3], 0.5 * value, EXACT)


suite.run()
