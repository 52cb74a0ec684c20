#!/usr/bin/env python3
"""What a scene can have its voxels from, and what it may ask of the file: exact values of every
type, numbered pictures, atlases, DDS volumes, time points, windows; what is too large."""

import gzip
import math
import struct
import zlib

from harness import Suite
from scenes import effect, scene, volume, voxels

suite = Suite()

# With this effect the first touch shows the voxel itself, opaque.
SHOW = effect("void PLUG_volume_classify(inout vec4 color, const in VolumeSample s) "
              "{ color = vec4(s.value.rgb, 1.0); }")
FULL = "OrthoViewpoint { position 0 0 10 fieldOfView -.5 -.5 .5 .5 }\n"
BEHIND = ("OrthoViewpoint { position 0 0 -10 orientation 0 1 0 3.14159265 "
          "fieldOfView -.5 -.5 .5 .5 }\n")


def image3d(url, more=""):
    return f'ImageTexture3D {{ url "{url}" {more} }}'


def row(data, count, files=None, fields="", view=FULL, channels=1):
    """The values at the centres of the voxels of one row, seen from the front."""
    text = scene(view, volume(data, effects=SHOW, fields=fields))
    pixels = suite.probe(text, [(x, count - 1) for x in range(count)], "--step", "0.01",
                         size=f"{count}x{count}", files=files)
    return [p[c] for p in pixels for c in range(channels)]


def rows(files, count, channels):
    """The same of many files with `count` voxels a row in one picture."""
    n = len(files)
    view = f"OrthoViewpoint {{ position 0 0 10 fieldOfView -.5 -.5 .5 {2 * n - 0.5} }}\n"
    data = [volume(image3d(name), effects=SHOW) for name in files]
    text = scene(view, *(f"Transform {{ translation 0 {2 * i} 0 children {d} }}\n"
                         for i, d in enumerate(data)))
    pixels = [(x, (2 * n - 1 - 2 * i) * count) for i in range(n) for x in range(count)]
    got = suite.probe(text, pixels, "--step", "0.01", size=f"{count}x{2 * n * count}", files=files)
    return {name: [p[c] for p in got[i * count:(i + 1) * count] for c in range(channels[name])]
            for i, name in enumerate(files)}


def nrrd(kind, sizes, data, encoding="raw", more=""):
    head = (f"NRRD0004\ntype: {kind}\ndimension: {len(sizes)}\n"
            f"sizes: {' '.join(map(str, sizes))}\nencoding: {encoding}\n{more}\n")
    return head.encode() + data


def encoded(values, code, big, encoding):
    raw = struct.pack((">" if big else "<") + code * len(values), *values)
    return {"raw": raw, "gzip": gzip.compress(raw), "hex": raw.hex().encode(),
            "ascii": " ".join(map(repr, values)).encode()}[encoding]


@suite.case
def T16():
    "16-bit and float NRRD of spacings 1 1 2.5, gzip, ascii, raw, hex, both endians: exact to 1/65535"
    words = [0, 1, 2, 255, 256, 32767, 32768, 65534, 65535]
    floats = [0.0, 2.0 ** -20, 1 / 65535, 0.1, 0.25, 0.5, 0.7, 1 - 2.0 ** -20, 1.0]
    signed = [-32768, -32767, -1, 0, 1, 2, 1000, 32766, 32767]
    cases = (("ushort", "H", words, 0, 65535), ("short", "h", signed, -32768, 65535),
             ("float", "f", floats, 0, 1), ("double", "d", floats, 0, 1))
    files, expected = {}, {}
    for kind, code, values, low, span in cases:
        for encoding in ("raw", "gzip", "ascii", "hex"):
            for big in ("little", "big"):
                name = f"{kind}-{encoding}-{big}.nrrd"
                data = encoded(values, code, big == "big", encoding)
                more = f"endian: {big}\nspacings: 1 1 2.5\n"
                files[name] = nrrd(kind, (9, 1, 1), data, encoding, more)
                expected[name] = [(v - low) / span for v in values]
    got = rows(files, 9, dict.fromkeys(files, 1))
    for name in files:
        suite.close(name, got[name], expected[name], 1 / 65535 / 2)


