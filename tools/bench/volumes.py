#!/usr/bin/env python3
"""What casting several volumes costs, as ratios of CPU times on this machine.

usage: volumes.py PLUGRAY [ROUNDS] [--quick]

Two volumes that overlap are drawn together and each alone, unshaded and shaded; and, where VTK 9
(Debian: python3-vtk9) and Xvfb are there, by VTK with the same data, camera, steps and transfer
functions. Then 1, 2, 4, 8, 16 volumes that overlap. All times are CPU times of all threads of a
process for one frame, the least over all rounds: what else the machine does adds, and never
takes away. Output is TAP; a bound that is not kept fails. --quick draws tiny volumes once, by plugray
alone, and judges no time.
"""

import collections
import math
import os
import sys
import tempfile

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))

from speed import data, engines, scenes  # noqa: E402

QUICK = "--quick" in sys.argv
PROGRAM = os.path.abspath(sys.argv[1])
ROUNDS = next((int(word) for word in sys.argv[2:] if word.isdigit()), 1 if QUICK else 3)
LARGE, SMALL = (data.lobb_volume(side) for side in ((16, 8) if QUICK else (128, 64)))
SIZE = 64 if QUICK else 512  # pixels
STEP = 0.5                   # voxels
TOGETHER = 1.3  # two together against the sum of each alone
FASTER = 10.0   # VTK against plugray
MANY = 1.3      # a volume among sixteen against one of two

Place = collections.namedtuple("Place", "shift angle axis")  # degrees


# ---- Scenes ----

def pair_places(side):
    """The second volume is turned by 25 degrees and shifted."""
    return [Place((0, 0, 0), 0, (1, 1, 0)),
            Place((0.3 * (side - 1), 0.1 * (side - 1), 0), 25, (1, 1, 0))]


def crowd_places(side, count):
    """Volumes about one centre, each turned otherwise."""
    return [Place((0.01 * (side - 1) * math.cos(i), 0.01 * (side - 1) * math.sin(i), 0), 3 * i,
                  (1, math.cos(i), math.sin(i))) for i in range(count)]


# as VTK's shading: a diffuse, a specular and an ambient part, from one light at the eye
MATERIAL = ("Material { ambientIntensity .2 diffuseColor .7 .7 .7 specularColor .3 .3 .3 "
            "shininess .15625 }")


def scene_text(volume, places, shaded):
    style = scenes.style(volume)
    if shaded:
        style = ("ComposedVolumeStyle { renderStyle [ %s ShadedVolumeStyle { lighting TRUE "
                 "material %s } ] }" % (style, MATERIAL))
    nodes = "".join("Transform { translation %.9g %.9g %.9g rotation %.9g %.9g %.9g %.9g children %s }\n"
                    % (*place.shift, *scenes.unit(place.axis), math.radians(place.angle),
                       scenes.volume_node(volume, style)) for place in places)
    return scenes.scene(volume, node=nodes)


# ---- Times ----

class Ours:
    def __init__(self, folder):
        self.plugray = engines.Plugray(PROGRAM, folder)

    def cost(self, volume, places, shaded, picture=None):
        text = scene_text(volume, places, shaded)
        words = ("--step", str(STEP))
        return self.plugray.render(text, words, SIZE, picture, 1 if QUICK else 3)["frame"].cpu


class Theirs:
    """Raises LookupError with the reason where VTK cannot draw here."""

    def __init__(self, folder):
        if QUICK:
            raise LookupError("quick")
        self.vtk = engines.Vtk(folder)

    def cost(self, volume, places, shaded, picture=None):
        return self.vtk.render(volume, "gpu", STEP, SIZE, shaded=shaded, places=places, picture=picture, budget=0).cpu

    def close(self):
        self.vtk.close()


