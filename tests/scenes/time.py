#!/usr/bin/env python3
"""Scenes in time: --time and --frames, what clocks move, and what is made anew for it."""

import os
import re

from harness import Suite
from scenes import constant, effect, front_scene, quad, scene, volume

suite = Suite()

CLOCK = "DEF T TimeSensor { loop TRUE cycleInterval 4 }\n"
WHITE = "UnlitMaterial { emissiveColor 1 1 1 }"


def interpolated(kind, keys, values, target, name="I"):
    """A node that the clock drives, and where it sends its values."""
    return (f"DEF {name} {kind}Interpolator {{ key [{keys}] keyValue [{values}] }}\n"
            f"ROUTE T.fraction_changed TO {name}.set_fraction\n"
            f"ROUTE {name}.value_changed TO {target}\n")


def at_times(text, times, pixel=(8, 8), **options):
    return [suite.probe(text, [pixel], "--time", str(t), **options)[0] for t in times]


@suite.case
def moved():
    "a shape moves and changes its colour"
    text = front_scene(CLOCK, "DEF M Transform { children ",
                       quad("DEF U UnlitMaterial { emissiveColor 1 0 0 }"), "}\n",
                       interpolated("Position", "0 1", "-1 0 0 1 0 0", "M.translation"),
                       interpolated("Color", "0 1", "1 0 0 0 0 1", "U.emissiveColor", "C"))
    for time, column, color in ((0, 1, (1, 0, 0, 1)), (2, 8, (1, 0, 1, 1)), (3, 12, (0.5, 0, 1, 1))):
        row = suite.probe(text, [(x, 8) for x in range(16)], "--time", str(time))
        suite.close(f"time {time}", row[column], color)
        covered = [x for x in range(16) if row[x][3] > 0]
        middle = 8 * (-1 + 2 * time / 4) + 8
        expected = [x for x in range(16) if abs(x + 0.5 - middle) < 4]
        suite.equal(f"time {time}, where it is", covered, expected)


@suite.case
def frames():
    "frames are the pictures of their times, to the bit"
    text = front_scene(CLOCK, "DEF M Transform { children ", quad("DEF U UnlitMaterial { }"), "}\n",
                       interpolated("Position", "0 1", "-.1 0 0 .1 .3 0", "M.translation"),
                       interpolated("Color", "0 1", "1 0 0 .3 .2 1", "U.emissiveColor", "C"))
    result = suite.render(text, "-o", "a.npy", "--frames", "4", "--fps", "2", "--time", "1")
    names = sorted(name for name in os.listdir(result.folder) if name.endswith(".npy"))
    suite.equal("names", names, [f"a-{i:04}.npy" for i in range(1, 5)])
    alone = suite.render(text, "-o", "b.npy", "--time", "2.5")
    with open(os.path.join(result.folder, "a-0004.npy"), "rb") as a, \
            open(os.path.join(alone.folder, "b.npy"), "rb") as b:
        suite.check("the same bytes", a.read() == b.read())
    result = suite.render(text, "-o", "p%03d.npy", "--frames", "2")
    suite.equal("numbers where the name says", sorted(os.listdir(result.folder)),
                ["p001.npy", "p002.npy", "scene.x3dv"])