@suite.case
def T16_spacings():
    "spacings 1 1 2.5 give a box of this shape where the file's geometry is asked for"
    file = nrrd("uchar", (2, 2, 2), bytes([255] * 8), "raw", 'spacings: 1 1 2.5\nunits: "m" "m" "m"\n')
    text = scene("OrthoViewpoint { position 10 0 0 orientation 0 1 0 1.5707963 "
                 "fieldOfView -4 -4 4 4 }\n",
                 volume(image3d("a.nrrd"), effects=SHOW, fields="fileGeometry TRUE"))
    picture = suite.picture(text, files={"a.nrrd": file}, size="80x80")
    seen = [[picture.at(x, y)[3] > 0.5 for x in range(80)] for y in range(80)]
    columns = sum(any(line[x] for line in seen) for x in range(80))
    rows = sum(any(line) for line in seen)
    suite.equal("the side: depth across, height up", (columns, rows), (50, 20))


@suite.case
def T19():
    "an asymmetric volume from six sides: slice 0 lies at -z, row 0 at -y, column 0 at -x"
    values = [0, 36, 73, 109, 146, 182, 219, 255]  # x fastest, then y, then z
    # where the camera is, how it turns, and which voxels stand at the lower left, lower right,
    # upper left and upper right of what it sees
    sides = (("+z", "0 0 10", "0 1 0 0", (4, 5, 6, 7)),
             ("-z", "0 0 -10", "0 1 0 3.14159265", (1, 0, 3, 2)),
             ("+x", "10 0 0", "0 1 0 1.57079633", (5, 1, 7, 3)),
             ("-x", "-10 0 0", "0 1 0 -1.57079633", (0, 4, 2, 6)),
             ("+y", "0 10 0", "1 0 0 -1.57079633", (6, 7, 2, 3)),
             ("-y", "0 -10 0", "1 0 0 1.57079633", (0, 1, 4, 5)))
    files = {"a.nrrd": nrrd("uchar", (2, 2, 2), bytes(values)),
             "p.png": png([[values[z * 4 + (1 - y) * 2 + x] for z in (0, 1) for x in (0, 1)]
                           for y in (0, 1)])}
    kinds = (("pixels", voxels(1, (2, 2, 2), values)), ("a NRRD file", image3d("a.nrrd")))
    for name, data in kinds:
        for side, position, turn, which in sides:
            text = scene(f"OrthoViewpoint {{ position {position} orientation {turn} "
                         "fieldOfView -.5 -.5 .5 .5 }\n", volume(data, effects=SHOW))
            seen = suite.probe(text, [(0, 15), (15, 15), (0, 0), (15, 0)], "--step", "0.01",
                               files=files)
            suite.close(f"{name} from {side}", [round(p[0] * 255) for p in seen],
                        [values[i] for i in which], 1)


# ---- Pictures

def chunk(name, data):
    return struct.pack(">I", len(data)) + name + data + struct.pack(">I", zlib.crc32(name + data))


def png(rows, deep=False):
    """A grey PNG; rows from the top."""
    code = ">" + ("H" if deep else "B") * len(rows[0])
    body = b"".join(b"\0" + struct.pack(code, *line) for line in rows)
    head = struct.pack(">IIBBBBB", len(rows[0]), len(rows), 16 if deep else 8, 0, 0, 0, 0)
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head) + chunk(b"IDAT", zlib.compress(body))
            + chunk(b"IEND", b""))


@suite.case
def numbered_pictures():
    "a url with a pattern and numbers is a stack of pictures"
    files = {f"s{i:03}.png": png([[10 * i, 10 * i + 1]]) for i in range(1, 13)}
    data = image3d("s%03d.png 1 12 1")
    suite.close("the last in front", row(data, 2, files), [120 / 255, 121 / 255], 1e-5)
    suite.close("the first behind", row(data, 2, files, view=BEHIND), [11 / 255, 10 / 255], 1e-5)
    suite.close("steps", row(image3d("s%03d.png 11 2 -3"), 2, files), [20 / 255, 21 / 255], 1e-5)
    del files["s007.png"]
    result = suite.render(scene(FULL, volume(data)), "--probe", "0,0", files=files, status=1)
    suite.equal("one is missing", result.messages()[0][3:],
                ("error", "'s007.png' does not exist", "missing-file"))


