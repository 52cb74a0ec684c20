#!/usr/bin/env python3
"""The plugs of surfaces: when they are called, what their parameters are."""

import math

from harness import Suite, blinn_phong, unit
from scenes import NO_HEADLIGHT, Row, effect, effect_parts, front_scene, quad, scene

suite = Suite()

MATERIAL = ("Material { diffuseColor .6 .4 .2 specularColor .3 .5 .7 shininess .1 "
            "ambientIntensity .5 emissiveColor .05 .1 0 }")
DIRECTION = (1.0, -1.0, -2.0)
LIGHT = "DirectionalLight { direction 1 -1 -2 ambientIntensity .2 intensity .8 }\n"
L = unit((-1, 1, 2))
VIEW = (0, 0, 1)


def lit(diffuse=(0.6, 0.4, 0.2), specular=(0.3, 0.5, 0.7), shininess=12.8, ambient=None,
        emissive=(0.05, 0.1, 0), normal=(0, 0, 1), scale=1.0, alpha=1.0):
    """A material under LIGHT alone."""
    ambient = ambient or tuple(0.5 * d for d in diffuse)
    shine = blinn_phong(normal, L, VIEW, diffuse, specular, shininess)
    rgb = tuple(e + scale * (0.2 * a + 0.8 * s) for e, a, s in zip(emissive, ambient, shine))
    return rgb + (alpha,)


def check_all(cases, head=""):
    """Cases: name, shape with its lights, expected colour."""
    row = Row(suite)
    for _, content, _ in cases:
        row.add(content)
    for (name, _, expected), got in zip(cases, row.draw(head=head)):
        suite.close(name, got, expected)


def unlit_with(code, kind="FRAGMENT", color=".2 .4 .6", **options):
    return quad(f"UnlitMaterial {{ emissiveColor {color} }}", effect(code, kind=kind), **options)


def lit_with(code, **options):
    return LIGHT + quad(MATERIAL, effect(code), **options)


@suite.case
def materials():
    "what the plugs start from: materials in closed form"
    check_all((
        ("unlit", quad("UnlitMaterial { emissiveColor .2 .4 .6 }"), (0.2, 0.4, 0.6, 1)),
        ("unlit, default", quad("UnlitMaterial { }"), (1, 1, 1, 1)),
        ("no material", quad(""), (1, 1, 1, 1)),
        ("no light: emissive", quad(MATERIAL), (0.05, 0.1, 0, 1)),
        ("lit", LIGHT + quad(MATERIAL), lit()),
        ("a light does not change what is unlit", LIGHT + quad("UnlitMaterial { emissiveColor .2 .4 .6 }"),
         (0.2, 0.4, 0.6, 1)),
        ("transparent", quad("UnlitMaterial { emissiveColor 1 .5 0 transparency .75 }"),
         (0.25, 0.125, 0, 0.25)),
        ("two lights", LIGHT + LIGHT + quad(MATERIAL.replace("emissiveColor .05 .1 0", "")),
         [2 * v for v in lit(emissive=(0, 0, 0))[:3]] + [1]),
        ("a light that is off", LIGHT.replace("{", "{ on FALSE", 1) + quad(MATERIAL),
         (0.05, 0.1, 0, 1)),
    ))


@suite.case
def headlight():
    "the headlight shines along the view"
    text = scene("OrthoViewpoint { position 0 0 10 fieldOfView -1 -1 1 1 }\n", quad(MATERIAL))
    shine = blinn_phong((0, 0, 1), VIEW, VIEW, (0.6, 0.4, 0.2), (0.3, 0.5, 0.7), 12.8)
    suite.close("", suite.middle(text), [e + s for e, s in zip((0.05, 0.1, 0), shine)] + [1])


