"""Rows of docs/stability.md: known failures of raycasters, each with a scene and an invariant.

    suite = Stability()

    @suite.row("F1", "opacity correction missing", scene=TEXT,
               shows="a constant volume, step and step / 8",
               invariant="opacity does not depend on the step")
    def opacity_correction(row):
        for name, options in row.methods():
            a, b = (row.picture("--step", s, *options) for s in (1, 1 / 8))
            row.measure("opacities differ by", worst(a, b), at_most=1e-6, case=name)

    suite.main(__name__)

A row's scene is kept in stability/F01.x3dv, with the files that it reads (F01-name.nrrd) beside it; that the kept
files are what the test draws, and that the page tells the row, its scene and its bounds as they are, is checked
with each run. `stability.py PLUGRAY --write` writes both.
"""

import pathlib
import re
import subprocess

from harness import CaseError, Suite, load_json, rotate, unit
from scenes import constant, front_scene, volume

FOLDER = pathlib.Path(__file__).resolve().parent / "stability"
PAGE = FOLDER.parents[2] / "docs" / "stability.md"
LARGEST_FILE = 65536


class NotRun(Exception):
    """What the row needs is not on this machine."""


class Measure:
    """One number of a row, the worst of all cases, and its bound."""

    def __init__(self, what, value, at_most, at_least):
        self.what = what
        self.value = value
        self.at_most = at_most
        self.at_least = at_least

    def holds(self, value):
        """Never for NaN."""
        return ((self.at_most is None or value <= self.at_most)
                and (self.at_least is None or value >= self.at_least))

    def worse(self, value):
        if value != value or self.value != self.value:
            return value if value != value else self.value
        return min(self.value, value) if self.at_most is None else max(self.value, value)

    def bound(self):
        parts = []
        if self.at_least is not None:
            parts.append(f"at least {short(self.at_least)}")
        if self.at_most is not None:
            parts.append(f"at most {short(self.at_most)}" if self.at_most != 0 else "0 allowed")
        return f"{self.what} ({', '.join(parts)})"

    def text(self):
        return f"{self.bound()}: {short(self.value, 2)}"


def short(value, digits=3):
    if abs(value) < 1e6 and value == int(value):
        return str(int(value))
    return f"{value:.{digits}g}"


class Row:
    """One failure: the scene, what is measured of it."""

    def __init__(self, suite, number, failure, scene, shows, invariant, files):
        assert re.fullmatch(r"F[1-9]\d?", number), number
        self.suite = suite
        self.number = number
        self.failure = failure
        head, mark, rest = scene.partition("\n")
        assert head.startswith("#X3D") and mark, number
        self.text = f"{head}\n# {number}, {failure}: {shows}\n{rest}"
        self.shows = shows
        self.invariant = invariant
        self.files = files or {}
        self.measures = {}
        self.why_not_run = ""
        self.fine = True

    # ---- what a row's function calls

    def measure(self, what, value, at_most=None, at_least=None, case="", details=()):
        """A number and its bound. Of one that is measured several times (`case` says of what), the page tells
        the worst."""
        value = float(value)
        known = self.measures.get(what)
        if known:
            assert (known.at_most, known.at_least) == (at_most, at_least), what
            known.value = known.worse(value)
        else:
            known = self.measures[what] = Measure(what, value, at_most, at_least)
        fine = known.holds(value)
        self.fine = self.fine and fine
        self.suite.check(f"{case}: {known.bound()}" if case else known.bound(), fine, f"measured {value!r}", *details)
        return fine

    def count(self, what, number, case="", details=()):
        """How many things are wrong: none may be."""
        return self.measure(what, number, at_most=0, case=case, details=details)

    def not_run(self, why):
        """Ends a row that needs what is not here."""
        raise NotRun(why)

    def changed(self, *pairs):
        """The scene with texts replaced; each must be there."""
        text = self.text
        for old, new in pairs:
            if old not in text:
                raise CaseError(f"{self.number}: there is no {old!r} in the scene")
            text = text.replace(old, new)
        return text

    def methods(self):
        """Pairs of name and options of each way to integrate that the program has."""
        return self.suite.methods()

    def planned(self, scene=None):
        """Pairs of asked error and options, where the program plans by an error; none for another scene (than the
        row's) of which it says that it only estimates."""
        plans = self.suite.planned()
        if plans and scene:
            told = load_json(self.render("--stats", "json", scene=scene).output)
            return plans if told["error"]["kind"] == "bounded" else []
        return plans

    def render(self, *arguments, scene=None, **options):
        return self.suite.render(scene or self.text, *arguments, files=self.files, **options)

    def picture(self, *arguments, scene=None, **options):
        """Of the row's scene, or of another."""
        return self.suite.picture(scene or self.text, *arguments, files=self.files, **options)

    def probe(self, pixels, *arguments, scene=None, **options):
        return self.suite.probe(scene or self.text, pixels, *arguments, files=self.files, **options)

    def middle(self, *arguments, scene=None, **options):
        return self.suite.middle(scene or self.text, *arguments, files=self.files, **options)

    # ---- what is kept of it

    def kept(self):
        """Names and contents of the files in the folder of scenes."""
        name = f"F{int(self.number[1:]):02}.x3dv"
        own = name[:3] + "-"
        assert all(file.startswith(own) for file in self.files), f"files of {self.number} begin with {own}"
        contents = {name: self.text, **self.files}
        return {file: c.encode() if isinstance(c, str) else c for file, c in contents.items()}

    def cells(self):
        """Of the page: number, failure, scene, invariant, measured, holds or not."""
        link = f"[F{int(self.number[1:]):02}](../tests/scenes/stability/F{int(self.number[1:]):02}.x3dv)"
        measured = "; ".join(m.text() for m in self.measures.values())
        if self.why_not_run:
            measured = "; ".join(filter(None, [measured, f"not run: {self.why_not_run}"]))
        verdict = "fails" if not self.fine else "holds" if self.measures else "not run"
        return [self.number, self.failure, f"{link} {self.shows}", self.invariant, measured, verdict]


