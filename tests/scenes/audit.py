#!/usr/bin/env python3
"""Numbers at their limits: many tiny steps, odd sizes, turned and stretched groups."""

import math

from harness import Suite, opacity, premultiplied, rotate, unit
from scenes import constant, front_scene, scene, volume

suite = Suite()


@suite.case
def tiny_steps():
    "opacities of very short steps keep their digits"
    for value in (1, 3, 51):
        text = front_scene(volume(constant(value, (8, 8, 8))))
        alpha = opacity(value / 255, 1, 1 / 8)
        for step in ("0.0156", "0.0039"):
            suite.close(f"value {value}, step {step}", suite.middle(text, "--step", step),
                        premultiplied((value / 255,) * 3, alpha), 5e-6)


def sky(direction):
    """Red, green and blue at 0, 1 and 2 from the zenith."""
    angle = math.acos(unit(direction)[1])
    if angle < 1:
        return (1 - angle, angle, 0, 1)
    return (0, 2 - angle, angle - 1, 1) if angle < 2 else (0, 0, 1, 1)


@suite.case
def background_in_groups():
    "a background takes the turns of the groups around it, neither scales nor places"
    node = "Background { skyColor [1 0 0, 0 1 0, 0 0 1] skyAngle [1 2] }"
    pixels = [(8, 0), (8, 4), (8, 8), (8, 16), (0, 0), (16, 16)]
    axis, angle = (1, 2, 3), 0.7
    for fields, turn in (
        ("", 0.0),
        ("rotation 1 2 3 0.7", -angle),
        ("scale 1 5 1 translation 3 4 5", 0.0),
        ("scale 1 5 .2 rotation 1 2 3 0.7", -angle),
    ):
        text = scene("Viewpoint { fieldOfView 1.5707963 }\n",
                     f"Transform {{ {fields} children [ {node} ] }}\n")
        for pixel, color in zip(pixels, suite.probe(text, pixels, size="17x17")):
            ray = ((pixel[0] + 0.5) / 8.5 - 1, 1 - (pixel[1] + 0.5) / 8.5, -1.0)
            suite.close(f"{fields}, pixel {pixel}", color, sky(rotate(axis, turn, ray)), 1e-5)


suite.run()
