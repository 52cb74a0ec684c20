#!/usr/bin/env python3
"""The proposal of 2005 and the final standard: what selects a dialect, what differs, OctTree."""

import os

from harness import Picture, Suite, dot, opacity, premultiplied
from scenes import constant, effect, front_scene, quad, scene, volume
from style_data import OPACITY, SLOPE, TINT, VIEW, Styles, boundary, magnitude, normal_of, silhouette

suite = Suite()

GREY = constant(51, (2, 2, 2))  # 0.2 in cells of 1/2
TOKEN = "Switch { whichChoice -1 children OctTree { } }\n"  # of 2005, and not in the picture


def told(result):
    """The lines of information about dialects, without their place."""
    return [line.split(": info: ")[1] for line in result.errors.splitlines() if line.endswith("[dialect]")]


FINAL_GREY = premultiplied((0.2,) * 3, opacity(0.2, 1, 0.5))
OLD_GREY = premultiplied((0.2,) * 3, opacity(0.8, 1, 0.5))


@suite.case
def default_ramp():
    "the default transfer function is opaque at 255, in 2005 at 0; --dialect overrides; one line tells"
    bare, token = front_scene(volume(GREY)), front_scene(TOKEN, volume(GREY))
    old, new = "as the proposal of 2005 has them", "as the final standard has them"
    rows = (
        ("final", bare, [], FINAL_GREY, None),
        ("final, asked", bare, ["--dialect", "final"], FINAL_GREY, f"{new}, as asked"),
        ("2005, asked", bare, ["--dialect", "2005"], OLD_GREY, f"{old}, as asked"),
        ("a word of 2005", token, [], OLD_GREY, old),
        ("a word of 2005, final asked", token, ["--dialect", "final"], FINAL_GREY, f"{new}, as asked"),
    )
    for name, text, arguments, expected, line in rows:
        result = suite.render(text, "--probe", "0,0", *arguments, size="1x1")
        suite.close(name, [float(word) for word in result.output.split()], expected)
        lines = [f"volume nodes are read {line} [dialect]"] if line else []
        suite.equal(f"{name}: told", told(result), lines)


@suite.case
def versions():
    "the version number of the file never decides"
    for version in ("3.0", "3.1", "3.2", "3.3", "4.0"):
        text = front_scene(volume(GREY)).replace("V4.0", f"V{version}")
        suite.close(version, suite.middle(text), FINAL_GREY)


@suite.case
def styles_of_dialects():
    "fields that are not given are the dialect's; a given one stands in both"
    facing, change = dot(normal_of(SLOPE), VIEW), magnitude(SLOPE)
    boundaries = {
        "": (boundary(OPACITY, change), boundary(OPACITY, change, 1, 0, 1)),
        "retainedOpacity 0.3": (boundary(OPACITY, change, 0.3), boundary(OPACITY, change, 0.3, 0, 1)),
        "boundaryOpacity 0.7": (boundary(OPACITY, change, 0.2, 0.7), boundary(OPACITY, change, 1, 0.7, 1)),
        "boundaryOpacity 1 opacityFactor 3 retainedOpacity 0": (boundary(OPACITY, change, 0, 1, 3),) * 2,
    }
    silhouettes = {
        "": (silhouette(OPACITY, facing), silhouette(OPACITY, facing, 0, 1, 0.5)),
        "silhouetteFactor 2": (silhouette(OPACITY, facing), silhouette(OPACITY, facing, 0, 1, 2)),
        "silhouetteSharpness 3": (silhouette(OPACITY, facing, 1, 0, 3), silhouette(OPACITY, facing, 0, 1, 3)),
        "silhouetteFactor 2 silhouetteBoundaryOpacity 0.5": (
            silhouette(OPACITY, facing, 1, 0.5, 0.5), silhouette(OPACITY, facing, 0, 0.5, 2)),
        "silhouetteRetainedOpacity 0.25 silhouetteBoundaryOpacity 0.5 silhouetteSharpness 2": (
            silhouette(OPACITY, facing, 0.25, 0.5, 2),) * 2,
    }
    for i, dialect in enumerate(("final", "2005")):
        styles = Styles(suite)
        for kind, rows in (("BoundaryEnhancementVolumeStyle", boundaries),
                           ("SilhouetteEnhancementVolumeStyle", silhouettes)):
            for fields, expected in rows.items():
                styles.add(f"{dialect}: {kind} {fields}", f"{kind} {{ {fields} }}", TINT, expected[i],
                           fields="gradientUnit 1")
        pixels = styles.row.draw("--dialect", dialect, files=styles.files)
        for pixel, (name, expected) in zip(pixels, styles.expected):
            suite.close(name, pixel, expected)


