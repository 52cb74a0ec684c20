#!/usr/bin/env python3
"""LineProperties, PointProperties and FillProperties, pixel by pixel."""

from harness import Suite
from scenes import front_scene, quad

suite = Suite()

LINE = "IndexedLineSet { coordIndex [0 1 -1] coord Coordinate { point [-1 0.03125 0, 1 0.03125 0] } }"


def drawn(picture, places):
    return "".join("#" if picture.at(x, y)[3] > 0.5 else "." for x, y in places)


def line(properties, geometry=LINE, size="32x32"):
    text = front_scene(quad("UnlitMaterial { }", geometry=geometry,
                            appearance="lineProperties LineProperties { %s }" % properties))
    return suite.picture(text, size=size)


@suite.case
def line_types():
    "linetype: patterns along the line, in pixels"
    row = [(x, 15) for x in range(32)]
    patterns = {1: "#" * 16, 2: "#" * 10 + "." * 6, 3: "##..##..##..##..",
                4: "########...##...", 5: "#######..##..##."}
    for kind, pattern in patterns.items():
        suite.equal(f"type {kind}", drawn(line(f"linetype {kind}"), row), pattern * 2)
    suite.equal("not applied", drawn(line("linetype 2 applied FALSE"), row), "#" * 32)
    upright = LINE.replace("-1 0.03125 0, 1 0.03125 0", "0.03125 1 0, 0.03125 -1 0")
    suite.equal("upright", drawn(line("linetype 4", upright), [(16, y) for y in range(32)]),
                patterns[4] * 2)
    result = suite.render(front_scene(quad("", geometry=LINE, appearance=(
        "lineProperties LineProperties { linetype 9 }"))), "-o", "a.png")
    suite.equal("stranger types are told of", [m[5] for m in result.messages()], ["not-drawn"])


@suite.case
def line_corners():
    "a pattern runs on around the corners of a polyline"
    corner = ("IndexedLineSet { coordIndex [0 1 2 -1] coord Coordinate { point "
              "[-1 0.03125 0, 0.03125 0.03125 0, 0.03125 -1 0] } }")
    picture = line("linetype 2", corner)
    way = [(x, 15) for x in range(16)] + [(16, y) for y in range(16, 31)]
    text = drawn(picture, way)
    suite.equal("the first leg", text[:16], "##########......")
    suite.equal("the second goes on", text[17:25], "########")


@suite.case
def line_width():
    "linewidthScaleFactor: as wide as GL can; what is not positive is the thinnest"
    column = [(16, y) for y in range(32)]
    for factor, expected in ((0, 1), (-3, 1), (1, 1), (3, 3), (5, 5)):
        text = drawn(line(f"linewidthScaleFactor {factor}"), column)
        suite.equal(f"factor {factor}", text.count("#"), expected)
    both = front_scene(
        quad("", geometry=LINE.replace("0.03125", "0.53125"),
             appearance="lineProperties LineProperties { linewidthScaleFactor 5 }"),
        quad("", geometry=LINE.replace("0.03125", "-0.46875")))
    text = drawn(suite.picture(both, size="32x32"), column)
    suite.equal("the next line is thin again", text.count("#"), 6)


@suite.case
def point_sizes():
    "PointProperties: the factor, and attenuation within its bounds"
    def size(properties, z=0):
        points = "PointSet { coord Coordinate { point [0.03125 0.03125 %s] } }" % z
        text = front_scene(quad("", geometry=points, appearance=(
            "pointProperties PointProperties { %s }" % properties)))
        return drawn(suite.picture(text, size="32x32"), [(x, 15) for x in range(32)]).count("#")

    suite.equal("nominal", size(""), 1)
    suite.equal("factor 5", size("pointSizeScaleFactor 5"), 5)
    bounds = "pointSizeMinValue %s pointSizeMaxValue %s"
    half = "pointSizeScaleFactor 70 attenuation 0 1 0 "
    suite.equal("by the distance", size(half + bounds % (1, 20)), 7)
    suite.equal("nearer", size(half + bounds % (1, 20), 5), 14)
    suite.equal("at most", size(half + bounds % (1, 4)), 4)
    suite.equal("at least", size(half + bounds % (9, 20)), 9)


def fill(properties, size="16x16"):
    text = front_scene(quad("UnlitMaterial { emissiveColor 0 0 1 }", geometry="Rectangle2D { size 2 2 }",
                            appearance="fillProperties FillProperties { %s }" % properties))
    return suite.picture(text, size=size)


def hatch(style, x, y):
    """Rows count from below."""
    lines = {1: y % 8, 2: x % 8, 3: (y - x) % 8, 4: (y + x) % 8}
    return {5: lines[1] == 0 or lines[2] == 0,
            6: lines[3] == 0 or lines[4] == 0}.get(style, lines.get(style) == 0)


@suite.case
def hatches():
    "FillProperties: six styles over the fill, or alone"
    for style in range(1, 7):
        picture = fill(f"hatchStyle {style} hatchColor 1 .5 0")
        wrong = [(x, y) for x in range(16) for y in range(16)
                 if picture.at(x, 15 - y) != ((1, 0.5, 0, 1) if hatch(style, x, y) else (0, 0, 1, 1))]
        suite.equal(f"style {style}", wrong, [])
    picture = fill("filled FALSE hatchStyle 5")
    wrong = [(x, y) for x in range(16) for y in range(16)
             if picture.at(x, 15 - y) != ((1, 1, 1, 1) if hatch(5, x, y) else (0, 0, 0, 0))]
    suite.equal("not filled", wrong, [])
    suite.equal("not hatched", fill("hatched FALSE").at(8, 15), (0, 0, 1, 1))
    suite.equal("neither", fill("hatched FALSE filled FALSE").at(8, 15), (0, 0, 0, 0))


suite.run()
