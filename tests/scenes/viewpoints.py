#!/usr/bin/env python3
"""What depends on the viewer: viewpoints and what binds them, cameras as uniforms, levels of detail,
billboards, headlights; and the groups that merely group."""

import math

from harness import Suite
from scenes import FRONT, NO_HEADLIGHT, effect, front_scene, quad, scene

suite = Suite()

CLOCK = "DEF T TimeSensor { loop TRUE cycleInterval 4 }\n"


def colored(color, geometry=None):
    return quad(f"UnlitMaterial {{ emissiveColor {color} }}", geometry=geometry)


RED, GREEN, BLUE = ((1, 0, 0, 1), (0, 1, 0, 1), (0, 0, 1, 1))
NOTHING = (0, 0, 0, 0)


def middle(text, *arguments):
    return suite.middle(text, *arguments)


# ---- Viewpoints


@suite.case
def bound_by_events():
    "a ROUTE binds another viewpoint, and unbinding goes back"
    text = scene(NO_HEADLIGHT, "DEF A OrthoViewpoint { position 0 0 10 fieldOfView -.5 -.5 .5 .5 }\n"
                 "DEF B OrthoViewpoint { position 5 0 10 fieldOfView -.5 -.5 .5 .5 }\n"
                 "DEF T TimeSensor { startTime 1 cycleInterval 2 } ROUTE T.isActive TO B.set_bind\n",
                 colored("1 0 0"), "Transform { translation 5 0 0 children ", colored("0 1 0"), "}\n")
    for time, color in ((0, RED), (2, GREEN), (4, RED)):
        suite.close(f"time {time}", middle(text, "--time", time), color)
    suite.close("the one that is asked for", middle(text, "--viewpoint", "B"), GREEN)
    result = suite.render(text, "--probe", "0,0", "--frames", "3", "--fps", "0.5", size="1x1")
    got = [[float(w) for w in line.split()] for line in result.output.splitlines()]
    suite.close("in frames", sum(got, []), RED + GREEN + RED)


@suite.case
def moved_viewpoint():
    "a viewpoint moves by an interpolator, and with the Transform around it"
    shapes = colored("1 0 0") + "Transform { translation 3 0 0 children " + colored("0 1 0") + "}\n"
    route = ("DEF I PositionInterpolator { key [0 1] keyValue [0 0 10 6 0 10] } ROUTE "
             "T.fraction_changed TO I.set_fraction\n")
    for name, view, field in (
            ("its own place", "DEF V OrthoViewpoint { fieldOfView -.5 -.5 .5 .5 }", "position"),
            ("a Transform", "DEF V Transform { children OrthoViewpoint { position 0 0 0 fieldOfView "
             "-.5 -.5 .5 .5 } }", "translation")):
        text = scene(NO_HEADLIGHT, CLOCK, view, route, f"ROUTE I.value_changed TO V.{field}\n", shapes)
        suite.close(f"{name}, at 0", middle(text, "--time", 0), RED)
        suite.close(f"{name}, at 2", middle(text, "--time", 2), GREEN)
        suite.close(f"{name}, at 3", middle(text, "--time", 3), NOTHING)


@suite.case
def hidden_viewpoint():
    "where the viewpoint that is asked for is hidden for a time, the first one stands in"
    text = scene(NO_HEADLIGHT, "DEF A OrthoViewpoint { position 0 0 10 fieldOfView -.5 -.5 .5 .5 }\n"
                 "DEF S Switch { whichChoice 0 children DEF B OrthoViewpoint { position 5 0 10 "
                 "fieldOfView -.5 -.5 .5 .5 } }\n", CLOCK,
                 "DEF Q IntegerSequencer { key [0 .25 .5] keyValue [0 -1 0] } ROUTE "
                 "T.fraction_changed TO Q.set_fraction ROUTE Q.value_changed TO S.whichChoice\n",
                 colored("1 0 0"), "Transform { translation 5 0 0 children ", colored("0 1 0"), "}\n")
    result = suite.render(text, "--probe", "0,0", "--frames", "3", "--fps", "1", "--viewpoint", "B",
                          size="1x1")
    got = [[float(w) for w in line.split()] for line in result.output.splitlines()]
    suite.close("", sum(got, []), GREEN + RED + GREEN)


@suite.case
def scaled_around():
    "scale around a viewpoint moves it and does not stretch what it sees"
    text = scene(NO_HEADLIGHT, "Transform { scale 2 2 2 children OrthoViewpoint { position 0 0 10 "
                 "fieldOfView -1 -1 1 1 } }\n", colored("1 0 0"))
    got = suite.probe(text, [(x, 8) for x in range(16)])
    suite.equal("", [x for x in range(16) if got[x][3]], list(range(4, 12)))


