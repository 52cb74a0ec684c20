#!/usr/bin/env python3
"""EdgeEnhancementVolumeStyle, CartoonVolumeStyle and ToneMappedVolumeStyle: colours by direction."""

import math
import struct

from harness import Suite, dot
from scenes import NO_HEADLIGHT, constant, effect, scene, volume
from style_data import (OPACITY, SLOPE, TINT, VIEW, Styles, cartoon, composed, edge, normal_of,
                        tone)

suite = Suite()


def seen_under(angle):
    """A slope whose normal is turned away from the viewer by an angle."""
    return (round(0.3 * math.sin(angle), 6), round(-0.2 * math.sin(angle), 6),
            round(-0.36055513 * math.cos(angle), 6))


def angle_of(slope):
    return math.acos(dot(normal_of(slope), VIEW))


@suite.case
def edge_fields():
    "Edge: beyond the threshold Cg = Cv |n.V| + edgeColor (1 - |n.V|); the opacity stays"
    styles = Styles(suite)
    facing = dot(normal_of(SLOPE), VIEW)
    for fields, values in (
        ("", {}),
        ("edgeColor 1 0 0 1", {"edge_color": (1, 0, 0)}),
        ("edgeColor 0 .5 1 .2", {"edge_color": (0, 0.5, 1)}),
        ("gradientThreshold 1.1", {"threshold": 1.1}),
        ("gradientThreshold 1.2", {"threshold": 1.2}),
        ("gradientThreshold 0", {"threshold": 0}),
    ):
        styles.add(fields or "defaults", f"EdgeEnhancementVolumeStyle {{ {fields} }}",
                   edge(TINT, facing, **values), OPACITY)
    angle = angle_of(SLOPE)
    suite.check("the angle lies between 1.1 and 1.2", 1.1 < angle < 1.2, angle)
    for weight in (0.25, 1):
        full = edge(TINT, facing, edge_color=(1, 0, 0))
        styles.add(f"contribution {weight}, as in 2005",
                   f"EdgeEnhancementVolumeStyle {{ edgeColor 1 0 0 1 contribution {weight} }}",
                   [t + weight * (c - t) for t, c in zip(TINT, full)], OPACITY)
    styles.draw()


@suite.case
def edge_directions():
    "Edge: backs are as faces; a surface seen at a right angle is not changed"
    styles = Styles(suite)
    for slope in ((0, 0, -0.5), (0.5, 0, 0), (0.1, 0.1, 0.3), (0.2, 0, -0.4), (-0.3, 0.4, 0.1)):
        styles.add(f"slope {slope}", "EdgeEnhancementVolumeStyle { edgeColor 0 1 0 1 }",
                   edge(TINT, dot(normal_of(slope), VIEW), (0, 1, 0)), OPACITY, slope=slope)
    styles.draw()


@suite.case
def cartoon_bins():
    "Cartoon: equal angles; the ends have their colours exactly, the others that of their middle"
    styles = Styles(suite)
    for degrees in (5, 20, 24, 40, 50, 66, 69, 85, 95):
        slope = seen_under(math.radians(degrees))
        *rgb, alpha = cartoon(angle_of(slope))
        styles.add(f"{degrees} degrees", "CartoonVolumeStyle { }", rgb, OPACITY * alpha, slope=slope)
    styles.draw()
    for name, degrees, grey in (("1", 10, 1), (".625", 30, 0.625), (".375", 60, 0.375), ("0", 80, 0)):
        suite.close(f"the specification's {name}", cartoon(math.radians(degrees)), (grey,) * 3 + (1,), 1e-9)


@suite.case
def cartoon_steps():
    "Cartoon: colorSteps"
    styles = Styles(suite)
    slope = seen_under(math.radians(50))
    for steps in (1, 2, 3, 5, 9, 64):
        *rgb, alpha = cartoon(angle_of(slope), steps)
        styles.add(f"{steps} steps", f"CartoonVolumeStyle {{ colorSteps {steps} }}", rgb,
                   OPACITY * alpha, slope=slope)
    for degrees in (1, 89):
        slope = seen_under(math.radians(degrees))
        *rgb, alpha = cartoon(angle_of(slope), 1, (0.2, 0.4, 0.6, 1))
        styles.add(f"one step, {degrees} degrees",
                   "CartoonVolumeStyle { colorSteps 1 orthogonalColor .2 .4 .6 1 }", rgb,
                   OPACITY * alpha, slope=slope)
    styles.draw()


