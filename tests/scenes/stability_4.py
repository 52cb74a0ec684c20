#!/usr/bin/env python3
"""F40 to F49: surfaces of equal value, styles, lights. stability_4.py PLUGRAY [ROW...]

With PLUGRAY_RAYS=1000 in the environment, F40 casts pictures of 1000 x 1000 rays."""

import math
import os

from crossings import Comparison, Field, View, cell_roots, marschner_lobb, noise, shells
from harness import over, premultiplied, rotate
from scenes import NO_HEADLIGHT, constant, effect, scene, volume, voxels
from stability_data import Stability, pixels_of, worst, wrong_numbers
from stability_3 import LIGHT, SHADE, WHOLE, image3d, nrrd, view

suite = Stability()
FLOOR = 2e-6
PIXELS = int(os.environ.get("PLUGRAY_RAYS", "80"))

# ---- F40 to F42: surfaces of equal value

FIELDS = {"waves": Field("F40-waves.nrrd", (40, 40, 40), marschner_lobb),
          "shells": Field("F40-shells.nrrd", (32, 32, 32), shells),
          "noise": Field("F40-noise.nrrd", (16, 16, 16), noise())}
OBLIQUE = View((1, 2, 3), 0.7, pixels=PIXELS)
STRAIGHT = View((1, 0, 0), 0.0, pixels=PIXELS)
NEAR = View((3, 1, -2), 1.9, perspective=True, pixels=PIXELS)
PLACE = "vec4(s.position, 1.0)"
COUNT = "vec4(1.0, 1.0, 1.0, 1.0 / 64.0)"  # opacity of each
NORMAL = "vec4(s.normal_eye * 0.5 + 0.5, 1.0)"
CASES_40 = (("waves", 0.5, OBLIQUE), ("waves", 0.5, NEAR), ("shells", 0.97, OBLIQUE), ("shells", 0.99, NEAR),
            ("shells", 0.99, STRAIGHT), ("noise", 0.5, OBLIQUE), ("noise", 0.9, NEAR))


def largest_angle(eye, roots, picture):
    """In degrees, between normals and the double-precision gradients where the first surface is."""
    largest = 0.0
    for i, color in enumerate(pixels_of(picture)):
        gradient = roots[8 * i + 2 : 8 * i + 5]
        if color[3] == 0 or roots[8 * i + 7] <= 0 or math.hypot(*gradient) < 1e-3:
            continue
        expected = rotate(*eye.turn, [-g / math.hypot(*gradient) for g in gradient])
        off = math.dist(expected, [2 * c - 1 for c in color[:3]])
        largest = max(largest, math.degrees(2 * math.asin(min(off / 2, 1))))
    return largest


def count_of(alpha):
    """Of crossings that are each 1/64 opaque."""
    return round(math.log(1 - alpha) / math.log(1 - 1 / 64))


@suite.row("F40", "surfaces crossed twice in a step are missed", scene=OBLIQUE.scene(FIELDS["shells"], 0.97, PLACE),
           files={field.name: field.nrrd() for field in FIELDS.values()},
           shows="shells thinner than a voxel, the waves of Marschner and Lobb, noise: some ten thousand rays from two sides "
                 "and from near",
           invariant="each ray meets what the roots of the cubics of its cells are, in double precision")
def crossings(row):
    for name, value, eye in CASES_40:
        field, rays = FIELDS[name], eye.rays()
        roots = cell_roots(suite.program, field, value, rays)
        p = row.picture(scene=eye.scene(field, value, PLACE), size=eye.size)
        found = Comparison(field, rays, roots, p)
        case = f"{name} {value}"
        row.measure("rays that meet a surface", found.hits, at_least=PIXELS * PIXELS / 100, case=case)
        row.count("first surfaces missed", found.missed, case=case, details=found.worst)
        row.count("surfaces where there is none", found.false, case=case, details=found.worst)
        row.measure("places differ by (voxels)", found.farthest, at_most=1e-4, case=case)
        row.measure("rays that 2e-6 of the value decide (of all)", found.unsure / PIXELS**2, at_most=5e-3, case=case)
        if eye is OBLIQUE:
            counts = [count_of(c[3]) for c in pixels_of(row.picture(scene=eye.scene(field, value, COUNT), size=eye.size))]
            row.count("rays with more or fewer crossings",
                      sum(n != roots[8 * i + 7] for i, n in enumerate(counts) if roots[8 * i + 7] >= 0), case=case)
        if name == "waves":
            p = row.picture(scene=eye.scene(field, value, NORMAL), size=eye.size)
            row.measure("normals differ by (degrees)", largest_angle(eye, roots, p), at_most=0.1, case=case)


