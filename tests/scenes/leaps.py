#!/usr/bin/env python3
"""Rays leap over blocks of a volume in which nothing can be seen, and change no bit; where that pays."""

import os
import random

from harness import Picture, Suite, load_json
from scenes import front_scene, scene, volume, voxels

suite = Suite()


def opacity_map(texels):
    return ("OpacityMapVolumeStyle { transferFunction PixelTexture { image %d 1 4 %s } }"
            % (len(texels), " ".join(f"0x{t:08X}" for t in texels)))


def same_bits(name, text, how):
    """The picture with leaps."""
    result = suite.render(text, "-o", "picture.npy", *how, "--stats", "json", size="48x48")
    found = Picture(os.path.join(result.folder, "picture.npy")).values
    suite.check(f"{name}: leaps", load_json(result.output)["plan"]["leaps"])
    suite.check(f"{name}: the same bits", found == suite.picture(text, *how, "--no-leaping", size="48x48").values)
    return found


@suite.case
def octants():
    "rays leap in all directions, from an eye amid the volume, and change no bit"
    dice, side = random.Random(4), 20
    data = voxels(1, (side,) * 3, (dice.randrange(160, 256) if dice.random() < 0.002 else 0 for _ in range(side ** 3)))
    shown = volume(data, opacity_map([0, 0, 0x80C04040, 0xFF8000C0]))
    for turn in (0, 3.1415927):
        text = scene(f"Viewpoint {{ position .02 -.03 .01 orientation .1 1 .2 {turn} fieldOfView 2.6 }}\n", shown)
        for method in ("midpoint", "preintegrated", "cells"):
            how = ("--method", method) if method == "cells" else ("--method", method, "--step", "0.3")
            name = f"{method}, turned by {turn:.2g}"
            found = same_bits(name, text, how)
            suite.check(f"{name}: in all directions something is seen",
                        all(any(found[4 * (48 * y + x) + 3] > 0.01 for y in range(b, b + 24) for x in range(a, a + 24))
                            for a in (0, 24) for b in (0, 24)))


@suite.case
def together():
    "two volumes in one place, in segments: rays leap where both are clear"
    dice, side = random.Random(9), 20
    parts = [volume(voxels(1, (side,) * 3, (dice.randrange(160, 256) if dice.random() < 0.002 else 0
                                            for _ in range(side ** 3))),
                    opacity_map([0, 0, 0x80C04040, 0xFF8000C0])) for _ in range(2)]
    text = scene("Viewpoint { position .3 .2 2 }\n", parts[0],
                 "Transform { rotation 1 2 3 .7 translation .2 -.1 .1 children %s }\n" % parts[1])
    found = same_bits("both", text, ("--method", "preintegrated", "--step", "0.25"))
    suite.check("something is seen", max(found[3::4]) > 0.05, max(found[3::4]))


def leaping(*parts):
    """How many volumes do, where there is no context: there are 16 textures, of which one has the functions."""
    result = suite.command("dump", "scene.x3dv", "-d", "out", files={"scene.x3dv": front_scene(*parts)})
    suite.equal("no word about layers", result.errors, "")
    return open(os.path.join(result.folder, "out", "volume-1.frag"), encoding="utf-8").read().count("uniform usampler3D ")


@suite.case
def mixed():
    "volumes together, sampled in steps: each leaps by its own blocks and changes no bit; where textures are few, some do not"
    dice, side = random.Random(7), 16

    def turned(i, part, function):
        data = voxels(1, (side,) * 3, (dice.randrange(160, 256) if dice.random() < part else 0 for _ in range(side ** 3)))
        return ("Transform { translation %g %g %g rotation 1 .3 .2 %g scale %g 1 1 children %s }\n"
                % (*(dice.uniform(-0.4, 0.4) for _ in range(3)), 0.3 * i, dice.uniform(0.7, 1.3),
                   volume(data, opacity_map(function))))

    crowd = [turned(i, 0.003, [0, 0, 0x80C04040, 0xFF8000C0]) for i in range(9)]
    everywhere = turned(0, 0.5, [0x10204008, 0x80C04080])
    plain = "Transform { translation .9 0 0 children %s }\n" % volume(voxels(2, (2, 2, 2), [0x8040] * 8))
    for name, step, parts in (("three, one of them nowhere clear, one without a function", 0.13,
                               [everywhere, crowd[0], plain]), ("two, one of them without a function", 0.3, [crowd[0], plain]),
                              ("five", 0.2, crowd[:5])):
        found = same_bits(name, front_scene(*parts), ("--step", str(step)))
        suite.check(f"{name}: something is seen", max(found[3::4]) > 0.05, max(found[3::4]))
    for count, expected in ((5, 5), (7, 7), (8, 7), (9, 6)):
        suite.equal(f"{count} volumes: so many leap", leaping(*crowd[:count]), expected)
    suite.equal("not that which is nowhere clear", leaping(everywhere, *crowd[:4]), 4)


@suite.case
def far():
    "leaps end before what can be seen, however long they are"
    length, places = 250, (37, 75, 111, 150, 172, 193, 212)
    data = voxels(1, (length, 2, 2), (255 if i % length in places else 0 for i in range(4 * length)))
    shown = volume(data, opacity_map([0, 0, 0xFF800018]), dimensions=(length, 1, 1))
    for name, x, turn in (("along x", -130, -1.5707963), ("against x", 130, 1.5707963)):
        text = scene(f"Viewpoint {{ position {x} .1 .1 orientation 0 1 0 {turn} fieldOfView .03 }}\n", shown)
        for method in ("midpoint", "preintegrated", "cells"):
            how = ("--method", method) if method == "cells" else ("--method", method, "--step", "0.25")
            found = same_bits(f"{method}, {name}", text, how)
            suite.check(f"{method}, {name}: all of them are seen", max(found[3::4]) > 0.2, max(found[3::4]))


@suite.case
def short():
    "where leaps would be short, measured in steps, nobody leaps"
    dice, side = random.Random(6), 20
    noise = {part: voxels(1, (side,) * 3, (255 if dice.random() < part else 0 for _ in range(side ** 3)))
             for part in (0.1, 0.02, 0.01, 0.002)}
    for part, method, step, leaps in (
            (0.1, "midpoint", 0.5, False), (0.1, "preintegrated", 0.125, False), (0.1, "cells", 0, False),
            (0.01, "preintegrated", 1, False), (0.01, "preintegrated", 0.25, True), (0.02, "preintegrated", 0.25, False),
            (0.02, "midpoint", 0.125, True), (0.02, "midpoint", 1, False), (0.02, "cells", 0, False),
            (0.002, "midpoint", 1, True), (0.002, "preintegrated", 1, True), (0.002, "cells", 0, True)):
        how = ("--method", method) if method == "cells" else ("--method", method, "--step", str(step))
        text = front_scene(volume(noise[part], opacity_map([0, 0, 0xFF800018])))
        found = load_json(suite.render(text, "-o", "picture.npy", *how, "--stats", "json").output)["plan"]["leaps"]
        suite.equal(f"{100 * part} % of voxels, {method}, step {step}", found, leaps)


if __name__ == "__main__":
    suite.run()
