#!/usr/bin/env python3
"""SegmentedVolumeData: every segment in its own style, T10."""

import re

from harness import Suite, opacity, over, premultiplied
from scenes import constant, effect, front_scene, scene, voxels, FRONT, NO_HEADLIGHT

suite = Suite()


def one_color(rgba, fields=""):
    return f"OpacityMapVolumeStyle {{ {fields} transferFunction PixelTexture {{ image 1 1 4 0x{rgba:08X} }} }}"


RED, GREEN, BLUE = one_color(0xFF000080), one_color(0x00FF0080), one_color(0x0000FF80)
A = opacity(128 / 255, 1, 1)
COLORS = {"red": (1, 0, 0), "green": (0, 1, 0), "blue": (0, 0, 1)}

# Four columns along x of one value, 102, with the labels 0 1 2 7.
DATA = constant(102, (4, 1, 1))
LABELS = voxels(1, (4, 1, 1), (0, 1, 2, 7))
PIXELS = [(5, 8), (7, 8), (9, 8), (11, 8)]


def segmented(styles, labels=LABELS, fields="", data=DATA):
    labels = f"segmentIdentifiers {labels}" if labels else ""
    return (f"SegmentedVolumeData {{ opacityUnitDistance 1 voxels {data} {labels} {fields} "
            f"renderStyle [ {' '.join(styles)} ] }}\n")


def columns(*parts, **more):
    return suite.probe(front_scene(segmented(*parts, **more)), PIXELS, "--step", ".4")


DEFAULT = premultiplied((0.4,) * 3, opacity(0.4, 1, 1))


def colored(name):
    return premultiplied(COLORS[name], A)


@suite.case
def own_styles():
    "segment i is drawn in style i; past the list in the default one"
    got = columns([RED, GREEN, BLUE])
    for i, want in enumerate((colored("red"), colored("green"), colored("blue"), DEFAULT)):
        suite.close(f"column {i}", got[i], want)
    for i, pixel in enumerate(columns([])):
        suite.close(f"no styles, column {i}", pixel, DEFAULT)
    got = columns([RED])
    for i, want in enumerate((colored("red"), DEFAULT, DEFAULT, DEFAULT)):
        suite.close(f"one style, column {i}", got[i], want)


@suite.case
def enabled():
    "segmentEnabled hides segments, those without a style of their own too; past the list all are shown"
    nothing = (0, 0, 0, 0)
    got = columns([RED, GREEN, BLUE], fields="segmentEnabled [ TRUE FALSE ]")
    for i, want in enumerate((colored("red"), nothing, colored("blue"), DEFAULT)):
        suite.close(f"one, column {i}", got[i], want)
    flags = "segmentEnabled [ TRUE TRUE TRUE TRUE TRUE TRUE TRUE FALSE ]"
    for styles, first in (([RED], colored("red")), ([], DEFAULT)):
        got = columns(styles, fields=flags)
        for i, want in enumerate((first, DEFAULT, DEFAULT, nothing)):
            suite.close(f"the last of {len(styles)} styles, column {i}", got[i], want)


@suite.case
def disabled_styles():
    "a segment whose only style is disabled is not drawn; a disabled member of a list is skipped"
    off = one_color(0x00FF0080, "enabled FALSE")
    got = columns([RED, off, f"ComposedVolumeStyle {{ renderStyle [ {off} {BLUE} ] }}", RED])
    for i, want in enumerate((colored("red"), (0, 0, 0, 0), colored("blue"), DEFAULT)):
        suite.close(f"column {i}", got[i], want)


@suite.case
def no_label_between():
    "T10: labels 0 and 2 side by side: no pixel of label 1"
    labels = voxels(1, (2, 1, 1), (0, 2))
    text = front_scene(segmented([RED, GREEN, BLUE], labels, data=constant(102, (2, 1, 1))))
    picture = suite.picture(text, "--size", "64x4")
    greens = sum(picture.at(x, 2)[1] > 0 for x in range(64))
    suite.equal("green pixels", greens, 0)
    suite.close("left", picture.at(31, 2), colored("red"))
    suite.close("right", picture.at(32, 2), colored("blue"))


