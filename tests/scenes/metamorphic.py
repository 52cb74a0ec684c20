#!/usr/bin/env python3
"""Random scenes, changed in ways that must not change the picture, or change it in a known way.

metamorphic.py PLUGRAY [RELATION...]                   a few scenes for each relation
metamorphic.py PLUGRAY --seeds FIRST COUNT [FOLDER]    more of them; what fails is made smaller and written to FOLDER

A relation makes two worlds of one, and says how their pictures are compared. Scenes take turns at the methods of
sampling that the program has, and at an error asked for.
"""

import copy
import os
import random
import sys

LONG = sys.argv[2:] if sys.argv[2:3] == ["--seeds"] else []
if LONG:
    sys.argv = sys.argv[:2]

from harness import CaseError  # noqa: E402
from metamorphic_data import EYES, random_world, shrunk, text_of  # noqa: E402
from stability_data import Stability, pixels_of, worst  # noqa: E402

suite = Stability()
RELATIONS = {}
BITS = 0  # equal to the bit


def relation(function):
    """(world, chance) -> (one world, the other, tolerance, how pixels of the other are ordered)."""
    RELATIONS[function.__name__] = function
    return function


def as_it_is(pixels):
    return pixels


def flipped(pixels, width=16):
    return [pixels[y * width + width - 1 - x] for y in range(len(pixels) // width) for x in range(width)]


def changed(world, **fields):
    other = copy.deepcopy(world)
    other.update(fields)
    return other


@relation
def translated(world, chance):
    "everything moved by up to a million"
    by = " ".join(str(chance.choice((-1, 1)) * chance.choice((3, 1e3 + 7, 654321, 1e6))) for _ in range(3))
    return world, changed(world, around=f"translation {by}"), 1e-4, as_it_is


@relation
def scaled(world, chance):
    "everything a millionth to a million times as large"
    s = chance.choice((1e-6, 1e-3, 7.0, 1e3, 1e6))
    world = changed(world, eye=EYES[1])  # what a parallel eye sees does not grow with a scale
    return world, changed(world, around=f"scale {s} {s} {s}"), 1e-4, as_it_is


@relation
def turned(world, chance):
    "everything turned"
    return world, changed(world, around=f"rotation 1 2 {chance.choice((-1, 3))} {chance.uniform(-3, 3):.3f}"), 1e-4, as_it_is


@relation
def mirrored(world, _):
    "volumes and lights mirrored: the flipped picture, to the bit"
    return world, changed(world, inside="scale -1 1 1"), BITS, flipped


@relation
def permuted(world, chance):
    "volumes in another order, to the bit"
    if len(world["volumes"]) < 2:
        world = changed(world, volumes=world["volumes"] + random_world(chance.random())["volumes"])
    order = copy.deepcopy(world["volumes"])
    return world, changed(world, volumes=order[1:] + order[:1]), BITS, as_it_is


@relation
def relit(world, chance):
    "lights in reverse order"
    world = changed(world, lights=world["lights"] + random_world(chance.random())["lights"])
    return world, changed(world, lights=world["lights"][::-1]), 2e-6, as_it_is


SWAPS = {  # which old axis is the new x, y, z; the rotation that turns the new box to where the old one was
    (1, 2, 0): (1, 1, 1, 2.0943951023931953),
    (2, 0, 1): (1, 1, 1, -2.0943951023931953),
}


@relation
def exchanged(world, chance):
    "axes of voxels exchanged, and the box turned back"
    axes = chance.choice(list(SWAPS))
    other = copy.deepcopy(world)
    for volume in other["volumes"]:
        old = copy.deepcopy(volume)
        n = old["size"]
        volume["size"] = tuple(n[a] for a in axes)
        volume["dimensions"] = tuple(old["dimensions"][a] for a in axes)
        if old["crop"]:
            volume["crop"] = tuple(tuple(corner[a] for a in axes) for corner in old["crop"])
        numbers = []
        for place in ((i, j, k) for k in range(n[axes[2]]) for j in range(n[axes[1]]) for i in range(n[axes[0]])):
            at = [0, 0, 0]
            for new, axis in enumerate(axes):
                at[axis] = place[new]
            numbers.append(old["numbers"][(at[2] * n[1] + at[1]) * n[0] + at[0]])
        volume["numbers"] = numbers
        volume["turned"] = SWAPS[axes]
    return world, other, 2e-4, as_it_is


@relation
def reversed_axis(world, chance):
    "voxels in reverse order along an axis, and the box mirrored there"
    axis = chance.randrange(3)
    other = copy.deepcopy(world)
    for volume in other["volumes"]:
        w, h, d = volume["size"]
        flip = [lambda i, n, a=a: n - 1 - i if a == axis else i for a in range(3)]
        volume["numbers"] = [volume["numbers"][(flip[2](k, d) * h + flip[1](j, h)) * w + flip[0](i, w)]
                             for k in range(d) for j in range(h) for i in range(w)]
        if volume["crop"]:
            low, high = (list(c) for c in volume["crop"])
            low[axis], high[axis] = 1 - high[axis], 1 - low[axis]
            volume["crop"] = tuple(low), tuple(high)
        volume["turned"] = tuple(-1 if a == axis else 1 for a in range(3))
    return world, other, 2e-4, as_it_is


@relation
def split(world, chance):
    "a box in two to eight parts, cut where steps end"
    volume = copy.deepcopy(world["volumes"][0])
    volume.update(size=(4, 4, 4), numbers=[chance.randrange(20, 236) for _ in range(64)], dimensions=(1, 1, 1), place={},
                  crop=None, style="")
    axes = chance.choice(((2,), (0, 2), (0, 1), (0, 1, 2)))
    parts = [((0, 0, 0), (1, 1, 1))]
    for axis in axes:
        cut = chance.choice((0.25, 0.5, 0.625))
        halves = []
        for low, high in parts:
            middle_high, middle_low = list(high), list(low)
            middle_high[axis] = middle_low[axis] = cut
            halves += [(low, tuple(middle_high)), (tuple(middle_low), high)]
        parts = halves
    whole = changed(world, volumes=[volume], eye=EYES[0])
    return whole, changed(whole, volumes=[dict(volume, crop=part) for part in parts]), 4e-6, as_it_is


@relation
def more_texels(world, _):
    "a transfer function with texels put in between"
    def between(a, b):
        return tuple((x + y) // 2 for x, y in zip(a, b))

    other = copy.deepcopy(world)
    for volume in other["volumes"]:  # all numbers are even: the mean of two is whole
        old = volume["texels"]
        volume["texels"] = [old[0]] + [t for a, b in zip(old, old[1:]) for t in (between(a, b), b)]
    return world, other, 2e-5, as_it_is


@relation
def unseen(world, chance):
    "what is off, clear or elsewhere is added"
    dark = "DirectionalLight { on FALSE color 1 0 0 global TRUE }\n"
    away = dict(copy.deepcopy(random_world(chance.random())["volumes"][0]),
                place={"translation": (chance.choice((-90, 90)), 0, 0)})
    return world, changed(world, lights=[dark] + world["lights"], volumes=world["volumes"] + [away]), 2e-6, as_it_is


# ---- comparing


def picture(world, options):
    return suite.picture(text_of(world), *options)


def way(seed):
    """Options, and what two pictures may differ by because each may be wrong."""
    ways = [(("--step", "0.25", *options), 0) for _, options in suite.methods()]
    ways += [(options, 2 * error) for error, options in suite.planned()]
    return ways[seed % len(ways)]


def difference(world, name, seed):
    """How much a relation is violated, its tolerance, and the two worlds."""
    one, other, tolerance, order = RELATIONS[name](world, random.Random(seed))
    options, more = way(seed)
    if name == "split" and "--method" in options and "midpoint" not in options:
        more = 1.6e-2  # segments look at their neighbours, cells share what error they may have: not across a cut
    a, b = pixels_of(picture(one, options)), order(pixels_of(picture(other, options)))
    return worst(a, b), tolerance + (more if tolerance != BITS else 0), one, other, max(c[3] for c in a)


def check(name, seed):
    error, tolerance, _, _, seen = difference(random_world(seed), name, seed)
    return suite.check(f"seed {seed}, {' '.join(way(seed)[0])}", error <= tolerance and seen > 0.02,
                       f"differs by {error:g}, {tolerance:g} are allowed", f"opacity {seen:g}")


@suite.case
def halved():
    "half the step: the picture tends to one"
    for seed in (71, 72):
        world = random_world(seed)
        pictures = [picture(world, ("--step", str(step))) for step in (0.4, 0.2, 0.1, 0.05)]
        mean = [sum(abs(x - y) for x, y in zip(a.values, b.values)) / len(a.values) for a, b in zip(pictures, pictures[1:])]
        suite.check(f"seed {seed}", all(b <= 0.75 * a + 2e-6 for a, b in zip(mean, mean[1:])) and mean[0] > 1e-7, mean)


def make_case(name, function):
    def case():
        for seed in SEEDS:
            check(name, seed)

    case.__name__, case.__doc__ = name, function.__doc__
    suite.case(case)


SEEDS = (1, 2)
for relation_name, relation_function in RELATIONS.items():
    make_case(relation_name, relation_function)


def search(first, count, folder):
    """Looks for scenes that break a relation."""
    found = 0
    for seed in range(first, first + count):
        for name in RELATIONS:
            def fails(world, name=name, seed=seed):
                try:
                    error, tolerance, *_ = difference(world, name, seed)
                    return error > tolerance
                except CaseError:
                    return True

            world = random_world(seed)
            if not fails(world):
                continue
            found += 1
            world = shrunk(world, fails)
            one, other, tolerance, _ = RELATIONS[name](world, random.Random(seed))
            os.makedirs(folder, exist_ok=True)
            for suffix, which in (("a", one), ("b", other)):
                path = os.path.join(folder, f"{name}-{seed}-{suffix}.x3dv")
                with open(path, "w", encoding="utf-8") as file:
                    file.write(text_of(which).replace("\n", f"\n# {name}, seed {seed}, {' '.join(way(seed)[0])}\n", 1))
            print(f"{name}, seed {seed}: more than {tolerance:g}, see {path}", flush=True)
    print(f"{count} seeds, {len(RELATIONS)} relations, {found} broken")
    return found


def main():
    if not LONG:
        suite.run()
    import tempfile
    with tempfile.TemporaryDirectory(prefix="plugray-metamorphic-") as folder:
        suite.folder = folder
        return 1 if search(int(LONG[1]), int(LONG[2]), (LONG[3:] or ["metamorphic-failures"])[0]) else 0


sys.exit(main())
