#!/usr/bin/env python3
"""Charts of speed against accuracy: chart.py PLUGRAY"""

import csv
import os
import pty
import re
import select
import shutil
import stat
import struct
import subprocess
import sys
import time
import xml.etree.ElementTree as xml

from command import Command
from pictures import read_npy
from tap import check, check_equal, done, skip

plugray = Command(sys.argv[1])
SIDE = 6
VALUES = " ".join(str((37 * x + 91 * y + 53 * z) % 256)
                  for z in range(SIDE) for y in range(SIDE) for x in range(SIDE))
VOLUME = f"""VolumeData {{
  voxels PixelTexture3D {{ image 1 {SIDE} {SIDE} {SIDE} {VALUES} }}
  renderStyle OpacityMapVolumeStyle {{
    transferFunction PixelTexture {{ image 3 1 4 0xFF000000 0x40C04060 0x2040F0A0 }} }} }}
"""
HEAD = "#X3D V4.0 utf8\nViewpoint { position 0 0 2 fieldOfView 0.6 }\n"
NAME = "waves & <dunes>'.x3dv"
plugray.write(NAME, HEAD + VOLUME)
plugray.write("box.x3dv", HEAD + "Shape { geometry Box { } }\n")
QUICK = ["--size", "20x16", "--repeat", "2", "--reference", "1/16", "--no-cache"]
COLUMNS = "method,knob,cpu_ms,wall_ms,gpu_ms,rmse,max,kind,bound,pareto,chosen,compile_ms"
FLOAT_ROUNDING = 2.0 ** -24


def table(*arguments, **more):
    """The rows of a chart as dictionaries, and that of the reference."""
    plugray.expect(0, "chart", NAME, "-o", "chart.csv", *QUICK, *arguments, **more)
    text = plugray.read("chart.csv")
    check_equal(text.splitlines()[0], COLUMNS, "the head of the table")
    rows = list(csv.DictReader(text.splitlines()))
    return rows[:-1], rows[-1]


def number(row, column):
    return float(row[column])


def front(rows, floor):
    """Which rows no other row beats in time and RMSE."""
    times = [number(row, "gpu_ms") if row["gpu_ms"] else number(row, "cpu_ms") for row in rows]
    errors = [max(number(row, "rmse"), floor) for row in rows]
    found = []
    for time, error in zip(times, errors):
        found.append(not any(t <= time and e <= error and (t < time or e < error)
                             for t, e in zip(times, errors)))
    return found


def one_method(rows, name):
    return [row for row in rows if row["method"] == name]


# ---- the table

rows, reference = table("--error", "1/100")
whole = rows
names = list(dict.fromkeys(row["method"] for row in rows))
check(names[0] == "midpoint" and names[-1] == "planner", "methods come in their order", names)
check(all(number(row, column) > 0 for row in rows for column in ("cpu_ms", "wall_ms", "compile_ms")),
      "all times are there", rows)
check(all(not row["gpu_ms"] or number(row, "gpu_ms") > 0 for row in rows), "times of a GPU, or none")
check_equal([number(row, "knob") for row in one_method(rows, "midpoint")],
            [2, 1, 0.5, 0.25, 0.125, 0.0625], "the steps of midpoint")
check_equal((reference["method"], number(reference, "knob"), reference["kind"]),
            ("reference", 0.0625, "extrapolated"), "the last row is the reference")
check(0 < number(reference, "rmse") < 1e-3 and number(reference, "max") >= number(reference, "rmse"),
      "the reference tells its own error", reference)
for column in ("rmse", "max"):
    errors = [number(row, column) for row in one_method(rows, "midpoint")]
    check(all(fine < 0.6 * coarse for coarse, fine in zip(errors, errors[1:-1])) and
          errors[-1] < errors[0] / 50, f"midpoint: {column} falls with the step", errors)
check(all(number(row, "max") >= number(row, "rmse") for row in rows), "the maximum is above the mean")
floor = max(3 * number(reference, "rmse"), FLOAT_ROUNDING)
check_equal([row["pareto"] for row in rows], [str(int(is_on)) for is_on in front(rows, floor)],
            "the Pareto front")
check({row["kind"] for row in one_method(rows, "midpoint")} == {"fixed"}
      and not any(row["bound"] for row in one_method(rows, "midpoint")), "fixed steps claim nothing")
planned = one_method(rows, "planner")
check({row["kind"] for row in planned} <= {"bounded", "estimated"}, "the planner bounds or estimates")
check(all(row["kind"] != "bounded" or number(row, "max") <= number(row, "bound")
          + 3 * number(reference, "max") for row in planned), "what is bounded is bounded", planned)
check_equal([round(1 / number(row, "knob")) for row in planned], [16, 64, 100, 255, 1023, 4095],
            "the asked error is a point of the planner, in its place")
check_equal([row["knob"] for row in rows if row["chosen"] == "1"], ["0.01"], "it is the one chosen")

