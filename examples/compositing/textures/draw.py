#!/usr/bin/env python3
"""Draws the textures of these scenes, anew and always the same: draw.py [FOLDER]

All tile. bricks-normal.png holds the normal in red, green and blue and the height in alpha;
waves-normal.png is a book of 16 normal maps, row by row from the top left, one period of waves in time."""

import math
import os
import struct
import sys
import zlib


def write_png(path, width, height, components, pixel):
    """pixel(x, y) gives `components` numbers of 0..1; y runs down."""
    rows = bytearray()
    for y in range(height):
        rows.append(0)
        for x in range(width):
            for value in pixel(x, y):
                rows.append(max(0, min(255, round(value * 255))))
    kind = {1: 0, 2: 4, 3: 2, 4: 6}[components]

    def chunk(name, data):
        return struct.pack(">I", len(data)) + name + data + struct.pack(">I", zlib.crc32(name + data))

    with open(path, "wb") as file:
        file.write(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, kind, 0, 0, 0)) +
                   chunk(b"IDAT", zlib.compress(bytes(rows), 9)) + chunk(b"IEND", b""))


# ---- Noise that tiles ----


def hashed(x, y, seed):
    """A number of 0..1 for a point of a grid."""
    n = (x * 374761393 + y * 668265263 + seed * 2147483647) & 0xFFFFFFFF
    n = ((n ^ (n >> 13)) * 1274126177) & 0xFFFFFFFF
    return ((n ^ (n >> 16)) & 0xFFFF) / 65535


def smooth(t):
    return t * t * (3 - 2 * t)


def value_noise(u, v, cells, seed):
    """Value noise of a torus: u, v in turns, `cells` grid cells a turn."""
    x, y = u * cells, v * cells
    i, j = math.floor(x), math.floor(y)
    s, t = smooth(x - i), smooth(y - j)
    corner = [hashed((i + a) % cells, (j + b) % cells, seed) for b in (0, 1) for a in (0, 1)]
    return (corner[0] * (1 - s) + corner[1] * s) * (1 - t) + (corner[2] * (1 - s) + corner[3] * s) * t


def turbulence(u, v, cells, octaves, seed):
    total, weight = 0.0, 0.0
    for octave in range(octaves):
        part = 0.5 ** octave
        total += part * value_noise(u, v, cells << octave, seed + octave)
        weight += part
    return total / weight


def mix(a, b, t):
    return [x + (y - x) * t for x, y in zip(a, b)]


# ---- Pictures ----

BRICKS = 128
ROWS, COLUMNS = 6, 3
MORTAR = 0.055


def brick(u, v):
    """Height, and a number for the brick (-1: mortar)."""
    row = math.floor(v * ROWS)
    x = u * COLUMNS + 0.5 * (row % 2)
    column = math.floor(x)
    inside = [min(x - column, column + 1 - x) * ROWS / COLUMNS, min(v * ROWS - row, row + 1 - v * ROWS)]
    edge = min(inside)
    rough = 0.18 * (turbulence(u, v, 8, 3, 5) - 0.5)
    if edge < MORTAR:
        return 0.1 + 0.3 * rough, -1
    return 0.1 + 0.75 * min(1, (edge - MORTAR) / 0.07) ** 0.5 + rough, row * COLUMNS + column % COLUMNS


def brick_color(x, y):
    u, v = (x + 0.5) / BRICKS, (y + 0.5) / BRICKS
    _, number = brick(u, v)
    grain = turbulence(u, v, 16, 3, 11)
    if number < 0:
        return mix((0.52, 0.50, 0.46), (0.72, 0.70, 0.65), grain)
    base = mix((0.50, 0.20, 0.13), (0.74, 0.36, 0.22), hashed(number, 3, 7))
    return mix(base, [c * 0.6 for c in base], 0.8 * grain)


def normal_of(height, u, v, step, scale):
    """The unit normal of a height field, and as a colour."""
    du = (height(u + step, v) - height(u - step, v)) / (2 * step)
    dv = (height(u, v - step) - height(u, v + step)) / (2 * step)  # t runs up, rows run down
    n = (-du * scale, -dv * scale, 1)
    length = math.sqrt(sum(c * c for c in n))
    return [c / length * 0.5 + 0.5 for c in n]


def brick_normal(x, y):
    u, v = (x + 0.5) / BRICKS, (y + 0.5) / BRICKS
    height = brick(u, v)[0]
    return normal_of(lambda a, b: brick(a % 1, b % 1)[0], u, v, 0.6 / BRICKS, 0.022) + [height]


GROUND = 96


def grass(x, y):
    u, v = x / GROUND, y / GROUND
    blades = value_noise(u, v, 48, 21) * 0.6 + value_noise(u, v * 0.5, 24, 23) * 0.4
    patch = turbulence(u, v, 4, 3, 22)
    return mix(mix((0.13, 0.26, 0.06), (0.32, 0.45, 0.12), patch), (0.55, 0.62, 0.22), 0.55 * blades ** 2)


def rock(x, y):
    u, v = x / GROUND, y / GROUND
    layers = turbulence(u, v, 4, 5, 31)
    cracks = abs(turbulence(u, v, 6, 4, 37) - 0.5) * 2
    color = mix((0.30, 0.27, 0.25), (0.58, 0.54, 0.49), layers)
    return mix([c * 0.45 for c in color], color, min(1, cracks * 4))


