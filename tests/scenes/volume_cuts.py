#!/usr/bin/env python3
"""Clip planes, of the scene and of single volumes, crop boxes and fog: what is left of a ray."""

import math

from harness import Suite, opacity, premultiplied
from scenes import constant, effect, front_scene, volume

suite = Suite()

VALUE = 0.2  # of every voxel; colour and opacity after half the box
UNIT = 0.5
DATA = constant(51, (2, 2, 2))


def left(length):
    return premultiplied((VALUE,) * 3, opacity(VALUE, length, UNIT))


def plane(a, b, c, d, fields=""):
    return f"ClipPlane {{ plane {a} {b} {c} {d} {fields} }}\n"


def group(*parts, fields=""):
    return f"Transform {{ {fields} children [\n{''.join(parts)}] }}\n"


def ahead(rows):
    """The ray through the middle, along -z: name, content, the length that is left."""
    for name, content, length in rows:
        suite.close(name, suite.middle(front_scene(content)), left(length))


NEAR, FAR = plane(0, 0, -1, 0), plane(0, 0, 1, 0)  # the halves that they take away
CUBE = volume(DATA)


@suite.case
def halves():
    "T21: the optical depth is that of the length that a plane leaves, on either side"
    ahead((
        ("the near half", group(NEAR, CUBE), 0.5),
        ("the far half", group(FAR, CUBE), 0.5),
        ("a quarter of the far side", group(plane(0, 0, 1, 0.25), CUBE), 0.75),
        ("a plane of another length", group(plane(0, 0, -3, 0.3), CUBE), 0.6),
        ("a plane beyond", group(plane(0, 0, 1, 0.7), CUBE), 1),
        ("a plane that leaves nothing", group(plane(0, 0, 1, -0.7), CUBE), 0),
        ("along the ray, on this side", group(plane(1, 0, 0, 0.1), CUBE), 1),
        ("along the ray, on the other", group(plane(1, 0, 0, -0.1), CUBE), 0),
        ("disabled", group(plane(0, 0, 1, 0, "enabled FALSE"), CUBE), 1),
        ("two", group(plane(0, 0, 1, 0.2), plane(0, 0, -1, 0.1), CUBE), 0.3),
        ("two that leave nothing", group(plane(0, 0, 1, -0.2), plane(0, 0, -1, -0.1), CUBE), 0),
        ("in groups around", group(FAR, group(plane(0, 0, -1, 0.1), group(CUBE))), 0.1),
        ("elsewhere", group(FAR) + CUBE, 1),
        ("turned round with its group", group(plane(0, 0, 1, 0.2), CUBE, fields="rotation 0 1 0 3.14159265"), 0.7),
        ("its place is that of its group", group(FAR, group(CUBE, fields="translation 0 0 0.25")), 0.75),
    ))


@suite.case
def oblique():
    "T21: an oblique plane, and under scale 2 1 1"
    pixels = [(i, 4) for i in range(2, 6)]
    places = [-0.375, -0.125, 0.125, 0.375]
    for name, content, scale in (
        ("oblique", group(plane(1, 0, 1, 0), CUBE), 1),
        ("scaled", group(plane(1, 0, 1, 0), CUBE, fields="scale 2 1 1"), 2),
        ("scaled around the plane's group", group(plane(1, 0, 2, 0), group(CUBE, fields="scale 2 1 1")), 2),
    ):
        got = suite.probe(front_scene(content), pixels, size="8x8")
        for x, color in zip(places, got):
            suite.close(f"{name} at {x}", color, left(0.5 + x / scale))


@suite.case
def own_planes():
    "clipPlanes of a volume: in its coordinates, for it alone"
    cut = volume(DATA, fields=f"clipPlanes [ {FAR} {plane(0, 0, -1, 0.3)} ]")
    ahead((
        ("two", cut, 0.3),
        ("turned round with it", group(cut, fields="rotation 0 1 0 3.14159265"), 0.3),
        ("disabled", volume(DATA, fields="clipPlanes ClipPlane { plane 0 0 1 0 enabled FALSE }"), 1),
        ("and the scene's", group(plane(0, 0, -1, 0.1), cut), 0.1),
    ))
    stretched = group(volume(DATA, fields=f"clipPlanes {FAR}"), fields="scale 1 1 3")
    suite.close("stretched with it: lengths are its own", suite.middle(front_scene(stretched)), left(0.5))
    # two in one box, one of them cut: the other one is whole
    both = volume(DATA, fields=f"clipPlanes {FAR}") + volume(DATA)
    through = 1 - (1 - opacity(VALUE, 0.5, UNIT)) * (1 - opacity(VALUE, 1, UNIT))
    suite.close("one of two that overlap", suite.middle(front_scene(both)), premultiplied((VALUE,) * 3, through))


@suite.case
def spared():
    "ignoreClipPlanes: planes of the scene spare this volume, its own and its crop box do not"
    ahead((
        ("spared", group(FAR, volume(DATA, fields="ignoreClipPlanes TRUE")), 1),
        ("not its own", group(FAR, volume(DATA, fields=f"ignoreClipPlanes TRUE clipPlanes {plane(0, 0, -1, 0.2)}")), 0.7),
        ("not its box", group(FAR, volume(DATA, fields="ignoreClipPlanes TRUE cropMin 0 0 .4")), 0.6),
    ))
    both = group(FAR, volume(DATA, fields="ignoreClipPlanes TRUE"), volume(DATA))
    through = 1 - (1 - opacity(VALUE, 1, UNIT)) * (1 - opacity(VALUE, 0.5, UNIT))
    suite.close("one of two", suite.middle(front_scene(both)), premultiplied((VALUE,) * 3, through))


