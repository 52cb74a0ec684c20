"""What the tests of DICOM share: small volumes drawn side by side, each voxel a pixel."""

import os
import subprocess
import tempfile

from dicom_data import dicom, image
from harness import Picture, Suite
from scenes import effect, scene, volume

suite = Suite()

# Where one looks from: the turn of an OrthoViewpoint, and the place of the axis across in
# `dimensions`. From below, pixel (x, k), counted from the bottom row, is voxel x of slice k, row 0.
BELOW = ("position 0 -10 0 orientation 1 0 0 1.5707963267948966", 2)
FRONT = ("position 0 0 10", 1)
SHOW = effect("void PLUG_volume_classify(inout vec4 color, const in VolumeSample s) "
              "{ color = vec4(s.value.rgb, 1.0); }")


class Case:
    """One url, and what is to be seen of it in a picture of `size` pixels, each a voxel."""

    def __init__(self, name, url, files, expected, size=None, low=0, high=255, view=BELOW,
                 fields=None, texture="", tolerance=1e-5):
        self.name, self.url, self.files, self.expected = name, url, files, list(expected)
        self.size = size or (len(self.expected), 1)
        self.low, self.high, self.view, self.texture = low, high, view, texture
        self.fields = f"valueRange {low} {high}" if fields is None else fields
        self.tolerance = tolerance * (high - low)

    def text(self, left, prefix=""):
        """The volume, whose left side is at `left`, its lower one at 0."""
        width, height = self.size
        turn, across = self.view
        dimensions, place = [width, 1, 1], [left + width / 2, 0, 0]
        dimensions[across], place[across] = height, height / 2
        data = volume(f'ImageTexture3D {{ url "{prefix}{self.url}" {self.texture} }}',
                      effects=SHOW, fields=self.fields, dimensions=dimensions)
        return f"Transform {{ translation {place[0]} {place[1]} {place[2]} children {data} }}"


def draw(cases, prefixes=None, **options):
    """All of them side by side: the colours of each, its lowest row first, and what is said."""
    prefixes = prefixes or [""] * len(cases)
    lefts = [sum(c.size[0] for c in cases[:i]) for i in range(len(cases))]
    width, height = lefts[-1] + cases[-1].size[0], max(c.size[1] for c in cases)
    files = {p + name: content for p, c in zip(prefixes, cases)
             for name, content in c.files.items()}
    text = scene(f"OrthoViewpoint {{ {cases[0].view[0]} fieldOfView 0 0 {width} {height} }}\n",
                 *(c.text(left, p) for c, left, p in zip(cases, lefts, prefixes)))
    result = suite.render(text, "-o", "picture.npy", "--step", "0.01", *options.pop("words", ()),
                          files=files, size=f"{width}x{height}", **options)
    picture = Picture(os.path.join(result.folder, "picture.npy"))
    return [[picture.at(left + x, height - 1 - y)[:3] for y in range(c.size[1])
             for x in range(c.size[0])] for c, left in zip(cases, lefts)], result


def physical(case, colours):
    return [c[0] * (case.high - case.low) + case.low for c in colours]


def all_close(*cases):
    """Draws cases that have the same view; nothing is said of any of them."""
    colours, result = draw(cases, [f"case{i}/" for i in range(len(cases))])
    for case, seen in zip(cases, colours):
        suite.close(case.name, physical(case, seen), case.expected, case.tolerance)
    suite.equal("nothing is said", texts(result), [])


def show(*arguments, said=(), **options):
    """Draws one case; what is said of it."""
    words = options.pop("words", ())
    folder = options.pop("folder", None)
    case = Case(*arguments, **options)
    colours, result = draw([case], words=words, folder=folder)
    suite.close(case.name, physical(case, colours[0]), case.expected, case.tolerance)
    suite.equal(f"{case.name}: said", texts(result), list(said))


def texts(result):
    return [f"{m[3]} {m[4]}" for m in result.messages()]


def refused(cases):
    """Cases of name, url, files, code, end of the message: one error each, at the url."""
    folder, names, files = suite.new_folder(), [], {}
    for i, (_, url, content, _, _) in enumerate(cases):
        names.append(f"case{i}/scene.x3dv")
        files[names[-1]] = scene(Case("", url, {}, [0]).text(0))
        files.update({f"case{i}/{name}": data for name, data in content.items()})
    found = suite.command("check", *names, files=files, folder=folder, status=1).messages()
    for name, case in zip(names, cases):
        own = [m for m in found if m[0] == name]
        suite.check(case[0], [(m[1], m[3], m[5]) for m in own] == [(4, "error", case[3])]
                    and own[0][4].endswith(case[4]), case[4], *own)


def in_folder(files):
    return {f"scan/{name}": content for name, content in files.items()}


def stack(places, **fields):
    """Slices of two pixels that hold 10 times their place, and 1 more; names run backwards."""
    return in_folder({
        f"slice{99 - number}": dicom(image(2, 1, [round(10 * z), round(10 * z) + 1],
                                           position=(0, 0, z), number_of=number, **fields))
        for number, z in enumerate(places)})


def one(values, columns=None, **fields):
    """A file of one slice of one row."""
    return dicom(image(columns or len(values), 1, values, **fields))


def single(name, content, expected, low, high, **options):
    """A case of a file of one row."""
    return Case(name, "a.dcm", {"a.dcm": content}, expected, low=low, high=high, **options)


def is_built():
    """Whether this program reads DICOM."""
    with tempfile.TemporaryDirectory() as folder:
        names = {"scene.x3dv": scene(Case("", "a.dcm", {}, [0]).text(0)).encode(),
                 "a.dcm": dicom(image(1, 1, [1]))}
        for name, content in names.items():
            with open(os.path.join(folder, name), "wb") as file:
                file.write(content)
        done = subprocess.run([suite.program, "check", "scene.x3dv"], cwd=folder, check=False,
                              capture_output=True, encoding="utf-8")
    return "this plugray was built without DICOM" not in done.stderr


def run():
    """All cases; without a library, only that there is an error."""
    if not is_built():
        suite.cases.clear()
        suite.cases.append(built_without)
    suite.run()


def built_without():
    "without a library, an error at the url"
    refused([(url, url, stack([0, 1]), "bad-volume", "this plugray was built without DICOM")
             for url in ("scan/", "scan/slice99")])
