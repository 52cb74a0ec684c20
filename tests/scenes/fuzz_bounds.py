#!/usr/bin/env python3
"""--error E on random volumes behind random transfer functions: where the program says that its error is bounded,
no channel of any pixel is further from the truth than E.

    fuzz_bounds.py PLUGRAY [--cases N] [--seed S] [--keep FOLDER]

It has to be said of all of these cases. What fails is made as small as it can be, and its scene kept in FOLDER. A pixel may
also be what some ray within 1/256 of a pixel shows, of voxels that differ by two units in the last place of how they
are stored: those are counted."""

import argparse
import itertools
import json
import math
import os
import random
import sys
import time

import fuzz_cases
from analytic_data import median
from harness import HEADER, CaseError, Picture, Suite
from scenes import NO_HEADLIGHT

PIXELS = 16
BATCH = 20  # cases that one run of the program draws
PATTERNS = 48  # of voxels that differ each in a way of its own


def disc(rings, turns):
    return [(0.0, 0.0)] + [(r / rings / 256 * math.cos(2 * math.pi * k / turns), r / rings / 256 * math.sin(2 * math.pi * k / turns))
                           for r in range(1, rings + 1) for k in range(turns)]


BESIDE, CLOSER = disc(2, 8), disc(6, 24)


def read_arguments():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n", maxsplit=1)[0])
    parser.add_argument("plugray")
    parser.add_argument("--cases", type=int, default=66, help="how many (default: 66)")
    parser.add_argument("--seed", type=int, default=1, help="of random numbers (default: 1)")
    parser.add_argument("--seconds", type=float, default=20, help="to make a failure smaller (default: 20)")
    parser.add_argument("--keep", default="fuzz-bounds-failures", help="folder of scenes that fail")
    return parser.parse_args()


def fraction(text):
    a, b = text.split("/")
    return int(a) / int(b)


def scene_of(cases):
    """One frame for each, and the files."""
    count, shown, files = len(cases), [], {}
    for i, case in enumerate(cases):
        text, more = fuzz_cases.content(case, f"v{i}")
        shown.append(text)
        files.update(more)
    head = HEADER + fuzz_cases.VIEWS[cases[0]["parallel"]] + NO_HEADLIGHT
    if count == 1:
        return head + shown[0], files
    keys = " ".join(str(i / count) for i in range(count))
    return (head + f"DEF CASES Switch {{ whichChoice 0 children [\n{''.join(shown)}] }}\n"
            f"DEF CLOCK TimeSensor {{ loop TRUE cycleInterval {count} }}\n"
            f"DEF TURN IntegerSequencer {{ key [ {keys} ] keyValue [ {' '.join(map(str, range(count)))} ] }}\n"
            "ROUTE CLOCK.fraction_changed TO TURN.set_fraction\n"
            "ROUTE TURN.value_changed TO CASES.whichChoice\n", files)


def draw(suite, cases):
    """Pictures of cases that have view and error in common, and what is said of the last one's error."""
    text, files = scene_of(cases)
    count = len(cases)
    frames = ["--frames", count, "--fps", 1, "--time", 0.5] if count > 1 else []
    result = suite.render(text, "-o", "a.npy", *frames, "--error", cases[0]["error"], "--stats", "json",
                          size=f"{PIXELS}x{PIXELS}", files=files)
    names = [f"a-{i:04}.npy" for i in range(1, count + 1)] if count > 1 else ["a.npy"]
    pictures = [Picture(os.path.join(result.folder, name)) for name in names]
    return pictures, json.loads(result.output)["error"]["kind"] == "bounded"


class Verdict:
    """On one picture: `ratio`, the greatest error / E of pixels that are not excused, and where that is."""

    def __init__(self):
        self.ratio, self.pixel, self.excused, self.unsure, self.unphysical = 0.0, None, 0, 0, False

    def failed(self):
        return self.unphysical or self.ratio > 1


def difference(got, color):
    return max(abs(a - b) for a, b in zip(got, color))


