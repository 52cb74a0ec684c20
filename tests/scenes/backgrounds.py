"""Backgrounds: what stands in which direction, in closed form."""

import math

from files import png
from harness import HEADER, Suite

suite = Suite()
START = HEADER + "NavigationInfo { headlight FALSE }\n"

# how the viewer turns from the front to see each side upright
TURNS = {
    "front": "0 1 0 0",
    "left": "0 1 0 1.57079633",
    "back": "0 1 0 3.14159265",
    "right": "0 1 0 -1.57079633",
    "top": "1 0 0 1.57079633",
    "bottom": "1 0 0 -1.57079633",
}


def corners(index):
    """The four colours of one side: lower left, lower right, upper left, upper right."""
    return [(0.2 * corner, 0.2 * index, 0.6 if corner % 2 else 0.2) for corner in range(4)]


def numbers(colors):
    return [tuple(round(255 * c) for c in color) for color in colors]


def pixel_texture(index):
    texels = " ".join("0x%02x%02x%02x" % color for color in numbers(corners(index)))
    return f"PixelTexture {{ image 2 2 3 {texels} textureProperties TextureProperties {{ minificationFilter \"AVG_PIXEL\" }} }}"


def file(index):
    """The same as a file: rows from the top."""
    c = numbers(corners(index))
    return png(2, 2, 3, [*c[2], *c[3], *c[0], *c[1]])


def seen(background, turn="0 1 0 0", **options):
    """The corners of a view of 90 degrees: lower left, lower right, upper left, upper right."""
    text = START + f"Viewpoint {{ position 0 0 0 orientation {turn} fieldOfView 1.57079633 }}\n" + background
    return suite.probe(text, [(0, 7), (7, 7), (0, 0), (7, 0)], size="8x8", **options)


def opaque(colors):
    return [value for color in numbers(colors) for value in (*[c / 255 for c in color], 1)]


def flat(colors):
    return [value for color in colors for value in color]


@suite.case
def texture_nodes():
    "a TextureBackground's six textures stand upright around the viewer"
    fields = " ".join(f"{side}Texture {pixel_texture(i)}" for i, side in enumerate(TURNS))
    for i, (side, turn) in enumerate(TURNS.items()):
        got = seen(f"TextureBackground {{ {fields} }}", turn)
        suite.close(side, flat(got), opaque(corners(i)), 1e-3)


@suite.case
def urls():
    "a Background's six files stand where the textures of the same names do"
    fields = " ".join(f'{side}Url "{side}.png"' for side in TURNS)
    files = {f"{side}.png": file(i) for i, side in enumerate(TURNS)}
    for i, (side, turn) in enumerate(TURNS.items()):
        got = seen(f"Background {{ {fields} }}", turn, files=files)
        suite.close(side, flat(got), opaque(corners(i)), 1e-3)


@suite.case
def edges_meet():
    "neighbouring sides meet without a seam: no colour of the far edge is seen"
    fields = " ".join(f"{side}Texture {pixel_texture(i)}" for i, side in enumerate(TURNS))
    text = START + "Viewpoint { position 0 0 0 orientation 0 1 0 0.78539816 }\nTextureBackground { " + fields + " }"
    # the view is centred on the edge between front and left
    got = suite.probe(text, [(31, 40), (32, 40), (31, 24), (32, 24)], size="64x64")
    expected = [corners(1)[1], corners(0)[0], corners(1)[3], corners(0)[2]]
    suite.close("", flat(got), opaque(expected), 1e-3)


@suite.case
def missing_file():
    "a file that is missing is reported; the other sides and the sky are drawn"
    text = START + 'Viewpoint { position 0 0 0 fieldOfView 1.57079633 }\nBackground { skyColor 0 1 0\n leftUrl "no.png" frontUrl "front.png" }'
    result = suite.render(text, "--probe", "0,7", size="8x8", files={"front.png": file(1)}, status=1)
    suite.equal("code and line", [(m[1], m[5]) for m in result.messages()], [(6, "missing-file")])
    color = [float(v) for v in result.output.split()]
    suite.close("the other", color, opaque([corners(1)[0]]), 1e-3)
    turned = text.replace("position 0 0 0", "position 0 0 0 orientation 0 1 0 1.57")
    result = suite.render(turned, "--probe", "3,3", size="8x8", files={"front.png": file(1)}, status=1)
    suite.close("the sky", [float(v) for v in result.output.split()], [0, 1, 0, 1])


