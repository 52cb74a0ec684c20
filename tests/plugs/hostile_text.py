"""Reading: what the linker must not be fooled by."""

from blackbox import BASE, case

RED = "void PLUG_change(inout vec4 c) { c.r += 1.0; }\n"


@case
def comments(link):
    "names of plugs in comments are none"
    r = link("// void PLUG_change(inout vec4 c) { }\n/* void PLUG_change(inout vec4 c) { } */\n"
             "/* see PLUG_change (...) */ void /* a */ PLUG_change /* b */ ( /* c, d */ inout vec4 c "
             "// , float e) {\n ) /* } */ { c.r /* ; */ = 1.0; // }\n}\n")
    r.sound()
    r.called("change", [0])


@case
def line_comment_plug(link):
    "a plug comment behind // is none"
    r = link(RED, base=BASE.replace("/* PLUG: change (color) */", "// /* PLUG: change (color) */"))
    r.valid()
    r.called("change", [])
    r.says("unknown-plug", "1:6", "warning")


@case
def spacing_of_comments(link):
    "spacing in a magic comment is free"
    for text in ("/*PLUG:change(color)*/", "/*\tPLUG :change\n (\n color\n )\n*/",
                 "/*   PLUG:   change   (color)   */", "/*\r\nPLUG: change (color)\r\n*/",
                 "/*PLUG:change (color)(color, color)*/"):
        r = link(RED, base=BASE.replace("/* PLUG: change (color) */", text))
        r.sound()
        r.called("change", [0])


@case
def spacing_of_functions(link):
    "any spacing in the head of a plug function"
    for text in ("void PLUG_change (inout vec4 c) { c.r = 1.0; }",
                 "void\nPLUG_change\n(\ninout\nvec4\nc\n)\n{\nc.r = 1.0;\n}",
                 ";void PLUG_change(inout vec4 c){c.r=1.0;}", ";;\tvoid\tPLUG_change\t(inout vec4 c)\t{ }",
                 "float a;void PLUG_change(inout vec4 c){c.r=a;}",
                 "void PLUG_change(inout vec4 c){c.r=1.0;}float b;"):
        r = link(text)
        r.sound()
        r.called("change", [0])


@case
def longer_words(link):
    "PLUG_ inside a longer word is none"
    r = link("void MY_PLUG_change(inout vec4 c) { c.g = 1.0; }\nfloat xPLUG_change = 1.0;\n"
             "void PLUG_change(inout vec4 c) { MY_PLUG_change(c); c.r = xPLUG_change; }\n")
    r.sound()
    r.called("change", [0])
    r.has(r"plr0_MY_PLUG_change \( c \)")


@case
def prototypes(link):
    "a prototype without a body is no plug function"
    r = link("void PLUG_change(inout vec4 c);\n")
    r.sound()
    r.called("change", [])
    r = link("void PLUG_change(inout vec4 c);\nvoid g(inout vec4 c) { PLUG_change(c); }\n"
             "void PLUG_change(inout vec4 c);\n" + RED)
    r.sound()
    r.called("change", [0])


@case
def breaks(link):
    "CRLF, lone CR, a byte-order mark, no newline at the end"
    text = "uniform float a;\n#define TWICE(x) \\\n  ((x) + \\\n  (x))\n" \
           "void PLUG_change(inout vec4 c) {\n  c.r = TWICE(a); // end\n}"
    base = BASE.rstrip("\n")
    for change in (lambda t: t, lambda t: t.replace("\n", "\r\n"),
                   lambda t: "\ufeff" + t, lambda t: "\ufeff" + t.replace("\n", "\r\n")):
        r = link(change(text), base=change(base))
        r.sound()
        r.called("change", [0])
        r.check("\r" not in r.text and "\ufeff" not in r.text, "no CR and no mark in the program")


@case
def continuations(link):
    "line continuations are spliced; the map keeps the author's lines"
    r = link("void PLUG_ch\\\nange(inout vec4 c) { c.r = 1.\\\n5; // a comment \\\n c.g = 7.0;\n"
             "  c.b = 2.5;\n}\n")
    r.sound()
    r.called("change", [0])
    r.has(r"c \. r = 1 \. 5 ;")
    r.lacks(r"7 \. 0")
    r.check(any("e0.frag:5:3" in row[1] for row in r.map), "line 5 keeps its number")
    r = link(RED, base=BASE.replace("PLUG: change", "PLUG: ch\\\nange"))
    r.sound()
    r.called("change", [0])


