#!/usr/bin/env python3
"""F29 to F39: data and textures. stability_3.py PLUGRAY [ROW...]"""

import math
import random
import struct
import zlib

from harness import opacity, premultiplied
from scenes import NO_HEADLIGHT, constant, effect, scene, volume, voxels
from stability_data import Stability, pixels_of, worst, wrong_numbers

suite = Stability()
CLASSIFY = "void PLUG_volume_classify(inout vec4 color, const in VolumeSample s)"
SHADE = "void PLUG_volume_shade(inout vec4 color, const in VolumeSample s)"
SHOW = effect(CLASSIFY + " { color = vec4(s.value.rrr, 1.0); }")  # the value where the ray begins
FLOOR = 2e-6


def view(wide, high, x=0.0, y=0.0):
    """Parallel rays along -z, around (x, y)."""
    low_x, low_y, high_x, high_y = x - wide, y - high, x + wide, y + high
    return f"OrthoViewpoint {{ position 0 0 10 fieldOfView {low_x!r} {low_y!r} {high_x!r} {high_y!r} }}\n"


WHOLE = view(0.5, 0.5)


def moved(text, x, y=0.0):
    return f"Transform {{ translation {x!r} {y!r} 0 children [\n{text}] }}\n"


def side_by_side(boxes):
    """Boxes of side 1 in a picture of which each fills a part; pixels are squares."""
    return scene(view(len(boxes) / 2, 0.5), NO_HEADLIGHT,
                 *(moved(box, i + 0.5 - len(boxes) / 2) for i, box in enumerate(boxes)))


def nrrd(kind, code, size, values):
    head = (f"NRRD0004\ntype: {kind}\ndimension: 3\nsizes: {' '.join(map(str, size))}\nencoding: raw\n"
            "endian: little\n\n")
    values = list(values)
    return head.encode() + struct.pack(f"<{len(values)}{code}", *values)


def image3d(name):
    return f'ImageTexture3D {{ url "{name}" }}'


def scattered(size, seed=1):
    """Bytes without any symmetry."""
    source = random.Random(seed)
    return [source.randrange(256) for _ in range(size[0] * size[1] * size[2])]


# ---- F29 to F32: where voxels and texels are

SQUARED = effect("void PLUG_volume_sample(inout VolumeSample s) { s.value.r *= s.value.r; }")
RAMPS = (2, 4, 6, 16)
ODD = (5, 4, 3)


