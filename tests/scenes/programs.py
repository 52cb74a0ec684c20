#!/usr/bin/env python3
"""The programs that scenes are drawn with: no more than the scene uses, valid, and mapped."""

import os
import re
import shutil
import subprocess

from harness import Suite, load_json
from scenes import constant, effect, front_scene, quad, volume

suite = Suite()

HERE = os.path.dirname(os.path.abspath(__file__))
BARE = front_scene(volume(constant(51, (4, 4, 4))))
# The composed program may have this many times the instructions of the hand-written one, as --stats
# counts them (measured 1.12: the clamping between plugs, which a bare volume does not need, and guards
# against rounding). What is left after a compiler's optimisation is compared in twins.py.
ALLOWED = 1.2


def dumped(text, files=None, status=0):
    """The programs of a scene: name -> text, and the folder."""
    result = suite.command("dump", "scene.x3dv", "-d", "out", files={"scene.x3dv": text, **(files or {})},
                           status=status)
    folder = os.path.join(result.folder, "out")
    programs = {}
    for name in sorted(os.listdir(folder)):
        with open(os.path.join(folder, name), encoding="utf-8") as file:
            programs[name] = file.read()
    return programs, folder


def without_comments(text):
    return re.sub(r"//[^\n]*|/\*.*?\*/", " ", text, flags=re.S)


def validator():
    return shutil.which("glslangValidator")


def validate(name, folder, programs):
    if not validator():
        suite.skip(name, "glslangValidator is not installed")
        return
    stages = [n for n in programs if n.endswith((".vert", ".geom", ".frag"))]
    for stem in sorted({n.rpartition(".")[0] for n in stages}):
        own = [n for n in stages if n.rpartition(".")[0] == stem]
        done = subprocess.run([validator(), "-l", *own], cwd=folder, stdout=subprocess.PIPE,
                              stderr=subprocess.STDOUT, check=False)
        suite.check(f"{name}: {stem} is valid", done.returncode == 0, done.stdout.decode())


def uniforms(text):
    return re.findall(r"\buniform\s+\w+\s+(\w+)", without_comments(text))


@suite.case
def bare_volume():
    "a bare volume, whatever the method: no light, no gradient, no unused uniform, one volume"
    programs, folder = dumped(BARE)
    names = [n for n in programs if n.startswith("volume") and n.endswith(".frag")]
    suite.equal("one fragment program", len(names), 1)
    text = without_comments(programs[names[0]])
    for word in ("light", "normal(?!ize)", "gradient", "[mM]aterial", "volume_mix_add", "s\\.segment"):
        suite.check(f"no {word}", not re.search(word, text),
                    *(line for line in text.splitlines() if re.search(word, line)))
    for uniform in uniforms(text):
        suite.check(f"uniform {uniform} is used", len(re.findall(rf"\b{uniform}\b", text)) > 1)
    fetches = len(re.findall(r"\btexture(?:Lod|Fetch)?\s*\((?!\w*(?:sums|ranges|leaps)\b)", text))
    suite.check("the voxel in one place, and at most the function", 1 <= fetches <= 2, fetches)
    suite.check("no plug comment and no conditional is left",
                "PLUG" not in text and "#if" not in text, text)
    validate("bare", folder, programs)


