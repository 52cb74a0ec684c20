#!/usr/bin/env python3
"""Slabs and planes: what viewpoints with near and far, and pairs of planes, leave of a volume."""

import math

from harness import Suite, opacity, over, premultiplied, unit
from scenes import NO_HEADLIGHT, constant, front_scene, quad, scene, volume, voxels

suite = Suite()
VALUE = 128
CUBE = volume(constant(VALUE))


def matter(length):
    v = VALUE / 255
    return premultiplied((v, v, v), opacity(v, max(length, 0), 1))


def flat(near, far, turn=0, distance=10, width=1):
    """Looks at the origin along -z, turned about y; distances from the eye."""
    x, z = distance * math.sin(turn), distance * math.cos(turn)
    return (f"OrthoViewpoint {{ position {x!r} 0 {z!r} orientation 0 1 0 {turn!r} "
            f"fieldOfView {-width} {-width} {width} {width} nearDistance {near!r} farDistance {far!r} }}\n")


def deep(near, far, distance=3):
    return f"Viewpoint {{ position 0 0 {distance} nearDistance {near!r} farDistance {far!r} }}\n"


def middle(view, *content, **options):
    return suite.middle(scene(view, NO_HEADLIGHT, *content), **options)


@suite.case
def lengths():
    "the optical depth is that of the slab, parallel and in perspective, turned and beside the axis"
    for near, far, length in ((9.6, 10.1, 0.5), (1, 10, 0.5), (9.75, 30, 0.75), (10.5, 11, 0), (3, 9.5, 0)):
        suite.close(f"parallel {near} to {far}", middle(flat(near, far), CUBE), matter(length))
        suite.close(f"perspective {near - 7} to {far - 7}", middle(deep(near - 7 if near > 7 else near / 10, far - 7),
                                                               CUBE), matter(length))
    for turn in (math.pi / 4, 0.3):
        suite.close(f"turned by {turn}", middle(flat(9.8, 10.1, turn), CUBE), matter(0.3))
    column, row = 12, 18
    got = suite.probe(scene(deep(2.6, 3.2), NO_HEADLIGHT, CUBE), [(column, row)], size="32x32")[0]
    half = math.tan(math.pi / 8)
    d = unit((((column + 0.5) / 16 - 1) * half, (1 - (row + 0.5) / 16) * half, -1))
    suite.close("planes, not spheres", got, matter(0.6 / -d[2]))


RAMP = voxels(1, (1, 1, 2), (0, 255))  # 0 at z = -.25, 1 at z = .25
X_RAMP = voxels(1, (2, 1, 1), (0, 255))


def ramp(z):
    return min(max(2 * z + 0.5, 0), 1)


def project(kind, data=RAMP, fields=""):
    return volume(data, f'ProjectionVolumeStyle {{ type "{kind}" }}', fields=fields)


def grey(value):
    return (value, value, value, 1)


@suite.case
def projected():
    "of a projection both ends of the slab count: MAX, MIN, AVERAGE"
    for near, far in ((9.9, 10.1), (9.8, 9.95), (10.05, 10.2)):
        ends = ramp(10 - near), ramp(10 - far)
        for view in (flat(near, far), deep(near - 7, far - 7)):
            name = f"{view.split(' ')[0]} {near} to {far}"
            suite.close(f"MAX {name}", middle(view, project("MAX")), grey(max(ends)), 2e-5)
            suite.close(f"MIN {name}", middle(view, project("MIN")), grey(min(ends)), 2e-5)
            suite.close(f"AVERAGE {name}", middle(view, project("AVERAGE")), grey(sum(ends) / 2), 2e-5)


