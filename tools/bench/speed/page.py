"""Writes docs/speed-accuracy.md and the table of all points beside it."""

import csv
import os
import re

from . import bounded, charts, engines, measure

HEAD = """# Speed and accuracy

Written by `{command}`; all points are in [points.csv](speed-accuracy/points.csv). Nothing on this page is
typed by hand.

Each point is one way to draw a volume, with one setting: the {time} of a frame, median of up to {rounds}
rounds in which all ways take turns, and the error against one truth, over all pixels and all four channels of
premultiplied floats. The truth is a raycaster in double precision ([tests/reference](../tests/reference/README.md)) that
integrates the trilinear values and the linear pieces of the transfer function piece by piece; its own error bar is
shown where it is near the curves. Pictures of VTK are taken as floats: its colour texture, of 8 bits, is made one of 32.

Data: `ml64`, `ml128`: the signal of Marschner and Lobb, floats, under a thin tent; `ct256`: a head of shells, sheets and a
wire with noise, 8 bits, under a function with eleven points; `smooth64`: the data of `ml64` under a function without edges.
Voxels are of side 1, which is the reference length; the volume ends at the outermost voxels' centres. `ct256` shaded, and
in perspective, as all other perspective views, are drawn smaller than the others; the size is in the table of points.
Shaded: VTK's lighting formula, in plugray as an author's effect that promises `colour-only keeps-transparent`.

In the charts the lower left is better. The numbers at both ends of a curve are its settings: steps in voxels, or the error that
`cells` and the planner (plugray's own choice) were asked for. A method that does not go with a scene has no curve;
[volumes](volumes.md#sampling) tells what each needs.

Noise: two standard errors of what is compared, 10 % where there was one round alone. Where a row tells a 95 % interval, two
programs took turns frame by frame in one process; the interval is that of the median of their ratios (bootstrap).

Measured with: {machine}.
"""


def machine(bench):
    """Processor, renderer and peers."""
    found = [f"{os.cpu_count()} cores"]
    with open("/proc/cpuinfo", encoding="utf-8") as file:
        models = re.findall(r"model name\s*:\s*(.*)", file.read())
    if models:
        found[0] += f", {models[0].strip()}"
    found.append(bench.renderer)
    if bench.vtk and bench.vtk.version:
        found.append(f"VTK {bench.vtk.version}")
    found.append(f"load {os.getloadavg()[1]:.1f} at the end")
    return ", ".join(f for f in found if f)


def table(head, rows):
    text = "| " + " | ".join(head) + " |\n|" + " --- |" * len(head) + "\n"
    for row in rows:
        text += "| " + " | ".join(row) + " |\n"
    return text


def rows_text(rows):
    text = ""
    for part in dict.fromkeys(row.part for row in rows):
        text += f"\n### {part}\n\n"
        text += table(("what", "measured", "bar", "", "how"),
                      [(row.what, row.value_text(), row.bar_text(), row.reached, row.detail)
                       for row in rows if row.part == part])
    return text


def summary(rows):
    counts = {}
    for row in rows:
        counts[row.reached.strip("*")] = counts.get(row.reached.strip("*"), 0) + 1
    text = "Of what has a bar: " + "; ".join(f"{n} {name}" for name, n in counts.items() if name != "reported") + "."
    lost = [row for row in rows if row.reached in ("**not reached**", "the least is reached", "missed, within noise")]
    if lost:
        text += "\n\nWhere we fall short:\n\n"
        text += table(("of", "what", "measured", "bar"),
                      [(row.part, row.what, row.value_text(), row.bar_text()) for row in lost])
    return text


def chosen(point):
    """What the planner has made of a wanted error."""
    if not point.plan or point.method.knob != "--error":
        return "-"
    return ", ".join(filter(None, (point.plan.get("method"), f"{point.plan['step']:g}" if point.plan.get("step")
                                   else "", "leaps" if point.plan.get("leaps") else "")))


