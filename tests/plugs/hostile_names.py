"""Names: what is an effect's own, what is shared, what is never renamed."""

from blackbox import BASE, case

RED = "void PLUG_change(inout vec4 c) { c.r += 1.0; }\n"


def change(body, head=""):
    return f"{head}\nvoid PLUG_change(inout vec4 c) {{ {body} }}\n"


@case
def isolation(link):
    "uniforms, functions, constants, structs, globals and macros of two effects do not collide"
    text = change("S s; s.amount = noise(c.rgb); c.r = s.amount * amount + float(N) + total + M(2.0);",
                  """uniform float amount;
const int N = 3;
struct S { float amount; };
float total = 1.0;
#define M(x) (x + 1.0)
float noise(vec3 p) { return p.x * amount; }""")
    other = text.replace("float noise(vec3 p) { return p.x", "float noise(vec3 p) { return p.y") \
        .replace("N = 3", "N = 4").replace("x + 1.0", "x + 2.0").replace("float amount; };", "float amount, b; };")
    r = link(text, other, text)
    r.sound()
    r.called("change", [0, 1, 2])
    for n in range(3):
        r.has(rf"uniform float plr{n}_amount ;")
        r.has(rf"s \. amount = plr{n}_noise \( c \. rgb \)")
        r.has(rf"struct plr{n}_S \{{ float amount")
        r.has(rf"# define plr{n}_M ")


@case
def comma_declarations(link):
    "comma declarations with arrays and initialisers"
    r = link(change("c.r = a + b[2] + d + e[1][0] + f.x;",
                    "uniform float a, b[3];\nfloat d = 1.0, unused = 2.0, e[2][1] = float[2][1](float[1](1.0), "
                    "float[1](2.0));\nconst vec2 f = vec2(1.0, 2.0), g = f;"
                    ).replace("e[2][1] = float[2][1](float[1](1.0), float[1](2.0))", "e2, e3[2]")
             .replace("e[1][0]", "e2 + e3[1]"))
    r.sound()
    r.lacks("unused|plr0_g")
    r.has(r"plr0_a")
    r.check(sorted((s[1], s[3], s[4]) for s in r.symbols) == [("a", "float", "0"), ("b", "float", "3")], "symbols")


@case
def array_forms(link):
    "float[3] a; arrays of constants and expressions in hoisted prototypes"
    r = link(change("float v[N + 1]; v[0] = c.r; c.r = f(v) + k[1] + m[0];",
                    "#define SIZE 2\nconst int N = SIZE * 2 - 1;\nuniform float[N] k;\nuniform float m[N], n[2 * SIZE];\n"
                    "float f(float v[N + 1]) { return v[N] + g(v, 1.0); }\n"
                    "float g(const in float v[(N) + 1], float x) { return v[0] * x; }\n"))
    r.sound()
    sizes = {s[1]: s[4] for s in r.symbols}
    r.check(set(sizes) == {"k", "m"}, "the uniforms in use")


@case
def members(link):
    "members after a dot and in struct bodies are never renamed, also where a global has the name"
    r = link(change("T t; t.s.value = value; t.s.xyz = vec3(xyz); t.a[1].value = 2.0; c.rgb = t.s.xyz * t.s.value"
                    " + t.a[1].value; c.xyz += vec3(1.0).xyz; c.a = rgb;",
                    "uniform float value;\nfloat xyz = 1.0, rgb = 2.0, a = 3.0, s;\n"
                    "struct S { float value; vec3 xyz; };\nstruct T { S s; S a[2]; float rgb, value[2]; };\n"))
    r.sound()
    r.has(r"t \. s \. value = plr0_value ;")
    r.has(r"c \. rgb = t \. s \. xyz")
    r.has(r"c \. a = plr0_rgb")
    r.has(r"struct plr0_T \{ plr0_S s ; plr0_S a \[ 2 \] ; float rgb , value \[ 2 \] ; \}")


@case
def member_types(link):
    "types and sizes in struct bodies are renamed, members spelt as types are not"
    r = link(change("T t; t.S.N[0] = 1.0; c.r = t.S.N[0];",
                    "const int N = 2;\nstruct S { float N[N]; };\nstruct T { S S; };")
             .replace("float N[N]", "float N[2]"))
    r.sound()
    r = link(change("T t; t.v[0] = 1.0; c.r = t.v[0];",
                    "const int N = 2;\nstruct S { float q; };\nstruct T { float v[N]; S s[N + 1]; } unused;\nT other;"))
    r.sound()
    r.has(r"float v \[ plr0_N \]")


