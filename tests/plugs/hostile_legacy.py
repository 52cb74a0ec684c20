"""Versions and old GLSL: what content in the wild uses runs unmodified in a core profile."""

from blackbox import BASE, case

RED = "void PLUG_change(inout vec4 c) { c.r += 1.0; }\n"
OLD_BASE = """varying vec2 coord;
uniform sampler2D image;
/* PLUG-DECLARATIONS */
void main() {
    gl_FragColor = texture2D(image, coord);
    /* PLUG: change (gl_FragColor) */
    if (gl_FragColor.a < 0.5) discard;
    gl_FragColor.rgb *= gl_FragColor.a;
}
"""
VERTEX = {"vertex": "#version 330\nin vec4 castle_Vertex;\nvoid main() { vec4 v = castle_Vertex; /* PLUG: place (v) */ gl_Position = v; }\n"}


def change(body, head=""):
    return f"{head}\nvoid PLUG_change(inout vec4 c) {{ {body} }}\n"


@case
def old_base(link):
    "gl_FragColor written and read, varying, texture2D"
    r = link(RED, change("c *= gl_FragColor;"), base=OLD_BASE)
    r.sound()
    r.called("change", [0, 1])
    r.lacks("gl_FragColor|varying|texture2D")
    r.has("in vec2 coord ;")


@case
def sampling(link):
    "the old sampling functions, with bias, projection, levels and shadows"
    r = link(change("""
    c += texture2D(t2, c.xy) + texture2D(t2, c.xy, 0.5) + texture2DProj(t2, c.xyz) + texture2DProj(t2, c, 0.5);
    c += textureCube(tc, c.xyz) + texture3D(t3, c.xyz) + texture3DProj(t3, c) + texture1D(t1, c.x) + texture1DProj(t1, c.xy);
    c += texture2DLod(t2, c.xy, 1.0) + texture2DProjLod(t2, c.xyz, 1.0) + texture3DLod(t3, c.xyz, 0.0) + textureCubeLod(tc, c.xyz, 1.0);
    c.r += shadow2D(ts, c.xyz).r + shadow2DProj(ts, c).r + shadow2DProj(ts, c, 0.5).a + shadow1D(s1, c.xyz).x;
    c.rgb += shadow2D(ts, vec3(shadow2DProj(ts, vec4(shadow2D(ts, c.xyz).rgb, (1.0))).rgb)).rgb;
    float f = shadow2D(ts, c.xyz).r; c.a = f;""",
                    "uniform sampler2D t2; uniform samplerCube tc; uniform sampler3D t3; uniform sampler1D t1;\n"
                    "uniform sampler2DShadow ts; uniform sampler1DShadow s1;"))
    r.sound()
    r.lacks("texture2D|shadow2D|texture3D|textureCube")


@case
def sampler_named_texture(link):
    "a parameter, a uniform, a local, a member called texture"
    base = BASE.replace("(color)", "(color, image, color.xy)").replace("in vec3", "uniform sampler2D image;\nin vec3")
    r = link("void PLUG_change(inout vec4 c, const in sampler2D texture, in vec2 tex_coord) {\n"
             "  c = texture2D(texture, tex_coord) + f(texture, texture2D(texture, c.xy).xy);\n}\n"
             "vec4 f(sampler2D texture, vec2 x) { return texture2D(texture, x); }\n", base=base)
    r.sound()
    r = link(change("c = texture2D(texture, c.xy);", "uniform sampler2D texture;"),
             change("float texture = 1.0; c.r = texture;"),
             change("S s; s.texture = 1.0; c.r = s.texture;", "struct S { float texture; };"),
             change("c = texture(image, c.xy);", "uniform sampler2D image;"))
    r.sound()
    r.check({s[1] for s in r.symbols} == {"texture", "image"}, "the uniform keeps its author's name")
    r = link("vec4 f(sampler2D texture, vec2 x) { return texture2D(texture, x); }\nuniform sampler2D t;\n"
             + change("c = f(t, c.xy) + texture(t, c.xy);"))
    r.sound()


@case
def own_texture_function(link):
    "functions of authors that are named as what became built in"
    r = link(change("c.r = texture(c.xy) + round(c.r) + inverse(c).x + isnan2(c.r) + modf(1.0) + trunc(c.r) + cosh(c.r);",
                    "float texture(vec2 p) { return p.x; }\nfloat round(float x) { return floor(x + 0.5); }\n"
                    "vec4 inverse(vec4 x) { return 1.0 / x; }\nfloat isnan2(float x) { return x; }\nfloat modf(float x) { return x; }\n"
                    "float trunc(float x) { return x; }\nfloat cosh(float x) { return exp(x); }\n"))
    r.sound()
    r.has("plr0_round \\( c")


