"""Draws scenes with the command line program and compares what comes out with expected numbers.

A test file makes one Suite, registers cases and runs it:

    suite = Suite()

    @suite.case
    def constant_volume():
        "the opacity of a constant volume does not depend on the step"
        pixels = suite.probe(scene_text, [(8, 8)])
        suite.close("in the middle", pixels[0], (0.1, 0.1, 0.1, 0.1))

    suite.run()

The program is the first argument; names of cases after it run only these. Output is TAP. Every
drawing has a folder of its own, no display is needed, and nothing is cached on disk.
"""

import array
import json
import math
import os
import shutil
import struct
import subprocess
import sys
import tempfile

HEADER = "#X3D V4.0 utf8\nPROFILE Immersive\n"


class CaseError(Exception):
    """The program did not do what the case needs to go on."""


class Result:
    """What one run of the program left behind."""

    def __init__(self, command, status, output, errors, folder):
        self.command = command
        self.status = status
        self.output = output
        self.errors = errors
        self.folder = folder

    def messages(self):
        """The diagnostics but information: (file, line, column, severity, message, code)."""
        found = []
        for line in self.errors.splitlines():
            if line.startswith(" ") or not line.endswith("]"):
                continue
            head, _, code = line[:-1].rpartition(" [")
            for severity in ("error", "warning", "note", "info"):
                place, mark, message = head.partition(f": {severity}: ")
                if mark:
                    file, row, column = split_place(place)
                    if severity != "info":
                        found.append((file, row, column, severity, message, code))
                    break
        return found

    def with_code(self, code):
        return [m for m in self.messages() if m[5] == code]


def split_place(place):
    parts = place.rsplit(":", 2)
    numbers = [p for p in parts[1:] if p.isdigit()]
    if len(parts) == 3 and len(numbers) == 2:
        return parts[0], int(numbers[0]), int(numbers[1])
    return place, 0, 0


class Picture:
    """A float picture: premultiplied RGBA, top row first."""

    def __init__(self, path):
        with open(path, "rb") as file:
            data = file.read()
        if data[:6] != b"\x93NUMPY":
            raise CaseError(f"{path} is no NPY file")
        long_header = data[6] > 1
        start = 12 if long_header else 10
        size = struct.unpack_from("<I" if long_header else "<H", data, 8)[0]
        header = eval(data[start : start + size], {"__builtins__": {}})  # a literal dictionary
        if header["descr"] != "<f4" or header["fortran_order"] or header["shape"][2] != 4:
            raise CaseError(f"{path}: {header}")
        self.height, self.width = header["shape"][:2]
        self.values = array.array("f", data[start + size :])
        if sys.byteorder == "big":
            self.values.byteswap()
        if len(self.values) != self.width * self.height * 4:
            raise CaseError(f"{path} has {len(self.values)} values for {header['shape']}")

    def at(self, x, y):
        start = 4 * (y * self.width + x)
        return tuple(self.values[start : start + 4])


