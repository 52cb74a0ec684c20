#!/usr/bin/env python3
"""F50 to F55: acceleration and drivers. stability_5.py PLUGRAY [ROW...]"""

import os
import random

from crossings import Field, View, cell_roots, noise
from harness import Picture, load_json, opacity, premultiplied
from scenes import NO_HEADLIGHT, constant, effect, scene, volume, voxels
from stability_data import Stability, pixels_of, worst, wrong_numbers
from stability_3 import LIGHT, WHOLE, image3d, nrrd, scattered, view
from stability_4 import COUNT, count_of

suite = Stability()
FLOOR = 2e-6


def differing(a, b):
    """How many numbers of two pictures are not the same."""
    return sum(x != y for x, y in zip(a.values, b.values)) + abs(len(a.values) - len(b.values))


def turned(text, axis="0 1 0", angle=0.0):
    return f"Transform {{ rotation {axis} {angle!r} children [\n{text}] }}\n"


OBLIQUE = ("1 2 3", 0.7)

# ---- F50 and F51: empty space


def spots():
    """Single voxels far from each other, at each position in blocks of 8 along each axis."""
    values = [0] * (80 * 16 * 16)
    for k in range(8):
        x, y, z = 9 * k + 4, 4 + (3 * k) % 8, 4 + (5 * k + 2) % 8
        values[(z * 16 + y) * 80 + x] = 255 - 9 * k
    return nrrd("uint8", "B", (80, 16, 16), values)


def peak(low, high):
    """Clear but for values around the middle of low .. high, of 255."""
    texels = [0x00 if not low <= 17 * i <= high else 0x80 for i in range(16)]
    return ("OpacityMapVolumeStyle { transferFunction PixelTexture { image 16 1 4 "
            + " ".join(f"0xFF8040{t:02X}" for t in texels) + " } }")


SMOOTH = nrrd("uint8", "B", (20, 20, 20), (min(255, (x - 9) ** 2 + (y - 11) ** 2 + (z - 8) ** 2)
                                           for z in range(20) for y in range(20) for x in range(20)))
FILES_50 = {"F50-spots.nrrd": spots(), "F50-smooth.nrrd": SMOOTH}


def spotted(turn=OBLIQUE):
    long = volume(image3d("F50-spots.nrrd"), dimensions=(2, 0.4, 0.4))
    return scene(view(1.1, 1.1), NO_HEADLIGHT, turned(long, *turn))


SHELL = scene(view(0.7, 0.7), NO_HEADLIGHT, turned(volume(image3d("F50-smooth.nrrd"), peak(80, 120)), *OBLIQUE))
CORE = scene("Viewpoint { position .1 .2 1.2 }\n", NO_HEADLIGHT,
             turned(volume(image3d("F50-smooth.nrrd"), peak(0, 34)), *OBLIQUE))


@suite.row("F50", "skipping drops what is at borders of blocks", scene=spotted(), files=FILES_50,
           shows="single bright voxels at each position within blocks of 8; shells and cores that a transfer function shows",
           invariant="the same picture to the bit, with and without leaping over what is empty")
def skipping(row):
    ways = [(name, ("--step", "0.5", *options)) for name, options in row.methods()]
    ways += [("error", options) for _, options in row.planned()]
    cases = [("spots", row.text, *way) for way in ways] + [("straight", spotted(("0 1 0", 0.0)), *ways[0])]
    cases += [("shell", SHELL, *ways[-1]), ("core", CORE, *ways[1 % len(ways)]), ("core", CORE, *ways[2 % len(ways)])]
    leaps = 0
    for name, text, way, options in cases:
        done = row.render("-o", "p.npy", "--stats", "json", *options, scene=text, size="48x48")
        leaps += load_json(done.output)["plan"]["leaps"]
        leaping = Picture(os.path.join(done.folder, "p.npy"))
        plain = row.picture(*options, "--no-leaping", scene=text, size="48x48")
        row.count("numbers that differ", differing(leaping, plain), case=f"{name} {way}")
        row.measure("the brightest", max(c[3] for c in pixels_of(plain)), at_least=0.05, case=f"{name} {way}")
    row.measure("pictures of which parts are leapt over", leaps, at_least=2)


def sparse():
    source = random.Random(7)
    return voxels(1, (16, 16, 16), (source.randrange(128, 256) if source.random() < 0.02 else 0 for _ in range(4096)))


