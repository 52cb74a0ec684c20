"""The reflection of glTF 2.0, appendix B."""

import math

from harness import dot, unit


def reflection(base, metallic, roughness, l, n=(0, 0, 1), view=(0, 0, 1)):
    """What a white light of intensity 1 gives: B.2 and B.3 with the functions of B.3.2 and B.3.4."""
    n_dot_l, n_dot_v = max(dot(n, l), 0), abs(dot(n, view))
    h = unit([a + b for a, b in zip(l, view)])
    n_dot_h, v_dot_h = dot(n, h), dot(view, h)
    a2 = roughness**4
    d = a2 / (math.pi * (n_dot_h**2 * (a2 - 1) + 1) ** 2)
    g = (2 * n_dot_l / (n_dot_l + math.sqrt(a2 + (1 - a2) * n_dot_l**2))
         * 2 * n_dot_v / (n_dot_v + math.sqrt(a2 + (1 - a2) * n_dot_v**2)))
    out = []
    for c in base:
        def mixed(f0, diffuse):
            f = f0 + (1 - f0) * (1 - v_dot_h) ** 5
            return (1 - f) * diffuse / math.pi + f * d * g / (4 * n_dot_l * n_dot_v)
        # B.3.5: one formula for what lies between dielectric and metal
        out.append(n_dot_l * mixed(0.04 * (1 - metallic) + c * metallic, c * (1 - metallic)))
    return out
