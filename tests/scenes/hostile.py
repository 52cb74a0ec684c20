#!/usr/bin/env python3
"""Scenes that nobody should write: an answer in time, an error or a defined picture, no crash, no NaN."""

import math
import struct

from harness import Suite, opacity
from scenes import constant, effect, front_scene, quad, volume

suite = Suite()

GREEN = "Transform { translation 0 0 -2 children [ " + quad("UnlitMaterial { emissiveColor 0 1 0 }") + " ] }\n"


def survives(name, text, files=None, drawn=True, arguments=()):
    """Ends with status 0 or 1 and numbers; what is beside the fault is drawn."""
    result = suite.render(text, "--probe", "8,8", *arguments, files=files, status=None)
    words = result.output.split()
    fine = result.status in (0, 1) and (not drawn or len(words) == 4)
    numbers = [float(w) for w in words]
    fine = fine and all(math.isfinite(v) for v in numbers)
    suite.check(name, fine, f"exit status {result.status}", result.output, result.errors[:600])
    return numbers, result


@suite.case
def degenerate_volumes():
    "sizes and places that make no sense"
    data = constant(128, (2, 2, 2))
    for name, text in (
        ("dimensions 0", volume(data, dimensions=(0, 1, 1))),
        ("negative dimensions", volume(data, dimensions=(-1, 1, 1))),
        ("scale 0", "Transform { scale 1 1 0 children [ " + volume(data) + " ] }\n"),
        ("tiny scale", "Transform { scale 1e-30 1e-30 1e-30 children [ " + volume(data) + " ] }\n"),
        ("negative reference length", volume(data, fields="opacityUnitDistance -1")),
        ("empty image", volume("PixelTexture3D { }")),
        ("too few values", volume("PixelTexture3D { image [1 2 2 2 1 2 3] }")),
        ("size that cannot be", volume("PixelTexture3D { image [1 2000000000 2000000000 2000000000 1] }")),
        ("negative size", volume("PixelTexture3D { image [1 -2 2 2 1] }")),
        ("nine components", volume("PixelTexture3D { image [9 1 1 1 1] }")),
        ("valueRange backwards", volume(data, fields="valueRange 1 -1")),
    ):
        numbers, _ = survives(name, front_scene(text, GREEN))
        suite.check(f"{name}: the rest is drawn", numbers and numbers[3] > 0.999, numbers)


@suite.case
def not_numbers():
    "NaN and infinities in data"
    values = [0.0, 1.0, math.nan, math.inf, -math.inf, 0.5, 0.5, 0.5]
    head = b"NRRD0004\ntype: float\ndimension: 3\nsizes: 2 2 2\nencoding: raw\nendian: little\n\n"
    files = {"n.nrrd": head + struct.pack("<8f", *values)}
    for style in ("", "ShadedVolumeStyle { lighting TRUE }"):
        text = front_scene("DirectionalLight { }\n", volume('ImageTexture3D { url "n.nrrd" }', style), GREEN)
        picture = suite.picture(text, files=files, size="32x32", status=None)
        suite.check(f"{style or 'bare'}: no NaN in the picture",
                    all(math.isfinite(v) for v in picture.values) and max(picture.values) > 0.5)


@suite.case
def effects_that_go_wrong():
    "effects that write NaN and infinities, loop long, or cut in the wrong way"
    data = constant(128, (2, 2, 2))
    zero = "float zero() { return 0.0; }\n"
    plugs = {
        "volume_ray": "void PLUG_volume_ray(inout float a, inout float b, const in vec3 o, const in vec3 d)"
                      "{ a = -1.0 / zero(); b = 1.0 / zero(); }",
        "volume_sample": "void PLUG_volume_sample(inout VolumeSample s) { s.value = vec4(0.0) / zero(); }",
        "volume_classify": "void PLUG_volume_classify(inout vec4 c, const in VolumeSample s) { c = vec4(1.0) / zero(); }",
        "volume_shade": "void PLUG_volume_shade(inout vec4 c, const in VolumeSample s) { c = vec4(0.0) / zero(); }",
    }
    for name, code in plugs.items():
        survives(name, front_scene(volume(data, effects=effect(zero + code)), GREEN))


@suite.case
def cycles():
    "scenes that contain themselves"
    for name, text in (
        ("group", "DEF G Group { children [ USE G " + GREEN + " ] }\n"),
        ("inline", 'Inline { url "scene.x3dv" }\n' + GREEN),
        ("proto", "PROTO P [ ] { Group { children P { } } }\nP { }\n" + GREEN),
        ("externproto", 'EXTERNPROTO P [ ] "scene.x3dv#P"\nP { }\n' + GREEN),
        ("effect", quad("UnlitMaterial { }", "DEF E Effect { parts USE E }") + GREEN),
    ):
        survives(name, front_scene(text), drawn=False)


