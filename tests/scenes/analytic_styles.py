#!/usr/bin/env python3
"""V20: shadows in homogeneous slabs; every style, and some of their compositions, on an oblique ramp.

On a ramp the gradient is the same everywhere, and so is all that a local style makes of a sample: its
colour, and the factor k of its opacity. X3D's styles scale the opacity of a reference length, so that the
extinction of O is -ln(1 - clamp(O k)) / reference (accuracy is judged with that, not with tau k)."""

import math

import analytic_truth as truth
from analytic_data import (CELLS, EXACT, HALVINGS, MIDPOINT, OBLIQUE, RAMP_GRADIENT, REFERENCE, SAME, TABLE, Sheet,
                           add_cases, check_backends, image3d, mapped_case, on_ramp, ramp_value)
from analytic_grid import Grid
from analytic_page import Analytic
from analytic_rays import Box, Parallel, centres
from harness import blinn_phong, dot, unit
from scenes import constant
from style_data import VIEW as TO_VIEWER
from style_data import boundary, cartoon, edge, silhouette, tone

suite = Analytic()

DIMENSIONS = (0.64, 0.5, 0.56)
COARSE = [2 * s for s in HALVINGS]
ALWAYS, SECOND = dict.fromkeys((MIDPOINT, TABLE, CELLS), EXACT), {MIDPOINT: 2, TABLE: 2, CELLS: SAME}
VIEW = Parallel(0.44)

# ---- V20a: light in a homogeneous slab, shadowed by the slab itself

SIGMA = 8.0
SCATTERS = "ShadedVolumeStyle { lighting TRUE shadows TRUE }"


def slab_case(name, exact):
    box = Box(DIMENSIONS, (5, 4, 6), place=OBLIQUE)
    return mapped_case(f"V20a light {name}", image3d("slab.nrrd"), {"slab.nrrd": Grid(box, lambda p: 0.4).file()}, box,
                       lambda s: SIGMA, lambda s: 1.0, exact, texels=1, styles=[SCATTERS], orders=SECOND, steps=COARSE)


def head_truth(chord):
    alpha = -math.expm1(-SIGMA * chord.length)
    return (-math.expm1(-2 * SIGMA * chord.length) / 2,) * 3 + (alpha,)


def back_truth(chord):
    depth = SIGMA * chord.length
    return (depth * math.exp(-depth),) * 3 + (-math.expm1(-depth),)


def side_case():
    """Upright, lit from above: the shadow is as deep as the ray is below the upper side."""
    box = Box(DIMENSIONS, (5, 4, 6))

    def exact(chord):
        alpha = -math.expm1(-SIGMA * chord.length)
        return (math.exp(-SIGMA * (box.dimensions[1] / 2 - chord.entry[1])) * alpha,) * 3 + (alpha,)

    case = slab_case("from above", exact)
    return mapped_case("V20a light from above", image3d("slab.nrrd"), case.files, box, lambda s: SIGMA, lambda s: 1.0,
                       exact, texels=1, styles=[SCATTERS], orders=ALWAYS)


for direction, members in (("0 0 -1", [slab_case("from the viewer", head_truth)]),
                           ("0 0 1", [slab_case("from behind", back_truth)]), ("0 -1 0", [side_case()])):
    lit = Sheet(suite, members, VIEW, head=f"DirectionalLight {{ direction {direction} }}\n")
    add_cases(lit, members)

# ---- V20b: what each style makes of colour and opacity, in the order of the list

SIZE = (9, 8, 10)
BOX = Box(DIMENSIONS, SIZE, *centres(SIZE, 1.0), OBLIQUE)
NORMAL = unit(BOX.place.map.normal([-g for g in RAMP_GRADIENT]))
FACING = dot(NORMAL, TO_VIEWER)
CHANGE = 0.75
LIGHT = "DirectionalLight { direction 1 -2 -3 }\n"
TO_LIGHT = unit((-1, 2, 3))
WOOD = ("Material { diffuseColor .6 .4 .2 specularColor .3 .2 .1 shininess .1 ambientIntensity 0 "
        "emissiveColor .05 .02 .01 transparency .3 }")
OTHER = 153 / 255  # the value of the volume that is blended with this one


def lit_wood(color, alpha):
    shine = blinn_phong(NORMAL, TO_LIGHT, TO_VIEWER, (0.6, 0.4, 0.2), (0.3, 0.2, 0.1), 12.8)
    return tuple(a + b for a, b in zip(shine, (0.05, 0.02, 0.01))), 0.7 * alpha


def flat(color, alpha):
    seen = cartoon(math.acos(FACING), 5, (1, 0.9, 0.2, 0.9), (0.2, 0.3, 0.9, 0.6))
    return seen[:3], alpha * seen[3]


