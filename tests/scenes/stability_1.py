#!/usr/bin/env python3
"""F1 to F17: integration and compositing. stability_1.py PLUGRAY [ROW...]"""

import math
import os
import sys

from harness import Picture, box_interval, over, premultiplied
from scenes import NO_HEADLIGHT, constant, effect, front_scene, quad, scene, volume, voxels
from stability_data import Stability, parallel_rays, pixels_of, worst, wrong_numbers

TESTS = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..")
sys.path[1:1] = [os.path.join(TESTS, "tools"), os.path.join(TESTS, "reference")]
import reference  # noqa: E402
from pictures import read_png  # noqa: E402

suite = Stability()
reference.beside(suite.program)
PLAIN = "ShadedVolumeStyle { }"  # without light: the voxel's own colour
AS_ASKED = "with an error of 1/255 asked for, colours are wrong by"
FLOOR = 2e-6  # of 32-bit floats over some hundred steps


def view(wide, high):
    return f"OrthoViewpoint {{ position 0 0 10 fieldOfView {-wide} {-high} {wide} {high} }}\n"


def turned(axis, angle, content):
    return f"Transform {{ rotation {' '.join(map(str, axis))} {angle!r} children [\n{content}] }}\n"


def function(*texels):
    """An OpacityMapVolumeStyle of RGBA texels, 0 to 255."""
    words = " ".join(f"0x{r:02X}{g:02X}{b:02X}{a:02X}" for r, g, b, a in texels)
    return f"OpacityMapVolumeStyle {{ transferFunction PixelTexture {{ image {len(texels)} 1 4 {words} }} }}"


def quadrature(f, low, high, count=4000):
    """Gauss's rule with two points in each of `count` parts."""
    h = (high - low) / count
    offset = h / (2 * math.sqrt(3))
    return sum(f(low + (i + 0.5) * h + side) for i in range(count) for side in (-offset, offset)) * h / 2


# ---- F1 to F4: lengths


@suite.row("F1", "opacity correction missing", scene=front_scene(volume(constant(51, (4, 4, 4)))),
           shows="a constant volume with steps of 1, 1/2 and 1/8 voxel",
           invariant="opacity does not depend on the step")
def opacity_correction(row):
    exact = 1 - (1 - 0.2) ** 4
    for name, options in row.methods():
        pixels = [row.middle("--step", step, *options) for step in (1, 0.5, 0.125)]
        row.measure("A differs from 1 - 0.8^4 by", max(abs(p[3] - exact) for p in pixels), at_most=FLOOR, case=name)
        row.measure("steps differ by", max(worst([pixels[0]], [p]) for p in pixels), at_most=FLOOR, case=name)


UNCHANGED = "SilhouetteEnhancementVolumeStyle { silhouetteRetainedOpacity 1 silhouetteBoundaryOpacity 0 }"
ONCE = [f"Transform {{ translation {x} 0 0 children [\n{box}] }}\n" for x, box in (
    (-1.5, volume(constant(51, (4, 4, 4)), fields="opacityUnitDistance 1")),
    (-0.5, volume(constant(51, (4, 4, 4)), function((51, 51, 51, 51), (51, 51, 51, 51)), fields="opacityUnitDistance 1")),
    (0.5, volume(constant(51, (4, 4, 4)), f"ComposedVolumeStyle {{ renderStyle [ {UNCHANGED} {UNCHANGED} ] }}",
                 fields="opacityUnitDistance 1")),
    (1.5, "SegmentedVolumeData { dimensions 1 1 1 voxels " + constant(51, (4, 4, 4)) + " opacityUnitDistance 1 }\n"))]

ONCE_ALONE = volume(constant(51, (4, 4, 4)), fields="opacityUnitDistance 1")


@suite.row("F2", "opacity correction applied twice", scene=scene(view(2, 0.5), NO_HEADLIGHT, *ONCE),
           shows="boxes that are 0.2 opaque as a whole: bare, with a transfer function, with two styles, with segments",
           invariant="each is 0.2 opaque for any step, whatever it passes through")
def corrected_once(row):
    for name, options in row.methods():
        for step in (2, 0.25):
            p = row.picture("--step", step, *options, size="8x2")
            found = [p.at(x, y)[3] for x in range(8) for y in range(2)]
            row.measure("A differs from 0.2 by", max(abs(a - 0.2) for a in found), at_most=FLOOR, case=f"{name} {step}")
            alone = row.middle("--step", step, *options, scene=scene(view(0.2, 0.2), NO_HEADLIGHT, ONCE_ALONE))
            row.measure("alone, A differs from 0.2 by", abs(alone[3] - 0.2), at_most=FLOOR, case=f"{name} {step}")


