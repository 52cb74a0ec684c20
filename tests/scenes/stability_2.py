#!/usr/bin/env python3
"""F18 to F28: rays, boxes, transforms. stability_2.py PLUGRAY [ROW...]"""

import math

from harness import box_interval, over, premultiplied, rotate, unit
from scenes import NO_HEADLIGHT, constant, effect, front_scene, quad, scene, volume, voxels
from stability_data import Stability, parallel_rays, perspective_rays, pixels_of, worst, wrong_numbers

suite = Stability()
AS_ASKED = "with an error of 1/255 asked for, colours are wrong by"
FLOOR = 2e-6  # of 32-bit floats over some hundred steps

# Where a ray enters and leaves, as colours of float pictures: length, entry, exit, 1.
CHORD = effect("""float from, to;
void PLUG_volume_ray(inout float t_enter, inout float t_exit, const in vec3 origin_eye, const in vec3 direction_eye) {
    from = t_enter;
    to = t_exit;
}
void PLUG_volume_ray_end(inout vec4 accumulated, inout float depth) {
    accumulated = from < to ? vec4(to - from, from, to, 1.0) : vec4(0.0);
}""")


def ortho(half, z=10, fields=""):
    return f"OrthoViewpoint {{ position 0 0 {z} fieldOfView {-half} {-half} {half} {half} {fields} }}\n"


def moved(content, fields):
    return f"Transform {{ {fields} children [\n{content}] }}\n"


def chord(ray, size=(1, 1, 1)):
    enter, leave = box_interval(*ray, size)
    return leave - enter


# ---- F18 to F21: boxes


FACES = volume(constant(1), effects=CHORD, dimensions=(1.125, 1.125, 1.125))


@suite.row("F18", "0 times infinity in the slab test", scene=scene(ortho(1), NO_HEADLIGHT, FACES),
           shows="rays along an axis, some exactly in faces and edges of the box, from before it, from its faces, mirrored",
           invariant="of each pair of faces one belongs to the box, the other does not; nothing is NaN")
def on_faces(row):
    """Pixel centres are odd multiples of 1/16, faces at 9/16."""
    def see(eye, content):
        return row.picture(scene=scene(eye, NO_HEADLIGHT, content))
    for z, length in ((10, 1.125), (0.5625, 1.125), (0, 0.5625), (-0.5625, 0)):
        for name, scale in (("", (1, 1)), ("mirrored", (-1, 1)), ("turned over", (-1, -1))):
            p = see(ortho(1, z), moved(FACES, f"scale {scale[0]} {scale[1]} 1"))
            first = [3 if s > 0 else 4 for s in (scale[0], -scale[1])]  # low x is left, low y is below
            wrong = 0
            for y in range(16):
                for x in range(16):
                    inside = all(f <= c < f + 9 for c, f in zip((x, y), first))
                    wrong += abs(p.at(x, y)[0] - (length if inside else 0)) > 1e-6
            row.count("pixels that are not as of a half-open box", wrong, case=f"eye at {z} {name}")
            row.count("NaN or negative", sum(not v >= (-0.6 if i % 4 == 1 else 0) for i, v in enumerate(p.values)),
                      case=f"eye at {z} {name}")
    eyes = [(0.5625, 0, 0, 0), (0.5625, 0.5625, 0, 0), (-0.5625, 0.5625, 0.5625, 0), (0, -0.5625, 0, 0.3)]
    for x, y, z, turn in eyes:
        view = f"Viewpoint {{ position {x} {y} {z} orientation 1 0 0 {turn} fieldOfView 1.2 }}\n"
        p = row.picture(scene=scene(view, NO_HEADLIGHT, FACES), size="17x17")
        rays = list(perspective_rays((17, 17), math.tan(0.6), (x, y, z), (1, 0, 0), turn))
        error = max(abs(c[0] - chord(r, (1.125,) * 3)) for c, r in zip(pixels_of(p), rays)
                    if all(abs(d) > 1e-9 for d in r[1]))
        row.measure("from eyes on faces, edges and a corner, lengths differ by", error, at_most=1e-6, case=f"{x} {y} {z}")


LONG = (1, 1, 1000)
SLIGHT = "rotation 0 1 0 1e-5"


@suite.row("F19", "small components replaced", scene=scene(
               "OrthoViewpoint { position 0.5 0 600 fieldOfView -.016 -.016 .016 .016 }\n", NO_HEADLIGHT,
               moved(volume(constant(1), effects=CHORD, dimensions=LONG), SLIGHT)),
           shows="a box of 1 x 1 x 1000 along rays that are 1e-5 oblique, at its side",
           invariant="lengths are those of the true direction")
