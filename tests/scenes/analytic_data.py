"""What the analytic cases V1 to V20 of volume rendering have in common: the table of sampling methods
and of what is expected of each, scenes of many cases, and the rule for observed orders of convergence.

A case is a volume whose pixels are known in closed form. Many are drawn by one run of the program: a
clock turns a Switch from case to case, and each frame is the picture of one of them. The lattice of
steps is never aligned with anything: the boxes stand oblique, so that each ray has a length of its own.
"""

import math
import os
import re
import struct

from analytic_rays import Box, Parallel, Transform, centres
from harness import HEADER, CaseError, Picture
from scenes import NO_HEADLIGHT, volume

# ---- methods

MIDPOINT, TABLE, CELLS = "midpoint", "preintegrated", "cells"
METHODS = (MIDPOINT, TABLE, CELLS)
EXACT = "exact"     # but for rounding, and for what a table can hold
BOUNDED = "bounded"  # within a constant times the step: fields or functions that jump
KINKED = "kinked"    # within a constant times its square: fields with kinks, as voxels have

PLANNED = "at most the error asked for"  # whatever the step
SAME = "as another method"  # what has no integrals of cells
POWERS = {BOUNDED: 1, KINKED: 2}
# The least trend over the halvings of a step. A table knows nothing of kinks within its segments.
TRENDS = {(MIDPOINT, BOUNDED): 0.8, (TABLE, BOUNDED): 0.8, (MIDPOINT, KINKED): 1.6, (TABLE, KINKED): 1.4}
ASKED = (1 / 255, 1 / 1023)


def offered_methods(suite):
    """Those of METHODS that the program knows; midpoint is what it has always had."""
    text = suite.command("render", "--help").output
    found = re.search(r"--method\s+([a-z|]+)", text)
    names = found.group(1).split("|") if found else [MIDPOINT]
    return [m for m in METHODS if m in names]


def method_arguments(suite, method, step):
    has_option = len(offered(suite)) > 1
    return ["--step", repr(float(step))] + (["--method", method] if has_option else [])


def integrated(suite):
    """The methods whose errors follow from the step."""
    return [method for method in offered(suite) if method != CELLS]


def offered(suite):
    if not hasattr(suite, "methods"):
        suite.methods = offered_methods(suite)
    return suite.methods


# ---- data


def nrrd(size, values, components=1):
    """Floats; x runs fastest."""
    axes = ([components] if components > 1 else []) + list(size)
    kinds = "kinds: " + " ".join((["list"] if components > 1 else []) + ["domain"] * 3) + "\n"
    head = (f"NRRD0004\ntype: float\ndimension: {len(axes)}\nsizes: {' '.join(map(str, axes))}\n{kinds}"
            "encoding: raw\nendian: little\n\n")
    return head.encode() + struct.pack(f"<{len(values)}f", *values)


def function_file(texels):
    """A transfer function of floats: straight RGBA from 0 to 1."""
    head = (f"NRRD0004\ntype: float\ndimension: 2\nsizes: 4 {len(texels)}\nkinds: RGBA-color domain\n"
            "encoding: raw\nendian: little\n\n")
    return head.encode() + b"".join(struct.pack("<4f", *texel) for texel in texels)


TEXELS = 4096


def table(extinction, color, reference, texels=TEXELS):
    """Texels of extinction(s) per length and colour color(s), grey or three."""
    found = []
    for i in range(texels):
        s = i / (texels - 1) if texels > 1 else 0.0
        c = color(s)
        c = tuple(c) if hasattr(c, "__iter__") else (c, c, c)
        tau = extinction(s)
        found.append(c + (1.0 if math.isinf(tau) else -math.expm1(-tau * reference),))
    return found


def opacity_map(name):
    return f'OpacityMapVolumeStyle {{ transferFunction ImageTexture {{ url "{name}" }} }}'


def image3d(name):
    return f'ImageTexture3D {{ url "{name}" }}'


def sampled(box, field):
    """The field's values at the voxels' centres, as a file."""
    w, h, d = box.size
    return nrrd(box.size, [
        field(box.own(((i + 0.5) / w, (j + 0.5) / h, (k + 0.5) / d)))
        for k in range(d) for j in range(h) for i in range(w)])


# ---- the ramp that most cases stand on

# Seen from the front it rises along every ray: the slope and the rays are at an acute angle.
OBLIQUE = Transform(rotation=(1, 2, 0.5, 0.5))
REFERENCE = 0.02


def oblique_box(dimensions=(0.64, 0.5, 0.56), size=(5, 4, 6), place=OBLIQUE):
    return Box(dimensions, size, *centres(size), place)


