#!/usr/bin/env python3
"""Draws the scenes of volumes/ whose scans lie beside the project, and checks something true of each; skipped
where the scans are missing. shared_volumes.py PLUGRAY SCANS [CASE...]"""

import array
import gzip
import json
import os
import re
import sys

SCANS = os.path.abspath(sys.argv.pop(2))
HERE = os.path.dirname(os.path.abspath(__file__))
SCENES = os.path.join(HERE, "volumes")
EFFECTS = os.path.join(HERE, "..", "..", "examples", "volumes")  # some scenes use effects of the examples

from harness import CaseError, Picture, Suite, read_probes  # noqa: E402

suite = Suite()


def draws(*scans):
    """Marks a case that needs these scans: skipped where one is missing."""

    def mark(function):
        def case():
            missing = [s for s in scans if not os.path.exists(os.path.join(SCANS, s + ".nrrd"))]
            if missing:
                suite.skip(suite.title, f"without {', '.join(missing)}")
            else:
                function()

        case.__name__, case.__doc__ = function.__name__, function.__doc__
        return suite.case(case)

    return mark


def draw(name, *arguments, size="96x72"):
    """A scene is to be drawn without a complaint."""
    result = suite.command("render", os.path.join(SCENES, name + ".x3dv"), "--size", size, "--no-cache",
                           "--allow", SCANS, "--allow", EFFECTS, *arguments)
    suite.equal("nothing to complain of", result.messages(), [])
    return result


def probe(name, pixels, *arguments, **options):
    where = [word for x, y in pixels for word in ("--probe", f"{x},{y}")]
    return read_probes(draw(name, *where, *arguments, **options), len(pixels))


def pick(name, x, y, *arguments, **options):
    return json.loads(draw(name, "--pick", f"{x},{y}", *arguments, **options).output)


def picture(name, *arguments, **options):
    result = draw(name, "-o", "picture.npy", *arguments, **options)
    return Picture(os.path.join(result.folder, "picture.npy"))


def voxels(name, code, sizes):
    """The voxels of an NRRD file with compressed data behind its header."""
    with open(os.path.join(SCANS, name + ".nrrd"), "rb") as file:
        data = file.read()
    values = array.array(code, gzip.decompress(data[data.index(b"\n\n") + 2 :]))
    if sys.byteorder == "big":
        values.byteswap()
    if len(values) != sizes[0] * sizes[1] * sizes[2]:
        raise CaseError(f"{name} has {len(values)} voxels")
    return values


def scans_of(name):
    with open(os.path.join(SCENES, name + ".x3dv"), encoding="utf-8") as file:
        return re.findall(r"shared/data/([\w-]+)\.nrrd", file.read())


def seen(image, background, tolerance=0.05):
    """How many pixels are not of the background."""
    return sum(
        max(abs(a - b) for a, b in zip(image.at(x, y), background)) > tolerance
        for y in range(image.height)
        for x in range(image.width)
    )


@draws("mr-head-160x232x160", "mr-head-labels-160x232x160")
def head():
    "a head by its segments: the brain alone is smaller than the head, and in the middle of it"
    whole = picture("mr-head")
    brain = picture("mr-head", "--set", "Head.segmentEnabled=FALSE FALSE TRUE")
    background = whole.at(0, 0)
    suite.check("the brain is a part of the head", 0.3 < seen(brain, background) / seen(whole, background) < 0.85,
                seen(brain, background), seen(whole, background))
    found = pick("mr-head", 48, 30, "--set", "Head.segmentEnabled=FALSE FALSE TRUE")
    suite.equal("and has its number", found["segment"], 2)


@draws("confocal-ovule-128x128x32", "confocal-ovule-labels-128x128x32")
def ovule():
    "cells of an ovule: the hue of a pixel is that of the segment that is picked there"
    for x, y in ((50, 38), (42, 23)):
        segment = pick("ovule", x, y)["segment"]
        color = probe("ovule", [(x, y)])[0]
        hue = (0.618034 * segment) % 1
        pure = [min(max(abs(((hue + shift) % 1) * 6 - 3) - 1, 0), 1) for shift in (0, 2 / 3, 1 / 3)]
        suite.check("a cell", 1 <= segment <= 50, segment)
        order = sorted(range(3), key=pure.__getitem__)
        suite.check("its hue", color[order[0]] <= color[order[2]] - 0.1, segment, color, pure)