def slight_angles(row):
    rays = []
    for x in range(64):
        place = (0.5 + 0.016 * ((x + 0.5) / 32 - 1), 0.0, 600.0)
        rays.append((rotate((0, 1, 0), -1e-5, place), rotate((0, 1, 0), -1e-5, (0, 0, -1))))
    p = row.picture(size="64x64")
    through, beside, kinds = 0.0, 0.0, set()
    for x, ray in enumerate(rays):
        got = p.at(x, 32)[0]
        low, high = (chord(ray, (1 + e, 1, 1000)) for e in (-3e-7, 3e-7))
        whole = min(low, high) > 999.9
        kinds.add(whole or (max(low, high) > 0) * 2)
        error = max(low - got, got - high, 0.0) / 1000
        through, beside = (max(through, error), beside) if whole else (through, max(beside, error))
    row.measure("kinds of rays (through, into the side, past it)", len(kinds), at_least=3)
    row.measure("error of lengths through, of the whole", through, at_most=1e-6)
    row.measure("error of lengths into the side, beyond those of a side moved by 1.5e-7", beside, at_most=1e-6)


HAZE = volume(constant(100), fields="opacityUnitDistance 1")
SIDES = ((0, 1, 0, 0), (0, 1, 0, math.pi), (0, 1, 0, math.pi / 2), (0, 1, 0, -math.pi / 2), (1, 0, 0, math.pi / 2),
         (1, 0, 0, -math.pi / 2))
INSIDE = (0.1, -0.2, 0.3)


def eye_inside(turn):
    return (f"Viewpoint {{ position {' '.join(map(str, INSIDE))} orientation {' '.join(map(repr, turn))} "
            "fieldOfView 1.5 }\n")


@suite.row("F20", "nothing from inside", scene=scene(*map(eye_inside, SIDES), NO_HEADLIGHT, HAZE),
           shows="an eye in a constant volume, looking six ways",
           invariant="each ray has the opacity of the way out")
def inside(row):
    for number, turn in enumerate(SIDES, 1):
        exact = [1 - (1 - 100 / 255) ** chord(r) for r in perspective_rays((8, 8), math.tan(0.75), INSIDE, turn[:3], turn[3])]
        for name, options in row.methods() if number == 1 else row.methods()[:1]:
            p = row.picture("--viewpoint", number, "--step", 0.3, *options, size="8x8")
            row.measure("A differs by", max(abs(c[3] - a) for c, a in zip(pixels_of(p), exact)), at_most=2e-6,
                        case=f"{name}, way {number}")
        if number == 1:
            for asked, options in row.planned():
                got = pixels_of(row.picture("--viewpoint", number, *options, size="8x8"))
                row.measure(AS_ASKED, max(abs(c[3] - a) for c, a in zip(got, exact)), at_most=asked)


OBLIQUE = (0.3, 0.4, 1.6), (1, -1, 0.2), 0.25


def cut_view(near):
    position, axis, angle = OBLIQUE
    return (f"Viewpoint {{ position {' '.join(map(str, position))} orientation {' '.join(map(str, axis))} {angle} "
            f"fieldOfView .8 nearDistance {near} }}\n")


@suite.row("F21", "the near plane clips faces of the box", scene=scene(cut_view(1.5), NO_HEADLIGHT, HAZE),
           shows="near planes that run obliquely through a constant volume, perspective",
           invariant="each ray has the opacity of what lies behind the plane")
def near_planes(row):
    position, axis, angle = OBLIQUE
    rays = list(perspective_rays((16, 16), math.tan(0.4), position, axis, angle))
    ahead = rotate(axis, angle, (0, 0, -1))
    for near in (0.001, 1.05, 1.2, 1.5, 1.9):
        exact = []
        for origin, direction in rays:
            enter, leave = box_interval(origin, direction)
            enter = max(enter, near / sum(a * b for a, b in zip(ahead, direction)))
            exact.append(1 - (1 - 100 / 255) ** max(leave - enter, 0))
        for name, options in row.methods() if near == 1.5 else row.methods()[:1]:
            p = row.picture("--step", 0.3, *options, scene=scene(cut_view(near), NO_HEADLIGHT, HAZE))
            row.measure("A differs by", max(abs(c[3] - a) for c, a in zip(pixels_of(p), exact)), at_most=2e-6,
                        case=f"{name}, near {near}")