RAMP_GRADIENT = (0.37, -0.29, -1.31)


def ramp_value(position):
    return 0.5 + sum(a * x for a, x in zip(RAMP_GRADIENT, position))


def on_ramp(chord):
    """The values at both ends, and the length."""
    return ramp_value(chord.entry), ramp_value(chord.at(chord.length)), chord.length


# ---- cases

HALVINGS = (1, 1 / 2, 1 / 4, 1 / 8, 1 / 16, 1 / 32)


class Case:
    """`truth(chord)` is the premultiplied colour of a ray, or None where nothing is said; `orders` what
    each method is expected to show: a number, PLANNED, SAME, EXACT, BOUNDED (by `bound` times the step) or KINKED (by its
    square); `steps` the steps that show it, in voxels; `tolerance` what EXACT allows a method beyond
    rounding."""

    def __init__(self, name, content, truth, box, files=None, orders=None, steps=HALVINGS, bound=None,
                 tolerance=None):
        self.name, self.content, self.truth, self.box = name, content, truth, box
        self.files, self.orders, self.steps = files or {}, orders or {}, tuple(steps)
        self.bound, self.tolerance = bound, tolerance or {}
        self.beside = (0.0,) * 4  # what rays show that miss it

    def expected(self, view, pixels):
        """The pixels' colours, row by row; also how many rays meet the volume, and the longest."""
        colors, met, longest = [], 0, 0.0
        for y in range(pixels):
            for x in range(pixels):
                chord = self.box.chord(view.ray(x, y, pixels))
                colors.append(self.truth(chord) if chord else self.beside)
                if chord and colors[-1]:
                    met += 1
                    longest = max(longest, chord.length)
        return colors, met, longest


def mapped_case(name, data, files, box, extinction, color, truth, reference=REFERENCE, texels=TEXELS,
                effects="", fields="", styles=(), **more):
    """A volume of `data` behind a transfer function, and other styles behind that."""
    function = "function-" + name.replace(" ", "-") + ".nrrd"
    files = {function: function_file(table(extinction, color, reference, texels)), **files}
    style = opacity_map(function)
    if styles:
        style = f"ComposedVolumeStyle {{ renderStyle [ {style} {' '.join(styles)} ] }}"
    content = box.place.around(volume(
        data, style, effects,
        f"valueRange 0 1 opacityUnitDistance {reference!r} {box.fields()} {fields}", box.dimensions))
    return Case(name, content, truth, box, files, **more)


def grey(pair):
    """The colour of premultiplied grey and opacity."""
    return (pair[0],) * 3 + (pair[1],)


def ramp_case(name, extinction, color, truth, **more):
    """`truth(s0, s1, length)`: grey and opacity."""
    box = oblique_box()
    return mapped_case(name, image3d("ramp.nrrd"), {"ramp.nrrd": sampled(box, ramp_value)}, box,
                       extinction, color, lambda chord: grey(truth(*on_ramp(chord))), **more)


# ---- drawing


class Sheet:
    """Cases that one run of the program draws, one a frame."""

    def __init__(self, suite, cases, view=None, pixels=12, head=""):
        self.suite, self.cases, self.pixels, self.head = suite, cases, pixels, head
        self.view = view or Parallel()
        self.drawn = {}
        self.known = {}

    def text(self):
        count = len(self.cases)
        keys, values = (" ".join(map(str, v)) for v in ([i / count for i in range(count)], range(count)))
        clock = (f"DEF CLOCK TimeSensor {{ loop TRUE cycleInterval {count} }}\n"
                 f"DEF TURN IntegerSequencer {{ key [ {keys} ] keyValue [ {values} ] }}\n"
                 "ROUTE CLOCK.fraction_changed TO TURN.set_fraction\n"
                 "ROUTE TURN.value_changed TO CASES.whichChoice\n")
        shown = "".join(f"Group {{ children [ {case.content} ] }}\n" for case in self.cases)
        return (HEADER + self.view.text() + NO_HEADLIGHT + self.head
                + f"DEF CASES Switch {{ whichChoice 0 children [\n{shown}] }}\n" + clock)

    def files(self):
        found = {}
        for case in self.cases:
            found.update(case.files)
        return found

    def pictures(self, method, step, backend="auto"):
        key = (method, step, backend)
        if key not in self.drawn:
            self.drawn[key] = self.draw("--backend", backend,
                                        *method_arguments(self.suite, method, step))[0]
        return self.drawn[key]

    def draw(self, *arguments):
        """The pictures of all cases, and what else the program said."""
        count = len(self.cases)
        result = self.suite.render(
            self.text(), "-o", "a.npy", "--frames", count, "--fps", 1, "--time", 0.5, *arguments,
            size=f"{self.pixels}x{self.pixels}", files=self.files())
        if result.messages():
            raise CaseError(result.errors)
        return [Picture(os.path.join(result.folder, f"a-{i:04}.npy")) for i in range(1, count + 1)], result.output

    def planned(self, case, error):
        """Of `cells`, which cuts rays where that error needs it."""
        if error not in self.drawn:
            self.drawn[error] = self.draw("--method", CELLS, "--error", repr(error))[0]
        return self.drawn[error][self.cases.index(case)]

    def picture(self, case, method, step, backend="auto"):
        return self.pictures(method, step, backend)[self.cases.index(case)]

    def expected(self, case):
        if case.name not in self.known:
            self.known[case.name] = case.expected(self.view, self.pixels)
        return self.known[case.name]

    def error(self, case, method, step):
        """The greatest difference of a channel of any ray."""
        colors = self.expected(case)[0]
        return greatest_error(self.picture(case, method, step), colors)

    def counts(self, case, steps):
        """Steps along the longest ray."""
        return [self.expected(case)[2] / (s * case.box.voxel()) for s in steps]


