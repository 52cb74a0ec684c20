#!/usr/bin/env python3
"""The plugs of the raycaster: what their parameters are and what an effect may do with them."""

import math

from harness import Suite, box_interval, opacity, premultiplied, unit
from scenes import FRONT, constant, effect, front_scene, quad, scene, volume, voxels
from shading_data import ramp

suite = Suite()

DATA = constant(51, (4, 4, 4))
RAY = ("void PLUG_volume_ray(inout float t_enter, inout float t_exit, const in vec3 origin_eye,"
       " const in vec3 direction_eye)")
SAMPLE = "void PLUG_volume_sample(inout VolumeSample s)"
CLASSIFY = "void PLUG_volume_classify(inout vec4 color, const in VolumeSample s)"
SHADE = "void PLUG_volume_shade(inout vec4 color, const in VolumeSample s)"
COMPOSITE = ("void PLUG_volume_composite(inout vec4 accumulated, inout vec4 color,"
             " const in VolumeSample s)")
END = "void PLUG_volume_ray_end(inout vec4 accumulated, inout float depth)"


def colored(code, data=DATA, fields="", dimensions=(1, 1, 1), style="", around="", view=FRONT,
            arguments=(), **options):
    content = volume(data, style, effect(code), fields, dimensions)
    if around:
        content = around + " children [\n" + content + "] }\n"
    return suite.middle(scene(view, content), *arguments, **options)


def value_of(expression, **options):
    """An expression of the first sample, as a colour."""
    return colored(CLASSIFY + "{ color = vec4(" + expression + ", 1.0); }", **options)[:3]


# ---- volume_ray


@suite.case
def ray_cut():
    "volume_ray clips, in distances of eye space from the eye"
    got = colored(RAY + "{ t_enter = max(t_enter, 9.75); t_exit = min(t_exit, 10.25); }")
    suite.close("a slab of half the depth", got, premultiplied((0.2,) * 3, opacity(0.2, 0.5, 0.25)))
    got = colored(RAY + "{ t_enter = 0.0; t_exit = 1.0e9; }")
    suite.close("it cannot grow beyond the box", got,
                premultiplied((0.2,) * 3, opacity(0.2, 1, 0.25)))
    got = colored(RAY + "{ t_exit = t_enter - 1.0; }")
    suite.close("nothing left", got, (0, 0, 0, 0), 0)
    got = colored("float zero() { return 0.0; }\n" + RAY + "{ t_enter = 0.0 / zero(); }")
    suite.check("NaN does no harm", all(math.isfinite(v) for v in got), got)


@suite.case
def ray_values():
    "entry and exit, origin and direction"
    code = ("float enter; float leave; vec3 o; vec3 d;\n"
            + RAY + "{ enter = t_enter; leave = t_exit; o = origin_eye; d = direction_eye; }\n"
            + CLASSIFY + "{ color = vec4(EXPRESSION, 1.0); }")

    def value(expression, view=FRONT, **options):
        return colored(code.replace("EXPRESSION", expression), view=view, **options)[:3]

    suite.close("parallel: distances from the eye's plane", value("enter / 10.0, leave / 20.0, 0.0"),
                (0.95, 10.5 / 20, 0), 1e-5)
    suite.close("parallel: direction", value("d * vec3(1.0, 1.0, -1.0)"), (0, 0, 1), 1e-6)
    suite.close("parallel: origin", value("o + 0.5"), (0.5, 0.5, 0.5), 1e-6)
    text = scene("Viewpoint { position 0 0 2 }\n",
                 volume(DATA, effects=effect(code.replace(
                     "EXPRESSION", "enter * 0.25, leave * 0.25, d.x + 0.5"))))
    half = math.tan(math.pi / 8)
    ray = unit(((4.5 / 8 - 1) * half, (1 - 6.5 / 8) * half, -1))
    enter, leave = box_interval((0, 0, 2), ray)
    got = suite.probe(text, [(4, 6)])[0]
    suite.close("perspective", got[:3], (enter / 4, leave / 4, ray[0] + 0.5), 1e-5)
    suite.close("scaled: still eye space",
                value("enter / 10.0, leave / 20.0, length(d) * 0.5", around="Transform { scale 3 3 3"),
                (0.85, 11.5 / 20, 0.5), 1e-5)


