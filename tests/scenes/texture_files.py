#!/usr/bin/env python3
"""Textures from files of all formats, texel by texel."""

import base64
import gzip
import math
import os
import struct

from files import png
from harness import Suite
from scenes import effect, front_scene, quad, scene
from textures import A, L, LA, RGB, RGBA, bmp, check_strips, dds, gif, hdr, tga

suite = Suite()

# Two by two texels, the top row first; exact in 8 bits.
PICTURE = [[(255, 0, 51), (0, 102, 255)], [(51, 204, 0), (153, 51, 102)]]
FLAT = [v for row in PICTURE for pixel in row for v in pixel]
# as GL counts texels: from the lower left, row by row
TEXELS = ((0, 0), (1, 0), (0, 1), (1, 1))
FETCH = "texelFetch(tex, ivec2(at.xy), int(at.z))"


def image(url, fields=""):
    return f'ImageTexture {{ url [ "{url}" ] {fields} }}'


def fractions(pixels, whole=255.0):
    return [[v / whole for v in pixels[1 - y][x]] for x, y in TEXELS]


def four_texels(name, texture, pixels=PICTURE, whole=255.0):
    return (name, texture, FETCH, TEXELS, fractions(pixels, whole))


def rgba_bytes(pixels):
    return b"".join(bytes(p) + b"\xff" * (4 - len(p)) for row in pixels for p in row)


@suite.case
def formats():
    "pictures of all formats, upright and exact"
    files = {
        "a.png": png(2, 2, 3, FLAT),
        "a.bmp": bmp(PICTURE),
        "a.tga": tga(PICTURE),
        "a.gif": gif([[0, 1], [2, 3]], [p for row in PICTURE for p in row]),
        "a.dds": dds(2, 2, rgba_bytes(PICTURE)),
        "packed": gzip.compress(png(2, 2, 3, FLAT)),
        "deep.png": png(2, 2, 3, [v * 257 - 1 if v else 1 for v in FLAT], 16),
        "a.hdr": hdr([[(128, 64, 32, 129), (128, 0, 0, 131)], [(64, 64, 64, 128), (0, 0, 0, 0)]]),
    }
    strips = [four_texels(name, image(name)) for name in list(files)[:6]]
    data = "data:image/png;base64," + base64.b64encode(files["a.png"]).decode()
    strips.append(four_texels("a data: url", image(data)))
    strips.append(("16 bits", image("deep.png"), f"({FETCH} - vec4(0.2)) * 1000.0 + 0.5", TEXELS,
                   [[((v * 257 - 1 if v else 1) / 65535 - 0.2) * 1000 + 0.5 for v in pixel]
                    for pixel in (PICTURE[1] + PICTURE[0])]))
    strips.append(("floats beyond 1", image("a.hdr"), f"0.25 * {FETCH}", TEXELS,
                   [0.0625, 0, (0.25, 0.125, 0.0625), (1, 0, 0)]))
    check_strips(suite, strips, files)


@suite.case
def written_by_plugray():
    "an OpenEXR picture is read as it was drawn, its colours divided by alpha"
    made = suite.render(
        scene("OrthoViewpoint { position 0 0 10 fieldOfView -.5 -.5 .5 .5 }\n"
              "NavigationInfo { headlight FALSE }\n",
              quad("UnlitMaterial { emissiveColor .8 .4 .2 transparency .75 }", effect(
                  "void PLUG_fragment_modify(inout vec4 c) { c.rgb *= gl_FragCoord.y < 2.0 ? 1.0 : 2.0; }"))),
        "-o", "a.exr", size="4x4")
    with open(os.path.join(made.folder, "a.exr"), "rb") as file:
        files = {"a.exr": file.read()}
    check_strips(suite, [
        ("colours", image("a.exr"), FETCH, ((0, 1), (0, 2)), [(0.8, 0.4, 0.2), (1.6, 0.8, 0.4)]),
        ("alpha", image("a.exr"), f"{FETCH}.aaa, 1.0", ((0, 1), (0, 2)), [0.25, 0.25]),
    ], files)


