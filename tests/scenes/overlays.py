#!/usr/bin/env python3
"""Overlays on pictures of volumes - scale bar, letters of orientation, legend - and fluorescence that adds up: the
effects of examples/volumes/compositions/effects."""

import math
import os

from harness import Suite, opacity

suite = Suite()
EFFECTS = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "examples", "volumes", "compositions", "effects")
WIDTH, HEIGHT = 160, 120

# What is drawn of a letter, row by row from the top.
LETTERS = {
    "0": ".###. #...# #..## #.#.# ##..# #...# .###.",
    "1": "..#.. .##.. ..#.. ..#.. ..#.. ..#.. .###.",
    "2": ".###. #...# ....# ...#. ..#.. .#... #####",
    "3": "##### ...#. ..#.. ...#. ....# #...# .###.",
    "5": "##### #.... ####. ....# ....# #...# .###.",
    "-": "..... ..... ..... ##### ..... ..... .....",
    ".": "..... ..... ..... ..... ..... .##.. .##..",
    " ": "..... ..... ..... ..... ..... ..... .....",
    "A": ".###. #...# #...# ##### #...# #...# #...#",
    "H": "#...# #...# #...# ##### #...# #...# #...#",
    "I": ".###. ..#.. ..#.. ..#.. ..#.. ..#.. .###.",
    "L": "#.... #.... #.... #.... #.... #.... #####",
    "P": "####. #...# #...# ####. #.... #.... #....",
    "R": "####. #...# #...# ####. #.#.. #..#. #...#",
    "S": ".#### #.... #.... .###. ....# ....# ####.",
    "U": "#...# #...# #...# #...# #...# #...# .###.",
    "m": "..... ..... ##.#. #.#.# #.#.# #...# #...#",
}


def files(*names):
    found = {}
    for name in ("text.glsl",) + names:
        with open(os.path.join(EFFECTS, name), encoding="utf-8") as file:
            found[name] = file.read()
    return found


def effect(name, fields=""):
    return f"""Effect {{ inputOutput SFFloat textSize 1 {fields} parts [
        EffectPart {{ type "FRAGMENT" url "text.glsl" }} EffectPart {{ type "FRAGMENT" url "{name}" }} ] }}"""


def scene(view, effects, volume="dimensions 0.04 0.04 0.04 voxels PixelTexture3D { image 1 1 1 1 0 }", around=""):
    return f"""#X3D V4.0 utf8
PROFILE Immersive
{view}
Transform {{ {around} children VolumeData {{ {volume} effects [ {effects} ] }} }}
"""


# 1000 pixels a metre.
PARALLEL = "OrthoViewpoint { position 0 0 1 fieldOfView [ -0.08 -0.06 0.08 0.06 ] }"


def draw(text, *names):
    return suite.picture(text, "--step", "0.5", size=f"{WIDTH}x{HEIGHT}", files=files(*names))


def lit(picture, x, y):
    return min(picture.at(x, y)[:2]) > 0.75  # white or yellow


def bitmap(text):
    rows = [LETTERS[letter].split() for letter in text]
    return [".".join(row[i] for row in rows) for i in range(7)]


def where(picture, text):
    """The places of a text in a picture: the upper left corners."""
    on = [[lit(picture, x, y) for x in range(picture.width)] for y in range(picture.height)]
    rows = [[dot == "#" for dot in row] for row in bitmap(text)]
    width = len(rows[0])
    return [(x, y) for y in range(picture.height - 6) for x in range(picture.width - width + 1)
            if all(on[y + i][x : x + width] == row for i, row in enumerate(rows))]


def longest_run(picture):
    """The longest horizontal line: its length."""
    best = 0
    for y in range(picture.height):
        run = 0
        for x in range(picture.width):
            run = run + 1 if lit(picture, x, y) else 0
            best = max(best, run)
    return best


@suite.case
def scale_bar_parallel():
    "a scale bar is as long as it says, with a round length"
    picture = draw(scene(PARALLEL, effect("scale-bar.glsl", "inputOutput SFFloat most 0.4")), "scale-bar.glsl")
    suite.equal("50 mm are 50 pixels", longest_run(picture), 50)  # 64 would fit
    suite.equal("and called so", len(where(picture, "50 mm")), 1)
    suite.check("outside the box too", picture.at(8, 113)[0] == 1, picture.at(8, 113))


@suite.case
def scale_bar_scaled():
    "a Transform scales what a millimetre is"
    picture = draw(scene(PARALLEL, effect("scale-bar.glsl", "inputOutput SFFloat most 0.4"),
                         around="scale 3 3 3 rotation 0 0 1 0.5"), "scale-bar.glsl")
    suite.equal("20 mm are 60 pixels", longest_run(picture), 60)
    suite.equal("and called so", len(where(picture, "20 mm")), 1)


