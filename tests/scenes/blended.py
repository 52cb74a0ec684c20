#!/usr/bin/env python3
"""BlendedVolumeStyle: another volume in the same box; ISO/IEC 19775-1 V4 41.4.1."""

from harness import Suite, opacity, premultiplied
from scenes import constant, effect, front_scene, voxels

suite = Suite()


def clamp(v):
    return min(max(v, 0.0), 1.0)


def one_color(rgba, fields=""):
    return f"OpacityMapVolumeStyle {{ {fields} transferFunction PixelTexture {{ image 1 1 4 0x{rgba:08X} }} }}"


def straight(rgba):
    return tuple((rgba >> shift & 255) / 255 for shift in (24, 16, 8, 0))


FIRST, SECOND = 0xC0402099, 0x2060E0CC


def composed(*styles):
    return f"ComposedVolumeStyle {{ renderStyle [ {' '.join(styles)} ] }}"


def blended(fields="", style=one_color(SECOND), data=constant(50)):
    style = f"renderStyle {style}" if style else ""
    data = f"voxels {data}" if data else ""
    return f"BlendedVolumeStyle {{ {fields} {style} {data} }}"


def draw(style, data=constant(102), **more):
    return suite.middle(front_scene(f"VolumeData {{ opacityUnitDistance 1 voxels {data} renderStyle {style} }}\n"),
                        "--step", ".5", **more)


def mixed(w1, w2, first=FIRST, second=SECOND):
    c1, c2 = straight(first), straight(second)
    return [clamp(w1 * a + w2 * b) for a, b in zip(c1, c2)]


def seen(color):
    return premultiplied(color[:3], opacity(color[3], 1, 1) if color[3] < 1 else 1)


OV, OB = straight(FIRST)[3], straight(SECOND)[3]


@suite.case
def constants():
    "Cg = clamp(Cv w1 + Cb w2), opacities alike; each constant at several values"
    suite.close("defaults", draw(composed(one_color(FIRST), blended())), seen(mixed(0.5, 0.5)))
    for w1, w2 in ((0.2, 0.5), (0.5, 0.1), (0.9, 0.8), (0, 1), (1, 0)):
        fields = f"weightConstant1 {w1} weightConstant2 {w2}"
        suite.close(fields, draw(composed(one_color(FIRST), blended(fields))), seen(mixed(w1, w2)))


@suite.case
def functions():
    "every weight function, of both weights"
    names = {"ALPHA0": OV, "ALPHA1": OB, "ONE_MINUS_ALPHA0": 1 - OV, "ONE_MINUS_ALPHA1": 1 - OB,
             "CONSTANT": 0.5, "TABLE": None}
    for name, value in names.items():
        first = OV if value is None else value
        got = draw(composed(one_color(FIRST), blended(f'weightFunction1 "{name}"')))
        suite.close(f"first {name}", got, seen(mixed(first, 0.5)))
        second = OB if value is None else value
        got = draw(composed(one_color(FIRST), blended(f'weightFunction2 "{name}"')))
        suite.close(f"second {name}", got, seen(mixed(0.5, second)))


@suite.case
def draft_names():
    "ALPHA2 anywhere: the draft's names, ALPHA1 is Ov"
    for first, second, w1, w2 in (("ALPHA1", "ALPHA2", OV, OB), ("ALPHA2", "ALPHA1", OB, OV),
                                  ("ONE_MINUS_ALPHA1", "ONE_MINUS_ALPHA2", 1 - OV, 1 - OB)):
        fields = f'weightFunction1 "{first}" weightFunction2 "{second}"'
        suite.close(fields, draw(composed(one_color(FIRST), blended(fields))), seen(mixed(w1, w2)))
    other = composed(one_color(FIRST), blended('weightFunction1 "ALPHA1"'), blended('weightFunction1 "ALPHA2"'))
    step = mixed(OV, 0.5)
    packed = [clamp(a * OB + b * 0.5) for a, b in zip(step, straight(SECOND))]
    suite.close("in another style of the file", draw(other), seen(packed))


@suite.case
def tables():
    "TABLE: the first weight is looked up at (Ov, Ob), the second at (Ob, Ov)"
    table = "PixelTexture { image 2 2 1 0x00 0x40 0x80 0xFF }"  # (0,0) (1,0) (0,1) (1,1)
    def look(x, y):
        bottom, top = (1 - x) * 0 + x * 64 / 255, (1 - x) * 128 / 255 + x
        return (1 - y) * bottom + y * top
    fields = f'weightFunction1 "TABLE" weightTransferFunction1 {table}'
    suite.close("first", draw(composed(one_color(FIRST), blended(fields))), seen(mixed(look(OV, OB), 0.5)))
    fields = f'weightFunction2 "TABLE" weightTransferFunction2 {table}'
    suite.close("second", draw(composed(one_color(FIRST), blended(fields))), seen(mixed(0.5, look(OB, OV))))
    red = table.replace("2 2 1 0x00 0x40 0x80 0xFF", "2 2 3 0x00FFFF 0x40FFFF 0x80FFFF 0xFFFFFF")
    fields = f'weightFunction1 "TABLE" weightTransferFunction1 {red}'
    suite.close("of colours the red", draw(composed(one_color(FIRST), blended(fields))), seen(mixed(look(OV, OB), 0.5)))


