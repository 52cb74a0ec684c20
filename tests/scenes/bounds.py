#!/usr/bin/env python3
"""bboxDisplay: the edges of bounding boxes, given or found."""

import os

from harness import Picture, Suite
from scenes import constant, effect, front_scene, quad, volume

suite = Suite()

WHITE, NOTHING, RED = (1, 1, 1, 1), (0, 0, 0, 0), (1, 0, 0, 1)
EMPTY = constant(0, (2, 2, 2))
SQUARE = quad("UnlitMaterial { emissiveColor 1 0 0 }")


def at(x, y):
    """The pixel of 20 x 20 whose centre is at a place of the plane z = 0 between -1 and 1."""
    column, row = (x + 1) * 10 - 0.5, (1 - y) * 10 - 0.5
    assert abs(column - round(column)) + abs(row - round(row)) < 1e-6
    return round(column), round(row)


def look(name, content, expected, **options):
    """`expected`: colours by place."""
    pixels = suite.probe(front_scene(content), [at(*place) for place in expected], size="20x20", **options)
    for (place, color), got in zip(expected.items(), pixels):
        suite.close(f"{name}: at {place}", got, color, 1e-6)


def moved(content, fields):
    return f"Transform {{ {fields} children [\n{content}] }}\n"


# between a square of side 1 and what is around it lie no centres of pixels: it is moved by half a pixel
HALF = "translation 0.05 0.05 0"


@suite.case
def volumes():
    "the box of a volume: its dimensions, visible or not, or the box that is given"
    for visible in ("TRUE", "FALSE"):
        fields = f"bboxDisplay TRUE visible {visible}"
        look(f"visible {visible}", moved(volume(EMPTY, fields=fields), HALF),
             {(0.55, 0.05): WHITE, (-0.45, 0.05): WHITE, (0.05, 0.55): WHITE, (0.05, -0.45): WHITE,
              (0.45, 0.05): NOTHING, (0.65, 0.05): NOTHING})
    look("dimensions", moved(volume(EMPTY, fields="bboxDisplay TRUE", dimensions=(1.5, 0.5, 1)),
                             "translation 0.1 0.1 0"),
         {(0.85, 0.05): WHITE, (-0.65, 0.05): WHITE, (0.05, 0.35): WHITE, (0.05, -0.15): WHITE,
          (0.55, 0.05): NOTHING})
    look("given", volume(EMPTY, fields="bboxDisplay TRUE bboxSize 0.3 0.3 0.3 bboxCenter 0.2 0.2 0"),
         {(0.35, 0.25): WHITE, (0.05, 0.25): WHITE, (0.25, 0.25): NOTHING, (0.55, 0.05): NOTHING})
    look("not asked for", moved(volume(EMPTY), HALF), {(0.55, 0.05): NOTHING, (-0.45, 0.05): NOTHING})


@suite.case
def visible():
    "a volume that is not visible is not there, and comes and goes in time"
    opaque = constant(255, (2, 2, 2))
    for fields, expected in (("visible FALSE", NOTHING), ("visible TRUE", WHITE)):
        look(fields, volume(opaque, fields=fields), {(0.05, 0.05): expected})
    timed = "DEF V " + volume(opaque) + (
        "DEF T TimeSensor { loop TRUE cycleInterval 2 }\n"
        "DEF B BooleanSequencer { key [0 0.5] keyValue [TRUE FALSE] }\n"
        "ROUTE T.fraction_changed TO B.set_fraction ROUTE B.value_changed TO V.visible\n")
    for time, color in ((0.5, WHITE), (1.5, NOTHING)):
        got = suite.probe(front_scene(timed), [at(0.05, 0.05)], "--time", time, size="20x20")[0]
        suite.close(f"at {time}", got, color)


@suite.case
def ends_rays():
    "a box hides what is behind it, volumes included"
    opaque = constant(255, (2, 2, 2))
    look("in front", moved(volume(opaque, fields="bboxDisplay TRUE bboxSize 0.4 0.4 1.5"), HALF),
         {(0.25, 0.05): WHITE, (0.15, 0.15): WHITE, (0.45, 0.45): WHITE})
    red = volume(opaque, effects=effect(
        "void PLUG_volume_shade(inout vec4 color, const in VolumeSample s) { color = vec4(1.0, 0.0, 0.0, 1.0); }",
        'language "GLSL"'), fields="bboxDisplay TRUE bboxSize 0.4 0.4 0.4")
    look("inside", moved(red, HALF), {(0.25, 0.05): RED, (0.05, 0.05): RED})


