#!/usr/bin/env python3
"""What is not used changes no program: the text is the same to the byte. Where things stand in a
picture - out of sight, across each other - is found out when it is drawn and is not in the text."""

import os

from harness import Picture, Suite, load_json
from scenes import constant, effect, front_scene, quad, volume, voxels

suite = Suite()

SUN = "DirectionalLight { direction 1 -1 -2 }\n"
PHONG = "Material { diffuseColor .6 .4 .2 specularColor .3 .3 .3 }"
SURFACE = quad(PHONG)
MAP = "OpacityMapVolumeStyle { }"
SHADED = "ShadedVolumeStyle { lighting TRUE }"
DATA = constant(51, (4, 4, 4))


def composed(*styles):
    return f"ComposedVolumeStyle {{ renderStyle [ {' '.join(styles)} ] }}"


VOLUME = volume(DATA, composed(MAP, SHADED))


def programs(text):
    """The texts of all programs of a scene, by name."""
    result = suite.command("dump", "scene.x3dv", "-d", "out", files={"scene.x3dv": text})
    found = {}
    for name in sorted(os.listdir(os.path.join(result.folder, "out"))):
        if not name.endswith(".map"):
            with open(os.path.join(result.folder, "out", name), encoding="utf-8") as file:
                found[name] = file.read()
    return found


def same(name, expected, *parts):
    got = programs(front_scene(*parts))
    suite.check(name, got == expected, *difference(expected, got))


def difference(expected, got):
    if sorted(expected) != sorted(got):
        return [f"programs {sorted(got)}, not {sorted(expected)}"]
    return [f"{name}: {line}" for name in got
            for line in sorted(set(got[name].splitlines()) ^ set(expected[name].splitlines()))][:20]


def other(name, expected, *parts):
    suite.check(name, programs(front_scene(*parts)) != expected)


@suite.case
def styles():
    "a style that is disabled"
    bare = programs(front_scene(SUN, VOLUME))
    edges = "EdgeEnhancementVolumeStyle { enabled FALSE }"
    same("among others", bare, SUN, volume(DATA, composed(MAP, edges, SHADED)))
    same("before and behind them", bare, SUN, volume(DATA, composed(edges, MAP, SHADED, edges)))
    same("in a style in the style", bare, SUN, volume(DATA, composed(MAP, composed(edges), SHADED)))
    same("composed of what is enabled", bare, SUN,
         volume(DATA, composed(MAP, SHADED, f"ComposedVolumeStyle {{ enabled FALSE renderStyle {SHADED} }}")))
    other("and one that is enabled does", bare, SUN,
          volume(DATA, composed(MAP, edges.replace("FALSE", "TRUE"), SHADED)))


WEAK = {
    "off": "PointLight { on FALSE }\n",
    "off, in its group": "PointLight { on FALSE global FALSE }\n",
    "without intensity": "PointLight { intensity 0 }\n",
    "black": "SpotLight { color 0 0 0 ambientIntensity 1 }\n",
    "weaker than a part of the error": "DirectionalLight { intensity .00002 ambientIntensity .00002 }\n",
    "weakened at its own place": "PointLight { attenuation 1e6 0 0 }\n",
}
STRONG = {
    "ambient light alone": "PointLight { intensity 0 ambientIntensity .5 }\n",
    "a little light": "DirectionalLight { intensity .01 }\n",
}


@suite.case
def lights_on_surfaces():
    "a light that gives next to no light, on a surface"
    bare, lit = programs(front_scene(SURFACE)), programs(front_scene(SUN, SURFACE))
    for name, light in WEAK.items():
        same(name, lit, light, SUN, SURFACE)
    same("alone", bare, WEAK["without intensity"], SURFACE)
    same("many", lit, SUN, *WEAK.values(), SURFACE)
    for name, light in STRONG.items():
        other(f"but not {name}", lit, light, SUN, SURFACE)


@suite.case
def lights_in_volumes():
    "a light that gives next to no light, in a volume"
    lit = programs(front_scene(SUN, VOLUME))
    for name, light in WEAK.items():
        same(name, lit, light, SUN, VOLUME)
    for name, light in {
            "beyond its radius": "PointLight { location 9 0 0 radius 8 }\n",
            "too far away": "PointLight { location 90 0 0 attenuation 0 0 1 radius 1e4 }\n",
            "beyond its radius, in lengths of its own":
                "Transform { scale .1 .1 .1 children PointLight { location 20 0 0 radius 11 } }\n"}.items():
        same(name, lit, light, SUN, VOLUME)
    for name, light in dict(
            STRONG, **{"what its radius reaches": "PointLight { location 9 0 0 radius 8.7 }\n"}).items():
        other(f"but not {name}", lit, light, SUN, VOLUME)