def mean_of_squares(n):
    """A ramp of n voxels along the ray, 0 to 1."""
    ramp = voxels(1, (1, 1, n), (255 * i // (n - 1) for i in range(n)))
    return volume(ramp, "ProjectionVolumeStyle { type \"AVERAGE\" }", SQUARED)


@suite.row("F29", "half a voxel off", scene=side_by_side([mean_of_squares(n) for n in RAMPS]),
           shows="the mean of squares along ramps of N voxels; a bright voxel amid 5 x 5 x 5; voxels and their mirror image",
           invariant="the mean is (2N + 1) / (6N), the spot is in the middle, the pictures are mirrored")
def half_voxel(row):
    p = row.picture("--step", "0.005", size="4x1")
    for i, n in enumerate(RAMPS):
        row.measure("means differ by", abs(p.at(i, 0)[0] - (2 * n + 1) / (6 * n)), at_most=1e-5, case=f"N = {n}")
    bright = voxels(1, (5, 5, 5), (255 if i == 62 else 0 for i in range(125)))
    values = scattered(ODD)
    x = ODD[0]
    mirrored = [values[i - i % x + x - 1 - i % x] for i in range(len(values))]
    for name, options in row.methods():
        spot = row.picture("--step", "0.5", *options, scene=scene(WHOLE, NO_HEADLIGHT, volume(bright)), size="32x32")
        weights = [c[3] for c in pixels_of(spot)]
        for place in (lambda i: i % 32, lambda i: i // 32):
            centre = sum(w * (place(i) + 0.5) for i, w in enumerate(weights)) / sum(weights)
            row.measure("the spot is off by (pixels)", abs(centre - 16), at_most=1e-3, case=name)
        a, b = (pixels_of(row.picture("--step", "0.5", *options, size="20x20",
                                      scene=scene(WHOLE, NO_HEADLIGHT, volume(voxels(1, ODD, data)))))
                for data in (values, mirrored))
        turned = [b[i - i % 20 + 19 - i % 20] for i in range(400)]
        row.measure("mirrored pictures differ by", worst(a, turned), at_most=FLOOR, case=name)


def table(entries):
    """Colour and opacity that grow linearly; these numbers of entries need no rounding."""
    texels = [255 * i // (entries - 1) for i in range(entries)]
    words = " ".join(f"0x{t:02X}{255 - t:02X}{t:02X}{t:02X}" for t in texels)
    return f"OpacityMapVolumeStyle {{ transferFunction PixelTexture {{ image {entries} 1 4 {words} }} }}"


@suite.row("F30", "half a texel off in transfer functions",
           scene=scene(WHOLE, NO_HEADLIGHT, volume(voxels(1, (4, 4, 4), scattered((4, 4, 4))), table(2))),
           shows="colour and opacity that grow linearly, in tables of 2, 4, 16, 52 and 256 entries",
           invariant="all tables give the same picture")
def function_texels(row):
    for name, options in row.methods():
        fine = ("--error", "1/4096") if name == "cells" else ("--step", "0.5")
        first, *others = (row.picture(*fine, *options, scene=row.changed((table(2), table(n))))
                          for n in (2, 4, 16, 52, 256))
        for p in others:
            row.measure("pictures differ by", worst(first, p), at_most=5e-5, case=name)


BOX = (3, 5, 7)


def on_face(i):
    x, y, z = i % 3, i // 3 % 5, i // 15
    return x in (0, 2) or y in (0, 4) or z in (0, 6)


FACES = volume(voxels(1, BOX, (255 if on_face(i) else 0 for i in range(105))))
COLUMNS = (40, 200, 90)  # of a ramp along x
ROWS = (10, 70, 220, 140, 30)


def between(values, place):
    """Linear between centres, clamped beyond the outermost."""
    at = min(max(place * len(values) - 0.5, 0), len(values) - 1)
    k = min(int(at), len(values) - 2)
    return (values[k] + (values[k + 1] - values[k]) * (at - k)) / 255


@suite.row("F31", "edges of textures leak", scene=scene(view(1.0, 1.0), NO_HEADLIGHT, FACES),
           shows="3 x 5 x 7 voxels, opaque at the faces; columns and rows of other values",
           invariant="nothing outside of the box; in the outer half voxel the value is that of the outermost centre")
def edges(row):
    for name, options in row.methods():
        p = row.picture("--step", "0.5", *options, size="64x64")
        inside = [16 <= i % 64 < 48 and 16 <= i // 64 < 48 for i in range(64 * 64)]
        outer = [any(abs(abs(k - 31.5) - 15.5) < 1 for k in (i % 64, i // 64)) for i in range(64 * 64)]
        found = [c[3] for c in pixels_of(p)]
        row.count("pixels outside that are not clear", sum(a != 0 for a, i in zip(found, inside) if not i), case=name)
        row.count("pixels at the border that are not opaque",
                  sum(a != 1 for a, i, o in zip(found, inside, outer) if i and o), case=name)
    for size, values, place in (((3, 1, 1), COLUMNS, 0), ((1, 5, 1), ROWS, 1)):
        p = row.picture("--step", "0.5", scene=scene(WHOLE, NO_HEADLIGHT, volume(voxels(1, size, values), effects=SHOW)),
                        size="60x60")
        expected = [between(values, ((i % 60 + 0.5) / 60, 1 - (i // 60 + 0.5) / 60)[place]) for i in range(3600)]
        row.measure("values differ by", worst(pixels_of(p), [(v, v, v, 1) for v in expected]), at_most=FLOOR)


FLAT = ((1, 1, 1), (4, 1, 1), (1, 1, 4), (2, 2, 2))
GREY = (0.2, 0.4, 0.6)
ALPHA = 0.4
TINT = effect(CLASSIFY + f" {{ color = vec4({GREY[0]}, {GREY[1]}, {GREY[2]}, {ALPHA}); }}")
LIGHT = "DirectionalLight { direction 1 -1 -1 ambientIntensity .5 }\n"
# Style, what it does to colour and opacity where there is no gradient.
STYLES = (
    ("", 1.0, 1.0),
    ("EdgeEnhancementVolumeStyle { }", 1.0, 1.0),
    ("SilhouetteEnhancementVolumeStyle { silhouetteRetainedOpacity .2 silhouetteBoundaryOpacity .7 }", 1.0, 1.0),
    ("BoundaryEnhancementVolumeStyle { retainedOpacity .7 boundaryOpacity .9 opacityFactor 2 }", 1.0, 0.7),
    ("BoundaryEnhancementVolumeStyle { retainedOpacity .5 boundaryOpacity .3 opacityFactor 0 }", 1.0, 0.8),
    ("CartoonVolumeStyle { colorSteps 1 }", 1.0, 1.0),
    ("ToneMappedVolumeStyle { }", 1.0, 1.0),
    ("ShadedVolumeStyle { lighting TRUE }", 0.1, 1.0),  # ambientIntensity .5, of the colour .2
)


@suite.row("F32", "one voxel a side", scene=side_by_side([volume(constant(102, s), fields="opacityUnitDistance 1") for s in FLAT]),
           shows="1 x 1 x 1, 4 x 1 x 1, 1 x 1 x 4 and 2 x 2 x 2 equal voxels, bare and in each style",
           invariant="a volume without gradient: the opacity of its length, whatever the grid; no division by zero")
def one_voxel(row):
    for name, options in row.methods():
        p = row.picture("--step", "0.3", *options, size="4x1")
        row.measure("A differs by", max(abs(c[3] - 0.4) for c in pixels_of(p)), at_most=FLOOR, case=name)
    for style, shade, factor in STYLES:
        text = side_by_side([volume(constant(102, s), style, TINT, "opacityUnitDistance 1") for s in FLAT])
        p = row.picture("--step", "0.3", scene=text + LIGHT, size="4x1")
        alpha = opacity(ALPHA * factor, 1, 1)
        expected = premultiplied([shade * c for c in GREY], alpha)
        row.measure("colours in styles differ by", worst(pixels_of(p), [expected] * 4), at_most=FLOOR,
                    case=style[:20])


# ---- F33 to F35: what is no number, and what has no direction

ODD_VALUES = {"nan": math.nan, "plus": math.inf, "minus": -math.inf}
MIDDLE = 4 * 81 + 4 * 9 + 4  # of nine voxels a side


def with_one(value):
    return nrrd("float", "f", (9, 9, 9), (value if i == MIDDLE else 0.5 for i in range(729)))


FILES_33 = {f"F33-{name}.nrrd": with_one(value) for name, value in ODD_VALUES.items()}
FILES_33["F33-zero.nrrd"] = with_one(0.0)
LIT = "ShadedVolumeStyle { lighting TRUE }"


def holed(name, style=""):
    return scene("OrthoViewpoint { position 0 0 10 fieldOfView -.5 -.5 .5 .5 }\n", NO_HEADLIGHT, LIGHT,
                 volume(image3d(f"F33-{name}.nrrd"), style, fields="valueRange 0 1"))


@suite.row("F33", "voxels that are no numbers", scene=holed("nan"), files=FILES_33,
           shows="a constant volume with one voxel that is NaN, +infinity or -infinity, bare and lit",
           invariant="it counts as 0 and changes what is less than a voxel away (lit: two); all pixels are numbers")
def no_numbers(row):
    def near(i, reach):
        return all(abs((k + 0.5) / 36 * 9 - 4.5) < reach for k in (i % 36, i // 36))

    for style, reach in (("", 1), (LIT, 2)):
        for name, options in row.methods() if not style else [("lit", ())]:
            zero = row.picture("--step", "0.5", *options, scene=holed("zero", style), size="36x36")
            for odd in ODD_VALUES:
                p = row.picture("--step", "0.5", *options, scene=holed(odd, style), size="36x36")
                row.count("wrong numbers", wrong_numbers(p), case=f"{odd} {name}")
                row.count("numbers that differ from those of a voxel of 0",
                          sum(a != b for a, b in zip(p.values, zero.values)), case=f"{odd} {name}")
                far = [c for i, c in enumerate(pixels_of(p)) if not near(i, reach)]
                row.count("pixels farther away that change", sum(c != far[0] for c in far), case=f"{odd} {name}")


# Each makes something that is no number (x is 0, or a number that the compiler does not know).
BAD = ("x / x", "sqrt(x - 1.0)", "log(x - 1.0)", "pow(x - 1.0, 0.5)", "acos(2.0 + x)", "normalize(vec3(x)).x",
       "inversesqrt(x - 1.0)", "log(x) - log(x)", "asin(x - 2.0)", "1.0 / x * x", "mod(1.0, x)", "exp(1.0 / x) * x")
BAD_CODE = ("uniform float x;\nfloat bad(int i) {\n"
            + "".join(f"    if (i == {i})\n        return {e};\n" for i, e in enumerate(BAD)) + "    return 0.5;\n}\n")


def bad_in(statement, plug="PLUG_volume_classify(inout vec4 color, const in VolumeSample s)"):
    code = (BAD_CODE + f"void {plug} {{ int i = int(gl_FragCoord.x); {statement} }}")
    return volume(constant(128), effects=effect(code, "inputOutput SFFloat x 0"), fields="opacityUnitDistance 1")


@suite.row("F34", "NaN in shaders", scene=scene(view(6.5, 0.5), NO_HEADLIGHT, "Transform { scale 13 1 1 children [\n",
                                                 bad_in("color = vec4(bad(i), 0.25, 1.0, 0.5);"), "] }\n"),
           shows="an author's effect makes NaN in twelve ways, in a colour, an opacity, a value, a light",
           invariant="NaN becomes 0 where it arises; nothing else changes, all pixels are numbers")
def shader_numbers(row):
    def of(text, *parts):
        return row.picture("--step", "1", size="13x1", scene=scene(
            view(6.5, 0.5), NO_HEADLIGHT, *parts, "Transform { scale 13 1 1 children [\n", text, "] }\n"))

    a = 0.5
    good = (0.5 * a, 0.25 * a, a, a)
    p = pixels_of(row.picture("--step", "1", size="13x1"))
    row.count("wrong numbers", wrong_numbers(p))
    finite = [i for i, e in enumerate(BAD) if p[i][0] > 0]
    row.measure("colours differ by", worst(p, [(0, *good[1:]) if i not in finite else (p[i][0], *good[1:])
                                               for i in range(12)] + [good]), at_most=FLOOR)
    row.measure("ways that make NaN here", 12 - len(finite), at_least=6)
    p = pixels_of(of(bad_in("color = vec4(0.5, 0.25, 1.0, bad(i));")))
    row.count("wrong numbers", wrong_numbers(p))
    p = pixels_of(of(bad_in("s.value.r = bad(i);", "PLUG_volume_sample(inout VolumeSample s)")))
    row.count("wrong numbers", wrong_numbers(p))
    lamp = LIGHT.replace("}", "effects [ " + effect(
        BAD_CODE + "void PLUG_light_scale(inout float scale, const in vec3 normal_eye, const in vec3 light_dir) "
        "{ scale = bad(int(gl_FragCoord.x)); }", "inputOutput SFFloat x 0") + " ] }")
    p = pixels_of(of(volume(constant(128), LIT, fields="opacityUnitDistance 1"), lamp))
    row.count("wrong numbers", wrong_numbers(p))


def speck(i):
    """Half of a volume: constant; the other: a slope. And noise of one step of 8 bits."""
    return 100 if i % 12 < 6 else 100 + 12 * (i % 12 - 5)


NOISE = [128 + b % 2 for b in scattered((12, 12, 12))]
BY_GRADIENT = "BoundaryEnhancementVolumeStyle { retainedOpacity 0 boundaryOpacity 1 opacityFactor 2 }"


def lit(values, styles, fields=""):
    style = f"ComposedVolumeStyle {{ renderStyle [ {styles} ] }}"
    return scene(WHOLE, NO_HEADLIGHT, LIGHT, volume(voxels(1, (12, 12, 12), values), style, TINT,
                                                    "opacityUnitDistance 1 " + fields))


@suite.row("F35", "normals of nothing", scene=lit(NOISE, f"{BY_GRADIENT} {LIT}", "gradientUnit .1"),
           shows="noise of one step of 8 bits, lit, opaque by its gradient (0.1 a box counts as 1); and a lit volume, half constant",
           invariant="without gradient there is ambient light alone; where gradients weigh, noise does not show")
def no_normals(row):
    p = pixels_of(row.picture("--step", "0.5", scene=lit([speck(i) for i in range(1728)], LIT), size="24x24"))
    alpha = opacity(ALPHA, 1, 1)
    flat = [c for i, c in enumerate(p) if i % 24 < 9]
    row.measure("ambient light differs by", worst(flat, [premultiplied([0.1 * g for g in GREY], alpha)] * len(flat)),
                at_most=FLOOR)
    rough = pixels_of(row.picture("--step", "0.5", scene=lit(NOISE, LIT), size="24x24"))
    smooth = pixels_of(row.picture("--step", "0.5", size="24x24"))
    row.measure("unweighted noise varies by", max(c[2] for c in rough) - min(c[2] for c in rough), at_least=1 / 255)
    row.measure("weighted noise is seen", max(max(c) for c in smooth), at_most=1 / 255)
    row.count("wrong numbers", wrong_numbers(rough) + wrong_numbers(smooth))


# ---- F36 to F39: precision

TWO = volume(voxels(1, (2, 1, 1), (100, 101)), effects=effect(
    "void PLUG_volume_classify(inout vec4 color, const in VolumeSample s) "
    "{ color = vec4((s.value.r * 255.0 - 100.0) * vec3(1.0), 1.0); }"))


@suite.row("F36", "filters of few bits", scene=scene(view(0.25, 0.25 / 4096), NO_HEADLIGHT, TWO),
           shows="two voxels of 8 bits, 100 and 101, from centre to centre in 4096 pixels",
           invariant="thousands of values between, none off by more than floats are")
def filter_bits(row):
    found = [c[0] for c in pixels_of(row.picture("--step", "0.5", size="4096x1"))]
    row.measure("distinct values", len(set(found)), at_least=4000)
    row.measure("values are wrong by (of 255)", max(abs(v - (i + 0.5) / 4096) for i, v in enumerate(found)),
                at_most=255e-6)
    row.not_run("filters of graphics cards, which have 256 places between two texels")


DEEP = range(60000, 60101)
FILES_37 = {"F37-u16.nrrd": nrrd("ushort", "H", (101, 1, 1), DEEP),
            "F37-i16.nrrd": nrrd("short", "h", (101, 1, 1), (v - 65000 for v in DEEP)),
            "F37-i32.nrrd": nrrd("int", "i", (101, 1, 1), (v + 16000000 for v in DEEP)),
            "F37-float.nrrd": nrrd("float", "f", (101, 1, 1), DEEP)}
RANGES_37 = {"u16": (0, 65535), "i16": (-32768, 32767), "i32": (0, 16777215), "float": (0, 65535)}


def deep(kind):
    low, high = RANGES_37[kind]
    code = (f"void PLUG_volume_classify(inout vec4 color, const in VolumeSample s) {{ float v = s.value.r * {high - low}.0"
            f" - {DEEP[0] - low + (-65000 if kind == 'i16' else 16000000 if kind == 'i32' else 0)}.0;"
            " color = vec4(vec3((v + 8.0) / 128.0), 1.0); }")
    return scene(view(0.5, 0.5 / 101), NO_HEADLIGHT,
                 volume(image3d(f"F37-{kind}.nrrd"), effects=effect(code), fields=f"valueRange {low} {high}"))


@suite.row("F37", "low bits are lost", scene=deep("u16"), files=FILES_37,
           shows="values from 60000 to 60100 of 16 bits unsigned and signed, of 24 bits, and as floats, each in the range of its type",
           invariant="each value is told from its neighbours: within half a step")
def low_bits(row):
    for kind in RANGES_37:
        p = pixels_of(row.picture("--step", "0.5", scene=deep(kind), size="101x1"))
        wrong = max(abs(c[0] * 128 - 8 - i) for i, c in enumerate(p))
        row.measure("values differ by (steps of 24 bits)" if kind == "i32" else "values differ by (steps of 16 bits)",
                    wrong, at_most=0.5 if kind == "i32" else 0.01, case=kind)


def id_colors(top):
    return effect(f"{CLASSIFY} {{ color = vec4(vec3(float(s.segment) / {float(top)}), 1.0); }}")


SMALL_IDS = [1 if b % 2 else 3 for b in scattered((4, 4, 4), 5)]
LARGE_IDS = [255 if b % 2 else 256 for b in scattered((4, 4, 4), 6)]
FILES_38 = {"F38-large.nrrd": nrrd("ushort", "H", (4, 4, 4), LARGE_IDS)}


def segmented(ids, effects="", styles=""):
    return (f"SegmentedVolumeData {{ opacityUnitDistance 1 voxels {voxels(1, (4, 4, 4), scattered((4, 4, 4)))} "
            f"segmentIdentifiers {ids} effects [ {effects} ] renderStyle [ {styles} ] }}\n")


def plain_color(red, green, blue):
    return ("OpacityMapVolumeStyle { transferFunction PixelTexture "
            f"{{ image 1 1 4 0x{red:02X}{green:02X}{blue:02X}FF }} }}")


@suite.row("F38", "numbers of segments filtered", files=FILES_38,
           scene=scene(WHOLE, NO_HEADLIGHT, segmented(
               voxels(1, (4, 4, 4), SMALL_IDS), styles=" ".join(
                   [plain_color(0, 0, 255), plain_color(255, 0, 0), plain_color(255, 255, 255), plain_color(0, 255, 0)]))),
           shows="segments 1 and 3 mixed voxel by voxel, four opaque styles; and 255 and 256 in 16 bits",
           invariant="only styles of numbers that are there are seen, each where its voxels are")
def segment_numbers(row):
    def first(ids, i):
        """Of the nearest slice, at a pixel of 40 x 40."""
        return ids[3 * 16 + (39 - i // 40) // 10 * 4 + i % 40 // 10]

    colors = {1: (1, 0, 0, 1), 3: (0, 1, 0, 1)}
    for name, options in row.methods():
        p = pixels_of(row.picture("--step", "0.5", *options, size="40x40"))
        row.count("pixels of other styles", sum(c != colors[first(SMALL_IDS, i)] for i, c in enumerate(p)), case=name)
    for ids, data, top in ((SMALL_IDS, voxels(1, (4, 4, 4), SMALL_IDS), 4), (LARGE_IDS, image3d("F38-large.nrrd"), 512)):
        p = pixels_of(row.picture("--step", "0.5", scene=scene(WHOLE, NO_HEADLIGHT, segmented(data, id_colors(top))),
                                  size="40x40"))
        row.count("pixels of other numbers", sum(c[0] != first(ids, i) / top for i, c in enumerate(p)))


def png(rows):
    """A picture of bytes, rows from the top."""
    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    head = struct.pack(">IIBBBBB", len(rows[0]), len(rows), 8, 0, 0, 0, 0)
    body = b"".join(b"\0" + bytes(line) for line in rows)
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head) + chunk(b"IDAT", zlib.compress(body)) + chunk(b"IEND", b""))


TILES = scattered((6, 5, 2), 9)
SHADES = [bytes(TILES[30 * z + 6 * y + x] for z in range(2) for x in range(6)) for y in range(5)]


def tiled(data, style=""):
    return scene(view(0.6, 0.6), NO_HEADLIGHT, LIGHT, volume(data, style, fields="opacityUnitDistance 1"))


ATLAS = 'ImageTextureAtlas { url "F39-tiles.png" slicesOverX 2 slicesOverY 1 numberOfSlices 2 }'


@suite.row("F39", "atlases bleed", scene=tiled(ATLAS), files={"F39-tiles.png": png(SHADES)},
           shows="two slices of 6 x 5 as tiles of a picture, and as 6 x 5 x 2 voxels, bare and lit",
           invariant="the same picture, gradients included")
def tiles(row):
    plain = voxels(1, (6, 5, 2), TILES)
    for name, options, style in [(*m, "") for m in row.methods()] + [("lit", (), LIT)]:
        a, b = (row.picture("--step", "0.25", *options, scene=tiled(data, style), size="24x24")
                for data in (ATLAS, plain))
        row.measure("pictures differ by", worst(a, b), at_most=0, case=name)
        row.measure("there is something to see", max(c[3] for c in pixels_of(a)), at_least=0.2)


suite.main(__name__)
