#!/usr/bin/env python3
"""What changes a scene of volumes in a known way changes its picture in a known way: everything moved, mirrored,
scaled or turned together, voxels with their axes exchanged, boxes cut into parts, what is not seen added."""

from harness import Suite
from scenes import NO_HEADLIGHT, scene, voxels

suite = Suite()

N = 4
PIXELS = [(x, y) for y in (4, 6, 9, 11) for x in (4, 7, 10, 11)]


def value(i, j, k, seed=3):
    """Some voxels, none of a symmetry."""
    return 30 + (i * 31 + j * 53 * seed + k * 71 + i * j * seed + k * k * i) % 190


def data(exchange=lambda i, j, k: (i, j, k), seed=3):
    """Voxel (i, j, k) holds what `exchange` says."""
    return voxels(1, (N, N, N), [value(*exchange(i, j, k), seed)
                                 for k in range(N) for j in range(N) for i in range(N)])


SHADED = "ShadedVolumeStyle { lighting TRUE material Material { specularColor .4 .4 .4 } }"
STYLES = (
    f"ComposedVolumeStyle {{ renderStyle [ {SHADED} EdgeEnhancementVolumeStyle {{ edgeColor .2 .4 .9 1 }} "
    "SilhouetteEnhancementVolumeStyle { silhouetteRetainedOpacity .5 silhouetteBoundaryOpacity .4 } ] }",
    "ComposedVolumeStyle { renderStyle [ BoundaryEnhancementVolumeStyle { } ToneMappedVolumeStyle { } ] }",
)
LIGHTS = ("DirectionalLight { direction -1 -2 -3 global TRUE }\n",
          "PointLight { location 2 1 3 radius 1e9 global TRUE intensity .7 attenuation .4 .3 .2 }\n")
TURN = "rotation 2 3 -1 .7"


def box(style=STYLES[0], voxel_data=None, kind="VolumeData", fields="", dimensions=(1, 1.2, 0.9)):
    style = f"renderStyle {style}" if style else ""
    size = " ".join(map(str, dimensions))
    return f"{kind} {{ dimensions {size} voxels {voxel_data or data()} {style} {fields} }}\n"


def surfaces(fields=""):
    return box(SHADED.replace("Material {", "Material { transparency .3 "), kind="IsoSurfaceVolumeData",
               fields="surfaceValues [ .3 .55 ] " + fields)


def placed(content, fields=TURN):
    return f"Transform {{ {fields} children [\n{content}] }}\n"


def eye(parallel=True):
    return ("OrthoViewpoint { position 0 0 5 fieldOfView -1 -1 1 1 }\n" if parallel
            else "Viewpoint { position 0 0 3 fieldOfView .8 }\n")


def see(*parts, pixels=PIXELS, arguments=()):
    """In steps that do not depend on the scene: of scenes that mean the same the planner may see more in one."""
    return suite.probe(scene(NO_HEADLIGHT, *parts), pixels, "--step", "0.5", *arguments)


def same(name, got, expected, tolerance=2e-4):
    """The picture, and that there is one."""
    worst = max(abs(a - b) for p, q in zip(got, expected) for a, b in zip(p, q))
    suite.check(name, worst <= tolerance and max(p[3] for p in expected) > 0.1, f"differs by {worst}", expected[:3], got[:3])


def together(fields, content, parallel=True):
    """Eye, lights and volumes in one space."""
    return placed(eye(parallel) + "".join(LIGHTS) + content, fields)


@suite.case
def moved_together():
    "eye, lights and volumes moved, turned and scaled together: the same picture"
    for name, content in (("surfaces", placed(surfaces())),
                          ("two", placed(box()) + placed(box(STYLES[1], data(seed=5)), "rotation 1 0 0 .5 translation .2 .1 .1"))):
        expected = see(eye(False), *LIGHTS, content)
        for way in ("translation 300 -200 100", "rotation 1 2 3 1.1"):
            same(f"{name} {way}", see(together(way, content, False)), expected, 1e-3)


@suite.case
def scaled():
    "a volume a thousand times larger or smaller, seen from so much farther or nearer"
    expected = see(eye(), LIGHTS[0], placed(box()))
    for s in (1e-3, 1e3):
        view = f"OrthoViewpoint {{ position 0 0 {5 * s} fieldOfView {-s} {-s} {s} {s} }}\n"
        same(f"a group of scale {s:g}", see(view, LIGHTS[0], placed(placed(box()), f"scale {s} {s} {s}")), expected)
        size = tuple(s * d for d in (1, 1.2, 0.9))
        same(f"dimensions {s:g}", see(view, LIGHTS[0], placed(box(dimensions=size))), expected)


def mirrored(points):
    return [(15 - x, y) for x, y in points]


@suite.case
def mirror():
    "a scale of -1 is the mirror image: of voxels, surfaces and light"
    lights = "DirectionalLight { direction 0 -2 -3 global TRUE }\n"  # in the mirror's plane
    for name, content in (("styles", placed(box())), ("surfaces", placed(surfaces()))):
        got = see(eye(), lights, placed(content, "scale -1 1 1"), pixels=mirrored(PIXELS))
        same(name, got, see(eye(), lights, content))


