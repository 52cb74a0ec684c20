#!/usr/bin/env python3
"""Crop boxes, clip planes and fog of volumes."""

import math

from harness import Suite, opacity, over, premultiplied
from scenes import FRONT, NO_HEADLIGHT, constant, effect, front_scene, scene, volume, voxels

suite = Suite()

RED = "OpacityMapVolumeStyle { transferFunction PixelTexture { image 1 1 4 0xFF000080 } }"
A = 128 / 255


def cube(fields="", style=RED, data=constant(9, (3, 3, 3))):
    return volume(data, style, fields="opacityUnitDistance 1 " + fields)


def slab(length):
    return premultiplied((1, 0, 0), opacity(A, length, 1))


@suite.case
def crop():
    "cropMin and cropMax in texture coordinates: each of six sides; what is outside the box is cut at the box"
    for fields, length in (("cropMin 0 0 .3", 0.7), ("cropMax 1 1 .4", 0.4), ("cropMin 0 0 .2 cropMax 1 1 .9", 0.7),
                           ("cropMin -5 -5 -5 cropMax 7 7 7", 1), ("cropMin 0 0 .6 cropMax 1 1 .5", 0),
                           ("cropMin .6 0 0", 0), ("cropMax .4 1 1", 0), ("cropMin 0 .6 0", 0), ("cropMax 1 .4 1", 0)):
        for step in ("0.3", "1.3"):
            got = suite.middle(front_scene(cube(fields)), "--step", step)
            suite.close(f"{fields}, step {step}", got, slab(length))
    halves = cube("cropMax .5 1 1") + cube("cropMin .5 0 0")
    whole = suite.picture(front_scene(cube()), "--size", "24x24")
    split = suite.picture(front_scene(halves), "--size", "24x24")
    most = max(abs(a - b) for a, b in zip(whole.values, split.values))
    suite.check("two halves are the whole", most < 2e-6, most)


@suite.case
def split_obliquely():
    "one box split by crop boxes, seen obliquely, is the box"
    view = "OrthoViewpoint { position 7 5 9 orientation -0.5 0.75 0.1 0.86 fieldOfView -1 -1 1 1 }\n"
    data = voxels(1, (4, 4, 4), [(i * 37) % 200 for i in range(64)])
    def draw(*parts):
        return suite.picture(scene(view, NO_HEADLIGHT, *parts), "--size", "32x32", "--step", "0.01")
    whole = draw(cube(data=data, style=""))
    parts = [cube(f"cropMin {x / 2} {y / 2} 0 cropMax {x / 2 + .5} {y / 2 + .5} 1", data=data, style="") for x in (0, 1) for y in (0, 1)]
    split = draw(*parts)
    most = max(abs(a - b) for a, b in zip(whole.values, split.values))
    suite.check("something is seen", max(whole.values) > 0.2, max(whole.values))
    suite.check("the same", most < 2e-3, most)


@suite.case
def own_planes():
    "clipPlanes: any number, in the volume's own coordinates; disabled ones cut nothing"
    def planes(*texts):
        return "clipPlanes [ " + " ".join(f"ClipPlane {{ {t} }}" for t in texts) + " ]"
    for texts, length in ((["plane 0 0 1 .2"], 0.7), (["plane 0 0 -1 .2"], 0.7), (["plane 0 0 1 .2", "plane 0 0 -1 .1"], 0.3),
                          (["plane 0 0 1 .2 enabled FALSE"], 1), (["plane 1 0 0 -.3"], 0), (["plane 1 0 0 .3"], 1),
                          (["plane 0 0 5 1"], 0.7), ([f"plane 0 0 1 {i / 100}" for i in range(50)], 0.5)):
        got = suite.middle(front_scene(cube(planes(*texts))))
        suite.close(f"{texts[:2]} of {len(texts)}", got, slab(length))
    moved = f"Transform {{ scale 1 1 2 translation 0 0 .5 children {cube(planes('plane 0 0 1 .2'))} }}\n"
    suite.close("scaled: the plane goes with the volume", suite.middle(front_scene(moved)), slab(0.7))


@suite.case
def oblique():
    "T21: an oblique plane under a scale of 2 1 1"
    text = f"Transform {{ scale 2 1 1 children [ ClipPlane {{ plane 1 0 1 0 }} {cube()} ] }}\n"
    size = 32
    pixels = [(8, 16), (16, 16), (24, 16), (28, 16)]
    for (x, y), got in zip(pixels, suite.probe(front_scene(text), pixels, size=f"{size}x{size}")):
        own = ((x + 0.5) / size * 2 - 1) / 2  # in the volume's own coordinates
        suite.close(f"column {x}", got, slab(min(max(0.5 + own, 0), 1) if abs(own) < 0.5 else 0))


