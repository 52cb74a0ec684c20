#!/usr/bin/env python3
"""Textures from files of all formats, texel by texel."""

import base64
import gzip
import os
import struct

from files import png
from harness import CaseError, Suite
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


suite.run()
