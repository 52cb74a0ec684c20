"""Runs the program under test: a Command has its own folder for files."""

import pathlib
import subprocess
import tempfile

from tap import check


class Command:
    def __init__(self, program):
        self.program = str(pathlib.Path(program).resolve())
        self.temporary = tempfile.TemporaryDirectory()
        self.folder = pathlib.Path(self.temporary.name)

    def write(self, name, text):
        path = self.folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        if isinstance(text, bytes):
            path.write_bytes(text)
        else:
            path.write_text(text, encoding="utf-8")
        return path

    def read(self, name):
        return (self.folder / name).read_text(encoding="utf-8")

    def run(self, *arguments, stdin=None, env=None):
        """The finished process; its output is text."""
        return subprocess.run([self.program, *arguments], cwd=self.folder, input=stdin, env=env,
                              capture_output=True, encoding="utf-8", errors="replace", timeout=300)

    def expect(self, status, *arguments, stderr="", **more):
        """Runs, checks the exit status, and that standard error has a text."""
        done = self.run(*arguments, **more)
        check(done.returncode == status and stderr in done.stderr,
              f"plugray {' '.join(arguments)}: exit status {status}{', ' + stderr if stderr else ''}",
              f"exit status {done.returncode}", done.stderr[:3000])
        return done