def in_units(scale, box=(1, 2, 1), fields="", step=(1, 1, 1), turn=(0, 1, 0, 0)):
    """A box of that scale, seen so that it looks the same."""
    eye = (f"OrthoViewpoint {{ position 0 0 {10 * scale} fieldOfView {-2 * scale} {-2 * scale} {2 * scale} {2 * scale} }}\n")
    content = volume(constant(100, (4, 8, 4)), dimensions=tuple(scale * b for b in box), fields=fields)
    return scene(eye, NO_HEADLIGHT, turned(turn[:3], turn[3], f"Transform {{ scale {' '.join(map(str, step))} children [\n"
                                                             f"{content}] }}\n"))


@suite.row("F3", "steps measured in other units than opacity", scene=lambda: in_units(1),
           shows="a box of 1 x 2 x 1, also a thousandth and a thousand times as large, stretched by a Transform, turned",
           invariant="opacity is that of the length in the volume's own coordinates, from every side")
def units(row):
    alpha = 100 / 255
    one = 1 - (1 - alpha) ** 4
    for scale in (1e-3, 1, 1e3):
        side = row.middle(scene=in_units(scale))
        row.measure("scaled dimensions change A by", abs(side[3] - one), at_most=FLOOR, case=f"scale {scale:g}")
        fixed = f"opacityUnitDistance {0.25 * scale}"
        length = row.middle(scene=in_units(scale, fields=fixed))
        row.measure("a reference of as much changes A by", abs(length[3] - one), at_most=FLOOR, case=f"scale {scale:g}")
    longer = row.middle(scene=in_units(2, fields="opacityUnitDistance .25"))
    row.measure("a fixed reference and twice the size: A differs from that of twice the length by",
                abs(longer[3] - (1 - (1 - alpha) ** 8)), at_most=FLOOR)
    stretched = row.middle(scene=in_units(1, step=(1, 1, 2.5)))
    row.measure("a Transform changes A by", abs(stretched[3] - one), at_most=FLOOR)
    along = row.middle(scene=in_units(1, turn=(1, 0, 0, math.pi / 2)))
    row.measure("along the side of 2, A differs from that of twice the length by",
                abs(along[3] - (1 - (1 - alpha) ** 8)), at_most=FLOOR)


WEDGE = (0, 1, 0), 0.65


@suite.row("F4", "last step dropped or too long", scene=scene(
               view(0.8, 0.8 / 24), NO_HEADLIGHT, turned(*WEDGE, volume(constant(40, (7, 7, 7))))),
           shows="a turned box, whose rays have lengths from 0 to 8.8 voxels",
           invariant="no sawtooth over the lengths: each ray has the opacity of its own")
def last_steps(row):
    size = (96, 4)
    rays = list(parallel_rays(size, (0.8, 0.8 / 24), *WEDGE))
    lengths = [b - a for a, b in (box_interval(o, d) for o, d in rays)]
    exact = [1 - (1 - 40 / 255) ** (7 * length) for length in lengths]
    for name, options in row.methods():
        for step in (1, 0.37):
            p = row.picture("--step", step, *options, size="96x4")
            error = max(abs(c[3] - a) for c, a in zip(pixels_of(p), exact))
            row.measure("A differs by", error, at_most=4e-6, case=f"{name} {step}")
    for asked, options in row.planned():
        got = pixels_of(row.picture(*options, size="96x4"))
        row.measure(AS_ASKED, max(abs(c[3] - a) for c, a in zip(got, exact)), at_most=asked)
    coat = row.changed((constant(40, (7, 7, 7)), voxels(1, (1, 1, 4), (255, 0, 0, 0))))
    seen = [i for i, (o, d) in enumerate(rays) if box_interval(o, d)[1] > 0 and
            exit_depth(o, d) < -0.5 + 1e-9]
    for name, options in row.methods():
        for step in (0.19, 0.13):  # of a voxel's mean side; the coat is as thick as 0.198
            got = pixels_of(row.picture("--step", step, *options, size="96x4", scene=coat))
            missed = sum(got[i][3] < 1 - 1e-3 for i in seen)
            row.count("rays that miss an opaque coat, thicker than a step, on the back", missed, case=f"{name} {step}")


def exit_depth(origin, direction):
    return origin[2] + box_interval(origin, direction)[1] * direction[2]


# ---- F7 to F10: many steps in floats


TWO_RAMP = voxels(1, (1, 1, 2), (60, 200))


@suite.row("F7", "jitter nobody asked for", scene=front_scene(volume(TWO_RAMP)),
           shows="a ramp along parallel rays", invariant="equal rays are equal to the bit, and so is a second picture")