# ---- DDS

ROW = ((0, 0), (1, 0))


@suite.case
def dds_masks():
    "DDS: colours, grey and alpha at any place of the texel, in any number of bits"
    def colors(*values):
        return f"{FETCH}", ROW, values

    def alphas(*values):
        return f"{FETCH}.aaa, 1.0", ROW, values

    kinds = [
        ("BGR, 24 bits", dds(2, 1, bytes([1, 2, 3, 255, 0, 51]), RGB, 24, (0xFF0000, 0xFF00, 0xFF, 0)),
         colors((3 / 255, 2 / 255, 1 / 255), (0.2, 0, 1))),
        ("BGRA", dds(2, 1, bytes([1, 2, 3, 4, 255, 0, 51, 0]), RGBA, 32,
                     (0xFF0000, 0xFF00, 0xFF, 0xFF000000)), alphas(4 / 255, 0)),
        ("BGRX has no alpha", dds(2, 1, bytes([1, 2, 3, 4, 255, 0, 51, 0]), RGB, 32,
                                  (0xFF0000, 0xFF00, 0xFF, 0xFF000000)), alphas(1, 1)),
        ("5, 6 and 5 bits", dds(2, 1, struct.pack("<2H", 1 << 11 | 21 << 5 | 31, 30 << 11), RGB, 16,
                                (0xF800, 0x7E0, 0x1F, 0)), colors((1 / 31, 21 / 63, 1), (30 / 31, 0, 0))),
        ("5, 5, 5 bits and one", dds(2, 1, struct.pack("<2H", 0x8000, 0), RGBA, 16,
                                     (0x7C00, 0x3E0, 0x1F, 0x8000)), alphas(1, 0)),
        ("4 bits each", dds(2, 1, struct.pack("<2H", 0x1234, 0xF0F0), RGBA, 16,
                            (0xF00, 0xF0, 0xF, 0xF000)), colors((2 / 15, 3 / 15, 4 / 15), (0, 1, 0))),
        ("10 bits each", dds(2, 1, struct.pack("<2I", 1 | 512 << 10 | 1023 << 20, 1 << 30), RGBA, 32,
                             (0x3FF, 0x3FF << 10, 0x3FF << 20, 3 << 30)),
         colors((1 / 1023, 512 / 1023, 1), 0)),
        ("3, 3 and 2 bits", dds(2, 1, bytes([0b10101011, 0b00100101]), RGB, 8, (0xE0, 0x1C, 3, 0)),
         colors((5 / 7, 2 / 7, 1), (1 / 7, 1 / 7, 1 / 3))),
        ("grey", dds(2, 1, bytes([51, 255]), L, 8, (0xFF, 0, 0, 0)), colors(0.2, 1)),
        ("grey of 16 bits", dds(2, 1, struct.pack("<2H", 1000, 65535), L, 16, (0xFFFF, 0, 0, 0)),
         colors(1000 / 65535, 1)),
        ("grey and alpha: grey", dds(2, 1, bytes([51, 102, 255, 0]), LA, 16, (0xFF, 0, 0, 0xFF00)),
         colors(0.2, 1)),
        ("grey and alpha: alpha", dds(2, 1, bytes([51, 102, 255, 0]), LA, 16, (0xFF, 0, 0, 0xFF00)),
         alphas(0.4, 0)),
        ("alpha alone is white", dds(2, 1, bytes([51, 255]), A, 8, (0, 0, 0, 0xFF)), colors(1, 1)),
        ("alpha alone: alpha", dds(2, 1, bytes([51, 255]), A, 8, (0, 0, 0, 0xFF)), alphas(0.2, 1)),
    ]
    files = {f"{i}.dds": data for i, (_, data, _) in enumerate(kinds)}
    check_strips(suite, [(name, image(f"{i}.dds"), *sample)
                         for i, (name, _, sample) in enumerate(kinds)], files, 2e-5)


