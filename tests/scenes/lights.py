#!/usr/bin/env python3
"""Lights: scopes, what effects on them can read, and the names that other browsers use."""

import math

from harness import Suite, blinn_phong, dot, rotate, unit
from scenes import Row, effect, front_scene, quad

suite = Suite()

WHITE = "Material { diffuseColor 1 1 1 ambientIntensity 0 }"


def check_all(cases, head="", **options):
    row = Row(suite)
    for _, content, _ in cases:
        row.add(content)
    for (name, _, expected), got in zip(cases, row.draw(head=head, **options)):
        suite.close(name, got, expected)


def grey(v):
    return (v, v, v, 1)


@suite.case
def scopes():
    "a light that is not global lights its group; one that is off, nothing"
    inner = "Group { children [ DirectionalLight { color 1 0 0 } %s ] }" % quad(WHITE)
    check_all((
        ("its own group", inner, (1, 0, 0, 1)),
        ("not the neighbour", "Group { children DirectionalLight { color 1 0 0 } }" + quad(WHITE),
         (0, 0, 0, 1)),
        ("also what stands before it", "Group { children [ %s DirectionalLight { } ] }" % quad(WHITE),
         grey(1)),
        ("outer and inner lights add up",
         "DirectionalLight { color 0 .5 0 }\n" + inner, (1, 0.5, 0, 1)),
        ("off", "DirectionalLight { on FALSE }" + quad(WHITE), (0, 0, 0, 1)),
        ("a point light of a group alone",
         "Group { children PointLight { global FALSE location 0 0 5 } }" + quad(WHITE), (0, 0, 0, 1)),
    ))
    row = Row(suite)
    row.add("Group { children [ DirectionalLight { global TRUE color 0 0 1 } ] }")
    row.add(quad(WHITE))
    suite.close("a global one lights all", row.draw()[1], (0, 0, 1, 1))


@suite.case
def ambient():
    "ambient light: the light's and the material's ambientIntensity, attenuated as the rest is"
    material = "Material { diffuseColor .5 .5 .5 ambientIntensity .4 }"
    point = "PointLight { global FALSE location -.125 .125 2 intensity 0 ambientIntensity .5 %s }\n"
    check_all((
        ("directional", "DirectionalLight { intensity 0 ambientIntensity .5 color 1 .5 0 }"
         + quad(material), (0.1, 0.05, 0, 1)),
        ("point, attenuated", point % "attenuation 0 1 0" + quad(material), grey(0.05)),
        ("point, out of reach", point % "radius 1.9" + quad(material), (0, 0, 0, 1)),
        ("spot, outside its cone", point.replace("PointLight", "SpotLight") %
         "direction 1 0 0 cutOffAngle .5 beamWidth .4" + quad(material), (0, 0, 0, 1)),
        ("environment", "EnvironmentLight { global FALSE ambientIntensity .5 color 1 .5 0 }"
         + quad(material), (0.1, 0.05, 0, 1)),
    ))


@suite.case
def environment():
    "EnvironmentLight: the irradiance that its texture has for the normal"
    faces = " ".join(
        f"{name} PixelTexture {{ image 1 1 3 {color} }}" for name, color in
        (("front", "0xFF0000"), ("back", "0x00FF00"), ("left", "0x0000FF"), ("right", "0xFFFF00"),
         ("top", "0x00FFFF"), ("bottom", "0xFFFFFF")))
    light = ("EnvironmentLight { global FALSE intensity .5 %s diffuseTexture "
             "ComposedCubeMapTexture { " + faces + " } }\n")
    drawn = []
    for turn in ("", "rotation 0 1 0 1.5707963", "rotation 0 1 0 3.14159265"):
        row = Row(suite)
        row.add(light % turn + quad(WHITE))
        drawn.append(row.draw()[0])
    for color in drawn:
        suite.check("half of one face", sorted(set(round(v, 3) for v in color[:3])) == [0, 0.5], color)
    suite.check("turned, other faces", len(set(drawn)) == 3, drawn)


# ---- What effects on a light can read


SPOT = ("SpotLight { global FALSE location %s direction %s color %s intensity %s beamWidth 1.5 "
        "cutOffAngle 1.5 attenuation 1 0 0 effects %s }\n")


@suite.case
def own_data():
    "an effect on a light reads that light's own fields, and its place and direction in eye space"
    show = ("vec4 seen;\n"
            "void PLUG_light_scale(inout float scale, const in vec3 normal_eye, const in vec3 light_dir)"
            "{ seen = vec4(%s, 1.0); }\n"
            "void PLUG_fragment_modify(inout vec4 c) { c = seen; }")

    def showing(expression):
        return SPOT % ("1 2 3", "0 0 -2", ".25 .5 .75", ".5", effect(show % expression)) + quad(WHITE)

    turned = ("Transform { rotation 0 0 1 1.5707963267949 children [ %s ] }")
    check_all((
        ("color and intensity", showing("color * intensity"), (0.125, 0.25, 0.375, 1)),
        ("direction", showing("-direction * 0.1"), (0, 0, 0.2, 1)),
        ("location", showing("location * 0.1"), (0.1, 0.2, 0.3, 1)),
        ("angles, radius, attenuation",
         showing("vec3(cutOffAngle * 0.1, radius * 0.001, attenuation.x * 0.5)"), (0.15, 0.1, 0.5, 1)),
        ("light_direction_eye", showing("-light_direction_eye"), (0, 0, 1, 1)),
        ("light_location_eye", showing("light_location_eye * vec3(0.05, 0.1, -0.1)"),
         ((6.5) * 0.05, 0.25, 0.7, 1)),
        ("turned", turned % SPOT.replace("\n", "") % ("0 0 3", "1 0 0", "1 1 1", "1",
                                                      effect(show % "vec3(light_direction_eye)"))
         + quad(WHITE), (0, 1, 0, 1)),
    )[:6])
    row = Row(suite)
    row.add(turned % ((SPOT % ("0 0 3", "1 0 0", "1 1 1", "1", effect(show % "light_direction_eye")))
                      + quad(WHITE)))
    suite.close("with the light's own rotation", row.draw()[0], (0, 1, 0, 1))


