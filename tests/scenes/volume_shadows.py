#!/usr/bin/env python3
"""Shadows of volumes: in themselves, on each other, on surfaces; in closed form."""

import math
import os

from harness import Suite, box_interval, unit
from scenes import FRONT, constant, effect, front_scene, quad, scene, volume, voxels

suite = Suite()

WHITE = 0xFFFFFF80  # half opaque after half a unit
UNIT = 0.5
ALPHA = 128 / 255
SIGMA = -math.log(1 - ALPHA) / UNIT
SEEN = 1 - math.exp(-SIGMA)  # through a box of side 1
SHADED = "ShadedVolumeStyle { lighting TRUE shadows TRUE }"
HEAD = "DirectionalLight { direction 0 0 -1 }"
BACK = "DirectionalLight { direction 0 0 1 }"
ABOVE = "DirectionalLight { direction 0 -1 0 }"
FINE = ("--step", 0.1)  # of four voxels a side


def opacity_map(rgba=WHITE):
    return f"OpacityMapVolumeStyle {{ transferFunction PixelTexture {{ image 1 1 4 0x{rgba:08X} }} }}"


def composed(*styles):
    return f"ComposedVolumeStyle {{ renderStyle [ {' '.join(styles)} ] }}"


def cloud(rgba=WHITE, shaded=SHADED, fields="", effects="", data=None, dimensions=(1, 1, 1)):
    """A box of one colour, in which light scatters alike in all directions."""
    return volume(data or constant(128, (4, 4, 4)), composed(opacity_map(rgba), shaded), effects,
                  f"opacityUnitDistance {UNIT} {fields}", dimensions)


def moved(text, place, scale=(1, 1, 1)):
    return (f"Transform {{ translation {' '.join(map(str, place))} scale {' '.join(map(str, scale))}"
            f" children [ {text} ] }}\n")


# ---- of a volume in itself


@suite.case
def slab():
    "V20a: a homogeneous slab in the light of the viewer, from behind and from the side"
    for name, light, expected in (
        ("front", HEAD, 0.5 * (1 - math.exp(-2 * SIGMA))),
        ("back", BACK, SIGMA * math.exp(-SIGMA)),
        ("side", ABOVE, math.exp(-SIGMA / 2) * SEEN),
    ):
        got = suite.middle(front_scene(light, cloud()), *FINE)
        suite.close(name, got, (expected,) * 3 + (SEEN,), 2e-4)
    got = suite.middle(scene(FRONT, cloud()), *FINE)
    suite.close("headlight", got[:3], (0.5 * (1 - math.exp(-2 * SIGMA)),) * 3, 2e-4)


@suite.case
def two_lights():
    "each light has a shadow of its own: the sum of both"
    dim = [light.replace("{", "{ intensity .4") for light in (HEAD, ABOVE)]
    got = suite.middle(front_scene(*dim, cloud()), *FINE)
    expected = 0.4 * (0.5 * (1 - math.exp(-2 * SIGMA)) + math.exp(-SIGMA / 2) * SEEN)
    suite.close("", got, (expected,) * 3 + (SEEN,), 2e-4)


@suite.case
def places():
    "a transformed volume: its shadow is as deep as it is in its own coordinates"
    text = moved(cloud(), (0, 0, 0), (0.5, 3, 2))  # own depth 1/2 to the side, along 3 units
    got = suite.middle(front_scene(ABOVE, text), *FINE)
    suite.close("", got, (math.exp(-SIGMA / 2) * SEEN,) * 3 + (SEEN,), 2e-4)


@suite.case
def lamps():
    "lights that stand somewhere: only what lies between them and the place counts"
    for name, height in (("outside", 3), ("inside", 0.2)):
        way = min(height, 0.5)
        for kind in (f"PointLight {{ location 0 {height} 0 attenuation 1 0 0 }}",
                     f"SpotLight {{ location 0 {height} 0 direction 0 -1 0 beamWidth 1.5 cutOffAngle 1.5 }}"):
            # the sample of the middle alone: one step of length 2
            got = suite.middle(front_scene(kind, cloud(effects=MIDDLE)), *FINE)
            expected = math.exp(-SIGMA * way) * (1 - math.exp(-SIGMA * 0.01))
            suite.close(f"{name}, {kind.split()[0]}", got[:3], (expected,) * 3, 2e-5)


