"""Curved fields of a place in own coordinates of a box of sides 0.64, 0.5, 0.56."""

import math

from harness import dot, unit

AXIS, WIDTH = unit((0.3, -0.4, -1.1)), 0.15  # V6
CENTRE, BREADTH = (0.07, -0.05, 0.11), 0.12  # V7
MIDDLE, RADIUS = (0.03, 0.01, -0.02), 0.22   # V8


def exponential(place):
    return math.exp(-(dot(AXIS, place) + 0.45) / WIDTH)


def distance(a, b):
    return math.sqrt(sum((x - y) ** 2 for x, y in zip(a, b)))


def bell(place, centre=CENTRE, breadth=BREADTH):
    return math.exp(-(distance(place, centre) / breadth) ** 2 / 2)


def parabola(place):
    return max(1 - (distance(place, MIDDLE) / RADIUS) ** 2, 0.0)


def solid(place):
    return 1.0 if distance(place, MIDDLE) < RADIUS else 0.0


def nearest(chord, centre):
    """How near the ray comes to a place, and how far along it that is."""
    way = dot(chord.direction, tuple(c - e for c, e in zip(centre, chord.entry)))
    return distance(chord.at(way), centre), way