@suite.case
def two_lights():
    "one effect on two lights sees the data of each"
    code = ("void PLUG_light_scale(inout float scale, const in vec3 normal_eye, const in vec3 light_dir)"
            "{ scale *= color.g + 0.25 * abs(light_direction_eye.x); }")
    first = "DirectionalLight { direction 0 0 -1 color 1 .25 0 effects DEF E %s }\n" % effect(code).strip()
    second = "DirectionalLight { direction 3 0 -4 color 0 .5 1 effects USE E }\n"
    one = 0.25
    two = (0.5 + 0.25 * 0.6) * 0.8
    check_all((("", first + second + quad(WHITE), (one, one * 0.25 + two * 0.5, two, 1)),))


@suite.case
def not_its_own():
    "a name that the light does not have is an error of the author"
    code = ("void PLUG_light_scale(inout float scale, const in vec3 normal_eye, const in vec3 light_dir)"
            "{ scale *= light_location_eye.z; }")
    text = front_scene("DirectionalLight { effects " + effect(code) + " }\n", quad(WHITE))
    result = suite.render(text, "--probe", "0,0", size="1x1", status=1)
    suite.equal("told", [m[3] for m in result.messages()][:1], ["error"])
    suite.close("the light shines without the effect", [float(v) for v in result.output.split()],
                grey(1))


@suite.case
def legacy_names():
    "castle_LightSource<N>...: the lights by number, in eye space"
    show = ("uniform vec3 castle_LightSource0SpotDirection, castle_LightSource0Position;\n"
            "uniform vec3 castle_LightSource1Color, castle_LightSource0Attenuation;\n"
            "uniform vec3 castle_LightSource0AmbientColor, castle_LightSource1Position;\n"
            "uniform float castle_LightSource0Radius, castle_LightSource0BeamWidth;\n"
            "uniform float castle_LightSource0SpotCosCutoff, castle_LightSource0SpotCutoff;\n"
            "uniform vec3 castle_LightSource7Color;\n"
            "void PLUG_fragment_modify(inout vec4 c) { c.rgb = vec3(%s); }")
    spot = ("SpotLight { global FALSE location 1 2 3 direction 3 0 -4 color .5 1 0 ambientIntensity .5 "
            "radius 20 beamWidth .25 cutOffAngle .5 attenuation 1 2 3 }\n")
    other = "DirectionalLight { color .5 .25 1 intensity .5 direction 0 -3 -4 }\n"

    def showing(expression):
        return spot + other + quad(WHITE, effect(show % expression))

    check_all((
        ("SpotDirection", showing("castle_LightSource0SpotDirection * vec3(1.0, 1.0, -1.0)"),
         (0.6, 0, 0.8, 1)),
        ("Position", showing("castle_LightSource0Position * vec3(0.1, 0.1, -0.1)"),
         (0.25, 0.25, 0.7, 1)),
        ("Position of a light without a place: to it", showing("castle_LightSource1Position"),
         (0, 0.6, 0.8, 1)),
        ("Color, with the intensity", showing("castle_LightSource1Color"), (0.25, 0.125, 0.5, 1)),
        ("AmbientColor", showing("castle_LightSource0AmbientColor"), (0.25, 0.5, 0, 1)),
        ("Attenuation", showing("castle_LightSource0Attenuation * 0.1"), (0.1, 0.2, 0.3, 1)),
        ("Radius, BeamWidth, SpotCutoff", showing(
            "castle_LightSource0Radius * 0.01, castle_LightSource0BeamWidth, castle_LightSource0SpotCutoff"),
         (0.2, 0.25, 0.5, 1)),
        ("SpotCosCutoff", showing("castle_LightSource0SpotCosCutoff"), grey(math.cos(0.5))),
        ("no light of that number", showing("castle_LightSource7Color"), (0, 0, 0, 1)),
        ("a shadow is no light", (spot + other).replace("{", "{ shadows TRUE") + quad(WHITE, effect(
            "uniform vec3 castle_LightSource2Color;\n"
            "void PLUG_fragment_modify(inout vec4 c) { c.rgb = castle_LightSource2Color; }")), (0, 0, 0, 1)),
    ), head="")


@suite.case
def turned_with_the_viewer():
    "castle_LightSource0SpotDirection follows the camera"
    code = ("uniform vec3 castle_LightSource0SpotDirection;\n"
            "void PLUG_light_scale(inout float scale, const in vec3 normal_eye, const in vec3 light_dir)"
            "{ scale *= 0.0; }\n"
            "void PLUG_fragment_modify(inout vec4 c) { c.rgb = castle_LightSource0SpotDirection * 0.5 + 0.5; }")
    text = ("#X3D V4.0 utf8\nPROFILE Full\nNavigationInfo { headlight FALSE }\n"
            "Viewpoint { position 3 0 4 orientation 0 1 0 .6435011 }\n"
            "SpotLight { location 0 0 5 direction 0 0 -1 effects " + effect(code) + " }\n"
            "Shape { appearance Appearance { material Material { } } geometry Sphere { } }\n")
    seen = rotate((0, 1, 0), -0.6435011, (0, 0, -1))
    suite.close("", suite.middle(text), [0.5 * v + 0.5 for v in seen] + [1], 1e-3)


suite.run()
