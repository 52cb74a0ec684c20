#!/usr/bin/env python3
"""The words and ways of GLSL that effects in the wild use, beyond those in legacy.py."""

import math

from harness import Suite
from scenes import NO_HEADLIGHT, Row, effect, effect_parts, front_scene, quad, scene, voxels

suite = Suite()

BLACK = "UnlitMaterial { emissiveColor 0 0 0 }"
MODIFY = "void PLUG_fragment_modify(inout vec4 color)"
IMAGE = "inputOutput SFNode image PixelTexture { repeatS FALSE repeatT FALSE image 2 1 3 0x336699 0xFF0000 }"
LEFT = (0.2, 0.4, 0.6)
SAMPLER = "uniform sampler2D image;\n"
# the probed pixel of a cell: the second of four, counted from the left and from the top
FRAGMENT = (1.5 / 4, 2.5 / 4)
PLACE = (FRAGMENT[0] - 0.5, FRAGMENT[1] - 0.5)


def check_all(cases, head=""):
    """Cases: name, shape, expected red, green and blue; all in one drawing without a word."""
    row = Row(suite)
    for _, content, _ in cases:
        row.add(content)
    for (name, _, expected), got in zip(cases, row.draw(head=head)):
        suite.close(name, got, tuple(expected) + (1,))


def modify(code, head="", fields="", **options):
    return quad(BLACK, effect(head + MODIFY + "{ " + code + " }", fields), **options)


def carry(vertex, head="", fields="", plug="PLUG_vertex_object_space(const in vec4 vertex_object, inout vec3 normal)",
          **options):
    """The vertex part sets `v`, the fragment part shows it."""
    return quad(BLACK, effect_parts((
        ("VERTEX", f"varying vec3 v;\n{head}void {plug} {{ {vertex} }}"),
        ("FRAGMENT", f"varying vec3 v;\n{MODIFY} {{ color.rgb = v; }}")), fields), **options)


@suite.case
def sampling():
    "texture functions of old names"
    volume = "inputOutput SFNode image " + voxels(3, (1, 1, 2), (0x336699, 0xFF0000))
    at = "vec2(0.25, 0.5)"
    check_all([
        (call, modify(f"color.rgb = {call}.rgb;", SAMPLER, IMAGE), LEFT)
        for call in ("texture2DProj(image, vec3(0.5, 1.0, 2.0))", "texture2DProj(image, vec4(0.5, 1.0, 9.0, 2.0))",
                     f"texture2DLod(image, {at}, 0.0)", f"texture2DLod(image, {at}, 0)",
                     "texture2DProjLod(image, vec3(0.5, 1.0, 2.0), 0.0)", f"texture2D(image, {at}, 0.0)",
                     f"textureLod(image, {at}, 0.0)", "textureProj(image, vec3(0.5, 1.0, 2.0))")
    ] + [
        (call, modify(f"color.rgb = {call}.rgb;", "uniform sampler3D image;\n", volume), LEFT)
        for call in ("texture3D(image, vec3(0.5, 0.5, 0.25))", "texture3DLod(image, vec3(0.5, 0.5, 0.25), 0.0)",
                     "texture3DProj(image, vec4(1.0, 1.0, 0.5, 2.0))",
                     "texture3DProjLod(image, vec4(1.0, 1.0, 0.5, 2.0), 0.0)")
    ])


@suite.case
def cube_maps():
    "textureCube reads a cube map"
    faces = " ".join(f"{side} PixelTexture {{ image 1 1 3 {color} }}" for side, color in (
        ("front", "0x336699"), ("back", "0xFF0000"), ("left", "0x00FF00"), ("right", "0x0000FF"),
        ("top", "0xFFFF00"), ("bottom", "0x00FFFF")))
    cube = f"inputOutput SFNode image ComposedCubeMapTexture {{ {faces} }}"
    head = "uniform samplerCube image;\n"
    check_all([
        ("textureCube", modify("color.rgb = textureCube(image, vec3(0.0, 1.0, 0.0)).rgb;", head, cube), (1, 1, 0)),
        ("textureCubeLod", modify("color.rgb = textureCubeLod(image, vec3(0.0, -1.0, 0.0), 0.0).rgb;", head, cube),
         (0, 1, 1)),
    ])