@suite.case
def without_effect():
    "fields of other browsers are read; those that change nothing are named once, unless they hold their default"
    volumes = volume(GREY, "OpacityMapVolumeStyle { type \"preintegrated\" opacityFactor 3 lightFactor 2 }", fields=(
        "sliceThickness 1 1 2 swapped TRUE renderSettings [ Group { } ] rayStep 0.1 renderer Group { } "
        "filterType \"LINEAR\" allowViewpointInside FALSE"))
    result = suite.render(front_scene(volumes, volumes), "--probe", "0,0", size="1x1")
    suite.equal("one warning each", [(m[3], m[4].split("'")[1], m[5]) for m in result.messages()], [
        ("warning", name, "not-drawn") for name in (
            "sliceThickness", "swapped", "renderSettings", "rayStep", "renderer", "filterType",
            "allowViewpointInside", "type", "opacityFactor", "lightFactor")])
    plain = volume(GREY, "ComposedVolumeStyle { ordered TRUE renderStyle OpacityMapVolumeStyle { type \"simple\" } }",
                   fields="swapped FALSE allowViewpointInside TRUE filterType \"\"")
    segments = f"SegmentedVolumeData {{ numberOfMaxSegments 7 voxels {GREY} }}\n"
    result = suite.render(front_scene(plain, segments), "--probe", "0,0", size="1x1")
    suite.equal("none", result.messages(), [])


@suite.case
def told_once():
    "the line is not repeated while the picture changes, nor where nothing is a volume"
    text = front_scene(
        TOKEN, "DEF V " + volume(GREY), "DEF T TimeSensor { loop TRUE }\n"
        "DEF I ScalarInterpolator { key [0 1] keyValue [0 1] }\n"
        "ROUTE T.fraction_changed TO I.set_fraction ROUTE I.value_changed TO V.opacityUnitDistance\n"
    )
    result = suite.render(text, "-o", "frame%d.png", "--frames", "3", "--fps", "4", size="2x2")
    suite.equal("three frames", len(told(result)), 1)
    result = suite.render(front_scene(TOKEN, quad()), "--probe", "0,0", size="1x1")
    suite.equal("no volume", told(result), [])


def square(color):
    return quad(f"UnlitMaterial {{ emissiveColor {color} }}")


def tree(fields):
    return "OctTree { " + fields + " }\n"


RED, GREEN = (1, 0, 0, 1), (0, 1, 0, 1)
NOTHING = (0, 0, 0, 0)
HALVES = f"highRes [ {square('0 1 0')} ] lowRes {square('1 0 0')}"


@suite.case
def octants():
    "OctTree: highRes nearer than range, else lowRes; distances count in its own coordinates"
    rows = (  # the viewer is 10 away
        ("near", tree(f"range 10.01 {HALVES}"), GREEN),
        ("at the range", tree(f"range 10 {HALVES}"), RED),
        ("a range of 20 is the default", tree(HALVES), GREEN),
        ("a range of 0", tree(f"range 0 {HALVES}"), RED),
        ("scaled", f"Transform {{ scale 1 1 .5 children {tree(f'range 15 {HALVES}')} }}", RED),
        ("center", tree(f"range 15 center 0 0 -6 {HALVES}"), RED),
        ("no lowRes", tree(f"range 1 highRes [ {square('0 1 0')} ]"), NOTHING),
        ("NULL", tree("range 1 highRes [ ] lowRes NULL"), NOTHING),
        ("no highRes", tree(f"lowRes {square('1 0 0')}"), NOTHING),
        ("in a tree", tree(f"highRes [ {tree(f'range 5 {HALVES}')} ]"), RED),
        ("hidden", tree(f"visible FALSE {HALVES}"), NOTHING),
        ("in lowRes a group", tree(f"range 1 lowRes Group {{ children {square('1 0 0')} }}"), RED),
    )
    for name, text, expected in rows:
        suite.close(name, suite.middle(front_scene(text)), expected)


