#!/usr/bin/env python3
"""What voxels are worth: components, filtering, files of other types, and where each voxel lies."""

import base64
import gzip
import struct

from harness import Suite, premultiplied
from scenes import constant, effect, front_scene, scene, volume, voxels

suite = Suite()

# With this effect the first touch shows the voxel itself, opaque.
SHOW = effect("void PLUG_volume_classify(inout vec4 color, const in VolumeSample s) "
              "{ color = vec4(s.value.rgb, 1.0); }")


@suite.case
def components():
    "the voxel as a colour before any style: L, LA, RGB, RGBA"
    cases = (
        (1, 0x80, (128, 128, 128, 128)),
        (2, 0x40C0, (64, 64, 64, 192)),
        (3, 0x306090, (48, 96, 144, 96)),
        (4, "0xFF804020", (255, 128, 64, 32)),
        (4, -8372160, (255, 128, 64, 64)),  # 0xFF804040 as a signed number
    )
    for count, value, expected in cases:
        # the style changes nothing: no light, no material
        text = front_scene(volume(constant(value, components=count), "ShadedVolumeStyle { }"))
        rgba = [v / 255 for v in expected]
        suite.close(f"{count} components, {value}", suite.middle(text),
                    premultiplied(rgba[:3], rgba[3]))


@suite.case
def missing_components():
    "missing components are 0, the fourth is 1"
    for count, value, expected in ((1, 0x80, (128, 0, 0, 255)), (2, 0x40C0, (64, 192, 0, 255)),
                                   (3, 0x306090, (48, 96, 144, 255)),
                                   (4, "0x10203040", (16, 32, 48, 64))):
        show = effect(
            "uniform int which;\n"
            "void PLUG_volume_classify(inout vec4 color, const in VolumeSample s) {\n"
            "  color = which == 0 ? vec4(s.value.rgb, 1.0) : vec4(s.value.aaa, 1.0); }",
            "initializeOnly SFInt32 which WHICH")
        for which in (0, 1):
            text = front_scene(volume(constant(value, components=count),
                                      effects=show.replace("WHICH", str(which))))
            wanted = expected[:3] if which == 0 else (expected[3],) * 3
            suite.close(f"{count} components, {'alpha' if which else 'colour'}",
                        suite.middle(text), [v / 255 for v in wanted] + [1])