# ---- F22 to F26: transforms


def asymmetric(flip=lambda i, j, k: (i, j, k), n=4):
    def value(i, j, k):
        return 20 + (i * 31 + j * 53 + k * 71 + i * j * 17 + k * k * i) % 200
    return voxels(1, (n, n, n), [value(*flip(i, j, k)) for k in range(n) for j in range(n) for i in range(n)])


SHADED = "ShadedVolumeStyle { lighting TRUE material Material { specularColor .4 .4 .4 } }"
LIT = "DirectionalLight { direction 0 -1 -2 global TRUE }\n"  # in the plane of the mirror


@suite.row("F22", "mirrored transforms", scene=scene(
               ortho(0.75), NO_HEADLIGHT, LIT, moved(volume(asymmetric(), SHADED), "scale -1 1 1")),
           shows="lit voxels of no symmetry under a scale of -1, against voxels in mirrored order",
           invariant="a scale of -1 is the flipped picture, to the bit, and that of the mirrored data")
def mirrored(row):
    other = scene(ortho(0.75), NO_HEADLIGHT, LIT, volume(asymmetric(lambda i, j, k: (3 - i, j, k)), SHADED))
    plain = scene(ortho(0.75), NO_HEADLIGHT, LIT, volume(asymmetric(), SHADED))
    for name, options in row.methods():
        p, q, r = (row.picture("--step", 0.25, *options, scene=s) for s in (row.text, other, plain))
        flipped = [r.at(15 - x, y) for y in range(16) for x in range(16)]
        row.measure("unlike mirrored data by", worst(p, q), at_most=1e-6, case=name)
        row.count("pixels unlike those of the flipped picture", sum(a != b for a, b in zip(pixels_of(p), flipped)), case=name)
        row.measure("something is seen", sum(c[3] > 0.1 for c in pixels_of(p)), at_least=100, case=name)


def shear(amount):
    """Transform fields outer, inner of x' = x + amount y, by a singular value decomposition in the plane."""
    a, b, c, d = 1.0, amount, 0.0, 1.0
    e, f, g, h = (a + d) / 2, (a - d) / 2, (c + b) / 2, (c - b) / 2
    q, r = math.hypot(e, h), math.hypot(f, g)
    one, two = math.atan2(g, f), math.atan2(h, e)
    theta, phi = (two - one) / 2, (two + one) / 2
    return f"rotation 0 0 1 {phi!r} scale {q + r!r} {q - r!r} 1", f"rotation 0 0 1 {theta!r}"


NORMAL = effect("void PLUG_volume_shade(inout vec4 color, const in VolumeSample s) "
                "{ color = vec4(0.5 * s.normal_eye + 0.5, 1.0); }")
RAMP = voxels(1, (4, 4, 4), [20 + 10 * i + 16 * j + 5 * k for k in range(4) for j in range(4) for i in range(4)])
CORE = "cropMin .375 .375 .375 cropMax .625 .625 .625"
TURN = (0.2, 1, 0.4), 0.7


def turn_fields(turn=TURN):
    return f"rotation {' '.join(map(str, turn[0]))} {turn[1]}"


def sheared(content):
    outer, inner = shear(0.5)
    return moved(moved(moved(content, inner), outer), turn_fields())


@suite.row("F23", "shear: normals by the wrong matrix, lengths by the wrong unit", scene=scene(
               ortho(0.75), NO_HEADLIGHT, sheared(volume(RAMP, effects=NORMAL, fields=CORE))),
           shows="a ramp under a shear of 0.5 and a turn, and a constant volume in its place",
           invariant="normals go by the inverse transpose; opacity by the length in the volume's own coordinates")
def shears(row):
    gradient = (10.0, 16.0, 5.0)
    normal = unit(rotate(*TURN, (-gradient[0], 0.5 * gradient[0] - gradient[1], -gradient[2])))
    p = row.picture("--step", 0.25, size="17x17")
    seen = [c for c in pixels_of(p) if c[3] > 0.999]
    row.measure("pixels of the core", len(seen), at_least=8)
    row.measure("normals differ by", max(abs(2 * c[i] - 1 - normal[i]) for c in seen for i in range(3)), at_most=1e-5)
    body = row.changed((f"effects [ {NORMAL} ]", ""), (CORE, "opacityUnitDistance .5"), (RAMP, constant(100)))
    exact = []
    for origin, direction in parallel_rays((16, 16), (0.75, 0.75)):
        origin, direction = (rotate(TURN[0], -TURN[1], v) for v in (origin, direction))
        own = [(x - 0.5 * y, y, z) for x, y, z in (origin, direction)]  # of the sheared box
        length = math.sqrt(sum(d * d for d in own[1]))
        exact.append(1 - (1 - 100 / 255) ** (2 * chord(own) * length))
    for name, options in row.methods():
        q = row.picture("--step", 0.3, *options, scene=body)
        row.measure("A differs by", max(abs(c[3] - a) for c, a in zip(pixels_of(q), exact)), at_most=4e-6, case=name)


