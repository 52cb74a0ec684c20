#!/usr/bin/env python3
"""Volumes among opaque and translucent surfaces; backgrounds and alpha."""

import math
import os

from files import read_png
from harness import Suite, box_interval, opacity, over, premultiplied
from scenes import constant, front_scene, quad, scene, volume

suite = Suite()

FOG = volume(constant(51, (4, 4, 4)))  # grey 0.2, reference 1/4, z from -1/2 to 1/2


def fog(length):
    return premultiplied((0.2,) * 3, opacity(0.2, length, 0.25))


def plane(z, material="UnlitMaterial { emissiveColor 1 .5 0 }"):
    return f"Transform {{ translation 0 0 {z} children [ {quad(material)} ] }}\n"


ORANGE = (1, 0.5, 0, 1)


@suite.case
def opaque_plane():
    "an opaque plane before, in and behind a volume, declared before and after"
    for z, length in ((2, 0), (0.5, 0), (0.25, 0.25), (-0.1, 0.6), (-0.45, 0.95), (-0.7, 1)):
        for order in ((FOG, plane(z)), (plane(z), FOG)):
            got = suite.middle(front_scene(*order))
            name = f"plane at {z}, {'after' if order[0] == FOG else 'before'}"
            suite.close(name, got, over(fog(length), ORANGE))


@suite.case
def plane_in_perspective():
    "the same along perspective rays"
    text = scene("Viewpoint { position 0 0 2 }\n", FOG, plane(0.1))
    half = math.tan(math.pi / 8)
    for x, y in ((8, 8), (4, 10), (12, 6)):
        v = ((x + 0.5) / 8.5 - 1, 1 - (y + 0.5) / 8.5)
        ray = (v[0] * half, v[1] * half, -1.0)
        enter, _ = box_interval((0, 0, 2), ray)
        length = math.sqrt(sum(c * c for c in ray)) * (1.9 - enter)
        got = suite.probe(text, [(x, y)], size="17x17")[0]
        suite.close(f"pixel {x},{y}", got, over(fog(length), ORANGE))


@suite.case
def depth_precision():
    "a far away surface does not spoil the depth of a near one"
    far_plane = "Transform { scale 100000 100000 1 children [ " + plane(-90000) + " ] }\n"
    text = scene("Viewpoint { position 0 0 2 }\n", FOG, plane(0.1), far_plane)
    got = suite.middle(text)
    suite.close("", got, over(fog(0.4), ORANGE), 2e-3)


@suite.case
def solid_inside():
    "a box inside the volume"
    box = ("Shape { appearance Appearance { material UnlitMaterial { emissiveColor 0 1 0 } } "
           "geometry Box { size .4 .4 .4 } }\n")
    got = suite.middle(front_scene(FOG, box))
    suite.close("", got, over(fog(0.3), (0, 1, 0, 1)))
    beside = suite.probe(front_scene(FOG, box), [(5, 8)])[0]
    suite.close("beside the box", beside, fog(1))


@suite.case
def nearer_surface_wins():
    "surfaces hide each other in any order"
    red = "UnlitMaterial { emissiveColor 1 0 0 }"
    for order in ((plane(0, red), plane(-0.2)), (plane(-0.2), plane(0, red))):
        suite.close("", suite.middle(front_scene(*order)), (1, 0, 0, 1))


@suite.case
def translucent_surface():
    "a translucent surface before and behind a volume"
    glass = "UnlitMaterial { emissiveColor 0 0 1 transparency .25 }"
    blue = premultiplied((0, 0, 1), 0.75)
    for order in (0, 1):
        parts = [FOG, plane(1, glass)]
        got = suite.middle(front_scene(*(parts[::-1] if order else parts)))
        suite.close(f"before the volume, order {order}", got, over(blue, fog(1)))
        parts = [FOG, plane(-1, glass)]
        got = suite.middle(front_scene(*(parts[::-1] if order else parts)))
        suite.close(f"behind the volume, order {order}", got, over(fog(1), blue))
    got = suite.middle(front_scene(plane(-1), plane(0, glass)))
    suite.close("over an opaque surface", got, over(blue, ORANGE))


@suite.case
def background():
    "without a Background transparent black; a Background covers by its transparency"
    suite.close("none", suite.middle(front_scene()), (0, 0, 0, 0), 0)
    sky = "Background { skyColor .2 .4 .6 }\n"
    suite.close("sky", suite.middle(front_scene(sky)), (0.2, 0.4, 0.6, 1), 1e-6)
    suite.close("volume over sky", suite.middle(front_scene(sky, FOG)),
                over(fog(1), (0.2, 0.4, 0.6, 1)))
    half = "Background { skyColor .2 .4 .6 transparency .5 }\n"
    suite.close("half", suite.middle(front_scene(half)), (0.1, 0.2, 0.3, 0.5), 1e-6)
    suite.close("volume over half", suite.middle(front_scene(half, FOG)),
                over(fog(1), (0.1, 0.2, 0.3, 0.5)))


def opened(result, name):
    return read_png(os.path.join(result.folder, name))


