#!/usr/bin/env python3
"""The scripts that set up, count and check: house.py SOURCE-ROOT"""

import json
import pathlib
import re
import subprocess
import sys
import tempfile

from tap import check, check_equal, done

root = pathlib.Path(sys.argv[1])

# ---- shell scripts can be read, and stop at errors

for name in ("tools/setup", "tools/data", "tools/build", "tools/demo", "tools/test", ".ci/run"):
    path = root / name
    read = subprocess.run(["bash", "-n", str(path)], capture_output=True, encoding="utf-8")
    check(read.returncode == 0, f"bash can read {name}", read.stderr)
    text = path.read_text(encoding="utf-8")
    check(re.search(r"^set -e?uo pipefail$", text, re.M), f"{name} stops at errors")
    check(path.stat().st_mode & 0o111, f"{name} can be run")

# ---- counting tests


def count(*tests):
    """What tools/count-tests says of these results of meson."""
    with tempfile.NamedTemporaryFile("w", suffix=".json") as log:
        for name, result, output in tests:
            log.write(json.dumps({"name": name, "result": result, "stdout": output}) + "\n")
        log.flush()
        run = subprocess.run([str(root / "tools/count-tests"), log.name], capture_output=True,
                             encoding="utf-8")
    return run.stdout.splitlines(), run.returncode


lines, status = count(("a", "OK", "ok 1 - x\nok 2 - y # SKIP no data\n1..2\n"), ("b", "OK", ""))
check_equal(lines[-1], "2 passed, 0 failed, 1 skipped", "single checks are counted")
check_equal(status, 0, "all passed: status 0")
check(any("no data" in line for line in lines), "what is skipped is listed", lines)

lines, status = count(("a", "OK", "ok 1 - x\nnot ok 2 - y # TODO hard\nok 3 - z # TODO easy\n1..3\n"))
check_equal((lines[-1], status), ("2 passed, 0 failed, 1 skipped", 0), "a known fault does not count as passed")
check(any("y # TODO hard" in line for line in lines), "known faults are listed", lines)

lines, status = count(("a", "FAIL", "ok 1 - x\nnot ok 2 - y\n1..2\n"))
check_equal(lines[-1], "1 passed, 1 failed, 0 skipped", "failed checks are counted")
check_equal(status, 1, "one failed: status 1")
check("failed: a: 2 - y" in lines, "what failed is listed", lines)

lines, status = count(("a", "ERROR", "ok 1 - x\n"), ("b", "TIMEOUT", "ok 1 - x\n"))
check_equal(lines[-1], "2 passed, 2 failed, 0 skipped", "a test that crashed or hung counts as failed")
lines, status = count(("a", "SKIP", "1..0 # SKIP no GL\n"))
check_equal((lines[-1], status), ("0 passed, 0 failed, 1 skipped", 1), "no check at all is a failure")

# ---- lists

packages = [line.split() for line in (root / "tools/packages.txt").read_text().splitlines()
            if line and not line.startswith("#")]
check(all(re.fullmatch(r"[a-z0-9][a-z0-9+.-]+", row[0]) and row[1:] in ([], ["checks"], ["bench"])
          for row in packages), "each row of tools/packages.txt is a package", packages)
rows = [line.split() for line in (root / "tools/data.txt").read_text().splitlines()
        if line and not line.startswith("#")]
check(all(len(row) == 3 and re.fullmatch(r"[0-9a-f]{64}", row[0]) for row in rows),
      "each row of tools/data.txt has a sum, a package and a path", rows)

# ---- the tree

tracked = subprocess.run(["git", "-C", str(root), "ls-files"], capture_output=True, encoding="utf-8")
if tracked.returncode == 0:
    wrong = []
    for name in tracked.stdout.splitlines():
        path = root / name
        if path.suffix in (".c", ".h", ".py", ".glsl", ".build", ".md", ".def", ".sh") and path.exists():
            data = path.read_bytes()
            if b"\r" in data or b"\t" in data and path.suffix != ".md" or data and not data.endswith(b"\n"):
                wrong.append(name)
    check(not wrong, "sources have no tabs, no carriage returns and end with a newline", *wrong)
done()