# Values along the ray, from behind; what is in front of them is 0.
PROFILES = {
    "cubes": [(k / 8) ** 3 for k in range(9)],
    "plateau": [0, 0.25, 0.5, 0.5, 0.5, 0.5, 0.75, 1, 1],
    "voxel": [0, 0.125, 0.25, 0.375, 0.5, 0.625, 0.75, 0.875, 1],
    "peak": [0, 0, 0, 0.25, 0.5, 0.25, 0, 0, 0],
    "jump": [0, 0, 0, 0, 1, 1, 1, 1, 1],
    "flat": [0.4999995] * 4 + [0.5000005] * 5,
    "noisy": [0.49999, 0.50001, 0.49998, 0.50002, 0.49999, 0.50003, 0.49999, 0.50001, 0.49998],
    "steep": [0, 1, 0, 1, 0, 1, 0, 1, 0],
    "below": [0.1] * 9,
    "above": [0.9] * 9,
}
MEET = [name for name in PROFILES if name not in ("below", "above")]
FILES_41 = {"F41-profiles.nrrd": nrrd("float", "f", (10, 1, 9), (PROFILES[name][k] for k in range(9) for name in PROFILES))}


@suite.row("F41", "refinement leaves its bracket", files=FILES_41,
           scene=scene(view(0.5, 0.05), NO_HEADLIGHT, "IsoSurfaceVolumeData { surfaceValues [ .5 ] valueRange 0 1 voxels "
                       + image3d("F41-profiles.nrrd") + effect(f"{SHADE} {{ color = vec4(s.position, 1.0); }}").join(
                           (" effects [ ", " ] }\n"))),
           shows="ten columns of voxels: cubes, a plateau and single voxels of exactly the value, jumps, noise around it",
           invariant="where a surface is found the value is that of the surface, inside of the box; none is found elsewhere")
def refinement(row):
    for step in ("0.3", "1", "4"):
        p = pixels_of(row.picture("--step", step, size="10x1"))
        row.count("wrong numbers", wrong_numbers(p), case=step)
        for name, color in zip(PROFILES, p):
            if name == "peak" and color[3] == 0:
                continue  # touched at a point: either way
            row.count("columns with a surface that is none, or without", (color[3] > 0) != (name in MEET), case=name)
            if color[3] > 0:
                at = min(max(color[2] * 9 - 0.5, 0), 8)
                k = min(int(at), 7)
                value = PROFILES[name][k] + (PROFILES[name][k + 1] - PROFILES[name][k]) * (at - k)
                row.measure("values differ by", abs(value - 0.5), at_most=1e-5, case=name)


NESTED = Field("F42-nested.nrrd", (32, 32, 32), lambda x, y, z: 1 - 2 * math.dist((x, y, z), (0.5, 0.5, 0.5)))
COLORS_42 = (f"{SHADE} {{ color = vec4(s.surface == 0 ? vec3(1.0, 0.0, 0.0) : vec3(0.0, 1.0, 0.0), 0.5); }}")
FACING = (f"{SHADE} {{ color = vec4(vec3(0.5 - 0.5 * dot(s.normal_eye, normalize(s.position_eye))), 1.0); }}")
INSIDE = "Viewpoint { position 0 0 0 fieldOfView 1 nearDistance 1e-4 }\n"


def nested(code, eye=WHOLE, values=".4 .7"):
    return scene(eye, NO_HEADLIGHT, f"IsoSurfaceVolumeData {{ surfaceValues [ {values} ] valueRange 0 255 voxels ",
                 image3d("F42-nested.nrrd"), f" effects [ {effect(code)} ] }}\n")


@suite.row("F42", "surfaces out of order, or inside out", scene=nested(COLORS_42), files={NESTED.name: NESTED.nrrd()},
           shows="two spheres around each other, seen from before them and from their middle; and values at the ends of the data",
           invariant="the nearest first; normals point out of the denser side; ends of the data make no noise")
