"""What things cost: empty space, more of everything, what is not used, composing itself."""

import math
import os

from . import data, engines, rows, scenes

HERE = os.path.dirname(os.path.abspath(__file__))
BY_HAND = os.path.join(HERE, "..", "..", "..", "tests", "scenes", "minimal-raycaster.frag")


class Case:
    """A scene drawn again and again, whose times are compared with another's."""

    def __init__(self, bench, text, words, size):
        self.bench, self.text, self.words, self.size = bench, text, tuple(words), size
        self.times, self.programs = [], None

    def draw(self, budget=0.4, picture=None):
        repeat = min(max(round(1e3 * budget / max(self.times[0], 1)), 1), 40) if self.times else 1
        stats = self.bench.plugray.render(self.text, self.words, self.size, picture, repeat)
        self.times.append(getattr(stats["frame"], self.bench.clock))
        self.programs = sorted((p["name"], p["instructions"], p["fetches"]) for p in stats["programs"])

    @property
    def time(self):
        return engines.median(self.times[1:] or self.times)  # the first one says how often to repeat


def paired(first, second, rounds, progress, budget):
    """The median of ratios second / first, each of two measurements side by side, and its standard error."""
    ratios = []
    for number in range(rounds + 1):
        order = (first, second) if number % 2 else (second, first)
        for case in order:
            case.draw(budget=budget)
            progress.step()
        if number:  # the first one says how often to repeat
            ratios.append(second.times[-1] / first.times[-1])
    mean = sum(ratios) / len(ratios)
    spread = math.sqrt(sum((r - mean) ** 2 for r in ratios) / max(len(ratios) - 1, 1) / len(ratios))
    return engines.median(ratios), spread


# ---- Empty space ----

LEAPING = ((9, 3.5), (22, 1.7), (81, 0.97))


def leaping(bench, progress):
    """Of each method that takes fixed steps: is it faster, and are the pictures the same to the bit?"""
    part = "Space leaping: CPU time without it against with it, spheres in empty space, steps of 1/2 voxel"
    if not bench.plugray.can(("--no-leaping",)):
        return [rows.Row(part, f"{percent} % of blocks occupied", None, bar,
                         detail="this build has no `--no-leaping`") for percent, bar in LEAPING]
    found = []
    for percent, bar in LEAPING:
        volume = data.sphere_volume(64 if bench.quick else 128, percent)
        data.write(volume, bench.folder)
        for method in (m for m in bench.methods if m.knob == "--step"):
            what = f"{method.name}, {percent} % of blocks occupied"
            found += leap(bench, scenes.scene(volume), (*method.words, "--step", "0.5"), part, what, bar, progress)
    return found


def leap(bench, text, words, part, what, bar, progress):
    size = 128 if bench.quick else 512
    on, off = Case(bench, text, words, size), Case(bench, text, (*words, "--no-leaping"), size)
    files = [os.path.join(bench.folder, f"leap-{os.getpid()}-{n}.npy") for n in "01"]
    on.draw(picture=files[0])
    off.draw(picture=files[1])
    same = rows.same_bytes(*files)
    for file in files:
        os.remove(file)
    ratio, spread = paired(on, off, bench.rounds, progress, 0.4)
    return [rows.Row(part, what, ratio, bar, noise=2 * spread,
                     detail=f"without {off.time:.1f} ms, with {on.time:.1f} ms"),
            rows.Row(part, f"{what}: pictures that differ in a bit", 0 if same else 1, 0, greater=False)]


# ---- More of everything ----

def identity(count):
    """Effects that cost something, and change nothing that shows."""
    one = ('Effect { language "GLSL" parts EffectPart { type "FRAGMENT" url "data:text/plain,\n'
           "/* PLUG-PROMISE: colour-only keeps-transparent */\n"
           "void PLUG_volume_shade(inout vec4 color, const in VolumeSample s) {\n"
           '    color.rgb = mix(color.rgb, sin(color.rgb), 0.01);\n}\n" } }\n')
    return one * count


def lit(volume, count):
    lights = "".join("DirectionalLight { direction %.6g %.6g -1 intensity %.6g }\n"
                     % (math.cos(i), math.sin(i), 1 / count) for i in range(count))
    style = ("ComposedVolumeStyle { renderStyle [ %s ShadedVolumeStyle { lighting TRUE material Material "
             "{ diffuseColor .7 .7 .7 } } ] }" % scenes.style(volume))
    return scenes.scene(volume, before="NavigationInfo { headlight FALSE }\n" + lights,
                        node=scenes.volume_node(volume, style))


