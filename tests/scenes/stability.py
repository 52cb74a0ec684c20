#!/usr/bin/env python3
"""The page of failures, docs/stability.md, and the rows behind it.

stability.py PLUGRAY                    check that the page has each row once, and none that fails
stability.py PLUGRAY --write [F7...]    run the rows (or these), write their scenes and the page
"""

import fcntl
import importlib
import pathlib
import sys

ARGUMENTS = sys.argv[1:]
sys.argv = sys.argv[:2]  # files of rows look at them, too

from stability_data import FOLDER, LARGEST_FILE, PAGE, page_rows  # noqa: E402

ROWS = 55
FILES = [f"stability_{i}" for i in range(1, 6)]
HERE = pathlib.Path(__file__).resolve().parent

HEAD = """# Stability

Ways in which raycasters of volumes are known to fail. Each has a scene that shows it, an invariant that must hold, and
a test that measures whether it does: `tests/scenes/stability_*.py`. The table is written by them:

    tests/scenes/stability.py PLUGRAY --write [ROW...]

and each run of the tests compares it with what they measure: rows, scenes, bounds, and that the bounds hold. The
numbers behind the bounds are the worst of all methods of sampling and all cases of a row, with Mesa's software renderer
on the machine that wrote the page. Lengths of "voxels" are steps of `--step`.

| row | failure | scene | invariant | measured | |
| --- | --- | --- | --- | --- | --- |
"""


def line(cells):
    assert not any(" | " in cell or "\n" in cell for cell in cells), cells
    return "| " + " | ".join(cells) + " |\n"


def write_page(rows):
    """Puts the rows in place of those with their numbers; others stay."""
    FOLDER.mkdir(exist_ok=True)
    with open(HERE / "stability_data.py", "rb") as lock:  # several may write at once
        fcntl.flock(lock, fcntl.LOCK_EX)
        known = page_rows(PAGE.read_text(encoding="utf-8")) if PAGE.exists() else {}
        for row in rows:
            if row.why_not_run and not row.measures and row.number in known:
                continue
            known[row.number] = row.cells()
        ordered = sorted(known.values(), key=lambda cells: int(cells[0][1:]))
        PAGE.write_text(HEAD + "".join(line(cells) for cells in ordered), encoding="utf-8")


def write(wanted):
    failed = 0
    for name in FILES:
        if not (HERE / f"{name}.py").exists():
            continue
        suite = importlib.import_module(name).suite
        rows = [row for row in suite.rows if not wanted or row.number in wanted]
        if not rows:
            continue
        suite.wanted = [row.number for row in rows]
        suite.writing = True
        try:
            suite.run()
        except SystemExit as end:
            failed |= bool(end.code)
        for row in rows:
            for file, content in row.kept().items():
                (FOLDER / file).write_bytes(content)
        write_page(rows)
    return int(failed)


def check():
    """Without drawing anything."""
    numbers = [f"F{i}" for i in range(1, ROWS + 1)]
    text = PAGE.read_text(encoding="utf-8")
    told = page_rows(text)
    rows = {}
    for name in FILES:
        if (HERE / f"{name}.py").exists():
            for row in importlib.import_module(name).suite.rows:
                rows.setdefault(row.number, []).append(row)
    kept = {name for found in rows.values() for row in found for name in row.kept()}
    there = {path.name for path in FOLDER.iterdir()}
    results = [
        ("each row has one test", sorted(rows) == sorted(numbers) and all(len(r) == 1 for r in rows.values()),
         sorted(set(numbers) ^ set(rows))),
        ("the page has the rows in order", list(told) == numbers and text.startswith(HEAD), list(told)),
        ("none fails", all(cells[5] in ("holds", "not run") for cells in told.values()),
         [n for n, cells in told.items() if cells[5] not in ("holds", "not run")]),
        ("only what other hardware is needed for is not run",
         {n for n, cells in told.items() if cells[5] == "not run"} <= {"F36", "F54", "F55"}, ""),
        ("the scenes are kept, and no others", kept == there, sorted(kept ^ there)),
        ("scenes are small", all((FOLDER / n).stat().st_size <= LARGEST_FILE for n in there), ""),
    ]
    print(f"1..{len(results)}")
    for number, (name, fine, details) in enumerate(results, 1):
        print(f"{'ok' if fine else 'not ok'} {number} - {name}")
        if not fine:
            print(f"#   {details}")
    return int(not all(fine for _, fine, _ in results))


if not ARGUMENTS or ARGUMENTS[1:2] not in ([], ["--write"]):
    sys.exit(__doc__)
sys.exit(write(ARGUMENTS[2:]) if ARGUMENTS[1:2] else check())
