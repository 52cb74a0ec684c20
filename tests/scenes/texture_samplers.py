#!/usr/bin/env python3
"""How textures are found, filtered, repeated and handed to effects."""

import os
import struct

from files import png
from harness import Suite, read_probes
from scenes import FRONT, NO_HEADLIGHT, effect, front_scene, quad, scene, volume, constant
from textures import bmp, check_strips, dds, strip

suite = Suite()

STEP = "PixelTexture {{ image 2 1 1 0 0xff {} }}"  # black, then white
LOD = "textureLod(tex, at.xy, at.z)"


def step(properties="", fields=""):
    if properties:
        fields += f" textureProperties TextureProperties {{ {properties} }}"
    return STEP.format(fields)


# From the left of the black texel: its centre, a quarter from there to the white one, the border.
INSIDE = ((0.25, 0.5), (0.375, 0.5), (0.5625, 0.5))
LINEAR, NEAREST = (0, 0.25, 0.625), (0, 0, 1)


@suite.case
def magnification():
    "magnificationFilter"
    kinds = (("without properties", "", LINEAR), ("its default is FASTEST", "borderWidth 0", NEAREST)) + tuple(
        (word, f'magnificationFilter "{word}"', colors) for word, colors in (
            ("AVG_PIXEL", LINEAR), ("DEFAULT", LINEAR), ("FASTEST", NEAREST),
            ("NEAREST_PIXEL", NEAREST), ("NICEST", LINEAR), ("LINEAR", LINEAR)))
    check_strips(suite, [(name, step(properties), LOD, INSIDE, colors)
                         for name, properties, colors in kinds])


@suite.case
def minification():
    "minificationFilter: between texels and between mipmaps"
    # four texels 0 0 1 1, then 0 1, then a half; at level 0.75 and an eighth from the left
    texture = 'PixelTexture {{ image 4 1 1 0 0 0xff 0xff textureProperties TextureProperties {{ minificationFilter "{}" }} }}'
    where = ((0.4375, 0.5, 0.25), (0.4375, 0.5, 0.75), (0.4375, 0.5, 1.25))
    # level 0 at 0.4375: texel 1.25, linear 0.25, nearest 0; level 1: 0.375, linear 0.375,
    # nearest 0; level 2: 0.5
    kinds = (
        ("AVG_PIXEL", (0.25, 0.25, 0.25)),
        ("NEAREST_PIXEL", (0, 0, 0)),
        ("FASTEST", (0, 0, 0)),
        ("AVG_PIXEL_AVG_MIPMAP", (0.28125, 0.34375, 0.40625)),
        ("NICEST", (0.28125, 0.34375, 0.40625)),
        ("DEFAULT", (0.28125, 0.34375, 0.40625)),
        ("AVG_PIXEL_NEAREST_MIPMAP", (0.25, 0.375, 0.375)),
        ("NEAREST_PIXEL_AVG_MIPMAP", (0, 0, 0.125)),
        ("NEAREST_PIXEL_NEAREST_MIPMAP", (0, 0, 0)),
        ("LINEAR_MIPMAP_LINEAR", (0.28125, 0.34375, 0.40625)),
    )
    strips = [(word, texture.format(word), LOD, where, colors) for word, colors in kinds]
    strips.append(("without properties", "PixelTexture { image 4 1 1 0 0 0xff 0xff }", LOD, where,
                   (0.28125, 0.34375, 0.40625)))
    check_strips(suite, strips, tolerance=2e-3)


