"""Textures that are drawn before the picture: RenderedTexture and GeneratedCubeMapTexture."""

from harness import HEADER, Suite

suite = Suite()
START = HEADER + "NavigationInfo { headlight FALSE }\nOrthoViewpoint { fieldOfView [ -1 -1 1 1 ] }\n"
UP = "minificationFilter \"NEAREST_PIXEL\" magnificationFilter \"NEAREST_PIXEL\""


def quad(appearance, half=1, z=0):
    """A square across the view, mapped once."""
    h = half
    return (
        f"Shape {{ geometry IndexedFaceSet {{ solid FALSE coord Coordinate {{ point [ {-h} {-h} {z}, {h} {-h} {z}, {h} {h} {z}, {-h} {h} {z} ] }}"
        " coordIndex [ 0 1 2 3 ] texCoord TextureCoordinate { point [ 0 0, 1 0, 1 1, 0 1 ] } }"
        f" appearance Appearance {{ {appearance} }} }}\n"
    )


def plain(color, half=1, z=0, more=""):
    return quad(f"material UnlitMaterial {{ emissiveColor {color} {more} }}", half, z)


def rendered(fields, size="16 16", def_name=""):
    return f"{def_name} RenderedTexture {{ dimensions [ {size} 4 ] update \"ALWAYS\" {fields} }}"


def screen(texture, half=1, z=0):
    return quad(f"material UnlitMaterial {{ }} texture {texture}", half, z)


# a camera that looks at what stands around (20, 0, 0)
ASIDE = "viewpoint OrthoViewpoint { position 20 0 10 fieldOfView [ -1 -1 1 1 ] }"


def aside(*shapes, x=20):
    return f"Transform {{ translation {x} 0 0 children [ {' '.join(shapes)} ] }}\n"


CORNERS = [(3, 12), (12, 12), (3, 3), (12, 3)]  # lower left, lower right, upper left, upper right
QUARTER = "Transform { translation 0.5 0.5 0 children " + plain("1 0.5 0.25", 0.5) + " }"


def red_green_blue(colors):
    return [v for c in colors for v in c[:3]]


@suite.case
def another_viewpoint():
    "a RenderedTexture shows the scene upright from its own viewpoint"
    text = START + screen(rendered(ASIDE)) + aside(QUARTER)
    got = suite.probe(text, CORNERS)
    suite.close("", red_green_blue(got), [0] * 9 + [1, 0.5, 0.25])


@suite.case
def viewpoint_of_the_scene():
    "its viewpoint may stand in the scene, inside transforms"
    view = "Transform { translation 20 0 10 rotation 0 0 1 1.57079633 children DEF V OrthoViewpoint { position 0 0 0 fieldOfView [ -1 -1 1 1 ] } }\n"
    text = START + view + screen(rendered("viewpoint USE V")) + aside(QUARTER)
    got = suite.probe(text, CORNERS)
    # turned against the clock, what is up on the right is seen down on the right
    suite.close("", red_green_blue(got), [0] * 3 + [1, 0.5, 0.25] + [0] * 6)


@suite.case
def current_viewpoint():
    "without one it shows what the picture's viewpoint sees, but what reads it"
    text = START + "Transform { translation 0 0 1 children [ " + screen(rendered(""), 0.5) + "] }" + plain("0 1 0", 0.25, -1)
    got = suite.probe(text, [(8, 8), (4, 4), (12, 12), (1, 1)])
    # the screen covers half of the view: the green square is half as large on it
    suite.close("", red_green_blue(got), [0, 1, 0] + [0] * 9)


@suite.case
def scene_of_its_own():
    "its field scene is shown in place of the scene, with its own lights and background"
    inner = "scene Group { children [ DirectionalLight { direction 0 0 -1 intensity 0.5 } Background { skyColor 0 0 1 } " + quad(
        "material Material { diffuseColor 1 0 0 ambientIntensity 0 }", 0.5).replace("solid FALSE", "solid FALSE") + " ] }"
    text = START + screen(rendered(inner)) + aside(QUARTER)
    got = suite.probe(text, [(8, 8), (1, 1)])
    suite.close("", red_green_blue(got), [0.5, 0, 0, 0, 0, 1])
    lit = "DirectionalLight { global TRUE direction 0 0 -1 intensity 0.25 }"
    got = suite.probe(START + lit + screen(rendered(inner)), [(8, 8)])
    suite.close("global lights of the scene light it, too", got[0][:3], (0.75, 0, 0))