@suite.case
def shadow_maps():
    "shadow2D and shadow2DProj compare with the shadow map of a light, and give a vec4"
    spot = ("SpotLight { location 0 0 5 direction 0 0 -1 shadows TRUE "
            "defaultShadowMap DEF Map GeneratedShadowMap { size 64 update \"ALWAYS\" } }\n")
    code = ("color.r = shadow2DProj(shadowMap, vec4(1.0, 1.0, 0.0002, 2.0)).r * 0.25;"
            " color.g = shadow2D(shadowMap, vec3(0.5, 0.5, 0.0001)).z * 0.5;"
            " color.b = shadow2DProj(shadowMap, vec4(1.0, 1.0, 1.9998, 2.0)).g * 0.5 + 0.125;")
    text = front_scene(spot, "Transform { translation 0 0 3 children [\n", modify(
        code, "uniform sampler2DShadow shadowMap;\n", "initializeOnly SFNode shadowMap USE Map"), "] }\n",
        quad("Material { }"))
    # before the square there is light, behind it none
    suite.close("", suite.middle(text), (0.25, 0.5, 0.125, 1))


@suite.case
def parameters_called_texture():
    "plug functions and helpers with a sampler called texture"
    texture = "texture PixelTexture { repeatS FALSE repeatT FALSE image 2 1 3 0x336699 0xFF0000 effects %s }"
    plug = ("void PLUG_texture_color(inout vec4 texture_color, const in sampler2D texture, const in vec4 tex_coord)"
            "{ texture_color = texture2D(texture, vec2(0.25, 0.5)); }")
    helper = ("vec4 pick(const in sampler2D texture, const in vec2 at) { return texture2D(texture, at); }\n"
              "void PLUG_texture_color(inout vec4 texture_color, const sampler2D texture, const vec4 tex_coord)"
              "{ texture_color = pick(texture, vec2(0.25, 0.5)); }")
    # without a sampler: for every kind of texture
    none = "void PLUG_texture_color(inout vec4 texture_color, const in vec4 tex_coord) { texture_color.rgb = tex_coord.xyz; }"
    check_all([
        ("of a plug", quad("UnlitMaterial { }", appearance=texture % effect(plug)), LEFT),
        ("handed on to a helper", quad("UnlitMaterial { }", appearance=texture % effect(helper)), LEFT),
        ("from Appearance", quad("UnlitMaterial { }", effect(plug), texture % "[ ]"), LEFT),
        ("no sampler", quad("UnlitMaterial { }", appearance=texture % effect(none)), FRAGMENT + (0,)),
        ("GLSL that was upgraded by hand", quad("UnlitMaterial { }", appearance=texture % effect(
            "#ifdef CASTLE_GLSL_VERSION_UPGRADE\n#define texture2D texture\n#endif\n"
            + plug.replace("sampler2D texture", "sampler2D t").replace("texture2D(texture", "texture2D(t"))), LEFT),
    ])


@suite.case
def qualifiers():
    "qualifiers that only some compilers take, in every order"
    plug = "PLUG_vertex_object_space({} vec4 vertex_object, {} vec3 normal)"
    check_all([
        (f"{first} | {second}", carry(code, plug=plug.format(first, second)), expected)
        for first, second, code, expected in (
            ("const in", "inout in", "normal = normal + vec3(0.25, 0.5, 0.0); v = normal * 0.5;", (0.125, 0.25, 0.5)),
            ("in const", "in inout", "normal.z = 0.5; v = normal;", (0, 0, 0.5)),
            ("const", "inout", "v = vertex_object.xyz + 0.5;", FRAGMENT + (0.5,)),
            ("in", "in", "v = normal * 0.5;", (0, 0, 0.5)),
            ("inout", "out", "normal = vec3(0.25); v = normal;", (0.25,) * 3),
            ("const inout", "const", "v = normal * 0.25;", (0, 0, 0.25)),
        )])