@suite.case
def boundaries():
    "repeatS and repeatT, boundaryModeS and boundaryModeT, borderColor"
    # beyond the left edge; beyond the right edge
    where = ((-0.25, 0.5), (1.25, 0.5), (-0.125, 0.5))
    repeat, clamp, mirror = (1, 0, 0.75), (0, 1, 0), (0, 1, 0)
    mode = 'magnificationFilter "LINEAR" boundaryModeS "{}"'.format
    twice = ((-0.75, 0.5), (1.75, 0.5))
    check_strips(suite, [
        ("repeated", step(), LOD, where, repeat),
        ("not repeated", step(fields="repeatS FALSE"), LOD, where, clamp),
        ("repeatT is another axis", step(fields="repeatT FALSE"), LOD, where, repeat),
        ("REPEAT wins over repeatS", step(mode("REPEAT"), "repeatS FALSE"), LOD, where, repeat),
        ("without a mode repeatS holds", step('magnificationFilter "LINEAR"', "repeatS FALSE"), LOD,
         where, clamp),
        ("CLAMP", step(mode("CLAMP")), LOD, where, clamp),
        ("CLAMP_TO_EDGE", step(mode("CLAMP_TO_EDGE")), LOD, where, clamp),
        ("MIRRORED_REPEAT", step(mode("MIRRORED_REPEAT")), LOD, where, mirror),
        ("MIRRORED_REPEAT, farther", step(mode("MIRRORED_REPEAT")), LOD, twice, (1, 0)),
        ("CLAMP_TO_BOUNDARY", step(mode("CLAMP_TO_BOUNDARY") + " borderColor .2 .4 .6 1"), LOD,
         ((-0.25, 0.5), (0, 0.5)), [(0.2, 0.2, 0.2), (0.1, 0.1, 0.1)]),
        ("borders of RGB", 'PixelTexture { image 1 1 3 0xff00ff textureProperties TextureProperties { '
         'boundaryModeT "CLAMP_TO_BOUNDARY" borderColor .2 .4 .6 1 } }', LOD,
         ((0.5, 2), (0.5, 0.5)), [(.2, .4, .6), (1, 0, 1)]),
        ("the third axis", 'PixelTexture3D { image [1 1 1 2 0 0xff] textureProperties '
         'TextureProperties { boundaryModeR "MIRRORED_REPEAT" } }', "textureLod(tex, at.xyz, 0.0)",
         ((.5, .5, -.25), (.5, .5, 1.25), (.5, .5, 1.75)), (0, 1, 0), "sampler3D"),
        ("repeatR is FALSE", "PixelTexture3D { image [1 1 1 2 0 0xff] }", "textureLod(tex, at.xyz, 0.0)",
         ((.5, .5, -.25), (.5, .5, 1.25)), (0, 1), "sampler3D"),
    ])
    bad = check_strips(suite, [("a word that is none", step(mode("AROUND")), LOD, where, repeat)])
    suite.equal("is reported", [m[3:] for m in bad.messages()],
                [("warning", "'AROUND' is no boundaryModeS; REPEAT is taken", "bad-value")])


@suite.case
def anisotropy():
    "anisotropicDegree blurs less of what is minified along one axis"
    # sixteen texels black and white in turn along s; stretched sixteen times along t
    texels = " ".join("0x000000" if x % 2 else "0xffffff" for x in range(16))
    text = "PixelTexture {{ image 16 1 3 {} textureProperties TextureProperties {{ {} }} }}"
    words = 'minificationFilter "NICEST" magnificationFilter "NEAREST_PIXEL"'
    isotropic, anisotropic = text.format(texels, words), text.format(texels, words + " anisotropicDegree 16")
    expression = "textureGrad(tex, vec2(0.53125, 0.5), vec2(1.0 / 64.0, 0.0), vec2(0.0, 16.0))"
    view = "OrthoViewpoint { position 0 0 10 fieldOfView 0 0 2 1 }\n"
    shapes = "".join(f"Transform {{ translation {x}.5 .5 0 children [ {strip(t, expression, [(0,)])} ] }}\n"
                     for x, t in enumerate((isotropic, anisotropic)))
    plain, better = suite.probe(scene(view, NO_HEADLIGHT, shapes), [(0, 0), (1, 0)], size="2x1")
    if plain[0] == better[0]:
        suite.skip("anisotropy", "this GL has none")
        return
    suite.check("farther from grey", abs(better[0] - 0.5) > abs(plain[0] - 0.5) + 0.1, plain, better)


