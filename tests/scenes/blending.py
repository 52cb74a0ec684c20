#!/usr/bin/env python3
"""How a shape shows what lies behind it: alphaMode, textures' alpha, BlendMode, the order."""

from harness import Suite, over, premultiplied
from scenes import Row, effect, front_scene, quad

suite = Suite()

BACK = (0.8, 0.4, 0.2)
BEHIND = ("Transform { translation 0 0 -1 children [ %s ] }\n"
          % quad("UnlitMaterial { emissiveColor .8 .4 .2 }"))
FRONT = (0.5, 0.25, 1.0)


def front(appearance, transparency=0.75, effects=""):
    return BEHIND + quad("UnlitMaterial { emissiveColor .5 .25 1 transparency %s }" % transparency,
                         effects, appearance=appearance)


def check_all(cases):
    row = Row(suite)
    for _, content, _ in cases:
        row.add(content)
    for (name, _, expected), got in zip(cases, row.draw()):
        suite.close(name, got, expected)


def pixel(alpha):
    return "texture PixelTexture { image 1 1 4 0xFFFFFF%02X }" % alpha


BLENDED = over(premultiplied(FRONT, 0.25), BACK + (1,))


@suite.case
def alpha_modes():
    "alphaMode: AUTO, OPAQUE, MASK, BLEND; alphaChannel says the same in older words"
    clear = effect("void PLUG_fragment_modify(inout vec4 c) { c.a = 0.25; }")
    check_all((
        ("AUTO blends what is transparent", front(""), BLENDED),
        ("AUTO does not blend what is not", front("", 0, clear), FRONT + (1,)),
        ("OPAQUE", front('alphaMode "OPAQUE"'), FRONT + (1,)),
        ("MASK, below the cutoff", front('alphaMode "MASK"'), BACK + (1,)),
        ("MASK, above it", front('alphaMode "MASK" alphaCutoff .2'), FRONT + (1,)),
        ("BLEND", front('alphaMode "BLEND"', 0, clear), BLENDED),
        ("NONE", front('alphaChannel "NONE"'), FRONT + (1,)),
        ("TEST", front('alphaChannel "TEST"'), BACK + (1,)),
        ("BLENDING", front('alphaChannel "BLENDING"', 0, clear), BLENDED),
        ("alphaMode counts before alphaChannel", front('alphaMode "OPAQUE" alphaChannel "TEST"'),
         FRONT + (1,)),
    ))
    text = front_scene(quad("UnlitMaterial { }", appearance='alphaMode "GLASS"'))
    suite.equal("an unknown mode", [m[5] for m in suite.render(text, "-o", "a.png", status=1).messages()],
                ["bad-value"])


@suite.case
def textures():
    "the alpha of textures: all or nothing is tested, all else blends"
    two = "texture PixelTexture { repeatS FALSE image 2 1 4 0xFFFFFFFF 0xFFFFFF00 %s }"
    nearest = ('textureProperties TextureProperties { minificationFilter "NEAREST_PIXEL" '
               'magnificationFilter "NEAREST_PIXEL" }')
    row = Row(suite)
    row.add(front(pixel(0xFF), 0))
    row.add(front(pixel(0x00), 0))
    row.add(front(pixel(0x33), 0))
    row.add(front(two % nearest, 0))
    row.add(front(two % nearest, 0.75))
    got = row.draw()
    for name, color, expected in zip(
            ("opaque", "nothing there", "blends", "tested", "a transparent material blends all the same"),
            got, (FRONT + (1,), BACK + (1,), over(premultiplied(FRONT, 0.2), BACK + (1,)), FRONT + (1,),
                  BLENDED)):
        suite.close(name, color, expected)
    text = front_scene(
        BEHIND, quad("UnlitMaterial { emissiveColor .5 .25 1 }", appearance=two % nearest),
        "Transform { translation 0 0 -.5 children [ %s ] }" % quad("UnlitMaterial { emissiveColor 0 1 0 }"))
    colors = suite.probe(text, [(6, 8), (10, 8)], size="16x16")
    suite.close("what is tested away hides nothing", colors[1], (0, 1, 0, 1))
    suite.close("what is there does", colors[0], FRONT + (1,))