@case
def struct_with_instance(link):
    "a struct declared with variables, an anonymous struct, const and uniform structs"
    r = link(change("c.r = one.x + two[1].x + three.x + u.x + k.x;",
                    "struct S { float x; } one, two[2];\nstruct { float x; } three;\nuniform struct U { float x; } u;\n"
                    "const S k = S(1.0);\n"))
    r.sound()
    r = link(*[change("c.r = three.x;", "struct { float x; } three;")] * 2)
    r.sound()


@case
def interface_blocks(link):
    "uniform blocks with and without an instance name do not collide"
    text = change("c.r = a + inst.b + more[1].d;",
                  "layout(std140) uniform Block { float a; vec4 e; };\nuniform Named { float b; } inst;\n"
                  "layout(std140, row_major) uniform Rows { float d; mat4 m; } more[2];")
    r = link(text, text)
    r.sound()
    r.has(r"inst \. b")


@case
def layouts(link):
    "layout qualifiers keep their keys, also where a global has the name"
    r = link(change("c.r = location + offset + a;",
                    "#extension GL_ARB_explicit_uniform_location : enable\nfloat location = 1.0, offset = 2.0, std140 = 1.0;\n"
                    "layout(location = 3) uniform float a;\n"))
    r.has(r"layout \( location = 3 \) uniform float plr0_a ;")
    r.has(r"plr0_location \+ plr0_offset")
    r.valid()


@case
def overloads(link):
    "all overloads of a reached name stay"
    r = link(change("c.r = f(1.0); c.g = f(vec2(1.0));",
                    "float f(float a) { return a; }\nfloat f(vec2 a);\nfloat f(vec2 a) { return f(a.x); }\n"
                    "float f(vec3 a) { return a.x; }\nfloat g() { return 1.0; }"))
    r.sound()
    r.has(r"float plr0_f \( vec3 a \) \{")
    r.lacks("plr0_g")


@case
def builtin_names(link):
    "functions named like built-in functions"
    r = link(change("c.r = mix(c.r, c.g) + mix(c.r, c.g, 0.5) + permute(vec4(1.0)).x + noise1(1.0) + step(1.0);",
                    "float mix(float a, float b) { return a + b; }\nvec4 permute(vec4 x) { return mod(x, 289.0); }\n"
                    "float noise1(float x) { return fract(x); }\nfloat step(float x) { return step(x, 1.0); }"))
    r.sound()
    r.has(r"plr0_mix \( c \. r , c \. g \)")
    r.has(r"[^_]mix \( c \. r , c \. g , 0")
    r.has(r"[^_]step \( x , 1")
    text = change("c.r = smoothstep(0.0, 1.0, c.r);", "float smoothstep(float a, float b, float x) { return x; }")
    r = link(text, text.replace("return x", "return 2.0 * x"))
    r.sound()
    r.has(r"plr0_smoothstep \( 0")
    r.has(r"plr1_smoothstep \( 0")
    r = link(change("c.r = max(min(c.r, 1.0), 0.0);", "float max(float a, float b) { return a > b ? a : b; }\n"
                    "#define min(a, b) max(-(a), b)"))
    r.sound()


@case
def builtin_named_variables(link):
    "locals, parameters and uniforms named like built-in functions"
    r = link(change("float mix = distance; float length = 2.0; c.r = mix * length + f(1.0, 2.0) + step;",
                    "uniform float distance, step;\nfloat f(float dot, float cross) { return max(dot, cross); }"))
    r.sound()
    r = link(change("float noise = noise(c.r); c.r = noise;", "float noise(float x) { return x; }"))
    r.sound()


@case
def shadowing(link):
    "locals and parameters that hide globals, uniforms and functions"
    r = link(change("""
    float a = a + 1.0;
    { float b = b; b += a; c.r = b; for (int h = 0; h < 2; h++) { c.g += float(h); { float h = 2.0; c.g += h; } } }
    c.b = b + f(a, c) + h(1.0);
    for (float b = b, d = b; b < 2.0; b += d + 1.0) c.r += b;
    if (c.r > 0.0) { float u = 1.0; c.r += u; } c.r += u;
""", "float a = 1.0, b = 2.0;\nuniform float u;\nfloat h(float x) { return x; }\n"
                    "float f(float u, vec4 b) { return u + b.x; }"))
    r.sound()
    r.has(r"for \( int (plr0_)?h = 0")
    r = link(change("vec4 color = c; float picture = 1.0; c = color * picture * f(picture); { float f = 2.0; c.r = f; }",
                    "float f(float color) { float main = color; return main; }"))
    r.sound()


