"""Draws the volumes of volumes.py with VTK 9 and says what a frame costs.

usage: volumes_vtk.py JOB.json

The job says which volumes there are; the answer is one JSON object on standard output: `cpu_ms`, the
CPU time of each frame, and `vtk`, its version. Needs a display. With `picture` the last frame is
written there, RGBA, 8 bits, bottom row first.
"""

import json
import resource
import sys

import vtkmodules.vtkRenderingOpenGL2  # noqa: F401, draws
from vtkmodules.vtkCommonCore import vtkUnsignedCharArray, vtkVersion
from vtkmodules.vtkCommonDataModel import vtkPiecewiseFunction
from vtkmodules.vtkIOImage import vtkImageImport
from vtkmodules.vtkRenderingCore import (vtkColorTransferFunction, vtkRenderWindow, vtkRenderer,
                                         vtkVolume, vtkVolumeProperty)
from vtkmodules.vtkRenderingVolume import vtkMultiVolume
from vtkmodules.vtkRenderingVolumeOpenGL2 import vtkOpenGLGPUVolumeRayCastMapper


def read(path, side):
    """Floats behind an NRRD header."""
    with open(path, "rb") as file:
        data = file.read()
    data = data[data.index(b"\n\n") + 2:]
    source = vtkImageImport()
    source.SetDataScalarTypeToFloat()
    source.SetNumberOfScalarComponents(1)
    source.SetWholeExtent(0, side - 1, 0, side - 1, 0, side - 1)
    source.SetDataExtentToWholeExtent()
    source.CopyImportVoidPointer(data, len(data))
    source.Update()
    return source


def make_property(job):
    color, opacity = vtkColorTransferFunction(), vtkPiecewiseFunction()
    for value, rgb in job["color"]:
        color.AddRGBPoint(value, *rgb)
    for value, alpha in job["opacity"]:
        opacity.AddPoint(value, *alpha)
    made = vtkVolumeProperty()
    made.SetColor(color)
    made.SetScalarOpacity(opacity)
    made.SetScalarOpacityUnitDistance(1)
    made.SetInterpolationTypeToLinear()
    if job["shaded"]:
        made.ShadeOn()
        made.SetAmbient(0.2)
        made.SetDiffuse(0.7)
        made.SetSpecular(0.3)
        made.SetSpecularPower(20)
    return made


def make_mapper(step):
    mapper = vtkOpenGLGPUVolumeRayCastMapper()
    mapper.SetAutoAdjustSampleDistances(0)
    mapper.SetLockSampleDistanceToInputSpacing(0)
    mapper.SetSampleDistance(step)
    mapper.SetImageSampleDistance(1)
    mapper.SetMinimumImageSampleDistance(1)
    mapper.SetMaximumImageSampleDistance(1)
    mapper.SetUseJittering(0)
    return mapper


def make_prop(job):
    """One volume as itself, several as vtkMultiVolume: it alone mixes them."""
    mapper, source, half = make_mapper(job["step"]), read(job["data"], job["side"]), job["side"] / 2 - 0.5
    several = vtkMultiVolume() if len(job["places"]) > 1 else None
    if several:
        several.SetMapper(mapper)
    for port, (shift, angle, axis) in enumerate(job["places"]):
        volume = vtkVolume()
        volume.SetProperty(make_property(job))
        volume.SetOrigin(half, half, half)
        volume.RotateWXYZ(angle, *axis)
        volume.SetPosition(*shift)
        if not several:
            mapper.SetInputConnection(source.GetOutputPort())
            volume.SetMapper(mapper)
            return volume
        mapper.SetInputConnection(port, source.GetOutputPort())
        several.SetVolume(volume, port)
    return several


def make_window(job):
    renderer = vtkRenderer()
    renderer.SetBackground(0, 0, 0)
    renderer.AddVolume(make_prop(job))
    window = vtkRenderWindow()
    window.SetMultiSamples(0)
    window.SetAlphaBitPlanes(1)
    window.SetSize(job["size"], job["size"])
    window.SetDesiredUpdateRate(1e-4)
    window.AddRenderer(renderer)
    half = job["side"] / 2 - 0.5
    camera = renderer.GetActiveCamera()
    camera.SetFocalPoint(half, half, half)
    camera.SetPosition(*(half + p for p in job["eye"]))
    camera.SetViewUp(0, 1, 0)
    camera.ParallelProjectionOn()
    camera.SetParallelScale(job["half_height"])
    renderer.ResetCameraClippingRange()
    return window


def cpu_ms():
    usage = resource.getrusage(resource.RUSAGE_SELF)
    return 1e3 * (usage.ru_utime + usage.ru_stime)


def main():
    with open(sys.argv[1], encoding="utf-8") as file:
        job = json.load(file)
    window = make_window(job)
    pixels = vtkUnsignedCharArray()
    times = []
    for number in range(1 + job["frames"]):  # the first one compiles
        start = cpu_ms()
        window.Render()
        window.GetRGBACharPixelData(0, 0, 0, 0, 0, pixels)  # waits until the frame is there
        if number:
            times.append(cpu_ms() - start)
    if job.get("picture"):
        last = job["size"] - 1
        window.GetRGBACharPixelData(0, 0, last, last, 0, pixels)
        with open(job["picture"], "wb") as file:
            file.write(bytes(memoryview(pixels)))
    print(json.dumps({"cpu_ms": times, "vtk": vtkVersion.GetVTKVersion()}))


main()