# ---- volume_sample


@suite.case
def sample_changes():
    "volume_sample may replace the value, and with it a whole volume"
    got = colored(SAMPLE + "{ s.value = vec4(0.6); }")
    suite.close("value", got, premultiplied((0.6,) * 3, opacity(0.6, 1, 0.25)))
    # a ball of radius 1/2 made from positions; its opacity is 1
    ball = SAMPLE + "{ s.value = vec4(step(length(s.position - 0.5), 0.5)); }"
    picture = suite.picture(front_scene(volume(DATA, effects=effect(ball))), "--step", "0.02",
                            size="64x64")
    area = sum(picture.at(x, y)[3] for x in range(64) for y in range(64)) / 64**2 * 4
    suite.close("the area of a disk", area, math.pi / 4, 0.01)
    suite.close("and a hole outside", picture.at(17, 17), (0, 0, 0, 0), 0)


@suite.case
def members():
    "members of the sample"
    suite.close("value", value_of("s.value.rgb"), (0.2, 0, 0))
    suite.close("position", value_of("s.position", arguments=("--step", "0.4")),
                (0.5, 0.5, 1 - 0.05), 1e-5)
    suite.close("position_eye", value_of("s.position_eye * vec3(1.0, 1.0, -0.1)",
                                         arguments=("--step", "0.4")), (0, 0, 0.955), 1e-5)
    suite.close("step_length: own coordinates",
                value_of("s.step_length, 0.0, 0.0", arguments=("--step", "2")), (0.5, 0, 0), 1e-5)
    suite.close("step_length does not scale",
                value_of("s.step_length, 0.0, 0.0", arguments=("--step", "2"),
                         around="Transform { scale 3 3 3"), (0.5, 0, 0), 1e-5)
    suite.close("segment and volume", value_of("float(s.segment), float(s.volume), 0.5"),
                (0, 0, 0.5), 0)


@suite.case
def step_lengths_add_up():
    "step lengths add up to the chord, the last one included"
    total = effect(COMPOSITE + "{ accumulated.r += s.step_length; }",
                   'placement "REPLACE" target "Composite"')
    for step in (0.3, 0.7, 1.1, 7):
        text = front_scene(volume(DATA, effects=total, dimensions=(1, 1, 2)))
        got = suite.middle(text, "--step", step)
        suite.close(f"step {step}", got[0], 2, 1e-5)


SLOPE = (0.3, -0.4, -0.5)


@suite.case
def gradients():
    "normal_eye: unit, out of the denser side; gradient: value per length in own coordinates"
    files = {"ramp.nrrd": ramp(SLOPE)}
    data = 'ImageTexture3D { url "ramp.nrrd" }'
    inner = RAY + "{ t_enter = max(t_enter, 10.0); }\n"

    def value(expression, **options):
        code = inner + CLASSIFY + "{ color = vec4(" + expression + ", 1.0); }"
        return colored(code, data=data, fields="valueRange 0 1", files=files, **options)[:3]

    normal = unit(tuple(-s for s in SLOPE))
    suite.close("normal_eye", value("s.normal_eye * 0.5 + 0.5"), [n / 2 + 0.5 for n in normal])
    size = math.sqrt(sum(s * s for s in SLOPE))
    suite.close("gradient", value("s.gradient, 0.0, 0.0")[0], size)
    suite.close("a Transform does not change it",
                value("s.gradient, 0.0, 0.0", around="Transform { scale 3 5 .2")[0], size)
    stretched = tuple(s / d for s, d in zip(SLOPE, (2, 1, 0.8)))
    size = math.sqrt(sum(s * s for s in stretched))
    suite.close("dimensions do", value("s.gradient, 0.0, 0.0", dimensions=(2, 1, 0.8))[0], size)


