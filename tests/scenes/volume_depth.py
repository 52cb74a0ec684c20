#!/usr/bin/env python3
"""Surfaces in, before and behind volumes: what is between them is composed in the order of depth."""

import math
import os
import re

from harness import Suite, box_interval, opacity, over, premultiplied, unit
from scenes import FRONT, NO_HEADLIGHT, constant, effect, front_scene, quad, scene, volume, voxels

suite = Suite()

VALUE = 128
CUBE = volume(constant(VALUE))  # the reference length is 1
GREEN = premultiplied((0, 1, 0), 0.5)
BLUE = premultiplied((0, 0, 1), 0.25)
SHEET = "UnlitMaterial { emissiveColor 0 1 0 transparency .5 }"
VEIL = "UnlitMaterial { emissiveColor 0 0 1 transparency .75 }"
WALL = "UnlitMaterial { emissiveColor 1 0 0 }"


def matter(length, value=VALUE, reference=1):
    """A bare volume of this value, so long."""
    v = value / 255
    return premultiplied((v, v, v), opacity(v, length, reference))


def layers(*front_to_back):
    color = (0, 0, 0, 0)
    for layer in reversed(front_to_back):
        color = over(layer, color)
    return color


def two_sided(material, size=0.5):
    s = size
    points = f"{-s} {-s} 0, {s} {-s} 0, {s} {s} 0, {-s} {s} 0"
    return quad(material, geometry="IndexedFaceSet { solid FALSE coordIndex [0 1 2 3 -1] coord "
                f"Coordinate {{ point [{points}] }} }}")


def at(z, content, x=0):
    return f"Transform {{ translation {x} 0 {z} children [\n{content}] }}\n"


def from_behind(content):
    return f"Transform {{ rotation 0 1 0 {math.pi!r} children [\n{content}] }}\n"


@suite.case
def one_sheet():
    "a translucent square in a constant cube, seen from both sides, for any step"
    body = CUBE + at(0.1, two_sided(SHEET))
    front = layers(matter(0.4), GREEN, matter(0.6))
    back = layers(matter(0.6), GREEN, matter(0.4))
    for step in (None, 3, 0.07):
        arguments = ["--step", step] if step else []
        suite.close(f"step {step}", suite.middle(front_scene(body), *arguments), front)
    suite.close("from behind", suite.middle(front_scene(from_behind(body))), back)
    suite.close("declared before", suite.middle(front_scene(at(0.1, two_sided(SHEET)), CUBE)), front)
    suite.close("mirrored and stretched", suite.middle(
        front_scene(f"Transform {{ scale 1 1 -2 children [\n{body}] }}\n")), back)
    suite.close("on a wall in the cube", suite.middle(front_scene(body, at(-0.2, two_sided(WALL)))),
                layers(matter(0.4), GREEN, matter(0.3), (1, 0, 0, 1)))
    suite.close("behind a wall", suite.middle(front_scene(body, at(0.3, two_sided(WALL)))),
                layers(matter(0.2), (1, 0, 0, 1)))


@suite.case
def beside_a_sheet():
    "where the square is not, the volume is whole; the samples stay where they are"
    data = voxels(1, (4, 4, 4), (17 * i % 256 for i in range(64)))
    steps = ("--step", "0.5")
    alone = suite.picture(front_scene(volume(data)), *steps, size="24x24")
    clear = "UnlitMaterial { emissiveColor 0 1 0 transparency 1 }"
    both = suite.picture(front_scene(volume(data), at(0.15, two_sided(clear, 0.2))), *steps, size="24x24")
    def difference(inside):
        return max(abs(alone.at(x, y)[i] - both.at(x, y)[i]) for x in range(24) for y in range(24)
                   for i in range(4) if inside == (8 < x < 15 and 8 < y < 15))
    suite.check("beside", difference(False) < 2e-6, difference(False))
    suite.check("through what is clear", difference(True) < 4e-3, difference(True))


@suite.case
def two_sheets():
    "several squares, in any order in the file"
    near, far = at(0.25, two_sided(SHEET)), at(-0.25, two_sided(VEIL))
    expected = layers(matter(0.25), GREEN, matter(0.5), BLUE, matter(0.25))
    suite.close("near first", suite.middle(front_scene(near, CUBE, far)), expected)
    suite.close("far first", suite.middle(front_scene(far, near, CUBE)), expected)
    suite.close("from behind", suite.middle(front_scene(from_behind(CUBE + near + far))),
                layers(matter(0.25), BLUE, matter(0.5), GREEN, matter(0.25)))
    outside = at(1, two_sided(SHEET)) + at(-1, two_sided(VEIL))
    suite.close("before and behind the cube, too", suite.middle(front_scene(outside, CUBE, near, far)),
                layers(GREEN, expected, BLUE))


