#!/usr/bin/env python3
"""ShadedVolumeStyle: the lights of ISO/IEC 19775-1 17.2.2 on samples, with normals from gradients."""

import math
import struct

from harness import Suite, blinn_phong, opacity, premultiplied, rotate, unit
from scenes import NO_HEADLIGHT, constant, effect, front_scene, scene, volume
from shading_data import ramp

suite = Suite()

VIEW = (0, 0, 1)  # to the viewer: parallel rays
# Opaque samples of the colour that `tint` says, from the middle of the ray on: there the
# gradient of a ramp is free of the box's borders.
TINT = (0.5, 0.25, 0.75)
INNER = effect(
    """void PLUG_volume_ray(inout float t_enter, inout float t_exit, const in vec3 origin_eye,
                     const in vec3 direction_eye) { t_enter = max(t_enter, 10.0); }
void PLUG_volume_classify(inout vec4 color, const in VolumeSample s) {
  color = vec4(0.5, 0.25, 0.75, 1.0); }"""
)


def light(direction, fields=""):
    return f"DirectionalLight {{ direction {' '.join(map(repr, direction))} {fields} }}\n"


def to_light(direction):
    return unit(tuple(-d for d in direction))


def shaded(slope, style, lights="", around="", navigation=NO_HEADLIGHT):
    content = volume('ImageTexture3D { url "ramp.nrrd" }', style, INNER, "valueRange 0 1")
    before, after = (around + " children [\n", "] }\n") if around else ("", "")
    view = "OrthoViewpoint { position 0 0 10 fieldOfView -1 -1 1 1 }\n"
    text = scene(view, navigation, lights, before, content, after)
    return text, {"ramp.nrrd": ramp(slope)}


def middle(*arguments, **options):
    text, files = shaded(*arguments, **options)
    return suite.middle(text, files=files)


SLOPE = (0.3, -0.4, -0.5)
NORMAL = unit(tuple(-s for s in SLOPE))
PLAIN = "ShadedVolumeStyle { lighting TRUE }"
MATERIAL = ("ShadedVolumeStyle { lighting TRUE material Material { diffuseColor .6 .4 .2 "
            "specularColor .3 .5 .7 shininess .1 ambientIntensity .5 emissiveColor .05 .1 0 "
            "transparency 0 } }")


@suite.case
def diffuse():
    "diffuse light on an oblique ramp; without a material the incoming colour is diffuse"
    for direction in ((0.0, 0.0, -1.0), (1.0, -2.0, -3.0), (-0.3, 0.4, 0.2), (0.0, 1.0, -0.4)):
        got = middle(SLOPE, PLAIN, light(direction))
        expected = blinn_phong(NORMAL, to_light(direction), VIEW, TINT, (0, 0, 0), 1)
        suite.close(f"direction {direction}", got, expected + (1,))


@suite.case
def specular():
    "diffuse, specular and emissive of a Material"
    for direction in ((0.0, 0.0, -1.0), (-1.0, 1.0, -3.0), (-2.0, 2.0, 1.0)):
        got = middle(SLOPE, MATERIAL, light(direction))
        shine = blinn_phong(NORMAL, to_light(direction), VIEW, (0.6, 0.4, 0.2), (0.3, 0.5, 0.7), 12.8)
        expected = [e + s for e, s in zip((0.05, 0.1, 0), shine)]
        suite.close(f"direction {direction}", got, expected + [1])


@suite.case
def several_lights():
    "colours, intensities and ambient parts of several lights add up"
    lights = (light((1.0, -1.0, -2.0), "color 1 .5 .25 intensity .5 ambientIntensity .2")
              + light((-1.0, 0.0, -1.0), "color 0 .5 1 intensity .7 ambientIntensity .1")
              + light((0.0, 0.0, -1.0), "on FALSE"))
    expected = [0.05, 0.1, 0]
    for direction, color, intensity, ambient in (((1, -1, -2), (1, 0.5, 0.25), 0.5, 0.2),
                                                 ((-1, 0, -1), (0, 0.5, 1), 0.7, 0.1)):
        shine = blinn_phong(NORMAL, to_light(direction), VIEW, (0.6, 0.4, 0.2), (0.3, 0.5, 0.7), 12.8)
        for i, diffuse_part in enumerate((0.6, 0.4, 0.2)):
            expected[i] += color[i] * (ambient * 0.5 * diffuse_part + intensity * shine[i])
    suite.close("", middle(SLOPE, MATERIAL, lights), expected + [1])


