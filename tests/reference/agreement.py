#!/usr/bin/env python3
"""plugray itself with short steps comes to what the reference says: both have the same conventions."""

import os
import random
import sys

folder = os.path.dirname(os.path.abspath(__file__))
sys.path[:0] = [folder, os.path.join(folder, "..", "scenes")]

import reference
from harness import Suite
from scenes import NO_HEADLIGHT, scene, volume, voxels

suite = Suite()
reference.beside(sys.argv[1])


def words(numbers):
    return " ".join(map(repr, numbers))


def numbers_of(seed, size):
    chance = random.Random(seed)
    return bytes(chance.randrange(256) for _ in range(size[0] * size[1] * size[2]))


def opacity_map(texels):
    """Texels of 8 bits."""
    packed = " ".join(f"0x{r:02X}{g:02X}{b:02X}{a:02X}" for r, g, b, a in texels)
    return (f"OpacityMapVolumeStyle {{ transferFunction PixelTexture {{ image {len(texels)} 1 4 "
            f"{packed} }} }}")


def fractions(texels):
    return reference.texels([[c / 255 for c in texel] for texel in texels])


def compare(text, size, volumes, camera, tolerance, **more):
    """Every channel of every pixel."""
    picture = suite.picture(text, "--step", "0.01", size=f"{size[0]}x{size[1]}")
    values, errors = reference.truth(volumes, camera, size, **more)
    worst, covered = 0, 0
    for y in range(size[1]):
        for x in range(size[0]):
            got, true = picture.at(x, y), values.at(x, y)
            covered += true[3] > 0.01
            if errors.at(x, y) < 1e-6:
                worst = max(worst, *(abs(a - b) for a, b in zip(got, true)))
    share = sum(e < 1e-6 for e in errors.data) / len(errors.data)
    suite.check("the reference is sure of itself", share > 0.99, share)
    suite.check("all pixels", worst <= tolerance and covered > size[0] * size[1] / 8, worst, covered)


SOFT = [(0, 0, 255, 0), (255, 200, 0, 40), (0, 255, 0, 10), (255, 0, 90, 120), (90, 90, 255, 60)]


@suite.case
def perspective():
    "a random volume in perspective: axes, order of rows and slices, half voxels at the sides"
    size, grid = (26, 22), (5, 6, 7)
    numbers = numbers_of(1, grid)
    position, turn, dimensions = (1.1, 0.7, 1.9), (-0.4, 0.6, 0.1, 0.6), (1.2, 0.8, 1)
    text = scene(f"Viewpoint {{ position {words(position)} orientation {words(turn)} fieldOfView 0.7 }}\n",
                 NO_HEADLIGHT, volume(voxels(1, grid, numbers), opacity_map(SOFT),
                                      dimensions=dimensions))
    compare(text, size,
            [reference.volume(grid, numbers, dimensions=dimensions, transfer=fractions(SOFT))],
            reference.camera(position, turn, 0.7), 1e-4)


HARD = [(0, 0, 255, 0), (255, 200, 0, 0), (0, 255, 0, 200), (255, 0, 90, 255), (90, 90, 255, 255)]


def placed(content, matrix_of):
    """In a Transform, and the same as a matrix."""
    fields = " ".join(f"{name} {words(value)}" for name, value in matrix_of.items())
    return f"Transform {{ {fields} children [\n{content}] }}\n", reference.transform(**matrix_of)


