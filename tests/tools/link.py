#!/usr/bin/env python3
"""plugray link: link.py PLUGRAY"""

import re
import subprocess
import sys

from command import Command
from tap import check, check_equal, done

plugray = Command(sys.argv[1])

plugray.write("base.vert", """#version 330 core
in vec4 castle_Vertex;
void main() {
    vec4 vertex = castle_Vertex;
    /* PLUG: place (vertex) */
    gl_Position = vertex;
}
""")
plugray.write("base.frag", """#version 330 core
out vec4 picture;
/* PLUG-DECLARATIONS */
void main() {
    vec4 color = vec4(0.0);
    /* PLUG: shade (color) */
    picture = color;
}
""")
plugray.write("tint.frag", """uniform vec3 amount;
uniform float levels[4];
uniform float unused;
void PLUG_shade(inout vec4 color) {
    color.rgb += amount * levels[2];
}
""")
plugray.write("wave.vert", """uniform float amount;
out float height;
void PLUG_place(inout vec4 vertex) {
    height = amount * vertex.x;
    vertex.y += height;
}
""")
plugray.write("wave.frag", """in float height;
uniform float amount;
void PLUG_shade(inout vec4 color) {
    color.g += height * amount;
}
""")
plugray.write("broken.frag", """void PLUG_shade(inout vec4 color) {
    color.r += 1.0;
""")
plugray.write("number.frag", """
  void PLUG_shade(inout vec4 color, float more) { color.r += more; }
""")
plugray.write("wrong.frag", """void PLUG_shade(inout vec4 color) {
    color.b += densty;
}
""")


def compiles(text, stage):
    run = subprocess.run(["glslangValidator", "--stdin", "-S", stage], input=text, encoding="utf-8",
                         capture_output=True)
    return check(run.returncode == 0, f"glslangValidator takes the {stage} program", run.stdout)


# ---- the program

plain = plugray.expect(0, "link", "base.frag", "tint.frag", "--stage", "fragment")
check(not plain.stderr, "a clean link says nothing", plain.stderr)
compiles(plain.stdout, "frag")
check("amount" in plain.stdout and "unused" not in plain.stdout, "what nothing reaches is left out")
plugray.expect(0, "link", "base.frag", "tint.frag", "-o", "deep/folder/out.frag")
check_equal(plugray.read("deep/folder/out.frag"), plain.stdout, "-o writes the same, making folders")
check_equal([p.name for p in (plugray.folder / "deep/folder").iterdir()], ["out.frag"],
            "no temporary file is left")
check("unused" in plugray.expect(0, "link", "base.frag", "tint.frag", "--keep-all").stdout,
      "--keep-all keeps what nothing reaches")
check_equal(plugray.expect(0, "link", "base.frag", "tint.frag", "tint.frag").stdout,
            plugray.expect(0, "link", "base.frag", "tint.frag", "tint.frag").stdout,
            "linking twice gives the same bytes")
for glsl, first in (("330", "#version 330 core"), ("410", "#version 410"), ("450", "#version 450"),
                    ("300es", "#version 300 es")):
    text = plugray.expect(0, "link", "base.frag", "tint.frag", "--glsl", glsl).stdout
    check(text.startswith(first), f"--glsl {glsl} begins with {first}", text[:100])

# ---- map and symbols

plugray.expect(0, "link", "base.frag", "tint.frag", "-o", "out.frag", "--map", "out.map",
               "--symbols", "out.tsv")
program = plugray.read("out.frag").splitlines()
rows = [line.split("\t") for line in plugray.read("out.map").splitlines()]
check_equal([row[0] for row in rows], [str(i + 1) for i in range(len(program))],
            "the map has a row for each line of the program")
check(all(len(row) == 3 and re.fullmatch(r".+:\d+:\d+", row[1]) for row in rows),
      "each row has LINE, FILE:LINE:COLUMN, EFFECT", rows[:5])
body = next(i for i, line in enumerate(program) if "levels[2]" in line or "[2]" in line)
check_equal(rows[body][1:], ["tint.frag:5:5", "tint.frag"], "a line of an effect leads to its place")
main = next(i for i, line in enumerate(program) if "void main" in line)
check_equal(rows[main][1:], ["base.frag:4:1", "-"], "a line of the base leads to its place")
symbols = sorted(line.split("\t") for line in plugray.read("out.tsv").splitlines())
check_equal([(s[0], s[1], s[3], s[4]) for s in symbols],
            [("tint.frag", "amount", "vec3", "0"), ("tint.frag", "levels", "float", "4")],
            "a row for each uniform: effect, name, type, array size")
check(all(re.search(rf"\b{re.escape(s[2])}\b", "\n".join(program)) for s in symbols),
      "the program's names of uniforms are in the program", symbols)
