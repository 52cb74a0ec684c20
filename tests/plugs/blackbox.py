"""Links texts with the command line program and asks about the outcome.

    base("...")                       the base shader of the case; `fragment`, unless its stage is said
    r = link("effect one", "effect two")
    r.sound()                         exit 0, nothing said, and glslangValidator takes the program
    r.has(r"a.*b")                    a regular expression on the program, white space made one blank
    r.calls("change")                 the numbers of the effects called in place of a plug, in order

An effect is a text (fragment stage), or a dictionary of texts by stage.
"""

import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "tools"))

import tap  # noqa: E402

ENDINGS = {"vertex": "vert", "geometry": "geom", "fragment": "frag"}
BASE = """#version 330 core
out vec4 picture;
in vec3 point;
/* PLUG-DECLARATIONS */
void main() {
    vec4 color = vec4(point, 1.0);
    /* PLUG: change (color) */
    picture = color;
}
"""
VALIDATOR = shutil.which("glslangValidator")
CASES = []


def case(function):
    CASES.append(function)
    return function


def as_bytes(text):
    return text if isinstance(text, bytes) else text.encode("utf-8")


class Outcome:
    def __init__(self, program, base, effects, stage, options):
        self.stage = stage
        with tempfile.TemporaryDirectory() as folder:
            words = [self.write(folder, "base", base)]
            words += [self.write(folder, f"e{i}", text) for i, text in enumerate(effects)]
            command = [program, "link", *words, "--stage", stage, "--map", "map", "--symbols",
                       "symbols", "-o", "out", *options]
            run = subprocess.run(command, cwd=folder, capture_output=True, timeout=300)
            self.status = run.returncode
            self.errors = run.stderr.decode("utf-8", "replace")
            self.raw = self.read(folder, "out")
            self.text = self.raw.decode("utf-8", "replace")
            self.map = [row.split("\t") for row in self.read(folder, "map").decode().splitlines()]
            self.symbols = [row.split("\t")
                            for row in self.read(folder, "symbols").decode().splitlines()]
        self.flat = " ".join(re.sub(r"([^\w\s])", r" \1 ", self.text).split())

    @staticmethod
    def write(folder, name, text):
        texts = text if isinstance(text, dict) else {"fragment": text}
        files = [f"{name}.{ENDINGS[stage]}" for stage in texts]
        for file, part in zip(files, texts.values()):
            with open(os.path.join(folder, file), "wb") as out:
                out.write(as_bytes(part))
        return "+".join(files)

    @staticmethod
    def read(folder, name):
        path = os.path.join(folder, name)
        if not os.path.exists(path):
            return b""
        with open(path, "rb") as file:
            return file.read()

    # ---- questions

    def validate(self):
        """What glslangValidator complains of; None: nothing."""
        run = subprocess.run([VALIDATOR, "--stdin", "-S", ENDINGS[self.stage]], input=self.raw,
                             capture_output=True, timeout=120)
        return None if run.returncode == 0 else run.stdout.decode("utf-8", "replace")

    def calls(self, plug):
        return [int(n) for n in re.findall(rf"\bplr(\d+)_{plug}(?:_\d+)? \( [^{{}};]* ;",
                                           self.body("main"))]

    def body(self, function):
        """The text of a function of the program, white space made one blank."""
        found = re.search(rf"\b{function} \( [^;{{]*\{{", self.flat)
        depth, at = 1, found.end() if found else len(self.flat)
        begin = at
        while at < len(self.flat) and depth:
            depth += {"{": 1, "}": -1}.get(self.flat[at], 0)
            at += 1
        return self.flat[begin:at]

    def diagnostics(self, code=None):
        """(file, line, column, severity, code) of each message."""
        rows = re.findall(r"^(\S+?):(\d+):(\d+): (\w+): .*\[([\w-]+)\]$", self.errors, re.M)
        return [(f, int(l), int(c), s, k) for f, l, c, s, k in rows if code in (None, k)]

    # ---- checks

    def details(self):
        return [f"exit status {self.status}", self.errors, self.text[:6000]]

    def check(self, condition, name):
        return tap.check(condition, f"{self.title}: {name}", *self.details())

    def valid(self, name="the program is valid"):
        if not VALIDATOR:
            tap.skip(f"{self.title}: {name}", "glslangValidator is not there")
            return True
        complaint = self.validate()
        return tap.check(complaint is None, f"{self.title}: {name}", complaint, *self.details())

    def sound(self):
        self.check(self.status == 0 and not self.errors, "links, and nothing is said")
        return self.valid()

    def has(self, pattern, name=None):
        return self.check(re.search(pattern, self.flat), name or f"has {pattern}")

    def lacks(self, pattern, name=None):
        return self.check(not re.search(pattern, self.flat), name or f"lacks {pattern}")

    def called(self, plug, expected):
        got = self.calls(plug)
        return self.check(got == expected, f"calls at {plug}: {expected}, got {got}")

    def says(self, code, place=None, severity=None, times=None):
        """A message with that code, "line:column" or "file:line:column", and severity."""
        rows = [r for r in self.diagnostics(code) if severity in (None, r[3])]
        if place:
            rows = [r for r in rows if place in (f"{r[1]}:{r[2]}", f"{r[0]}:{r[1]}:{r[2]}")]
        good = bool(rows) if times is None else len(rows) == times
        where = f" at {place}" if place else ""
        return self.check(good, f"says {severity or ''} {code}{where}")


class Linker:
    """Links the effects of a case into its base."""

    def __init__(self, program):
        self.program = str(pathlib.Path(program).resolve())
        self.title = ""

    def __call__(self, *effects, base=BASE, stage="fragment", options=()):
        outcome = Outcome(self.program, base, effects, stage, options)
        outcome.title = self.title
        return outcome


def run(cases):
    """Runs the cases with the program of the first argument; names after it choose some."""
    if len(sys.argv) < 2:
        sys.exit(f"usage: {sys.argv[0]} PLUGRAY [CASE...]")
    link = Linker(sys.argv[1])
    for function in cases:
        if sys.argv[2:] and function.__name__ not in sys.argv[2:]:
            continue
        link.title = (function.__doc__ or function.__name__).strip()
        try:
            function(link)
        except (OSError, subprocess.SubprocessError) as error:
            tap.check(False, link.title, repr(error))
    tap.done()