@suite.case
def everything_moves():
    "what moved from frame to frame is where it is when it is drawn alone, to the bit"
    moving = "DEF {0} Transform {{ children [ {1} ] }}\n"
    parts = (
        ("V", "Viewpoint { position 0 .2 3 }"), ("S", quad("Material { diffuseColor .8 .6 .4 }")),
        ("L", "PointLight { location 0 .3 1 global TRUE attenuation 1 .2 .1 }"),
        ("G", "DirectionalLight { direction -.2 0 -1 color 0 1 0 } "
              "ClipPlane { plane 1 .2 0 .3 } LocalFog { color 0 0 1 visibilityRange 9 } "
              + quad("Material { diffuseColor 1 1 1 }", geometry="Sphere { radius .4 }")),
        ("K", "SpotLight { location 1 2 3 direction -1 -2 -3 cutOffAngle .5 radius 99 shadows TRUE "
              "shadowMapSize 64 global TRUE color 1 0 0 }"),
        ("B", "Background { skyColor [ 0 0 1, 1 1 0 ] skyAngle 1.5 }"),
        ("D", volume(constant(40, (2, 2, 2)))))
    text = scene(CLOCK, *(moving.format(name, content) for name, content in parts),
                 *(interpolated("Position", "0 1", f"0 0 0 .{i + 1} .{8 - i} -.{i}", f"{name}.translation",
                                "P" + name) for i, (name, _) in enumerate(parts)),
                 *(interpolated("Orientation", "0 1", f"0 1 .{i} 0 0 1 .{i} .{i + 1}",
                                f"{name}.rotation", "O" + name) for i, (name, _) in enumerate(parts)))
    result = suite.render(text, "-o", "a.npy", "--frames", "3", "--fps", "1")
    pictures = []
    for frame in range(3):
        alone = suite.render(text, "-o", "b.npy", "--time", str(frame))
        with open(os.path.join(result.folder, f"a-000{frame + 1}.npy"), "rb") as a, \
                open(os.path.join(alone.folder, "b.npy"), "rb") as b:
            pictures.append(a.read())
            suite.check(f"frame {frame + 1}", pictures[-1] == b.read())
    suite.check("they differ", len(set(pictures)) == 3)


@suite.case
def frame_probes():
    "probes are printed frame after frame; 25 frames a second unless said"
    text = front_scene(quad("UnlitMaterial { }", effect(
        "void PLUG_fragment_modify(inout vec4 c) { c.rgb = vec3(plugray_Time); }")))
    result = suite.render(text, "--probe", "8,8", "--probe", "7,7", "--frames", "3")
    values = [float(line.split()[0]) for line in result.output.splitlines()]
    suite.close("", values, [0, 0, 0.04, 0.04, 0.08, 0.08])


@suite.case
def time_as_uniform():
    "time reaches effects by ROUTE and as plugray_Time"
    code = ("uniform float time, x; void PLUG_fragment_modify(inout vec4 c) "
            "{ c.rgb = vec3(time, x, plugray_Time) * 0.25; }")
    text = front_scene(CLOCK, quad("UnlitMaterial { }", effect(
        code, "inputOnly SFTime time inputOutput SFFloat x 0", "DEF E")),
        "ROUTE T.time TO E.time ROUTE T.fraction_changed TO E.set_x\n")
    got = at_times(text, (0, 3))
    suite.close("at 0", got[0], (0, 0, 0, 1))
    suite.close("at 3", got[1], (0.75, 0.1875, 0.75, 1))


@suite.case
def started_by_proximity():
    "a clock that a huge sensor starts runs from the time of loading"
    code = "uniform float t; void PLUG_fragment_modify(inout vec4 c) { c.rgb = vec3(t); }"
    text = front_scene("DEF P ProximitySensor { size 1e6 1e6 1e6 }\n"
                       "DEF T TimeSensor { loop TRUE }\n",
                       quad("UnlitMaterial { }", effect(code, "inputOnly SFTime t", "DEF E")),
                       "ROUTE P.enterTime TO T.startTime ROUTE T.elapsedTime TO E.t\n")
    suite.close("", [c[0] for c in at_times(text, (0, 0.5, 0.75))], (0, 0.5, 0.75))