@case
def local_after_use(link):
    "a local that is declared after a use of the global of that name"
    r = link(change("c.r = a; float a = 2.0; c.g = a; { c.b = N; } int N = 1; c.a = float(N);",
                    "uniform float a;\nconst float N = 3.0;"))
    r.sound()
    r.check(any(s[1] == "a" for s in r.symbols), "the uniform is in use")


@case
def local_functions_shadow(link):
    "a local named as a function of the effect, used before as a function"
    r = link(change("float x = f(c.r); float f = x; c.r = f;", "float f(float x) { return x; }"))
    r.sound()
    r = link(change("S S; S.x = 1.0; c.r = S.x;", "struct S { float x; };"))
    r.sound()


@case
def macros_shared(link):
    "macros are shared by the units of one effect, in list order, and with no other effect"
    first, second = "#define K 2.0\n#define F(x) (x * K)\n", change("c.r = F(K) + G;", "#ifdef K\n#define G 1.0\n#endif\n")
    r = link({"fragment": second.replace("F(K) + G", "1.0")}, RED)
    r.sound()
    r = link(first + second, change("c.g = K;", "uniform float K;"), change("c.g = K;", "#define K 4.0"))
    r.sound()
    r.has("# define plr0_K 2 \\. 0")
    r.has("uniform float plr1_K")
    r.has("# define plr2_K 4 \\. 0")


@case
def macro_parameters(link):
    "function-like macros with parameters named like globals, members and functions"
    r = link(change("float t = amount; c.r = F(2.0, t) + G(c) + H(rgb).x + amount;",
                    "uniform float amount;\nfloat xyz(float x) { return x; }\nfloat a = 1.0;\n"
                    "#define F(amount, a) ((amount) * (a) + xyz(a))\n#define G(xyz) (xyz.x + xyz.rgb.r)\n"
                    "#define H(f) (c.f)\n"))
    r.sound()
    r.has(r"# define plr0_F ?\( amount , a \) \( \( amount \) \* \( a \) \+ plr0_xyz \( a \) \)")


@case
def macro_members(link):
    "macros named like members and swizzles replace these as well"
    r = link(change("S s; s.m = 1.0; c.r = s.m; c.w2 = c.q1;",
                    "#define m member\n#define w2 g\n#define q1 r\nstruct S { float m; };"))
    r.sound()


@case
def macro_redefined(link):
    "a macro that is undefined and defined again"
    r = link(change("c.r = a1() + b1() + K;", "#define K 1.0\nfloat a1() { return K; }\n#undef K\n#define K 2.0\n"
                    "float b1() { return K; }"))
    r.sound()
    r.check(r.flat.find("K 1 . 0") < r.flat.find("float plr0_a1 ( ) {") < r.flat.find("# undef plr0_K")
            < r.flat.find("K 2 . 0") < r.flat.find("float plr0_b1 ( ) {"), "in the order of the text")


@case
def macro_declares(link):
    "macros that stand for types, qualifiers, whole declarations and functions"
    r = link(change("c.r = a + b + f(1.0) + g(1.0) + TABLE[1];",
                    "#define REAL float\n#define PARAM const in\n#define UNI uniform REAL\n"
                    "#define DECLARE(n) float n(REAL x) { return x * a; }\nUNI a;\nuniform REAL b;\nDECLARE(g)\n"
                    "REAL f(PARAM REAL x) { return x; }\nconst REAL TABLE[2] = REAL[2](1.0, 2.0);\n"))
    r.check(r.status == 0 and not r.errors, "links")
    r.valid()


@case
def macro_makes_plug_function(link):
    "macros around plug functions"
    r = link("#define ARGS inout vec4 c\n#define BODY { c.r = 1.0; }\nvoid PLUG_change(ARGS) BODY\n" + RED)
    r.valid()
    r = link("#define V void\nV PLUG_change(inout vec4 c) { c.r = 1.0; }\n")
    r.valid()


@case
def direct_calls(link):
    "PLUG_x called directly calls the unit's own functions of that name"
    r = link("void PLUG_change(inout vec4 c, float again) { c.g = again; if (again > 0.0) PLUG_change(c); }\n"
             "void PLUG_change(inout vec4 c) { c.r = 1.0; }\n",
             "void PLUG_change(inout vec4 c) { c.b = 1.0; }\n"
             "void f(inout vec4 c) { if (c.r > 0.0) PLUG_change(c); else PLUG_change (c); }\n"
             "void PLUG_change(inout vec4 c, float x) { f(c); }",
             base=BASE.replace("(color)", "(color, 1.0) (color)"))
    r.sound()
    r.lacks("PLUG_")
    r.called("change", [0, 0, 1, 1])