@suite.case
def surfaces():
    "textures of surfaces are mipmapped where they are small"
    texels = " ".join("0xffffff" if (x + y) % 2 else "0" for y in range(64) for x in range(64))
    texture = f"texture PixelTexture {{ image 64 64 3 {texels} }}"
    pixels = suite.probe(front_scene(quad("UnlitMaterial { }", appearance=texture)),
                         [(6, 6), (8, 9), (10, 7)])
    for got in pixels:
        suite.close("grey from afar", got, (0.5, 0.5, 0.5, 1), 0.02)


@suite.case
def in_volumes():
    "what effects of volumes read has no mipmaps: a ray has no derivatives"
    texels = " ".join("0xff" if x < 4 else "0" for x in range(64))
    code = ("uniform sampler2D tex;\nvoid PLUG_volume_classify(inout vec4 color, const in VolumeSample s)"
            "{ if (s.position.x > 0.25) { float u = int(gl_FragCoord.x) % 2 == 0 ? 0.03 : 0.97;"
            "color = vec4(texture(tex, vec2(u, 0.5)).rrr, 1.0); } }")
    text = front_scene(volume(constant(255), effects=effect(
        code, f"initializeOnly SFNode tex PixelTexture {{ image 64 1 1 {texels} }}")))
    suite.close("level 0", suite.probe(text, [(10, 8)])[0], (1, 1, 1, 1))


# ---- files


@suite.case
def urls():
    "the first url that loads and is understood"
    files = {"good.png": png(1, 1, 3, [51, 102, 153]), "bad.png": b"\x89PNG\r\n\x1a\nrubbish",
             "data/in.png": png(1, 1, 3, [255, 0, 51])}

    def texture(*names, fields=""):
        return f"ImageTexture {{ url [ {' '.join(f'{chr(34)}{n}{chr(34)}' for n in names)} ] {fields} }}"

    good = (0.2, 0.4, 0.6)
    result = check_strips(suite, [
        ("missing, then good", texture("none.png", "good.png"), LOD, [(.5, .5)], [good]),
        ("broken, then good", texture("bad.png", "good.png"), LOD, [(.5, .5)], [good]),
        ("load FALSE: white", texture("none.png", fields="load FALSE"), LOD, [(.5, .5)], [1]),
        ("castle-data:/", texture("castle-data:/in.png"), LOD, [(.5, .5)], [(1, 0, .2)]),
        ("castle-data:, three dimensions", 'ImageTexture3D { url [ "bad.png" "castle-data:/in.png" ] }',
         "textureLod(tex, at.xyz, 0.0)", [(.5, .5, .5)], [(1, 0, .2)], "sampler3D"),
    ], files)
    suite.equal("broken files are warnings", sorted({(m[3], m[5]) for m in result.messages()}),
                [("warning", "bad-image")])
    result = check_strips(suite, [
        ("missing, then broken: white", texture("none.png", "bad.png"), LOD, [(.5, .5)], [1]),
        ("outside the data folder: white", texture("castle-data:/../../x.png"), LOD, [(.5, .5)], [1]),
    ], files, status=1)
    suite.equal("errors", [(m[3], m[5]) for m in result.messages()],
                [("error", "bad-image"), ("error", "not-allowed")])


@suite.case
def data_folders():
    "castle-data:/ is the folder data beside the scene, or the one that the scene lies in"
    text = scene(FRONT, NO_HEADLIGHT, quad(appearance='texture ImageTexture { url "castle-data:/a/b.png" }'))
    picture = png(1, 1, 3, [51, 102, 153])
    folder = suite.new_folder()
    for where, allowed in (("", []), ("data/x/", ["--allow", "data"])):
        done = suite.command("render", f"{where}s.x3dv", "--size", "16x16", "--no-cache", *allowed,
                             "--probe", "8,8", folder=folder,
                             files={f"{where}s.x3dv": text, "data/a/b.png": picture})
        suite.close(f"scene {where}s.x3dv", read_probes(done, 1)[0], (0.2, 0.4, 0.6, 1))
    done = suite.command("render", "data/x/s.x3dv", "--size", "16x16", "--no-cache", "--probe", "8,8",
                         folder=folder, status=1)
    suite.equal("only where it is allowed", [m[5] for m in done.messages()], ["not-allowed"])
    os.remove(os.path.join(folder, "data/a/b.png"))
    done = suite.command("render", "s.x3dv", "--size", "16x16", "--no-cache", "--probe", "8,8",
                         folder=folder, status=1)
    suite.equal("the message names the file", [m[4] for m in done.messages()],
                ["'data/a/b.png' does not exist"])


