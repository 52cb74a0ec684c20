#!/usr/bin/env python3
"""Effects with a geometry stage: what they emit, and what goes through it."""

from harness import Suite
from scenes import Row, effect, effect_parts, front_scene, quad

suite = Suite()

LAYOUT = ("#version 150 core\nlayout(triangles) in;\n"
          "layout(triangle_strip, max_vertices = 6) out;\n")
SAME = """void main() {
  for (int i = 0; i < gl_in.length(); i++) { geometryVertexSet(i); EmitVertex(); }
  EndPrimitive();
}"""
PROTOTYPES = """void geometryVertexSet(const int index);
void geometryVertexZero();
void geometryVertexAdd(const int index, const float scale);
"""
# the pixel that is probed lies here in the square of its cell
X, Y = -0.125, 0.125
CARRY = ("VERTEX", "varying vec4 v;\nvoid PLUG_vertex_object_space(const in vec4 vertex_object,"
         " inout vec3 normal_object) { v = vertex_object + vec4(0.5, 0.5, 0.25, 0.0); }")
SHOW = ("FRAGMENT", "varying vec4 v;\nvoid PLUG_fragment_modify(inout vec4 color)"
        "{ color = vec4(v.xyz, 1.0); }")
CARRIED = (X + 0.5, Y + 0.5, 0.25, 1)
UNLIT = "UnlitMaterial { emissiveColor .2 .4 .6 }"
LIGHT = "DirectionalLight { direction 0 0 -1 }\n"
# gl_Position moves by one cell of a row of `count`: 2 / count of clip space
BY_HAND = ("GEOMETRY", """in vec4 v[%s];
out vec4 v_geoshader;
void PLUG_geometry_vertex_set(const int index) { v_geoshader = v[index]; }
void PLUG_geometry_vertex_zero() { v_geoshader = vec4(0.0); }
void PLUG_geometry_vertex_add(const int index, const float scale) { v_geoshader += v[index] * scale; }
""")
BY_HAND_SHOW = ("FRAGMENT", "#ifdef HAS_GEOMETRY_SHADER\n#define v v_geoshader\n#endif\n" + SHOW[1])


def geometry(code, layout=LAYOUT):
    return effect(layout + code, kind="GEOMETRY")


def check_all(cases):
    row = Row(suite)
    for _, content, _ in cases:
        row.add(content)
    for (name, _, expected), got in zip(cases, row.draw()):
        suite.close(name, got, expected)


@suite.case
def passing():
    "every varying passes through a geometry stage that says nothing of it"
    same = geometry(PROTOTYPES + SAME)
    textured = "texture PixelTexture { repeatS FALSE repeatT FALSE image 2 1 3 0x336699 0xFF0000 }"
    check_all((
        ("nothing to pass", quad(UNLIT, same), (0.2, 0.4, 0.6, 1)),
        ("without prototypes", quad(UNLIT, geometry(SAME)), (0.2, 0.4, 0.6, 1)),
        ("an author's varying", quad(UNLIT, effect_parts((CARRY, SHOW)) + same), CARRIED),
        ("before it in the list", quad(UNLIT, same + effect_parts((CARRY, SHOW))), CARRIED),
        ("in one effect", quad(UNLIT, effect_parts((
            CARRY, ("GEOMETRY", LAYOUT + PROTOTYPES + SAME), SHOW))), CARRIED),
        ("marked for an older engine", quad(UNLIT, effect_parts((
            ("VERTEX", "/* VARYING-PASSTHROUGH-GEOMETRY-SHADERS */\n" + CARRY[1]), SHOW)) + same), CARRIED),
        ("two of one name", quad(UNLIT, effect_parts((CARRY, SHOW)) + same + effect_parts((
            ("VERTEX", CARRY[1].replace("vec4(0.5, 0.5, 0.25, 0.0)", "0.5")),
            ("FRAGMENT", "varying vec4 v;\nvoid PLUG_fragment_modify(inout vec4 c) { c.b = v.x; }")))),
         CARRIED[:2] + (X + 0.5, 1)),
        ("normal and place of the light's", LIGHT + quad("Material { diffuseColor .5 .25 1 }", same),
         (0.5, 0.25, 1, 1)),
        ("texture coordinates", quad("UnlitMaterial { }", same, textured), (0.4, 0.3, 0.45, 1)),
        ("colours at the vertices", quad(
            "UnlitMaterial { }", same, geometry="TriangleSet { coord Coordinate { point [-.5 -.5 0, .5 -.5 0,"
            " 0 1 0] } color Color { color [1 .5 0, 1 .5 0, 1 .5 0] } }"), (1, 0.5, 0, 1)),
        ("flat whole numbers", quad(UNLIT, effect_parts((
            ("VERTEX", "#version 130\nflat out int number;\nvoid PLUG_vertex_object_space(const in vec4 o,"
                       " inout vec3 n) { number = 3; }"),
            ("FRAGMENT", "#version 130\nflat in int number;\nvoid PLUG_fragment_modify(inout vec4 c)"
                         "{ c.rgb = vec3(0.25) * number; }"))) + same), (0.75, 0.75, 0.75, 1)),
        ("matrices", quad(UNLIT, effect_parts((
            ("VERTEX", "varying mat3 m;\nvoid PLUG_vertex_object_space(const in vec4 o, inout vec3 n)"
                       "{ m = mat3(0.25, 0.5, 0.75, 0, 0, 0, 0, 0, 0); }"),
            ("FRAGMENT", "varying mat3 m;\nvoid PLUG_fragment_modify(inout vec4 c) { c.rgb = m[0]; }")))
            + same), (0.25, 0.5, 0.75, 1)),
        ("arrays", quad(UNLIT, effect_parts((
            ("VERTEX", "varying float list[3];\nvoid PLUG_vertex_object_space(const in vec4 o, inout vec3 n)"
                       "{ list[0] = 0.25; list[1] = 0.5; list[2] = 0.75; }"),
            ("FRAGMENT", "varying float list[3];\nvoid PLUG_fragment_modify(inout vec4 c)"
                         "{ c.rgb = vec3(list[0], list[1], list[2]); }"))) + same), (0.25, 0.5, 0.75, 1)),
    ))


