#!/usr/bin/env python3
"""MultiTexture: modes, sources and functions against their formulas."""

from harness import Suite
from scenes import Row, quad

suite = Suite()

# Two textures of one colour each, on a translucent material: nothing is 0 or 1.
A = (0x99 / 255, 0x33 / 255, 0xCC / 255, 0x66 / 255)
B = (0x40 / 255, 0x80 / 255, 0xB0 / 255, 0xC0 / 255)
TEXTURES = ("texture [ PixelTexture { image 1 1 4 0x9933CC66 } "
            "PixelTexture { image 1 1 4 0x4080B0C0 } ]")
MATERIAL = "UnlitMaterial { emissiveColor .8 .6 .4 transparency .25 }"
PRIMARY = (0.8, 0.6, 0.4, 0.75)
FACTOR = (0.1, 0.7, 0.3, 0.6)
FIELDS = "color .1 .7 .3 alpha .6"


def signed_dot(a, b):
    return 4 * sum((x - 0.5) * (y - 0.5) for x, y in zip(a[:3], b[:3]))


def each(f):
    return lambda a, b, p: tuple(f(x, y) for x, y in zip(a, b))


def blend(alpha):
    return lambda a, b, p: tuple(x * alpha(a, p) + y * (1 - alpha(a, p)) for x, y in zip(a, b))


def added(f):
    return lambda a, b, p: tuple(f(x, a[3], y) for x, y in zip(a[:3], b[:3])) + (a[3] * b[3],)


# name -> formula of the texture, the second argument and the stage before
MODES = {
    "MODULATE": each(lambda x, y: x * y),
    "REPLACE": each(lambda x, y: x),
    "MODULATE2X": each(lambda x, y: 2 * x * y),
    "MODULATE4X": each(lambda x, y: 4 * x * y),
    "ADD": each(lambda x, y: x + y),
    "ADDSIGNED": each(lambda x, y: x + y - 0.5),
    "ADDSIGNED2X": each(lambda x, y: 2 * (x + y - 0.5)),
    "SUBTRACT": each(lambda x, y: x - y),
    "ADDSMOOTH": each(lambda x, y: x + y - x * y),
    "BLENDDIFFUSEALPHA": blend(lambda a, p: PRIMARY[3]),
    "BLENDTEXTUREALPHA": blend(lambda a, p: a[3]),
    "BLENDFACTORALPHA": blend(lambda a, p: FACTOR[3]),
    "BLENDCURRENTALPHA": blend(lambda a, p: p[3]),
    "MODULATEALPHA_ADDCOLOR": added(lambda x, alpha, y: x + alpha * y),
    "MODULATEINVALPHA_ADDCOLOR": added(lambda x, alpha, y: x + (1 - alpha) * y),
    "MODULATEINVCOLOR_ADDALPHA": added(lambda x, alpha, y: alpha + (1 - x) * y),
    "DOTPRODUCT3": lambda a, b, p: (signed_dot(a, b),) * 4,
    "SELECTARG1": each(lambda x, y: x),
    "SELECTARG2": each(lambda x, y: y),
}


def mixed(mode, a, b, previous):
    result = [max(v, 0) for v in MODES[mode](a, b, previous)]
    return tuple(result[:3]) + (min(result[3], 1),)


def seen(color):
    """Premultiplied, over nothing; blending keeps the alpha of the picture within 1."""
    alpha = min(max(color[3], 0), 1)
    return tuple(c * alpha for c in color[:3]) + (alpha,)


def multi(modes, sources=(), functions=(), textures=TEXTURES):
    def strings(name, words):
        return f"{name} [ " + " ".join(f'"{w}"' for w in words) + " ] " if words else ""

    return (f"texture MultiTexture {{ {FIELDS} " + strings("mode", modes)
            + strings("source", sources) + strings("function", functions) + textures + " }")


def check_all(cases):
    row = Row(suite)
    for _, content, _ in cases:
        row.add(content)
    for (name, _, expected), got in zip(cases, row.draw()):
        suite.close(name, got, seen(expected), 2e-3)


def case(name, *arguments):
    return name, quad(MATERIAL, appearance=multi(*arguments[:-1])), arguments[-1]


@suite.case
def modes():
    "each mode, the second texture over the first"
    check_all([case(mode, ("REPLACE", mode), mixed(mode, B, A, A)) for mode in MODES])


@suite.case
def modes_of_the_first():
    "each mode, over the material's colour"
    one = "texture PixelTexture { image 1 1 4 0x9933CC66 }"
    check_all([(mode, quad(MATERIAL, appearance=multi((mode,), textures=one)),
                mixed(mode, A, PRIMARY, PRIMARY)) for mode in MODES])


@suite.case
def off():
    "OFF leaves a texture out; without modes all multiply"
    product = [x * y * z for x, y, z in zip(A, B, PRIMARY)]
    check_all((
        case("the second", ("REPLACE", "OFF"), A),
        case("the first", ("OFF", "ADD"), mixed("ADD", B, PRIMARY, PRIMARY)),
        case("no modes", (), product),
        case("too few", ("REPLACE",), mixed("MODULATE", B, A, A)),
    ))


