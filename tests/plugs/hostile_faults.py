"""Faults: a bad effect never takes its neighbours down, and is reported at its own line."""

from blackbox import BASE, case

RED = "void PLUG_change(inout vec4 c) { c.r += 1.0; }\n"


def fault(link, text, code, place, *options, severity="error", base=BASE):
    """An effect that is left out, between two that stay."""
    r = link(RED, text, RED, base=base, options=options)
    r.check(r.status == 1, "exit 1")
    r.says(code, f"e1.frag:{place}", severity)
    r.called("change", [0, 2])
    r.valid()
    return r


@case
def unterminated(link):
    "unterminated text of every kind"
    fault(link, "\nvoid PLUG_change(inout vec4 c) { c.r = 1.0;\n", "unterminated", "2:6")
    fault(link, "\n  void f() { {\n}\nvoid PLUG_change(inout vec4 c) { }\n", "unterminated", "2:8")
    fault(link, RED + "  /* never closed\n" + RED, "unterminated", "2:3")
    fault(link, RED + "/* PLUG: change (c) \n" + RED, "unterminated", "2:1")
    fault(link, RED + "/*/", "unterminated", "2:1")
    fault(link, "void PLUG_change(inout vec4 c { c.r = 1.0; }", "unterminated", "1:6")
    fault(link, "struct S { float x;\n" + RED, "unterminated", "1:8")
    fault(link, RED + "#if 1\n", "preprocessor", "2:1")
    fault(link, RED + "#ifdef A\n#else\n#else\n#endif\n", "preprocessor", "4:1")
    fault(link, RED + "#endif\n", "preprocessor", "2:1")
    fault(link, RED + "#elif 1\n", "preprocessor", "2:1")


@case
def too_many_brackets(link):
    "closing brackets too many"
    for text in (RED + "}\n", "}" + RED, RED + ")", RED.replace("c.r", ") c.r"), RED.replace("c.r", "( c.r"),
                 RED.replace("c.r", "[ c.r")):
        r = link(RED, text, RED, options=["--validate"])
        r.check(r.status == 1, f"exit 1: {text!r}")
        r.called("change", [0, 2])
        r.valid()
        r.check(r.errors.count("e1.frag:") > 0 and "base.frag:" not in r.errors, "reported in the effect")


@case
def not_void(link):
    "a plug function that returns something"
    fault(link, "float PLUG_change(inout vec4 c) { return 1.0; }", "plug-not-void", "1:7")
    fault(link, RED + "  highp vec4\n  PLUG_nowhere(int a) { return vec4(1.0); }", "plug-not-void", "3:3")
    fault(link, "PLUG_change(inout vec4 c) { c.r = 1.0; }", "plug-not-void", "1:1")


@case
def arity(link):
    "a number of parameters that fits no place"
    r = fault(link, "void\nPLUG_change(inout vec4 c, float b) { }", "plug-arity", "2:1")
    r.says("plug-arity", "base.frag:7:5", "note")
    fault(link, "void PLUG_change() { }", "plug-arity", "1:6")
    fault(link, "void PLUG_change(inout vec4 c, mat4 m[3], float f) { }", "plug-arity", "1:6")
    base = BASE.replace("/* PLUG: change (color) */", "/* PLUG: change (color) */ /* PLUG: change (color, 1.0) */")
    r = link(RED, "void PLUG_change(inout vec4 c, float x) { c.g = x; }", base=base)
    r.sound()
    r.called("change", [0, 1])


@case
def reserved(link):
    "reserved names"
    fault(link, "uniform float gl_mine;\n" + RED, "reserved-name", "1:15")
    fault(link, "float plugray_mine() { return 1.0; }\n" + RED, "reserved-name", "1:7")
    fault(link, RED + "void f() { float plr3_x; }\n", "reserved-name", "2:18")
    fault(link, RED + "#define gl_X 1\n", "reserved-name", "2:9")


@case
def unknown_plugs(link):
    "unknown plugs: a warning with the nearest names; wrong stage; known but inactive is silent"
    r = link("void PLUG_chnage(inout vec4 c) { }", RED)
    r.check(r.status == 0 and '"change"' in r.errors, "the nearest name")
    r.says("unknown-plug", "e0.frag:1:6", "warning")
    r = link("\n\n  void PLUG_vertex_object_space(inout vec4 v) { }\n")
    r.says("wrong-stage", "e0.frag:3:8", "warning")
    r.check("vertex stage" in r.errors, "names the stage")
    r = link("void PLUG_light_scale(inout float s, vec3 a, vec3 b) { s = 1.0; }\n" + RED)
    r.sound()
    r = link("void PLUG_zzzzqqqq() { }")
    r.says("unknown-plug", "e0.frag:1:6", "warning", times=1)


