#!/usr/bin/env python3
"""What the compositions of volumes and effects show: the effects of examples/volumes/compositions against closed forms, and
the scenes of tests/scenes/volumes on scans, which are skipped where these are missing."""

import math
import os

from harness import Picture, Suite, opacity

suite = Suite()
HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.join(HERE, "..", "..")
EFFECTS = os.path.join(ROOT, "examples", "volumes", "compositions", "effects")
DATA = os.path.join(ROOT, "..", "shared", "data")


def files(*names):
    found = {}
    for name in names:
        with open(os.path.join(EFFECTS, name), encoding="utf-8") as file:
            found[name] = file.read()
    return found


def part(name):
    return f'parts EffectPart {{ type "FRAGMENT" url "{name}" }}'


HEAD = """#X3D V4.0 utf8
PROFILE Immersive
"""

# ---- Zones of ablation

ZONES = [((0.2, 0.2, 0), (1, 0, 0), (0.2, 0.1)), ((-0.2, 0.2, 0), (0, 1, 0), (0.2, 0.1)), ((0, -0.25, 0), (1, 1, 0), (0.2, 0.1))]


def words(numbers):
    return " ".join(f"{v:g}" for v in numbers)


def zones(count):
    """The uppermost of a block of grey that is cut through its middle, seen from above."""
    effects = "".join(
        f"""Effect {{ inputOutput SFVec3f center {words(center)} inputOutput SFVec3f axis {words(axis)}
            inputOutput SFVec2f radii {words(radii)} {part("ablation-zone.glsl")} }}"""
        for center, axis, radii in ZONES[:count])
    return f"""{HEAD}
OrthoViewpoint {{ position 0 0 2 fieldOfView [ -0.5 -0.5 0.5 0.5 ] }}
VolumeData {{
  voxels PixelTexture3D {{ image 1 1 1 1 128 }}
  cropMin 0 0 0.4999 cropMax 1 1 0.5
  opacityUnitDistance 0.000001
  renderStyle OpacityMapVolumeStyle {{ }}
  effects [
    Effect {{ inputOutput SFVec3f floor 0.5 0 0 inputOutput SFColor zone_color 1 0 0 {part("ablation.glsl")} }}
    {effects}
  ]
}}"""


def depth_in_zone(zone, place):
    center, axis, radii = zone
    length = math.hypot(*axis)
    offset = (place[0] - center[0], place[1] - center[1])
    along = (offset[0] * axis[0] + offset[1] * axis[1]) / length
    across = math.sqrt(max(offset[0] ** 2 + offset[1] ** 2 - along**2, 0))
    return math.hypot(along / radii[0], across / radii[1])


@suite.case
def ablation_zones():
    "one effect three times: three ellipsoids with a place, size and direction each"
    size = 40
    names = ("ablation.glsl", "ablation-zone.glsl")
    for count in (1, 3):
        picture = suite.picture(zones(count), size=f"{size}x{size}", files=files(*names))
        wrong = 0
        for y in range(size):
            for x in range(size):
                place = ((x + 0.5) / size - 0.5, 0.5 - (y + 0.5) / size)
                depth = min(depth_in_zone(zone, place) for zone in ZONES[:count])
                if min(abs(depth - 1), abs(depth - 0.86)) < 0.02:
                    continue
                grey = 1.9 * 128 / 255
                share = 0 if depth > 1 else 1 if depth > 0.86 else 0.4
                green = min(grey, 1) * (1 - share)
                wrong += abs(picture.at(x, y)[1] - green) > 0.02
        suite.equal(f"{count} of them", wrong, 0)


# ---- The elliptic cut


@suite.case
def elliptic_cut():
    "a cylinder of elliptic section cuts rays to what is in it"
    text = f"""{HEAD}
OrthoViewpoint {{ position 0 -2 0 orientation 1 0 0 1.5707963 fieldOfView [ -0.5 -0.5 0.5 0.5 ] }}
Transform {{ scale 2 2 2 children VolumeData {{
  dimensions 0.5 0.5 0.5 opacityUnitDistance 0.5
  voxels PixelTexture3D {{ image 1 1 1 1 128 }}
  effects Effect {{ inputOutput SFVec2f middle 0.05 0 inputOutput SFVec2f half_axes 0.15 0.2 {part("elliptic-cut.glsl")} }}
}} }}"""
    pixels = [2, 8, 10, 12, 15, 18]
    got = suite.probe(text, [(x, 10) for x in pixels], size="20x20", files=files("elliptic-cut.glsl"))
    for x, color in zip(pixels, got):
        offset = (((x + 0.5) / 20 - 0.5) / 2 - 0.05) / 0.15
        chord = 2 * 0.2 * math.sqrt(1 - offset**2) if abs(offset) < 1 else 0
        suite.close(f"column {x}", color[3], opacity(128 / 255, chord, 0.5), 1e-3)


