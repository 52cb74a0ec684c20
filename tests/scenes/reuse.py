#!/usr/bin/env python3
"""What is used more than once: programs of equal text, nodes that are USEd again and again."""

from harness import HEADER, Suite
from scenes import FRONT, NO_HEADLIGHT, effect, quad, scene

suite = Suite()


def beside(shape, x):
    return f"Transform {{ translation {x} 0 0 scale .5 .5 .5 children {shape} }}"


@suite.case
def initialisers():
    "a uniform without a source keeps its initialiser, whoever used the program before"
    red, none = quad("UnlitMaterial { emissiveColor 1 0 0 }"), quad("")
    for order, expected in (((red, none), ((1, 0, 0, 1), (1, 1, 1, 1))),
                            ((none, red), ((1, 1, 1, 1), (1, 0, 0, 1)))):
        text = scene(FRONT, NO_HEADLIGHT, beside(order[0], -0.5), beside(order[1], 0.5))
        got = suite.probe(text, [(4, 8), (12, 8)])
        for pixel, want in zip(got, expected):
            suite.close("", pixel, want)


@suite.case
def short_arrays():
    "a field shorter than its array leaves the rest at zero"
    code = "uniform float x[2]; void PLUG_fragment_modify(inout vec4 c) { c = vec4(x[0], x[1], 0.0, 1.0); }"
    shapes = [beside(quad("UnlitMaterial { }", effect(code, f"inputOutput MFFloat x [ {values} ]")), at)
              for values, at in ((".25 .5", -0.5), (".75", 0.5))]
    got = suite.probe(scene(FRONT, *shapes), [(4, 8), (12, 8)])
    suite.close("both given", got[0], (0.25, 0.5, 0, 1))
    suite.close("one given", got[1], (0.75, 0, 0, 1))


@suite.case
def endless():
    "groups that double forty times end in one error, and what was met before is drawn"
    text = HEADER + FRONT + quad("UnlitMaterial { emissiveColor 0 1 0 }")
    text += "Switch { whichChoice -1 children [ DEF G0 Group { }\n"
    text += "".join(f"DEF G{i} Group {{ children [ USE G{i - 1} USE G{i - 1} ] }}\n" for i in range(1, 41))
    text += "] }\nUSE G40\n"
    result = suite.render(text, "--probe", "8,8", status=1)
    suite.equal("one error", [m[5] for m in result.messages()], ["limit"])
    suite.close("drawn", [float(w) for w in result.output.split()], (0, 1, 0, 1))


suite.run()
