#!/usr/bin/env python3
"""DICOM: every voxel of small series, as physical values, through the whole program."""

import gzip
import os
import struct
import subprocess
import tempfile

import dicom_data as d
from dicom_data import dicom, image
from harness import Picture, Suite
from scenes import effect, scene, volume

suite = Suite()

# Where one looks from: the turn of an OrthoViewpoint, and the place of the axis across in
# `dimensions`. From below, pixel (x, k), counted from the bottom row, is voxel x of slice k, row 0.
BELOW = ("position 0 -10 0 orientation 1 0 0 1.5707963267948966", 2)
FRONT = ("position 0 0 10", 1)
SHOW = effect("void PLUG_volume_classify(inout vec4 color, const in VolumeSample s) "
              "{ color = vec4(s.value.rgb, 1.0); }")


class Case:
    """One url, and what is to be seen of it in a picture of `size` pixels, each a voxel."""

    def __init__(self, name, url, files, expected, size=None, low=0, high=255, view=BELOW,
                 fields=None, texture="", tolerance=1e-5):
        self.name, self.url, self.files, self.expected = name, url, files, list(expected)
        self.size = size or (len(self.expected), 1)
        self.low, self.high, self.view, self.texture = low, high, view, texture
        self.fields = f"valueRange {low} {high}" if fields is None else fields
        self.tolerance = tolerance * (high - low)

    def text(self, left, prefix=""):
        """The volume, whose left side is at `left`, its lower one at 0."""
        width, height = self.size
        turn, across = self.view
        dimensions, place = [width, 1, 1], [left + width / 2, 0, 0]
        dimensions[across], place[across] = height, height / 2
        data = volume(f'ImageTexture3D {{ url "{prefix}{self.url}" {self.texture} }}',
                      effects=SHOW, fields=self.fields, dimensions=dimensions)
        return f"Transform {{ translation {place[0]} {place[1]} {place[2]} children {data} }}"


def draw(cases, prefixes=None, **options):
    """All of them side by side: the colours of each, its lowest row first, and what is said."""
    prefixes = prefixes or [""] * len(cases)
    lefts = [sum(c.size[0] for c in cases[:i]) for i in range(len(cases))]
    width, height = lefts[-1] + cases[-1].size[0], max(c.size[1] for c in cases)
    files = {p + name: content for p, c in zip(prefixes, cases)
             for name, content in c.files.items()}
    text = scene(f"OrthoViewpoint {{ {cases[0].view[0]} fieldOfView 0 0 {width} {height} }}\n",
                 *(c.text(left, p) for c, left, p in zip(cases, lefts, prefixes)))
    result = suite.render(text, "-o", "picture.npy", "--step", "0.01", *options.pop("words", ()),
                          files=files, size=f"{width}x{height}", **options)
    picture = Picture(os.path.join(result.folder, "picture.npy"))
    return [[picture.at(left + x, height - 1 - y)[:3] for y in range(c.size[1])
             for x in range(c.size[0])] for c, left in zip(cases, lefts)], result


def physical(case, colours):
    return [c[0] * (case.high - case.low) + case.low for c in colours]


def all_close(*cases):
    """Draws cases that have the same view; nothing is said of any of them."""
    colours, result = draw(cases, [f"case{i}/" for i in range(len(cases))])
    for case, seen in zip(cases, colours):
        suite.close(case.name, physical(case, seen), case.expected, case.tolerance)
    suite.equal("nothing is said", texts(result), [])


def show(*arguments, said=(), **options):
    """Draws one case; what is said of it."""
    words = options.pop("words", ())
    folder = options.pop("folder", None)
    case = Case(*arguments, **options)
    colours, result = draw([case], words=words, folder=folder)
    suite.close(case.name, physical(case, colours[0]), case.expected, case.tolerance)
    suite.equal(f"{case.name}: said", texts(result), list(said))


def texts(result):
    return [f"{m[3]} {m[4]}" for m in result.messages()]


