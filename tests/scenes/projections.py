#!/usr/bin/env python3
"""ProjectionVolumeStyle: T11, intensities along the ray; one layer, met where it was found."""

from harness import Suite, opacity, over, premultiplied
from scenes import FRONT, NO_HEADLIGHT, constant, effect, front_scene, quad, scene, voxels

suite = Suite()

RAMP = (0, 51, 102, 153, 204, 255)  # along z, slice 0 behind


def along_z(values, components=1):
    return voxels(components, (1, 1, len(values)), values)


def projection(data, kind="MAX", threshold=None, fields=""):
    style = f'type "{kind}"' + ("" if threshold is None else f" intensityThreshold {threshold}")
    return f"VolumeData {{ voxels {data} renderStyle ProjectionVolumeStyle {{ {style} }} {fields} }}\n"


def middle(*parts):
    return suite.middle(front_scene(*parts), "--step", "0.2")  # voxels are flat here


@suite.case
def intensities():
    "greatest, least, mean; both ends of the ray count"
    for kind, want in (("MAX", 1), ("MIN", 0), ("AVERAGE", 0.5)):
        for step in ("0.3", "1", "7"):
            got = suite.middle(front_scene(projection(along_z(RAMP), kind)), "--step", step)
            suite.close(f"{kind} of a ramp, step {step}", got, (want,) * 3 + (1,),
                        0.02 if (kind, step) == ("AVERAGE", "7") else 1e-6)
    peak = (0, 0, 51, 204, 51, 0, 0)
    suite.close("a peak", middle(projection(along_z(peak)))[0], 204 / 255, 1e-3)
    mean = suite.middle(front_scene(projection(along_z(peak), "AVERAGE")), "--step", "0.01")
    suite.close("mean of a peak", mean[0], 306 / 255 / 7, 2e-4)
    suite.close("beside the box", suite.probe(front_scene(projection(along_z(RAMP))), [(1, 1)])[0], (0, 0, 0, 0), 0)
    result = suite.render(front_scene(projection(along_z(RAMP), "MEAN")), "--probe", "8,8")
    suite.equal("another type is told", [m[5] for m in result.messages()], ["bad-value"])
    suite.close("and is MAX", [float(v) for v in result.output.split()], (1, 1, 1, 1))


@suite.case
def components():
    "the intensity is the mean of the colours; alpha is that of the voxel chosen, 1 if it has none"
    la = (0x4020, 0xC080, 0x6040)  # L, A
    suite.close("LA, greatest", middle(projection(along_z(la, 2))), premultiplied((0xC0 / 255,) * 3, 0x80 / 255), 2e-3)
    suite.close("LA, least", middle(projection(along_z(la, 2), "MIN")), premultiplied((0x40 / 255,) * 3, 0x20 / 255), 1e-5)
    rgb = (0x102030, 0x906030, 0x303030)
    suite.close("RGB", middle(projection(along_z(rgb, 3))), (0x60 / 255,) * 3 + (1,), 2e-3)
    rgba = (0x10203010, 0x90603080, 0x30303020)
    suite.close("RGBA", middle(projection(along_z(rgba, 4))), premultiplied((0x60 / 255,) * 3, 0x80 / 255), 2e-3)


@suite.case
def local_maximum():
    "intensityThreshold: the first local maximum above it"
    # seen from +z: 0.6 comes first, then 0.9
    peaks = tuple(round(255 * v) for v in (0, 0.9, 0, 0, 0.6, 0))
    for threshold, want in ((0.5, 0.6), (0.7, 0.9), (0.0, 0.9), (0.95, 0.9)):
        got = suite.middle(front_scene(projection(along_z(peaks), "MAX", threshold)), "--step", "0.1")
        suite.close(f"threshold {threshold}", got, (want,) * 3 + (1,), 2e-3)


@suite.case
def layer():
    "the layer lies where the intensity was found, the mean at the entry; surfaces before it hide it, behind end the ray"
    red = quad("UnlitMaterial { emissiveColor 1 0 0 }")
    for z, want in ((0.45, (1, 1, 1, 1)), (0.3, (1, 1, 1, 1))):
        shape = f"Transform {{ translation 0 0 {z} children [\n{red}] }}\n"
        suite.close(f"surface at {z}, greatest in front of it", middle(projection(along_z(RAMP)), shape), want, 1e-5)
    shape = f"Transform {{ translation 0 0 0.1 children [\n{red}] }}\n"
    peak = along_z((0, 255, 0, 51, 0))  # z = -0.2 and 0.2
    suite.close("the surface hides the greater peak", middle(projection(peak), shape), (0.2, 0.2, 0.2, 1), 2e-3)
    suite.close("the ray ends there: the least", middle(projection(along_z(RAMP), "MIN"), shape)[0],
                0.5 + 0.1 * 6 / 5, 1e-5)
    suite.close("the mean too", middle(projection(along_z(RAMP), "AVERAGE"), shape)[0],
                (1 * (1 / 12) + (1 + 0.62) / 2 * (0.4 - 1 / 12)) / 0.4, 3e-3)