@suite.case
def deep_pictures():
    "16 bits of a stack of pictures are kept"
    files = {f"s{i}.png": png([[0x1234 + i, 0xfedc]], deep=True) for i in (8, 9, 10)}
    suite.close("", row(image3d("s%d.png 8 10"), 2, files),
                [(0x1234 + 10) / 65535, 0xfedc / 65535], 1e-6)


@suite.case
def atlas():
    "tiles of a picture are slices: the first at the top left, its top row at -y"
    rows = [[16 * y + x for x in range(6)] for y in range(4)]
    data = 'ImageTextureAtlas { url "a.png" slicesOverX 3 slicesOverY 2 numberOfSlices 5 }'
    files = {"a.png": png(rows)}
    bottom = FULL.replace("-.5 -.5 .5 .5", "-.5 -.5 .5 0")
    suite.close("the last tile, its first row", row(data, 2, files, view=bottom),
                [(32 + 2) / 255, (32 + 3) / 255], 8 / 255)
    text = scene(FULL, volume(data, effects=SHOW))
    four = suite.probe(text, [(0, 1), (1, 1), (0, 0), (1, 0)], "--step", "0.01", size="2x2",
                       files=files)
    suite.close("slice 4", [p[0] for p in four], [v / 255 for v in (34, 35, 50, 51)], 1e-5)
    four = suite.probe(scene(BEHIND, volume(data, effects=SHOW)), [(1, 1), (0, 1), (1, 0), (0, 0)],
                       "--step", "0.01", size="2x2", files=files)
    suite.close("slice 0", [p[0] for p in four], [v / 255 for v in (0, 1, 16, 17)], 1e-5)
    suite.close("as a texture of a style",
                suite.probe(scene(FULL, volume(voxels(1, (1, 1, 1), [0]),
                                               f"OpacityMapVolumeStyle {{ transferFunction {data} }}")),
                            [(0, 0)], size="1x1", files=files)[0][3], 1, 1e-5)


@suite.case
def atlas_of_parts():
    "tiles that are no whole number of pixels: each voxel is the pixel at its place"
    width, tiles = 10, 3  # 3 1/3 pixels a tile: 3 voxels, 1 1/9 pixels apart
    line = [20 * i for i in range(width)]
    data = f'ImageTextureAtlas {{ url "a.png" slicesOverX {tiles} slicesOverY 1 }}'
    for tile, view in ((tiles - 1, FULL), (0, BEHIND)):
        places = [(tile + (i + 0.5) / 3) * width / tiles for i in range(3)]
        expected = [line[math.floor(p)] / 255 for p in places]
        got = row(data, 3, {"a.png": png([line])}, view=view)
        suite.close(f"tile {tile}", got if view == FULL else got[::-1], expected, 1e-5)


# ---- DDS

def dds(dxgi, size, data, mipmaps=1):
    flags = 0x1 | 0x2 | 0x4 | 0x1000 | 0x800000 | (0x20000 if mipmaps > 1 else 0)
    head = struct.pack("<4s7I44x", b"DDS ", 124, flags, size[1], size[0], 0, size[2], mipmaps)
    pixel = struct.pack("<2I4s5I", 32, 4, b"DX10", 0, 0, 0, 0, 0)
    caps = struct.pack("<5I", 0x401008, 0x200000, 0, 0, 0)
    return head + pixel + caps + struct.pack("<5I", dxgi, 4, 0, 1, 0) + data


