"""Shadow maps: where shadows begin and end, in closed form."""

import math
import os

from harness import HEADER, Picture, Suite

suite = Suite()
HALF = math.sqrt(0.5)

TOP = "OrthoViewpoint { position 0 10 0 orientation 1 0 0 -1.57079633 fieldOfView [ -4 -4 4 4 ] }\n"
FLOOR_POINTS = "-4 0 4, 4 0 4, 4 0 -4, -4 0 -4"


def quad(points, color="1 1 1", appearance="", shape="", effects=""):
    return (
        f"Shape {{ {shape} geometry IndexedFaceSet {{ solid FALSE coord Coordinate {{ point [ {points} ] }}"
        f" coordIndex [ 0 1 2 3 ] }} appearance Appearance {{ {appearance}"
        f" material Material {{ diffuseColor {color} ambientIntensity 0 }} {effects} }} }}\n"
    )


def floor(appearance="", effects=""):
    return quad(FLOOR_POINTS, "1 1 1", appearance, "", effects)


def caster(height=1, appearance="", shape="", effects=""):
    """A square of side 1 above the middle of the floor."""
    return quad(
        f"-0.5 {height} 0.5, 0.5 {height} 0.5, 0.5 {height} -0.5, -0.5 {height} -0.5",
        "1 0 0",
        appearance,
        shape,
        effects,
    )


def scene(*parts):
    return HEADER + "NavigationInfo { headlight FALSE }\n" + TOP + "\n".join(parts)


def pixel(x, z, size=128):
    """Where the picture shows the point (x, 0, z) of the floor, seen from above."""
    return (int((x + 4) / 8 * size), int((z + 4) / 8 * size))


def greens(text, places, *arguments, **options):
    """Green is what the floor alone reflects: the caster is red."""
    pixels = [pixel(x, z) for x, z in places]
    return [c[1] for c in suite.probe(text, pixels, *arguments, size="128x128", **options)]


SLANTED = "DirectionalLight { direction 1 -1 0 shadows TRUE }"
# of that light: just inside and just outside of each edge that the caster does not hide
INSIDE = [(0.56, 0), (1.44, 0), (1, 0.44), (1, -0.44)]
OUTSIDE = [(1.56, 0), (1, 0.56), (1, -0.56), (-0.6, 0)]


@suite.case
def directional():
    "the shadow of a square in parallel light is that square, moved along the light"
    got = greens(scene(SLANTED, floor(), caster()), INSIDE + OUTSIDE)
    suite.close("shadow", got[:4], [0, 0, 0, 0])
    suite.close("light", got[4:], [HALF] * 4)


@suite.case
def spot():
    "the shadow of a square in a spot light is that square, enlarged from the light"
    light = "SpotLight { location 0 3 0 direction 0 -1 0 cutOffAngle 1 beamWidth 0.9 shadows TRUE }"
    text = scene(light, floor(), caster())
    lit = [3 / math.hypot(3, 0.81)] * 4
    suite.close("shadow", greens(text, [(0.69, 0), (-0.69, 0), (0, 0.69), (0, -0.69)]), [0] * 4)
    suite.close("light", greens(text, [(0.81, 0), (-0.81, 0), (0, 0.81), (0, -0.81)]), lit, 0.02)


@suite.case
def wide_spot():
    "a spot light of any angle casts shadows"
    light = "SpotLight { location 0 3 0 direction 0 -1 0 cutOffAngle 1.57 beamWidth 1.5 shadows TRUE }"
    text = scene(light, floor(), caster())
    suite.close("shadow", greens(text, [(0.69, 0), (-0.69, 0), (0, 0.69), (0, -0.69)]), [0] * 4)
    suite.check("light", min(greens(text, [(0.81, 0), (3.9, 0), (-3.9, 3.9)])) > 0.4)


