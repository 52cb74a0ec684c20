#!/usr/bin/env python3
"""Shaders in the words of older GLSL, and an author's complete shaders with plugs."""

from harness import Suite
from scenes import NO_HEADLIGHT, Row, effect, effect_parts, front_scene, quad, scene

suite = Suite()

BLACK = "UnlitMaterial { emissiveColor 0 0 0 }"
MODIFY = "void PLUG_fragment_modify(inout vec4 color)"
IMAGE = "inputOutput SFNode image PixelTexture { image 2 1 3 0x336699 0xFF0000 }"


def shader(vertex, fragment, fields="", version=""):
    return (
        f"shaders ComposedShader {{ {fields} language \"GLSL\" parts [\n"
        f"ShaderPart {{ type \"VERTEX\" url \"data:text/plain,\n{version}{vertex}\n\" }}\n"
        f"ShaderPart {{ type \"FRAGMENT\" url \"data:text/plain,\n{version}{fragment}\n\" }} ] }}\n")


PLAIN_VERTEX = """attribute vec4 castle_Vertex;
uniform mat4 castle_ModelViewMatrix;
uniform mat4 castle_ProjectionMatrix;
varying vec3 seen;
void main() {
  seen = castle_Vertex.xyz + 0.5;
  gl_Position = castle_ProjectionMatrix * (castle_ModelViewMatrix * castle_Vertex);
}"""


@suite.case
def words():
    "varying, attribute, texture2D, a parameter called texture, inout in, array constructors"
    cases = {
        "texture2D": (effect(f"uniform sampler2D image;\n{MODIFY}{{ color.rgb = texture2D(image, vec2(0.25, 0.5)).rgb; }}",
                             IMAGE), (0.2, 0.4, 0.6)),
        "a parameter called texture": (effect(
            "uniform sampler2D image;\nvec3 read(const in sampler2D texture, vec2 at)"
            "{ return texture2D(texture, at).rgb; }\n" + MODIFY + "{ color.rgb = read(image, vec2(0.25, 0.5)); }",
            IMAGE), (0.2, 0.4, 0.6)),
        "inout in": (effect("void change(inout in vec3 c) { c = c + 0.5; }\n" + MODIFY + "{ change(color.rgb); }"),
                     (0.5, 0.5, 0.5)),
        "array constructor": (effect("const float list[3] = float[3](0.1, 0.2, 0.3);\n" + MODIFY
                                     + "{ color.rgb = vec3(list[0], list[1], list[2]); }"), (0.1, 0.2, 0.3)),
        "own version": (effect("#version 120\n" + MODIFY + "{ color.rgb = vec3(0.25); }"), (0.25,) * 3),
        "integer literals": (effect(MODIFY + "{ color.rgb = vec3(1) * 0.5; float x = 1; color.r = x; }"),
                             (1, 0.5, 0.5)),
        "upgrade macro": (effect("#ifdef CASTLE_GLSL_VERSION_UPGRADE\n" + MODIFY
                                 + "{ color.g = 0.75; }\n#endif\n"), (0, 0.75, 0)),
        "precision": (effect("#ifdef GL_ES\nprecision mediump float;\n#endif\nuniform highp float unset;\n"
                             + MODIFY + "{ color.b = 0.5 + unset; }", "inputOutput SFFloat unset .25"), (0, 0, 0.75)),
    }
    row = Row(suite)
    for content, _ in cases.values():
        row.add(quad(BLACK, content))
    for (name, (_, expected)), got in zip(cases.items(), row.draw()):
        suite.close(name, got, expected + (1,))


@suite.case
def complete_shader():
    "a ComposedShader of old words, its fields, textures and no lights"
    fragment = """uniform sampler2D image;
uniform vec3 tint;
varying vec3 seen;
void main() { gl_FragColor = vec4(seen.xy, texture2D(image, vec2(0.25, 0.5)).b * tint.b, 1.0); }"""
    fields = IMAGE + " inputOutput SFColor tint 0 0 .5"
    row = Row(suite)
    row.add("DirectionalLight { }\n" + quad("Material { }", appearance=shader(PLAIN_VERTEX, fragment, fields)))
    suite.close("", row.draw()[0], (0.375, 0.625, 0.3, 1))