@suite.case
def final_colours():
    "fragment_modify, fog_apply and fragment_end, in this order"
    check_all((
        ("fragment_modify", unlit_with(
            "void PLUG_fragment_modify(inout vec4 color) { color.rgb = color.bgr * 0.5; }"),
         (0.3, 0.2, 0.1, 1)),
        ("fog_apply: colour and normal", LIGHT + quad(MATERIAL, effect(
            "void PLUG_fog_apply(inout vec4 color, const vec3 normal_eye)"
            "{ color.rgb = normal_eye * 0.5 + 0.25; }")), (0.25, 0.25, 0.75, 1)),
        ("fragment_end", unlit_with(
            "void PLUG_fragment_end(inout vec4 color) { color.g = 1.0 - color.g; }"),
         (0.2, 0.6, 0.6, 1)),
        ("all three", unlit_with(
            "void PLUG_fragment_end(inout vec4 color) { color.rgb = color.rgb * 0.5; }\n"
            "void PLUG_fog_apply(inout vec4 color, const vec3 n) { color.rgb += 0.2; }\n"
            "void PLUG_fragment_modify(inout vec4 color) { color.rgb *= 2.0; }"),
         (0.3, 0.5, 0.7, 1)),
        ("an opaque surface stays opaque", unlit_with(
            "void PLUG_fragment_modify(inout vec4 color) { color.a = 0.25; }"),
         (0.2, 0.4, 0.6, 1)),
    ))


@suite.case
def before_light():
    "main_texture_apply gets the diffuse colour before light; texture_apply is its alias"
    code = "void PLUG_{}(inout vec4 color, const in vec3 normal_eye) {{ color.rgb = color.bgr * normal_eye.z; }}"
    check_all(tuple(
        (f"{name}, {kind}", content, expected)
        for name in ("main_texture_apply", "texture_apply")
        for kind, content, expected in (
            ("lit", lit_with(code.format(name)), lit(diffuse=(0.2, 0.4, 0.6))),
            ("unlit", unlit_with(code.format(name).replace("* normal_eye.z", "")), (0.6, 0.4, 0.2, 1)),
        )))


@suite.case
def material_plugs():
    "material_* change what the lights get"
    check_all((
        ("material_ambient", lit_with(
            "void PLUG_material_ambient(inout vec3 ambient) { ambient = ambient.bgr * 2.0; }"),
         lit(ambient=(0.2, 0.4, 0.6))),
        ("material_specular", lit_with(
            "void PLUG_material_specular(inout vec3 specular) { specular *= 0.5; }"),
         lit(specular=(0.15, 0.25, 0.35))),
        ("material_shininess: the exponent itself", lit_with(
            "void PLUG_material_shininess(inout float shininess) { shininess *= 2.0; }"),
         lit(shininess=25.6)),
        ("material_emissive", lit_with(
            "void PLUG_material_emissive(inout vec3 emissive) { emissive += vec3(0.0, 0.0, 0.2); }"),
         lit(emissive=(0.05, 0.1, 0.2))),
        ("material_light_ambient", lit_with(
            "void PLUG_material_light_ambient(inout vec3 ambient) { ambient += vec3(0.1, 0.0, 0.0); }"),
         [v + e for v, e in zip(lit(), (0.1, 0, 0, 0))]),
        ("material_occlusion: after the lights, before emissive", lit_with(
            "void PLUG_material_occlusion(inout vec4 color) { color.rgb *= 0.5; }"),
         [e + 0.5 * v for e, v in zip((0.05, 0.1, 0), lit(emissive=(0, 0, 0)))] + [1]),
    ))


@suite.case
def light_plugs():
    "light_scale and lighting_apply"
    scale = ("void PLUG_light_scale(inout float scale, const in vec3 normal_eye, const in vec3 light_dir)"
             "{ scale *= 0.5 * normal_eye.z * light_dir.z / %r; }" % L[2])
    check_all((
        ("light_scale, one half", lit_with(scale), lit(scale=0.5)),
        ("light_scale: direction to the light", lit_with(
            "vec3 seen;\n"
            "void PLUG_light_scale(inout float scale, const in vec3 normal_eye, const in vec3 light_dir)"
            "{ seen = light_dir; }\n"
            "void PLUG_fragment_modify(inout vec4 color) { color.rgb = seen * 0.5 + 0.5; }"),
         [0.5 + v / 2 for v in L] + [1]),
        ("lighting_apply", lit_with(
            "void PLUG_lighting_apply(inout vec4 color, const vec4 vertex_eye, const vec3 normal_eye)"
            "{ color.rgb = vec3(color.r, -0.05 * vertex_eye.z * vertex_eye.w, normal_eye.z * 0.25); }"),
         (lit()[0], 0.5, 0.25, 1)),
        ("light_scale without lights is silent", quad(MATERIAL, effect(scale)), (0.05, 0.1, 0, 1)),
    ))