@suite.case
def closed_shapes():
    "of a translucent box the far faces are drawn first, and matter is between; none of a solid one"
    for solid, expected in (("FALSE", layers(matter(0.25), GREEN, matter(0.5), GREEN, matter(0.25))),
                            ("TRUE", layers(matter(0.25), GREEN, matter(0.75)))):
        box = quad(SHEET, geometry=f"Box {{ size .5 .5 .5 solid {solid} }}")
        suite.close(f"solid {solid}", suite.middle(front_scene(CUBE, box)), expected)
        suite.close(f"solid {solid}, mirrored", suite.middle(
            front_scene(CUBE, f"Transform {{ scale -1 1 1 children [\n{box}] }}\n")), expected)


@suite.case
def shells():
    "one translucent shell in another, in any order in the file, with matter between"
    def box(size, material):
        return quad(material, geometry=f"Box {{ size {size} {size} {size} solid FALSE }}")
    expected = layers(matter(0.2), GREEN, matter(0.15), BLUE, matter(0.3), BLUE, matter(0.15), GREEN, matter(0.2))
    outer, inner = box(0.6, SHEET), box(0.3, VEIL)
    suite.close("the outer one first", suite.middle(front_scene(CUBE, outer, inner)), expected)
    suite.close("the inner one first", suite.middle(front_scene(inner, CUBE, outer)), expected)


@suite.case
def oblique():
    "a square that crosses the volume and sticks out of it is met where it is, at each pixel"
    tilted = f"Transform {{ rotation 0 1 0 {math.pi / 4!r} children [\n{two_sided(SHEET, 2)}] }}\n"
    pixels = [(4, 8), (6, 8), (8, 8), (10, 8)]  # of 16: x from -1 to 1
    got = suite.probe(front_scene(CUBE, tilted), pixels)
    for (column, _), color in zip(pixels, got):
        x = (column + 0.5) / 8 - 1
        suite.close(f"x = {x}", color, layers(matter(0.5 + x), GREEN, matter(0.5 - x)), 2e-4)


def ray(column, row, size, eye, angle=math.pi / 4):
    half = math.tan(angle / 2)
    return unit((((column + 0.5) / size * 2 - 1) * half, (1 - (row + 0.5) / size * 2) * half, -1))


@suite.case
def perspective():
    "lengths along oblique rays, with the eye outside and inside, with and without a near plane"
    body = CUBE + at(-0.1, two_sided(SHEET))
    for eye, fields, start in ((3, "", 0), (0.3, "", 0), (0.3, "nearDistance .15", 0.15),
                               (0.3, "nearDistance .15 farDistance .5", 0.15)):
        text = scene(f"Viewpoint {{ position 0 0 {eye} {fields} }}\n", NO_HEADLIGHT, body)
        pixels = [(15, 15), (12, 18)]
        for (column, row), got in zip(pixels, suite.probe(text, pixels, size="32x32")):
            d = ray(column, row, 32, eye)
            enter, leave = box_interval((0, 0, eye), d)
            enter = max(enter, start / -d[2])
            if "far" in fields:
                leave = min(leave, 0.5 / -d[2])
            meets = (eye + 0.1) / -d[2]
            suite.close(f"from {eye} {fields} {column}", got,
                        layers(matter(meets - enter), GREEN, matter(leave - meets)), 2e-4)


@suite.case
def parallel_inside():
    "parallel rays begin at the eye's plane, inside the volume and between two squares, too"
    for eye, content, expected in (
            (0.3, two_sided(SHEET), layers(matter(0.3), GREEN, matter(0.5))),
            (0.1, two_sided(SHEET) + at(0.3, two_sided(VEIL)), layers(matter(0.1), GREEN, matter(0.5)))):
        view = f"OrthoViewpoint {{ position 0 0 {eye} fieldOfView -1 -1 1 1 nearDistance .001 farDistance 9 }}\n"
        suite.close(f"from {eye}", suite.middle(scene(view, NO_HEADLIGHT, CUBE, content)), expected, 2e-3)


@suite.case
def opaque():
    "T14: an opaque square at half depth, declared before and after: the same, half the optical depth"
    wall = two_sided(WALL)
    expected = layers(matter(0.5), (1, 0, 0, 1))
    suite.close("before", suite.middle(front_scene(wall, CUBE)), expected)
    suite.close("after", suite.middle(front_scene(CUBE, wall)), expected)