@suite.case
def redeclared_host_names():
    "host uniforms and attributes that an effect declares again, or only elsewhere than on GL ES"
    guarded = "#ifndef GL_ES\nuniform mat3 castle_NormalMatrix;\nuniform mat4 castle_ModelViewMatrix;\n#endif\n"
    turn = "Transform {{ rotation 0 1 0 .5 children [ {} ] }}\n"
    side = (math.sin(0.5) / 2 + 0.5, 0.5, math.cos(0.5) / 2 + 0.5)
    show = "color.rgb = castle_NormalMatrix * vec3(0.0, 0.0, 1.0) * 0.5 + 0.5;"
    both = ("uniform mat3 castle_NormalMatrix;\n", guarded, "uniform highp mat3 castle_NormalMatrix;\n",
            "uniform mat3 castle_NormalMatrix, unused;\n", "#ifdef GL_ES\nerror\n#else\n" + guarded + "#endif\n")
    check_all([(repr(head), turn.format(modify(show, head)), side) for head in both] + [
        ("in two effects and two stages", turn.format(quad(BLACK, effect_parts((
            ("VERTEX", guarded + "varying vec3 v;\nvoid PLUG_vertex_eye_space(const in vec4 p, const in vec3 n)"
                                 "{ v = castle_NormalMatrix * vec3(0.0, 0.0, 1.0); }"),
            ("FRAGMENT", guarded + "varying vec3 v;\n" + MODIFY + "{ color.rgb = v; }")))
            + effect(guarded + MODIFY + "{ color.rgb = color.rgb * 0.5 + 0.5 + 0.0 * castle_NormalMatrix[0]; }"))),
         side),
        ("a matrix field", modify("color.rgb = vec3(1.0, 0.0, 0.0) * turn;", "uniform highp mat3 turn;\n",
                                  "inputOutput SFMatrix3f turn .25 .5 .75 0 0 0 0 0 0"), (0.25, 0.5, 0.75)),
    ])


@suite.case
def attributes():
    "the attributes of the geometry, by their castle_ names and by those of old GLSL"
    square = ("IndexedFaceSet { coordIndex [0 1 2 3 -1] texCoordIndex [0 0 0 0 -1] colorPerVertex TRUE coord Coordinate {"
              " point [-.5 -.5 0, .5 -.5 0, .5 .5 0, -.5 .5 0] } %s }")
    coords = ("texCoord MultiTextureCoordinate { texCoord [ TextureCoordinate { point [.25 .5] }"
              " TextureCoordinate { point [.75 .125] } ] }")
    colors = "color Color { color [.25 .5 1, .25 .5 1, .25 .5 1, .25 .5 1] }"
    plain = {"geometry": square % coords}
    check_all([
        ("castle_MultiTexCoord0", carry("v = castle_MultiTexCoord0.xyw;", "attribute vec4 castle_MultiTexCoord0;\n",
                                        **plain), (0.25, 0.5, 1)),
        ("castle_MultiTexCoord1", carry("v = castle_MultiTexCoord1.xyw;", "attribute vec4 castle_MultiTexCoord1;\n",
                                        **plain), (0.75, 0.125, 1)),
        ("castle_MultiTexCoord7: as the last", carry("v = castle_MultiTexCoord7.xyw;",
                                                     "attribute vec4 castle_MultiTexCoord7;\n", **plain), (0.75, 0.125, 1)),
        ("gl_MultiTexCoord1", carry("v = gl_MultiTexCoord1.xyw;", **plain), (0.75, 0.125, 1)),
        ("without a declaration", carry("v = castle_MultiTexCoord0.xyw;", **plain), (0.25, 0.5, 1)),
        ("castle_ColorPerVertex", carry("v = castle_ColorPerVertex.rgb;", "attribute vec4 castle_ColorPerVertex;\n",
                                        geometry=square % colors), (0.25, 0.5, 1)),
        ("castle_Vertex and castle_Normal", carry("v = vec3(castle_Vertex.xy + 0.5, castle_Normal.z * 0.5);",
                                                  "attribute vec4 castle_Vertex;\nattribute vec3 castle_Normal;\n"),
         FRAGMENT + (0.5,)),
        ("gl_Vertex and gl_Normal", carry("v = vec3(gl_Vertex.xy + 0.5, gl_Normal.z * 0.5);"), FRAGMENT + (0.5,)),
    ])


@suite.case
def texture_coordinates_of_fragments():
    "castle_TexCoord0 and later ones as inputs of the fragment stage"
    texture = "texture PixelTexture { image 1 1 3 0xFFFFFF }"
    declared = "varying vec4 castle_TexCoord0;\n"
    check_all([
        ("declared", quad("UnlitMaterial { }", effect(declared + MODIFY + "{ color.rgb = castle_TexCoord0.xyw; }"),
                          texture), FRAGMENT + (1,)),
        ("as an input of GLSL 1.30", quad("UnlitMaterial { }", effect(
            "#version 130\nin vec4 castle_TexCoord0;\n" + MODIFY + "{ color.rgb = castle_TexCoord0.xyw; }"), texture),
         FRAGMENT + (1,)),
        ("by two effects", quad("UnlitMaterial { }", effect(
            declared + MODIFY + "{ color.r = castle_TexCoord0.x; }") + effect(
                declared + MODIFY + "{ color.g = castle_TexCoord0.y; }"), texture), FRAGMENT + (1,)),
    ])