@suite.case
def viewpoint_group():
    "viewpoints in a ViewpointGroup are found"
    text = scene(NO_HEADLIGHT, "ViewpointGroup { children [ OrthoViewpoint { position 9 0 10 } "
                 "DEF B OrthoViewpoint { position 0 0 10 fieldOfView -.5 -.5 .5 .5 } ] }\n",
                 colored("1 0 0"))
    suite.close("the first", middle(text), NOTHING)
    suite.close("by name", middle(text, "--viewpoint", "B"), RED)
    suite.close("by number", middle(text, "--viewpoint", "2"), RED)


@suite.case
def field_of_view():
    "fieldOfView is the smaller angle; fieldOfViewForceVertical makes it that of the height"
    # a square of side 1 at distance 1 fills a field of view of twice atan(1/2)
    angle = 2 * math.atan(0.5)
    for force, columns in (("FALSE", (0, 16)), ("TRUE", (4, 12))):
        # the picture is half as wide as high, or, forced, half of it is out of sight
        text = scene(NO_HEADLIGHT, f"Viewpoint {{ position 0 0 1 fieldOfView {angle} "
                     f"fieldOfViewForceVertical {force} }}\n", colored("1 0 0"))
        got = suite.probe(text, [(4, y) for y in range(32)], size="16x32")
        rows = [y for y in range(32) if got[y][3]]
        suite.equal(force, (rows[0], rows[-1] + 1), (8, 24) if force == "FALSE" else (0, 32))


# ---- Cameras as uniforms


@suite.case
def camera_matrices():
    "routed matrices of the camera are those that take world to eye, and back"
    code = """
uniform mat4 world_to_eye, eye_to_world;
uniform mat3 turn, turn_back;
void PLUG_fragment_modify(inout vec4 c) {
    mat4 a = world_to_eye - plugray_ViewMatrix, b = eye_to_world - plugray_InverseViewMatrix;
    mat3 d = turn - mat3(plugray_ViewMatrix), e = turn_back - transpose(turn);
    float off = 0.0;
    for (int i = 0; i < 4; i++)
        off += dot(a[i], a[i]) + dot(b[i], b[i]);
    for (int i = 0; i < 3; i++)
        off += dot(d[i], d[i]) + dot(e[i], e[i]);
    vec4 here = world_to_eye * vec4(0.0, 0.0, 0.0, 1.0);
    c = vec4(off, here.z * -0.1, length(eye_to_world[3].xyz) * 0.1, 1.0);
}"""
    fields = ("inputOnly SFMatrix4f world_to_eye inputOnly SFMatrix4f eye_to_world "
              "inputOnly SFMatrix3f turn inputOnly SFMatrix3f turn_back")
    text = scene(NO_HEADLIGHT, "DEF V Viewpoint { position 3 0 4 orientation 0 1 0 0.6435011 }\n",
                 quad("UnlitMaterial { }", effect(code, fields, "DEF E")),
                 "ROUTE V.cameraMatrix TO E.world_to_eye ROUTE V.cameraInverseMatrix TO "
                 "E.eye_to_world ROUTE V.cameraRotationMatrix TO E.turn ROUTE "
                 "V.cameraRotationInverseMatrix TO E.turn_back\n")
    suite.close("", middle(text), (0, 0.5, 0.5, 1))


@suite.case
def viewer_position():
    "ProximitySensor tells where the viewer is, in its own coordinates"
    code = "uniform vec3 eye; void PLUG_fragment_modify(inout vec4 c) { c.rgb = eye * 0.1; }"
    text = scene(NO_HEADLIGHT, "Viewpoint { position 1 0 8 orientation 0 1 0 0.12435 }\n"
                 "Transform { translation -1 -1 0 children DEF P ProximitySensor { size 99 99 99 } }\n",
                 quad("UnlitMaterial { }", effect(code, "inputOnly SFVec3f eye", "DEF E")),
                 "ROUTE P.position_changed TO E.eye\n")
    suite.close("", middle(text), (0.2, 0.1, 0.8, 1))


# ---- Levels of detail, billboards


def level_at(distance, fields="range [5 10]", scale=1, children=None):
    children = children or colored("1 0 0") + colored("0 1 0") + colored("0 0 1")
    return scene(NO_HEADLIGHT, f"Viewpoint {{ position 0 0 {distance} fieldOfView 0.01 }}\n"
                 f"Transform {{ scale {scale} {scale} {scale} children LOD {{ {fields} children [\n"
                 f"{children} ] }} }}\n")