OTHER = "Transform { scale 1 1 .5 children [ %s ] }\n" % volume(constant(51))


@suite.case
def several_volumes():
    "a square in two volumes that overlap, one of them stretched; in one of two that do not"
    far, near = math.log(127 / 255), math.log(204 / 255)
    def mixed(length, other):
        depths = (-far * length, -near * other * 2)
        whole = sum(depths)
        shade = (VALUE / 255 * depths[0] + 0.2 * depths[1]) / whole
        return premultiplied((shade,) * 3, 1 - math.exp(-whole))
    text = front_scene(CUBE, OTHER, at(0.05, two_sided(SHEET)))
    suite.close("overlapping", suite.middle(text),
                layers(matter(0.25), mixed(0.2, 0.2), GREEN, mixed(0.3, 0.3), matter(0.25)))
    text = front_scene(at(1, CUBE), at(-1, CUBE), at(-0.9, two_sided(SHEET)))
    suite.close("apart", suite.middle(text), layers(matter(1), matter(0.4), GREEN, matter(0.6)))


BEFORE = 'placement "ADD_BEFORE"'
LAYER = ("void PLUG_volume_composite(inout vec4 accumulated, inout vec4 color, const in VolumeSample s)"
         " { color.rgb = vec3(1.0, 0.5, 0.0); }")


@suite.case
def layers_apart():
    "volumes that are cast apart are divided, too"
    own = volume(constant(VALUE), effects=effect(LAYER, BEFORE))
    text = front_scene(at(1, own), at(-1, CUBE), at(-0.9, two_sided(VEIL)), at(0.9, two_sided(SHEET)))
    def orange(length):
        return premultiplied((1, 0.5, 0), opacity(VALUE / 255, length, 1))
    suite.close("", suite.middle(text), layers(
        orange(0.6), GREEN, orange(0.4), matter(0.4), BLUE, matter(0.6)))


@suite.case
def projections():
    "a projection is one layer where its intensity is found, before or behind the square"
    ramp = voxels(1, (1, 1, 4), (0, 100, 200, 100))  # slices from -z
    expected = {"MAX": (200, 0.125), "MIN": (0, -0.375), "AVERAGE": (None, 0.5)}
    for kind, (value, place) in expected.items():
        style = f'ProjectionVolumeStyle {{ type "{kind}" }}'
        for z in (0.3, -0.3):
            got = suite.middle(front_scene(volume(ramp, style), at(z, two_sided(SHEET))), "--step", 0.25)
            shade = got[0] if value is None else value / 255
            layer = premultiplied((shade,) * 3, 1)
            if value is None:
                suite.check(f"{kind}: something", 0.3 < shade < 0.5, shade)
            suite.close(f"{kind}, square at {z}", got,
                        layers(GREEN, layer) if z > place else layer, 2e-3)


@suite.case
def surfaces_of_value():
    "surfaces of equal value and the square are met in order"
    ramp = voxels(1, (1, 1, 2), (0, 255))  # 0 at z = -.25, 1 at z = .25
    style = "OpacityMapVolumeStyle { transferFunction PixelTexture { image 1 1 4 0xff000080 } }"
    iso = ("IsoSurfaceVolumeData { surfaceValues [ .3, .7 ] voxels %s renderStyle %s }\n" % (ramp, style))
    red = premultiplied((1, 0, 0), 128 / 255)
    for z, expected in ((0.2, (GREEN, red, red)), (0, (red, GREEN, red)), (-0.2, (red, red, GREEN))):
        suite.close(f"square at {z}", suite.middle(front_scene(iso, at(z, two_sided(SHEET)))),
                    layers(*expected))


@suite.case
def in_a_texture():
    "the same in a RenderedTexture"
    inner = ("Group { children [ %s %s ] }" % (CUBE, at(0.1, two_sided(SHEET))))
    eye = "viewpoint OrthoViewpoint { position 0 0 10 fieldOfView -.4 -.4 .4 .4 }"
    text = front_scene(quad("UnlitMaterial { emissiveColor 1 1 1 }", appearance=(
        f'texture RenderedTexture {{ update "ALWAYS" dimensions [ 8 8 4 ] {eye} scene {inner} '
        f"background Background {{ skyColor 0 0 0 }} }}")))
    expected = layers(matter(0.4), GREEN, matter(0.6), (0, 0, 0, 1))
    suite.close("", suite.middle(text)[:3], expected[:3], 3e-3)


