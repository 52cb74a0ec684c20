#!/usr/bin/env python3
"""What casting several volumes costs, as ratios of CPU times on this machine.

usage: volumes.py PLUGRAY [ROUNDS] [--quick]

Two volumes that overlap are drawn together and each alone, unshaded and shaded; and, where VTK 9
(Debian: python3-vtk9) and Xvfb are there, by VTK with the same data, camera, steps and transfer
functions. Then 1, 2, 4, 8, 16 volumes that overlap. All times are CPU times of all threads of a
process for one frame, the least over all rounds: what else the machine does adds, and never
takes away. Output is TAP; a bound that is not kept fails. --quick draws tiny volumes once, by plugray
alone, and judges no time.
"""

import array
import collections
import json
import math
import os
import shutil
import signal
import subprocess
import sys
import tempfile

QUICK = "--quick" in sys.argv
PROGRAM = os.path.abspath(sys.argv[1])
ROUNDS = next((int(word) for word in sys.argv[2:] if word.isdigit()), 1 if QUICK else 3)
SIDE, SMALL = (16, 8) if QUICK else (128, 64)  # voxels along an edge
SIZE = 64 if QUICK else 512                    # pixels
STEP = 0.5                                     # voxels
TOGETHER = 1.3  # two together against the sum of each alone
FASTER = 10.0   # VTK against plugray
MANY = 1.3      # a volume among sixteen against one of two

COLOR = ((0, (0, 0, 1)), (0.5, (0.9, 0.8, 0.3)), (1, (1, 0.2, 0)))
OPACITY = ((0, (0,)), (0.45, (0,)), (0.5, (0.6,)), (0.55, (0,)), (1, (0,)))
TEXELS = 21  # every knot is the centre of one

Place = collections.namedtuple("Place", "shift angle axis")


# ---- Data ----

def write_nrrd(path, sizes, values, more=""):
    with open(path, "wb") as file:
        file.write(("NRRD0004\ntype: float\ndimension: %d\nsizes: %s\nencoding: raw\nendian: %s\n%s"
                    "min: 0\nmax: 1\n\n" % (len(sizes), " ".join(map(str, sizes)), sys.byteorder,
                                            more)).encode("ascii"))
        file.write(values.tobytes())


def marschner_lobb(side):
    """The test signal of Marschner and Lobb (1994) with fM = 6, alpha = 0.25, on [-1,1]^3."""
    axis = [2 * i / (side - 1) - 1 for i in range(side)]
    rings = [0.25 * (1 + math.cos(12 * math.pi * math.cos(math.pi / 2 * math.hypot(x, y))))
             for y in axis for x in axis]
    values = array.array("f")
    for z in axis:
        values.extend((1 - math.sin(math.pi / 2 * z) + ring) / 2.5 for ring in rings)
    return values


def between(knots, x):
    for (low, first), (high, second) in zip(knots, knots[1:]):
        if x <= high:
            part = (x - low) / (high - low)
            return [(1 - part) * a + part * b for a, b in zip(first, second)]
    return list(knots[-1][1])


def transfer_function():
    values = array.array("f")
    for i in range(TEXELS):
        x = i / (TEXELS - 1)
        values.extend(between(COLOR, x) + between(OPACITY, x))
    return values


def write_data(folder):
    for side in (SIDE, SMALL):
        write_nrrd(os.path.join(folder, f"{side}.nrrd"), (side, side, side), marschner_lobb(side))
    write_nrrd(os.path.join(folder, "function.nrrd"), (4, TEXELS, 1), transfer_function(),
               "kinds: RGBA-color domain domain\n")


# ---- Scenes ----

def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def unit(a):
    length = math.hypot(*a)
    return [x / length for x in a]


def half_height(side):
    """Of the picture: the volume's half diagonal."""
    return math.sqrt(3) * (side - 1) / 2


def camera(side):
    """Where the eye is, seen from the volume's centre, and how it is turned (axis and angle)."""
    z = unit((0.5, 0.35, 0.8))
    distance = half_height(side) / math.sin(math.radians(15))
    x = unit(cross((0, 1, 0), z))
    y = cross(z, x)
    turn = math.acos((x[0] + y[1] + z[2] - 1) / 2)
    axis = unit((y[2] - z[1], z[0] - x[2], x[1] - y[0]))
    return [distance * c for c in z], axis, turn


def pair_places(side):
    """The second volume is turned by 25 degrees and shifted."""
    return [Place((0, 0, 0), 0, (1, 1, 0)),
            Place((0.3 * (side - 1), 0.1 * (side - 1), 0), 25, (1, 1, 0))]