FLAT = (("scale 1 1 0", "", "a scale of 0 along the view"), ("scale 0 0 0", "", "a scale of 0"), ("scale 1 0 1", "", "a scale of 0 across"),
        ("scale 1e-30 1 1", "", "a scale of 1e-30"), ("", "dimensions 1 1 0", "a dimension of 0"),
        ("", "dimensions 1 -1 1", "a negative dimension"), ("scale 1e30 1e30 1e30", "", "a scale of 1e30"))


@suite.row("F24", "singular transforms and empty boxes", scene=front_scene(
               moved(volume(constant(200)), "scale 1 1 0"), moved(HAZE, "scale .5 .5 .5")),
           shows="scales and dimensions of zero, below zero, too small and too large, beside a volume that is fine",
           invariant="it is left out or drawn as documented, with a message; nothing is NaN, the other volume is drawn")
def singular(row):
    alone = row.picture(scene=front_scene(moved(HAZE, "scale .5 .5 .5")))
    for fields, size, name in FLAT:
        content = volume(constant(200), fields=size).replace("dimensions 1 1 1\n", "" if size else "dimensions 1 1 1\n")
        text = front_scene(moved(content, fields), moved(HAZE, "scale .5 .5 .5"))
        result = row.render("-o", "p.npy", scene=text, status=None)
        row.measure("messages", len(result.messages()), at_least=1, case=name, details=[result.errors])
        row.count("crashes", result.status not in (0, 1), case=name, details=[result.errors])
        p = row.picture(scene=text, status=None)
        row.count("wrong numbers", wrong_numbers(p), case=name)
        row.count("numbers of the other volume that change", sum(a != b for a, b in zip(p.values, alone.values)), case=name)


# A sheet in a ramp between the centres of two voxels: a triangle of extinction over 1/8 of it.
SHEET_TEXELS = [0] * 17
SHEET_TEXELS[9] = 90
SHEET = ("OpacityMapVolumeStyle { transferFunction PixelTexture { image 17 1 2 "
         + " ".join(hex(0xFF00 + a) for a in SHEET_TEXELS) + " } }")


def sheet_along(axis, size):
    shape = [1, 1, 1]
    shape[axis] = 2
    low, high = ["0"] * 3, ["1"] * 3
    low[axis], high[axis] = ".25", ".75"
    reference = size[axis] / 16
    return volume(voxels(1, shape, (0, 255)), SHEET, dimensions=size,
                  fields=f"cropMin {' '.join(low)} cropMax {' '.join(high)} opacityUnitDistance {reference}")


WAYS = (("rotation 0 1 0 1.5707963267948966", 0), ("rotation 1 0 0 1.5707963267948966", 1), ("", 2))


@suite.row("F25", "boxes 1000 times as long as wide", scene=scene(
               ortho(0.4, 600), NO_HEADLIGHT, moved(sheet_along(0, (1, 1, 1000)), WAYS[0][0])),
           shows="a thin sheet across each axis of a box of 1 x 1 x 1000",
           invariant="the sheet is seen as it is along each axis")
def anisotropic(row):
    a = 90 / 255
    depth = 2 * ((1 - a) * math.log1p(-a) + a) / a  # of -ln(1 - alpha) over both sides of the triangle, in texels
    for turn, axis in WAYS:
        text = scene(ortho(0.4, 600), NO_HEADLIGHT, moved(sheet_along(axis, (1, 1, 1000)), turn))
        length = (1, 1, 1000)[axis]
        exact = -math.expm1(-depth * (length / 2 / 16) / (length / 16))
        mean = (1000 / 2) ** (1 / 3)  # a voxel's sides
        for name, options in row.methods():
            got = row.middle("--step", length / 2 / 16 / 16 / mean, *options, scene=text)
            row.measure("with 16 steps a texel, A differs by", abs(got[3] - exact), at_most=1 / 255, case=f"{name}, axis {axis}",
                        details=[got, exact])
        for asked, options in row.planned():
            got = row.middle(*options, scene=text)
            row.measure(AS_ASKED, abs(got[3] - exact), at_most=asked, case=f"axis {axis}")