def least(cases, rounds):
    """The least time of each case; the cases take turns, so that a busy minute hits all of them."""
    times = {name: math.inf for name in cases}
    for _ in range(rounds):
        for name, measure in cases.items():
            times[name] = min(times[name], measure())
    return times


# ---- Checks ----

count = failed = 0


def report(fine, text, *details):
    global count, failed
    count += 1
    failed += not (fine or QUICK)
    print(f"{'ok' if fine or QUICK else 'not ok'} {count} - {text}")
    for detail in details:
        print(f"# {detail}")
    sys.stdout.flush()


def skip(text, why):
    global count
    count += 1
    print(f"ok {count} - {text} # SKIP {why}")


def picture_difference(plugray, vtk, folder):
    """Root mean square between the two pictures of one volume, colours from 0 to 1."""
    places = pair_places(LARGE.side)[:1]
    files = os.path.join(folder, "vtk.rgba"), os.path.join(folder, "plugray.npy")
    vtk.cost(LARGE, places, False, files[0])
    plugray.cost(LARGE, places, False, files[1])
    theirs, ours = engines.read_vtk(files[0], SIZE), engines.read_npy(files[1])
    return math.sqrt(sum((a - b) ** 2 for i, (a, b) in enumerate(zip(ours, theirs)) if i % 4 != 3) / (3 * SIZE * SIZE))


def check_pair(plugray, vtk, shaded):
    how = "shaded" if shaded else "unshaded"
    places = pair_places(LARGE.side)
    cases = {"first": places[:1], "second": places[1:], "together": places}
    ours = least({name: lambda p=p: plugray.cost(LARGE, p, shaded) for name, p in cases.items()}, ROUNDS)
    ratio = ours["together"] / (ours["first"] + ours["second"])
    report(ratio <= TOGETHER, f"two volumes {how}: {ratio:.2f} times each alone, of at most {TOGETHER}",
           "CPU ms: first %(first).0f, second %(second).0f, together %(together).0f" % ours)
    title = f"two volumes {how}: as VTK"
    if isinstance(vtk, str):
        skip(title, vtk)
        return
    theirs = least({name: lambda p=p: vtk.cost(LARGE, p, shaded) for name, p in cases.items()},
                   min(ROUNDS, 2))
    ratio = theirs["together"] / ours["together"]
    report(ratio >= FASTER, f"two volumes {how}: {ratio:.1f} times less than VTK, of at least {FASTER:g}",
           "CPU ms of VTK: first %(first).0f, second %(second).0f, together %(together).0f" % theirs,
           "one volume: %.2f times less than VTK" % (theirs["first"] / ours["first"]))


def check_crowd(plugray):
    numbers = (1, 2) if QUICK else (1, 2, 4, 8, 16)
    times = least({n: lambda n=n: plugray.cost(SMALL, crowd_places(SMALL.side, n), False) for n in numbers},
                  ROUNDS)
    most = numbers[-1]
    ratio = times[most] / times[2] * 2 / most
    report(ratio <= MANY, f"{most} volumes: {ratio:.2f} times {most // 2} times two, of at most {MANY}",
           "CPU ms: " + ", ".join(f"{n} volumes {times[n]:.0f}" for n in numbers))


def main():
    with tempfile.TemporaryDirectory() as folder:
        for volume in (LARGE, SMALL):
            data.write(volume, folder)
        plugray = Ours(folder)
        try:
            vtk = Theirs(folder)
        except LookupError as why:
            vtk = str(why)
        try:
            if isinstance(vtk, str):
                skip("one volume: the picture of VTK", vtk)
            else:
                difference = picture_difference(plugray, vtk, folder)
                report(difference < 0.01, f"one volume: the picture of VTK, {difference:.4f} apart")
            for shaded in (False, True):
                check_pair(plugray, vtk, shaded)
            check_crowd(plugray)
        finally:
            if not isinstance(vtk, str):
                vtk.close()
    print(f"1..{count}")
    sys.exit(1 if failed else 0)


main()