@suite.case
def own_background():
    "its field background replaces that of the scene"
    text = START + "Background { skyColor 0 1 0 }" + screen(rendered(ASIDE), 0.5)
    suite.close("of the scene", red_green_blue(suite.probe(text, [(8, 8)])), [0, 1, 0])
    text = START + "Background { skyColor 0 1 0 }" + screen(rendered(ASIDE + " background Background { skyColor 1 0 0 }"), 0.5)
    suite.close("its own", red_green_blue(suite.probe(text, [(8, 8), (1, 1)])), [1, 0, 0, 0, 1, 0])


@suite.case
def own_fog():
    "its field fog replaces that of the scene"
    fog = ' fog Fog { color 0 0 1 visibilityRange 0.001 }'
    wall = aside(plain("1 0 0"))
    reads = f"""material UnlitMaterial {{ }} effects Effect {{ initializeOnly SFNode seen {rendered(ASIDE + fog)}
    parts EffectPart {{ type "FRAGMENT" url "data:text/plain, uniform sampler2D seen;
    void PLUG_fragment_end(inout vec4 color) {{ color = texture2D(seen, vec2(0.5)); }}" }} }}"""
    text = START + "Fog { color 0 1 0 visibilityRange 0.001 }" + quad(reads) + wall
    suite.close("", suite.probe(text, [(8, 8)])[0][:3], (0, 0, 1))
    text = text.replace(fog, "")
    suite.close("without", suite.probe(text, [(8, 8)])[0][:3], (0, 1, 0))


@suite.case
def one_after_another():
    "what a texture shows may read another one, whatever the order in the file"
    third = "viewpoint OrthoViewpoint { position 40 0 10 fieldOfView [ -1 -1 1 1 ] }"
    parts = [screen(rendered(ASIDE)), aside(screen(rendered(third))), aside(QUARTER, x=40)]
    for order in (parts, parts[::-1]):
        got = suite.probe(START + "".join(order), CORNERS)
        suite.close("", red_green_blue(got), [0] * 9 + [1, 0.5, 0.25])


@suite.case
def circles():
    "textures that show each other stand still: same picture each time, no shape reads what is drawn"
    a = screen(rendered("viewpoint OrthoViewpoint { position 20 0 10 fieldOfView [ -1 -1 1 1 ] }"))
    b = aside(screen(rendered("viewpoint OrthoViewpoint { position 0 0 10 fieldOfView [ -2 -2 2 2 ] }")), QUARTER)
    text = START + a + b + plain("0 0 1", 0.9, 1)
    first = suite.probe(text, CORNERS)
    again = suite.probe(text, CORNERS, "--repeat", "3")
    suite.equal("", first, again)


@suite.case
def updates():
    "update NONE leaves it black, NEXT_FRAME_ONLY draws it once"
    none = rendered(ASIDE).replace("ALWAYS", "NONE")
    got = suite.probe(START + screen(none) + aside(QUARTER), CORNERS)
    suite.close("NONE", red_green_blue(got), [0] * 12)
    once = rendered(ASIDE).replace("ALWAYS", "NEXT_FRAME_ONLY")
    got = suite.probe(START + screen(once) + aside(QUARTER), CORNERS, "--repeat", "2")
    suite.close("NEXT_FRAME_ONLY", red_green_blue(got), [0] * 9 + [1, 0.5, 0.25])


