"""plr-turns, one process that keeps many views and draws them in turns: what is compared is drawn side by side."""

import json
import os
import selectors
import subprocess

from . import engines

METHODS = {"auto": 0, "midpoint": 1, "preintegrated": 2, "cells": 3}
PATIENCE = 120  # seconds for one answer


def program(plugray):
    """That of the same build."""
    path = os.path.join(os.path.dirname(os.path.abspath(plugray)), os.pardir, "tests", "engine", "plr-turns")
    if not os.path.exists(path):
        raise OSError(f"{os.path.normpath(path)} is not built")
    return path


class View:
    """One scene, drawn in one way."""

    def __init__(self, answer):
        self.index = answer["view"]
        self.bounded, self.value = answer["bounded"], answer["value"]
        self.method, self.step, self.leaps = answer["method"], answer["step"], answer["leaps"]
        self.programs = sorted((p["name"], p["hash"], p["instructions"], p["fetches"]) for p in answer["programs"])


class Turns:
    """Raises OSError where the build has no plr-turns."""

    def __init__(self, plugray):
        self.program = program(plugray)
        self.child = None

    def ask(self, *words):
        if not self.child:
            self.child = subprocess.Popen([self.program], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True,
                                          env=dict(os.environ, MESA_SHADER_CACHE_DISABLE="true"))
        self.child.stdin.write("\t".join(map(str, words)) + "\n")
        self.child.stdin.flush()
        with selectors.DefaultSelector() as ready:
            ready.register(self.child.stdout, selectors.EVENT_READ)
            line = self.child.stdout.readline() if ready.select(PATIENCE) else ""
        if not line:
            self.close()
            raise engines.Failed(f"plr-turns does not answer: {' '.join(map(str, words))}")
        answer = json.loads(line)
        if "failed" in answer:
            raise engines.Failed(f"plr-turns: {answer['failed']}: {' '.join(map(str, words))}")
        return answer

    def scene(self, path):
        self.ask("scene", path)

    def view(self, pixels, method="auto", step=0, error=0, leaps=True):
        return View(self.ask("view", pixels, METHODS[method], repr(float(step)), repr(float(error)), int(leaps)))

    def replace(self, view, name, vertex, fragment):
        """Files in the place of a program that was composed."""
        self.ask("replace", view.index, name, vertex, fragment)

    def picture(self, view, path):
        """Draws and writes it."""
        self.ask("picture", view.index, path)

    def pilots(self, view):
        """CPU milliseconds of the pilot drawings of a view that was drawn before."""
        return self.ask("later", view.index, 0.001)["pilots_cpu_ms"]

    def times(self, views, rounds, clock="cpu"):
        """Milliseconds of each view in each round."""
        return self.ask("turns", rounds, *(v.index for v in views))[f"{clock}_ms"]

    def forget(self):
        if self.child:
            self.ask("forget")

    def close(self):
        if self.child:
            self.child.kill()
            self.child.wait()
            self.child.stdin.close()
            self.child.stdout.close()
            self.child = None
