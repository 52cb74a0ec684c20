"""Those that draw: plugray, a process a point, and VTK, one process that is asked again and again."""

import array
import json
import os
import shutil
import signal
import subprocess
import sys

from . import scenes

HERE = os.path.dirname(os.path.abspath(__file__))


class Frame:
    """What drawing one picture took, milliseconds, all threads."""

    def __init__(self, cpu, wall):
        self.cpu = cpu
        self.wall = wall


def median(values):
    values = sorted(values)
    middle = len(values) // 2
    return values[middle] if len(values) % 2 else (values[middle - 1] + values[middle]) / 2


def read_npy(path):
    """Its numbers, top row first, as floats or doubles."""
    with open(path, "rb") as file:
        data = file.read()
    start = 10 if data[6] == 1 else 12
    header = int.from_bytes(data[8:start], "little")
    kind = "d" if b"<f8" in data[start:start + header] else "f"
    return array.array(kind, data[start + header:])


class Failed(Exception):
    """The engine did not draw."""


class Plugray:
    def __init__(self, program, folder):
        self.program = os.path.abspath(program)
        self.folder = folder
        self.count = 0
        words = subprocess.run([self.program, "render", "--help"], check=False, text=True,
                               stdout=subprocess.PIPE, stderr=subprocess.STDOUT).stdout
        self.options = {word for word in ("--method", "--error", "--no-leaping") if word in words}

    def can(self, words):
        """Whether this build knows these options."""
        return all(w in self.options for w in words if w.startswith("--") and w != "--step")

    def render(self, text, words, size, picture=None, repeat=1):
        """Draws a scene's text; the statistics, with `frame` among them."""
        self.count += 1
        name = f"scene-{os.getpid()}.x3dv"
        with open(os.path.join(self.folder, name), "w", encoding="ascii") as file:
            file.write(text)
        command = [self.program, "render", name, "--size", f"{size}x{size}", "--stats", "json",
                   "--no-cache", "--repeat", str(repeat), *words]
        if picture:
            command += ["-o", picture]
        done = subprocess.run(command, cwd=self.folder, text=True, check=False,
                              stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        if done.returncode or not done.stdout:
            raise Failed(" ".join(command) + "\n" + done.stderr)
        stats = json.loads(done.stdout)
        stats["frame"] = Frame(stats["phases"]["draw"]["cpu_ms"], stats["phases"]["draw"]["wall_ms"])
        stats["messages"] = done.stderr
        return stats


class Vtk:
    """Raises LookupError with the reason where it cannot draw here."""

    def __init__(self, folder):
        self.folder = folder
        self.python = self.find_python()
        self.version = ""
        self.child = self.server = None
        self.environment = dict(os.environ, MESA_SHADER_CACHE_DISABLE="true")
        if not os.environ.get("DISPLAY"):
            self.start_server()

    @staticmethod
    def find_python():
        for python in (sys.executable, "/usr/bin/python3"):
            test = subprocess.run([python, "-c", "import vtkmodules.vtkRenderingVolumeOpenGL2"],
                                  check=False, stderr=subprocess.DEVNULL)
            if test.returncode == 0:
                return python
        raise LookupError("no VTK 9 for Python")

    def start_server(self):
        if not shutil.which("Xvfb"):
            raise LookupError("no Xvfb")
        reader, writer = os.pipe()
        # -noreset: else the server starts anew as the last window goes
        self.server = subprocess.Popen(
            ["Xvfb", "-displayfd", str(writer), "-noreset", "-nolisten", "tcp", "-screen", "0",
             "1280x1280x24"], pass_fds=(writer,), stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL)
        os.close(writer)
        with os.fdopen(reader) as answer:
            number = answer.readline().strip()
        if not number:
            self.close()
            raise LookupError("Xvfb does not start")
        self.environment["DISPLAY"] = ":" + number

    def forget(self):
        """Ends the process, and with it its windows and textures."""
        if self.child:
            self.child.stdin.close()
            self.child.wait()
            self.child = None

    def close(self):
        self.forget()
        if self.server:
            self.server.send_signal(signal.SIGTERM)
            self.server.wait()
            self.server = None

    def render(self, volume, mapper, step, size, perspective=False, shaded=False, picture=None,
               budget=0.5, places=None):
        """`places`: of several volumes with the same data, each (shift, degrees, axis)."""
        if not self.child:
            self.child = subprocess.Popen([self.python, os.path.join(HERE, "vtk_child.py")], text=True,
                                          env=self.environment, stdin=subprocess.PIPE,
                                          stdout=subprocess.PIPE, stderr=subprocess.DEVNULL)
        job = {"volume": {"path": os.path.join(self.folder, volume.name + ".raw"), "side": volume.side,
                          "kind": volume.kind, "color": volume.color, "opacity": volume.opacity},
               "mapper": mapper, "step": step, "size": size, "perspective": perspective,
               "shading": [scenes.AMBIENT, scenes.DIFFUSE, scenes.SPECULAR, scenes.POWER] if shaded
               else None, "eye": scenes.eye(volume.side), "angle": 2 * scenes.HALF_ANGLE,
               "half_height": scenes.half_height(volume.side), "picture": picture, "budget": budget,
               "places": places}
        self.child.stdin.write(json.dumps(job) + "\n")
        self.child.stdin.flush()
        line = self.child.stdout.readline()
        if not line:
            raise Failed(f"VTK did not draw {volume.name}, {mapper}, {step}")
        answer = json.loads(line)
        self.version = answer["version"]
        return Frame(median(answer["cpu_ms"]), median(answer["wall_ms"]))


def read_vtk(path, size):
    """A picture of VTK, top row first."""
    with open(path, "rb") as file:
        bottom_first = array.array("f", file.read())
    row = 4 * size
    top_first = array.array("f")
    for y in reversed(range(size)):
        top_first.extend(bottom_first[y * row:(y + 1) * row])
    return top_first