@suite.case
def other_grid():
    "the second volume has its own grid, components and gradients"
    data = voxels(1, (1, 1, 4), (0, 0, 255, 255))
    fine = voxels(4, (2, 3, 2), [0x20406080] * 12)
    got = draw(blended("weightConstant1 0 weightConstant2 1", "", fine), data)
    color = straight(0x20406080)
    ramp = (0x20 + 0x40 + 0x60) / 3 / 255
    # the default map of RGBA voxels: by R, G of a 2D function: the ramp of the red value
    suite.close("its own default map", got, seen([color[0]] * 3 + [color[0]]))
    shade = ("ShadedVolumeStyle { lighting TRUE }")
    light = "DirectionalLight { direction 0 0 -1 ambientIntensity 0 }\n"
    slope = voxels(1, (1, 1, 4), (255, 170, 85, 0))  # falls towards the viewer: faces him
    style = blended("weightConstant1 0 weightConstant2 1", composed(one_color(0xFFFFFFFF), shade), slope)
    text = front_scene(light, f"VolumeData {{ voxels {constant(9)} renderStyle {style} }}\n")
    crop = text.replace("VolumeData {", "VolumeData { cropMax 1 1 .5")
    suite.close("lit by its own gradient", suite.middle(crop), (1, 1, 1, 1), 1e-5)


@suite.case
def disabled_and_missing():
    "a disabled style inside is skipped; without voxels there is nothing to add; without a style the default map"
    off = one_color(SECOND, "enabled FALSE")
    suite.close("skipped", draw(composed(one_color(FIRST), blended("", off))), seen(straight(FIRST)))
    suite.close("no voxels", draw(composed(one_color(FIRST), blended("", data=None))), seen(mixed(0.5, 0.5, second=0)))
    suite.close("no style", draw(composed(one_color(FIRST), blended("", ""))),
                seen(mixed(0.5, 0.5, second=0x32323232)))
    suite.close("alone", draw(blended("enabled FALSE")), (0, 0, 0, 0), 0)
    result = suite.render(front_scene(f"VolumeData {{ voxels {constant(102)} renderStyle {blended('weightFunction1 @BETA@'.replace('@', chr(34)))} }}\n"), "--probe", "8,8")
    suite.equal("unknown function", [m[5] for m in result.messages()], ["bad-value"])


@suite.case
def nested():
    "T9: Blended in Composed in Blended is the composition of the functions"
    third = 0x10F08066
    inner = blended("weightConstant1 .25 weightConstant2 .75", one_color(third), constant(77))
    style = composed(one_color(FIRST), blended("weightConstant1 .4 weightConstant2 .5",
                                               composed(one_color(SECOND), inner)))
    step = [clamp(0.25 * a + 0.75 * b) for a, b in zip(straight(SECOND), straight(third))]
    want = [clamp(0.4 * a + 0.5 * b) for a, b in zip(straight(FIRST), step)]
    suite.close("three deep", draw(style), seen(want))
    style, want = one_color(FIRST), straight(FIRST)
    for i in range(12):
        style = composed(one_color(SECOND), blended(f"weightConstant1 {0.3 + i / 40} weightConstant2 .6", style))
        want = [clamp((0.3 + i / 40) * a + 0.6 * b) for a, b in zip(straight(SECOND), want)]
    suite.close("twelve deep", draw(style), seen(want))


@suite.case
def long_lists():
    "three, eight and sixteen styles in one list; the same style twice with other parameters; T23 three maps"
    for count in (3, 8, 16):
        styles, want = [one_color(FIRST)], straight(FIRST)
        for i in range(1, count):
            rgba = (0x13579BDF * (i + 1)) & 0xFFFFFFFF | 0x40
            styles.append(blended(f"weightConstant1 {0.5 + i / 50} weightConstant2 .3", one_color(rgba), constant(i)))
            want = [clamp((0.5 + i / 50) * a + 0.3 * b) for a, b in zip(want, straight(rgba))]
        suite.close(f"{count}", draw(composed(*styles)), seen(want))


@suite.case
def authors():
    "functions of authors on the volume see the result, not the volume that is blended in"
    code = effect("void PLUG_volume_shade(inout vec4 color, const in VolumeSample s) { color.rgb *= 0.5; }")
    style = composed(one_color(FIRST), blended())
    got = suite.middle(front_scene(f"VolumeData {{ opacityUnitDistance 1 voxels {constant(102)} renderStyle {style} effects [ {code} ] }}\n"))
    want = mixed(0.5, 0.5)
    suite.close("", got, seen([c / 2 for c in want[:3]] + [want[3]]))


suite.run()
