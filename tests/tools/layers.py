#!/usr/bin/env python3
"""The layering of docs/architecture.md, read from the #include lines: layers.py SOURCE-ROOT"""

import pathlib
import re
import sys

from tap import check, done

root = pathlib.Path(sys.argv[1])
INCLUDE = re.compile(r'^\s*#\s*include\s*[<"]([^>"]+)[>"]')

# What each folder may include, besides itself and the C library.
PUBLIC = {name: f"plugray/{name}.h" for name in ("base", "plugs", "x3d", "engine")}
CODES = "plugray/codes.def"
ALLOWED = {
    "base": {PUBLIC["base"], CODES},
    "plugs": {PUBLIC["base"], PUBLIC["plugs"], CODES, "base/"},
    "x3d": {PUBLIC["base"], PUBLIC["x3d"], CODES, "base/", "libxml/", "zlib.h"},
    "tools": {*PUBLIC.values(), CODES, "base/", "engine/"},
}
# Within headers that all folders may use.
OTHERS = ("GL/", "EGL/", "KHR/", "GLES", "libxml/", "glslang/", "png.h", "openexr", "stb", "zlib.h",
          "plugray/", "base/", "plugs/", "x3d/", "engine/", "effects/", "tools/", "tests/")


def sources(folder):
    for path in sorted((root / folder).rglob("*.[ch]")):
        if path.parent.name != "bench":  # a benchmark makes its own input, and compares with glslang
            yield path


def includes(path):
    for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
        found = INCLUDE.match(line)
        if found:
            yield number, found.group(1)


for folder, allowed in ALLOWED.items():
    wrong = []
    for path in sources(folder):
        for number, name in includes(path):
            if name.startswith(folder + "/") or not name.startswith(OTHERS):
                continue
            if not any(name == one or (one.endswith("/") and name.startswith(one))
                       for one in allowed):
                wrong.append(f"{path.relative_to(root)}:{number}: {name}")
    check(not wrong, f"{folder}/ includes only what its layer may", *wrong)

wrong = [f"{path.relative_to(root)}:{number}: {name}" for path in sources("engine")
         for number, name in includes(path) if name.startswith(("tools/", "libxml/", "tests/"))]
check(not wrong, "engine/ includes nothing of tools/ and no XML", *wrong)

glslang = {path.name for path in sources("engine")
           for _, name in includes(path) if name.startswith("glslang/")}
check(glslang <= {"glsl.c"}, "glslang lies behind one file of engine/", glslang)

# The one file of C++.
dcmtk = {str(path.relative_to(root)) for folder in ("base", "plugs", "x3d", "engine", "tools")
         for suffix in ("c", "h", "cpp") for path in (root / folder).rglob("*." + suffix)
         for _, name in includes(path) if name.startswith("dcmtk/")}
check(dcmtk <= {"engine/volume_dicom_file.cpp"}, "DCMTK lies behind one file of engine/", dcmtk)

wrong = [str(path.relative_to(root)) for path in (root / "effects").rglob("*")
         if path.suffix in (".c", ".h", ".cpp")]
check(not wrong, "effects/ holds no C", *wrong)

# Statements, not single words: the linker has to know these.
GLSL = re.compile(r'"[^"\n]*(void main|gl_Position *=|texture\(|vec[234]\([^"\n]*;)[^"\n]*"')
wrong = [f"{path.relative_to(root)}:{number}" for folder in ("base", "plugs", "x3d", "engine", "tools")
         for path in sources(folder)
         for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1)
         if GLSL.search(line)]
check(not wrong, "no GLSL stands in strings of C", *wrong)
done()
