#!/usr/bin/env python3
"""plugray info, that needs no GL: info.py PLUGRAY"""

import json
import math
import re
import struct
import sys

from command import Command
from tap import check, check_equal, done

plugray = Command(sys.argv[1])

PERCENTS = (0.1, 1, 5, 25, 50, 75, 95, 99, 99.9)


def nrrd(kind, sizes, data, *fields):
    """An attached NRRD: little endian raw."""
    lines = ["NRRD0005", f"type: {kind}", f"dimension: {len(sizes)}",
             "sizes: " + " ".join(map(str, sizes)), "encoding: raw", "endian: little", *fields, ""]
    return "\n".join(lines).encode() + b"\n" + data


def scene(name, style="NULL", fields="", before=""):
    return (f"#X3D V3.3 utf8\n{before}\nDEF V VolumeData {{ {fields} voxels ImageTexture3D {{ url \"{name}\" }}\n"
            f"  renderStyle {style}\n}}\n")


def info(text, *files, name="scene.x3dv", status=0):
    """The JSON and the text of a scene."""
    for path, data in files:
        plugray.write(path, data)
    plugray.write(name, text)
    written = plugray.expect(status, "info", "--format", "json", name).stdout
    return json.loads(written), plugray.expect(status, "info", name).stdout


def volume_of(data, **options):
    result, text = info(scene("v.nrrd", **options), ("v.nrrd", data))
    return result["volumes"][0], text


# ---- where voxels lie


def geometry(*fields):
    volume, text = volume_of(nrrd("uint8", (2, 3, 4), bytes(range(24)), *fields))
    return volume["geometry"], text


DIRECTIONS = ("space directions: (2,0,0) (0,3,0) (0,0,4)", "space origin: (10,-20,30)",
              'space units: "mm" "mm" "mm"')
for space, letters, words, right in (
    ("RAS", "RAS", "i to the right, j to the front, k up; right-handed", True),
    ("LPS", "LPS", "i to the left, j to the back, k up; right-handed", True),
    ("LAS", "LAS", "i to the left, j to the front, k up; left-handed: a mirror image unless fileGeometry is TRUE",
     False),
):
    g, text = geometry(f"space: {space}", *DIRECTIONS)
    check_equal((g["axes"], g["right_handed"]), (letters, right), f"{space}: axes and hand")
    check(words + "\n" in text, f"{space}: in words", text)
    check_equal(g["affine"], [[2, 0, 0, 10], [0, 3, 0, -20], [0, 0, 4, 30]], f"{space}: affine")
    check_equal((g["spacing"], g["metres"], g["placed"]), ([2, 3, 4], 0.001, True), f"{space}: spacing")
check("spacing      2 x 3 x 4 mm, the whole 4 x 9 x 16 mm\n" in text, "spacing in words", text)
check("LAS: x to the left, y to the front, z up\n" in text, "the space in words", text)
g, text = geometry("space: LPS", "space directions: (0,0,-1) (-1,0,0) (0,1,0.1)", "space origin: (0,0,0)")
check_equal((g["axes"], g["right_handed"]), ("IRP", True), "axes in another order")
check(abs(g["oblique_degrees"] - math.degrees(math.atan(0.1))) < 1e-6 and "oblique by up to 5.7 degrees" in text,
      "how oblique they are", g, text)
check("mm (the file names no unit)" in text, "no unit", text)
g, text = geometry("space: RAS", "space directions: (-1,0,0) (0,1,0) (0,0,1)", "space origin: (0,0,0)")
check_equal((g["axes"], g["right_handed"]), ("LAS", False), "voxels in mirrored order")
g, text = geometry("spacings: 1 1 2.5", 'units: "um" "um" "um"')
check_equal((g["axes"], g["placed"], g["metres"]), (None, False, 1e-6), "sizes without a place")
check("does not say where x, y and z point" in text and "i along +x" in text, "in words", text)
g, text = geometry()
check(g is None and "the data do not say" in text, "no geometry at all", text)