@suite.case
def by_hand():
    "varyings that authors pass by hand"
    same = geometry(PROTOTYPES + SAME)
    for size in ("", "CASTLE_GEOMETRY_INPUT_SIZE", "gl_in.length()"):
        hand = (BY_HAND[0], LAYOUT + BY_HAND[1] % size)
        check_all((
            (f"v[{size}] and main() of another effect",
             quad(UNLIT, effect_parts((CARRY, hand, BY_HAND_SHOW)) + same), CARRIED),
            ("main() of its own", quad(UNLIT, effect_parts((
                CARRY, hand, ("GEOMETRY", LAYOUT + PROTOTYPES + SAME), BY_HAND_SHOW))), CARRIED),
            ("passed by hand beside one that is not", quad(UNLIT, effect_parts((
                CARRY, hand, BY_HAND_SHOW)) + effect_parts((
                    ("VERTEX", CARRY[1]),
                    ("FRAGMENT", "varying vec4 v;\nvoid PLUG_fragment_modify(inout vec4 c) { c.b = v.y; }"))) + same),
             CARRIED[:2] + (Y + 0.5, 1)),
        ))


@suite.case
def without_main():
    "geometry parts without any main() are left out, with one warning for the effect"
    hand = (BY_HAND[0], BY_HAND[1] % "CASTLE_GEOMETRY_INPUT_SIZE")
    carrying = effect_parts((CARRY, hand, BY_HAND_SHOW), head="DEF Carrying")
    shape = quad(UNLIT, carrying)
    text = front_scene(shape, shape.replace("DEF Carrying Effect", "Effect"))
    result = suite.render(text, "--probe", "7,7", size="16x16")
    suite.close("the fragment stage reads the vertex stage's", [float(w) for w in result.output.split()],
                (0.4375, 0.5625, 0.25, 1))
    suite.equal("a warning for each effect", [m[3:] for m in result.messages()],
                [("warning", "no geometry part has main(): there is no geometry stage", "no-main")] * 2)
    result = suite.render(front_scene("Transform { children DEF S " + shape + "}\nUSE S USE S"), "-o", "a.png")
    suite.equal("one for shapes that share it", len(result.messages()), 1)