@case
def two_in_a_unit(link):
    "two functions for one plug in one unit, with the same and with other parameters"
    r = link(RED + "void PLUG_change(inout vec4 c) { c.g += 1.0; }\nvoid PLUG_change(inout vec4 c, vec2 d) { }\n"
             "void helper(inout vec4 c) { PLUG_change(c); }\nvoid PLUG_change(inout vec4 c) { c.b = 1.0; helper(c); }\n"
             .replace("helper(c); }\n", "}\n"),
             base=BASE.replace("(color)", "(color) (color, color.rg)"))
    r.sound()
    r.called("change", [0, 0, 0, 0])


@case
def prefixes(link):
    "PLUG_a beside PLUG_a_b in either order"
    base = BASE.replace("/* PLUG: change (color) */", "/* PLUG: a (color) */ /* PLUG: a_b (color) */ /* PLUG: a_2 (color) */")
    parts = ["void PLUG_a(inout vec4 c) { c.r = 1.0; }\n", "void PLUG_a_b(inout vec4 c) { c.g = 1.0; }\n",
             "void PLUG_a_2(inout vec4 c) { c.b = 1.0; }\n"]
    for text in ("".join(parts), "".join(parts[::-1]), parts[0] + parts[0] + parts[2]):
        r = link(text, base=base)
        r.sound()
        r.lacks("PLUG_")
    r = link(parts[0] + "float a_2, a, plr_a;\n" + parts[0].replace("1.0", "a_2 + a"), base=base)
    r.sound()


@case
def chains(link):
    "custom plugs through a chain of four effects, with a struct that is shared by its spelling"
    struct = "struct Wave { float height; vec2 direction; };\n"
    r = link(struct + change("Wave w; w.height = 1.0; w.direction = vec2(0.0); /* PLUG: wave (w) */ c.r = w.height;"),
             struct.replace("; ", " ;\n  ") + "void PLUG_wave(inout Wave w) { float h = w.height; /* PLUG: height (h, w) */ w.height = h; }\n",
             struct + "void PLUG_height(inout float h, const in Wave w) { /* PLUG: last (h) */ h *= w.direction.x; }\n",
             "void PLUG_last(inout float h) { h += 1.0; }\nvoid PLUG_height(inout float h, const in Wave w) { h += w.height; }")
    r.sound()
    r.check("plr1_wave ( w ) ;" in r.body("plr0_change"), "1 speaks in 0")
    r.check("plr2_height ( h , w ) ; plr3_height ( h , w ) ;" in r.body("plr1_wave"), "2 and 3 speak in 1")
    r.check("plr3_last ( h ) ;" in r.body("plr2_height"), "3 speaks in 2")
    r.check(r.flat.count("struct plr") == 1, "one struct")


@case
def custom_plug_too_early(link):
    "a plug of an effect is not open to what comes before"
    r = link("void PLUG_own(inout float x) { x = 2.0; }\n" + RED, change("float x = 1.0; /* PLUG: own (x) */ c.r = x;"))
    r.valid()
    r.called("change", [0, 1])
    r.says("unknown-plug", "e0.frag:1:6", "warning")


@case
def provided_names(link):
    "a name is looked up in the effects whose plugs it implements: functions, uniforms, structs, macros"
    r = link(change("Wave w; w.height = base_height; /* PLUG: wave (w) */ c.r = helper(w.height);",
                    "struct Wave { float height; };\nuniform float base_height;\nfloat helper(float x) { return x * LIMIT; }\n"
                    "const float LIMIT = 3.0;\n#define HALF 0.5\n"),
             "void PLUG_wave(inout Wave w) { w.height = helper(base_height) * LIMIT * HALF; }\n")
    r.sound()
    r.has(r"plr0_helper \( plr0_base_height \) \* plr0_LIMIT \* plr0_HALF")
    r.check([s[0] for s in r.symbols if s[1] == "base_height"] == ["e0.frag"], "one uniform")


@case
def base_names(link):
    "a name that the effect does not define is looked up in the base, then in the library"
    base = BASE.replace("void main", "struct Hit { float t; };\nuniform float exposure;\nfloat unused_by_base(float x) { return x; }\n"
                        "const float EPS = 0.1;\n#define TAU 6.28\nvoid main")
    r = link(change("Hit h; h.t = EPS; c.r = unused_by_base(exposure) * h.t * TAU; c.g = position_world_to_eye_space(c).x;"),
             change("float exposure = 1.0; c.r *= exposure * own(); ", "float own() { return TAU; }"), base=base)
    r.sound()
    r.has("unused_by_base \\( exposure \\)")
    r.has("vec4 position_world_to_eye_space \\(")


