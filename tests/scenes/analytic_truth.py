"""Closed forms of the volume rendering integral. Functions that return truths of rays on ramps take the
values s0 and s1 at both ends of a ray, between which s runs linearly, and its length; they return
premultiplied grey and opacity. T is the transmittance; a slope b is (s1 - s0) / length."""

import math

# Gauss and Legendre's rule of 8 points, on (-1, 1)
NODES = ((0.1834346424956498, 0.3626837833783620), (0.5255324099163290, 0.3137066458778873),
         (0.7966664774136267, 0.2223810344533745), (0.9602898564975363, 0.1012285362903763))


def gauss(function, start, end, parts=1):
    """The integral, by parts of equal length."""
    total, half = 0.0, (end - start) / (2 * parts)
    for part in range(parts):
        middle = start + (2 * part + 1) * half
        for node, weight in NODES:
            total += weight * (function(middle - half * node) + function(middle + half * node))
    return total * half


def integrated(extinction, color, length, breaks=(), parts=40):
    """Premultiplied grey and opacity of a ray on which extinction(t) and color(t) are smooth between
    the breaks: the integral of C tau T, by quadrature inside of quadrature. For checks of closed forms."""
    ends = [0.0] + sorted(b for b in breaks if 0 < b < length) + [length]
    grey, depth = 0.0, 0.0
    for start, end in zip(ends, ends[1:]):
        for part in range(parts):
            a = start + (end - start) * part / parts
            b = start + (end - start) * (part + 1) / parts
            before = depth
            grey += gauss(lambda t: color(t) * extinction(t)
                          * math.exp(-before - gauss(extinction, a, t)), a, b)
            depth += gauss(extinction, a, b)
    return grey, -math.expm1(-depth)


def homogeneous(extinction, color, length):
    """V1, V2."""
    alpha = -math.expm1(-extinction * length)
    return tuple(c * alpha for c in color) + (alpha,)


def linear_extinction(kappa):
    """V3: tau = kappa s, C = 1."""
    def truth(s0, s1, length):
        alpha = -math.expm1(-kappa * length * (s0 + s1) / 2)
        return alpha, alpha

    return truth


def linear_both(kappa):
    """V4: tau = kappa s, C = s. By parts: -s T, and the integral of T, which is an error function."""
    def truth(s0, s1, length):
        m = kappa * length / (2 * (s1 - s0))
        root = math.sqrt(m)
        through = math.exp(-m * (s1 * s1 - s0 * s0))
        bell = math.sqrt(math.pi) / (2 * root) * (math.erf(root * s1) - math.erf(root * s0))
        return s0 - s1 * through + math.exp(m * s0 * s0) * bell, 1 - through

    return truth


def manufactured(a, k):
    """V5: tau = a / (1 + a s), C = (1 + a s)^-k: T is a power of 1 + a s too."""
    def truth(s0, s1, length):
        q = length / (s1 - s0)
        u0, u1 = 1 + a * s0, 1 + a * s1
        return q / (q + k) * (u0**-k - u0**q * u1 ** -(q + k)), 1 - (u0 / u1) ** q

    return truth


def exponential(kappa, width):
    """V6: tau = kappa s of s = s0 e^(-t / width), C = 1."""
    def truth(s0, length):
        alpha = -math.expm1(kappa * s0 * width * math.expm1(-length / width))
        return alpha, alpha

    return truth


def bell(kappa, width):
    """V7: tau = kappa e^(-r^2 / (2 width^2)): `impact` is the least distance from the centre, `way` how
    far along the ray that is."""
    def truth(impact, way, length):
        root = math.sqrt(2) * width
        depth = (kappa * width * math.sqrt(math.pi / 2) * math.exp(-(impact / root) ** 2)
                 * (math.erf((length - way) / root) + math.erf(way / root)))
        alpha = -math.expm1(-depth)
        return alpha, alpha

    return truth


def ball(kappa, radius, parabolic):
    """V8: of constant extinction, or kappa (1 - r^2 / R^2)."""
    def truth(impact):
        half = math.sqrt(max(radius**2 - impact**2, 0.0))
        depth = 4 * kappa * half**3 / (3 * radius**2) if parabolic else 2 * kappa * half
        alpha = -math.expm1(-depth)
        return alpha, alpha

    return truth


def two_slabs(first, second):
    """V9: colour and extinction of s < 1/2 and of s > 1/2."""
    def truth(s0, s1, length):
        split = min(max((0.5 - s0) / (s1 - s0), 0.0), 1.0) * length
        near, far = math.exp(-first[1] * split), math.exp(-second[1] * (length - split))
        return first[0] * (1 - near) + near * second[0] * (1 - far), 1 - near * far

    return truth


def thin_sheet(extinction, low, high):
    """V10: tau between two values, C = 1."""
    def truth(s0, s1, length):
        share = max(min(s1, high) - max(s0, low), 0.0) / (s1 - s0)
        alpha = -math.expm1(-extinction * length * share)
        return alpha, alpha

    return truth


def waves(kappa, q):
    """V11: tau = kappa (1 + cos 2 pi q s), C = 1."""
    def truth(s0, s1, length):
        w = 2 * math.pi * q
        alpha = -math.expm1(-kappa * length * (1 + (math.sin(w * s1) - math.sin(w * s0)) / (w * (s1 - s0))))
        return alpha, alpha

    return truth