@suite.case
def against_the_minimal_one():
    "instructions and fetches against a raycaster written by hand"
    stats = load_json(suite.render(BARE, "--step", ".5", "--no-leaping", "--stats", "json").output)
    program = next(p for p in stats["programs"] if p["name"].startswith("volume"))
    suite.equal("fetches", program["fetches"], 3)
    with open(os.path.join(HERE, "minimal-raycaster.frag"), encoding="utf-8") as file:
        minimal = file.read()
    # a complete shader passes through the same counter
    shader = ('Shape { appearance Appearance { shaders ComposedShader { language "GLSL" '
              "initializeOnly SFNode voxels PixelTexture3D { image [1 1 1 1 0] } "
              "initializeOnly SFNode transferFunction PixelTexture { image 1 1 4 0 } "
              "initializeOnly SFMatrix4f eyeToLocal 1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1 "
              "initializeOnly SFVec3f dimensions 1 1 1 initializeOnly SFVec4f viewport 0 0 1 1 "
              "initializeOnly SFFloat sampleDistance 1 initializeOnly SFFloat referenceLength 1 "
              "initializeOnly SFFloat transparencyLeft 0 initializeOnly SFVec2f visibleValues 0 2 "
              "parts [ ShaderPart { type \"VERTEX\" url \"data:text/plain,\n#version 330 core\n"
              "void main() { gl_Position = vec4(0.0); }\" }\n"
              "ShaderPart { type \"FRAGMENT\" url \"minimal-raycaster.frag\" } ] } } "
              "geometry Box { } }\n")
    stats = load_json(suite.render(front_scene(shader), "--stats", "json",
                                   files={"minimal-raycaster.frag": minimal}).output)
    own = next(p for p in stats["programs"] if p["name"].startswith("surface"))
    suite.equal("fetches of the minimal one", own["fetches"], 3)
    ratio = program["instructions"] / own["instructions"]
    print(f"# {program['instructions']} instructions, by hand {own['instructions']}: ratio {ratio:.3f}")
    suite.check(f"at most {ALLOWED} times the instructions", 0.5 < ratio <= ALLOWED, ratio)


@suite.case
def minimal_one_draws_the_same():
    "the raycaster written by hand draws the same picture: it is no straw man"
    with open(os.path.join(HERE, "minimal-raycaster.frag"), encoding="utf-8") as file:
        minimal = file.read()
    data = "PixelTexture3D { image [1 2 2 2 20 60 0 90 120 33 70 200] repeatS FALSE repeatT FALSE repeatR FALSE }"
    size = 16
    # eye space to the volume's own coordinates: 10 back along z
    shader = ('Shape { appearance Appearance { shaders ComposedShader { language "GLSL" '
              f"initializeOnly SFNode voxels {data} "
              "initializeOnly SFNode transferFunction PixelTexture { repeatS FALSE repeatT FALSE "
              "image 2 1 4 0x00000000 0xFFFFFFFF } "
              "initializeOnly SFMatrix4f eyeToLocal 1 0 0 0 0 1 0 0 0 0 1 10 0 0 0 1 "
              f"initializeOnly SFVec3f dimensions 1 1 1 initializeOnly SFVec4f viewport 0 0 {size} {size} "
              "initializeOnly SFFloat sampleDistance .05 initializeOnly SFFloat referenceLength .5 "
              "initializeOnly SFFloat transparencyLeft 0 initializeOnly SFVec2f visibleValues 0 2 "
              "parts [ ShaderPart { type \"VERTEX\" url \"data:text/plain,\n#version 330 core\n"
              "in vec4 castle_Vertex;\nvoid main() { gl_Position = vec4(castle_Vertex.xy, 0.0, 1.0); }\" }\n"
              "ShaderPart { type \"FRAGMENT\" url \"minimal-raycaster.frag\" } ] } } "
              "geometry IndexedFaceSet { solid FALSE coordIndex [0 1 2 3 -1] coord Coordinate { point "
              "[-1 -1 0, 1 -1 0, 1 1 0, -1 1 0] } } }\n")
    by_hand = suite.picture(front_scene(shader),
                            files={"minimal-raycaster.frag": minimal}, size=f"{size}x{size}")
    composed = suite.picture(front_scene(volume(data)), "--step", "0.1", size=f"{size}x{size}")
    colors = range(0, size * size * 4)
    worst = max(abs(by_hand.values[i] - composed.values[i]) for i in colors if i % 4 != 3)
    suite.close("", worst, 0, 1e-4)
    suite.check("something is drawn", max(composed.values) > 0.2, max(composed.values))


LIT = ("DirectionalLight { }\n",
       volume(constant(51, (4, 4, 4)), "ShadedVolumeStyle { lighting TRUE }"))


