#!/usr/bin/env python3
"""Which effects reach what, in which order, and that they do not disturb each other."""

from harness import HEADER, Suite
from scenes import FRONT, NO_HEADLIGHT, Row, constant, effect, effect_parts, front_scene, quad, scene, volume

suite = Suite()

MODIFY = "void PLUG_fragment_modify(inout vec4 color)"
CLASSIFY = "void PLUG_volume_classify(inout vec4 color, const in VolumeSample s)"


def append(digit, plug=MODIFY):
    """Shifts the red digits and appends one: the colour tells the order of calls."""
    return effect(plug + f"{{ color.r = color.r * 0.1 + 0.{digit}; color.a = 1.0; }}")


def digits(order):
    """What `append` leaves: the last digit called comes first."""
    return float("0." + "".join(str(d) for d in reversed(order)))


BLACK = "UnlitMaterial { emissiveColor 0 0 0 }"


@suite.case
def order_on_surfaces():
    "the shape's list in order, then groups from inner to outer, siblings before and after"
    shape = quad(BLACK, append(1) + append(2))
    text = front_scene(append(5), "Group { children [", append(3), shape, append(4), "] }",
                       append(6), "Group { children [", append(7), "] }")
    suite.close("", suite.middle(text)[0], digits([1, 2, 3, 4, 5, 6]), 2e-5)


@suite.case
def order_on_volumes():
    "the same for volumes"
    content = volume(constant(0), effects=append(1, CLASSIFY) + append(2, CLASSIFY))
    text = front_scene(append(5, CLASSIFY), "Transform { children [", append(3, CLASSIFY), content,
                       append(4, CLASSIFY), "] }", append(6, CLASSIFY))
    suite.close("", suite.middle(text)[0], digits([1, 2, 3, 4, 5, 6]), 2e-5)


@suite.case
def inlined():
    "an effect in a group reaches what the group inlines; an inlined effect does not leak out"
    part = HEADER + quad(BLACK, append(1)) + append(2)
    inside = 'Group { children [ Inline { url "part.x3dv" } ' + append(3) + " ] }\n"
    got = suite.middle(front_scene(inside), files={"part.x3dv": part})
    suite.close("in", got[0], digits([1, 2, 3]), 2e-5)
    outside = "Group { children [ Inline { url \"part.x3dv\" } ] }\n"
    beside = "Transform { translation 0 0 1 children [ " + quad(BLACK, append(4)) + " ] }\n"
    got = suite.middle(front_scene(outside, beside), files={"part.x3dv": part})
    suite.close("out", got[0], digits([4]), 2e-5)


@suite.case
def disabled_and_foreign():
    "enabled FALSE and other languages leave an effect out"
    off = append(1).replace("Effect {", "Effect { enabled FALSE", 1)
    cg = append(2).replace("Effect {", 'Effect { language "CG"', 1)
    text = front_scene(quad(BLACK, off + cg + append(3)))
    result = suite.render(text, "--probe", "8,8")
    suite.close("", float(result.output.split()[0]), digits([3]), 2e-5)
    suite.equal("a warning", [m[3::2] for m in result.messages()], [("warning", "language")])


@suite.case
def one_light_alone():
    "an effect on a light scales that light alone; in Appearance and groups it scales all"
    half = effect("void PLUG_light_scale(inout float scale, const in vec3 normal_eye,"
                  " const in vec3 light_dir) { scale *= 0.5; }")
    def light(color, effects=""):
        return f"DirectionalLight {{ color {color} effects [ {effects} ] }}\n"

    material = "Material { diffuseColor 1 1 1 }"
    row = Row(suite)
    row.add(light("1 0 0", half) + light("0 1 0") + quad(material))
    row.add(light("1 0 0") + light("0 1 0") + quad(material, half))
    row.add(light("1 0 0") + half + light("0 1 0") + quad(material))
    row.add(light("1 0 0", half) + light("0 1 0") + quad(material, half))
    got = row.draw()
    for name, color, expected in zip(
            ("on a light", "in Appearance", "in the group", "on both"), got,
            ((0.5, 1, 0, 1), (0.5, 0.5, 0, 1), (0.5, 0.5, 0, 1), (0.25, 0.5, 0, 1))):
        suite.close(name, color, expected)


