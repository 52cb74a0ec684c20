#!/usr/bin/env python3
"""--pick: what is seen in a pixel, and where."""

import math

from harness import Suite, box_interval, load_json, unit
from scenes import NO_HEADLIGHT, constant, effect, front_scene, quad, scene, volume, voxels

suite = Suite()
SIZE = 32
NOTHING = {"position": None, "value": None, "physical": None, "segment": None, "volume": None}


def pick(text, pixels, *arguments, size=f"{SIZE}x{SIZE}", **options):
    where = [word for x, y in pixels for word in ("--pick", f"{x},{y}")]
    result = suite.render(text, *where, *arguments, size=size, **options)
    return [load_json(line) for line in result.output.splitlines()]


def place(column, size=SIZE):
    """Of a pixel's centre, in FRONT."""
    return (column + 0.5) / size * 2 - 1


def first_visible(value, step, reference=1):
    """Depth in a bare constant volume of the first sample at which 1/255 is reached."""
    alpha = value / 255
    n = math.ceil(math.log(254 / 255) / math.log(1 - alpha) * reference / step)
    return (n - 0.5) * step


CUBE = "DEF Cube " + volume(constant(3))


@suite.case
def constant_volume():
    "the first sample at which the accumulated opacity reaches 1/255, in world coordinates"
    for step in (0.1, 0.02):
        found = pick(front_scene(CUBE), [(10, 16)], "--step", step)[0]
        suite.equal(f"step {step}: members", list(found),
                    ["position", "value", "physical", "segment", "volume"])
        suite.close(f"step {step}: position", found["position"],
                    (place(10), -place(16), 0.5 - first_visible(3, step)), 1e-5)
        suite.close(f"step {step}: value", found["value"], [3 / 255], 1e-6)
        suite.close(f"step {step}: physical", found["physical"], [3], 1e-6)
        suite.equal(f"step {step}: volume", (found["volume"], found["segment"]), ("Cube", None))
    found = pick(front_scene(volume(constant(0))), [(0, 0), (16, 16)])
    suite.equal("nothing there, nothing visible there", found, [NOTHING, NOTHING])
    found = pick(front_scene(CUBE), [(10, 16)], "--step", 0.1, "--samples", 5)[0]
    suite.close("the ray is that of the pixel's centre", found["position"][:2], (place(10), -place(16)), 1e-6)


@suite.case
def perspective():
    "along oblique rays, from outside and inside"
    for eye in (3, 0.1):
        text = scene(f"Viewpoint {{ position 0 0 {eye} }}\n", NO_HEADLIGHT, CUBE)
        found = pick(text, [(20, 9)], "--step", 0.05)[0]
        half = math.tan(math.pi / 8)
        d = unit((place(20) * half, -place(9) * half, -1))
        t = box_interval((0, 0, eye), d)[0] + first_visible(3, 0.05)
        suite.close(f"from {eye}", found["position"], (t * d[0], t * d[1], eye + t * d[2]), 1e-5)



@suite.case
def segments():
    "number and name of the segment; one that is disabled is not there"
    header = ("NRRD0004\ntype: unsigned short\ndimension: 3\nsizes: 1 1 3\nencoding: ascii\n"
              "Segment0_LabelValue:=300\nSegment0_Name:=Corpus callosum\n\n7 300 2\n")
    for enabled, segment, label, z in (("", 2, None, 0.5), ("TRUE TRUE FALSE", 300, "Corpus callosum", 1 / 6)):
        text = front_scene(
            f"SegmentedVolumeData {{ voxels {constant(9, (1, 1, 3))} segmentEnabled [ {enabled} ] "
            f'segmentIdentifiers ImageTexture3D {{ url "labels.nrrd" }} }}\n')
        found = pick(text, [(16, 16)], "--step", 0.01, files={"labels.nrrd": header})[0]
        suite.equal(f"segment {segment}", (found["segment"], found.get("label"), found["volume"]),
                    (segment, label, 0))
        voxel = (1 / 3) ** (1 / 3)  # beyond the list of styles: the default one
        suite.close(f"segment {segment}: place", found["position"][2],
                    z - first_visible(9, 0.01 * voxel, voxel), 4e-3)
        suite.close(f"segment {segment}: value", found["value"], [9 / 255])


@suite.case
def segments_of_2005():
    "of segmentedVoxels the last component is the segment and no value"
    both = voxels(2, (1, 1, 2), (0x0905, 0x0003))  # 0 is opaque there
    text = front_scene(f"DEF S SegmentedVolumeData {{ segmentedVoxels {both} }}\n")
    found = pick(text, [(16, 16)], "--step", 0.05, "--dialect", "2005")[0]
    suite.equal("segment and volume", (found["segment"], found["volume"]), (3, "S"))
    suite.equal("one value", (found["value"], found["physical"]), ([0], [0]))