@suite.case
def pay_for_use():
    "each feature adds what it needs, and only that"
    def count(*parts):
        stats = load_json(suite.render(front_scene(*parts), "--stats", "json").output)
        return next(p for p in stats["programs"] if p["name"].startswith("volume"))

    bare = count(volume(constant(51)))
    shaded = count(volume(constant(51), "ShadedVolumeStyle { }"))
    lit = count(*LIT)
    two = count("DirectionalLight { }\n", *LIT)
    no_light = count(LIT[1])
    segments = 5  # two looks at bytes in two places; their integral: everything can be seen
    suite.equal("a style without a function: the voxel in one place, and its tables", shaded["fetches"], segments + 1)
    suite.check("a light needs the gradient", lit["fetches"] > 1, lit)
    suite.equal("without a light no gradient is fetched", no_light["fetches"], segments)
    suite.check("a second light costs less than the first",
                0 < two["instructions"] - lit["instructions"]
                < lit["instructions"] - no_light["instructions"], (no_light, lit, two))
    idle = effect("float unused(float x) { return sin(x); }\nuniform float idle = 1.0;\n")
    suite.equal("an effect without plug functions costs nothing",
                count(volume(constant(51), effects=idle)), bare)


@suite.case
def valid_programs():
    "programs of lit, mixed and affected scenes are valid"
    two = volume(constant(51)) + "Transform { translation .5 0 0 children [\n" + volume(
        constant(99), "ShadedVolumeStyle { lighting TRUE }", effect(
            "void PLUG_light_scale(inout float scale, const in vec3 n, const in vec3 l) { scale *= n.z; }")) + "] }\n"
    surface = quad("Material { }", effect("uniform sampler2D t;\nvoid PLUG_fragment_modify(inout vec4 c)"
                                          "{ c *= texture2D(t, c.xy); }",
                                          "initializeOnly SFNode t PixelTexture { image 1 1 1 9 }"))
    programs, folder = dumped(front_scene("DirectionalLight { }\nPointLight { }\nSpotLight { }\n", two, surface))
    suite.check("a volume and a surface", any(n.startswith("volume") for n in programs)
                and any(n.startswith("surface") for n in programs), list(programs))
    validate("many", folder, programs)


@suite.case
def maps():
    "the map leads every line of the program to a place; an effect's line to the author's"
    code = "void PLUG_volume_classify(inout vec4 color, const in VolumeSample s) {\n  color.b = 0.123;\n}"
    text = front_scene(volume(constant(51), effects=effect(code, head="DEF Mine")))
    programs, _ = dumped(text)
    name = next(n for n in programs if n.startswith("volume") and n.endswith(".frag"))
    lines = programs[name].splitlines()
    rows = [row.split("\t") for row in programs[name + ".map"].splitlines()]
    suite.equal("a row a line", [int(r[0]) for r in rows], list(range(1, len(lines) + 1)))
    at = next(i for i, line in enumerate(lines) if "0.123" in line)
    author = next(i for i, line in enumerate(text.splitlines(), 1) if "0.123" in line)
    file, line, _ = rows[at][1].rsplit(":", 2)
    suite.equal("the author's line", (file, int(line), rows[at][2]), ("scene.x3dv", author, "Mine"))


@suite.case
def deterministic():
    "the same scene gives the same programs to the byte"
    suite.check("", dumped(front_scene(*LIT))[0] == dumped(front_scene(*LIT))[0])


@suite.case
def statistics():
    "--stats json has all its parts"
    stats = load_json(suite.render(BARE, "--step", "0.5", "--stats", "json", "--repeat", "2").output)
    suite.equal("phases", list(stats["phases"]), ["load", "link", "compile", "upload", "draw"])
    suite.check("times", all(p["cpu_ms"] >= 0 and p["wall_ms"] >= 0 for p in stats["phases"].values())
                and stats["phases"]["draw"]["wall_ms"] > 0, stats["phases"])
    # 8 x 8 pixels meet the box of 4 voxels' depth; a sample each half voxel, one more at most where
    # the length of the ray is not quite a whole number of them
    suite.check("samples", 8 * 8 * 8 <= stats["samples"] <= 8 * 8 * 9, stats["samples"])

suite.run()
