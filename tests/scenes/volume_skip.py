#!/usr/bin/env python3
"""What cannot be seen of a volume is passed over; what can be seen is drawn as if nothing were."""

import os

from harness import Suite
from scenes import effect, front_scene, volume, voxels

suite = Suite()

# it does nothing, but nobody knows: with it every sample is styled
WATCHER = effect("void PLUG_volume_shade(inout vec4 color, const in VolumeSample s) { color.a += 0.0; }")
SHINE = """%s void PLUG_volume_shade(inout vec4 color, const in VolumeSample s) {
    color.rgb = mix(color.rgb, s.position, 0.5);%s }"""
PEAK = [0x80402000, 0x80402000, 0xFF000060, 0x00FF0000, 0x0000FF00]
SIDE = 5


def waves(components=1):
    """Values that go up and down along every axis, 0 and 255 among them."""
    values = [(37 * x + 91 * y + 53 * z) % 256 for z in range(SIDE) for y in range(SIDE)
              for x in range(SIDE)]
    values[0], values[-1] = 0, 255
    if components == 2:
        values = [v << 8 | (255 - v * v % 251) for v in values]
    return voxels(components, (SIDE,) * 3, values)


def opacity_map(texels, rows=1):
    return ("OpacityMapVolumeStyle { transferFunction PixelTexture { image %d %d 4 %s } }"
            % (len(texels) // rows, rows, " ".join(f"0x{t:08X}" for t in texels)))


def composed(*styles):
    return "ComposedVolumeStyle { renderStyle [ %s ] }" % " ".join(styles)


def same(name, parts, *arguments, header=""):
    """The parts are functions of the effects of their volumes."""
    pictures = [suite.picture(front_scene(header, *(p(e) for p in parts)), "--step", "0.1", *arguments,
                              size="12x12").values for e in ("", WATCHER)]
    suite.check(f"{name}: not all is clear", max(pictures[0]) > 0.01, max(pictures[0]))
    worst = max(abs(a - b) for a, b in zip(*pictures))
    suite.check(f"{name}: the same picture", worst < 2e-6, worst)


def one(style, data=None, fields=""):
    return lambda effects: volume(data or waves(), style, effects=effects, fields=fields)


def placed(place, part):
    return lambda effects: "Transform { %s children %s }\n" % (place, part(effects))


@suite.case
def functions():
    "transfer functions that are clear at their ends, nowhere, and in between"
    same("a peak", [one(opacity_map(PEAK))])
    same("an opaque peak", [one(opacity_map([0, 0, 0xFF8000FF, 0, 0]))])
    same("at the low end", [one(opacity_map([0x40, 0, 0, 0]))])
    same("at the high end", [one(opacity_map([0, 0, 0, 0x4080C040]))])
    same("two peaks", [one(opacity_map([0, 0x60, 0, 0, 0xFF000080, 0]))])
    same("one texel", [one(opacity_map([0x20406030]))])
    same("no function", [one("")])
    same("the draft's ramp", [one("")], "--dialect", "2005")
    same("two dimensions", [one(opacity_map([0, 0, 0x20, 0, 0, 0xFF000080, 0, 0, 0x80], rows=3),
                                waves(2))])


@suite.case
def clear():
    "a function that is clear everywhere draws nothing"
    suite.close("", suite.middle(front_scene(volume(waves(), opacity_map([0xFF00, 0xFF0000])))), (0,) * 4)


@suite.case
def styles():
    "styles after the opacity map"
    light = "DirectionalLight { direction 1 -1 -2 }\n"
    for style in ("ShadedVolumeStyle { lighting TRUE }", "CartoonVolumeStyle { }",
                  "SilhouetteEnhancementVolumeStyle { }", "EdgeEnhancementVolumeStyle { }",
                  "BoundaryEnhancementVolumeStyle { }", "ToneMappedVolumeStyle { }"):
        same(style.split()[0], [one(composed(opacity_map(PEAK), style))], header=light)
    same("a map that comes later", [one(composed("ShadedVolumeStyle { }",
                                                 opacity_map([0x20406030, 0x80])))])
    same("two maps", [one(composed(opacity_map([0, 0]), opacity_map(PEAK)))])


@suite.case
def mixed():
    "volumes together: translucent, opaque, one of them without anything clear"
    turned = placed("rotation 1 1 0 .4 translation .2 .1 .3", one(opacity_map(PEAK)))
    same("both clear in places", [one(opacity_map(PEAK[::-1])), turned])
    same("an opaque one", [one(opacity_map([0, 0, 0xFF8000FF, 0, 0])), turned])
    same("two opaque ones", [one(opacity_map([0, 0, 0xFF8000FF, 0, 0])),
                             placed("translation .1 0 .2", one(opacity_map([0, 0x00FF00FF, 0])))])
    same("everywhere something", [one(opacity_map([0x20406030, 0x80204010])), turned])
    same("a gap between them", [one(opacity_map(PEAK)), placed("translation 0 0 -3", one(""))])
    half = lambda effects: volume(waves(), opacity_map(PEAK))
    same("one of them watched", [half, turned])


@suite.case
def promised():
    "an effect that promises to keep clear what is clear sees only what can be seen: the same picture"
    for name, promise, more in (("colour-only", "colour-only", ""), ("keeps-transparent", "keeps-transparent",
                                                                     " color.a *= 0.75;")):
        parts = [front_scene(volume(waves(), opacity_map(PEAK), effects=effect(
            SHINE % ("/* PLUG-PROMISE: %s */" % promise if kept else "", more)))) for kept in (True, False)]
        pictures = [suite.picture(part, "--step", "0.1", size="12x12").values for part in parts]
        suite.check(f"{name}: not all is clear", max(pictures[0]) > 0.01, max(pictures[0]))
        worst = max(abs(a - b) for a, b in zip(*pictures))
        suite.check(f"{name}: the same picture", worst < 2e-6, worst)


def program(*parts):
    result = suite.command("dump", "scene.x3dv", "-d", "out", files={"scene.x3dv": front_scene(*parts)})
    folder = os.path.join(result.folder, "out")
    return "".join(open(os.path.join(folder, n), encoding="utf-8").read()
                   for n in sorted(os.listdir(folder)) if n.startswith("volume") and n.endswith(".frag"))


@suite.case
def programs():
    "samples are passed over only where no author's effect could make something of them"
    ray = effect("void PLUG_volume_ray(inout float t_enter, inout float t_exit, const in vec3 origin_eye, "
                 "const in vec3 direction_eye) { t_enter += 0.25; }")
    sampling = effect("void PLUG_volume_sample(inout VolumeSample s) { s.value.r += 0.5; }")
    def promising(words, around="%s\n", more="", fields=""):
        comment = around % f"/* PLUG-PROMISE: {words} */"
        return volume(waves(), opacity_map(PEAK), effects=effect(SHINE % (comment, ""), fields=fields) + more)

    for name, text, skips in (
            ("a volume", [volume(waves(), opacity_map(PEAK))], True),
            ("an effect on the ray", [volume(waves(), opacity_map(PEAK), effects=ray)], True),
            ("an effect on styles", [volume(waves(), opacity_map(PEAK), effects=WATCHER)], False),
            ("a promise about colours", [promising("colour-only")], True),
            ("a promise about what is clear", [promising("keeps-transparent")], True),
            ("another promise", [promising("lipschitz 2")], False),
            ("a promise that is not active", [promising("colour-only", "#if 0\n%s\n#endif\n")], False),
            ("a promise of one of two effects", [promising("colour-only", more=WATCHER)], False),
            ("a promise of one of two units", [volume(waves(), opacity_map(PEAK), effects="""Effect {
                language "GLSL" parts [ EffectPart { type "FRAGMENT" url "data:text/plain,/* PLUG-PROMISE: colour-only */
                void PLUG_volume_shade(inout vec4 c, const in VolumeSample s) { c.r = 1.0; }" }
                EffectPart { type "FRAGMENT" url "data:text/plain,
                void PLUG_volume_shade(inout vec4 c, const in VolumeSample s) { c.a = 1.0; }" } ] }""")], False),
            ("a promise of what replaces the styles", [promising("colour-only", fields='placement "REPLACE"')], False),
            ("a promise of what changes samples", [volume(waves(), opacity_map(PEAK), effects=effect(
                "/* PLUG-PROMISE: colour-only */ void PLUG_volume_sample(inout VolumeSample s) { s.value.r += 0.5; }"))],
             False),
            ("an effect on samples", [volume(waves(), opacity_map(PEAK), effects=sampling)], False),
            ("an effect of a group", ["Group { children [ %s %s ] }" %
                                      (WATCHER, volume(waves(), opacity_map(PEAK)))], False),
            ("a map after a style", [volume(waves(), composed("ShadedVolumeStyle { }",
                                                              opacity_map(PEAK)))], False)):
        found = program(*text)
        suite.equal(name, "lowest_bit" in found or "leaps" in found, skips)


if __name__ == "__main__":
    suite.run()
