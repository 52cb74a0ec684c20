#!/usr/bin/env python3
"""Volumes in segments whose styles only change what a transfer function makes visible: the picture is that of
fine steps, and sooner than by samples in the middle."""

import math
import operator
import os
import random
import struct

from harness import Picture, Suite, load_json
from scenes import NO_HEADLIGHT, effect, scene, voxels

suite = Suite()
SIDE = 10
PIXELS = 24
TRUTH = 1 / 64  # voxels; drawn in the middle of steps

CAMERA = "Viewpoint { position 0.9 0.7 3 orientation -0.6 0.8 0 0.37 fieldOfView 0.6 }\n"
LIGHTS = ("DirectionalLight { direction -1 -2 -3 global TRUE }\n"
          "PointLight { location 2 1 3 radius 1e9 global TRUE intensity 0.7 }\n")


def smooth_noise():
    """Random voxels, blurred once: normals turn within a voxel or two."""
    dice = random.Random(3)
    raw = [dice.random() for _ in range(SIDE ** 3)]

    def at(i, j, k):
        return raw[(min(max(k, 0), SIDE - 1) * SIDE + min(max(j, 0), SIDE - 1)) * SIDE + min(max(i, 0), SIDE - 1)]

    return voxels(1, (SIDE, SIDE, SIDE), [
        round(255 * min(max(1.9 * sum(at(i + a, j + b, k + c) for a in (-1, 0, 1) for b in (-1, 0, 1)
                                      for c in (-1, 0, 1)) / 27 - 0.45, 0), 1))
        for k in range(SIDE) for j in range(SIDE) for i in range(SIDE)])


VOXELS = smooth_noise()
# a thin function: two peaks, between which nothing can be seen
MAP = ("OpacityMapVolumeStyle { transferFunction PixelTexture { image 16 1 4 "
       "0 0 0 0 0x3060a000 0x3060a0c0 0x3060a000 0 0 0xd0a04000 0xd0a04080 0xc0603000 0 0 0 0 } }")

# colours alone, to the bit the same opacity
LIGHTING = """/* PLUG-PROMISE: colour-only */
void PLUG_volume_shade(inout vec4 color, const in VolumeSample s) {
    color.rgb *= 0.3 + 0.7 * abs(s.normal_eye.z);
}"""

STYLES = {
    "lit": "ShadedVolumeStyle { lighting TRUE material Material { specularColor .4 .4 .4 } }",
    "tones": "ToneMappedVolumeStyle { }",
    "edges": "EdgeEnhancementVolumeStyle { edgeColor .2 .4 .9 1 }",
    "boundaries": "BoundaryEnhancementVolumeStyle { retainedOpacity .3 boundaryOpacity .8 opacityFactor 1 }",
    "silhouettes": "SilhouetteEnhancementVolumeStyle { silhouetteRetainedOpacity .5 silhouetteBoundaryOpacity .4 }",
}


def volume(style, more="", data=VOXELS):
    style = f"renderStyle ComposedVolumeStyle {{ renderStyle [ {MAP} {style} ] }}"
    return f"VolumeData {{ dimensions 1 1.2 0.9 voxels {data} {style} {more} }}\n"


def draw(parts, *arguments, **options):
    result = suite.render(scene(NO_HEADLIGHT, CAMERA, LIGHTS, *parts), "-o", "a.npy", "--stats", "json", *arguments,
                          size=f"{PIXELS}x{PIXELS}", **options)
    return Picture(os.path.join(result.folder, "a.npy")).values, load_json(result.output)


def error(a, b):
    """Root of the mean square, and the greatest."""
    apart = [abs(p - q) for p, q in zip(a, b)]
    return (sum(d * d for d in apart) / len(apart)) ** 0.5, max(apart)


def compare(name, *parts):
    truth = draw(parts, "--step", TRUTH)[0]
    suite.check(f"{name}: something is seen", max(truth) > 0.2, max(truth))
    fine, told = draw(parts, "--step", 1 / 32, "--method", "preintegrated")
    suite.check(f"{name}: in segments", told["plan"]["method"] == "preintegrated", told["plan"])
    suite.check(f"{name}: fine segments give the picture of fine steps", error(fine, truth)[1] < 4e-3,
                error(fine, truth))
    coarse = [error(draw(parts, "--step", 0.5, "--method", m)[0], truth)[0] for m in ("midpoint", "preintegrated")]
    suite.check(f"{name}: segments of half a voxel are nearer than steps", coarse[1] < 0.8 * coarse[0], coarse)
    suite.check(f"{name}: the default", draw(parts)[1]["plan"]["method"] == "preintegrated")