def snow(x, y):
    u, v = x / GROUND, y / GROUND
    return mix((0.80, 0.85, 0.93), (0.99, 0.99, 1.0), turbulence(u, v, 5, 4, 41))


WINDOW = 256


def window(x, y):
    """Stained glass, what a spot light throws: the mean of nine points a pixel."""
    points = [glass(2 * (x + (i + 0.5) / 3) / WINDOW - 1, 1 - 2 * (y + (j + 0.5) / 3) / WINDOW)
              for i in range(3) for j in range(3)]
    return [sum(c) / 9 for c in zip(*points)]


def glass(s, t):
    r, angle = math.hypot(s, t), math.atan2(t, s)
    if r > 0.96:
        return (0, 0, 0)
    petal = angle / (2 * math.pi) * 8
    from_lead = min(petal - math.floor(petal), math.ceil(petal) - petal) * 2 * math.pi / 8 * r
    ring = min(abs(r - edge) for edge in (0.22, 0.58, 0.96))
    if ring < 0.025 or (r > 0.22 and from_lead < 0.02):
        return (0.02, 0.02, 0.02)
    colors = ((0.95, 0.20, 0.12), (0.98, 0.75, 0.15), (0.15, 0.45, 0.95), (0.15, 0.75, 0.30))
    if r < 0.22:
        return (1.0, 0.85, 0.35)
    sector = math.floor(petal) % 8
    color = colors[sector % 4] if r < 0.58 else colors[(sector + 2) % 4]
    return [c * (0.85 + 0.15 * hashed(sector, int(r > 0.58), 3)) for c in color]


STILL = 192


def still_life(x, y):
    """A window sill with a few fruits, from circles and light."""
    s, t = (x + 0.5) / STILL, 1 - (y + 0.5) / STILL
    color = mix((0.36, 0.42, 0.55), (0.78, 0.80, 0.82), t)
    if abs(s - 0.74) < 0.18 and 0.45 < t < 0.95:
        color = mix((0.55, 0.78, 0.97), (0.93, 0.97, 1.0), (t - 0.45) * 2)
        if abs(s - 0.74) < 0.008 or abs(t - 0.70) < 0.008:
            color = (0.35, 0.24, 0.15)
    if t < 0.30:
        plank = math.floor((s + 0.2 * t) * 5)
        color = mix((0.45, 0.29, 0.16), (0.62, 0.42, 0.24), hashed(plank, 1, 9))
        color = mix(color, [0.7 * c for c in color], turbulence(s, t * 0.2, 32, 2, 51))
    fruits = ((0.30, 0.36, 0.16, (0.85, 0.16, 0.12)), (0.52, 0.30, 0.12, (0.95, 0.62, 0.10)),
              (0.17, 0.26, 0.10, (0.45, 0.66, 0.15)), (0.41, 0.22, 0.08, (0.42, 0.14, 0.36)))
    for cx, cy, r, skin in fruits:
        dx, dy = (s - cx) / r, (t - cy) / r
        shadow = math.hypot((s - cx - 0.3 * r) / (1.2 * r), (t - cy + 0.9 * r) / (0.35 * r))
        if t < 0.30 and shadow < 1 and dx * dx + dy * dy > 1:
            color = [c * (0.55 + 0.45 * shadow) for c in color]
    for cx, cy, r, skin in fruits:
        dx, dy = (s - cx) / r, (t - cy) / r
        if dx * dx + dy * dy < 1:
            dz = math.sqrt(1 - dx * dx - dy * dy)
            light = max(0, 0.45 * dx + 0.62 * dy + 0.64 * dz)
            shine = max(0, light) ** 40
            color = [c * (0.25 + 0.85 * light) + 0.7 * shine for c in skin]
    return color


PAGE, PAGES = 64, 4


def wave_normal(x, y):
    """Sixteen moments of a few waves whose directions and times close."""
    moment = y // PAGE * PAGES + x // PAGE
    u, v = (x % PAGE + 0.5) / PAGE, 1 - (y % PAGE + 0.5) / PAGE
    time = moment / (PAGES * PAGES)
    waves = ((1, 2, 1, 0.5), (-2, 1, 1, 0.45), (3, -1, 2, 0.25), (2, 4, 2, 0.18), (-4, 3, 3, 0.12), (5, 2, 3, 0.1))
    slope = [0.0, 0.0]
    for i, j, turns, height in waves:
        phase = 2 * math.pi * (i * u + j * v - turns * time) + i * j
        for axis, wave in enumerate((i, j)):
            slope[axis] += height * 0.22 * wave * math.cos(phase)
    n = (-slope[0], -slope[1], 1)
    length = math.sqrt(sum(c * c for c in n))
    return [c / length * 0.5 + 0.5 for c in n]


PICTURES = (("bricks.png", BRICKS, BRICKS, 3, brick_color), ("bricks-normal.png", BRICKS, BRICKS, 4, brick_normal),
            ("grass.png", GROUND, GROUND, 3, grass), ("rock.png", GROUND, GROUND, 3, rock),
            ("snow.png", GROUND, GROUND, 3, snow), ("window.png", WINDOW, WINDOW, 3, window),
            ("still-life.png", STILL, STILL, 3, still_life),
            ("waves-normal.png", PAGE * PAGES, PAGE * PAGES, 3, wave_normal))

if __name__ == "__main__":
    folder = sys.argv[1] if len(sys.argv) > 1 else os.path.dirname(os.path.abspath(__file__))
    for name, width, height, components, pixel in PICTURES:
        write_png(os.path.join(folder, name), width, height, components, pixel)
