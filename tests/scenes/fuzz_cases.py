"""Random volumes behind random transfer functions, for fuzz_bounds.py: a case is a dictionary that JSON can
hold, from which both the scene and the job of the double-precision raycaster are made."""

import math
import os
import struct
import sys

from analytic_data import function_file
from analytic_rays import words
from scenes import volume

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "reference"))
import reference as raycaster

ERRORS = ("1/64", "1/255", "1/1023")
ULPS = {"u8": 2 / 65535, "u16": 2**-23, "f32": 2**-23, "f64": 0}  # two units in the last place: of 16 bits, of floats near 1
SEGMENTED = 0.2  # of all volumes
MOST = {"u8": 255, "u16": 65535, "f32": 1, "f64": 1}
NRRD_TYPES = {"u8": ("uchar", "B"), "u16": ("ushort", "H"), "f32": ("float", "f")}


# ---- random parts; r is a random.Random


def axis(r):
    return [r.uniform(-1, 1) for _ in range(2)] + [r.uniform(0.1, 1)]


def waves(r, count):
    """A sum of some waves in `count` dimensions, within 0 and 1."""
    parts = [([r.gauss(0, 4) for _ in range(count)], r.uniform(0, 7), r.random()) for _ in range(3)]
    whole = sum(p[2] for p in parts)

    def at(*place):
        return 0.5 + 0.5 * sum(weight * math.sin(start + sum(a * x for a, x in zip(turns, place)))
                               for turns, start, weight in parts) / whole

    return at


def field(r):
    """Of texture coordinates."""
    kind = r.choice(("smooth", "smooth", "noise", "noise", "levels", "ramp", "saturated", "dots", "same", "thin"))
    wave, low, high = waves(r, 3), r.random(), r.random()
    if kind == "smooth":
        return wave
    if kind == "noise":
        return lambda *place: low + (high - low) * r.random()
    if kind == "levels":
        levels = [r.choice((0, 1, r.random())) for _ in range(3)]
        return lambda *place: levels[min(int(3 * wave(*place)), 2)]
    if kind == "ramp":
        slope = [r.uniform(-1, 1) for _ in range(3)]
        return lambda *place: 0.5 + sum(a * (x - 0.5) for a, x in zip(slope, place))
    if kind == "saturated":
        return lambda *place: 6 * (r.random() - 0.5) + 0.5
    if kind == "dots":
        return lambda *place: high if r.random() < 0.1 else low
    if kind == "thin":
        return lambda *place: low + 0.01 * r.random()
    return lambda *place: low


def voxels(r, size, kind):
    at, most = field(r), MOST[kind]
    numbers = [min(max(at(*((i + 0.5) / n for i, n in zip((x, y, z), size))), 0), 1) * most
               for z in range(size[2]) for y in range(size[1]) for x in range(size[0])]
    return single(numbers) if kind == "f32" else [round(v) for v in numbers]


def single(numbers):
    """As 32 bits hold them."""
    return list(struct.unpack(f"<{len(numbers)}f", struct.pack(f"<{len(numbers)}f", *numbers)))


