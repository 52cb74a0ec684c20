"""Draws with VTK 9 what pareto asks for, and says what a frame costs.

Reads one JSON object a line: `volume` {path, side, kind, color, opacity}, `perspective`, `shaded`,
`mapper` (gpu or fixed), `places` (null, or of volumes that have these data: shift, degrees, axis), `step` (voxels), `size` (pixels), `budget` (CPU seconds), `picture` (a file for
float RGBA, bottom row first, or null). Answers one line for each: `cpu_ms` and `wall_ms` of every frame
after a first one. Windows are kept from line to line. Needs a display.
"""

import ctypes
import json
import math
import resource
import sys
import time

import vtkmodules.vtkRenderingOpenGL2  # noqa: F401, draws
import vtkmodules.vtkRenderingVolumeOpenGL2 as volumes_gl
from vtkmodules.vtkCommonCore import vtkUnsignedCharArray, vtkVersion
from vtkmodules.vtkCommonDataModel import vtkPiecewiseFunction
from vtkmodules.vtkIOImage import vtkImageImport
from vtkmodules.vtkRenderingCore import (vtkColorTransferFunction, vtkRenderWindow, vtkRenderer,
                                         vtkVolume, vtkVolumeProperty)
from vtkmodules.vtkRenderingVolume import vtkFixedPointVolumeRayCastMapper, vtkMultiVolume

TEXTURE_2D, RGBA, FLOAT, RGBA32F = 0x0DE1, 0x1908, 0x1406, 0x8814
MOST_FRAMES = 5


def read(volume):
    with open(volume["path"], "rb") as file:
        data = file.read()
    source = vtkImageImport()
    if volume["kind"] == "float":
        source.SetDataScalarTypeToFloat()
    else:
        source.SetDataScalarTypeToUnsignedChar()
    source.SetNumberOfScalarComponents(1)
    last = volume["side"] - 1
    source.SetWholeExtent(0, last, 0, last, 0, last)
    source.SetDataExtentToWholeExtent()
    source.CopyImportVoidPointer(data, len(data))
    source.Update()
    return source


def make_property(volume, shading):
    color, opacity = vtkColorTransferFunction(), vtkPiecewiseFunction()
    for value, rgb in volume["color"]:
        color.AddRGBPoint(value, *rgb)
    for value, alpha in volume["opacity"]:
        opacity.AddPoint(value, alpha)
    made = vtkVolumeProperty()
    made.SetColor(color)
    made.SetScalarOpacity(opacity)
    made.SetScalarOpacityUnitDistance(1)
    made.SetInterpolationTypeToLinear()
    if shading:
        made.ShadeOn()
        made.SetAmbient(shading[0])
        made.SetDiffuse(shading[1])
        made.SetSpecular(shading[2])
        made.SetSpecularPower(shading[3])
    return made


def make_mapper(kind):
    if kind == "gpu":
        mapper = volumes_gl.vtkOpenGLGPUVolumeRayCastMapper()
        mapper.SetUseJittering(0)
    else:
        mapper = vtkFixedPointVolumeRayCastMapper()
        mapper.SetIntermixIntersectingGeometry(0)
        mapper.SetNumberOfThreads(2)
    mapper.SetAutoAdjustSampleDistances(0)
    mapper.SetLockSampleDistanceToInputSpacing(0)
    mapper.SetImageSampleDistance(1)
    mapper.SetMinimumImageSampleDistance(1)
    mapper.SetMaximumImageSampleDistance(1)
    mapper.SetBlendModeToComposite()
    return mapper


def set_step(mapper, step):
    mapper.SetSampleDistance(step)
    if isinstance(mapper, vtkFixedPointVolumeRayCastMapper):
        mapper.SetInteractiveSampleDistance(step)


def make_prop(job, source, mapper):
    """Several volumes as vtkMultiVolume: it alone mixes them."""
    half = job["volume"]["side"] / 2 - 0.5
    places = job["places"] or [((0, 0, 0), 0, (1, 0, 0))]
    several = vtkMultiVolume() if len(places) > 1 else None
    if several:
        several.SetMapper(mapper)
    for port, (shift, angle, axis) in enumerate(places):
        volume = vtkVolume()
        volume.SetProperty(make_property(job["volume"], job["shading"]))
        volume.SetOrigin(half, half, half)
        volume.RotateWXYZ(angle, *axis)
        volume.SetPosition(*shift)
        mapper.SetInputConnection(port, source.GetOutputPort())
        if not several:
            volume.SetMapper(mapper)
            return volume
        several.SetVolume(volume, port)
    return several


