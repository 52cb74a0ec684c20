"""The true pictures: drawn by the double-precision raycaster of the tests, and kept."""

import array
import hashlib
import os
import sys

from . import data, engines, scenes

SOURCES = os.path.join(os.path.dirname(os.path.abspath(__file__)), *[os.pardir] * 3, "tests", "reference")
sys.path.insert(0, SOURCES)
import reference  # noqa: E402, it lies beside the program that it starts


class Truth:
    """Premultiplied RGBA, doubles, top row first, and the greatest error bar of a channel."""

    def __init__(self, numbers, error):
        self.numbers = numbers
        self.error = error


def texels(volume):
    values = array.array("f", data.function_texels(volume))
    return [tuple(values[i:i + 4]) for i in range(0, len(values), 4)]


def camera(setting):
    axis, angle = scenes.turn()
    side = setting.volume.side
    h = scenes.half_height(side)
    field = 3.141592653589793 / 180 * 2 * scenes.HALF_ANGLE if setting.perspective else (-h, -h, h, h)
    return reference.camera(position=scenes.eye(side), orientation=(*axis, angle), fieldOfView=field)


def volume_of(setting, folder):
    volume = setting.volume
    side, crop = volume.side, 0.5 / volume.side
    shading = reference.vtk_shading(scenes.AMBIENT, scenes.DIFFUSE, scenes.SPECULAR, scenes.POWER,
                                    light="camera") if setting.shaded else None
    return reference.volume((side,) * 3, os.path.join(folder, volume.name + ".raw"),
                            {"float": "f32", "uint8": "u8"}[volume.kind],
                            transfer=reference.texels(texels(volume)), dimensions=(side,) * 3,
                            value_range=(0, volume.top), crop=((crop,) * 3, (1 - crop,) * 3),
                            shading=shading)


def key(setting, folder):
    """What the picture depends on."""
    digest = hashlib.sha256()
    for text in (setting.scene, str(setting.size), data.digest(setting.volume, folder),
                 str(texels(setting.volume))):
        digest.update(text.encode())
    for name in sorted(name for name in os.listdir(SOURCES) if name.endswith((".c", ".h"))):
        with open(os.path.join(SOURCES, name), "rb") as file:
            digest.update(file.read())
    return digest.hexdigest()[:16]


def make(setting, folder):
    path = os.path.join(folder, f"truth-{setting.name}-{key(setting, folder)}")
    if not os.path.exists(path + ".values"):
        values, errors = reference.truth([volume_of(setting, folder)], camera(setting),
                                         (setting.size, setting.size), threads=os.cpu_count())
        for name, numbers in ((".error", array.array("d", [max(errors.data)])), (".values", values.data)):
            with open(path + ".part", "wb") as file:
                numbers.tofile(file)
            os.rename(path + ".part", path + name)
    numbers, error = array.array("d"), array.array("d")
    for array_of, name in ((numbers, ".values"), (error, ".error")):
        with open(path + name, "rb") as file:
            array_of.frombytes(file.read())
    if len(numbers) != 4 * setting.size ** 2:
        raise engines.Failed(f"{path}: {len(numbers)} numbers")
    return Truth(numbers, error[0])
