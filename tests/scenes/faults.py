#!/usr/bin/env python3
"""Faults in effects: neighbours are drawn, the author's line and column are told, exit status 1."""

import gzip

from harness import HEADER, Suite, load_json
from scenes import FRONT, NO_HEADLIGHT, constant, effect, front_scene, quad, scene, volume

suite = Suite()

BLACK = "UnlitMaterial { emissiveColor 0 0 0 }"
MODIFY = "void PLUG_fragment_modify(inout vec4 color)"
RED, BLUE = effect(MODIFY + "{ color.r = 0.5; }"), effect(MODIFY + "{ color.b = 0.25; }")


def position(text, mark):
    """Line and column, from 1, of a mark that occurs once."""
    at = text.index(mark)
    assert text.index(mark, at) == text.rindex(mark), mark
    return text.count("\n", 0, at) + 1, at - text.rfind("\n", 0, at)


def places(result, severity="error"):
    return [(m[1], m[2]) for m in result.messages() if m[3] == severity]


BAD = {  # name: code of the effect, fields, what the message stands at, code of the message
    "syntax": (MODIFY + " {\n  color.g = 1.0\n  ;;) color.g = 0.5; }", "", None, "glsl"),
    "name": (MODIFY + " {\n  color.g = wrong_name * 2.0; }", "", "wrong_name", "glsl"),
    "type": (MODIFY + " {\n  vec2 mixed_up = color; color.g = mixed_up.x; }", "", None, "glsl"),
    "not void": ("float PLUG_fragment_modify(inout vec4 color) { return 1.0; }", "",
                 "PLUG_fragment_modify(inout vec4 color) { return", "plug-not-void"),
    "number of parameters": ("void PLUG_fragment_modify(inout vec4 color, float extra) { }", "",
                             "PLUG_fragment_modify(inout vec4 color, float extra", "plug-arity"),
    "type of a parameter": ("void PLUG_fragment_modify(inout vec3 triple) { triple.g = 1.0; }", "",
                            "(inout vec3 triple", "glsl"),
    "unterminated comment": (MODIFY + "{ color.g = 1.0; }\n/* never closed", "", "/* never closed",
                             "unterminated"),
    "unterminated body": ("void PLUG_fragment_modify(inout vec4 open) { open.g = 1.0;\n", "",
                          "PLUG_fragment_modify(inout vec4 open", "unterminated"),
    "type of a uniform": ("uniform vec4 tint;\n" + MODIFY + "{ color.g = tint.g; }",
                          "initializeOnly SFVec3f tint 0 1 0", "tint 0 1 0", "uniform-type"),
    "host name": ("uniform vec3 castle_ModelViewMatrix;\n" + MODIFY
                  + "{ color.g = castle_ModelViewMatrix.x; }", "", None, "host-type"),
}


@suite.case
def one_of_three():
    "one bad effect among three: the others are drawn, one error at its place"
    for name, (code, fields, mark, kind) in BAD.items():
        text = front_scene(quad(BLACK, RED + effect(code, fields) + BLUE))
        result = suite.render(text, "--probe", "8,8", status=1)
        suite.close(f"{name}: the others", [float(w) for w in result.output.split()], (0.5, 0, 0.25, 1))
        errors = [m for m in result.messages() if m[3] == "error"]
        suite.equal(f"{name}: code", sorted({m[5] for m in errors}), [kind])
        if mark:
            line, column = position(text, mark)
            suite.equal(f"{name}: place", errors[0][:3] if errors else None,
                        ("scene.x3dv", line, column))
        else:
            first = position(text, code.split("\n")[0])[0]
            last = first + code.count("\n")
            suite.check(f"{name}: line", errors and first <= errors[0][1] <= last,
                        f"expected {first}..{last}", result.errors)