class Suite:
    def __init__(self):
        if len(sys.argv) < 2:
            sys.exit(f"usage: {sys.argv[0]} PLUGRAY [CASE...]")
        self.program = os.path.abspath(sys.argv[1])
        self.wanted = sys.argv[2:]
        self.cases = []
        self.count = 0
        self.failed = 0
        self.folder = None
        self.draws = 0
        self.known = {}
        self.known_failures = 0

    def case(self, function):
        self.cases.append(function)
        return function

    def known_fault(self, why):
        """Marks a case (above @suite.case) that is right and fails: its failures are TODO lines, and
        it is a failure when there are none any more."""

        def mark(function):
            self.known[function] = why
            return function

        return mark

    # ---- checks

    def check(self, name, condition, *details):
        """One TAP line; the details are printed where it fails."""
        self.count += 1
        text = f"{self.title}: {name}" if name else self.title
        todo = ""
        if not condition and self.why_known:
            todo = f" # TODO {self.why_known}"
            self.known_failures += 1
        elif not condition:
            self.failed += 1
        print(f"{'ok' if condition else 'not ok'} {self.count} - {text.replace('#', '')}{todo}")
        if not condition:
            for detail in details:
                for line in str(detail).splitlines():
                    print(f"#   {line}")
        sys.stdout.flush()
        return condition

    def equal(self, name, got, expected):
        return self.check(name, got == expected, f"expected {expected!r}", f"got      {got!r}")

    def close(self, name, got, expected, tolerance=1e-4):
        """Numbers, one or many: every component within the tolerance, none of them NaN."""
        a, b = numbers(got), numbers(expected)
        fine = len(a) == len(b) and all(abs(x - y) <= tolerance for x, y in zip(a, b))
        return self.check(
            name,
            fine,
            f"expected {show(b)} +- {tolerance:g}",
            f"got      {show(a)}",
            f"folder   {self.folder}" if os.environ.get("PLUGRAY_KEEP") else "",
        )

    def skip(self, name, why):
        self.count += 1
        print(f"ok {self.count} - {name} # SKIP {why}")

    # ---- running the program

    def new_folder(self):
        self.draws += 1
        folder = os.path.join(self.folder, str(self.draws))
        os.makedirs(folder)
        return folder

    def command(self, *arguments, files=None, status=0, folder=None, timeout=120):
        """Runs the program in a folder that holds `files` (name -> text or bytes)."""
        folder = folder or self.new_folder()
        for name, content in (files or {}).items():
            path = os.path.join(folder, name)
            os.makedirs(os.path.dirname(path), exist_ok=True)
            with open(path, "wb") as file:
                file.write(content.encode() if isinstance(content, str) else content)
        done = subprocess.run(
            [self.program, *map(str, arguments)],
            cwd=folder,
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            timeout=timeout,
            check=False,
        )
        result = Result(
            " ".join(map(str, arguments)),
            done.returncode,
            done.stdout.decode(errors="replace"),
            done.stderr.decode(errors="replace"),
            folder,
        )
        if status is not None and result.status != status:
            raise CaseError(
                f"{result.command}: exit status {result.status}, not {status}\n{result.errors}"
            )
        return result

    def render(self, scene, *arguments, size="16x16", name=None, files=None, **options):
        """Draws scene text; its kind follows from its beginning."""
        name = name or ("scene.x3d" if scene.lstrip().startswith("<") else "scene.x3dv")
        return self.command(
            "render", name, "--size", size, "--no-cache", *arguments,
            files={name: scene, **(files or {})}, **options,
        )

    def probe(self, scene, pixels, *arguments, **options):
        """The premultiplied colours of some pixels."""
        where = [word for x, y in pixels for word in ("--probe", f"{x},{y}")]
        return read_probes(self.render(scene, *where, *arguments, **options), len(pixels))

    def middle(self, scene, *arguments, **options):
        """The colour of a picture of one pixel: the ray through the middle."""
        return self.probe(scene, [(0, 0)], *arguments, size="1x1", **options)[0]

    def picture(self, scene, *arguments, **options):
        result = self.render(scene, "-o", "picture.npy", *arguments, **options)
        return Picture(os.path.join(result.folder, "picture.npy"))

    # ---- all cases

    def run(self):
        keep = os.environ.get("PLUGRAY_KEEP")
        self.folder = tempfile.mkdtemp(prefix="plugray-scenes-")
        try:
            for case in self.cases:
                if not self.wanted or case.__name__ in self.wanted:
                    self.run_case(case)
        finally:
            if not keep:
                shutil.rmtree(self.folder)
        print(f"1..{self.count}")
        sys.exit(1 if self.failed else 0)

    def run_case(self, case):
        self.title = " ".join((case.__doc__ or case.__name__).split())
        self.why_known = self.known.get(case)
        self.known_failures = 0
        try:
            case()
        except (CaseError, subprocess.TimeoutExpired) as error:
            self.check(case.__name__, False, error)
        if self.why_known:
            fixed = not self.known_failures
            self.why_known = None
            self.check("still a known fault (else take the mark away)", not fixed)


def read_probes(result, count):
    lines = result.output.splitlines()
    if len(lines) != count:
        raise CaseError(f"{result.command}: {len(lines)} lines for {count} probes\n{result.output}")
    try:
        colors = [tuple(float(word) for word in line.split(" ")) for line in lines]
    except ValueError as error:
        raise CaseError(f"{result.command}: {error}") from error
    if any(len(color) != 4 for color in colors):
        raise CaseError(f"{result.command}: not four numbers a line\n{result.output}")
    return colors


def numbers(value):
    return [float(v) for v in value] if hasattr(value, "__iter__") else [float(value)]


def show(values):
    return "(" + ", ".join(f"{v:.6f}" for v in values) + ")"


def load_json(text):
    try:
        return json.loads(text)
    except ValueError as error:
        raise CaseError(f"no JSON: {error}\n{text[:2000]}") from error


# ---- arithmetic


def opacity(alpha, length, reference):
    """Of a length where `alpha` is the opacity of a reference length."""
    return 1.0 - (1.0 - alpha) ** (length / reference)


def premultiplied(rgb, alpha):
    return tuple(c * alpha for c in rgb) + (alpha,)


def over(front, back):
    """Premultiplied colours."""
    return tuple(f + (1.0 - front[3]) * b for f, b in zip(front, back))


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def unit(v):
    length = math.sqrt(dot(v, v))
    return tuple(x / length for x in v)


def rotate(axis, angle, v):
    """Rodrigues' formula."""
    k = unit(axis)
    c, s = math.cos(angle), math.sin(angle)
    cross = (k[1] * v[2] - k[2] * v[1], k[2] * v[0] - k[0] * v[2], k[0] * v[1] - k[1] * v[0])
    along = dot(k, v) * (1.0 - c)
    return tuple(v[i] * c + cross[i] * s + k[i] * along for i in range(3))


def box_interval(origin, direction, size=(1, 1, 1)):
    """Where a ray runs inside a box that is centred at the origin, in lengths of `direction`."""
    enter, leave = 0.0, math.inf
    for o, d, s in zip(origin, direction, size):
        if abs(d) < 1e-12:
            if abs(o) > s / 2:
                return 0.0, 0.0
            continue
        a, b = sorted(((-s / 2 - o) / d, (s / 2 - o) / d))
        enter, leave = max(enter, a), min(leave, b)
    return (enter, leave) if leave > enter else (0.0, 0.0)


def blinn_phong(normal, light_dir, view_dir, diffuse, specular, shininess):
    """One white light of intensity 1 without ambient light; `shininess` is the exponent."""
    n, l = unit(normal), unit(light_dir)
    half = unit(tuple(a + b for a, b in zip(l, unit(view_dir))))
    d, h = max(dot(n, l), 0.0), max(dot(n, half), 0.0)
    shine = h**shininess if h > 0 else 0.0
    return tuple(d * a + shine * b for a, b in zip(diffuse, specular))