@suite.case
def sums():
    "many weak lights together are not weak"
    lit = programs(front_scene(SUN, SURFACE))
    other("", lit, SUN, *["DirectionalLight { intensity .0002 }\n"] * 20, SURFACE)


@suite.case
def errors():
    "what is too weak depends on the error that is asked for"
    dim = "DirectionalLight { intensity .002 }\n"
    def count(*options):
        stats = load_json(suite.render(front_scene(dim, SUN, SURFACE), "--stats", "json", *options).output)
        return stats["programs"][0]["instructions"]
    suite.check("", count("--error", ".1") < count() == count("--error", "1/255"))


@suite.case
def lights_that_matter_otherwise():
    "weak lights stay where their strength does not say what they do"
    dim = "DirectionalLight { intensity .0001 }\n"
    dark = "DirectionalLight { intensity 0 }\n"
    modify = effect("void PLUG_fragment_modify(inout vec4 c) { c.r *= 2.0; }")
    tones = volume(DATA, "ToneMappedVolumeStyle { }")
    physical = quad("PhysicalMaterial { }")
    for name, head, what in (("an effect of an author", dark, quad(PHONG, modify)),
                             ("an effect around", dark, f"Group {{ children [ {modify} {SURFACE} ] }}\n"),
                             ("an effect on the light", dark.replace("0 }", "0 effects [ %s ] }" % effect(
                                 "void PLUG_light_scale(inout float scale, const in vec3 n, const in vec3 l) "
                                 "{ scale *= 2.0; }")), SURFACE),
                             ("a volume's effect", dark, volume(DATA, SHADED, effect(
                                 "void PLUG_volume_shade(inout vec4 color, const in VolumeSample s) { color.r *= 2.0; }"))),
                             ("tones count lights", dark, tones),
                             ("linear light", dim, physical),
                             ("the curve of ToneMapping", dim, "ToneMapping { exposure 1000 }\n" + SURFACE)):
        plain = programs(front_scene(what))
        other(name, plain, head, what)
    plain = programs(front_scene(physical))
    same("but in linear light none is none", plain, dark, physical)


@suite.case
def surroundings():
    "planes and fogs that are disabled"
    for name, what in (("a surface", SURFACE), ("a volume", VOLUME)):
        bare = programs(front_scene(SUN, what))
        same(f"{name}: a clip plane", bare, SUN, "ClipPlane { enabled FALSE }\n", what)
        same(f"{name}: a fog of no range", bare, SUN, "Fog { color 1 0 0 }\n", what)
        same(f"{name}: a local fog", bare, SUN, "LocalFog { enabled FALSE visibilityRange 9 }\n", what)
        other(f"{name}: a clip plane that is enabled does", bare, SUN, "ClipPlane { }\n", what)
        other(f"{name}: a fog with a range does", bare, SUN, "Fog { visibilityRange 9 }\n", what)
    bare = programs(front_scene(SUN, VOLUME))
    same("a plane of the volume's own", bare, SUN,
         volume(DATA, composed(MAP, SHADED), fields="clipPlanes ClipPlane { enabled FALSE }"))


def segmented(styles, enabled):
    labels = voxels(1, (4, 4, 4), [i % 3 for i in range(64)])
    return (f"SegmentedVolumeData {{ dimensions 1 1 1 voxels {DATA} segmentIdentifiers {labels} "
            f"segmentEnabled [ {enabled} ] renderStyle [ {styles} ] }}\n")


@suite.case
def segments():
    "a segment that is switched off leaves nothing of its style"
    silhouette = "SilhouetteEnhancementVolumeStyle { }"
    edges = "EdgeEnhancementVolumeStyle { }"
    off = programs(front_scene(SUN, segmented(f"{edges} {SHADED} {silhouette}", "TRUE FALSE TRUE")))
    same("its style is another", off, SUN, segmented(f"{edges} CartoonVolumeStyle {{ }} {silhouette}", "TRUE FALSE TRUE"))
    same("its style is disabled, too", off, SUN,
         segmented(f"{edges} {SHADED[:-1]} enabled FALSE }} {silhouette}", "TRUE FALSE TRUE"))
    text = "\n".join(off.values())
    suite.check("no light is left", "add_light" not in text and "Reflection" not in text)
    maps = f"{MAP} {MAP} {MAP}"
    same("maps alone: switches are numbers", programs(front_scene(segmented(maps, "TRUE TRUE TRUE"))),
         segmented(maps, "TRUE FALSE TRUE"))