def tries(case):
    """Rays and changes of voxels that may be, those that are likeliest to tell first: of all voxels of a volume alike, and of
    each by chance."""
    some, count = (0, -1, 1, -0.5, 0.5), len(case["volumes"])
    alike = sorted(itertools.product(some, repeat=count), key=lambda c: sum(map(abs, c)))
    yield CLOSER, case, None
    for change in alike[1:]:
        yield BESIDE, case, change
    r = random.Random(1)
    for _ in range(PATTERNS):
        yield BESIDE, fuzz_cases.with_other_voxels(r, case), None


def excuses(case, x, y, got, allowed):
    """The least error against the rays beside, of these voxels and of such as differ as little as they may."""
    found = math.inf
    for rays, other, change in tries(case):
        colors, bars = fuzz_cases.truth(other, PIXELS, [(x, y, *shift) for shift in rays], change)
        found = min(found, *(difference(got, c) - b for c, b in zip(colors, bars)))
        if found <= allowed:
            break
    return found


def is_physical(color, most):
    """Finite, 0 <= A <= 1, 0 <= I <= A Cmax."""
    slack = 3e-6
    return (all(map(math.isfinite, color)) and 0 <= color[3] <= 1
            and all(-slack <= c <= color[3] * m + slack for c, m in zip(color, most)))


def texels_of(one):
    """All colours that a volume may have."""
    if "segments" not in one:
        return one["texels"]
    return [t for texels in one["segments"]["functions"] for t in texels] + [[1] * 4]