def refused(cases):
    """Cases of name, url, files, code, end of the message: one error each, at the url."""
    folder, names, files = suite.new_folder(), [], {}
    for i, (_, url, content, _, _) in enumerate(cases):
        names.append(f"case{i}/scene.x3dv")
        files[names[-1]] = scene(Case("", url, {}, [0]).text(0))
        files.update({f"case{i}/{name}": data for name, data in content.items()})
    found = suite.command("check", *names, files=files, folder=folder, status=1).messages()
    for name, case in zip(names, cases):
        own = [m for m in found if m[0] == name]
        suite.check(case[0], [(m[1], m[3], m[5]) for m in own] == [(4, "error", case[3])]
                    and own[0][4].endswith(case[4]), case[4], *own)


def in_folder(files):
    return {f"scan/{name}": content for name, content in files.items()}


def stack(places, **fields):
    """Slices of two pixels that hold 10 times their place, and 1 more; names run backwards."""
    return in_folder({
        f"slice{99 - number}": dicom(image(2, 1, [round(10 * z), round(10 * z) + 1],
                                           position=(0, 0, z), number_of=number, **fields))
        for number, z in enumerate(places)})


def one(values, columns=None, **fields):
    """A file of one slice of one row."""
    return dicom(image(columns or len(values), 1, values, **fields))


def single(name, content, expected, low, high, **options):
    """A case of a file of one row."""
    return Case(name, "a.dcm", {"a.dcm": content}, expected, low=low, high=high, **options)


@suite.case
def order():
    "slices are put in order of place, not of names or numbers; other files are left alone"
    files = {}
    for k, name in enumerate("dbca"):
        values = [10 * k, 10 * k + 1, 10 * k + 2]
        files[name] = dicom(image(3, 2, values * 2, position=(0, 0, 5 * k - 7), number_of=9 - k))
    files.update({"notes.txt": b"no picture", "empty": b"", ".hidden": b"x"})
    all_close(Case("a folder", "scan/", in_folder(files),
                   [10 * k + x for k in range(4) for x in range(3)], (3, 4)),
              Case("a single file of a series is that slice alone", "scan/a", in_folder(files),
                   [30, 31, 32]))


@suite.case
def rows():
    "row 0 lies at -Y, slice 0 at -Z"
    show("", "a.dcm", {"a.dcm": dicom(image(2, 3, [1, 2, 3, 4, 5, 6]))}, range(1, 7), (2, 3),
         view=FRONT)


@suite.case
def other_planes():
    "places count along the normal of the slices, whichever way that points"
    all_close(*(
        Case(name, "scan/", in_folder({
            str(9 - k): dicom(image(2, 1, [k, k + 50], orientation=orientation,
                                    position=[3 * k * w for w in way])) for k in range(3)}),
             [0, 50, 1, 51, 2, 52], (2, 3))
        for name, orientation, way in (("sagittal", (0, 1, 0, 0, 0, -1), (-1, 0, 0)),
                                       ("coronal", (1, 0, 0, 0, 0, -1), (0, 1, 0)),
                                       ("axial, upside down", (1, 0, 0, 0, -1, 0), (0, 0, -1)),
                                       ("oblique", (.6, .8, 0, 0, 0, 1), (.8, -.6, 0)),
                                       ("rounded places", (1, 0, 0, 0, 1, 0), (0, 0, 1 / 3)))))


@suite.case
def gaps():
    "missing and uneven slices: a warning, and values between them, linearly"
    show("missing", "scan/", stack([0, 1, 2, 5, 6]),
         [v for z in range(7) for v in (10 * z, 10 * z + 1)], (2, 7),
         said=["warning 2 slices of scan/ are missing; what lies there is interpolated"])
    show("uneven", "scan/", stack([0, 1, 2.5, 3]),
         [v for k in range(7) for v in (5 * k, 5 * k + 1)], (2, 7),
         said=["warning the slices of scan/ are not evenly spaced; 4 of them are resampled to 7, "
               "0.5 mm apart"])


@suite.case
def duplicates():
    "slices at one place: a warning, the one of the least number is taken"
    files = stack([0, 1, 2])
    files["scan/a"] = dicom(image(2, 1, [70, 71], position=(0, 0, 1), number_of=50))
    show("the first", "scan/", files, [0, 1, 10, 11, 20, 21], (2, 3),
         said=["warning 1 slices of scan/ lie where others lie, among them a; the first at each "
               "place is used"])
    show("timePoint takes the later one, where there is one", "scan/", files,
         [0, 1, 70, 71, 20, 21], (2, 3), texture="timePoint 1")


