"""Points of speed and error: who drew what with which setting, how long it took, how far from the truth."""

import math
import operator
import os
import time

from . import data, engines, scenes

# ---- What is compared ----

class Method:
    """A way to draw, with one knob."""

    def __init__(self, name, who, words, knob, values, few, shaded=True):
        self.name = name
        self.who = who        # "plugray" or the mapper of VTK
        self.words = words    # further options
        self.knob = knob      # the option that takes the knob's value
        self.values = values
        self.few = few        # where many would take too long
        self.shaded = shaded  # whether it is measured on shaded pictures, too


STEPS, FEW_STEPS = (4, 2, 1, 1 / 2, 1 / 4, 1 / 8, 1 / 16), (2, 1, 1 / 2, 1 / 4, 1 / 8)
ERRORS = (1 / 4, 1 / 8, 1 / 16, 1 / 32, 1 / 64, 1 / 128, 1 / 255, 1 / 1023)
FEW_ERRORS = (1 / 8, 1 / 32, 1 / 64, 1 / 255, 1 / 1023)
VTK_STEPS, FEW_VTK_STEPS = (2, 1, 1 / 2, 1 / 4, 1 / 8), (2, 1, 1 / 2, 1 / 8)
METHODS = (
    Method("midpoint", "plugray", ("--method", "midpoint"), "--step", STEPS, FEW_STEPS),
    Method("preintegrated", "plugray", ("--method", "preintegrated"), "--step", STEPS, FEW_STEPS),
    Method("cells", "plugray", ("--method", "cells"), "--error", ERRORS, FEW_ERRORS),
    Method("planner", "plugray", (), "--error", ERRORS, FEW_ERRORS),
    Method("VTK GPU", "gpu", (), "step", VTK_STEPS, FEW_VTK_STEPS),
    Method("VTK fixed point", "fixed", (), "step", VTK_STEPS, FEW_VTK_STEPS, shaded=False),
)
SLOW = 1500  # ms
BARE = ("--no-leaping",)  # added to plain midpoint: nothing is passed over


def supported(method, plugray):
    return method.who != "plugray" or plugray.can((*method.words, method.knob)) or method.name == "midpoint"


class Setting:
    """A volume, seen in one way: what one chart shows."""

    def __init__(self, volume, size, perspective=False, shaded=False, title=""):
        self.volume = volume
        self.size = size
        self.perspective = perspective
        self.shaded = shaded
        self.name = "-".join((volume.name, "perspective" if perspective else "orthographic",
                              "shaded" if shaded else "unshaded"))
        self.title = title
        self.scene = scenes.scene(volume, perspective, shaded)


    @property
    def weight(self):
        """About what it costs to measure, against others."""
        return self.size ** 2 / 512 ** 2 * self.volume.side / 64 * (2.5 if self.shaded else 1)

    @property
    def primary(self):
        """Whether the most is asked of it."""
        return not self.perspective and not self.shaded


def settings(quick):
    big, small = (256, 128) if quick else (512, 256)
    volumes = data.lobb_volume(64), data.lobb_volume(128), data.head_volume(256)
    found = []
    for volume in volumes:
        for perspective in (False, True):
            for shaded in (False, True):
                if quick and perspective and (shaded or volume is not volumes[0]):
                    continue
                costly = perspective or (volume is volumes[2] and shaded)
                found.append(Setting(volume, small if costly else big, perspective, shaded))
    found.append(Setting(data.smooth_volume(64), small, title="a transfer function without edges"))
    return found


# ---- Statistics ----

def standard_error(values):
    """Of the mean, relative to it; pessimistic where there is one value alone."""
    if len(values) < 2:
        return 0.05
    mean = sum(values) / len(values)
    square = sum((v - mean) ** 2 for v in values) / (len(values) - 1)
    return math.sqrt(square / len(values)) / mean


class Error:
    """The difference of two pictures over all pixels and channels."""

    def __init__(self, picture, truth):
        if len(picture) != len(truth):
            raise engines.Failed(f"{len(picture)} numbers for {len(truth)}")
        self.rmse = math.dist(picture, truth) / math.sqrt(len(truth))
        self.most = max(map(abs, map(operator.sub, picture, truth)))


# ---- Points ----

def fraction(value):
    """1/16 where it is the inverse of a whole number."""
    inverse = 1 / value
    return f"1/{inverse:.0f}" if inverse > 1.5 and abs(inverse - round(inverse)) < 1e-6 * inverse else f"{value:.9g}"


