#!/usr/bin/env python3
"""Draws every example with both backends and compares the two pictures, and each with a small
reference picture in reference/. Those of volumes/, a scene for each node and style, are drawn once.

usage: gallery.py PLUGRAY EXAMPLES SCANS [NAME...]; with PLUGRAY_WRITE_REFERENCES set, the pictures of EGL
become the references.

Tolerances. The two backends run the same rasteriser on the same machine: a ray may end a step earlier
by one rounding, so next to nothing may differ. A reference may come from another machine and another
driver, with other roundings in sin, pow and texture filters: edges of patterns move by a part of a pixel.
A missing light, effect or object changes far more than either bound."""

import os
import re
import shutil
import subprocess
import sys
import tempfile

from files import read_png

WIDTH = 120  # of the pictures; their shape is 4:3 or what the scene's META "picture" says
# Mean difference of a channel, and the part of pixels that differ by more than LARGE: of 255.
BACKENDS = {"mean": 0.25, "large": 8, "part": 0.01}
REFERENCES = {"mean": 2.0, "large": 32, "part": 0.03}
SCANS = re.compile(r"\.cache/data/([\w.-]+)")  # what a scene asks for
SAID = {"volumes/iso-surface-style-2005.x3dv": "[bad-value]"}  # what is complained of, and meant to be
LIBRARIES = {"library.x3dv", "compositing/models/models.x3dv"}  # draw nothing by themselves
SAME = [("hello-volume.x3dv", "hello-volume.x3d"), ("light-effect.x3dv", "light-effect.x3d")]

HERE = os.path.dirname(os.path.abspath(__file__))
count = failed = 0


def check(condition, name, *details):
    global count, failed
    count += 1
    failed += not condition
    print(f"{'ok' if condition else 'not ok'} {count} - {name}")
    for detail in () if condition else details:
        for line in str(detail).splitlines():
            print(f"#   {line}")
    sys.stdout.flush()


def skip(name, why):
    global count
    count += 1
    print(f"ok {count} - {name} # SKIP {why}")


def scenes(folder):
    found = []
    for root, _, names in os.walk(folder):
        for name in names:
            path = os.path.relpath(os.path.join(root, name), folder)
            if name.endswith((".x3d", ".x3dv")) and path not in LIBRARIES:
                found.append(path)
    return sorted(found)


def size_of(path):
    with open(path, encoding="utf-8") as file:
        found = re.search(r'META "picture" "(\d+)x(\d+)"', file.read())
    width, height = map(int, found.groups()) if found else (4, 3)
    return f"{WIDTH}x{round(WIDTH * height / width)}"


def draw(program, path, backend, folders, target, said=None):
    """The exit status, what was complained of, and whether the scene was read as one of 2005."""
    words = [program, "render", path, "-o", target, "--size", size_of(path), "--backend", backend, "--no-cache"]
    for folder in filter(os.path.isdir, folders):
        words += ["--allow", folder]
    done = subprocess.run(words, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                          stderr=subprocess.PIPE, timeout=240, check=False)
    lines = done.stderr.decode(errors="replace").splitlines()
    problems = [line for line in lines
                if ": info: " not in line and not line.startswith(" ") and not (said and line.endswith(said))]
    old = any("proposal of 2005" in line and line.endswith("[dialect]") for line in lines)
    return done.returncode, "\n".join(problems), old


def difference(a, b):
    """Mean difference of the channels, and for each pixel the largest."""
    wa, ha, ca, da = read_png(a)
    wb, hb, cb, db = read_png(b)
    if (wa, ha) != (wb, hb):
        return 255.0, [255]
    step = min(ca, cb, 3)
    total, worst = 0, []
    for i in range(wa * ha):
        parts = [abs(da[i * ca + c] - db[i * cb + c]) for c in range(step)]
        total += sum(parts)
        worst.append(max(parts))
    return total / (wa * ha * step), worst


def compare(a, b, limits, name):
    mean, worst = difference(a, b)
    part = sum(w > limits["large"] for w in worst) / len(worst)
    check(mean <= limits["mean"] and part <= limits["part"], name,
          f"mean difference {mean:.3f} (at most {limits['mean']})",
          f"{part:.2%} of the pixels differ by more than {limits['large']} (at most {limits['part']:.0%})")