@suite.case
def dds_volumes():
    "DDS volumes: bytes, words, halves, floats, of 1, 2 and 4 components; of mipmaps the first"
    halves = [0.0, 0.333251953125, 1.0, 0.5]
    cases = (("R8", 61, "B", 1, [0, 7, 200, 255], 255), ("R16", 56, "H", 1, [0, 1, 65534, 65535], 65535),
             ("R16F", 54, "e", 1, halves, 1), ("R32F", 41, "f", 1, [0, 0.1, 0.9, 1], 1),
             ("RG16", 35, "H", 2, [0, 65535, 300, 5], 65535), ("RG16F", 34, "e", 2, halves, 1),
             ("RGBA8", 28, "B", 4, [1, 2, 3, 255, 9, 8, 7, 255], 255),
             ("RGBA16F", 10, "e", 4, halves + [1.0, 0.25, 0.125, 0.75], 1))
    for width in (2, 4):
        files, expected, shown = {}, {}, {}
        for name, number, code, count, values, most in cases:
            if len(values) == width * count:
                packed = struct.pack(f"<{len(values)}{code}", *values)
                files[name] = dds(number, (width, 1, 2), packed * 2)
                shown[name] = min(count, 3)
                expected[name] = [values[x * count + c] / most for x in range(width)
                                  for c in range(shown[name])]
        got = rows(files, width, shown)
        for name in files:
            suite.close(name, got[name], expected[name], 1e-6)
    levels = bytes([10, 20, 30, 40] * 4) + bytes([99] * 4)
    file = dds(61, (4, 2, 2), levels[:16] + bytes([99] * 2), 2)
    suite.close("mipmaps", row(image3d("a.dds"), 4, {"a.dds": file}),
                [v / 255 for v in (10, 20, 30, 40)], 1e-5)


@suite.case
def dds_slices():
    "the slices of a DDS volume begin at -z, their rows at +y"
    file = dds(61, (2, 2, 2), bytes([0, 30, 60, 90, 120, 150, 180, 210]))
    text = scene(FULL, volume(image3d("a.dds"), effects=SHOW))
    four = suite.probe(text, [(0, 0), (1, 0), (0, 1), (1, 1)], "--step", "0.01", size="2x2",
                       files={"a.dds": file})
    suite.close("", [p[0] * 255 for p in four], [120, 150, 180, 210], 1e-2)


# ---- Components