@suite.case
def cartoon_colors():
    "Cartoon: hues go the shorter way round, a grey takes the other's; alpha is linear"
    styles = Styles(suite)
    slope = seen_under(math.radians(40))
    for name, orthogonal, parallel in (
        ("red to green", (1, 0, 0, 1), (0, 1, 0, 1)),
        ("red to violet, through 0", (1, 0, 0, 1), (0.5, 0, 1, 1)),
        ("violet to orange, through 1", (0.6, 0, 1, 1), (1, 0.5, 0, 1)),
        ("white to blue", (1, 1, 1, 1), (0, 0, 1, 1)),
        ("green to grey", (0.1, 0.8, 0.3, 1), (0.4, 0.4, 0.4, 1)),
        ("alpha", (0.2, 0.3, 0.4, 0.9), (0.5, 0.3, 0.1, 0.1)),
        ("opaque to clear", (1, 1, 0, 1), (0, 1, 1, 0)),
    ):
        colors = " ".join(f"{f} {' '.join(map(str, c))}" for f, c in
                          (("orthogonalColor", orthogonal), ("parallelColor", parallel)))
        *rgb, alpha = cartoon(angle_of(slope), 4, orthogonal, parallel)
        styles.add(name, f"CartoonVolumeStyle {{ {colors} }}", rgb, OPACITY * alpha, slope=slope)
    styles.draw()


def ball(size=24):
    """Distance from the middle, 1 there and 0 at the sides of the box."""
    def value(*index):
        return max(0.0, 1 - math.sqrt(sum(((i + 0.5) / size * 2 - 1) ** 2 for i in index)))

    values = [value(i, j, k) for k in range(size) for j in range(size) for i in range(size)]
    head = (f"NRRD0004\ntype: float\ndimension: 3\nsizes: {size} {size} {size}\n"
            "encoding: raw\nendian: little\n\n")
    return head.encode() + struct.pack(f"<{len(values)}f", *values)


