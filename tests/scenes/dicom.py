#!/usr/bin/env python3
"""DICOM series: order, gaps, what goes together, what may be read, what is damaged."""

import os
import struct

import dicom_data as d
from dicom_data import dicom, image
from dicom_scenes import FRONT, Case, all_close, in_folder, refused, run, show, stack, suite


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


run()
