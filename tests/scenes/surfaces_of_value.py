#!/usr/bin/env python3
"""IsoSurfaceVolumeData: where its surfaces are, in which order the ray meets them, in which style."""

import math

from harness import Suite, opacity, over, premultiplied
from scenes import FRONT, constant, effect, front_scene, scene, voxels

suite = Suite()

# Values 0, 1/3, 2/3, 1 along z, slice 0 behind: the ray meets the greatest first.
RAMP = voxels(1, (1, 1, 4), (0, 85, 170, 255))
HILL = voxels(1, (1, 1, 5), (0, 128, 255, 128, 0))


def one_color(rgba):
    return f"OpacityMapVolumeStyle {{ transferFunction PixelTexture {{ image 1 1 4 0x{rgba:08X} }} }}"


def surfaces(data, values, styles=(), fields=""):
    return (f"IsoSurfaceVolumeData {{ surfaceValues [ {values} ] {fields} voxels {data} "
            f"renderStyle [ {' '.join(styles)} ] }}\n")


def depth_of(value, data_end=0.375):
    "where the ramp has this value: z from -0.375 (0) to 0.375 (1)"
    return -data_end + 2 * data_end * value


RED, GREEN, BLUE = 0xFF000033, 0x00FF0033, 0x0000FFFF
A = 0x33 / 255


@suite.case
def one_value():
    "one value: one surface; without a style the default map colours it, alpha is that of one crossing"
    for value in (0.25, 0.6):
        suite.close(f"at {value}", suite.middle(front_scene(surfaces(RAMP, value))), (value ** 2,) * 3 + (value,))
    for step in ("0.1", "1", "30"):
        got = suite.middle(front_scene(surfaces(RAMP, 0.4, [one_color(RED)])), "--step", step)
        suite.close(f"step {step}", got, (A, 0, 0, A))
    suite.close("none in the data", suite.middle(front_scene(surfaces(constant(100), 0.7))), (0, 0, 0, 0), 0)
    suite.close("no value", suite.middle(front_scene(surfaces(RAMP, ""))), (0, 0, 0, 0), 0)


@suite.case
def where():
    "the surface is where the field has the value, whatever the step"
    code = ("void PLUG_volume_shade(inout vec4 color, const in VolumeSample s)"
            "{ color = vec4(s.position.z, -s.position_eye.z / 20.0, s.value.r, 1.0); }")
    for value in (0.1, 0.37, 0.9):
        z = depth_of(value)
        for step in ("0.05", "0.7", "40"):
            text = surfaces(RAMP, value, fields=f"effects [ {effect(code)} ]")
            got = suite.middle(front_scene(text), "--step", step)
            suite.close(f"{value}, step {step}", got, (z + 0.5, (10 - z) / 20, value, 1), 2e-6)


@suite.case
def both_in_one_step():
    "T12: surfaces inside one step are met by depth, not in the order of the list"
    want = over((A, 0, 0, A), over((0, A, 0, A), (0, 0, 1, 1)))
    values, styles = (0.7, 0.5, 0.3), [one_color(c) for c in (RED, GREEN, BLUE)]
    for order in ((0, 1, 2), (2, 1, 0), (1, 0, 2)):
        text = surfaces(RAMP, " ".join(str(values[i]) for i in order), [styles[i] for i in order])
        for step in ("0.25", "50"):
            suite.close(f"{order}, step {step}", suite.middle(front_scene(text), "--step", step), want)


@suite.case
def seen_from_behind():
    "from the other side the order turns round"
    text = surfaces(RAMP, "0.7 0.3", [one_color(RED), one_color(0x00FF0080)])
    view = "OrthoViewpoint { position 0 0 -10 orientation 0 1 0 3.14159265 fieldOfView -1 -1 1 1 }\n"
    got = suite.middle(scene(view, "NavigationInfo { headlight FALSE }\n", text), "--step", "9")
    g = 0x80 / 255
    suite.close("", got, over((0, g, 0, g), (A, 0, 0, A)), 1e-4)


@suite.case
def in_and_out():
    "a shell is met twice"
    want = over((A, 0, 0, A), (A, 0, 0, A))
    for step in ("0.1", "0.6"):
        got = suite.middle(front_scene(surfaces(HILL, 0.5, [one_color(RED)])), "--step", step)
        suite.close(f"step {step}", got, want)
    code = "void PLUG_volume_shade(inout vec4 color, const in VolumeSample s) { color = vec4(vec3(float(s.surface)), 0.5); }"
    text = surfaces(HILL, "0.4 0.8", fields=f"effects [ {effect(code)} ]")
    # numbers 0 1 1 0 at alpha 0.5: the second counts 0.25, the third 0.125
    suite.close("numbers", suite.middle(front_scene(text), "--step", ".1")[0], 0.25 + 0.125)


