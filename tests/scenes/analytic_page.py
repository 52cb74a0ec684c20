"""The tests of the analytic cases, and the table of docs/accuracy.md, which tells what they found."""

import pathlib
import re

from harness import Suite

PAGE = pathlib.Path(__file__).resolve().parents[2] / "docs" / "accuracy.md"
BEGIN, END = "<!-- made by tests/scenes/analytic.py: begin -->", "<!-- end -->"
METHODS = ("midpoint", "preintegrated", "cells")


class Analytic(Suite):
    """A suite whose results are rows of the page: what a method was found to do in a case."""

    def __init__(self):
        super().__init__()
        self.results = {}  # row -> method -> what was expected, what was measured
        self.sheets = []

    def result(self, row, method, expected, measured, fine, *details):
        row = row or self.title
        self.results.setdefault(row, {})[method] = (expected, measured)
        name = "" if row == self.title else row + ": "
        return self.check(f"{name}{method}: {expected} ({measured})", fine, *details)

    def main(self, name):
        """Where the file is run and not imported."""
        if name == "__main__":
            self.case(self.page)
            self.run()

    def page(self):
        "docs/accuracy.md tells what was found"
        told = page_rows(PAGE.read_text(encoding="utf-8"))
        for row, found in self.results.items():
            cells = told.get(row, {})
            wrong = [f"{method}: {expected}, not {cells.get(method)!r}"
                     for method, (expected, _) in found.items()
                     if not cells.get(method, "").startswith(expected + " (")]
            if wrong:
                self.check(f"{row} (else run tests/scenes/analytic.py PLUGRAY --write)", False, *wrong)
        self.check("all rows", set(self.results) <= set(told))


def page_rows(text):
    """Row -> method -> cell."""
    found = {}
    for line in text[text.index(BEGIN):text.index(END)].splitlines():
        cells = [cell.strip() for cell in line.strip("|").split("|")]
        if len(cells) == len(METHODS) + 1 and re.match(r"V\d", cells[0]):
            found[cells[0]] = dict(zip(METHODS, cells[1:]))
    return found


def cells_of(found):
    """`found`: method -> (expected, measured)."""
    return {method: f"{expected} ({measured})" for method, (expected, measured) in found.items()}


def table(rows):
    """`rows`: row -> method -> cell."""
    def number(row):
        return int(re.match(r"V(\d+)", row).group(1))

    lines = ["| case | " + " | ".join(METHODS) + " |", "| --- |" + " --- |" * len(METHODS)]
    for row in sorted(rows, key=number):
        lines.append(f"| {row} | " + " | ".join(rows[row].get(method, "") for method in METHODS) + " |")
    return "\n".join(lines) + "\n"
