"""What `--error E` promises, on the analytic and on random cases of the tests: is the error within E where it is said to
be, and what does that cost against the cheapest fixed steps whose error is?"""

import collections
import contextlib
import hashlib
import json
import math
import os
import random
import sys
import tempfile
import time

from . import engines, truth, turns

SCENES = os.path.join(truth.SOURCES, os.pardir, "scenes")
sys.path.insert(0, SCENES)
import fuzz_bounds  # noqa: E402
import fuzz_cases  # noqa: E402, they lie beside the tests

RANDOM = 1000  # cases
ERRORS = (1 / 64, 1 / 255, 1 / 1023)
LIMIT = 4  # times what the planner takes for the least error: no steps that take longer are tried
STEPS = (2, 1, 1 / 2, 1 / 4, 1 / 8, 1 / 16, 1 / 32, 1 / 64)
FIXED = ("midpoint", "preintegrated")
BESIDE = [(dx / 256, dy / 256) for dx in (-1, 0, 1) for dy in (-1, 0, 1) if dx or dy]

Case = collections.namedtuple("Case", "name kind make")  # kind: analytic or random
Drawing = collections.namedtuple("Drawing", "text files jobs camera opaque")


# ---- Cases ----

@contextlib.contextmanager
def argument(plugray):
    """The tests take their program from the command line."""
    kept, sys.argv = sys.argv, ["bounded.py", plugray]
    try:
        yield
    finally:
        sys.argv = kept


def analytic_cases(plugray):
    """V1 to V19 on three grids, seen from eight sides, in parallel and in perspective by turns."""
    with argument(plugray):
        import analytic_errors as tests
    found = []

    def add(name, view, make):
        found.append(Case(f"{name}, {type(view).__name__.lower()}", "analytic",
                          lambda: analytic_drawing(tests, make(), view)))

    makers = [(name, lambda size, turn, name=name: tests.case_of(name, size, turn)) for name in tests.CASES]
    makers += [("V17 overlapping", tests.overlapping), ("V19 cropped, with a surface", tests.cut)]
    for name, make in makers:
        for number, (turn, size) in enumerate((t, s) for t in tests.TURNS for s in tests.GRIDS):
            title = f"{name} {'x'.join(map(str, size))} from side {number // len(tests.GRIDS)}"
            add(title, tests.VIEWS[number % 2], lambda make=make, size=size, turn=turn: make(size, turn))
    for number, turn in enumerate(tests.TURNS):
        add(f"V12 cell from side {number}", tests.VIEWS[number % 2], lambda turn=turn: tests.random_cell(turn))
    return found


def analytic_drawing(tests, case, view):
    from harness import HEADER
    from scenes import NO_HEADLIGHT
    return Drawing(HEADER + view.text() + NO_HEADLIGHT + case.content, case.files, case.jobs,
                   tests.camera_of(view), case.opaque)


def random_cases(count, seed):
    """Those of the fuzzing tests."""
    dice = random.Random(seed)

    def make(number, at):
        case = fuzz_cases.random_case(random.Random(at), number % 2 == 0, "1/255")
        text, files = fuzz_bounds.scene_of([case])
        return Drawing(text, files, fuzz_cases.jobs(case), fuzz_cases.camera(case), ())

    return [Case(f"random {seed}-{n}", "random", lambda n=n, at=dice.getrandbits(64): make(n, at))
            for n in range(count)]


def all_cases(plugray, count, seed):
    """Both kinds, mixed, in an order that depends on the seed alone: the first N are a fair sample."""
    found = analytic_cases(plugray) + random_cases(count, seed)
    random.Random(seed).shuffle(found)
    return found


# ---- One case ----