@suite.case
def overlapping():
    "two volumes, turned against each other, with units of their own, an opaque wall through both"
    size, grids = (24, 30), ((4, 5, 3), (6, 3, 4))
    numbers = [numbers_of(seed, grid) for seed, grid in zip((2, 3), grids)]
    places = ({"translation": (0.2, 0.1, 0), "rotation": (1, 2, 0.5, 0.7)},
              {"translation": (-0.1, 0, 0.3), "rotation": (0.3, -1, 0.2, 1.9), "scale": (1.3, 0.8, 1),
               "scaleOrientation": (1, 1, 0, 0.5)})
    styles = (SOFT, SOFT[::-1])
    units = (0.4, 0)
    one, two = (placed(volume(voxels(1, grid, data), opacity_map(style),
                              fields=f"opacityUnitDistance {unit}"), place)
                for grid, data, style, unit, place in zip(grids, numbers, styles, units, places))
    wall, wall_matrix = placed(
        "Shape { appearance Appearance { material UnlitMaterial { emissiveColor .2 .9 .6 } } "
        "geometry IndexedFaceSet { solid FALSE coordIndex [0 1 2 3 -1] coord Coordinate { point "
        "[-.2 -1 -.1, .6 -1 -.1, .6 1 -.1, -.2 1 -.1] } } }\n", {"rotation": (0, 1, 0, 0.5)})
    box = (-0.9, -0.9, 0.9, 0.9)
    text = scene(f"OrthoViewpoint {{ position 0 0 5 fieldOfView {words(box)} }}\n", NO_HEADLIGHT,
                 one[0], two[0], wall)
    solid = reference.parallelogram((-0.2, -1, -0.1), (0.8, 0, 0), (0, 2, 0), (0.2, 0.9, 0.6),
                                    wall_matrix)
    compare(text, size,
            [reference.volume(grid, data, transfer=fractions(style), matrix=part[1], opacity_unit=unit)
             for grid, data, style, unit, part in zip(grids, numbers, styles, units, (one, two))],
            reference.camera((0, 0, 5), fieldOfView=box), 1e-4, opaque=[solid])


@suite.case
def cut():
    "crop box, clip plane, near and far distance, background"
    size, grid = (20, 20), (4, 4, 4)
    numbers = numbers_of(7, grid)
    fields = ("cropMin .1 0 .2 cropMax 1 .8 1 clipPlanes ClipPlane { plane 1 .5 -.2 .1 }")
    view = "position .3 .2 1.6 fieldOfView .6 nearDistance 1.3 farDistance 1.9"
    text = scene(f"Viewpoint {{ {view} }}\n", NO_HEADLIGHT,
                 "Background { skyColor .2 .3 .6 transparency .25 }\n",
                 volume(voxels(1, grid, numbers), opacity_map(SOFT), fields=fields))
    compare(text, size,
            [reference.volume(grid, numbers, transfer=fractions(SOFT),
                              crop=((0.1, 0, 0.2), (1, 0.8, 1)), clip_planes=[(1, 0.5, -0.2, 0.1)])],
            reference.camera((0.3, 0.2, 1.6), fieldOfView=0.6, nearDistance=1.3, farDistance=1.9),
            1e-4, background=(0.2, 0.3, 0.6, 0.75))


@suite.case
def opaque():
    "functions up to alpha 1: short steps come near, the nearer the shorter"
    size, grid = (20, 20), (3, 4, 3)
    numbers = numbers_of(5, grid)
    position = (0.4, 0.3, 2.2)
    text = scene(f"Viewpoint {{ position {words(position)} fieldOfView 0.5 }}\n", NO_HEADLIGHT,
                 volume(voxels(1, grid, numbers), opacity_map(HARD)))
    compare(text, size, [reference.volume(grid, numbers, transfer=fractions(HARD))],
            reference.camera(position, fieldOfView=0.5), 3e-3)


@suite.case
def segments():
    "labels and a function for each segment"
    size, grid = (22, 18), (4, 3, 5)
    numbers = numbers_of(8, grid)
    labels = bytes(n % 4 for n in numbers_of(9, grid))
    position, turn = (1.2, 0.5, 1.7), (-0.3, 0.8, 0.1, 0.65)
    third = SOFT[1:4]
    text = scene(f"Viewpoint {{ position {words(position)} orientation {words(turn)} fieldOfView 0.7 }}\n",
                 NO_HEADLIGHT,
                 f"SegmentedVolumeData {{ voxels {voxels(1, grid, numbers)} "
                 f"segmentIdentifiers {voxels(1, grid, labels)} segmentEnabled [ TRUE FALSE TRUE ] "
                 f"renderStyle [ {opacity_map(SOFT)} {opacity_map(SOFT)} {opacity_map(third)} ] }}\n")
    compare(text, size,
            [reference.volume(grid, numbers, labels=(grid, labels, "u8"),
                              segments=[fractions(SOFT), reference.HIDDEN, fractions(third)])],
            reference.camera(position, turn, 0.7), 6e-3)


suite.run()