@suite.case
def switched():
    "a Switch shows one child after another; each frame is right, whatever came before"
    shapes = "".join(quad(f"UnlitMaterial {{ emissiveColor {c} }}")
                     for c in ("1 0 0", "0 1 0", "0 0 1"))
    text = front_scene(CLOCK, f"DEF S Switch {{ whichChoice -1 children [ {shapes} ] }}\n",
                       "DEF Q IntegerSequencer { key [0 .25 .5 .75] keyValue [0 1 2 -1] }\n"
                       "ROUTE T.fraction_changed TO Q.set_fraction "
                       "ROUTE Q.value_changed TO S.whichChoice\n")
    result = suite.render(text, "--probe", "8,8", "--frames", "6", "--fps", "1", "--time", "0.5")
    got = [tuple(float(w) for w in line.split()) for line in result.output.splitlines()]
    expected = [(1, 0, 0, 1), (0, 1, 0, 1), (0, 0, 1, 1), (0, 0, 0, 0), (1, 0, 0, 1), (0, 1, 0, 1)]
    for i, (g, e) in enumerate(zip(got, expected)):
        suite.close(f"frame {i + 1}", g, e)


@suite.case
def toggled_light():
    "a light goes on and off by a toggle; a light in a moving Transform moves"
    text = front_scene(
        "DEF T TimeSensor { loop TRUE cycleInterval 1 }\n"
        "DEF L DirectionalLight { direction 0 0 -1 on FALSE }\n",
        "DEF B BooleanTrigger { } DEF G BooleanToggle { }\n",
        quad("Material { diffuseColor 1 1 1 ambientIntensity 0 }"),
        "ROUTE T.cycleTime TO B.set_triggerTime ROUTE B.triggerTrue TO G.set_boolean\n"
        "ROUTE G.toggle TO L.on\n")
    suite.close("on, off, on", [c[0] for c in at_times(text, (0.5, 1.5, 2.5))], (1, 0, 1))
    text = front_scene(
        CLOCK, "DEF M Transform { children DirectionalLight { direction 0 0 -1 global TRUE } }\n",
        quad("Material { diffuseColor 1 1 1 ambientIntensity 0 }"),
        interpolated("Orientation", "0 1", "0 1 0 0, 0 1 0 2.0943951", "M.rotation"))
    result = suite.render(text, "--probe", "8,8", "--frames", "2", "--fps", "0.5")
    got = [float(line.split()[0]) for line in result.output.splitlines()]
    suite.close("turned by 60 degrees", got, (1, 0.5))


@suite.case
def morphed():
    "a mesh follows its coordinates"
    text = front_scene(CLOCK, quad(WHITE, geometry=(
        "IndexedFaceSet { coordIndex [0 1 2 3 -1] coord DEF P Coordinate { point "
        "[-1 -1 0, 1 -1 0, 1 1 0, -1 1 0] } }")),
        interpolated("Coordinate", "0 1", "-1 -1 0, 1 -1 0, 1 1 0, -1 1 0, "
                     "0 -1 0, 1 -1 0, 1 1 0, 0 1 0", "P.point"))
    result = suite.render(text, *[w for x in range(16) for w in ("--probe", f"{x},8")],
                          "--frames", "3", "--fps", "0.5")
    lines = [float(line.split()[3]) for line in result.output.splitlines()]
    for frame, left in ((0, 0), (1, 4), (2, 8)):
        suite.equal(f"frame {frame + 1}", [x for x in range(16) if lines[16 * frame + x]],
                    list(range(left, 16)))


@suite.case
def faded():
    "a material becomes transparent: it is then blended over what lies behind"
    text = front_scene(CLOCK, "Transform { translation 0 0 -1 children ",
                       quad("UnlitMaterial { emissiveColor 0 1 0 }"), "}\n",
                       quad("DEF U UnlitMaterial { emissiveColor 1 0 0 }"),
                       interpolated("Scalar", "0 .25 1", "0 0 .75", "U.transparency"))
    result = suite.render(text, "--probe", "8,8", "--frames", "3", "--fps", "0.5")
    got = [tuple(float(w) for w in line.split()) for line in result.output.splitlines()]
    suite.close("opaque", got[0], (1, 0, 0, 1))
    suite.close("a quarter", got[1], (0.75, 0.25, 0, 1))
    suite.close("three quarters", got[2], (0.25, 0.75, 0, 1))