def across(picture, y=None):
    """The red of the middle row."""
    return [picture.at(x, picture.height // 2 if y is None else y)[0] for x in range(picture.width)]


FULL = "OrthoViewpoint { position 0 0 10 fieldOfView -.5 -.5 .5 .5 }\n"


def interpolated(values, u):
    """At u in 0..1 across the box; clamped beyond the outermost centres."""
    n = len(values)
    at = min(max(u * n - 0.5, 0), n - 1)
    low = min(int(at), n - 2) if n > 1 else 0
    high = min(low + 1, n - 1)
    return values[low] + (values[high] - values[low]) * (at - low)


@suite.case
def trilinear():
    "voxel centres, interpolation between and the value of the outermost beyond"
    values = [0, 255, 51, 204, 102]
    text = scene(FULL, volume(voxels(1, (5, 1, 1), values), effects=SHOW))
    got = across(suite.picture(text, size="40x40"))
    expected = [interpolated(values, (x + 0.5) / 40) / 255 for x in range(40)]
    suite.close("", got, expected, 2e-5)


@suite.case
def half_voxel():
    "the mean of s^2 over N ramp voxels is (2N+1)/(6N)"
    # a function replaces the over of the raycaster: it sums, over the length of the ray
    mean = effect(
        "void PLUG_volume_composite(inout vec4 accumulated, inout vec4 color,"
        " const in VolumeSample s) {\n"
        "  accumulated += vec4(vec3(s.value.r * s.value.r * s.step_length), s.step_length); }",
        'placement "REPLACE" target "Composite"')
    for n in (2, 3, 5, 17):
        data = volume(voxels(1, (1, 1, n), [round(255 * i / (n - 1)) for i in range(n)]),
                      effects=mean)
        exact = [round(255 * i / (n - 1)) / 255 for i in range(n)]
        # piecewise: half a voxel at each end, then linear pieces
        total = (exact[0] ** 2 + exact[-1] ** 2) / (2 * n)
        total += sum(a * a + a * b + b * b for a, b in zip(exact, exact[1:])) / (3 * n)
        pixel = suite.middle(front_scene(data), "--step", "0.02")
        suite.close(f"N = {n}", pixel, (total, total, total, 1), 2e-4)
        if n in (2, 17):
            suite.close(f"N = {n}, closed form", pixel[0], (2 * n + 1) / (6 * n), 2e-3)


@suite.case
def places():
    "slice 0 lies at -z, row 0 at the bottom, column 0 on the left"
    values = [0, 36, 73, 109, 146, 182, 219, 255]
    data = volume(voxels(1, (2, 2, 2), values), effects=SHOW)

    def corner(picture, x, y):
        return round(picture.at(x, y)[0] * 255)

    def corners(picture):
        last = picture.width - 1
        return [corner(picture, x, y) for y in (last, 0) for x in (0, last)]

    size = "64x64"
    front = suite.picture(scene(FULL, data), "--step", "0.01", size=size)
    suite.close("from +z", corners(front), values[4:], 1)
    back = suite.picture(
        scene("OrthoViewpoint { position 0 0 -10 orientation 0 1 0 3.14159265 "
              "fieldOfView -.5 -.5 .5 .5 }\n", data), "--step", "0.01", size=size)
    suite.close("from -z", corners(back), [values[i] for i in (1, 0, 3, 2)], 1)
    right = suite.picture(
        scene("OrthoViewpoint { position 10 0 0 orientation 0 1 0 1.57079633 "
              "fieldOfView -.5 -.5 .5 .5 }\n", data), "--step", "0.01", size=size)
    suite.close("from +x", corners(right), [values[i] for i in (5, 1, 7, 3)], 1)
    top = suite.picture(
        scene("OrthoViewpoint { position 0 10 0 orientation 1 0 0 -1.57079633 "
              "fieldOfView -.5 -.5 .5 .5 }\n", data), "--step", "0.01", size=size)
    suite.close("from +y", corners(top), [values[i] for i in (6, 7, 2, 3)], 1)


@suite.case
def composed_texture():
    "the slices of a ComposedTexture3D run from -z to +z"
    slices = " ".join(f"PixelTexture {{ image 2 1 1 {a} {b} }}" for a, b in ((10, 60), (200, 120)))
    data = f"ComposedTexture3D {{ texture [ {slices} ] }}"
    front = suite.picture(scene(FULL, volume(data, effects=SHOW)), "--step", "0.01", size="64x64")
    suite.close("front", [front.at(0, 30)[0] * 255, front.at(63, 30)[0] * 255], (200, 120), 1)
    back = suite.picture(
        scene("OrthoViewpoint { position 0 0 -10 orientation 0 1 0 3.14159265 "
              "fieldOfView -.5 -.5 .5 .5 }\n", volume(data, effects=SHOW)),
        "--step", "0.01", size="64x64")
    suite.close("back", [back.at(63, 30)[0] * 255, back.at(0, 30)[0] * 255], (10, 60), 1)


# ---- files

TYPES = {  # NRRD type: array code, lowest, highest
    "int8": ("b", -100, 27), "uint8": ("B", 3, 250), "int16": ("h", -1024, 2986),
    "uint16": ("H", 60000, 60100), "int32": ("i", -2000000, 1000000), "uint32": ("I", 0, 4000000000),
    "int64": ("q", -500, 700), "uint64": ("Q", 5, 9005), "float": ("f", -0.5, 2.5),
    "double": ("d", 1e-3, 3e-3),
}


def nrrd_header(kind, size, encoding, extra=""):
    return (
        f"NRRD0004\n# written by a test\ntype: {kind}\ndimension: 3\n"
        f"sizes: {size[0]} {size[1]} {size[2]}\nencoding: {encoding}\n{extra}"
    )


def packed(code, values, big=False):
    return struct.pack((">" if big else "<") + code * len(values), *values)


def ramp_values(low, high, code, count=5):
    values = [low + (high - low) * i / (count - 1) for i in range(count)]
    return values if code in "fd" else [int(v) for v in values]


def image_volume(url, fields=""):
    return volume(f'ImageTexture3D {{ url "{url}" }}', effects=SHOW, fields=fields)


def shown(url, files, fields="", arguments=(), pixels=40):
    text = scene(FULL, image_volume(url, fields))
    return across(suite.picture(text, *arguments, files=files, size=f"{pixels}x{pixels}"))


def expected_ramp(values, low, high, pixels=40):
    scaled = [min(max((v - low) / (high - low), 0), 1) for v in values]
    return [interpolated(scaled, (x + 0.5) / pixels) for x in range(pixels)]


@suite.case
def types():
    "every numeric type, from the least to the greatest value of the data to 0..1"
    for kind, (code, low, high) in TYPES.items():
        for big in (False, True):
            if code in "bB" and big:
                continue
            values = ramp_values(low, high, code)
            order = "" if code in "bB" else f"endian: {'big' if big else 'little'}\n"
            file = nrrd_header(kind, (5, 1, 1), "raw", order).encode() + b"\n" + packed(code, values, big)
            # 8-bit data is value / 255, other data from its least to its greatest
            bounds = (0, 255) if kind == "uint8" else (low, high)
            suite.close(f"{kind}{', big endian' if big else ''}",
                        shown("data.nrrd", {"data.nrrd": file}), expected_ramp(values, *bounds),
                        2e-5)


@suite.case
def encodings():
    "raw, gzip, ascii; detached, with lines and bytes to skip"
    values = ramp_values(-1024, 2986, "h")
    raw = packed("h", values)
    expected = expected_ramp(values, -1024, 2986)
    end = "endian: little\n"
    text = " ".join(map(str, values[:2])) + "\n" + "\n".join(map(str, values[2:])) + "\n"
    cases = {
        "gzip": {"data.nrrd": nrrd_header("short", (5, 1, 1), "gzip", end).encode() + b"\n"
                 + gzip.compress(raw)},
        "ascii": {"data.nrrd": nrrd_header("short", (5, 1, 1), "ascii").encode() + b"\n"
                  + text.encode()},
        "text, CRLF": {"data.nrrd": (nrrd_header("int16_t", (5, 1, 1), "txt") + "\n" + text)
                       .replace("\n", "\r\n").encode()},
        "detached": {"data.nrrd": nrrd_header("int16", (5, 1, 1), "raw", end
                                              + "data file: voxels.raw\n") + "\n",
                     "voxels.raw": raw},
        "byte skip": {"data.nrrd": nrrd_header("int16", (5, 1, 1), "raw", end
                                               + "byte skip: 7\ndata file: voxels.raw\n"),
                      "voxels.raw": b"1234567" + raw},
        "from the end": {"data.nrrd": nrrd_header("int16", (5, 1, 1), "raw", end
                                                  + "byte skip: -1\ndata file: voxels.raw\n"),
                         "voxels.raw": b"any length" + raw},
        "line skip": {"data.nrrd": nrrd_header("int16", (5, 1, 1), "raw", end
                                               + "line skip: 2\nbyte skip: 1\ndata file: v.raw\n"),
                      "v.raw": b"one\ntwo\n!" + raw},
        "detached gzip": {"data.nrrd": nrrd_header("int16", (5, 1, 1), "gz", end
                                                   + "data file: voxels.gz\n"),
                          "voxels.gz": gzip.compress(raw)},
    }
    for name, files in cases.items():
        suite.close(name, shown("data.nrrd", files), expected, 2e-5)


@suite.case
def declared_range():
    "min and max of the file, valueRange of the scene"
    values = ramp_values(-1024, 2986, "h")
    data = packed("h", values)
    head = nrrd_header("int16", (5, 1, 1), "raw", "endian: little\n")
    declared = (head + "min: -2000\nmax: 4000\n\n").encode() + data
    suite.close("declared", shown("d.nrrd", {"d.nrrd": declared}),
                expected_ramp(values, -2000, 4000), 2e-5)
    plain = head.encode() + b"\n" + data
    suite.close("valueRange clamps",
                shown("d.nrrd", {"d.nrrd": plain}, "valueRange 0 1500"),
                expected_ramp(values, 0, 1500), 2e-5)
    suite.close("valueRange of 8-bit data",
                across(suite.picture(
                    scene(FULL, volume(voxels(1, (5, 1, 1), [0, 50, 100, 150, 200]), effects=SHOW,
                                       fields="valueRange 50 150")), size="40x40")),
                expected_ramp([0, 50, 100, 150, 200], 50, 150), 2e-5)
    wide = packed("H", [60000, 60001, 60002, 60050, 60100])
    file = nrrd_header("uint16", (5, 1, 1), "raw", "endian: little\n").encode() + b"\n" + wide
    suite.close("the last bits of 16 count",
                shown("d.nrrd", {"d.nrrd": file}, "valueRange 60000 60010"),
                expected_ramp([60000, 60001, 60002, 60050, 60100], 60000, 60010), 2e-4)


def nifti(code, number, values, slope=0.0, intercept=0.0, big=False):
    order = ">" if big else "<"
    size = struct.calcsize(code)
    header = bytearray(352)
    struct.pack_into(order + "i", header, 0, 348)
    struct.pack_into(order + "8h", header, 40, 3, len(values), 1, 1, 1, 1, 1, 1)
    struct.pack_into(order + "2h", header, 70, number, 8 * size)
    struct.pack_into(order + "8f", header, 76, 1, 1, 1, 1, 0, 0, 0, 0)
    struct.pack_into(order + "3f", header, 108, 352, slope, intercept)
    header[344:348] = b"n+1\0"
    return bytes(header) + packed(code, values, big)


@suite.case
def nifti_files():
    "NIfTI-1: types, byte order, gzip, slope and intercept"
    values = ramp_values(-1024, 2986, "h")
    expected = expected_ramp(values, -1024, 2986)
    for name, content in (("n.nii", nifti("h", 4, values)),
                          ("n.nii", nifti("h", 4, values, big=True)),
                          ("n.nii.gz", gzip.compress(nifti("h", 4, values)))):
        suite.close(name, shown(name, {name: content}), expected, 2e-5)
    floats = ramp_values(-0.5, 2.5, "f")
    suite.close("float", shown("n.nii", {"n.nii": nifti("f", 16, floats)}),
                expected_ramp(floats, -0.5, 2.5), 2e-5)
    scaled = nifti("h", 4, values, slope=0.5, intercept=100)
    suite.close("slope and intercept", shown("n.nii", {"n.nii": scaled}, "valueRange 0 1000"),
                expected_ramp([0.5 * v + 100 for v in values], 0, 1000), 2e-5)


@suite.case
def first_axis_is_fastest():
    "in files too, the first axis is x, the second y, the third z"
    values = [0, 36, 73, 109, 146, 182, 219, 255]
    file = nrrd_header("uint8", (2, 2, 2), "raw").encode() + b"\n" + bytes(values)
    picture = suite.picture(scene(FULL, image_volume("v.nrrd")), "--step", "0.01",
                            files={"v.nrrd": file}, size="64x64")
    got = [picture.at(x, y)[0] * 255 for y in (63, 0) for x in (0, 63)]
    suite.close("", got, values[4:], 1)


@suite.case
def colour_file():
    "a NRRD of colours"
    file = (b"NRRD0004\ntype: uint8\ndimension: 4\nsizes: 3 2 1 1\n"
            b"kinds: RGB-color domain domain domain\nencoding: raw\n\n"
            + bytes([255, 0, 51, 0, 102, 255]))
    picture = suite.picture(scene(FULL, image_volume("c.nrrd")), files={"c.nrrd": file}, size="8x8")
    suite.close("left", picture.at(0, 4), (1, 0, 0.2, 1))
    suite.close("right", picture.at(7, 4), (0, 0.4, 1, 1))


@suite.case
def bad_files():
    "a missing, a broken and a forbidden file: an error at the url, the rest is drawn"
    rest = "Transform { translation 0 0 0 children [\n" + volume(constant(255)) + "] }\n"
    head = nrrd_header("int16", (50, 50, 50), "raw", "endian: little\n").encode() + b"\n"
    for url, files, code in (("none.nrrd", {}, "missing-file"),
                             ("short.nrrd", {"short.nrrd": head + b"few"}, "bad-volume"),
                             ("junk.nrrd", {"junk.nrrd": b"not a volume at all"}, "bad-image"),
                             ("/etc/passwd", {}, "not-allowed"),
                             ("../outside.nrrd", {}, "not-allowed")):
        text = front_scene(image_volume(url), rest)
        result = suite.render(text, "--probe", "8,8", files=files, status=1)
        suite.equal(f"{url}: one error of its kind", [m[5] for m in result.messages()], [code])
        suite.equal(f"{url}: the rest is drawn", result.output.split(), ["1.00000000"] * 4)


@suite.case
def data_url():
    "voxels in a data: url"
    file = nrrd_header("uint8", (1, 1, 1), "raw").encode() + b"\n" + b"\x66"
    url = "data:application/octet-stream;base64," + base64.b64encode(file).decode()
    text = front_scene(image_volume(url))
    suite.close("", suite.middle(text), (0.4, 0, 0, 1))


suite.run()
