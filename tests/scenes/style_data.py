"""Volume styles on an oblique ramp: its gradient is the same everywhere, so that every style is one
constant. The formulas are those of ISO/IEC 19775-1 41.4 and of the proposal of 2005."""

import colorsys
import math

from harness import dot, premultiplied, unit
from scenes import Row, effect, volume
from shading_data import ramp

VIEW = (0, 0, 1)  # to the viewer: parallel rays
SLOPE = (0.3, -0.4, -0.2)
TINT = (0.5, 0.25, 0.75)
OPACITY = 0.5
# One reference length (an eighth) in the middle of the box, where the gradient of the ramp is free of
# the box's borders: what is seen has the opacity that the styles make.
INSIDE = """void PLUG_volume_ray(inout float t_enter, inout float t_exit, const in vec3 origin_eye,
                     const in vec3 direction_eye)
{ t_enter = max(t_enter, %r - 0.0625); t_exit = min(t_exit, %r + 0.0625); }
void PLUG_volume_classify(inout vec4 color, const in VolumeSample s) { color = vec4(%r, %r, %r, %r); }"""


def inside(color=TINT, opacity=OPACITY, middle=10.0):
    return effect(INSIDE % (middle, middle, *map(float, color), float(opacity)))


def normal_of(slope, dimensions=(1, 1, 1)):
    return unit(tuple(-s / d for s, d in zip(slope, dimensions)))


def magnitude(slope):
    return math.sqrt(dot(slope, slope))


def ramp_name(slope):
    return "ramp_" + "_".join(f"{s:g}" for s in slope) + ".nrrd"


def composed(*styles):
    return f"ComposedVolumeStyle {{ renderStyle [ {' '.join(styles)} ] }}"


class Styles:
    """Volumes side by side in one drawing, each with a style; all are seen by parallel rays."""

    def __init__(self, suite):
        self.suite = suite
        self.row = Row(suite)
        self.files = {}
        self.expected = []

    def data(self, slope):
        self.files[ramp_name(slope)] = ramp(slope)
        return f'ImageTexture3D {{ url "{ramp_name(slope)}" }}'

    def add(self, name, style, rgb, alpha, *, slope=SLOPE, data=None, fields="", lights="", around="",
            color=TINT, opacity=OPACITY, dimensions=(1, 1, 1)):
        """A volume of `style` that shall show the colour rgb at the opacity alpha."""
        content = volume(data or self.data(slope), style, inside(color, opacity),
                         "valueRange 0 1 opacityUnitDistance .125 " + fields, dimensions)
        before, after = (around + " children [\n", "] }\n") if around else ("", "")
        self.row.add(f"{lights}{before}{content}{after}")
        self.expected.append((name, premultiplied(rgb, alpha)))

    def draw(self, tolerance=1e-4, **options):
        pixels = self.row.draw(files=self.files, **options)
        for pixel, (name, expected) in zip(pixels, self.expected):
            self.suite.close(name, pixel, expected, tolerance)


# ---- formulas


def boundary(opacity, change, retained=0.2, boundary=0.9, factor=2.0):
    return min(opacity * (retained + boundary * change**factor), 1.0)


def silhouette(opacity, n_dot_v, retained=1.0, boundary=0.0, sharpness=0.5):
    return min(opacity * (retained + boundary * (1 - abs(n_dot_v)) ** sharpness), 1.0)


def edge(color, n_dot_v, edge_color=(0, 0, 0), threshold=0.4):
    facing = abs(n_dot_v)
    if facing >= math.cos(threshold):
        return tuple(color)
    return tuple(c * facing + e * (1 - facing) for c, e in zip(color, edge_color))


def between_in_hsv(a, b, share):
    """The hue of a grey is that of the other colour; the shorter way round."""
    a, b = list(colorsys.rgb_to_hsv(*a)), list(colorsys.rgb_to_hsv(*b))
    if a[1] == 0:
        a[0] = b[0]
    if b[1] == 0:
        b[0] = a[0]
    way = (b[0] - a[0] + 0.5) % 1 - 0.5
    hue = (a[0] + share * way) % 1
    return colorsys.hsv_to_rgb(hue, *(p + share * (q - p) for p, q in zip(a[1:], b[1:])))


def cartoon(angle, steps=4, orthogonal=(1, 1, 1, 1), parallel=(0, 0, 0, 1)):
    """Colour and what the opacity is multiplied by."""
    if angle > math.pi / 2:
        return (0, 0, 0, 0)
    size = math.pi / 2 / steps
    part = min(int(angle / size), steps - 1)
    if part == 0:
        return tuple(orthogonal)
    if part == steps - 1:
        return tuple(parallel)
    share = (part + 0.5) * size / (math.pi / 2)
    alpha = orthogonal[3] + share * (parallel[3] - orthogonal[3])
    return between_in_hsv(orthogonal[:3], parallel[:3], share) + (alpha,)


def tone(normal, lights, cool=(0, 0, 1), warm=(1, 1, 0)):
    """`lights`: the directions to them."""
    total = [0.0] * 3
    for light in lights:
        share = (1 + dot(unit(light), normal)) / 2
        for i in range(3):
            total[i] += share * warm[i] + (1 - share) * cool[i]
    return tuple(total)