@suite.case
def on_volumes():
    "the same on a volume"
    classify = "void PLUG_volume_classify(inout vec4 color, const in VolumeSample s)"
    bad = effect(classify + " {\n  color = vec4(s.density); }")
    text = front_scene(volume(constant(9), effects=effect(classify + "{ color = vec4(0.5, 0.0, 0.0, 1.0); }")
                              + bad + effect(classify + "{ color.b = 0.25; }")))
    result = suite.render(text, "--probe", "8,8", status=1)
    suite.close("the others", [float(w) for w in result.output.split()], (0.5, 0, 0.25, 1))
    line, _ = position(text, "s.density")
    suite.equal("line", sorted({m[1] for m in result.messages() if m[3] == "error"}), [line])


@suite.case
def warnings():
    "unknown plug with the nearest name, wrong stage, unreached mistakes: warnings, exit status 0"
    cases = {
        "unknown": ("void PLUG_fragment_modifi(inout vec4 misspelt) { }", "FRAGMENT", "unknown-plug",
                    "fragment_modify"),
        "wrong stage": (MODIFY + "{ /* wrong stage */ }", "VERTEX", "wrong-stage", "fragment"),
    }
    for name, (code, kind, expected, said) in cases.items():
        text = front_scene(quad(BLACK, RED + effect(code, kind=kind) + BLUE))
        result = suite.render(text, "--probe", "8,8")
        suite.close(f"{name}: drawn", [float(w) for w in result.output.split()], (0.5, 0, 0.25, 1))
        found = result.with_code(expected)
        suite.equal(f"{name}: severity", [m[3] for m in found], ["warning"])
        suite.check(f"{name}: says {said}", found and said in result.errors, result.errors)
        line, column = position(text, code)
        shift = code.index("PLUG_")
        suite.equal(f"{name}: place", found[0][1:3] if found else None, (line, column + shift))
    unreached = effect("float idle(float x) { return nothing_there * x; }\n" + MODIFY + "{ color.g = 1.0; }")
    text = front_scene(quad(BLACK, unreached))
    result = suite.command("check", "scene.x3dv", files={"scene.x3dv": text})
    suite.equal("unreached: a warning of check", [m[3::2] for m in result.messages()],
                [("warning", "unreached")])
    suite.equal("unreached: line", [m[1] for m in result.messages()], [position(text, "nothing_there")[0]])
    result = suite.render(text, "--probe", "8,8")
    suite.close("unreached: drawn", [float(w) for w in result.output.split()], (0, 1, 0, 1))


@suite.case
def once_for_many_shapes():
    "a bad effect that three shapes use is reported once"
    bad = effect(MODIFY + "{ color.g = wrong_name; }", head="DEF B")
    text = front_scene(quad(BLACK, bad), quad(BLACK, "USE B"), quad(BLACK, "USE B"))
    result = suite.render(text, "--probe", "8,8", status=1)
    suite.equal("", len(places(result)), 1)


@suite.case
def lacking():
    "what builds on a bad effect is left out with a note"
    bad = effect(MODIFY + "{ float heat = wrong_name;\n /* PLUG: heat_change (heat) */ color.g = heat; }")
    user = effect("void PLUG_heat_change(inout float heat) { heat = 1.0; }")
    result = suite.render(front_scene(quad(BLACK, RED + bad + user)), "--probe", "8,8", status=1)
    suite.close("drawn", [float(w) for w in result.output.split()], (0.5, 0, 0, 1))
    suite.equal("one error, and a note", (len(places(result)), bool(result.with_code("lacks"))), (1, True))


BROKEN = "void PLUG_fragment_modify(inout vec4 color)\n{\n  color.g = wrong_name;\n}\n"