@suite.case
def large_numbers():
    "numbers beyond 255"
    header = ("NRRD0004\ntype: {}\ndimension: 3\nsizes: 4 1 1\nencoding: ascii\n\n{}\n")
    for kind, numbers in (("ushort", "300 301 65535 7"), ("int", "300 301 1000000 7")):
        files = {"labels.nrrd": header.format(kind, numbers)}
        code = ("void PLUG_volume_shade(inout vec4 color, const in VolumeSample s)"
                "{ color = vec4(float(s.segment) / 2000000.0, float(s.segment % 256) / 256.0, 0.0, 1.0); }")
        text = segmented([], 'ImageTexture3D { url "labels.nrrd" }', f"effects [ {effect(code)} ]")
        got = suite.probe(front_scene(text), PIXELS, files=files)
        for pixel, number in zip(got, numbers.split()):
            n = int(number)
            suite.close(f"{kind} {n}", pixel, (n / 2e6, n % 256 / 256, 0, 1), 1e-6)
    enabled = "segmentEnabled [ " + "TRUE " * 300 + "FALSE ]"
    got = suite.probe(front_scene(segmented([RED], 'ImageTexture3D { url "labels.nrrd" }', enabled)), PIXELS, files=files)
    suite.close("number 300 is hidden", got[0], (0, 0, 0, 0))
    suite.close("301 is not", got[1], DEFAULT)


@suite.case
def very_many():
    "two hundred segments with a map each, one of them hidden: one look-up a sample"
    labels = voxels(1, (4, 1, 1), (0, 100, 199, 250))
    styles = [one_color((i << 24 | 0x80) & 0xFFFFFFFF) for i in range(200)]
    text = segmented(styles, labels, "segmentEnabled [ " + "TRUE " * 100 + "FALSE ]")
    got = suite.probe(front_scene(text), PIXELS, "--step", ".4")
    for pixel, want in zip(got, ((0, 0, 0, A), (0, 0, 0, 0), (199 / 255 * A, 0, 0, A), DEFAULT)):
        suite.close("", pixel, want)
    result = suite.command("render", "scene.x3dv", "--stats", "json", "--size", "8x8", "--step", ".4",
                           files={"scene.x3dv": front_scene(text)})
    suite.check("fetches", '"fetches": 3' in result.output, result.output[-200:])


@suite.case
def other_size():
    "identifiers of another size are ignored, with a warning"
    text = front_scene(segmented([RED, GREEN], voxels(1, (2, 1, 1), (1, 1))))
    result = suite.render(text, *[a for x, y in PIXELS for a in ("--probe", f"{x},{y}")])
    suite.equal("told", [(m[3], m[5]) for m in result.messages()], [("warning", "bad-volume")])
    for line in result.output.splitlines():
        suite.close("segment 0", [float(v) for v in line.split()], colored("red"))


@suite.case
def of_2005():
    "segmentedVoxels: of 2 and 4 components the last is the segment, of 3 the blue one; one alone draws nothing"
    def field(components, values):
        return f"segmentedVoxels {voxels(components, (4, 1, 1), values)}"
    def old(components, values, styles):
        return front_scene(f"SegmentedVolumeData {{ opacityUnitDistance 1 {field(components, values)} "
                           f"renderStyle [ {' '.join(styles)} ] }}\n")
    styles = [RED, GREEN, BLUE]
    for components, base in ((2, 0x6600), (4, 0x66666600), (3, 0x666600)):
        got = suite.probe(old(components, [base | v for v in (0, 1, 2, 1)], styles), PIXELS, "--step", ".4")
        for pixel, name in zip(got, ("red", "green", "blue", "green")):
            suite.close(f"{components} components, {name}", pixel, colored(name))
    result = suite.render(old(1, (1, 1, 1, 1), styles), "--probe", "8,8")
    suite.close("one", [float(v) for v in result.output.split()], (0, 0, 0, 0), 0)
    suite.equal("told", [m[5] for m in result.messages()], ["bad-volume"])


@suite.case
def any_style():
    "lights, lists and blended volumes within one segment"
    shade = "ShadedVolumeStyle { lighting TRUE material Material { emissiveColor 0 0 1 diffuseColor 0 0 0 } }"
    both = f"ComposedVolumeStyle {{ renderStyle [ {GREEN} {shade} ] }}"
    blended = (f"BlendedVolumeStyle {{ weightConstant1 0 weightConstant2 1 renderStyle {RED} voxels {constant(9)} }}")
    got = columns([both, blended, GREEN])
    for i, want in enumerate((colored("blue"), colored("red"), colored("green"), DEFAULT)):
        suite.close(f"column {i}", got[i], want)