@suite.case
def emitting():
    "what a geometry stage emits is drawn: moved, doubled, blended, made of uniforms"
    moved = """uniform float shift;
void main() {
  for (int copy = 0; copy < 2; copy++) {
    for (int i = 0; i < 3; i++) {
      geometryVertexSet(i);
      gl_Position.x += float(copy) * shift * gl_Position.w;
      EmitVertex();
    }
    EndPrimitive();
  }
}"""
    cell = quad(UNLIT, effect(LAYOUT + PROTOTYPES + moved, kind="GEOMETRY",
                              fields="inputOutput SFFloat shift 1"))
    middle = """void main() {
  for (int i = 0; i < 3; i++) {
    geometryVertexZero();
    for (int k = 0; k < 3; k++) geometryVertexAdd(k, k == i ? 0.5 : 0.25);
    EmitVertex();
  }
  EndPrimitive();
}"""
    # the triangle between the middles of the sides of each triangle, from (-1, -1), (3, -1), (-1, 3)
    triangle = "TriangleSet { solid FALSE coord Coordinate { point [-1 -1 0, 3 -1 0, -1 3 0] } }"
    small = quad("UnlitMaterial { }", effect_parts((CARRY, SHOW)) + geometry(PROTOTYPES + middle),
                 geometry=triangle)
    row = Row(suite)
    row.add(cell)
    row.add("")
    got = row.draw()
    suite.close("where it was", got[0], (0.2, 0.4, 0.6, 1))
    suite.close("and in the next cell", got[1], (0.2, 0.4, 0.6, 1))
    picture = suite.picture(front_scene(small), size="16x16")
    # its corners: (0, 0), (1, 0), (0, 1)
    suite.close("outside", picture.at(7, 7), (0, 0, 0, 0))
    suite.close("inside: place and varyings agree", picture.at(10, 6),
                ((10.5 / 8 - 1) + 0.5, (1 - 6.5 / 8) + 0.5, 0.25, 1))


@suite.case
def host_names():
    "castle_* uniforms, own varyings and plugs of the geometry stage; several effects on one main()"
    flat = """in vec4 eye[];
out vec3 facet;
void main() {
  facet = normalize(cross(eye[1].xyz - eye[0].xyz, eye[2].xyz - eye[0].xyz)) * 0.5;
  vec4 shift = castle_ProjectionMatrix * (castle_ModelViewMatrix * vec4(0.0, 0.0, 0.0, 1.0));
  float weight = shift.w;
  /* PLUG: facet_change (facet) */
  for (int i = 0; i < 3; i++) { geometryVertexSet(i); gl_Position.xy *= weight; EmitVertex(); }
  EndPrimitive();
}"""
    own = effect_parts((
        ("VERTEX", "varying vec4 eye;\nvoid PLUG_vertex_eye_space(const in vec4 vertex_eye,"
                   " const in vec3 normal_eye) { eye = vertex_eye; }"),
        ("GEOMETRY", LAYOUT + PROTOTYPES + "uniform mat4 castle_ModelViewMatrix;\n"
                     "uniform mat4 castle_ProjectionMatrix;\n" + flat),
        ("FRAGMENT", "varying vec3 facet;\nvoid PLUG_fragment_modify(inout vec4 color)"
                     "{ color.rgb = facet + 0.25; }")))
    change = effect("void PLUG_facet_change(inout vec3 facet) { facet.xy += 0.125; }", kind="GEOMETRY")
    counted = effect_parts((
        ("GEOMETRY", "out float index_of;\nuniform float part;\n"
                     "void PLUG_geometry_vertex_set(const int index) { index_of = part; }"),
        ("FRAGMENT", "in float index_of;\nvoid PLUG_fragment_modify(inout vec4 c) { c.b = index_of; }")),
        fields="inputOutput SFFloat part .625")
    check_all((
        ("a varying of the stage itself", quad(UNLIT, own), (0.25, 0.25, 0.75, 1)),
        ("a plug of it", quad(UNLIT, own + change), (0.375, 0.375, 0.75, 1)),
        ("and more effects", quad(UNLIT, own + change + counted), (0.375, 0.375, 0.625, 1)),
        ("conditionals see it", quad(UNLIT, geometry(SAME) + effect(
            "void PLUG_fragment_modify(inout vec4 c) {\n#ifdef HAS_GEOMETRY_SHADER\n c.rgb = vec3(0.5);\n"
            "#endif\n}")), (0.5, 0.5, 0.5, 1)),
    ))


@suite.case
def primitives():
    "lines and points in, if the author says so"
    points = "PointSet { coord Coordinate { point [0 0 0] } }"
    lines = "LineSet { vertexCount 2 coord Coordinate { point [-.4 0 0, .4 0 0] } }"
    square = """void main() {
  for (int i = 0; i < 4; i++) {
    geometryVertexSet(%s);
    gl_Position.xy += vec2(i %% 2, i / 2) * %s - %s;
    EmitVertex();
  }
  EndPrimitive();
}"""
    for kind, shape, place in (("points", points, "0"), ("lines", lines, "1")):
        strip = f"#version 150\nlayout({kind}) in;\nlayout(triangle_strip, max_vertices = 4) out;\n"
        content = quad("UnlitMaterial { emissiveColor 0 1 0 }",
                       geometry(square % (place, "0.5", "vec2(0.25)"), strip), geometry=shape)
        picture = suite.picture(front_scene(content), size="16x16")
        x = 8 if kind == "points" else 11
        suite.close(f"{kind}: a square there", picture.at(x, 7), (0, 1, 0, 1))
        covered = sum(picture.at(a, b)[3] for a in range(16) for b in range(16))
        suite.close(f"{kind}: its size", covered, 16)


