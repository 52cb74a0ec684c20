"""Writes texture files for tests: DDS, BMP, TGA, GIF, Radiance HDR; and reads textures in scenes."""

import struct

from harness import read_probes
from scenes import NO_HEADLIGHT, effect, quad, scene

# ---- files of one picture; pixels are rows of tuples, the top row first


def bmp(rows):
    height, width = len(rows), len(rows[0])
    lines = b"".join(
        b"".join(bytes(p[2::-1]) for p in row) + b"\0" * (-3 * width % 4) for row in rows[::-1]
    )
    return struct.pack("<2sIHHIIiiHHIIiiII", b"BM", 54 + len(lines), 0, 0, 54, 40, width, height, 1,
                       24, 0, len(lines), 0, 0, 0, 0) + lines


def tga(rows):
    height, width = len(rows), len(rows[0])
    depth = 8 * len(rows[0][0])
    head = struct.pack("<BBBHHBHHHHBB", 0, 0, 2, 0, 0, 0, 0, 0, width, height, depth, 0x20)
    return head + b"".join(bytes(p[2::-1]) + bytes(p[3:]) for row in rows for p in row)


def gif(rows, palette):
    """Rows of indices below 4; a clear code before each keeps all codes at three bits."""
    height, width = len(rows), len(rows[0])
    bits, count = 0, 0
    for code in [c for row in rows for index in row for c in (4, index)] + [5]:
        bits |= code << count
        count += 3
    packed = bits.to_bytes((count + 7) // 8, "little")
    assert len(packed) < 256
    colors = b"".join(bytes(c) for c in palette)
    return (b"GIF89a" + struct.pack("<HHBBB", width, height, 0x81, 0, 0) + colors + b","
            + struct.pack("<HHHHB", 0, 0, width, height, 0)
            + b"\2" + bytes([len(packed)]) + packed + b"\0;")


def hdr(rows):
    """Pixels as four bytes: mantissas and exponent."""
    head = f"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y {len(rows)} +X {len(rows[0])}\n".encode()
    return head + b"".join(bytes(p) for row in rows for p in row)


# ---- DDS

RGB, RGBA, L, LA, A = 0x40, 0x41, 0x20000, 0x20001, 2


def dds(width, height, data, flags=RGBA, bits=32, masks=(0xFF, 0xFF00, 0xFF0000, 0xFF000000),
        four_cc=b"", depth=0, levels=0, cube=False, dxgi=None, faces=0xFE00):
    if dxgi is not None:
        four_cc = b"DX10"
    if four_cc:
        flags, bits, masks = 4, 0, (0, 0, 0, 0)
    caps2 = (faces if cube else 0) | (0x200000 if depth else 0)
    head = b"DDS " + struct.pack("<7I44x", 124, 0x1007, height, width, 0, depth, levels)
    head += struct.pack("<2I4s5I", 32, flags, four_cc, bits, *masks)
    head += struct.pack("<5I", 0x1000, caps2, 0, 0, 0)
    if dxgi is not None:
        head += struct.pack("<5I", dxgi, 4 if depth else 3, 4 if cube else 0, 1, 0)
    return head + data


# ---- reading in scenes


def strip(texture, expression, coords, sampler="sampler2D"):
    """A row of squares, whose colours are an expression of the sampler `tex` and of `at`, one of
    the coordinates each."""
    points = ", ".join(f"vec4({', '.join(map(str, (list(c) + [0, 0, 0])[:4]))})" for c in coords)
    code = (f"uniform {sampler} tex;\nvoid PLUG_fragment_modify(inout vec4 color) {{\n"
            f"const vec4 points[{len(coords)}] = vec4[]({points});\n"
            f"vec4 at = points[int(gl_FragCoord.x)];\ncolor = vec4({expression}); }}")
    shape = quad("UnlitMaterial { }", effect(code, f"initializeOnly SFNode tex {texture}"))
    return f"Transform {{ scale {len(coords)} 1 1 children [\n{shape}] }}\n"


def check_strips(suite, strips, files=None, tolerance=1e-4, status=0):
    """Strips: name, texture, expression, coordinates, expected colours (numbers for grey)[,
    sampler]. Returns the result of the command."""
    width, height = max(len(s[3]) for s in strips), len(strips)
    body = "".join(
        f"Transform {{ translation {len(coords) / 2} {y + 0.5} 0 children [\n"
        f"{strip(texture, expression, coords, *sampler)}] }}\n"
        for y, (_, texture, expression, coords, _, *sampler) in enumerate(strips)
    )
    view = f"OrthoViewpoint {{ position 0 0 10 fieldOfView 0 0 {width} {height} }}\n"
    pixels = [(x, height - 1 - y) for y, s in enumerate(strips) for x in range(len(s[3]))]
    where = [word for x, y in pixels for word in ("--probe", f"{x},{y}")]
    result = suite.render(scene(view, NO_HEADLIGHT, body), *where, size=f"{width}x{height}",
                          files=files, status=status)
    colors = iter(read_probes(result, len(pixels)))
    for name, _, _, coords, expected, *_ in strips:
        got = [next(colors)[:3] for _ in coords]
        want = [[e] * 3 if isinstance(e, (int, float)) else e[:3] for e in expected]
        suite.close(name, sum(map(list, got), []), sum(map(list, want), []), tolerance)
    return result