@suite.case
def pays_for_use():
    "what is not inside divides nothing: its programs know nothing of parts"
    def fragment(body):
        folder = suite.command("dump", "a.x3dv", "-d", "d", files={"a.x3dv": front_scene(body)}).folder
        name = next(n for n in os.listdir(f"{folder}/d") if re.match(r"volume.*\.frag$", n))
        with open(f"{folder}/d/{name}", encoding="utf-8") as file:
            return file.read()
    for name, body, parts in (
            ("inside", at(0.1, two_sided(SHEET)), True), ("beside", at(0, two_sided(SHEET), 1.1), False),
            ("before", at(0.6, two_sided(SHEET)), False), ("opaque", at(0.1, two_sided(WALL)), False),
            ("by a corner's box alone", "Transform { translation .6 0 .6 rotation 0 1 0 .7854 "
             "children [ %s ] }" % two_sided(SHEET), False)):
        text = fragment(CUBE + body)
        suite.equal(name, "partStart" in text, parts)
        suite.check(f"{name}: no depth is written", "gl_FragDepth" not in text)


@suite.case
def moved():
    "a square that moves into the volume divides it, one that moves out does not"
    text = front_scene(
        CUBE, "DEF T Transform { children [ %s ] }\n" % two_sided(SHEET),
        "DEF C TimeSensor { cycleInterval 4 loop TRUE }\n"
        "DEF P PositionInterpolator { key [0, 1] keyValue [0 0 .9, 0 0 -3.1] }\n"
        "ROUTE C.fraction_changed TO P.set_fraction\nROUTE P.value_changed TO T.translation\n")
    result = suite.render(text, "-o", "p.npy", "--probe", "0,0", "--frames", 3, "--fps", 1.25, size="1x1")
    got = [[float(w) for w in line.split()] for line in result.output.splitlines()]
    for z, color, expected in zip((0.9, 0.1, -0.7), got, (
            layers(GREEN, matter(1)), layers(matter(0.4), GREEN, matter(0.6)), layers(matter(1), GREEN))):
        suite.close(f"z = {z}", color, expected)


@suite.case
def large_sheets():
    "a large square behind a volume stays behind, though its middle is nearer, and the other way round"
    tall = "Transform { translation 0 0 -1 scale 1 1 4 children [ %s ] }\n" % CUBE  # z from -3 to 1
    def slope(x, z):
        return (f"Transform {{ translation {x} 0 {z} rotation 0 1 0 {-math.pi / 4!r} children [ "
                f"{two_sided(SHEET, 4.5 * math.sqrt(2))} ] }}\n")
    views = {"parallel": FRONT, "perspective": "Viewpoint { position 0 0 10 }\n"}
    for name, view in views.items():
        for where, content, expected in (("behind", slope(4, 0.4), layers(matter(1), GREEN)),
                                         ("before", slope(-4, -2.4), layers(GREEN, matter(1)))):
            for parts in ((tall, content), (content, tall)):
                suite.close(f"{where}, {name}", suite.middle(scene(view, NO_HEADLIGHT, *parts)), expected)


@suite.case
def written_depths():
    "writeDepth: what is cast after a volume ends where its rays end, surfaces behind are hidden"
    def orange(length):
        return premultiplied((1, 0.5, 0), opacity(VALUE / 255, length, 1))
    tall = "Transform { translation 0 0 .5 scale 1 1 4 children [ %s ] }\n" % CUBE  # z from -1.5 to 2.5
    before, whole = matter(0.5), matter(1)  # up to z = .5
    def first(value, write):
        return volume(constant(value), fields=f"writeDepth {write}", effects=effect(LAYER, BEFORE))
    cases = (("as it is", VALUE, "FALSE", layers(whole, orange(1))),
             ("it ends where the rays leave", VALUE, "TRUE", layers(matter(0.75), orange(1))),
             ("where nothing more is seen", 255, "TRUE", layers(before, (1, 0.5, 0, 1))),
             ("nothing where there is no trace", 0, "TRUE", whole))
    for view in (FRONT, "Viewpoint { position 0 0 10 }\n",
                 "Viewpoint { position 0 0 10 nearDistance 1 farDistance 100 }\n"):
        for name, value, write, expected in cases:
            suite.close(f"{name}, {view.split(' ')[0]}", suite.middle(
                scene(view, NO_HEADLIGHT, tall, first(value, write)), "--step", 0.02), expected, 5e-3)
    inside = at(0, two_sided(VEIL))
    suite.close("around a square", suite.middle(front_scene(tall, first(VALUE, "TRUE"), inside)),
                layers(matter(0.625), orange(0.5), BLUE, matter(0.125), orange(0.5)), 1e-4)


suite.run()