@suite.case
def boxes():
    "cropMin and cropMax: a box in texture coordinates, whatever the volume's size and place"
    ahead((
        ("from behind", volume(DATA, fields="cropMin 0 0 .3"), 0.7),
        ("from the front", volume(DATA, fields="cropMax 1 1 .3"), 0.3),
        ("both", volume(DATA, fields="cropMin 0 0 .25 cropMax 1 1 .75"), 0.5),
        ("more than all", volume(DATA, fields="cropMin -1 -1 -1 cropMax 2 2 2"), 1),
        ("nothing", volume(DATA, fields="cropMin 0 0 .6 cropMax 1 1 .4"), 0),
        ("beside the ray", volume(DATA, fields="cropMin .6 0 0"), 0),
        ("with a plane", group(plane(0, 0, -1, 0), volume(DATA, fields="cropMin 0 0 .3")), 0.2),
    ))
    long = volume(DATA, fields="cropMin 0 0 .25 opacityUnitDistance .5", dimensions=(1, 1, 2))
    suite.close("a long box", suite.middle(front_scene(long)), left(1.5))
    turned = group(volume(DATA, fields="cropMin .25 0 0"), fields="rotation 0 1 0 1.57079633")
    suite.close("turned", suite.middle(front_scene(turned)), left(0.75))
    got = suite.probe(front_scene(volume(DATA, fields="cropMin .25 .5 0 cropMax .75 1 1")),
                      [(x, 3) for x in range(8)] + [(3, 4)], size="8x8")
    for x, color in enumerate(got[:8]):
        suite.close(f"the sides, column {x}", color, left(1 if x in (3, 4) else 0))
    suite.close("the lower half", got[8], left(0))


@suite.case
def moving():
    "planes and boxes that move"
    timed = group("DEF P ClipPlane { plane 0 0 -1 0 }", "DEF V " + CUBE) + (
        "DEF T TimeSensor { loop TRUE cycleInterval 4 }\n"
        "DEF I PositionInterpolator { key [0 1] keyValue [0 0 0 0 0 1] }\n"
        "DEF S ScalarInterpolator { key [0 1] keyValue [0 1] }\n"
        "ROUTE T.fraction_changed TO I.set_fraction ROUTE I.value_changed TO V.cropMin\n")
    for time in (0.4, 1, 1.6, 3):  # the far part goes first, the near half is not there
        got = suite.middle(front_scene(timed), "--time", time)
        suite.close(f"a box at {time}", got, left(max(0.5 - time / 4, 0)))
    timed = group(group(FAR.replace("ClipPlane", "DEF P ClipPlane"), CUBE)) + (
        "DEF T TimeSensor { loop TRUE cycleInterval 4 }\n"
        "DEF B BooleanSequencer { key [0 0.5] keyValue [FALSE TRUE] }\n"
        "ROUTE T.fraction_changed TO B.set_fraction ROUTE B.value_changed TO P.enabled\n")
    for time, length in ((1, 1), (3, 0.5)):
        suite.close(f"a plane at {time}", suite.middle(front_scene(timed), "--time", time), left(length))


SHEET = volume(DATA, fields="opacityUnitDistance .001", dimensions=(1, 1, 0.001))  # 10 from the eye


@suite.case
def fog():
    "fog takes a sample's colour as that of a surface at its distance, and leaves its opacity"
    def fogged(color, share):
        return premultiplied([c * (1 - share) + VALUE * share for c in color], VALUE)

    color = (1, 0.5, 0)
    for name, fields, share in (
        ("linear", "visibilityRange 40", 0.75),
        ("exponential", 'visibilityRange 40 fogType "EXPONENTIAL"', math.exp(-10 / 30)),
        ("none", "visibilityRange 0", 1),
        ("out of sight", "visibilityRange 8", 0),
    ):
        for node in ("Fog", "LocalFog"):
            text = front_scene(f"{node} {{ color 1 .5 0 {fields} }}\n", SHEET)
            suite.close(f"{node}, {name}", suite.middle(text), fogged(color, share), 3e-4)
    text = front_scene("Group { children LocalFog { color 1 .5 0 visibilityRange 40 } }\n", SHEET)
    suite.close("elsewhere", suite.middle(text), fogged(color, 1))
    deep = front_scene("Fog { color 1 0 0 visibilityRange 40 }\n", volume(constant(255), fields=""))
    suite.close("an opaque box: its front", suite.middle(deep, "--step", "0.01"), (1, 1 - 9.5 / 40, 1 - 9.5 / 40, 1), 1e-3)


@suite.case
def paid_for():
    "a scene without planes, boxes or fog has none in its program"
    def program(content):
        result = suite.command("dump", "scene.x3dv", "-d", "out", files={"scene.x3dv": front_scene(content)})
        with open(f"{result.folder}/out/volume-1.frag", encoding="utf-8") as file:
            return file.read()

    bare, full = program(CUBE), program("Fog { visibilityRange 9 }\n" + group(FAR, volume(DATA, fields="cropMin 0 0 .1")))
    for word in ("fog_interpolant", "plane"):
        suite.check(f"{word} where it is asked for", word in full)
        suite.check(f"no {word} without", word not in bare)


@suite.case
def fog_of_authors():
    "fog_apply is of surfaces: an author's function there does not reach volumes"
    code = ("void PLUG_fog_apply(inout vec4 fragment_color, const in vec3 normal_eye)"
            "{ fragment_color = vec4(0.0, 1.0, 0.0, 1.0); }")
    plain = front_scene(volume(constant(102, (2, 2, 2))))
    group = front_scene("Group { children [", effect(code), volume(constant(102, (2, 2, 2))), "] }")
    suite.close("as without", suite.middle(group), suite.middle(plain), 0)
    suite.equal("nothing is said", suite.render(group, "--probe", "8,8").messages(), [])


suite.run()