@suite.case
def encodings():
    "the author's line and column in x3dv, CDATA, attributes, files, Inline, PROTO, gzip"
    x3d = ('<?xml version="1.0" encoding="UTF-8"?>\n<X3D profile="Immersive" version="4.0">\n<Scene>\n'
           '<OrthoViewpoint position="0 0 10"/>\n<Shape><Appearance><UnlitMaterial/>\n'
           '<Effect containerField="effects"><EffectPart type="FRAGMENT" %s</Effect></Appearance>\n'
           '<IndexedFaceSet coordIndex="0 1 2 3 -1"><Coordinate point="-1 -1 0 1 -1 0 1 1 0 -1 1 0"/>'
           "</IndexedFaceSet></Shape>\n</Scene>\n</X3D>\n")
    classic = front_scene(quad(BLACK, effect(BROKEN)))
    cdata = x3d % f"><![CDATA[data:text/plain,\n{BROKEN}]]></EffectPart>"
    bare = x3d % f"><![CDATA[{BROKEN}]]></EffectPart>"
    attribute = x3d % ("url='\"data:text/plain,\n" + BROKEN + "\"'/>")
    entity = attribute.replace("inout vec4 color)", "inout vec4 color) /* &lt;&#97;&amp; */").replace(
        "  color.g = wrong", "  /* &gt; */ color.g = wrong")
    outside = front_scene(quad(BLACK, 'Effect { parts EffectPart { type "FRAGMENT" url "glsl/broken.frag" } }'))
    inline = front_scene('Inline { url "parts/part.x3dv" }\n')
    proto = scene(FRONT, NO_HEADLIGHT, "PROTO Bad [ ] {\n", effect(BROKEN), "}\n", quad(BLACK, "Bad { }"))
    cases = (
        ("x3dv", "scene.x3dv", classic, {}, "scene.x3dv", classic),
        ("CDATA", "scene.x3d", cdata, {}, "scene.x3d", cdata),
        ("CDATA without data:", "scene.x3d", bare, {}, "scene.x3d", bare),
        ("attribute", "scene.x3d", attribute, {}, "scene.x3d", attribute),
        ("entities", "scene.x3d", entity, {}, "scene.x3d", entity),
        ("file", "scene.x3dv", outside, {"glsl/broken.frag": BROKEN}, "glsl/broken.frag", BROKEN),
        ("Inline", "scene.x3dv", inline, {"parts/part.x3dv": HEADER + quad(BLACK, effect(BROKEN))},
         "parts/part.x3dv", HEADER + quad(BLACK, effect(BROKEN))),
        ("PROTO", "scene.x3dv", proto, {}, "scene.x3dv", proto),
        ("CRLF", "scene.x3dv", classic.replace("\n", "\r\n"), {}, "scene.x3dv", classic),
        ("gzip", "scene.x3dv", gzip.compress(classic.encode()), {}, "scene.x3dv", classic),
        ("byte-order mark", "scene.x3dv", "\ufeff" + classic, {}, "scene.x3dv", classic),
    )
    for name, path, text, files, where, source in cases:
        result = suite.command("render", path, "--size", "8x8", "--no-cache", "--probe", "4,4",
                               files={path: text, **files}, status=1)
        errors = [m for m in result.messages() if m[3] == "error"]
        suite.equal(name, [m[:3] for m in errors], [(where,) + position(source, "wrong_name")])
        if name == "attribute":
            suite.check("attribute: CDATA is advised", result.with_code("newlines"), result.errors)


@suite.case
def caret():
    "the author's line and a caret stand below the message"
    result = suite.render(front_scene(quad(BLACK, effect(BROKEN))), "--probe", "8,8", status=1)
    lines = result.errors.splitlines()
    at = next((i for i, l in enumerate(lines) if "wrong_name" in l and not l.startswith(" ")), 0)
    shown = lines[at + 1 : at + 3] + ["", ""]
    suite.check("line", "color.g = wrong_name;" in shown[0] and shown[0].startswith(" "), result.errors)
    suite.equal("caret", shown[1].find("^"), shown[0].find("wrong_name"))