def corner(inside, size=(3, 3, 3)):
    """One voxel that is not empty: the last one."""
    count = size[0] * size[1] * size[2]
    return voxels(1, size, [0] * (count - 1) + [inside])


@suite.case
def transforms():
    "turned, sheared, mirrored volumes: the place is where the voxel stands in the world"
    shear = ("Transform { rotation 0 0 1 .6 children Transform { scale -1.5 1 1 children "
             "Transform { rotation 0 0 1 -.4 children [ %s ] } } }\n")
    text = front_scene(shear % ("DEF V " + volume(corner(255))))
    x, y = 1 / 3, 1 / 3  # the voxel's centre
    for angle, scale in ((-0.4, -1.5), (0.6, 1)):
        x, y = (x * math.cos(angle) - y * math.sin(angle), x * math.sin(angle) + y * math.cos(angle))
        x *= scale
    column, row = math.floor((x + 1) * 64), math.floor((1 - y) * 64)
    found = pick(text, [(column, row)], "--step", 0.02, size="128x128")[0]
    suite.close("where it is looked for", found["position"][:2], (place(column, 128), -place(row, 128)), 1e-5)
    suite.equal("what is there", found["volume"], "V")
    suite.close("as near as it begins", found["position"][2], 0.5 - 0.5 * 0.02 / 3, 1e-5)
    suite.check("it is the voxel's", found["value"][0] > 0.9, found)
    suite.equal("elsewhere is nothing", pick(text, [(96, 96)], size="128x128")[0], NOTHING)
    for scale, side in (("1 1 1", 1), ("-1 1 1", -1), ("1 -1 1", 1)):
        body = volume(voxels(1, (2, 1, 1), (0, 200)))
        found = pick(front_scene(f"Transform {{ scale {scale} children [\n{body}] }}\n"),
                     [(9, 16), (22, 16)])
        seen = [f["physical"] for f in found]
        suite.equal(f"scale {scale}", seen, [None, [200]] if side > 0 else [[200], None])


@suite.case
def values():
    "numbers of the file, beyond the window, too; components; interpolated as textures are"
    header = ("NRRD0004\ntype: short\ndimension: 3\nsizes: 1 1 2\nencoding: ascii\n\n-1000 3000\n")
    style = "OpacityMapVolumeStyle { transferFunction PixelTexture { image 1 1 4 0xffffffff } }"
    text = front_scene(
        'VolumeData { voxels ImageTexture3D { url "a.nrrd" } valueRange 0 1000 renderStyle %s }\n' % style)
    found = pick(text, [(16, 16)], "--step", 0.01, files={"a.nrrd": header})[0]
    suite.close("beyond the window", (found["value"], found["physical"]) and found["value"] + found["physical"],
                (1, 3000), 1e-6)
    colors = voxels(4, (1, 1, 1), ("0x4080C0FF",))
    found = pick(front_scene(volume(colors)), [(16, 16)])[0]
    suite.close("four components", found["physical"], (0x40, 0x80, 0xC0, 0xFF))
    ramp = volume(voxels(1, (2, 1, 1), (100, 200)), style)
    found = pick(front_scene(ramp), [(14, 16)])[0]
    suite.close("between voxels", found["physical"], [150 + 100 * place(14) / 0.5], 1e-3)


@suite.case
def events():
    "surfaces of equal value and projections are where they are met"
    ramp = voxels(1, (1, 1, 2), (0, 255))  # 0 at z = -.25, 1 at z = .25
    iso = "DEF I IsoSurfaceVolumeData { surfaceValues [ .3, .7 ] voxels %s renderStyle [ %s ] }\n"
    clear = "OpacityMapVolumeStyle { transferFunction PixelTexture { image 1 1 4 0xff000000 } }"
    solid = "OpacityMapVolumeStyle { transferFunction PixelTexture { image 1 1 4 0xff0000ff } }"
    for name, styles, value, number in (("the nearest", solid + solid, 0.7, 1),
                                        ("what is transparent is not seen", solid + clear, 0.3, 0)):
        found = pick(front_scene(iso % (ramp, styles)), [(16, 16)], "--step", 0.6)[0]
        suite.close(name, found["position"][2], (value - 0.5) / 2, 1e-4)
        suite.close(f"{name}: value", found["value"], [value], 1e-4)
        suite.equal(f"{name}: surface", (found["surface"], found["volume"]), (number, "I"))
    peak = volume(voxels(1, (1, 1, 4), (0, 100, 200, 100)), 'ProjectionVolumeStyle { type "MAX" }')
    found = pick(front_scene(peak), [(16, 16)], "--step", 0.25)[0]
    suite.close("the greatest", found["position"][2], 0.125, 0.03)
    suite.close("its value", found["physical"], [200], 2)


def at(z, content):
    return f"Transform {{ translation 0 0 {z} children [\n{content}] }}\n"