@case
def words_reserved_since(link):
    "words that became reserved since are names in old content"
    words = ("sample filter input output common active buffer shared smooth flat centroid patch noperspective partition "
             "resource superp coherent restrict readonly writeonly subroutine layout precise").split()
    for word in words:
        r = link(change(f"float {word} = 1.0; {word} += 1.0; c.r = ({word}) * 2.0 + f({word}, 1.0) + {word};",
                        f"float f(float {word}, float x) {{ return {word} * x; }}"))
        r.sound()
        r = link(change(f"c.r = {word} + float({word});", f"uniform float {word};"))
        r.sound()
        r.check([s[1] for s in r.symbols] == [word], "the uniform keeps its author's name")
        r = link(change(f"S s; s.{word} = 1.0; c.r = s.{word};", f"struct S {{ float {word}; vec2 b; }};"))
        r.sound()
    r = link(change("c.r = smooth(1.0) + filter(c.r, 2.0);",
                    "float smooth(float x) { return x; }\nfloat filter(in float sample, float input) { return sample * input; }"))
    r.sound()


@case
def modern_qualifiers(link):
    "the same words still work as qualifiers"
    r = link(change("c.r = a + b + d; g = c.r;",
                    "flat in int i;\nsmooth in float a;\nnoperspective in float b;\ncentroid in float d;\nfloat g;"))
    r.sound()
    r.has("smooth in float plr0_a ;")
    r = link(change("c.r = a;", "centroid varying float a;"))
    r.sound()


@case
def doubled_qualifiers(link):
    "inout in and the like mean what the last permits"
    r = link("void PLUG_change(inout in vec4 c) { f(c.r); c.g = g(c.b); }\nvoid f(in inout float x) { x = 1.0; }\n"
             "float g(in const float x) { return x; }\nvoid h(const in highp vec3 x, out float y) { y = x.x; }\n")
    r.sound()
    r.has(r"void plr0_change \( inout vec4 c \)")


@case
def arrays(link):
    "array constructors, of every form"
    r = link(change("float a[3] = float[3](1.0, 2.0, 3.0); vec2 b[2] = vec2[](vec2(1.0), vec2(2.0)); c.r = a[1] + b[1].x + K[0]"
                    " + float(a.length()) + w(float[2](1.0, 2.0));",
                    "const float K[2] = float[](1.0, 2.0);\nfloat w(float v[2]) { return v[0]; }\n"
                    "float[2] x(float[2] v) { return v; }"))
    r.sound()


@case
def fragment_data(link):
    "gl_FragData with constant and other indices"
    r = link(change("gl_FragData[1] = c;"), base=OLD_BASE.replace("gl_FragColor", "gl_FragData[0]"))
    r.sound()
    r.has("out vec4 \\w+ \\[ 2 \\] ;")
    r = link(change("for (int i = 0; i < gl_MaxDrawBuffers; i++) { if (i == 3) gl_FragData[3] = c; }"), base=OLD_BASE.replace("gl_FragColor", "gl_FragData[0]"))
    r.sound()


@case
def vertex_legacy(link):
    "gl_Vertex, gl_Normal, gl_MultiTexCoord, ftransform, the old matrices"
    base = {"vertex": """varying vec3 n; varying vec4 t;
void main() {
    n = gl_NormalMatrix * gl_Normal;
    t = gl_MultiTexCoord0 + gl_Color;
    vec4 v = gl_ModelViewMatrix * gl_Vertex;
    /* PLUG: place (v) */
    gl_TexCoord[0] = gl_TextureMatrix[0] * gl_MultiTexCoord1;
    gl_Position = gl_ProjectionMatrix * v + gl_ModelViewProjectionMatrix * gl_Vertex + ftransform();
}
"""}
    r = link({"vertex": "void PLUG_place(inout vec4 v) { v = gl_ModelViewMatrix * v + castle_ModelViewMatrix * castle_Vertex; }\n"},
             base=base, stage="vertex")
    r.sound()
    r.lacks(r"\bgl_(?!Position)|varying|ftransform \( \) \{ \}")
    r = link(change("c += gl_TexCoord[0];"))
    r.check(r.status == 0, "gl_TexCoord in a fragment unit")
    r.valid()


