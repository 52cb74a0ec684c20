#!/usr/bin/env python3
"""F1 to F17: integration and compositing. stability_1.py PLUGRAY [ROW...]"""

from scenes import constant, front_scene, volume
from stability_data import Stability, worst

suite = Stability()


@suite.row("F1", "opacity correction missing", scene=front_scene(volume(constant(51, (4, 4, 4)))),
           shows="a constant volume with steps of 1, 1/2 and 1/8 voxel",
           invariant="opacity does not depend on the step")
def opacity_correction(row):
    exact = 1 - (1 - 0.2) ** 4
    for name, options in row.methods():
        pixels = [row.middle("--step", step, *options) for step in (1, 0.5, 0.125)]
        row.measure("A differs from 1 - 0.8^4 by", max(abs(p[3] - exact) for p in pixels), at_most=2e-6, case=name)
        row.measure("steps differ by", max(worst([pixels[0]], [p]) for p in pixels), at_most=2e-6, case=name)


suite.main(__name__)