def nifti(pixdim0, qform):
    header = bytearray(352)
    struct.pack_into("<i", header, 0, 348)
    struct.pack_into("<8h", header, 40, 3, 2, 3, 4, 1, 1, 1, 1)
    struct.pack_into("<hh", header, 70, 2, 8)
    struct.pack_into("<8f", header, 76, pixdim0, 1, 2, 3, 0, 0, 0, 0)
    struct.pack_into("<f", header, 108, 352)
    header[123] = 2
    struct.pack_into("<hh", header, 252, qform, 0)
    header[344:348] = b"n+1\0"
    return bytes(header) + bytes(range(24))


for sign, letters, right in ((1, "RAS", True), (-1, "RAI", False)):
    result, _ = info(scene("v.nii"), ("v.nii", nifti(sign, 1)))
    g = result["volumes"][0]["geometry"]
    check_equal((g["axes"], g["right_handed"]), (letters, right), f"NIfTI with pixdim[0] {sign}")

# ---- values


def rank(values, percent):
    return values[max(math.ceil(percent / 100 * len(values)), 1) - 1]


values = [(i * 7919 % 4096) - 1000 for i in range(3000)] + [9000]
volume, text = volume_of(nrrd("int16", (3001, 1, 1), struct.pack("<3001h", *values)))
(stats,) = volume["values"]
check_equal([stats["percentiles"][f"{p:g}"] for p in PERCENTS], [rank(sorted(values), p) for p in PERCENTS],
            "percentiles")