@suite.case
def modern_shader():
    "a ComposedShader of GLSL 3.30"
    version = "#version 330 core\n"
    vertex = PLAIN_VERTEX.replace("attribute", "in").replace("varying", "out")
    fragment = "in vec3 seen;\nout vec4 result;\nvoid main() { result = vec4(seen.xy, 0.25, 1.0); }"
    row = Row(suite)
    row.add(quad("Material { }", appearance=shader(vertex, fragment, version=version)))
    suite.close("", row.draw()[0], (0.375, 0.625, 0.25, 1))


@suite.case
def own_plugs():
    "plugs in a complete shader: built-in names and own ones are open to effects"
    fragment = """varying vec3 seen;
/* PLUG-DECLARATIONS */
void main() {
  vec4 color = vec4(seen.xy, 0.0, 1.0);
  float heat = 0.25;
  /* PLUG: heat_change (heat) */
  color.b = heat;
  /* PLUG: fragment_modify (color) */
  gl_FragColor = color;
}"""
    heat = effect("void PLUG_heat_change(inout float heat) { heat *= 3.0; }")
    swap = effect(MODIFY + "{ color.rg = color.gr; }")
    row = Row(suite)
    row.add(quad("Material { }", heat + swap, shader(PLAIN_VERTEX, fragment)))
    row.add(quad("Material { }", "", shader(PLAIN_VERTEX, fragment)))
    row.add(quad("Material { }", heat, shader(PLAIN_VERTEX, fragment.replace("/* PLUG-DECLARATIONS */", ""))))
    got = row.draw()
    suite.close("both", got[0], (0.625, 0.375, 0.75, 1))
    suite.close("none", got[1], (0.375, 0.625, 0.25, 1))
    suite.close("without PLUG-DECLARATIONS", got[2], (0.375, 0.625, 0.75, 1))


@suite.case
def vertex_plugs_in_complete_shader():
    "a plug in the vertex stage of a complete shader"
    vertex = PLAIN_VERTEX.replace("  gl_Position", "  vec4 v = castle_Vertex;\n"
                                  "  /* PLUG: vertex_object_space_change (v, n) */\n  gl_Position").replace(
        "castle_ModelViewMatrix * castle_Vertex)", "castle_ModelViewMatrix * v)").replace(
        "void main() {", "void main() {\n  vec3 n = vec3(0.0, 0.0, 1.0);")
    fragment = "varying vec3 seen;\nvoid main() { gl_FragColor = vec4(1.0, seen.y, 0.0, 1.0); }"
    move = effect("void PLUG_vertex_object_space_change(inout vec4 v, inout vec3 n) { v.x += 1.0; }",
                  kind="VERTEX")
    row = Row(suite)
    row.add(quad("Material { }", move, shader(vertex, fragment)))
    row.add("")
    got = row.draw()
    suite.close("moved away", got[0], (0, 0, 0, 0))
    suite.close("to the next cell", got[1], (1, 0.625, 0, 1))


@suite.case
def broken_shader():
    "a broken complete shader falls back to the next one, then to the material; an error tells where"
    good = shader(PLAIN_VERTEX, "varying vec3 seen;\nvoid main() { gl_FragColor = vec4(0.0, 1.0, 0.0, 1.0); }")
    bad = shader(PLAIN_VERTEX, "varying vec3 seen;\nvoid main() { gl_FragColor = vec4(undefined_name, 1.0); }")
    body = lambda s: s[len("shaders "):]
    text = front_scene(quad("UnlitMaterial { emissiveColor 0 0 1 }",
                            appearance=f"shaders [ {body(bad)} {body(good)} ]"))
    result = suite.render(text, "--probe", "8,8", status=1)
    suite.close("the next one", [float(w) for w in result.output.split()], (0, 1, 0, 1))
    line = next(i for i, l in enumerate(text.splitlines(), 1) if "undefined_name" in l)
    suite.check("its line", [m for m in result.messages() if m[1] == line and m[3] == "error"], result.errors)
    text = front_scene(quad("UnlitMaterial { emissiveColor 0 0 1 }", appearance=bad))
    result = suite.render(text, "--probe", "8,8", status=1)
    suite.close("the material", [float(w) for w in result.output.split()], (0, 0, 1, 1))


suite.run()