plugray.expect(0, "link", "base.frag", "tint.frag", "tint.frag", "--symbols", "twice.tsv", "-o", "o.frag")
twice = [line.split("\t") for line in plugray.read("twice.tsv").splitlines()]
check_equal(sorted({s[0] for s in twice}), ["tint.frag", "tint.frag#2"], "two uses are told apart")
check_equal(len({s[2] for s in twice}), 4, "two uses of one effect share no uniform")

# ---- stages

both = ("link", "base.vert+base.frag", "wave.vert+wave.frag", "tint.frag")
vertex = plugray.expect(0, *both, "--stage", "vertex", "--symbols", "vertex.tsv").stdout
fragment = plugray.expect(0, *both, "--stage", "fragment", "--symbols", "fragment.tsv").stdout
compiles(vertex, "vert")
compiles(fragment, "frag")


def names(file, effect):
    return {s[2] for s in (line.split("\t") for line in plugray.read(file).splitlines())
            if s[0] == effect and s[1] == "amount"}


effect = "wave.vert+wave.frag"
check_equal(names("vertex.tsv", effect), names("fragment.tsv", effect), "the stages agree on names")
plugray.write("wave.vert.glsl", plugray.read("wave.vert"))
plugray.write("wave.vs", plugray.read("wave.vert"))
for name in ("wave.vert.glsl", "wave.vs"):
    check_equal(plugray.expect(0, "link", "base.vert", name, "--stage", "vertex").stdout,
                plugray.expect(0, "link", "base.vert", "wave.vert", "--stage", "vertex").stdout,
                f"{name} belongs to the vertex stage")
plugray.write("plain.glsl", plugray.read("wave.vert"))
check("height" in plugray.expect(0, "link", "base.vert", "plain.glsl", "--stage", "vertex").stdout,
      "a unit without an ending of a stage belongs to that of --stage")
plugray.write("a+b.frag", plugray.read("tint.frag"))
check("amount" in plugray.expect(0, "link", "base.frag", "a+b.frag").stdout,
      "a file whose name holds a plus is one unit")

# ---- faults

fault = plugray.expect(1, "link", "base.frag", "tint.frag", "broken.frag",
                       stderr="broken.frag:1:6: error: ")
check("[unterminated]\n    void PLUG_shade(inout vec4 color) {\n         ^\n" in fault.stderr,
      "the author's line and a caret stand below, indented", fault.stderr)
check_equal(fault.stdout, plain.stdout, "the rest is written all the same")
fault = plugray.expect(1, "link", "base.frag", "number.frag", stderr="number.frag:2:8: error: ")
check("[plug-arity]" in fault.stderr, "a wrong number of parameters has its code", fault.stderr)
fault = plugray.expect(0, "link", "base.frag", "wrong.frag")
check("densty" in fault.stdout, "without --validate no compiler is asked")
fault = plugray.expect(1, "link", "base.frag", "wrong.frag", "tint.frag", "--validate",
                       stderr="wrong.frag:2:16: error: ")
check("densty" in fault.stderr and "[glsl]" in fault.stderr, "--validate reports at the author's line",
      fault.stderr)
check("densty" not in fault.stdout and "amount" in fault.stdout, "... leaves out the faulty effect only")
check("plr0_" not in fault.stderr and "plr1_" not in fault.stderr, "... and names things as the author does")
compiles(fault.stdout, "frag")
plugray.expect(0, "link", "base.frag", "tint.frag", "--validate", "--glsl", "450", "--keep-all")
plugray.write("marked.frag", b"\xef\xbb\xbfvoid PLUG_shade(inout vec4 color, int more) { }\n")
fault = plugray.expect(1, "link", "base.frag", "marked.frag", stderr="[plug-arity]")
check("\n    void PLUG_shade(inout vec4 color, int more) { }\n         ^\n" in fault.stderr,
      "the caret stands right behind a byte-order mark", fault.stderr)
plugray.write("tabs.frag", "\tvoid /* ä */ PLUG_shade(inout vec4 color, int more) { }\n")
fault = plugray.expect(1, "link", "base.frag", "tabs.frag", stderr="tabs.frag:1:16: error: ")
check("\n    \t             ^\n" in fault.stderr, "... and behind tabs and letters of several bytes",
      fault.stderr)
missing = plugray.expect(1, "link", "base.frag", "nowhere.frag", "tint.frag", stderr="[missing-file]")
check_equal("amount" in missing.stdout, True, "a missing effect leaves the others")
plugray.expect(1, "link", "nowhere.frag", stderr="nowhere.frag:1:1: error: ")
plugray.expect(3, "link", "base.frag", "-o", "base.frag/out.frag", stderr="[output]")
check_equal(plugray.run("link", "-", "tint.frag", "--stage", "fragment",
                        stdin=plugray.read("base.frag")).stdout, plain.stdout,
            "the base may come from standard input")
done()