@suite.case
def contours():
    "one value and a step: every value whole steps away, inside the data"
    result = (0, 0, 0, 0)
    for value in (0.95, 0.85, 0.75, 0.65, 0.55, 0.45, 0.35, 0.25, 0.15, 0.05):
        result = over(result, premultiplied((value,) * 3, value))
    for sign in ("", "-"):
        got = suite.middle(front_scene(surfaces(RAMP, 0.25, fields=f"contourStepSize {sign}0.1")))
        suite.close(f"step {sign}0.1", got, result, 5e-4)
    styles = [one_color(c) for c in (0xFF000080, 0x00FF0080, 0x0000FF80)]
    # 0.5 is given and takes the first style; 0 the second, 0.25, 0.75 and 1 the third (the last)
    a = 128 / 255
    want = (0, 0, 0, 0)
    for rgb in ((0, 0, 1), (0, 0, 1), (1, 0, 0), (0, 0, 1)):
        want = over(want, premultiplied(rgb, a))
    got = suite.middle(front_scene(surfaces(RAMP, 0.5, styles, "contourStepSize 0.25")))
    suite.close("styles", got, want)
    two = surfaces(RAMP, "0.3 0.7", [one_color(RED)], "contourStepSize 0.1")
    suite.close("of several values the step is ignored", suite.middle(front_scene(two)),
                over((A, 0, 0, A), (A, 0, 0, A)))


@suite.case
def too_many():
    "a step of next to nothing is refused where it is too fine"
    result = suite.render(front_scene(surfaces(RAMP, 0.5, fields="contourStepSize 1e-5")), "--probe", "8,8", status=1)
    suite.equal("code", [m[5] for m in result.messages()], ["limit"])


@suite.case
def last_style():
    "a style past the end is the last one; a style that is disabled hides its surface"
    styles = [one_color(RED), one_color(GREEN)]
    got = suite.middle(front_scene(surfaces(RAMP, "0.8 0.6 0.4", styles)))
    suite.close("three values, two styles", got, over((A, 0, 0, A), over((0, A, 0, A), (0, A, 0, A))))
    hidden = [one_color(RED).replace("{ trans", "{ enabled FALSE trans", 1), one_color(GREEN)]
    suite.close("the first is hidden", suite.middle(front_scene(surfaces(RAMP, "0.8 0.6", hidden))), (0, A, 0, A))
    suite.close("all", suite.middle(front_scene(surfaces(RAMP, "0.8", hidden[:1]))), (0, 0, 0, 0), 0)


@suite.case
def tolerance():
    "surfaceTolerance: only where the normalised gradient is above it"
    # the ramp rises by 1/3 in 1/4: the gradient is 4/3 inside
    for unit, limit, seen in ((0.5, 0.6, True), (0.5, 0.7, False), (0.3, 0.39, True), (0.3, 0.41, False)):
        text = surfaces(RAMP, 0.5, [one_color(RED)], f"gradientUnit {unit} surfaceTolerance {limit}")
        suite.close(f"unit {unit}, tolerance {limit}", suite.middle(front_scene(text)),
                    (A, 0, 0, A) if seen else (0, 0, 0, 0))
    given = "gradients PixelTexture3D { image 3 1 1 1 0xFF8080 } surfaceTolerance "
    for limit, seen in ((0.9, True), (1.1, False)):
        text = surfaces(RAMP, 0.5, [one_color(RED)], given + str(limit))
        suite.close(f"gradients of their own, tolerance {limit}", suite.middle(front_scene(text)),
                    (A, 0, 0, A) if seen else (0, 0, 0, 0))


@suite.case
def normals():
    "the normal at a surface points out of the denser side; gradients of their own turn it"
    code = ("void PLUG_volume_shade(inout vec4 color, const in VolumeSample s)"
            "{ color = vec4(s.normal_eye * 0.5 + 0.5, 1.0); }")
    text = surfaces(RAMP, 0.5, fields=f"effects [ {effect(code)} ]")
    suite.close("of the voxels", suite.middle(front_scene(text)), (0.5, 0.5, 0, 1), 1e-6)
    own = f"gradients PixelTexture3D {{ image 3 1 1 1 0xFF8080 }} effects [ {effect(code)} ]"
    suite.close("their own", suite.middle(front_scene(surfaces(RAMP, 0.5, fields=own)))[0], 0, 4e-3)