rows, _ = table("--methods", "midpoint,planner")
check_equal(list(dict.fromkeys(row["method"] for row in rows)), ["midpoint", "planner"],
            "only what --methods names")
check_equal([round(1 / number(row, "knob")) for row in rows if row["chosen"] == "1"], [255],
            "1/255 is asked for if nothing is")
rows, _ = table("--methods", "midpoint", "--backend", "osmesa", "--viewpoint", "1", "--time", "1")
check(len(rows) == 6 and not any(row["chosen"] == "1" for row in rows), "no planner, nothing chosen")

# ---- the numbers, computed anew from pictures of plugray render


def picture(step):
    plugray.expect(0, "render", NAME, "-o", "picture.npy", "--size", "20x16", "--no-cache", "--step", step)
    return read_npy((plugray.folder / "picture.npy").read_bytes())[1]


def difference(a, b):
    """RMSE and maximum."""
    distances = [abs(x - y) for x, y in zip(a, b)]
    return (sum(d * d for d in distances) / len(distances)) ** 0.5, max(distances)


def extrapolated(coarse, fine):
    return [f + (f - c) / 3 for c, f in zip(coarse, fine)]


def same(row, errors):
    return all(abs(number(row, column) - error) <= 1e-6 * error + 1e-12
               for column, error in zip(("rmse", "max"), errors))


levels = [picture(step) for step in ("0.25", "0.125", "0.0625")]
truth = extrapolated(levels[1], levels[2])
check(same(reference, difference(truth, extrapolated(levels[0], levels[1]))),
      "the reference's error is the difference of two extrapolations", reference)
fixed = {number(row, "knob"): row for row in one_method(whole, "midpoint")}
for step, values in ((1, picture("1")), (0.25, levels[0]), (0.0625, levels[2])):
    check(same(fixed[step], difference(values, truth)), f"the error of steps of {step}", fixed[step])

# ---- scenes that not every method goes with

plugray.write("colors.x3dv", HEAD + "VolumeData { voxels PixelTexture3D { image 4 2 2 2 " +
              " ".join(["0xFF804020", "0x20408080"] * 4) + " } }\n")
run = plugray.expect(0, "chart", "colors.x3dv", "-o", "colors.csv", *QUICK,
                     stderr="preintegrated: the scene cannot be sampled so; it is left out [no-method]")
names = {line.split(",")[0] for line in plugray.read("colors.csv").splitlines()[1:]}
check({"midpoint", "planner", "reference"} <= names and "preintegrated" not in names,
      "what the scene cannot be sampled by has no rows", names)
plugray.expect(1, "chart", "colors.x3dv", "-o", "no.csv", *QUICK, "--methods", "preintegrated",
               stderr="error: preintegrated: the scene cannot be sampled so")

# ---- pictures

BRIEF = [*QUICK, "--methods", "midpoint,planner"]
if shutil.which("gnuplot"):
    plugray.expect(0, "chart", NAME, "-o", "new/chart.svg", *BRIEF)
    path = plugray.folder / "new" / "chart.svg"
    text = " ".join("".join(node.itertext()) for node in xml.parse(path).iter()
                    if node.tag.endswith("}text"))
    text = " ".join(text.split())
    for label in (NAME, "20x16 pixels", "root mean square error", "greatest error", "(ms)",
                  "midpoint, by step", "planner, by error", "Pareto front", "the planner's choice",
                  "3 times the error of the reference", "steps of 1/4, 1/8 and 1/16 voxel", "asked: 1/255",
                  "Medians of 2 draws"):
        check(label in text, f"the chart says: {label}", text)
    check("preintegrated" not in text, "methods that are left out are not in the legend", text)
    check(path.stat().st_size < 100_000, "it is small", path.stat().st_size)
    plugray.expect(0, "chart", NAME, "-o", "chart.png", *BRIEF)
    data = (plugray.folder / "chart.png").read_bytes()
    check(data[:8] == b"\x89PNG\r\n\x1a\n" and struct.unpack(">II", data[16:24]) == (1080, 960),
          "a PNG of 1080x960 pixels")
else:
    skip("charts as pictures", "there is no gnuplot")

# ---- what goes wrong

plugray.expect(1, "chart", "box.x3dv", "-o", "no.svg" if shutil.which("gnuplot") else "no.csv", *QUICK,
               stderr="the scene shows no volume: there is nothing to be sampled [no-volume]")
plugray.expect(1, "chart", "nowhere.x3dv", "-o", "no.csv", stderr="[missing-file]")
plugray.expect(2, "chart", NAME, "-o", "no.csv", *QUICK, "--viewpoint", "Nowhere", stderr="[unknown-def]")
plugray.write("bad.x3dv", (plugray.folder / NAME).read_text() +
              "Shape { geometry IndexedFaceSet { coord Coordinate { } coordIndex [ 0 1 2 -1 ] } }\n")
