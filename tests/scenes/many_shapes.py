#!/usr/bin/env python3
"""Many shapes: programs by text, faults of one, warnings once."""

import os

from harness import Suite, load_json
from scenes import NO_HEADLIGHT, effect, front_scene, quad, scene

suite = Suite()

MODIFY = "void PLUG_fragment_modify(inout vec4 color)"
TINTS = (0.25, 0.5, 0.75, 1.0)


def grid(shapes, head=""):
    """Shapes of side 1 in rows of ten, four pixels wide each: probed in their middles."""
    rows = (len(shapes) + 9) // 10
    body = "".join(f"Transform {{ translation {i % 10 + 0.5} {i // 10 + 0.5} 0 children [\n{shape}] }}\n"
                   for i, shape in enumerate(shapes))
    view = f"OrthoViewpoint {{ position 0 0 10 fieldOfView 0 0 10 {rows} }}\n"
    return scene(view, NO_HEADLIGHT, head, body), f"40x{4 * rows}"


def middle(picture, index, count):
    rows = (count + 9) // 10
    return picture.at(4 * (index % 10) + 1, 4 * (rows - 1 - index // 10) + 1)


def draw(shapes, *arguments, head="", **options):
    text, size = grid(shapes, head)
    result = suite.render(text, "-o", "picture.npy", *arguments, size=size, **options)
    from harness import Picture
    return text, result, Picture(os.path.join(result.folder, "picture.npy"))


@suite.case
def one_program_a_text():
    "200 shapes with effects of their own and two texts between them: two programs"
    shapes = [quad("UnlitMaterial { }", effect(
        f"uniform float tint;\n{MODIFY} {{ color.rgb *= {('tint', 'tint * 0.5')[i % 2]}; }}",
        f"inputOutput SFFloat tint {TINTS[i % 4]}", head=f"DEF E{i}")) for i in range(200)]
    _, result, picture = draw(shapes, "--stats", "json")
    stats = load_json(result.output)
    suite.equal("programs", len(stats["programs"]), 2)
    colors = [middle(picture, i, 200)[:3] for i in range(200)]
    suite.equal("each shape has its own values", colors,
                [(TINTS[i % 4] * (1, 0.5)[i % 2],) * 3 for i in range(200)])
    suite.equal("without a word", result.messages(), [])
    listing = suite.command("dump", "scene.x3dv", "-d", "out", files={"scene.x3dv": grid(shapes)[0]})
    suite.equal("and two in a dump", sorted(os.listdir(os.path.join(listing.folder, "out"))),
                sorted(f"surface-{n}.{kind}" for n in (1, 2) for kind in ("frag", "frag.map", "vert", "vert.map")))


@suite.case
def different_places():
    "what stands around an equal text counts: lights, textures, the geometry stage"
    code = effect(MODIFY + " { color.r *= 0.5; }")
    lit = quad("Material { }", code)
    shapes = [lit, "DirectionalLight { }\n" + lit, "PointLight { global FALSE }\n" + lit,
              quad("Material { }", code, "texture PixelTexture { image 1 1 1 255 }"), lit]
    _, result, _ = draw(shapes, "--stats", "json")
    suite.equal("programs", len(load_json(result.output)["programs"]), 4)


@suite.case
def one_wrong_of_a_hundred():
    "one wrong effect of a hundred shapes: an error at its line, the other shapes drawn in full"
    for kind, bad in (("compiler", "color.rgb = unknown_name;"), ("linker", "} int PLUG_fog_apply(inout vec4 c) {")):
        shapes = [quad(f"UnlitMaterial {{ emissiveColor 0 {TINTS[i % 4]} 0 }}",
                       effect(f"{MODIFY} {{ color.r = 0.5; }}", head=f"DEF E{i}")
                       + (effect(f"{MODIFY} {{ color.b = 1.0; {bad} }}", head="DEF Wrong") if i == 57 else ""))
                  for i in range(100)]
        text, result, picture = draw(shapes, status=1)
        got = [middle(picture, i, 100) for i in range(100)]
        suite.equal(f"{kind}: all shapes, one without the wrong effect", got,
                    [(0.5, TINTS[i % 4], 0, 1) for i in range(100)])
        errors = [m for m in result.messages() if m[3] == "error"]
        line = next(i for i, line in enumerate(text.splitlines(), 1) if bad in line)
        suite.equal(f"{kind}: errors at its line alone", {m[1] for m in errors}, {line})


@suite.case
def shared_faults():
    "a wrong effect that many shapes share is reported once"
    wrong = effect(MODIFY + " { color.rgb = unknown_name; }", head="DEF Wrong")
    shapes = [quad("UnlitMaterial { emissiveColor 0 1 0 }", wrong)] + [
        quad("UnlitMaterial { emissiveColor 0 1 0 }", "USE Wrong") for _ in range(49)]
    _, result, picture = draw(shapes, status=1)
    suite.check("each error stands once", len(result.messages()) == len(set(result.messages())) < 4,
                result.errors)
    suite.equal("all are drawn", [middle(picture, i, 50) for i in range(50)], [(0, 1, 0, 1)] * 50)


@suite.case
def other_languages():
    "an effect or a shader in another language is skipped, with one warning for each node"
    for language in ("HLSL", "CG", "WGSL"):
        other = effect("float4 main() : COLOR { return 0; }", f'language "{language}"', head="DEF Other")
        own = effect(MODIFY + " { color.r = 0.5; }", 'language "GLSL"')
        shapes = [quad("UnlitMaterial { emissiveColor 0 1 0 }", other + own)] + [
            quad("UnlitMaterial { emissiveColor 0 1 0 }", "USE Other " + own) for _ in range(19)] + [
                quad("UnlitMaterial { emissiveColor 0 1 0 }", other.replace("DEF Other", "") + own)]
        text, result, picture = draw(shapes)
        suite.equal(f"{language}: all shapes", [middle(picture, i, 21) for i in range(21)], [(0.5, 1, 0, 1)] * 21)
        lines = [i for i, line in enumerate(text.splitlines(), 1) if f'"{language}"' in line]
        suite.equal(f"{language}: warnings", [(m[1], m[3], m[5]) for m in result.messages()],
                    [(line, "warning", "language") for line in lines])
    shader = "shaders ComposedShader { language \"HLSL\" parts ShaderPart { url \"data:text/plain,x\" } }"
    result = suite.render(front_scene(quad("UnlitMaterial { emissiveColor 0 1 0 }", appearance=shader)), "--probe", "8,8")
    suite.close("a complete shader: the material", [float(w) for w in result.output.split()], (0, 1, 0, 1))
    suite.equal("one warning", [m[5] for m in result.messages()], ["language"])


suite.run()