def jitter(row):
    for name, options in row.methods():
        first, second = (row.picture("--step", 0.11, *options) for _ in range(2))
        inside = {first.at(x, y) for x in range(5, 11) for y in range(5, 11)}
        row.count("pixels of other colours", len(inside) - 1, case=name)
        row.count("numbers that change", sum(a != b for a, b in zip(first.values, second.values)), case=name)


BLACK = voxels(2, (2, 1, 1), (0x00C8, 0x00FF))  # opacities 200/255 to 1 along x
TAIL = 1 / 255 / 8


def behind_black(content):
    front = volume(BLACK, PLAIN, dimensions=(1, 1, 0.5), fields="opacityUnitDistance .25")
    return front_scene(f"Transform {{ translation 0 0 .8 children [\n{front}] }}\n", content)


WHITE = volume(constant(255))
BRIGHT = ("DirectionalLight { direction 0 0 -1 intensity 100 global TRUE }\nTransform { translation 0 0 -1 children [\n"
          + quad("Material { ambientIntensity 0 diffuseColor 1 1 1 }") + "] }\n")


GLOWING = "Transform { translation 0 0 -1 children [\n" + quad("UnlitMaterial { }", effects=effect(
    "void PLUG_fragment_modify(inout vec4 fragment_color) { fragment_color.rgb *= 100.0; }")) + "] }\n"


def left_at(x):
    """Of light behind BLACK, in column x of 64."""
    at = min(max(2 * (x - 16 + 0.5) / 32 - 0.5, 0.0), 1.0)
    return (1 - (200 + 55 * at) / 255) ** 2


@suite.row("F8", "bias of rays that end early", scene=behind_black(WHITE),
           shows="a black slab that lets 5e-2 to 1e-5 through before a white one, and before a surface of brightness 100",
           invariant="what is left out is at most 1/8 of 1/255, also of what is brighter than white; never is anything added")
def early_end(row):
    for name, options in row.methods():
        p = row.picture("--step", 0.25, *options, size="64x64")
        wrong, added = 0.0, 0.0
        for x in range(16, 48):
            through = left_at(x)
            red, alpha = p.at(x, 32)[0], p.at(x, 32)[3]
            wrong = max(wrong, through - red, 1 - alpha)
            added = max(added, red - through, alpha - 1)
        row.measure("light left out", wrong, at_most=TAIL, case=name)
        row.measure("light added", added, at_most=FLOOR, case=name)
        errors = []
        for bright in (BRIGHT, GLOWING):
            p = row.picture("--step", 0.02, *options, size="64x64", scene=behind_black(bright))
            errors += [abs(p.at(x, 32)[0] - 100 * left_at(x)) for x in range(16, 48)]
        row.measure("error of brightness 100 behind", max(errors), at_most=1 / 255, case=name)


@suite.row("F9", "accumulation in 8 bits", scene=front_scene(volume(constant(1, (1, 1, 512)), dimensions=(1, 1, 512))
                                                             ).replace("position 0 0 10", "position 0 0 300"),
           shows="512 voxels of 1/255, in steps that add 1/1020 each",
           invariant="thin matter adds up")
def thin(row):
    exact = 1 - (254 / 255) ** 512
    for name, options in row.methods():
        color = row.middle("--step", 0.25, *options)
        row.measure("A differs by", abs(color[3] - exact), at_most=1e-4, case=name)
        row.measure("colour differs by", abs(color[0] - exact / 255), at_most=4e-4, case=name)
    for asked, options in row.planned():
        row.measure(AS_ASKED, abs(row.middle(*options)[3] - exact), at_most=asked)


RISE = voxels(1, (1, 1, 2), (2, 5))


def rise_depth(origin, direction):
    """The optical depth of a ray through RISE, per reference length."""
    enter, leave = box_interval(origin, direction)

    def extinction(t):
        at = min(max(2 * (origin[2] + t * direction[2] + 0.5) - 0.5, 0.0), 1.0)
        return -math.log1p(-(2 + 3 * at) / 255)

    return quadrature(extinction, enter, leave, 400) if leave > enter else 0.0


@suite.row("F10", "1 - exp(-x) in floats", scene=scene(
               view(1, 1), NO_HEADLIGHT, turned((1, 2, 0), 0.6, volume(RISE, fields="opacityUnitDistance 0.015625"))),
           shows="thin matter in steps of 1/4 to 1/256 of the length in which it is 1/50 opaque",
           invariant="finer steps make nothing worse")