def make_window(job, source):
    mapper = make_mapper(job["mapper"])
    renderer = vtkRenderer()
    renderer.SetBackground(0, 0, 0)
    renderer.SetBackgroundAlpha(0)
    renderer.AddVolume(make_prop(job, source, mapper))
    window = vtkRenderWindow()
    window.SetMultiSamples(0)
    window.SetAlphaBitPlanes(1)
    window.SetSize(job["size"], job["size"])
    window.SetDesiredUpdateRate(1e-4)
    window.AddRenderer(renderer)
    half = job["volume"]["side"] / 2 - 0.5
    camera = renderer.GetActiveCamera()
    camera.SetFocalPoint(half, half, half)
    camera.SetPosition(*(half + p for p in job["eye"]))
    camera.SetViewUp(0, 1, 0)
    if job["perspective"]:
        camera.SetViewAngle(job["angle"])
    else:
        camera.ParallelProjectionOn()
        camera.SetParallelScale(job["half_height"])
    renderer.ResetCameraClippingRange()
    set_step(mapper, job["step"])
    window.Render()
    make_float(window, job["size"])
    return window, mapper


class Gl:
    """The few functions that VTK does not offer to Python."""
    library = None

    @classmethod
    def get(cls):
        cls.library = cls.library or ctypes.CDLL("libGL.so.1")
        return cls.library


def color_texture(window):
    window.MakeCurrent()
    return window.GetRenderFramebuffer().GetColorAttachmentAsTextureObject(0).GetHandle()


def make_float(window, size):
    """The window's own colour texture, of 8 bits a channel, is made one of floats."""
    gl = Gl.get()
    gl.glBindTexture(TEXTURE_2D, color_texture(window))
    gl.glTexImage2D(TEXTURE_2D, 0, RGBA32F, size, size, 0, RGBA, FLOAT, None)
    gl.glBindTexture(TEXTURE_2D, 0)


def write_picture(window, size, path):
    gl = Gl.get()
    pixels = (ctypes.c_float * (4 * size * size))()
    gl.glBindTexture(TEXTURE_2D, color_texture(window))
    gl.glGetTexImage(TEXTURE_2D, 0, RGBA, FLOAT, pixels)
    gl.glBindTexture(TEXTURE_2D, 0)
    with open(path, "wb") as file:
        file.write(bytes(pixels))


def now():
    usage = resource.getrusage(resource.RUSAGE_SELF)
    return 1e3 * (usage.ru_utime + usage.ru_stime), 1e3 * time.monotonic()


def draw(window, pixel):
    start = now()
    window.Render()
    window.GetRGBACharPixelData(0, 0, 0, 0, 0, pixel)  # waits until the frame is there
    end = now()
    return end[0] - start[0], end[1] - start[1]


def answer(job, windows, sources):
    key = json.dumps([job[k] for k in ("volume", "perspective", "shading", "mapper", "size", "places")])
    if key not in windows:
        path = job["volume"]["path"]
        sources[path] = sources.get(path) or read(job["volume"])
        windows[key] = make_window(job, sources[path])
    window, mapper = windows[key]
    set_step(mapper, job["step"])
    pixel = vtkUnsignedCharArray()
    first = draw(window, pixel)
    frames = math.ceil(min(MOST_FRAMES, max(1, 1e3 * job["budget"] / max(first[0], 1))))
    times = [draw(window, pixel) for _ in range(frames)]
    if job["picture"]:
        write_picture(window, job["size"], job["picture"])
    return {"cpu_ms": [t[0] for t in times], "wall_ms": [t[1] for t in times],
            "version": vtkVersion.GetVTKVersion()}


def main():
    windows, sources = {}, {}
    for line in sys.stdin:
        print(json.dumps(answer(json.loads(line), windows, sources)), flush=True)


main()