@suite.case
def local_effect_uses_the_shape():
    "an effect on a light uses a plug of the shape where the light has none of that name"
    light = ("DirectionalLight { effects "
             + effect(MODIFY + "{ color.b = 0.75; }") + " }\n")
    text = front_scene(light, quad("Material { diffuseColor 1 .5 0 }"))
    suite.close("", suite.middle(text), (1, 0.5, 0.75, 1))


SAME = """const int N = COUNT;
#define FACTOR VALUE
struct Pair { float a; float b; };
float state = FACTOR;
float noise(vec3 p) { Pair pair = Pair(state, float(N)); return pair.a * pair.b; }
uniform float amount;
void PLUG_fragment_modify(inout vec4 color) { color.CHANNEL += noise(vec3(0.0)) * amount; }
"""


def same(count, value, channel, amount):
    code = SAME.replace("COUNT", str(count)).replace("VALUE", str(value)).replace("CHANNEL", channel)
    return effect(code, f"initializeOnly SFFloat amount {amount}")


@suite.case
def equal_names():
    "functions, constants, structs, macros, globals and uniforms of equal names"
    text = front_scene(quad(BLACK, same(2, 0.1, "r", 1) + same(3, 0.2, "g", 0.5) + same(1, 0.5, "b", 0.9)))
    suite.close("surface", suite.middle(text), (0.2, 0.3, 0.45, 1))
    volumes = (same(2, 0.1, "r", 1) + same(3, 0.2, "g", 0.5)).replace(
        MODIFY, CLASSIFY).replace("color.r +=", "color.a = 1.0; color.r +=")
    suite.close("volume", suite.middle(front_scene(volume(constant(0), effects=volumes))),
                (0.2, 0.3, 0, 1))


@suite.case
def used_twice():
    "one effect used twice in a list, and on a surface and a volume"
    defined = effect(SAME.replace("COUNT", "2").replace("VALUE", "0.1").replace("CHANNEL", "r"),
                     "initializeOnly SFFloat amount 1", "DEF E")
    suite.close("twice", suite.middle(front_scene(quad(BLACK, defined + "USE E"))), (0.4, 0, 0, 1))
    code = ("float half_of(float x) { return 0.5 * x; }\n"
            + MODIFY + "{ color.r = half_of(0.5); }\n" + CLASSIFY + "{ color = vec4(half_of(1.0)); }")
    both = effect(code, head="DEF E")
    text = scene("OrthoViewpoint { position 0 0 10 fieldOfView -1 -1 1 1 }\n",
                 "Transform { translation -.5 0 0 children [ ", quad(BLACK, both), " ] }\n",
                 "Transform { translation .5 0 0 children [ ", volume(constant(9), effects="USE E"),
                 " ] }\n")
    got = suite.probe(text, [(4, 8), (12, 8)])
    suite.close("surface", got[0], (0.25, 0, 0, 1))
    suite.close("volume", got[1], (0.25, 0.25, 0.25, 0.5))


@suite.case
def varyings():
    "varyings of one effect are shared by its stages and hidden from other effects"
    def carrying(value, channel):
        return effect_parts((
            ("VERTEX", "varying float carried;\nvoid PLUG_vertex_object_space(const in vec4 v, inout vec3 n)"
                       f"{{ carried = {value}; }}"),
            ("FRAGMENT", "varying float carried;\n" + MODIFY + f"{{ color.{channel} = carried; }}")))

    text = front_scene(quad(BLACK, carrying(0.25, "r") + carrying(0.5, "g") + carrying(0.75, "b")))
    suite.close("", suite.middle(text), (0.25, 0.5, 0.75, 1))


@suite.case
def helpers():
    "a helper part, and one that two effects USE"
    helper = ('DEF H EffectPart { type "FRAGMENT" url "data:text/plain,\n'
              'float twice(float x) { return 2.0 * x; }\n" }')
    def user(channel, value, part):
        return (f"Effect {{ parts [ {part} EffectPart {{ type \"FRAGMENT\" url \"data:text/plain,\n"
                f"float twice(float x);\n{MODIFY}{{ color.{channel} = twice({value}); }}\n\" }} ] }}\n")

    text = front_scene(quad(BLACK, user("r", 0.1, helper) + user("g", 0.2, "USE H")))
    suite.close("", suite.middle(text), (0.2, 0.4, 0, 1))


