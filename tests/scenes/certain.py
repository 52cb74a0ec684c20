#!/usr/bin/env python3
"""Where values and functions change little the planner takes long steps, and says a bound that they keep; elsewhere,
and where somebody else has a say, it does not."""

import json
import math

from harness import Suite, opacity, premultiplied
from scenes import constant, effect, front_scene, volume, voxels

suite = Suite()

SIDE = 8
UNIT = 0.25
EVEN = "0xff802040 0xff802040"
NEARLY = "0xff802040 0xff802044"
STEEP = "0x0000ff00 0xff8020ff"


def mapped(texels, count=2):
    return f"OpacityMapVolumeStyle {{ transferFunction PixelTexture {{ image {count} 1 4 {texels} }} }}"


def scene(data, texels=EVEN, effects="", style=None, fields=""):
    return front_scene(volume(data, style or mapped(texels), effects, f"opacityUnitDistance {UNIT} {fields}"))


def ramp(step):
    return voxels(1, (SIDE, SIDE, SIDE), [step * x for _ in range(SIDE * SIDE) for x in range(SIDE)])


def noise():
    return voxels(1, (SIDE, SIDE, SIDE), [i * i * 7 % 251 for i in range(SIDE**3)])


def planned(text, *arguments):
    result = suite.command("render", "scene.x3dv", "-o", "out.png", "--size", "8x8", "--stats", "json", *arguments,
                           files={"scene.x3dv": text})
    found = json.loads(result.output)
    return found["error"], found["plan"]


def expect(name, text, method, kind, *arguments):
    error, plan = planned(text, *arguments)
    suite.check(name, plan["method"] == method and error["kind"] == kind, plan, error)
    return plan


@suite.case
def values_that_do_not_matter():
    "one step for the whole ray, if the function is the same for all values; the closed form is kept"
    text = scene(noise())
    plan = expect("plan", text, "midpoint", "bounded")
    suite.check("one step", plan["step"] >= SIDE * math.sqrt(3), plan)
    picture = suite.picture(text, size="8x8")
    rgb = [0xff / 255, 0x80 / 255, 0x20 / 255]
    alpha = opacity(0x40 / 255, 1, UNIT)
    suite.close("colour", picture.at(4, 4), premultiplied(rgb, alpha), 2e-3)


@suite.case
def little_changes():
    "the longer the less changes, and the more the greater the error that may be"
    steps = [expect(f"{name}, --error {error}", scene(data, NEARLY), "midpoint", "bounded", "--error", error)["step"]
             for name, data, error in (("steep", ramp(30), "1/1023"), ("gentle", ramp(2), "1/1023"),
                                       ("gentle", ramp(2), "1/64"))]
    suite.check("in this order", steps[0] < steps[1] <= steps[2], steps)


@suite.case
def much_changes():
    expect("noise behind a steep function", scene(noise(), STEEP), "cells", "bounded")
    expect("a jump", scene(ramp(30), style=mapped("0xff802010 0xff802010 0x00ff00f0 0x00ff00f0", 4)), "cells", "bounded")


@suite.case
def opaque_values():
    "a function that is opaque for all values is certain; one that is for some is not"
    expect("for all", scene(noise(), "0xff8020ff 0xff8020ff"), "midpoint", "bounded")
    expect("for some", scene(noise(), STEEP), "cells", "bounded")


@suite.case
def segments():
    "each has a function of its own: where they meet there is a jump"
    labels = "segmentIdentifiers PixelTexture3D { image [ 1 2 1 1 0 1 ] }"
    text = front_scene(f"SegmentedVolumeData {{ voxels {constant(90, (2, 1, 1))} {labels} "
                       f"renderStyle [ {mapped(EVEN)} {mapped(NEARLY)} ] }}")
    error, plan = planned(text)
    suite.check("no long steps", plan["method"] == "cells" or error["kind"] == "estimated", plan, error)


@suite.case
def what_was_asked_for():
    expect("steps", scene(noise()), "midpoint", "estimated", "--step", "1")
    expect("cells", scene(noise()), "cells", "bounded", "--method", "cells")
    expect("midpoint", scene(noise()), "midpoint", "estimated", "--method", "midpoint")


@suite.case
def somebody_else_has_a_say():
    red = effect("void PLUG_volume_shade(inout vec4 color, const in VolumeSample s) { color.r = 1.0; }")
    for name, text in (
            ("an effect", scene(noise(), effects=red)),
            ("a style", scene(noise(), style=f"ComposedVolumeStyle {{ renderStyle [ {mapped(EVEN)} "
                                             "EdgeEnhancementVolumeStyle { } ] }"))):
        error, _ = planned(text)
        suite.check(name, error["kind"] == "estimated", error)


@suite.case
def several_in_one_place():
    "their errors add up"
    one = volume(ramp(2), mapped(NEARLY), "", f"opacityUnitDistance {UNIT}")
    alone = expect("one", front_scene(one), "midpoint", "bounded", "--error", "1/1023")
    both = expect("two", front_scene(one, one), "midpoint", "bounded", "--error", "1/1023")
    suite.check("shorter steps", both["step"] < alone["step"], both, alone)
    many = expect("six", front_scene(*[one] * 6), "midpoint", "bounded", "--error", "1/64")
    suite.check("more than cells can be cut for", many["step"] > 0, many)
    expect("with one that is not even", front_scene(one, volume(noise(), mapped(STEEP))), "cells", "bounded")


suite.run()