@suite.case
def headlight():
    "the headlight shines along the view, unless NavigationInfo says no"
    expected = blinn_phong(NORMAL, VIEW, VIEW, TINT, (0, 0, 0), 1)
    suite.close("no NavigationInfo", middle(SLOPE, PLAIN, navigation=""), expected + (1,))
    suite.close("headlight TRUE", middle(SLOPE, PLAIN, navigation="NavigationInfo { }\n"),
                expected + (1,))
    suite.close("headlight FALSE", middle(SLOPE, PLAIN), (0, 0, 0, 1))
    # the viewpoint looks along +x; the ramp is built so that its normal meets it
    text, files = shaded((0.5, 0.2, 0.1), PLAIN, navigation="")
    text = text.replace("position 0 0 10", "position -10 0 0 orientation 0 1 0 -1.5707963267949")
    expected = blinn_phong((-0.5, -0.2, -0.1), (-1, 0, 0), (-1, 0, 0), TINT, (0, 0, 0), 1)
    suite.close("turned viewpoint", suite.middle(text, files=files), expected + (1,))


@suite.case
def constant_region():
    "where the gradient is zero, only ambient and emissive light"
    style = MATERIAL.replace("transparency 0", "transparency .25")
    lights = light((0.0, 0.0, -1.0), "ambientIntensity .4 color 1 .5 1")
    text = front_scene(lights, volume(constant(51, (4, 4, 4)), style))
    rgb = [e + 0.4 * c * 0.5 * d for e, c, d in zip((0.05, 0.1, 0), (1, 0.5, 1), (0.6, 0.4, 0.2))]
    amount = opacity(0.2 * 0.75, 1, 0.25)
    suite.close("material, transparency", suite.middle(text), premultiplied(rgb, amount))
    text = front_scene(lights, volume(constant(51, (4, 4, 4)), PLAIN))
    rgb = [0.4 * c * 0.2 * 0.2 for c in (1, 0.5, 1)]
    suite.close("no material: ambientIntensity 0.2", suite.middle(text),
                premultiplied(rgb, opacity(0.2, 1, 0.25)))


@suite.case
def no_light():
    "without lights only emissive light remains"
    suite.close("material", middle(SLOPE, MATERIAL), (0.05, 0.1, 0, 1))
    suite.close("no material", middle(SLOPE, PLAIN), (0, 0, 0, 1))


@suite.case
def unlit():
    "lighting FALSE changes no colour; transparency counts"
    lights = light((0.0, 0.0, -1.0))
    suite.close("no material", middle(SLOPE, "ShadedVolumeStyle { }", lights), TINT + (1,))
    text = front_scene(lights, volume(
        constant(102, (2, 2, 2)), "ShadedVolumeStyle { material Material { transparency .5 } }"))
    suite.close("transparency", suite.middle(text)[3], opacity(0.4 * 0.5, 1, 0.5))


@suite.case
def transformed_normals():
    "normals are carried by the inverse transpose"
    direction = (1.0, -1.0, -2.0)
    stretch = (2, 1, 0.5)
    got = middle(SLOPE, PLAIN, light(direction), f"Transform {{ scale {' '.join(map(str, stretch))}")
    normal = tuple(n / s for n, s in zip(NORMAL, stretch))
    suite.close("stretched", got,
                blinn_phong(normal, to_light(direction), VIEW, TINT, (0, 0, 0), 1) + (1,))
    axis, angle = (1, 2, 3), 0.8
    got = middle(SLOPE, PLAIN, light(direction), f"Transform {{ rotation 1 2 3 {angle}")
    normal = rotate(axis, angle, NORMAL)
    suite.close("turned", got,
                blinn_phong(normal, to_light(direction), VIEW, TINT, (0, 0, 0), 1) + (1,))
    got = middle(SLOPE, PLAIN, light(direction), "Transform { scale -1 1 1")
    normal = (-NORMAL[0],) + NORMAL[1:]
    suite.close("mirrored", got,
                blinn_phong(normal, to_light(direction), VIEW, TINT, (0, 0, 0), 1) + (1,))


