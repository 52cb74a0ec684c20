"""What is asked of speed and error, a row each: measured, the bar, whether it is reached."""

import collections
import math

from . import engines, measure


class Row:
    def __init__(self, part, what, value, bar, least=None, greater=True, detail="", noise=0):
        self.part = part          # heading of its table
        self.what = what
        self.value = value        # None: not measured, `detail` says why
        self.bar = bar            # None: reported alone
        self.least = least        # what is tolerated where the bar is not reached
        self.greater = greater    # whether the value is to be at least the bar, or at most
        self.detail = detail
        self.noise = noise        # two standard errors of the value

    @property
    def reached(self):
        if self.value is None:
            return "not measured"
        if self.bar is None:
            return "reported"
        beyond = (lambda bar: self.value - bar) if self.greater else (lambda bar: bar - self.value)
        if beyond(self.bar) >= 0:
            return "reached" if beyond(self.bar) >= self.noise or not self.bar else "reached, within noise"
        if self.least is not None and beyond(self.least) >= 0:
            return "the least is reached"
        return "missed, within noise" if beyond(self.bar) >= -self.noise else "**not reached**"

    def bar_text(self):
        if self.bar is None:
            return "-"
        text = f"{'at least' if self.greater else 'at most'} {self.bar:g}"
        return text + (f" ({self.least:g} is the least)" if self.least is not None else "")

    def value_text(self):
        if self.value is None:
            return "-"
        return f"{self.value:.4f}" if 0.9 <= self.value < 1.1 else f"{self.value:.3g}"


def in_turns(points, rounds, progress, budget=0.4):
    for _ in range(rounds):
        for point in points:
            point.draw(budget=budget)
            progress.step()


def ours(points):
    return [p for p in points if p.method.who == "plugray"]


def of_method(points, name, knob=None):
    return [p for p in points if p.method.name == name and (knob is None or p.knob == knob)]


# ---- As good as VTK, in less time ----

EIGHTH = "CPU time to the RMSE of VTK's GPU mapper at 1/8 voxel"
BARS = {("ml64", False): (10, 8), ("ml128", False): (20, 16), ("ct256", False): (10, 10),
        ("ml64", True): (10, None), ("ml128", True): (20, None), ("ct256", True): (10, None)}


def race(bench, setting, points, theirs, bar, least, part, what, progress):
    """VTK's point against the cheapest setting of plugray that is as good, drawn in turns."""
    rival = measure.seek(bench, setting, bench.methods, ours(points), theirs.error.rmse)
    if rival is None and not ours(points):
        return Row(part, what, None, bar, least, detail="nothing was drawn")
    if rival is None:
        best = min(ours(points), key=lambda p: p.error.rmse)
        return Row(part, what, 0, bar, least, detail=f"no setting comes to RMSE {theirs.error.rmse:.2e}; "
                   f"the best, {best.method.name} {best.settings_text()}, to {best.error.rmse:.2e}")
    fresh = measure.Point(bench, setting, theirs.method, theirs.knob)
    in_turns((fresh, rival), bench.rounds, progress)
    ratio = fresh.time / rival.time
    slack = math.hypot(fresh.slack, rival.slack)
    return Row(part, what, ratio, bar, least,
               noise=slack * ratio, detail=f"VTK {fresh.time:.0f} ms, RMSE {theirs.error.rmse:.2e}, "
               f"max {theirs.error.most:.3f}; "
               f"plugray `{rival.settings_text()}` {rival.time:.1f} ms, RMSE {rival.error.rmse:.2e}, max "
               f"{rival.error.most:.3f}; two standard errors {100 * slack:.0f} %")


def eighth(bench, results, progress):
    rows = []
    for setting, points in results.items():
        bars = BARS.get((setting.volume.name, setting.shaded))
        theirs = of_method(points, "VTK GPU", 1 / 8)
        if not bars or not theirs:
            continue
        if setting.perspective:
            bars = (None, None)  # the bars are for orthographic views
        rows.append(race(bench, setting, points, theirs[0], *bars, EIGHTH, setting.name, progress))
    return rows


BYTES = "CPU time to the least RMSE that VTK's GPU mapper reaches with 8-bit voxels"


def truth_of_bytes(bench, results, progress):
    """VTK filters 8-bit voxels in 8 bits here: its error has a floor."""
    rows = []
    for setting, points in results.items():
        theirs = of_method(points, "VTK GPU")
        if setting.volume.name != "ct256" or setting.shaded or not theirs:
            continue
        best = min(theirs, key=lambda p: p.error.rmse)
        rows.append(race(bench, setting, points, best, None if setting.perspective else 20, None,
                         BYTES,
                         f"{setting.name}, VTK at {best.knob:g} voxel", progress))
    return rows


# ---- Nowhere behind ----

FRONT = "Points of VTK that have both less time and less error than plugray's front"