LAYER = ("void PLUG_volume_composite(inout vec4 accumulated, inout vec4 color, const in VolumeSample s)"
         " { color.rgb = vec3(1.0, 0.5, 0.0); }")


@suite.case
def several():
    "of volumes that overlap the one that hides most; of others the nearest, layers included"
    thin, thick = "DEF Thin " + volume(constant(3)), "DEF Thick " + volume(constant(30))
    for name, parts in (("thin first", (thin, thick)), ("thick first", (thick, thin))):
        found = pick(front_scene(*parts), [(16, 16)], "--step", 0.01)[0]
        suite.equal(name, found["volume"], "Thick")
    for z, expected in ((0.05, "Thin"), (-0.05, "Thick")):
        # 0.05 of the thin one alone hide less than 1/255
        found = pick(front_scene(at(z * 10, thin), thick), [(16, 16)], "--step", 0.01)[0]
        suite.equal(f"overlapping at {z * 10}", found["volume"], expected)
    own = "DEF Own " + volume(constant(30), effects=effect(LAYER, 'placement "ADD_BEFORE"'))
    for z, expected in ((1, "Own"), (-1, "Thin")):
        found = pick(front_scene(at(z, own), thin), [(16, 16)], "--step", 0.1)[0]
        suite.equal(f"a layer at {z}", found["volume"], expected)


@suite.case
def cut_away():
    "what planes, crop boxes and viewpoints cut away is not seen"
    dense = constant(255, (2, 2, 2))
    plane = "ClipPlane { plane 0 0 -1 .2 }\n"
    for name, text, z in (
            ("a plane", front_scene(plane, volume(dense)), 0.2),
            ("the volume's own plane", front_scene(volume(dense, fields=f"clipPlanes {plane}")), 0.2),
            ("a crop box", front_scene(volume(dense, fields="cropMax 1 1 .4")), -0.1),
            ("a viewpoint", scene("OrthoViewpoint { position 0 0 10 fieldOfView -1 -1 1 1 nearDistance 9.7 "
                                  "farDistance 20 }\n", NO_HEADLIGHT, volume(dense)), 0.3)):
        found = pick(text, [(16, 16)], "--step", 0.002)[0]
        suite.close(name, found["position"][2], z, 1e-3)


@suite.case
def shapes():
    "opaque shapes hide volumes, translucent ones do not; which one it is"
    def square(z, name, material="UnlitMaterial { }"):
        return at(z, name + " " + quad(material))
    text = front_scene(square(-2, "DEF A"), square(0.8, "DEF B"), square(0.7, ""), CUBE,
                       at(0.9, "DEF C " + quad("UnlitMaterial { transparency .5 }")))
    found = pick(text, [(16, 16), (2, 2)])
    suite.equal("the nearest", (found[0]["shape"], found[0]["volume"]), ("B", None))
    suite.close("its place", found[0]["position"], (place(16), -place(16), 0.8), 1e-5)
    suite.equal("beside", found[1], NOTHING)
    found = pick(front_scene(CUBE, square(-2, "DEF A"), square(0.9, "DEF C", "UnlitMaterial { transparency .5 }")),
                 [(16, 16)])[0]
    suite.equal("through what is translucent", (found["volume"], found.get("shape")), ("Cube", None))
    found = pick(front_scene(*(square(-z / 10, "") for z in range(20, 0, -1))), [(16, 16)])[0]
    suite.equal("by number where it has no name", (found["shape"], round(found["position"][2], 4)), (19, -0.1))
    text = scene("Viewpoint { position 0 0 3 }\n", NO_HEADLIGHT, square(1, "DEF P"))
    found = pick(text, [(17, 14)])[0]
    half = math.tan(math.pi / 8)
    suite.close("perspective", found["position"], (2 * half * place(17), -2 * half * place(14), 1), 1e-5)


@suite.case
def with_the_rest():
    "with probes and pictures, at each time"
    text = front_scene(
        "DEF T Transform { children [ %s ] }\n" % CUBE,
        "DEF C TimeSensor { cycleInterval 4 loop TRUE }\n"
        "DEF P PositionInterpolator { key [0, 1] keyValue [0 0 0, 0 0 4] }\n"
        "ROUTE C.fraction_changed TO P.set_fraction\nROUTE P.value_changed TO T.translation\n")
    result = suite.render(text, "--pick", "16,16", "--probe", "16,16", "--frames", 2, "--fps", 1,
                          "--step", 0.1, size="32x32")
    lines = result.output.splitlines()
    suite.equal("probe, pick, probe, pick", [line[0] for line in lines], ["0", "{", "0", "{"])
    depths = [load_json(line)["position"][2] for line in lines[1::2]]
    suite.close("it moves", depths, (0.5 - first_visible(3, 0.1), 1.5 - first_visible(3, 0.1)), 1e-5)


suite.run()