@suite.case
def components():
    "2, 3 and 4 components of 8, 16 and 32 bits, interleaved and one after the other"
    files, expected, seen = {}, {}, {}
    for count in (2, 3, 4):
        for kind, code, most in (("uchar", "B", 255), ("ushort", "H", 65535), ("uint", "I", 2 ** 32 - 1),
                                 ("float", "f", 1)):
            whole = [most * i // 11 if most > 1 else i / 11 for i in range(12)][:3 * count]
            whole[0], whole[-1] = 0, most  # the range of the data
            raw = struct.pack(f"<{len(whole)}{code}", *whole)
            swapped = [whole[x * count + c] for c in range(count) for x in range(3)]
            planes = struct.pack(f"<{len(whole)}{code}", *swapped)
            shown = min(count, 3)
            values = [whole[x * count + c] / most for x in range(3) for c in range(shown)]
            for name, sizes, kinds, data in (("inner", (count, 3, 1, 1), "vector domain domain domain", raw),
                                             ("outer", (3, 1, 1, count), "domain domain domain vector", planes)):
                name = f"{count}-{kind}-{name}.nrrd"
                files[name] = nrrd(kind, sizes, data, more=f"endian: little\nkinds: {kinds}\n")
                expected[name] = values
                seen[name] = shown
    got = rows(files, 3, seen)
    for name in files:
        suite.close(name, got[name], expected[name], 1e-6)


# ---- Choices of the scene

@suite.case
def time_points():
    "timePoint chooses one of the volumes of a file"
    file = nrrd("uchar", (2, 1, 1, 3), bytes([10, 20, 30, 40, 50, 60]),
                more="kinds: domain domain domain time\n")
    for point, expected in ((0, (10, 20)), (1, (30, 40)), (2, (50, 60))):
        suite.close(f"{point}", row(image3d("a.nrrd", f"timePoint {point}"), 2, {"a.nrrd": file}),
                    [v / 255 for v in expected], 1e-5)
    text = scene(FULL, volume(image3d("a.nrrd", "timePoint 5"), effects=SHOW))
    result = suite.render(text, "--probe", "0,0", files={"a.nrrd": file})
    suite.equal("one too many", [m[3:] for m in result.messages()],
                [("warning", "there is no time point 5; a.nrrd has 3, counted from 0, and the last "
                  "is taken", "bad-value")])


@suite.case
def windows():
    "windowCenter and windowWidth; valueRange wins; both win over the file's own range"
    values = [-1000, -160, 0, 40, 240, 3000]
    raw = struct.pack("<6h", *values)
    for more in ("", "min: -1000\nmax: 3000\n"):
        files = {"a.nrrd": nrrd("short", (6, 1, 1), raw, more="endian: little\n" + more)}
        suite.close("soft tissue" + (", declared" if more else ""),
                    row(image3d("a.nrrd"), 6, files, "windowCenter 40 windowWidth 400"),
                    [0, 0, 160 / 400, 0.5, 1, 1], 1e-6)
        suite.close("valueRange" + (", declared" if more else ""),
                    row(image3d("a.nrrd"), 6, files,
                        "windowCenter 40 windowWidth 400 valueRange 0 240"),
                    [0, 0, 0, 40 / 240, 1, 1], 1e-6)


# ---- Too large

@suite.case
def brought_down():
    "what GL cannot hold and what is not cast in bricks is averaged, with a warning; opacity stays"
    side = 16384
    files = {"a.nrrd": nrrd("uchar", (side, 1, 2), bytes([100, 200] * side))}
    text = scene(FULL, volume(image3d("a.nrrd"), "ProjectionVolumeStyle { }"))
    result = suite.render(text, "--probe", "5,8", "--step", "0.2", files=files)
    messages = [m[3:] for m in result.messages()]
    if not messages:
        suite.skip("16384 voxels a side", "GL takes them here")
        return
    suite.check("one warning", len(messages) == 1 and messages[0][0] == "warning"
                and "16384 x 1 x 2 voxels are more than can be held here; they are brought down by "
                in messages[0][1] and messages[0][2] == "limit", messages)
    suite.close("the mean", float(result.output.split()[0]), 150 / 255, 1e-4)
    # a voxel's opacity belongs to the reference length of the whole volume
    fog = (f"SegmentedVolumeData {{ dimensions 16384 1 2 voxels {image3d('a.nrrd')} "
           f"segmentIdentifiers {image3d('s.nrrd')} }}\n")
    files = {"a.nrrd": nrrd("uchar", (side, 1, 2), bytes([51] * side * 2)),
             "s.nrrd": nrrd("uchar", (side, 1, 2), bytes(side * 2))}
    pixel = suite.probe(scene(FULL, fog), [(0, 0)], "--step", "0.5", size="1x1", files=files)[0]
    suite.close("the opacity", pixel[3], 1 - (1 - 0.2) ** 2, 1e-4)


# ---- Segment numbers

SEGMENT = effect("void PLUG_volume_classify(inout vec4 color, const in VolumeSample s) {\n"
                 "  int n = s.segment;\n"
                 "  color = vec4(vec3(n & 255, n >> 8 & 255, n >> 16 & 255) / 255.0, 1.0); }")


def segments(file, count, side=0):
    """The segment numbers in the middle of `count` parts of a row, and what is said of them."""
    side = side or count
    text = scene(FULL, f"SegmentedVolumeData {{ effects {SEGMENT}\n"
                 f"voxels {image3d('v.nrrd')} segmentIdentifiers\n{image3d('s.nrrd')} }}\n")
    where = [word for x in range(count) for word in ("--probe", f"{x},{count - 1}")]
    files = {"v.nrrd": nrrd("uchar", (side, 1, 2), bytes([255] * side * 2)), "s.nrrd": file}
    result = suite.render(text, *where, "--step", "0.2", size=f"{count}x{count}", files=files)
    found = []
    for line in result.output.splitlines():
        r, g, b, _ = (round(float(v) * 255) for v in line.split())
        found.append(r + 256 * g + 65536 * b)
    return found, [m[3:5] for m in result.messages()]


@suite.case
def segment_numbers():
    "numbers of segments are whole numbers of any size, as stored, never mixed"
    for kind, code, values in (("uchar", "B", [0, 255, 7]), ("ushort", "H", [0, 256, 65535]),
                               ("short", "h", [300, 12, 999]), ("uint", "I", [65536, 70001, 16777215]),
                               ("float", "f", [3.0, 2035.0, 256.0])):
        raw = struct.pack(f"<6{code}", *values * 2)
        suite.equal(kind, segments(nrrd(kind, (3, 1, 2), raw, more="endian: little\n"), 3),
                    ([int(v) for v in values], []))
    raw = struct.pack("<6h", *[-4, 5, -1] * 2)
    suite.equal("below 0", segments(nrrd("short", (3, 1, 2), raw, more="endian: little\n"), 3),
                ([0, 5, 0], [("warning", "4 segment numbers are below 0 or beyond 32 bits; 0 is "
                              "taken for them")]))
    raw = struct.pack("<6f", *[1.75, 5, 1.25] * 2)
    suite.equal("fractions", segments(nrrd("float", (3, 1, 2), raw, more="endian: little\n"), 3),
                ([2, 5, 1], [("warning", "4 segment numbers are not whole; they are rounded")]))


@suite.case
def segmented_voxels():
    "the segment in the last component has no part in the range of the values"
    show = effect("void PLUG_volume_classify(inout vec4 color, const in VolumeSample s) {\n"
                  "  color = vec4(s.value.r, float(s.segment & 255) / 255.0, "
                  "float(s.segment >> 8) / 255.0, 1.0); }")
    values, ids = [0, 250, 1000], [300, 60000, 7]
    raw = struct.pack("<12H", *[n for pair in zip(values, ids) for n in pair] * 2)
    file = nrrd("ushort", (2, 3, 1, 2), raw, more="endian: little\nkinds: vector domain domain domain\n")
    text = scene(FULL, f"SegmentedVolumeData {{ effects {show} segmentedVoxels\n{image3d('a.nrrd')} }}\n")
    got = suite.probe(text, [(x, 2) for x in range(3)], "--step", "0.2", size="3x3",
                      files={"a.nrrd": file})
    suite.close("", [c for p in got for c in p[:3]],
                [n for v, i in zip(values, ids) for n in (v / 1000, (i & 255) / 255, (i >> 8) / 255)],
                1e-5)


@suite.case
def reduced_segments():
    "segment numbers of what is brought down are those of most voxels"
    side = 16384
    # thirds: 9; 9 and 300, three times as many of these; 7
    part = [9] * (side // 4) + [300, 300, 9, 300] * (side // 8) + [7] * (side // 4)
    raw = struct.pack(f"<{2 * side}H", *part * 2)
    found, said = segments(nrrd("ushort", (side, 1, 2), raw, more="endian: little\n"), 4, side)
    if not said:
        suite.skip("16384 voxels a side", "GL takes them here")
        return
    suite.equal("", found, [9, 300, 300, 7])
    suite.equal("one warning", len(said), 1)


@suite.case
def levels():
    "a list of voxels is one volume and its reduced copies; wrong sizes are warnings"
    def level(side, value):
        return voxels(1, (side, 1, 1), [value] * side)
    for sizes, fine in (((4, 2, 1), True), ((5, 3, 2), True), ((5, 2, 1), True), ((4, 3), False),
                        ((4, 4), False)):
        text = scene(FULL, "VolumeData { effects " + SHOW + " voxels [ "
                     + " ".join(level(s, 50 * (i + 1)) for i, s in enumerate(sizes)) + " ] }\n")
        result = suite.render(text, "--probe", "8,8")
        suite.close(f"{sizes}: the finest is drawn", float(result.output.split()[0]), 50 / 255, 1e-4)
        warned = [m for m in result.messages() if "level" in m[4]]
        suite.equal(f"{sizes}: warnings", len(warned), 0 if fine else 1)


suite.run()
