#!/usr/bin/env python3
"""TransferFunction: piecewise linear between knots, in fractions or in physical values."""

import struct

from harness import Suite, premultiplied
from scenes import FRONT, NO_HEADLIGHT, front_scene, quad, scene, volume, voxels

suite = Suite()

FULL = "OrthoViewpoint { position 0 0 10 fieldOfView -.5 -.5 .5 .5 }\n"


def function(knots, fields="", head=""):
    keys = " ".join(repr(float(key)) for key, _ in knots)
    colors = ", ".join(" ".join(map(str, color)) for _, color in knots)
    return f"{head} TransferFunction {{ key [{keys}] keyValue [{colors}] {fields} }}"


def opacity_map(text):
    return f"OpacityMapVolumeStyle {{ transferFunction {text} }}"


def lookup(knots, at):
    """What holds at a place, straight from the definition; of equal keys the last one counts."""
    if at < knots[0][0]:
        return knots[0][1]
    for (a, low), (b, high) in reversed(list(zip(knots, knots[1:]))):
        if a <= at < b:
            return tuple(x + (y - x) * (at - a) / (b - a) for x, y in zip(low, high))
    return knots[-1][1]


def bar(data, style, fields="", head=""):
    """A row of voxels, each as wide as a pixel and as deep as its opacity counts."""
    return scene(FULL, NO_HEADLIGHT, head,
                 volume(data, style, fields=f"opacityUnitDistance 1 {fields}"))


