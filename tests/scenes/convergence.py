#!/usr/bin/env python3
"""The volume rendering integral in closed form, and how fast the steps converge to it."""

import math

from harness import Suite, box_interval, rotate, unit
from scenes import constant, effect, front_scene, scene, volume, voxels

suite = Suite()

CLASSIFY = "void PLUG_volume_classify(inout vec4 color, const in VolumeSample s)"


def field(expressions, steps):
    """One ray of length 1; x runs from 0 at the entry to 1. `expressions`: colour and extinction."""
    color, extinction = expressions
    code = (CLASSIFY + "{ float x = 1.0 - s.position.z; float extinction = " + extinction
            + "; color = vec4(vec3(" + color + "), 1.0 - exp(-extinction)); }")
    text = front_scene(volume(constant(9), effects=effect(code), fields="opacityUnitDistance 1"))
    return suite.middle(text, "--step", repr(1 / steps))


def errors(expressions, exact, channel=0):
    """At step lengths that do not divide the ray."""
    return [abs(field(expressions, 1.0943 * n)[channel] - exact) for n in (8, 16, 32, 64)]


def second_order(name, found, largest):
    """Halving the step quarters the error, down to what floats can tell."""
    floor = 4e-6
    ratios = [a / b for a, b in zip(found, found[1:]) if b > floor]
    suite.check(name, found[0] <= largest and found[-1] < largest / 30
                and all(3.0 < r < 5.5 for r in ratios), found, ratios)


@suite.case
def linear_extinction():
    "V3: extinction that grows linearly is exact with samples in the middle of steps"
    for kappa in (0.5, 4):
        for steps in (1, 7, 33.3):
            got = field(("1.0", f"{float(kappa)} * x"), steps)[3]
            suite.close(f"kappa {kappa}, {steps} steps", got, 1 - math.exp(-kappa / 2),
                        1e-5)


@suite.case
def linear_colour():
    "V4: colour and extinction linear"
    m = 2.0
    exact = math.sqrt(math.pi) * math.erf(math.sqrt(m)) / (2 * math.sqrt(m)) - math.exp(-m)
    second_order("order 2", errors(("x", "4.0 * x"), exact), 1.2e-3)


@suite.case
def manufactured():
    "V5: transmittance 1 / (1 + a x), colour a power of it"
    a, k = 6, 2
    exact = (1 - (1 + a) ** (-k - 1)) / (k + 1)
    second_order("order 2", errors((f"pow(1.0 + {a}.0 * x, -{k}.0)", f"{a}.0 / (1.0 + {a}.0 * x)"), exact), 6e-2)


@suite.case
def bell():
    "V7: a bell, off centre and cut off by the box"
    kappa, centre, width = 5, 0.7, 0.3
    root = math.sqrt(2) * width
    depth = kappa * width * math.sqrt(math.pi / 2) * (
        math.erf((1 - centre) / root) + math.erf(centre / root))
    found = errors(("1.0", f"{kappa}.0 * exp(-(x - {centre}) * (x - {centre}) / {2 * width**2})"),
                   1 - math.exp(-depth), 3)
    second_order("order 2", found, 2e-3)


@suite.case
def two_slabs():
    "V9: two slabs; swapped, they look different"
    one, two = (0.8, 2.0), (0.3, 5.0)
    for first, second in ((one, two), (two, one)):
        half = math.exp(-first[1] / 2)
        exact = first[0] * (1 - half) + half * second[0] * (1 - math.exp(-second[1] / 2))
        pair = [f"x < 0.5 ? {a} : {b}" for a, b in zip(first, second)]
        # the step between the slabs falls on a border of steps
        suite.close(f"{first} before {second}", field(pair, 32)[0], exact, 1e-5)


@suite.case
def thin_sheet():
    "V10: a thin sheet is met by as many samples as lie in it"
    extinction, width = 8.0, 0.05
    for steps in (90, 213):
        got = field(("1.0", f"abs(x - 0.4021) < {width / 2} ? {extinction} : 0.0"), steps)[3]
        hits = [math.floor(width * steps), math.ceil(width * steps)]
        allowed = [1 - math.exp(-extinction * h / steps) for h in hits]
        suite.check(f"{steps} steps", any(abs(got - a) < 2e-4 for a in allowed), got, allowed)


CORNERS = [30, 200, 90, 10, 140, 60, 250, 120]


def trilinear(position):
    """Of 2 x 2 x 2 voxels at texture coordinates, clamped beyond the centres."""
    at = [min(max(2 * p - 0.5, 0.0), 1.0) for p in position]
    total = 0.0
    for index, value in enumerate(CORNERS):
        weight = 1.0
        for axis in range(3):
            weight *= at[axis] if index >> axis & 1 else 1 - at[axis]
        total += weight * value / 255
    return total


def integrated(origin, direction, reference):
    """Grey and opacity along a ray, by 20000 steps in double precision."""
    enter, leave = box_interval(origin, direction)
    count = 20000
    h = (leave - enter) / count
    grey, through = 0.0, 1.0
    for i in range(count):
        t = enter + (i + 0.5) * h
        value = trilinear([o + t * d + 0.5 for o, d in zip(origin, direction)])
        alpha = 1 - (1 - value) ** (h / reference)
        grey += through * value * alpha
        through *= 1 - alpha
    return grey, 1 - through


@suite.case
def oblique_cell():
    "V12: eight voxels, oblique perspective rays"
    axis, angle = (1, 2, 0.5), 0.9
    position = rotate(axis, angle, (0.1, 0.05, 2.5))
    text = scene(
        f"Viewpoint {{ position {' '.join(map(repr, position))} "
        f"orientation {' '.join(map(str, axis))} {angle} fieldOfView 0.5 }}\n",
        volume(voxels(1, (2, 2, 2), CORNERS)))
    pixels = [(8, 8), (5, 6), (11, 4), (9, 12)]
    half = math.tan(0.25)
    for (x, y), got in zip(pixels, suite.probe(text, pixels, "--step", "0.02", size="17x17")):
        ray = unit((((x + 0.5) / 8.5 - 1) * half, (1 - (y + 0.5) / 8.5) * half, -1.0))
        grey, alpha = integrated(position, rotate(axis, angle, ray), 0.5)
        suite.close(f"pixel {x},{y}", got, (grey, grey, grey, alpha), 6e-4)


suite.run()