@suite.case
def dds_numbers():
    "DDS: half and whole floats, 16-bit integers, DX10 formats"
    def one(data, *colors, **format):
        return data, format, colors

    kinds = [
        ("R16F", one(struct.pack("<2e", 0.5, 2 ** -20), 0.5, 2 ** -20, four_cc=b"\x6f\0\0\0")),
        ("RG16F", one(struct.pack("<4e", 0.5, 0.25, 1, 0), (0.5, 0.25, 0), (1, 0, 0),
                      four_cc=b"\x70\0\0\0")),
        ("RGBA16F", one(struct.pack("<8e", 0.5, 0.25, 0.75, 1, -1, 0, 0.125, 1), (0.5, 0.25, 0.75),
                        (-1, 0, 0.125), four_cc=b"\x71\0\0\0")),
        ("R32F", one(struct.pack("<2f", 0.3, 0.7), 0.3, 0.7, four_cc=b"\x72\0\0\0")),
        ("RGBA32F", one(struct.pack("<8f", .1, .2, .3, 1, .4, .5, .6, 1), (.1, .2, .3), (.4, .5, .6),
                        four_cc=b"\x74\0\0\0")),
        ("RGBA16", one(struct.pack("<8H", 1, 2, 3, 4, 65535, 0, 6553, 0), (1 / 65535, 2 / 65535, 3 / 65535),
                       (1, 0, 6553 / 65535), four_cc=b"\x24\0\0\0")),
        ("DX10 RGB32F", one(struct.pack("<6f", .1, .2, .3, .4, .5, .6), (.1, .2, .3), (.4, .5, .6), dxgi=6)),
        ("DX10 RGBA8", one(bytes([51, 102, 153, 255] * 2), (.2, .4, .6), (.2, .4, .6), dxgi=28)),
        ("DX10 BGRA8 sRGB: as it stands", one(bytes([51, 102, 153, 255] * 2), (.6, .4, .2), (.6, .4, .2),
                                              dxgi=91)),
        ("DX10 R8", one(bytes([51, 255]), .2, 1, dxgi=61)),
        ("DX10 RG8", one(bytes([51, 255, 0, 102]), (.2, 1, 0), (0, .4, 0), dxgi=49)),
        ("DX10 R16", one(struct.pack("<2H", 13107, 0), .2, 0, dxgi=56)),
    ]
    files = {f"{i}.dds": dds(2, 1, data, **format)
             for i, (_, (data, format, _)) in enumerate(kinds)}
    check_strips(suite, [(name, image(f"{i}.dds"), FETCH, ROW, colors)
                         for i, (name, (_, _, colors)) in enumerate(kinds)], files, 1e-5)


