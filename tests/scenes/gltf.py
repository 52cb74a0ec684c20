#!/usr/bin/env python3
"""glTF files, drawn: gltf.py PLUGRAY [CASE...]"""

import base64
import gzip
import json
import math
import struct
import zlib

from harness import Suite

suite = Suite()

BYTE, UBYTE, USHORT, UINT, FLOAT = 5120, 5121, 5123, 5125, 5126
FORMATS = {BYTE: "b", UBYTE: "B", USHORT: "H", UINT: "I", FLOAT: "f"}
TYPES = {1: "SCALAR", 2: "VEC2", 3: "VEC3", 4: "VEC4"}
RED, GREEN, BLUE, WHITE = (1, 0, 0, 1), (0, 1, 0, 1), (0, 0, 1, 1), (1, 1, 1, 1)


class Model:
    """Writes glTF."""

    def __init__(self):
        self.data = bytearray()
        self.json = {"asset": {"version": "2.0"}, "scenes": [{"nodes": []}]}

    def add(self, table, item):
        self.json.setdefault(table, []).append(item)
        return len(self.json[table]) - 1

    def view(self, data):
        self.data += b"\0" * (-len(self.data) % 4)
        self.data += data
        return self.add("bufferViews", {"buffer": 0, "byteOffset": len(self.data) - len(data),
                                        "byteLength": len(data)})

    def accessor(self, values, component=FLOAT, **more):
        rows = [v if isinstance(v, (list, tuple)) else (v,) for v in values]
        flat = [number for row in rows for number in row]
        view = self.view(struct.pack(f"<{len(flat)}{FORMATS[component]}", *flat))
        return self.add("accessors", {"bufferView": view, "componentType": component,
                                      "count": len(rows), "type": TYPES[len(rows[0])], **more})

    def mesh(self, *primitives):
        return self.add("meshes", {"primitives": primitives})

    def node(self, **node):
        self.json["scenes"][0]["nodes"].append(self.add("nodes", node))
        return self

    def unlit(self, color=WHITE, **more):
        return self.material(extensions={"KHR_materials_unlit": {}},
                             pbrMetallicRoughness={"baseColorFactor": color, **more.pop("pbr", {})},
                             **more)

    def material(self, **material):
        return self.add("materials", material)

    def text(self, uri=None):
        whole = uri or "data:application/octet-stream;base64," + base64.b64encode(self.data).decode()
        return json.dumps({**self.json, "buffers": [{"byteLength": len(self.data), "uri": whole}]},
                          indent=1)

    def glb(self):
        text = json.dumps({**self.json, "buffers": [{"byteLength": len(self.data)}]}).encode()
        text += b" " * (-len(text) % 4)
        data = bytes(self.data) + b"\0" * (-len(self.data) % 4)
        size = 12 + 8 + len(text) + 8 + len(data)
        return (struct.pack("<4sII", b"glTF", 2, size) +
                struct.pack("<II", len(text), 0x4E4F534A) + text +
                struct.pack("<II", len(data), 0x004E4942) + data)


def box(model, half=1.0, normals=True, **primitive):
    """Six faces of four vertices each."""
    points, outward, corners = [], [], []
    for axis in range(3):
        for sign in (1, -1):
            n = [sign * (k == axis) for k in range(3)]
            u = [int(k == (axis + 1) % 3) for k in range(3)]
            w = [n[1] * u[2] - n[2] * u[1], n[2] * u[0] - n[0] * u[2], n[0] * u[1] - n[1] * u[0]]
            first = len(points)
            for a, b in ((-1, -1), (1, -1), (1, 1), (-1, 1)):
                points.append([half * (n[k] + a * u[k] + b * w[k]) for k in range(3)])
                outward.append(n)
            corners += [first + k for k in (0, 1, 2, 0, 2, 3)]
    attributes = {"POSITION": model.accessor(points)}
    if normals:
        attributes["NORMAL"] = model.accessor(outward, BYTE)
    return {"attributes": attributes, "indices": model.accessor(corners, USHORT), **primitive}


def quad(model, size=1.0, uv=((0, 0), (1, 1)), **primitive):
    """A square at z = 0 that looks to the viewer; the image's first row is at its top."""
    (u0, v0), (u1, v1) = uv
    attributes = {
        "POSITION": model.accessor([(-size, -size, 0), (size, -size, 0), (size, size, 0), (-size, size, 0)]),
        "TEXCOORD_0": model.accessor([(u0, v1), (u1, v1), (u1, v0), (u0, v0)]),
    }
    attributes.update(primitive.pop("attributes", {}))
    return {"attributes": attributes, "indices": model.accessor([0, 1, 2, 0, 2, 3], UBYTE), **primitive}


