#!/usr/bin/env python3
"""Several volumes: apart, half overlapping, in the same box, in any order."""

import math

from harness import Suite, over, premultiplied
from scenes import constant, effect, front_scene, quad, scene, volume, voxels

suite = Suite()


def opacity_map(rgba):
    return (f"OpacityMapVolumeStyle {{ transferFunction PixelTexture "
            f"{{ image 1 1 4 0x{rgba:08X} }} }}")


class Fog:
    """A box of one colour; `unit`: the length after which its alpha is reached."""

    def __init__(self, rgba, z=0.0, unit=1.0, size=4, dimensions=(1, 1, 1)):
        self.rgb = tuple((rgba >> shift & 255) / 255 for shift in (24, 16, 8))
        self.alpha = (rgba & 255) / 255
        self.extinction = -math.log(1 - self.alpha) / unit if self.alpha < 1 else math.inf
        self.near, self.far = z + dimensions[2] / 2, z - dimensions[2] / 2
        self.text = (
            f"Transform {{ translation 0 0 {z} children [\n"
            + volume(constant(128, (size,) * 3), opacity_map(rgba), dimensions=dimensions,
                     fields=f"opacityUnitDistance {unit}") + "] }\n")


def expected(fogs):
    """Segments between entries and exits; in each, extinctions add and colours mix by them."""
    cuts = sorted({f.near for f in fogs} | {f.far for f in fogs}, reverse=True)
    result = (0, 0, 0, 0)
    for near, far in zip(cuts, cuts[1:]):
        here = [f for f in fogs if f.near >= near and f.far <= far]
        if not here:
            continue
        opaque = [f for f in here if f.alpha >= 1]
        if opaque:
            color = [sum(f.rgb[i] for f in opaque) / len(opaque) for i in range(3)]
            return over(result, tuple(color) + (1,))
        total = sum(f.extinction for f in here)
        color = [sum(f.rgb[i] * f.extinction for f in here) / total for i in range(3)]
        result = over(result, premultiplied(color, 1 - math.exp(-total * (near - far))))
    return result


def both_orders(name, *fogs, tolerance=2e-4, arguments=()):
    want = expected(fogs)
    for label, order in (("", fogs), (", listed the other way round", fogs[::-1])):
        got = suite.middle(front_scene(*(f.text for f in order)), *arguments)
        suite.close(name + label, got, want, tolerance)


@suite.case
def apart():
    "volumes one behind the other are met in order along the ray"
    both_orders("two", Fog(0xFF0000A0, z=1), Fog(0x0000FFC0, z=-1))
    both_orders("touching", Fog(0xFF0000A0, z=0.5), Fog(0x0000FFC0, z=-0.5))
    both_orders("three", Fog(0xFF0000A0, z=2), Fog(0x00FF00C0), Fog(0x0000FFC0, z=-2))


@suite.case
def half_overlapping():
    "three parts: one volume, both, the other"
    both_orders("", Fog(0xFF0000A0, z=0.25), Fog(0x0000FFC0, z=-0.25))
    both_orders("units of length of their own", Fog(0xFF8000A0, z=0.25, unit=0.5),
                Fog(0x0080FFC0, z=-0.25, unit=2, dimensions=(1, 1, 1.5)))


@suite.case
def same_box():
    "in the same box colours mix by extinction, for any step"
    fogs = Fog(0xFF0000E0), Fog(0x00FF80B0, unit=0.3)
    for step in (2, 0.5, 0.1):
        both_orders(f"step {step}", *fogs, arguments=("--step", step))


@suite.case
def own_steps():
    "volumes of different resolution"
    both_orders("", Fog(0xFF0000E0, size=2), Fog(0x00FF80B0, unit=0.3, size=16))


@suite.case
def opaque_samples():
    "opaque samples hide translucent ones and are averaged"
    both_orders("one opaque", Fog(0xFF0000FF), Fog(0x00FF8080))
    both_orders("two opaque", Fog(0xFF0000FF), Fog(0x00FF80FF))
    both_orders("opaque behind", Fog(0xFF0000FF, z=-0.5), Fog(0x00FF8080, z=0.5))


