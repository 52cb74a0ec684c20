#!/usr/bin/env python3
"""What composing costs on surfaces, as ratios of drawing times on this machine.

usage: surface.py PLUGRAY [ROUNDS]

Each pair of scenes draws the same picture: once composed from effects, once by a program written by
hand. They are drawn in turns, each turn many times in one run; the ratio is that of the medians over all turns.
Output is TAP; a ratio above its bound fails.
"""

import json
import os
import statistics
import subprocess
import sys
import tempfile

SIZE = "320x240"
REPEAT = "15"

HEADER = """#X3D V4.0 utf8
PROFILE Immersive
NavigationInfo { headlight FALSE }
Viewpoint { position 0 0 3 }
DirectionalLight { direction 1 -1 -2 ambientIntensity .3 color 1 .9 .8 intensity .9 }
PointLight { location 1 2 3 attenuation .5 .1 .01 intensity .7 color .5 .7 1 }
"""

# fills the picture many times over: what one fragment costs is all that counts
LAYERS = "".join(
    "Transform { translation 0 0 %g children [ Shape { appearance %%s geometry Rectangle2D "
    "{ size 4 4 } } ] }\n" % (0.01 * i) for i in range(8))


def scene(appearance):
    first = LAYERS.replace("%s", "DEF A " + appearance, 1)
    return HEADER + first.replace("%s", "USE A")


MATERIAL = ("Material { diffuseColor .6 .4 .2 specularColor .5 .5 .5 shininess .2 "
            "ambientIntensity .4 emissiveColor .05 0 .05 }")

VERTEX = """
uniform mat4 castle_ModelViewMatrix;
uniform mat4 castle_ProjectionMatrix;
uniform mat3 castle_NormalMatrix;
in vec4 castle_Vertex;
in vec3 castle_Normal;
out vec3 place;
out vec3 normal;
void main() {
    vec4 eye = castle_ModelViewMatrix * castle_Vertex;
    place = eye.xyz;
    normal = normalize(castle_NormalMatrix * castle_Normal);
    gl_Position = castle_ProjectionMatrix * eye;
}
"""

# the standard's equations with nothing around them
FRAGMENT = """
uniform vec3 diffuse, specular, emissive;
uniform float shininess, ambient, ambientLight, opacity;
uniform vec3 sun, sunColor, lampColor, attenuation;
uniform vec3 lamp; /* in eye space */
uniform float sunIntensity, lampIntensity, radius;
in vec3 place;
in vec3 normal;
out vec4 color;
%(declarations)s
vec3 reflect_light(vec3 n, vec3 l, vec3 v) {
    vec3 h = normalize(l + v);
    return diffuse * max(dot(n, l), 0.0) + specular * pow(max(dot(n, h), 0.0), shininess);
}
void main() {
    vec3 n = normalize(normal);
    if (!gl_FrontFacing)
        n = -n;
    vec3 v = normalize(-place);
    vec3 sum = emissive;
    sum += sunColor * (ambientLight * ambient * diffuse +
                       sunIntensity * reflect_light(n, sun, v));
    vec3 to = lamp - place;
    float d = length(to);
    float scale = d > radius ? 0.0 : 1.0 / max(attenuation.x + (attenuation.y + attenuation.z * d) * d, 1.0);
    sum += scale * lampColor * lampIntensity * reflect_light(n, to / d, v);
    color = vec4(sum, opacity);
%(statements)s
    color.a = 1.0;
}
"""


def by_hand(declarations="", statements=""):
    code = FRAGMENT % {"declarations": declarations, "statements": statements}
    return ("Appearance { shaders ComposedShader { "
            "inputOutput SFVec3f diffuse .6 .4 .2 inputOutput SFVec3f specular .5 .5 .5 "
            "inputOutput SFVec3f emissive .05 0 .05 inputOutput SFFloat shininess 25.6 "
            "inputOutput SFFloat ambient .4 inputOutput SFFloat ambientLight .3 "
            "inputOutput SFFloat opacity 1 inputOutput SFVec3f sun -.40824829 .40824829 .81649658 "
            "inputOutput SFVec3f sunColor 1 .9 .8 inputOutput SFVec3f lampColor .5 .7 1 "
            "inputOutput SFVec3f attenuation .5 .1 .01 inputOutput SFVec3f lamp 1 2 0 "
            "inputOutput SFFloat sunIntensity .9 inputOutput SFFloat lampIntensity .7 "
            "inputOutput SFFloat radius 100 %s"
            "parts [ ShaderPart { type \"VERTEX\" url \"data:text/plain,%s\" } "
            "ShaderPart { type \"FRAGMENT\" url \"data:text/plain,%s\" } ] } }"
            % ("".join(f"inputOutput SFFloat k{i} {0.9 + 0.01 * i} " for i in range(10))
               if declarations else "", VERTEX, code))


