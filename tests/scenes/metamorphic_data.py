"""Random scenes of volumes as data, that can be written as text, changed, and made smaller.

A world is a dictionary: `volumes`, each with `size`, `numbers`, `texels` (of its transfer function, RGBA 0..255), `style`,
`dimensions`, `place` (fields of the Transform around it), `crop` or None, `unit` (opacityUnitDistance); `lights` (nodes);
`eye` (a viewpoint); `around` (fields of a Transform around everything); `inside` (of one around volumes and lights).
"""

import copy
import random

from scenes import NO_HEADLIGHT, scene, voxels

STYLES = (
    "",
    "ShadedVolumeStyle { lighting TRUE material Material { specularColor .4 .4 .4 } }",
    "EdgeEnhancementVolumeStyle { edgeColor .2 .4 .9 1 }",
    "SilhouetteEnhancementVolumeStyle { silhouetteRetainedOpacity .5 silhouetteBoundaryOpacity .4 }",
    "BoundaryEnhancementVolumeStyle { }",
    "ToneMappedVolumeStyle { }",
)
EYES = ("OrthoViewpoint { position 0 0 5 fieldOfView -1 -1 1 1 }\n", "Viewpoint { position 0 0 3 fieldOfView .7 }\n")


def words(numbers):
    return " ".join(f"{n!r}" for n in numbers)


def random_volume(chance):
    size = tuple(chance.randint(2, 5) for _ in range(3))
    count = chance.randint(3, 9)
    smooth = [chance.randrange(0, 200, 2) for _ in range(count)]
    smooth[0] = chance.choice((0, smooth[0]))
    return {
        "size": size,
        "numbers": [chance.randrange(20, 236) for _ in range(size[0] * size[1] * size[2])],
        "texels": [tuple(chance.randrange(0, 256, 2) for _ in range(3)) + (a,) for a in smooth],
        "style": chance.choice(STYLES),
        "dimensions": tuple(chance.choice((0.5, 0.75, 1, 1.25)) for _ in range(3)),
        "place": {"translation": tuple(chance.choice((-0.25, 0, 0.125)) for _ in range(3)),
                  "rotation": (chance.choice((1, 2)), chance.choice((0, 3)), -1, round(chance.uniform(-1.5, 1.5), 2)),
                  "scale": tuple(chance.choice((0.75, 1, 1.5)) for _ in range(3))},
        "crop": chance.choice((None, None, ((0.1, 0, 0.2), (0.9, 0.8, 1)))),
        "unit": chance.choice((0, 0.25)),
    }


def random_light(chance):
    color = words(round(chance.uniform(0.2, 1), 1) for _ in range(3))
    direction = words(chance.choice((-2, -1, 0.5)) for _ in range(3))
    if chance.random() < 0.5:
        return f"DirectionalLight {{ color {color} direction {direction} global TRUE intensity .5 }}\n"
    location = words(chance.choice((-2, 1, 3)) for _ in range(3))
    return f"PointLight {{ color {color} location {location} radius 1e18 global TRUE intensity .5 }}\n"


def random_world(seed):
    chance = random.Random(seed)
    return {
        "volumes": [random_volume(chance) for _ in range(chance.choice((1, 1, 2, 3)))],
        "lights": [random_light(chance) for _ in range(chance.randint(1, 3))],
        "eye": chance.choice(EYES),
        "around": "",
        "inside": "",
    }


def transform(fields, content):
    return f"Transform {{ {fields} children [\n{content}] }}\n" if fields else content


def style_text(volume):
    texels = " ".join(f"0x{r:02X}{g:02X}{b:02X}{a:02X}" for r, g, b, a in volume["texels"])
    opacity = (f"OpacityMapVolumeStyle {{ transferFunction PixelTexture {{ image {len(volume['texels'])} 1 4 {texels} }} }}")
    return f"ComposedVolumeStyle {{ renderStyle [ {opacity}\n {volume['style']} ] }}" if volume["style"] else opacity


def volume_text(volume):
    fields = f"dimensions {words(volume['dimensions'])} voxels {voxels(1, volume['size'], volume['numbers'])}\n"
    fields += f"renderStyle {style_text(volume)}\n"
    if volume["crop"]:
        fields += f"cropMin {words(volume['crop'][0])} cropMax {words(volume['crop'][1])}\n"
    if volume["unit"]:
        fields += f"opacityUnitDistance {volume['unit']}\n"
    place = " ".join(f"{name} {words(value)}" for name, value in volume["place"].items())
    back = volume.get("turned", ())  # a rotation, or a scale of mirrors
    turned = f"{'rotation' if len(back) == 4 else 'scale'} {words(back)}" if back else ""
    return transform(place, transform(turned, f"VolumeData {{ {fields} }}\n"))


def text_of(world):
    content = transform(world["inside"], "".join(world["lights"]) + "".join(map(volume_text, world["volumes"])))
    return scene(NO_HEADLIGHT, transform(world["around"], world["eye"] + content))


# ---- smaller worlds


def smaller(world):
    """Worlds with something taken away, the most first."""
    for key in ("volumes", "lights"):
        for i in range(len(world[key])):
            if key == "lights" or len(world[key]) > 1:
                less = copy.deepcopy(world)
                del less[key][i]
                yield less
    for i, volume in enumerate(world["volumes"]):
        for key, plain in (("style", ""), ("crop", None), ("unit", 0), ("dimensions", (1, 1, 1)),
                           ("texels", volume["texels"][:2]), ("place", {"rotation": volume["place"].get("rotation", (0, 0, 1, 0))}),
                           ("place", {"rotation": (0, 0, 1, 0)})):
            if volume[key] != plain:
                less = copy.deepcopy(world)
                less["volumes"][i][key] = plain
                yield less
        for axis in range(3):
            if volume["size"][axis] > 2:
                yield with_half(world, i, axis)


def with_half(world, index, axis):
    """Half the voxels along an axis."""
    less = copy.deepcopy(world)
    volume = less["volumes"][index]
    w, h, d = volume["size"]
    size = list(volume["size"])
    size[axis] = max(size[axis] // 2, 2)
    volume["numbers"] = [volume["numbers"][(k * h + j) * w + i] for k in range(size[2]) for j in range(size[1])
                         for i in range(size[0])]
    volume["size"] = tuple(size)
    return less


def shrunk(world, fails, most=60):
    """The smallest world found that still fails."""
    tries = 0
    again = True
    while again and tries < most:
        again = False
        for less in smaller(world):
            tries += 1
            if fails(less):
                world, again = less, True
                break
            if tries >= most:
                break
    return world