def greatest_error(picture, colors):
    worst = 0.0
    for i, color in enumerate(colors):
        for got, wanted in zip(picture.values[4 * i:4 * i + 4], color or ()):
            difference = abs(got - wanted)
            if not difference <= worst:  # NaN too
                worst = difference if difference == difference else math.inf
    return worst


# ---- rules


def floor_of(count):
    """What floats can tell of a sum of so many steps."""
    return max(2e-6, count * 6e-8)


def observed_orders(errors, counts):
    """log2 of the ratios of neighbours, as far as both are above the floor."""
    return [math.log2(a / b) for (a, b), (m, n) in zip(zip(errors, errors[1:]), zip(counts, counts[1:]))
            if a > floor_of(m) and b > floor_of(n)]


def median(values):
    values = sorted(values)
    middle = len(values) // 2
    return values[middle] if len(values) % 2 else (values[middle - 1] + values[middle]) / 2


def grows(errors, counts):
    """Whether a finer one is worse than the one before, by more than floats explain."""
    return any(b > 1.05 * a and b > floor_of(n) for a, b, n in zip(errors, errors[1:], counts[1:]))


def slope_of(values):
    """Of a line through equally spaced values, by least squares."""
    middle = (len(values) - 1) / 2
    return (sum((i - middle) * v for i, v in enumerate(values))
            / sum((i - middle) ** 2 for i in range(len(values))))


def show(values):
    return " ".join(f"{v:.3g}" for v in values)


def check_order(suite, method, errors, counts, order, least=5, row=None):
    orders = observed_orders(errors, counts)
    found = median(orders) if len(orders) >= least else math.nan
    return suite.result(row, method, f"order {order}", f"{found:.2f}",
                        abs(found - order) <= 0.1 and not grows(errors, counts), f"errors {show(errors)}",
                        f"orders {show(orders)}, of {least} above the floor")


def check_planned(sheet, case, colors=None, row=None):
    """No error is greater than what is asked for: 1/255 where nothing is, whatever the step."""
    suite, colors = sheet.suite, colors or sheet.expected(case)[0]
    pictures = [sheet.picture(case, CELLS, case.steps[0]), sheet.planned(case, ASKED[1])]
    errors = [greatest_error(picture, colors) for picture in pictures]
    suite.check(f"{CELLS}: finite, 0 <= A <= 1, I <= A", all(map(is_physical, pictures)))
    return suite.result(row, CELLS, PLANNED, ", ".join(f"{e:.1e} of 1/{1 / a:.0f}" for e, a in zip(errors, ASKED)),
                        all(e <= a for e, a in zip(errors, ASKED)), f"errors {show(errors)}")


def check_same(sheet, case, method):
    """To the bit."""
    step = case.steps[1]
    got = sheet.picture(case, method, step).values
    apart = {m: max(abs(a - b) for a, b in zip(got, sheet.picture(case, m, step).values)) for m in (TABLE, MIDPOINT)}
    nearest = min(apart, key=apart.get)
    return sheet.suite.result(None, method, f"as {nearest}", f"{apart[nearest]:.1g} apart",
                              got.tobytes() == sheet.picture(case, nearest, step).values.tobytes())


def check_exact(suite, method, errors, counts, tolerance, row=None):
    allowed = [max(tolerance, floor_of(n)) for n in counts]
    expected = "exact" if tolerance < 1e-4 else f"at most {tolerance:.2g}"
    return suite.result(row, method, expected, f"{max(errors):.1e}",
                        all(e <= a for e, a in zip(errors, allowed)), f"errors {show(errors)}",
                        f"allowed {show(allowed)}")


