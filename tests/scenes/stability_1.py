#!/usr/bin/env python3
"""F1 to F17: integration and compositing. stability_1.py PLUGRAY [ROW...]"""

import math
import os
import sys

from harness import Picture, box_interval, over, premultiplied
from scenes import NO_HEADLIGHT, constant, effect, front_scene, quad, scene, volume, voxels
from stability_data import Stability, parallel_rays, pixels_of, worst, wrong_numbers

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "tools"))
from pictures import read_png  # noqa: E402

suite = Stability()
PLAIN = "ShadedVolumeStyle { }"  # without light: the voxel's own colour
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


@suite.row("F2", "opacity correction applied twice", scene=scene(view(2, 0.5), NO_HEADLIGHT, *ONCE),
           shows="boxes that are 0.2 opaque as a whole: bare, with a transfer function, with two styles, with segments",
           invariant="each is 0.2 opaque for any step, whatever it passes through")
def corrected_once(row):
    for name, options in row.methods():
        for step in (2, 1, 0.25):
            p = row.picture("--step", step, *options, size="8x2")
            found = [p.at(x, y)[3] for x in range(8) for y in range(2)]
            row.measure("A differs from 0.2 by", max(abs(a - 0.2) for a in found), at_most=FLOOR, case=f"{name} {step}")


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
    coat = row.changed((constant(40, (7, 7, 7)), voxels(1, (1, 1, 4), (255, 0, 0, 0))))
    seen = [i for i, (o, d) in enumerate(rays) if box_interval(o, d)[1] > 0 and
            exit_depth(o, d) < -0.5 + 1e-9]
    for name, options in row.methods():
        for step in (0.5, 0.37):
            got = pixels_of(row.picture("--step", step, *options, size="96x4", scene=coat))
            missed = sum(got[i][3] < 1 - 1e-3 for i in seen)
            row.count("rays that miss an opaque coat of 1/2 voxel on the back", missed, case=f"{name} {step}")


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


@suite.row("F8", "bias of rays that end early", scene=behind_black(WHITE),
           shows="a black slab that lets 5e-2 to 1e-5 through before a white one, and before a surface of brightness 100",
           invariant="what is left out is at most 1/8 of 1/255, also of what is brighter than white; never is anything added",
           fault="rays end as if nothing behind were brighter than 1")
def early_end(row):
    for name, options in row.methods():
        p = row.picture("--step", 0.25, *options, size="64x64")
        wrong, added = 0.0, 0.0
        for x in range(16, 48):
            at = min(max(2 * (x - 16 + 0.5) / 32 - 0.5, 0.0), 1.0)
            through = (1 - (200 + 55 * at) / 255) ** 2
            red, alpha = p.at(x, 32)[0], p.at(x, 32)[3]
            wrong = max(wrong, through - red, 1 - alpha)
            added = max(added, red - through, alpha - 1)
        row.measure("light left out", wrong, at_most=TAIL, case=name)
        row.measure("light added", added, at_most=FLOOR, case=name)
        p = row.picture("--step", 0.02, *options, size="64x64", scene=behind_black(BRIGHT))
        errors = []
        for x in range(16, 48):
            at = min(max(2 * (x - 16 + 0.5) / 32 - 0.5, 0.0), 1.0)
            errors.append(abs(p.at(x, 32)[0] - 100 * (1 - (200 + 55 * at) / 255) ** 2))
        row.measure("error of brightness 100 behind", max(errors), at_most=1 / 255, case=name)


@suite.row("F9", "accumulation in 8 bits", scene=front_scene(volume(constant(1, (1, 1, 512)), dimensions=(1, 1, 512))
                                                             ).replace("position 0 0 10", "position 0 0 300"),
           shows="512 voxels of 1/255, in steps that add 1/1020 each",
           invariant="thin matter adds up")
def thin(row):
    exact = 1 - (254 / 255) ** 512
    for name, options in row.methods():
        color = row.middle("--step", 0.25, *options)
        row.measure("A differs by", abs(color[3] - exact), at_most=2e-5, case=name)
        row.measure("colour differs by", abs(color[0] - exact / 255), at_most=2e-5, case=name)


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
        row.measure("colour differs from the integral by", worst([got], [(red, 0, blue, alpha)]), at_most=1e-4, case=name)
        placed = row.middle("--step", 1 / 64, *options, scene=row.text + behind)
        row.measure("over a background, colour differs by", worst([placed], [over(got, back + (1.0,))]), at_most=FLOOR,
                    case=name)
        p = row.picture("--step", 0.5, *options)
        row.count("colours beyond their opacity", sum(max(c[:3]) > c[3] + FLOOR for c in pixels_of(p)), case=name)


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
        for step in (1, 0.3):
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


@suite.row("F16", "a cap on steps", scene=front_scene(volume(voxels(1, (1, 1, 1024), [255] + [0] * 1023), dimensions=(1, 1, 1024)))
           .replace("position 0 0 10", "position 0 0 600"),
           shows="1023 empty voxels, then an opaque one; again with a haze and steps of 1/2048",
           invariant="the back is reached with 65536 steps, and with two million, or the picture says that it is not",
           fault="llvmpipe ends all loops of a pixel after 65535 turns in silence")
def many_steps(row):
    haze = row.changed((f"image [1 1 1 1024 255 {' '.join(['0'] * 1023)}]", f"image [1 1 1 1024 255 {' '.join(['1'] * 1023)}]"))
    for name, options in row.methods():
        row.measure("what shines through the opaque voxel", 1 - row.middle("--step", 1 / 64, *options)[3], at_most=1e-3, case=name)
        row.measure("what shines through behind haze", 1 - row.middle("--step", 1 / 64, *options, scene=haze)[3],
                    at_most=1e-3, case=name)
        exact = 1 - (254 / 255) ** 512
        cut = haze.replace("dimensions 1 1 1024", "cropMin 0 0 .5 dimensions 1 1 1024")
        for step in (1 / 64, 1 / 2048):
            p = row.middle("--step", step, *options, scene=cut)
            row.measure("half the haze is wrong by", abs(p[3] - exact), at_most=1e-3, case=f"{name} {step:.2g}")


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
    top, wide = (row.picture("--step", 0.1, scene=front_scene(cube(n)).replace("dimensions", MAXIMUM)) for n in (6, 10))
    row.measure("empty voxels around change a maximum by", worst([top.values[::4]], [wide.values[::4]]), at_most=2e-2)


MAXIMUM = 'renderStyle ProjectionVolumeStyle { type "MAX" } dimensions'


suite.main(__name__)