def png(rows):
    """RGBA rows, components 0 to 1."""
    raw = b"".join(b"\0" + bytes(round(255 * c) for pixel in row for c in pixel) for row in rows)

    def chunk(name, data):
        return struct.pack(">I", len(data)) + name + data + struct.pack(">I", zlib.crc32(name + data))

    head = struct.pack(">IIBBBBB", len(rows[0]), len(rows), 8, 6, 0, 0, 0)
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head) + chunk(b"IDAT", zlib.compress(raw)) + chunk(b"IEND", b"")


FOUR = [[RED, GREEN], [BLUE, WHITE]]
QUARTERS = [(4, 4), (11, 4), (4, 11), (11, 11)]
NEAREST = {"magFilter": 9728, "minFilter": 9728}


def look(model, squares=1):
    """An orthographic view from z = 5 of a row of squares of side 2; `place` puts something there."""
    lens = {"xmag": squares, "ymag": 1, "znear": 0, "zfar": 20}
    camera = model.add("cameras", {"type": "orthographic", "orthographic": lens})
    model.squares = squares
    return model.node(camera=camera, translation=[0, 0, 5])


def place(model, square, **node):
    return model.node(translation=[2 * square - model.squares + 1, 0, 0], **node)


def probe_squares(model, pixels):
    """The colours of the same pixels of all squares, 16 by 16 each."""
    where = [(x + 16 * square, y) for square in range(model.squares) for x, y in pixels]
    colors = suite.probe(inlined("model.glb"), where, size=f"{16 * model.squares}x16",
                         files={"model.glb": model.glb()})
    return [colors[i:i + len(pixels)] for i in range(0, len(colors), len(pixels))]


def x3d(body):
    return "#X3D V4.0 utf8\n" + body


def inlined(name="model.gltf"):
    return x3d(f'Inline {{ url "{name}" }}')


# ---- shapes


@suite.case
def box_unlit():
    """a box of glTF covers the pixels of a Box"""
    model = Model()
    mesh = model.mesh(box(model, material=model.unlit((0.25, 0.5, 1, 1))))
    model.node(mesh=mesh, rotation=[0, math.sin(0.3), 0, math.cos(0.3)])
    mine = suite.picture(inlined(), files={"model.gltf": model.text()}, size="40x30")
    theirs = suite.picture(
        x3d("Transform { rotation 0 1 0 0.6 children Shape { appearance Appearance { material "
            "UnlitMaterial { emissiveColor 0.25 0.5 1 } } geometry Box { } } }"), size="40x30")
    suite.equal("", mine.values, theirs.values)
    suite.check("and something is drawn", theirs.at(20, 15) == (0.25, 0.5, 1, 1), theirs.at(20, 15))


PHYSICAL = {"baseColorFactor": [1, 0.5, 0.25, 1], "metallicFactor": 0.25, "roughnessFactor": 0.5}


@suite.case
def box_lit():
    """a physical material is X3D's own"""
    model = Model()
    mesh = model.mesh(box(model, material=model.material(pbrMetallicRoughness=PHYSICAL)))
    model.node(mesh=mesh, rotation=[0, math.sin(0.3), 0, math.cos(0.3)])
    mine = suite.picture(inlined("model.glb"), files={"model.glb": model.glb()}, size="40x30")
    theirs = suite.picture(
        x3d("Transform { rotation 0 1 0 0.6 children Shape { appearance Appearance { material "
            "PhysicalMaterial { baseColor 1 0.5 0.25 metallic 0.25 roughness 0.5 } } "
            "geometry Box { } } }"), size="40x30")
    suite.close("", mine.values, theirs.values)
    suite.check("and something is drawn", 0 < theirs.at(20, 15)[2] < theirs.at(20, 15)[0] < 1,
                theirs.at(20, 15))


@suite.case
def flat_normals():
    """without normals faces are flat"""
    pictures = []
    for normals in (True, False):
        model = Model()
        mesh = model.mesh(box(model, normals=normals, material=model.material(pbrMetallicRoughness=PHYSICAL)))
        model.node(mesh=mesh, rotation=[0, math.sin(0.3), 0, math.cos(0.3)])
        pictures.append(suite.picture(inlined(), files={"model.gltf": model.text()}, size="40x30"))
    suite.close("", pictures[1].values, pictures[0].values)


