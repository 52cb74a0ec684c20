"""Asks the double-precision raycaster for the true colours of pixels.

    import reference
    values, error_bar = reference.truth(
        volumes=[reference.volume((2, 2, 2), bytes([0, 255, 0, 255, 0, 255, 0, 255]),
                                  transfer=reference.texels([(1, 0, 0, 0), (1, 0, 0, 0.5)]))],
        camera=reference.camera(position=(0, 0, 10), fieldOfView=(-1, -1, 1, 1)),
        size=(64, 64))
    red, green, blue, alpha = values.at(31, 31)  # premultiplied; column, row from the top
    assert abs(red - got) <= wanted + error_bar.at(31, 31)

`truth` gives two Arrays (or, for single pixels, two lists in their order): premultiplied RGBA, and for each
pixel how much any of its channels may be wrong. The program is found by the environment variable PLR_REFERENCE,
or beside the plugray of the same build: call `reference.use(program)` or `reference.beside(plugray)`.

What a job holds is told in README.md; the builders below write its parts, with the names that X3D uses for the
same things. Everything is given in the units of the scene, angles in radians.
"""

import array
import json
import math
import os
import struct
import subprocess
import sys
import tempfile

CODES = {"u8": "B", "u16": "H", "f32": "f", "f64": "d"}
IDENTITY = (1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1)

program = os.environ.get("PLR_REFERENCE")
report = {}  # of the last job: pixels, not_converged (error bar above 1e-6), largest_error


class Failed(Exception):
    """The program did not answer."""


def use(path):
    """Says where the program is."""
    global program
    program = os.path.abspath(path)


def beside(plugray):
    """The program of the build that a `plugray` belongs to (BUILD/tools/plugray, or BUILD/tools/plugray/plugray)."""
    folder = os.path.dirname(os.path.abspath(plugray))
    for _ in range(3):
        path = os.path.join(folder, "tests", "reference", "plr-reference")
        if os.path.exists(path):
            return use(path)
        folder = os.path.dirname(folder)
    raise Failed(f"no plr-reference beside {plugray}")


# ---- the truth


def truth(volumes, camera, size, *, background=None, opaque=(), pixels=None, threads=1,
          tolerance=None, touches_pass=False, folder=None):
    """The true colours of a picture.

    volumes: a list of `volume(...)`; camera: `camera(...)`; size: (width, height).
    background: straight RGBA behind everything (default: nothing, transparent black).
    opaque: a list of `plane`, `sphere`, `box`, `parallelogram`.
    pixels: None for all, else a list of (x, y) or (x, y, dx, dy): column and row from the top left, and a shift of the
        ray in parts of a pixel, to the right and down. Then both results are lists in this order.
    tolerance: of one piece of a ray (default 1e-10; the error bar tells what came out).
    touches_pass: alpha 1 in a single point of a ray (the tip of a tent) does not stop it.
    Returns (values, error_bar): `values.at(x, y)` are four numbers, premultiplied; `error_bar.at(x, y)` is one.
    """
    job = {"size": list(size), "camera": camera, "volumes": [], "opaque": list(opaque)}
    if background is not None:
        job["background"] = list(background)
    if tolerance:
        job["tolerance"] = tolerance
    if touches_pass:
        job["touchesPass"] = True
    with tempfile.TemporaryDirectory(prefix="plr-reference-", dir=folder) as place:
        for number, one in enumerate(volumes):
            job["volumes"].append(with_files(one, os.path.join(place, str(number))))
        return run(job, place, pixels, threads)


def with_files(one, prefix):
    """A volume whose numbers lie in files."""
    written = dict(one)
    for part, suffix in ((written, "voxels"), (written.get("labels"), "labels")):
        if part is not None and "numbers" in part:
            part = dict(part)
            path = f"{prefix}.{suffix}"
            with open(path, "wb") as file:
                file.write(packed(part.pop("numbers"), part["type"]))
            part["file"] = path
            if suffix == "voxels":
                written = part
            else:
                written["labels"] = part
    return written


