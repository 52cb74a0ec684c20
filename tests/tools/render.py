#!/usr/bin/env python3
"""plugray render: render.py PLUGRAY"""

import json
import os
import sys

from command import Command
from pictures import read_npy, read_png
from tap import check, check_equal, done

plugray = Command(sys.argv[1])
SCENE = """#X3D V3.3 utf8
Viewpoint { }
DEF Away Viewpoint { description "the other way" orientation 0 1 0 3.14159 }
Shape {
  appearance Appearance { material DEF Paint UnlitMaterial { emissiveColor 0.25 0.5 0.75 } }
  geometry Box { size 2 2 2 }
}
"""
plugray.write("box.x3dv", SCENE)
environment = {**os.environ, "XDG_CACHE_HOME": str(plugray.folder / "cache")}
SMALL = ("--size", "16x12", "--backend", "osmesa")


def render(status, *arguments, **more):
    return plugray.expect(status, "render", *arguments, env=environment, **more)


def probe(*arguments):
    lines = render(0, "box.x3dv", *SMALL, *arguments).stdout.splitlines()
    return [[float(word) for word in line.split(" ")] for line in lines]


# ---- probes

run = render(0, "box.x3dv", *SMALL, "--probe", "8,6", "--probe", "0,0")
check_equal(run.stdout, "0.25000000 0.50000000 0.75000000 1.00000000\n"
                        "0.00000000 0.00000000 0.00000000 0.00000000\n",
            "a line for each probe: four decimal numbers with a leading digit")
check_equal(probe("--probe", "8,6", "--set", "Paint.emissiveColor=1 0 0.5"), [[1, 0, 0.5, 1]],
            "--set changes a field")
check_equal(probe("--probe", "8,6", "--set", "Paint.emissiveColor=-1 0 2.5"), [[-1, 0, 2.5, 1]],
            "colours are not clamped")
check_equal(render(0, "-", *SMALL, "--probe", "8,6", stdin=SCENE).stdout.split()[0], "0.25000000",
            "the scene may come from standard input")
for selector in ("2", "Away", "the other way"):
    check_equal(probe("--viewpoint", selector, "--probe", "8,6"), [[0, 0, 0, 0]],
                f"--viewpoint {selector} looks the other way")
check_equal(probe("--viewpoint", "1", "--probe", "8,6"), [[0.25, 0.5, 0.75, 1]], "--viewpoint 1 is the first")
for selector in ("3", "0", "Nowhere"):
    render(2, "box.x3dv", *SMALL, "--probe", "8,6", "--viewpoint", selector, stderr=selector)
check_equal(probe("--samples", "4", "--probe", "8,6"), [[0.25, 0.5, 0.75, 1]], "--samples 4 draws the same inside")

# ---- pictures

half = ("--set", "Paint.transparency=0.5")
render(0, "box.x3dv", *SMALL, "-o", "out/plain.png", *half)
width, height, channels, rows = read_png((plugray.folder / "out/plain.png").read_bytes())
check_equal((width, height), (16, 12), "a PNG has the size asked for")
middle = rows[6][8 * channels:9 * channels]
check(all(abs(a - b) <= 1 for a, b in zip(middle, (32, 64, 96))), "a PNG is over black", list(middle))
check(channels == 3 or middle[3] == 255, "a PNG is opaque")
render(0, "box.x3dv", *SMALL, "-o", "clear.png", "--transparent", *half)
_, _, channels, rows = read_png((plugray.folder / "clear.png").read_bytes())
check_equal(channels, 4, "--transparent keeps alpha")
middle = rows[6][8 * 4:9 * 4]
check(all(abs(a - b) <= 1 for a, b in zip(middle, (64, 128, 191, 128))), "... straight", list(middle))
check_equal(list(rows[0][:4]), [0, 0, 0, 0], "... and nothing where nothing is")
render(0, "box.x3dv", *SMALL, "-o", "out.npy", *half)
shape, floats = read_npy((plugray.folder / "out.npy").read_bytes())
check_equal(shape, (12, 16, 4), "an NPY has height, width, 4")
check_equal(floats[(6 * 16 + 8) * 4:(6 * 16 + 9) * 4], (0.125, 0.25, 0.375, 0.5), "... premultiplied")
render(0, "box.x3dv", *SMALL, "-o", "out.exr")
check_equal((plugray.folder / "out.exr").read_bytes()[:4], b"\x76\x2f\x31\x01", "an EXR is one")
check_equal(sorted(path.name for path in (plugray.folder / "out").iterdir()), ["plain.png"],
            "no temporary file is left")
plugray.write("taken", "")
render(3, "box.x3dv", *SMALL, "-o", "taken/out.png", stderr="[output]")

# ---- faults

plugray.write("faulty.x3dv", SCENE + '\nInline { url "missing.x3dv" }\n')
run = render(1, "faulty.x3dv", *SMALL, "-o", "faulty.png", "--probe", "8,6", stderr="[missing-file]")
check_equal(run.stdout.split()[:1], ["0.25000000"], "the rest is drawn")
check((plugray.folder / "faulty.png").exists(), "and written")
render(1, "nowhere.x3dv", "-o", "nowhere.png", stderr="[missing-file]")
check(not (plugray.folder / "nowhere.png").exists(), "no scene, no picture")
old = {**environment, "MESA_GL_VERSION_OVERRIDE": "2.1"}
plugray.expect(3, "render", "box.x3dv", "-o", "old.png", env=old, stderr="[no-gl]")
plugray.expect(3, "check", "--trust", "box.x3dv", env=old, stderr="[no-gl]")
plugray.expect(0, "check", "box.x3dv", env=old)

# ---- statistics

run = render(0, "box.x3dv", *SMALL, "--stats", "json", "--repeat", "3", "--probe", "0,0")
first, _, rest = run.stdout.partition("\n")
stats = json.loads(rest)
check_equal(first, "0.00000000 0.00000000 0.00000000 0.00000000", "probes come before statistics")
check_equal(sorted(stats["phases"]), ["compile", "draw", "link", "load", "upload"], "five phases")
check(all(set(phase) == {"cpu_ms", "wall_ms"} and phase["cpu_ms"] >= 0 and phase["wall_ms"] >= 0
          for phase in stats["phases"].values()), "each with cpu_ms and wall_ms")
check(stats["phases"]["draw"]["wall_ms"] > 0, "drawing takes time")
check_equal(stats["samples"], 0, "no volume, no samples")
check(len(stats["programs"]) == 1 and stats["programs"][0]["name"].startswith("surface") and
      stats["programs"][0]["instructions"] > 0 and stats["programs"][0]["fetches"] == 0,
      "one program with instructions and fetches", stats["programs"])
check_equal(stats["error"], {"asked": None, "kind": "estimated", "value": None}, "no bound is claimed")
text = render(0, "box.x3dv", *SMALL, "--stats").stdout
check("draw" in text and "instructions" in text, "--stats alone is for people", text)
render(0, "--stats", "box.x3dv", *SMALL)

# ---- cache

check(any(path.is_file() for path in (plugray.folder / "cache/plugray").rglob("*")), "programs are kept on disk")
environment["XDG_CACHE_HOME"] = str(plugray.folder / "unused")
render(0, "box.x3dv", *SMALL, "--probe", "0,0", "--no-cache")
check(not (plugray.folder / "unused/plugray").exists(), "--no-cache keeps nothing")
done()