def crowd_places(side, count):
    """Volumes about one centre, each turned otherwise."""
    return [Place((0.01 * (side - 1) * math.cos(i), 0.01 * (side - 1) * math.sin(i), 0), 3 * i,
                  (1, math.cos(i), math.sin(i))) for i in range(count)]


# as VTK's shading below: a diffuse, a specular and an ambient part, from one light at the eye
MATERIAL = ("Material { ambientIntensity .2 diffuseColor .7 .7 .7 specularColor .3 .3 .3 "
            "shininess .15625 }")


def scene_text(side, places, shaded):
    style = 'OpacityMapVolumeStyle { transferFunction ImageTexture { url "function.nrrd" } }'
    if shaded:
        style = ("ComposedVolumeStyle { renderStyle [ %s ShadedVolumeStyle { lighting TRUE "
                 "material %s } ] }" % (style, MATERIAL))
    eye, axis, turn = camera(side)
    text = "#X3D V4.0 utf8\nPROFILE Immersive\n"
    text += "OrthoViewpoint { position %.9g %.9g %.9g orientation %.9g %.9g %.9g %.9g " % (
        *eye, *axis, turn)
    text += "fieldOfView %.9g %.9g %.9g %.9g }\n" % (
        *(-half_height(side),) * 2, *(half_height(side),) * 2)
    crop = 0.5 / side  # VTK's volumes end at the outermost voxels' centres
    for place in places:
        text += ("Transform { translation %.9g %.9g %.9g rotation %.9g %.9g %.9g %.9g children "
                 "VolumeData { dimensions %d %d %d cropMin %.9g %.9g %.9g cropMax %.9g %.9g %.9g "
                 'renderStyle %s voxels ImageTexture3D { url "%d.nrrd" } } }\n'
                 % (*place.shift, *unit(place.axis), math.radians(place.angle), side, side, side,
                    *(crop,) * 3, *(1 - crop,) * 3, style, side))
    return text


# ---- Times ----

class Plugray:
    def __init__(self, folder):
        self.folder = folder

    def render(self, side, places, shaded, *more):
        with open(os.path.join(self.folder, "scene.x3dv"), "w", encoding="ascii") as file:
            file.write(scene_text(side, places, shaded))
        command = [PROGRAM, "render", "scene.x3dv", "--size", f"{SIZE}x{SIZE}", "--step", str(STEP)]
        return subprocess.run(command + list(more), cwd=self.folder, check=True, text=True,
                              stdout=subprocess.PIPE, stderr=subprocess.PIPE).stdout

    def cost(self, side, places, shaded):
        output = self.render(side, places, shaded, "--repeat", "1" if QUICK else "3", "--stats",
                             "json")
        return json.loads(output)["phases"]["draw"]["cpu_ms"]


class Vtk:
    """Raises LookupError with the reason where it cannot draw here."""

    def __init__(self, folder):
        self.folder = folder
        self.server = None
        if QUICK:
            raise LookupError("quick")
        self.python = self.find_python()
        if not shutil.which("Xvfb"):
            raise LookupError("no Xvfb")
        reader, writer = os.pipe()
        # -noreset: else the server starts anew as the last window goes
        self.server = subprocess.Popen(
            ["Xvfb", "-displayfd", str(writer), "-noreset", "-nolisten", "tcp", "-screen", "0",
             "1024x1024x24"], pass_fds=(writer,), stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL)
        os.close(writer)
        with os.fdopen(reader) as answer:
            self.display = ":" + answer.readline().strip()
        if self.display == ":":
            self.close()
            raise LookupError("Xvfb does not start")

    @staticmethod
    def find_python():
        for python in (sys.executable, "/usr/bin/python3"):
            test = subprocess.run([python, "-c", "import vtkmodules.vtkRenderingVolumeOpenGL2"],
                                  check=False, stderr=subprocess.DEVNULL)
            if test.returncode == 0:
                return python
        raise LookupError("no VTK 9 for Python")

    def close(self):
        if self.server:
            self.server.send_signal(signal.SIGTERM)
            self.server.wait()

    def cost(self, side, places, shaded, picture=None):
        job = {"data": os.path.join(self.folder, f"{side}.nrrd"), "side": side, "places": places,
               "shaded": shaded, "size": SIZE, "step": STEP, "color": COLOR, "opacity": OPACITY,
               "eye": camera(side)[0], "half_height": half_height(side), "frames": 1,
               "picture": picture}
        path = os.path.join(self.folder, "job.json")
        with open(path, "w", encoding="utf-8") as file:
            json.dump(job, file)
        child = os.path.join(os.path.dirname(os.path.abspath(__file__)), "volumes_vtk.py")
        answer = subprocess.run([self.python, child, path], check=True, text=True,
                                env={**os.environ, "DISPLAY": self.display},
                                stdout=subprocess.PIPE, stderr=subprocess.DEVNULL).stdout
        return min(json.loads(answer.strip().splitlines()[-1])["cpu_ms"])