def crowd(volume, count):
    """Volumes about one centre, each turned otherwise."""
    nodes = "".join("Transform { rotation 1 %.6g %.6g %.6g children %s }\n"
                    % (math.cos(i), math.sin(i), math.radians(3 * i), scenes.volume_node(volume))
                    for i in range(count))
    return scenes.scene(volume, node=nodes)


def scaling(bench, progress):
    """Fitted exponents of the time against how many there are."""
    volume = data.lobb_volume(64)
    size = 128 if bench.quick else 384
    plain = scenes.scene(volume)
    half = (*bench.midpoint_words, "--step", "0.5")
    with_effects = lambda n: scenes.scene(volume, node=scenes.volume_node(volume, effects=identity(n)))
    top = 4 if bench.quick else 16
    counts = [n for n in (1, 2, 4, 8, 16) if n <= top]
    sizes = [64, 128, 256] if bench.quick else [128, 256, 512, 1024]
    bare = bench.bare
    series = (
        ("steps", [(n, plain, (*bench.midpoint_words, "--step", f"{0.5 / n:g}", *bare), size) for n in counts]),
        ("pixels", [(n * n, plain, half, n) for n in sizes]),
        ("effects", [(n, with_effects(n), half, size) for n in counts]),
        ("lights", [(n, lit(volume, n), half, size) for n in counts]),
        ("volumes", [(n, crowd(volume, n), half, size) for n in counts]),
    )
    found, curves = [], {}
    for name, cases in series:
        drawn = [(n, Case(bench, *rest)) for n, *rest in cases]
        for _ in range(max(2, bench.rounds)):
            for _, case in drawn:
                case.draw(budget=0.2)
                progress.step()
        times = [case.time for _, case in drawn]
        numbers = [n for n, _ in drawn]
        curves[name] = list(zip(numbers, times))
        detail = ", ".join(f"{n}: {t:.1f} ms" for n, t in zip(numbers, times))
        last = math.log(times[-1] / times[-2]) / math.log(numbers[-1] / numbers[-2])
        found.append(rows.Row("Fitted exponent of CPU time", name, rows.exponent(numbers, times), 1.05,
                              greater=False, detail=f"{detail}; between the last two {last:.2f}"))
    return found, curves


# ---- What is not used ----

def unused_scenes(volume):
    plain = scenes.volume_node(volume)
    disabled = ("ComposedVolumeStyle { renderStyle [ %s CartoonVolumeStyle { enabled FALSE } ] }"
                % scenes.style(volume))
    bare = scenes.scene(volume)
    style = "ComposedVolumeStyle { renderStyle [ %s ] }" % scenes.style(volume)
    return (
        ("a disabled style", scenes.scene(volume, node=scenes.volume_node(volume, style)),
         scenes.scene(volume, node=scenes.volume_node(volume, disabled))),
        ("a light that nothing asks for", bare, scenes.scene(volume, before="DirectionalLight { }\n")),
        ("a light that is off", lit(volume, 1),
         lit(volume, 1).replace("DirectionalLight", "PointLight { on FALSE }\nDirectionalLight", 1)),
        ("a volume that a Switch hides", bare,
         scenes.scene(volume, after=f"Switch {{ whichChoice -1 children {plain} }}\n")),
        ("a disabled clip plane", bare,
         scenes.scene(volume, before="ClipPlane { enabled FALSE plane 1 0 0 0 }\n")),
    )


def unused(bench, progress):
    volume = data.lobb_volume(64)
    part = "CPU time with something unused or disabled against without it"
    words = (*bench.midpoint_words, "--step", "0.25")
    found = []
    for what, without, with_it in unused_scenes(volume):
        size = 128 if bench.quick else 384
        first, second = (Case(bench, text, words, size) for text in (without, with_it))
        ratio, spread = paired(first, second, 2 if bench.quick else 8, progress, 0.5)
        same = "same programs" if first.programs == second.programs else "**other programs**"
        found.append(rows.Row(part, what, ratio, 1.01, greater=False, noise=2 * spread,
                              detail=f"two standard errors {2 * spread:.4f}; {same}"))
    return found


# ---- Composed against written by hand ----