@suite.case
def exchanged_axes():
    "voxels with axes exchanged or reversed, and the box turned back"
    expected = see(eye(), *LIGHTS, box(dimensions=(1, 1, 1)))
    ways = (("reversed x", lambda i, j, k: (N - 1 - i, j, k), "scale -1 1 1"),
            ("reversed z", lambda i, j, k: (i, j, N - 1 - k), "scale 1 1 -1"),
            ("a quarter around z", lambda i, j, k: (j, N - 1 - i, k), "rotation 0 0 1 -1.5707963267948966"),
            ("a third around the diagonal", lambda i, j, k: (j, k, i), "rotation 1 1 1 -2.0943951023931953"))
    for name, exchange, back in ways:
        same(name, see(eye(), *LIGHTS, placed(box(voxel_data=data(exchange), dimensions=(1, 1, 1)), back)), expected)


@suite.case
def parts():
    "a box cut in two by crop boxes or by planes is the whole, with tiny steps"
    whole = see(eye(), *LIGHTS, placed(box()), arguments=("--step", ".02"))
    for axis in (0, 2):
        low, high = ["0"] * 3, ["1"] * 3
        low[axis] = high[axis] = ".37"
        cut = [box(fields=f"cropMax {' '.join(high)}"), box(fields=f"cropMin {' '.join(low)}")]
        same(f"axis {axis}", see(eye(), *LIGHTS, placed("".join(cut)), arguments=("--step", ".02")), whole, 4e-3)
    planes = [box(fields=f"clipPlanes ClipPlane {{ plane {p} }}") for p in ("1 2 .5 .1", "-1 -2 -.5 -.1")]
    same("oblique", see(eye(), *LIGHTS, placed("".join(planes)), arguments=("--step", ".02")), whole, 4e-3)


@suite.case
def finer():
    "half the step: the picture tends to one"
    a, b, c = (see(eye(), *LIGHTS, placed(box()), arguments=("--step", s)) for s in (0.2, 0.1, 0.05))
    distance = lambda p, q: max(abs(x - y) for u, v in zip(p, q) for x, y in zip(u, v))
    suite.check("", distance(b, c) <= max(distance(a, b), 1e-4), distance(a, b), distance(b, c))
    same("surfaces", see(eye(), *LIGHTS, placed(surfaces()), arguments=("--step", ".1")),
         see(eye(), *LIGHTS, placed(surfaces()), arguments=("--step", ".05")), 2e-3)


CLEAR = "OpacityMapVolumeStyle { transferFunction PixelTexture { image 1 1 4 0xFF000000 } }"


@suite.case
def unseen():
    "what is off, clear, empty or elsewhere changes nothing"
    fine = ("--step", ".02")  # boxes around cut steps
    content = placed(box())
    expected = see(eye(), *LIGHTS, content)
    expected_fine = see(eye(), *LIGHTS, content, arguments=fine)
    dark = ("DirectionalLight { on FALSE color 1 0 0 global TRUE }\n", "PointLight { intensity 0 global TRUE }\n",
            placed("SpotLight { global FALSE location 0 0 4 }\n"))
    apart = (placed(box(STYLES[1]), "translation 90 0 0"), box("OpacityMapVolumeStyle { enabled FALSE }"),
             "VolumeData { renderStyle CartoonVolumeStyle { } }\n",
             "Switch { whichChoice -1 children [ " + box() + " ] }\n")
    around = (box(CLEAR), box("", kind="IsoSurfaceVolumeData", fields="surfaceValues 2"),
              box("", kind="IsoSurfaceVolumeData"), box("", kind="SegmentedVolumeData", fields="segmentEnabled FALSE"))
    same("lights", see(*dark, eye(), *LIGHTS, content), expected)
    same("volumes", see(*apart, eye(), *LIGHTS, content), expected)
    for more in around:
        same(more[:80].replace("\n", " "), see(more, eye(), *LIGHTS, content, arguments=fine), expected_fine, 4e-3)
    same("all of it, behind", see(eye(), *LIGHTS, content, *dark, *apart, *around, arguments=fine), expected_fine, 4e-3)


@suite.case
def unused_style():
    "a disabled member, a list in a list, a weight of 1 and 0"
    expected = see(eye(), *LIGHTS, placed(box(SHADED)))
    for style in (f"ComposedVolumeStyle {{ renderStyle [ CartoonVolumeStyle {{ enabled FALSE }} {SHADED} ] }}",
                  f"ComposedVolumeStyle {{ renderStyle [ ComposedVolumeStyle {{ renderStyle {SHADED} }} ComposedVolumeStyle {{ }} ] }}",
                  f"ComposedVolumeStyle {{ renderStyle [ {SHADED} BlendedVolumeStyle {{ weightConstant1 1 weightConstant2 0 "
                  f"voxels {data(seed=7)} renderStyle CartoonVolumeStyle {{ }} }} ] }}"):
        same(style[:90], see(eye(), *LIGHTS, placed(box(style))), expected)
    # a volume of one segment is that volume
    same("a segment", see(eye(), *LIGHTS, placed(box(SHADED, kind="SegmentedVolumeData"))), expected)


suite.run()
