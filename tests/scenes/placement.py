#!/usr/bin/env python3
"""Effects that stand before, after or in place of built-in ones, or remove them."""

from harness import Suite, opacity, premultiplied
from scenes import Row, constant, effect, front_scene, quad, scene, volume

suite = Suite()

CLASSIFY = "void PLUG_volume_classify(inout vec4 color, const in VolumeSample s)"
SHADE = "void PLUG_volume_shade(inout vec4 color, const in VolumeSample s)"
COMPOSITE = ("void PLUG_volume_composite(inout vec4 accumulated, inout vec4 color,"
             " const in VolumeSample s)")
ADD_LIGHT = ("void PLUG_add_light(inout vec4 color, const in vec4 vertex_eye,"
             " const in vec3 normal_eye, const in MaterialInfo material)")
DATA = constant(102, (2, 2, 2))
MAP = "OpacityMapVolumeStyle { transferFunction PixelTexture { image 1 1 4 0xFF800080 } }"
ALPHA = 128 / 255


def placed(code, placement, target=None, active=None):
    fields = f'placement "{placement}"'
    if target is not None:
        fields += f' target "{target}"'
    if active:
        fields += " onlyIfActive TRUE"
    return effect(code, fields)


def drawn(code, placement, target=None, style=MAP, active=None, extra=""):
    own = placed(code, placement, target, active)
    return suite.middle(front_scene(volume(DATA, style, own + extra)))


def fog(rgb, alpha):
    return premultiplied(rgb, opacity(alpha, 1, 0.5))


RED_HALF = CLASSIFY + "{ color = vec4(color.r * 0.5, color.g, 0.25, color.a); }"


@suite.case
def around_a_style():
    "before, after and instead of a leading opacity map"
    suite.close("after", drawn(RED_HALF, "ADD_AFTER", "OpacityMapVolumeStyle"),
                fog((0.5, 128 / 255, 0.25), ALPHA))
    suite.close("before: the map replaces it", drawn(RED_HALF, "ADD_BEFORE", "OpacityMapVolumeStyle"),
                fog((1, 128 / 255, 0), ALPHA))
    suite.close("instead: the voxel comes in", drawn(RED_HALF, "REPLACE", "OpacityMapVolumeStyle"),
                fog((0.2, 0.4, 0.25), 0.4))
    suite.close("removed", drawn("", "REMOVE", "OpacityMapVolumeStyle"), fog((0.4,) * 3, 0.4))
    suite.close("the default map, too", drawn(RED_HALF, "REPLACE", "OpacityMapVolumeStyle", style=""),
                fog((0.2, 0.4, 0.25), 0.4))


@suite.case
def around_shading():
    "before and instead of the shaded style"
    style = "ShadedVolumeStyle { lighting TRUE material Material { emissiveColor .5 .25 1 } }"
    composed = f"ComposedVolumeStyle {{ renderStyle [ {MAP} {style} ] }}"
    white = SHADE + "{ color.rgb = vec3(1.0); color.a *= 0.5; }"
    suite.close("before", drawn(white, "ADD_BEFORE", "ShadedVolumeStyle", composed),
                fog((0.5, 0.25, 1), ALPHA / 2))
    suite.close("instead", drawn(white, "REPLACE", "ShadedVolumeStyle", composed),
                fog((1, 1, 1), ALPHA / 2))
    suite.close("removed", drawn("", "REMOVE", "ShadedVolumeStyle", composed),
                fog((1, 128 / 255, 0), ALPHA))


@suite.case
def around_composite():
    "before and instead of the over"
    yellow = COMPOSITE + "{ color.rgb = vec3(1.0, 1.0, 0.0); }"
    suite.close("before", drawn(yellow, "ADD_BEFORE", "Composite"), fog((1, 1, 0), ALPHA))
    suite.close("after: too late", drawn(yellow, "ADD_AFTER", "Composite"), fog((1, 128 / 255, 0), ALPHA))
    total = COMPOSITE + "{ accumulated.g += s.step_length * 0.5; }"
    suite.close("instead", drawn(total, "REPLACE", "Composite"), (0, 0.5, 0, 0))
    suite.close("removed", drawn("", "REMOVE", "Composite"), (0, 0, 0, 0), 0)