@suite.case
def shapes_and_groups():
    "what is not given is found: of shapes, of groups, in the coordinates of what is inside"
    shape = SQUARE.replace("Shape {", "Shape { bboxDisplay TRUE")
    look("a shape", moved(shape, HALF), {(0.55, 0.05): WHITE, (-0.45, 0.05): WHITE, (0.05, 0.05): RED})
    hidden = SQUARE.replace("Shape {", "Shape { bboxDisplay TRUE visible FALSE")
    look("a hidden shape", moved(hidden, HALF), {(0.55, 0.05): WHITE, (0.05, 0.05): NOTHING})
    two = (moved(SQUARE, "translation -0.4 0 0 scale 0.1 0.1 1")
           + moved(SQUARE, "translation 0.4 0 0 scale 0.1 0.3 1"))
    look("a group of two", moved(f"Group {{ bboxDisplay TRUE children [ {two} ] }}", "translation 0 0 0"),
         {(0.05, 0.15): WHITE, (0.05, -0.15): WHITE, (0.05, 0.05): NOTHING, (0.35, 0.05): RED,
          (-0.45, 0.05): WHITE})
    # one eighth of a turn: the box turns with the group
    square = f"Transform {{ rotation 0 0 1 0.785398163 scale 0.9 0.9 1 bboxDisplay TRUE children {SQUARE} }}"
    look("turned", moved(square, HALF), {(0.65, 0.35): NOTHING, (0.35, 0.65): NOTHING, (0.05, 0.05): RED})
    given = f"Group {{ bboxDisplay TRUE visible FALSE bboxSize 1 1 0 children {SQUARE} }}"
    look("hidden, given", moved(given, HALF), {(0.55, 0.05): WHITE, (0.05, 0.05): NOTHING})
    hidden = f"Group {{ bboxDisplay TRUE visible FALSE children {SQUARE} }}"
    look("hidden, not given", moved(hidden, HALF), {(0.55, 0.05): NOTHING, (0.05, 0.05): NOTHING})
    nested = f"Group {{ bboxDisplay TRUE children Group {{ bboxDisplay TRUE children {SQUARE} }} }}"
    look("a box in a box", moved(nested, HALF), {(0.55, 0.05): WHITE, (0.65, 0.05): NOTHING})
    mixed = f"Group {{ bboxDisplay TRUE children [ {volume(EMPTY)} {SQUARE} ] }}"
    look("a volume among shapes", moved(mixed, HALF), {(0.55, 0.05): WHITE, (0.65, 0.05): NOTHING})
    octants = f"OctTree {{ bboxDisplay TRUE highRes {SQUARE} }}"
    look("an OctTree", moved(octants, HALF), {(0.55, 0.05): WHITE, (0.65, 0.05): NOTHING})
    look("nothing inside", "Group { bboxDisplay TRUE }", {(0.55, 0.05): NOTHING})


@suite.case
def plain():
    "effects of groups leave boxes alone, and a box may come and go in time"
    black = effect("void PLUG_fragment_modify(inout vec4 color) { color = vec4(0.0, 0.0, 0.0, 1.0); }", 'language "GLSL"')
    look("no effects", moved(black + volume(EMPTY, fields="bboxDisplay TRUE"), HALF), {(0.55, 0.05): WHITE})
    timed = moved("DEF V " + volume(EMPTY), HALF) + (
        "DEF T TimeSensor { loop TRUE cycleInterval 2 }\n"
        "DEF B BooleanSequencer { key [0 0.5] keyValue [FALSE TRUE] }\n"
        "ROUTE T.fraction_changed TO B.set_fraction ROUTE B.value_changed TO V.bboxDisplay\n")
    for time, color in ((0.5, NOTHING), (1.5, WHITE)):
        got = suite.probe(front_scene(timed), [at(0.55, 0.05)], "--time", time, size="20x20")[0]
        suite.close(f"at {time}", got, color)


@suite.case
def moving():
    "a box goes with what it is around, frame by frame"
    timed = "DEF M " + moved(volume(EMPTY, fields="bboxDisplay TRUE"), HALF) + (
        "DEF T TimeSensor { loop TRUE cycleInterval 10 }\n"
        "DEF I PositionInterpolator { key [0 1] keyValue [0.05 0.05 0 1.05 0.05 0] }\n"
        "ROUTE T.fraction_changed TO I.set_fraction ROUTE I.value_changed TO M.translation\n")
    result = suite.render(front_scene(timed), "-o", "frame%d.npy", "--frames", "4", "--fps", "1", size="20x20")
    names = sorted(name for name in os.listdir(result.folder) if name.endswith(".npy"))
    for i, name in enumerate(names):
        picture = Picture(os.path.join(result.folder, name))
        edges = [x for x in range(20) if picture.at(x, 9)[3] > 0.5]
        suite.equal(f"at {i}", edges, [5 + i, 15 + i])


@suite.case
def of_files():
    "a volume whose size comes from its file has no box that is known: one warning"
    result = suite.render(front_scene(volume(EMPTY, fields="bboxDisplay TRUE fileGeometry TRUE")), "--probe", "0,0")
    suite.equal("told", [m[5] for m in result.messages() if "bounding box" in m[4]], ["not-drawn"])


suite.run()
