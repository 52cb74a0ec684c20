#!/usr/bin/env python3
"""The scenes of examples/ and of the README have no problems: examples.py PLUGRAY SOURCE-ROOT"""

import pathlib
import re
import sys

from command import Command
from tap import check, done, skip

plugray = Command(sys.argv[1])
root = pathlib.Path(sys.argv[2]).resolve()
data = root / ".cache/data"

scenes = [path for path in sorted((root / "examples").rglob("*"))
          if path.suffix in (".x3d", ".x3dv", ".wrl")]
check(scenes, "there are examples")
for path in scenes:
    text = path.read_text(encoding="utf-8")
    name = path.relative_to(root)
    check(re.search(r"^\s*#[^X]|<!--", text, re.M), f"{name} says what it shows")
    if ".cache/data" in text and not data.exists():
        skip(f"{name} has no errors", "the scans are not here: run tools/data")
        continue
    run = plugray.run("check", str(path), "--allow", str(data))
    check(run.returncode == 0, f"{name} has no errors", run.stderr)

blocks = re.findall(r"(?:^    .*\n|^\n)+", (root / "README.md").read_text(encoding="utf-8"), re.M)
scene = [re.sub(r"^    ", "", block, flags=re.M) for block in blocks if "VolumeData" in block]
check(len(scene) == 1, "the README shows a scene")
plugray.write("head.nrrd", "NRRD0001\ntype: uchar\ndimension: 3\nsizes: 2 2 2\nencoding: ascii\n\n"
                           "0 255 0 255 0 255 0 255\n")
plugray.write("readme.x3dv", "#X3D V3.3 utf8\n" + scene[0])
run = plugray.run("check", "readme.x3dv", "--strict")
check(run.returncode == 0, "the scene of the README has no problems", run.stderr)
done()