@suite.case
def gradients_on_voxels():
    "the gradient is the interpolation of central differences, halved at the border"
    values = [10, 40, 250, 90, 60]  # along x; 5 voxels
    at_centres = [(values[min(i + 1, 4)] - values[max(i - 1, 0)]) / 255 * 5 / 2 for i in range(5)]
    code = CLASSIFY + "{ color = vec4(s.gradient * 0.2, -s.normal_eye.x * 0.5 + 0.5, 0.0, 1.0); }"
    text = scene("OrthoViewpoint { position 0 0 10 fieldOfView -.5 -.5 .5 .5 }\n",
                 volume(voxels(1, (5, 1, 1), values), effects=effect(code)))
    picture = suite.picture(text, size="40x40")
    got, expected, signs = [], [], []
    for x in range(40):
        at = min(max((x + 0.5) / 8 - 0.5, 0), 4)
        low = min(int(at), 3)
        g = at_centres[low] + (at_centres[low + 1] - at_centres[low]) * (at - low)
        got += picture.at(x, 20)[:1]
        signs.append(picture.at(x, 20)[1])
        expected.append(min(abs(g) * 0.2, 1))
        if abs(g) < 1e-3:
            signs[-1] = None
    suite.close("magnitude", got, expected, 2e-4)
    suite.check("direction", all(s is None or s in (0.0, 1.0) for s in signs)
                and signs[8] == 1 and signs[30] == 0, signs)


@suite.case
def no_gradient():
    "the normal is zero where the gradient vanishes"
    suite.close("", value_of("abs(s.normal_eye) + s.gradient"), (0, 0, 0), 0)


# ---- volume_classify, volume_shade


@suite.case
def clamping():
    "after a plug colours are within 0..1, NaN becomes 0"
    got = colored(CLASSIFY + "{ color = vec4(3.0, -2.0, 0.5, 7.0); }")
    suite.close("clamped", got, (1, 0, 0.5, 1), 1e-6)
    got = colored("float zero() { return 0.0; }\n" + CLASSIFY
                  + "{ float nan = zero() / zero(); color = vec4(nan, 0.5, nan, 1.0); }")
    suite.close("NaN in a colour", got, (0, 0.5, 0, 1), 1e-6)
    got = colored(CLASSIFY + "{ color = vec4(1.0, 1.0, 1.0, sqrt(-s.value.r)); }")
    suite.close("NaN in alpha", got, (0, 0, 0, 0), 0)
    got = colored(CLASSIFY + "{ color.rgb = vec3(4.0); }\n" + SHADE + "{ color.rgb *= 0.25; }")
    suite.close("between classify and shade", got[:3],
                [0.25 * opacity(0.2, 1, 0.25)] * 3)


@suite.case
def incoming():
    "classify gets the mapped voxel, shade what classify left; both straight"
    got = colored(CLASSIFY + "{ color = vec4(color.r * 2.0, color.a * 3.0, 0.0, 0.5); }\n"
                  + SHADE + "{ color = vec4(color.gr, 1.0, color.a); }")
    suite.close("", got, premultiplied((0.6, 0.4, 1), opacity(0.5, 1, 0.25)))


@suite.case
def alpha_per_reference():
    "alpha that an effect writes means per reference length"
    for reference in (0.25, 0.7):
        got = colored(CLASSIFY + "{ color.a = 0.3; }",
                      fields="" if reference == 0.25 else f"opacityUnitDistance {reference}")
        suite.close(f"{reference}", got[3], opacity(0.3, 1, reference))


# ---- volume_composite, volume_ray_end