@case
def names_of_base_redefined(link):
    "an effect that defines a name of the base or the library has its own"
    base = BASE.replace("void main", "uniform float exposure;\nfloat helper(float x) { return x * exposure; }\n"
                        "struct Hit { float t; };\nvoid main").replace("picture = ", "color.r = helper(1.0); Hit h; h.t = 1.0; picture = h.t * ")
    r = link(change("c.r = helper(c.r) * exposure; Hit h; h.q = 1.0; c.g = h.q;",
                    "uniform float exposure;\nfloat helper(float x) { return 2.0 * x; }\nstruct Hit { float q; };"),
             change("Hit h; h.t = 1.0; c.b = h.t;", "struct Hit { float t; };"),
             change("c.r = mix3(1.0);", "float mix3(float a) { return a; }\nvec4 position_world_to_eye_space(vec4 p) { return p; }"),
             base=base)
    r.sound()
    r.has("plr0_helper \\( c \\. r \\) \\* plr0_exposure")
    r.check(r.flat.count("struct Hit") == 1 and r.flat.count("struct plr0_Hit") == 1 and "plr1_Hit" not in r.flat,
            "the struct spelt as in the base is the base's")


@case
def own_main(link):
    "a unit with its own main is an effect's function like another"
    r = link("void main() { }\n" + RED, "void helper() { main(); }\nvoid main() { picture2(); }\nvoid picture2() { }\n" + RED)
    r.sound()
    r.called("change", [0, 1])
    r.check(r.flat.count("void main (") == 1, "one main")


@case
def host_uniforms(link):
    "castle_* uniforms are the host's, wherever declared: the same again is dropped"
    text = change("c = castle_ModelViewMatrix * c; c.r += castle_NormalMatrix[0][0];",
                  "uniform mat4 castle_ModelViewMatrix;\nuniform highp mat3 castle_NormalMatrix;\n"
                  "uniform mat4 castle_ProjectionMatrix, castle_Unused;")
    r = link(text, text, change("c = castle_ModelViewMatrix * c;"))
    r.sound()
    r.check(r.flat.count("uniform mat4 castle_ModelViewMatrix ;") == 1, "once")
    r.lacks("plr._castle")


@case
def host_uniform_in_base_and_library(link):
    "a host uniform of the base that a library function uses as well is declared once"
    for name in ("uniform mat4 castle_ModelViewMatrix;", "uniform mat4 castle_ModelViewMatrix, castle_ProjectionMatrix;",
                 "uniform highp mat4 castle_ModelViewMatrix;"):
        base = BASE.replace("void main", name + "\nvoid main").replace("picture = ", "color *= castle_ModelViewMatrix; picture = ")
        r = link(change("c = direction_eye_to_world_space(c.rgb).xyzz; c += position_world_to_eye_space(c);",
                        name.replace("highp ", "")), base=base)
        r.sound()
        r.check(len(__import__("re").findall("mat4 castle_ModelViewMatrix ;", r.flat)) == 1, "once")


@case
def host_uniform_wrong_type(link):
    "a host name declared with another type is an error"
    r = link(RED, change("c.r = castle_ModelViewMatrix[0][0];", "uniform mat3 castle_ModelViewMatrix;"), RED)
    r.check(r.status == 1, "exit 1")
    r.says("host-type", "e1.frag:1:14", "error")
    r.called("change", [0, 2])
    r.valid()
    r = link(RED, change("c.r = castle_ModelViewMatrix[0][0][0];", "uniform mat4 castle_ModelViewMatrix[2];"))
    r.says("host-type", "e1.frag:1:14", "error")
    base = BASE.replace("void main", "uniform float castle_Own;\nvoid main").replace("picture = ", "color.r = castle_Own; picture = ")
    r = link(change("c.r = castle_Own.x;", "uniform vec2 castle_Own;"), change("c.r = castle_Own;", "uniform float castle_Own;"), base=base)
    r.says("host-type", "e0.frag:1:14", "error")
    r.called("change", [1])
    r.valid()


@case
def two_effects_one_unknown_castle_name(link):
    "two effects that declare a castle_ name nobody knows share it"
    text = change("c.r = castle_Fancy;", "uniform float castle_Fancy;")
    r = link(text, text)
    r.sound()
    r.check(r.flat.count("uniform float castle_Fancy ;") == 1, "once")
    r = link(text, text.replace("uniform float", "uniform vec2").replace("= castle_Fancy", "= castle_Fancy.x"))
    r.says("host-type", severity="error")
    r.valid()


