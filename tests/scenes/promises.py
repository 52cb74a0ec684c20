#!/usr/bin/env python3
"""`check --trust`: effects are asked what they make of many samples, and a promise that is broken is found."""

import os
import sys

from harness import Suite, load_json
from scenes import effect, effect_parts, front_scene, volume, voxels

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "tools", "bench"))
from speed.scenes import lighting  # noqa: E402

suite = Suite()
RAMP = [4 * i for i in range(64)]  # values from 0 to 252/255


def shade(body, plug="shade", head=""):
    return f"{head}\nvoid PLUG_volume_{plug}(inout vec4 color, const in VolumeSample s) {{ {body} }}"


def promise(words, code):
    return f"/* PLUG-PROMISE: {words} */\n{code}"


def data(components=1):
    values = [v if components == 1 else v << 8 | 255 - v for v in RAMP]
    return voxels(components, (4, 4, 4), values)


def check(text, *arguments, status=0, files=None):
    """The scene and what is said of it, as a list of (line, column, severity, code, message)."""
    done = suite.command("check", "--trust", "--no-cache", "--format", "json", "scene.x3dv", *arguments,
                         files={"scene.x3dv": text, **(files or {})}, status=status)
    return [(d["line"], d["column"], d["severity"], d["code"], d["message"]) for d in load_json(done.output)]


def line_of(text, mark):
    """The line of the promise before a mark in the code."""
    return text[: text.rindex("PLUG-PROMISE", 0, text.index(mark))].count("\n") + 1


# Functions that keep what they promise, and such as do not; each has a mark of its own in a comment.
HONEST = [
    ("colour-only", shade("color.rgb = color.gbr * 3.0 + s.value.r;")),
    ("color-only", shade("if (s.value.r > 0.5) color.rgb = vec3(color.a);", "classify")),
    ("keeps-transparent", shade("color.a *= 1.0 + 50.0 * s.value.r;")),
    ("keeps-transparent", shade("if (color.a > 0.0) color = vec4(0.5);", "classify")),
    ("colour-only keeps-transparent", shade("color.rgb *= s.normal_eye * s.gradient + s.position_eye;")),
    ("lipschitz 2", shade("")),
    ("lipschitz 1", shade("color = vec4(1.0, 1.0, 1.0, s.value.r);", "classify")),
    ("lipschitz 10.1", shade("color = vec4(1.0, 1.0, 1.0, clamp(10.0 * s.value.r - 4.0, 0.0, 1.0));")),
    ("lipschitz 0.001", shade("color = vec4(s.position * s.gradient, 0.25);")),
    ("colour-only lipschitz 3", shade("color.rgb = 1.0 - color.rgb;", head="/* two promises */")),
]
BROKEN = [
    ("colour-only", shade("color.a *= 0.5;"), "colour-only is broken: alpha"),
    ("colour-only", shade("color.a *= s.value.r > 0.9 ? 0.5 : 1.0;"), "colour-only is broken: alpha"),
    ("color-only", shade("if (s.value.r > 0.9 && color.r < 0.1) color.a = 0.31;", "classify"),
     "colour-only is broken: alpha"),
    ("colour-only", shade("if (s.position.x > 0.98) color.a = 0.31;"), "place 0.9"),
    ("colour-only", shade("if (s.normal_eye == vec3(0.0) && color.a == 1.0) color.a = 0.9;"),
     "alpha 1 becomes 0.9"),
    ("keeps-transparent", shade("color.a += 0.01;"), "keeps-transparent is broken: alpha 0 becomes 0.01"),
    ("keeps-transparent", shade("if (color.a == 0.0 && s.value.r == 1.0) color.a = -0.5;"),
     "alpha 0 becomes -0.5 at value 1 "),
    ("keeps-transparent colour-only", shade("color.a = max(color.a, 0.1);"), "colour-only is broken: alpha"),
    ("lipschitz 1.5", shade(""), "lipschitz 1.5 is broken"),
    ("lipschitz 12.5", shade("color.a = step(0.9, s.value.r);"), "lipschitz 12.5 is broken"),
    ("lipschitz 12.5", shade("color.rgb *= smoothstep(0.5, 0.51, s.value.r);", "classify"),
     "lipschitz 12.5 is broken"),
    ("lipschitz 9", shade("color = vec4(1.0, 1.0, 1.0, clamp(10.0 * s.value.r - 4.0, 0.0, 1.0));"),
     "lipschitz 9 is broken"),
    ("colour-only", shade("color.rgb /= color.a;"), " becomes "),
    ("lipschitz 1000000", shade("color.r = color.a == 0.0 ? 1.0 / color.a : color.r;"), "lipschitz 1e+06 is broken"),
    ("keeps-transparent", shade("color.rgb = log(color.rgb);"), "keeps-transparent is broken: colour"),
]