def packed(numbers, kind):
    if isinstance(numbers, (bytes, bytearray)):
        return bytes(numbers)
    data = array.array(CODES[kind], numbers)
    if sys.byteorder == "big":
        data.byteswap()
    return data.tobytes()


def run(job, place, pixels=None, threads=1):
    """Runs a job, a dictionary, in a folder."""
    if program is None:
        raise Failed("where is plr-reference? set PLR_REFERENCE, or call use() or beside()")
    paths = [os.path.join(place, name) for name in ("job.json", "values.npy", "error.npy", "list")]
    with open(paths[0], "w", encoding="utf-8") as file:
        json.dump(job, file)
    command = [program, paths[0], "-o", paths[1], "--error", paths[2], "--threads", str(threads)]
    if pixels is not None:
        with open(paths[3], "w", encoding="utf-8") as file:
            for pixel in pixels:
                file.write(" ".join(repr(float(v)) for v in (*pixel, 0, 0)[:4]) + "\n")
        command += ["--pixels", paths[3]]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    if done.returncode:
        raise Failed(done.stderr.strip())
    report.clear()
    report.update(json.loads(done.stdout))
    values, errors = Array(paths[1]), Array(paths[2])
    if pixels is None:
        return values, errors
    return [tuple(values.data[4 * i : 4 * i + 4]) for i in range(len(pixels))], list(errors.data)


class Array:
    """Float64 in numpy's format: `shape`, `data` (flat), `at(x, y)`."""

    def __init__(self, path):
        with open(path, "rb") as file:
            data = file.read()
        size = struct.unpack_from("<H", data, 8)[0]
        header = eval(data[10 : 10 + size], {"__builtins__": {}})  # a literal dictionary
        self.shape = header["shape"]
        self.data = array.array("d", data[10 + size :])
        if sys.byteorder == "big":
            self.data.byteswap()
        self.height, self.width = (*self.shape, 1)[:2]

    def at(self, x, y):
        if len(self.shape) == 2:
            return self.data[y * self.width + x]
        start = 4 * (y * self.width + x)
        return tuple(self.data[start : start + 4])


# ---- parts of jobs


def camera(position=(0, 0, 10), orientation=(0, 0, 1, 0), fieldOfView=math.pi / 4, nearDistance=0,
           farDistance=0, matrix=IDENTITY):
    """A Viewpoint, or with four numbers for fieldOfView an OrthoViewpoint; matrix: of the Transforms around it."""
    return {"position": list(position), "orientation": list(orientation),
            "fieldOfView": list(fieldOfView) if hasattr(fieldOfView, "__iter__") else fieldOfView,
            "nearDistance": nearDistance, "farDistance": farDistance, "matrix": list(matrix)}


def volume(size, numbers, type="u8", *, transfer=None, dimensions=(1, 1, 1), matrix=IDENTITY,
           value_range=None, crop=None, clip_planes=(), opacity_unit=0, voxel_change=0,
           labels=None, segments=None, other_segments=None, shading=None, offset=None):
    """A volume.

    size: voxels along x, y, z; numbers: x fastest, then y (row 0 at -Y), then z (slice 0 at -Z): a list, bytes, or the
        path of a raw file (with `offset`); type: u8, u16, f32, f64.
    transfer: `texels(...)` or `points(...)`; None is the default ramp, (v, v, v, v).
    value_range: numbers that become 0 and 1 (default: 0..255 of u8, else the data's least and greatest).
    crop: (cropMin, cropMax); clip_planes: (a, b, c, d) in the world, the negative side is cut away.
    matrix: volume to world, 16 numbers by rows (see `transform`); opacity_unit: opacityUnitDistance.
    voxel_change: added to all values, after the range and before they are clamped to 0..1.
    labels: (size, numbers, type) of segment numbers; segments: a list of transfers, `HIDDEN` for none; other_segments:
        the transfer of all numbers above.
    shading: `vtk_shading(...)`.
    """
    made = {"size": list(size), "type": type, "dimensions": list(dimensions), "matrix": list(matrix),
            "clipPlanes": [list(p) for p in clip_planes], "opacityUnitDistance": opacity_unit,
            "voxelChange": voxel_change, **data(numbers, offset)}
    optional = {"transfer": transfer, "range": value_range and list(value_range),
                "cropMin": crop and list(crop[0]), "cropMax": crop and list(crop[1]),
                "segments": segments, "otherSegments": other_segments, "shading": shading}
    if labels:
        optional["labels"] = {"size": list(labels[0]), "type": labels[2], **data(labels[1])}
    made.update((name, value) for name, value in optional.items() if value is not None)
    return made