@case
def nested_parentheses(link):
    "nested parentheses in parameters and arguments"
    r = link("#define P(x) x\nconst int N = 2;\nvoid PLUG_change(inout P(vec4) c, float a[(N) * (2)]) { "
             "c.r = a[3]; }\n",
             base=BASE.replace("(color)", "(color, float[](max(1.0, (2.0)), f(color, 1), 3.0, 4.0))")
             .replace("void main", "float f(vec4 c, int i) { return c.r; }\nvoid main"))
    r.called("change", [0])
    r.valid()


@case
def argument_lists(link):
    "the first list of a function's length is called"
    base = BASE.replace("(color)", "(color, 1.0, vec2(0.0, 1.0)) (color, 2.0) (color, 3.0) (color)")
    r = link("void PLUG_change(inout vec4 c) { c.r = 1.0; }",
             "void PLUG_change(inout vec4 c, float a) { c.r = a; }",
             "void PLUG_change(inout vec4 c, float a, vec2 b) { c.r = a + b.x; }", base=base)
    r.sound()
    r.called("change", [0, 1, 2])
    r.has(r"plr1_change \( color , 2 \. 0 \) ;")
    r.has(r"plr2_change \( color , 1 \. 0 , vec2 \( 0 \. 0 , 1 \. 0 \) \) ;")


@case
def empty_lists(link):
    "() and (void) have no parameters"
    base = BASE.replace("(color)", "( )")
    for text in ("void PLUG_change() { }", "void PLUG_change(void) { }", "void PLUG_change( /* x */ ) { }"):
        r = link(text, base=base)
        r.sound()
        r.called("change", [0])
    r = link("void PLUG_change(inout vec4 c) { }", base=base)
    r.says("plug-arity", "e0.frag:1:6", "error")
    r.called("change", [])


@case
def if_0(link):
    "inactive text does not exist"
    r = link("#if 0\nvoid PLUG_change(inout vec4 c) { undefined }\n#endif\n"
             "#if 1\n" + RED + "#else\nvoid PLUG_change(inout vec4 c) { c.g = 1.0; }\n#endif\n")
    r.sound()
    r.called("change", [0])
    r = link(RED, base=BASE.replace("/* PLUG: change (color) */",
                                    "#if 0\n/* PLUG: change (color) */\n#endif"))
    r.called("change", [])
    r.says("unknown-plug", "1:6", "warning")
    r = link("#if 0\nvoid PLUG_nowhere() { { { ( \n it's no text\n#else\n" + RED + "#endif\n")
    r.sound()
    r.called("change", [0])


@case
def conditionals(link):
    "#ifdef chains, #elif, defined(), nesting, with the unit's own macros"
    r = link("""#define A 2
#define B
#undef B
#define EMPTY
#if defined(B) || !defined A
float one;
#elif A == 1 + 1 && !(A > 2) && (A << 1) == 4 && A % 2 == 0
#ifdef EMPTY
void PLUG_change(inout vec4 c) { c.r = 3.0; }
#else
void PLUG_change(inout vec4 c) { c.r = 4.0; }
#endif
#elif unevaluable(1)
void PLUG_change(inout vec4 c) { c.r = 5.0; }
#else
void PLUG_change(inout vec4 c) { c.r = 6.0; }
#endif
#if __VERSION__ >= 330 && defined(CASTLE_GLSL_VERSION_UPGRADE) && !defined(GL_ES)
void PLUG_change(inout vec4 c) { c.g = 7.0; }
#endif
""")
    r.sound()
    r.called("change", [0, 0])
    r.has("3 \\. 0")
    r.has("7 \\. 0")
    r.lacks(r"\b[456] \. 0|# (if|el|endif)")


@case
def conditionals_in_bodies(link):
    "conditionals inside functions, structs, parameter lists and blocks"
    r = link("""struct S { float a;
#if 1
  float b;
#else
  float nothing;
#endif
};
void PLUG_change(inout vec4 c
#if 0
 , float more
#endif
) {
  S s;
#ifdef NOTHING
  c.r = nothing;
#else
  s.a = s.b = 1.0; c.r = s.b;
#endif
}
""")
    r.sound()
    r.called("change", [0])
    r.lacks("nothing|more|# (if|el|endif)")