@suite.case
def styles():
    "styles of the standard"
    for name, style in STYLES.items():
        compare(name, volume(style))


@suite.case
def fog():
    "fog"
    compare("fog", "Fog { color 0.7 0.7 0.8 visibilityRange 5 }\n", volume(""))


@suite.case
def promised():
    "effects of authors: where they promise to change colours alone"
    node = "effects " + effect(LIGHTING, 'language "GLSL"')
    compare("promised", volume("", node))
    honest = LIGHTING.split("\n", 1)[1]
    _, told = draw([volume("", "effects " + effect(honest, 'language "GLSL"'))], "--step", 0.5, "--method",
                   "preintegrated")
    suite.check("without the promise samples are looked at", told["plan"]["method"] == "midpoint", told["plan"])
    _, told = draw([volume("", "effects " + effect(LIGHTING.replace("colour-only", "keeps-transparent"),
                                                   'language "GLSL"'))],
                   "--step", 0.5, "--method", "preintegrated")
    suite.check("so they are where it may change the opacity", told["plan"]["method"] == "midpoint", told["plan"])


@suite.case
def highlights():
    "highlights bend within segments: styles see their normals turn"
    data = voxels(1, (SIDE, SIDE, SIDE), [
        round(127.5 + 127.5 * math.sin(1.1 * i + 0.4 * j) * math.cos(0.8 * j - 0.7 * k))
        for k in range(SIDE) for j in range(SIDE) for i in range(SIDE)])
    shining = LIGHTING.replace("0.3 + 0.7 * abs(s.normal_eye.z)", "pow(abs(s.normal_eye.z), 20.0)")
    wide = "OpacityMapVolumeStyle { transferFunction PixelTexture { image 3 1 4 0xffffff00 0xffffffc0 0xffffff00 } }"
    node = effect(shining, 'language "GLSL"')
    parts = (f"VolumeData {{ dimensions 1 1.2 0.9 voxels {data} renderStyle {wide} effects {node} }}\n",)
    truth = draw(parts, "--step", TRUTH)[0]
    found = [error(draw(parts, "--step", step, "--method", "preintegrated")[0], truth)[0] for step in (0.5, 0.25)]
    suite.check("half a voxel errs by less than 0.002", found[0] < 0.002, found)
    suite.check("a quarter by less than 0.0005", found[1] < 0.0005, found)


def looks_twice(*parts):
    """Whether the program has styles look at a place twice."""
    result = suite.command("dump", "scene.x3dv", "-d", "out", files={"scene.x3dv": scene(CAMERA, *parts)})
    with open(os.path.join(result.folder, "out", "volume-1.frag"), encoding="utf-8") as file:
        return "style_turned" in file.read()


@suite.case
def twice():
    "only where normals are asked for, and no rays of light are walked"
    shadows = STYLES["lit"].replace("lighting TRUE", "lighting TRUE shadows TRUE")
    found = [looks_twice(LIGHTS, volume(style)) for style in
             (STYLES["lit"], STYLES["boundaries"], shadows)]
    suite.check("lit; not: boundaries, shadows", found == [True, False, False], found)
    beside = "Transform { translation 3 0 0 children " + volume(shadows) + "}"
    suite.check("nor where another volume casts shadows", not looks_twice(LIGHTS, volume(STYLES["lit"]), beside))


@suite.case
def opaque():
    "opaque values are lit, and hide"
    solid = MAP.replace("0xd0a04000 0xd0a04080 0xc0603000 0 0 0 0", "0xd0a04000 " + 6 * "0xd0a040ff ")
    parts = ("VolumeData { dimensions 1 1.2 0.9 voxels %s renderStyle ComposedVolumeStyle { renderStyle [ %s %s ] } }\n"
             % (VOXELS, solid, STYLES["lit"]),)
    truth = draw(parts, "--step", TRUTH)[0]
    fine = draw(parts, "--step", 1 / 32, "--method", "preintegrated")[0]
    worst = sorted(abs(p - q) for p, q in zip(fine, truth))
    suite.check("alpha is 1 somewhere", max(truth[3::4]) == 1)
    suite.check("but for outlines the same", worst[int(0.98 * len(worst))] < 1e-2, worst[int(0.98 * len(worst))])