@suite.case
def other_primitives():
    "an effect whose geometry stage takes something else is left out of that shape, and said so"
    same = effect(LAYOUT + SAME, kind="GEOMETRY", head="DEF Same")
    lines = "LineSet { vertexCount 2 coord Coordinate { point [-1 0 0, 1 0 0] } }"
    turn = effect("void PLUG_fragment_modify(inout vec4 color) { color.rgb = color.bgr; }")
    text = front_scene("Group { children [\n", same, turn, quad(UNLIT), quad(UNLIT, geometry=lines), "] }\n")
    result = suite.render(text, "--probe", "8,7", "--probe", "2,7", "--probe", "2,8", status=1)
    rows = [[float(w) for w in line.split()] for line in result.output.splitlines()]
    suite.close("the square", rows[0], (0.6, 0.4, 0.2, 1))
    suite.check("the line", (0.6, 0.4, 0.2, 1) in [tuple(round(v, 6) for v in row) for row in rows[1:]], rows)
    line = next(i for i, l in enumerate(text.splitlines(), 1) if "layout(triangles) in" in l)
    suite.equal("its word", [(m[1], m[2], m[5]) for m in result.messages()], [(line, 8, "wrong-primitive")])


@suite.case
def complete_shader():
    "complete shaders: their own geometry stage, and the engine's functions where they have none"
    vertex = """attribute vec4 castle_Vertex;
uniform mat4 castle_ModelViewMatrix;
uniform mat4 castle_ProjectionMatrix;
varying vec4 v;
void main() {
  gl_Position = castle_ProjectionMatrix * (castle_ModelViewMatrix * castle_Vertex);
  v = castle_Vertex + 0.5;
}"""
    fragment = "varying vec4 v;\nvoid main() { gl_FragColor = vec4(v.xy, 0.0, 1.0); }"
    own = """in vec4 v[];
out vec4 w;
void main() {
  for (int i = 0; i < 3; i++) { gl_Position = gl_in[i].gl_Position; w = v[i].yxzw; EmitVertex(); }
  EndPrimitive();
}"""

    def shader(*parts):
        text = "".join(f"ShaderPart {{ type \"{kind}\" url \"data:text/plain,\n{code}\n\" }}\n"
                       for kind, code in parts)
        return f"shaders ComposedShader {{ language \"GLSL\" parts [ {text} ] }}\n"

    check_all((
        ("its own", quad("Material { }", appearance=shader(
            ("VERTEX", vertex), ("GEOMETRY", LAYOUT + own),
            ("FRAGMENT", fragment.replace("vec4 v", "vec4 w").replace("v.xy", "w.xy")))),
         (Y + 0.5, X + 0.5, 0, 1)),
        ("an effect's", quad("Material { }", geometry(SAME), shader(
            ("VERTEX", vertex), ("FRAGMENT", fragment))), (X + 0.5, Y + 0.5, 0, 1)),
    ))


@suite.case
def faults():
    "a wrong geometry part is left out at its own line, the rest is drawn"
    bad = effect(LAYOUT + SAME.replace("EndPrimitive", "EndPrimitif"), kind="GEOMETRY")
    text = front_scene(quad(UNLIT, bad + effect_parts((CARRY, SHOW))))
    result = suite.render(text, "--probe", "7,7", status=1)
    suite.close("the other effect", [float(w) for w in result.output.split()],
                (0.4375, 0.5625, 0.25, 1))
    line = next(i for i, l in enumerate(text.splitlines(), 1) if "EndPrimitif" in l)
    suite.equal("its line", [m[1] for m in result.messages()], [line])
    volume = ("VolumeData { voxels PixelTexture3D { image [1 1 1 1 255] } effects "
              + geometry(SAME) + " }\n")
    result = suite.render(front_scene(volume), "--probe", "8,8")
    suite.equal("volumes have no such stage", [m[3::2] for m in result.messages()],
                [("warning", "wrong-stage")])


suite.run()