@case
def unevaluable(link):
    "an expression that cannot be evaluated keeps all branches, their functions and uniforms"
    r = link("""#extension GL_ARB_texture_gather : enable
#ifdef GL_ARB_texture_gather
uniform float fast;
float value() { return fast; }
#elif 0
float value() { return never; }
#else
uniform float slow;
float value() { return slow; }
#endif
void PLUG_change(inout vec4 c) {
#if GL_ARB_texture_gather
  c.r = value();
#else
  c.g = value();
#endif
}
""")
    r.sound()
    r.called("change", [0])
    r.has("# (ifdef GL_ARB_texture_gather|if defined)")
    r.has("plr0_fast")
    r.has("plr0_slow")
    r.lacks("never")


@case
def unevaluable_plugs(link):
    "plugs and plug functions in branches that are kept"
    r = link("""#ifdef GL_ARB_texture_gather
void PLUG_change(inout vec4 c) { c.r = 1.0; }
#else
void PLUG_change(inout vec4 c) { c.g = 1.0; }
#endif
""")
    r.valid()
    r = link(RED, base=BASE.replace("/* PLUG: change (color) */", """
#ifdef GL_ARB_texture_gather
    color.g = 1.0;
    /* PLUG: change (color) */
#else
    /* PLUG: change (color) */
#endif"""))
    r.sound()
    r.called("change", [0, 0])


@case
def plug_in_define(link):
    "a plug comment inside a #define is none, with a warning"
    r = link(RED, base=BASE.replace("void main", "#define X(c) /* PLUG: change (c) */ (c)\nvoid main")
             .replace("/* PLUG: change (color) */", "color = X(color);", 1)
             .replace("/* PLUG: change (c) */ (c)", "/* PLUG: change (c) */ (c)"))
    r.says("plug-in-macro", "base.frag:5:14", "warning")
    r.called("change", [])
    r.valid()


@case
def places_of_plugs(link):
    "plugs in loops, unrolled text, branches, and functions other than main"
    base = """#version 330 core
out vec4 picture;
/* PLUG-DECLARATIONS */
void light(inout vec4 c, int i) {
    /* PLUG: each (c, i) */
}
void main() {
    vec4 color = vec4(0.0);
    for (int i = 0; i < 3; i++) /* PLUG: change (color) */ ;
    for (int i = 0; i < 3; i++) { light(color, i); /* PLUG: change (color) */ }
    /* PLUG: change (color) */ /* PLUG: change (color) */
    if (color.r > 0.0) /* PLUG: change (color) */
        color.g = 1.0;
    else /* PLUG: change (color) */
        color.b = 1.0;
    if (color.r > 1.0) { } /* PLUG: change (color) */
    while (color.r < 1.0)
        /* PLUG: change (color) */
        color.r += 1.0;
    do { /* PLUG: change (color) */ color.r += 1.0; } while (color.r < 1.0);
    switch (int(color.r)) { case 0: /* PLUG: change (color) */ break; default: /* PLUG: change (color) */ }
    { /* PLUG: change (color) */ }
    picture = color;
}"""
    r = link(RED, RED + "void PLUG_each(inout vec4 c, int i) { c.b += float(i); }\n", base=base)
    r.sound()
    r.called("change", [0, 1] * 12)
    r.check("plr1_each ( c , i ) ;" in r.body("light"), "the function has its call")


@case
def else_without_braces(link):
    "a plug behind if or else stays one statement"
    base = BASE.replace("/* PLUG: change (color) */", """
    if (color.r > 0.5) /* PLUG: change (color) */;
    else if (color.g > 0.5) /* PLUG: change (color) */ { color.g = 0.0; }
    else for (int i = 0; i < 2; i++) if (i > 0) /* PLUG: change (color) */ color.b += 1.0; else color.b -= 1.0;
    color.a = 1.0;""")
    r = link(RED, RED, base=base)
    r.sound()
    r.called("change", [0, 1] * 3)


@case
def declarations_mark(link):
    "forward declarations go where PLUG-DECLARATIONS says, else after the leading lines"
    effect = "void PLUG_change(inout vec4 c) { c = h(c); }\nvec4 h(vec4 c) { return c; }\n"
    body = "void main() { vec4 color = vec4(0.0); /* PLUG: change (color) */ picture = color; }\n"
    for head in ("#version 330\n/* PLUG-DECLARATIONS */\nout vec4 picture;\n",
                 "#version 330\nout vec4 picture;\n/*PLUG-DECLARATIONS*/\n",
                 "#version 330\nout vec4 picture;\n/*\n PLUG-DECLARATIONS\n*/ /* PLUG-DECLARATIONS */\n",
                 "out vec4 picture;\n", "// a comment\n\n#version 330\n// another\nout vec4 picture;\n",
                 "out vec4 picture; /* PLUG-DECLARATIONS */ float x() { return 1.0; }\n"):
        r = link(effect, base=head + body)
        r.sound()
        r.called("change", [0])
        at = r.flat.find("void plr0_change ( inout vec4 c ) ;")
        r.check(0 < at < r.flat.find("void main"), "a prototype stands before main")