@suite.case
def in_a_mix():
    "with another volume: what of it lies before the layer, the layer, what lies behind"
    fog = ("VolumeData { opacityUnitDistance 1 voxels " + constant(9) + " renderStyle OpacityMapVolumeStyle { transferFunction "
           "PixelTexture { image 1 1 4 0xFF000080 } } }\n")
    a = 128 / 255
    data = along_z(tuple(v << 8 | 0x80 for v in (0, 0, 0, 204, 0)), 2)  # z = 0.2
    alpha = 128 / 255
    want = over(premultiplied((1, 0, 0), opacity(a, 0.3, 1)),
                over(premultiplied((0.8,) * 3, alpha), premultiplied((1, 0, 0), opacity(a, 0.7, 1))))
    for parts in ((fog, projection(data)), (projection(data), fog)):
        suite.close("", suite.middle(front_scene(*parts), "--step", ".05"), want, 3e-3)


@suite.case
def authors():
    "an author's functions meet the layer; what samples changes what is found"
    shade = effect("void PLUG_volume_shade(inout vec4 color, const in VolumeSample s) { color.rgb *= vec3(1.0, 0.5, 0.25); }")
    suite.close("shade", middle(projection(along_z(RAMP), fields=f"effects [ {shade} ]")), (1, 0.5, 0.25, 1), 1e-6)
    turned = effect("void PLUG_volume_sample(inout VolumeSample s) { s.value = 1.0 - s.value * 0.75; }")
    suite.close("sample", middle(projection(along_z(RAMP), "MIN", fields=f"effects [ {turned} ]"))[0], 0.25, 1e-6)


@suite.case
def slabs():
    "near and far of an OrthoViewpoint cut a slab; one without thickness shows the plane"
    def slab(near, far):
        return f"OrthoViewpoint {{ position 0 0 10 fieldOfView -1 -1 1 1 nearDistance {near} farDistance {far} }}\n"
    def value(z):
        return min(max((z + 0.5) * 6 - 0.5, 0), 5) / 5
    for near, far in ((9.6, 9.9), (9.8, 10.3), (9.3, 10.7)):
        z0, z1 = 10 - near, 10 - far
        for kind, want in (("MAX", value(z0)), ("MIN", value(z1))):
            got = suite.middle(scene(slab(near, far), NO_HEADLIGHT, projection(along_z(RAMP), kind)))
            suite.close(f"{kind} from {near} to {far}", got[0], want, 1e-5)
    for at in (9.7, 10.0, 10.22):
        for kind in ("MAX", "AVERAGE"):
            got = suite.middle(scene(slab(at, at), NO_HEADLIGHT, projection(along_z(RAMP), kind)))
            suite.close(f"{kind} of the plane at {at}", got, (value(10 - at),) * 3 + (1,), 1e-5)
    planes = "clipPlanes [ ClipPlane { plane 0 0 1 0.1 } ClipPlane { plane 0 0 -1 0.2 } ]"
    got = suite.middle(scene(FRONT, NO_HEADLIGHT, projection(along_z(RAMP), fields=planes)))
    suite.close("between two planes", got[0], value(0.2), 1e-5)


@suite.case
def not_composable():
    "inside a list of styles a projection is skipped, with a warning"
    style = ("ComposedVolumeStyle { renderStyle [ OpacityMapVolumeStyle { } ProjectionVolumeStyle { } ] }")
    text = front_scene(f"VolumeData {{ voxels {constant(102)} renderStyle {style} }}\n")
    result = suite.render(text, "--probe", "8,8")
    suite.equal("told", [(m[3], m[5]) for m in result.messages()], [("warning", "bad-node")])
    suite.close("as without", [float(v) for v in result.output.split()],
                premultiplied((0.4,) * 3, opacity(0.4, 1, 1)))
    text = front_scene(f"SegmentedVolumeData {{ voxels {constant(102)} renderStyle [ ProjectionVolumeStyle {{ }} ] }}\n")
    result = suite.render(text, "--probe", "8,8")
    suite.equal("of a segment", [(m[3], m[5]) for m in result.messages()], [("warning", "bad-value")])


suite.run()