FAR_BOX = moved(volume(asymmetric(), fields="opacityUnitDistance .5"), turn_fields())
PERSPECTIVE = "Viewpoint { position 0 0 3 fieldOfView .5 }\n"


@suite.row("F26", "far from the origin, tiny and huge", scene=scene(
               NO_HEADLIGHT, moved(PERSPECTIVE + FAR_BOX, "translation 1234567 -7654321 1000003")),
           shows="eye and volume moved together up to 8e6 box sizes away; a millionth and a million times as large; "
                 "the eye up to 1e5 box sizes from the volume",
           invariant="the picture stays as it is")
def far_away(row):
    here = scene(NO_HEADLIGHT, PERSPECTIVE + FAR_BOX)
    for name, options in row.methods():
        a = row.picture("--step", 1 / 64, *options, scene=here)
        b = row.picture("--step", 1 / 64, *options)
        row.measure("moving all by 8e6 changes colours by", worst(a, b), at_most=1e-4, case=name)
    first = row.picture("--step", 0.5, scene=here)
    for way in ("translation 100 -200 300", "translation 1e5 3e5 -2e5", "scale 1e-6 1e-6 1e-6", "scale 1e6 1e6 1e6"):
        p = row.picture("--step", 0.5, scene=scene(NO_HEADLIGHT, moved(PERSPECTIVE + FAR_BOX, way)))
        row.measure("moving and scaling all changes colours by", worst(first, p), at_most=1e-4, case=way)
    box = volume(asymmetric(), fields="opacityUnitDistance .5")
    near = row.picture("--step", 0.5, scene=scene(ortho(0.75, 2), NO_HEADLIGHT, moved(box, turn_fields())))
    for distance in (100, 1e5):
        p = row.picture("--step", 0.5, scene=scene(ortho(0.75, distance), NO_HEADLIGHT, moved(box, turn_fields())))
        row.measure("moving a parallel eye away changes colours by", worst(near, p), at_most=1e-4, case=f"{distance:g}")
    angle = 2 * math.atan(0.75e-5)
    p = row.picture("--step", 0.5, scene=scene(f"Viewpoint {{ position 0 0 1e5 fieldOfView {angle!r} }}\n", NO_HEADLIGHT,
                                               moved(box, turn_fields())))
    row.measure("a telescope differs from a parallel eye by", worst(near, p), at_most=2e-4)


# ---- F27, F28: neighbours


def half(z, depth, fields="opacityUnitDistance .3"):
    return moved(volume(constant(90), dimensions=(1, 1, depth), fields=fields), f"translation 0 0 {z}")


ABUTTING = half(-0.3, 0.4) + half(0.2, 0.6)
LOOK = "Viewpoint { position 0.2 0.1 2 fieldOfView .8 }\n"


@suite.row("F27", "cracks between boxes", scene=scene(LOOK, NO_HEADLIGHT, moved(ABUTTING, "rotation 1 2 0 .9")),
           shows="two boxes that share a face against one, turned, and with the face along the view",
           invariant="two boxes are one: no gap, nothing counted twice")
def abutting(row):
    for turn in ("rotation 1 2 0 .9", "rotation 0 1 0 1.5707963267948966", "rotation 1 0 0 1.5"):
        for view in (LOOK, ortho(1)):
            two = scene(view, NO_HEADLIGHT, moved(ABUTTING, turn))
            one = scene(view, NO_HEADLIGHT, moved(half(0, 1), turn))
            for name, options in row.methods() if view == LOOK else row.methods()[:1]:
                p, q = (row.picture("--step", 0.4, *options, size="64x64", scene=s) for s in (two, one))
                case = f"{name}, {turn}, {view.split(' ')[0]}"
                row.measure("colours differ by", worst(p, q), at_most=4e-6, case=case)
                row.count("gaps", sum(a[3] == 0 and b[3] > 1e-3 for a, b in zip(pixels_of(p), pixels_of(q))), case=case)
    # a shared face that the rays of a column of pixels run in: at x = 5/64
    def beside(low, high):
        return moved(volume(constant(90), dimensions=(high - low, 1, 1), fields="opacityUnitDistance .3"),
                     f"translation {(low + high) / 2} 0 0")
    p = row.picture("--step", 0.4, size="64x64", scene=front_scene(beside(-0.5, 5 / 64), beside(5 / 64, 0.5)))
    q = row.picture("--step", 0.4, size="64x64", scene=front_scene(beside(-0.5, 0.5)))
    row.measure("along rays in the face, colours differ by", worst(p, q), at_most=FLOOR)