def opacities(r, count):
    kind = r.choice(("smooth", "smooth", "tents", "spikes", "noise", "steps", "ramp"))
    wave, scale = waves(r, 1), r.choice((1, 0.5, 0.1, 0.01))
    if kind == "smooth":
        return [scale * wave(i / count) for i in range(count)]
    if kind == "tents":
        tents = [(r.random(), r.uniform(0.02, 0.15), r.random()) for _ in range(r.randrange(1, 4))]
        return [max(h * max(0, 1 - abs(i / (count - 1) - c) / w) for c, w, h in tents) for i in range(count)]
    if kind == "spikes":
        return [r.random() if r.random() < 3 / count else 0 for _ in range(count)]
    if kind == "noise":
        return [scale * r.random() for _ in range(count)]
    if kind == "steps":
        levels = [r.choice((0, scale * r.random())) for _ in range(4)]
        return [levels[4 * i // count] for i in range(count)]
    return [scale * i / (count - 1) for i in range(count)]


def function(r):
    """Texels: straight RGBA."""
    count = r.choice((2, 3, 4, 5, 9, 16, 33, 64, r.randrange(2, 65)))
    alpha = opacities(r, count)
    if r.random() < 0.4:
        first = r.randrange(count)
        for i in range(first, min(first + r.randrange(1, count + 1), count)):
            alpha[i] = 0
    if r.random() < 0.35:
        first = r.randrange(count)
        for i in range(first, min(first + r.choice((1, 1, 2, count // 3 + 1)), count)):
            alpha[i] = 1
    elif r.random() < 0.1:
        alpha[r.randrange(count)] = 1 - 10 ** -r.uniform(2, 7)
    kind = r.choice(("same", "smooth", "noise", "noise"))
    shades, one = [waves(r, 1) for _ in range(3)], [r.random() for _ in range(3)]
    colors = [one if kind == "same" else [s(i / count) for s in shades] if kind == "smooth"
              else [r.choice((0, 1, r.random())) for _ in range(3)] for i in range(count)]
    return [single([*c, a]) for c, a in zip(colors, alpha)]


def segments(r, size):
    """Labels of voxels, each by chance or in regions; functions of all but the last, perhaps, and which of them are on."""
    count = r.randrange(2, 5)
    top, wave, scattered = count + (r.random() < 0.3), waves(r, 3), r.random() < 0.4
    labels = [r.randrange(top) if scattered else min(int(top * wave(*((i + 0.5) / n for i, n in zip(at, size)))), top - 1)
              for at in ((x, y, z) for z in range(size[2]) for y in range(size[1]) for x in range(size[0]))]
    return {"labels": labels, "functions": [function(r) for _ in range(count)],
            "enabled": [r.random() < 0.8 for _ in range(r.choice((0, count, top)))]}


def placed(r, dimensions, where):
    """In view of an eye at 0 0 1 that looks along -z."""
    scale = [1, 1, 1]
    place = {"translation": [r.uniform(-0.15, 0.15) for _ in range(3)]}
    if where == "face":
        place["translation"][2] = 1 - dimensions[2] / 2
        return place
    if where == "inside":
        place["translation"][2] = 1 + r.uniform(-0.4, 0.3) * min(dimensions)
    if r.random() < 0.85:
        place["rotation"] = [*axis(r), r.uniform(0, 6.2)]
    if r.random() < 0.35:
        scale = [r.choice((1, -1)) * 2 ** r.uniform(-1, 0.5) for _ in range(3)]
        place["scale"] = scale
        if r.random() < 0.5:
            place["scaleOrientation"] = [*axis(r), r.uniform(0, 6.2)]
    return place


def one_volume(r, where):
    large = r.random() < 0.2
    size = [r.randrange(17, 34) if large and r.random() < 0.7 else r.choice((1, 2, 3, r.randrange(1, 10)))
            for _ in range(3)]
    kind = r.choice(("f32", "f32", "u8", "u16"))
    dimensions = [round(r.uniform(0.3, 0.9), 3) for _ in range(3)]
    made = {"size": size, "type": kind, "numbers": voxels(r, size, kind), "dimensions": dimensions,
            "place": placed(r, dimensions, where), "texels": function(r),
            "unit": r.choice((0, 0, round(10 ** r.uniform(-2.5, 0), 4)))}
    if r.random() < SEGMENTED:
        made["segments"] = segments(r, size)
    if r.random() < 0.15:
        made["factor"] = r.choice((0, 1, r.random(), r.random()))
    if r.random() < 0.2:
        low = [round(r.uniform(0, 0.5), 3) * (r.random() < 0.6) for _ in range(3)]
        made["crop"] = [low, [round(r.uniform(a + 0.1, 1), 3) for a in low]]
    return made


def random_case(r, parallel, error):
    where = r.choice(("outside",) * 5 + ("inside", "face"))
    case = {"parallel": parallel, "error": error,
            "volumes": [one_volume(r, where) for _ in range(2 if r.random() < 0.2 else 1)]}
    if r.random() < 0.15:
        case["clips"] = [[*axis(r), round(r.uniform(-0.1, 0.2), 3)] for _ in range(r.randrange(1, 3))]
        if where == "inside":
            for clip in case["clips"]:
                clip[3] -= clip[2] * 0.9
    return case


# ---- scenes


VIEWS = {True: "OrthoViewpoint { position 0 0 1 fieldOfView -.45 -.45 .45 .45 }\n",
         False: "Viewpoint { position 0 0 1 fieldOfView .8 }\n"}


def data_file(one):
    name, code = NRRD_TYPES[one["type"]]
    head = (f"NRRD0004\ntype: {name}\ndimension: 3\nsizes: {' '.join(map(str, one['size']))}\n"
            "encoding: raw\nendian: little\n\n")
    return head.encode() + struct.pack(f"<{len(one['numbers'])}{code}", *one["numbers"])


def style(texels, factor, name, files):
    files[name] = function_file(texels)
    text = f'OpacityMapVolumeStyle {{ transferFunction ImageTexture {{ url "{name}" }} }}'
    if factor is None:
        return text
    return (f"ComposedVolumeStyle {{ renderStyle [ {text} BoundaryEnhancementVolumeStyle {{ boundaryOpacity 0 "
            f"retainedOpacity {factor!r} }} ] }}")


def segmented(one, data, fields, prefix, files):
    parts = one["segments"]
    files[f"{prefix}-labels.nrrd"] = data_file({**one, "type": "u8", "numbers": parts["labels"]})
    styles = [style(texels, one.get("factor"), f"{prefix}-{i}.nrrd", files) for i, texels in enumerate(parts["functions"])]
    enabled = " ".join(str(on).upper() for on in parts["enabled"])
    return (f"SegmentedVolumeData {{ dimensions {words(one['dimensions'])}\n  voxels {data}\n"
            f"  segmentIdentifiers ImageTexture3D {{ url \"{prefix}-labels.nrrd\" }}\n  segmentEnabled [ {enabled} ]\n"
            f"  renderStyle [ {' '.join(styles)} ]\n  {fields} }}\n")


def content(case, prefix):
    """Nodes, and the files that they name."""
    files, parts = {}, []
    for clip in case.get("clips", ()):
        parts.append(f"ClipPlane {{ plane {words(clip)} }}\n")
    for i, one in enumerate(case["volumes"]):
        data = f"{prefix}-{i}.nrrd"
        files[data] = data_file(one)
        fields = f"valueRange 0 {MOST[one['type']]}\n  opacityUnitDistance {one['unit']!r}"
        if "crop" in one:
            fields += f"\n  cropMin {words(one['crop'][0])} cropMax {words(one['crop'][1])}"
        image = f'ImageTexture3D {{ url "{data}" }}'
        if "segments" in one:
            node = segmented(one, image, fields, f"{prefix}-{i}", files)
        else:
            map_ = style(one["texels"], one.get("factor"), f"{prefix}-{i}-function.nrrd", files)
            node = volume(image, map_, "", fields, one["dimensions"])
        place = " ".join(f"{name} {words(value)}" for name, value in one["place"].items())
        parts.append(f"Transform {{ {place} children [\n{node}] }}\n")
    return f"Group {{ children [\n{''.join(parts)}] }}\n", files


# ---- the truth


def with_other_voxels(r, case):
    """A copy, for the raycaster alone, in which each voxel differs by at most what is allowed."""
    volumes = [{**one, "type": "f64", "numbers": [
        n / MOST[one["type"]] + r.choice((-1, 0, 0, 1)) * ULPS[one["type"]] for n in one["numbers"]]} for one in case["volumes"]]
    return {**case, "volumes": volumes}


def functions(one):
    """Of the whole, or of the segments."""
    factor, parts = one.get("factor", 1), one.get("segments")
    if not parts:
        return {"transfer": raycaster.texels(one["texels"], factor)}
    enabled, last = parts["enabled"], len(parts["functions"])
    found = [raycaster.texels(texels, factor) for texels in parts["functions"]]
    found += [None] * (len(enabled) - last)  # the default one
    return {"labels": (one["size"], parts["labels"], "u8"),
            "segments": [raycaster.HIDDEN if i < len(enabled) and not enabled[i] else f or {} for i, f in enumerate(found)]}


def jobs(case, change=None):
    """`change`: of the voxels of each volume, in parts of what is allowed."""
    change = change or (0,) * len(case["volumes"])
    return [raycaster.volume(
        one["size"], one["numbers"], one["type"], dimensions=one["dimensions"],
        value_range=(0, MOST[one["type"]]), opacity_unit=one["unit"], matrix=raycaster.transform(**one["place"]),
        crop=one.get("crop"), clip_planes=case.get("clips", ()), voxel_change=part * ULPS[one["type"]],
        **functions(one)) for one, part in zip(case["volumes"], change)]


def camera(case):
    return raycaster.camera((0, 0, 1), fieldOfView=(-0.45, -0.45, 0.45, 0.45) if case["parallel"] else 0.8)


def truth(case, pixels, rays=None, change=None):
    return raycaster.truth(jobs(case, change), camera(case), (pixels, pixels), pixels=rays, tolerance=1e-8)
