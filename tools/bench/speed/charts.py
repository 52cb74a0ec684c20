"""Charts by gnuplot: CPU time against error, one curve a method."""

import os
import shutil
import subprocess

from . import measure

COLORS = {"midpoint": "#1b6ca8", "preintegrated": "#2a9d5c", "cells": "#8a4fbf", "planner": "#d1495b",
          "VTK GPU": "#555555", "VTK fixed point": "#a0a0a0"}
SHAPES = {"midpoint": 7, "preintegrated": 5, "cells": 9, "planner": 13, "VTK GPU": 6, "VTK fixed point": 4}


def gnuplot(script):
    subprocess.run(["gnuplot"], input=script, text=True, check=True)


def available():
    return shutil.which("gnuplot") is not None


def block(name, rows):
    return f"${name} << EOD\n" + "".join(" ".join(f"{v:.6g}" for v in row) + "\n" for row in rows) + "EOD\n"


def curve(points, which):
    return sorted((p.time, getattr(p.error, which)) for p in points if getattr(p.error, which) > 0)


def panel(title, plots, error_bar):
    lines = [f'set title "{title}" noenhanced', "plot " + ", \\\n  ".join(plots)]
    if error_bar:
        lines[-1] += (f", \\\n  {error_bar:.3g} with lines dashtype 2 linecolor rgb '#bbbbbb' title "
                      "'error bar of the truth'")
    return "\n".join(lines) + "\n"


def setting_chart(setting, points, truth_error, clock, path):
    """Two panels beside each other: root mean square, and the greatest error."""
    script = ["set terminal svg size 1000,470 dynamic font 'sans-serif,12' background 'white'",
              f"set output '{path}'", "set logscale xy", "set format y '10^{%T}'", "set grid linecolor rgb '#e4e4e4'",
              f"set xlabel '{clock} time of a frame, ms'",
              "set key outside bottom center horizontal samplen 2 font ',10'",
              "set multiplot layout 1,2"]
    names = list(dict.fromkeys(p.method.name for p in points))
    for which, title in (("rmse", "root mean square error"), ("most", "greatest error")):
        plots = []
        for number, name in enumerate(names):
            rows = curve([p for p in points if p.method.name == name], which)
            if not rows:
                continue
            script.append(block(f"{which}{number}", rows))
            plots.append(f"${which}{number} with linespoints linewidth 1.5 pointsize 0.7 pointtype {SHAPES[name]} "
                         f"linecolor rgb '{COLORS[name]}' title '{name}'")
        if which == "rmse":
            best = [(p.time, p.error.rmse) for p in measure.front(points) if p.error.rmse > 0]
            script.append(block("front", best))
            plots.append("$front with points pointtype 6 pointsize 1.6 linewidth 1.5 linecolor rgb '#e09f3e' "
                         "title 'Pareto front'")
        lowest = min(y for p in points if (y := getattr(p.error, which)) > 0)
        shown = truth_error if truth_error > lowest / 30 else 0
        script.append(panel(f"{setting.name}: {title}", plots, shown))
    script.append("unset multiplot\n")
    gnuplot("\n".join(script))


def scaling_chart(series, path):
    script = ["set terminal svg size 640,440 dynamic font 'sans-serif,12' background 'white'",
              f"set output '{path}'", "set logscale xy 2", "set grid linecolor rgb '#e4e4e4'",
              "set xlabel 'how many times as much'", "set ylabel 'CPU time against the first'",
              "set key top left samplen 2", "set title 'CPU time as scenes grow'"]
    plots = []
    for number, (name, rows) in enumerate(series.items()):
        script.append(block(f"s{number}", [(n / rows[0][0], t / rows[0][1]) for n, t in rows]))
        plots.append(f"$s{number} with linespoints linewidth 1.5 pointsize 0.7 title '{name}'")
    plots.append("x with lines dashtype 2 linecolor rgb '#999999' title 'linear'")
    script.append("plot " + ", \\\n  ".join(plots) + "\n")
    gnuplot("\n".join(script))


def names(setting):
    return os.path.join("speed-accuracy", setting.name + ".svg")
