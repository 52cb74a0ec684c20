#!/usr/bin/env python3
"""Fields of effects as uniforms: every X3D type, arrays, textures; host uniforms and attributes."""



from files import png
from harness import Suite
from scenes import FRONT, Row, constant, effect, effect_parts, front_scene, quad, scene, volume, voxels

suite = Suite()

MODIFY = "void PLUG_fragment_modify(inout vec4 color)"
BLACK = "UnlitMaterial { emissiveColor 0 0 0 }"


def showing(declaration, field, expression):
    return quad(BLACK, effect(f"uniform {declaration};\n{MODIFY}{{ color.rgb = {expression}; }}",
                              f"inputOutput {field}"))


def check_all(cases, **options):
    row = Row(suite)
    for case in cases:
        row.add(case[1] if len(case) == 3 else showing(*case[1:4]))
    for case, got in zip(cases, row.draw(**options)):
        suite.close(case[0], got[:3], case[-1])


@suite.case
def single_fields():
    "each SF type"
    check_all((
        ("SFBool", "bool x", "SFBool x TRUE", "vec3(x ? 0.5 : 0.0)", (0.5,) * 3),
        ("SFBool FALSE", "bool x", "SFBool x FALSE", "vec3(x ? 0.5 : 0.25)", (0.25,) * 3),
        ("SFInt32", "int x", "SFInt32 x -3", "vec3(float(x + 8) * 0.1)", (0.5,) * 3),
        ("SFFloat", "float x", "SFFloat x 0.625", "vec3(x)", (0.625,) * 3),
        ("SFDouble", "float x", "SFDouble x 0.625", "vec3(x)", (0.625,) * 3),
        ("SFTime", "float x", "SFTime x 0.375", "vec3(x)", (0.375,) * 3),
        ("SFVec2f", "vec2 x", "SFVec2f x .25 .5", "vec3(x, 1.0)", (0.25, 0.5, 1)),
        ("SFVec2d", "vec2 x", "SFVec2d x .25 .5", "vec3(x, 1.0)", (0.25, 0.5, 1)),
        ("SFVec3f", "vec3 x", "SFVec3f x .25 .5 .75", "x", (0.25, 0.5, 0.75)),
        ("SFVec3d", "vec3 x", "SFVec3d x .25 .5 .75", "x", (0.25, 0.5, 0.75)),
        ("SFVec4f", "vec4 x", "SFVec4f x .25 .5 .75 .5", "x.rgb * x.a", (0.125, 0.25, 0.375)),
        ("SFVec4d", "vec4 x", "SFVec4d x .25 .5 .75 .5", "x.rgb * x.a", (0.125, 0.25, 0.375)),
        ("SFColor as vec3", "vec3 x", "SFColor x .25 .5 .75", "x", (0.25, 0.5, 0.75)),
        ("SFColor as vec4", "vec4 x", "SFColor x .25 .5 .75", "x.rgb * x.a", (0.25, 0.5, 0.75)),
        ("SFColorRGBA", "vec4 x", "SFColorRGBA x .25 .5 .75 .5", "x.rgb * x.a", (0.125, 0.25, 0.375)),
        ("SFRotation: axis and angle", "vec4 x", "SFRotation x 0 1 0 .5", "x.rga", (0, 1, 0.5)),
    ))


THREE = "SFMatrix3f x .1 .2 .3 .4 .5 .6 .7 .8 .9"
FOUR = "x " + " ".join(str(i / 100) for i in range(1, 17))


@suite.case
def matrices():
    "matrices are written row by row; they multiply columns"
    check_all((
        ("SFMatrix3f", "mat3 x", THREE, "x * vec3(1.0, 0.0, 0.0)", (0.1, 0.4, 0.7)),
        ("SFMatrix3d", "mat3 x", THREE.replace("3f", "3d"), "x[1]", (0.2, 0.5, 0.8)),
        ("SFMatrix4f", "mat4 x", "SFMatrix4f " + FOUR, "(x * vec4(0.0, 0.0, 0.0, 1.0)).xyz",
         (0.04, 0.08, 0.12)),
        ("SFMatrix4d", "mat4 x", "SFMatrix4d " + FOUR, "x[3].yzw", (0.08, 0.12, 0.16)),
    ))