def small_exponents(row):
    exact = [1 - math.exp(-64 * rise_depth(o, d)) for o, d in parallel_rays((8, 8), (1, 1), (1, 2, 0), 0.6)]
    for name, options in row.methods():
        errors = []
        for parts in (4, 32, 256):
            p = row.picture("--step", 1 / (32 * parts), *options, size="8x8")
            errors.append(max(abs(c[3] - a) for c, a in zip(pixels_of(p), exact)))
        row.measure("error of steps of 1/4, 1/32 and 1/256", max(errors), at_most=2e-5, case=name, details=[errors])
        row.measure("error of 1/256 over that of 1/4, less the floor", errors[2] - 1.05 * errors[0], at_most=2e-6, case=name,
                    details=[errors])


# ---- F11, F12: colours


def ramp_integral(color, extinction, length):
    """Colour and opacity through a clear-cut ramp: from texture coordinate 3/4 to 1/4 of two voxels."""
    count, grey, depth = 20000, 0.0, 0.0
    h = 1.0 / count
    for i in range(count):
        s = 1 - (i + 0.5) * h
        od = extinction(s) * length * h
        grey += math.exp(-depth) * color(s) * -math.expm1(-od)
        depth += od
    return grey, -math.expm1(-depth)


FRINGE = function((255, 0, 0, 160), (0, 0, 255, 0))


@suite.row("F11", "straight and premultiplied colours mixed up", scene=front_scene(volume(
               voxels(1, (1, 1, 2), (0, 255)), FRINGE, fields="cropMin 0 0 .25 cropMax 1 1 .75 opacityUnitDistance .2")),
           shows="a ramp with a transfer function from opaque red to clear blue, alone and over a background",
           invariant="straight colours are interpolated, then weighted by extinction; over a background is as composed afterwards")
def association(row):
    def opacity(s):
        return 160 / 255 * (1 - s)

    def extinction(s):
        return -math.log1p(-opacity(s)) / 0.2

    red, alpha = ramp_integral(lambda s: 1 - s, extinction, 0.5)
    blue, _ = ramp_integral(lambda s: s, extinction, 0.5)
    back = (0.2, 0.7, 0.4)
    behind = f"Background {{ skyColor {' '.join(map(str, back))} }}\n"
    for name, options in row.methods():
        got = row.middle("--step", 1 / 64, *options)
        row.measure("colour differs from the integral by", worst([got], [(red, 0, blue, alpha)]), at_most=4e-4, case=name)
        placed = row.middle("--step", 1 / 64, *options, scene=row.text + behind)
        row.measure("over a background, colour differs by", worst([placed], [over(got, back + (1.0,))]), at_most=FLOOR,
                    case=name)
        p = row.picture("--step", 0.5, *options)
        row.count("colours beyond their opacity", sum(max(c[:3]) > c[3] + FLOOR for c in pixels_of(p)), case=name)
    for asked, options in row.planned():
        row.measure(AS_ASKED, worst([row.middle(*options)], [(red, 0, blue, alpha)]), at_most=asked)


@suite.row("F12", "sRGB decoded twice or never", scene=front_scene(
               *(turned((0, 0, 1), 0.0, f"Transform {{ translation {x} 0 0 scale .5 .5 1 children [\n{box}] }}\n")
                 for x, box in ((-0.75, volume(constant(128))),
                                (-0.25, volume(constant(255), function((128, 64, 32, 255), (128, 64, 32, 255)))),
                                (0.25, volume(voxels(3, (1, 1, 1), [0x804020]), PLAIN, fields="opacityUnitDistance 1")),
                                (0.75, quad("UnlitMaterial { emissiveColor .5 .25 .125 }"))))),
           shows="half grey as a voxel, in a transfer function, as RGB voxels and on a surface, in PNG and floats",
           invariant="numbers come out as they stand in the file")
def transfer_curve(row):
    v = 128 / 255
    third = (128 + 64 + 32) / 3 / 255
    expected = [premultiplied((v, v, v), v), (128 / 255, 64 / 255, 32 / 255, 1.0),
                premultiplied((128 / 255, 64 / 255, 32 / 255), third), (0.5, 0.25, 0.125, 1.0)]
    result = row.render("-o", "p.png", size="8x8")
    with open(os.path.join(result.folder, "p.png"), "rb") as file:
        _, _, channels, rows = read_png(file.read())
    p = row.picture("--step", 0.5, size="8x8")
    for x, color in zip((1, 3, 5, 7), expected):
        row.measure("floats differ by", worst([p.at(x - 1, 4)], [color]), at_most=FLOOR, case=str(x))
        got = rows[4][channels * (x - 1) : channels * (x - 1) + 3]
        row.measure("8-bit numbers differ by more than rounding", max(abs(g - 255 * c) for g, c in zip(got, color)) - 0.5,
                    at_most=1e-3, case=str(x), details=[list(got)])


