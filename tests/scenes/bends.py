#!/usr/bin/env python3
"""Rays in segments: values that bend between their ends."""

import math

from harness import Suite
from scenes import front_scene, voxels

suite = Suite()

COUNT, LONG = 96, 6  # voxels along the ray; of a segment
PEAK = 51  # in the middle between the ends of a segment: they have the same value
VALUES = [max(0, round(250 - 0.5 * (i + 0.5 - PEAK) ** 2)) for i in range(COUNT)]
UNIT = 16  # voxels
STEP = LONG / COUNT ** (2 / 3)  # voxels are flat: a side of a cube as large is 1


def extinction(value):
    """Of the transfer function below: clear up to the middle, from there to an opacity of 1/2."""
    return -math.log(1 - max(0, value / 255 - 0.5) * 2 * 128 / 255)


def opacity():
    """Between the centres of voxels values are on a line."""
    parts = 200
    depth = 0
    for i in range(COUNT - 1):
        for k in range(parts):
            w = (k + 0.5) / parts
            depth += extinction(VALUES[i] * (1 - w) + VALUES[i + 1] * w) / parts
    return 1 - math.exp(-depth / UNIT)


@suite.case
def peak():
    "at a peak between two samples there is more than both of them have"
    data = voxels(1, (1, 1, COUNT), VALUES)
    volume = (f"VolumeData {{ dimensions 1 1 1 opacityUnitDistance {UNIT / COUNT!r} voxels {data}\n"
              "renderStyle OpacityMapVolumeStyle { transferFunction PixelTexture { image 3 1 4 "
              "0xFFFFFF00 0xFFFFFF00 0xFFFFFF80 } } }\n")
    got = suite.probe(front_scene(volume), [(8, 8)], "--method", "preintegrated", "--step", repr(STEP))[0]
    suite.check("opacity", abs(got[3] - opacity()) < 1.0e-3, got, opacity())


suite.run()
