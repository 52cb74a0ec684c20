#!/usr/bin/env python3
"""Writes GLSL files into one C table, the one that plr_effects_file reads.

usage: embed.py OUTPUT ROOT FILE...
       embed.py --text NAME OUTPUT FILE    any one file as a C string of that name

Paths in the table are relative to ROOT, sorted, with forward slashes."""
import os
import sys

HEAD = """/* Made by tools/embed.py from the files below effects/. */
#include <plugray/engine.h>

"""

TAIL = """
static const struct {
    const char *path, *text;
    size_t length;
} files[] = {
%s
};

const char *plr_effects_file(size_t index, const char **text, size_t *length) {
    if (index >= sizeof files / sizeof files[0])
        return NULL;
    if (text)
        *text = files[index].text;
    if (length)
        *length = files[index].length;
    return files[index].path;
}
"""


def array(name, data):
    """The bytes with a final NUL: string literals of this length are beyond what C11 promises."""
    numbers = [str(byte) for byte in data] + ["0"]
    lines = [",".join(numbers[i : i + 32]) for i in range(0, len(numbers), 32)]
    return "static const char %s[] = {\n%s};\n" % (name, ",\n".join(lines))


def read(path):
    with open(path, "rb") as file:
        data = file.read()
    for number, line in enumerate(data.split(b"\n"), 1):
        if any(byte > 126 or (byte < 32 and byte != 9) for byte in line):
            sys.exit("%s:%d: error: only printable ASCII belongs in GLSL here" % (path, number))
    return data


def write_text(name, output, path):
    with open(output, "w", encoding="ascii") as file:
        file.write("/* Made by tools/embed.py. */\nextern const char %s[];\n" % name)
        file.write(array(name, read(path)).replace("static ", "", 1))


def main():
    if sys.argv[1] == "--text":
        write_text(*sys.argv[2:])
        return
    output, root, paths = sys.argv[1], sys.argv[2], sys.argv[3:]
    table = sorted((os.path.relpath(path, root).replace(os.sep, "/"), path) for path in paths)
    text, rows = HEAD, []
    for index, (name, path) in enumerate(table):
        data = read(path)
        text += array("file_%d" % index, data)
        rows.append('    {"%s", file_%d, %d},' % (name, index, len(data)))
    text += TAIL % "\n".join(rows)
    with open(output, "w", encoding="ascii") as file:
        file.write(text)


main()