@suite.case
def planes_of_the_scene():
    "the planes of the groups around cut; ignoreClipPlanes spares a volume; own planes still cut it"
    def group(volume_text):
        return f"Group {{ children [ ClipPlane {{ plane 0 0 1 0 }} {volume_text} ] }}\n"
    suite.close("cut", suite.middle(front_scene(group(cube()))), slab(0.5))
    suite.close("spared", suite.middle(front_scene(group(cube("ignoreClipPlanes TRUE")))), slab(1))
    own = cube("ignoreClipPlanes TRUE clipPlanes ClipPlane { plane 0 0 -1 .2 }")
    suite.close("own", suite.middle(front_scene(group(own))), slab(0.7))
    outside = cube() + "Group { children ClipPlane { plane 0 0 1 0 } }\n"
    suite.close("of another group", suite.middle(front_scene(outside)), slab(1))
    two = group(cube() + cube("ignoreClipPlanes TRUE").replace("VolumeData", "VolumeData", 1))
    want = over(slab(0.5), (0, 0, 0, 0))
    both = premultiplied((1, 0, 0), 1 - (1 - opacity(A, 0.5, 1)) * (1 - opacity(A, 1, 1)))
    suite.close("one of two that overlap", suite.middle(front_scene(two)), both)


@suite.case
def fog():
    "fog changes the colour of samples by their distance, the nearest LocalFog first; opacity stays"
    style = "OpacityMapVolumeStyle { transferFunction PixelTexture { image 1 1 4 0xFF0000FF } }"
    body = cube(style=style)
    for more, want in (("", None), ('fogType "EXPONENTIAL"', "exp")):
        text = f"Fog {{ color 0 0 1 visibilityRange 20 {more} }}\n" + body
        got = suite.middle(front_scene(text), "--step", ".01")
        d = 9.5
        f = 1 - d / 20 if want is None else math.exp(-d / (20 - d))
        suite.close(more or "linear", got, (f, 0, 1 - f, 1), 1e-3)
    local = f"Group {{ children [ LocalFog {{ color 0 1 0 visibilityRange 19 }} {body} ] }}\nFog {{ color 0 0 1 visibilityRange 20 }}\n"
    suite.close("local", suite.middle(front_scene(local), "--step", ".01"), (0.5, 0.5, 0, 1), 1e-3)
    thin = front_scene("Fog { color 0 0 1 visibilityRange 20 }\n" + cube())
    got = suite.middle(thin, "--step", ".02")
    suite.close("alpha", got[3], opacity(A, 1, 1))
    od = -math.log(1 - A)
    n = 2000
    red = sum(math.exp(-od * (i + .5) / n) * od / n * (1 - (9.5 + (i + .5) / n) / 20) for i in range(n))
    suite.close("the integral of what is fogged", got[0], red, 1e-4)
    surface = f"IsoSurfaceVolumeData {{ surfaceValues .5 voxels {voxels(1, (1, 1, 2), (0, 255))} renderStyle {style} }}\n"
    got = suite.middle(front_scene("Fog { color 0 0 1 visibilityRange 20 }\n" + surface))
    suite.close("a surface", got, (0.5, 0, 0.5, 1), 1e-5)
    code = effect("void PLUG_fog_apply(inout vec4 fragment_color, const in vec3 normal_eye) { fragment_color.g = 1.0; }")
    suite.close("an author's fog", suite.middle(front_scene(cube(f"effects [ {code} ]"))), premultiplied((1, 1, 0), opacity(A, 1, 1)))


@suite.case
def no_new_programs():
    "numbers of crop boxes and planes are no part of the program"
    def program(fields):
        result = suite.command("dump", "scene.x3dv", "-d", "out", files={"scene.x3dv": front_scene(cube(fields))})
        with open(f"{result.folder}/out/volume-1.frag") as file:
            return file.read()
    suite.equal("crop", program("cropMin .1 .2 .3"), program("cropMax .9 .8 .7"))
    suite.equal("planes", program("clipPlanes ClipPlane { plane 1 0 0 0 }"), program("clipPlanes ClipPlane { plane 0 1 0 .5 }"))


suite.run()