# ---- F14 to F17: several volumes, many steps, where rays begin


def slab(color, alpha, z, fields="opacityUnitDistance .5", depth=0.5):
    content = volume(constant(1), function(color + (alpha,), color + (alpha,)), dimensions=(1, 1, depth), fields=fields)
    return f"Transform {{ translation 0 0 {z} children [\n{content}] }}\n"


RED, BLUE = ((255, 0, 0), 200), ((0, 0, 255), 120)
SEGMENTS = ("SegmentedVolumeData { dimensions 1 1 1 voxels %s segmentIdentifiers %s renderStyle [\n%s\n%s ] "
            "opacityUnitDistance .5 }\n" % (constant(1, (1, 1, 2)), voxels(1, (1, 1, 2), (0, 1)),
                                            function((0, 0, 255, 120)), function((255, 0, 0, 200))))


def matter(color, alpha):
    return premultiplied(tuple(c / 255 for c in color), alpha / 255)


@suite.row("F14", "order of compositing", scene=front_scene(slab(*BLUE, -0.25), slab(*RED, 0.25)),
           shows="two slabs, one before the other; exchanged; as segments of one volume; in the same place",
           invariant="what is nearer lies over what is farther, in any order of the file; what is in one place mixes by extinction")
def order(row):
    red, blue = matter(*RED), matter(*BLUE)
    a, b = slab(*BLUE, -0.25), slab(*RED, 0.25)
    mixed_depth = -math.log1p(-200 / 255), -math.log1p(-120 / 255)
    total = -math.expm1(-sum(mixed_depth))
    share = mixed_depth[0] / sum(mixed_depth)
    mixed = (share * total, 0, (1 - share) * total, total)
    one, two = slab(*RED, 0), slab(*BLUE, 0)
    for name, options in row.methods():
        for step in (1, 0.3) if name == "midpoint" else (0.3,):
            def see(*parts):
                return row.middle("--step", step, *options, scene=front_scene(*parts))
            case = f"{name} {step}"
            near, far = see(a, b), see(slab(*RED, -0.25), slab(*BLUE, 0.25))
            row.measure("one before the other differs by", max(worst([near], [over(red, blue)]), worst([far], [over(blue, red)])),
                        at_most=FLOOR, case=case)
            row.measure("the mixture differs by", worst([see(one, two)], [mixed]), at_most=FLOOR, case=case)
            row.count("numbers that the order of the file changes", sum(x != y for p, q in (
                (near, see(b, a)), (see(one, two), see(two, one))) for x, y in zip(p, q)), case=case)
        segments = row.middle("--step", 1 / 256, *options, scene=front_scene(SEGMENTS))
        row.measure("segments differ, with steps of 1/256, by", worst([segments], [over(red, blue)]), at_most=1 / 255, case=name)
    for text, exact in ((row.text, over(red, blue)), (front_scene(SEGMENTS), over(red, blue)), (front_scene(one, two), mixed)):
        for asked, options in row.planned(text):
            row.measure(AS_ASKED, worst([row.middle(*options, scene=text)], [exact]), at_most=asked)


STRIPES = [40 + 200 * (k % 2) for k in range(100)]


def fine_and_coarse(first, second):
    return front_scene(first, second).replace("-1 -1 1 1", "-.02 -.02 .02 .02")


COARSE = volume(constant(150), function((255, 0, 0, 150), (255, 0, 0, 150)))
FINE = volume(voxels(1, (4, 4, 100), [v for v in STRIPES for _ in range(16)]),
              function((0, 255, 0, 0), (0, 255, 0, 12)), dimensions=(0.04, 0.04, 1))


@suite.row("F15", "overlapping volumes stepped by the coarsest", scene=fine_and_coarse(COARSE, FINE),
           shows="one voxel of 1 in the place of 100 stripes of 0.01",
           invariant="the finest volume sets the steps; the order of the file changes nothing")
