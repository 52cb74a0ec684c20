#!/usr/bin/env python3
"""ComposedVolumeStyle: order, members that are disabled, styles in styles."""

from harness import Suite, opacity, premultiplied
from scenes import constant, effect, front_scene, volume

suite = Suite()

VALUE = 102
DATA = constant(VALUE, (2, 2, 2))


def opacity_map(rgba, fields=""):
    return (f"OpacityMapVolumeStyle {{ {fields} transferFunction PixelTexture "
            f"{{ image 1 1 4 0x{rgba:08X} }} }}")


def composed(*styles, fields=""):
    return f"ComposedVolumeStyle {{ {fields} renderStyle [ {' '.join(styles)} ] }}"


RED, GREEN = opacity_map(0xFF000080), opacity_map(0x00FF0040)
HALF = "ShadedVolumeStyle { material Material { transparency .5 } }"
GREY = 0.4, 0.4, 0.4


def color(rgb, alpha):
    return premultiplied(rgb, opacity(alpha, 1, 0.5))


def style_color(style, effects=""):
    return suite.middle(front_scene(volume(DATA, style, effects)))


@suite.case
def order():
    "styles run in the order of the list"
    red, green = 128 / 255, 64 / 255
    suite.close("the later map replaces colour and opacity", style_color(composed(RED, GREEN)),
                color((0, 1, 0), green))
    suite.close("the other way round", style_color(composed(GREEN, RED)), color((1, 0, 0), red))
    suite.close("a map, then transparency", style_color(composed(RED, HALF))[3],
                opacity(red * 0.5, 1, 0.5))
    suite.close("transparency, then a map", style_color(composed(HALF, RED)), color((1, 0, 0), red))
    suite.close("transparency twice: no conversion of lengths between",
                style_color(composed(RED, HALF, HALF))[3], opacity(red * 0.25, 1, 0.5))


@suite.case
def disabled():
    "a disabled member is skipped; all disabled, or alone and disabled, draws nothing"
    off = opacity_map(0x00FF0040, "enabled FALSE")
    suite.close("skipped", style_color(composed(RED, off)), color((1, 0, 0), 128 / 255))
    suite.close("alone", style_color(off), (0, 0, 0, 0), 0)
    suite.close("all members", style_color(composed(off, off)), (0, 0, 0, 0), 0)
    suite.close("the whole list", style_color(composed(RED, fields="enabled FALSE")), (0, 0, 0, 0), 0)


@suite.case
def nested():
    "a list inside a list"
    suite.close("", style_color(composed(composed(RED), composed(HALF, composed(HALF))))[3],
                opacity(128 / 255 * 0.25, 1, 0.5))
    off = composed(RED, fields="enabled FALSE")
    suite.close("disabled inside", style_color(composed(GREEN, off)), color((0, 1, 0), 64 / 255))


@suite.case
def lit_after_map():
    "a map colours, light shades: emissive white stays, no light takes the map's colour"
    lit = "ShadedVolumeStyle { lighting TRUE material Material { emissiveColor .2 .4 .6 } }"
    suite.close("", style_color(composed(RED, lit)), color((0.2, 0.4, 0.6), 128 / 255))


@suite.case
def authors_between():
    "leading maps, the author's classify, the other styles, the author's shade"
    classify = effect("void PLUG_volume_classify(inout vec4 color, const in VolumeSample s)"
                      "{ color = vec4(color.gbr, color.a * 0.5); }")
    shade = effect("void PLUG_volume_shade(inout vec4 color, const in VolumeSample s)"
                   "{ color = vec4(color.bbb, color.a * 0.5); }")
    red = 128 / 255
    # RED is classified to blue; HALF halves; shading makes the blue a white
    suite.close("classify and shade", style_color(composed(RED, HALF), classify + shade)[3],
                opacity(red * 0.125, 1, 0.5))
    suite.close("colour", style_color(composed(RED, "ShadedVolumeStyle { }"), classify + shade),
                color((1, 1, 1), red * 0.25))
    suite.close("a later map replaces what classify did",
                style_color(composed(RED, "ShadedVolumeStyle { }", GREEN), classify),
                color((0, 1, 0), 64 / 255))


@suite.case
def unknown_style():
    "a style that is not known is a warning; the volume is drawn"
    result = suite.render(front_scene(volume(DATA, "SomeVolumeStyle { }")), "--probe", "8,8")
    suite.equal("warning", [m[3::2] for m in result.messages()][:1], [("warning", "unknown-node")])


suite.run()