@suite.case
def normals():
    "fragment_eye_space may change the normal before light"
    normal = unit((0.6, 0.0, 0.8))
    check_all((
        ("fragment_eye_space", lit_with(
            "void PLUG_fragment_eye_space(const vec4 vertex_eye, inout vec3 normal_eye)"
            "{ normal_eye = normalize(normal_eye + vec3(0.75, 0.0, vertex_eye.w - 1.0)); }"),
         lit(normal=normal)),
        ("vertex_object_space", LIGHT + quad(MATERIAL, effect(
            "void PLUG_vertex_object_space(const in vec4 vertex_object, inout vec3 normal_object)"
            "{ normal_object = vec3(0.6, 0.0, 0.8); }", kind="VERTEX")), lit(normal=normal)),
        ("stretched: inverse transpose",
         LIGHT + "Transform { scale 2 1 1 children Transform { rotation 0 1 0 .5 children [ "
         + quad(MATERIAL) + " ] } }", lit(normal=unit((math.sin(0.5) / 2, 0, math.cos(0.5))))),
    ))


@suite.case
def vertex_plugs():
    "plugs of the vertex stage: what they get, what they move"
    moved = ("void PLUG_vertex_object_space_change(inout vec4 vertex_object, inout vec3 normal_object)"
             "{ vertex_object.xy += vec2(1.0, 0.0); }")
    show = "void PLUG_fragment_modify(inout vec4 color) { color.rgb = carried; }"

    def carrying(code):
        return quad("UnlitMaterial { }", effect_parts((
            ("VERTEX", "varying vec3 carried;\n" + code),
            ("FRAGMENT", "varying vec3 carried;\n" + show))))

    x, y = -0.125, 0.125  # of the probed pixel in its cell
    cases = [
        ("vertex_object_space_change moves a shape to the next cell",
         quad("UnlitMaterial { emissiveColor 1 0 0 }", effect(moved, kind="VERTEX")), (0, 0, 0, 0)),
        ("there", "", (1, 0, 0, 1)),
        ("vertex_object_space gets object space", carrying(
            "void PLUG_vertex_object_space(const in vec4 vertex_object, inout vec3 normal_object)"
            "{ carried = vec3(vertex_object.xy + 0.5, normal_object.z); }"), (x + 0.5, y + 0.5, 1, 1)),
        ("vertex_eye_space gets eye space", carrying(
            "void PLUG_vertex_eye_space(const in vec4 vertex_eye, const in vec3 normal_eye)"
            "{ carried = vec3(vertex_eye.x * 0.1, vertex_eye.z * -0.05, normal_eye.z * 0.5); }"),
         ((3.5 + x) / 10, 0.5, 0.5, 1)),
        ("vertex_eye_space_extended gets both normals", LIGHT.replace("1 -1 -2", "0 0 1")
         + "Transform { rotation 1 0 0 .5 children [ " + carrying(
            "void PLUG_vertex_eye_space_extended(const in vec4 vertex_eye, const in vec3 normal_eye,"
            " const in vec3 normal_object) { carried = vec3(normal_object.z,"
            " -normal_eye.y, normal_eye.z) * 0.5; }") + " ] }\n",
         (0.5, math.sin(0.5) / 2, math.cos(0.5) / 2, 1)),
    ]
    check_all(cases)


@suite.case
def moved_towards_the_viewer():
    "vertices that an effect moves far are not cut off"
    for z in (6, -40):
        code = ("void PLUG_vertex_object_space_change(inout vec4 vertex_object,"
                " inout vec3 normal_object) { vertex_object.z += %d.0; }" % z)
        text = front_scene(quad("UnlitMaterial { emissiveColor 0 1 0 }", effect(code, kind="VERTEX")))
        suite.close(f"by {z}", suite.middle(text), (0, 1, 0, 1))


@suite.case
def interpolation():
    "varyings are interpolated along the surface"
    text = front_scene(quad("UnlitMaterial { }", effect_parts((
        ("VERTEX", "varying vec2 place;\nvoid PLUG_vertex_object_space(const in vec4 v, inout vec3 n)"
                   "{ place = v.xy + 0.5; }"),
        ("FRAGMENT", "varying vec2 place;\nvoid PLUG_fragment_modify(inout vec4 c)"
                     "{ c.rg = place; c.b = 0.0; }")))))
    picture = suite.picture(text, size="32x32")
    for x, y in ((8, 8), (23, 8), (16, 23)):
        suite.close(f"pixel {x},{y}", picture.at(x, y),
                    ((x + 0.5) / 16 - 0.5, 1.5 - (y + 0.5) / 16, 0, 1))