@suite.case
def point():
    "a point light casts shadows in all directions of the world"
    turns = ["0 0 1 0", "0 0 1 1.57079633", "0 0 1 3.14159265",
             "0 0 1 -1.57079633",
             "1 0 0 1.57079633", "1 0 0 -1.57079633"]
    for turn in turns:
        text = (
            HEADER + f"NavigationInfo {{ headlight FALSE }}\nTransform {{ rotation {turn} children [ " + TOP
            + "PointLight { location 0 3 0 shadows TRUE }" + floor() + caster() + " ] }"
        )
        dark = [(0.69, 0), (-0.69, 0), (0, 0.69), (0, -0.69)]
        light = [(0.81, 0), (-0.81, 0), (0, 0.81), (0, -0.81)]
        got = greens(text, dark + light)
        suite.close(f"shadow, turned by {turn}", got[:4], [0] * 4)
        suite.close(f"light, turned by {turn}", got[4:], [3 / math.hypot(3, 0.81)] * 4, 0.02)


@suite.case
def across_the_edges_of_a_cube():
    "a shadow goes on from one face of a cube map to the next"
    text = scene("PointLight { location -2 2 0 shadows TRUE }", floor(), caster(0.5))
    # the floor at x = 0 is where the faces -y and +x of the map meet; the shadow spans 0 to 4/3
    suite.close("shadow", greens(text, [(0.6, 0), (1.25, 0), (1.1, 0.5), (1.1, -0.5)]), [0] * 4)
    suite.check("light", min(greens(text, [(1.5, 0), (0.6, 0.8), (0.6, -0.8)])) > 0.2)
    seam = scene("PointLight { location -2 2 0 shadows TRUE }", floor(), quad("-1 1 1, 0 1 1, 0 1 -1, -1 1 -1", "1 0 0"))
    suite.close("over the seam", greens(seam, [(0.05, 0), (0.05, 1.5), (1, 0), (1.9, 0)]), [0] * 4)


@suite.case
def placed_by_transforms():
    "light and caster are carried by their transforms, scales included"
    light = f"Transform {{ rotation 0 1 0 1.57079633 scale 2 2 2 children {SLANTED} }}"
    square = f"Transform {{ translation 1 0.5 0 scale 2 1 1 children {caster(0.5)} }}"
    text = scene(light.replace("DirectionalLight {", "DirectionalLight { global TRUE "), floor(), square)
    # the light comes along (0, -1, -1); the caster spans x 0 to 2 at height 1
    suite.close("shadow", greens(text, [(0.06, -1), (1.94, -1), (1, -1.44), (1, -0.56)]), [0] * 4)
    suite.close("light", greens(text, [(-0.06, -1), (2.06, -1), (1, -1.56)]), [HALF] * 3)


MOVE = """effects Effect { parts EffectPart { type "VERTEX" url "data:text/plain,
void PLUG_vertex_object_space_change(inout vec4 vertex_object, inout vec3 normal_object)
{ vertex_object.z += 1.5; }" } }"""


@suite.case
def moved_vertices():
    "what moves a shape's vertices moves its shadow"
    text = scene(SLANTED, floor(), caster(effects=MOVE))
    suite.close("shadow", greens(text, [(1, 1.5), (0.56, 1.5), (1, 1.94), (1, 1.06)]), [0] * 4)
    suite.close("light", greens(text, [(1, 0), (1, 0.94), (1, 2.06)]), [HALF] * 3)