run = plugray.expect(1, "chart", "bad.x3dv", "-o", "bad.csv", *BRIEF, stderr="[bad-geometry]")
check(run.stderr.count("[bad-geometry]") == 1 and "reference" in plugray.read("bad.csv"),
      "faults of the scene are told once, and the chart is made", run.stderr)
plugray.write("taken", "")
plugray.expect(3, "chart", NAME, "-o", "taken/no.csv", *BRIEF, stderr="[output]")

WRONG = [
    ([], "-o CHART is missing"),
    (["-o", "no.jpg"], "ends in .svg, .png or .csv"),
    (["-o", "no.csv", "--methods", "midpoint,magic"], "not 'magic'"),
    (["-o", "no.csv", "--methods", ""], "--methods takes some of midpoint, preintegrated, cells, planner"),
    (["-o", "no.csv", "--error", "0"], "--error takes a number above 0"),
    (["-o", "no.csv", "--error", "1/0"], "--error takes a number above 0"),
    (["-o", "no.csv", "--error", "1/"], "--error takes a number above 0"),
    (["-o", "no.csv", "--error", "-1/-255"], "--error takes a number above 0"),
    (["-o", "no.csv", "--error", "1/255x"], "--error takes a number above 0"),
    (["-o", "no.csv", "--error", "nan"], "--error takes a number above 0"),
    (["-o", "no.csv", "--reference", "3"], "--reference takes a number above 0 and at most 2"),
    (["-o", "no.csv", "--repeat", "0"], "--repeat takes a whole number from 1"),
    (["-o", "no.csv", "--step", "1"], "there is no option --step"),
]
for words, message in WRONG:
    plugray.expect(2, "chart", NAME, *words, stderr=message)

# ---- gnuplot, absent or ill


def with_gnuplot(script):
    """An environment whose only gnuplot is this script of sh, or none; an empty TMPDIR."""
    folder, temporary = plugray.folder / "bin", plugray.folder / "tmp"
    shutil.rmtree(folder, ignore_errors=True)
    shutil.rmtree(temporary, ignore_errors=True)
    folder.mkdir()
    temporary.mkdir()
    if script is not None:
        program = folder / "gnuplot"
        program.write_text(f"#!/bin/sh\n{script}\n")
        program.chmod(program.stat().st_mode | stat.S_IXUSR)
    return {**os.environ, "PATH": str(folder), "TMPDIR": str(temporary)}


def left_behind():
    return sorted(path.name for path in (plugray.folder / "tmp").iterdir())


environment = with_gnuplot(None)
run = plugray.expect(3, "chart", NAME, "-o", "no.svg", *BRIEF, env=environment,
                     stderr="gnuplot, which is not installed")
check("[missing-program]" in run.stderr, "it has a code", run.stderr)
rows, _ = table("--methods", "midpoint", env=environment)
check(len(rows) == 6, "a table needs no gnuplot")
environment["PATH"] = "bin:"
with_gnuplot(": >run; exit 1")
plugray.expect(3, "chart", NAME, "-o", "no.svg", *BRIEF, env=environment, stderr="not installed")
check(not (plugray.folder / "run").exists(), "no gnuplot from the working folder is run")

for name, script in (("fails", "echo some fault >&2; printf half >chart; exit 1"),
                     ("writes nothing", "exit 0"),
                     ("is killed", "printf half >chart; kill -9 $$")):
    plugray.write("kept.svg", "as it was")
    run = plugray.expect(3, "chart", NAME, "-o", "kept.svg", *BRIEF, env=with_gnuplot(script),
                         stderr="gnuplot cannot draw the chart")
    check_equal((plugray.read("kept.svg"), left_behind()), ("as it was", []),
                f"gnuplot {name}: the old chart is kept, nothing is left behind")
    check("fails" != name or "some fault" in run.stderr, "what it said is told", run.stderr)
run = plugray.expect(0, "chart", NAME, "-o", "kept.svg", *BRIEF, env=with_gnuplot("echo whole >chart"))
check_equal((plugray.read("kept.svg"), left_behind()), ("whole\n", []), "what gnuplot wrote is the chart")
# ---- progress

ours, theirs = pty.openpty()
with subprocess.Popen([plugray.program, "chart", NAME, "-o", "no.csv", "--size", "640x480", "--no-cache"],
                      cwd=plugray.folder, stdin=subprocess.DEVNULL, stderr=theirs) as process:
    shown, end = b"", time.monotonic() + 60
    while not re.search(rb"\[#* *\] \d+ %, \d+ s", shown) and time.monotonic() < end:
        if select.select([ours], [], [], 0.1)[0]:
            shown += os.read(ours, 4096)
    process.terminate()
check(re.search(rb"plugray: [a-z ]+ \[#* *\] \d+ %, \d+ s", shown), "a bar on a terminal tells how far it is",
      shown)
os.close(theirs)
os.close(ours)
check(not any(path.name.startswith("no.") for path in plugray.folder.iterdir()), "no chart where one failed")
done()
