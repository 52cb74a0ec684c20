#!/usr/bin/env python3
"""Composed programs against twins of them, written by hand: one main() a stage without a function of
its own, in tests/scenes/twins/. Of each pair are compared

* the pictures, of a viewpoint in perspective and of one without: equal to the bit,
* instructions in functions after spirv-opt -O: at most 1.05 times the twin's,
* texture fetches: as many,

and nothing can be taken from a twin: without any one of its statements it draws another picture, or does
not compile. Nobody leaps over blocks: that is something else to do.

usage: twins.py PLUGRAY TWIN [CASE...]; with PLUGRAY_TWINS=all in the environment that is asked of all twins,
and of parts of expressions, too; else of a few."""

import os
import shutil
import subprocess
import sys

from harness import CaseError, Suite
from twin_scenes import TWINS
import twin_tools

TWIN = os.path.abspath(sys.argv.pop(2))
suite = Suite()
HERE = os.path.join(os.path.dirname(os.path.abspath(__file__)), "twins")
ALLOWED = 1.05
SIZE = "32x32"
ALL = os.environ.get("PLUGRAY_TWINS") == "all"
STAGES = ("vert", "frag")


def hand_written(twin):
    """Stage -> path."""
    return {stage: os.path.join(HERE, f"{getattr(twin, stage)}.{stage}") for stage in STAGES}


def draw(twin, folder, pairs):
    """What the other programs draw, one word a pair (vertex, fragment), and how much the composed one does."""
    lines = "".join(f"{vertex} {fragment}\n" for vertex, fragment in pairs)
    done = subprocess.run([TWIN, "scene.x3dv", SIZE, str(twin.step), twin.program, twin.views], cwd=folder,
                          input=lines, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, check=False)
    results = done.stdout.splitlines()
    drawn = [int(line.split()[1]) for line in results if line.startswith("drawn ")]
    results = [line for line in results if not line.startswith("drawn ")]
    if done.returncode or len(results) != len(pairs):
        raise CaseError(f"twin: exit status {done.returncode}\n{done.stderr}{done.stdout}")
    return results, drawn


def check_counts(twin, folder):
    own = hand_written(twin)
    composed = [twin_tools.count(f"composed.{stage}", stage, folder) for stage in STAGES]
    minimal = [twin_tools.count(own[stage], stage, folder) for stage in STAGES]
    if not suite.check("they compile", None not in composed + minimal, composed, minimal):
        return
    for stage, a, b in zip(STAGES, composed, minimal):
        print(f"# {stage}: {a[0]} instructions, by hand {b[0]}: {a[0] / b[0]:.3f}; fetches {a[1]}, {b[1]}")
    total, by_hand = (sum(c[0] for c in counts) for counts in (composed, minimal))
    suite.check(f"at most {ALLOWED} times the instructions", total <= ALLOWED * by_hand, total, by_hand)
    suite.equal("fetches", [c[1] for c in composed], [c[1] for c in minimal])


def check_form(twin):
    for stage, path in hand_written(twin).items():
        with open(path, encoding="utf-8") as file:
            text = file.read()
        names = [t.text for t in twin_tools.tokens_of(text)]
        suite.equal(f"{stage}: one function", names.count("{"), 1 + sum(
            names[i] == "{" and names[i - 1] in (")", "else") and names[i - 2:i] != ["(", ")"]
            for i in range(len(names))))
        suite.check(f"{stage}: no macro", "#define" not in text)


def take_away(twin, folder, ways):
    """Programs with a part missing that draw the same picture."""
    own, pairs, names = hand_written(twin), [], []
    for stage in STAGES:
        with open(own[stage], encoding="utf-8") as file:
            text = file.read()
        for way in ways:
            for name, without in way(text):
                path = os.path.join(folder, f"without-{len(pairs)}.{stage}")
                with open(path, "w", encoding="utf-8") as file:
                    file.write(without)
                pairs.append((path if stage == "vert" else own["vert"], path if stage == "frag" else own["frag"]))
                names.append(f"{stage}: {name}")
    results, _ = draw(twin, folder, pairs)
    return [name for name, result in zip(names, results) if result == "same"], len(names)


def add(twin):
    def case():
        if not all(shutil.which(tool) for tool in ("glslangValidator", "spirv-opt")):
            suite.skip(twin.name, "glslangValidator and spirv-opt are not installed")
            return
        folder = suite.new_folder()
        with open(os.path.join(folder, "scene.x3dv"), "w", encoding="utf-8") as file:
            file.write(twin.scene)
        own = hand_written(twin)
        (result,), drawn = draw(twin, folder, [(own["vert"], own["frag"])])
        check_form(twin)
        check_counts(twin, folder)
        suite.check("something is drawn", len(drawn) > 1 and min(drawn) > 80, drawn)
        if suite.equal("the same picture to the bit", result, "same") and (ALL or twin.name in ALWAYS):
            idle, count = take_away(twin, folder, [twin_tools.statements] + ([twin_tools.expressions] if ALL else []))
            idle = [part for part in idle if not part.partition(": ")[2].startswith(twin.spare)]
            suite.check(f"none of {count} parts can be taken away", not idle, *idle)

    case.__name__ = twin.name
    case.__doc__ = twin.title
    suite.case(case)


ALWAYS = ("phong", "textured", "shaded")
for one in TWINS:
    add(one)
suite.run()