@suite.case
def arrays():
    "MF fields are arrays"
    check_all((
        ("MFBool", "bool x[3]", "MFBool x [TRUE FALSE TRUE]", "vec3(x[0], x[1], x[2])", (1, 0, 1)),
        ("MFInt32", "int x[3]", "MFInt32 x [1 2 3]", "vec3(x[0], x[1], x[2]) * 0.1", (0.1, 0.2, 0.3)),
        ("MFFloat", "float x[3]", "MFFloat x [.1 .2 .3]", "vec3(x[0], x[1], x[2])", (0.1, 0.2, 0.3)),
        ("MFDouble", "float x[3]", "MFDouble x [.1 .2 .3]", "vec3(x[0], x[1], x[2])", (0.1, 0.2, 0.3)),
        ("MFTime", "float x[2]", "MFTime x [.1 .2]", "vec3(x[0], x[1], 0.0)", (0.1, 0.2, 0)),
        ("MFVec2f", "vec2 x[2]", "MFVec2f x [.1 .2, .3 .4]", "vec3(x[0], x[1].y)", (0.1, 0.2, 0.4)),
        ("MFVec3f", "vec3 x[2]", "MFVec3f x [0 0 0, .1 .2 .3]", "x[1]", (0.1, 0.2, 0.3)),
        ("MFVec4f", "vec4 x[2]", "MFVec4f x [0 0 0 0, .1 .2 .3 .4]", "x[1].gba", (0.2, 0.3, 0.4)),
        ("MFColor", "vec3 x[2]", "MFColor x [0 0 0, .1 .2 .3]", "x[1]", (0.1, 0.2, 0.3)),
        ("MFColorRGBA", "vec4 x[2]", "MFColorRGBA x [0 0 0 0, .1 .2 .3 .4]", "x[1].gba", (0.2, 0.3, 0.4)),
        ("MFRotation", "vec4 x[2]", "MFRotation x [0 0 1 0, 1 0 0 .5]", "x[1].xyw", (1, 0, 0.5)),
        ("MFMatrix3f", "mat3 x[2]", "MFMatrix3f x [0 0 0 0 0 0 0 0 0, .1 .2 .3 .4 .5 .6 .7 .8 .9]",
         "x[1][0]", (0.1, 0.4, 0.7)),
        ("longer than its uniform", "float x[2]", "MFFloat x [.1 .2 .3 .4]", "vec3(x[0], x[1], 0.0)",
         (0.1, 0.2, 0)),
    ))


IMAGE = png(2, 1, 3, [51, 102, 153, 255, 0, 0])


@suite.case
def textures():
    "texture nodes are samplers, each with its own repeat"
    pixel = "PixelTexture { image 2 1 3 0x336699 0xFF0000 %s }"
    three = voxels(3, (1, 1, 2), [0x336699, 0xFF0000])
    check_all((
        ("PixelTexture", "sampler2D x", "SFNode x " + pixel % "", "texture2D(x, vec2(0.25, 0.5)).rgb",
         (0.2, 0.4, 0.6)),
        ("right half", "sampler2D x", "SFNode x " + pixel % "", "texture2D(x, vec2(0.75, 0.5)).rgb",
         (1, 0, 0)),
        ("repeated", "sampler2D x", "SFNode x " + pixel % "", "texture2D(x, vec2(1.25, 0.5)).rgb",
         (0.2, 0.4, 0.6)),
        ("clamped", "sampler2D x", "SFNode x " + pixel % "repeatS FALSE",
         "texture2D(x, vec2(1.25, 0.5)).rgb", (1, 0, 0)),
        ("ImageTexture", "sampler2D x", 'SFNode x ImageTexture { url "image.png" }',
         "texture2D(x, vec2(0.25, 0.5)).rgb", (0.2, 0.4, 0.6)),
        ("PixelTexture3D", "sampler3D x", "SFNode x " + three, "texture3D(x, vec3(0.5, 0.5, 0.25)).rgb",
         (0.2, 0.4, 0.6)),
        ("PixelTexture3D, last slice", "sampler3D x", "SFNode x " + three,
         "texture(x, vec3(0.5, 0.5, 0.75)).rgb", (1, 0, 0)),
        ("MFNode", "sampler2D x[2]", f"MFNode x [ {pixel % ''} PixelTexture {{ image 1 1 3 0x0066CC }} ]",
         "vec3(texture2D(x[0], vec2(0.75, 0.5)).r, texture2D(x[1], vec2(0.5)).gb)", (1, 0.4, 0.8)),
    ), files={"image.png": IMAGE})