@suite.case
def scale_bar_stretched():
    "where a volume is stretched, the bar goes by the direction in which it lies"
    fields = "inputOutput SFFloat barLength 20"
    picture = draw(scene(PARALLEL, effect("scale-bar.glsl", fields), around="scale 2 1 1"), "scale-bar.glsl")
    suite.equal("along the stretched axis", longest_run(picture), 40)
    picture = draw(scene(PARALLEL, effect("scale-bar.glsl", fields), around="scale 1 2 2"), "scale-bar.glsl")
    suite.equal("across", longest_run(picture), 20)


@suite.case
def scale_bar_perspective():
    "in perspective the bar is that at the volume's centre"
    view = "Viewpoint { position 0 0 0.5 fieldOfView 0.4 }"
    picture = draw(scene(view, effect("scale-bar.glsl", "inputOutput SFFloat barLength 30")), "scale-bar.glsl")
    exact = 0.03 / 0.5 / math.tan(0.2) * HEIGHT / 2
    suite.close("30 mm", longest_run(picture), exact, 0.5)
    suite.equal("called so", len(where(picture, "30 mm")), 1)


@suite.case
def scale_bar_unit():
    "another unit, and less than one of it"
    fields = "inputOutput SFFloat unitLength 0.1 inputOutput MFInt32 unit [ 72 85 109 ]"
    picture = draw(scene(PARALLEL, effect("scale-bar.glsl", fields)), "scale-bar.glsl")
    suite.equal("0.2 of 100 pixels", longest_run(picture), 20)
    suite.equal("the longest below 48 pixels", len(where(picture, "0.2 HUm")), 1)


BODY = """dimensions 0.02 0.02 0.02 voxels PixelTexture3D { image 1 2 1 2 0 255 0 0 }
    opacityUnitDistance 0.00001"""  # right and inferior is bright


def sides(picture):
    """The letter at the left, right, top and bottom edge."""
    found = {}
    for letter in "RLAPSI":
        for x, y in where(picture, letter):
            side = ("left" if x < 20 else "right" if x > WIDTH - 25 else "top" if y < 20 else
                    "bottom" if y > HEIGHT - 20 else "inside")
            found[side] = letter
    return [found.get(side) for side in ("left", "right", "top", "bottom")]


def bright_side(picture):
    """Where the bright octants are: -1 left, 1 right; -1 top, 1 bottom; 0 both."""
    counts = [picture.at(x, y)[0] > 0.3 for x, y in ((75, 60), (84, 60), (80, 55), (80, 64))]
    return counts[1] - counts[0], counts[3] - counts[2]


@suite.case
def orientation_sides():
    "letters tell the sides of the body: left is left"
    half = math.pi / 2
    views = [
        # name, place, turn, letters (left, right, top, bottom), where the bright part is
        ("from the front", "0 1 0", f"0 0.70710678 0.70710678 {math.pi}", ["R", "L", "S", "I"], (-1, 1)),
        ("from behind", "0 -1 0", f"1 0 0 {half}", ["L", "R", "S", "I"], (1, 1)),
        ("from below", "0 0 -1", f"0 1 0 {math.pi}", ["R", "L", "A", "P"], (-1, 0)),
        ("from the right", "1 0 0", f"0.57735027 0.57735027 0.57735027 {2 * math.pi / 3}", ["P", "A", "S", "I"], (0, 1)),
    ]
    for name, place, turn, letters, bright in views:
        view = f"OrthoViewpoint {{ position {place} orientation {turn} fieldOfView [ -0.08 -0.06 0.08 0.06 ] }}"
        picture = draw(scene(view, effect("orientation-letters.glsl"), BODY), "orientation-letters.glsl")
        suite.equal(f"{name}: letters", sides(picture), letters)
        suite.equal(f"{name}: the volume itself", bright_side(picture), bright)


@suite.case
def orientation_mirrored():
    "a mirrored volume has mirrored letters; DICOM's axes are said by fields"
    view = "OrthoViewpoint { position 0 0 1 fieldOfView [ -0.08 -0.06 0.08 0.06 ] }"
    picture = draw(scene(view, effect("orientation-letters.glsl"), BODY, "scale -1 1 1"), "orientation-letters.glsl")
    suite.equal("R stands left", sides(picture), ["R", "L", "A", "P"])
    suite.equal("so does what is right", bright_side(picture)[0], -1)
    fields = "inputOutput SFVec3f right -1 0 0 inputOutput SFVec3f anterior 0 -1 0"
    picture = draw(scene(view, effect("orientation-letters.glsl", fields), BODY), "orientation-letters.glsl")
    suite.equal("of DICOM", sides(picture), ["R", "L", "P", "A"])