def least(cases, rounds):
    """The least time of each case; the cases take turns, so that a busy minute hits all of them."""
    times = {name: math.inf for name in cases}
    for _ in range(rounds):
        for name, measure in cases.items():
            times[name] = min(times[name], measure())
    return times


# ---- Checks ----

count = failed = 0


def report(fine, text, *details):
    global count, failed
    count += 1
    failed += not (fine or QUICK)
    print(f"{'ok' if fine or QUICK else 'not ok'} {count} - {text}")
    for detail in details:
        print(f"# {detail}")
    sys.stdout.flush()


def skip(text, why):
    global count
    count += 1
    print(f"ok {count} - {text} # SKIP {why}")


def picture_difference(plugray, vtk, folder):
    """Root mean square between the two pictures of one volume, colours from 0 to 1."""
    places = pair_places(SIDE)[:1]
    files = os.path.join(folder, "vtk.rgba"), os.path.join(folder, "plugray.npy")
    vtk.cost(SIDE, places, False, files[0])
    plugray.render(SIDE, places, False, "-o", files[1])
    with open(files[0], "rb") as file:
        theirs = file.read()
    with open(files[1], "rb") as file:
        head = file.read(10)
        file.seek(10 + int.from_bytes(head[8:10], "little"))
        ours = array.array("f", file.read())
    row = 4 * SIZE
    squares = sum((ours[y * row + x] - theirs[(SIZE - 1 - y) * row + x] / 255) ** 2
                  for y in range(SIZE) for x in range(row) if x % 4 != 3)
    return math.sqrt(squares / (3 * SIZE * SIZE))


def check_pair(plugray, vtk, shaded):
    how = "shaded" if shaded else "unshaded"
    places = pair_places(SIDE)
    cases = {"first": places[:1], "second": places[1:], "together": places}
    ours = least({name: lambda p=p: plugray.cost(SIDE, p, shaded) for name, p in cases.items()}, ROUNDS)
    ratio = ours["together"] / (ours["first"] + ours["second"])
    report(ratio <= TOGETHER, f"two volumes {how}: {ratio:.2f} times each alone, of at most {TOGETHER}",
           "CPU ms: first %(first).0f, second %(second).0f, together %(together).0f" % ours)
    title = f"two volumes {how}: as VTK"
    if isinstance(vtk, str):
        skip(title, vtk)
        return
    theirs = least({name: lambda p=p: vtk.cost(SIDE, p, shaded) for name, p in cases.items()},
                   min(ROUNDS, 2))
    ratio = theirs["together"] / ours["together"]
    report(ratio >= FASTER, f"two volumes {how}: {ratio:.1f} times less than VTK, of at least {FASTER:g}",
           "CPU ms of VTK: first %(first).0f, second %(second).0f, together %(together).0f" % theirs,
           "one volume: %.2f times less than VTK" % (theirs["first"] / ours["first"]))


def check_crowd(plugray):
    numbers = (1, 2) if QUICK else (1, 2, 4, 8, 16)
    times = least({n: lambda n=n: plugray.cost(SMALL, crowd_places(SMALL, n), False) for n in numbers},
                  ROUNDS)
    most = numbers[-1]
    ratio = times[most] / times[2] * 2 / most
    report(ratio <= MANY, f"{most} volumes: {ratio:.2f} times {most // 2} times two, of at most {MANY}",
           "CPU ms: " + ", ".join(f"{n} volumes {times[n]:.0f}" for n in numbers))


def main():
    with tempfile.TemporaryDirectory() as folder:
        write_data(folder)
        plugray = Plugray(folder)
        try:
            vtk = Vtk(folder)
        except LookupError as why:
            vtk = str(why)
        try:
            if isinstance(vtk, str):
                skip("one volume: the picture of VTK", vtk)
            else:
                difference = picture_difference(plugray, vtk, folder)
                report(difference < 0.01, f"one volume: the picture of VTK, {difference:.4f} apart")
            for shaded in (False, True):
                check_pair(plugray, vtk, shaded)
            check_crowd(plugray)
        finally:
            if not isinstance(vtk, str):
                vtk.close()
    print(f"1..{count}")
    sys.exit(1 if failed else 0)


main()