@suite.case
def built_in_variables():
    "gl_FragCoord, gl_FrontFacing, derivatives"
    check_all([
        ("gl_FragCoord", modify("color.rgb = vec3(mod(gl_FragCoord.xy, 4.0) * 0.25, 0.0);"), FRAGMENT + (0,)),
        ("gl_FrontFacing", modify("color.rgb = vec3(gl_FrontFacing ? 0.75 : 0.25);"), (0.75,) * 3),
        ("dFdx and dFdy", quad(BLACK, effect_parts((
            ("VERTEX", "varying vec2 v;\nvoid PLUG_vertex_object_space(const in vec4 o, inout vec3 n) { v = o.xy; }"),
            ("FRAGMENT", "varying vec2 v;\n" + MODIFY + "{ color.rgb = vec3(dFdx(v.x), dFdy(v).y, fwidth(v.x)); }")))),
         (0.25, 0.25, 0.25)),
    ])


@suite.case
def implicit_conversions():
    "whole numbers where floats are meant"
    cases = {
        "vec3(1) / 2": (0.5,) * 3, "vec3(0.25, 0.5, 1)": (0.25, 0.5, 1), "pow(vec3(0.5), vec3(2))": (0.25,) * 3,
        "vec3(pow(0.5, 2))": (0.25,) * 3, "mix(vec3(0), vec3(1), 0.25)": (0.25,) * 3,
        "vec3(max(-0.5, 0) + 0.5)": (0.5,) * 3, "vec3(clamp(1.5, 0, 1))": (1,) * 3, "vec3(mod(2.25, 1))": (0.25,) * 3,
        "vec3(smoothstep(0, 1, 0.5))": (0.5,) * 3, "2 * vec3(0.25)": (0.5,) * 3, "vec3(step(0, 0.5)) - 0.5": (0.5,) * 3,
    }
    check_all([(expression, modify(f"color.rgb = {expression};"), expected) for expression, expected in cases.items()]
              + [("arguments of functions", modify("color.rgb = vec3(half(1));", "float half(float x) { return x / 2; }\n"),
                  (0.5,) * 3),
                 ("initialisers", modify("float x = 1; const float y = 2; color.rgb = vec3(x / y);"), (0.5,) * 3)])


@suite.case
def conditionals():
    "GL_ES, precision and versions"
    vertex = "void PLUG_vertex_object_space(const in vec4 vertex_object, inout vec3 normal)"
    check_all([
        ("precision for GL ES", modify("color.r = 0.5;", "#ifdef GL_ES\nprecision mediump float;\n#endif\n"), (0.5, 0, 0)),
        ("precision without asking", modify("lowp float x = 0.5; color.r = x;", "precision highp float;\n"), (0.5, 0, 0)),
        ("GL_ES is not defined", modify("\n#ifdef GL_ES\ncolor.r = 1.0;\n#else\ncolor.g = 0.5;\n#endif\n"), (0, 0.5, 0)),
        ("upgraded: vertex part", carry("\n#ifdef CASTLE_GLSL_VERSION_UPGRADE\nv = vec3(0.5);\n#else\nv = vec3(0.0);\n"
                                        "#endif\n"), (0.5,) * 3),
        ("__VERSION__", modify("\n#if __VERSION__ >= 130\ncolor.b = 0.5;\n#endif\n"), (0, 0, 0.5)),
        ("300 es", modify("color.rgb = texture(image, vec2(0.25, 0.5)).rgb;",
                          "#version 300 es\nprecision highp float;\n" + SAMPLER, IMAGE), LEFT),
        ("parts of different versions", quad(BLACK, effect_parts((
            ("VERTEX", "#version 130\nout vec3 v;\n" + vertex + "{ v = vec3(0.25); }"),
            ("FRAGMENT", "varying vec3 v;\n" + MODIFY + "{ color.rgb = v; }")))
            + effect("#version 330 core\n" + MODIFY + "{ color.g = 0.5; }")
            + effect("#version 120\n" + MODIFY + "{ color.b = 0.75; }")), (0.25, 0.5, 0.75)),
    ])