@case
def plug_syntax(link):
    "plug comments that cannot be read give a warning"
    for text in ("/* PLUG: */", "/* PLUG: change */", "/* PLUG: change (color */", "/* PLUG: change color) */",
                 "/* PLUG: 1x (color) */", "/* PLUG: change (color) more */", "/* PLUG: change (color);\n*/"):
        r = link(RED, base=BASE.replace("/* PLUG: change (color) */", text))
        r.says("plug-syntax", "base.frag:7:5", "warning")
        r.called("change", [])
        r.valid()


@case
def lacking(link):
    "an effect that lacks a plug of a faulty effect gives a note"
    r = link("void PLUG_change(inout vec4 c) { float x; /* PLUG: own (x) */ \n", "void PLUG_own(inout float x) { }\n" + RED)
    r.check(r.status == 1, "exit 1")
    r.says("unterminated", "e0.frag:1:6", "error")
    r.says("lacks", "e1.frag:1:6", "note")
    r.called("change", [1])
    r = link("struct W { float x; };\nfloat helper(W w) { return w.x; }\nvoid PLUG_change(inout vec4 c) { W w; /* PLUG: own (w) */ undefined; }\n",
             "void PLUG_own(inout W w) { w.x = helper(w); }\n" + RED, RED, options=["--validate"])
    r.says("glsl", "e0.frag:3:59", "error")
    r.called("change", [1, 2])
    r.says("lacks", severity="note")
    r.valid()


@case
def every_bad_effect(link):
    "each bad effect gives at least its first error, once"
    bad = ["void PLUG_change(inout vec4 c) { c.r = oops; }\n", "void PLUG_change(inout vec4 c) {\n  c.nope = 1.0;\n}\n",
           "uniform vec4 u = oops2;\nvoid PLUG_change(inout vec4 c) { c = u; }\n", "void PLUG_change(inout vec4 c) { c.r = 1.0 }\n",
           "void PLUG_change(inout vec4 c) { float c = 1.0; int i = 1.5; }\n", "float PLUG_change(inout vec4 c) { }\n",
           "void PLUG_change(inout vec4 c, float b) { }\n", "void PLUG_change(inout vec4 c) {\n"]
    r = link(RED, *bad, RED, options=["--validate"])
    r.check(r.status == 1, "exit 1")
    r.called("change", [0, 9])
    r.valid()
    for i in range(1, 9):
        r.check(r.errors.count(f"e{i}.frag:") >= 1, f"e{i} is reported")
    r.says("glsl", "e1.frag:1:40", "error", times=1)
    r.says("glsl", "e2.frag:2:5", "error")
    r.says("glsl", "e3.frag:1:18", "error")
    r.check("base.frag:" not in r.errors.replace("base.frag:7:5: note", ""), "no error in the base")
    r.check("plr" not in r.errors, "names as the author spelt them")
    r = link(RED, bad[0], bad[0], bad[0], options=["--validate"])
    r.called("change", [0])


@case
def glsl_places(link):
    "GLSL errors in functions, uniforms, structs, macros, constants, initialisers, parameters"
    for text, place in (("void PLUG_change(inout vec4 c) {\n\n      c.r = wrong + 1.0;\n}\n", "3:13"),
                        ("uniform wrongtype u;\nvoid PLUG_change(inout vec4 c) { c.r = u; }", "1:1"),
                        ("struct S {\n  wrongtype x;\n};\nvoid PLUG_change(inout vec4 c) { S s; c.r = 1.0; }", "2:3"),
                        ("const float K = wrong;\nvoid PLUG_change(inout vec4 c) { c.r = K; }", "1:17"),
                        ("float g() {\n  return /* \u00fc */ wrong;\n}\nvoid PLUG_change(inout vec4 c) { c.r = g(); }", None),
                        ("\tvoid PLUG_change(inout vec4 c) { c.r = wrong; }", "1:41"),
                        ("void PLUG_change(inout vec4 c) { c.r = \\\n   wrong; }", "2:4"),
                        ("void PLUG_change(inout vec4 c)\r\n{\r\n  c.r = wrong;\r\n}\r\n", "3:9"),
                        ("\ufeffvoid PLUG_change(inout vec4 c) { c.r = wrong; }", None),
                        ("float f(wrongtype x) { return 1.0; }\nvoid PLUG_change(inout vec4 c) { c.r = f(1); }", "1:1")):
        r = link(RED, text, RED, options=["--validate"])
        r.check(r.status == 1, "exit 1")
        r.says("glsl", place and f"e1.frag:{place}", "error")
        r.called("change", [0, 2])
        r.valid()