def has_content(path):
    _, _, components, data = read_png(path)
    return len({data[i : i + components] for i in range(0, len(data), components)}) > 5


def example(program, examples, scans, folder, path):
    with open(os.path.join(examples, path), encoding="utf-8") as file:
        wanted = SCANS.findall(file.read())
    missing = [s for s in wanted if not os.path.exists(os.path.join(scans, s))]
    if missing:
        skip(path, f"without {', '.join(missing)}: run tools/data")
        return None
    stem = path.replace("/", "-")
    backends = ("egl",) if path.startswith("volumes/") else ("egl", "osmesa")
    pictures = {b: os.path.join(folder, f"{stem}.{b}.png") for b in backends}
    for backend, target in pictures.items():
        status, problems, old = draw(program, os.path.join(examples, path), backend, [scans, os.path.join(examples, "data")],
                                     target, SAID.get(path))
        check(status == 0 and not problems, f"{path}: {backend} draws it, nothing to complain of",
              f"exit status {status}", problems)
        if status == 3:
            return None
        check(old == ("-2005." in path), f"{path}: read in the dialect that its name says")
    if "osmesa" in pictures:
        compare(pictures["egl"], pictures["osmesa"], BACKENDS, f"{path}: both backends draw the same")
    check(has_content(pictures["egl"]), f"{path}: something is seen")
    reference = os.path.join(HERE, "reference", stem + ".png")
    if os.environ.get("PLUGRAY_WRITE_REFERENCES"):
        os.makedirs(os.path.dirname(reference), exist_ok=True)
        shutil.copy(pictures["egl"], reference)
    if os.path.exists(reference):
        compare(pictures["egl"], reference, REFERENCES, f"{path}: as in its reference")
    else:
        check(False, f"{path}: it has a reference picture", reference)
    return pictures["egl"]


def begins_with_comment(path):
    with open(path, encoding="utf-8") as file:
        lines = [line for line in file.read().split("\n") if line.strip()]
    rest = [line for line in lines if not line.startswith(("#X3D", "#VRML", "PROFILE", "META", "<?xml"))]
    return rest[0].lstrip().startswith(("#", "<!--"))


def volume_nodes():
    """The names of the nodes of Volume Rendering, but those that other browsers added."""
    with open(os.path.join(HERE, "..", "..", "x3d", "nodes.def"), encoding="utf-8") as file:
        nodes = re.findall(r'^NODE\((\w+), "VolumeRendering", (.*)\)$', file.read(), re.M)
    return [name for name, rest in nodes if "STANDARD" in rest or "DIALECT_2005" in rest]


def covers(examples):
    """Every node and style of Volume Rendering has a scene."""
    folder, text = os.path.join(examples, "volumes"), ""
    for name in os.listdir(folder):
        if name.endswith((".x3d", ".x3dv")):
            with open(os.path.join(folder, name), encoding="utf-8") as file:
                text += "\n".join(line for line in file if not line.startswith("#"))
    nodes = volume_nodes()
    missing = [name for name in nodes if not re.search(rf"\b{name}\b", text)]
    check(len(nodes) >= 16 and not missing, "every node of Volume Rendering has a scene", nodes, missing)


def main():
    program, examples, scans = sys.argv[1:4]
    wanted = sys.argv[4:]
    everything = scenes(examples)
    with open(os.path.join(examples, "README.md"), encoding="utf-8") as file:
        readme = file.read()
    check(len(everything) >= 10 and sum(p.endswith(".x3d") for p in everything) >= 5,
          "at least ten examples, at least five in XML", everything)
    covers(examples)
    pictures = {}
    with tempfile.TemporaryDirectory(prefix="plugray-gallery-") as folder:
        for path in everything:
            if wanted and path not in wanted:
                continue
            check(begins_with_comment(os.path.join(examples, path)), f"{path}: says what it shows")
            check(f"`{path}`" in readme, f"{path}: stands in README.md")
            pictures[path] = example(program, examples, scans, folder, path)
        for a, b in SAME:
            if pictures.get(a) and pictures.get(b):
                mean, worst = difference(pictures[a], pictures[b])
                check(mean == 0 and max(worst) == 0, f"{a} and {b} are the same", mean, max(worst))
    print(f"1..{count}")
    sys.exit(1 if failed else 0)


if __name__ == "__main__":
    main()