TABLE_FLOOR = 2e-3


def check_bounded(suite, method, errors, lengths, counts, constant, order, row=None):
    """e <= constant * h^power; a kink or a jump makes single ratios of errors vary, not their trend. Of
    errors that floats may make themselves no trend is asked."""
    power = POWERS[order]
    allowed = [max(constant * h**power, floor_of(n)) for h, n in zip(lengths, counts)]
    whole = slope_of([-math.log2(max(e, 1e-9)) for e in errors])
    used = max(e / h**power for e, h in zip(errors, lengths))
    unit = "h" if power == 1 else f"h^{power}"
    # the table of segments holds jumps no finer than its nodes: no trend below that
    floor = max(TABLE_FLOOR if method == "preintegrated" else 0, *map(floor_of, counts))
    return suite.result(row, method, f"at most {constant:.3g} {unit}", f"{used:.2g} {unit}, order {whole:.2f}",
                        all(e <= a for e, a in zip(errors, allowed))
                        and (whole >= TRENDS[method, order] or max(errors) <= floor),
                        f"errors {show(errors)}", f"allowed {show(allowed)}")


def is_physical(picture):
    """Finite, 0 <= A <= 1, 0 <= I <= A: all colours are within 0 and 1."""
    values, slack = picture.values, 2e-6
    if not all(map(math.isfinite, values)):
        return False
    return all(0 <= a <= 1 and 0 <= min(r, g, b) and max(r, g, b) <= a + slack
               for r, g, b, a in zip(*(values[i::4] for i in range(4))))


def check_denser(suite, name, thin, dense):
    """More extinction is never more transparent."""
    pairs = list(zip(thin.values[3::4], dense.values[3::4]))
    suite.check(f"{name}: denser is more opaque",
                all(b >= a - 1e-6 for a, b in pairs) and any(b > a + 1e-4 for a, b in pairs))


def check_case(sheet, case):
    """What its orders say, for every method that the program offers."""
    suite = sheet.suite
    _, met, longest = sheet.expected(case)
    suite.check(f"{met} rays", met >= 64)
    for method in offered(suite):
        if method not in case.orders:
            continue
        order = case.orders[method]
        if order == PLANNED:
            check_planned(sheet, case)
            continue
        if order == SAME:
            check_same(sheet, case, method)
            continue
        steps = case.steps[:1] if method == CELLS else case.steps  # which says nothing to it
        errors = [sheet.error(case, method, step) for step in steps]
        lengths = [step * case.box.voxel() for step in steps]
        counts = [longest / length for length in lengths]
        if order == EXACT:
            check_exact(suite, method, errors, counts, case.tolerance.get(method, 0))
        elif order in POWERS:
            check_bounded(suite, method, errors, lengths, counts, case.bound, order)
        else:
            check_order(suite, method, errors, counts, order)
        suite.check(f"{method}: finite, 0 <= A <= 1, I <= A",
                    all(is_physical(sheet.picture(case, method, step)) for step in steps))


def has_backend(suite, name):
    if not hasattr(suite, "backends"):
        suite.backends = {}
    if name not in suite.backends:
        empty = suite.render(HEADER, "--probe", "0,0", "--backend", name, size="1x1", status=None)
        if empty.status not in (0, 3):
            raise CaseError(empty.errors)
        suite.backends[name] = empty.status == 0
    return suite.backends[name]


def check_backends(sheet, step, methods=None):
    """Both give the same bits, by every method (or these)."""
    suite = sheet.suite
    for name in ("egl", "osmesa"):
        if not has_backend(suite, name):
            return suite.skip("alike to the bit", f"no {name} here")
    for method in methods or offered(suite):
        # where there is EGL it is what draws without being asked
        pairs = zip(sheet.cases, sheet.pictures(method, step), sheet.pictures(method, step, "osmesa"))
        for case, one, other in pairs:
            suite.check(f"{method}, {case.name}: EGL and OSMesa alike to the bit",
                        one.values.tobytes() == other.values.tobytes())


def by_number(cases):
    """V3 -> its cases."""
    found = {}
    for case in cases:
        found.setdefault(case.name.split()[0], []).append(case)
    return found


def add_cases(sheet, cases):
    """A case of the suite for each number, which is its name on the command line."""
    for number, members in by_number(cases).items():
        def run(members=members):
            title = sheet.suite.title
            for member in members:
                sheet.suite.title = member.name
                check_case(sheet, member)
            sheet.suite.title = title
        run.__name__ = number
        sheet.suite.case(run)