@suite.case
def transparent_pictures():
    "sky and ground are seen through what a picture leaves open"
    half = "PixelTexture { image 1 1 4 0xff000080 }"
    got = seen(f"TextureBackground {{ skyColor 0 1 0 frontTexture {half} }}")[0]
    a = 128 / 255
    suite.close("over the sky", got, (a, 1 - a, 0, 1), 1e-3)
    got = seen(f"TextureBackground {{ transparency 1 frontTexture {half} }}")[0]
    suite.close("over nothing", got, (a, 0, 0, a), 1e-3)
    got = seen("Background { skyColor 0 1 0 transparency 0.75 }")[0]
    suite.close("without picture", got, (0, 0.25, 0, 0.25))


SHADER = """TextureBackground { skyColor 0 0 1 frontTexture ShaderTexture { effects Effect { parts EffectPart {
type "FRAGMENT" url "data:text/plain,
void PLUG_texture_color(inout vec4 texture_color, const in vec4 tex_coord)
{ texture_color = vec4(tex_coord.st, texture_color.r * 0.5, 1.0); }" } } } }"""


@suite.case
def shader_textures():
    "a side may be a ShaderTexture, which its effects colour by coordinates"
    got = seen(SHADER)
    low, high = 1 / 16, 15 / 16
    expected = [(low, low), (high, low), (low, high), (high, high)]
    suite.close("", flat(got), [v for s, t in expected for v in (s, t, 0.5, 1)], 1e-3)
    suite.close("beside it the sky", seen(SHADER, TURNS["left"])[0], (0, 0, 1, 1))
    pink = "TextureBackground { frontTexture ShaderTexture { } }"
    suite.close("pink without effects", seen(pink)[0], (1, 0, 1, 1))
    effect = SHADER.replace("ShaderTexture {", "PixelTexture { image 1 1 3 0xff0000").replace("const in vec4 tex_coord", "const in sampler2D image, const in vec4 tex_coord")
    suite.close("effects of other textures", seen(effect)[0], (low, low, 0.5, 1), 1e-3)


@suite.case
def faulty_effect():
    "a faulty effect of a side is reported at its place; the side is drawn without it"
    text = START + "Viewpoint { position 0 0 0 fieldOfView 1.57079633 }\n" + SHADER.replace("tex_coord.st", "nothing")
    result = suite.render(text, "--probe", "3,3", size="8x8", status=1)
    suite.equal("line", [m[1] for m in result.messages() if m[3] == "error"][:1], [8])
    suite.close("pink", [float(v) for v in result.output.split()], [1, 0, 1, 1])


@suite.case
def turned_by_groups():
    "a background turns with the groups around it; their scales and places do not matter"
    fields = " ".join(f"{side}Texture {pixel_texture(i)}" for i, side in enumerate(TURNS))
    for rotation, side in (("0 1 0 1.57079633", "right"), ("1 0 0 1.57079633", "bottom")):
        group = f"Transform {{ translation 5 6 7 rotation {rotation} scale 3 1 0.5 children TextureBackground {{ {fields} }} }}"
        index = list(TURNS).index(side)
        got = sorted(flat(seen(group)))
        suite.close(f"by {rotation}", got, sorted(opaque(corners(index))), 1e-3)


@suite.case
def first_is_bound():
    "of several backgrounds the first is drawn"
    got = seen("Background { skyColor 1 0 0 } TextureBackground { skyColor 0 1 0 } Background { skyColor 0 0 1 }")[0]
    suite.close("", got, (1, 0, 0, 1))


@suite.case
def image_background():
    "an ImageBackground fills the viewport, whatever the camera"
    text = f"ImageBackground {{ color 1 0.5 1 1 texture {pixel_texture(3)} }}"
    got = seen(text, TURNS["left"])
    expected = [(r, g * 0.5, b) for r, g, b in corners(3)]
    suite.close("", flat(got), [v for c in expected for v in (*c, 1)], 3e-3)
    suite.close("without texture", seen("ImageBackground { color 0.25 0.5 1 0.5 }")[0], (0.125, 0.25, 0.5, 0.5))
    mirrored = text.replace("texture ", "texCoords [ 1 0, 0 0, 0 1, 1 1 ] texture ")
    suite.close("coordinates", seen(mirrored)[0][:1], (expected[1][0],), 3e-3)


@suite.case
def sky_by_angle():
    "sky and ground go on beside the pictures"
    text = f"""TextureBackground {{ skyColor [ 1 0 0, 0 1 0 ] skyAngle 1.5707963
    groundColor [ 0 0 1, 0 1 1 ] groundAngle 1.5707963 frontTexture {pixel_texture(2)} }}"""
    up = seen(text, "1 0 0 1.5607963")
    angle = math.atan(math.hypot(7 / 8, 7 / 8)) / (math.pi / 2)
    suite.close("zenith", up[0][:3], (1 - angle, angle, 0), 0.02)
    suite.close("nadir", seen(text, "1 0 0 -1.5607963")[0][:3], (0, angle, 1), 0.02)


suite.run()
