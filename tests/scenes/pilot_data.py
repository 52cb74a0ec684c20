"""Scenes without a known bound of the error, and how they are compared with the truth."""

import math
import os

from harness import Picture, Suite, load_json
from scenes import effect, quad, scene, voxels

suite = Suite()

SIDE, PIXELS = 12, 36
TRUTH = 1 / 64  # voxel: the steps that stand for the true picture
SLACK = 1 / 8 / 255 + 1e-4  # its rays end early, and its steps are not infinitely short
NO_LIGHT = "NavigationInfo { headlight FALSE }\n"
LIGHT = "DirectionalLight { direction -0.5 -0.6 -0.7 ambientIntensity 0.2 }\n"
CAMERA = "Viewpoint { position 0.35 0.25 2.1 orientation -0.6 0.8 0 0.2 }\n"
FRONT = "OrthoViewpoint { position 0 0 10 fieldOfView -0.6 -0.6 0.6 0.6 }\n"


def field(function, components=1):
    """Voxels of a function of places between -1 and 1; its values are 0 to 1, or tuples of such."""
    values = []
    for k in range(SIDE):
        for j in range(SIDE):
            for i in range(SIDE):
                got = function(*((2 * n + 1) / SIDE - 1 for n in (i, j, k)))
                packed = 0
                for value in got if components > 1 else (got,):
                    packed = packed * 256 + round(255 * min(max(value, 0), 1))
                values.append(packed)
    return voxels(components, (SIDE, SIDE, SIDE), values)


def hills(x, y, z):
    return 0.5 + 0.5 * math.sin(2.1 * x + 0.4) * math.cos(1.7 * y - 0.3) * math.cos(2.4 * z + 0.2)


def ball(x, y, z):
    return 1.1 - math.sqrt(x * x + y * y + z * z)


def checks(x, y, z):
    """And a slope: where nothing changes, normals would be those of rounding."""
    rows = (math.floor(7 * x) + math.floor(7 * y) + math.floor(7 * z)) % 2
    return 0.2 + 0.6 * rows + 0.1 * x + 0.07 * y - 0.05 * z


HILLS, BALL = field(hills), field(ball)
SHELL = ("OpacityMapVolumeStyle { transferFunction PixelTexture { image 8 1 4 "
         "0x00000000 0x00000000 0x3060a020 0xd0a04080 0x40c06030 0x00000000 0x20208010 0xffffff60 } }")


def volume(data=HILLS, style="", fields="", node="VolumeData"):
    style = f"renderStyle {style}" if style else ""
    return f"{node} {{ dimensions 1 1 1 voxels {data} {style} {fields} }}\n"


def composed(*styles):
    return f"ComposedVolumeStyle {{ renderStyle [ {' '.join(styles)} ] }}"


STEEP = """void PLUG_volume_classify(inout vec4 color, const in VolumeSample s) {
    color.rgb = mix(vec3(0.9, 0.3, 0.1), vec3(0.1, 0.4, 0.9), smoothstep(0.45, 0.55, s.value.r));
    color.a = 0.5 * color.a * color.a;
}"""

SCENES = {
    "shaded": (CAMERA, LIGHT, volume(style=composed(SHELL, "ShadedVolumeStyle { lighting TRUE }"))),
    "shadows": (CAMERA, LIGHT, volume(style=composed(SHELL, "ShadedVolumeStyle { lighting TRUE shadows TRUE }"))),
    "edges": (CAMERA, volume(BALL, "EdgeEnhancementVolumeStyle { edgeColor 1 0.6 0.2 1 gradientThreshold 0.6 }")),
    "cartoon": (CAMERA, LIGHT, volume(BALL, "CartoonVolumeStyle { colorSteps 4 }")),
    "two components": (CAMERA, volume(field(lambda x, y, z: (hills(x, y, z), 0.5 * ball(z, x, y)), 2))),
    "isosurface": (CAMERA, LIGHT, volume(BALL, fields="surfaceValues 0.5", node="IsoSurfaceVolumeData")),
    "greatest value": (CAMERA, volume(style="ProjectionVolumeStyle { type \"MAX\" }")),
    "fog": (CAMERA, "Fog { color 0.7 0.7 0.8 visibilityRange 4 }\n", volume(style=SHELL)),
    "an author's effect": (CAMERA, volume(fields="effects " + effect(STEEP, 'language "GLSL"'))),
    "surfaces": (CAMERA, LIGHT, quad("Material { transparency 0.5 diffuseColor 0.2 0.8 0.3 }"),
                 "Transform { translation 0.2 0 -0.1 children Shape { appearance Appearance { material Material { } } "
                 "geometry Sphere { radius 0.2 } } }\n",
                 volume(style=composed(SHELL, "ShadedVolumeStyle { lighting TRUE }"))),
    "voxels in rows": (FRONT, NO_LIGHT, volume(field(checks), composed(
        SHELL, "EdgeEnhancementVolumeStyle { edgeColor 1 1 1 1 }"))),
}


def draw(name, *arguments):
    """A picture and what is said of it."""
    result = suite.render(scene(*SCENES[name]), "-o", "a.npy", "--stats", "json", *arguments,
                          size=f"{PIXELS}x{PIXELS}")
    return Picture(os.path.join(result.folder, "a.npy")).values, load_json(result.output)


def differences(a, b):
    """The greatest of each pixel."""
    return [max(abs(p - q) for p, q in zip(a[i : i + 4], b[i : i + 4])) for i in range(0, len(a), 4)]


known = {}


def truth(name):
    if name not in known:
        known[name] = draw(name, "--step", TRUTH)[0]
    return known[name]


def check_estimate(name, error, *arguments, slack=SLACK):
    picture, told = draw(name, "--error", error, *arguments)
    said, plan = told["error"], told["plan"]
    wrong = differences(picture, truth(name))
    beyond = sum(w > (said["value"] or 0) + slack for w in wrong) / len(wrong)
    suite.check(f"{name}, --error {error:.4f}: estimated, and 99 % of pixels are no worse than said",
                said["kind"] == "estimated" and said["value"] and beyond <= 0.01, said, plan,
                f"{100 * beyond:.2f} % of pixels, greatest error {max(wrong)}")
    if said["value"] and said["value"] <= error:
        suite.check(f"{name}: no pixel is further than that from the true one", max(wrong) <= error + slack,
                    max(wrong), said)
    return said, plan