@suite.case
def in_time():
    "shadows follow lights and shapes in time, in one picture as in a row of them"
    mover = "DEF M Transform { children C }".replace("C", caster())
    turner = "DEF R Transform { children L }".replace("L", SLANTED.replace("DirectionalLight {", "DirectionalLight { global TRUE"))
    clock = """DEF T TimeSensor { cycleInterval 4 loop TRUE }
    DEF P PositionInterpolator { key [ 0 1 ] keyValue [ 0 0 0, 0 0 4 ] }
    DEF O OrientationInterpolator { key [ 0 0.25 0.5 1 ] keyValue [ 0 1 0 0, 0 1 0 0, 0 1 0 3.14159265, 0 1 0 3.14159265 ] }
    ROUTE T.fraction_changed TO P.set_fraction ROUTE P.value_changed TO M.translation
    ROUTE T.fraction_changed TO O.set_fraction ROUTE O.value_changed TO R.rotation\n"""
    text = scene(turner, floor(), mover, clock)
    places = [(1, 0), (1, 1), (-1, 2)]
    expected = [[0, HALF, HALF], [HALF, 0, HALF], [HALF, HALF, 0]]
    for t in range(3):
        suite.close(f"at {t} s", greens(text, places, "--time", str(t)), expected[t])
    where = [word for x, z in places for word in ("--probe", "%d,%d" % pixel(x, z))]
    result = suite.render(text, *where, "--frames", "3", "--fps", "1", size="128x128")
    got = [float(line.split()[1]) for line in result.output.splitlines()]
    suite.close("as frames", got, sum(expected, []))


@suite.case
def beside_the_map():
    "what is beside a light's map is lit"
    light = """DirectionalLight { direction 0 -1 0 shadows TRUE up 0 0 -1 projectionLocation 0 5 0
      projectionRectangle -0.25 -0.25 0.25 0.25 projectionNear 1 projectionFar 10 }"""
    text = scene(light, floor(), quad("-1 1 1, 1 1 1, 1 1 -1, -1 1 -1", "1 0 0", shape="DEF S"))
    # seen from below the caster, its shadow on the floor is as wide as the map
    below = text.replace(TOP, "OrthoViewpoint { position 0 0.5 0 orientation 1 0 0 -1.57079633 nearDistance 0.01 fieldOfView [ -4 -4 4 4 ] }\n")
    suite.close("in the map", greens(below, [(0, 0), (0.2, 0.2), (-0.2, 0)]), [0] * 3)
    suite.close("beside it", greens(below, [(0.5, 0), (0, -0.5), (3, 3)]), [1] * 3)


@suite.case
def two_lights():
    "each light has its own shadow"
    other = "DirectionalLight { direction -1 -1 0 color 0 1 0 intensity 0.5 shadows TRUE }"
    text = scene(SLANTED, other, floor(), caster())
    got = greens(text, [(1, 0), (-1, 0), (0, 1), (3, 0)])
    suite.close("", got, [0.5 * HALF, HALF, 1.5 * HALF, 1.5 * HALF])
    alone = scene(SLANTED, other.replace("shadows TRUE", ""), floor(), caster())
    got = greens(alone, [(1, 0), (-1, 0), (0, 1)])
    suite.close("one of them without", got, [0.5 * HALF, 1.5 * HALF, 1.5 * HALF])


@suite.case
def other_effects_of_the_light():
    "an author's effect on the light works together with its shadow"
    dim = """effects Effect { parts EffectPart { type "FRAGMENT" url "data:text/plain,
    void PLUG_light_scale(inout float scale, const in vec3 normal_eye, const in vec3 light_dir)
    { scale *= 0.25; }" } }"""
    text = scene(SLANTED.replace("}", dim + " }"), floor(), caster())
    suite.close("", greens(text, [(1, 0), (3, 0)]), [0, 0.25 * HALF])
    replaced = dim.replace("Effect {", 'Effect { placement "REPLACE" target "GeneratedShadowMap"', 1)
    text = scene(SLANTED.replace("}", replaced + " }"), floor(), caster())
    suite.close("instead of it", greens(text, [(1, 0), (3, 0)]), [0.25 * HALF] * 2)


@suite.case
def group_effect():
    "an effect on a group around shadowed shapes sees them shadowed"
    tint = """Effect { parts EffectPart { type "FRAGMENT" url "data:text/plain,
    void PLUG_fragment_modify(inout vec4 fragment_color) { fragment_color.g = 1.0 - fragment_color.g; }" } }"""
    text = scene(SLANTED, "Group { children [ " + tint + floor() + caster() + " ] }")
    suite.close("", greens(text, [(1, 0), (3, 0)]), [1, 1 - HALF])