@suite.case
def orientation_oblique():
    "in an oblique view the nearest side stands first"
    view = "OrthoViewpoint { position 0 0 1 fieldOfView [ -0.08 -0.06 0.08 0.06 ] }"
    picture = draw(scene(view, effect("orientation-letters.glsl"), BODY, "rotation 0 0 1 0.6"), "orientation-letters.glsl")
    suite.equal("RP on the right", [x > WIDTH - 25 for x, _ in where(picture, "RP")], [True])
    suite.equal("AR on top", [y < 20 for _, y in where(picture, "AR")], [True])


class Half:
    """Every other pixel of a picture."""

    def __init__(self, picture, x, y):
        self.picture, self.x, self.y = picture, x, y
        self.width, self.height = (picture.width - x) // 2, (picture.height - y) // 2

    def at(self, x, y):
        return self.picture.at(2 * x + self.x, 2 * y + self.y)


@suite.case
def orientation_cube():
    "a cube turns with the volume; the letter of its face says from where it is seen"
    half = math.pi / 2
    views = [("A", "0 1 0", f"0 0.70710678 0.70710678 {math.pi}", ""), ("P", "0 -1 0", f"1 0 0 {half}", ""),
             ("S", "0 0 1", "0 0 1 0", ""), ("I", "0 0 -1", f"0 1 0 {math.pi}", ""),
             ("R", "1 0 0", f"0.57735027 0.57735027 0.57735027 {2 * math.pi / 3}", ""),
             ("L", "1 0 0", f"0.57735027 0.57735027 0.57735027 {2 * math.pi / 3}", "scale -1 1 1")]
    for letter, place, turn, around in views:
        view = f"OrthoViewpoint {{ position {place} orientation {turn} fieldOfView [ -0.08 -0.06 0.08 0.06 ] }}"
        fields = "inputOutput SFFloat size 0.1 inputOutput SFVec2f place 0.8 0.2"  # two pixels a dot
        picture = draw(scene(view, effect("orientation-cube.glsl", fields), BODY, around), "orientation-cube.glsl")
        found = {each for each in "RLAPSI" for x in (0, 1) for y in (0, 1) if where(Half(picture, x, y), each)}
        suite.equal(f"{letter}{' in a mirror' if around else ''}", found, {letter})


FUNCTION = """initializeOnly SFNode transferFunction TransferFunction {
    key [ 0 0.5 1 ] keyValue [ 1 0 0 0, 0 1 0 0.1, 0 0 1 1 ] }"""


@suite.case
def legend():
    "a legend has the function's colours, opaque, and its values"
    fields = FUNCTION + """ inputOutput SFVec2f range -100 100 inputOutput MFInt32 unit [ 72 85 ]
        inputOutput SFVec4f place 0.1 0.1 0.1 0.5"""
    picture = draw(scene(PARALLEL, effect("color-legend.glsl", fields)), "color-legend.glsl")
    for row in (0, 14, 29, 45, 59):
        at = (row + 0.5) / 60
        color = (1 - 2 * at, 2 * at, 0) if at < 0.5 else (0, 2 - 2 * at, 2 * at - 1)
        suite.close(f"row {row}", picture.at(20, HEIGHT - 1 - 12 - row), color + (1,), 2e-3)
    for text, row in (("-100", 0), ("100", 60), ("0", 30), ("-50", 15), ("50", 45), ("HU", 67)):
        rows = [HEIGHT - 12 - (y + 3.5) for _, y in where(picture, text)]
        suite.check(f"{text} stands where it belongs", any(abs(r - row) <= 1 for r in rows), rows)


@suite.case
def legend_window():
    "a legend of a part of the function"
    fields = FUNCTION + """ inputOutput SFVec2f range 0 10 inputOutput SFVec2f shown 5 0
        inputOutput SFVec4f place 0.1 0.1 0.1 0.5"""
    picture = draw(scene(PARALLEL, effect("color-legend.glsl", fields)), "color-legend.glsl")
    suite.close("the end is below", picture.at(20, HEIGHT - 1 - 12), (1 / 120, 119 / 120, 0, 1), 2e-3)
    suite.close("the beginning is above", picture.at(20, HEIGHT - 72), (119 / 120, 1 / 120, 0, 1), 2e-3)