def told(text):
    """How samples are taken, what is said of the error, and of blocks."""
    info = suite.command("info", "scene.x3dv", files={"scene.x3dv": text}).output
    full = re.search(r"can be seen in (\d+) % of", info)
    return (*(re.search(rf"^ *{word}: (\w+)", info, re.M).group(1) for word in ("sampling", "error")), full and int(full.group(1)))


@suite.case
def planned():
    "opacity maps and constant factors are drawn with a bound; what else is in a segment that is there is not"
    factor = "BoundaryEnhancementVolumeStyle { boundaryOpacity 0 retainedOpacity 0.5 }"
    halved = f"ComposedVolumeStyle {{ renderStyle [ {BLUE} {factor} ] }}"
    cartoon, fog = "CartoonVolumeStyle { }", "Fog { visibilityRange 9 }"
    code = "void PLUG_volume_shade(inout vec4 color, const in VolumeSample s) { color.g = 0.0; }"
    many = [one_color(0x10000 * i + 0x80) for i in range(256)]
    plenty = {"labels": voxels(1, (16, 16, 1), range(256)), "data": constant(102, (16, 16, 1))}
    for name, text, bounded in (
            ("maps", segmented([RED, GREEN, halved]), True),
            ("none", segmented([]), True),
            ("a hidden one has another", segmented([RED, cartoon], fields="segmentEnabled [ TRUE FALSE ]"), True),
            ("one that is nowhere has", segmented([RED, GREEN, BLUE, cartoon]), True),
            ("one has", segmented([RED, cartoon]), False),
            ("fog", segmented([RED]) + fog, False),
            ("an author", segmented([RED], fields=f"effects [ {effect(code)} ]"), False),
            ("colours", segmented([RED], data=voxels(3, (4, 1, 1), range(4))), False),
            ("no labels", segmented([RED, GREEN], ""), True),
            ("as many as there is room for", segmented(many, **plenty), True),
            ("in two places", segmented([RED, GREEN]) + segmented([GREEN]), True),
            ("in two of three", 2 * segmented([RED, GREEN]) + segmented([GREEN], ""), False)):
        suite.equal(name, told(front_scene(text))[:2], ("cells", "bounded") if bounded else ("midpoint", "estimated"))
    text = front_scene(segmented([RED]))
    drawn = suite.render(text, "--probe", "5,8", "--step", ".4", "--method", "preintegrated", "--stats", "json").output
    suite.check("labels between two samples", '"method": "midpoint"' in drawn, drawn)


@suite.case
def leaps():
    "blocks of hidden segments are leapt over, others never: to the bit"
    size, count = (46, 34, 19), 46 * 34 * 19
    data = voxels(1, size, ((i * i * 7 + i // 5) % 256 for i in range(count)))
    regions = [min(i % 46 // 12, 2) + 64 * (i // 46 % 34 > 23) for i in range(count)]
    maps = [one_color((0x20 + 2 * i) << 24 | (0x9F - i) << 16 | 0x40) for i in range(67)]
    view = ("OrthoViewpoint { position 3 2 9 orientation -.6 .8 0 .4 fieldOfView -1 -1 1 1 }\n", NO_HEADLIGHT)
    for hidden in ((1, 2, 64), (0, 1, 2), (0, 1, 2, *range(63, 67))):
        enabled = " ".join("FALSE" if i in hidden else "TRUE" for i in range(67))
        text = scene(*view, segmented(maps, voxels(1, size, regions), f"segmentEnabled [ {enabled} ]", data))
        pictures = [suite.picture(text, *o, "--size", "32x32").values for o in ((), ("--no-leaping",))]
        suite.check(f"{hidden}: alike", pictures[0] == pictures[1])
        suite.equal(f"{hidden}: something is seen", any(pictures[0]), len(hidden) < 7)
        method, _, full = told(text)
        suite.equal(f"{hidden}: method", method, "cells")
        suite.check(f"{hidden}: blocks", full == 0 if len(hidden) == 7 else 20 < full < 100, full)


@suite.case
def authors():
    "an author's functions on the volume see all segments, after their styles"
    code = "void PLUG_volume_shade(inout vec4 color, const in VolumeSample s) { if (s.segment == 7) color = vec4(1.0, 1.0, 0.0, color.a); }"
    got = columns([RED, GREEN, BLUE], fields=f"effects [ {effect(code)} ]")
    suite.close("segment 7", got[3], premultiplied((1, 1, 0), opacity(0.4, 1, 1)))
    suite.close("segment 0", got[0], colored("red"))


suite.run()
