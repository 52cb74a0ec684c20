"""What things cost: empty space, more of everything, what is not used, composing itself."""

import math
import os
import random

from . import data, engines, rows, scenes

HERE = os.path.dirname(os.path.abspath(__file__))
TWINS = os.path.join(HERE, "..", "..", "..", "tests", "scenes", "twins")


class Side:
    """A scene, and how it is drawn."""

    def __init__(self, bench, text, size, method="auto", step=0, leaps=True):
        self.bench, self.text, self.size = bench, text, size
        self.how = {"method": method, "step": step, "leaps": leaps}
        self.times, self.view = [], None

    def show(self):
        """Makes its view anew, and draws it once."""
        path = os.path.join(self.bench.folder, f"side-{os.getpid()}.x3dv")
        with open(path, "w", encoding="ascii") as file:
            file.write(self.text)
        self.bench.turns.scene(path)
        self.view = self.bench.turns.view(self.size, **self.how)
        self.bench.turns.times([self.view], 1)
        os.remove(path)
        return self

    def picture(self):
        path = os.path.join(self.bench.folder, f"side-{os.getpid()}.npy")
        self.bench.turns.picture(self.view, path)
        numbers = engines.read_npy(path)
        os.remove(path)
        return numbers

    @property
    def time(self):
        return engines.median(self.times)

    @property
    def instructions(self):
        return sum(p[2] for p in self.view.programs)


def rounds_for(bench, sides, seconds):
    """How often they can all be drawn in some CPU seconds."""
    once = sum(t[0] for t in bench.turns.times([s.view for s in sides], 1))
    return min(max(round(1e3 * seconds / max(once, 0.1)), 2), 400)


class Ratio:
    """Of times, second / first, of frames side by side: the median, and where it lies with 95 %."""

    def __init__(self, blocks):
        self.count = sum(map(len, blocks))
        self.median = engines.median([r for block in blocks for r in block])
        dice, found = random.Random(1), []
        for _ in range(400):  # bootstrap, of views and of frames
            some = [dice.choice(blocks) for _ in blocks]
            found.append(engines.median([r for block in some for r in dice.choices(block, k=len(block))]))
        found.sort()
        self.low, self.high = found[10], found[389]
        self.above, self.below = self.high - self.median, self.median - self.low

    def text(self):
        return f"95 %: {self.low:.4f} to {self.high:.4f}, {self.count} pairs of frames"


BLOCKS = 6


def paired(first, second, progress, seconds):
    """Frame by frame in turns in one process. Where textures lie in memory counts, so views are made anew
    now and then, in the other order."""
    bench, blocks = first.bench, []
    for number in range(2 if bench.quick else BLOCKS):
        bench.turns.forget()
        for side in (first, second) if number % 2 else (second, first):
            side.show()
        rounds = rounds_for(bench, (first, second), seconds / BLOCKS)
        times = bench.turns.times([first.view, second.view], rounds, bench.clock)
        first.times += times[0]
        second.times += times[1]
        blocks.append([b / a for a, b in zip(*times)])
        progress.step()
    return Ratio(blocks)


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
            found += leap(bench, scenes.scene(volume), method.name, part, what, bar, progress)
    return found


