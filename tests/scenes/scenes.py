"""Pieces of scenes that several tests use, in Classic VRML."""

import itertools

from harness import HEADER

# A box of side 1 at the origin fills the middle half of the picture; parallel rays along -z.
FRONT = "OrthoViewpoint { position 0 0 10 fieldOfView -1 -1 1 1 }\n"
NO_HEADLIGHT = "NavigationInfo { headlight FALSE }\n"


def voxels(components, size, values):
    """A PixelTexture3D; values packed as in X3D."""
    w, h, d = size
    values = list(values)
    assert len(values) == w * h * d
    return f"PixelTexture3D {{ image [{components} {w} {h} {d} {' '.join(map(str, values))}] }}"


def constant(value, size=(1, 1, 1), components=1):
    return voxels(components, size, itertools.repeat(value, size[0] * size[1] * size[2]))


def volume(data, style="", effects="", fields="", dimensions=(1, 1, 1)):
    parts = [f"dimensions {' '.join(map(str, dimensions))}", f"voxels {data}"]
    if style:
        parts.append(f"renderStyle {style}")
    if effects:
        parts.append(f"effects [ {effects} ]")
    return "VolumeData { " + "\n  ".join(parts + [fields]) + " }\n"


def effect(code, fields="", head="", kind="FRAGMENT"):
    """An Effect of one part; `head`: a DEF before, `fields`: declarations and values."""
    return (
        f"{head} Effect {{ {fields}\n parts EffectPart {{ type \"{kind}\" url \"data:text/plain,\n"
        f"{code}\n\" }} }}\n"
    )


def effect_parts(parts, fields="", head=""):
    """An Effect of several parts: pairs of kind and code."""
    text = "".join(
        f"EffectPart {{ type \"{kind}\" url \"data:text/plain,\n{code}\n\" }}\n"
        for kind, code in parts
    )
    return f"{head} Effect {{ {fields}\n parts [ {text} ] }}\n"


def scene(*parts):
    return HEADER + "".join(parts)


def front_scene(*parts):
    return scene(FRONT, NO_HEADLIGHT, *parts)


def quad(material="UnlitMaterial { }", effects="", appearance="", geometry=None):
    """A square of side 1 in the plane z = 0 that looks to +z, texture coordinates 0 to 1."""
    geometry = geometry or (
        "IndexedFaceSet { coordIndex [0 1 2 3 -1] coord Coordinate { point "
        "[-.5 -.5 0, .5 -.5 0, .5 .5 0, -.5 .5 0] } texCoordIndex [0 1 2 3 -1] "
        "texCoord TextureCoordinate { point [0 0, 1 0, 1 1, 0 1] } }"
    )
    material = f"material {material}" if material else ""
    effects = f"effects [ {effects} ]" if effects else ""
    return (
        f"Shape {{ appearance Appearance {{ {material} {appearance} {effects} }} "
        f"geometry {geometry} }}\n"
    )


class Row:
    """Shapes side by side in one drawing: each its own cell of 4 x 4 pixels, probed near its
    middle. Lights of a cell reach only that cell."""

    def __init__(self, suite):
        self.suite = suite
        self.cells = []

    def add(self, content):
        self.cells.append(content)

    def draw(self, *arguments, head="", **options):
        count = len(self.cells)
        body = "".join(
            f"Transform {{ translation {i + 0.5} 0.5 0 children [\n{cell}] }}\n"
            for i, cell in enumerate(self.cells)
        )
        view = f"OrthoViewpoint {{ position 0 0 10 fieldOfView 0 0 {count} 1 }}\n"
        text = scene(view, NO_HEADLIGHT, head, body)
        pixels = [(4 * i + 1, 1) for i in range(count)]
        return self.suite.probe(text, pixels, *arguments, size=f"{4 * count}x4", **options)