def avi(frames, width, height, codec=b"\0\0\0\0", bits=24):
    """A RIFF AVI of one video stream."""

    def chunk(name, data):
        return name + struct.pack("<I", len(data)) + data + b"\0" * (len(data) % 2)

    size = max(map(len, frames))
    head = chunk(b"avih", struct.pack("<14I", 40000, 0, 0, 0, len(frames), 0, 1, size, width, height, 0, 0, 0, 0))
    stream = chunk(b"strh", b"vids" + codec + struct.pack("<IHHIIIIIIiI4h", 0, 0, 0, 0, 1, 25, 0, len(frames),
                                                          size, -1, 0, 0, 0, width, height))
    stream += chunk(b"strf", struct.pack("<IiiHH4sIiiII", 40, width, height, 1, bits, codec, size, 0, 0, 0, 0))
    lists = chunk(b"LIST", b"hdrl" + head + chunk(b"LIST", b"strl" + stream))
    lists += chunk(b"LIST", b"movi" + b"".join(chunk(b"00dc" if codec[0] else b"00db", f) for f in frames))
    return chunk(b"RIFF", b"AVI " + lists)


@suite.case
def movies():
    "MovieTexture: the first frame of a GIF, of a video, of a row of pictures"
    def frame(*rows):  # bottom row first, BGR, rows of four bytes
        return b"".join(bytes(v for p in row for v in p[::-1]) + b"\0" * (-3 * len(row) % 4) for row in rows)

    one = frame([(51, 102, 153), (255, 0, 0)], [(0, 255, 0), (0, 0, 255)])
    two = frame([(0, 0, 0)] * 2, [(0, 0, 0)] * 2)
    files = {
        "raw.avi": avi([one, two], 2, 2),
        "row01.png": png(1, 1, 3, [51, 102, 153]), "row02.png": png(1, 1, 3, [0, 0, 0]),
        "old0.bmp": bmp([[(255, 0, 51)]]), "old1.bmp": bmp([[(0, 0, 0)]]),
        "cut.avi": avi([one], 2, 2)[:150],
    }
    where, colors = [(.25, .25), (.75, .25), (.25, .75), (.75, .75)], [
        (.2, .4, .6), (1, 0, 0), (0, 1, 0), (0, 0, 1)]
    strips = [
        ("pictures, counted from 1", 'MovieTexture { url "row@counter(2).png" }', LOD, [(.5, .5)], [(.2, .4, .6)]),
        ("pictures, counted from 0", 'MovieTexture { url "old%d.bmp" }', LOD, [(.5, .5)], [(1, 0, .2)]),
    ]
    check_strips(suite, strips, files)
    video = front_scene(quad(appearance='texture MovieTexture { url "raw.avi" }'))
    result = suite.render(video, "--probe", "8,8", files=files, status=None)
    if "built without" in result.errors:
        suite.skip("videos", "built without FFmpeg's libraries")
        return
    check_strips(suite, [("video", 'MovieTexture { url "raw.avi" }', LOD, where, colors)], files)
    cut = check_strips(suite, [("a damaged video: white", 'MovieTexture { url "cut.avi" }', LOD, where, [1] * 4)],
                       files, status=1)
    suite.equal("and one error, nothing else", [m[5] for m in cut.messages()], ["bad-image"])
    suite.check("no line of another library", all(
        line.startswith((" ", "scene.x3dv:")) for line in cut.errors.splitlines()), cut.errors)