# ---- The window


@suite.case
def window():
    "a window goes from black to white; what is darker is nothing"
    voxels = [0, 64, 128, 192]
    text = f"""{HEAD}
OrthoViewpoint {{ position 0 0 2 fieldOfView [ -0.5 -0.5 0.5 0.5 ] }}
VolumeData {{ voxels PixelTexture3D {{ image 1 4 1 1 {words(voxels)} }}
  effects Effect {{ inputOutput SFVec2f window 0.2 0.6 {part("window.glsl")} }} }}"""
    got = suite.probe(text, [(x, 0) for x in range(4)], size="4x4", files=files("window.glsl"))
    for voxel, color in zip(voxels, got):
        grey = min(max((voxel / 255 - 0.2) / 0.4, 0), 1)
        suite.close(f"voxel {voxel}", color, (grey,) * 3 + (1,) if grey > 0.04 else (0,) * 4, 1e-3)


# ---- On scans


def scan_picture(name, *arguments):
    """Of a scene of tests/scenes/volumes; None, and a skipped test, without its data."""
    if not os.path.isdir(DATA):
        suite.skip(name, "without ../shared/data")
        return None
    result = suite.command("render", os.path.join(HERE, "volumes", name), "--size", "120x90", "--no-cache", "-o",
                           "picture.npy", "--allow", DATA, "--allow", EFFECTS, *arguments)
    suite.equal(f"{name}: nothing to complain of", result.messages(), [])
    return Picture(os.path.join(result.folder, "picture.npy"))


def count(picture, condition):
    return sum(bool(condition(*picture.at(x, y)[:3])) for y in range(picture.height) for x in range(picture.width))


def is_red(r, g, b):
    return r > 0.5 and r > 2 * g and r > 2 * b


def is_blue(r, g, b):
    return b > 0.5 and b > 2 * r


@suite.case
def stroke():
    "an effect marks what two contrasts say of a third: lesion and fluid"
    picture = scan_picture("stroke.x3dv")
    if not picture:
        return
    suite.check("a lesion", count(picture, is_red) > 40, count(picture, is_red))
    suite.check("fluid", count(picture, is_blue) > 20, count(picture, is_blue))
    left = sum(is_red(*picture.at(x, y)[:3]) for y in range(90) for x in range(48))
    suite.check("the lesion is in one half", left > 0.8 * count(picture, is_red), left)
    picture = scan_picture("stroke.x3dv", "--set", "Lesion.bright=1")
    suite.equal("nothing is that bright", (count(picture, is_red), count(picture, is_blue)), (0, 0))


def is_orange(r, g, b):
    return r > 0.3 and r > 2 * b


def is_cyan(r, g, b):
    return b > 0.15 and b > 1.5 * r


@suite.case
def channels():
    "two channels, each cut by a plane of its own"
    picture = scan_picture("channels.x3dv")
    if not picture:
        return
    both = count(picture, is_orange), count(picture, is_cyan)
    suite.check("both are seen", min(both) > 200, both)
    picture = scan_picture("channels.x3dv", "--set", "NucleiPlane.plane=0 0 0 -1")
    suite.equal("a plane takes the nuclei away", count(picture, is_orange), 0)
    suite.check("and shows more cytoplasm", count(picture, is_cyan) > both[1], count(picture, is_cyan))
    picture = scan_picture("channels.x3dv", "--set", "CytoplasmPlane.plane=0 0 0 -1")
    suite.equal("another one the cytoplasm", count(picture, is_cyan), 0)


@suite.case
def fluorescence():
    "two channels of a scan: the picture of both is the sum of theirs"
    both = scan_picture("fluorescence.x3dv")
    if not both:
        return
    one = scan_picture("fluorescence.x3dv", "--set", "Cytoplasm.visible=FALSE")
    other = scan_picture("fluorescence.x3dv", "--set", "Nuclei.visible=FALSE")
    worst = max(abs(a - b - c) for a, b, c in zip(both.values, one.values, other.values))
    suite.check("at every pixel", worst < 0.02, worst)
    suite.check("both are bright", max(one.values) > 0.5 and max(other.values) > 0.5, max(one.values), max(other.values))


suite.run()