def look(name, text, count, expected, files=None, tolerance=2e-5):
    """`expected`: straight colours of all voxels."""
    pixels = [(i, count // 2) for i in range(count)]
    got = suite.probe(text, pixels, size=f"{count}x{count}", files=files)
    worst = max(range(count), key=lambda i: max(
        abs(a - b) for a, b in zip(got[i], premultiplied(expected[i][:3], expected[i][3]))))
    wanted = premultiplied(expected[worst][:3], expected[worst][3])
    suite.close(f"{name}, worst at {worst}", got[worst], wanted, tolerance)


def bytes_of(values):
    return voxels(1, (len(values), 1, 1), values)


RISE = [(0, (1, 0, 0, 0)), (0.2, (0, 1, 0, 0.5)), (0.6, (0, 0, 1, 0.25)), (1, (1, 1, 1, 0.75))]


@suite.case
def fractions():
    "exact at the knots and linear between them"
    values = [0, 17, 51, 85, 102, 153, 170, 204, 238, 255]
    cases = (
        ("fifths", RISE),
        ("thirds and sevenths", [(1 / 3, (1, 0, 0, 0.2)), (3 / 7, (0, 1, 0, 0.8)), (2 / 3, (0, 0, 1, 0.4))]),
        ("255ths", [(51 / 255, (1, 0, 0, 1)), (52 / 255, (0, 1, 0, 0.5)), (170 / 255, (0, 0, 1, 0.5))]),
        ("beyond both ends", [(-1, (1, 0, 0, 0.5)), (3, (0, 1, 0, 0.9))]),
        ("one knot", [(0.3, (0.1, 0.2, 0.3, 0.4))]),
    )
    for name, knots in cases:
        look(name, bar(bytes_of(values), opacity_map(function(knots))), len(values),
             [lookup(knots, value / 255) for value in values])


@suite.case
def knots_between_texels():
    "knots that no number of texels holds: wrong by what a texel of 4096 can hide"
    knots = [(0, (0, 0, 0, 0.5)), (0.123456, (1, 0, 0, 0.5)), (0.7654321, (0, 1, 1, 0.5)), (1, (1, 1, 1, 0.5))]
    values = [0, 31, 32, 64, 128, 195, 196, 255]
    look("four knots", bar(bytes_of(values), opacity_map(function(knots))), len(values),
         [lookup(knots, value / 255) for value in values], tolerance=1 / 4095 / 0.123456)


@suite.case
def steps():
    "of two knots at one place the second one holds from there on"
    knots = [(0, (1, 0, 0, 0.5)), (0.4, (1, 0, 0, 0.5)), (0.4, (0, 0, 1, 0.25)), (1, (0, 0, 1, 0.25))]
    values = [0, 51, 101, 102, 103, 255]
    look("a step", bar(bytes_of(values), opacity_map(function(knots))), len(values),
         [lookup(knots, value / 255) for value in values])


def nrrd(values, header=""):
    data = struct.pack(f"<{len(values)}h", *values)
    return (f"NRRD0004\ntype: short\ndimension: 3\nsizes: {len(values)} 1 1\nencoding: raw\n"
            f"endian: little\n{header}\n").encode() + data


HOUNSFIELD = [-1000, -500, 0, 40, 300, 700, 1500, 3000]
FILE = "ImageTexture3D { url \"ct.nrrd\" }"
TISSUE = [(-1000, (0, 0, 0, 0)), (0, (0.5, 0.25, 0, 0.1)), (300, (1, 1, 0.5, 0.5)), (3000, (1, 1, 1, 0.9))]


@suite.case
def physical():
    "keys in the units of the file, whatever range its values are taken from"
    style = opacity_map(function(TISSUE, "physical TRUE"))
    files = {"ct.nrrd": nrrd(HOUNSFIELD)}
    expected = [lookup(TISSUE, value) for value in HOUNSFIELD]
    look("the range of the data", bar(FILE, style), 8, expected, files)
    look("a given range", bar(FILE, style, "valueRange -1000 3000"), 8, expected, files)
    narrow = [lookup(TISSUE, min(max(value, -500), 700)) for value in HOUNSFIELD]
    look("a narrow range clamps", bar(FILE, style, "valueRange -500 700"), 8, narrow, files)
    turned = bar(FILE, style, "valueRange 3000 -1000")
    look("a range turned over", turned, 8, expected, files)
    look("a declared range", bar(FILE, style), 8, expected,
         {"ct.nrrd": nrrd(HOUNSFIELD, "min: -1024\nmax: 3071\n")})
    tenths = [(key / 10, color) for key, color in TISSUE]
    look("bytes count from 0 to 255", bar(bytes_of([0, 30, 100, 255]), opacity_map(function(tenths, "physical TRUE"))),
         4, [lookup(tenths, value) for value in (0, 30, 100, 255)])


@suite.case
def shared():
    "one function on two volumes of different ranges"
    files = {"ct.nrrd": nrrd([0, 100]), "mr.nrrd": nrrd([0, 400])}
    knots = [(0, (1, 0, 0, 0.5)), (100, (0, 1, 0, 0.5)), (400, (0, 0, 1, 0.5))]
    parts = [FRONT, NO_HEADLIGHT]
    for name, head, place in (("ct", function(knots, "physical TRUE", "DEF F"), -0.5), ("mr", "USE F", 0.5)):
        data = FILE.replace("ct", name)
        parts.append(f"Transform {{ translation {place} 0 0 children "
                     + volume(data, opacity_map(head), fields="opacityUnitDistance 1") + "}\n")
    # two pixels for each volume, at the centres of its voxels
    got = suite.probe(scene(*parts), [(x, 2) for x in range(4)], size="4x4", files=files)
    for i, at in enumerate((0, 100, 0, 400)):
        suite.close(f"value {at}", got[i], premultiplied(lookup(knots, at)[:3], 0.5), 2e-5)


@suite.case
def other_uses():
    "as the texture of a shape; in XML; changed in time"
    shape = quad("UnlitMaterial { emissiveColor 1 1 1 }",
                 appearance=f"texture {function([(0, (1, 0, 0, 1)), (1, (0, 1, 0, 1))])}")
    got = suite.probe(front_scene(shape), [(x, 10) for x in (7, 12)], size="20x20")
    for color, s in zip(got, (0.25, 0.75)):
        suite.close(f"a shape at {s}", color, (1 - s, s, 0, 1), 2e-3)
    xml = ("<X3D version='4.0'><Scene><OrthoViewpoint fieldOfView='-.5 -.5 .5 .5'/><NavigationInfo headlight='false'/>"
           "<VolumeData opacityUnitDistance='1'><PixelTexture3D image='1 2 1 1 51 153'/><OpacityMapVolumeStyle>"
           "<TransferFunction key='0 1' keyValue='1 0 0 .5, 0 1 0 .5'/></OpacityMapVolumeStyle></VolumeData></Scene></X3D>")
    look("XML", xml, 2, [(0.8, 0.2, 0, 0.5), (0.4, 0.6, 0, 0.5)])
    timed = bar(bytes_of([51, 153]), opacity_map(function([(0, (1, 0, 0, 0.5)), (1, (0, 1, 0, 0.5))], "", "DEF F"))) + (
        "DEF T TimeSensor { loop TRUE cycleInterval 2 }\n"
        "DEF I CoordinateInterpolator { key [0 1] keyValue [0 0 0, 1 1 1] }\n"
        "DEF B BooleanSequencer { key [0 0.5] keyValue [FALSE TRUE] }\n"
        "ROUTE T.fraction_changed TO B.set_fraction ROUTE B.value_changed TO F.physical\n")
    for time, at in ((0.5, 0.2), (1.5, 1)):  # 51 is 0.2, and beyond the last key if it is 51
        got = suite.probe(timed, [(0, 1)], "--time", time, size="2x2")[0]
        suite.close(f"at {time}", got, premultiplied((1 - at, at, 0), 0.5), 2e-5)


@suite.case
def faults():
    "lists that do not fit: a warning each, and what fits is drawn"
    def told(text):
        result = suite.render(bar(bytes_of([51, 153]), opacity_map(text)), "--probe", "0,1", size="2x2")
        return [m[3:] for m in result.messages()], [float(v) for v in result.output.split()]

    messages, color = told("TransferFunction { key [0 1 2] keyValue [1 0 0 .5, 0 1 0 .5] }")
    suite.equal("three keys, two values", messages, [(
        "warning", "TransferFunction has 3 keys and 2 values; what has no partner is left out", "bad-value")])
    suite.close("what has partners", color, premultiplied((0.8, 0.2, 0), 0.5), 2e-5)
    messages, color = told("TransferFunction { }")
    suite.equal("no keys", [m[2] for m in messages], ["bad-value"])
    suite.close("transparent", color, (0, 0, 0, 0))
    messages, color = told(function([(0.5, (1, 0, 0, 0.5)), (0.1, (0, 1, 0, 0.5)), (1, (0, 0, 1, 0.5))]))
    suite.equal("falling keys", [m[1:] for m in messages], [("the keys of a TransferFunction must not fall", "bad-value")])
    suite.close("before the first", color, premultiplied((1, 0, 0), 0.5), 2e-5)
    many = function([(i / 5000, (i % 2, 0, 0, 0.5)) for i in range(5001)])
    suite.equal("more keys than texels", told(many)[0], [])
    same = function([(1 / 3, (0, 0, 0, 0.5))] * 20000 + [(0.7071, (1, 1, 1, 0.5))])
    suite.close("one key again and again", told(same)[1], (0, 0, 0, 0.5), 2e-5)


suite.run()