@suite.case
def own_plugs():
    "a plug of an effect is open to later effects: a chain of three"
    first = effect("struct Spot { float size; };\n" + MODIFY + "{ Spot spot = Spot(0.25);\n"
                   "  /* PLUG: spot_change (spot) */\n  color.r = spot.size; }")
    second = effect("struct Spot { float size; };\n"
                    "void PLUG_spot_change(inout Spot spot) { spot.size *= 2.0; float extra = 0.0;\n"
                    "  /* PLUG: spot_extra (extra) */\n  spot.size += extra; }")
    third = effect("void PLUG_spot_extra(inout float extra) { extra += 0.125; }")
    got = suite.middle(front_scene(quad(BLACK, first + second + third + third)))
    suite.close("in order", got, (0.75, 0, 0, 1))
    result = suite.render(front_scene(quad(BLACK, third + second + first)), "--probe", "8,8")
    suite.close("what comes before the plug does not reach it", float(result.output.split()[0]), 0.25)
    suite.equal("and is warned of", [m[5] for m in result.messages() if m[3] == "warning"],
                ["unknown-plug", "unknown-plug"])


@suite.case
def several_functions():
    "two functions for one plug in one part; two parts for one plug"
    code = (MODIFY + "{ color.r += 0.25; }\n" + MODIFY + "{ color.r *= 0.5; }")
    suite.close("one part", suite.middle(front_scene(quad(BLACK, effect(code)))), (0.125, 0, 0, 1))
    parts = effect_parts((("FRAGMENT", MODIFY + "{ color.r += 0.25; }"),
                          ("FRAGMENT", MODIFY + "{ color.r *= 0.5; }")))
    suite.close("two parts", suite.middle(front_scene(quad(BLACK, parts))), (0.125, 0, 0, 1))


@suite.case
def tricky_text():
    "comments, conditionals, prefixes, spacing, continuations"
    codes = {
        "prefix, short first": (
            "void PLUG_fragment_end(inout vec4 c) { c.g = 0.5; }\n" + MODIFY + "{ color.r = 0.5; }",
            (0.5, 0.5, 0, 1)),
        "in comments": (
            "/* PLUG_fog_apply (inout vec4 c) */\n// void PLUG_fog_apply(inout vec4 c) { c.r = 1.0; }\n"
            + MODIFY + "{ color.b = 0.5; }", (0, 0, 0.5, 1)),
        "inactive": (
            "#if 0\n" + MODIFY + "{ color.r = 1.0; }\n#else\n" + MODIFY + "{ color.g = 1.0; }\n#endif\n",
            (0, 1, 0, 1)),
        "spacing": (
            "float x;void\nPLUG_fragment_modify\n (\ninout vec4 color\n)\n{color.r=0.25;}", (0.25, 0, 0, 1)),
        "continuations": (
            "#define ADD(x) \\\\\n  color.g += x; \\\\\n  color.r += x\n" + MODIFY + "{ ADD(0.25); }",
            (0.25, 0.25, 0, 1)),
        "CRLF": (("float h() { return 0.5; }\n" + MODIFY + "\n{\n color.r = h();\n}\n").replace("\n", "\r\n"),
                 (0.5, 0, 0, 1)),
        "direct call": (
            "void PLUG_fog_apply(inout vec4 c, const vec3 n) { c.g += 0.25; }\n" + MODIFY
            + "{ PLUG_fog_apply(color, vec3(0.0)); }", (0, 0.5, 0, 1)),
        "keyword in the parameters": (
            "void PLUG_fragment_modify(inout vec4 color) { vec4 texture = vec4(0.5); color.r = texture.r; }",
            (0.5, 0, 0, 1)),
    }
    row = Row(suite)
    for code, _ in codes.values():
        row.add(quad(BLACK, effect(code)))
    for (name, (_, expected)), got in zip(codes.items(), row.draw()):
        suite.close(name, got, expected)