SPARSE = volume(sparse())
ALONG = {"faces": ("0 1 0", 0.0), "edges": ("0 1 0", 0.7853981633974483), "corners": ("1 -1 0", 0.9553166181245093)}
NOISE_51 = Field("F51-noise.nrrd", (16, 16, 16), noise(3))


class InFaces(View):
    """Sixteen rays a side that run through the centres of sixteen voxels: in the faces of cells."""

    far = 0.5

    def __init__(self):
        super().__init__((0, 1, 0), 0.0, pixels=16)


@suite.row("F51", "blocks skipped, and rays that stall, at edges", files={NOISE_51.name: NOISE_51.nrrd()},
           scene=scene(view(0.5, 0.5), NO_HEADLIGHT, SPARSE),
           shows="rays in faces, along edges and through corners of cells and blocks, of few voxels and of noise",
           invariant="every picture ends; the same with and without leaping; each crossing of a surface is counted once")
def stalls(row):
    ways = [(name, ("--step", "0.5", *options)) for name, options in row.methods()]
    for direction, turn in ALONG.items():
        text = scene(view(0.5, 0.5), NO_HEADLIGHT, turned(SPARSE, *turn))
        for way, options in ways if direction == "corners" else ways[:1]:
            a, b = (row.picture(*options, *more, scene=text, size="32x32", timeout=60) for more in ((), ("--no-leaping",)))
            row.count("numbers that differ", differing(a, b), case=f"{direction} {way}")
            row.count("wrong numbers", wrong_numbers(a), case=f"{direction} {way}")
    eye = InFaces()
    roots = cell_roots(suite.program, NOISE_51, 0.5, eye.rays())
    counts = [count_of(c[3]) for c in pixels_of(row.picture(scene=eye.scene(NOISE_51, 0.5, COUNT), size=eye.size))]
    row.count("rays with more or fewer crossings",
              sum(n != roots[8 * i + 7] for i, n in enumerate(counts) if roots[8 * i + 7] >= 0))


# ---- F52 and F53: what is left of earlier pictures

MAPS = ("DEF NARROW OpacityMapVolumeStyle { transferFunction PixelTexture { image 4 1 4 0 0 0xFF0000C0 0 } }",
        "DEF WIDE OpacityMapVolumeStyle { enabled FALSE transferFunction PixelTexture "
        "{ image 4 1 4 0x0000FF40 0x00FF0040 0x00FF0040 0xFFFFFF40 } }")
EDITS = (f"DEF V VolumeData {{ voxels {sparse()} renderStyle ComposedVolumeStyle {{ renderStyle [ {' '.join(MAPS)} ] }} }}\n"
         f"DEF I IsoSurfaceVolumeData {{ dimensions .9 .9 .9 surfaceValues [ .2 ] voxels {sparse()} "
         "renderStyle [ OpacityMapVolumeStyle { transferFunction PixelTexture { image 1 1 4 0x40FF4080 } } ] }\n"
         "DEF T TimeSensor { loop TRUE cycleInterval 4 }\n"
         "DEF ON BooleanSequencer { key [ 0 .25 .5 .75 ] keyValue [ FALSE TRUE FALSE TRUE ] }\n"
         "DEF STEP ScalarInterpolator { key [ 0 .25 .5 .75 ] keyValue [ .3 .15 .4 .2 ] }\n"
         "DEF CROP PositionInterpolator { key [ 0 .25 .5 .75 ] keyValue [ 0 0 0, .4 0 0, 0 .5 0, 0 0 .3 ] }\n"
         "ROUTE T.fraction_changed TO ON.set_fraction ROUTE T.fraction_changed TO STEP.set_fraction\n"
         "ROUTE T.fraction_changed TO CROP.set_fraction ROUTE ON.value_changed TO WIDE.set_enabled\n"
         "ROUTE STEP.value_changed TO I.contourStepSize ROUTE CROP.value_changed TO V.cropMin\n")


def frames(row, text, count, *arguments):
    """Pictures of one run, a second apart."""
    done = row.render("-o", "p.npy", "--frames", count, "--fps", "1", *arguments, scene=text, size="24x24")
    names = sorted(n for n in os.listdir(done.folder) if n.endswith(".npy"))
    return [Picture(os.path.join(done.folder, n)) for n in names]


@suite.row("F52", "stale blocks after an edit", scene=scene(view(0.6, 0.6), NO_HEADLIGHT, EDITS),
           shows="a transfer function that is clear almost everywhere and one that is not, in turns; contours and a crop box that move",
           invariant="each picture of a row is that of a program that begins there")