@suite.case
def who_casts():
    "castShadow FALSE and shadowCaster FALSE cast none; translucent shapes cast none"
    suite.close("castShadow", greens(scene(SLANTED, floor(), caster(shape="castShadow FALSE")), [(1, 0)]), [HALF])
    text = scene(SLANTED, floor(), caster(appearance="shadowCaster FALSE"))
    suite.close("shadowCaster", greens(text, [(1, 0)]), [HALF])
    text = scene(SLANTED, floor(), caster().replace("diffuseColor", "transparency 0.5 diffuseColor"))
    suite.close("translucent", greens(text, [(1, 0)]), [HALF])
    text = scene("DirectionalLight { direction 1 -1 0 }", floor(), caster())
    suite.close("without shadows", greens(text, [(1, 0)]), [HALF])
    text = scene(SLANTED.replace("shadows", "shadowIntensity 0.25 shadows"), floor(), caster())
    suite.close("shadowIntensity", greens(text, [(1, 0)]), [0.75 * HALF])


@suite.case
def receive_shadows():
    "an appearance may name the lights whose shadows fall on it"
    light = "DEF L DirectionalLight { direction 1 -1 0 }"
    text = scene(light, floor("receiveShadows USE L"), caster())
    suite.close("", greens(text, [(1, 0), (3, 0)]), [0, HALF])


@suite.case
def discarded_fragments():
    "where a shape's fragments are discarded, light passes"
    hole = """effects Effect { parts [ EffectPart { type "VERTEX" url "data:text/plain, varying float along;
    void PLUG_vertex_object_space(const in vec4 vertex_object, inout vec3 normal_object) { along = vertex_object.z; }" }
    EffectPart { type "FRAGMENT" url "data:text/plain, varying float along;
    void PLUG_fragment_modify(inout vec4 fragment_color) { if (along > 0.0) discard; }" } ] }"""
    text = scene(SLANTED, floor(), caster(effects=hole))
    suite.close("", greens(text, [(1, 0.25), (1, -0.25), (1, 0.06), (1, -0.06)]), [HALF, 0, HALF, 0])


@suite.case
def no_acne():
    "a lit plane does not shadow itself, however flat the light falls on it"
    for degrees in (90, 60, 30, 10, 3):
        angle = math.radians(degrees)
        light = f"DirectionalLight {{ direction {math.cos(angle):.7f} {-math.sin(angle):.7f} 0.1 shadows TRUE shadowMapSize 64 }}"
        text = scene(light, floor(), "Transform { translation 0 -3 0 children Sphere_ }".replace("Sphere_", quad(FLOOR_POINTS)))
        result = suite.render(text, "-o", "picture.npy", size="64x64")
        picture = Picture(os.path.join(result.folder, "picture.npy"))
        expected = math.sin(angle) / math.sqrt(1.01)
        worst = max(abs(picture.at(x, y)[1] - expected) for x in range(64) for y in range(64))
        suite.check(f"{degrees} degrees", worst < 1e-3, f"wrong by {worst}")


@suite.case
def bent_normals():
    "normals that an effect bends to the light do not bend the surface: still no shadow on itself"
    bend = """effects Effect { parts EffectPart { type "FRAGMENT" url "data:text/plain,
    void PLUG_fragment_eye_space(const vec4 vertex_eye, inout vec3 normal_eye)
    { normal_eye = direction_world_to_eye_space(normalize(vec3(-1.0, 0.1, 0.0))); }" } }"""
    for kind in ("DirectionalLight { direction 1 -0.1 0", "PointLight { location -50 5.5 0"):
        light = kind + " shadows TRUE shadowMapSize 64 }"
        text = scene(light, floor(effects=bend), "Transform { translation 0 -3 0 children Q }".replace("Q", floor()))
        picture = suite.picture(text, size="64x64")
        darkest = min(picture.values[1::4])
        suite.check(kind.split()[0], darkest > 0.98, darkest)