@case
def glsl_in_macro(link):
    "an error in a macro's body is reported in the effect, at the macro's use or body"
    r = link(RED, "#define BAD(x) (x + wrong)\nvoid PLUG_change(inout vec4 c) {\n  c.r = BAD(1.0);\n}\n", RED, options=["--validate"])
    r.check(r.status == 1, "exit 1")
    r.check(r.errors.startswith(("e1.frag:3:", "e1.frag:1:")), "in the effect")
    r.called("change", [0, 2])


@case
def type_mismatch(link):
    "a type error of a socket call stands at the parameter list, with a note that names the plug's place"
    r = link(RED, "\n  void PLUG_change (inout vec3 c) { c.r = 1.0; }\n", RED, options=["--validate"])
    r.check(r.status == 1, "exit 1")
    r.says(None, "e1.frag:2:20", "error")
    r.says(None, "base.frag:7:5", "note")
    r.called("change", [0, 2])
    r.valid()
    r = link(RED, "void PLUG_change(inout Missing c) { }\n", RED, options=["--validate"])
    r.check(r.status == 1 and "e1.frag:1:" in r.errors, "an unknown type")
    r.called("change", [0, 2])


@case
def unreached_errors(link):
    "GLSL errors in unreached text are warnings [unreached]"
    r = link("float dead() {\n  return wrong;\n}\n" + RED, options=["--validate"])
    r.check(r.status == 0, "exit 0")
    r.says("unreached", "e0.frag:2:10", "warning")
    r.called("change", [0])
    r.valid()


@case
def base_faults(link):
    "a fault in the base is an error, and nothing is written"
    r = link(RED, base=BASE + "void f() {")
    r.check(r.status == 1, "exit 1")
    r.says("unterminated", "base.frag:10:6", "error")
    r = link(RED, base=BASE + "/* x")
    r.says("unterminated", "base.frag:10:1", "error")
    r = link(RED, base=BASE.replace("vec4(point", "vec4(pont"), options=["--validate"])
    r.check(r.status == 1, "exit 1")
    r.says("glsl", "base.frag:6:23", "error")


@case
def clash_with_base(link):
    "names of the base's locals, parameters and functions in effects harm nothing"
    base = BASE.replace("void main", "float f(float color) { return color; }\nvoid main")
    r = link("float color = 1.0;\nuniform float main_amount;\nfloat f(float x) { return x * color * main_amount; }\n"
             "void PLUG_change(inout vec4 picture) { vec4 color2 = picture; picture.r = f(color) + color2.r; }\n", base=base,
             options=["--validate"])
    r.sound()


@case
def missing_files(link):
    "an effect that is not there leaves the others"
    import os
    import subprocess
    import tempfile
    r = link(RED)
    with tempfile.TemporaryDirectory() as folder:
        for name, text in (("base.frag", BASE), ("a.frag", RED)):
            with open(os.path.join(folder, name), "w", encoding="utf-8") as file:
                file.write(text)
        done = subprocess.run([link.program, "link", "base.frag", "none.frag", "a.frag", "a.frag+none2.frag"], cwd=folder,
                              capture_output=True, text=True)
        r.check(done.returncode == 1 and "none.frag:1:1: error" in done.stderr and "[missing-file]" in done.stderr
                and "plr1_change(color)" in done.stdout, "exit 1, and the rest")
        for words, status in ((["link"], 2), (["link", "base.frag", "--stage", "nowhere"], 2), (["link", "base.frag", "--glsl", "111"], 2),
                              (["link", "base.frag", "--nothing"], 2), (["link", "base.frag", "a.frag"], 0), (["link", "nothing.frag"], 1)):
            done = subprocess.run([link.program, *words], cwd=folder, capture_output=True, text=True)
            r.check(done.returncode == status, f"{' '.join(words)}: {status}, not {done.returncode}")
