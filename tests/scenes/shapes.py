#!/usr/bin/env python3
"""What geometry nodes look like: normals, texture coordinates, outlines."""

import math

from harness import Suite
from scenes import Row, effect, effect_parts, front_scene, quad, scene

suite = Suite()

# Shows the normal, from -1 to 1 as 0 to 1.
SHOW_NORMAL = effect("void PLUG_fog_apply(inout vec4 color, const in vec3 normal)"
                     " { color = vec4(normal * 0.5 + 0.5, 1.0); }")

def shown(geometry, show=SHOW_NORMAL, place=""):
    """A shape around the middle of a cell of side 1."""
    shape = (f"Shape {{ appearance Appearance {{ material Material {{ }} effects [ {show} ] }} "
             f"geometry {geometry} }}\n")
    return f"Transform {{ {place} children [ {shape} ] }}\n"


def as_color(normal):
    return tuple(n * 0.5 + 0.5 for n in normal) + (1,)


@suite.case
def normals_of_shapes():
    "normals at a pixel of each shape"
    x = y = -0.125  # the pixel's middle (1, 1 of 4, from above): -1/8, 1/8 in its cell
    y = 0.125
    small = "scale .4 .4 .4"
    u, v = x / 0.4, y / 0.4
    row = Row(suite)
    expected = []

    def add(name, text, normal):
        row.add(text)
        expected.append((name, as_color(normal)))

    add("Sphere", shown("Sphere { slices 200 stacks 100 }", place=small),
        (u, v, math.sqrt(1 - u * u - v * v)))
    add("Cylinder", shown("Cylinder { slices 400 }", place=small), (u, 0, math.sqrt(1 - u * u)))
    add("Box", shown("Box { divisions 3 }", place=small), (0, 0, 1))
    add("Box from inside", shown("Box { ccw FALSE }", place=small), (0, 0, 1))
    add("Plane", shown("Plane { }", place=small), (0, 0, 1))
    add("Disk2D", shown("Disk2D { }", place=small), (0, 0, 1))
    add("Disk2D from behind", shown("Disk2D { }", place=small + " rotation 0 1 0 3.14159265"),
        (0, 0, 1))
    add("ArcClose2D", shown("ArcClose2D { endAngle 0 }", place=small), (0, 0, 1))
    add("TriangleSet2D", shown("TriangleSet2D { vertices [ -1 -1, 1.2 -1, -1 1.2 ] }", place=small),
        (0, 0, 1))
    # seen from above; the knob of the lid is level in its middle
    top = "rotation 1 0 0 1.57079633"
    add("Teapot", "Transform { translation -.0947 .125 0 scale .3 .3 .3 children " +
        shown("Teapot { }", place=top) + " }", (0, 0, 1))
    add("Extrusion", shown("Extrusion { }", place=small + " " + top), (0, 0, 1))
    add("ElevationGrid", shown("ElevationGrid { xDimension 2 zDimension 2 xSpacing 2 zSpacing 2 "
                               "height [ 0 2 0 2 ] }", place=top + " translation -1 1 0"),
        (-math.sqrt(0.5), 0, math.sqrt(0.5)))
    for (name, want), got in zip(expected, row.draw()):
        suite.close(name, got, want, 5e-3)


@suite.case
def letters():
    "a letter is where its outline is, and its holes are not"
    style = 'FontStyle { family "TYPEWRITER" style "BOLD" size 2 justify ["MIDDLE" "MIDDLE"] }'
    white = "UnlitMaterial { }"
    texts = [quad(white, geometry=f'Text {{ string "{text}" fontStyle {style} }}')
             for text in ("O", "-", "I")]
    view = "OrthoViewpoint { position 0 0 10 fieldOfView -1 -1 1 1 }\n"
    pictures = [suite.picture(scene(view, text), size="40x40") for text in texts]
    lit = [[p.at(x, y)[3] for x, y in ((20, 20), (20, 12), (20, 18), (12, 20))] for p in pictures]
    columns = [sum(p.at(20, y)[3] for y in range(40)) for p in pictures]
    suite.equal("the middle of O is empty", lit[0][0], 0)
    suite.check("O has a top and a bottom", 6 < columns[0] < 18, columns)
    suite.check("a dash is a short way through", 2 <= columns[1] < 8, columns)
    suite.check("I is a long one", columns[2] > 24, columns)


