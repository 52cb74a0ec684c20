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


suite.run()