@suite.case
def sizes():
    "it has as many texels as its dimensions say"
    half = "Transform { translation 0.5 0 0 scale 0.5 1 1 children " + plain("1 1 1") + " }"
    nearest = f"textureProperties TextureProperties {{ {UP} }}"
    text = START + screen(rendered(ASIDE + nearest, "2 1").replace("[ -1 -1 1 1 ]", "[ -1 -0.5 1 0.5 ]")) + aside(half)
    got = suite.probe(text, [(7, 8), (8, 8)])
    suite.close("two texels", red_green_blue(got), [0, 0, 0, 1, 1, 1])
    big = rendered(ASIDE, "-5 100000")
    result = suite.render(START + screen(big) + aside(QUARTER), "--probe", "8,8", status=None)
    suite.check("sizes out of range do no harm", result.status in (0, 1), result.errors)


@suite.case
def depths():
    "with depthMap it holds depths: 0 near, 1 far"
    view = "viewpoint OrthoViewpoint { position 20 0 10 fieldOfView [ -1 -1 1 1 ] nearDistance 5 farDistance 15 } depthMap TRUE"
    text = START + screen(rendered(view)) + aside(plain("1 0 0", 0.5, 2.5), plain("1 0 0", 0.25, -2.5).replace("0.25 0.25 -2.5", "0.25 0.25 -2.5"))
    got = suite.probe(text, [(8, 8), (1, 1)])
    suite.close("", red_green_blue(got), [0.25] * 3 + [1] * 3)


VOLUME = """VolumeData { dimensions 1 1 1 voxels PixelTexture3D { image [ 1 2 2 2 255 255 255 255 255 255 255 255 ] }
renderStyle OpacityMapVolumeStyle { transferFunction PixelTexture { image 1 1 4 0xff0000ff } } }"""


@suite.case
def volumes():
    "volumes are drawn in it, behind and before surfaces"
    text = START + screen(rendered(ASIDE)) + aside(VOLUME, plain("0 1 0", 0.25, 1), plain("0 0 1", 0.75, -1))
    got = suite.probe(text, [(8, 8), (5, 8), (3, 8), (0, 8)])
    suite.close("", red_green_blue(got), [0, 1, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0])


@suite.case
def effects_and_samplers():
    "effects on it see its texels; authors' effects read it through sampler2D"
    swap = """effects Effect { parts EffectPart { type "FRAGMENT" url "data:text/plain,
    void PLUG_texture_color(inout vec4 texture_color, const in sampler2D t, const in vec4 coord) { texture_color.rgb = texture_color.bgr; }" } }"""
    got = suite.probe(START + screen(rendered(ASIDE + swap)) + aside(QUARTER), CORNERS)
    suite.close("effect", red_green_blue(got[3:]), [0.25, 0.5, 1])
    reads = f"""material UnlitMaterial {{ }} effects Effect {{ initializeOnly SFNode seen {rendered(ASIDE)}
    parts EffectPart {{ type "FRAGMENT" url "data:text/plain, uniform sampler2D seen;
    void PLUG_fragment_modify(inout vec4 color) {{ color = texture2D(seen, gl_FragCoord.xy / 16.0); }}" }} }}"""
    got = suite.probe(START + quad(reads) + aside(QUARTER), CORNERS)
    suite.close("sampler", red_green_blue(got), [0] * 9 + [1, 0.5, 0.25])


@suite.case
def in_time():
    "what textures show moves in time, and what is drawn once is as it is at that time"
    mover = "DEF M Transform { children Q }".replace("Q", aside(plain("1 1 1", 0.5)))
    clock = """DEF T TimeSensor { cycleInterval 4 loop TRUE } DEF P PositionInterpolator { key [ 0 1 ] keyValue [ -0.5 -0.5 0, -0.5 3.5 0 ] }
    ROUTE T.fraction_changed TO P.set_fraction ROUTE P.value_changed TO M.translation\n"""
    for update in ("ALWAYS", "NEXT_FRAME_ONLY"):
        text = START + screen(rendered(ASIDE).replace("ALWAYS", update)) + mover + clock
        where = [word for x, y in CORNERS for word in ("--probe", f"{x},{y}")]
        lines = suite.render(text, *where, "--frames", "2", "--fps", "1").output.split("\n")
        got = [float(line.split()[0]) for line in lines if line]
        suite.close(update, got, [1, 0, 0, 0, 0, 0, 1, 0])