@suite.case
def planes():
    "a slab without thickness is the plane itself"
    for z in (0.1, -0.2, 0.03):
        for kind in ("MAX", "MIN", "AVERAGE"):
            for view in (flat(10 - z, 10 - z), deep(3 - z, 3 - z)):
                got = middle(view, project(kind))
                suite.close(f"{kind} {view.split(' ')[0]} at {z}", got, grey(ramp(z)), 2e-5)
    columns = (4, 7, 9)
    for turn in (math.pi / 4, 0.3):
        # the plane through the origin, turned: x runs with the cosine
        text = scene(flat(10, 10, turn), NO_HEADLIGHT, project("MAX", X_RAMP))
        got = suite.probe(text, [(x, 8) for x in columns])
        for column, color in zip(columns, got):
            across = (column + 0.5) / 8 - 1
            suite.close(f"oblique by {turn}, column {column}", color, grey(ramp(across * math.cos(turn))), 2e-5)
    text = scene(deep(3, 3), NO_HEADLIGHT, project("AVERAGE", X_RAMP))
    half = math.tan(math.pi / 8)
    for column, color in zip(columns[1:], suite.probe(text, [(x, 8) for x in columns[1:]])):
        suite.close(f"perspective, column {column}", color, grey(ramp(((column + 0.5) / 8 - 1) * half * 3)), 2e-5)
    suite.close("nothing of what has thickness", middle(flat(10, 10), CUBE), (0, 0, 0, 0))
    moved = "Transform { rotation 0 1 0 .4 scale 2 1 1 children [\n%s] }\n" % project("MAX", X_RAMP)
    got = suite.probe(scene(flat(10, 10), NO_HEADLIGHT, moved), [(x, 8) for x in columns])
    for column, color in zip(columns, got):
        across = ((column + 0.5) / 8 - 1) * math.cos(0.4) / 2
        suite.close(f"of a turned and stretched volume, column {column}", color, grey(ramp(across)), 2e-5)
    suite.close("of one of several volumes", middle(flat(9.9, 9.9), project("MAX"), CUBE), grey(ramp(0.1)), 2e-5)


@suite.case
def between_clip_planes():
    "two clip planes make a slab of any direction"
    c, s = math.cos(0.7), math.sin(0.7)
    pair = (f"clipPlanes [ ClipPlane {{ plane {s!r} 0 {c!r} .1 }} "
            f"ClipPlane {{ plane {-s!r} 0 {-c!r} .1 }} ]")
    length = 0.2 / c
    suite.close("matter", suite.middle(front_scene(volume(constant(VALUE), fields=pair))), matter(length))
    columns = (7, 8)
    for kind, place in (("MAX", 0.5), ("MIN", -0.5), ("AVERAGE", 0)):
        text = front_scene(project(kind, fields=pair))
        for column, color in zip(columns, suite.probe(text, [(x, 8) for x in columns])):
            z = -((column + 0.5) / 8 - 1) * s / c + place * length
            suite.close(f"{kind}, column {column}", color, grey(ramp(z)), 2e-5)


RED = "OpacityMapVolumeStyle { transferFunction PixelTexture { image 1 1 4 0xff000080 } }"


@suite.case
def surfaces():
    "surfaces of equal value and shapes outside the slab are not there"
    iso = "IsoSurfaceVolumeData { surfaceValues [ .3, .7 ] voxels %s renderStyle %s }\n" % (RAMP, RED)
    one = premultiplied((1, 0, 0), 128 / 255)
    for near, far, count in ((9.5, 10.5, 2), (9.95, 10.5, 1), (9.5, 10.05, 1), (9.95, 10.05, 0)):
        expected = (0, 0, 0, 0)
        for _ in range(count):
            expected = over(one, expected)
        suite.close(f"surfaces from {near} to {far}", middle(flat(near, far), iso), expected)
    sheet = "Transform { translation 0 0 %s children [ %s ] }\n"
    glass = "UnlitMaterial { emissiveColor 0 1 0 transparency .5 }"
    green = premultiplied((0, 1, 0), 0.5)
    suite.close("glass inside", middle(flat(9.7, 10.2), CUBE, sheet % (0.1, quad(glass))),
                over(matter(0.2), over(green, matter(0.3))))
    suite.close("glass before", middle(flat(9.7, 10.2), CUBE, sheet % (0.4, quad(glass))), matter(0.5))
    suite.close("glass behind", middle(flat(9.7, 10.2), CUBE, sheet % (-0.3, quad(glass))), matter(0.5))


suite.run()
