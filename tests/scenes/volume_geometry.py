#!/usr/bin/env python3
"""fileGeometry: size, shear and place from the file; left stays left. volume_geometry.py PLUGRAY"""

import math
import struct

from harness import Suite, opacity, rotate

suite = Suite()

# Four voxels that no rotation carries into a mirror image: the corner where all indices are 0, and
# the far ends of the three edges from there. Everything else is empty.
SIZE = (3, 4, 5)
CORNERS = {(0, 0, 0): 64, (2, 0, 0): 128, (0, 3, 0): 192, (0, 0, 4): 255}
AXIS, ANGLE = (0.6, 0.0, -0.2), 2.4  # of the camera: no two corners close to each other in any case
PIXELS = 120


def voxels():
    data = bytearray(SIZE[0] * SIZE[1] * SIZE[2])
    for (i, j, k), value in CORNERS.items():
        data[(k * SIZE[1] + j) * SIZE[0] + i] = value
    return bytes(data)


def nrrd(*fields, data=None, size=SIZE):
    lines = ["NRRD0005", "type: uint8", "dimension: 3", "sizes: " + " ".join(map(str, size)),
             "encoding: raw", *fields, ""]
    return "\n".join(lines).encode() + b"\n" + (data or voxels())


def nifti(qform=None, sform=None, sign=1.0, pixdim=(2, 3, 1)):
    """NIfTI-1 with the quaternion (b, c, d) and offset `qform`, or the rows `sform`; millimetres."""
    header = bytearray(352)
    struct.pack_into("<i", header, 0, 348)
    struct.pack_into("<8h", header, 40, 3, *SIZE, 1, 1, 1, 1)
    struct.pack_into("<hh", header, 70, 2, 8)
    struct.pack_into("<8f", header, 76, sign, *pixdim, 0, 0, 0, 0)
    struct.pack_into("<f", header, 108, 352)
    header[123] = 2
    struct.pack_into("<hh", header, 252, 1 if qform else 0, 1 if sform else 0)
    if qform:
        struct.pack_into("<6f", header, 256, *qform)
    if sform:
        struct.pack_into("<12f", header, 280, *[number for row in sform for number in row])
    header[344:348] = b"n+1\0"
    return bytes(header) + voxels()


def scene(name, half, unit="", before="", after="", fields="fileGeometry TRUE", center=(0, 0, 0)):
    """Seen from afar in the direction of the test's camera, `half` a picture high."""
    back = rotate(AXIS, ANGLE, (0, 0, 1))
    position = [c + 100 * half * b for c, b in zip(center, back)]
    return f"""#X3D V3.3 utf8
{unit}
OrthoViewpoint {{ position {position[0]} {position[1]} {position[2]}
  orientation {AXIS[0]} {AXIS[1]} {AXIS[2]} {ANGLE} fieldOfView [ {-half} {-half} {half} {half} ] }}
{before} VolumeData {{ {fields} voxels ImageTexture3D {{ url "{name}" }}
  renderStyle ProjectionVolumeStyle {{ type "MAX" }} }} {after}
"""


def pixel(point, center, half):
    """Column and row where the camera sees a point of the scene."""
    seen = rotate(AXIS, -ANGLE, [p - c for p, c in zip(point, center)])
    return (int((seen[0] / half + 1) / 2 * PIXELS), int((1 - seen[1] / half) / 2 * PIXELS))


def check_corners(name, data, where, half, center, **options):
    """Each of the four is seen where `where` (of its indices) says."""
    file = "v.nii" if data[:4] == b"\x5c\x01\0\0" else "v.nrrd"
    pixels = [pixel(where(corner), center, half) for corner in CORNERS]
    seen = suite.probe(scene(file, half, center=center, **options), pixels, "--step", "0.1",
                       size=f"{PIXELS}x{PIXELS}", files={file: data})
    # half a pixel beside the centre, of a voxel of several: a little less than its value
    fine = all(abs(color[0] - value / 255) < 0.07 for color, value in zip(seen, CORNERS.values()))
    suite.check(name, fine, f"at {pixels}", f"expected {list(CORNERS.values())}",
                f"got {[round(color[0] * 255) for color in seen]}")


def affine(columns, origin, scale, turn=1):
    """Indices to scene: the columns are the steps along the axes, as the file has them."""
    def where(index):
        point = [scale * (o + sum(columns[axis][row] * index[axis] for axis in range(3)))
                 for row, o in enumerate(origin)]
        return (turn * point[0], point[1], point[2])
    return where


def middle(where):
    return where([(n - 1) / 2 for n in SIZE])


def directions(columns, origin):
    vectors = " ".join(f"({','.join(map(str, c))})" for c in columns)
    return (f"space directions: {vectors}", f"space origin: ({','.join(map(str, origin))})",
            'space units: "mm" "mm" "mm"')