@suite.case
def levels_of_detail():
    "the level follows from the distance to the viewer, in the LOD's own coordinates"
    for distance, color in ((3, RED), (5.5, GREEN), (9.5, GREEN), (10.5, BLUE), (1000, BLUE)):
        suite.close(f"at {distance}", middle(level_at(distance)), color)
    suite.close("scaled by 2", middle(level_at(9, scale=2)), RED)
    suite.close("a centre", middle(level_at(9, "range [5 10] center 0 0 6")), RED)
    suite.close("no range: the finest", middle(level_at(100, "")), RED)
    two = colored("1 0 0") + colored("0 1 0")
    suite.close("fewer levels than ranges", middle(level_at(20, children=two)), GREEN)


@suite.case
def level_in_time():
    "the level changes while the viewer moves"
    text = scene(NO_HEADLIGHT, CLOCK, "DEF V Viewpoint { fieldOfView 0.01 }\n"
                 "LOD { range [8] children [", colored("1 0 0"), colored("0 1 0"), "] }\n"
                 "DEF I PositionInterpolator { key [0 1] keyValue [0 0 6 0 0 10] } ROUTE "
                 "T.fraction_changed TO I.set_fraction ROUTE I.value_changed TO V.position\n")
    result = suite.render(text, "--probe", "0,0", "--frames", "4", "--fps", "1", size="1x1")
    got = [float(line.split()[0]) for line in result.output.splitlines()]
    suite.close("", got, (1, 1, 0, 0))


@suite.case
def billboards():
    "a billboard turns to the viewer: about an axis, or altogether"
    # seen from the side, a square that looks to +z is a line
    side = "OrthoViewpoint { position 10 0 0 orientation 0 1 0 1.5707963 fieldOfView -1 -1 1 1 }\n"
    above = "OrthoViewpoint { position 0 10 0 orientation 1 0 0 -1.5707963 fieldOfView -1 -1 1 1 }\n"
    rolled = "OrthoViewpoint { position 0 0 10 orientation 0 0 1 0.7853982 fieldOfView -1 -1 1 1 }\n"

    def covered(view, axis, turned="0 1 0 0"):
        text = scene(NO_HEADLIGHT, view, f"Transform {{ rotation {turned} children Billboard {{ "
                     f"axisOfRotation {axis} children ", colored("1 0 0"), "} }\n")
        picture = suite.picture(text, size="32x32")
        return sum(1 for x in range(32) for y in range(32) if picture.at(x, y)[3] > 0)

    suite.equal("about y, from the side", covered(side, "0 1 0"), 256)
    suite.equal("about y, from the side, in a turned group", covered(side, "0 1 0", "0 1 0 0.5"), 256)
    suite.equal("about x, from the side: a line", covered(side, "1 0 0"), 0)
    suite.equal("about x, from above", covered(above, "1 0 0"), 256)
    suite.equal("altogether, from above", covered(above, "0 0 0"), 256)
    suite.equal("altogether, upright for a rolled viewer", covered(rolled, "0 0 0"), 256)
    suite.equal("altogether, in a turned group", covered(rolled, "0 0 0", "1 1 0 1"), 256)


@suite.case
def upright_billboard():
    "a billboard without axis keeps its y axis upright on the screen"
    half = ("IndexedFaceSet { solid FALSE coordIndex [0 1 2 3 -1] coord Coordinate { point "
            "[-.5 0 0, .5 0 0, .5 .5 0, -.5 .5 0] } }")
    text = scene(NO_HEADLIGHT, "OrthoViewpoint { position 0 10 0 orientation 1 0 0 -1.5707963 "
                 "fieldOfView -1 -1 1 1 }\nBillboard { axisOfRotation 0 0 0 children ",
                 colored("1 0 0", half), "}\n")
    got = suite.probe(text, [(8, 6), (8, 9)])
    suite.close("above the middle", got[0], RED)
    suite.close("below", got[1], NOTHING)


# ---- Headlights and navigation


@suite.case
def headlights():
    "NavigationInfo switches the headlight; headlightNode gives another one, where the viewer is"
    surface = quad("Material { diffuseColor 1 1 1 ambientIntensity 0 }")
    view = "OrthoViewpoint { position 0 0 10 }\n"

    def lit(navigation, *rest):
        return middle(scene(view, navigation, surface, *rest))[0]

    suite.close("as it is", lit(""), 1)
    suite.close("off", lit(NO_HEADLIGHT), 0)
    suite.close("the first NavigationInfo counts", lit("NavigationInfo { } " + NO_HEADLIGHT), 1)
    suite.close("another light, half as strong", lit(
        "NavigationInfo { headlightNode DirectionalLight { intensity 0.5 } }"), 0.5)
    suite.close("aslant from the viewer", lit(
        "KambiNavigationInfo { headlightNode DirectionalLight { direction 0 -1.7320508 -1 } }"), 0.5)
    suite.close("one that is off", lit(
        "NavigationInfo { headlightNode DirectionalLight { on FALSE } }"), 0)
    # a point light at the eye, ten away: 1 / (1 + 0.1 * 10)
    suite.close("a point light", lit("NavigationInfo { headlightNode PointLight { attenuation "
                                     "1 0.1 0 radius 100 } }"), 0.5)
    suite.close("an external prototype of the name", lit(
        "EXTERNPROTO KambiNavigationInfo [ exposedField SFBool headlight exposedField SFNode "
        "headlightNode field SFBool timeOriginAtLoad ] \"urn:castle-engine.sourceforge.net:node:"
        "KambiNavigationInfo\"\nKambiNavigationInfo { timeOriginAtLoad TRUE headlightNode "
        "DirectionalLight { intensity 0.25 } }"), 0.25)


