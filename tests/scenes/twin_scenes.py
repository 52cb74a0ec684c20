"""The scenes whose programs have twins written by hand (twins.py). Every scene shows all that its program
can do, to two viewpoints, one in perspective and one without: else a twin could leave something out."""

from scenes import effect, scene

VIEWS = """DEF front Viewpoint { position .3 .2 3 }
DEF flat OrthoViewpoint { position 0 0 2.5 fieldOfView -1.5 -1.5 1.5 1.5 }
NavigationInfo { headlight FALSE }
"""


class Twin:
    """`vert`, `frag`: files in twins/ without their endings; `program`: of `plugray dump`; `spare`: how parts
    begin that no picture here needs, but others."""

    views, spare = "front,flat", ()

    def __init__(self, name, title, *parts, vert=None, frag=None, program="surface-1", step=0.5):
        self.name, self.title = name, title
        self.scene = scene(VIEWS, *parts)
        self.vert, self.frag = vert or name, frag or name
        self.program, self.step = program, step


# one is zero, one looks away
NORMALS = "normal Normal { vector [ -.5 -.4 .8, .9 -.1 -.4, 0 0 0, -.4 .9 .3 ] }"


def sheet(extra="", material="", appearance=""):
    """A square that is bent by its normals; to eye space these do not keep their lengths."""
    return (f"Transform {{ scale 1 1.2 2 children Shape {{ appearance Appearance {{ material {material} {appearance} }} geometry IndexedFaceSet {{ "
            f"coordIndex [ 0 1 2 -1 0 2 3 -1 ] {extra} coord Coordinate {{ point [ -1 -1 .2, 1 -.9 -.1, .9 1 .3, -1 .8 0 ] }} }} }} }}\n")


PHONG = ("Material { diffuseColor .6 .4 .2 specularColor .5 .6 .7 shininess .1 ambientIntensity .4 "
         "emissiveColor .05 .1 .15 }")

SUN = "DirectionalLight { direction 1 -1 -2 ambientIntensity .3 color 1 .9 .8 intensity .9 }\n"
LAMP = ("Transform { scale .8 .8 .8 children PointLight { location .5 .6 .7 attenuation .5 .9 .4 ambientIntensity .2 "
        "color .6 .8 1 intensity .8 radius 1.6 } }\n")
COORDINATES = "texCoord TextureCoordinate { point [ 0 0, 1 .1, .9 1, .1 .8 ] }"
PICTURE = ("texture PixelTexture { image 3 3 3 0xFF8040 0x20C060 0xF0F010 0x8090A0 0xFFFFFF 0x103050 "
           "0x4020C0 0x00FF80 0x70E0D0 }")
FOG = "Transform { scale 1 2 1 children Fog { color .7 .8 .9 visibilityRange 3.1 } }\n"
# far away, in the middle and out of sight
BEHIND = ("Transform { translation -.9 0 -2 children %s }\nTransform { translation .9 .1 1 children %s }\n")

# The first one from far away, where rays begin before the volume; the second one out of the middle, exactly along
# faces of the box, the last one from inside.
VOLUME_VIEWS = """DEF far Viewpoint { position -.3 -.2 -30 orientation 0 1 0 3.14159 fieldOfView .06 }
DEF front Viewpoint { position .3 .5 2.3 orientation 1 -.5 0 -.2 }
DEF flat OrthoViewpoint { position 0 0 3 fieldOfView -1.5 -1.5 2.5 2.5 }
DEF inside Viewpoint { position .1 .1 .5 }
NavigationInfo { headlight FALSE }
"""


def half(values):
    """Half of the voxels are clear, some are 1."""
    return " ".join(str(v if i % 9 < 5 else 0) for i, v in enumerate(values))


DATA = "PixelTexture3D { image [ 1 3 3 3 " + half([i * i * 37 % 255 if i % 7 else 255 for i in range(27)]) + " ] }"
PAIRS = "PixelTexture3D { image [ 2 3 3 3 " + half([i * i * 2311 % 65536 for i in range(27)]) + " ] }"
MAP = ("OpacityMapVolumeStyle { transferFunction PixelTexture { image 4 1 4 0x20408000 0xC0602030 0x30FF5060 "
       "0xFFE0C0FF } }")


def body(style="", fields="", data=DATA):
    style = f"renderStyle {style}" if style else ""
    return (f"VolumeData {{ dimensions .875 .875 1.3 opacityUnitDistance .06 voxels {data} {style} {fields} }}\n")