@suite.case
def legend_physical():
    "a function with physical keys is the volume's own"
    volume = """voxels PixelTexture3D { image 1 1 1 1 0 } valueRange -1 3 dimensions 0.01 0.01 0.01"""
    fields = """initializeOnly SFNode transferFunction TransferFunction {
        physical TRUE key [ -1 1 3 ] keyValue [ 1 0 0 0, 0 1 0 0.1, 0 0 1 1 ] }
        inputOutput SFVec2f range -1 3 inputOutput SFVec4f place 0.1 0.1 0.1 0.5"""
    picture = draw(scene(PARALLEL, effect("color-legend.glsl", fields), volume), "color-legend.glsl")
    suite.close("a quarter up", picture.at(20, HEIGHT - 1 - 12 - 15), (1 - 31 / 60, 31 / 60, 0, 1), 5e-3)
    suite.close("three quarters up", picture.at(20, HEIGHT - 1 - 12 - 45), (0, 1 - 31 / 60, 31 / 60, 1), 5e-3)


@suite.case
def overlays_together():
    "three overlays with fonts of their own; they lie over the volume"
    effects = (effect("scale-bar.glsl", "inputOutput SFVec2f place 0.4 0.5") + effect("orientation-letters.glsl") +
               effect("color-legend.glsl", FUNCTION))
    volume = "dimensions 0.1 0.1 0.1 voxels PixelTexture3D { image 1 1 1 1 128 } opacityUnitDistance 0.0001"
    picture = draw(scene(PARALLEL, effects, volume), "scale-bar.glsl", "orientation-letters.glsl", "color-legend.glsl")
    suite.equal("the bar's label", len(where(picture, "20 mm")), 1)
    suite.equal("letters", sides(picture), ["L", "R", "A", "P"])
    suite.close("the volume", picture.at(80, 90)[3], 1, 1e-3)


def channel(color, z, alpha):
    return f"""Transform {{ translation 0 0 {z} children VolumeData {{
        voxels PixelTexture3D {{ image 1 1 1 1 255 }} opacityUnitDistance 1
        renderStyle OpacityMapVolumeStyle {{ transferFunction TransferFunction {{
            key [ 0 1 ] keyValue [ 0 0 0 0, {color} {alpha} ] }} }} }} }}"""


def fluorescence(*channels, background="", fields=""):
    return f"""#X3D V4.0 utf8
PROFILE Immersive
OrthoViewpoint {{ position 0 0 4 fieldOfView [ -0.4 -0.4 0.4 0.4 ] }}
{background}
Group {{ children [ {" ".join(channels)}
    Effect {{ placement "REPLACE" target "Composite" {fields}
        parts EffectPart {{ type "FRAGMENT" url "additive.glsl" }} }} ] }}
"""


@suite.case
def channels_add():
    "channels that overlap add their light: nothing is hidden, whatever the order"
    green, magenta = channel("0 1 0", 0, 0.3), channel("1 0 1", 0.25, 0.5)
    g, m = -math.log(1 - 0.3), -math.log(1 - 0.5)
    for name, pair in (("one order", (green, magenta)), ("the other", (magenta, green))):
        color = suite.middle(fluorescence(*pair), files=files("additive.glsl"))
        suite.close(name, color, (m, g, m, 0), 1e-3)
    alone = suite.middle(fluorescence(green), files=files("additive.glsl"))
    suite.close("one alone", alone, (0, g, 0, 0), 1e-3)
    color = suite.middle(fluorescence(green, magenta, fields="inputOutput SFFloat exposure 0.5"),
                         files=files("additive.glsl"))
    suite.close("exposure", color, (m / 2, g / 2, m / 2, 0), 1e-3)


@suite.case
def channels_apart():
    "channels one behind the other add as well, and so does what is behind"
    green, magenta = channel("0 1 0", -1, 0.3), channel("1 0 1", 1, 0.5)
    g, m = -math.log(1 - 0.3), -math.log(1 - 0.5)
    color = suite.middle(fluorescence(green, magenta, background="Background { skyColor 0 0 0.1 }"),
                         files=files("additive.glsl"))
    suite.close("over a background", color[:3], (m, g, m + 0.1), 1e-3)


@suite.case
def without_the_effect():
    "without the effect the front hides the back"
    green, magenta = channel("0 1 0", -1, 0.3), channel("1 0 1", 1, 0.5)
    text = fluorescence(green, magenta).replace('"Composite"', '"Fog" onlyIfActive TRUE')
    color = suite.middle(text, files=files("additive.glsl"))
    suite.close("over", color[:3], (0.5, 0.5 * opacity(0.3, 1, 1), 0.5), 1e-3)


suite.run()
