#!/usr/bin/env python3
"""The arithmetic, data and scenes of tools/bench/pareto: pareto.py SOURCE-ROOT PLUGRAY"""

import os
import subprocess
import sys
import tempfile

from tap import check, check_equal, done

sys.dont_write_bytecode = True
ROOT, PLUGRAY = sys.argv[1], os.path.abspath(sys.argv[2])
sys.path.insert(0, os.path.join(ROOT, "tools", "bench"))

from speed import costs, data, engines, measure, rows, scenes, truth  # noqa: E402


def near(got, wanted, part=1e-9):
    return abs(got - wanted) <= part * abs(wanted)


# ---- arithmetic

class Fake:
    """A point that needs no drawing."""

    method = measure.METHODS[0]

    def __init__(self, time, rmse, knob):
        self.time, self.knob, self.slack = time, knob, 0.02
        self.error = type("", (), {"rmse": rmse, "most": rmse})()


curve = [Fake(10, 1e-1, 4), Fake(20, 1e-2, 2), Fake(25, 2e-2, 1.5), Fake(40, 1e-3, 1)]
check_equal([p.time for p in measure.front(curve)], [10, 20, 40], "the front leaves out what is beaten twice")
time, knob = measure.crossing(curve[:2], 10 ** -1.5)
check(near(time, 200 ** 0.5), "an error midway between two points: the geometric mean of their times", time)
check(near(knob, 8 ** 0.5), "and of their knobs", knob)
time, knob = measure.crossing(curve, 1e-2)
check(near(time, 20) and near(knob, 2), "an error that a point has: its time", time, knob)
check(measure.crossing(curve, 1e-4) is None, "an error that no point reaches: none")
check(near(measure.front_time(curve, 10 ** -2.5), (20 * 40) ** 0.5), "the time of the front between two of its points")
check_equal(measure.front_time(curve, 0.5), 10, "any error above the first point's: that one's time")
check(measure.front_time(curve, 1e-9) == float("inf"), "an error that the front does not reach: never")
check(near(rows.exponent((1, 2, 4, 8), (3, 12, 48, 192)), 2), "the exponent of a square")
check(near(measure.standard_error((9, 11, 9, 11)), (4 / 3) ** 0.5 / 2 / 10), "a standard error, relative")
error = measure.Error([0.0, 1.0, 0.5, 0.25], [0.0, 1.0, 0.0, 0.25])
check((error.rmse, error.most) == (0.25, 0.5), "the error of a picture", error.rmse, error.most)

for value, more, wanted in ((10, {}, "reached"), (9.9, {}, "**not reached**"), (9.9, {"noise": 0.2}, "within noise"),
                            (8.5, {"least": 8}, "the least is reached"), (None, {}, "not measured"),
                            (9, {"greater": False}, "reached"), (11, {"greater": False}, "**not reached**")):
    check_equal(rows.Row("", "", value, 10, **more).reached, wanted, f"a row of {value}, bar 10, {more}")

# ---- data

with tempfile.TemporaryDirectory() as folder:
    lobb = data.lobb_volume(64)
    data.write(lobb, folder)
    check_equal(data.digest(lobb, folder), "fda9420f7dd540ba", "ml64 is the data that VTK was measured with")
    for percent in (9, 22, 81):
        values = data.spheres(64, percent / 100)
        places = [(i % 64, i // 64 % 64, i // 4096) for i, v in enumerate(values) if v]
        part = len(data.blocks_of(places, 64)) / 512
        check(abs(part - percent / 100) < 0.01, f"{percent} % of the blocks of spheres are occupied", part)
    for volume in (lobb, data.head_volume(256), data.sphere_volume(64, 9), data.smooth_volume(64)):
        knots = [v for v, _ in (*volume.color, *volume.opacity)]
        check(all(abs(k / volume.top * (volume.texels - 1) % 1 - 0.5) > 0.4999 for k in knots),
              f"every point of the function of {volume.name} is the centre of a texel")
    slice_of_head = data.head(32)
    check(slice_of_head[0] < 10 and max(slice_of_head) > 240 and len(slice_of_head) == 32 ** 3,
          "a head: air around it, a wire in it")

    # ---- scenes: judged by the reference

    truth.reference.beside(PLUGRAY)
    plugray = engines.Plugray(PLUGRAY, folder)
    picture = os.path.join(folder, "picture.npy")
    for perspective, shaded in ((False, False), (True, False), (False, True), (True, True)):
        setting = measure.Setting(lobb, 32, perspective, shaded)
        stats = plugray.render(setting.scene, ("--step", "0.125"), 32, picture)
        error = measure.Error(engines.read_npy(picture), truth.make(setting, folder).numbers)
        check(error.rmse < 1e-3, f"{setting.name}: as the truth", error.rmse, error.most)
        check_equal(stats["messages"], "", f"{setting.name}: no message")
    bare = engines.Plugray(PLUGRAY, folder)
    bare.options = set()

    class Bench:
        """As little of one as costs.py needs."""

        plugray, quick, rounds, clock, midpoint_words, bare = bare, True, 1, "cpu", (), ()

    Bench.folder = folder
    row = costs.by_hand(Bench, type("", (), {"step": lambda self: None})())[0]
    check(row.value is not None, "the raycaster written by hand draws the same picture", row.detail)
    for what, *pair in costs.unused_scenes(lobb):
        programs = [plugray.render(text, ("--step", "1"), 16)["programs"] for text in pair]
        check_equal(programs[1], programs[0], f"{what}: the same programs")

done()