@suite.case
def cartoon_rings():
    "T5: rings on a ball, at r = sin(k pi / 8); the colour of the middle is orthogonalColor"
    radius, width = 0.4, 192
    opaque = effect("void PLUG_volume_classify(inout vec4 color, const in VolumeSample s) "
                    f"{{ color = vec4(length(s.position - 0.5) < {radius} ? 1.0 : 0.0); }}")
    text = scene("OrthoViewpoint { position 0 0 10 fieldOfView -.5 -.0078125 .5 .0078125 }\n", NO_HEADLIGHT,
                 volume('ImageTexture3D { url "ball.nrrd" }', "CartoonVolumeStyle "
                        "{ orthogonalColor 1 0 0 1 parallelColor 0 0 1 1 }", opaque, "valueRange 0 1"))
    picture = suite.picture(text, "--step", ".1", size=f"{width}x3", files={"ball.nrrd": ball()})
    colors = [cartoon((k + 0.5) * math.pi / 8, 4, (1, 0, 0, 1), (0, 0, 1, 1))[:3] for k in range(4)]
    bins = []
    for x in range(width // 2, width):
        pixel = picture.at(x, 1)
        bins += [k for k in range(4) if all(abs(a - b) < 2e-3 for a, b in zip(pixel, colors[k] + (1,)))]
    suite.equal("four colours, in their order", bins, sorted(bins))
    ends = [(len(bins) - bins[::-1].index(k) if k in bins else 0) / width / radius for k in range(4)]
    suite.close("radii", ends, [math.sin(k * math.pi / 8) for k in (1, 2, 3, 4)], 0.02)


def directional(direction, fields=""):
    return f"DirectionalLight {{ direction {' '.join(map(str, direction))} {fields} }}\n"


def away(direction):
    return tuple(-d for d in direction)


@suite.case
def tone_fields():
    "ToneMapped: warm towards the light, cool away from it, the opacity stays"
    styles = Styles(suite)
    normal = normal_of(SLOPE)
    side = (1, -2, -3)
    for name, fields, values in (
        ("defaults", "", {}),
        ("warmColor", "warmColor .9 .5 .1 1", {"warm": (0.9, 0.5, 0.1)}),
        ("coolColor", "coolColor .1 .2 .6 .3", {"cool": (0.1, 0.2, 0.6)}),
        ("both", "coolColor 0 1 1 0 warmColor 1 0 0 .5", {"cool": (0, 1, 1), "warm": (1, 0, 0)}),
    ):
        styles.add(name, f"ToneMappedVolumeStyle {{ {fields} }}", tone(normal, [away(side)], **values),
                   OPACITY, lights=directional(side))
    styles.draw()


@suite.case
def tone_lights():
    "T6: by the directions of the lights alone, summed unclamped; without light nothing changes"
    styles = Styles(suite)
    normal = normal_of(SLOPE)
    half = "ToneMappedVolumeStyle { coolColor 0 .1 .3 0 warmColor .5 .3 0 0 }"
    colors = {"cool": (0, 0.1, 0.3), "warm": (0.5, 0.3, 0)}

    def add(name, lights, directions, style=half, **values):
        styles.add(name, style, tone(normal, directions, **(values or colors)), OPACITY, lights=lights)

    add("from where the surface looks", directional(away(normal)), [normal])
    add("from behind", directional(normal), [away(normal)])
    a, b = (1, -2, -3), (-1, 0.5, 0.2)
    add("two lights", directional(a) + directional(b), [away(a), away(b)])
    add("colour, intensity and ambient light do not enter",
        directional(a, "color 1 0 0 intensity .3 ambientIntensity .5"), [away(a)])
    place = (0.375 - 0.5 + 0.2, 0.625 - 0.5 + 3, 4)  # the pixel of a cell looks at (-1/8, 1/8, 0)
    add("a point light, far out of its radius",
        f"PointLight {{ location {place[0]} {place[1]} 4 radius .1 attenuation 1 2 3 global FALSE }}\n",
        [(0.2, 3, 4)])
    add("outside the cone of a spot light",
        f"SpotLight {{ location {place[0]} {place[1]} 4 direction 0 0 1 cutOffAngle .1 global FALSE }}\n",
        [(0.2, 3, 4)])
    styles.add("no light", half, TINT, OPACITY)
    styles.add("a light that is off", half, TINT, OPACITY, lights=directional(a, "on FALSE"))
    styles.draw(tolerance=1e-3)


@suite.case
def tone_beyond_one():
    "ToneMapped: two lights on one side of 1, with a style behind that sees the sum"
    white = "ToneMappedVolumeStyle { coolColor .9 .9 .9 0 warmColor .9 .9 .9 0 }"
    styles = Styles(suite)
    lights = directional((0, 0, -1)) + directional((1, 0, 0))
    facing = dot(normal_of(SLOPE), VIEW)
    styles.add("", composed(white, "EdgeEnhancementVolumeStyle { }"),
               [min(c, 1) for c in edge((1.8, 1.8, 1.8), facing)], OPACITY, lights=lights)
    styles.draw()


@suite.case
def no_gradient():
    "T18: where the gradient is zero Edge, Cartoon and ToneMapped change nothing"
    styles = Styles(suite)
    flat = constant(77, (8, 8, 8))
    for style in ("EdgeEnhancementVolumeStyle { edgeColor 1 0 0 1 }",
                  "CartoonVolumeStyle { orthogonalColor 1 0 0 1 parallelColor 0 1 0 1 }",
                  "ToneMappedVolumeStyle { }"):
        styles.add(style.split()[0], style, TINT, OPACITY, data=flat, lights=directional((0, 0, -1)))
    styles.draw()


suite.run()