def finest(row):
    red = -math.log1p(-150 / 255)

    def extinction(z):  # of the stripes, per length
        at = min(max(100 * z - 0.5, 0.0), 99.0)
        low = min(int(at), 98)
        value = (STRIPES[low] + (STRIPES[low + 1] - STRIPES[low]) * (at - low)) / 255
        return -math.log1p(-value * 12 / 255) / 0.01

    color, through = [0.0, 0.0], 1.0
    count = 20000
    for i in range(count):
        green = extinction(1 - (i + 0.5) / count)
        alpha = -math.expm1(-(red + green) / count)
        color[0] += through * alpha * red / (red + green)
        color[1] += through * alpha * green / (red + green)
        through *= 1 - alpha
    exact = (color[0], color[1], 0, 1 - through)
    for name, options in row.methods():
        p = row.picture("--step", 0.25, *options, size="4x4")
        row.measure("steps of 1/4 of the fine voxels are wrong by", max(worst([c], [exact]) for c in pixels_of(p)),
                    at_most=1 / 255, case=name)
        q = row.picture("--step", 0.25, *options, size="4x4", scene=fine_and_coarse(FINE, COARSE))
        row.count("numbers that the order of the file changes", sum(a != b for a, b in zip(p.values, q.values)), case=name)
    for asked, options in row.planned():
        p = row.picture(*options, size="4x4")
        row.measure(AS_ASKED, max(worst([c], [exact]) for c in pixels_of(p)), at_most=asked)


SHADOWED = "renderStyle ShadedVolumeStyle { lighting TRUE shadows TRUE material Material { } } dimensions 1 1 1024"
LONG_MAXIMUM = 'renderStyle ProjectionVolumeStyle { type "MAX" } dimensions 1 1 1024'


@suite.row("F16", "a cap on steps", scene=front_scene(volume(voxels(1, (1, 1, 1024), [255] + [0] * 1023), dimensions=(1, 1, 1024)))
           .replace("position 0 0 10", "position 0 0 600"),
           shows="1023 empty voxels, then an opaque one; again with a haze and steps of 1/2048",
           invariant="the back is reached with 65536 steps, with two million, and where each asks for light; or a message says "
                     "that it is not")
def many_steps(row):
    haze = row.changed((f"image [1 1 1 1024 255 {' '.join(['0'] * 1023)}]", f"image [1 1 1 1024 255 {' '.join(['1'] * 1023)}]"))
    for name, options in row.methods():
        row.measure("what shines through the opaque voxel", 1 - row.middle("--step", 1 / 64, *options)[3], at_most=1e-3, case=name)
        row.measure("what shines through behind haze", 1 - row.middle("--step", 1 / 64, *options, scene=haze)[3],
                    at_most=1e-3, case=name)
        lit = haze.replace("dimensions 1 1 1024", SHADOWED) + "DirectionalLight { direction 0 0 -1 shadows TRUE }\n"
        row.measure("what shines through behind haze in its own shadow", 1 - row.middle("--step", 1 / 2, *options, scene=lit)[3],
                    at_most=1e-3, case=name)
        exact = 1 - (254 / 255) ** 512
        cut = haze.replace("dimensions 1 1 1024", "cropMin 0 0 .5 dimensions 1 1 1024")
        for step in (1 / 64, 1 / 2048) if name == "midpoint" else (1 / 64,):
            p = row.middle("--step", step, *options, scene=cut)
            row.measure("half the haze is wrong by", abs(p[3] - exact), at_most=1e-3, case=f"{name} {step:.2g}")
    for asked, options in row.planned():
        row.measure(AS_ASKED, max(1 - row.middle(*options)[3], 1 - row.middle(*options, scene=haze)[3]), at_most=asked)
    maximum = row.render("--step", 1 / 64, "--probe", "0,0", size="1x1", scene=row.text.replace("dimensions 1 1 1024", LONG_MAXIMUM))
    row.measure("messages where a projection cannot take as many", len(maximum.with_code("limit")), at_least=1)


def cube(size):
    """A blob, within a box of more or fewer empty voxels: `size` of them along each side."""
    values = []
    for k in range(size):
        for j in range(size):
            for i in range(size):
                x, y, z = (abs(c - (size - 1) / 2) for c in (i, j, k))
                values.append((90 + 37 * int(x + y) + 53 * int(z + 2 * x)) % 160 + 30 if max(x, y, z) < 2 else 0)
    side = size / 8
    return turned((1, 2, 3), 0.9, volume(voxels(1, (size, size, size), values), dimensions=(side, side, side)))


@suite.row("F17", "measures that begin where the ray does", scene=front_scene(cube(6)),
           shows="a block of 4 voxels seen on a corner, with 1 and with 3 empty voxels around it, from near and far",
           invariant="a place looks as it is, wherever the ray has entered")