@suite.case
def same_sampler_names():
    "two effects with samplers of one name; a sampler on a volume"
    def reading(channel, color):
        return effect(f"uniform sampler2D image;\n{MODIFY}{{ color.{channel} = texture2D(image, vec2(0.5)).{channel}; }}",
                      f"inputOutput SFNode image PixelTexture {{ image 1 1 3 {color} }}")

    text = front_scene(quad(BLACK, reading("r", "0x330000") + reading("g", "0x006600")))
    suite.close("surface", suite.middle(text), (0.2, 0.4, 0, 1))
    mask = effect("uniform sampler3D mask;\n"
                  "void PLUG_volume_classify(inout vec4 color, const in VolumeSample s)"
                  "{ color = vec4(texture(mask, s.position).rgb, 1.0); }",
                  "initializeOnly SFNode mask " + voxels(3, (2, 1, 1), [0x336699, 0xFF0000]))
    got = suite.probe(front_scene(volume(constant(9), effects=mask)), [(4, 8), (11, 8)])
    suite.close("left", got[0], (0.2, 0.4, 0.6, 1), 0.3)
    suite.close("right", got[1], (1, 0, 0, 1), 0.3)


@suite.case
def host_uniforms():
    "castle_* and plugray_* uniforms, declared by the effect or not"
    def show(expression, declaration=""):
        return quad(BLACK, effect(f"{declaration}\n{MODIFY}{{ color.rgb = {expression}; }}"))

    check_all((
        ("plugray_ViewportSize", show("vec3(plugray_ViewportSize / vec2(200.0, 8.0), 0.0)"),
         (24 / 200, 0.5, 0)),
        ("castle_ModelViewMatrix", show("(castle_ModelViewMatrix * vec4(0.0, 0.0, 0.0, 1.0)).xyz * vec3(.1, .1, -.05)"),
         (0.15, 0.05, 0.5)),
        ("declared again", show("castle_NormalMatrix * vec3(0.0, 0.0, 1.0)", "uniform mat3 castle_NormalMatrix;"),
         (0, 0, 1)),
        ("plugray_ModelMatrix", show("(plugray_ModelMatrix * vec4(0.0, 0.0, 0.0, 1.0)).xyz * 0.1"),
         (0.35, 0.05, 0)),
        ("plugray_InverseViewMatrix", show("(plugray_InverseViewMatrix * vec4(0.0, 0.0, 0.0, 1.0)).xyz * 0.05"),
         (0, 0, 0.5)),
        ("gl_FragCoord", show("vec3(gl_FragCoord.xy * vec2(0.02, 0.1), 0.0)"),
         (0.02 * (4 * 5 + 1.5), 0.25, 0)),
    ))
    text = front_scene("Transform { translation 0 0 2 children [ ", volume(constant(9), effects=effect(
        "void PLUG_volume_classify(inout vec4 color, const in VolumeSample s) { color = vec4("
        "(castle_ModelViewMatrix * vec4(0.0, 0.0, 0.0, 1.0)).xyz * -0.1, 1.0); }")), " ] }\n")
    suite.close("of a volume", suite.middle(text), (0, 0, 0.8, 1))


@suite.case
def library():
    "functions of the library are taken in by name"
    show = effect("vec4 position_eye_to_world_space(vec4 position);\n"
                  "void PLUG_lighting_apply(inout vec4 color, const vec4 vertex_eye, const vec3 n)"
                  "{ color.rgb = position_eye_to_world_space(vertex_eye).xyz; }")
    text = scene("OrthoViewpoint { position 0 0 10 fieldOfView -1 -1 1 1 }\n",
                 "Transform { translation .25 .5 .75 children [ ", quad(BLACK, show), " ] }\n")
    got = suite.probe(text, [(10, 4)], size="16x16")[0]
    suite.close("", got[:3], (10.5 / 8 - 1, 1 - 4.5 / 8, 0.75))