@suite.case
def nothing_there():
    "what has nothing to draw"
    bare = programs(front_scene(SUN, SURFACE, VOLUME))
    # without a picture its styles are checked as if it had data
    drawn = [load_json(suite.render(front_scene(SUN, SURFACE, VOLUME, more), "--stats", "json").output)["programs"]
             for more in ("", "VolumeData { renderStyle %s }\n" % SHADED)]
    suite.equal("a volume without data", drawn[1], drawn[0])
    same("a volume whose style is disabled", bare, SUN, SURFACE, VOLUME,
         volume(DATA, "CartoonVolumeStyle { enabled FALSE }"))
    same("a shape without geometry", bare, SUN, SURFACE, VOLUME, "Shape { }\n")
    same("a shape that is not rendered", bare, SUN, SURFACE, VOLUME, quad("PhysicalMaterial { }").replace(
        "Shape {", "Shape { render FALSE"))
    same("a branch that is not chosen", bare, SUN, SURFACE, VOLUME,
         f"Switch {{ children [ {quad('PhysicalMaterial { }')} {VOLUME} ] }}\n")
    same("an effect that is disabled", bare, SUN, VOLUME, quad(PHONG, effect(
        "void PLUG_fragment_modify(inout vec4 c) { c.r *= 2.0; }", "enabled FALSE")))


@suite.case
def places():
    "where volumes and surfaces are is not in the text"
    second = volume(DATA, MAP)
    moved = lambda x, y, z: f"Transform {{ translation {x} {y} {z} children [\n{second}] }}\n"
    across = programs(front_scene(SUN, VOLUME, moved(.2, .1, .3), SURFACE))
    same("beside each other", across, SUN, VOLUME, moved(3, 0, 0), SURFACE)
    same("one behind the other", across, SUN, VOLUME, moved(0, 0, -5), SURFACE)
    same("out of sight", across, SUN, VOLUME, moved(99, 99, 0), SURFACE)
    same("behind the viewer", across, SUN, VOLUME, moved(0, 0, 50), SURFACE)
    same("the surface elsewhere", across, SUN, VOLUME, moved(.2, .1, .3),
         f"Transform {{ translation 0 0 -9 children [\n{SURFACE}] }}\n")


@suite.case
def projective():
    "a division is only there where some matrix asks for it"
    matrix = "MatrixTransform { matrix 1 0 0 0 0 1 0 0 0 0 1 0 0 0 %s %s children [\n%s] }\n"
    bare = programs(front_scene(SUN, SURFACE))
    same("none", bare, SUN, matrix % (0, 1, SURFACE))
    got = programs(front_scene(SUN, matrix % (.1, 1.5, SURFACE)))
    suite.check("one", any("vertex_eye.w" in text for text in got.values()))
    suite.check("none elsewhere", not any("vertex_eye.w" in text for text in bare.values()))


@suite.case
def growing():
    "a light that grows comes back"
    light = "DEF L DirectionalLight { intensity 0 direction 0 0 -1 }\n"
    white = quad("Material { diffuseColor .5 .5 .5 }")
    for name, change in (("set", ["--set", "L.intensity=1"]), ("ambient", ["--set", "L.ambientIntensity=5"])):
        suite.close(name, suite.probe(front_scene(light, white), [(8, 8)], *change)[0][:3], [0.5] * 3)
    clock = ("DEF T TimeSensor { loop TRUE cycleInterval 4 }\nDEF S ScalarInterpolator { key [ 0 .5 1 ] keyValue "
             "[ 0 1 0 ] }\nROUTE T.fraction_changed TO S.set_fraction\nROUTE S.value_changed TO L.set_intensity\n")
    frames = film(front_scene(light, white, clock))
    suite.close("by events, and goes again", [frame.at(2, 2)[0] for frame in frames], [0, .25, .5, .25, 0])
    moving = ("DEF P TimeSensor { loop TRUE cycleInterval 4 }\nDEF I PositionInterpolator { key [ 0 .5 1 ] keyValue "
              "[ 40 0 0 0 0 4 40 0 0 ] }\nROUTE P.fraction_changed TO I.set_fraction\n"
              "DEF M Transform { children PointLight { radius 10 } }\nROUTE I.value_changed TO M.set_translation\n")
    ramp = volume(voxels(1, (1, 1, 2), (255, 0)), SHADED)
    frames = film(front_scene(ramp, moving))
    near = suite.picture(front_scene(ramp, "PointLight { location 0 0 4 radius 10 }\n"), size="4x4")
    suite.equal("by coming near", [frame.at(2, 2)[:3] for frame in frames],
                [(0, 0, 0)] * 2 + [near.at(2, 2)[:3]] + [(0, 0, 0)] * 2)
    suite.check("with light", max(near.at(2, 2)[:3]) > .1, near.at(2, 2))


def film(text):
    """Five pictures, a second from one to the next."""
    result = suite.render(text, "-o", "out.npy", "--frames", "5", "--fps", "1", size="4x4")
    names = sorted(n for n in os.listdir(result.folder) if n.endswith(".npy"))
    return [Picture(os.path.join(result.folder, name)) for name in names]


suite.run()