@suite.case
def signals():
    "viewing, projection and rendering go by ROUTEs to fields of effects"
    seen = """material UnlitMaterial { } effects DEF E Effect { inputOutput SFMatrix4f m 1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1
    parts EffectPart { type "FRAGMENT" url "data:text/plain, uniform mat4 m;
    void PLUG_fragment_modify(inout vec4 color) { color.rgb = (m * vec4(1.0, 1.0, 1.0, 1.0)).xyz / vec3(40.0, 2.0, 10.0) + vec3(1.0, 0.0, 1.0); }" } }"""
    texture = rendered(ASIDE, def_name="DEF T")
    text = START + quad(seen, 1, 1) + screen(texture) + "ROUTE T.viewing TO E.m\n"
    # (1, 1, 1) from an eye at (20, 0, 10): (-19, 1, -9)
    suite.close("viewing", suite.probe(text, [(8, 8)])[0][:3], (1 - 19 / 40, 0.5, 1 - 0.9))
    flag = """material UnlitMaterial { emissiveColor 0 0 1 } effects DEF E Effect { inputOutput SFBool on FALSE
    parts EffectPart { type "FRAGMENT" url "data:text/plain, uniform bool on;
    void PLUG_fragment_modify(inout vec4 color) { if (on) color.rgb = vec3(1.0, 0.0, 0.0); }" } }"""
    text = START + screen(texture, 0.5, 1) + quad(flag) + "ROUTE T.rendering TO E.on\n"
    text = text.replace(ASIDE, "")
    got = suite.probe(text, [(8, 8), (1, 1)])
    suite.close("rendering", red_green_blue(got), [1, 0, 0, 0, 0, 1])


@suite.case
def samples():
    "with several samples a pixel it is drawn once, from the middle"
    text = START + screen(rendered(ASIDE)) + aside(QUARTER)
    got = suite.probe(text, CORNERS, "--samples", "4")
    suite.close("", red_green_blue(got), [0] * 9 + [1, 0.5, 0.25])


@suite.case
def translucent():
    "translucent shapes and shadows are drawn in it"
    text = START + screen(rendered(ASIDE)) + aside(plain("1 1 1", 1, -1), plain("1 0 0", 0.5, 0, "transparency 0.5"))
    suite.close("", red_green_blue(suite.probe(text, [(8, 8), (1, 1)])), [1, 0.5, 0.5, 1, 1, 1])


CUBE = """Shape { geometry Box { size 0.5 0.5 0.5 } appearance Appearance { material UnlitMaterial { }
effects Effect { initializeOnly SFNode around GeneratedCubeMapTexture { update "ALWAYS" size 32 %s }
initializeOnly SFVec3f way %s parts EffectPart { type "FRAGMENT" url "data:text/plain,
uniform samplerCube around; uniform vec3 way;
void PLUG_fragment_modify(inout vec4 color) { color = textureCube(around, way); }" } } } }
"""

# six walls around the middle, each with a white mark at one corner
WALLS = {
    "1 0 0": ("1 0 0", "5 0 0", "0 1 0 -1.57079633"),
    "-1 0 0": ("0 1 0", "-5 0 0", "0 1 0 1.57079633"),
    "0 1 0": ("0 0 1", "0 5 0", "1 0 0 1.57079633"),
    "0 -1 0": ("1 1 0", "0 -5 0", "1 0 0 -1.57079633"),
    "0 0 1": ("1 0 1", "0 0 5", "0 1 0 3.14159265"),
    "0 0 -1": ("0 1 1", "0 0 -5", "0 0 1 0"),
}


def walls():
    return "".join(
        f"Transform {{ translation {place} rotation {turn} children {plain(color, 5)} }}\n" for color, place, turn in WALLS.values()
    )


def sphere(place, color):
    return f"Transform {{ translation {place} children Shape {{ geometry Box {{ size 1 1 1 }} appearance Appearance {{ material UnlitMaterial {{ emissiveColor {color} }} }} }} }}\n"


PERSPECTIVE = HEADER + "NavigationInfo { headlight FALSE }\nViewpoint { position 0 0 1 }\n"