@suite.case
def large():
    "a texture that GL cannot hold is made smaller, with a warning"
    size = 32768
    row = b"\x00" * (size // 2) + b"\xff" * (size // 2)
    files = {"wide.dds": dds(size, 1, row, flags=0x20000, bits=8, masks=(255, 0, 0, 0))}
    result = check_strips(suite, [("still there", 'ImageTexture { url "wide.dds" }', LOD,
                                   [(0.25, .5), (0.499, .5), (0.501, .5), (0.75, .5)], [0, 0, 1, 1])], files)
    codes = [m[3:6:2] for m in result.messages()]
    suite.check("a warning where the limit is lower", codes in ([], [("warning", "limit")]), codes)


# ---- uniforms


@suite.case
def kinds():
    "a texture of another kind than its sampler is an error at the field; the effect is left out"
    cube = "GeneratedCubeMapTexture { }"
    wrong = (
        ("sampler2D", "PixelTexture3D { image [1 1 1 1 255] }", "a texture for sampler3D, its uniform is sampler2D"),
        ("sampler3D", "PixelTexture { image 1 1 1 255 }", "a texture for sampler2D, its uniform is sampler3D"),
        ("samplerCube", "PixelTexture { image 1 1 1 255 }", "a texture for sampler2D, its uniform is samplerCube"),
        ("sampler2D", cube, "a texture for samplerCube, its uniform is sampler2D"),
        ("sampler2DShadow", "PixelTexture { image 1 1 1 255 }",
         "a texture for sampler2D, its uniform is sampler2DShadow"),
        ("sampler2D", "GeneratedShadowMap { }", "a texture for sampler2DShadow, its uniform is sampler2D"),
        ("sampler2D", "ShaderTexture { }", "ShaderTexture, which no sampler can read"),
    )
    read = {"sampler2DShadow": "vec4(texture(tex, vec3(0.5)))", "sampler2D": "texture(tex, vec2(0.5))"}
    for sampler, texture, message in wrong:
        code = (f"uniform {sampler} tex;\nvoid PLUG_fragment_modify(inout vec4 color)"
                f"{{ color = {read.get(sampler, 'texture(tex, vec3(0.5))')}; }}")
        result = suite.render(front_scene(quad(
            "UnlitMaterial { emissiveColor .2 .4 .6 }",
            effect(code, f"\ninitializeOnly SFNode tex {texture}"))), "--probe", "8,8", status=1)
        suite.equal(f"{sampler}", [(m[1], m[3], m[4], m[5]) for m in result.messages() if m[3] == "error"],
                    [(6, "error", f"the field 'tex' holds {message}", "uniform-type")])
        suite.close("drawn without it", read_probes(result, 1)[0], (0.2, 0.4, 0.6, 1))


@suite.case
def arrays():
    "arrays of samplers; samplers of many kinds side by side; one without a texture is black"
    code = """uniform sampler2D many[3];
uniform samplerCube cube; uniform sampler3D solid; uniform sampler2D nothing;
void PLUG_fragment_modify(inout vec4 color) {
  float sum = texture(many[0], vec2(0.5)).r + 2.0 * texture(many[1], vec2(0.5)).r + 4.0 * texture(many[2], vec2(0.5)).r;
  color = vec4(sum / 8.0, texture(cube, vec3(0.0, 1.0, 0.0)).r + texture(nothing, vec2(0.5)).r,
               texture(solid, vec3(0.5)).r, 1.0); }"""
    grey = "PixelTexture {{ image 1 1 1 {} }}".format
    faces = " ".join(f"{face}Texture {grey(51 * i)}" for i, face in enumerate(
        ("back", "bottom", "front", "left", "right", "top")))
    fields = f"""initializeOnly MFNode many [ {grey(255)} ImageTexture {{ url "a.png" }} {grey(0)} ]
initializeOnly SFNode cube ComposedCubeMapTexture {{ {faces} }}
initializeOnly SFNode solid PixelTexture3D {{ image [1 1 1 1 102] }}
initializeOnly SFNode nothing NULL"""
    result = suite.probe(front_scene(quad("UnlitMaterial { }", effect(code, fields))), [(8, 8)],
                         files={"a.png": png(1, 1, 1, [255])})
    suite.close("", result[0], (3 / 8, 1, 0.4, 1))


suite.run()