@suite.case
def lines():
    "lines and points of Geometry2D"
    white = "UnlitMaterial { }"
    for name, geometry in (("Polyline2D", "Polyline2D { lineSegments [ -.1 -1, -.1 1 ] }"),
                           ("Polypoint2D", "Polypoint2D { point [ -.1 .1 ] }"),
                           ("Circle2D", "Circle2D { radius .14142 }"),
                           ("Arc2D", "Arc2D { radius .14142 startAngle 2 endAngle 3 }")):
        picture = suite.picture(front_scene(quad(white, geometry=geometry)), size="10x10")
        suite.close(name, picture.at(4, 4), (1, 1, 1, 1))
        suite.close(name + " leaves the rest", picture.at(0, 5), (0, 0, 0, 0))


@suite.case
def texture_coordinates():
    "texture coordinates at a pixel of each shape, as effects and textures get them"
    show = effect_parts([
        ("VERTEX", "attribute vec4 castle_MultiTexCoord0; attribute vec4 castle_MultiTexCoord1;"
         "varying vec4 both; void PLUG_vertex_eye_space(const in vec4 eye, const in vec3 normal)"
         " { both = vec4(castle_MultiTexCoord0.st, castle_MultiTexCoord1.st); }"),
        ("FRAGMENT", "varying vec4 both; void PLUG_fog_apply(inout vec4 color, const in vec3 normal)"
         " { color = vec4(both.rgb, 1.0); }")])
    row = Row(suite)
    expected = []

    def add(name, geometry, want, place="scale .4 .4 .4"):
        row.add(shown(geometry, show, place))
        expected.append((name, want))

    s = 0.5 - 0.125 / 0.8  # of what is 0.8 wide around the middle
    t = 0.5 + 0.125 / 0.8
    add("Rectangle2D", "Rectangle2D { }", (s, t, s))
    add("Plane", "Plane { size 2 2 }", (s, t, s))
    add("Disk2D", "Disk2D { }", (s, t, s))
    add("Box", "Box { divisions 2 }", (s, t, s))
    add("a face set without any", "IndexedFaceSet { coordIndex [ 0 1 2 3 ] coord Coordinate { point "
        "[ -1 -.5 0, 1 -.5 0, 1 .5 0, -1 .5 0 ] } }", (s, (0.125 / 0.4 + 0.5) / 2, s))
    add("two units", "IndexedFaceSet { coordIndex [ 0 1 2 3 ] coord Coordinate { point [ -1 -1 0, 1 -1 "
        "0, 1 1 0, -1 1 0 ] } texCoord MultiTextureCoordinate { texCoord [ TextureCoordinate { point "
        "[ 0 0, 1 0, 1 1, 0 1 ] } TextureCoordinate { point [ 1 0, 0 0, 0 1, 1 1 ] } ] } }",
        (s, t, 1 - s))
    add("Extrusion seen from above", "Extrusion { }", (s, 1 - t, s),
        "scale .4 .4 .4 rotation 1 0 0 1.57079633")
    add("ElevationGrid", "ElevationGrid { xDimension 2 zDimension 2 height [ 0 0 0 0 ] }",
        (0.5 - 0.125, 0.5 - 0.125, 0.5 - 0.125), "rotation 1 0 0 1.57079633 translation -.5 .5 0")
    for (name, want), got in zip(expected, row.draw()):
        suite.close(name, got[:3], want, 1e-4)


suite.run()