@suite.case
def prose():
    "names of plugs in comments and in text that is not there call nothing"
    check_all([
        ("in comments", modify("color.r = 0.5; /* not PLUG_fog_apply (color, normal) */",
                               "/* see PLUG_fog_apply (inout vec4 c) { } */ // PLUG_fragment_end(x)\n"), (0.5, 0, 0)),
        ("in #if 0", modify("color.r = 0.5;", "#if 0\nvoid PLUG_fragment_end(inout vec4 c) { c.g = 1.0; }\n#endif\n"),
         (0.5, 0, 0)),
        ("a plug that begins another's name", quad(BLACK, effect(
            "void PLUG_vertex_object_space(const in vec4 o, inout vec3 n) { }\n"
            "void PLUG_vertex_object_space_change(inout vec4 o, inout vec3 n) { o.x += 1.0; }", kind="VERTEX")
            + effect(MODIFY + "{ color.r = 1.0; }")) + quad("UnlitMaterial { emissiveColor 0 1 0 }"), (0, 1, 0)),
    ])


SHADER_VERTEX = """attribute vec4 castle_Vertex;
attribute vec4 castle_MultiTexCoord0;
uniform mat4 castle_ModelViewMatrix;
uniform mat4 castle_ProjectionMatrix;
varying vec4 seen;
void main() {
  seen = castle_MultiTexCoord0;
  gl_Position = castle_ProjectionMatrix * castle_ModelViewMatrix * castle_Vertex;
}"""


def shader(vertex, fragment, fields=""):
    return (f"shaders ComposedShader {{ {fields} language \"GLSL\" parts [\n"
            f"ShaderPart {{ type \"VERTEX\" url \"data:text/plain,\n{vertex}\n\" }}\n"
            f"ShaderPart {{ type \"FRAGMENT\" url \"data:text/plain,\n{fragment}\n\" }} ] }}\n")


@suite.case
def complete_shaders():
    "complete shaders in the words of fixed functions and of GL ES"
    old_vertex = """void main() {
  gl_TexCoord[0] = gl_TextureMatrix[0] * gl_MultiTexCoord0;
  gl_FrontColor = vec4(0.25);
  gl_Position = ftransform();
}"""
    es_vertex = SHADER_VERTEX.replace("attribute", "in").replace("varying", "out")
    check_all([
        ("ftransform, gl_TexCoord, gl_TextureMatrix", quad(appearance=shader(
            old_vertex, "void main() { gl_FragColor = vec4(gl_TexCoord[0].st, gl_Color.r, 1.0); }")), FRAGMENT + (0.25,)),
        ("300 es", quad(appearance=shader(
            "#version 300 es\n" + es_vertex, "#version 300 es\nprecision mediump float;\nin vec4 seen;\n"
            "out vec4 result;\nvoid main() { result = vec4(seen.st, 0.5, 1.0); }")), FRAGMENT + (0.5,)),
        ("130 with parts of 110", quad(appearance=shader(
            "#version 130\n" + es_vertex, "varying vec4 seen;\nvoid main() { gl_FragColor = vec4(seen.st, 0.5, 1); }")),
         FRAGMENT + (0.5,)),
        ("no light and no texture of the engine's", "DirectionalLight { direction 0 0 -1 }\n" + quad(
            "Material { }", appearance="texture PixelTexture { image 1 1 3 0xFF0000 }\n" + shader(
                SHADER_VERTEX, "varying vec4 seen;\n/* PLUG-DECLARATIONS */\n"
                "void main() { gl_FragColor = vec4(seen.st, 0.5, 1.0); }")), FRAGMENT + (0.5,)),
    ])


@suite.case
def plugs_of_complete_shaders():
    "plugs that a complete shader offers under the names of old built-in ones; others are silent there"
    fragment = """varying vec4 seen;
%s
void main() {
  vec4 color = vec4(seen.st, 0.0, 1.0);
  vec3 normal = vec3(0.0, 0.0, 1.0);
  /* PLUG: texture_apply (color, normal) */
  gl_FragColor = color;
}"""
    apply = effect("void PLUG_texture_apply(inout vec4 color, const in vec3 normal) { color.b = normal.z * 0.5; }")
    others = effect("void PLUG_fog_apply(inout vec4 c, const vec3 n) { c.r = 0.0; }\n"
                    "void PLUG_light_scale(inout float s, const in vec3 n, const in vec3 l) { s = 0.0; }\n"
                    "void PLUG_texture_color(inout vec4 c, const in vec4 t) { c.r = 0.0; }")
    for head in ("/* PLUG-DECLARATIONS */", "", "#version 120\n"):
        text = fragment % head if not head.startswith("#") else head + fragment % ""
        content = quad("Material { }", apply + others, shader(SHADER_VERTEX, text))
        result = suite.render(front_scene(content), "--probe", "7,8")
        suite.close(f"{head!r}", [float(w) for w in result.output.split()], (0.4375, 0.4375, 0.5, 1))
        suite.equal("without a word", result.messages(), [])
    for name, told in (("of_another_shape", []), ("texture_aply", ["unknown-plug"])):
        content = quad("Material { }", apply + effect(f"void PLUG_{name}(inout vec4 c) {{ c.r = 0.0; }}"),
                       shader(SHADER_VERTEX, fragment % ""))
        result = suite.render(front_scene(content), "--probe", "7,8")
        suite.equal(f"{name}: what is said of it", [m[5] for m in result.messages()], told)