def nesting(row):
    red, green = (0.5, 0, 0, 0.5), (0, 0.5, 0, 0.5)
    outside = over(red, over(green, over(green, red)))
    row.measure("colours differ by", worst([row.middle()], [outside]), at_most=FLOOR, case="from outside")
    inside = row.picture(scene=nested(COLORS_42, INSIDE), size="8x8")
    row.measure("colours differ by", worst(pixels_of(inside), [over(green, red)] * 64), at_most=FLOOR, case="from inside")
    # straight at the spheres the normal faces the viewer or looks away
    facing = row.middle(scene=nested(FACING))[0]
    row.measure("cosines differ by", abs(facing - 1), at_most=1e-5, case="from outside")
    away = pixels_of(row.picture(scene=nested(FACING, INSIDE), size="8x8"))
    row.measure("normals from inside differ by", max(abs(c[0]) for c in away), at_most=2e-3)
    for values in ("0", "1", "0 1"):
        p = row.picture(scene=nested(COLORS_42, values=values), size="32x32")
        row.count("wrong numbers", wrong_numbers(p), case=values)


# ---- F43 to F47: edge values of styles. One crossing of a plane: its normal is known, its opacity is the style's

TINT = (0.5, 0.25, 0.75)
OV = 0.5
FROM_NEAR = "Viewpoint { position 0 0 .25 fieldOfView 1.5707963 nearDistance .001 }\n"
SIDE = 33  # the middle one of its pixels looks along the normal
GIVEN = effect(f"void PLUG_volume_classify(inout vec4 color, const in VolumeSample s) "
               f"{{ color = vec4({TINT[0]}, {TINT[1]}, {TINT[2]}, {OV}); }}")


def plane(style, eye=FROM_NEAR, fields="", data=None, lights=""):
    data = data or voxels(1, (1, 1, 16), (255 - 17 * i for i in range(16)))  # denser behind
    return scene(eye, NO_HEADLIGHT, lights, f"IsoSurfaceVolumeData {{ surfaceValues [ .5 ] voxels {data} {fields} "
                 f"renderStyle [ {style} ] effects [ {GIVEN} ] }}\n")