class Point:
    """One method at one value of its knob."""

    def __init__(self, bench, setting, method, knob, extra=()):
        self.bench = bench
        self.setting = setting
        self.method = method
        self.knob = knob
        self.extra = tuple(extra)
        self.cpu, self.wall, self.times = [], [], []
        self.error = None
        self.said = None  # what plugray says about its error
        self.plan = None  # and what it has chosen

    @property
    def words(self):
        words = self.method.words if self.bench.plugray.can(self.method.words) else ()
        knob = fraction(self.knob) if self.method.knob == "--error" else f"{self.knob:.9g}"
        return (*words, self.method.knob, knob, *self.extra)

    def settings_text(self):
        if self.method.who == "plugray":
            return " ".join(self.words)
        return f"sample distance {self.knob:g}"

    @property
    def applies(self):
        """Whether it was drawn by its method: what cannot be sampled so is sampled otherwise."""
        return not self.plan or "--method" not in self.words or self.plan["method"] == self.method.name

    def draw(self, judge=False, budget=0.4):
        """Measures once more; `budget` is for the frames of one measurement, CPU seconds."""
        folder, setting = self.bench.folder, self.setting
        picture = os.path.join(folder, f"picture-{os.getpid()}.npy") if judge else None
        if self.method.who == "plugray":
            known = self.cpu[0] / 1e3 if self.cpu else 0.2
            repeat = min(max(round(budget / max(known, 1e-3)), 1), 25)
            stats = self.bench.plugray.render(setting.scene, self.words, setting.size, picture, repeat)
            frame, self.said, self.plan = stats["frame"], stats.get("error"), stats.get("plan")
        else:
            frame = self.bench.vtk.render(setting.volume, self.method.who, self.knob, setting.size,
                                          setting.perspective, setting.shaded, picture, budget)
        self.cpu.append(frame.cpu)
        self.wall.append(frame.wall)
        self.times.append(getattr(frame, self.bench.clock))
        if judge:
            numbers = (engines.read_npy(picture) if self.method.who == "plugray"
                       else engines.read_vtk(picture, setting.size))
            os.remove(picture)
            self.error = Error(numbers, self.bench.truth(setting).numbers)
        return self

    @property
    def time(self):
        return engines.median(self.times)

    @property
    def slack(self):
        """Two standard errors, relative."""
        return 2 * standard_error(self.times)


def measure(points, rounds, progress, seconds_left=lambda: math.inf):
    """Draws all points in turns, so that a busy minute hits all of them. Those that fail are dropped, and methods that
    do not apply; slow ones
    are drawn in two rounds. A round for which there is no time is left out, but the first."""
    failed = []
    took = 0
    for number in range(rounds):
        if number and took > seconds_left():
            break
        start = time.monotonic()
        for point in points:
            if point in failed or (number > 1 and point.time > SLOW):
                continue
            try:
                point.draw(judge=number == 0)
            except engines.Failed as why:
                failed.append(point)
                progress.note(f"{point.setting.name}, {point.method.name} {point.knob:g}: {why}")
            if not point.applies:
                failed += [p for p in points if p.method is point.method]
            progress.step()
        took = time.monotonic() - start
    return [p for p in points if p not in failed]


# ---- Curves ----

def log_between(low, high, part):
    return math.exp(math.log(low) + part * (math.log(high) - math.log(low)))


def crossing(points, target):
    """Where a method's curve reaches an error: (time, knob), or None; straight in logarithms."""
    points = sorted(points, key=lambda p: p.time)
    best = None
    for point in points:
        if point.error.rmse <= target and (best is None or point.time < best[0]):
            best = point.time, point.knob
    for low, high in zip(points, points[1:]):
        if low.error.rmse > target >= high.error.rmse > 0:
            part = math.log(low.error.rmse / target) / math.log(low.error.rmse / high.error.rmse)
            found = log_between(low.time, high.time, part), log_between(low.knob, high.knob, part)
            if best is None or found[0] < best[0]:
                best = found
    return best


def front(points, which="rmse"):
    """Those that no other beats in both time and error (`rmse` or `most`), fastest first."""
    best, found = math.inf, []
    for point in sorted(points, key=lambda p: (p.time, getattr(p.error, which))):
        if getattr(point.error, which) < best:
            best = getattr(point.error, which)
            found.append(point)
    return found


def front_time(points, error, which="rmse"):
    """How long the front takes to an error; straight in logarithms between its points."""
    before = None
    for point in front(points, which):
        reached = getattr(point.error, which)
        if reached <= error:
            if not before or reached <= 0:
                return point.time
            part = math.log(before[1] / error) / math.log(before[1] / reached)
            return log_between(before[0], point.time, part)
        before = point.time, reached
    return math.inf


def seek(bench, setting, methods, points, target, tries=4):
    """The cheapest setting of plugray whose error is at most the target, drawn and not interpolated: of the two
    methods whose curves are there first."""
    found = []
    for method in methods:
        at = crossing([p for p in points if p.method is method], target)
        if at:
            found.append((at[0], method, at[1]))
    reached = []
    for _, method, knob in sorted(found, key=lambda f: f[0])[:2]:
        for _ in range(tries):
            point = Point(bench, setting, method, knob).draw(judge=True)
            if point.error.rmse <= target:
                reached.append(Point(bench, setting, method, knob).draw(judge=True))
                break
            knob *= 0.97 * min(1, (target / point.error.rmse) ** 0.5)
    return min(reached, key=lambda p: p.time, default=None)