@suite.case
def unlike():
    "slices that do not go together are refused, and named"
    refused([
        (what, "scan/", {**stack([0, 1, 2]), "scan/z": dicom(odd)}, "bad-volume", message)
        for what, odd, message in (
            ("size", image(3, 1, [1, 2, 3], position=(0, 0, 9)),
             "z is 3 x 1 with 1 samples a pixel, but slice97 is 2 x 1 with 1"),
            ("orientation", image(2, 1, [1, 2], position=(0, 0, 9),
                                  orientation=(1, 0, 0, 0, .8, .6)),
             "z has another orientation than slice97"),
            ("spacing", image(2, 1, [1, 2], position=(0, 0, 9), spacing=(1, 1.1)),
             "z has pixels of another size than slice97"),
            ("no place", image(2, 1, [1, 2], x00200032=None),
             "slice97 says where it lies, but z does not"))])


@suite.case
def types():
    "8, 16 and 32 bits, signed or not"
    cases = []
    for bits in (8, 16, 32):
        for signed in (False, True):
            low, high = (-(1 << bits - 1), (1 << bits - 1) - 1) if signed else (0, (1 << bits) - 1)
            values = [low, low + 1, high // 2, high - 1, high]
            cases.append(single(f"{bits} bits, {'signed' if signed else 'unsigned'}",
                                one(values, bits=bits, signed=signed), values, low, high))
    all_close(*cases)


@suite.case
def stored_bits():
    "only the bits stored count, wherever they are; the sign is theirs"
    values = [0xF000, 0x7001, 0x0FFF, 0x5800]
    all_close(single("12 bits under others", one(values, stored=12), [0, 1, 4095, 2048], 0, 4095),
              single("signed", one(values, stored=12, signed=True), [0, 1, -1, -2048], -2048, 2047),
              single("12 bits at the top",
                     one([0x000F, 0x001F, 0xFFFF, 0x8000], stored=12, x00280102=15),
                     [0, 1, 4095, 2048], 0, 4095))


@suite.case
def rescaled():
    "slope and intercept, also where slices differ in them"
    files = in_folder({str(k): dicom(image(2, 1, [k, 10], position=(0, 0, k),
                                           x00281053=[0.5, 2, -3][k], x00281052=k))
                       for k in range(3)})
    all_close(single("one slice", one([0, 100, 3000], x00281053=0.5, x00281052=-1000),
                     [-1000, -950, 500], -1000, 500),
              Case("each slice its own", "scan/", files, [0, 5, 3, 21, -4, -28], (2, 3), -30, 30))


@suite.case
def padding():
    "padding becomes the least value, and is not among least and greatest"
    lowest = one([-2000, 100, 300, 700], signed=True, x00280120=struct.pack("<h", -2000))
    files = in_folder({str(k): dicom(image(2, 1, [50 * k, 60], position=(0, 0, k),
                                           x00281053=1 + k, x00280120=0)) for k in range(2)})
    all_close(
        single("its range", lowest, [0, 0, 1 / 3, 1], 0, 1, fields=""),
        single("its number", lowest, [100, 100, 300, 700], -2000, 700),
        single("from one value to another", one([1, 2, 3, 40, 90], x00280120=1, x00280121=3),
               [40, 40, 40, 40, 90], 0, 100),
        single("with a falling slope",
               one([0, 100, 300], x00280120=0, x00281053=-1, x00281052=1000), [700, 900, 700],
               0, 1000),
        single("with a window that begins lower",
               one([500, 100, 300], x00280120=500, x00281050=150, x00281051=301), [0, 100, 300],
               -50, 300),
        Case("where slices differ", "scan/", files, [60, 60, 100, 120], (2, 2), 0, 200))


@suite.case
def mirrored():
    "MONOCHROME1 is mirrored within what its bits hold, before slope and intercept"
    bright = dict(x00280004="MONOCHROME1")
    # the window from 40 to 80 is that from 175 to 215 of the mirrored values
    window = dict(x00281050=60, x00281051=40, x00281056="LINEAR_EXACT")
    all_close(
        single("12 bits", one([0, 1, 4095], stored=12, **bright), [4095, 4094, 0], 0, 4095),
        single("signed", one([-2048, 5, 2047], stored=12, signed=True, **bright),
               [2047, -6, -2048], -2048, 2047),
        single("slope and intercept",
               one([0, 55, 255], bits=8, x00281053=2, x00281052=-10, **bright), [500, 390, -10],
               -10, 500),
        single("padding", one([0, 55, 255], bits=8, x00280120=255, **bright), [255, 200, 200],
               0, 255),
        single("the window too", one([60, 40, 50], bits=8, **window, **bright), [0.5, 1, 0.75],
               0, 1, fields=""))


@suite.case
def windows():
    "the file's window is the range; the first of several; valueRange counts more"
    values = [0, 100, 150, 200, 1000]
    cases = [
        single(name, one(values, **tags),
               [min(max((v - low) / (high - low), 0), 1) for v in values], 0, 1, fields="")
        for name, tags, low, high in (
            ("linear", dict(x00281050=150.5, x00281051=101), 100, 200),
            ("exact", dict(x00281050=150, x00281051=100, x00281056="LINEAR_EXACT"), 100, 200),
            ("several", dict(x00281050=[150.5, 0], x00281051=[101, 50]), 100, 200),
            ("rescaled", dict(x00281050=50.5, x00281051=101, x00281052=-100), 0, 100),
            ("no width", dict(x00281050=150, x00281051=1), 0, 1000))]
    cases[3].expected = [0, 0, 0.5, 1, 1]
    cases.append(single("valueRange", one(values, x00281050=150.5, x00281051=101), values, 0, 1000))
    files = in_folder({str(k): dicom(image(1, 1, [150], position=(0, 0, k), x00281051=101,
                                           x00281050=150.5 + 100 * k)) for k in range(2)})
    cases.append(Case("of several slices, what spans them all", "scan/", files, [0.25, 0.25],
                      (1, 2), 0, 1, fields=""))
    all_close(*cases)


@suite.case
def colour():
    "RGB by pixel and by plane, YBR"
    rgb = dict(x00280002=3, x00280004="RGB", bits=8)
    packed = dict(rgb, x7FE00010=None)
    values, by_plane = [255, 0, 51, 0, 102, 255], [255, 0, 0, 102, 51, 255]
    planes = d.fragments([d.rle_frame([bytes(by_plane[2 * c:2 * c + 2]) for c in range(3)])])
    cases = {
        "by pixel": one(values, 2, x00280006=0, **rgb),
        "by plane": one(by_plane, 2, x00280006=1, **rgb),
        "RLE, by pixel": dicom(image(2, 1, b"", x00280006=0, **packed), d.RLE, planes),
        "RLE, by plane": dicom(image(2, 1, b"", x00280006=1, **packed), d.RLE, planes),
        "YBR_FULL": one([76, 85, 255, 128, 128, 128], 2,
                        **dict(rgb, x00280004="YBR_FULL", x00280006=0)),
    }
    wanted = [values] * 4 + [[254, 0, 0, 128, 128, 128]]
    colours, result = draw([Case(name, "a.dcm", {"a.dcm": content}, [0, 0], fields="")
                            for name, content in cases.items()],
                           [f"case{i}/" for i in range(len(cases))])
    for name, seen, expected in zip(cases, colours, wanted):
        suite.equal(name, [round(255 * c) for pixel in seen for c in pixel], expected)
    suite.equal("nothing is said", texts(result), [])


@suite.case
def encodings():
    "every transfer syntax that is read, with odd sizes"
    values = [0, 1, 256, 4095, 65535, 77, 300, 9, 40000]
    plain = image(3, 3, values)
    packed = image(3, 3, b"", x7FE00010=None)
    planes = [bytes(v >> 8 for v in values), bytes(v & 255 for v in values)]
    files = {
        "implicit little endian": dicom(plain, d.IMPLICIT),
        "big endian": dicom(image(3, 3, values, big=True), d.BIG),
        "deflated": dicom(plain, d.DEFLATED),
        "without preamble": d.encode(plain),
        "without preamble, implicit": d.encode(plain, explicit=False),
        "gzipped": gzip.compress(dicom(plain)),
        "RLE": dicom(packed, d.RLE, d.fragments([d.rle_frame(planes)])),
        "JPEG lossless": dicom(packed, d.JPEG_LOSSLESS,
                               d.fragments([d.jpeg_lossless(3, 3, values, 16)])),
    }
    cases = [Case(name, "a.dcm", {"a.dcm": content}, values, (3, 3), 0, 65535, view=FRONT)
             for name, content in files.items()]
    all_close(*cases)
    cases = [single(f"{bits} bits, {name} endian",
                    dicom(image(3, 1, [1, 2, 250], bits=bits, big=syntax == d.BIG), syntax),
                    [1, 2, 250], 0, 255)
             for bits in (8, 32) for name, syntax in (("little", d.LITTLE), ("big", d.BIG))]
    odd = image(3, 1, range(1, 10), bits=8, big=True, x00280008=3)
    cases.append(Case("odd frames, big endian", "a.dcm", {"a.dcm": dicom(odd, d.BIG)},
                      range(1, 10), (3, 3)))
    values = [-1.5, 0.25, 3]
    for name, tag in (("float", "x7FE00008"), ("double", "x7FE00009")):
        content = dicom(image(3, 1, b"", bits=32, x7FE00010=None, **{tag: values}))
        cases.append(single(f"{name} pixels", content, values, -1.5, 3))
    all_close(*cases)


def groups(position, slope=1, intercept=0):
    return {0x00209113: [{0x00200032: list(position)}],
            0x00289145: [{0x00281052: intercept, 0x00281053: slope}]}


@suite.case
def frames():
    "frames of one file: each in its place, with its own values"
    shared = {0x00209116: [{0x00200037: [1, 0, 0, 0, 1, 0]}],
              0x00289110: [{0x00280030: [1, 1], 0x00180050: 1}]}
    enhanced = image(2, 1, [20, 21, 0, 1, 10, 11], x00280008=3, x52009229=[shared],
                     x52009230=[groups((0, 0, 2)), groups((0, 0, 0), 2, 5),
                                groups((0, 0, 1), 1, 100)],
                     x00200032=None, x00200037=None, x00280030=None)
    values = [1, 2, 3, 4, 5, 6]
    packed = dicom(image(2, 1, b"", x00280008=3, x7FE00010=None), d.RLE, d.fragments(
        [d.rle_frame([bytes([0, 0]), bytes(values[2 * k:2 * k + 2])]) for k in range(3)]))
    all_close(*(
        Case(name, "a.dcm", {"a.dcm": content}, expected, (len(expected) // 3, 3))
        for name, content, expected in (
            ("functional groups", dicom(enhanced), [5, 7, 110, 111, 20, 21]),
            ("one behind the other", dicom(image(2, 1, values, x00280008=3, x00180088=2.5)),
             values),
            ("without any place", dicom(image(2, 1, values, x00280008=3, x00200032=None)), values),
            ("packed", packed, values),
            ("of an odd size", dicom(image(3, 1, range(1, 10), bits=8, x00280008=3)),
             range(1, 10)))))
    show("at uneven offsets", "a.dcm",
         {"a.dcm": dicom(image(2, 1, values, x00280008=3, x3004000C=[0, 2, 3]))},
         [1, 2, 2, 3, 3, 4, 5, 6], (2, 4),
         said=["warning 1 slices of a.dcm are missing; what lies there is interpolated"])


@suite.case
def unplaced():
    "slices that do not say where they are: in the order of their numbers, and a warning"
    files = in_folder({str(9 - k): dicom(image(1, 1, [k], number_of=k, x00200032=None))
                       for k in range(3)})
    show("", "scan/", files, [0, 1, 2], (1, 3),
         said=["warning the slices of scan/ do not say where they lie; they are in the order of "
               "their numbers"])


@suite.case
def several_series():
    "the largest series of a folder, or the one that is named"
    files = in_folder({f"{name}{k}": dicom(image(1, 1, [value + k], position=(0, 0, k),
                                                 series=series))
                       for name, series, count, value in (("a", "1.2.1", 2, 10),
                                                          ("b", "1.2.2", 3, 20),
                                                          ("c", "1.2.3", 1, 30))
                       for k in range(count)})
    show("the largest", "scan/", files, [20, 21, 22], (1, 3),
         said=["warning scan/ holds 3 series; the largest, '1.2.2' (3 slices), is read, but not "
               "'1.2.1' (2 slices), '1.2.3' (1 slices)"])
    show("by its name", "scan/#1.2.1", files, [10, 11], (1, 2))
    refused([("no such series", "scan/#1.2", files, "bad-volume",
              "cannot be read as DICOM: it has no series of this SeriesInstanceUID")])


@suite.case
def rules():
    "folders and the files in them are read where files may be read, nowhere else"
    outside = suite.new_folder()
    for k in range(2):
        with open(os.path.join(outside, f"out{k}"), "wb") as file:
            file.write(dicom(image(2, 1, [70, 80], position=(0, 0, 7 + k))))
    show("which --allow allows", f"{outside}/", {}, [70, 80] * 2, (2, 2),
         words=("--allow", outside))
    folder = suite.new_folder()
    os.makedirs(os.path.join(folder, "scan"))
    os.symlink(os.path.join(outside, "out0"), os.path.join(folder, "scan", "link"))
    show("a link that leads out is left out", "scan/", stack([0, 1]), [0, 1, 10, 11], (2, 2),
         said=["warning 1 files of scan/ cannot be read, among them link"], folder=folder)
    os.symlink(outside, os.path.join(folder, "way"))
    refused([("another folder", f"{outside}/", {}, "not-allowed", ""),
             ("a folder that leads out", f"{folder}/way/", {}, "not-allowed", ""),
             ("a folder that is missing", "none/", {}, "missing-file", "does not exist"),
             ("a file as a folder", "scene.x3dv/", {}, "missing-file", "")])


@suite.case
def damaged_in_folder():
    "a damaged file of a series is left out, and named"
    files = stack([0, 1, 3])
    files["scan/bad"] = dicom(image(2, 1, [20, 21], position=(0, 0, 2)))[:-1]
    show("what it showed is interpolated", "scan/", files, [0, 1, 10, 11, 20, 21, 30, 31], (2, 4),
         said=["warning bad is left out: an element is longer than what is left of the file",
               "warning 1 slices of scan/ are missing; what lies there is interpolated"])
    refused([("no pictures at all", "scan/", {"scan/a": b"text", "scan/b": b""}, "bad-volume",
              "scan/ cannot be read as DICOM: none of its files holds pictures")])


def nested(depth):
    head = (struct.pack("<HH2sHI", 0x0040, 0x0275, b"SQ", 0, d.UNDEFINED)
            + struct.pack("<HHI", 0xFFFE, 0xE000, d.UNDEFINED))
    return head * depth


@suite.case
def faults():
    "what is wrong with a file, at its url, before memory is taken"
    good = image(2, 2, [1, 2, 3, 4])
    plain = dicom(good)
    header = {tag: value for tag, value in good.items() if tag != 0x7FE00010}

    def other(**fields):
        return dicom(image(2, 2, [1, 2, 3, 4], **fields))

    def pixel(length, data=b"12345678"):
        return dicom(header, tail=d.element(0x7FE00010, data, vr="OW", length=length))

    longer = "an element is longer than what is left of the file"
    cases = (
        ("cut in the pixels", plain[:-3], longer),
        ("cut in the header", plain[:200], None),
        ("pixels that claim 4 GiB", pixel(0xFFFFFFF0), longer),
        ("fewer pixels than said", pixel(4, b"1234"),
         "it holds 4 bytes of pixels, too few for the 2 x 2 x 1 of its header"),
        ("very many columns", other(x00280011=65535),
         "it says 65535 x 2 x 1 pixels; 1..16384 a side are possible"),
        ("many columns", other(x00280011=16384),
         "it holds 8 bytes of pixels, too few for the 16384 x 2 x 1 of its header"),
        ("many frames", other(x00280008=2000000000),
         "it says 2 x 2 x 2000000000 pixels; 1..16384 a side are possible"),
        ("frames that are not there", other(x00280008=3),
         "it holds 8 bytes of pixels, too few for the 2 x 2 x 3 of its header"),
        ("no rows", other(x00280010=None), "it says 2 x 0 x 1 pixels; 1..16384 a side are possible"),
        ("1 bit", other(x00280100=1), "its pixels of 1 bits are not read"),
        ("more bits stored than allocated", other(x00280101=17),
         "its bits stored do not fit the bits allocated"),
        ("palette", other(x00280004="PALETTE COLOR"),
         "its photometric interpretation PALETTE COLOR is not read"),
        ("grey of three samples", other(x00280002=3), "3 samples a pixel do not go with MONOCHROME2"),
        ("no orientation", other(x00200037=[1, 0, 0, 1, 0, 0]),
         "its orientation is not two perpendicular directions"),
        ("lookup table", other(x00283000=[{0x00280010: 1}]),
         "its modality lookup table is not read"),
        ("no pixels", dicom(header), "it holds no pictures"),
        ("deep", dicom(header, tail=nested(100000)), "sequences are nested too deep"),
        ("an open sequence", dicom(header, tail=nested(3)), "it ends within a sequence"),
        ("disorder", dicom(header, tail=b"".join(
            struct.pack("<HH2sH", 0x7000, 60000 - k, b"DS", 0) for k in range(300))),
         "its elements are in disorder"),
        ("a lying element", dicom(header, tail=d.element(0x00291010, b"ab", vr="UN",
                                                         length=0xFFFFFF00)), longer),
        ("an unknown value representation",
         dicom(header, tail=struct.pack("<HH2sHI", 0x0029, 0x1010, b"DU", 2, 0x7FFFFFFF)),
         "an element has an unknown value representation"),
        ("deflated rubbish", dicom(header, d.DEFLATED)[:-9], "its deflated data cannot be unpacked"),
        ("an unknown transfer syntax", dicom(good, "1.2.3.4"), "its transfer syntax is not known"),
        ("JPEG 2000", dicom(header, d.JPEG_2000, d.fragments([b"rubbish!"])),
         "its way of packing pixels is not read"),
        ("packed frames that are not there",
         dicom({**header, 0x00280008: 2}, d.RLE, d.fragments([d.rle_frame([b"1234", b"1234"])])),
         "it holds 100 bytes of pixels, too few for the 2 x 2 x 2 of its header"),
        ("run lengths that end early",
         dicom(header, d.RLE, d.fragments([d.rle_frame([b"1234", b"123"])])),
         "its pixel data are damaged"),
        ("run lengths that begin elsewhere",
         dicom(header, d.RLE, d.fragments([struct.pack("<16I", 2, 64, 0x7FFFFFF0, *[0] * 13)
                                           + d.rle_frame([b"1234"])])),
         "its pixel data are damaged"),
        ("packed rubbish", dicom(header, d.RLE, d.fragments([b"rubbish!" * 10])), None),
        ("packed rubbish, JPEG", dicom(header, d.JPEG_LOSSLESS, d.fragments([b"rubbish!" * 10])),
         None),
    )
    refused([(name, "a.dcm", {"a.dcm": content}, "bad-volume",
              f"a.dcm cannot be read as DICOM: {message}" if message else "")
             for name, content, message in cases])


def is_built():
    """Whether this program reads DICOM; if not, that it says so, at the url."""
    with tempfile.TemporaryDirectory() as folder:
        names = {"scene.x3dv": scene(Case("", "a.dcm", {}, [0]).text(0)).encode(),
                 "a.dcm": dicom(image(1, 1, [1]))}
        for name, content in names.items():
            with open(os.path.join(folder, name), "wb") as file:
                file.write(content)
        done = subprocess.run([suite.program, "check", "scene.x3dv"], cwd=folder, check=False,
                              capture_output=True, encoding="utf-8")
    return "this plugray was built without DICOM" not in done.stderr


if not is_built():
    suite.cases.clear()

    @suite.case
    def built_without():
        "without a library, an error at the url"
        refused([(url, url, stack([0, 1]), "bad-volume", "this plugray was built without DICOM")
                 for url in ("scan/", "scan/slice99")])

suite.run()