def composed(effects=""):
    return "Appearance { material %s %s }" % (MATERIAL, effects)


# ten effects of one statement each, on the final colour
STATEMENTS = [
    "color.rgb = color.rgb * k0 + 0.01;",
    "color.r = mix(color.g, color.r, k1);",
    "color.rgb = sqrt(max(color.rgb, 0.0)) * k2;",
    "color.g += 0.02 * sin(color.b * k3);",
    "color.rgb = color.brg * k4;",
    "color.b = max(color.b, 0.1 * k5);",
    "color.rgb *= vec3(1.0, k6, 1.0);",
    "color.rgb += 0.05 * cos(color.gbr * k7);",
    "color.rgb = mix(color.rgb, vec3(0.5), 0.1 * k8);",
    "color.rgb = color.rgb / (0.5 + k9);",
]


def ten_effects():
    return "effects [ " + "".join(
        "Effect { inputOutput SFFloat k%d %g parts EffectPart { type \"FRAGMENT\" url \"data:text/plain,\n"
        "uniform float k%d;\nvoid PLUG_fragment_modify(inout vec4 color) { %s }\n\" } }\n"
        % (i, 0.9 + 0.01 * i, i, statement) for i, statement in enumerate(STATEMENTS)) + " ]"


UNIFORMS = "uniform float %s;" % ", ".join(f"k{i}" for i in range(10))

PAIRS = (
    ("a composed Phong surface against one by hand", 1.03, composed(), by_hand()),
    ("ten effects against their statements by hand", 1.05, composed(ten_effects()),
     by_hand(UNIFORMS, "    " + "\n    ".join(STATEMENTS))),
)


def run(program, folder, name, *more):
    command = [program, "render", name, "--size", SIZE, "--no-cache", *more]
    return subprocess.run(command, cwd=folder, check=True, stdout=subprocess.PIPE,
                          stderr=subprocess.PIPE, text=True).stdout


def draw_time(program, folder, name):
    output = run(program, folder, name, "--repeat", REPEAT, "--stats", "json")
    return json.loads(output)["phases"]["draw"]["cpu_ms"]


def same_picture(program, folder, names):
    colors = [run(program, folder, name, *(w for p in ("10,10", "160,120", "300,60")
                                            for w in ("--probe", p))).split() for name in names]
    return all(abs(float(a) - float(b)) < 2e-3 for a, b in zip(*colors)), colors


def measure(program, folder, pair, rounds):
    title, bound, first, second = pair
    names = ("composed.x3dv", "by-hand.x3dv")
    for name, appearance in zip(names, (first, second)):
        with open(os.path.join(folder, name), "w", encoding="ascii") as file:
            file.write(scene(appearance))
    same, colors = same_picture(program, folder, names)
    if not same:
        return False, f"{title}: the pictures differ", colors
    times = {name: [] for name in names}
    for turn in range(rounds):
        for name in names if turn % 2 else names[::-1]:
            times[name].append(draw_time(program, folder, name))
    medians = [statistics.median(times[name]) for name in names]
    ratio = medians[0] / medians[1]
    return (ratio <= bound, f"{title}: {ratio:.3f} of at most {bound}",
            "composed %.2f ms, by hand %.2f ms" % tuple(medians))


def main():
    program = os.path.abspath(sys.argv[1])
    rounds = int(sys.argv[2]) if len(sys.argv) > 2 else 10
    failed = 0
    print(f"1..{len(PAIRS)}")
    with tempfile.TemporaryDirectory() as folder:
        for number, pair in enumerate(PAIRS, 1):
            fine, text, detail = measure(program, folder, pair, rounds)
            failed += not fine
            print(f"{'ok' if fine else 'not ok'} {number} - {text}\n# {detail}")
            sys.stdout.flush()
    sys.exit(1 if failed else 0)


main()