EIGHT = """#X3D V4.0 utf8
PROFILE Immersive
OrthoViewpoint { position 0 0 10 }
NavigationInfo { headlight FALSE }
Shape {
  appearance Appearance {
    material UnlitMaterial { emissiveColor 0 0 zero }
    effects [
      Effect { parts EffectPart { type "FRAGMENT" url "data:text/plain,
        void PLUG_fragment_modify(inout vec4 color) {
          color.g = wrong_name;
        }" } }
      Effect {
        initializeOnly SFVec3f tint 0 1 0
        parts EffectPart { type "FRAGMENT" url "data:text/plain,
        uniform vec4 tint;
        void PLUG_fragment_modify(inout vec4 color) { color += tint; }" } }
      Effect { parts EffectPart { type "FRAGMENT" url "data:text/plain,
        float PLUG_fragment_modify(inout vec4 color) { return 1.0; }" } }
      Effect { parts EffectPart { type "FRAGMENT" url "data:text/plain,
        void PLUG_fog_apply(inout vec4 color) { }" } }
      Effect { parts EffectPart { type "FRAGMENT" url "data:text/plain,
        void PLUG_fragment_modified(inout vec4 color) { }" } }
      Effect { parts EffectPart { type "FRAGMENT" url "missing.frag" } }
    ]
  }
  geometry Box { sise 1 1 1 }
}
Grup { }
"""
EIGHT_PLACES = [  # line, code
    (7, "bad-value"), (11, "glsl"), (14, "uniform-type"), (19, "plug-not-void"), (21, "plug-arity"),
    (23, "unknown-plug"), (24, "missing-file"), (27, "unknown-field"), (29, "unknown-node"),
]


@suite.case
def eight_mistakes():
    "check reports all mistakes of a scene, each at its own line"
    for name, text in (("scene.x3dv", EIGHT), ("crlf.x3dv", EIGHT.replace("\n", "\r\n"))):
        result = suite.command("check", name, files={name: text}, status=1)
        found = [(m[1], m[5]) for m in result.messages() if m[3] in ("error", "warning")]
        suite.equal(name, sorted(found), EIGHT_PLACES)
        suite.equal(f"{name}: file", {m[0] for m in result.messages() if m[3] in ("error", "warning")},
                    {name})


@suite.case
def eight_mistakes_drawn():
    "render reports the same and draws what is left"
    result = suite.render(EIGHT.replace("sise", "size"), "--probe", "8,8", status=1)
    suite.equal("reported", sorted((m[1], m[5]) for m in result.messages() if m[3] in ("error", "warning")),
                [p for p in EIGHT_PLACES if p[0] != 27])
    suite.check("drawn", float(result.output.split()[3]) == 1, result.output)


@suite.case
def machine_formats():
    "check --format json and sarif say the same places"
    files = {"scene.x3dv": EIGHT}
    text = suite.command("check", "--format", "json", "scene.x3dv", files=files, status=1).output
    suite.check("json", all(f'"{code}"' in text for _, code in EIGHT_PLACES) and load_json(text) is not None,
                text[:1500])
    log = load_json(suite.command("check", "--format", "sarif", "scene.x3dv", files=files, status=1).output)
    lines = sorted(r["locations"][0]["physicalLocation"]["region"]["startLine"]
                   for r in log["runs"][0]["results"] if r["level"] in ("error", "warning"))
    suite.equal("sarif", lines, [line for line, _ in EIGHT_PLACES])


@suite.case
def unreadable():
    "a scene that cannot be read: exit status 1, the place of the fault, no crash"
    for name, text, line in (("a.x3dv", HEADER + "Shape { geometry Box { size 1 1 }\n", 3),
                             ("b.x3d", "<X3D><Scene><Shape></Scene></X3D>\n", 1)):
        result = suite.command("render", name, "--size", "4x4", "--no-cache", "--probe", "1,1",
                               files={name: text}, status=1)
        suite.check(name, any(m[3] == "error" and m[1] >= line for m in result.messages()),
                    result.errors)
    missing = suite.command("render", "no.x3dv", "--probe", "0,0", status=1)
    suite.check("missing scene", missing.with_code("missing-file"), missing.errors)


def scene_with(code):
    return front_scene(quad('UnlitMaterial { }', effect(code, 'inputOutput SFFloat u 1')))


@suite.case
def quoted_word():
    "where the compiler quotes the word that it means, the column is that word's"
    text = scene_with("uniform float u;\nvoid PLUG_fragment_modify(inout vec4 c) { c.r = 1.0; u = 2.0; }")
    found = suite.render(text, "--probe", "8,8", status=1).with_code("glsl")
    line = next(i for i, l in enumerate(text.splitlines(), 1) if "u = 2.0" in l)
    column = text.splitlines()[line - 1].index("u = 2.0") + 1
    suite.equal("line and column", [(m[1], m[2]) for m in found], [(line, column)])


suite.run()