@suite.case
def deep_and_many():
    "depth and number have limits or are just drawn"
    deep = 20000
    survives("deep groups", front_scene("Group { children " * deep + GREEN + " }" * deep), drawn=False)
    xml = ("<X3D><Scene>" + "<Group>" * deep + "</Group>" * deep + "</Scene></X3D>")
    survives("deep groups in XML", xml, drawn=False)
    survives("many shapes", front_scene(*[f"Transform {{ translation {i} 0 -1 children USE Q }}\n" if i else
                                          quad("UnlitMaterial { emissiveColor 0 1 0 }").replace(
                                              "Shape {", "DEF Q Shape {", 1) for i in range(2000)]))
    survives("many lights", front_scene("DirectionalLight { intensity .01 }\n" * 60, quad("Material { }")))


@suite.case
def many_volumes():
    "more volumes than textures fit into a program: some are layers, with a warning at them; all are drawn"
    text = front_scene(volume(constant(9)) * 40)
    numbers, result = survives("ends", text)
    found = result.messages()
    suite.check("a warning with a place", found and all(m[3] == "warning" and m[5] == "layered" and m[1] > 0
                                                        for m in found), result.errors)
    suite.check("drawn", numbers and numbers[3] >= opacity(9 / 255, 10, 1) - 1e-4, numbers)


@suite.case
def doubling():
    "2^25 shapes in a few lines: an error"
    text = front_scene("DEF A Group { children [ " + GREEN + " ] }\n" + "".join(
        f"DEF {chr(65 + i)} Group {{ children [ USE {chr(64 + i)} USE {chr(64 + i)} ] }}\n"
        for i in range(1, 26)))
    result = suite.render(text, "--probe", "8,8", status=1)
    suite.check("limit", result.with_code("limit"), result.errors)


@suite.case
def hostile_text():
    "text that is broken in odd places"
    for name, code in (
        ("empty part", ""), ("only a comment", "/* nothing */"), ("lone quote", "void f() { ' }"),
        ("unbalanced", "}}}}}} void PLUG_fragment_modify(inout vec4 c) {"),
        ("deep parentheses", "void PLUG_fragment_modify(inout vec4 c) { c.r = " + "(" * 5000 + "1.0" + ")" * 5000 + "; }"),
        ("deep conditionals", "#if 1\n" * 3000 + "#endif\n" * 3000),
        ("macro of itself", "#define A A A A\nvoid PLUG_fragment_modify(inout vec4 c) { c.r = float(A); }"),
        ("bytes", "void PLUG_fragment_modify(inout vec4 c) { /* \x01\x02\x7f */ c.r = 0.5; }"),
        ("include", "#include <stdio.h>\nvoid PLUG_fragment_modify(inout vec4 c) { c.r = 0.5; }"),
        ("main", "void main() { }\nvoid PLUG_fragment_modify(inout vec4 c) { c.r = 0.5; }"),
        ("reserved", "float gl_Mine = 1.0;\nvoid PLUG_fragment_modify(inout vec4 c) { c.r = gl_Mine; }"),
        ("long line", "void PLUG_fragment_modify(inout vec4 c) { c.r = 0.0" + " + 0.0" * 20000 + "; }"),
    ):
        numbers, _ = survives(name, front_scene(quad(
            "UnlitMaterial { emissiveColor 0 0 0 }", effect(code) + effect(
                "void PLUG_fragment_modify(inout vec4 color) { color.b = 0.5; }"))))
        suite.check(f"{name}: its neighbour is drawn", numbers and abs(numbers[2] - 0.5) < 1e-3, numbers)


@suite.case
def hostile_pictures():
    "pictures and volumes whose headers lie"
    head = b"NRRD0004\ntype: float\ndimension: 3\nsizes: %s\nencoding: raw\nendian: little\n\n"
    for name, content in (("huge", head % b"99999 99999 99999"), ("overflow", head % b"4294967297 4294967297 2"),
                          ("negative", head % b"-1 2 2"), ("zero", head % b"0 2 2"),
                          ("no sizes", b"NRRD0004\ntype: float\n\n"), ("text", b"NRRD0004\n" + b"x" * 100000)):
        result = suite.render(front_scene(volume('ImageTexture3D { url "n.nrrd" }'), GREEN), "--probe", "8,8",
                              files={"n.nrrd": content}, status=1)
        suite.equal(f"{name}: one error", [m[3] for m in result.messages()], ["error"])
        suite.close(f"{name}: the rest", [float(w) for w in result.output.split()], (0, 1, 0, 1))


suite.run()