@suite.case
def matrices():
    """a matrix moves, turns and shears as its columns say"""
    model = Model()
    mesh = model.mesh(quad(model, 0.25, material=model.unlit(RED)))
    # x' = x + y / 2 + 1/2, y' = y - 1/4
    look(model).node(mesh=mesh, matrix=[1, 0, 0, 0, 0.5, 1, 0, 0, 0, 0, 1, 0, 0.5, -0.25, 0, 1])
    picture = suite.picture(inlined(), files={"model.gltf": model.text()}, size="64x64")
    wrong = 0
    for row in range(64):
        for column in range(64):
            x, y = (column + 0.5) / 32 - 1, 1 - (row + 0.5) / 32
            v = y + 0.25
            u = x - 0.5 - v / 2
            if min(abs(abs(u) - 0.25), abs(abs(v) - 0.25)) > 0.02:
                inside = abs(u) < 0.25 and abs(v) < 0.25
                wrong += picture.at(column, row)[3] != (1 if inside else 0)
    suite.equal("pixels elsewhere", wrong, 0)
    suite.equal("the middle", picture.at(47, 39), RED)


@suite.case
def mirrored():
    """a mirror turns no face around"""
    model = Model()
    mesh = model.mesh(quad(model, 0.75, material=model.unlit(RED)))
    look(model).node(mesh=mesh, scale=[-1, 1, 1])
    suite.equal("", suite.middle(inlined(), files={"model.gltf": model.text()}), RED)


@suite.case
def sides():
    """the back of a face is drawn where it is double-sided"""
    model = Model()
    look(model, 2)
    for i, double in enumerate((False, True)):
        mesh = model.mesh(quad(model, 0.75, material=model.unlit(RED, doubleSided=double)))
        place(model, i, mesh=mesh, rotation=[0, 1, 0, 0])
    suite.equal("", probe_squares(model, [(8, 8)]), [[(0, 0, 0, 0)], [RED]])


@suite.case
def modes():
    """strips, fans and lists cover the same square"""
    model = Model()
    look(model, 6)
    corners = [(-0.75, -0.75, 0), (0.75, -0.75, 0), (0.75, 0.75, 0), (-0.75, 0.75, 0)]
    material = model.unlit(RED)
    for i, (mode, order) in enumerate(((4, [0, 1, 2, 0, 2, 3]), (5, [0, 1, 3, 2]), (6, [0, 1, 2, 3]))):
        shape = quad(model, 0.75, material=material, mode=mode)
        shape["indices"] = model.accessor(order, UINT)
        place(model, 2 * i, mesh=model.mesh(shape))
        plain = {"attributes": {"POSITION": model.accessor([corners[k] for k in order])}}
        place(model, 2 * i + 1, mesh=model.mesh({**plain, "mode": mode, "material": material}))
    suite.equal("", probe_squares(model, QUARTERS + [(0, 8)]), [[RED] * 4 + [(0, 0, 0, 0)]] * 6)


# ---- colours and textures


@suite.case
def vertex_colors():
    """vertex colours multiply the colour of the material"""
    model = Model()
    shape = quad(model, material=model.unlit((0.5, 1, 0.5, 1)))
    shape["attributes"]["COLOR_0"] = model.accessor([(255, 51, 255)] * 4, UBYTE, normalized=True)
    look(model).node(mesh=model.mesh(shape))
    suite.close("", suite.middle(inlined(), files={"model.gltf": model.text()}), (0.5, 0.2, 0.5, 1))


def textured(model, image, **more):
    sampler = model.add("samplers", dict(NEAREST))
    texture = model.add("textures", {"source": model.add("images", image), "sampler": sampler})
    return model.unlit(pbr={"baseColorTexture": {"index": texture, **more}})


@suite.case
def textures():
    """the first row of an image is where v is 0, wherever the image is"""
    url = "data:image/png;base64," + base64.b64encode(png(FOUR)).decode()
    for name, image in (("data: uri", {"uri": url}), ("file", {"uri": "pictures/my%20image.png"}), ("view", None)):
        model = Model()
        if not image:
            image = {"bufferView": model.view(png(FOUR)), "mimeType": "image/png"}
        look(model).node(mesh=model.mesh(quad(model, material=textured(model, image))))
        files = {"sub/model.glb": model.glb(), "sub/pictures/my image.png": png(FOUR)}
        colors = suite.probe(inlined("sub/model.glb"), QUARTERS, files=files)
        suite.equal(name, colors, [RED, GREEN, BLUE, WHITE])