# what the viewer sees is a hundredth around the middle; the way of light is left alone
MIDDLE = effect("""void PLUG_volume_ray(inout float t_enter, inout float t_exit, const in vec3 origin_eye,
                     const in vec3 direction_eye)
{ if (direction_eye.z < -0.99) { t_enter = max(t_enter, 9.995); t_exit = min(t_exit, 10.005); } }""")


@suite.case
def intensity():
    "shadowIntensity: how much of the light a shadow takes; ambient light has no shadow"
    def light(fields):
        return f"DirectionalLight {{ direction 0 -1 0 {fields} }}"
    shadowed, lit = math.exp(-SIGMA / 2) * SEEN, SEEN
    for value in (0, 0.5, 1):
        got = suite.middle(front_scene(light(f"shadowIntensity {value}"), cloud()), *FINE)
        suite.close(f"shadowIntensity {value}", got[:3], (value * shadowed + (1 - value) * lit,) * 3, 2e-4)
    got = suite.middle(front_scene(light("ambientIntensity .5"), cloud()), *FINE)
    suite.close("ambient", got[:3], (shadowed + 0.5 * 0.2 * SEEN,) * 3, 2e-4)


# ---- on surfaces

FLOOR = moved(quad("Material { diffuseColor 1 1 1 ambientIntensity 1 }"), (0, 0, -1), (2, 2, 1))
ASLANT = "DirectionalLight { direction 1 0 -1 }"
ARRIVES = math.sqrt(0.5)  # of that light on the floor
PLACES = [(c + 0.5) / 8 - 1 for c in (1, 4, 6, 14)]  # the last one is beside the shadow


def on_floor(*parts, arguments=()):
    """What the floor reflects; the volume is beside the picture, at (-1.5, 0, 0)."""
    pixels = [(round((x + 1) * 8 - 0.5), 8) for x in PLACES]
    return [c[0] for c in suite.probe(front_scene(*parts, FLOOR), pixels, *arguments, size="16x16")]


def ways(to_light=(-1, 0, 1), center=(-1.5, 0, 0), size=(1, 1, 1)):
    """How far the light goes through the box, for each place."""
    unit_light = unit(to_light)
    found = []
    for x in PLACES:
        enter, leave = box_interval([p - c for p, c in zip((x, 1 / 16, -1), center)], unit_light, size)
        found.append(leave - enter)
    return found


def aside(text):
    return moved(text, (-1.5, 0, 0))


@suite.case
def on_a_surface():
    "T20: a surface behind a volume: light times exp(-depth), ambient light unchanged"
    through = [math.exp(-SIGMA * way) for way in ways()]
    suite.check("the test sees shadow and light", through[0] < 0.7 and through[-1] == 1)
    suite.close("light", on_floor(ASLANT, aside(cloud())), [ARRIVES * t for t in through])
    ambient = ASLANT.replace("{", "{ ambientIntensity .5")
    suite.close("ambient", on_floor(ambient, aside(cloud())), [ARRIVES * t + 0.5 for t in through])
    half = ASLANT.replace("{", "{ shadowIntensity .5")
    suite.close("shadowIntensity", on_floor(half, aside(cloud())), [ARRIVES * (t + 1) / 2 for t in through])
    suite.close("opaque", on_floor(ASLANT, aside(cloud(0xFFFFFFFF))), [ARRIVES * (t == 1) for t in through])