class Judge:
    """Errors against the true colours of some pixels."""

    def __init__(self, drawing, pixels, count, name):
        self.drawing, self.size = drawing, pixels
        numbers = random.Random(name).sample(range(pixels * pixels), count)
        self.places = [(n % pixels, n // pixels) for n in sorted(numbers)]
        self.colors, self.bars = self.ask(self.places)

    def ask(self, rays, ulps=0):
        jobs = [{**job, "voxelChange": ulps * fuzz_cases.ULPS[job["type"]]} for job in self.drawing.jobs] if ulps \
            else self.drawing.jobs
        return truth.reference.truth(jobs, self.drawing.camera, (self.size, self.size), pixels=rays, tolerance=1e-8,
                                     opaque=self.drawing.opaque)

    def nearest(self, place, got, allowed):
        """The least error against rays beside, and other voxels."""
        found = math.inf
        for rays, ulps in (([(*place, *shift) for shift in BESIDE], 0), ([place], 1), ([place], -1)):
            colors, bars = self.ask(rays, ulps)
            found = min(found, *(apart(got, c) - b for c, b in zip(colors, bars)))
            if found <= allowed:
                break
        return found

    def judge(self, picture, allowed=None):
        """The greatest error, and how many pixels are within what is allowed only beside; None: nothing is."""
        worst, excused = 0.0, 0
        for (x, y), color, bar in zip(self.places, self.colors, self.bars):
            start = 4 * (y * self.size + x)
            got = picture[start:start + 4]
            found = apart(got, color) - bar
            if allowed is not None and found > allowed:
                found = self.nearest((x, y), got, allowed)
                excused += found <= allowed
            worst = max(worst, found)
        return worst, excused


def apart(got, color):
    """The greatest difference of a channel; what is no number is infinitely far."""
    found = max(abs(a - b) for a, b in zip(got, color))
    return found if found == found else math.inf


class Tried:
    """A view that was drawn."""

    def __init__(self, what, view, error, excused, first):
        self.what, self.view, self.error, self.excused = what, view, error, excused
        self.first = first  # milliseconds, once
        self.pilots = 0     # what those drawings take where a view changes


class Measurement:
    """Draws one case in all ways."""

    def __init__(self, turns, folder, pixels, samples, budget, methods=FIXED):
        self.turns, self.folder, self.methods = turns, folder, methods
        self.pixels, self.samples, self.budget = pixels, samples, budget
        self.picture = os.path.join(folder, "picture.npy")

    def run(self, case):
        """A record, which JSON can hold."""
        drawing = case.make()
        for name, content in {**drawing.files, "scene.x3dv": drawing.text}.items():
            with open(os.path.join(self.folder, name), "wb") as file:
                file.write(content.encode() if isinstance(content, str) else content)
        judge = Judge(drawing, self.pixels, self.samples, case.name)
        self.turns.forget()
        self.turns.scene(os.path.join(self.folder, "scene.x3dv"))
        plans = [self.planned(judge, error) for error in ERRORS]
        most = LIMIT * max(plan.first for plan in plans)
        fixed = [tried for method in self.methods for tried in self.fixed(judge, method, most)]
        return {"name": case.name, "kind": case.kind, "samples": self.samples,
                "errors": self.costs(plans, fixed)}

    def tried(self, what, judge, view, allowed=None):
        self.turns.picture(view, self.picture)
        worst, excused = judge.judge(engines.read_npy(self.picture), allowed)
        return Tried(what, view, worst, excused, self.turns.times([view], 1)[0][0])

    def planned(self, judge, error):
        view = self.turns.view(self.pixels, error=error)
        plan = self.tried(f"--error 1/{round(1 / error)}", judge, view, error if view.bounded else None)
        plan.pilots = self.turns.pilots(view)
        return plan

    def fixed(self, judge, method, most):
        """From long steps to short ones, until the least error is reached."""
        found = []
        for step in STEPS:
            view = self.turns.view(self.pixels, method, step=step)
            if view.method != method:
                break  # it does not go with this scene
            found.append(self.tried(f"{method} {step:g}", judge, view))
            if found[-1].error <= min(ERRORS) or found[-1].first > most:
                break
        return found

    def costs(self, plans, fixed):
        """Each error's cost, and that of the longest steps of each method that are within it."""
        rivals = {}
        for error in ERRORS:
            within = [tried for tried in fixed if tried.error <= error]
            rivals[error] = [next(t for t in within if t.view.method == method)
                             for method in FIXED if any(t.view.method == method for t in within)]
        views = list(dict.fromkeys(t.view for t in (*plans, *(t for some in rivals.values() for t in some))))
        took = self.take_turns(views)
        found = []
        for error, plan in zip(ERRORS, plans):
            best = min(rivals[error], key=lambda t: took[t.view], default=None)
            found.append({"asked": error, "bounded": plan.view.bounded, "said": plan.view.value, "found": plan.error,
                          "excused": plan.excused, "method": plan.view.method, "step": plan.view.step,
                          "ms": took[plan.view], "pilots_ms": plan.pilots, "best": best.what if best else None,
                          "best_ms": took[best.view] if best else None, "best_found": best.error if best else None})
        return found

    def take_turns(self, views):
        first = self.turns.times(views, 1)
        rounds = min(max(round(1e3 * self.budget / max(sum(t[0] for t in first), 0.1)), 1), 24)
        more = self.turns.times(views, rounds)
        return {view: engines.median(one + rest) for view, one, rest in zip(views, first, more)}


# ---- All of them, kept ----

def key(plugray):
    """What records depend on."""
    digest = hashlib.sha256()
    here = os.path.dirname(os.path.abspath(__file__))
    for path in (turns.program(plugray), truth.reference.program,
                 os.path.abspath(__file__), os.path.join(here, "turns.py"), os.path.join(SCENES, "fuzz_cases.py"),
                 os.path.join(SCENES, "analytic_errors.py")):
        with open(path, "rb") as file:
            digest.update(file.read())
    return digest.hexdigest()[:16]


class Records:
    """Lines of JSON in a file: a run that was stopped goes on where it was."""

    def __init__(self, path):
        self.path, self.known = path, {}
        if os.path.exists(path):
            with open(path, encoding="utf-8") as file:
                for line in file:
                    with contextlib.suppress(ValueError):  # the last one may be torn
                        record = json.loads(line)
                        self.known[record["name"]] = record

    def add(self, record):
        self.known[record["name"]] = record
        with open(self.path, "a", encoding="utf-8") as file:
            file.write(json.dumps(record) + "\n")


class Run:
    """As many cases as there is time for. Raises OSError where the build lacks what it needs."""

    def __init__(self, plugray, work, quick=False, count=RANDOM, seed=1, errors_alone=False):
        os.makedirs(work, exist_ok=True)
        self.turns = turns.Turns(plugray)
        self.cases = all_cases(plugray, count, seed)
        self.pixels, self.samples, self.budget = (96, 128, 0.1) if quick else (128, 320, 0.2)
        self.work, self.methods = work, () if errors_alone else FIXED
        kind = ("quick-" if quick else "") + ("errors-" if errors_alone else "")
        self.records = Records(os.path.join(work, f"bounds-{kind}{key(plugray)}.jsonl"))

    def go(self, minutes, most, only, progress):
        """Measures those that are not known yet."""
        end = time.monotonic() + 60 * minutes if minutes else math.inf
        wanted = [case for case in self.cases[:most] if only in case.name]
        with tempfile.TemporaryDirectory(dir=self.work) as folder:
            measurement = Measurement(self.turns, folder, self.pixels, self.samples, self.budget, self.methods)
            for case in wanted:
                if time.monotonic() > end:
                    break
                if case.name not in self.records.known:
                    self.records.add(self.measured(measurement, case, progress))
                progress.step(f" of {len(wanted)}")

    @staticmethod
    def measured(measurement, case, progress):
        try:
            return measurement.run(case)
        except engines.Failed as why:
            progress.note(f"{case.name}: {why}")
            return {"name": case.name, "kind": case.kind, "failed": str(why)}

    def summary(self, only=""):
        return Summary([self.records.known[c.name] for c in self.cases
                        if c.name in self.records.known and only in c.name])

    def close(self):
        self.turns.close()


# ---- Summary ----

class Summary:
    """Of many records."""

    def __init__(self, records):
        self.records = records
        self.tries = [(r, e) for r in records if "errors" in r for e in r["errors"]]
        self.failed = [r for r in records if "failed" in r]

    def some(self, asked=None, bounded=None, kind=None):
        return [(r, e) for r, e in self.tries if (asked is None or abs(e["asked"] - asked) < 1e-9)
                and (bounded is None or e["bounded"] == bounded) and (kind is None or r["kind"] == kind)]

    @staticmethod
    def exceeded(tries):
        """Where a bound is said and not kept; a bound above what was asked for is said, too."""
        return [(r, e) for r, e in tries if e["bounded"] and e["found"] > max(e["asked"], e["said"])]

    @staticmethod
    def ratios(tries, pilots=0):
        """Time against the cheapest fixed steps, of those for which there are some; cheapest first. With `pilots` 1 as
        where the camera moves: pilot drawings are made for each frame."""
        return sorted(((e["ms"] + pilots * e["pilots_ms"]) / e["best_ms"], f"{r['name']} {e['asked']}", r["name"], e)
                      for r, e in tries if e["best"])

    @staticmethod
    def quartiles(ratios):
        """25, 50, 75 %."""
        values = [ratio[0] for ratio in ratios]
        if not values:
            return None
        return [values[round(part * (len(values) - 1))] for part in (0.25, 0.5, 0.75)]


# ---- Tables ----

def numbers_of(summary, asked):
    """A row of the table for an error: counts, and what they cost."""
    tries = summary.some(asked)
    told = [(r, e) for r, e in tries if e["bounded"]]
    excused = sum(e["excused"] for _, e in told)
    samples = sum(r["samples"] for r, _ in told)
    within = sum(e["found"] <= e["asked"] for _, e in tries if not e["bounded"])
    every, bound, moving = (summary.quartiles(r) for r in (
        summary.ratios(tries), summary.ratios(told), summary.ratios(tries, pilots=1)))
    none = sum(not e["best"] for _, e in tries)
    ratio = lambda q: f"{q[1]:.2f} ({q[0]:.2f} to {q[2]:.2f})" if q else "-"
    return (f"1/{round(1 / asked)}", f"{len(tries)}", f"{len(told)}", f"{len(summary.exceeded(told))}",
            f"{max((e['found'] / e['asked'] for _, e in told), default=0):.2f}", f"{excused} of {samples}",
            f"{within} of {len(tries) - len(told)}", ratio(every), ratio(bound), ratio(moving), f"{none}")


HEAD = ("E", "cases", "bounded", "above the bound", "greatest error / E, where bounded", "pixels within E only beside",
        "estimated, and within E", "time / cheapest fixed steps within E: median (quartiles)", "the same where bounded",
        "the same with pilot drawings in each frame", "no fixed steps within E")


def worst_rows(summary, count=10):
    """Those that cost the most against fixed steps."""
    return [(name, f"1/{round(1 / e['asked'])}", "bounded" if e["bounded"] else "estimated",
             f"{e['method']}, {e['step']:g}", f"{e['ms']:.2f} ms, error {e['found']:.1e}", e["best"],
             f"{e['best_ms']:.2f} ms, error {e['best_found']:.1e}", f"{ratio:.2f}")
            for ratio, _, name, e in summary.ratios(summary.tries)[:-count - 1:-1]]


WORST_HEAD = ("case", "E", "says", "chosen", "takes", "cheapest fixed steps", "take", "times")


def aligned(head, rows):
    """A table for a terminal."""
    table = [head, *rows]
    widths = [max(len(row[i]) for row in table) for i in range(len(head))]
    return ["  ".join(cell.ljust(width) for cell, width in zip(row, widths)).rstrip() for row in table]


def lines(summary):
    """All of it, for a terminal."""
    columns = zip(HEAD, *(numbers_of(summary, asked) for asked in ERRORS))
    first, *more = columns
    yield from aligned(first, more)
    yield ""
    yield from aligned(WORST_HEAD, worst_rows(summary))
    for record, e in summary.exceeded(summary.tries):
        yield f"above its bound: {record['name']}, --error 1/{round(1 / e['asked'])}: {e['found'] / e['asked']:.3f} of it"
    for record in summary.failed:
        yield f"not drawn: {record['name']}: {record['failed']}"