TRANSFORMS = (
    ({"offset": [0.5, 0]}, [GREEN, RED, WHITE, BLUE]),
    ({"scale": [0.5, 0.5]}, [RED] * 4),
    ({"scale": [0.5, 0.5], "offset": [0, 0.5]}, [BLUE] * 4),
    # counterclockwise as one looks at the image: u' = v, v' = 1 - u
    ({"rotation": math.pi / 2, "offset": [0, 1]}, [BLUE, RED, WHITE, GREEN]),
)


@suite.case
def texture_transforms():
    """KHR_texture_transform moves, turns and scales"""
    model = Model()
    look(model, len(TRANSFORMS))
    image = {"bufferView": model.view(png(FOUR)), "mimeType": "image/png"}
    for i, (transform, _) in enumerate(TRANSFORMS):
        material = textured(model, image, extensions={"KHR_texture_transform": transform})
        place(model, i, mesh=model.mesh(quad(model, material=material)))
    for (transform, expected), colors in zip(TRANSFORMS, probe_squares(model, QUARTERS)):
        suite.equal(f"{transform}", colors, expected)


@suite.case
def wrapping():
    """samplers repeat, mirror and clamp"""
    model = Model()
    look(model, 3)
    image = {"bufferView": model.view(png([[RED, GREEN]])), "mimeType": "image/png"}
    for i, wrap in enumerate((10497, 33648, 33071)):
        material = textured(model, image)
        model.json["samplers"][i].update(wrapS=wrap)
        place(model, i, mesh=model.mesh(quad(model, uv=((0, 0), (2, 1)), material=material)))
    # u = 0.19 and 1.06
    suite.equal("", probe_squares(model, [(1, 8), (8, 8)]), [[RED, RED], [RED, GREEN], [RED, GREEN]])


ALPHAS = (
    ({}, [WHITE, WHITE]),
    ({"alphaMode": "MASK"}, [(0, 0, 0, 0), WHITE]),
    ({"alphaMode": "MASK", "alphaCutoff": 0.1}, [WHITE, WHITE]),
    ({"alphaMode": "BLEND"}, [(0.2,) * 4, (0.6,) * 4]),
)


@suite.case
def alpha_modes():
    """OPAQUE, MASK and BLEND"""
    model = Model()
    look(model, len(ALPHAS))
    image = {"bufferView": model.view(png([[(1, 1, 1, 0.2), (1, 1, 1, 0.6)]])), "mimeType": "image/png"}
    for i, (mode, _) in enumerate(ALPHAS):
        material = textured(model, image)
        model.json["materials"][material].update(mode)
        place(model, i, mesh=model.mesh(quad(model, material=material)))
    for (mode, expected), colors in zip(ALPHAS, probe_squares(model, [(4, 8), (11, 8)])):
        suite.close(f"{mode}", [c for color in colors for c in color],
                    [c for color in expected for c in color], 0.003)


@suite.case
def two_sets():
    """each texture of a material finds its own set of coordinates"""
    model = Model()
    images = [model.add("images", {"bufferView": model.view(png(rows)), "mimeType": "image/png"})
              for rows in ([[RED, (0, 0, 0, 1)]], [[(0, 0, 0, 1), GREEN]])]
    sampler = model.add("samplers", dict(NEAREST))
    first, second = (model.add("textures", {"source": i, "sampler": sampler}) for i in images)
    material = model.material(
        pbrMetallicRoughness={"baseColorFactor": [0, 0, 0, 1], "metallicFactor": 1, "roughnessFactor": 1,
                              "baseColorTexture": {"index": first}},
        emissiveFactor=[1, 1, 1], emissiveTexture={"index": second, "texCoord": 1})
    shape = quad(model, material=material)
    upright = model.accessor([(1, 0), (1, 0), (0, 0), (0, 0)])  # u runs down the square
    shape["attributes"]["TEXCOORD_1"] = upright
    look(model).node(mesh=model.mesh(shape))
    colors = suite.probe(inlined("model.glb"), QUARTERS, files={"model.glb": model.glb()})
    suite.equal("", [round(c[1]) for c in colors], [0, 0, 1, 1])


