#!/usr/bin/env python3
"""--error E where no bound of the error is known: what pilot drawings say of it is not below the truth."""

import os
import sys

sys.path.insert(1, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "reference"))
import reference
from scenes import constant, scene
from pilot_data import FRONT, PIXELS, SCENES, SIDE, check_estimate, hills, known, suite, volume


@suite.case
def estimates():
    "what is said of the error is not below the true one"
    for name in SCENES:
        check_estimate(name, 1 / 64)


@suite.case
def of_the_integral():
    "against the double-precision raycaster: samples in the middle of steps"
    reference.beside(suite.program)
    numbers = bytes(round(255 * min(max(hills(*((2 * n + 1) / SIDE - 1 for n in (i, j, k))), 0), 1))
                    for k in range(SIDE) for j in range(SIDE) for i in range(SIDE))
    colors = [(0, 0, 0, 0), (0.2, 0.4, 0.6, 0.2), (0.8, 0.4, 0.2, 0.6), (0, 0.8, 0.6, 0.2)]
    image = " ".join("0x" + "".join(f"{round(255 * c):02x}" for c in color) for color in colors)
    SCENES["midpoint"] = (FRONT, "Transform { rotation 0.6 0.8 0 0.7 children ", volume(
        style=f"OpacityMapVolumeStyle {{ transferFunction PixelTexture {{ image 4 1 4 {image} }} }}"), "}")
    known["midpoint"] = list(reference.truth(
        [reference.volume((SIDE, SIDE, SIDE), numbers, transfer=reference.texels(colors),
                          matrix=reference.turned((0.6, 0.8, 0, 0.7)))],
        reference.camera(position=(0, 0, 10), fieldOfView=(-0.6, -0.6, 0.6, 0.6)), (PIXELS, PIXELS))[0].data)
    for error in (1 / 32, 1 / 255, 1 / 1023):
        check_estimate("midpoint", error, "--method", "midpoint", slack=0)
    check_estimate("midpoint", 1 / 255, "--method", "preintegrated", slack=0)


@suite.case
def within_opaque_values():
    "where a ray begins amid opaque values, their own colour is seen, not that of the first opaque one"
    image = "0xff000000 0xff0000ff 0x00ff00ff 0x0000ffff 0x0000ff00"
    style = f"OpacityMapVolumeStyle {{ transferFunction PixelTexture {{ image 5 1 4 {image} }} }}"
    for value in (128, 160):
        blue = value / 255 * 4 - 2
        color = (0, 1 - blue, blue, 1)
        for method in ("midpoint", "preintegrated", "cells"):
            got = suite.middle(scene(FRONT, volume(constant(value, (2, 2, 2)), style)), "--error", "1/255",
                               "--method", method)
            suite.close(f"{method}, {value}", got, color, 1e-4)


suite.run()