@suite.case
def two_sides():
    "the back side: culled if solid, lit with the turned normal if not"
    back = "Transform { rotation 0 1 0 3.14159265358979 children [ %s ] }\n"
    geometry = ("IndexedFaceSet { solid %s coordIndex [0 1 2 3 -1] coord Coordinate { point "
                "[-.5 -.5 0, .5 -.5 0, .5 .5 0, -.5 .5 0] } }")
    check_all((
        ("solid", LIGHT + back % quad(MATERIAL, geometry=geometry % "TRUE"), (0, 0, 0, 0)),
        ("not solid", LIGHT + back % quad(MATERIAL, geometry=geometry % "FALSE"), lit()),
        ("not solid, front", LIGHT + quad(MATERIAL, geometry=geometry % "FALSE"), lit()),
        ("ccw FALSE", LIGHT + quad(MATERIAL, geometry=(geometry % "TRUE").replace("{", "{ ccw FALSE", 1)),
         (0, 0, 0, 0)),
    ))


@suite.case
def geometry_nodes():
    "Box and Sphere: places and normals"
    sphere = ("Shape { appearance Appearance { material UnlitMaterial { } effects %s } "
              "geometry Sphere { radius .5 } }\n") % effect(
        "void PLUG_fog_apply(inout vec4 c, const vec3 normal_eye) { c.rgb = normal_eye * 0.5 + 0.5; }")
    picture = suite.picture(front_scene(sphere), size="64x64")
    for x, y in ((32, 32), (40, 28), (24, 40)):
        px, py = (x + 0.5) / 32 - 1, 1 - (y + 0.5) / 32
        n = (px / 0.5, py / 0.5, math.sqrt(1 - 4 * (px * px + py * py)))
        suite.close(f"sphere, pixel {x},{y}", picture.at(x, y), [v / 2 + 0.5 for v in n] + [1], 0.02)
    covered = sum(picture.at(x, y)[3] for x in range(64) for y in range(64)) / 1024
    suite.close("sphere, its area", covered, math.pi / 4, 0.02)
    box = ("Transform { rotation 0 1 0 .5 children [ Shape { appearance Appearance { material "
           "UnlitMaterial { } effects %s } geometry Box { size .6 .6 .6 } } ] }\n") % effect(
        "void PLUG_fog_apply(inout vec4 c, const vec3 normal_eye) { c.rgb = normal_eye * 0.5 + 0.5; }")
    got = suite.probe(front_scene(box), [(16, 16)], size="32x32")[0]
    suite.close("box", got, (math.sin(0.5) / 2 + 0.5, 0.5, math.cos(0.5) / 2 + 0.5, 1), 1e-3)


@suite.case
def textures():
    "ImageTexture and PixelTexture of an Appearance multiply; texture effects change their colour"
    pixel = "texture PixelTexture { repeatS FALSE repeatT FALSE image 1 1 3 0x3366CC %s }"
    tint = ("effects " + effect(
        "void PLUG_texture_color(inout vec4 texture_color, const in vec4 tex_coord)"
        "{ texture_color.rgb = vec3(tex_coord.xy, 1.0); }"))
    with_sampler = ("effects " + effect(
        "void PLUG_texture_color(inout vec4 texture_color, const in sampler2D tex,"
        " const in vec4 tex_coord) { texture_color.rgb = 1.0 - texture2D(tex, tex_coord.xy).rgb; }"))
    half = "UnlitMaterial { emissiveColor 1 .5 .5 }"
    check_all((
        ("pixel texture", quad(half, appearance=pixel % ""), (0.2, 0.2, 0.4, 1)),
        ("diffuse", LIGHT + quad(MATERIAL, appearance=pixel % ""),
         lit(diffuse=(0.12, 0.16, 0.16))),
        ("texture effect", quad(half, appearance=pixel % tint), (0.375, 0.3125, 0.5, 1)),
        ("texture effect with the sampler", quad(half, appearance=pixel % with_sampler),
         (0.8, 0.3, 0.1, 1)),
    ))


suite.run()