OBLIQUE = ((1.9, 0.3, -0.2), (-0.5, 2.9, 0.4), (0.1, -0.2, 1.1))
SHEARED = ((2, 0, 0), (0, 3, 0), (0, 1.2, 1.0))
MIRRORED = ((-2, 0, 0), (0, 3, 0), (0, 0, 1))
ORIGIN = (50, -30, 12)
HALF = 0.009


@suite.case
def spaces():
    """voxels in the scene"""
    for space, turn in (("RAS", 1), ("LPS", 1), ("LAS", -1), ("3D-left-handed", -1)):
        where = affine(OBLIQUE, ORIGIN, 1e-3, turn)
        check_corners(space, nrrd(f"space: {space}", *directions(OBLIQUE, ORIGIN)), where, HALF, middle(where))
    for name, columns in (("a gantry tilt", SHEARED), ("voxels in mirrored order", MIRRORED)):
        where = affine(columns, ORIGIN, 1e-3)
        check_corners(name, nrrd("space: LPS", *directions(columns, ORIGIN)), where, HALF, middle(where))


@suite.case
def nifti_files():
    """NIfTI"""
    where = affine(((2, 0, 0), (0, 3, 0), (0, 0, 1)), (7, 8, 9), 1e-3)
    check_corners("qform", nifti((0, 0, 0, 7, 8, 9)), where, HALF, middle(where))
    where = affine(((2, 0, 0), (0, 3, 0), (0, 0, -1)), (7, 8, 9), 1e-3)
    check_corners("a negative pixdim[0]", nifti((0, 0, 0, 7, 8, 9), sign=-1.0), where, HALF, middle(where))
    rows = [[OBLIQUE[column][row] for column in range(3)] + [ORIGIN[row]] for row in range(3)]
    where = affine(OBLIQUE, ORIGIN, 1e-3)
    check_corners("sform", nifti(sform=rows), where, HALF, middle(where))
    where = affine(((2, 0, 0), (0, 3, 0), (0, 0, 1)), (-2, -4.5, -2), 1e-3)
    check_corners("neither: centred", nifti(sign=-1.0), where, HALF, (0, 0, 0))


@suite.case
def surroundings():
    """units and transformations"""
    data = nrrd("space: LPS", *directions(OBLIQUE, ORIGIN))
    where = affine(OBLIQUE, ORIGIN, 1)
    check_corners("a scene in millimetres", data, where, HALF * 1000, middle(where),
                  unit="UNIT length millimetre 0.001")
    where = affine(OBLIQUE, ORIGIN, 1e-3)

    def turned(index):
        x, y, z = where(index)
        return (-2 * y + 1, 2 * x, 2 * z)

    check_corners("below a Transform", data, turned, 2 * HALF, middle(turned),
                  before="Transform { translation 1 0 0 rotation 0 0 1 1.5707963 scale 2 2 2 children",
                  after="}")
    where = affine(((1, 0, 0), (0, 0.5, 0), (0, 0, 0.4)), (-1, -0.75, -0.8), 1)
    check_corners("a file without geometry: dimensions", nrrd(), where, 1.6, (0, 0, 0),
                  fields="fileGeometry TRUE dimensions 3 2 2")
    done = suite.render(scene("v.nrrd", 1), "-o", "a.png", files={"v.nrrd": nrrd()})
    suite.check("a warning then, at the field",
                "scene.x3dv:5:" in done.errors and "warning: the data tell no size" in done.errors, done.errors)
    data = nrrd("spacings: 1 0.5 0.4", 'units: "m" "m" "m"')
    check_corners("dimensions do not count where there is one", data, where, 1.6, (0, 0, 0),
                  fields="fileGeometry TRUE dimensions 7 7 7")


@suite.case
def lengths():
    """opacity follows the voxels' own lengths"""
    constant = nrrd("space: LPS", "space directions: (0.5,0,0) (0,2,0) (0,0,8)", "space origin: (0,0,0)",
                    'space units: "m" "m" "m"', data=bytes([51] * 60))
    text = """#X3D V3.3 utf8
OrthoViewpoint { position 0.5 3 200 fieldOfView [ -0.1 -0.1 0.1 0.1 ] }
VolumeData { fileGeometry TRUE voxels ImageTexture3D { url "v.nrrd" } }
"""
    seen = suite.middle(text, files={"v.nrrd": constant})
    # 5 voxels of 8 m; an opacity of 0.2 holds for the geometric mean of the sides
    suite.close("along z", seen[3], opacity(0.2, 40, (0.5 * 2 * 8) ** (1 / 3)), 1e-4)
    suite.check("not mere coincidence", not math.isclose(seen[3], opacity(0.2, 5, 1), abs_tol=1e-2), seen)


suite.run()