@case
def declarations_need_structs(link):
    "forward declarations are preceded by the structs and constants that they name"
    for mark in ("/* PLUG-DECLARATIONS */\n", ""):
        r = link("const int M = N;\nstruct Own { T t; };\n"
                 "void PLUG_change(inout vec4 c, S s, float a[N], vec2 b[M]) { Own o; o.t = s.t[1]; c.r = o.t.x + a[1]"
                 " + b[0].x; }\n",
                 base="#version 330\n" + mark + """out vec4 picture;
#define TWO 2
const int ONE = 1;
const int N = ONE + ONE;
struct T { float x; };
struct S { T t[TWO]; };
void main() {
    vec4 color = vec4(0.0);
    S s; float a[N]; vec2 b[N];
    s.t[1].x = a[0] = a[1] = 1.0; b[0] = b[1] = vec2(0.0);
    /* PLUG: change (color, s, a, b) */
    picture = color;
}
""")
        r.sound()
        r.called("change", [0])


@case
def mark_in_effects(link):
    "PLUG-DECLARATIONS in an effect or in a comment line harms nothing"
    r = link("/* PLUG-DECLARATIONS */\nfloat a() { return 1.0; }\n/* PLUG-DECLARATIONS */\n"
             "void PLUG_change(inout vec4 c) { c.r = a(); /* PLUG-DECLARATIONS */ }\n",
             base=BASE.replace("/* PLUG-DECLARATIONS */", "// /* PLUG-DECLARATIONS */"))
    r.sound()
    r.called("change", [0])


@case
def nothing_but(link):
    "files of nothing, of comments, of blanks"
    for text in ("", "// nothing", "/* nothing */", "\n\n\n", "\ufeff", " \t\r\n", ";", ";;;\n", "#", "#\n"):
        r = link(text, RED, text)
        r.sound()
        r.called("change", [1])
    r = link(RED, base="void main() { }")
    r.check(r.status == 0, "a base without plugs")
    r = link(RED, base="")
    r.check(r.status in (0, 1), "an empty base")


@case
def foreign_bytes(link):
    "bytes outside ASCII in comments; NUL bytes"
    r = link("// \u00fcber \u4e2d\u6587\n/* \u00e9 */ void PLUG_change(inout vec4 c) { /* \u00df */ c.r = 1.0; } // \u00e4")
    r.sound()
    r.called("change", [0])
    r = link(b"// \xff\xfe\x80 \x00 \n/* \x00 */ void PLUG_change(inout vec4 c) { c.r = 1.0; }\n")
    r.sound()
    r.called("change", [0])
    r = link(b"void PLUG_change(inout vec4 c) { c.r = \x00 1.0; }\n", RED)
    r.check(b"\x00" not in r.raw, "no NUL in the program")
    r = link(b"void PLUG_change(inout vec4 c) { c.r = \x00 1.0; }\n", RED, options=["--validate"])
    r.called("change", [1])
    r.valid()


@case
def long_lines(link):
    "very long lines, words and lists"
    r = link("void PLUG_change(inout vec4 c) { c.r = " + " + ".join(["1.0"] * 20000) + "; }")
    r.check(r.status == 0, "a line of 120 kB")
    r.called("change", [0])
    name = "a" * 1000
    r = link(f"float {name} = 1.0;\nvoid PLUG_change(inout vec4 c) {{ c.r = {name}; }}")
    r.check(r.status == 0 and f"plr0_{name}" in r.text, "a word of 1000 letters")


@case
def deep_nesting(link):
    "100 kB of nested brackets end in a message or a program, never in a crash"
    for opening, closing in ("()", "{}", "[]"):
        for tail in (closing * 100000, ""):
            text = "void PLUG_change(inout vec4 c) { c.r = 1.0; " + opening * 100000 + tail + "; }\n"
            r = link(text, RED)
            r.check(r.status in (0, 1) and r.calls("change")[-1:] == [1], f"{opening} {bool(tail)}")
    r = link("#if 1\n" * 50000 + "#endif\n" * 50000 + RED)
    r.check(r.status in (0, 1), "50000 nested #if")
    r = link("#if " + "(" * 50000 + "1" + ")" * 50000 + "\n#endif\n", RED)
    r.check(r.status in (0, 1) and r.calls("change") == [1], "50000 parentheses in #if")
    r = link("void PLUG_change(inout vec4 c) { " + "if (c.r > 0.0) " * 20000 + "c.r = 1.0; }", RED)
    r.check(r.status in (0, 1) and r.calls("change")[-1:] == [1], "20000 nested if")