check_equal((volume["range"], stats["finite"], stats["nan"]), ([min(values), max(values)], 3001, 0), "range")
bins = stats["histogram"]
counts = [0] * len(bins["counts"])
for value in values:
    counts[int((value - bins["first"]) // bins["width"])] += 1
check_equal(bins["counts"], counts, "histogram")
check(f"{bins['first']} |" in text and f"| {counts[0]}\n" in text, "histogram as text", text)
check("range        -1000 to 9000, that of the data\n" in text, "where the range comes from", text)
volume, text = volume_of(nrrd("float", (2, 2, 1), struct.pack("<4f", 1, math.nan, 5, math.inf), "min: 0", "max: 4"),
                         fields="valueRange 1 3")
check_equal((volume["range"], volume["range_declared"], volume["shown"]), ([0, 4], True, [1, 3]),
            "declared range, and that of the node")
stats = volume["values"][0]
check_equal((stats["minimum"], stats["maximum"], stats["nan"], stats["infinite"]), (1, 5, 1, 1), "what is no number")
check("1 NaN, 1 infinite" in text and "declared by the file; the volume node shows 1 to 3\n" in text, "in words", text)

volume, text = volume_of(nrrd("float", (2, 1, 1), struct.pack("<2f", -7, 7)), fields="windowCenter 1 windowWidth 4")
check_equal((volume["range"], volume["shown"]), ([-7, 7], [-1, 3]), "a window")

# ---- hostile values

for name, kind, sizes, data in (
    ("all equal", "uint16", (2, 2, 2), struct.pack("<8H", *[7] * 8)),
    ("all NaN", "float", (2, 2, 2), struct.pack("<8f", *[math.nan] * 8)),
    ("one voxel", "int8", (1, 1, 1), b"\x80"),
    ("the widest range", "double", (2, 2, 1), struct.pack("<4d", -1.7e308, 1.7e308, 0, 5e-324)),
    ("the widest integers", "uint64", (2, 1, 1), struct.pack("<2Q", 0, 2**64 - 1)),
):
    volume, text = volume_of(nrrd(kind, sizes, data))
    stats = volume["values"][0]
    voxels = math.prod(sizes)
    check_equal(stats["finite"] + stats["nan"], voxels, f"{name}: all are counted")
    check_equal(sum(stats["histogram"]["counts"]), stats["finite"], f"{name}: all stand in the histogram")
    check("nan" not in text.replace("NaN", ""), f"{name}: no line with nan", text)
    if stats["minimum"] == stats["maximum"]:
        check(volume["start_with"] is None, f"{name}: no transfer function", volume["start_with"])
four = nrrd("uint8", (4, 2, 1, 1), bytes((1, 2, 3, 4, 5, 6, 7, 8)), "kinds: RGBA-color space space space")
volume, text = volume_of(four)
check_equal([v["maximum"] for v in volume["values"]], [5, 6, 7, 8], "four components")
check(volume["start_with"] is None and "component 4" in text, "colours have no transfer function", text)

# ---- segments

LABELS = ("Segment0_Name:=Liver", "Segment0_LabelValue:=3", "Segment0_Color:=1 0.5 0",
          "Segment1_Name:=Spleen", "Segment1_LabelValue:=700", "Segment1_Color:=0 0 1")
data = nrrd("uint16", (2, 2, 2), struct.pack("<8H", 0, 3, 3, 700, 700, 700, 9, 0), *LABELS)
text = """#X3D V3.3 utf8
SegmentedVolumeData {
  voxels PixelTexture3D { image 1 2 2 2 0 255 0 255 0 255 0 255 }
  segmentIdentifiers ImageTexture3D { url "labels.nrrd" }
}
"""
result, text = info(text, ("labels.nrrd", data))
(labels,) = [v for v in result["volumes"] if v["uses"][0]["field"] == "segmentIdentifiers"]
(plain,) = [v for v in result["volumes"] if v["uses"][0]["field"] == "voxels"]
check_equal([(s["number"], s["voxels"], s["name"]) for s in labels["segments"]],
            [(0, 2, None), (3, 2, "Liver"), (9, 1, None), (700, 3, "Spleen")], "numbers, voxels and names of segments")
check_equal(labels["segments"][1]["color"], [1, 0.5, 0, 1], "a segment's colour")
check(labels["start_with"] is None and plain["segments"] is None, "segments have no transfer function")
check(re.search(r"^ +700 +3  Spleen  0 0 1 1$", text, re.M), "segments as text", text)

# ---- a transfer function to start with

# 3/4 air around 0, the rest between 100 and 200: the air is transparent, the rest is not
values = [i % 10 for i in range(750)] + [100 + i % 101 for i in range(250)]
data = nrrd("uint8", (10, 10, 10), bytes(values))
for name, opening in (("scene.x3dv", "OpacityMapVolumeStyle {"), ("scene.x3d", "<OpacityMapVolumeStyle ")):
    if name.endswith("d"):
        template = ("<X3D version='3.3' profile='Immersive'><Scene><VolumeData>\n<ImageTexture3D url='v.nrrd' "
                    "containerField='voxels'/>\n%s</VolumeData></Scene></X3D>\n")
    else:
        template = 'VolumeData { voxels ImageTexture3D { url "v.nrrd" }\n%s }\n'
        template = "#X3D V3.3 utf8\n" + template.replace("%s", "renderStyle %s")
    result, text = info(template % ("" if name.endswith("d") else "NULL"), ("v.nrrd", data), name=name)
    start = result["volumes"][0]["start_with"]
    check(start["x3d"].startswith(opening) and opening in text, f"{name}: in the encoding of the scene", start["x3d"])
    again, _ = info(template % start["x3d"], name=name)  # no error, no warning that changes the status
    check("PixelTexture" in again["nodes"], f"{name}: can be pasted", again)
knots = start["knots"]
check([k["value"] for k in knots] == sorted(k["value"] for k in knots) and knots[-1]["value"] == 255,
      "knots ascend to the end of the range", knots)
check(10 < knots[1]["value"] < 100 and knots[1]["opacity"] == 0, "air is transparent", knots)
check_equal(knots[2]["value"], rank(sorted(values[750:]), 50), "then the median of the object")
check(0 < knots[2]["opacity"] < knots[3]["opacity"] <= knots[4]["opacity"] < 1, "opacities grow", knots)
texels = [int(word, 16) for word in re.findall(r"0x([0-9A-F]{8})", start["x3d"])]
check_equal(len(texels), 64, "64 texels")
check(texels[2] & 255 == 0 and all(t & 255 for t in texels[26:]), "transparent in air, nowhere in the object", texels)

# signed: most near zero, a lobe on either side
values = [0.001 * (i % 7 - 3) for i in range(940)] + [0.5 + i / 60 for i in range(30)] + [-0.5 - i / 60 for i in range(30)]
volume, _ = volume_of(nrrd("float", (10, 10, 10), struct.pack("<1000f", *values)))
knots = volume["start_with"]["knots"]
check_equal([-k["value"] for k in reversed(knots)], [k["value"] for k in knots], "signed values: knots on both sides")
check_equal([k["opacity"] for k in reversed(knots)], [k["opacity"] for k in knots], "signed values: like opacities")
inner = [k for k in knots if abs(k["value"]) < 0.5]
check(len(inner) == 2 and not any(k["opacity"] for k in inner), "signed values: zero is background", knots)
check(knots[0]["color"][2] > knots[0]["color"][0] and knots[-1]["color"][0] > knots[-1]["color"][2],
      "signed values: negative ones are blue", knots)

# ---- programs

plugray.write("v.nrrd", nrrd("uint8", (10, 10, 10), bytes(500) + bytes(range(250)) * 2))  # half of it is clear
HALF = "OpacityMapVolumeStyle { transferFunction PixelTexture { image 4 1 4 0 0 0x80808040 0xff } }"  # of it is clear
result, text = info(scene("v.nrrd", HALF))
plan = {choice["about"]: (choice["chosen"], choice["why"]) for choice in result["plan"]}
check_equal(sorted(plan), ["early termination", "error", "gradients", "lights", "sampling", "skipping",
                            "storage", "styles"], "every choice of the plan is told")
check("plan of volumes:" in text and all(f"    {about}: {chosen}; {why}" in text for about, (chosen, why) in plan.items()),
      "in words, too", text)
(program,) = result["programs"]
check_equal(program["gradients"], 0, "no gradient where nobody asks")
check_equal([e for m in ("normal_eye", "gradient") for e in program["members"][m]["read_by"]], [], "nobody reads one")
check_equal(sum(f["count"] for f in program["fetched"]), program["fetches"], "every fetch is somebody's")
fetched = {f["sampler"]: f["count"] for f in program["fetched"]}
check_equal((sorted(fetched), fetched["voxelQuads"], fetched["ranges"], fetched["leaps"]),
            (["leaps", "ranges", "sums", "voxelQuads"], 2, 1, 1), "a cubic in a cell, what bounds it, and its integrals")
check_equal((plan["gradients"][0], plan["lights"][0], plan["styles"][0]), ("none", "0", "in tables"),
            "no gradient, light or style at samples")
check(", 0 gradients a step" in text and "is read by" not in text, "and nothing of it in the text", text)

for kind, swing, chosen, expected in (("cells", 0.09, "cells", {"voxelQuads": 2, "sums": 11, "ranges": 1}),
                                      ("midpoint", 0, "midpoint", {"voxels": 1})):
    numbers = [0.3 + swing * (i * 37 % 11) / 2 for i in range(4 ** 3)]
    result, text = info(scene("dense.nrrd", "OpacityMapVolumeStyle { }", "valueRange 0 1"),
                        ("dense.nrrd", nrrd("float", (4, 4, 4), struct.pack("<64f", *numbers))))
    plan = {choice["about"]: choice["chosen"] for choice in result["plan"]}
    check_equal((plan["sampling"], plan["skipping"]), (chosen, "none"), f"{kind}: all can be seen, nobody looks for it")
    fetched = {f["sampler"]: f["count"] for f in result["programs"][0]["fetched"]}
    check_equal({name: fetched.get(name) for name in (*expected, "leaps")}, {**expected, "leaps": None},
                f"{kind}: and each sample is taken once")


# an eighth of it can be seen: rays leap
plugray.write("sparse.nrrd", nrrd("uint8", (40, 40, 40), bytes(200 if max(i % 40, i // 40 % 40, i // 1600) < 20 else 0
                                                               for i in range(40 ** 3))))


def skipping(promise, data="sparse.nrrd"):
    style = "ComposedVolumeStyle { renderStyle [ %s ShadedVolumeStyle { } ] }" % HALF
    result, _ = info(scene(data, style + '''
        effects Effect { parts EffectPart { type "FRAGMENT" url "data:text/plain,%s
        void PLUG_volume_shade(inout vec4 color, const in VolumeSample s) { color.r = 1.0; }" } }''' % promise))
    return [(c["chosen"], "would cost more than they save" in c["why"]) for c in result["plan"] if c["about"] == "skipping"]


check_equal(skipping(""), [("none", False)], "an effect of an author ends skipping")
check_equal(skipping("/* PLUG-PROMISE: colour-only */"), [("by distances between blocks", False)],
            "unless it promises not to need it")
check_equal(skipping("/* PLUG-PROMISE: keeps-transparent */"), [("of clear samples", False)],
            "of samples, where it may change their opacity")
check_equal(skipping("/* PLUG-PROMISE: colour-only */", "v.nrrd"), [("none", True)], "leaps are too short, and it is told")

SHADED = """ComposedVolumeStyle { renderStyle [
    OpacityMapVolumeStyle { }
    ShadedVolumeStyle { lighting TRUE } ] }"""
result, text = info(scene("v.nrrd", SHADED))
(program,) = result["programs"]
check_equal(program["gradients"], 1, "one gradient for a lit volume")
check_equal([(e["effect"], e["place"]["line"], e["place"]["column"])
             for e in program["members"]["normal_eye"]["read_by"]], [("ShadedVolumeStyle", 6, 5)], "for whom")
check("normal_eye (from the gradient) is read by ShadedVolumeStyle at scene.x3dv:6:5\n" in text, "in words", text)
held = {choice["about"]: choice["chosen"] for choice in result["plan"]}
check_equal((held["gradients"], held["lights"], held["styles"]), ("held", "1", "1 at samples"), "what it needs is told")
fetched = [f for f in program["fetched"] if f["sampler"] == "voxelGradients"]
check_equal(sum(f["count"] for f in fetched), 2, "a fetch of a gradient: before what is opaque, and there")
check(all(f["for"]["effect"] == "VolumeData" and f["for"]["place"]["line"] == 3 for f in fetched), "for the volume",
      fetched)
check_equal(sum(f["count"] for f in program["fetched"]), program["fetches"], "every fetch is somebody's, again")
(shade,) = [p for p in program["plugs"] if p["name"] == "volume_shade"]
check_equal((shade["offered_by"]["effect"], [u["effect"] for u in shade["used_by"]]),
            ("VolumeData", ["ShadedVolumeStyle"]), "who offers and who uses a plug")
check_equal([(d["node"], d["def"], d["place"]["line"]) for d in program["draws"]], [("VolumeData", "V", 3)],
            "what is drawn")
check("        draws VolumeData V at scene.x3dv:3:7\n" in text, "in words", text)

two = scene("v.nrrd", SHADED, before=scene("v.nrrd").split("\n", 1)[1].replace("DEF V ", ""))
result, _ = info(two)
(program,) = result["programs"]
check_equal((program["gradients"], len(program["draws"])), (1, 2), "two volumes, one of them lit: one gradient")

EFFECT = """effects DEF Steep Effect { language "GLSL" parts EffectPart { type "FRAGMENT" url "data:text/plain,
  void PLUG_volume_shade(inout vec4 color, const in VolumeSample s) { color.a *= s.gradient; }
" } }"""
result, text = info(scene("v.nrrd", fields=EFFECT))
(program,) = result["programs"]
check_equal([(e["effect"], e["place"]["line"]) for e in program["members"]["gradient"]["read_by"]], [("Steep", 3)],
            "an author's effect that reads the gradient")
check_equal(program["members"]["normal_eye"]["read_by"], [], "and no normal")
check(re.search(r"gradient \(its magnitude\) is read by Steep at scene.x3dv:3:\d+\n", text), "in words", text)

result, text = info(scene("missing.nrrd"), status=1)
check_equal(result["volumes"], [], "voxels that cannot be read are left out")
plugray.expect(2, "info", "--format", "sarif", "scene.x3dv", stderr="text|json")
done()