@suite.case
def no_acne_around_a_point():
    "nor in the light of a point or a cone, at any tilt"
    for light in ("PointLight { location 1 2 0.5", "SpotLight { location -3 3 0 direction 2 -1 0 cutOffAngle 1 beamWidth 1"):
        text = scene(light + " }", floor())
        shadowed = scene(light + " shadows TRUE shadowMapSize 64 }", floor(), "Transform { translation 0 -3 0 children Q }".replace("Q", quad(FLOOR_POINTS)))
        a = suite.picture(text, size="64x64")
        b = suite.picture(shadowed, size="64x64")
        worst = max(abs(x - y) for x, y in zip(a.values, b.values))
        suite.check(light.split()[0], worst < 1e-3, f"wrong by {worst}")


MAP = 'GeneratedShadowMap { update "ALWAYS" size 512 light USE L }'


@suite.case
def fitted_to_what_matters():
    "a wide flat floor does not make the map coarse: edges are as sharp as the small caster allows"
    wide = quad("-400 0 400, 400 0 400, 400 0 -400, -400 0 -400")
    light = SLANTED.replace("shadows", "shadowMapSize 256 shadows")
    got = greens(scene(light, wide, caster()), INSIDE + OUTSIDE)
    suite.close("", got, [0] * 4 + [HALF] * 4)
    # what moves is not known to the engine, but to the author
    moved = caster(effects=MOVE, shape="bboxSize 1 0 1 bboxCenter 0 1 1.5")
    got = greens(scene(light, wide, moved), [(1, 1.5), (0.6, 1.1), (1, 0.9), (1, 2.1)])
    suite.close("moved", got, [0, 0, HALF, HALF])
    spot = "SpotLight { location 0 3 0 direction 0 -1 0 cutOffAngle 1 beamWidth 1 shadowMapSize 128 shadows TRUE }"
    got = greens(scene(spot, wide, caster()), [(0.69, 0), (0, -0.69), (0.81, 0), (0, -0.81)])
    suite.close("spot", got, [0, 0] + [3 / math.hypot(3, 0.81)] * 2, 0.02)


@suite.case
def explicit_map():
    "a GeneratedShadowMap among the textures scales the light that it names, and no other"
    lights = "DEF L DirectionalLight { direction 1 -1 0 } DirectionalLight { direction 0 -1 0 intensity 0.25 }"
    text = scene(lights, floor(f"texture {MAP}"), caster())
    suite.close("alone", greens(text, INSIDE + OUTSIDE[:3]), [0.25] * 4 + [0.25 + HALF] * 3)
    text = scene(lights, floor(f"texture MultiTexture {{ texture [ {MAP} ] }}"), caster())
    suite.close("of several", greens(text, [(1, 0), (3, 0)]), [0.25, 0.25 + HALF])
    suite.close("others without", greens(scene(lights, floor(), caster(appearance=f"texture {MAP}")), [(1, 0)]), [0.25 + HALF])
    text = scene(lights, floor("texture " + MAP.replace("ALWAYS", "NONE")), caster())
    suite.close("never drawn", greens(text, [(1, 0)]), [0.25 + HALF])


@suite.case
def default_map():
    "a light's defaultShadowMap says how its map is made"
    light = SLANTED.replace("shadows", "defaultShadowMap GeneratedShadowMap { size 16 } shadows")
    got = greens(scene(light, floor(), caster()), [(1, 0), (3, 0)])
    suite.close("drawn", got, [0, HALF])
    # the edge is as soft as the texels are large
    fine = greens(scene(SLANTED, floor(), caster()), [(1, 0.44)])[0]
    coarse = greens(scene(light, floor(), caster()), [(1, 0.44)])[0]
    suite.check("its size counts", coarse > fine + 0.05, coarse, fine)