@suite.case
def sphere():
    "T5 and V15: a sphere's depth, normal and silhouette"
    n = 33
    def value(x, y, z):
        return max(0.0, 1 - math.sqrt(sum(((c + 0.5) / n * 2 - 1) ** 2 for c in (x, y, z))))
    data = voxels(1, (n, n, n), (round(255 * value(x, y, z)) for z in range(n) for y in range(n) for x in range(n)))
    code = ("void PLUG_volume_shade(inout vec4 color, const in VolumeSample s)"
            "{ color = vec4((s.position_eye.z + 10.0) * 2.0, s.normal_eye.xy * 0.5 + 0.5, 1.0); }")
    text = front_scene(surfaces(data, 0.5, fields=f"effects [ {effect(code)} ]"))
    size = 64
    pixels = [(32, 32), (38, 32), (36, 25), (46, 32), (49, 32)]
    for (x, y), got in zip(pixels, suite.probe(text, pixels, size=f"{size}x{size}")):
        px, py = (x + 0.5) / size * 2 - 1, 1 - (y + 0.5) / size * 2
        inside = 0.25 ** 2 - px * px - py * py
        if inside < 0:
            suite.close(f"beside {x},{y}", got, (0, 0, 0, 0), 0)
            continue
        want = (2 * math.sqrt(inside), px / 0.25 * 0.5 + 0.5, py / 0.25 * 0.5 + 0.5, 1)
        suite.close(f"at {x},{y}", got, want, 0.03 if (x, y) != (46, 32) else 0.1)


@suite.case
def in_a_mix():
    "a surface inside a volume that is filled: what is before it, the surface, what is behind"
    fog = ("VolumeData { opacityUnitDistance 1 voxels " + constant(9) + " renderStyle " + one_color(0xFFFFFF80) + " }\n")
    a = 128 / 255
    for value in (0.2, 0.7):
        z = depth_of(value)
        front = premultiplied((1, 1, 1), opacity(a, 0.5 - z, 1))
        back = premultiplied((1, 1, 1), opacity(a, z + 0.5, 1))
        want = over(front, over((A, 0, 0, A), back))
        for order in (0, 1):
            parts = [fog, surfaces(RAMP, value, [one_color(RED)])]
            got = suite.middle(front_scene(*parts[::-1 if order else 1]))
            suite.close(f"at {value}, order {order}", got, want, 2e-4)


@suite.case
def cut():
    "crop boxes and planes cut surfaces; a cut surface has no wall"
    red = [one_color(RED)]
    for fields, seen in (("cropMin 0 0 .5", True), ("cropMax 1 1 .5", False), ("clipPlanes ClipPlane { plane 0 0 1 -0.1 }", True),
                         ("clipPlanes ClipPlane { plane 0 0 -1 0.1 }", False)):
        got = suite.middle(front_scene(surfaces(RAMP, 0.8, red, fields)))
        suite.close(fields, got, (A, 0, 0, A) if seen else (0, 0, 0, 0))


@suite.case
def older_spelling():
    "ISOSurfaceVolumeData; and the style of 2005, which has no value, draws that at 0.5 and says so"
    text = surfaces(RAMP, 0.6).replace("IsoSurface", "ISOSurface")
    suite.close("draft", suite.middle(front_scene(text)), (0.36,) * 3 + (0.6,))
    old = f"VolumeData {{ voxels {RAMP} renderStyle ISOSurfaceVolumeStyle {{ }} }}\n"
    result = suite.render(front_scene(old), "--probe", "8,8")
    suite.close("2005", [float(v) for v in result.output.split()], (0.25,) * 3 + (0.5,))
    suite.equal("told", [m[5] for m in result.messages() if m[3] == "warning"], ["bad-value"])


@suite.case
def physical():
    "physicalUnits: values and steps in the units of the data"
    fields = "physicalUnits TRUE valueRange -100 300"
    ramp = front_scene(surfaces(RAMP, 155.0, [one_color(RED)], fields))
    # PixelTexture3D's numbers are 0..255: 155 is 255/400 of the range and 155/255 of the ramp
    code = ("void PLUG_volume_shade(inout vec4 color, const in VolumeSample s)"
            "{ color = vec4(s.position.z, s.value.r, 0.0, 1.0); }")
    text = surfaces(RAMP, 155.0, fields=fields + f" effects [ {effect(code)} ]")
    suite.close("place", suite.middle(front_scene(text)), (0.5 + depth_of(155 / 255), 255 / 400, 0, 1), 1e-5)
    suite.close("seen", suite.middle(ramp), (A, 0, 0, A))


suite.run()
