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


@suite.case
def degrees():
    "angles in the unit of their file, without a warning about their range"
    head = "#X3D V4.0 utf8\nPROFILE Immersive\n"
    unit_line = "UNIT angle degree 0.017453292519943295\n"
    box = volume(constant(51, (4, 4, 4)), dimensions=(1, 1, 3))
    pixels = [(3, 8), (8, 8), (13, 4)]
    probes = [word for x, y in pixels for word in ("--probe", f"{x},{y}")]

    def body(view, turn):
        return (f"Viewpoint {{ position 0 0 3 fieldOfView {view} }}\n"
                f"Transform {{ rotation 0 1 0 {turn} children [\n{box}] }}\n")

    wanted = suite.probe(head + body(0.52359878, 0.6981317), pixels)
    inline = "Viewpoint { position 0 0 3 fieldOfView 0.52359878 }\nInline { url \"part.x3dv\" }\n"
    degree = head + unit_line + body(30, 40)
    for name, text in (("in the scene", degree), ("inlined", head + inline)):
        result = suite.render(text, *probes, files={"part.x3dv": degree})
        suite.equal(f"{name}, messages", result.messages(), [])
        suite.close(name, [float(word) for word in result.output.split()], sum(wanted, ()), 1e-5)
    front = front_scene(box)
    with_unit = head + unit_line + front.removeprefix(head)
    suite.close("an OrthoViewpoint's fieldOfView is no angle", suite.middle(with_unit),
                suite.middle(front), 1e-6)


@suite.case
def missing_function():
    "without the file of its transfer function a volume has the default ramp"
    for node in ("ImageTexture", "ImageTexture3D"):
        style = f'OpacityMapVolumeStyle {{ transferFunction {node} {{ url "no.png" }} }}'
        text = front_scene(volume(constant(51), style))
        result = suite.render(text, "--probe", "8,8", status=1)
        suite.equal(f"{node}, messages", [m[5] for m in result.messages()], ["missing-file"])
        suite.close(node, [float(word) for word in result.output.split()],
                    premultiplied((0.2,) * 3, 0.2))


@suite.case
def refused_pixels():
    "a mistake in an image is told once"
    for node in ("PixelTexture3D { image [1 2 2 2 1 2] }", "PixelTexture3D { image [1 1 1] }",
                 "PixelTexture3D { image [1 1 1 1 256 what] }"):
        result = suite.render(front_scene(volume(node)), "--probe", "8,8", status=1)
        suite.equal(node, [m[5] for m in result.messages()], ["bad-value"])


suite.run()