@suite.case
def same_node_twice():
    "one volume node used twice"
    fog = Fog(0x3366CC90)
    first = fog.text.replace("VolumeData", "DEF V VolumeData")
    second = "Transform { translation 0 0 -1.5 children [ USE V ] }\n"
    got = suite.middle(front_scene(first, second))
    suite.close("", got, over(expected([fog]), expected([fog])), 2e-4)


@suite.case
def own_effects():
    "each volume has its own effects"
    red = effect("void PLUG_volume_classify(inout vec4 color, const in VolumeSample s)"
                 "{ color.rgb = vec3(1.0, 0.0, 0.0); }")
    green = effect("void PLUG_volume_classify(inout vec4 color, const in VolumeSample s)"
                   "{ color.rgb = vec3(0.0, 1.0, 0.0); }")
    for order in (0, 1):
        parts = [
            f"Transform {{ translation {x} 0 0 scale .5 .5 .5 children [\n"
            + volume(constant(255), effects=code) + "] }\n"
            for x, code in ((-0.5, red), (0.5, green))]
        got = suite.probe(front_scene(*(parts[::-1] if order else parts)), [(4, 8), (12, 8)])
        suite.close(f"order {order}", got[0] + got[1], (1, 0, 0, 1, 0, 1, 0, 1))


@suite.case
def mixed_by_own_effects():
    "in a mix too, each volume's sample passes its own effects; s.volume tells which"
    mark = effect("uniform int which;\n"
                  "void PLUG_volume_classify(inout vec4 color, const in VolumeSample s)"
                  "{ color = vec4(float(s.volume == which), float(s.volume), 0.0, 0.5); }",
                  "initializeOnly SFInt32 which N")
    unit = "opacityUnitDistance 1"
    text = front_scene(
        volume(constant(9), effects=mark.replace("which N", "which 0"), fields=unit),
        volume(constant(9), effects=mark.replace("which N", "which 1"), fields=unit))
    suite.close("", suite.middle(text), premultiplied((1, 0.5, 0), 0.75), 2e-4)


@suite.case
def shape_between():
    "an opaque surface between and inside"
    red, blue = Fog(0xFF0000A0, z=0.25), Fog(0x0000FFC0, z=-0.25)
    plane = "Transform { translation 0 0 -.1 children [ " + quad(
        "UnlitMaterial { emissiveColor 1 1 0 }") + " ] }\n"
    cut = Fog(0xFF0000A0, z=0.25), Fog(0x0000FFC0, z=-0.25)
    for fog in cut:
        fog.far = max(fog.far, -0.1)
    got = suite.middle(front_scene(plane, red.text, blue.text))
    suite.close("", got, over(expected(cut), (1, 1, 0, 1)), 2e-4)


@suite.case
def per_ray_order():
    "T15: which volume is nearer is decided for each ray"
    # two crossed slabs: left the red one is nearer, right the blue one
    slabs = [
        f"Transform {{ rotation 0 1 0 {angle} children [\n"
        + volume(constant(128), opacity_map(rgba), dimensions=(4, 2, 0.02),
                 fields="opacityUnitDistance 0.0001") + "] }\n"
        for angle, rgba in ((0.6, 0xFF0000F8), (-0.6, 0x0000FFF8))]
    for order in (0, 1):
        got = suite.probe(front_scene(*(slabs[::-1] if order else slabs)), [(3, 8), (12, 8)])
        suite.close(f"order {order}", got[0] + got[1], (1, 0, 0, 1, 0, 0, 1, 1), 1e-3)


@suite.case
def layer():
    "a composite function on one of several overlapping volumes makes it a layer, with a warning"
    own = effect("void PLUG_volume_composite(inout vec4 accumulated, inout vec4 color,"
                 " const in VolumeSample s) { color.rgb = vec3(1.0, 1.0, 0.0); }",
                 'placement "ADD_BEFORE" target "Composite"')
    text = front_scene(volume(constant(255), opacity_map(0x0000FF80), own,
                              "opacityUnitDistance 1"), Fog(0x00FF0080, z=-0.5).text)
    result = suite.render(text, "--probe", "8,8")
    suite.equal("one warning", [m[5] for m in result.messages()], ["layered"])
    got = [float(word) for word in result.output.split()]
    first = premultiplied((1, 1, 0), 128 / 255)
    suite.close("the function meets its own volume alone", got,
                over(first, premultiplied((0, 1, 0), 128 / 255)), 2e-4)