@case
def many_effects(link):
    "5000 effects"
    r = link(*["uniform float a;\nvoid PLUG_change(inout vec4 c) { c.r += a; }\n"] * 5000)
    r.check(r.status == 0 and not r.errors, "links")
    r.called("change", list(range(5000)))


@case
def determinism(link):
    "the same bytes each time"
    effects = ("uniform float a;\nstruct S { float x; };\nvoid PLUG_change(inout vec4 c) { S s; s.x = a; c.r = s.x;"
               " /* PLUG: own (c) */ }\n", "void PLUG_own(inout vec4 c) { c.b = 1.0; }\n" + RED) * 3
    first = link(*effects)
    first.sound()
    first.check(all(link(*effects).raw == first.raw for _ in range(3)), "linked four times")


@case
def map_is_complete(link):
    "every line of the program has a row; columns are exact"
    effect = "uniform float amount;\n\n  void PLUG_change(inout vec4 c)\n  {\n    c.r += amount; c.g = helper(c);\n  }\n" \
             "float helper(vec4 c) { return c.g; }\n"
    r = link(effect, effect)
    r.sound()
    lines = r.text.split("\n")
    lines = lines[:-1] if lines[-1] == "" else lines
    r.check([row[0] for row in r.map] == [str(i + 1) for i in range(len(lines))], "a row for each line")
    texts = {"base.frag": BASE.split("\n"), "e0.frag": effect.split("\n"), "e1.frag": effect.split("\n")}
    for line, row in zip(lines, r.map):
        file, number, column = row[1].rsplit(":", 2)
        if file in texts and "change" not in line:
            word = line.split()[0] if line.split() else ""
            origin = texts[file][int(number) - 1][int(column) - 1:]
            word = word.replace("plr0_", "").replace("plr1_", "")
            r.check(origin.startswith(word.split("(")[0]), f"{row[1]} is {word}")
    r.check({row[2] for row in r.map} >= {"-", "e0.frag", "e1.frag"}, "effects are named")


@case
def strings_of_directives(link):
    "strings of preprocessor lines hide nothing and open nothing"
    for line in ('#pragma message("/* PLUG: change (c) */")', '#pragma message("/* open")', '#pragma a "// b" c',
                 '#pragma "void PLUG_change(inout vec4 c) { }"', "#pragma it's"):
        r = link(line + "\n" + RED, RED)
        r.sound()
        r.called("change", [0, 1])


@case
def functions_in_one_branch(link):
    "a plug function that is in one branch that is kept is called where it is defined, and only there"
    for text in ("#ifdef GL_X\n" + RED + "#endif\n", "#ifdef GL_X\nvoid PLUG_change(inout vec4 c, float b) { }\n#else\n" + RED + "#endif\n",
                 "#ifdef GL_X\n#elif UNKNOWN\n#ifndef GL_Y\n" + RED + "#endif\n#endif\n",
                 "#ifndef GL_X\n" + RED + "#endif\nvoid PLUG_change(inout vec4 c) { c.g = 1.0; }\n"):
        r = link(text, RED, base=BASE.replace("(color)", "(color, 1.0) (color)"))
        r.sound()
        r.check(r.calls("change")[0] == 0 and r.calls("change")[-1] == 1, "both effects are called")


@case
def many_plugs_in_a_line(link):
    "calls of many plugs in one line cost no more than their text"
    import resource

    def cpu_seconds():  # of the programs that were run; other load on the machine does not count
        used = resource.getrusage(resource.RUSAGE_CHILDREN)
        return used.ru_utime + used.ru_stime
    start = cpu_seconds()
    r = link("void PLUG_change(inout vec4 c) { " + "/* PLUG: own (c) */ " * 8000 + "}",
             *["void PLUG_own(inout vec4 c) { c.r = 1.0; }"] * 10)
    r.check(r.status == 0 and cpu_seconds() - start < 8.0, "8000 plugs, 10 effects")
    start = cpu_seconds()
    r = link(*[f"void PLUG_zork{i}(inout vec4 c) {{ /* PLUG: own{i} (c) */ }}\n" for i in range(3000)])
    r.check(r.status == 0 and cpu_seconds() - start < 8.0, "3000 unknown plugs")