@suite.case
def attributes():
    "attributes of the geometry: texture coordinates, FloatVertexAttribute"
    geometry = ("IndexedFaceSet { coordIndex [0 1 2 3 -1] coord Coordinate { point "
                "[-.5 -.5 0, .5 -.5 0, .5 .5 0, -.5 .5 0] } texCoord TextureCoordinate { point "
                "[0 0, .5 0, .5 1, 0 1] } attrib FloatVertexAttribute { name \"heat\" numComponents 1 "
                "value [0 1 1 0] } }")
    code = effect_parts((
        ("VERTEX", "attribute float heat;\nattribute vec4 castle_MultiTexCoord0;\nvarying vec3 seen;\n"
                   "void PLUG_vertex_object_space(const in vec4 v, inout vec3 n)"
                   "{ seen = vec3(castle_MultiTexCoord0.xy, heat); }"),
        ("FRAGMENT", "varying vec3 seen;\n" + MODIFY + "{ color.rgb = seen; }")))
    row = Row(suite)
    row.add(quad(BLACK, code, geometry=geometry))
    suite.close("", row.draw()[0], (0.1875, 0.625, 0.375, 1))


@suite.case
def set_option():
    "--set changes a field"
    text = front_scene(quad(BLACK, effect(
        f"uniform vec3 tint;\n{MODIFY}{{ color.rgb = tint; }}", "inputOutput SFVec3f tint 0 0 0", "DEF T")))
    suite.close("", suite.middle(text, "--set", "T.tint=.25 .5 .75"), (0.25, 0.5, 0.75, 1))


@suite.case
def without_partner():
    "a uniform without a field and a field without a uniform are warnings"
    code = f"uniform float lonely;\n{MODIFY}{{ color.r = 0.5 + lonely; }}"
    text = front_scene(quad(BLACK, effect(code, "initializeOnly SFFloat idle 3")))
    result = suite.render(text, "--probe", "8,8")
    suite.close("drawn", float(result.output.split()[0]), 0.5)
    suite.equal("warnings", sorted(m[3::2] for m in result.messages()),
                [("warning", "unset-uniform"), ("warning", "unused-field")])
    quiet = effect(code, 'uniformMissing "IGNORE" initializeOnly SFFloat idle 3')
    result = suite.render(front_scene(quad(BLACK, quiet)), "--probe", "8,8")
    suite.equal("IGNORE silences the field", result.with_code("unused-field"), [])
    given = effect(code.replace("lonely;", "lonely = 0.25;", 1))
    result = suite.render(front_scene(quad(BLACK, given)), "--probe", "8,8")
    suite.close("an initialiser stands", float(result.output.split()[0]), 0.75)
    suite.equal("silently", result.messages(), [])


@suite.case
def types_without_uniform():
    "SFString and SFImage have no uniform: a warning or an error at the field, and the rest is drawn"
    for field in ('SFString label \"text\"', "SFImage picture 1 1 1 9"):
        code = f"{MODIFY}{{ color.g = 0.5; }}"
        text = front_scene(quad(BLACK, effect(code, "initializeOnly " + field.replace("\\", ""))))
        result = suite.render(text, "--probe", "8,8", status=None)
        suite.check(f"{field}: drawn", result.output.split()[:2] == ["0.00000000", "0.50000000"],
                    result.output, result.errors)


@suite.case
def default_values():
    "declared fields without a value have X3D's defaults"
    check_all((
        ("SFFloat", "float x", "SFFloat x 0", "vec3(x + 0.5)", (0.5,) * 3),
        ("MFFloat, empty", "float x[2]", "MFFloat x [ ]", "vec3(x[0] + 0.25)", (0.25,) * 3),
    ))
    code = f"uniform sampler2D image;\n{MODIFY}{{ color.rgb = texture2D(image, vec2(0.5)).rgb + 0.25; }}"
    text = front_scene(quad(BLACK, effect(code, "inputOutput SFNode image NULL")))
    result = suite.render(text, "--probe", "8,8", status=None)
    suite.check("SFNode NULL does no harm", len(result.output.split()) == 4, result.errors)


suite.run()