@suite.case
def png_files():
    "a PNG is opaque over black, or straight with --transparent; premultiplied else"
    half = "Background { skyColor 1 .4 0 transparency .5 }\n"
    result = suite.render(front_scene(half), "-o", "a.png", size="3x2")
    width, height, components, data = opened(result, "a.png")
    suite.equal("size", (width, height), (3, 2))
    suite.close("over black", data[:3], (128, 51, 0), 1)
    suite.check("opaque", components in (1, 3) or set(data[3::4]) == {255}, data[:8])
    result = suite.render(front_scene(half), "-o", "b.png", "--transparent", size="3x2")
    _, _, components, data = opened(result, "b.png")
    suite.equal("four components", components, 4)
    suite.close("straight", data[:4], (255, 102, 0, 128), 1)
    # colours are not limited inside; a PNG clamps
    bright = front_scene("Transform { scale 3 3 3 children [\n",
                         quad("UnlitMaterial { emissiveColor 1 1 1 }", effect_double()), "] }\n")
    suite.close("2 stays 2 in floats", suite.middle(bright), (2, 1, 0.5, 1), 1e-6)
    data = opened(suite.render(bright, "-o", "c.png", size="3x2"), "c.png")[3]
    suite.close("clamped", data[:3], (255, 255, 128), 1)


def effect_double():
    return ('Effect { parts EffectPart { type "FRAGMENT" url "data:text/plain,\n'
            "void PLUG_fragment_modify(inout vec4 color) { color.rgb = vec3(2.0, 1.0, 0.5); }\n"
            '" } }')


@suite.case
def rows_and_columns():
    "the first row of a picture is the top one; probes count from the top left"
    text = scene("OrthoViewpoint { position 0 0 10 fieldOfView -1 -1 1 1 }\n",
                 "Transform { translation -.5 .5 0 children [ ",
                 quad("UnlitMaterial { emissiveColor 1 0 0 }"), " ] }\n",
                 "Transform { translation .5 -.5 0 children [ ",
                 quad("UnlitMaterial { emissiveColor 0 0 1 }"), " ] }\n")
    picture = suite.picture(text, size="4x4")
    suite.close("top left", picture.at(0, 0), (1, 0, 0, 1))
    suite.close("bottom right", picture.at(3, 3), (0, 0, 1, 1))
    suite.close("top right", picture.at(3, 0), (0, 0, 0, 0))
    probes = suite.probe(text, [(0, 0), (3, 3), (0, 3)], size="4x4")
    suite.close("probes", sum(probes, ()), (1, 0, 0, 1, 0, 0, 1, 1, 0, 0, 0, 0))
    data = opened(suite.render(text, "-o", "p.png", size="4x4"), "p.png")
    suite.close("PNG", data[3][: 3], (255, 0, 0), 0)


@suite.case
def translucent_order():
    "translucent surfaces are drawn from far to near, in any order of the file"
    def glass(z, color):
        return plane(z, f"UnlitMaterial {{ emissiveColor {color} transparency .5 }}")

    panes = [glass(1, "1 0 0"), glass(0, "0 1 0"), glass(-1, "0 0 1")]
    expected = over(over((0.5, 0, 0, 0.5), (0, 0.5, 0, 0.5)), (0, 0, 0.5, 0.5))
    for order in ((0, 1, 2), (2, 1, 0), (1, 2, 0)):
        suite.close(f"{order}", suite.middle(front_scene(*(panes[i] for i in order))), expected)


@suite.case
def textured_alpha():
    "a texture with alpha blends, one without does not"
    behind = plane(-1)
    for components, word, expected in ((4, "0xFF000080", over(premultiplied((1, 0, 0), 128 / 255), ORANGE)),
                                       (2, "0x8040", over(premultiplied((128 / 255,) * 3, 64 / 255), ORANGE)),
                                       (3, "0xFF0080", (1, 0, 128 / 255, 1)),
                                       (1, "0x80", (128 / 255,) * 3 + (1,)),
                                       (4, "0x00FF00FF", (0, 1, 0, 1))):
        texture = f"texture PixelTexture {{ image 1 1 {components} {word} }}"
        got = suite.middle(front_scene(behind, quad("UnlitMaterial { }", appearance=texture)))
        suite.close(f"{components} components, {word}", got, expected)


@suite.case
def colours_at_vertices():
    "Color and ColorRGBA of a face set"
    geometry = ("IndexedFaceSet { coordIndex [0 1 2 3 -1] coord Coordinate { point "
                "[-.5 -.5 0, .5 -.5 0, .5 .5 0, -.5 .5 0] } color %s }")
    for node, expected in (("Color { color [0 0 0, 1 0 0, 1 1 0, 0 1 0] }", (0.375, 0.625, 0, 1)),
                           ("ColorRGBA { color [0 0 0 1, 1 0 0 1, 1 1 0 1, 0 1 0 1] }", (0.375, 0.625, 0, 1))):
        text = scene("OrthoViewpoint { position 0 0 10 fieldOfView -.5 -.5 .5 .5 }\n",
                     quad("UnlitMaterial { }", geometry=geometry % node))
        got = suite.probe(text, [(1, 1)], size="4x4")[0]
        suite.close(node, got, expected)


@suite.case
def switches():
    "Switch, LOD, visible FALSE"
    red, green = (quad(f"UnlitMaterial {{ emissiveColor {c} }}") for c in ("1 0 0", "0 1 0"))
    for name, text, expected in (
        ("choice 1", f"Switch {{ whichChoice 1 children [ {red} {green} ] }}\n", (0, 1, 0, 1)),
        ("no choice", f"Switch {{ children [ {red} {green} ] }}\n", (0, 0, 0, 0)),
        ("LOD", f"LOD {{ children [ {green} {red} ] }}\n", (0, 1, 0, 1)),
        ("visible FALSE", f"Group {{ visible FALSE children [ {red} ] }}\n", (0, 0, 0, 0)),
    ):
        suite.close(name, suite.middle(front_scene(text)), expected)


suite.run()