@case
def attributes(link):
    "vertex attributes belong to the geometry: never renamed, shared by effects"
    base = {"vertex": "#version 330\nin vec4 castle_Vertex;\nvoid main() { vec4 v = castle_Vertex; /* PLUG: place (v) */ gl_Position = v; }\n"}
    text = {"vertex": "attribute float weight;\nin vec3 castle_Normal;\nuniform float u;\nvoid PLUG_place(inout vec4 v) { v.x += weight * u + castle_Normal.x; }\n"}
    r = link(text, text, base=base, stage="vertex")
    r.sound()
    r.check(r.flat.count("in float weight ;") == 1, "once")
    r.has("plr0_u")
    r.has("plr1_u")
    r = link(text, {"vertex": text["vertex"].replace("float weight", "vec2 weight").replace("weight *", "weight.x *")},
             base=base, stage="vertex")
    r.check(r.status == 1, "another type of one attribute is an error")
    r.says("host-type", severity="error")
    r.valid()


@case
def redeclared_gl(link):
    "gl_ names are never renamed; built-in variables may be declared again"
    r = link(change("c.r = gl_FragCoord.x; gl_FragDepth = 0.5;",
                    "layout(origin_upper_left, pixel_center_integer) in vec4 gl_FragCoord;"))
    r.sound()
    r.has(r"layout \( origin_upper_left , pixel_center_integer \) in vec4 gl_FragCoord ;")
    base = {"vertex": "#version 330\nin vec4 castle_Vertex;\nout gl_PerVertex { vec4 gl_Position; float gl_ClipDistance[2]; };\n"
                      "void main() { vec4 v = castle_Vertex; /* PLUG: place (v) */ gl_Position = v; }\n"}
    r = link({"vertex": "void PLUG_place(inout vec4 v) { gl_ClipDistance[0] = v.x; gl_ClipDistance[1] = 1.0; }\n"}, base=base,
             stage="vertex", options=["--glsl", "410"])
    r.check(r.status == 0, "gl_PerVertex in the base")
    r.valid()
    r = link(RED, change("c.r = gl_own;", "float gl_own;"))
    r.says("reserved-name", severity="error")
    r.called("change", [0])


@case
def varyings(link):
    "the stages of one effect share varyings; those of two effects do not collide"
    base = {"vertex": "#version 330\nin vec4 castle_Vertex;\nvoid main() { vec4 v = castle_Vertex; /* PLUG: place (v) */ gl_Position = v; }\n",
            "fragment": BASE.replace("in vec3 point;\n", "").replace("point, 1.0", "1.0")}
    effect = {"vertex": "varying float height;\nuniform float amount;\nvoid PLUG_place(inout vec4 v) { height = v.y * amount; }\n",
              "fragment": "varying float height;\nuniform float amount;\nvoid PLUG_change(inout vec4 c) { c.r = height * amount; }\n"}
    for stage, word in (("vertex", "out"), ("fragment", "in")):
        r = link(effect, RED, effect, base=base, stage=stage)
        r.sound()
        for n in (0, 2):
            r.has(f"{word} float plr{n}_height ;")
            r.has(f"uniform float plr{n}_amount ;")


@case
def varyings_of_base(link):
    "an effect that declares a varying of the base again"
    for text in ("in vec3 point;", "varying vec3 point;"):
        r = link(change("c.rgb = point;", text))
        r.check(r.status in (0, 1), "links")
        r.valid()


@case
def underscores(link):
    "names that begin with, end with or hold several underscores"
    r = link(change("c.r = _a + a_ + __b() + a__b + _ + (_1);",
                    "uniform float _a, a_;\nfloat __b() { return 1.0; }\nfloat a__b, _, _1;"))
    r.check(r.status == 0, "links")
    r.valid()
    r.lacks(r"plr0__")


@case
def numbered_names(link):
    "names that look as if the linker had made them collide with nothing"
    r = link(RED + RED + change("c.r += change_2 + change + change_3();", "float change_2, change;\nfloat change_3() { return 1.0; }"),
             "void PLUG_change(inout vec4 c) { float u_a = _a + ua; c.r = u_a; }\nfloat _a, ua, u_a;\n")
    r.sound()
    r.called("change", [0, 0, 0, 1])
    r = link(RED, change("c.r = plr0_change;", "float plr0_change;"), change("float plr1_x = 1.0; c.r = plr1_x;"))
    r.says("reserved-name", "e1.frag:1:7", "error")
    r.says("reserved-name", "e2.frag:2:40", "error")
    r.called("change", [0])
    r.valid()


