"""The scenes that are measured, as text.

The camera looks at the volume's centre along (-0.5, -0.35, -0.8), from so far that the volume's
bounding sphere fills 30 degrees; upright is +Y. Voxels are of side 1, centred at 0 .. N - 1 in VTK and
about the origin here; the volume ends at the outermost voxels' centres.
"""

import math

AHEAD = (0.5, 0.35, 0.8)  # towards the eye
HALF_ANGLE = 15           # degrees
AMBIENT, DIFFUSE, SPECULAR, POWER = 0.2, 0.7, 0.3, 20

# VTK's lighting: one light at the eye, which stands, with the half vector, as the point where the ray
# enters the box sees it, for orthographic views too; normals of either side.
LIGHTING = """
/* PLUG-PROMISE: colour-only keeps-transparent */
uniform vec3 voxelsPerSide;
vec3 lightDirection;
void PLUG_volume_ray(inout float t_enter, inout float t_exit, const in vec3 origin_eye, const in vec3 direction_eye) {
    vec3 place = (origin_eye - castle_ModelViewMatrix[3].xyz) * mat3(castle_ModelViewMatrix);
    vec3 ahead = direction_eye * mat3(castle_ModelViewMatrix);
    ahead = mix(ahead, vec3(1.0e-20), equal(ahead, vec3(0.0)));
    vec3 faces = (-sign(ahead) * 0.5 * (voxelsPerSide - 1.0) - place) / ahead;
    float enter = max(faces.x, max(faces.y, faces.z));
    lightDirection = normalize(-(origin_eye + enter * direction_eye));
}
void PLUG_volume_shade(inout vec4 color, const in VolumeSample s) {
    float part = abs(dot(s.normal_eye, lightDirection));
    color.rgb = color.rgb * (%g + %g * part) + %g * pow(part, %g);
}
""" % (AMBIENT, DIFFUSE, SPECULAR, POWER)


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def unit(a):
    length = math.hypot(*a)
    return [x / length for x in a]


def half_height(side):
    """Of an orthographic picture: the volume's half diagonal."""
    return math.sqrt(3) * (side - 1) / 2


def eye(side):
    """Seen from the volume's centre."""
    distance = half_height(side) / math.sin(math.radians(HALF_ANGLE))
    return [distance * c for c in unit(AHEAD)]


def turn():
    """The camera's axis and angle."""
    z = unit(AHEAD)
    x = unit(cross((0, 1, 0), z))
    y = cross(z, x)
    axis = unit((y[2] - z[1], z[0] - x[2], x[1] - y[0]))
    return axis, math.acos((x[0] + y[1] + z[2] - 1) / 2)


def viewpoint(side, perspective):
    axis, angle = turn()
    place = "position %.9g %.9g %.9g orientation %.9g %.9g %.9g %.9g" % (*eye(side), *axis, angle)
    if perspective:
        return "Viewpoint { %s fieldOfView %.9g }\n" % (place, math.radians(2 * HALF_ANGLE))
    h = half_height(side)
    return "OrthoViewpoint { %s fieldOfView %.9g %.9g %.9g %.9g }\n" % (place, -h, -h, h, h)


def style(volume):
    return ('OpacityMapVolumeStyle { transferFunction ImageTexture { url "%s-function.nrrd" } }'
            % volume.name)


def lighting(side):
    return ('Effect { language "GLSL" initializeOnly SFVec3f voxelsPerSide %d %d %d parts EffectPart '
            '{ type "FRAGMENT" url "data:text/plain,%s" } }' % (side, side, side, LIGHTING))


def volume_node(volume, styles=None, effects="", crop=True):
    """With `crop`, VTK's volume: it ends at the outermost voxels' centres."""
    side = volume.side
    low, high = 0.5 / side, 1 - 0.5 / side
    box = "cropMin %.9g %.9g %.9g cropMax %.9g %.9g %.9g" % (*(low,) * 3, *(high,) * 3) if crop else ""
    return ("VolumeData { dimensions %d %d %d %s\n"
            'renderStyle %s\nvoxels ImageTexture3D { url "%s.nrrd" } effects [ %s ] }\n'
            % (side, side, side, box, styles or style(volume), volume.name, effects))


def scene(volume, perspective=False, shaded=False, before="", node=None, after=""):
    node = node or volume_node(volume, effects=lighting(volume.side) if shaded else "")
    return ("#X3D V4.0 utf8\nPROFILE Immersive\n" + viewpoint(volume.side, perspective) + before + node
            + after)