STYLES = {
    "boundary": ("BoundaryEnhancementVolumeStyle { retainedOpacity .3 boundaryOpacity .6 opacityFactor 1.5 }",
                 lambda color, alpha: (color, boundary(alpha, CHANGE, 0.3, 0.6, 1.5))),
    "strong boundary": ("BoundaryEnhancementVolumeStyle { retainedOpacity .3 boundaryOpacity 2 opacityFactor 1 }",
                        lambda color, alpha: (color, boundary(alpha, CHANGE, 0.3, 2, 1))),
    "silhouette": ("SilhouetteEnhancementVolumeStyle { silhouetteRetainedOpacity .2 "
                   "silhouetteBoundaryOpacity .9 silhouetteSharpness .7 }",
                   lambda color, alpha: (color, silhouette(alpha, FACING, 0.2, 0.9, 0.7))),
    "edge": ("EdgeEnhancementVolumeStyle { edgeColor 1 .2 0 1 gradientThreshold .1 }",
             lambda color, alpha: (edge(color, FACING, (1, 0.2, 0), 0.1), alpha)),
    "cartoon": ("CartoonVolumeStyle { orthogonalColor 1 .9 .2 .9 parallelColor .2 .3 .9 .6 colorSteps 5 }", flat),
    "tone": ("ToneMappedVolumeStyle { coolColor 0 .1 .6 0 warmColor .9 .6 0 0 }",
             lambda color, alpha: (tone(NORMAL, [TO_LIGHT], (0, 0.1, 0.6), (0.9, 0.6, 0)), alpha)),
    "shaded": ("ShadedVolumeStyle { lighting TRUE }",
               lambda color, alpha: (blinn_phong(NORMAL, TO_LIGHT, TO_VIEWER, color, (0, 0, 0), 1), alpha)),
    "wooden": (f"ShadedVolumeStyle {{ lighting TRUE material {WOOD} }}", lit_wood),
    "blended": (f"BlendedVolumeStyle {{ weightConstant1 .7 weightConstant2 .2 voxels {constant(153)} }}",
                lambda color, alpha: (tuple(0.7 * c + 0.2 * OTHER for c in color), 0.7 * alpha + 0.2 * OTHER)),
}
COMPOSED = ("boundary silhouette edge", "edge silhouette boundary", "tone boundary", "shaded silhouette",
            "cartoon boundary", "boundary cartoon", "blended silhouette", "silhouette blended",
            "edge shaded strong-boundary", "tone blended wooden")


def applied(names, color, alpha):
    for name in names:
        color, alpha = STYLES[name][1](tuple(color), alpha)
        color = tuple(min(max(c, 0.0), 1.0) for c in color)
    return color, min(alpha, 1.0)


def styled_case(title, names, extinction, color, exact, **more):
    grid = Grid(BOX, ramp_value)
    steepness = math.sqrt(dot(RAMP_GRADIENT, RAMP_GRADIENT))
    return mapped_case("V20b " + title, image3d("ramp.nrrd"),
                       {"ramp.nrrd": grid.file()}, BOX, extinction, color, exact,
                       fields=f"gradientUnit {CHANGE / steepness!r}",
                       styles=[STYLES[name][0] for name in names], **more)


TINT, OPACITY = (0.5, 0.25, 0.75), 0.3


def flat_case(names):
    """One colour and opacity everywhere: exact for any step."""
    color, alpha = applied(names, TINT, OPACITY)
    sigma = -math.log1p(-alpha) / 0.1
    return styled_case(", then ".join(names), names, lambda s: -math.log1p(-OPACITY) / 0.1, lambda s: TINT,
                       lambda chord: truth.homogeneous(sigma, color, chord.length), reference=0.1, texels=1,
                       orders=ALWAYS, steps=(1.3, 0.3))


def ramp_case(names, kappa=50.0):
    """tau = kappa s and C = s before the styles."""
    def after(s):
        return applied(names, (s, s, s), -math.expm1(-kappa * s * REFERENCE))

    def exact(chord):
        s0, s1, length = on_ramp(chord)
        slope = (s1 - s0) / length
        found = [truth.integrated(lambda t: -math.log1p(-after(s0 + slope * t)[1]) / REFERENCE,
                                  lambda t, i=i: after(s0 + slope * t)[0][i], length, parts=2) for i in range(3)]
        return tuple(f[0] for f in found) + (found[0][1],)

    return styled_case("ramp, " + ", ".join(names), names, lambda s: kappa * s, lambda s: s, exact, orders=SECOND,
                       steps=[3 * s for s in HALVINGS])


FLAT = [flat_case([name]) for name in STYLES]
FLAT += [flat_case([n.replace("-", " ") for n in names.split()]) for names in COMPOSED]
flat_sheet = Sheet(suite, FLAT, VIEW, pixels=10, head=LIGHT)
add_cases(flat_sheet, FLAT)
RAMPS = [ramp_case(names) for names in (["boundary"], ["edge", "silhouette"])]
ramps = Sheet(suite, RAMPS, VIEW, pixels=10, head=LIGHT)
add_cases(ramps, RAMPS)


@suite.case
def order_of_styles():
    "V20b the order of styles in a list counts"
    pair = [case for case in FLAT if "blended" in case.name and "silhouette" in case.name]
    a, b = (flat_sheet.picture(case, "midpoint", 1.3).values for case in pair)
    suite.check("; ".join(case.name for case in pair), max(abs(x - y) for x, y in zip(a, b)) > 0.01)


@suite.case
def backends():
    "both backends"
    check_backends(flat_sheet, 1.3, ["midpoint"])  # programs are the same for all methods
    check_backends(ramps, 3 / 4, ["midpoint"])


suite.main(__name__)