@suite.case
def box_shaped_cells():
    "dimensions stretch the gradient"
    text, files = shaded(SLOPE, PLAIN, light((1.0, -1.0, -2.0)))
    text = text.replace("dimensions 1 1 1", "dimensions 2 1 .5")
    normal = tuple(n / s for n, s in zip(NORMAL, (2, 1, 0.5)))
    expected = blinn_phong(normal, to_light((1, -1, -2)), VIEW, TINT, (0, 0, 0), 1)
    suite.close("", suite.middle(text, files=files), expected + (1,))


@suite.case
def light_in_a_group():
    "a light reaches its group alone, and turns with it; a global one reaches all"
    lit = "Transform {{ rotation 0 1 0 {angle} children [\n{light} {content}] }}\n"
    content = volume('ImageTexture3D { url "ramp.nrrd" }', PLAIN, INNER, "valueRange 0 1")
    files = {"ramp.nrrd": ramp(SLOPE)}
    view = "OrthoViewpoint { position 0 0 10 fieldOfView -1 -1 1 1 }\n"
    angle, direction = 0.5, (1.0, 0.0, -1.0)
    text = scene(view, NO_HEADLIGHT, lit.format(angle=angle, light=light(direction), content=content))
    normal = rotate((0, 1, 0), angle, NORMAL)
    there = rotate((0, 1, 0), angle, to_light(direction))
    suite.close("turned with its group", suite.middle(text, files=files),
                blinn_phong(normal, there, VIEW, TINT, (0, 0, 0), 1) + (1,))
    for fields, expected in (("", (0, 0, 0)),
                             ("global TRUE", blinn_phong(NORMAL, there, VIEW, TINT, (0, 0, 0), 1))):
        text = scene(view, NO_HEADLIGHT,
                     lit.format(angle=angle, light=light(direction, fields), content=""), content)
        suite.close(f"from another group, {fields or 'local'}", suite.middle(text, files=files),
                    tuple(expected) + (1,))


@suite.case
def rgb_gradient():
    "the scalar of colour voxels is the mean of RGB"
    size = 8
    values = []
    for k in range(size):
        for j in range(size):
            for i in range(size):
                values += [i / 20, j / 20, 0.2]
    head = (f"NRRD0004\ntype: float\ndimension: 4\nsizes: 3 {size} {size} {size}\n"
            "kinds: RGB-color domain domain domain\nencoding: raw\nendian: little\n\n")
    text, _ = shaded(SLOPE, PLAIN, light((1.0, 1.0, -1.0)))
    file = head.encode() + struct.pack(f"<{len(values)}f", *values)
    expected = blinn_phong((-1, -1, 0), (-1, -1, 1), VIEW, TINT, (0, 0, 0), 1)
    suite.close("", suite.middle(text, files={"ramp.nrrd": file}), expected + (1,))


@suite.case
def point_and_spot():
    "point and spot lights on samples: distance, radius, cone"
    files = {"ramp.nrrd": ramp((0, 0, -0.5))}
    text, _ = shaded((0, 0, -0.5), PLAIN)  # normal +z at the point (0, 0, -first step / 2)
    # the first sample lies half a step, 1/4 voxel, behind z = 0
    at = -0.25 / 8
    for node, expected in (
        ("PointLight { location 0 0 2 attenuation 0 1 0 }", 1 / (2 - at)),
        ("PointLight { location 0 3 4 attenuation 0 0 1 }",
         (4 - at) / math.hypot(3, 4 - at) / (9 + (4 - at) ** 2)),
        ("PointLight { location 0 0 2 radius 1 }", 0),
        ("SpotLight { location 0 0 2 direction 0 0 -1 cutOffAngle .5 beamWidth .4 }", 1),
        ("SpotLight { location 0 0 2 direction 1 0 -1 cutOffAngle .5 beamWidth .4 }", 0),
    ):
        lit = text.replace(NO_HEADLIGHT, NO_HEADLIGHT + node + "\n")
        got = suite.middle(lit, files=files)
        suite.close(node, got, [expected * t for t in TINT] + [1])


suite.run()