def cosines():
    """Between ray and normal, for each pixel."""
    for i in range(SIDE * SIDE):
        x, y = ((2 * k + 1) / SIDE - 1 for k in (i % SIDE, i // SIDE))
        yield 1 / math.sqrt(1 + x * x + y * y)


def silhouette(sharpness, fields="silhouetteRetainedOpacity .2 silhouetteBoundaryOpacity .7"):
    return f"SilhouetteEnhancementVolumeStyle {{ {fields} silhouetteSharpness {sharpness} }}"


@suite.row("F43", "silhouettes of negative base", scene=plane(silhouette(0.5)),
           shows="a plane seen from near, straight on in the middle; sharpness 0, 0.5, 1 and 3",
           invariant="retained + boundary (1 - n.v)^sharpness, with 0^0 = 1, where n.v is 1 too")
def silhouettes(row):
    for sharpness in (0, 0.5, 1, 3):
        p = pixels_of(row.picture(scene=plane(silhouette(sharpness)), size=f"{SIDE}x{SIDE}"))
        row.count("wrong numbers", wrong_numbers(p), case=sharpness)
        expected = [premultiplied(TINT, OV * (0.2 + 0.7 * max(1 - c, 0) ** sharpness)) for c in cosines()]
        middle = SIDE * SIDE // 2
        row.measure("in the middle colours differ by", worst([p[middle]], [expected[middle]]), at_most=3e-4, case=sharpness)
        del p[middle], expected[middle]
        row.measure("elsewhere they differ by", worst(p, expected), at_most=2e-5, case=sharpness)


BALL = Field("F44-ball.nrrd", (24, 24, 24), lambda x, y, z: 1 - math.dist((x, y, z), (0.5, 0.5, 0.5)))
OPAQUE = effect(f"{SHADE} {{ color.a = color.a > 0.0 ? 1.0 : 0.0; }}")


def cartoon(fields):
    return scene(WHOLE, NO_HEADLIGHT, "IsoSurfaceVolumeData { surfaceValues [ .6 ] valueRange 0 255 voxels ",
                 image3d(BALL.name), f" renderStyle [ CartoonVolumeStyle {{ {fields} }} ] effects [ {OPAQUE} ] }}\n")


def hue(rgb):
    """In degrees, -180 to 180."""
    r, g, b = rgb
    return math.degrees(math.atan2(math.sqrt(3) * (g - b), 2 * r - g - b))


@suite.row("F44", "cartoons: one step, hues the long way round, hues of greys",
           scene=cartoon("colorSteps 2 orthogonalColor 1 0 .1667 1 parallelColor 1 .1667 0 1"), files={BALL.name: BALL.nrrd()},
           shows="a ball from red of 350 degrees to red of 10 degrees, and from white to black; 1, 2 and 64 steps",
           invariant="no more colours than steps, from one to the other without another hue")
def cartoons(row):
    for steps in (1, 2, 64):
        for colors in ("orthogonalColor 1 0 .1667 1 parallelColor 1 .1667 0 1", "orthogonalColor 1 1 1 1 parallelColor 0 0 0 1"):
            p = pixels_of(row.picture(scene=cartoon(f"colorSteps {steps} {colors}"), size="48x48"))
            seen = {tuple(round(v, 4) for v in c[:3]) for c in p if c[3] > 0}
            row.count("wrong numbers", wrong_numbers(p), case=steps)
            row.measure("colours of each step", len(seen) / steps, at_most=1, case=steps)
            if colors.startswith("orthogonalColor 1 0"):
                row.measure("hues away from red (degrees)", max(abs(hue(c)) for c in seen), at_most=10.1, case=steps)
                row.measure("least red", min(c[0] for c in seen), at_least=0.999, case=steps)
            else:
                row.measure("colour in greys", max(max(c) - min(c) for c in seen), at_most=FLOOR, case=steps)
                line = [p[24 * 48 + x][0] for x in range(24, 48) if p[24 * 48 + x][3] > 0]
                row.count("pixels brighter than those nearer to the middle",
                          sum(b > a + FLOOR for a, b in zip(line, line[1:])), case=steps)


def gooch(count, direction, colors):
    lights = "".join(f"DirectionalLight {{ direction {direction} ambientIntensity {k % 2} }}\n" for k in range(count))
    return plane(f"ToneMappedVolumeStyle {{ {colors} }}", WHOLE, lights=lights)


DIM = "warmColor .1 .05 0 0 coolColor 0 .02 .11 0"


@suite.row("F45", "tones of many lights", scene=gooch(8, "0 -.6 -.8", DIM),
           shows="1, 2 and 8 lights from one place on a plane, from before it and from behind",
           invariant="each light gives (1 + l.n) / 2 of the warm colour and the rest of the cool one; their sum is clamped once; "
                     "opacity stays")
def tones(row):
    for count, direction, cosine in ((1, "0 -.6 -.8", 0.8), (2, "0 -.6 -.8", 0.8), (8, "0 -.6 -.8", 0.8), (8, "0 0 1", -1),
                                     (8, "1 0 0", 0)):
        w = (1 + cosine) / 2
        rgb = [min(count * (w * a + (1 - w) * b), 1) for a, b in zip((0.1, 0.05, 0), (0, 0.02, 0.11))]
        got = row.middle(scene=gooch(count, direction, DIM))
        row.measure("colours differ by", worst([got], [premultiplied(rgb, OV)]), at_most=FLOOR, case=f"{count} {direction}")
    got = row.middle(scene=gooch(8, "0 -.6 -.8", ""))
    row.measure("colours that are clamped differ by", worst([got], [premultiplied((1, 1, 0.8), OV)]), at_most=FLOOR)


SLOPE_46 = 16 * 17 / 255  # of the ramp, a box


def boundary(gs, ge, size=1, given=True):
    data = "dimensions 1 1 " + str(size) + (f" gradientUnit {0.5 / SLOPE_46}" if given else "")
    return plane(f"BoundaryEnhancementVolumeStyle {{ retainedOpacity .3 boundaryOpacity {gs} opacityFactor {ge} }}", WHOLE, data)


@suite.row("F46", "boundaries overflow", scene=boundary(1e9, 10),
           shows="a plane where the gradient is half of what counts as 1; boundary opacity up to 1e9, exponents 0, 1 and 10",
           invariant="min(1, Ov (retained + boundary G^exponent)), finite; G is halved where the box is twice as long")
def boundaries(row):
    for gs, ge in ((0, 1), (1, 0), (1, 10), (1e9, 0), (1e9, 10)):
        alpha = min(OV * (0.3 + gs * 0.5**ge), 1)
        got = row.middle(scene=boundary(gs, ge))
        row.count("wrong numbers", wrong_numbers([got]), case=f"{gs} {ge}")
        row.measure("A differs by", abs(got[3] - alpha), at_most=FLOOR, case=f"{gs} {ge}")
    for size in (0.5, 2):
        row.measure("A in longer boxes differs by",
                    abs(row.middle(scene=boundary(1, 1, size))[3] - OV * (0.3 + min(0.5 / size, 1e9))), at_most=FLOOR, case=size)
    row.measure("by the data's own unit it differs by",
                worst([row.middle(scene=boundary(1, 1, 1, False))], [row.middle(scene=boundary(1, 1, 7, False))]), at_most=FLOOR)


def edge(threshold, back=False):
    data = voxels(1, (1, 1, 16), (17 * i if back else 255 - 17 * i for i in range(16)))
    return plane(f"EdgeEnhancementVolumeStyle {{ gradientThreshold {threshold} edgeColor 1 0 0 1 }}", data=data)


@suite.row("F47", "edges: thresholds of angles", scene=edge(0.4),
           shows="a plane seen from near, thresholds 0, 0.4 and pi/2; from its inner side",
           invariant="the standard's formula, whose step at the threshold t is 1 - cos t, from both sides; at 0 there is none")
def edges(row):
    for threshold, back in ((0, False), (0.4, False), (0.4, True), (1.5707964, False)):
        p = pixels_of(row.picture(scene=edge(threshold, back), size=f"{SIDE}x{SIDE}"))
        row.count("wrong numbers", wrong_numbers(p), case=threshold)
        shares = [0 if c >= math.cos(threshold) else 1 - c for c in cosines()]
        expected = [premultiplied([t + share * (e - t) for t, e in zip(TINT, (1, 0, 0))], OV) for share in shares]
        row.measure("colours differ by", worst(p, expected), at_most=FLOOR, case=f"{threshold} {back}")


# ---- F48 and F49: shadows, segments, switches

WHITE = "OpacityMapVolumeStyle { transferFunction PixelTexture { image 1 1 4 0xFFFFFF80 } }"
SHADED = "ShadedVolumeStyle { lighting TRUE shadows TRUE }"
SIGMA = -math.log(1 - 128 / 255) / 0.5
SLAB = volume(constant(128, (4, 4, 4)), f"ComposedVolumeStyle {{ renderStyle [ {WHITE} {SHADED} ] }}",
              fields="opacityUnitDistance .5")
LAMPS = {"front": ("0 0 -1", 0.5 * (1 - math.exp(-2 * SIGMA))), "back": ("0 0 1", SIGMA * math.exp(-SIGMA)),
         "side": ("0 -1 0", math.exp(-SIGMA / 2) * (1 - math.exp(-SIGMA)))}
LOOKS_DOWN = "Viewpoint { position 0 0 0 orientation 1 0 0 -1.5707963 fieldOfView .1 nearDistance 1e-4 }\n"


def lamp(direction):
    return f"DirectionalLight {{ direction {direction} global TRUE }}\n"


def plate(thin):
    """A floor below the eye, and above it a plate of less than a fifth of a voxel, seen by the light alone."""
    rows = [255 if i < 8 else 140 if thin and i == 26 else 0 for i in range(32)]
    return scene(LOOKS_DOWN, NO_HEADLIGHT, lamp("0 -1 0"),
                 f"IsoSurfaceVolumeData {{ surfaceValues [ .5 ] voxels {voxels(1, (1, 32, 1), rows)} "
                 f"renderStyle [ ComposedVolumeStyle {{ renderStyle [ {WHITE} {SHADED} ] }} ] }}\n")


def ball(shadows):
    lit = f"ShadedVolumeStyle {{ lighting TRUE shadows {shadows} material Material {{ diffuseColor 1 1 1 ambientIntensity 0 }} }}"
    return scene(WHOLE, NO_HEADLIGHT, lamp("-1 -1 -1"), "IsoSurfaceVolumeData { surfaceValues [ .6 ] valueRange 0 255 voxels ",
                 image3d("F48-ball.nrrd"), f" renderStyle [ {lit} ] effects [ {OPAQUE} ] }}\n")


@suite.row("F48", "shadows of volumes", scene=scene(WHOLE, NO_HEADLIGHT, lamp("0 0 -1"), SLAB),
           files={"F48-ball.nrrd": BALL.nrrd()},
           shows="a homogeneous slab lit from before it, from behind, from the side; a ball; a plate thinner than a step",
           invariant="the three closed forms; no ball shadows itself where light meets it; every surface casts its shadow")
def shadows(row):
    for name, (direction, expected) in LAMPS.items():
        got = row.middle("--step", "0.1", scene=scene(WHOLE, NO_HEADLIGHT, lamp(direction), SLAB))
        row.measure("light in slabs differs by", max(abs(c - expected) for c in got[:3]), at_most=2e-4, case=name)
    bare, shadowed = (pixels_of(row.picture(scene=ball(s), size="48x48")) for s in ("FALSE", "TRUE"))
    row.count("pixels of the lit side in shadow", sum(a[0] > 0.2 and b != a for a, b in zip(bare, shadowed)))
    row.measure("pixels of the lit side", sum(a[0] > 0.2 for a in bare), at_least=200)
    a = 128 / 255
    for thin in (True, False):
        got = row.middle(scene=plate(thin))
        expected = premultiplied([(1 - a) ** 2 if thin else 1] * 3, a)
        row.measure("light under plates differs by", worst([got], [expected]), at_most=1e-5, case="thin" if thin else "none")


LABELS = [0, 1, 2, 1]
RED = "OpacityMapVolumeStyle { transferFunction PixelTexture { image 1 1 4 0xFF000080 } }"
SHADE_ALL = "ToneMappedVolumeStyle { } EdgeEnhancementVolumeStyle { } CartoonVolumeStyle { }"


def segments(styles, enabled="TRUE TRUE TRUE"):
    return scene(WHOLE, NO_HEADLIGHT, LIGHT, "SegmentedVolumeData { opacityUnitDistance 1 "
                 f"voxels {voxels(1, (4, 2, 2), range(20, 180, 10))} "
                 f"segmentIdentifiers {voxels(1, (4, 2, 2), LABELS * 4)} segmentEnabled [ {enabled} ] "
                 f"renderStyle [ {styles} ] }}\n")


def composed(*styles):
    return f"ComposedVolumeStyle {{ renderStyle [ {' '.join(styles)} ] }}"


def off(style):
    return style.replace("{", "{ enabled FALSE", 1)


def programs(row, text):
    """The texts of all programs of a scene."""
    folder = row.suite.new_folder()
    row.suite.command("dump", "scene.x3dv", "-d", "out", files={"scene.x3dv": text}, folder=folder, status=None)
    out = os.path.join(folder, "out")
    found = {}
    for name in sorted(os.listdir(out)):
        if not name.endswith(".map"):
            with open(os.path.join(out, name), encoding="utf-8") as file:
                found[name] = file.read()
    return found


EDGE = "EdgeEnhancementVolumeStyle { edgeColor 0 1 0 1 }"


@suite.row("F49", "styles outside of their segments, or disabled and yet there",
           scene=segments(f"{RED} {composed(EDGE, 'CartoonVolumeStyle { }')} {RED}", "TRUE FALSE TRUE"),
           shows="four columns of three segments; styles and segments switched off; a blend without its table",
           invariant="what is off is as if it were not there, in the picture and in the program; styles stay in their segments")
def switches(row):
    own = composed(EDGE, "CartoonVolumeStyle { }")
    hidden = pixels_of(row.picture(size="16x16"))
    row.count("pixels of a hidden segment", sum(c[3] > 0 for i, c in enumerate(hidden) if LABELS[i % 16 // 4] == 1))
    for name, options in row.methods():
        shown, without = (pixels_of(row.picture("--step", "0.5", *options, scene=segments(f"{RED} {s} {RED}"), size="16x16"))
                          for s in (own, RED))
        row.count("pixels of other segments that a style changes",
                  sum(worst([a], [b]) > 1e-6 for i, (a, b) in enumerate(zip(shown, without)) if LABELS[i % 16 // 4] != 1),
                  case=name)  # with styles another method may draw them
        row.measure("pixels of its own that it changes", sum(a != b for a, b in zip(shown, without)), at_least=64, case=name)
    a, b = (pixels_of(row.picture(scene=segments(f"{RED} {s} {RED}", e), size="16x16"))
            for s, e in ((off(own), "TRUE TRUE TRUE"), (own, "TRUE FALSE TRUE")))
    row.measure("a disabled style and a hidden segment differ by", worst(a, b), at_most=0)
    box = voxels(1, (4, 2, 2), range(20, 180, 10))
    for style in (EDGE, "ShadedVolumeStyle { lighting TRUE }", "SilhouetteEnhancementVolumeStyle { }"):
        disabled, absent = (scene(WHOLE, LIGHT, volume(box, composed(RED, *more))) for more in ((off(style),), ()))
        row.count("programs that a disabled style changes",
                  sum(programs(row, disabled).get(n) != t for n, t in programs(row, absent).items()), case=style[:10])
    table, alpha = (row.middle(scene=scene(WHOLE, volume(box, composed(RED, "BlendedVolumeStyle { weightFunction1 \""
                                                         + f + "\" voxels " + constant(50) + " }"))))
                    for f in ("TABLE", "ALPHA0"))
    row.measure("a blend without its table differs by", worst([table], [alpha]), at_most=0)


suite.main(__name__)