def marked(rows):
    return [effect(promise(row[0], row[1] + f" // mark {i};")) for i, row in enumerate(rows)]


@suite.case
def honest():
    "what is promised and kept is passed in silence"
    text = front_scene("", volume(data(), "OpacityMapVolumeStyle { }", effects=" ".join(marked(HONEST))))
    suite.equal("nothing is said", check(text), [])


@suite.case
def broken():
    "each effect that breaks a promise is found, at its promise, and no other"
    effects = [e for pair in zip(marked(BROKEN), marked(HONEST) + [""] * len(BROKEN)) for e in pair]
    text = front_scene("", volume(data(), "OpacityMapVolumeStyle { }", effects=" ".join(effects)))
    lines = text.splitlines()
    found = check(text, status=1)
    # the row before each function has the promise
    places = [i + 1 for i, line in enumerate(lines) if "PLUG-PROMISE" in line
              and any(f"{row[1].strip()} // mark {k};" == lines[i + 2] and row[0] in line
                      for k, row in enumerate(BROKEN))]
    suite.equal("so many lines", len(places), len(BROKEN))
    suite.equal("all of them and nothing else", [(f[0], f[1], f[2], f[3]) for f in found],
                [(line, 1, "error", "broken-promise") for line in places])
    for (words, code, said), one in zip(BROKEN, found):
        suite.check(f"{words}: {code.split('{', 1)[1]}", said in one[4], one)
    suite.equal("again, the same", check(text, status=1), found)


@suite.case
def uniforms():
    "functions have the uniforms that the scene gives them"
    code = promise("colour-only", shade("color.a *= factor;", head="uniform float factor = 1.0;"))
    for factor, status in (("1", 0), ("0.5", 1)):
        text = front_scene("", volume(data(), "OpacityMapVolumeStyle { }",
                                      effects=effect(code, fields=f"inputOutput SFFloat factor {factor}")))
        found = check(text, status=status)
        suite.equal(f"a factor of {factor}", [f[3] for f in found], ["broken-promise"] * status)
    suite.equal("set on the command line", [f[3] for f in check(
        front_scene("", volume(data(), "OpacityMapVolumeStyle { }", effects=effect(
            code, fields="inputOutput SFFloat factor 1", head="DEF E"))), "--set", "E.factor=0.5", status=1)],
        ["broken-promise"])
    picture = "inputOutput SFNode table PixelTexture { image 2 1 1 0xFF %s }"
    code = promise("colour-only", shade("color.a *= texture(table, vec2(s.value.r, 0.5)).r;",
                                        head="uniform sampler2D table;"))
    for texel, status in (("0xFF", 0), ("0xFA", 1)):
        text = front_scene("", volume(data(), "OpacityMapVolumeStyle { }",
                                      effects=effect(code, fields=picture % texel)))
        suite.equal(f"a texture of 0xFF and {texel}", [f[3] for f in check(text, status=status)],
                    ["broken-promise"] * status)


@suite.case
def volumes():
    "each volume's own data, a group's effect on all, several components, segments, surfaces of value"
    rare = promise("colour-only", shade("if (s.value.g > 0.0 && s.value.b == 0.0) color.a = 0.5;"))
    text = front_scene("", volume(data(), "OpacityMapVolumeStyle { }", effects=effect(rare)))
    suite.equal("one component: the others are 0", check(text), [])
    text = front_scene("", volume(data(2), "OpacityMapVolumeStyle { }", effects=effect(rare)))
    found = check(text, status=1)
    suite.equal("two components", [f[3] for f in found], ["broken-promise"])
    suite.check("both are told", "at value " in found[0][4] and
                len(found[0][4].split("at value ")[1].split(" (")[0].split()) == 2, found)
    both = ("Group { children [ %s\n%s\nTransform { translation .2 0 .1 children %s } ] }" % (
        effect(promise("keeps-transparent", shade("color.a = mix(color.a, 0.5, float(s.volume == 1));")), head="DEF G"),
        volume(data(), "OpacityMapVolumeStyle { }"), volume(data(), "")))
    found = check(front_scene("", both), status=1)
    suite.equal("of a group: on its second volume", [f[3] for f in found], ["broken-promise"])
    numbers = data()
    for node in ('SegmentedVolumeData { renderStyle [ OpacityMapVolumeStyle { } ] segmentIdentifiers ' + numbers,
                 'IsoSurfaceVolumeData { surfaceValues 0.5 renderStyle [ ]'):
        text = front_scene("", "%s voxels %s effects [ %s %s ] }" % (
            node, numbers, effect(promise("colour-only", shade("color.r = 1.0;"))),
            effect(promise("colour-only", shade("color.a = 0.7;")))))
        suite.equal(node.split()[0], [f[3] for f in check(text, status=1)], ["broken-promise"])