class VolumeTwin(Twin):
    views = "far,front,flat,inside"

    def __init__(self, name, title, *parts, spare=()):
        super().__init__(name, title, vert="volume", program="volume-1", step=0.08)
        self.scene = scene(VOLUME_VIEWS, *parts)
        # to look ahead saves time; log(0) and shifts by 32 and more are not defined; pictures may stand anywhere
        # in a window, and hosts have projections out of the middle
        self.spare = ("if (value >", "if (texture(", "if (color.a < 1.0)", "- first", "- begin", "- viewport.xy",
                      "+ p[2].xy", *spare)


TWINS = [
    Twin("unlit", "a colour that no light changes",
         sheet(material="UnlitMaterial { emissiveColor .2 .4 .7 }")),
    Twin("phong", "Phong's reflection of one directional light", SUN, sheet(NORMALS, PHONG)),
    Twin("texture", "a texture", sheet(COORDINATES, "UnlitMaterial { emissiveColor .9 .6 .7 }", PICTURE)),
    Twin("textured", "a texture in the light of two lights", SUN, LAMP,
         sheet(NORMALS + COORDINATES, PHONG, PICTURE)),
    Twin("fog", "fog before what is lit", SUN, FOG, sheet(NORMALS, PHONG).replace("Shape", "DEF S Shape"),
         BEHIND % ("USE S", "USE S"), vert="phong"),
    Twin("physical", "a physical material in the light of a lamp", LAMP.replace(".5 .6 .7 att", "1.3 .1 .5 att"),
         sheet(NORMALS, "PhysicalMaterial { baseColor .8 .5 .3 metallic .4 roughness .45 emissiveColor .02 .01 .03 }"),
         # beyond what the standard allows
         "Transform { translation .7 -.3 .4 scale .3 .3 .3 children [\n",
         sheet(NORMALS, "PhysicalMaterial { baseColor .3 .5 .9 metallic 1.3 roughness 1.2 }"),
         "Transform { translation 2 0 0 children [\n",
         sheet(NORMALS, "PhysicalMaterial { baseColor .3 .9 .5 metallic 1 roughness 0 }"), "] } ] }\n", vert="phong"),
    Twin("effect", "effects of an author on a light and on the shape",
         SUN.replace("intensity .9", "intensity .9 effects [ %s ]" % effect(
             "uniform float bands;\nvoid PLUG_light_scale(inout float scale, const in vec3 normal_eye, "
             "const in vec3 light_dir)\n{ scale *= bands * abs(normal_eye.x); }", "inputOutput SFFloat bands 1.7")),
         sheet(NORMALS, PHONG, "effects [ %s ]" % effect(
             "uniform vec3 tint;\nvoid PLUG_fragment_modify(inout vec4 fragment_color)\n"
             "{ fragment_color.rgb = mix(fragment_color.rgb, tint, fragment_color.g); }",
             "inputOutput SFColor tint .2 .9 .4")), vert="phong"),
    VolumeTwin("ramp", "a volume and its transfer function", body(MAP)),
    VolumeTwin("map", "an opacity map of two components", body(
        "OpacityMapVolumeStyle { transferFunction PixelTexture { image 2 3 4 0x20408000 0xC0602000 0x30FF5000 "
        "0xFFE0C040 0x80808080 0x3090C0FF } }",
        data=PAIRS), spare=("- 1", "* plr1_transferPlace.zw", "/ vec2(")),  # of looking ahead
    VolumeTwin("boundary", "boundaries that are enhanced", body(
        "BoundaryEnhancementVolumeStyle { retainedOpacity .3 boundaryOpacity .8 opacityFactor 1.4 }"),
        # a power may be 0, or of a large number
        spare=("if (plr1_opacityFactor", "function min(pow(", "function min(length(")),
    VolumeTwin("shaded", "a volume in the light of one light", SUN, body(
        "ShadedVolumeStyle { lighting TRUE material %s }" % PHONG.replace("}", "transparency .15 }"))),
    VolumeTwin("clipped", "a volume behind a clip plane", "ClipPlane { plane .5 .3 0 .05 }\n",
               body(MAP).replace(".06", ".02"),
               spare=("sign before 3.0e38", "- eye")),  # no number of steps, too; a rounding
]