@case
def helper_used_twice(link):
    "one helper unit in two effects: each has its own copy"
    helper = "uniform float scale;\nfloat noise(vec3 p) { return p.x * scale; }\n"
    r = link(helper + change("c.r = noise(c.rgb);"), helper + change("c.g = noise(c.rgb);"))
    r.sound()
    r.has("plr0_noise \\( c")
    r.has("plr1_noise \\( c")


@case
def units_of_an_effect(link):
    "units of one effect share functions, structs, macros; a later unit speaks at the plugs of an earlier"
    r = link({"fragment": RED}, RED)
    base = BASE
    import os, tempfile, subprocess
    with tempfile.TemporaryDirectory() as folder:
        parts = {"base.frag": base, "a.frag": "#define K 2.0\nstruct S { float x; };\nuniform float amount;\n"
                 "float helper(S s);\n", "b.frag": "uniform float amount;\nfloat helper(S s) { return s.x * K * amount; }\n",
                 "c.frag": "float helper(S s);\n" + change("S s; s.x = 1.0; /* PLUG: own (s) */ c.r = helper(s) * amount;",
                                                            "uniform float amount;"),
                 "d.frag": "void PLUG_own(inout S s) { s.x = K; }\n#undef K\n#define K 3.0\nvoid PLUG_change(inout vec4 c) { c.g = K; }\n"}
        for name, text in parts.items():
            with open(os.path.join(folder, name), "w", encoding="utf-8") as file:
                file.write(text)
        done = subprocess.run([link.program, "link", "base.frag", "a.frag+b.frag+c.frag+d.frag"], cwd=folder, capture_output=True)
        r.status, r.errors, r.raw = done.returncode, done.stderr.decode(), done.stdout
        r.text = done.stdout.decode()
        import re
        r.flat = " ".join(re.sub(r"([^\w\s])", r" \1 ", r.text).split())
    r.sound()
    r.called("change", [0, 0])
    r.check(r.flat.count("uniform float plr0_amount ;") == 1, "the uniform is declared once")
    r.check("plr0_own ( s ) ;" in r.body("plr0_change"), "the later unit speaks in the earlier")


@case
def dead_code(link):
    "functions, uniforms, constants and structs that nothing reaches are left out; --keep-all keeps them"
    text = change("c.r = used();", "uniform float dead_u;\nconst float DEAD = 1.0;\nstruct Dead { float x; };\n"
                  "float dead(Dead d) { return dead_u * DEAD; }\nfloat live = 1.0, dead_g = 2.0;\n"
                  "uniform sampler2D dead_s;\nfloat used() { return live; }\n#define DEAD_M dead_s\nfloat dead(float x) { return x; }")
    r = link(text)
    r.sound()
    r.lacks(r"(?i)plr0_dead")
    r = link(text, options=["--keep-all"])
    r.check(r.status == 0, "links")
    r.valid()
    for word in ("dead_u", "DEAD", "Dead", "dead", "dead_g", "dead_s"):
        r.has(rf"plr0_{word}\b")
    r = link("void PLUG_nowhere() { x(); }\nvoid x() { }\n")
    r.lacks("plr0")
    r.valid()


@case
def unrecognised_is_kept(link):
    "what is not recognised is kept whole"
    r = link("precision highp float;\nprecision mediump int;\n#pragma optimize(off)\n" + RED)
    r.sound()
    r.has("# pragma optimize \\( off \\)")
    r.has("precision highp float ;")
    r = link("invariant gl_Position;\n" + RED) 
    r.has("invariant gl_Position ;")


