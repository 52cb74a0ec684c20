#!/usr/bin/env python3
"""plugray plugs SCENE: what each shape and each volume calls, in order."""

import json
import re

from harness import Suite
from scenes import FRONT, constant, effect, effect_parts, quad, scene, volume

suite = Suite()

LIT = "Material { diffuseColor 1 1 1 }"
NO_HEADLIGHT = "NavigationInfo { headlight FALSE }\n"


def chains(text, *arguments, **options):
    """The listing's chains: the heads, and the calls below each: (depth, plug, effect, place)."""
    options.setdefault("files", {}).setdefault("scene.x3dv", text)
    output = suite.command("plugs", "scene.x3dv", *arguments, **options).output
    found, stage = [], None
    for line in output.split("\n\nsurface-1:\n")[0].split("\n\nvolume-1:\n")[0].splitlines():
        indent = len(line) - len(line.lstrip())
        if line and indent == 0:
            found.append((line, []))
        elif indent == 2:
            stage = line.strip()
        elif indent >= 4:
            plug, _, rest = line.strip().partition(": ")
            name, _, place = rest.rpartition(" at ")
            found[-1][1].append(((indent - 4) // 2, stage, plug, name, place))
    return found


def author(calls):
    """The calls of authors' functions: stage, plug, effect, line."""
    return [(stage, plug, name, int(place.split(":")[1]))
            for _, stage, plug, name, place in calls if not place.startswith("effects/")]


def line_of(text, word, count=1):
    lines = [i for i, line in enumerate(text.splitlines(), 1) if word in line]
    return lines[count - 1]


@suite.case
def shape():
    "plug by plug in the order of the calls, effect by effect, at the authors' lines"
    text = scene(NO_HEADLIGHT, "DirectionalLight { effects ", effect(
        "void PLUG_light_scale(inout float scale, const in vec3 n, const in vec3 l) { scale *= 0.5; }",
        head="DEF Dim"), "}\nGroup { children [\n", effect(
            "void PLUG_fragment_modify(inout vec4 c) { c.r = 1.0; } // outer", head="DEF Outer"),
        quad(LIT, effect("void PLUG_fragment_modify(inout vec4 c) { c.g = 1.0; } // first\n"
                         "void PLUG_main_texture_apply(inout vec4 c, const vec3 n)\n{\n  /* PLUG: mine (c) */\n}",
                         head="DEF First")
             + effect("void PLUG_mine(inout vec4 c) { c.b = 1.0; }", head="DEF Second")
             + effect("void PLUG_vertex_eye_space(const in vec4 v, const in vec3 n) { }", head="DEF Third",
                      kind="VERTEX")).replace("Shape", "DEF Cube Shape"), "] }\n")
    (head, calls), = chains(text)
    suite.equal("the shape", head,
                f"surface: Shape Cube at scene.x3dv:{line_of(text, 'DEF Cube')}:10, program surface-1")
    suite.equal("authors' calls", author(calls), [
        ("vertex", "vertex_eye_space", "Third", line_of(text, "PLUG_vertex_eye_space")),
        ("fragment", "main_texture_apply", "First", line_of(text, "PLUG_main_texture_apply")),
        ("fragment", "mine", "Second", line_of(text, "PLUG_mine")),
        ("fragment", "light_scale", "Dim", line_of(text, "PLUG_light_scale")),
        ("fragment", "fragment_modify", "First", line_of(text, "// first")),
        ("fragment", "fragment_modify", "Outer", line_of(text, "// outer"))])
    builtin = [(plug, name, place.split(":")[0]) for _, _, plug, name, place in calls if place.startswith("effects/")]
    suite.check("built-in effects at their files",
                ("add_light", "DirectionalLight", "effects/lights/DirectionalLight.glsl") in builtin, builtin)
    depths = {plug: depth for depth, _, plug, _, _ in calls}
    suite.equal("calls within calls", [depths[p] for p in ("main_texture_apply", "mine", "light_scale")],
                [0, 1, depths["add_light"] + 1])


@suite.case
def equal_effects():
    "shapes that share a program have chains of their own, with their own lines"
    code = "void PLUG_fragment_modify(inout vec4 c) { c.r = 0.5; }"
    text = scene(NO_HEADLIGHT, quad(effects=effect(code)), quad(effects=effect(code, head="DEF Other")))
    one, two = chains(text)
    suite.equal("programs", [head.rpartition(" ")[2] for head, _ in (one, two)], ["surface-1"] * 2)
    suite.equal("lines", [author(calls)[0][2:] for _, calls in (one, two)],
                [("Effect", line_of(text, "PLUG_")), ("Other", line_of(text, "PLUG_", 2))])


@suite.case
def volumes():
    "volumes that are cast together have each its own effects"
    code = "void PLUG_volume_classify(inout vec4 c, const in VolumeSample s) { c.%s *= 0.5; }"
    text = scene(FRONT, NO_HEADLIGHT,
                 "DEF One " + volume(constant(128), effects=effect(code % "r", head="DEF Red")),
                 "DEF Two " + volume(constant(64), effects=effect(code % "g", head="DEF Green")))
    found = chains(text)
    suite.equal("heads", [re.sub(r":\d+:\d+", "", head) for head, _ in found],
                ["volume: VolumeData One at scene.x3dv, program volume-1",
                 "volume: VolumeData Two at scene.x3dv, program volume-1"])
    suite.equal("their effects", [[name for _, _, name, _ in author(calls)] for _, calls in found],
                [["Red"], ["Green"]])
    suite.check("what both have", all(any(name == "Composite" for _, _, _, name, _ in calls)
                                      for _, calls in found), found)


@suite.case
def geometry_stage():
    "the geometry stage stands between the others"
    text = scene(quad(effects=effect_parts((
        ("GEOMETRY", "layout(triangles) in;\nlayout(triangle_strip, max_vertices = 3) out;\nvoid main() {\n"
                     "  for (int i = 0; i < 3; i++) { geometryVertexSet(i); EmitVertex(); }\n}\n"
                     "void PLUG_geometry_vertex_set(const int index) { }"),
        ("FRAGMENT", "void PLUG_fragment_modify(inout vec4 c) { c.r = 1.0; }"),
        ("VERTEX", "void PLUG_vertex_object_space(const vec4 v, inout vec3 n) { }")), head="DEF All")))
    (_, calls), = chains(text)
    suite.equal("", [call[:2] for call in author(calls)], [
        ("vertex", "vertex_object_space"), ("geometry", "geometry_vertex_set"), ("fragment", "fragment_modify")])


@suite.case
def worlds_of_textures():
    "what a RenderedTexture shows is listed as well"
    inner = quad("UnlitMaterial { }", effect("void PLUG_fragment_modify(inout vec4 c) { c.g = 0.5; }",
                                             head="DEF Within")).replace("Shape", "DEF Inner Shape")
    text = scene(quad("UnlitMaterial { }", effect("void PLUG_fragment_modify(inout vec4 c) { c.r = 0.5; }",
                                                  head="DEF Without"),
                      "texture RenderedTexture { dimensions [16 16 3] scene Group { children [\n%s] } }" % inner))
    found = chains(text)
    suite.equal("", [[name for _, _, name, _ in author(calls)] for _, calls in found], [["Without"], ["Within"]])


@suite.case
def left_out():
    "what is left out has no place in the chain; what is replaced neither"
    text = scene(quad("UnlitMaterial { }",
                      effect("void PLUG_fragment_modify(inout vec4 c) { c.r = nothing; }", head="DEF Wrong")
                      + effect("void PLUG_surface_color(inout vec4 c) { c.r = 0.5; }", 'placement "REPLACE" target'
                               ' "UnlitMaterial"', head="DEF Instead")
                      + effect("void PLUG_light_scale(inout float s, const in vec3 n, const in vec3 l) { }",
                               head="DEF Unused")))
    (_, calls), = chains(text, status=1)
    suite.equal("", [name for _, _, _, name, _ in calls], ["Instead"])


@suite.case
def as_json():
    "the same as JSON"
    text = scene(NO_HEADLIGHT, "DirectionalLight { }\n", quad(LIT, effect(
        "void PLUG_light_scale(inout float s, const in vec3 n, const in vec3 l) { s *= 0.5; }",
        head='DEF Dim')))
    data = json.loads(suite.command("plugs", "scene.x3dv", "--format", "json", files={"scene.x3dv": text}).output)
    thing, = data["drawables"]
    suite.equal("the shape", (thing["kind"], thing["node"], thing["def"], thing["program"], thing["place"]["line"]),
                ("surface", "Shape", None, "surface-1", line_of(text, "Shape")))
    call = next(c for c in thing["calls"] if c["plug"] == "light_scale")
    suite.equal("a call", call, {
        "stage": "fragment", "plug": "light_scale", "depth": call["depth"], "effect": "Dim", "builtin": False,
        "function": {"file": "scene.x3dv", "line": line_of(text, "PLUG_"), "column": 6},
        "offered_by": "DirectionalLight", "offered_at": call["offered_at"]})
    suite.equal("its plug", call["offered_at"]["file"], "effects/lights/DirectionalLight.glsl")
    text_calls = chains(text)[0][1]
    suite.equal("as many as in the text", len(thing["calls"]), len(text_calls))


@suite.case
def own_plugs():
    "the plugs that plugray brings: as text, JSON and the tables of the documentation"
    listing = suite.command("plugs").output
    data = json.loads(suite.command("plugs", "--format", "json").output)
    tables = suite.command("plugs", "--format", "markdown").output
    for plug in ("vertex_object_space_change", "geometry_vertex_set", "fragment_modify", "volume_classify", "add_light"):
        suite.check(plug, re.search(rf"^{plug} \(", listing, re.M) and f"| `{plug}` |" in tables
                    and any(row["name"] == plug for row in data))
    row = next(row for row in data if row["name"] == "texture_color")
    suite.check("both lists of texture_color", len(row["parameters"]) == 2 and row["stage"] == "fragment", row)
    suite.command("plugs", "scene.x3dv", "--format", "markdown", status=2, files={"scene.x3dv": scene(quad())})


suite.run()
