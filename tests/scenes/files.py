"""Writes image files for tests: PNG of any bit depth, and reads 8-bit PNG back."""

import struct
import zlib

SIGNATURE = b"\x89PNG\r\n\x1a\n"
COLOR_TYPES = {1: 0, 2: 4, 3: 2, 4: 6}  # components -> PNG's colour type


def chunk(kind, data):
    return struct.pack(">I", len(data)) + kind + data + struct.pack(
        ">I", zlib.crc32(kind + data) & 0xFFFFFFFF)


def png(width, height, components, samples, bits=8):
    """Samples top row first, components fastest."""
    code = "B" if bits == 8 else "H"
    row = width * components
    lines = b"".join(
        b"\0" + struct.pack(f">{row}{code}", *samples[y * row : (y + 1) * row])
        for y in range(height)
    )
    head = struct.pack(">2I5B", width, height, bits, COLOR_TYPES[components], 0, 0, 0)
    return SIGNATURE + chunk(b"IHDR", head) + chunk(b"IDAT", zlib.compress(lines)) + chunk(b"IEND", b"")


def unfilter(kind, line, before, step):
    """PNG's five filters; `before` is the line above."""
    for i in range(len(line)):
        a = line[i - step] if i >= step else 0
        b = before[i]
        c = before[i - step] if i >= step else 0
        if kind == 1:
            guess = a
        elif kind == 2:
            guess = b
        elif kind == 3:
            guess = (a + b) // 2
        elif kind == 4:
            p = a + b - c
            near = min((abs(p - a), 0, a), (abs(p - b), 1, b), (abs(p - c), 2, c))
            guess = near[2]
        else:
            guess = 0
        line[i] = (line[i] + guess) & 255
    return line


def read_png(path):
    """Width, height, components and the bytes of an 8-bit PNG that is not interlaced."""
    with open(path, "rb") as file:
        data = file.read()
    if data[:8] != SIGNATURE:
        raise ValueError(f"{path} is no PNG")
    at, packed, head = 8, b"", None
    while at < len(data):
        length, kind = struct.unpack_from(">I4s", data, at)
        body = data[at + 8 : at + 8 + length]
        at += 12 + length
        if kind == b"IHDR":
            head = struct.unpack(">2I5B", body)
        elif kind == b"IDAT":
            packed += body
    width, height, bits, color_type, _, _, interlaced = head
    if bits != 8 or interlaced:
        raise ValueError(f"{path}: {bits} bits, interlaced {interlaced}")
    components = {v: k for k, v in COLOR_TYPES.items()}[color_type]
    raw = zlib.decompress(packed)
    step, row = components, width * components
    before, result = bytearray(row), bytearray()
    for y in range(height):
        start = y * (row + 1)
        before = unfilter(raw[start], bytearray(raw[start + 1 : start + 1 + row]), before, step)
        result += before
    return width, height, components, bytes(result)
