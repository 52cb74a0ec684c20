#!/usr/bin/env python3
"""Opacity along rays through constant volumes: 1 - (1 - alpha)^(length / reference length)."""

import math

from harness import Suite, box_interval, opacity, premultiplied, rotate
from scenes import constant, front_scene, scene, volume

suite = Suite()


def grey(alpha):
    """A bare volume of value v has colour (v, v, v)."""

    def color(value):
        return premultiplied((value, value, value), alpha)

    return color


@suite.case
def steps():
    "T1: a constant volume is as opaque for any step"
    for value in (1, 51, 128, 254):
        text = front_scene(volume(constant(value, (4, 4, 4))))
        expected = grey(opacity(value / 255, 1, 1 / 4))(value / 255)
        for step in (None, 4, 1, 0.37, 0.11):
            arguments = ["--step", step] if step else []
            # rays end where less than 1/8 of 1/255 would shine through
            tolerance = 6e-4 if value == 254 else 1e-4
            got = suite.middle(text, *arguments)
            suite.close(f"value {value}, step {step}", got, expected, tolerance)


@suite.case
def ends():
    "a ray ends where what is left is below an eighth of the error that is asked for"
    white = "OpacityMapVolumeStyle { transferFunction PixelTexture { image 2 1 4 0xFFFFFF80 0xFFFFFF80 } }"
    text = front_scene(volume(constant(9, (32, 32, 32)), white))
    for error in ("1/16", "1/255", "1/4095", "0.000001"):
        over, _, under = error.partition("/")
        most = float(over) / float(under or 1) / 8
        got = suite.middle(text, "--error", error)[0]
        suite.check(f"error {error}", 1 - most - 1e-7 <= got <= 1, got)


@suite.case
def opaque_at_first_touch():
    "a voxel of full opacity hides what is behind it, however short the step"
    for step in (2, 0.5, 0.01):
        text = front_scene(volume(constant(255, (2, 2, 2))))
        suite.close(f"step {step}", suite.middle(text, "--step", step), (1, 1, 1, 1), 1e-6)


@suite.case
def empty():
    "value 0 is empty space"
    text = front_scene(volume(constant(0, (2, 2, 2))))
    suite.close("", suite.middle(text), (0, 0, 0, 0), 0)


@suite.case
def thin_fog():
    "T2: 1/255 in each of 1000 reference lengths"
    text = front_scene(
        "Transform { translation 0 0 -600 children [\n",
        volume(constant(1, (1, 1, 1000)), dimensions=(1, 1, 1000)),
        "] }\n",
    )
    for step in (2, 1, 0.25):
        pixel = suite.middle(text, "--step", step)
        suite.close(f"step {step}", pixel[3], 1 - (254 / 255) ** 1000, 1e-3)


VIEWS = (  # axis, angle, the axis of the volume along the ray
    ((0, 0, 1), 0.0, 2),
    ((0, 1, 0), math.pi / 2, 0),
    ((1, 0, 0), math.pi / 2, 1),
)


def turned(axis, angle, content):
    return (
        f"Transform {{ rotation {axis[0]} {axis[1]} {axis[2]} {angle!r} children [\n{content}] }}\n"
    )


@suite.case
def box_shaped_cells():
    "the reference length is the geometric mean of a voxel's sides, along each axis"
    dimensions = (1, 2, 4)
    data = constant(51, (4, 2, 8))  # cells of 1/4 x 1 x 1/2: reference 1/2
    view = "OrthoViewpoint { position 0 0 10 fieldOfView -3 -3 3 3 }\n"
    for axis, angle, along in VIEWS:
        text = scene(view, turned(axis, angle, volume(data, dimensions=dimensions)))
        expected = grey(opacity(0.2, dimensions[along], 0.5))(0.2)
        suite.close(f"axis {along}", suite.middle(text), expected)


@suite.case
def diagonals():
    "the length of an oblique ray is measured in the volume's own coordinates"
    dimensions = (1, 2, 4)
    view = "OrthoViewpoint { position 0 0 10 fieldOfView -1 -1 1 1 }\n"
    for axis, angle in (((1, 1, 0), 0.9), ((3, -1, 2), 2.1), ((0, 1, 1), -0.7)):
        text = scene(view, turned(axis, angle, volume(constant(51, (4, 2, 8)), dimensions=dimensions)))
        direction = rotate(axis, -angle, (0, 0, -1))
        enter, leave = box_interval(rotate(axis, -angle, (0, 0, 10)), direction, dimensions)
        expected = grey(opacity(0.2, leave - enter, 0.5))(0.2)
        suite.close(f"{axis} {angle}", suite.middle(text), expected)