@case
def versions(link):
    "the result begins with the highest version that base or units ask for"
    for base, effect, expected in (("", "", "330 core"), ("#version 110\n", "", "330 core"), ("#version 120\n", "#version 130\n", "330 core"),
                                   ("#version 100\n", "", "330 core"), ("#version 300 es\n", "", "330 core"),
                                   ("#version 330 compatibility\n", "", "330 core"), ("#version 150 core\n", "#version 400\n", "400 core"),
                                   ("#version 450 core\n", "#version 330\n", "450 core"), ("", "#version 410 core", "410 core"),
                                   ("", "\n// x\n  #  version   420  /* x */ core\n", "420 core"), ("", "#version 310 es\n", "430 core")):
        r = link(effect + "\n" + RED, base=base + "out vec4 picture;\nvoid main() { vec4 color = vec4(1.0); /* PLUG: change (color) */ picture = color; }")
        r.sound()
        r.check(r.text.startswith(f"#version {expected}\n"), f"{base!r} and {effect!r} give {expected}")
        r.check(r.text.count("#version") == 1, "one line")
    r = link("#version 999\n" + RED)
    r.says("bad-version", severity="warning")
    r.valid()
    r = link("#if 0\n#version 450\n#endif\n" + RED)
    r.check(r.text.startswith("#version 330 core"), "an inactive line asks for nothing")
    r = link("#version 130\nvarying float x;\n" + change("c = texture2D(t, c.xy) * x;", "uniform sampler2D t;"))
    r.sound()


@case
def targets(link):
    "--glsl sets the version"
    for target, first in (("330", "#version 330 core"), ("410", "#version 410 core"), ("450", "#version 450 core"), ("300es", "#version 300 es")):
        r = link(RED, change("c += texture2D(t, c.xy) + u;", "#ifdef GL_ES\nprecision mediump float;\n#endif\nuniform sampler2D t;\nuniform vec4 u;"),
                 base=BASE.replace("#version 330 core", ""), options=["--glsl", target])
        r.sound()
        r.check(r.text.startswith(first), f"{target} begins with {first}")
    r = link("#version 450\n" + RED, options=["--glsl", "410"])
    r.check(r.text.startswith("#version 450 core"), "a unit may ask for more than the target")


@case
def extensions(link):
    "extension lines move up and are merged"
    r = link("#extension GL_ARB_texture_gather : enable\n" + RED + "#extension GL_ARB_gpu_shader5 : enable\n",
             "#extension GL_ARB_texture_gather : require\n#version 330\n" + RED,
             change("c.r = 1.0;", "# extension  GL_ARB_texture_gather:enable // x\n#if 0\n#extension GL_NONE : require\n#endif"))
    r.sound()
    r.has(r"^# version 330 core # extension GL_ARB_texture_gather : require # extension GL_ARB_gpu_shader5 : enable out")
    r.check(r.text.count("#extension") == 2, "merged")


@case
def other_lines(link):
    "#line goes, #pragma and #error stay"
    r = link("#line 100\n#pragma debug(on)\n" + RED + "#line 7 3\n")
    r.sound()
    r.lacks("# line")
    r.has("# pragma debug \\( on \\)")
    r = link("#if 1\n#else\n#error never\n#endif\n" + RED)
    r.sound()
    r.lacks("error")


@case
def precisions(link):
    "precision statements and qualifiers"
    r = link("precision mediump float;\nuniform highp mat3 m;\nlowp float f(mediump vec3 x) { highp float y = x.x; return y; }\n"
             + change("highp vec3 x = m * c.rgb; c.r = f(x);"), "precision highp float;\n" + RED)
    r.sound()
    r = link(change("c.r = f(1.0);", "#ifdef GL_ES\nprecision mediump float;\n#endif\n#ifndef GL_ES\n#define lowp\n#define mediump\n#define highp\n"
                    "#endif\nlowp float f(highp float x) { return x; }"))
    r.check(r.status == 0, "precision words as macros")
    r.valid()


@case
def old_varyings_lists(link):
    "varying and attribute in lists, with arrays, invariant and centroid"
    base = dict(VERTEX)
    r = link({"vertex": "attribute vec4 tangent, other;\nvarying vec3 a, b[2];\ninvariant varying float i;\ncentroid varying vec2 k;\n"
                        "void PLUG_place(inout vec4 v) { v += tangent; a = v.xyz; b[0] = b[1] = a; i = 1.0; k = v.xy; }\n"},
             base=base, stage="vertex")
    r.sound()
    r.has("in vec4 tangent ;")
    r.lacks("other")