def judge(case, picture, bounded=True):
    verdict, allowed = Verdict(), fraction(case["error"])
    most = [max(t[c] for v in case["volumes"] for t in texels_of(v)) for c in range(3)]
    true, bars = fuzz_cases.truth(case, PIXELS)
    for i, bar in enumerate(bars.data):
        got = picture.values[4 * i:4 * i + 4]
        if not is_physical(got, most):
            verdict.unphysical, verdict.pixel = True, (i % PIXELS, i // PIXELS)
            return verdict
        if not bounded:
            continue
        verdict.unsure += bar > allowed
        found = difference(got, true.data[4 * i:4 * i + 4]) - bar
        if found > allowed:
            less = excuses(case, i % PIXELS, i // PIXELS, got, allowed)
            verdict.excused += less <= allowed
            found = min(found, less)
        if found / allowed > verdict.ratio:
            verdict.ratio, verdict.pixel = found / allowed, (i % PIXELS, i // PIXELS)
    return verdict


# ---- failures made smaller


def changed(case, index=None, **fields):
    """A copy with fields of the case, or of one of its volumes, changed; None takes one away."""
    copy = json.loads(json.dumps(case))
    target = copy if index is None else copy["volumes"][index]
    for name, value in fields.items():
        if value is None:
            target.pop(name, None)
        else:
            target[name] = value
    return copy


def with_fewer_voxels(case, index):
    one = case["volumes"][index]
    for axis in range(3):
        size = list(one["size"])
        for low, high in ((0, (size[axis] + 1) // 2), (size[axis] // 2, size[axis]), (0, size[axis] - 1),
                          (1, size[axis])):
            if high - low in (0, size[axis]):
                continue
            kept = list(size)
            kept[axis] = high - low
            def part(numbers, size=size, axis=axis, low=low, high=high):
                return [v for i, v in enumerate(numbers)
                        if low <= (i % size[0], i // size[0] % size[1], i // size[0] // size[1])[axis] < high]

            fewer = changed(case, index, size=kept, numbers=part(one["numbers"]))
            if "segments" in one:
                fewer["volumes"][index]["segments"]["labels"] = part(one["segments"]["labels"])
            yield fewer


def with_simpler_segments(case, index):
    one = case["volumes"][index]
    parts = one["segments"]
    for texels in parts["functions"]:
        yield changed(case, index, segments=None, texels=texels)
    yield changed(case, index, segments={**parts, "enabled": []})
    for label in sorted(set(parts["labels"])):
        yield changed(case, index, segments={**parts, "labels": [0 if v == label else v for v in parts["labels"]]})
    for i, texels in enumerate(parts["functions"]):
        other = [json.loads(json.dumps(f)) for f in parts["functions"]]
        for k, texel in enumerate(texels):
            if texel[3] > 0:
                other[i] = texels[:k] + [texel[:3] + [0]] + texels[k + 1:]
                yield changed(case, index, segments={**parts, "functions": list(other)})


def with_simpler_numbers(case, index):
    one = case["volumes"][index]
    texels, numbers = one["texels"], one["numbers"]
    yield changed(case, index, texels=[[1, 1, 1, t[3]] for t in texels])
    yield changed(case, index, texels=[t[:3] + [round(t[3], 2)] for t in texels])
    for i in range(len(texels)):
        if len(texels) > 2:
            yield changed(case, index, texels=texels[:i] + texels[i + 1:])
        if texels[i][3] > 0:
            yield changed(case, index, texels=texels[:i] + [texels[i][:3] + [0]] + texels[i + 1:])
    if one["type"] == "f32":
        yield changed(case, index, numbers=fuzz_cases.single([round(v, 2) for v in numbers]))


def smaller(case):
    """Cases with one thing less each."""
    if "clips" in case:
        yield changed(case, clips=None)
    for i in range(len(case["volumes"])):
        one = case["volumes"][i]
        if len(case["volumes"]) > 1:
            yield changed(case, volumes=case["volumes"][:i] + case["volumes"][i + 1:])
        for name in ("crop", "factor"):
            if name in one:
                yield changed(case, i, **{name: None})
        for name in ("scaleOrientation", "scale", "rotation"):
            if name in one["place"]:
                yield changed(case, i, place={k: v for k, v in one["place"].items() if k != name})
        if one["unit"]:
            yield changed(case, i, unit=0)
        if one["type"] != "f32":
            most = fuzz_cases.MOST[one["type"]]
            yield changed(case, i, type="f32", numbers=fuzz_cases.single([v / most for v in one["numbers"]]))
        if not case["parallel"]:
            yield changed(case, parallel=True)
        yield from with_fewer_voxels(case, i)
        yield from with_simpler_numbers(case, i)
        if "segments" in one:
            yield from with_simpler_segments(case, i)


def fails_alone(suite, case):
    pictures, bounded = draw(suite, [case])
    verdict = judge(case, pictures[0], bounded)
    return verdict if verdict.failed() else False


def shrink(suite, case, seconds):
    end, progress = time.monotonic() + seconds, True
    while progress and time.monotonic() < end:
        progress = False
        for candidate in smaller(case):
            if time.monotonic() > end:
                break
            if candidate != case and fails_alone(suite, candidate):
                case, progress = candidate, True
                break
    return case


def keep(suite, case, folder, seconds):
    """The scene, smaller, and what is wrong with it."""
    verdict = fails_alone(suite, case)
    if verdict:
        case = shrink(suite, case, seconds)
        verdict = fails_alone(suite, case)
    place = os.path.join(folder, case["name"])
    os.makedirs(place, exist_ok=True)
    text, files = scene_of([case])
    files["scene.x3dv"], files["case.json"] = text.encode(), json.dumps(case).encode()
    for file, data in files.items():
        with open(os.path.join(place, file), "wb") as out:
            out.write(data)
    if not verdict:
        return f"{place}: not alone, only after others"
    said = "not within bounds" if verdict.unphysical else f"{verdict.ratio:.3f} E"
    return f"{place}: {said} at {verdict.pixel}, --error {case['error']} --size {PIXELS}x{PIXELS}"


# ---- all


def batches(count, seed):
    """Cases that are drawn together: of one view and error."""
    r = random.Random(seed)
    kinds = [(parallel, error) for error in fuzz_cases.ERRORS for parallel in (True, False)]
    waiting = {}
    for i in range(count):
        parallel, error = kinds[i % len(kinds)]
        case = fuzz_cases.random_case(random.Random(r.getrandbits(64)), parallel, error)
        case["name"] = f"seed-{seed}-case-{i}"
        key = (parallel, error)
        waiting.setdefault(key, []).append(case)
        if len(waiting[key]) == BATCH:
            yield key, waiting.pop(key)
    yield from waiting.items()


class Totals:
    def __init__(self):
        self.ratios, self.excused, self.unsure, self.pixels, self.failures = [], 0, 0, 0, 0

    def add(self, verdict, bounded):
        self.failures += verdict.failed()
        self.excused += verdict.excused
        self.unsure += verdict.unsure
        if bounded:
            self.ratios.append(verdict.ratio)
            self.pixels += PIXELS * PIXELS


def check_batch(suite, key, cases, totals, arguments):
    parallel, error = key
    suite.title = f"{len(cases)} {'parallel' if parallel else 'perspective'}, {error}"
    pictures, bounded = draw(suite, cases)
    suite.check("bounded", bounded)
    verdicts = [judge(case, picture, bounded) for case, picture in zip(cases, pictures)]
    for verdict in verdicts:
        totals.add(verdict, bounded)
    wrong = [case for case, verdict in zip(cases, verdicts) if verdict.failed()]
    for verdict, case in zip(verdicts, cases):
        if verdict.failed():
            print(f"# {case['name']}: {'unphysical' if verdict.unphysical else verdict.ratio} at {verdict.pixel}")
    suite.check(f"worst {max(v.ratio for v in verdicts):.2f} E", not wrong,
                *(keep(suite, case, os.path.abspath(arguments.keep), arguments.seconds) for case in wrong[:3]))


def main():
    arguments = read_arguments()
    sys.argv[2:] = []
    suite, totals = Suite(), Totals()
    fuzz_cases.raycaster.beside(arguments.plugray)

    @suite.case
    def promises():
        "what is bounded"
        opaque, clear, half = [1, 1, 1, 1], [1, 1, 1, 0], [1, 1, 1, 0.5]
        for name, functions, expected in (
                ("an opaque range", [[clear, opaque]], True),
                ("two opaque ranges", [[opaque, clear, opaque]], True),
                ("two volumes", [[clear, half], [half, clear]], True),
                ("an opaque range of one of two", [[clear, half], [clear, opaque]], True),
                ("jumps", [[clear] * 300 + [half] * 300], True),
                ("three volumes", [[clear, opaque]] * 3, True),
                ("texels below 0 are not", [[[1, 1, 1, -1], half]], False)):
            case = {"parallel": True, "error": "1/64", "volumes": [
                {"size": [1, 1, 2], "type": "u8", "numbers": [0, 255], "dimensions": [1, 1, 1], "place": {}, "unit": 0,
                 "texels": texels} for texels in functions]}
            suite.equal(name, draw(suite, [case])[1], expected)
        segmented = {"labels": [0, 2], "functions": [[clear, half], [half, opaque], [opaque, clear]], "enabled": [True, False]}
        case["volumes"][0]["segments"] = segmented
        suite.equal("segments", draw(suite, [case])[1], True)
        segmented["functions"][2] = [[1, 1, 1, -1], half]
        suite.equal("not where one of them is not", draw(suite, [case])[1], False)
        segmented["labels"] = [0, 0]
        suite.equal("segments that are there", draw(suite, [case])[1], True)

    @suite.case
    def reach():
        "a line of the same mean reaches farther than the values do"
        case = {"parallel": False, "error": "1/1023", "volumes": [
            {"size": [1, 3, 3], "type": "f32", "unit": 0, "dimensions": [0.653, 0.51, 0.694],
             "numbers": fuzz_cases.single([0, 0, 0, 0, 0.10922516882419586, 0, 0.6354807615280151, 0.6354807615280151, 0]),
             "place": {"translation": [-0.14049696226621966, -0.015217499214771724, -0.09937378349042886],
                       "rotation": [0.5478240965773891, 0.6876940241281935, 0.11742102859805036, 3.6015237816564483]},
             "texels": [[1, 1, 1, 0.99 if i == 4 else 0] for i in range(64)]}]}
        pictures, bounded = draw(suite, [case])
        suite.check("bounded, and within", bounded and judge(case, pictures[0]).ratio < 0.5)

    @suite.case
    def random_volumes():
        "random volumes"
        for key, cases in batches(arguments.cases, arguments.seed):
            check_batch(suite, key, cases, totals, arguments)
        suite.title = f"{len(totals.ratios)} cases with a bound"
        suite.check(f"{totals.failures} failed; greatest error / E: median {median(totals.ratios or [0]):.3f}, most "
                    f"{max(totals.ratios, default=0):.3f}; {totals.excused} of {totals.pixels} pixels excused by rays or voxels "
                    f"beside, {totals.unsure} without a true colour",
                    not totals.failures and totals.excused + totals.unsure <= totals.pixels / 50)

    suite.run()


if __name__ == "__main__":
    main()