@suite.case
def unit_distance():
    "opacityUnitDistance sets the reference length"
    data = constant(102, (4, 4, 4))
    for reference in (0.1, 1, 3):
        text = front_scene(volume(data, fields=f"opacityUnitDistance {reference}"))
        expected = grey(opacity(0.4, 1, reference))(0.4)
        suite.close(f"{reference}", suite.middle(text), expected)


@suite.case
def transforms():
    "a Transform changes shape, never opacity"
    content = volume(constant(51, (4, 4, 4)))
    for scale in ("3 3 3", "1 1 5", "0.01 2 0.3", "-1 1 1", "-1 -2 -.5"):
        text = front_scene(f"Transform {{ scale {scale} children [\n{content}] }}\n")
        suite.close(f"scale {scale}", suite.middle(text), grey(opacity(0.2, 1, 0.25))(0.2))


@suite.case
def sheared():
    "shear, by a turned box in a stretched group"
    angle, stretch = 0.5, (1, 1, 3)
    content = turned((0, 1, 0), angle, volume(constant(51, (4, 4, 4))))
    text = front_scene(
        f"Transform {{ scale {stretch[0]} {stretch[1]} {stretch[2]} children [\n{content}] }}\n"
    )
    # the ray z in the group's coordinates, then turned back; its length there is stretched
    direction = rotate((0, 1, 0), -angle, (0, 0, -1))
    enter, leave = box_interval(rotate((0, 1, 0), -angle, (0, 0, 10)), direction)
    suite.close("", suite.middle(text), grey(opacity(0.2, leave - enter, 0.25))(0.2))


def perspective_ray(x, y, size, angle=math.pi / 4):
    """Direction of length 1 through the centre of a pixel of a square picture."""
    half = math.tan(angle / 2)
    v = (((x + 0.5) / size * 2 - 1) * half, (1 - (y + 0.5) / size * 2) * half, -1.0)
    length = math.sqrt(sum(c * c for c in v))
    return tuple(c / length for c in v)


PIXELS = [(8, 8), (0, 0), (5, 11), (16, 3), (2, 9)]


@suite.case
def perspective():
    "perspective rays have the length of their chord"
    content = volume(constant(51, (4, 4, 4)))
    text = scene("Viewpoint { position 0 0 1.9 }\n", content)
    for pixel, color in zip(PIXELS, suite.probe(text, PIXELS, size="17x17")):
        enter, leave = box_interval((0, 0, 1.9), perspective_ray(*pixel, 17))
        expected = grey(opacity(0.2, leave - enter, 0.25))(0.2)
        suite.close(f"pixel {pixel}", color, expected)


@suite.case
def field_of_view():
    "fieldOfView is the angle of the shorter side"
    content = volume(constant(51, (4, 4, 4)))
    text = scene("Viewpoint { position 0 0 3 fieldOfView 0.5 }\n", content)
    half = math.tan(0.25)
    for x, y in ((30, 0), (20, 15), (10, 5)):
        v = (((x + 0.5) / 16 - 2) * half, (1 - (y + 0.5) / 8) * half, -1.0)
        length = math.sqrt(sum(c * c for c in v))
        enter, leave = box_interval((0, 0, 3), tuple(c / length for c in v))
        color = suite.probe(text, [(x, y)], size="64x16")[0]
        suite.close(f"pixel {x},{y}", color, grey(opacity(0.2, leave - enter, 0.25))(0.2))


@suite.case
def inside():
    "from inside, the ray starts at the eye"
    content = volume(constant(51, (4, 4, 4)))
    for position, axis, angle in (
        ((0, 0, 0), (0, 0, 1), 0.0),
        ((0.2, 0.1, -0.4), (0, 1, 0), math.pi),
        ((0, 0.3, 0.3), (1, 0, 0), 0.6),
    ):
        text = scene(
            f"Viewpoint {{ position {' '.join(map(str, position))} "
            f"orientation {' '.join(map(str, axis))} {angle!r} }}\n",
            content,
        )
        for pixel, color in zip(PIXELS, suite.probe(text, PIXELS, size="17x17")):
            ray = rotate(axis, angle, perspective_ray(*pixel, 17))
            enter, leave = box_interval(position, ray)
            expected = grey(opacity(0.2, leave - enter, 0.25))(0.2)
            suite.close(f"at {position}, pixel {pixel}", color, expected)


