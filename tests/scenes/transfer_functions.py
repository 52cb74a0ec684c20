#!/usr/bin/env python3
"""Transfer functions: u = (v (N-1) + 1/2) / N, straight colours, precision of the texture."""

from files import png
from harness import Suite, opacity, premultiplied
from scenes import constant, front_scene, volume, voxels

suite = Suite()


def mapped(function, value, components=1):
    """One voxel, one reference length: the opacity is the function's."""
    style = f"OpacityMapVolumeStyle {{ transferFunction {function} }}"
    return front_scene(volume(constant(value, components=components), style))


def texture(width, height, components, values):
    return f"PixelTexture {{ image {width} {height} {components} {' '.join(map(str, values))} }}"


def rgba(word, components=4):
    parts = [(word >> 8 * (components - 1 - i) & 255) / 255 for i in range(components)]
    return parts


def expected(color):
    return premultiplied(color[:3], color[3])


TEXELS = [0xFF000000, 0x00FF0040, 0x2040C080, 0xF0E0D0C0]


@suite.case
def texel_centres():
    "0 and 1 at the outer texels' centres, others exactly between"
    function = texture(4, 1, 4, [f"0x{t:08X}" for t in TEXELS])
    for value, texel in zip((0, 85, 170, 255), TEXELS):
        suite.close(f"value {value}", suite.middle(mapped(function, value)), expected(rgba(texel)))


@suite.case
def between_texels():
    "straight RGBA is interpolated linearly"
    function = texture(2, 1, 4, ["0xFF000033", "0x0000FFCC"])
    a, b = rgba(0xFF000033), rgba(0x0000FFCC)
    for value in (51, 102, 128, 204):
        part = value / 255
        color = [x + (y - x) * part for x, y in zip(a, b)]
        suite.close(f"value {value}", suite.middle(mapped(function, value)), expected(color))


@suite.case
def kinds_of_texel():
    "L gives (l,l,l,1), LA (l,l,l,a), RGB opaque"
    for components, word, color in ((1, 0x66, (0.4, 0.4, 0.4, 1)),
                                    (2, 0x6633, (0.4, 0.4, 0.4, 0.2)),
                                    (3, 0x336699, (0.2, 0.4, 0.6, 1)),
                                    (4, 0x33669933, (0.2, 0.4, 0.6, 0.2))):
        function = texture(1, 1, components, [word])
        suite.close(f"{components} components", suite.middle(mapped(function, 77)), expected(color))


@suite.case
def fine_table():
    "T17: a table of 256: voxel i meets texel i, without mipmaps"
    words = [(i * 77 % 256) << 24 | (i * 31 % 256) << 16 | (255 - i) << 8 | (i * 13 % 256)
             for i in range(256)]
    function = texture(256, 1, 4, [f"0x{w:08X}" for w in words])
    for value in (0, 1, 100, 127, 128, 254, 255):
        suite.close(f"value {value}", suite.middle(mapped(function, value), "--step", "0.5"),
                    expected(rgba(words[value])))


@suite.case
def wide_texture_of_one_colour():
    "T17: the rows of a function count for two components; LA voxels look up (l, a)"
    # 2 x 3 texels, bottom row first
    words = [0x00000000, 0xFF0000FF, 0x00FF0080, 0x0000FF80, 0xFFFFFF40, 0x80808040]
    function = texture(2, 3, 4, [f"0x{w:08X}" for w in words])
    for value, index in ((0x0000, 0), (0xFF00, 1), (0x00FF, 4), (0xFFFF, 5)):
        suite.close(f"LA {value:04X}", suite.middle(mapped(function, value, 2)),
                    expected(rgba(words[index])))
    a, b = rgba(words[2]), rgba(words[3])
    low, high = rgba(words[0]), rgba(words[1])
    t = 102 / 255 * 2  # between row 0 and row 1
    s = 51 / 255
    color = [(1 - t) * ((1 - s) * p + s * q) + t * ((1 - s) * u + s * v)
             for p, q, u, v in zip(low, high, a, b)]
    suite.close("between", suite.middle(mapped(function, 0x3366, 2)), expected(color))


@suite.case
def ignored_components():
    "one component looks along the bottom row; RGB voxels use red and green of a 2D function"
    words = [0xFF000080, 0x00FF0080, 0x0000FF80, 0xFFFFFF80]
    function = texture(2, 2, 4, [f"0x{w:08X}" for w in words])
    suite.close("L", suite.middle(mapped(function, 255)), expected(rgba(words[1])))
    suite.close("RGB", suite.middle(mapped(function, 0x00FF77, 3)), expected(rgba(words[2])))