def fronts(results):
    """No point of VTK may have both less time and less error than plugray's front."""
    rows = []
    for setting, points in results.items():
        mine = ours(points)
        ahead, worst, where = 0, 0, ""
        rivals = [p for p in points if p.method.who != "plugray"] if mine else []
        for rival in rivals:
            needed = measure.front_time(mine, rival.error.rmse)
            slack = math.hypot(rival.slack, max(p.slack for p in measure.front(mine)))
            ratio = needed / rival.time
            if ratio > 1 + slack:
                ahead += 1
            if ratio > worst:
                worst, where = ratio, f"{rival.method.name} at {rival.knob:g} voxel"
        if rivals:
            rows.append(Row(FRONT, setting.name, ahead, 0, greater=False,
                            detail=f"of {len(rivals)}; closest: {where}, for whose RMSE plugray takes "
                            f"{worst:.2f} times its CPU time"))
    return rows


# ---- What is promised ----

PROMISED = "What `--error E` promises"


def promises(results):
    """No error above a bound that is said, and no more time than the cheapest fixed setting within it."""
    broken, said, ratios = [], 0, []
    for setting, points in results.items():
        fixed = [p for p in points if p.method.knob == "--step"]
        for point in points:
            if point.method.knob != "--error" or not (point.said or {}).get("value"):
                continue
            if point.said["kind"] == "bounded":
                said += 1
                if point.error.most > point.said["value"]:
                    broken.append(f"{setting.name} {point.method.name} {point.knob:.4g}: {point.error.most:.2e}")
            if point.method.name == "planner" and point.knob <= 1 / 60 and point.said["kind"] == "bounded":
                cheapest = measure.front_time(fixed, point.knob, "most")
                if cheapest < math.inf:
                    ratios.append(point.time / cheapest)
    if not said:
        return []
    return [Row(PROMISED, "points of the charts whose greatest error is above a bound that plugray says", len(broken), 0,
                greater=False, detail=f"of {said}" + "".join("; " + b for b in broken)),
            Row(PROMISED, "the same points, time against the cheapest fixed steps whose greatest error is within E, median",
                engines.median(ratios) if ratios else None, 1.5, greater=False,
                detail=f"{len(ratios)} settings" + (f", {min(ratios):.2f} to {max(ratios):.2f}" if ratios else ""))]


def bounds(summary):
    """The same of the cases of the tests; the tables further down tell more."""
    if not summary or not summary.tries:
        return []
    told = summary.some(bounded=True)
    kinds = collections.Counter(r["kind"] for r in summary.records)
    cases = " and ".join(f"{n} {kind}" for kind, n in sorted(kinds.items())) + " cases"
    found = [Row(PROMISED, "cases of the tests whose greatest error is above a bound that plugray says",
                 len(summary.exceeded(told)), 0, greater=False,
                 detail=f"of {len(told)} pictures with a bound, of {len(summary.tries)}; {cases}, three E each")]
    for what, tries in (("where a bound is said", told), ("all", summary.tries)):
        ratios = summary.ratios(tries)
        quartiles = summary.quartiles(ratios)
        found.append(Row(PROMISED, f"the same cases, {what}: time against the cheapest fixed steps whose greatest error is "
                         "within E, median", quartiles and quartiles[1], 1.5 if tries is told else None, greater=False,
                         detail=f"{len(ratios)} pictures, quartiles {quartiles[0]:.2f} and {quartiles[2]:.2f}; for "
                         f"{len(tries) - len(ratios)} more no fixed steps are within E" if quartiles else ""))
    return found


# ---- Finer than plain steps ----

FINER = "CPU time to the RMSE of plain midpoint, in un-skipped steps of 1 voxel"


def finer(bench, results, progress):
    rows = []
    for setting, points in results.items():
        if setting.perspective or setting.shaded or setting.volume.name.startswith("smooth"):
            continue
        midpoint = bench.method("midpoint")
        for knob in (1 / 4, 1 / 8, 1 / 16):
            plain = of_method(points, "midpoint", knob)
            if not plain:
                continue
            target = plain[0].error.rmse
            what = f"{setting.name}, RMSE of 1/{round(1 / knob)} voxel ({target:.2e})"
            asked = knob == 1 / 4 or (knob == 1 / 8 and setting.volume.name == "ct256")
            base = measure.Point(bench, setting, midpoint, 1, bench.bare)
            rival = measure.seek(bench, setting, bench.methods, ours(points), target)
            if rival is None:
                continue
            in_turns((base, rival), bench.rounds, progress)
            ratio = rival.time / base.time
            rows.append(Row(FINER, what, ratio, 1.5 if asked else None, greater=False,
                            noise=ratio * math.hypot(rival.slack, base.slack),
                            detail=f"`{rival.settings_text()}` {rival.time:.1f} ms, RMSE "
                            f"{rival.error.rmse:.2e}; `{base.settings_text()}` {base.time:.1f} ms; "
                            f"midpoint itself takes {plain[0].time / base.time:.2f}"))
    return rows


# ---- Fits ----

def exponent(sizes, times):
    """Of the power law through the points, by least squares of logarithms."""
    xs, ys = [math.log(s) for s in sizes], [math.log(t) for t in times]
    mx, my = sum(xs) / len(xs), sum(ys) / len(ys)
    return sum((x - mx) * (y - my) for x, y in zip(xs, ys)) / sum((x - mx) ** 2 for x in xs)


def same_bytes(first, second):
    return engines.read_npy(first).tobytes() == engines.read_npy(second).tobytes()