@suite.case
def cut():
    "crop boxes and clip planes take the shadow away; so do effects of authors"
    center, size = (-1.25, 0, 0), (0.5, 1, 1)
    half = [ARRIVES * math.exp(-SIGMA * way) for way in ways(center=center, size=size)]
    whole = [ARRIVES * math.exp(-SIGMA * way) for way in ways()]
    suite.check("the test sees a difference", max(abs(a - b) for a, b in zip(half, whole)) > 0.1)
    for name, fields in (("crop", "cropMin .5 0 0"), ("plane", "clipPlanes ClipPlane { plane 1 0 0 0 }")):
        suite.close(name, on_floor(ASLANT, aside(cloud(fields=fields))), half)
    scene_plane = "ClipPlane { plane 1 0 0 1.5 }"
    suite.close("plane of the scene", on_floor(ASLANT, scene_plane, aside(cloud())), half)
    got = on_floor(ASLANT, scene_plane, aside(cloud(fields="ignoreClipPlanes TRUE")))
    suite.close("ignored", got, whole)
    ray = effect("""void PLUG_volume_ray(inout float t_enter, inout float t_exit, const in vec3 origin_eye,
        const in vec3 direction_eye)
        { t_exit = min(t_exit, (-1.5 - origin_eye.x) / direction_eye.x); }""")
    suite.close("author's ends", on_floor(ASLANT, aside(cloud(effects=ray))), half)
    classify = effect("""uniform float kept; void PLUG_volume_classify(inout vec4 color, const in VolumeSample s)
        { color.a = s.position.x > 0.5 ? kept * color.a : 0.0; }""", "inputOutput SFFloat kept 1")
    suite.close("author's classify", on_floor(ASLANT, aside(cloud(effects=classify))), half, 0.02)
    sample = effect("void PLUG_volume_sample(inout VolumeSample s) { s.value = vec4(0.0); }")
    ramp = volume(constant(255, (4, 4, 4)), SHADED, sample)
    suite.close("author's sample", on_floor(ASLANT, aside(ramp)), [ARRIVES] * 4)


@suite.case
def who_casts():
    "what casts no shadow: no shadows or no lighting asked for, a disabled style, a projection"
    lit = [ARRIVES] * 4
    for style in ("ShadedVolumeStyle { lighting TRUE }", "ShadedVolumeStyle { shadows TRUE }",
                  "ShadedVolumeStyle { lighting TRUE shadows TRUE enabled FALSE }"):
        suite.close(style, on_floor(ASLANT, aside(cloud(shaded=style))), lit)
    projection = volume(constant(255, (4, 4, 4)), "ProjectionVolumeStyle { }")
    suite.close("projection", on_floor(ASLANT, aside(projection)), lit)
    whole = [ARRIVES * math.exp(-SIGMA * way) for way in ways()]
    old = "ShadedVolumeStyle { lighting TRUE shadows TRUE phaseFunction \"NONE\" }"
    suite.close("without a phase function", on_floor(ASLANT, aside(cloud(shaded=old))), whole)
    blended = f"BlendedVolumeStyle {{ weightConstant1 1 weightConstant2 0 voxels {constant(9)} renderStyle {SHADED} }}"
    suite.close("inside a blended style", on_floor(ASLANT, aside(cloud(shaded=blended))), whole)


@suite.case
def segments():
    "a segment that is disabled casts none; the others do"
    data = constant(128, (2, 1, 1))
    def segmented(enabled):
        style = composed(opacity_map(), SHADED)
        return (f"SegmentedVolumeData {{ opacityUnitDistance {UNIT} voxels {data} segmentEnabled [ {enabled} ]"
                f" segmentIdentifiers {voxels(1, (2, 1, 1), [0, 1])} renderStyle [ {style} {style} ] }}\n")
    for enabled, center, size in (("TRUE TRUE", (-1.5, 0, 0), (1, 1, 1)), ("FALSE TRUE", (-1.25, 0, 0), (0.5, 1, 1))):
        expected = [ARRIVES * math.exp(-SIGMA * way) for way in ways(center=center, size=size)]
        got = on_floor(ASLANT, aside(segmented(enabled)), arguments=("--step", 0.02))
        suite.close(enabled, got, expected, 0.01)
    suite.close("none", on_floor(ASLANT, aside(segmented("FALSE FALSE"))), [ARRIVES] * 4)