@suite.case
def prototypes():
    "an effect library in a PROTO: fields by IS, instances of their own"
    proto = ("PROTO Tint [ initializeOnly SFColor tint 1 1 1  initializeOnly SFFloat amount 0 ] { "
             "Effect { initializeOnly SFColor tint IS tint initializeOnly SFFloat amount IS amount\n"
             " parts EffectPart { type \"FRAGMENT\" url \"data:text/plain,\n"
             "uniform vec3 tint; uniform float amount;\n" + MODIFY
             + "{ color.rgb = mix(color.rgb, tint, amount); }\n\" } } }\n")
    text = scene(FRONT, NO_HEADLIGHT, proto, quad(
        "UnlitMaterial { emissiveColor 1 1 1 }",
        "Tint { tint 1 0 0 amount .5 } Tint { tint 0 0 1 amount .25 }"))
    suite.close("", suite.middle(text), (0.75, 0.375, 0.625, 1))


@suite.case
def one_shape_in_two_groups():
    "a shape used in two groups is drawn with each group's effects"
    shape = quad(BLACK, append(1)).replace("Shape {", "DEF S Shape {", 1)
    row = Row(suite)
    row.add(shape + append(2))
    row.add("USE S " + append(3))
    got = row.draw()
    suite.close("first", got[0][0], digits([1, 2]), 2e-5)
    suite.close("second", got[1][0], digits([1, 3]), 2e-5)


@suite.case
def one_group_effect_on_all():
    "one effect in a group reaches a shape and a volume, with what each has"
    both = effect(MODIFY + "{ color = vec4(0.0, 1.0, 0.0, 1.0); }\n"
                  + CLASSIFY + "{ color = vec4(0.0, 0.0, 1.0, 1.0); }")
    text = front_scene(both, "Transform { translation -.5 0 0 children [ ", quad(BLACK), " ] }\n",
                       "Transform { translation .5 0 0 children [ ", volume(constant(9)), " ] }\n")
    result = suite.render(text, "--probe", "4,8", "--probe", "12,8")
    suite.close("", [float(w) for w in result.output.split()], (0, 1, 0, 1, 0, 0, 1, 1))
    suite.equal("nothing to complain of", result.messages(), [])


@suite.case
def textures_of_appearance():
    "an effect in Appearance reaches its texture's plug; one on the texture comes first"
    color = ("void PLUG_texture_color(inout vec4 texture_color, const in vec4 tex_coord)"
             "{ texture_color.r = texture_color.r * 0.1 + 0.%d; }")
    texture = f"texture PixelTexture {{ image 1 1 3 0 effects {effect(color % 1)} }}"
    text = front_scene(append(3), quad("UnlitMaterial { }", effect(color % 2), texture))
    suite.close("", suite.middle(text)[0], digits([1, 2, 3]), 2e-5)


@suite.case
def lights_of_two_volumes():
    "an effect on a light works in each volume that the light reaches"
    half = effect("void PLUG_light_scale(inout float scale, const in vec3 n, const in vec3 l)"
                  "{ scale *= 0.5; }")
    from_left = "PixelTexture3D { image [1 1 1 2 0 255] }"
    opaque = effect(CLASSIFY + "{ color = vec4(0.5, 0.25, 1.0, 1.0); }")
    lit = volume(from_left, "ShadedVolumeStyle { lighting TRUE }", opaque)
    text = front_scene("DirectionalLight { direction 0 0 1 effects ", half, " }\n",
                       "DirectionalLight { direction 0 0 1 intensity .25 }\n",
                       *(f"Transform {{ translation {x} 0 0 children [ {lit} ] }}\n"
                         for x in (-0.6, 0.6)))
    # empty behind, dense in front: the normal points away from the viewer, to the light
    got = suite.probe(text, [(3, 8), (12, 8)])
    for name, color in zip(("left", "right"), got):
        suite.close(name, color, (0.375, 0.1875, 0.75, 1), 1e-3)


@suite.case
def many_effects():
    "a hundred effects of one text on one shape"
    step = effect("float step_of(float x) { return x + 0.005; }\n"
                  + MODIFY + "{ color.r = step_of(color.r); }", head="DEF E")
    text = front_scene(quad(BLACK, step + "USE E " * 99))
    suite.close("", suite.middle(text), (0.5, 0, 0, 1), 2e-4)


suite.run()