@suite.case
def near_and_far():
    "nearDistance and farDistance cut by planes, where they are given"
    content = volume(constant(51, (4, 4, 4)))
    for fields, near, far in (
        ("nearDistance 1.7", 1.7, math.inf),
        ("farDistance 2.2", 0, 2.2),
        ("nearDistance 1.6 farDistance 1.9", 1.6, 1.9),
    ):
        text = scene(f"Viewpoint {{ position 0 0 2 {fields} }}\n", content)
        for pixel, color in zip(PIXELS, suite.probe(text, PIXELS, size="17x17")):
            ray = perspective_ray(*pixel, 17)
            enter, leave = box_interval((0, 0, 2), ray)
            length = max(0, min(leave, far / -ray[2]) - max(enter, near / -ray[2]))
            expected = grey(opacity(0.2, length, 0.25))(0.2)
            suite.close(f"{fields}, pixel {pixel}", color, expected)


@suite.case
def moved_viewpoint():
    "a viewpoint in transformed groups sees what it should"
    axis, angle = (1, 2, -1), 0.8
    content = volume(constant(51, (4, 4, 4)))
    text = scene(
        "Transform { translation 4 5 6 children [\n",
        turned(axis, angle, "Viewpoint { position 0 0 2 }\n" + content),
        "] }\n",
    )
    for pixel, color in zip(PIXELS, suite.probe(text, PIXELS, size="17x17")):
        enter, leave = box_interval((0, 0, 2), perspective_ray(*pixel, 17))
        expected = grey(opacity(0.2, leave - enter, 0.25))(0.2)
        suite.close(f"pixel {pixel}", color, expected)


@suite.case
def chosen_viewpoint():
    "--viewpoint takes a number, a DEF name or a description; else the first counts"
    content = volume(constant(255))
    text = scene(
        "Viewpoint { position 9 0 2 }\nDEF Two Viewpoint { position 0 0 2 }\n"
        'Viewpoint { position 0 9 2 description "above" }\n',
        content,
    )
    for arguments, hit in (((), 0), (("--viewpoint", "2"), 1), (("--viewpoint", "Two"), 1),
                           (("--viewpoint", "above"), 0)):
        suite.close(f"{arguments}", suite.middle(text, *arguments)[3], hit)


@suite.case
def far_away_and_tiny():
    "far from the origin and at tiny scale nothing changes"
    content = volume(constant(51, (4, 4, 4)))
    for offset, scale in ((1e4, 1.0), (0.0, 1e-3), (-3e5, 1e3)):
        text = scene(
            f"OrthoViewpoint {{ position {offset} {offset} {offset + 10 * scale} "
            f"fieldOfView {-scale} {-scale} {scale} {scale} }}\n",
            f"Transform {{ translation {offset} {offset} {offset} scale {scale} {scale} {scale} "
            f"children [\n{content}] }}\n",
        )
        suite.close(f"at {offset}, scale {scale}", suite.middle(text),
                    grey(opacity(0.2, 1, 0.25))(0.2), 1e-3)


@suite.case
def nothing_to_see():
    "rays past the box and volumes that are not visible stay empty"
    content = volume(constant(255))
    for pixel in ((1, 8), (8, 15), (3, 3)):
        suite.close(f"beside, pixel {pixel}", suite.probe(front_scene(content), [pixel])[0],
                    (0, 0, 0, 0), 0)
    hidden = volume(constant(255), fields="visible FALSE")
    suite.close("visible FALSE", suite.middle(front_scene(hidden)), (0, 0, 0, 0), 0)
    bare = front_scene("VolumeData { }\n")
    suite.close("without voxels", suite.middle(bare), (0, 0, 0, 0), 0)


@suite.case
def edges_of_the_box():
    "the box covers exactly the pixels that it should"
    picture = suite.picture(front_scene(volume(constant(255))), size="32x32")
    inside_box = [
        (x, y) for y in range(32) for x in range(32) if picture.at(x, y) == (1.0, 1.0, 1.0, 1.0)
    ]
    suite.equal("", inside_box, [(x, y) for y in range(8, 24) for x in range(8, 24)])


@suite.case
def samples():
    "--samples averages within a pixel"
    # the box covers a quarter of a pixel that is as wide as two boxes each way
    text = scene("OrthoViewpoint { position 0 0 10 fieldOfView -1 -1 1 1 }\n",
                 volume(constant(255)))
    pixel = suite.probe(text, [(0, 0)], "--samples", "256", size="1x1")[0]
    suite.close("a quarter is covered", pixel, (0.25,) * 4, 0.02)


suite.run()