@case
def used_and_reads(link):
    "PLUG_USED and READS in the base: negations, #elif, in functions and structs, nothing left of them"
    base = """#version 330 core
out vec4 picture;
struct S {
    vec4 value;
#if READS(normal)
    vec3 normal;
#endif
#if READS ( depth ) && !PLUG_USED(never)
    float depth;
#endif
};
#if PLUG_USED(shade)
vec4 light() { return vec4(1.0); }
#elif PLUG_USED(flat_shade)
vec4 light() { return vec4(2.0); }
#else
vec4 light() { return vec4(3.0); }
#endif
void main() {
    S s;
    s.value = light();
#if READS(normal)
    s.normal = vec3(4.0);
#endif
#if READS(depth)
    s.depth = 5.0;
#endif
    /* PLUG: shade (s) */
#if !PLUG_USED(shade) || PLUG_USED(flat_shade)
    /* PLUG: flat_shade (s) */
#endif
#if !PLUG_USED(never) && defined(__VERSION__)
    picture = s.value;
#else
    picture = unknown;
#endif
}
"""
    r = link(base=base)
    r.sound()
    r.has(r"3 \. 0")
    r.lacks(r"[1245] \. 0|normal|depth|# if|READS|USED")
    r = link("void PLUG_shade(inout S s) { s.value.rgb = s.normal; }", base=base)
    r.sound()
    r.has(r"1 \. 0")
    r.has("s \\. normal = vec3")
    r.lacks("depth|# if")
    r = link("void PLUG_flat_shade(inout S s) { f(s); }\nvoid f(inout S s) { s.value.r = s.depth; }\n"
             "void unreached(S s) { s.normal; }", base=base)
    r.sound()
    r.has(r"2 \. 0")
    r.has("s \\. depth = 5")
    r.lacks("normal|# if")


@case
def used_across_stages(link):
    "PLUG_USED asks all stages"
    base = {"vertex": "#version 330\nin vec4 castle_Vertex;\n#if PLUG_USED(change)\nout vec3 point;\n#endif\nvoid main() {\n"
                      "#if PLUG_USED(change)\npoint = castle_Vertex.xyz;\n#endif\ngl_Position = castle_Vertex; }\n",
            "fragment": "#version 330\nout vec4 picture;\n#if PLUG_USED(change)\nin vec3 point;\n#endif\nvoid main() { vec4 color = vec4(1.0);\n"
                        "#if PLUG_USED(change)\ncolor.xyz = point; /* PLUG: change (color) */\n#endif\npicture = color; }\n"}
    for stage in ("vertex", "fragment"):
        r = link(base=base, stage=stage)
        r.sound()
        r.lacks("point")
        r = link(RED, base=base, stage=stage)
        r.sound()
        r.has("point")


@case
def scopes_of_locals(link):
    "locals of inner blocks and loops, and lists of them, hide names only where they hold"
    r = link(change("""
    float x = 1.0, amount = amount + x, h = amount;
    { float noise = noise(h); c.r = noise; { float u = u; c.g += u; } c.b = u; } c.g += noise(u);
    for (int i = 0, N = N; i < N; i++) c.r += float(N); c.r += float(N);
    for (float u = u, v = u; u < 1.0; u += v) { c.r += v; { float v = u; c.r += v; } } c.b += u;
    for (int u = 0; u < 1; u++) if (u > 0) c.r += float(u); else { c.g += float(u); } c.b += u;
    switch (int(c.r)) { case 0: float k = k; c.r += k; break; default: c.r += k; }
    c.a = k;""", "uniform float amount, u;\nconst int N = 2;\nconst float k = 1.0;\nfloat noise(float x) { return x; }"))
    r.sound()
    r.has(r"amount = plr0_amount \+ x , h = amount ;")
    r.has(r"\{ float u = plr0_u ; c \. g \+ = u ; \} c \. b = plr0_u ;")
    r = link(change("{ float h = 1.0; c.b = h; } for (int b = 0; b < 2; b++) { c.b += float(b); c.h2 = c.b; } /* PLUG: own (c) */",
                    "#define h2 g"),
             change("/* PLUG: last (c) */ c.r = h;", "#define h 2.0\n#define b 3.0\n#define rg 4.0")
             + "void PLUG_own(inout vec4 c) { c.a = 1.0; }\n",
             "struct S { float h; vec2 b; };\nvoid PLUG_last(inout vec4 c) { S s; s.h = c.b; s.b = c.rg; { float h = s.h; "
             "c.r = h; } for (int b = 0, h = 1; b < h; b++) { c.g += s.b.x; } c.r += f(c.r, c.g) + rg(); }\n"
             "float f(float b, float h) { return b + h; }\nfloat rg() { return 1.0; }\n")
    r.sound()
    r.has(r"struct plr2_S \{ float h ; vec2 b ; \}")
    r.check(". plr" not in r.body("plr2_last"), "members of one effect are not macros of another")


@case
def macros_see_locals(link):
    "a macro that names what is a parameter or local where it is used"
    r = link(change("float g = 2.0; c.r = TWICE + f(c.g) + g;", "uniform float g, tex;\n#define TWICE (g * 2.0)\n#define AT (tex + 1.0)\n"
                    "float f(float tex) { return AT; }"))
    r.sound()
    r.check([s[1] for s in r.symbols] == [] or r.text.count("plr0_g = 2.0") == 1, "the local is meant")