def leap(bench, text, method, part, what, bar, progress):
    size = 128 if bench.quick else 384
    on, off = (Side(bench, text, size, method, 0.5, leaps) for leaps in (True, False))
    ratio = paired(on, off, progress, 0.5 if bench.quick else 4)
    same = on.picture().tobytes() == off.picture().tobytes()
    return [rows.Row(part, what, ratio.median, bar, noise=ratio.below,
                     detail=f"without {off.time:.1f} ms, with {on.time:.1f} ms; {ratio.text()}"),
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
    with_effects = lambda n: scenes.scene(volume, node=scenes.volume_node(volume, effects=identity(n)))
    top = 4 if bench.quick else 16
    counts = [n for n in (1, 2, 4, 8, 16) if n <= top]
    sizes = [64, 128, 256] if bench.quick else [128, 256, 512, 1024]
    half = lambda text, pixels=size: Side(bench, text, pixels, "midpoint", 0.5)
    series = (
        ("steps", [(n, Side(bench, plain, size, "midpoint", 0.5 / n, leaps=False)) for n in counts]),
        ("pixels", [(n * n, half(plain, n)) for n in sizes]),
        ("effects", [(n, half(with_effects(n))) for n in counts]),
        ("lights", [(n, half(lit(volume, n))) for n in counts]),
        ("volumes", [(n, half(crowd(volume, n))) for n in counts]),
    )
    found, curves = [], {}
    for name, sides in series:
        times = side_by_side(bench, [side for _, side in sides], progress)
        numbers = [n for n, _ in sides]
        curves[name] = list(zip(numbers, times))
        detail = ", ".join(f"{n}: {t:.1f} ms" for n, t in zip(numbers, times))
        last = math.log(times[-1] / times[-2]) / math.log(numbers[-1] / numbers[-2])
        found.append(rows.Row("Fitted exponent of CPU time", name, rows.exponent(numbers, times), 1.05,
                              greater=False, detail=f"{detail}; between the last two {last:.2f}"))
    return found, curves


def side_by_side(bench, sides, progress):
    """Medians of frames that take turns."""
    bench.turns.forget()
    for side in sides:
        side.show()
    rounds = min(rounds_for(bench, sides, 1 if bench.quick else 10), 40)
    times = bench.turns.times([s.view for s in sides], rounds, bench.clock)
    progress.step()
    return [engines.median(t) for t in times]


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
    size, step, seconds = (128, 0.5, 0.5) if bench.quick else (256, 0.5, 8)
    found = []
    pairs = unused_scenes(volume)
    for what, without, with_it in (("the same scene again, for comparison", pairs[0][1], pairs[0][1]), *pairs):
        first, second = (Side(bench, text, size, "midpoint", step) for text in (without, with_it))
        ratio = paired(first, second, progress, seconds)
        same = first.view.programs == second.view.programs
        text = "the same text of the program" if same else "another text of the program"
        control = without is with_it
        found.append(rows.Row(part, what, ratio.median, None if control else 1.01, greater=False, noise=ratio.above,
                              detail=f"{ratio.text()}; {first.time:.1f} ms"))
        if not control:
            found.append(rows.Row(part, f"{what}: instructions more", second.instructions - first.instructions, 0,
                                  greater=False, detail=f"of {first.instructions}; {text}"))
    return found


# ---- Composed against written by hand ----

def hand_scenes(volume):
    """What is drawn, the twin of its program in tests/scenes/twins, and the scene."""
    whole = lambda style: scenes.volume_node(volume, style, crop=False)
    sun = "NavigationInfo { headlight FALSE }\nDirectionalLight { direction 1 -1 -2 ambientIntensity .3 }\n"
    lit = ("ShadedVolumeStyle { lighting TRUE material Material { diffuseColor .6 .4 .2 specularColor .5 .6 .7 "
           "shininess .1 ambientIntensity .4 emissiveColor .05 .1 .15 transparency .15 } }")
    edges = "BoundaryEnhancementVolumeStyle { retainedOpacity .3 boundaryOpacity .8 opacityFactor 1.4 }"
    map_ = scenes.style(volume)
    return (
        ("a transfer function", "ramp", scenes.scene(volume, node=whole(map_))),
        ("a clip plane", "clipped", scenes.scene(volume, before="ClipPlane { plane .5 .3 0 2 }\n", node=whole(map_))),
        ("enhanced boundaries", "boundary", scenes.scene(volume, node=whole(edges))),
        ("light", "shaded", scenes.scene(volume, before=sun, node=whole(lit))),
    )


class HandSide(Side):
    """The scene by a program that was written by hand."""

    twin = ""

    def show(self):
        super().show()
        self.bench.turns.replace(self.view, "volume-1", os.path.join(TWINS, "volume.vert"),
                                 os.path.join(TWINS, self.twin + ".frag"))
        self.bench.turns.times([self.view], 1)
        return self


def by_hand(bench, progress):
    volume = data.lobb_volume(64)
    part = "Composed program against one main() written by hand that draws the same bits, CPU time"
    size, step, seconds = (128, 0.5, 0.5) if bench.quick else (160, 0.5, 12)
    found = []
    for what, twin, text in hand_scenes(volume):
        composed = Side(bench, text, size, "midpoint", step, leaps=False)
        hand = HandSide(bench, text, size, "midpoint", step, leaps=False)
        hand.twin = twin
        ratio = paired(hand, composed, progress, seconds)
        same = hand.picture().tobytes() == composed.picture().tobytes()
        detail = f"{ratio.text()}; composed {composed.time:.1f} ms, by hand {hand.time:.1f} ms"
        found.append(rows.Row(part, f"{what}, steps of {step:g} voxel", ratio.median if same else None, 1.02,
                              greater=False, noise=ratio.above,
                              detail=detail if same else "they do not draw the same"))
    return found