@suite.case
def visibility_limit():
    "what is farther than the visibilityLimit is not drawn, unless the viewpoint says how far"
    for view in ("Viewpoint { position 0 0 10 fieldOfView .01 }", "OrthoViewpoint { position 0 0 10 }",
                 "Viewpoint { position 0 0 10 fieldOfView .01 farDistance 20 }", ""):
        for limit in (0, 9, 11):
            text = scene(f"NavigationInfo {{ headlight FALSE visibilityLimit {limit} }}\n", view,
                         colored("1 0 0"))
            seen = limit != 9 or "farDistance" in view
            suite.close(f"{view} {limit}", middle(text), RED if seen else NOTHING)


@suite.case
def bound_navigation():
    "a NavigationInfo and a Background that are bound by events are used"
    text = scene("OrthoViewpoint { position 0 0 10 fieldOfView -1 -1 1 1 }\nNavigationInfo { }\n"
                 "DEF N NavigationInfo { headlight FALSE }\n"
                 "Background { skyColor 0 1 0 } DEF B Background { skyColor 0 0 1 }\n",
                 quad("Material { diffuseColor 1 1 1 ambientIntensity 0 }"),
                 "DEF T TimeSensor { startTime 1 cycleInterval 5 }\n"
                 "ROUTE T.isActive TO N.set_bind ROUTE T.isActive TO B.set_bind\n")
    for time, surface, sky in ((0, (1, 1, 1, 1), GREEN), (2, (0, 0, 0, 1), BLUE)):
        got = suite.probe(text, [(8, 8), (1, 1)], "--time", str(time))
        suite.close(f"light at {time}", got[0], surface)
        suite.close(f"sky at {time}", got[1], sky)


# ---- Groups


@suite.case
def groups():
    "groups of all kinds show their children; what is no child is not shown"
    red = colored("1 0 0")
    shown = {
        "Group": f"Group {{ children {red} }}",
        "StaticGroup": f"StaticGroup {{ children {red} }}",
        "Anchor": f"Anchor {{ url \"other.x3dv\" children {red} }}",
        "Collision": f"Collision {{ enabled FALSE children {red} proxy {colored('0 1 0')} }}",
        "CADLayer": f"CADLayer {{ children {red} }}",
        "CADAssembly": f"CADAssembly {{ children CADPart {{ translation 0 0 1 children "
                       f"CADFace {{ shape {red} }} }} }}",
        "Switch": f"Switch {{ whichChoice 1 children [ Group {{ }} {red} ] }}",
        "Layers": f"LayerSet {{ layers Layer {{ children {red} }} }}",
        "MatrixTransform, by rows": "Transform { translation -3 0 0 children MatrixTransform { matrix "
                                    f"1 0 0 3 0 1 0 0 0 0 1 0 0 0 0 1 children {red} }} }}",
    }
    hidden = {
        "visible FALSE": f"Group {{ visible FALSE children {red} }}",
        "a shape with render FALSE": red.replace("Shape {", "Shape { render FALSE"),
        "Switch -1": f"Switch {{ children {red} }}",
        "Switch past the end": f"Switch {{ whichChoice 1 children {red} }}",
        "what a LoadSensor watches": f"LoadSensor {{ children Inline {{ load FALSE }} }}",
    }
    for name, node in shown.items():
        suite.close(name, middle(front_scene(node)), RED)
    for name, node in hidden.items():
        suite.close(name, middle(front_scene(node)), NOTHING)


@suite.case
def deep_chain():
    "a chain of USE, deeper than any stack, ends in one error"
    text = FRONT + colored("1 0 0") + "Switch { children [ DEF G0 Group { }\n"
    text += "".join(f"DEF G{i} Group {{ children USE G{i - 1} }}\n" for i in range(1, 30000))
    result = suite.render(scene(text, "] }\nUSE G29999\n"), "--probe", "8,8", status=1)
    suite.equal("one error", [m[5] for m in result.messages()], ["limit"])
    suite.close("drawn", [float(w) for w in result.output.split()], RED)


suite.run()