@suite.case
def surfaces_of_value():
    "each crossing of a surface of equal value lets through 1 - alpha"
    sheet = voxels(1, (8, 8, 8), [0, 0, 0, 255, 255, 0, 0, 0] * 64)  # across x
    for alpha, values, crossings in ((0.25, ".5", 2), (1, ".5", 2), (0.25, ".25 .75", 4)):
        material = f"material Material {{ transparency {1 - alpha} }}"
        style = composed(opacity_map(0xFFFFFFFF), SHADED.replace("{", "{ " + material))
        text = f"IsoSurfaceVolumeData {{ surfaceValues [ {values} ] voxels {sheet} renderStyle {style} }}\n"
        got = on_floor(ASLANT, aside(text))
        suite.close(f"alpha {alpha}, {values}", got[1:], [ARRIVES * (1 - alpha) ** n for n in (crossings, crossings, 0)])
    old = f"VolumeData {{ voxels {sheet} renderStyle ISOSurfaceVolumeStyle {{ lighting TRUE shadows TRUE }} }}\n"
    suite.close("of 2005: at 0.5, as opaque as that", on_floor(ASLANT, aside(old))[1:], [ARRIVES * t for t in (0.25, 0.25, 1)])


@suite.case
def on_each_other():
    "one volume in the shadow of another one, and of both; listed in any order"
    far = moved(cloud(0xFFFFFF80), (0, 3, 0), (1, 0.5, 1))  # half as thick along the light
    near = cloud()
    expected = math.exp(-SIGMA * 1.5) * SEEN
    for order in ((far, near), (near, far)):
        got = suite.middle(front_scene(ABOVE, *order), *FINE)
        suite.close("", got[:3], (expected,) * 3, 2e-4)
    plain = near.replace("shadows TRUE", "shadows FALSE")
    got = suite.middle(front_scene(ABOVE, far, plain), *FINE)
    suite.close("a volume that asks for none is in none", got[:3], (0,) * 3, 2e-4)  # and does not scatter
    got = suite.middle(front_scene(ABOVE, far.replace("shadows TRUE", "shadows FALSE"), near), *FINE)
    suite.close("and casts none", got[:3], (math.exp(-SIGMA / 2) * SEEN,) * 3, 2e-4)


@suite.case
def no_shadow_no_code():
    "a scene whose volumes ask for no shadow composes programs without a line of it"
    def programs(style):
        result = suite.command("dump", "s.x3dv", "-d", "out", files={
            "s.x3dv": front_scene(ABOVE, "PointLight { }", cloud(shaded=style), FLOOR)})
        folder = os.path.join(result.folder, "out")
        texts = {}
        for name in os.listdir(folder):
            if name.endswith(".frag"):
                with open(os.path.join(folder, name), encoding="utf-8") as file:
                    texts[name] = file.read()
        return texts
    without = programs("ShadedVolumeStyle { lighting TRUE }")
    suite.equal("shadows FALSE", programs("ShadedVolumeStyle { lighting TRUE shadows FALSE }"), without)
    suite.check("not a word", without and not any("shadow" in t.lower() for t in without.values()))
    suite.check("else there is", all("hadow" in t for t in programs(SHADED).values()))


@suite.case
def itself():
    "nothing opaque is dark for its own sake: a cube and a sphere in the light of the viewer"
    got = suite.middle(front_scene(HEAD, cloud(0xFFFFFFFF)))
    suite.close("cube", got, (1, 1, 1, 1))
    n = 16
    values = [255 if math.dist((x, y, z), ((n - 1) / 2,) * 3) < 6 else 0
              for z in range(n) for y in range(n) for x in range(n)]
    ball = voxels(1, (n, n, n), values)
    surface = f"IsoSurfaceVolumeData {{ surfaceValues .5 voxels {ball} renderStyle "
    style = composed(opacity_map(0xFFFFFFFF), "ShadedVolumeStyle { lighting TRUE %s }") + " }\n"
    pixels = [(16, 16), (18, 17)]
    for light in (HEAD, "DirectionalLight { direction -1 -1 -1 }"):
        plain, dark = (suite.probe(front_scene(light, surface + style % word), pixels, size="32x32")
                       for word in ("", "shadows TRUE"))
        suite.close(f"sphere, {light}", dark[0] + dark[1], plain[0] + plain[1])
        suite.check(f"there it is, {light}", plain[0][3] == plain[1][3] == 1 and plain[1][0] > 0.1, plain)