WALL = quad("UnlitMaterial { emissiveColor 1 0 0 }")
GLASS = quad("UnlitMaterial { emissiveColor 0 1 0 transparency .5 }")
EYE = "Viewpoint { position 0.2 -0.1 3 orientation 1 1 0 .02 fieldOfView .5 }\n"
RAYS = (0.2, -0.1, 3), (1, 1, 0), 0.02
# Specks that stretch the range of depths: 0.05 before the eye, and 5000 behind.
SPECKS = (moved(WALL, "translation 0.2 -0.1 2.95 scale 1e-6 1e-6 1") + moved(WALL, "translation 0 0 -5000"))


def plane_scene(z, sheet=WALL, fields="opacityUnitDistance 1", head="", rest=SPECKS, turn="", effects=""):
    box = volume(constant(100, (64, 64, 64)) if effects else constant(100), effects=effects, fields=fields)
    return scene(EYE, NO_HEADLIGHT, head, box, moved(sheet, f"translation 0 0 {z} {turn} scale 4 4 1"), rest)


@suite.row("F28", "depth of opaque things", scene=plane_scene(0.1),
           shows="an opaque and a translucent plane in, behind, before a constant volume, and in its faces; depths from 0.05 to 5000",
           invariant="rays end on the surface, within 1/10 of a voxel of a volume of 64 voxels a side")
def depth(row):
    rays = list(perspective_rays((16, 16), math.tan(0.25), *RAYS))
    for z, turn in ((0.1, ""), (0.1, "rotation 0 1 0 .8"), (-0.7, ""), (0.5, ""), (-0.5, ""), (0.8, "")):
        lengths, kinds = [], []
        angle = 0.8 if turn else 0.0
        normal = rotate((0, 1, 0), angle, (0, 0, 1))
        for origin, direction in rays:
            enter, leave = box_interval(origin, direction)
            t = ((z - origin[2]) * normal[2] - origin[0] * normal[0]) / sum(a * b for a, b in zip(normal, direction))
            place = [o + t * d for o, d in zip(origin, direction)]
            hit = max(abs(rotate((0, 1, 0), -angle, (place[0], place[1], place[2] - z))[i]) for i in (0, 1)) < 1.999
            kinds.append(hit)
            lengths.append(max(min(leave, t) - enter, 0.0) if hit else max(leave - enter, 0.0))
        p = row.picture("--step", 0.3, scene=plane_scene(z, turn=turn, effects=CHORD))
        errors = [abs(c[0] - length) * 64 for c, length, hit in zip(pixels_of(p), lengths, kinds) if hit]
        # where the ray misses the volume, the effect's picture is what is behind: the wall's red
        row.measure("pixels that hit the plane", len(errors), at_least=100, case=f"{z} {turn}")
        seen = [e for e, c, length in zip(errors, [c for c, h in zip(pixels_of(p), kinds) if h],
                                          [n for n, h in zip(lengths, kinds) if h]) if length > 0]
        if seen:
            row.measure("lengths are wrong by, in voxels", max(seen), at_most=0.1, case=f"{z} {turn}")
        for name, options in row.methods():
            q = row.picture("--step", 0.3, *options, scene=plane_scene(z, turn=turn))
            color = [over(premultiplied((100 / 255,) * 3, 1 - (1 - 100 / 255) ** n), (1, 0, 0, 1))
                     for n, hit in zip(lengths, kinds) if hit]
            row.measure("colours are wrong by", worst([c for c, hit in zip(pixels_of(q), kinds) if hit], color), at_most=1e-3,
                        case=f"{name} {z} {turn}")
    alone = row.picture("--step", 0.3, scene=plane_scene(0.1, GLASS))
    exact = []
    for origin, direction in rays:
        enter, leave = box_interval(origin, direction)
        t = (0.1 - origin[2]) / direction[2]
        parts = [max(min(max(b, enter), leave) - min(max(a, enter), leave), 0.0) for a, b in ((enter, t), (t, leave))]
        colors = [premultiplied((100 / 255,) * 3, 1 - (1 - 100 / 255) ** n) for n in parts]
        exact.append(over(colors[0], over(premultiplied((0, 1, 0), 0.5), colors[1])))
    row.measure("with glass inside, colours are wrong by", worst(pixels_of(alone), exact), at_most=1e-3)


suite.main(__name__)