def entries(row):
    far = row.changed(("position 0 0 10", "position 0 0 23.37"))
    for name, options in row.methods():
        tight, wide = (row.picture("--step", 1 / 32, *options, scene=front_scene(cube(n))) for n in (6, 10))
        row.measure("empty voxels around change colours by", worst(tight, wide), at_most=1 / 255, case=name)
        a = row.picture("--step", 0.5, *options)
        b = row.picture("--step", 0.5, *options, scene=far)
        row.measure("moving the eye along the ray changes colours by", worst(a, b), at_most=2e-5, case=name)
    for asked, options in row.planned():
        pictures = [row.picture(*options, scene=text) for text in (row.text, front_scene(cube(10)), far)]
        row.measure("with an error of 1/255 asked for, any of it changes colours by", max(worst(pictures[0], p) for p in pictures),
                    at_most=2 * asked)
    top, wide = (row.picture("--step", 0.1, scene=front_scene(cube(n)).replace("dimensions", MAXIMUM)) for n in (6, 10))
    row.measure("empty voxels around change a maximum by", worst([top.values[::4]], [wide.values[::4]]), at_most=2e-2)


MAXIMUM = 'renderStyle ProjectionVolumeStyle { type "MAX" } dimensions'


# ---- F5, F6, F13: functions of high frequencies, against the reference


def texels(alphas, rgb=lambda i: (255, 255, 255)):
    """Style and the reference's function of the same texels."""
    colors = [rgb(i) + (a,) for i, a in enumerate(alphas)]
    return function(*colors), reference.texels([[c / 255 for c in color] for color in colors])


def true_picture(numbers, size, transfer, half, pixels, turn=None, kind="u8", **fields):
    matrix = reference.turned((*turn[0], turn[1])) if turn else reference.IDENTITY
    values, errors = reference.truth([reference.volume(size, numbers, kind, transfer=transfer, matrix=matrix, **fields)],
                                     reference.camera((0, 0, 10), fieldOfView=(-half, -half, half, half)), pixels)
    return [values.at(x, y) for y in range(pixels[1]) for x in range(pixels[0])], max(errors.data)


SHELL = 12
SHELL_NUMBERS = [max(0, min(255, round(255 - 36 * math.dist((i, j, k), ((SHELL - 1) / 2,) * 3))))
                 for k in range(SHELL) for j in range(SHELL) for i in range(SHELL)]
STEP_STYLE, STEP_TRUTH = texels([0] * 16 + [120] * 8 + [0] * 8, lambda i: (255, 180, 90) if i % 2 else (90, 180, 255))
SHELL_TURN = (1, 2, 0.5), 0.6


@suite.row("F5", "wood grain", scene=scene(view(0.5, 0.5), NO_HEADLIGHT, turned(*SHELL_TURN, volume(
               voxels(1, (SHELL,) * 3, SHELL_NUMBERS), STEP_STYLE))),
           shows="a shell of 2 voxels with abrupt edges and colours in a turned box",
           invariant="no rings: the picture comes to the true one as steps get finer, and to the error asked for")
def wood_grain(row):
    true, bar = true_picture(SHELL_NUMBERS, (SHELL,) * 3, STEP_TRUTH, 0.5, (32, 32), SHELL_TURN)
    row.measure("error bar of the reference", bar, at_most=1e-5)
    for name, options in row.methods():
        errors = [worst(pixels_of(row.picture("--step", step, *options, size="32x32")), true) for step in (1, 1 / 64)]
        row.measure("with steps of 1/64, colours are wrong by", errors[1], at_most=1 / 255, case=name, details=[errors])
    for asked, options in row.planned():
        got = pixels_of(row.picture(*options, size="32x32"))
        row.measure(AS_ASKED, worst(got, true), at_most=asked)


COMB = [0 if i % 2 == 0 else 90 for i in range(65)]
COMB_STYLE, COMB_TRUTH = texels(COMB)
SPIKE = [0] * 65
SPIKE[37] = 200
SPIKE_STYLE, SPIKE_TRUTH = texels(SPIKE)
EVEN = [round(255 * i / 16) for i in range(17)]
FINE_CROP = "cropMin 0 0 .03125 cropMax 1 1 .96875 dimensions 1 1 16 opacityUnitDistance 2"


def even_ramp(style):
    content = volume(voxels(1, (1, 1, 17), EVEN), style, fields=FINE_CROP).replace("dimensions 1 1 1\n", "")
    return scene(view(0.3, 0.3).replace("0 0 10", "0 0 20"), NO_HEADLIGHT, turned((0, 1, 0), 0.02, content))


@suite.row("F6", "high frequencies of the transfer function missed", scene=even_ramp(COMB_STYLE),
           shows="a ramp with 32 teeth of opacity, and with one thin spike, each of 1/2 voxel",
           invariant="midpoint sees them with fine steps, integrals of the function with steps of a voxel, too")