@suite.case
def cube_directions():
    "a generated cube map gives in each direction of the world what stands there, around the shape"
    around = walls() + sphere("-3 3 -4", "0.5 0.25 0.75") + sphere("4 -3 2", "0.25 0.75 0.5") + sphere("2 4 3", "0.125 0.5 1")
    wanted = {way: wall[0] for way, wall in WALLS.items()}
    wanted.update({"-3 3 -4": "0.5 0.25 0.75", "4 -3 2": "0.25 0.75 0.5", "2 4 3": "0.125 0.5 1", "3 3 -4": "0 1 1", "4 3 2": "1 0 0", "2 -4 3": "1 1 0"})
    expected, shapes = [], ""
    for i, (way, color) in enumerate(wanted.items()):
        expected += [float(v) for v in color.split()]
        box = CUBE % (f"bias {5.5 - i} 5.75 0", way)
        shapes += f"Transform {{ translation {i - 5.5} -5.75 0 children {box} }}\n"
    # small boxes in a row below the walls; each looks from the middle of the walls
    text = HEADER + "NavigationInfo { headlight FALSE }\nOrthoViewpoint { position 0 0 1 fieldOfView [ -6 -6 6 6 ] }\n"
    got = suite.probe(text + around + shapes, [(4 * i + 2, 46) for i in range(12)], size="48x48")
    suite.close("", red_green_blue(got), expected)


@suite.case
def cube_through_transforms():
    "the map is seen from the middle of the shape, where its transforms put it"
    # moved towards +x, the marker at (5, 0, -5) is seen straight ahead
    marker = sphere("5 0 -5", "1 1 1")
    text = HEADER + "NavigationInfo { headlight FALSE }\nOrthoViewpoint { position 5 0 1 fieldOfView [ -1 -1 1 1 ] }\n"
    moved = "Transform { translation 4 0 0 rotation 0 0 1 1.57 children Transform { translation 0 -1 0 children " + CUBE % ("", "0 0 -1") + " } }"
    suite.close("", suite.middle(text + marker + moved)[:3], (1, 1, 1))
    still = CUBE % ("", "0 0 -1")
    text = text.replace("position 5 0 1", "position 0 0 1")
    suite.close("elsewhere it is not", suite.middle(text + marker + still)[:3], (0, 0, 0))


@suite.case
def cube_background():
    "a cube map shows the background, and not the shape that reads it"
    text = PERSPECTIVE + "Background { skyColor [ 1 0 0, 0 1 0 ] skyAngle 3.1416 }\n" + CUBE % ("", "0 1 0")
    got = suite.middle(text)
    suite.close("up", got[:3], (1, 0, 0), 0.03)
    suite.close("down", suite.middle(text.replace("way 0 1 0", "way 0 -1 0"))[:3], (0, 1, 0), 0.03)


@suite.case
def unread_textures_cost_nothing():
    "a texture that nothing reads is not drawn, and its scene's programs are checked all the same"
    bad = """scene Group { children Shape { geometry Box { } appearance Appearance { effects Effect { parts EffectPart { type "FRAGMENT"
    url "data:text/plain,
    void PLUG_fragment_modify(inout vec4 color) { color = nothing; }" } } } } }"""
    text = START + screen(rendered(ASIDE + bad))
    result = suite.command("check", "scene.x3dv", files={"scene.x3dv": text}, status=1)
    suite.equal("", {m[1] for m in result.messages() if m[3] == "error"}, {text[: text.index("nothing")].count("\n") + 1})


@suite.case
def many():
    "hundreds of them, each showing the next, come to an end"
    count = 300
    parts = [START, screen(rendered(ASIDE, "2 2"))]
    for i in range(1, count):
        view = f"viewpoint OrthoViewpoint {{ position {20 * i + 20} 0 10 fieldOfView [ -1 -1 1 1 ] }}"
        parts.append(aside(screen(rendered(view, "2 2")), x=20 * i))
    result = suite.render("".join(parts), "--probe", "8,8", status=1)
    suite.equal("the limit is told", {m[5] for m in result.messages()}, {"limit"})


suite.run()