@suite.case
def authors_comparison():
    "an author's effect reads a shadow map through sampler2DShadow"
    effect = f"""effects Effect {{ initializeOnly SFNode map {MAP}
    parts [ EffectPart {{ type "VERTEX" url "data:text/plain, varying vec4 place;
    void PLUG_vertex_object_space(const in vec4 vertex_object, inout vec3 normal_object) {{ place = vertex_object; }}" }}
    EffectPart {{ type "FRAGMENT" url "data:text/plain, uniform sampler2DShadow map; varying vec4 place;
    void PLUG_fragment_modify(inout vec4 fragment_color) {{
        // parallel light straight down, the map spans 8 units around the middle
        float lit = shadow2DProj(map, vec4(place.x / 8.0 + 0.5, 0.5 - place.z / 8.0, 0.5, 1.0)).r;
        fragment_color = vec4(0.0, lit, 0.0, 1.0); }}" }} ] }}"""
    light = """DEF L DirectionalLight { direction 0 -1 0 up 0 0 -1 projectionLocation 0 5 0 projectionNear 1 projectionFar 9
      projectionRectangle -4 -4 4 4 }"""
    # depth 0.5 is the floor's; the caster moves aside for the camera
    text = scene(light, floor(effects=effect), "Transform { translation 2 0 0 children Q }".replace("Q", caster()))
    below = text.replace(TOP, "OrthoViewpoint { position 0 0.5 0 orientation 1 0 0 -1.57079633 nearDistance 0.01 fieldOfView [ -4 -4 4 4 ] }\n")
    suite.close("", greens(below, [(2, 0), (2.4, 0.4), (0, 0), (2.6, 0)]), [0, 0, 1, 1])


@suite.case
def on_volumes():
    "lit volumes receive shadows of shapes"
    volume = """VolumeData { dimensions 2 2 2 voxels PixelTexture3D { image [ 1 2 2 2 200 200 50 50 200 200 50 50 ] }
    renderStyle ShadedVolumeStyle { lighting TRUE material Material { ambientIntensity 0 diffuseColor 1 1 1 } } }\n"""
    cover = quad("-3 3 3, 0 3 3, 0 3 -3, -3 3 -3")
    front = "OrthoViewpoint { fieldOfView [ -1 -1 1 1 ] }\n"
    light = "DirectionalLight { direction 0 -1 0 shadows TRUE }\n"
    for lights, name in ((light, "shadow"), (light.replace("shadows TRUE", ""), "light")):
        text = scene(lights, cover, volume).replace(TOP, front)
        left, right = suite.probe(text, [(4, 8), (11, 8)])
        dark = 0 if name == "shadow" else right[0]
        suite.close(f"left, {name}", left[:3], [dark] * 3, 1e-3)
        suite.check(f"right, {name}", right[0] > 0.1 and left[3] > 0.1, left, right)


@suite.case
def pays_for_what_it_uses():
    "without shadows there is no shadow code, and nothing is drawn for them"
    plain = suite.command("dump", "scene.x3dv", "-d", "out", files={"scene.x3dv": scene("DirectionalLight { }", floor(), caster())})
    names = sorted(os.listdir(os.path.join(plain.folder, "out")))
    suite.check("no program", not [n for n in names if n.startswith("shadow")], names)
    text = "".join(open(os.path.join(plain.folder, "out", n)).read() for n in names if n.endswith(".frag"))
    suite.check("no sampler", "hadow" not in text, text)
    used = suite.command("dump", "scene.x3dv", "-d", "out", files={"scene.x3dv": scene(SLANTED, floor(), caster())})
    names = sorted(os.listdir(os.path.join(used.folder, "out")))
    depth = [n for n in names if n.startswith("shadow") and n.endswith(".vert")]
    suite.equal("one program draws all depths", len(depth), 1)
    text = open(os.path.join(used.folder, "out", depth[0])).read()
    suite.check("of places alone", "castle_Normal" not in text and "castle_NormalMatrix" not in text, text)


suite.run()