def bits(values, size):
    packed = sum(v << (i * size) for i, v in enumerate(values))
    return packed.to_bytes(len(values) * size // 8, "little")


@suite.case
def dds_blocks():
    "DDS: DXT1, DXT3, DXT5, ATI1 and ATI2 blocks, unpacked by their formulas"
    red, blue = 0xF800, 0x001F
    four = struct.pack("<2H", red, blue) + bits([0, 1, 2, 3] * 4, 2)
    three = struct.pack("<2H", blue, red) + bits([0, 1, 2, 3] * 4, 2)
    alphas = bits([15, 0, 5, 10] * 4, 4)
    seven = bytes([255, 0]) + bits([0, 1, 2, 7] * 4, 3)
    five = bytes([0, 255]) + bits([2, 5, 6, 7] * 4, 3)
    first = ((0, 0), (1, 0), (2, 0), (3, 0))
    ramp = [(1, 0, 0), (0, 0, 1), (170 / 255, 0, 85 / 255), (85 / 255, 0, 170 / 255)]
    alpha = f"{FETCH}.aaa, 1.0"
    kinds = [
        ("DXT1, four colours", b"DXT1", four, FETCH, ramp),
        ("DXT1, three colours", b"DXT1", three, FETCH,
         [(0, 0, 1), (1, 0, 0), (128 / 255, 0, 128 / 255), 0]),
        ("DXT1, transparent", b"DXT1", three, alpha, [1, 1, 1, 0]),
        ("DXT3, colours", b"DXT3", alphas + three, FETCH,
         [(0, 0, 1), (1, 0, 0), (85 / 255, 0, 170 / 255), (170 / 255, 0, 85 / 255)]),
        ("DXT3, alpha", b"DXT3", alphas + four, alpha, [1, 0, 5 / 15, 10 / 15]),
        ("DXT5, colours", b"DXT5", seven + four, FETCH, ramp),
        ("DXT5, seven steps of alpha", b"DXT5", seven + four, alpha, [1, 0, 219 / 255, 36 / 255]),
        ("DXT5, five steps of alpha", b"DXT5", five + four, alpha, [0.2, 0.8, 0, 1]),
        ("ATI1", b"ATI1", five, FETCH, [0.2, 0.8, 0, 1]),
        ("ATI2", b"ATI2", five + seven, FETCH,
         [(0.2, 1, 0), (0.8, 0, 0), (0, 219 / 255, 0), (1, 36 / 255, 0)]),
    ]
    files = {f"{i}.dds": dds(4, 4, data, four_cc=code)
             for i, (_, code, data, *_) in enumerate(kinds)}
    # rows of a block lie upside down in the texture; blocks reach over the edge
    rows = bytes([255, 0]) + bits([0] * 4 + [1] * 12, 3)
    files["rows.dds"] = dds(5, 5, rows + bytes([255, 0] + [0] * 6) * 3, four_cc=b"BC4U")
    strips = [(name, image(f"{i}.dds"), expression, first, colors)
              for i, (name, _, _, expression, colors) in enumerate(kinds)]
    strips.append(("rows and edges", image("rows.dds"), FETCH,
                   ((0, 4), (0, 3), (3, 1), (4, 4), (4, 1), (0, 0), (4, 0)), [1, 0, 0, 1, 1, 1, 1]))
    check_strips(suite, strips, files, 1e-5)


@suite.case
def dds_levels():
    "DDS: the mipmaps of the file are taken, as far as they go"
    levels = [bytes([51 * (i + 1)]) * (size * size) for i, size in enumerate((4, 2, 1))]
    grey = {"flags": L, "bits": 8, "masks": (255, 0, 0, 0)}
    files = {
        "all.dds": dds(4, 4, b"".join(levels), levels=3, **grey),
        "two.dds": dds(4, 4, b"".join(levels[:2]), levels=2, **grey),
        "cut.dds": dds(4, 4, b"".join(levels[:2]), levels=3, **grey),
        "many.dds": dds(4, 4, b"".join(levels), levels=99, **grey),
    }
    lod = "textureLod(tex, vec2(0.5), at.x)"
    where = ((0,), (1,), (2,))
    check_strips(suite, [
        ("all", image("all.dds"), lod, where, [.2, .4, .6]),
        ("between two", image("all.dds"), lod, ((.5,), (1.5,)), [.3, .5]),
        ("two", image("two.dds"), lod, where, [.2, .4, .4]),
        ("cut off", image("cut.dds"), lod, where, [.2, .4, .4]),
        ("more than there can be", image("many.dds"), lod, where, [.2, .4, .6]),
    ], files)


@suite.case
def dds_volumes():
    "DDS: volumes as textures of three dimensions and as voxels"
    texels = bytes(51 * v for v in (0, 1, 2, 3, 5, 4, 1, 0))  # x, then y from the top, then z
    grey = {"flags": L, "bits": 8, "masks": (255, 0, 0, 0), "depth": 2}
    files = {"v.dds": dds(2, 2, texels, **grey),
             "new.dds": dds(2, 2, texels, depth=2, dxgi=61),
             "mips.dds": dds(2, 2, texels + b"\xff", levels=2, **grey)}
    fetch = "texelFetch(tex, ivec3(at.xyz), 0)"
    where = ((0, 1, 0), (1, 1, 0), (0, 0, 0), (1, 0, 0), (0, 1, 1), (1, 1, 1), (0, 0, 1), (1, 0, 1))
    check_strips(suite, [
        (name, f'ImageTexture3D {{ url "{name}" }}', fetch, where, [0, .2, .4, .6, 1, .8, .2, 0],
         "sampler3D") for name in files
    ], files)
    column = suite.probe(front_scene('VolumeData { voxels ImageTexture3D { url "v.dds" } }\n'),
                         [(8, 4), (8, 11)], files=files)
    suite.check("voxels are drawn", column[0][3] != column[1][3] and min(column[0][3], column[1][3]) > 0,
                column)


DIRECTIONS = {  # of faces as one sees them from inside: ahead, to the right, up
    "right": ((1, 0, 0), (0, 0, 1), (0, 1, 0)),
    "left": ((-1, 0, 0), (0, 0, -1), (0, 1, 0)),
    "top": ((0, 1, 0), (1, 0, 0), (0, 0, 1)),
    "bottom": ((0, -1, 0), (1, 0, 0), (0, 0, -1)),
    "back": ((0, 0, 1), (-1, 0, 0), (0, 1, 0)),
    "front": ((0, 0, -1), (1, 0, 0), (0, 1, 0)),
}


def toward(face, right, up):
    ahead, to_right, to_up = DIRECTIONS[face]
    return tuple(a + right * r + up * u for a, r, u in zip(ahead, to_right, to_up))


def face_texels(index):
    """Two by two greys that no other face has: top left, top right, bottom left, bottom right."""
    return [10 * index + k for k in (1, 2, 3, 4)]


CUBE_WHERE = [toward(face, *corner) for face in DIRECTIONS
              for corner in ((-.5, .5), (.5, .5), (-.5, -.5), (.5, -.5))]
CUBE_COLORS = [v / 255 for i in range(6) for v in face_texels(i)]
CUBE = "textureLod(tex, at.xyz, 0.0)"


def cube_strip(name, texture, where=None, colors=None):
    return (name, texture, CUBE, where or CUBE_WHERE, colors or CUBE_COLORS, "samplerCube")


@suite.case
def cube_maps():
    "cube maps: every face and each of its corners by direction"
    files = {f"{face}.png": png(2, 2, 1, face_texels(i)) for i, face in enumerate(DIRECTIONS)}
    composed = "ComposedCubeMapTexture { " + " ".join(
        f'{face}Texture ImageTexture {{ url "{face}.png" }}' for face in DIRECTIONS) + " }"
    old = composed.replace("Texture ImageTexture", " ImageTexture")
    mixed = composed.replace('ImageTexture { url "top.png" }', "PixelTexture { image 2 2 4 %s }" % " ".join(
        f"0x{v:02x}{v:02x}{v:02x}ff" for v in face_texels(2)[2:] + face_texels(2)[:2]))
    check_strips(suite, [
        cube_strip("ComposedCubeMapTexture", composed),
        cube_strip("fields called as in X3D 3.0", old),
        cube_strip("faces of different components", mixed),
    ], files)


@suite.case
def dds_cubes():
    "DDS: cube maps, whose -y is up in the space of a scene; with and without mipmaps"
    directions = (lambda s, t: (1, -t, -s), lambda s, t: (-1, -t, s), lambda s, t: (s, 1, t),
                  lambda s, t: (s, -1, -t), lambda s, t: (s, -t, 1), lambda s, t: (-s, -t, -1))
    where = [direction(s, t) for direction in directions for t in (-.5, .5) for s in (-.5, .5)]
    where = [(x, -y, z) for x, y, z in where]
    grey = {"flags": L, "bits": 8, "masks": (255, 0, 0, 0), "cube": True}
    faces = [bytes(face_texels(i)) for i in range(6)]
    files = {
        "cube.dds": dds(2, 2, b"".join(faces), **grey),
        "mips.dds": dds(2, 2, b"".join(f + bytes([200 + i]) for i, f in enumerate(faces)), levels=2,
                        **grey),
        "new.dds": dds(2, 2, b"".join(faces), cube=True, dxgi=61),
        "five.dds": dds(2, 2, b"".join(faces), faces=0x7E00, **grey),
        "cut.dds": dds(2, 2, b"".join(faces)[:-1], **grey),
    }

    def cube(name):
        return f'ImageCubeMapTexture {{ url "{name}" }}'

    result = check_strips(suite, [cube_strip(name, cube(name), where) for name in list(files)[:3]] + [
        ("levels of faces", cube("mips.dds"), "textureLod(tex, at.xyz, 1.0)",
         [(1, 0, 0), (-1, 0, 0), (0, -1, 0), (0, 1, 0), (0, 0, 1), (0, 0, -1)],
         [(200 + i) / 255 for i in range(6)], "samplerCube"),
        ("the first face as a picture", image("cube.dds"), FETCH, TEXELS,
         [v / 255 for v in (3, 4, 1, 2)]),
    ], files)
    suite.equal("with a warning", [m[3:] for m in result.messages()],
                [("warning", "cube.dds is a cube map; the first face is taken", "bad-image")])
    for name, why in (("five.dds", "its cube map lacks faces"), ("cut.dds", "it is cut off")):
        result = check_strips(suite, [(name, cube(name), CUBE, [(1, 0, 0)], [1], "samplerCube")], files,
                              status=1)
        suite.equal(f"{name} is an error", [m[4] for m in result.messages()],
                    [f"this image cannot be read: {why}"])


@suite.case
def cube_pictures():
    "cube maps of one picture: a row, a column, crosses; a panorama"
    names = list(DIRECTIONS)

    def picture(columns, rows, places, turned=()):
        texels = [0] * (columns * rows * 4)
        for face, (column, row) in places.items():
            values = face_texels(names.index(face))
            for k, v in enumerate(values[::-1] if face in turned else values):
                texels[(2 * row + k // 2) * columns * 2 + 2 * column + k % 2] = v
        return png(2 * columns, 2 * rows, 1, texels)

    cross = {"right": (2, 1), "left": (0, 1), "top": (1, 0), "bottom": (1, 2), "front": (1, 1)}
    files = {
        "row.png": picture(6, 1, {f: (i, 0) for i, f in enumerate(names)}),
        "column.png": picture(1, 6, {f: (0, i) for i, f in enumerate(names)}),
        "wide.png": picture(4, 3, {**cross, "back": (3, 1)}),
        "high.png": picture(3, 4, {**cross, "back": (1, 3)}, ["back"]),
        "columns.png": png(8, 4, 1, [30 * x for y in range(4) for x in range(8)]),
        "rows.png": png(8, 4, 1, [80 * y for y in range(4) for x in range(8)]),
        "three.png": png(3, 2, 1, [0] * 6),
    }

    def cube(name):
        return f'ImageCubeMapTexture {{ url "{name}" }}'

    # what lies between two texels of a panorama is linear: so are these, but for the seam at the back
    where = [d for d in CUBE_WHERE if abs(d[1]) < 1 and d[2] < 1]
    column = [4 + 8 * math.atan2(x, -z) / (2 * math.pi) - 0.5 for x, _, z in where]
    row = [2 - 4 * math.atan2(y, math.hypot(x, z)) / math.pi - 0.5 for x, y, z in where]
    result = check_strips(
        suite, [cube_strip(name, cube(name)) for name in list(files)[:4]] + [
            cube_strip("panorama: columns", cube("columns.png"), where, [30 * v / 255 for v in column]),
            cube_strip("panorama: rows", cube("rows.png"), where, [80 * v / 255 for v in row]),
        ], files)
    suite.equal("without a word", result.messages(), [])
    bad = check_strips(suite, [("three by two: white", cube("three.png"), CUBE, [(1, 0, 0)], [1],
                                "samplerCube")], files, status=1)
    suite.equal("and an error", [m[4:] for m in bad.messages()],
                [("three.png cannot be a cube map: the picture is neither six squares, a cross of "
                  "squares nor a panorama", "bad-image")])


suite.run()