@draws("cryoem-betagal-100x100x100", "cryoem-betagal-localres-100x100x100")
def protein():
    "a protein: the surface has the value asked for, and colours of the second map"
    found = pick("betagal", 48, 36)
    suite.close("its value", found["physical"][0], 0.06, 1e-4)
    image = picture("betagal")
    pixels = [image.at(x, y) for y in range(image.height) for x in range(image.width)]
    suite.check("blue is there", any(p[2] > p[0] + 0.2 for p in pixels))
    suite.check("red is there", any(p[0] > p[2] + 0.2 for p in pixels))


@draws("lightsheet-nuclei-94x86x124")
def nuclei():
    "nuclei: along each column of voxels, the greatest value of the file, by the window"
    width, height, depth = 94, 86, 124
    data = voxels("lightsheet-nuclei-94x86x124", "H", (width, height, depth))
    pixels = [(13 * i % width, 29 * i % height) for i in range(24)]
    colors = probe("nuclei", pixels, "--viewpoint", "columns", size=f"{width}x{height}")
    for (x, y), color in zip(pixels, colors):
        column = data[(height - 1 - y) * width + x :: width * height]
        expected = min(max((max(column) - 250) / 1700, 0), 1)
        suite.close(f"column {x},{y}", color[:3], [expected] * 3, 1 / 100)


@draws("ct-tooth-103x94x161")
def tooth():
    "a tooth, cut open: its crown is enamel, white; dentine below is amber"
    image = picture("tooth")
    background = image.at(0, 0)
    rows = [y for y in range(image.height) if any(
        max(abs(a - b) for a, b in zip(image.at(x, y), background)) > 0.1 for x in range(image.width))]
    top, bottom = rows[0], rows[-1]
    middle = (top + bottom) // 2

    def white(low, high):
        return sum(min(image.at(x, y)[:3]) > 0.8 for y in range(low, high) for x in range(image.width))

    suite.check("enamel is in the upper half", white(top, middle) > 20, white(top, middle))
    suite.equal("and not in the lower one", white(middle + 4, bottom), 0)
    amber = [image.at(x, middle) for x in range(image.width)]
    suite.check("dentine", any(p[0] > 0.5 and p[0] > 1.5 * p[2] for p in amber), amber)


@draws("orbital-benzene-55x55x40")
def benzene():
    "an orbital of either sign: what is orange above is blue below, seen from the side"
    size = 40
    image = picture("benzene", "--viewpoint", "side", size=f"{size}x{size}")
    background = image.at(0, 0)
    wrong = found = 0
    for y in range(size // 2):
        for x in range(size):
            above, below = image.at(x, y), image.at(x, size - 1 - y)
            covered = [max(abs(a - b) for a, b in zip(p, background)) > 0.1 for p in (above, below)]
            found += all(covered)
            wrong += covered[0] != covered[1] or (all(covered) and (above[0] > above[2]) == (below[0] > below[2]))
    suite.check("it is there", found > 40, found)
    suite.check("mirrored, in the other colour", wrong <= found // 20, wrong, found)


@suite.case
def others():
    "every other scene is drawn, without a complaint, and something is seen"
    for name in sorted(f[:-5] for f in os.listdir(SCENES) if f.endswith(".x3dv")):
        if name in CHECKED:
            continue
        missing = [s for s in scans_of(name) if not os.path.exists(os.path.join(SCANS, s + ".nrrd"))]
        if missing:
            suite.skip(name, f"without {', '.join(missing)}")
            continue
        image = picture(name)
        part = seen(image, image.at(0, 0)) / (image.width * image.height)
        suite.check(f"{name} shows something", 0.05 < part < 0.95, part)


CHECKED = {"mr-head", "ovule", "betagal", "nuclei", "tooth", "benzene"}  # by the cases above

suite.run()