@suite.case
def eight_octants():
    "eight nodes at most are drawn of highRes, volumes among them"
    # each square a little nearer than the one before
    nodes = "".join(
        f"Transform {{ translation 0 0 {i} children {square(f'{i / 10} 0 0')} }}\n" for i in range(1, 10)
    )
    text = front_scene(tree(f"highRes [ {nodes} ]"))
    result = suite.render(text, "--probe", "0,0", size="1x1", status=0)
    suite.close("the eighth", [float(word) for word in result.output.split()], (0.8, 0, 0, 1))
    suite.equal("told", [m[3:] for m in result.messages()],
                [("warning", "OctTree.highRes has 9 nodes; the first 8 are drawn", "not-drawn")])
    half = "Transform { translation 0 0 %s children " + volume(GREY) + " }\n"
    text = front_scene(tree(f"highRes [ {half % '2'} {half % '-2'} ]"))
    expected = opacity(0.8, 2, 0.5)
    suite.close("two volumes", suite.middle(text), premultiplied((0.2,) * 3, expected))


@suite.case
def effects_of_octants():
    "an effect among the nodes of an OctTree is one of that group"
    blue = effect("void PLUG_fragment_modify(inout vec4 color) { color.b = 1.0; }", 'language "GLSL"')
    text = front_scene(tree(f"highRes [ {blue} {square('0 1 0')} ]"),
                       f"Transform {{ translation 5 0 0 children {square('1 0 0')} }}")
    suite.close("inside", suite.middle(text), (0, 1, 1, 1))
    text = front_scene(tree(f"highRes [ {blue} {square('0 1 0')} ]"),
                       f"Transform {{ translation 0 0 1 children {square('1 0 0')} }}")
    suite.close("outside", suite.middle(text), RED)


@suite.case
def octants_tell():
    "lowResActive is sent at first and when it changes, and the picture follows"
    text = scene(
        "DEF V Viewpoint { position 0 0 2 }\nNavigationInfo { headlight FALSE }\n",
        f"DEF O OctTree {{ range 10 {HALVES} }}\n",
        "DEF G Transform { translation 0 0 0.1 scale 0.5 0.5 1 visible FALSE children "
        + square("0 0 1") + " }\n",
        "DEF T TimeSensor { loop TRUE cycleInterval 10 }\n"
        "DEF I PositionInterpolator { key [0 1] keyValue [0 0 2 0 0 22] }\n"
        "ROUTE T.fraction_changed TO I.set_fraction ROUTE I.value_changed TO V.position\n"
        "ROUTE O.lowResActive TO G.visible\n",
    )
    for time, expected in ((0, GREEN), (3.9, GREEN), (4.1, (0, 0, 1, 1)), (9, (0, 0, 1, 1))):
        suite.close(f"at {time}", suite.middle(text, "--time", time), expected)
    result = suite.picture(text, "--time", "4.1", size="101x101")
    suite.close("beside", result.at(50 + 4, 50), RED)
    # at 0, 1, ... 5: beyond the range after 4
    result = suite.render(text, "-o", "frame%d.npy", "--frames", "6", "--fps", "1", size="101x101")
    names = sorted(name for name in os.listdir(result.folder) if name.endswith(".npy"))
    colors = [Picture(os.path.join(result.folder, name)).at(50, 50) for name in names]
    suite.close("frame by frame", sum(colors, ()), sum([GREEN] * 4 + [(0, 0, 1, 1)] * 2, ()))


suite.run()
