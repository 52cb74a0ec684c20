#!/usr/bin/env python3
"""DICOM pixels: every voxel of small files, as physical values, through the whole program."""

import gzip
import struct

import dicom_data as d
from dicom_data import dicom, image
from dicom_scenes import (FRONT, Case, all_close, draw, in_folder, one, run, single, suite, texts)


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
    jpeg = d.fragments([d.jpeg_lossless(2, 1, values, 8, 3)])
    cases = {
        "by pixel": one(values, 2, x00280006=0, **rgb),
        "by plane": one(by_plane, 2, x00280006=1, **rgb),
        "RLE, by pixel": dicom(image(2, 1, b"", x00280006=0, **packed), d.RLE, planes),
        "RLE, by plane": dicom(image(2, 1, b"", x00280006=1, **packed), d.RLE, planes),
        "JPEG, by pixel": dicom(image(2, 1, b"", x00280006=0, **packed), d.JPEG_LOSSLESS, jpeg),
        "JPEG, by plane": dicom(image(2, 1, b"", x00280006=1, **packed), d.JPEG_LOSSLESS, jpeg),
        "YBR_FULL": one([76, 85, 255, 128, 128, 128], 2,
                        **dict(rgb, x00280004="YBR_FULL", x00280006=0)),
    }
    wanted = [values] * 6 + [[254, 0, 0, 128, 128, 128]]
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


run()