def edits(row):
    for name, options in row.methods():
        row_of_frames = frames(row, row.text, 4, "--step", "0.5", *options)
        row.measure("pictures", len(row_of_frames), at_least=4, case=name)
        for i, p in list(enumerate(row_of_frames))[1::2]:
            cold = row.picture("--time", i, "--step", "0.5", *options, size="24x24")
            row.count("numbers that differ", differing(p, cold), case=f"{name} {i}")
        row.measure("numbers that an edit changes", differing(*row_of_frames[:2]), at_least=100, case=name)


JUMP = ("DEF EYE OrthoViewpoint { position 0 0 10 fieldOfView -.6 -.6 .6 .6 }\n"
        "DEF T TimeSensor { loop TRUE cycleInterval 2 }\n"
        "DEF TURN OrientationInterpolator { key [ 0 .5 1 ] keyValue [ 0 1 0 0, 0 1 0 1, 0 1 0 1 ] }\n"
        "DEF B Transform { children [\n" + SPARSE + "] }\n"
        "ROUTE T.fraction_changed TO TURN.set_fraction ROUTE TURN.value_changed TO B.rotation\n")


@suite.row("F53", "ghosts of earlier pictures", scene=scene(JUMP, NO_HEADLIGHT),
           shows="the same picture drawn again and again, and one after a jump of the volume",
           invariant="nothing is accumulated over time: each picture is complete, and the same to the bit")
def ghosts(row):
    for name, options in row.methods():
        once, often = (row.picture("--repeat", n, "--step", "0.5", *options, size="24x24") for n in (1, 4))
        row.count("numbers that differ in a repeated picture", differing(once, often), case=name)
        jump = frames(row, row.text, 2, "--step", "0.5", *options)[1]
        cold = row.picture("--time", "1", "--step", "0.5", *options, size="24x24")
        row.count("numbers that differ after a jump", differing(jump, cold), case=name)


# ---- F54 and F55: other machines

MANY_STYLES = ("ComposedVolumeStyle { renderStyle [ " + peak(60, 200) + " EdgeEnhancementVolumeStyle { edgeColor 0 1 0 1 } "
               "SilhouetteEnhancementVolumeStyle { silhouetteRetainedOpacity .5 silhouetteBoundaryOpacity .4 } "
               "ShadedVolumeStyle { lighting TRUE } ] }")
CLOUD = voxels(1, (6, 5, 4), scattered((6, 5, 4)))
DRIVERS = {
    "bare": volume(CLOUD), "function": volume(CLOUD, peak(60, 200)), "styles": volume(CLOUD, MANY_STYLES),
    "surfaces": f"IsoSurfaceVolumeData {{ surfaceValues [ .3 .6 ] voxels {CLOUD} }}\n",
    "two": volume(CLOUD) + "Transform { translation .3 .2 .1 children [\n" + volume(CLOUD, peak(100, 180)) + "] }\n",
}


# Mesa 22's softpipe writes to an array at the place that the first of four pixels asks for, whatever the others do. So
# it cannot look ahead in several volumes at once. With an effect that does nothing, but may, no ray looks ahead.
WATCHER = effect("void PLUG_volume_shade(inout vec4 color, const in VolumeSample s) { color.a += 0.0; }")


@suite.row("F54", "drivers differ", scene=scene(view(0.7, 0.7), NO_HEADLIGHT, LIGHT, turned(DRIVERS["styles"], *OBLIQUE)),
           shows="a bare volume, a transfer function, four styles, surfaces, two volumes: EGL and OSMesa, Mesa's llvmpipe and softpipe",
           invariant="EGL and OSMesa draw the same to the bit, softpipe the same within 1e-3")