def bounds_of(cell):
    """What is measured and its bounds, without the numbers that come out."""
    return [part.rpartition(": ")[0] for part in cell.split("; ") if not part.startswith("not run: ")]


def page_rows(text):
    """Number -> cells, of the table in the page."""
    rows = {}
    for line in text.splitlines():
        cells = [cell.strip() for cell in line.strip("|").split(" | ")]
        if len(cells) == 6 and re.fullmatch(r"F\d+", cells[0]):
            rows[cells[0]] = cells
    return rows


class Stability(Suite):
    """Rows are cases; after each, the kept files and the page are compared with it."""

    def __init__(self):
        super().__init__()
        self.rows = []
        self.writing = False
        self.known_methods = None
        self.plans = []

    def row(self, number, failure, scene, shows, invariant, files=None, fault=None):
        """`scene`, or a function that makes it. `fault`: why it is known to fail, until that is mended."""

        def register(function):
            row = Row(self, number, failure, scene() if callable(scene) else scene, shows, invariant, files)
            self.rows.append(row)

            def case():
                try:
                    function(row)
                except NotRun as why:
                    row.why_not_run = str(why)
                    self.skip(f"{number} {failure}", why)
                except (CaseError, subprocess.TimeoutExpired):
                    row.fine = False
                    raise
                if not self.writing:
                    self.compare(row)

            case.__name__ = number
            case.__doc__ = f"{number} {failure}"
            self.case(self.known_fault(fault)(case) if fault else case)
            return function

        return register

    def compare(self, row):
        for name, content in row.kept().items():
            path = FOLDER / name
            self.check(f"stability/{name} is the scene drawn", path.exists() and path.read_bytes() == content,
                       "stability.py PLUGRAY --write writes it")
        told = page_rows(PAGE.read_text(encoding="utf-8")).get(row.number) if PAGE.exists() else None
        cells = row.cells()
        if row.why_not_run and told:  # measured elsewhere, and told so
            told, cells = told[:4], cells[:4]
        elif told:
            told = told[:4] + bounds_of(told[4]) + told[5:]
            cells = cells[:4] + bounds_of(cells[4]) + cells[5:]
        self.equal("docs/stability.md tells row, scene and bounds", told, cells)

    def methods(self):
        """Read from the program once."""
        if self.known_methods is None:
            text = self.command("render", "--help").output
            found = re.search(r"--method ([\w|]+)", text)
            names = [n for n in found.group(1).split("|") if n != "auto"] if found else []
            self.known_methods = [(name, ("--method", name)) for name in names] or [("midpoint", ())]
            told = load_json(self.render(front_scene(volume(constant(9))), "--stats", "json").output)
            if told["error"]["kind"] == "bounded":
                self.plans = [(1 / 255, ("--error", "1/255"))]
        return self.known_methods

    def planned(self):
        self.methods()
        return self.plans

    def main(self, name):
        """Runs the rows, where the file is the program."""
        if name == "__main__":
            self.run()


# ---- rays of pixels, in the space of what is turned


def parallel_rays(size, half, axis=(0, 1, 0), angle=0.0, distance=10.0):
    """Origin and direction of each pixel's ray, top row first: an OrthoViewpoint at 0 0 `distance` with a field of
    -half .. half, seen from a box that is turned about `axis`."""
    (width, height), (wide, high) = size, half
    for row in range(height):
        for column in range(width):
            place = (wide * ((column + 0.5) * 2 / width - 1), high * (1 - (row + 0.5) * 2 / height), distance)
            yield rotate(axis, -angle, place), rotate(axis, -angle, (0, 0, -1))


def perspective_rays(size, half_tangent, position=(0, 0, 0), axis=(0, 1, 0), angle=0.0):
    """The same of a Viewpoint at `position` with `orientation` axis, angle; `half_tangent`: of half the smaller angle."""
    width, height = size
    scale = half_tangent / min(width, height)
    for row in range(height):
        for column in range(width):
            ray = unit((scale * (2 * column + 1 - width), scale * (height - 1 - 2 * row), -1.0))
            yield position, rotate(axis, angle, ray)


# ---- arithmetic that rows share


def worst(a, b):
    """The largest difference of two pictures or lists of colours; infinite for NaN."""
    a, b = (p.values if hasattr(p, "values") else [v for color in p for v in color] for p in (a, b))
    if len(a) != len(b):
        return float("inf")
    differences = [abs(x - y) for x, y in zip(a, b)]
    return max(differences) if all(d == d for d in differences) else float("inf")


def pixels_of(picture):
    """All colours, top row first."""
    return [tuple(picture.values[i : i + 4]) for i in range(0, len(picture.values), 4)]


def wrong_numbers(picture, most=1.0 + 1e-6):
    """How many numbers of a picture are no numbers, infinite, or outside of 0 to `most`."""
    values = picture.values if hasattr(picture, "values") else [v for color in picture for v in color]
    return sum(not 0.0 <= v <= most for v in values)