def data(numbers, offset=None):
    if isinstance(numbers, str):
        return {"file": os.path.abspath(numbers), "offset": offset or 0}
    return {"numbers": numbers}


HIDDEN = {"hidden": True}


def texels(colors, opacity=1, tint=(1, 1, 1)):
    """A transfer function by the texels of its texture, straight RGBA: values 0 and 1 are the outer ones' centres.
    `opacity` multiplies alpha and `tint` RGB, then both are clamped: what styles that are constant factors do."""
    return {"texels": [list(c) for c in colors], "opacity": opacity, "tint": list(tint)}


def points(rows, opacity=1, tint=(1, 1, 1)):
    """A transfer function by points (value, r, g, b, a) in ascending order; two of one value are a jump."""
    return {"points": [list(row) for row in rows], "opacity": opacity, "tint": list(tint)}


def vtk_shading(ambient=0.2, diffuse=0.7, specular=0.3, power=20, light="ray", unclamped=False):
    """VTK's formula with a headlight. light: "ray" - it shines along each ray -, or "camera" - from the camera's
    place to where the ray enters the volume, as VTK does with parallel rays too. unclamped: colours may exceed 1."""
    return {"ambient": ambient, "diffuse": diffuse, "specular": specular, "power": power,
            "light": light, "unclamped": unclamped}


def plane(a, b, c, d, color):
    """Opaque, where a x + b y + c z + d = 0."""
    return {"plane": [a, b, c, d], "color": list(color)}


def sphere(center, radius, color, matrix=IDENTITY):
    return {"sphere": [*center, radius], "color": list(color), "matrix": list(matrix)}


def box(least, greatest, color, matrix=IDENTITY):
    return {"box": [*least, *greatest], "color": list(color), "matrix": list(matrix)}


def parallelogram(corner, edge, other_edge, color, matrix=IDENTITY):
    return {"parallelogram": [*corner, *edge, *other_edge], "color": list(color),
            "matrix": list(matrix)}


# ---- matrices, by rows


def multiply(*matrices):
    """The first is the outermost."""
    result = IDENTITY
    for m in matrices:
        result = tuple(sum(result[i // 4 * 4 + k] * m[4 * k + i % 4] for k in range(4))
                       for i in range(16))
    return result


def transform(translation=(0, 0, 0), rotation=(0, 0, 1, 0), scale=(1, 1, 1), center=(0, 0, 0),
              scaleOrientation=(0, 0, 1, 0)):
    """Of X3D's Transform: T C R SR S -SR -C."""
    x, y, z, angle = scaleOrientation
    stretch = (scale[0], 0, 0, 0, 0, scale[1], 0, 0, 0, 0, scale[2], 0, 0, 0, 0, 1)
    return multiply(moved(translation), moved(center), turned(rotation), turned(scaleOrientation),
                    stretch, turned((x, y, z, -angle)), moved([-c for c in center]))


def moved(by):
    return (1, 0, 0, by[0], 0, 1, 0, by[1], 0, 0, 1, by[2], 0, 0, 0, 1)


def turned(rotation):
    x, y, z, angle = rotation
    length = math.sqrt(x * x + y * y + z * z)
    x, y, z = x / length, y / length, z / length
    c, s = math.cos(angle), math.sin(angle)
    t = 1 - c
    return (c + t * x * x, t * x * y - s * z, t * x * z + s * y, 0,
            t * x * y + s * z, c + t * y * y, t * y * z - s * x, 0,
            t * x * z - s * y, t * y * z + s * x, c + t * z * z, 0, 0, 0, 0, 1)