def points_table(points, clock):
    rows = []
    for point in points:
        said, plan = point.said or {}, chosen(point)
        kind = f"{said['kind']} {said['value']:.2g}" if said.get("value") else "-"
        noise = f"{100 * point.slack / 2:.1f} %" if len(point.times) > 1 else "one round"
        rows.append((point.method.name, f"`{point.settings_text()}`", f"{point.time:.1f}", noise,
                     f"{point.error.rmse:.2e}", f"{point.error.most:.1e}", plan, kind))
    return table(("method", "setting", f"{clock} ms", "standard error", "RMSE", "greatest error", "chosen",
                  "says"), rows)


def write_csv(results, path):
    with open(path, "w", encoding="utf-8", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(("setting", "pixels", "method", "knob", "options", "cpu_ms", "cpu_standard_error", "wall_ms",
                         "rmse", "max", "said_kind", "said_value", "chosen", "rounds"))
        for setting, points in results.items():
            for p in points:
                said = p.said or {}
                writer.writerow((setting.name, setting.size, p.method.name, f"{p.knob:.9g}", p.settings_text(),
                                 f"{engines.median(p.cpu):.2f}",
                                 f"{measure.standard_error(p.cpu) * engines.median(p.cpu):.2f}",
                                 f"{engines.median(p.wall):.2f}", f"{p.error.rmse:.4e}",
                                 f"{p.error.most:.4e}", said.get("kind") or "", said.get("value") or "",
                                 chosen(p), len(p.cpu)))


BOUNDS = """
## Errors that are promised

Cases of the tests, mixed: the analytic ones on three grids from eight sides
([analytic_errors.py](../tests/scenes/analytic_errors.py)) and random volumes behind random functions
([fuzz_cases.py](../tests/scenes/fuzz_cases.py)), parallel and in perspective. Some pixels of each picture are compared with the
raycaster in double precision. Pixels that are not within E of the true colour of their own ray may be within E of that of some ray
within 1/256 pixel, or of voxels that differ by 2 ulp of how they are stored: those are counted. Time is the CPU time of a
frame, median; all ways to draw a case take turns in one process. Where no bound is known, the planner measures the error by pilot
drawings, small pictures that are made when a view changes: a moving camera pays for them in each frame. Fixed steps are `midpoint` and
`preintegrated` with 2, 1, 1/2 ... 1/64 voxel, as long as they do not take more than {limit} times what the planner takes for
1/1023. The same on more cases, beginning where this page ended:

    tools/bench/bounds

"""


def bounds_text(summary):
    return (BOUNDS.format(limit=bounded.LIMIT) + table(bounded.HEAD, [bounded.numbers_of(summary, e) for e in bounded.ERRORS])
            + "\nThe ten that cost the most against fixed steps:\n\n"
            + table(bounded.WORST_HEAD, bounded.worst_rows(summary)))


def write(bench, command, found, folder):
    """The page, the table and the charts, into a folder as docs/ is one."""
    beside = os.path.join(folder, "speed-accuracy")
    os.makedirs(beside, exist_ok=True)
    write_csv(found.results, os.path.join(beside, "points.csv"))
    text = HEAD.format(command=command, rounds=bench.rounds, time=bench.time, machine=machine(bench))
    text += "\n## What must be reached\n\n" + summary(found.rows) + "\n" + rows_text(found.rows)
    if found.series and charts.available():
        charts.scaling_chart(found.series, os.path.join(beside, "scaling.svg"))
        text += "\n![CPU time as scenes grow](speed-accuracy/scaling.svg)\n"
    if found.bounds and found.bounds.tries:
        text += bounds_text(found.bounds)
    text += "\n## Charts\n"
    for setting, points in found.results.items():
        text += f"\n### {setting.name}, {setting.size} x {setting.size} pixels\n\n"
        if setting.title:
            text += f"{setting.title[0].upper()}{setting.title[1:]}.\n\n"
        if charts.available():
            charts.setting_chart(setting, points, bench.truth(setting).error, bench.clock_name,
                                 os.path.join(folder, charts.names(setting)))
            text += f"![CPU time against error]({charts.names(setting)})\n\n"
        text += points_table(points, bench.clock_name)
    with open(os.path.join(folder, "speed-accuracy.md"), "w", encoding="utf-8") as file:
        file.write(text)