@case
def castle_upgrade(link):
    "CASTLE_GLSL_VERSION_UPGRADE and __VERSION__ decide, and do not appear"
    r = link(change("c.r = f();", "#ifdef CASTLE_GLSL_VERSION_UPGRADE\nfloat f() { return 1.5; }\n#else\nfloat f() { return 2.5; }\n#endif\n"
                    "#if __VERSION__ < 130\nfloat never;\n#endif"))
    r.sound()
    r.has("1 \\. 5")
    r.lacks("2 \\. 5|CASTLE|never")
    r = link(change("c.r = V + float(__VERSION__) + float(__LINE__);", "#define V float(__VERSION__)"))
    r.sound()


@case
def es_content(link):
    "content for ES: #version 300 es, precision, in and out"
    r = link("#version 300 es\nprecision mediump float;\nprecision highp sampler3D;\nuniform sampler2D t;\n" + change("c = texture(t, c.xy);"))
    r.sound()
    r = link(RED, base="#version 300 es\nprecision highp float;\nin vec2 uv;\nout vec4 fragColor;\nvoid main() { vec4 color = vec4(uv, 0.0, 1.0);\n"
             "/* PLUG: change (color) */ fragColor = color; }")
    r.sound()


@case
def corpus_manner(link):
    "an effect in the manner of public content"
    r = link({"vertex": "varying vec3 position_object;\nvoid PLUG_vertex_object_space(const in vec4 vertex_object, const in vec3 normal_object)\n"
                        "{ position_object = vec3(vertex_object); }\n",
              "fragment": """varying vec3 position_object;
uniform float threshold; // from 0 to 1
#ifndef GL_ES
uniform mat4 castle_ModelViewMatrix;
#endif
/* see PLUG_fragment_end (...) */
float perlin(const in vec3 p);
float sum(vec3 p)
{
  float s = 0.;
  int i;
  for (i = 0; i < 3; i++) s += perlin(p * float(i));
  return s;
}
float perlin(const in vec3 p) { return fract(dot(p, vec3(1, 57, 3))); }
void PLUG_texture_apply(inout vec4 fragment_color, const in vec3 normal_eye_fragment)
{
  fragment_color.rgb = mix(fragment_color.rgb, vec3(0.5), sum(position_object) - threshold);
}
"""}, base={"vertex": "attribute vec4 castle_Vertex; attribute vec3 castle_Normal;\nuniform mat4 castle_ModelViewMatrix, castle_ProjectionMatrix;\n"
                      "void main() { vec4 vertex_object = castle_Vertex; vec3 normal_object = castle_Normal;\n"
                      "/* PLUG: vertex_object_space (vertex_object, normal_object) */\n"
                      "gl_Position = castle_ProjectionMatrix * (castle_ModelViewMatrix * vertex_object); }\n",
            "fragment": "void main() { vec4 fragment_color = vec4(1.0); vec3 n = vec3(0.0, 0.0, 1.0);\n"
                        "/* PLUG: texture_apply (fragment_color, n) */\ngl_FragColor = fragment_color; }\n"})
    r.sound()
    r.check([s[1] for s in r.symbols] == ["threshold"], "the uniforms")


@case
def macros_for_old_words(link):
    "content that defines the old words itself, for old and new GLSL"
    r = link(change("c = texture2D(t, c.xy) + v.xyxy;", "#if __VERSION__ >= 130\n#define texture2D texture\n#define varying in\n"
                    "#endif\nuniform sampler2D t;\nvarying vec2 v;"))
    r.sound()
    r.has("# define plr0_texture2D texture ")
    r = link(change("c = f(t, c.xy) + TEX(t, c.xy);", "#define texture2D texture\n#define TEX texture2D\nuniform sampler2D t;\n"
                    "vec4 f(sampler2D s, vec2 uv) { return texture2D(s, uv); }"))
    r.sound()
    r = link(change("c.r = SH(t, c.xyz) + SH2(t, c.xyz).r;", "#define SH(a, b) shadow2D(a, b).r\n#define SH2 shadow2D\n"
                    "uniform sampler2DShadow t;"))
    r.sound()
    r = link(change("c = texture(t, c.xy);", "#define texture(s, uv) texture2D(s, uv)\nuniform sampler2D t;"),
             change("c = texture(t, c.xy, 1.0);", "uniform sampler2D t;"), change("c.r = texture;", "#define texture (1.0 + 2.0)"))
    r.sound()
    r = link(change("sample q; q.x = 1.0; c.r = q.x; texture r; r.y = 2.0; c.g = r.y;",
                    "struct sample { float x; };\nstruct texture { float y; };"))
    r.sound()