# ---- cameras, lights, names


@suite.case
def cameras():
    """the angle of a camera is that of the picture's height"""
    angle = 0.8
    for size in ("40x20", "20x40"):
        width, height = map(int, size.split("x"))
        model = Model()
        camera = model.add("cameras", {"type": "perspective", "perspective": {"yfov": angle, "znear": 0.1}})
        model.node(camera=camera, translation=[0, 0, 4])
        model.node(mesh=model.mesh(quad(model, 0.8, material=model.unlit(RED))))
        picture = suite.picture(inlined(), files={"model.gltf": model.text()}, size=size)
        column = sum(picture.at(width // 2, y)[3] for y in range(height))
        suite.close(size, column, 0.8 / (4 * math.tan(angle / 2)) * height, 1.01)


@suite.case
def alone():
    """a file without a camera is seen whole when it is opened by itself"""
    model = Model()
    mesh = model.mesh(quad(model, 1.0, material=model.unlit(RED)))
    model.node(mesh=mesh, translation=[100, 50, 0], scale=[20, 20, 20])
    for name, content in (("a.gltf", model.text().encode()), ("a.glb", model.glb()),
                          ("a", gzip.compress(model.glb()))):
        result = suite.command("render", name, "--size", "32x32", "-o", "p.npy", "--no-cache", files={name: content})
        with open(f"{result.folder}/p.npy", "rb") as file:
            data = file.read()
        values = struct.unpack(f"<{32 * 32 * 4}f", data[-32 * 32 * 16:])
        covered = sum(values[3::4])
        edge = sum(values[4 * i + 3] for i in range(32))
        suite.check(name, 300 < covered < 900 and edge == 0, covered, edge)


@suite.case
def lights():
    """lights are those of X3D"""
    for light, node in (
        ({"type": "directional", "color": [1, 0.5, 0.25], "intensity": 2},
         "DirectionalLight { color 1 0.5 0.25 intensity 2 global TRUE }"),
        ({"type": "point", "intensity": 9},
         "PointLight { intensity 9 attenuation 0 0 1 radius 1000 }"),
        ({"type": "spot", "intensity": 9, "range": 50, "spot": {"innerConeAngle": 0.1, "outerConeAngle": 0.3}},
         "SpotLight { intensity 9 attenuation 0 0 1 radius 50 beamWidth 0.1 cutOffAngle 0.3 }"),
    ):
        model = Model()
        model.json["extensions"] = {"KHR_lights_punctual": {"lights": [light]}}
        material = model.material(pbrMetallicRoughness=PHYSICAL)
        shape = quad(model, material=material)
        shape["attributes"]["NORMAL"] = model.accessor([(0, 0, 1)] * 4)
        look(model).node(mesh=model.mesh(shape))
        model.node(translation=[0.25, 0, 3], extensions={"KHR_lights_punctual": {"light": 0}})
        head = x3d("NavigationInfo { headlight FALSE } ")
        mine = suite.picture(head + 'Inline { url "m.gltf" }', files={"m.gltf": model.text()})
        theirs = suite.picture(
            head + "OrthoViewpoint { position 0 0 5 } Transform { translation 0.25 0 3 children " + node +
            " } Shape { appearance Appearance { material PhysicalMaterial { baseColor 1 0.5 0.25 metallic "
            "0.25 roughness 0.5 } } geometry QuadSet { coord Coordinate { point [ -1 -1 0 1 -1 0 1 1 0 -1 1 0 "
            "] } normal Normal { vector [ 0 0 1 0 0 1 0 0 1 0 0 1 ] } } }")
        suite.close(light["type"], mine.values, theirs.values)
        suite.check(f"{light['type']} lights", theirs.at(9, 8)[0] > 0.01, theirs.at(9, 8))


@suite.case
def names():
    """nodes and materials are reached by their names"""
    model = Model()
    material = model.unlit(RED, name="Paint")
    look(model).node(mesh=model.mesh(quad(model, 0.75, material=material)), name="Square")
    files = {"model.gltf": model.text()}
    scene = x3d('DEF I Inline { url "model.gltf" } IMPORT I.Square AS S '
                "DEF P PositionInterpolator { key 0 keyValue 5 0 0 } ROUTE P.value_changed TO S.translation")
    suite.equal("IMPORT", suite.middle(scene, files=files), RED)
    result = suite.command("render", "model.gltf", "--size", "1x1", "--probe", "0,0", "--no-cache",
                           "--set", "Paint.emissiveColor=0 1 0", files=files)
    suite.equal("--set of a material", result.output.split(), ["0.00000000", "1.00000000"] * 1 +
                ["0.00000000", "1.00000000"])
    result = suite.command("render", "model.gltf", "--size", "1x1", "--probe", "0,0", "--no-cache",
                           "--set", "Square.translation=5 0 0", files=files)
    suite.equal("--set of a node", result.output.split(), ["0.00000000"] * 4)


@suite.case
def effects():
    """an effect beside the Inline changes what is inlined"""
    model = Model()
    look(model).node(mesh=model.mesh(quad(model, material=model.unlit(RED))))
    scene = x3d('Inline { url "model.gltf" } Effect { parts EffectPart { type "FRAGMENT" url '
                '"data:,void PLUG_fragment_modify(inout vec4 color) { color = color.brga; }" } }')
    suite.equal("", suite.middle(scene, files={"model.gltf": model.text()}), GREEN)


@suite.case
def own_attributes():
    """an effect reads what the file gives each vertex"""
    model = Model()
    shape = quad(model, material=model.unlit())
    shape["attributes"]["_HEAT"] = model.accessor([0, 0, 1, 1])
    look(model).node(mesh=model.mesh(shape))
    scene = x3d('Inline { url "model.gltf" } Effect { parts [ EffectPart { type "VERTEX" url "data:,'
                "attribute float _HEAT; varying float heat; void PLUG_vertex_eye_space(const in vec4 v, "
                'const in vec3 n) { heat = _HEAT; }" } EffectPart { type "FRAGMENT" url "data:,varying float '
                'heat; void PLUG_fragment_modify(inout vec4 color) { color = vec4(heat, 0.0, 0.0, 1.0); }" } ] }')
    suite.close("", [c[0] for c in suite.probe(scene, [(8, 0), (8, 15)], files={"model.gltf": model.text()})],
                [15.5 / 16, 0.5 / 16])


# ---- files


@suite.case
def other_files():
    """buffers and images lie beside the file, or are refused"""
    model = Model()
    look(model).node(mesh=model.mesh(quad(model, material=model.unlit(RED))))
    data = bytes(model.data)
    files = {"sub/my model.gltf": model.text("part%201.bin"), "sub/part 1.bin": data}
    suite.equal("beside the model", suite.middle(inlined("sub/my model.gltf"), files=files), RED)
    folder = suite.new_folder()
    files = {"scene/sub/m.gltf": model.text("../../outside.bin"), "outside.bin": data,
             "scene/main.x3dv": inlined("sub/m.gltf")}
    refused = suite.command("render", "scene/main.x3dv", "--probe", "0,0", "--size", "1x1", "--no-cache",
                            files=files, status=1, folder=folder)
    suite.check("outside the scene's folder", "[not-allowed]" in refused.errors and
                "scene/sub/m.gltf:" in refused.errors, refused.errors)
    allowed = suite.command("render", "scene/main.x3dv", "--allow", ".", "--probe", "0,0", "--size", "1x1",
                            "--no-cache", folder=folder)
    suite.equal("unless it is allowed", allowed.output.split()[0], "1.00000000")
    missing = suite.command("check", "m.gltf", files={"m.gltf": model.text("none.bin")}, status=1)
    suite.check("a missing file", "[missing-file]" in missing.errors and "m.gltf:" in missing.errors, missing.errors)
    network = suite.command("check", "m.gltf", files={"m.gltf": model.text("http://x/y.bin")}, status=1)
    suite.check("the network", "[not-allowed]" in network.errors, network.errors)


@suite.case
def the_rest_is_drawn():
    """a broken mesh beside a sound one"""
    model = Model()
    broken = quad(model)
    broken["indices"] = model.accessor([0, 1, 77], USHORT)
    look(model).node(mesh=model.mesh(broken, quad(model, material=model.unlit(RED))))
    result = suite.command("render", "m.glb", "--probe", "8,8", "--size", "16x16", "--no-cache",
                           files={"m.glb": model.glb()}, status=1)
    suite.equal("drawn", result.output.split()[:2], ["1.00000000", "0.00000000"])
    suite.check("reported", "m.glb:1:" in result.errors and "[bad-geometry]" in result.errors, result.errors)


suite.run()