@suite.case
def occluder():
    "T20: an occluder inside: nowhere brighter, darker behind it, alpha and ambient light as before"
    n = 12
    values = []
    for _, y, _ in ((z, y, x) for z in range(n) for y in range(n) for x in range(n)):
        values.append(255 if y == n - 3 else 90 if y < n - 6 else 0)  # a plate above a thicker slab
    data = voxels(1, (n, n, n), values)
    ramp = "OpacityMapVolumeStyle { transferFunction PixelTexture { image 2 1 4 0x80FF8000 0xFFFFFFFF } }"
    light = "DirectionalLight { direction .3 -1 -.2 ambientIntensity .4 }"
    picture = {}
    for asked in ("TRUE", "FALSE"):
        # NONE: what scatters belongs to shadows
        style = f'ShadedVolumeStyle {{ lighting TRUE shadows {asked} phaseFunction "NONE" }}'
        picture[asked] = suite.picture(front_scene(light, volume(data, composed(ramp, style))), size="24x24")
    dark, plain = picture["TRUE"].values, picture["FALSE"].values
    suite.check("nowhere brighter", all(a <= b + 1e-5 for a, b in zip(dark, plain)))
    suite.check("shadow somewhere", max(b - a for a, b in zip(dark, plain)) > 0.2)
    suite.close("alpha", dark[3::4], plain[3::4], 1e-6)
    ambient = light.replace("{", "{ intensity 0")
    style = 'ShadedVolumeStyle { lighting TRUE shadows %s phaseFunction "NONE" }'
    a, b = (suite.picture(front_scene(ambient, volume(data, composed(ramp, style % asked))), size="24x24")
            for asked in ("TRUE", "FALSE"))
    suite.close("ambient light alone", a.values, b.values, 1e-6)


@suite.case
def motion():
    "a volume that moves takes its shadow along"
    clock = ("DEF T TimeSensor { cycleInterval 1 loop TRUE }\n"
             "DEF P PositionInterpolator { key [0 1] keyValue [-1.5 0 0, -1.5 10 0] }\n")
    routes = "ROUTE T.fraction_changed TO P.set_fraction\nROUTE P.value_changed TO M.set_translation\n"
    text = front_scene(ASLANT, clock, "DEF M Transform { children [ " + cloud() + " ] }\n", FLOOR, routes)
    result = suite.render(text, "--frames", 2, "--fps", 2, "--probe", "6,8", size="16x16")
    first, second = [float(line.split()[0]) for line in result.output.splitlines()]
    x = (6.5 / 8 - 1)
    enter, leave = box_interval((x + 1.5, 1 / 16, -1), unit((-1, 0, 1)))
    suite.close("", (first, second), (ARRIVES * math.exp(-SIGMA * (leave - enter)), ARRIVES))


@suite.case
def faults():
    "a faulty effect on a volume is reported once, and the shadow is that of the rest"
    bad = effect("void PLUG_volume_classify(inout vec4 color, const in VolumeSample s) { color = nothing; }")
    def drawn(style):
        text = front_scene(ASLANT, aside(cloud(effects=bad, shaded=style)), FLOOR)
        return suite.render(text, "--probe", "4,8", status=1)
    result, plain = drawn(SHADED), drawn("ShadedVolumeStyle { lighting TRUE }")
    suite.equal("messages", result.messages(), plain.messages())
    suite.check("there are some", result.messages())
    suite.close("shadow", float(result.output.split()[0]), ARRIVES * math.exp(-SIGMA * ways()[1]))


@suite.case
def too_many():
    "more than eight volumes: so many shadows, and it is said once"
    for count, told in ((8, []), (9, ["limit"])):
        text = front_scene(ASLANT, *[moved(cloud(), (0, 0, i)) for i in range(count)], FLOOR)
        result = suite.command("check", "s.x3dv", files={"s.x3dv": text}, status=1 if told else 0)
        suite.equal(f"{count}", [code for code in ("limit",) if f"[{code}]" in result.output + result.errors], told)


suite.run()