@suite.case
def volumes():
    "a volume moves, and a field of its style changes"
    style = "OpacityMapVolumeStyle { }"
    effects = effect("uniform float k; void PLUG_volume_classify(inout vec4 c, const in VolumeSample "
                     "s) { c = vec4(k, k, k, 1.0); }", "inputOutput SFFloat k 0", "DEF E")
    text = front_scene(CLOCK, "DEF M Transform { children ",
                       volume(constant(128), style, effects), "}\n",
                       "ROUTE T.fraction_changed TO E.k\n",
                       interpolated("Position", "0 1", "0 0 0 4 0 0", "M.translation"))
    result = suite.render(text, "--probe", "8,8", "--probe", "15,8", "--frames", "3", "--fps", "1")
    got = [tuple(float(w) for w in line.split()) for line in result.output.splitlines()]
    suite.close("there", got[0], (0, 0, 0, 1))
    suite.close("moved by one", got[3], (0.25, 0.25, 0.25, 1))
    suite.close("gone from where it was", got[2], (0, 0, 0, 0))
    suite.close("moved by two: out of sight", got[5], (0, 0, 0, 0))


@suite.case
def faults_once():
    "a fault is told once, however many frames are drawn"
    text = front_scene(CLOCK, "DEF M Transform { children ",
                       quad("UnlitMaterial { emissiveColor 0 1 0 }",
                            effect("void PLUG_fragment_modify(inout vec4 c) { c = nothing; }")),
                       "}\n", interpolated("Position", "0 1", "0 0 0 .1 0 0", "M.translation"))
    once = suite.render(text, "--probe", "8,8", status=1)
    suite.check("told", "nothing" in once.errors)
    result = suite.render(text, "--probe", "8,8", "--frames", "4", "--fps", "1", status=1)
    suite.equal("messages", result.messages(), once.messages())
    suite.equal("drawn", result.output, "0.00000000 1.00000000 0.00000000 1.00000000\n" * 4)


@suite.case
def programs_are_kept():
    "frames compose no new programs"
    moving = "DEF M Transform { children " + quad(WHITE) + "}\n"
    text = front_scene(CLOCK, moving,
                       interpolated("Position", "0 1", "0 0 0 .1 0 0", "M.translation"))
    one, ten = (suite.render(text, "--stats", "json", "--frames", n).output for n in ("1", "10"))
    count = lambda output: len(re.findall(r'"instructions"', output))
    suite.equal("", count(ten), count(one))


@suite.case
def in_prototypes():
    "clocks and ROUTEs inside a prototype's body, and IS on what they move"
    text = front_scene(
        "PROTO Blink [ initializeOnly SFColor from 1 0 0 inputOutput SFVec3f place 0 0 0 ] {\n"
        "Transform { translation IS place children Shape { appearance Appearance { material "
        "DEF U UnlitMaterial { emissiveColor IS from } } geometry Box { size 1 1 1 } } }\n"
        "DEF T TimeSensor { loop TRUE cycleInterval 4 } DEF C ColorInterpolator { key [0 1] "
        "keyValue [1 0 0 0 0 1] } ROUTE T.fraction_changed TO C.set_fraction\n"
        "ROUTE C.value_changed TO U.emissiveColor }\n"
        "DEF A Blink { place -.5 0 0 } Blink { place .5 0 0 from 0 1 0 }\n"
        "DEF T TimeSensor { loop TRUE cycleInterval 4 }\n",
        interpolated("Position", "0 1", "-.5 0 0 -.5 8 0", "A.place"))
    got = suite.probe(text, [(4, 8), (12, 8)], "--time", "2")
    suite.close("the first has moved away", got[0], (0, 0, 0, 0))
    suite.close("the second", got[1], (1, 0, 1, 1))


suite.run()
