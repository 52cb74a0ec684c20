"""A small TAP producer for tests written in Python."""

import sys

count = 0
failed = 0


def check(condition, name, *details):
    """One check; the details are printed where it fails."""
    global count, failed
    count += 1
    print(f"{'ok' if condition else 'not ok'} {count} - {' '.join(name.split())}")
    if not condition:
        failed += 1
        for detail in details:
            for line in str(detail).splitlines():
                print(f"#   {line}")
    sys.stdout.flush()
    return bool(condition)


def check_equal(actual, expected, name):
    return check(actual == expected, name, f"expected: {expected!r}", f"actual:   {actual!r}")


def skip(name, why):
    global count
    count += 1
    print(f"ok {count} - {name} # SKIP {why}")


def done():
    print(f"1..{count}")
    sys.exit(1 if failed else 0)