@suite.case
def apart_with_composite():
    "volumes that do not overlap: a function for compositing on each, in a group, counts for each"
    total = effect("void PLUG_volume_composite(inout vec4 accumulated, inout vec4 color,"
                   " const in VolumeSample s) { color.rgb = vec3(1.0, 1.0, 0.0); }",
                   'placement "ADD_BEFORE" target "Composite"')
    one = Fog(0xFF000080)
    left = "Transform { translation -.5 0 0 scale .5 .5 .5 children [ " + one.text + " ] }\n"
    right = "Transform { translation .5 0 0 scale .5 .5 .5 children [ " + one.text + " ] }\n"
    got = suite.probe(front_scene(total, left, right), [(4, 8), (12, 8)])
    want = premultiplied((1, 1, 0), 128 / 255)
    suite.close("left", got[0], want, 2e-4)
    suite.close("right", got[1], want, 2e-4)


@suite.case
def rays_of_their_own():
    "volume_ray on one volume leaves the other alone"
    cut = effect("void PLUG_volume_ray(inout float t_enter, inout float t_exit, const in vec3 o,"
                 " const in vec3 d) { t_exit = t_enter; }")
    red, green = Fog(0xFF000080), Fog(0x00FF0080)
    inside = red.text.replace("opacityUnitDistance", f"effects [ {cut} ] opacityUnitDistance")
    got = suite.middle(front_scene(inside, green.text))
    suite.close("", got, expected([green]), 2e-4)


@suite.case
def lit_mixture():
    "light in a mix: each volume with its own style"
    lit = volume("PixelTexture3D { image [1 1 1 2 0 255] }", "ShadedVolumeStyle { lighting TRUE }",
                 effect("void PLUG_volume_classify(inout vec4 color, const in VolumeSample s)"
                        "{ color = vec4(0.5, 0.25, 1.0, 1.0); }"))
    got = suite.middle(front_scene("DirectionalLight { direction 0 0 1 }\n",
                                   lit, Fog(0x00FF00FF).text))
    suite.close("opaque samples are averaged, lit and unlit", got, (0.25, 0.625, 0.5, 1), 1e-3)


@suite.case
def to_the_last_bit():
    "the order in which volumes are listed changes no bit of the picture"
    parts = [f"Transform {{ translation {0.1 * i} {0.07 * i * i} {-0.05 * i} rotation 1 {i} 0 {0.3 * i} "
             "children " + volume(voxels(1, (3, 3, 3), [(i * 71 + 37 * k) % 256 for k in range(27)]))
             + "}\n" for i in range(5)]
    first = suite.picture(front_scene(*parts), "--size", "24x24")
    for order in ((4, 3, 2, 1, 0), (2, 0, 4, 1, 3)):
        other = suite.picture(front_scene(*(parts[i] for i in order)), "--size", "24x24")
        suite.check(str(order), first.values == other.values, "pictures differ")
    suite.check("something is drawn", max(first.values) > 0.1, max(first.values))


@suite.case
def many():
    "ten volumes"
    fogs = [Fog(0xFF000020 + (i << 20), z=0.3 * i, unit=1.0) for i in range(10)]
    both_orders("in a row, each over its neighbours", *fogs)


@suite.case
def sixteen():
    "sixteen volumes in one place, each with a transfer function of its own, are mixed by one program"
    fogs = [Fog((0x10 * i << 24) | (0xFF - 9 * i << 16) | 0x4010 + i, z=0.01 * i) for i in range(16)]
    text = front_scene(*(f.text for f in fogs))
    result = suite.render(text, "--probe", "8,8")
    suite.equal("no layers", [m[5] for m in result.messages()], [])
    suite.close("mixed", [float(v) for v in result.output.split()], expected(fogs), 3e-4)


suite.run()
