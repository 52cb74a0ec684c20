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

from speed import bounded, costs, data, engines, measure, rows, scenes, truth, turns  # noqa: E402


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

for value, more, wanted in ((10, {}, "reached"), (9.9, {}, "**not reached**"), (9.9, {"noise": 0.2}, "missed, within noise"),
                            (8.5, {"least": 8}, "the least is reached"), (None, {}, "not measured"),
                            (9, {"greater": False}, "reached"), (11, {"greater": False}, "**not reached**"),
                            (10.1, {"noise": 0.2}, "reached, within noise")):
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
    # ---- costs

    class Bench:
        """As little of one as costs.py needs."""

        quick, rounds, clock = True, 1, "cpu"

    Bench.turns, Bench.folder = turns.Turns(PLUGRAY), folder
    silent = type("", (), {"step": lambda self, more="": None, "note": print})()
    for row in costs.by_hand(Bench, silent):
        check(row.value is not None, f"{row.what}: the program written by hand draws the same bits", row.detail)
    for what, *pair in costs.unused_scenes(lobb):
        Bench.turns.forget()
        first, second = (costs.Side(Bench, text, 16, "midpoint", 1).show() for text in pair)
        check_equal(second.instructions, first.instructions, f"{what}: as many instructions")
    ratio = costs.Ratio([[1.0, 1.1, 1.2], [1.1, 1.1, 1.3]])
    check(ratio.median == 1.1 and 1.0 <= ratio.low <= 1.1 <= ratio.high <= 1.3, "a ratio and its interval", ratio.text())
    Bench.turns.close()

    # ---- bounds

    run = bounded.Run(PLUGRAY, folder, True, 40)
    check_equal(sorted(c.name for c in run.cases), sorted({c.name for c in run.cases}), "no two cases have one name")
    check_equal(len(run.cases), 14 * 24 + 8 + 40, "analytic cases on three grids from eight sides, cells, random ones")
    run.go(None, 2, "", silent)
    again = bounded.Run(PLUGRAY, folder, True, 40)
    check_equal(sorted(again.records.known), sorted(c.name for c in run.cases[:2]), "what was measured is known")
    found = again.summary()
    check_equal([r for r in found.records if "failed" in r], [], "all is drawn")
    check_equal(found.exceeded(found.tries), [], "no error above its bound")
    check(all(e["ms"] > 0 and e["found"] < 0.5 for _, e in found.tries), "times and errors", found.tries)
    check(all(e["best_found"] <= e["asked"] for _, e in found.tries if e["best"]), "fixed steps within E", found.tries)
    run.close()

    case = next(c for c in run.cases if c.name.startswith("V1 constant 5x4x6"))
    judge = bounded.Judge(case.make(), 32, 16, "")
    right = [0.0] * (4 * 32 * 32)
    for (x, y), color in zip(judge.places, judge.colors):
        right[4 * (y * 32 + x):4 * (y * 32 + x) + 4] = color
    check_equal(judge.judge(right, 1e-3), (0.0, 0), "the true colours have no error")
    x, y = judge.places[8]
    right[4 * (y * 32 + x)] += 0.01
    worst, excused = judge.judge(right, 1e-3)
    check(near(worst, 0.01, 0.05) and not excused, "a pixel that is wrong is found, and is not excused", worst, excused)
    right[4 * (y * 32 + x)] = float("nan")
    check(judge.judge(right)[0] == float("inf"), "so is what is no number")

done()