def drivers(row):
    for name, content in DRIVERS.items():
        text = scene(view(0.7, 0.7), NO_HEADLIGHT, LIGHT, turned(content, *OBLIQUE))
        ways = row.methods() if name == "function" else row.methods()[:1]
        for way, options in ways:
            arguments = ("--step", "0.5", *options)
            egl = row.picture(*arguments, "--backend", "egl", scene=text, size="20x20")
            osmesa = row.picture(*arguments, "--backend", "osmesa", scene=text, size="20x20")
            row.count("numbers that EGL and OSMesa draw differently", differing(egl, osmesa), case=f"{name} {way}")
        if name == "two":  # whose steps ahead are in arrays, see above
            text = text.replace("VolumeData {", f"VolumeData {{ effects [ {WATCHER} ]")
        if name in ("two", "function"):
            egl = row.picture("--step", "0.5", scene=text, size="20x20")
        os.environ["GALLIUM_DRIVER"] = "softpipe"
        try:
            soft = row.picture("--step", "0.5", scene=text, size="20x20")
        finally:
            del os.environ["GALLIUM_DRIVER"]
        row.measure("softpipe differs by", worst(egl, soft), at_most=1e-3, case=name)
    row.not_run("graphics cards")


LONG = 2049
FILES_55 = {"F55-long.nrrd": nrrd("uint8", "B", (LONG, 1, 1), [102] * LONG),
            "F55-huge.nrrd": b"NRRD0004\ntype: uint8\ndimension: 3\nsizes: 2049 2049 2049\nencoding: raw\n\n" + bytes(100),
            "F55-wide.nrrd": b"NRRD0004\ntype: uint8\ndimension: 3\nsizes: 16385 1 1\nencoding: raw\n\n" + bytes(16385)}
SAME = "SilhouetteEnhancementVolumeStyle { silhouetteRetainedOpacity 1 silhouetteBoundaryOpacity 0 }"


def beside(first):
    """A volume that may be refused, and one that is fine."""
    return scene(view(1.0, 0.5), NO_HEADLIGHT,
                 "Transform { translation -.5 0 0 children [\n", volume(image3d(first), fields="opacityUnitDistance 1"),
                 "] }\nTransform { translation .5 0 0 children [\n",
                 volume(constant(102), fields="opacityUnitDistance 1"), "] }\n")


BAD_EFFECT = effect("void PLUG_volume_shade(inout vec4 color, const in VolumeSample s) { color = nothing_of_the_kind; }")


@suite.row("F55", "limits of machines", scene=beside("F55-long.nrrd"), files=FILES_55,
           shows="2049 voxels a side, 2049^3 of which there are none, 16385 a side; 40 styles, 40 volumes; an effect that does not compile",
           invariant="what is too large is cast in parts or refused with a message; the rest is drawn; all styles count")
def limits(row):
    one = premultiplied((0.4,) * 3, 0.4)

    def draw(text, size="2x1", status=None):
        done = row.render("-o", "p.npy", scene=text, size=size, status=status)
        return done, pixels_of(Picture(os.path.join(done.folder, "p.npy")))

    done, p = draw(row.text, status=0)
    row.measure("colours of what is drawn differ by", worst(p, [one, one]), at_most=FLOOR, case="2049")
    for name in ("huge", "wide"):
        done, p = draw(beside(f"F55-{name}.nrrd"), status=1)
        row.measure("messages about what is refused", len(done.messages()), at_least=1, case=name)
        row.measure("colours of what is drawn differ by", worst(p[1:], [one]), at_most=FLOOR, case=name)
        row.measure("what is refused is seen", max(p[0]), at_most=0, case=name)
    styles = f"ComposedVolumeStyle {{ renderStyle [ {(SAME + ' ') * 40} ] }}"
    done, p = draw(scene(WHOLE, NO_HEADLIGHT, volume(constant(102), styles, fields="opacityUnitDistance 1")), "1x1", 0)
    row.measure("colours of what is drawn differ by", worst(p, [one]), at_most=FLOOR, case="40 styles")
    boxes = "".join(f"Transform {{ translation {i - 19.5} 0 0 children [ "
                    + volume(constant(60 + i), fields="opacityUnitDistance 1") + "] }\n" for i in range(40))
    done, p = draw(scene(view(20.0, 0.5), NO_HEADLIGHT, boxes), "40x1", 0)
    expected = [premultiplied(((60 + i) / 255,) * 3, opacity((60 + i) / 255, 1, 1)) for i in range(40)]
    row.measure("colours of 40 volumes differ by", worst(p, expected), at_most=FLOOR)
    done, p = draw(scene(WHOLE, NO_HEADLIGHT, volume(constant(102), "", BAD_EFFECT, "opacityUnitDistance 1")), "1x1", 1)
    row.measure("colours of what is drawn differ by", worst(p, [one]), at_most=FLOOR, case="a bad effect")
    row.measure("messages about effects that do not compile", len(done.messages()), at_least=1)


suite.main(__name__)