@suite.case
def whole_step():
    "target \"\" is the whole step"
    first = placed(CLASSIFY + "{ color.b = 0.75; }", "ADD_BEFORE", "")
    got = suite.middle(front_scene(volume(DATA, MAP, effect(CLASSIFY + "{ color.r = color.b; }") + first)))
    suite.close("before all: the map replaces it", got, fog((0, 128 / 255, 0), ALPHA))
    got = suite.middle(front_scene(volume(DATA, MAP, effect(CLASSIFY + "{ color.r = 0.5; }")
                                          + placed(CLASSIFY + "{ color.b = 0.75; }", "REPLACE", ""))))
    suite.close("instead of all", got[2], 0.75 * opacity(0.4, 1, 0.5))
    got = drawn(CLASSIFY + "{ color.r *= 0.5; }", "ADD_AFTER", "")
    suite.close("after all", got, fog((0.5, 128 / 255, 0), ALPHA))


@suite.case
def lights():
    "lights: replaced, removed, all of one type"
    material = "Material { diffuseColor 1 .5 .25 ambientIntensity 0 }"
    light = "DirectionalLight { color 1 1 0 }\nPointLight { global FALSE location 0 0 1000 radius 2000 color 0 0 1 }\n"
    glow = ADD_LIGHT + "{ color.rgb += material.diffuse.bgr * normal_eye.z; }"
    row = Row(suite)
    row.add(light + quad(material))
    row.add(light + quad(material, placed("", "REMOVE", "DirectionalLight")))
    row.add(light + quad(material, placed(glow, "REPLACE", "DirectionalLight")))
    row.add(light + quad(material, placed(glow, "ADD_AFTER")))
    got = row.draw()
    names = "all lights", "removed", "replaced", "added"
    expected = ((1, 0.5, 0.25, 1), (0, 0, 0.25, 1), (0.25, 0.5, 1.25, 1), (1.25, 1, 1.25, 1))
    for name, color, want in zip(names, got, expected):
        suite.close(name, color, want, 1e-3)


@suite.case
def only_if_active():
    "onlyIfActive leaves an effect out where its target is not there"
    for active, expected in ((False, 0.5), (True, 1)):
        got = drawn(CLASSIFY + "{ color.r *= 0.5; }", "ADD_AFTER", "ShadedVolumeStyle", active=active)
        suite.close(f"absent, onlyIfActive {active}", got[0], expected * opacity(ALPHA, 1, 0.5))
    got = drawn(CLASSIFY + "{ color.r *= 0.5; }", "ADD_AFTER", "OpacityMapVolumeStyle", active=True)
    suite.close("present", got[0], 0.5 * opacity(ALPHA, 1, 0.5))


@suite.case
def materials():
    "the material of a surface can be replaced, too"
    code = ("void PLUG_surface_color(inout vec4 color) { color.rgb = vec3(0.25, 0.5, 0.75); }")
    text = front_scene(quad("UnlitMaterial { emissiveColor 1 0 0 }", placed(code, "REPLACE", "UnlitMaterial")))
    suite.close("", suite.middle(text), (0.25, 0.5, 0.75, 1))


@suite.case
def mistakes():
    "REMOVE without a target and an unknown placement are errors at their field; the rest is drawn"
    for fields, code in (('placement "REMOVE"', "bad-target"), ('placement "ASIDE"', "bad-value")):
        text = front_scene(volume(DATA, MAP, effect(RED_HALF, fields)))
        result = suite.render(text, "--probe", "8,8", status=1)
        suite.equal(f"{fields}: its code", [m[5] for m in result.messages()], [code])
        line = next(i for i, l in enumerate(text.splitlines(), 1) if "placement" in l)
        suite.equal(f"{fields}: its line", result.messages()[0][1], line)
        suite.close(f"{fields}: drawn", [float(w) for w in result.output.split()],
                    fog((1, 128 / 255, 0), ALPHA))


@suite.case
def unknown_target():
    "a target that names no effect is told, with the nearest name; one that is not in this scene is not"
    for target, told in (("OpacityMapVolumeStlye", 'did you mean "OpacityMapVolumeStyle"'), ("SpotLight", None)):
        text = front_scene(volume(DATA, MAP, effect(RED_HALF, f'target "{target}"')))
        messages = suite.render(text, "--probe", "8,8").messages()
        suite.equal(f"{target}: codes", [m[5] for m in messages], ["unknown-target"] if told else [])
        if told:
            line = next(i for i, l in enumerate(text.splitlines(), 1) if "Effect" in l)
            suite.check(f"{target}: place and words", messages[0][1] == line and told in messages[0][4], messages)


suite.run()