@suite.case
def gradients():
    "gradients that are held are those of samples, however small the differences of values are"
    ramp = [32768 + 3 * i + 2 * j - k * k for k in range(SIDE) for j in range(SIDE) for i in range(SIDE)]
    data = nrrd(ramp)
    style = "ShadedVolumeStyle { lighting TRUE }"
    node = ("VolumeData { voxels ImageTexture3D { url \"v.nrrd\" } valueRange 0 65535 renderStyle "
            f"ComposedVolumeStyle {{ renderStyle [ OpacityMapVolumeStyle {{ }} {style} ] }} }}\n")
    text = scene(NO_HEADLIGHT, CAMERA, LIGHTS, node)
    pictures = []
    for method in ("midpoint", "preintegrated"):
        result = suite.render(text, "-o", "a.npy", "--step", "0.25", "--method", method, size="16x16",
                              files={"v.nrrd": data})
        pictures.append(Picture(os.path.join(result.folder, "a.npy")).values)
    suite.check("lit alike", error(*pictures)[1] < 2e-3 and max(pictures[0]) > 0.2, error(*pictures))


@suite.case
def backends():
    "EGL and OSMesa draw the same bits"
    parts = (volume(STYLES["lit"]),)
    pictures = [draw(parts, "--step", 0.5, "--method", "preintegrated", "--backend", b)[0] for b in ("egl", "osmesa")]
    suite.check("lit segments", pictures[0] == pictures[1], error(*pictures))


@suite.case
def leaps():
    "leaping changes no bit"
    parts = (volume(STYLES["lit"]),)
    pictures = [draw(parts, "--step", 0.5, "--method", "preintegrated", *more)[0] for more in ((), ("--no-leaping",))]
    suite.check("lit segments", pictures[0] == pictures[1], error(*pictures))


def nrrd(values):
    """16-bit voxels as a file."""
    head = f"NRRD0004\ntype: uint16\ndimension: 3\nsizes: {SIDE} {SIDE} {SIDE}\nencoding: raw\nendian: little\n\n"
    return head.encode() + b"".join(v.to_bytes(2, "little") for v in values)


@suite.case
def bytes_and_floats():
    "bytes, which lie four in a texel, have the values that a filter of floats gives"
    sides, dice = (7, 4, 9), random.Random(5)
    values = [dice.randrange(256) for _ in range(sides[0] * sides[1] * sides[2])]
    head = "NRRD0004\ntype: %s\ndimension: 3\nsizes: %d %d %d\nencoding: raw\nendian: little\nmin: 0\nmax: %d\n\n"
    files = {"bytes.nrrd": (head % ("uint8", *sides, 255)).encode() + bytes(values),
             "floats.nrrd": (head % ("float", *sides, 1)).encode()
             + b"".join(struct.pack("<f", v / 255) for v in values)}
    pictures = [draw((volume("", data='ImageTexture3D { url "%s" }' % name),), "--step", 0.5, "--method", "preintegrated",
                     files=files)[0] for name in files]
    worst = max(map(abs, map(operator.sub, *pictures)))
    suite.check("bytes as floats", worst < 1e-4, worst)
    suite.check("something is seen", max(pictures[0]) > 0.2, max(pictures[0]))


LINEAR = "OpacityMapVolumeStyle { transferFunction PixelTexture { image 3 1 4 0 0x4080ff00 0xffc08020 } }"


@suite.case
def joined():
    "four segments are one where the function is linear in their values, of one volume: nearly the same picture"
    dice = random.Random(8)
    data = voxels(1, (SIDE,) * 3, [dice.randrange(160, 200) if i // SIDE ** 2 > 6 else 3 for i in range(SIDE ** 3)])
    one = volume(LINEAR, data=data)
    beside = "Transform { translation 50 0 0 children %s }\n" % volume(LINEAR, data=data)
    how = ("--step", 0.25, "--method", "preintegrated")
    alone, told = draw((one,), *how)
    suite.check("in segments", told["plan"]["method"] == "preintegrated" and told["plan"]["leaps"], told["plan"])
    suite.check("something is seen", max(alone) > 0.1, max(alone))
    suite.check("leaping changes no bit", alone == draw((one,), *how, "--no-leaping")[0])
    apart = error(alone, draw((one, beside), *how)[0])[1]
    suite.check("not the same", apart > 1e-5, apart)
    suite.check("nearly", apart < 0.02 * 0.25 ** 2, apart)


suite.run()