def teeth(row):
    for kind, style, transfer in (("teeth", COMB_STYLE, COMB_TRUTH), ("spike", SPIKE_STYLE, SPIKE_TRUTH)):
        matrix = reference.turned((0, 1, 0, 0.02))
        values, _ = reference.truth(
            [reference.volume((1, 1, 17), EVEN, transfer=transfer, matrix=matrix, dimensions=(1, 1, 16), opacity_unit=2,
                              crop=((0, 0, 0.03125), (1, 1, 0.96875)))],
            reference.camera((0, 0, 20), fieldOfView=(-0.3, -0.3, 0.3, 0.3)), (8, 8))
        true = [values.at(x, y) for y in range(8) for x in range(8)]
        row.measure("opacity of the truth", min(c[3] for c in true), at_least=0.05, case=kind)
        for name, options in row.methods():
            for step in (1 / 64,) if name == "midpoint" else (1, 1 / 64):
                got = pixels_of(row.picture("--step", step, *options, scene=even_ramp(style), size="8x8"))
                row.measure("colours are wrong by", worst(got, true), at_most=1 / 255, case=f"{kind}, {name}, {step:g}")
        for asked, options in row.planned():
            got = pixels_of(row.picture(*options, scene=even_ramp(style), size="8x8"))
            row.measure(AS_ASKED, worst(got, true), at_most=asked, case=kind)


FLAT = [30000, 30001, 30000, 30002, 30001, 30000, 30002, 30000]
FLAT_FILE = ("NRRD0004\ntype: ushort\ndimension: 3\nsizes: 2 2 2\nencoding: ascii\nmin: 0\nmax: 65535\n\n"
             + " ".join(map(str, FLAT)) + "\n")
NARROW = [0] * 1001
NARROW[617] = 160
NARROW_STYLE, NARROW_TRUTH = texels(NARROW)


def segments_scene(data, style, fields):
    return front_scene(volume(data, style, fields=fields))


def ramp_truth(transfer, reach, unit):
    values, _ = reference.truth(
        [reference.volume((1, 1, 2), [0, 255], transfer=transfer, crop=((0, 0, reach), (1, 1, 1 - reach)), opacity_unit=unit)],
        reference.camera((0, 0, 10), fieldOfView=(-1, -1, 1, 1)), (1, 1))
    return values.at(0, 0)


@suite.row("F13", "pre-integration: division by nothing, coarse tables, attenuation left out", scene=segments_scene(
               'ImageTexture3D { url "F13-flat.nrrd" }', function((255, 0, 0, 20), (0, 0, 255, 220)), "opacityUnitDistance .3"),
           shows="values that differ by 1/65535 in a step; a ramp through the default function; a spike of 1/1000",
           invariant="nearly constant values are as constant ones; halved steps quarter the error; a spike is whole for any step",
           files={"F13-flat.nrrd": FLAT_FILE})
def integrals(row):
    value = sum(FLAT) / 8 / 65535
    alpha = (20 + 200 * value) / 255
    flat = premultiplied((1 - value, 0, value), 1 - (1 - alpha) ** (1 / 0.3))
    tone = function((0, 0, 0, 0), (255, 255, 255, 178))
    true = ramp_truth(reference.texels([(0, 0, 0, 0), (1, 1, 1, 178 / 255)]), 0.25, 0.2)
    spike = ramp_truth(NARROW_TRUTH, 0.25, 0.01)
    row.measure("opacity of the spike", spike[3], at_least=0.03)
    ramp = voxels(1, (1, 1, 2), (0, 255))
    side = 0.5 ** (1 / 3)  # of a voxel, the mean
    for name, options in row.methods():
        for step in (2, 1 / 16, 1 / 256):
            row.measure("of nearly constant values, colours differ from constant ones by",
                        worst([row.middle("--step", step, *options)], [flat]), at_most=2e-5, case=f"{name} {step:g}")
        core = "cropMin 0 0 .25 cropMax 1 1 .75 opacityUnitDistance "
        errors = []
        for steps in (8.37, 66.96):
            # cells have no steps: their errors are those that are asked for
            asked = ("--error", "1/4096") if name == "cells" else ("--step", 0.5 / steps / side)
            got = row.middle(*asked, *options, scene=segments_scene(ramp, tone, core + ".2"))
            errors.append(worst([got], [true]))
        row.measure("error of 67 steps on the ramp, beyond 1/40 of that of 8", errors[1] - errors[0] / 40, at_most=1e-4,
                    case=name, details=[errors])  # tables have a floor
        for steps in (8.37, 512) if name != "midpoint" else (8192,):
            got = row.middle("--step", 0.5 / steps / side, *options, scene=segments_scene(ramp, NARROW_STYLE, core + ".01"))
            row.measure("the spike is wrong by", worst([got], [spike]), at_most=1e-3, case=f"{name} {steps:g}")


suite.main(__name__)