@suite.case
def library():
    "the functions between eye and world space, forward-declared by the author, in every stage"
    declared = ("vec4 position_eye_to_world_space(vec4 position_eye);\nvec4 position_world_to_eye_space(vec4 position);\n"
                "vec3 direction_eye_to_world_space(vec3 direction_eye);\nvec3 direction_world_to_eye_space(vec3 direction);\n")
    named = 'shaderLibraries "castle-shader:/EyeWorldSpace.glsl"'
    view = ("OrthoViewpoint { position 4 0 1 orientation 0 1 0 1.5707963267949 fieldOfView -1 -1 1 1 }\n" + NO_HEADLIGHT)
    turned = "Transform { translation 0 0 1 rotation 0 1 0 1.5707963267949 children [ %s ] }\n"
    # world: x = 0, y up, z from 1.5 on the left to 0.5 on the right; the quad looks to +x
    world = "vec3(w.x + 0.25, w.y + 0.5, w.z - 0.5)"
    back = ("position_world_to_eye_space(w) - vertex_eye", "direction_world_to_eye_space(d) - normal_eye")
    vertex = (declared + "varying vec3 v;\nvoid PLUG_vertex_eye_space(const in vec4 vertex_eye, const in vec3 normal_eye)"
              " { vec4 w = position_eye_to_world_space(vertex_eye); v = " + world + "; }")
    fragment = (declared + "void PLUG_fragment_eye_space(const vec4 vertex_eye, inout vec3 normal_eye) {\n"
                "  vec4 w = position_eye_to_world_space(vertex_eye);\n  vec3 d = direction_eye_to_world_space(normal_eye);\n"
                f"  seen = length({back[0]}) + length({back[1]}) < 0.001 ? {world} + d - vec3(1.0, 0.0, 0.0) : vec3(0.0);\n}}\n"
                + MODIFY + "{ color.rgb = seen; }")
    geometry = ("layout(triangles) in;\nlayout(triangle_strip, max_vertices = 3) out;\n" + declared
                + "in vec4 place[];\nout vec3 carried;\nvoid main() {\n  for (int i = 0; i < 3; i++) {\n"
                "    vec4 w = position_eye_to_world_space(place[i]);\n    carried = " + world + ";\n"
                "    geometryVertexSet(i);\n    EmitVertex();\n  }\n  EndPrimitive();\n}")
    contents = {
        "vertex": effect_parts((("VERTEX", vertex), ("FRAGMENT", "varying vec3 v;\n" + MODIFY + "{ color.rgb = v; }")),
                               named),
        "fragment": effect("vec3 seen;\n" + fragment, named),
        "without being named": effect("vec3 seen;\n" + fragment),
        "geometry": effect_parts((
            ("VERTEX", "varying vec4 place;\nvoid PLUG_vertex_eye_space(const in vec4 e, const in vec3 n) { place = e; }"),
            ("GEOMETRY", geometry), ("FRAGMENT", "varying vec3 carried;\n" + MODIFY + "{ color.rgb = carried; }")), named),
    }
    for name, content in contents.items():
        result = suite.render(scene(view, turned % quad("UnlitMaterial { }", content)), "--probe", "7,7")
        suite.close(name, [float(w) for w in result.output.split()], (0.25, 0.5625, 0.5625, 1))
        suite.equal(f"{name}: without a word", result.messages(), [])
    text = front_scene(quad(BLACK, effect(MODIFY + "{ color.r = 1.0; }", 'shaderLibraries [ "castle-shader:/EyeWorldSpace.glsl",'
                                          '\n"castle-shader:/Other.glsl" ]')))
    result = suite.render(text, "--probe", "8,8")
    line = next(i for i, l in enumerate(text.splitlines(), 1) if "Other.glsl" in l)
    suite.equal("an unknown library", [m[1:4:2] for m in result.messages()], [(line, "warning")])


suite.run()