@suite.case
def sources():
    "what the texture is mixed with"
    specular = ("Material { emissiveColor .8 .6 .4 specularColor .3 .9 .5 transparency .25 }")
    check_all((
        case("DIFFUSE", ("REPLACE", "ADDSMOOTH"), ("", "DIFFUSE"), mixed("ADDSMOOTH", B, PRIMARY, A)),
        case("FACTOR", ("REPLACE", "ADDSMOOTH"), ("", "FACTOR"), mixed("ADDSMOOTH", B, FACTOR, A)),
        case("FACTOR of the first", ("ADDSMOOTH", "SELECTARG2"), ("FACTOR",),
             mixed("ADDSMOOTH", A, FACTOR, PRIMARY)),
        case("none", ("REPLACE", "ADDSMOOTH"), ("", ""), mixed("ADDSMOOTH", B, A, A)),
        ("SPECULAR", quad(specular.replace("emissive", "diffuse"),
                          appearance=multi(("REPLACE", "SELECTARG2"), ("", "SPECULAR")))
         .replace("Shape {", "DirectionalLight { direction 0 0 -1 intensity 0 ambientIntensity 1 }\n"
                  "Shape {"),
         tuple(0.2 * c for c in (0.3, 0.9, 0.5)) + (0.75,)),
    ))


@suite.case
def functions():
    "COMPLEMENT turns colours round, ALPHAREPLICATE puts alpha in their place, after the mode"
    product = mixed("MODULATE", B, A, A)
    check_all((
        case("COMPLEMENT", ("REPLACE", "MODULATE"), (), ("", "COMPLEMENT"),
             tuple(1 - c for c in product[:3]) + (product[3],)),
        case("ALPHAREPLICATE", ("REPLACE", "MODULATE"), (), ("", "ALPHAREPLICATE"),
             (product[3],) * 4),
        case("of the first", ("REPLACE", "ADD"), (), ("COMPLEMENT",),
             tuple(1 - a + b for a, b in zip(A[:3], B[:3])) + (A[3] + B[3],)),
    ))


@suite.case
def separate():
    "colour and alpha in ways of their own"
    add, modulate = mixed("ADD", B, A, A), mixed("MODULATE", B, A, A)
    check_all((
        case("modes", ("REPLACE", "ADD / MODULATE"), add[:3] + modulate[3:]),
        case("a comma", ("REPLACE", "MODULATE,REPLACE"), modulate[:3] + B[3:]),
        case("sources", ("REPLACE", "SELECTARG2"), ("", "FACTOR / DIFFUSE"),
             FACTOR[:3] + PRIMARY[3:]),
        case("a source for alpha alone", ("REPLACE", "SELECTARG2"), ("", " / FACTOR"),
             A[:3] + FACTOR[3:]),
        case("with a function", ("REPLACE", "ADD / REPLACE"), (), ("", "ALPHAREPLICATE"),
             (B[3],) * 4),
    ))


@suite.case
def before_light():
    "textures are mixed into the colour that light falls on"
    light = "DirectionalLight { direction 0 0 -1 }\n"
    material = "Material { diffuseColor .8 .6 .4 ambientIntensity 0 }"
    textures = ("texture [ PixelTexture { image 1 1 3 0x9933CC } "
                "PixelTexture { image 1 1 3 0x4080B0 } ]")
    row = Row(suite)
    row.add(light + quad(material, appearance=multi(("REPLACE", "ADDSMOOTH"), textures=textures)))
    a, b = A[:3] + (1,), B[:3] + (1,)
    suite.close("", row.draw()[0], mixed("ADDSMOOTH", b, a, a), 2e-3)


@suite.case
def faults():
    "unknown words, a MultiTexture inside, too many textures: warnings, and the rest is drawn"
    def draw(appearance):
        row = Row(suite)
        row.add(quad("UnlitMaterial { }", appearance=appearance))
        body = row.cells[0]
        text = ("#X3D V4.0 utf8\nPROFILE Immersive\nNavigationInfo { headlight FALSE }\n"
                "OrthoViewpoint { fieldOfView -.5 -.5 .5 .5 }\n" + body)
        result = suite.render(text, "--probe", "8,8")
        return text, result, [float(w) for w in result.output.split()]

    pixel = "PixelTexture { image 1 1 3 0x336699 }"
    text, result, got = draw(f"texture MultiTexture {{ mode [ \"MODULATE\" \"NONSENSE\" ] texture [ {pixel} {pixel} ] }}")
    suite.close("an unknown mode multiplies", got, (0.04, 0.16, 0.36, 1), 2e-3)
    line = next(i for i, l in enumerate(text.splitlines(), 1) if "NONSENSE" in l)
    suite.check("and is warned of", [m for m in result.with_code("bad-value")
                                     if m[1] == line and m[3] == "warning"], result.errors)
    text, result, got = draw(f"texture MultiTexture {{ texture [ {pixel} MultiTexture {{ texture {pixel} }} ] }}")
    suite.close("nested: left out", got, (0.2, 0.4, 0.6, 1), 2e-3)
    suite.check("and warned of", result.with_code("bad-node"), result.errors)
    white = "PixelTexture { image 1 1 1 255 } "
    text, result, got = draw(f"texture MultiTexture {{ texture [ {white * 7} {pixel} {pixel} ] }}")
    suite.close("nine: the ninth is left out", got, (0.2, 0.4, 0.6, 1), 2e-3)
    suite.check("and warned of", [m for m in result.with_code("limit") if m[3] == "warning"],
                result.errors)
    text, result, got = draw("texture MultiTexture { }")
    suite.close("no textures at all", got, (1, 1, 1, 1))
    text, result, got = draw(f"texture MultiTexture {{ texture [ NULL {pixel} ] }}")
    suite.close("NULL", got, (0.2, 0.4, 0.6, 1), 2e-3)


suite.run()