def mode(fields):
    return "blendMode BlendMode { %s }" % fields


@suite.case
def blend_modes():
    "BlendMode: the factors by name, in upper and lower case"
    s, d, a = FRONT, BACK, 0.25
    cases = []
    factors = {
        "zero": lambda i: 0, "one": lambda i: 1, "src_color": lambda i: s[i],
        "one_minus_src_color": lambda i: 1 - s[i], "dst_color": lambda i: d[i],
        "one_minus_dst_color": lambda i: 1 - d[i], "src_alpha": lambda i: a,
        "one_minus_src_alpha": lambda i: 1 - a, "dst_alpha": lambda i: 1,
        "one_minus_dst_alpha": lambda i: 0, "src_alpha_saturate": lambda i: 0,
        "constant_color": lambda i: (0.1, 0.2, 0.3)[i],
        "one_minus_constant_color": lambda i: 1 - (0.1, 0.2, 0.3)[i],
        "constant_alpha": lambda i: 0.4, "one_minus_constant_alpha": lambda i: 0.6}
    for name, factor in factors.items():
        cases.append((f"source {name}", front(mode(
            f'srcFactor "{name}" destFactor "ONE" color .1 .2 .3 colorTransparency .6')),
            [s[i] * factor(i) + d[i] for i in range(3)] + [1]))
        if name != "src_alpha_saturate":
            cases.append((f"destination {name}", front(mode(
                f'srcFactor "zero" destFactor "{name.upper()}" blendColor .1 .2 .3 .4')),
                [d[i] * factor(i) for i in range(3)] + [1]))
    check_all(cases)


@suite.case
def blend_equations():
    "BlendMode: equations, separate factors of alpha; opaque materials blend too"
    both = 'sourceColorFactor "ONE" destinationColorFactor "ONE" '
    check_all((
        ("an opaque material adds", front(mode('srcFactor "one" destFactor "one"'), 0),
         [s + d for s, d in zip(FRONT, BACK)] + [1]),
        ("FUNC_SUBTRACT", front(mode(both + 'colorEquation "FUNC_SUBTRACT"')),
         [s - d for s, d in zip(FRONT, BACK)] + [1]),
        ("FUNC_REVERSE_SUBTRACT", front(mode(both + 'colorEquation "FUNC_REVERSE_SUBTRACT"')),
         [d - s for s, d in zip(FRONT, BACK)] + [1]),
        ("MIN", front(mode('colorEquation "MIN"')), [min(s, d) for s, d in zip(FRONT, BACK)] + [1]),
        ("MAX", front(mode('colorEquation "MAX"')), [max(s, d) for s, d in zip(FRONT, BACK)] + [1]),
        ("alpha of its own", front(mode('sourceAlphaFactor "ZERO" destinationAlphaFactor "ZERO"')),
         BLENDED[:3] + (0,)),
        ("the next shape blends as usual", front(""), BLENDED),
        ("defaults", front(mode("")), BLENDED),
    ))
    text = front_scene(quad("UnlitMaterial { }", appearance=mode('\nsrcFactor "half"')))
    found = suite.render(text, "-o", "a.png", status=1).messages()
    suite.equal("an unknown factor at its place", [(m[1], m[5]) for m in found], [(6, "bad-value")])


@suite.case
def order():
    "translucent shapes are drawn from the back, after all opaque ones"
    def at(z, color):
        return ("Transform { translation 0 0 %s children [ %s ] }\n" %
                (z, quad(f"UnlitMaterial {{ emissiveColor {color} transparency .5 }}")))

    expected = over(premultiplied((1, 0, 0), 0.5),
                    over(premultiplied((0, 1, 0), 0.5), BACK + (1,)))
    check_all((
        ("near first in the file", at(1, "1 0 0") + at(0, "0 1 0") + BEHIND, expected),
        ("far first in the file", BEHIND + at(0, "0 1 0") + at(1, "1 0 0"), expected),
    ))


suite.run()
