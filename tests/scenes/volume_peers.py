#!/usr/bin/env python3
"""What other browsers get wrong, in closed form: rays along diagonals, cells that are no cubes, many frames."""

import math
import os
import subprocess
import sys

from harness import Suite, opacity, premultiplied, rotate
from scenes import NO_HEADLIGHT, constant, front_scene, scene, volume, voxels

suite = Suite()

DIAGONAL = (-1, -1, -1)  # the way of the ray


def along_diagonal(content):
    """Parallel rays from one corner of the cube to the other; the middle one meets both."""
    angle = math.acos(1 / math.sqrt(3))
    turned = rotate((-1, 1, 0), angle, (0, 0, -1))
    assert all(abs(a - b / math.sqrt(3)) < 1e-9 for a, b in zip(turned, DIAGONAL)), turned
    view = f"OrthoViewpoint {{ position 10 10 10 orientation -1 1 0 {angle!r} fieldOfView -1 -1 1 1 }}\n"
    return scene(view, NO_HEADLIGHT, content)


@suite.case
def diagonal():
    "T3: along the diagonal of a cube the optical depth is sqrt(3) times that along an axis"
    for value, side in ((5, 2), (40, 4), (3, 16)):
        cube = volume(constant(value, (side,) * 3))
        alpha = value / 255
        for name, text, length in (("axis", front_scene(cube), 1), ("diagonal", along_diagonal(cube), math.sqrt(3))):
            got = suite.middle(text)
            expected = opacity(alpha, length, 1 / side)
            suite.close(f"{name}, {side} voxels of {value}", got, premultiplied((alpha,) * 3, expected), 1e-4)


@suite.case
def far_corner():
    "T3: the ray along the diagonal reaches the farthest voxel"
    far = voxels(1, (8, 8, 8), [255] + [0] * 511)
    # between the centres of the last two voxels the value is a cube of the share of the way
    suite.close("opaque", suite.middle(along_diagonal(volume(far)))[3], 1, 1e-6)
    near = voxels(1, (8, 8, 8), [0] * 511 + [255])
    suite.close("and the nearest", suite.middle(along_diagonal(volume(near)))[3], 1, 1e-6)


# A slope along x and z, in voxels that are eight times as long as wide, and in cubes. In the middle of the
# box gradients are those of the slope.
SIDES = (8, 8, 4), (8, 8, 32)
STYLES = (
    "OpacityMapVolumeStyle { transferFunction PixelTexture { image 1 1 4 0x8040C050 } } "
    "BoundaryEnhancementVolumeStyle { } EdgeEnhancementVolumeStyle { edgeColor 1 0 0 1 } "
    "SilhouetteEnhancementVolumeStyle { silhouetteRetainedOpacity .5 silhouetteBoundaryOpacity .5 } "
    "ShadedVolumeStyle { lighting TRUE }")


def slope(size):
    w, h, d = size
    long = 32 // d
    # 6 a cube along z, 3 along x
    return voxels(1, size, [round(6 * (k + 0.5) * long) + 3 * i for k in range(d) for _ in range(h) for i in range(w)])


@suite.case
def long_cells():
    "T4: dimensions 1 1 4 with few voxels, and the same data on a grid of cubes, give one picture"
    view = ("Viewpoint { position 2.5 1.5 5 orientation -.4 .9 .1 .6 fieldOfView .35 }\n"
            "NavigationInfo { headlight FALSE }\nDirectionalLight { direction -.2 -.5 -1 }\n")
    pictures = []
    for size in SIDES:
        content = volume(slope(size), f"ComposedVolumeStyle {{ renderStyle [ {STYLES} ] }}", dimensions=(1, 1, 4), fields=(
            "opacityUnitDistance .2 gradientUnit .1 valueRange 0 255 cropMin .2 .2 .4 cropMax .8 .8 .6"))
        pictures.append(suite.picture(scene(view, content), size="24x24"))
    worst = max(abs(a - b) for y in range(24) for x in range(24)
                for a, b in zip(pictures[0].at(x, y), pictures[1].at(x, y)))
    seen = sum(pictures[0].at(x, y)[3] > 0.01 for y in range(24) for x in range(24))
    suite.check(f"something is seen: {seen} pixels", seen > 30)
    suite.check(f"the pictures differ by {worst:.2g} at most", worst < 1e-3)


def frames(count, folder):
    """Draws frames; how much memory that took, in KiB."""
    arguments = [suite.program, "render", "scene.x3dv", "--size", "4x4", "--no-cache", "-o", "frame%d.png",
                 "--frames", str(count), "--fps", "10"]
    # AddressSanitizer keeps what was freed, up to a bound
    options = os.environ.get("ASAN_OPTIONS", "") + ":quarantine_size_mb=1:thread_local_quarantine_size_kb=16"
    environment = dict(os.environ, ASAN_OPTIONS=options)
    with subprocess.Popen(arguments, cwd=folder, env=environment, stdout=subprocess.PIPE, stderr=subprocess.STDOUT) as process:
        output = process.stdout.read().decode(errors="replace")
        _, status, usage = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
    suite.equal(f"{count} frames: exit status", process.returncode, 0)
    if process.returncode:
        print(f"# {output[:2000]}")
    return usage.ru_maxrss


@suite.case
def many_frames():
    "T22: events on types, weights and values, frame after frame: the picture follows, memory does not grow"
    grey, white = constant(51, (2, 2, 2)), constant(204, (2, 2, 2))
    text = front_scene(
        "DEF V " + volume(grey, f"DEF B BlendedVolumeStyle {{ voxels {white} weightConstant2 0 weightConstant1 1 }}"),
        f"DEF I IsoSurfaceVolumeData {{ dimensions .1 .1 .1 surfaceValues .5 voxels {grey} }}\n",
        "DEF T TimeSensor { loop TRUE cycleInterval 1 }\n",
        "DEF W ScalarInterpolator { key [0 1] keyValue [0 1] }\n",
        "DEF S ScalarInterpolator { key [0 1] keyValue [0.2 0.4] }\n",
        "DEF E BooleanSequencer { key [0 0.5] keyValue [TRUE FALSE] }\n",
        "ROUTE T.fraction_changed TO W.set_fraction ROUTE W.value_changed TO B.weightConstant2\n",
        "ROUTE T.fraction_changed TO S.set_fraction ROUTE S.value_changed TO I.surfaceTolerance\n",
        "ROUTE T.fraction_changed TO E.set_fraction ROUTE E.value_changed TO B.enabled\n",
        "ROUTE E.value_changed TO I.bboxDisplay\n")
    for time, weight in ((0.1, 0.1), (0.4, 0.4), (0.7, None)):
        got = suite.middle(text, "--time", time)
        a = 0.2 + 0.8 * (weight or 0)
        # disabled, the only style draws nothing
        expected = premultiplied((min(a, 1),) * 3, opacity(a, 1, 0.5)) if weight else (0, 0, 0, 0)
        suite.close(f"at {time}", got, expected, 1e-4)
    folder = suite.new_folder()
    with open(os.path.join(folder, "scene.x3dv"), "w", encoding="utf-8") as file:
        file.write(text)
    few, many = frames(20, folder), frames(220, folder)
    suite.check(f"{few} KiB for 20 frames, {many} for 220", many < few + 8192)


suite.run()