@suite.case
def composite():
    "volume_composite: opacity of the step, premultiplied sum; once a step"
    count = COMPOSITE + "{ accumulated.r += 0.01; accumulated.g = max(accumulated.g, color.a); }"
    got = colored(count, style="ShadedVolumeStyle { }", arguments=("--step", "1"))
    # the over comes before: green is the larger of its sum and the opacity of one step
    green, red = 0.0, 0.0
    alpha = 0.0
    for _ in range(4):
        red += (1 - alpha) * 0.04 + 0.01
        green = max(green + (1 - alpha) * 0.04, 0.2)
        alpha += (1 - alpha) * 0.2
    suite.close("four steps, each of one reference length", got[:2], (red, green))
    got = colored(COMPOSITE + "{ color = vec4(1.0, 0.5, 0.0, 0.5); }", arguments=("--step", "1"))
    # a function after Composite changes nothing that counts
    suite.close("a function after the over comes too late", got,
                premultiplied((0.2,) * 3, opacity(0.2, 1, 0.25)))


@suite.case
def maximum_projection():
    "a projection as an effect that replaces the over: the maximum along the ray"
    code = COMPOSITE + "{ accumulated = vec4(max(accumulated.rgb, s.value.rrr), 1.0); }"
    text = front_scene(volume(
        voxels(1, (1, 1, 5), [0, 30, 200, 40, 0]),
        effects=effect(code, 'placement "REPLACE" target "Composite"')))
    suite.close("", suite.middle(text, "--step", "0.01"), (200 / 255,) * 3 + (1,), 2e-3)


@suite.case
def all_steps_where_asked():
    "an author's composite function meets all steps: no ray ends early"
    code = COMPOSITE + "{ accumulated.b += 0.01; }"
    got = colored(code, data=constant(255, (4, 4, 4)), arguments=("--step", "0.5"))
    suite.close("eight steps", got, (1, 1, 1.08, 1), 2e-4)


@suite.case
def ray_end():
    "volume_ray_end changes the sum once; depth is that of the first sample that counts"
    got = colored(END + "{ accumulated = vec4(accumulated.rgb * 2.0, accumulated.a); }")
    a = opacity(0.2, 1, 0.25)
    suite.close("the sum", got, (0.4 * a, 0.4 * a, 0.4 * a, a))
    got = colored(END + "{ accumulated = vec4(depth * 0.05, 0.0, 0.0, 1.0); }",
                  arguments=("--step", "0.04"))
    suite.close("depth", got[0], 9.505 / 20, 3e-4)


@suite.case
def surface_plugs_on_volumes():
    "a plug of surfaces on a volume says nothing, or where it exists; the volume is drawn"
    code = "void PLUG_fragment_modify(inout vec4 color) { color = vec4(1.0); }\n" \
           + CLASSIFY + "{ color = vec4(0.0, 1.0, 0.0, 1.0); }"
    text = front_scene(volume(DATA, effects=effect(code)))
    result = suite.render(text, "--probe", "8,8")
    suite.close("drawn", [float(w) for w in result.output.split()], (0, 1, 0, 1))
    suite.check("no error", not [m for m in result.messages() if m[3] == "error"], result.errors)


@suite.case
def light_in_volume():
    "light_scale on a volume and on its light"
    files = {"ramp.nrrd": ramp((0, 0, -0.5))}
    scale = effect("void PLUG_light_scale(inout float scale, const in vec3 normal_eye,"
                   " const in vec3 light_dir) { scale *= 0.25 * light_dir.z * normal_eye.z; }")
    data = 'ImageTexture3D { url "ramp.nrrd" }'
    opaque = effect(CLASSIFY + "{ color = vec4(0.8, 0.6, 0.4, 1.0); }")
    style = "ShadedVolumeStyle { lighting TRUE }"
    two = ("DirectionalLight { intensity .5 EFFECTS }\n"
           "DirectionalLight { direction 0 0 -1 intensity .25 }\n")
    for where, factor in (("the volume", 0.25 * 0.75), ("one light", 0.25 * 0.5 + 0.25)):
        lights = two.replace("EFFECTS", f"effects {scale}" if where == "one light" else "")
        text = front_scene(lights, volume(data, style, opaque + (scale if where == "the volume" else ""),
                                          "valueRange 0 1"))
        got = suite.middle(text, files=files)
        suite.close(where, got, [factor * c for c in (0.8, 0.6, 0.4)] + [1])


suite.run()