@suite.case
def three_dimensions():
    "T17: a 3D function is looked up with red, green and blue"
    words = [0xFF0000C0, 0x00FF00C0, 0x0000FFC0, 0xFFFF00C0, 0x00FFFFC0, 0xFF00FFC0, 0x808080C0,
             0x204060C0]
    function = voxels(4, (2, 2, 2), [f"0x{w:08X}" for w in words])
    for value, index in ((0x000000, 0), (0xFF0000, 1), (0x00FF00, 2), (0xFF00FF, 5), (0xFFFFFF, 7)):
        suite.close(f"{value:06X}", suite.middle(mapped(function, value, 3)),
                    expected(rgba(words[index])))


@suite.case
def image_files():
    "PNG files of 8 and 16 bits keep their precision"
    function = 'ImageTexture { url "function.png" }'
    eight = png(4, 1, 4, [v for t in TEXELS for v in t.to_bytes(4, "big")])
    for value, texel in zip((0, 85, 170, 255), TEXELS):
        suite.close(f"8 bits, value {value}",
                    suite.middle(mapped(function, value), files={"function.png": eight}),
                    expected(rgba(texel)))
    sixteen = png(2, 1, 4, [60001, 7, 33333, 12345, 257, 40000, 1, 65535], bits=16)
    suite.close("16 bits", suite.middle(mapped(function, 0), files={"function.png": sixteen}),
                expected([v / 65535 for v in (60001, 7, 33333, 12345)]), 3e-6)
    grey = png(2, 1, 2, [0, 0, 0x6666, 0x3333], bits=16)
    suite.close("grey and alpha", suite.middle(mapped(function, 255), files={"function.png": grey}),
                expected((0.4, 0.4, 0.4, 0.2)))


@suite.case
def rows_of_files():
    "the bottom row of an image file is the first of the function"
    file = png(1, 2, 4, [0, 0, 255, 128, 255, 0, 0, 64])
    function = 'ImageTexture { url "function.png" }'
    suite.close("alpha 0 of LA voxels", suite.middle(mapped(function, 0x0000, 2),
                                                     files={"function.png": file}),
                expected((1, 0, 0, 64 / 255)))
    suite.close("alpha 1 of LA voxels", suite.middle(mapped(function, 0x00FF, 2),
                                                     files={"function.png": file}),
                expected((0, 0, 1, 128 / 255)))


@suite.case
def default_ramp():
    "without a function: colour v, alpha v; for any number of components the first counts"
    for style in ("", "OpacityMapVolumeStyle { }", "ComposedVolumeStyle { renderStyle "
                  "OpacityMapVolumeStyle { } }"):
        for components, value in ((1, 0x66), (2, 0x66CC), (3, 0x66FF00)):
            text = front_scene(volume(constant(value, components=components), style))
            suite.close(f"{style or 'no style'}, {components} components", suite.middle(text),
                        premultiplied((0.4,) * 3, 0.4))


@suite.case
def ramp_equals_function():
    "the same linear function with 2 and with 256 texels gives the same picture"
    data = voxels(1, (3, 2, 2), [0, 100, 200, 30, 250, 90, 180, 20, 240, 60, 10, 255])
    pictures = []
    for count in (2, 256):
        words = [round(255 * i / (count - 1)) * 0x101 for i in range(count)]
        style = ("OpacityMapVolumeStyle { transferFunction "
                 + texture(count, 1, 2, [f"0x{w:04X}" for w in words]) + " }")
        text = front_scene(volume(data, style))
        pictures.append(suite.picture(text, "--step", "0.5", size="24x24").values)
    plain = suite.picture(front_scene(volume(data)), "--step", "0.5", size="24x24").values
    suite.close("2 and 256", max(abs(a - b) for a, b in zip(*pictures)), 0, 1e-5)
    suite.close("2 and none", max(abs(a - b) for a, b in zip(pictures[0], plain)), 0, 1e-5)
    suite.check("something is drawn", max(plain) > 0.3, max(plain))


@suite.case
def opaque_texel():
    "an opaque function is opaque for any step, a translucent one is corrected"
    data = constant(255, (4, 4, 4))
    for alpha in (255, 128):
        style = (f"OpacityMapVolumeStyle {{ transferFunction "
                 f"{texture(1, 1, 4, [0x3366CC00 + alpha])} }}")
        for step in (2, 0.3):
            got = suite.middle(front_scene(volume(data, style)), "--step", step)
            amount = 1 if alpha == 255 else opacity(128 / 255, 1, 0.25)
            suite.close(f"alpha {alpha}, step {step}", got, premultiplied((0.2, 0.4, 0.8), amount))


suite.run()