def by_hand_scene(volume, size, step):
    """The raycaster of the tests, fed as the engine feeds the composed one."""
    axis, angle = scenes.turn()
    eye = scenes.eye(volume.side)
    x, y, z = (rotated(axis, angle, v) for v in ((1, 0, 0), (0, 1, 0), (0, 0, 1)))
    matrix = " ".join(f"{x[i]:.9g} {y[i]:.9g} {z[i]:.9g} {eye[i]:.9g}" for i in range(3)) + " 0 0 0 1"
    visible = [v / volume.top for v, alpha in volume.opacity if alpha > 0]
    lows = [v for v, alpha in volume.opacity if v / volume.top < min(visible)]
    highs = [v for v, alpha in volume.opacity if v / volume.top > max(visible)]
    low = max(lows) / volume.top if lows else -1
    high = min(highs) / volume.top if highs else 2
    modes = " ".join(f'boundaryMode{axis} "CLAMP_TO_EDGE"' for axis in "STR")
    plain = ('textureProperties TextureProperties { minificationFilter "LINEAR" magnificationFilter "LINEAR" %s }'
             % modes)
    return scenes.viewpoint(volume.side, False), f'''Shape {{ appearance Appearance {{ shaders ComposedShader {{
language "GLSL"
initializeOnly SFNode voxels ImageTexture3D {{ url "{volume.name}.nrrd" {plain} }}
initializeOnly SFNode transferFunction ImageTexture {{ url "{volume.name}-function.nrrd" {plain} }}
initializeOnly SFMatrix4f eyeToLocal {matrix}
initializeOnly SFVec3f dimensions {volume.side} {volume.side} {volume.side}
initializeOnly SFVec4f viewport 0 0 {size} {size}
initializeOnly SFFloat sampleDistance {step:g}
initializeOnly SFFloat referenceLength 1
initializeOnly SFFloat transparencyLeft {1 / 131070:.9g}
initializeOnly SFVec2f visibleValues {low:.9g} {high:.9g}
parts [ ShaderPart {{ type "VERTEX" url "data:text/plain,
#version 330 core
in vec4 castle_Vertex;
void main() {{ gl_Position = vec4(castle_Vertex.xy, 0.0, 1.0); }}" }}
ShaderPart {{ type "FRAGMENT" url "by-hand.frag" }} ] }} }}
geometry IndexedFaceSet {{ solid FALSE coordIndex [0 1 2 3 -1] coord Coordinate {{ point
[-1 -1 0, 1 -1 0, 1 1 0, -1 1 0] }} }} }}
'''


def rotated(axis, angle, v):
    """Rodrigues' formula."""
    c, s = math.cos(angle), math.sin(angle)
    turned = scenes.cross(axis, v)
    along = sum(a * b for a, b in zip(axis, v)) * (1 - c)
    return [v[i] * c + turned[i] * s + axis[i] * along for i in range(3)]


def by_hand(bench, progress):
    volume = data.lobb_volume(64)
    size, step = (128, 0.5) if bench.quick else (384, 0.125)
    with open(BY_HAND, encoding="utf-8") as file, \
            open(os.path.join(bench.folder, "by-hand.frag"), "w", encoding="utf-8") as copy:
        copy.write(file.read())
    view, shape = by_hand_scene(volume, size, step)
    whole = scenes.volume_node(volume).replace("cropMin", "#").split("#")
    node = whole[0] + "\n" + whole[1].split("\n", 1)[1]  # the one by hand knows no crop box
    words = (*bench.midpoint_words, "--step", f"{step:g}", *bench.bare)
    composed = Case(bench, scenes.scene(volume, node=node), words, size)
    hand = Case(bench, "#X3D V4.0 utf8\nPROFILE Immersive\n" + view + shape, (), size)
    files = [os.path.join(bench.folder, f"hand-{os.getpid()}-{n}.npy") for n in "01"]
    composed.draw(picture=files[0])
    hand.draw(picture=files[1])
    pictures = [engines.read_npy(f) for f in files]
    apart = max(abs(a - b) for i, (a, b) in enumerate(zip(*pictures)) if i % 4 != 3)
    for file in files:
        os.remove(file)
    part = "Composed raycaster against one written by hand, CPU time"
    if apart > 1e-3:
        return [rows.Row(part, "ml64", None, 1.02, greater=False,
                         detail=f"they do not draw the same: colours are up to {apart:.2g} apart")]
    ratio, spread = paired(hand, composed, 2 if bench.quick else 8, progress, 0.5)
    return [rows.Row(part, f"ml64, steps of {step:g} voxel",
                     ratio, 1.02, greater=False, noise=2 * spread,
                     detail=f"two standard errors {2 * spread:.4f}; composed "
                     f"{composed.time:.1f} ms, by hand {hand.time:.1f} ms; colours at most {apart:.1e} apart")]