@suite.case
def units():
    "several units: each function is called; the error is where the first one promises"
    good = promise("colour-only", shade("color.r = 1.0;"))
    bad = promise("colour-only", shade("color.a = 0.5;", "classify"))
    text = front_scene("", volume(data(), "OpacityMapVolumeStyle { }",
                                  effects=effect_parts([("FRAGMENT", good), ("FRAGMENT", bad)])))
    found = check(text, status=1)
    second = [i + 1 for i, line in enumerate(text.splitlines()) if "PLUG-PROMISE" in line][1]
    suite.equal("the second unit's promise", [(f[0], f[3]) for f in found], [(second, "broken-promise")])
    text = front_scene("", volume(data(), "OpacityMapVolumeStyle { }", effects=effect_parts(
        [("FRAGMENT", good), ("FRAGMENT", shade("color.a = 0.5;", "classify"))])))
    suite.equal("one unit promises nothing: nothing is promised", check(text), [])
    twice = promise("lipschitz 3", "void PLUG_volume_shade(inout vec4 c, const in VolumeSample s) "
                    "{ c = vec4(1.0, 1.0, 1.0, clamp(3.0 * c.a, 0.0, 1.0)); }")
    text = front_scene("", volume(data(), "OpacityMapVolumeStyle { }",
                                  effects=effect_parts([("FRAGMENT", twice), ("FRAGMENT", twice)])))
    suite.equal("two functions in a row may change three times three times as much", check(text), [])


@suite.case
def untested():
    "what is not tested is told; without --trust nothing is tested"
    code = promise("colour-only", "void PLUG_volume_sample(inout VolumeSample s) { s.value.r = 0.5; }")
    text = front_scene("", volume(data(), "OpacityMapVolumeStyle { }", effects=effect(code)))
    found = check(text)
    suite.equal("no function that gets a colour", [(f[2], f[3]) for f in found], [("info", "promise")])
    code = promise("colour-only", "void PLUG_main_texture_apply(inout vec4 c, const in vec3 n) { c.a = 0.5; }")
    text = front_scene("", "Shape { appearance Appearance { material Material { } effects %s } geometry Box { } }"
                       % effect(code))
    found = check(text)
    suite.equal("on a surface", [(f[2], f[3]) for f in found], [("info", "promise")])
    text = front_scene("", volume(data(), "OpacityMapVolumeStyle { }", effects=effect(promise(
        "colour-only", shade("color.r *= ray_speed;")))))
    found = check(text)
    suite.equal("what only a ray has", [(f[2], f[3]) for f in found], [("info", "promise")])
    liar = front_scene("", volume(data(), "OpacityMapVolumeStyle { }", effects=effect(promise(
        "colour-only", shade("color.a = 0.5;")))))
    done = suite.command("check", "scene.x3dv", files={"scene.x3dv": liar})
    suite.equal("not asked to", done.errors, "")
    faulty = front_scene("", volume(data(), "OpacityMapVolumeStyle { }", effects=effect(promise(
        "colour-only", shade("color.q = nonsense;")))))
    suite.equal("an effect that does not compile", [f[3] for f in check(faulty, status=1)][:1], ["glsl"])


@suite.case
def placed():
    "wherever the effect is placed, its functions are tested"
    for fields in ('placement "REPLACE" target "OpacityMapVolumeStyle"', 'placement "ADD_BEFORE"',
                   'placement "ADD_AFTER" target "ShadedVolumeStyle" onlyIfActive TRUE'):
        text = front_scene("", volume(data(), "OpacityMapVolumeStyle { }", effects=effect(
            promise("colour-only", shade("color.a *= 0.5;", "classify")), fields=fields)))
        found = check(text, status=1 if "onlyIf" not in fields else None)
        suite.check(fields, "broken-promise" in [f[3] for f in found], found)


@suite.case
def bench():
    "the light of VTK as an effect, as the benchmarks have it"
    text = front_scene("", volume(data(), "OpacityMapVolumeStyle { }", effects=lighting(4)))
    suite.equal("its promise is kept", check(text), [])
    suite.equal("on OSMesa", check(text, "--backend", "osmesa"), [])


if __name__ == "__main__":
    suite.run()
