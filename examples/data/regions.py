#!/usr/bin/env python3
"""Writes examples/volumes/compositions/brain-regions.x3dv: a brain whose 116 regions of the AAL atlas have a colour each.
Run without arguments; the scene that lies there is what it writes."""

import colorsys
import os

HERE = os.path.dirname(os.path.abspath(__file__))
TARGET = os.path.join(HERE, "..", "volumes", "compositions", "brain-regions.x3dv")
REGIONS = 116
HEAD = """#X3D V4.0 utf8
PROFILE Immersive
META "picture" "480x360"
# A brain coloured by region: the 116 segments of the AAL atlas on the scan that it was drawn on, each with an opacity map of its
# own; left and right have the same hue. A box is cut out, and what lies between the regions is grey. The light is
# an author's effect on all segments. Written by examples/data/regions.py.
Viewpoint { position 0.3 0.28 0.42 orientation -0.6089 0.7689 0.1951 0.7898 fieldOfView 0.36 }
Background { skyColor 0.03 0.035 0.05 }
NavigationInfo { headlight FALSE }
Transform {
  rotation 0 0.70711 0.70711 3.14159 # z of the scan is up, y to the face
  translation 0 -0.03 0.018
  children SegmentedVolumeData {
    fileGeometry TRUE
    voxels ImageTexture3D { url "../../../.cache/data/ch2bet.nii.gz" }
    segmentIdentifiers ImageTexture3D { url "../../../.cache/data/aal.nii.gz" }
    effects Effect { parts EffectPart { type "FRAGMENT" url "effects/brain-light.glsl" } }
    renderStyle [
"""
TAIL = """    ]
  }
}
"""


def color(region):
    """Left and right follow one another in the atlas: odd and even numbers. Neighbours in its list differ."""
    pair = (region - 1) // 2
    return colorsys.hsv_to_rgb(pair * 0.381966 % 1.0, 0.45 + 0.2 * (pair % 3), 0.95 - 0.1 * (pair % 2))


def style(rgb):
    r, g, b = (f"{c:.2f}" for c in rgb)
    return (f"      OpacityMapVolumeStyle {{ transferFunction TransferFunction {{ key [ 0.1 0.2 ] "
            f"keyValue [ {r} {g} {b} 0, {r} {g} {b} 1 ] }} }}\n")


def main():
    with open(TARGET, "w", encoding="utf-8") as file:
        file.write(HEAD + style((0.62, 0.62, 0.62)) + "".join(style(color(i)) for i in range(1, REGIONS + 1)) + TAIL)


if __name__ == "__main__":
    main()
