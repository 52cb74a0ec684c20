"""Charts by gnuplot: CPU time against error, one curve a method."""

import math
import os
import shutil
import subprocess

from . import measure

COLORS = {"midpoint": "#1b6ca8", "preintegrated": "#2a9d5c", "cells": "#8a4fbf", "planner": "#d1495b",
          "VTK GPU": "#555555", "VTK fixed point": "#a0a0a0"}
SHAPES = {"midpoint": 7, "preintegrated": 5, "cells": 9, "planner": 13, "VTK GPU": 6, "VTK fixed point": 4}
# of the knobs at the ends of curves
LABELS = {"midpoint": "center offset 0,0.8", "preintegrated": "right offset -0.7,-0.5", "cells": "right offset -1.6,0",
          "planner": "left offset 1.6,0", "VTK GPU": "center offset 0,0.8", "VTK fixed point": "center offset 0,-0.8"}


def gnuplot(script):
    subprocess.run(["gnuplot"], input=script, text=True, check=True)


def available():
    return shutil.which("gnuplot") is not None


def block(name, rows):
    return f"${name} << EOD\n" + "".join(" ".join(f"{v:.6g}" for v in row) + "\n" for row in rows) + "EOD\n"


def curve(points, which):
    """The points of one method, the fastest knob first: time, error, and what its knob is at both ends."""
    error = lambda p: getattr(p.error, which)
    points = sorted((p for p in points if error(p) > 0), key=lambda p: -p.knob)
    if not points:
        return []
    ends = {points[0]: measure.fraction(points[0].knob), points[-1]: measure.fraction(points[-1].knob)}
    apart = max(abs(math.log(points[0].time / points[-1].time)) / 0.35,
                abs(math.log(error(points[0]) / error(points[-1]))) / 0.8)
    if len(points) > 1 and apart < 1:  # one label for both
        ends = {points[-1]: f"{ends[points[0]]} to {ends[points[-1]]}"}
    return [(p.time, error(p), ends.get(p, "")) for p in points]


def ticks(low, high):
    """Of a logarithmic axis: powers of ten, 2 and 5 times them."""
    found = [m * 10.0 ** power for power in range(-3, 7) for m in (1, 2, 5)]
    return ", ".join(f"'{v:g}' {v:g}" for v in found if low <= v <= high)


def legend(names, with_truth):
    """One line below both panels."""
    entries = [("Pareto front", "point pointtype 7 pointsize 1.7 linecolor rgb '#f4cf8f'")]
    entries += [(n, f"point pointtype {SHAPES[n]} pointsize 0.8 linecolor rgb '{COLORS[n]}'") for n in names]
    entries += [("- -  error of the truth", "textcolor rgb '#999999'")] if with_truth else []
    widths = [0.0068 * len(name) + 0.036 for name, _ in entries]
    lines, x = [], 0.5 - sum(widths) / 2 + 0.018
    for (name, how), width in zip(entries, widths):
        lines.append(f"set label '{name}' at screen {x:.4f},0.045 left offset 0.8,0 font ',11' {how}")
        x += width
    return lines


def setting_chart(setting, points, truth_error, clock, path):
    """Two panels beside each other: root mean square, and the greatest error."""
    times = [p.time for p in points]
    low, high = min(times) / 1.3, max(times) * 1.5
    script = ["set terminal svg size 1000,460 dynamic font 'sans-serif,12' background 'white'",
              f"set output '{path}'", "set logscale xy", "set format y '10^{%T}'", "set grid linecolor rgb '#e4e4e4'",
              f"set xrange [{low:g}:{high:g}]", f"set xtics ({ticks(low, high)})",
              f"set xlabel '{clock} time of a frame, ms' offset 0,0.4",
              "unset key", "set multiplot layout 1,2 margins 0.055,0.985,0.21,0.92 spacing 0.07"]
    names = list(dict.fromkeys(p.method.name for p in points))
    shown = truth_error > min(p.error.rmse for p in points) / 30
    for which, title in (("rmse", "root mean square error"), ("most", "greatest error")):
        errors = [y for p in points if (y := getattr(p.error, which)) > 0]
        script.append(f"set yrange [{min(errors) / 1.6:g}:{max(errors) * 2.5:g}]")
        plots = []
        if which == "rmse":
            best = [(p.time, p.error.rmse) for p in measure.front(points) if p.error.rmse > 0]
            script.append(block("front", best))
            plots.append("$front with points pointtype 7 pointsize 1.7 linecolor rgb '#f4cf8f'")
        for number, name in enumerate(names):
            rows = curve([p for p in points if p.method.name == name], which)
            if not rows:
                continue
            script.append(f"${which}{number} << EOD\n"
                          + "".join(f'{x:.6g} {y:.6g} "{knob}"\n' for x, y, knob in rows) + "EOD\n")
            plots.append(f"${which}{number} with linespoints linewidth 1.5 pointsize 0.7 pointtype {SHAPES[name]} "
                         f"linecolor rgb '{COLORS[name]}'")
            plots.append(f"${which}{number} using 1:2:3 with labels font ',9' textcolor rgb '{COLORS[name]}' "
                         f"{LABELS[name]}")
        if shown:
            plots.append(f"{truth_error:.3g} with lines dashtype 2 linecolor rgb '#bbbbbb'")
        script += legend(names, shown) if which == "rmse" else ["unset label"]
        script.append(f"set label '{title}' at graph 0.5,1.04 center font ',13'")
        script.append("plot " + ", \\\n  ".join(plots))
    script.append("unset multiplot\n")
    gnuplot("\n".join(script))


def scaling_chart(series, path):
    """Names stand at the ends of the curves."""
    script = ["set terminal svg size 760,440 dynamic font 'sans-serif,12' background 'white'",
              f"set output '{path}'", "set logscale xy 2", "set grid linecolor rgb '#e4e4e4'",
              "set xlabel 'how many times as much'", "set ylabel 'CPU time against the first'", "unset key",
              "set lmargin 8", "set rmargin 10", "set clip two"]
    plots = ["x with lines dashtype 2 linecolor rgb '#999999'"]
    colors = list(COLORS.values())
    top = max(n for rows in series.values() for n in [rows[-1][0] / rows[0][0]])
    for number, (name, rows) in enumerate(series.items()):
        near = [(n / rows[0][0], t / rows[0][1]) for n, t in rows]
        script.append(block(f"s{number}", near))
        script.append("set label '%s' at %g,%g left offset 0.8,%g textcolor rgb '%s'" % (name, *near[-1], 0.7 * ((near[-1][1] > near[-1][0]) - (near[-1][1] <= near[-1][0])) * (near[-1][0] < top), colors[number]))
        plots.append(f"$s{number} with linespoints linewidth 1.5 pointsize 0.7 pointtype 7 "
                     f"linecolor rgb '{colors[number]}'")
    script.append(f"set xrange [1:{top:g}]")
    script.append(f"set label 'linear' at {top:g},{top:g} left offset 0.8,0 textcolor rgb '#999999'")
    script.append("plot " + ", \\\n  ".join(plots) + "\n")
    gnuplot("\n".join(script))


def names(setting):
    return os.path.join("speed-accuracy", setting.name + ".svg")
