"""How far it is, for people."""

import sys
import time


class Progress:
    """A line on standard error that says how far it is."""

    def __init__(self, name):
        self.name = name
        self.start = time.monotonic()
        self.count = 0
        self.part = self.more = ""
        self.notes = []

    def begin(self, part):
        self.part, self.count, self.more = part, 0, ""
        self.show("\n")

    def step(self, more=""):
        self.count += 1
        self.more = more
        self.show("\r")

    def show(self, before):
        if sys.stderr.isatty() or before == "\n":
            lead, end = (before, "") if sys.stderr.isatty() else ("", "\n")
            count = f"  {self.count}{self.more}" if self.count else ""
            sys.stderr.write(f"{lead}{time.monotonic() - self.start:6.0f} s  {self.part}{count}{end}")
            sys.stderr.flush()

    def note(self, text):
        self.notes.append(text)
        sys.stderr.write(f"\n{self.name}: {text}\n")
