#!/usr/bin/env python3
"""Runs the analytic cases and writes what they found into docs/accuracy.md.

analytic.py PLUGRAY --write [ramps|fields|surfaces|volumes|segments|styles...]

Without names all are run, and rows of cases that are no more go.
"""

import importlib
import sys

FILES = ("ramps", "fields", "surfaces", "volumes", "segments", "styles")
names = sys.argv[3:] or FILES
if sys.argv[2:3] != ["--write"] or not set(names) <= set(FILES):
    sys.exit(__doc__)
whole = not sys.argv[3:]
del sys.argv[2:]

from analytic_page import BEGIN, END, PAGE, cells_of, page_rows, table  # noqa: E402

failed, results = 0, {}
for name in names:
    suite = importlib.import_module("analytic_" + name).suite
    try:
        suite.run()
    except SystemExit as end:
        failed |= int(bool(end.code))
    results.update((row, cells_of(found)) for row, found in suite.results.items())
text = PAGE.read_text(encoding="utf-8")  # as others left it
rows = {**({} if whole else page_rows(text)), **results}
head, rest = text.split(BEGIN)
PAGE.write_text(f"{head}{BEGIN}\n\n{table(rows)}\n{END}{rest.split(END)[1]}", encoding="utf-8")
sys.exit(failed)
