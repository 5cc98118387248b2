#!/usr/bin/env python3
"""Colours of forces in the playback page are told apart by those who do not see red or green, and stand out.

Distances are CIEDE2000 (Sharma, Wu and Dalal 2005) of colours as they are seen with protanopia and deuteranopia
(Machado, Oliveira and Fernandes 2009, severity 1, of linear light); contrasts are those of WCAG 2.
"""
import itertools
import math
import os
import pathlib
import re
import unittest

SOURCE = pathlib.Path(os.environ["FRAM_SOURCE"])
SEEN = {
    "all": ((1, 0, 0), (0, 1, 0), (0, 0, 1)),
    "deuteranopia": ((0.367322, 0.860646, -0.227968), (0.280085, 0.672501, 0.047413), (-0.011820, 0.042940, 0.968881)),
    "protanopia": ((0.152286, 1.052583, -0.204868), (0.114503, 0.786281, 0.099216), (-0.003882, -0.048116, 1.051998)),
}
TO_XYZ = ((0.4124564, 0.3575761, 0.1804375), (0.2126729, 0.7151522, 0.0721750), (0.0193339, 0.1191920, 0.9503041))
WATER = (68, 114, 150)  # as the page draws it
APART = 12  # what colours that differ in hue and lightness have; 1 is just seen, side by side
CONTRAST = 3  # WCAG 2.2, 1.4.11


def linear(rgb):
    return [v / 12.92 if v <= 0.04045 else ((v + 0.055) / 1.055) ** 2.4 for v in (c / 255 for c in rgb)]


def times(matrix, vector):
    return [sum(a * b for a, b in zip(row, vector)) for row in matrix]


def lab(light):
    white = (0.95047, 1, 1.08883)
    ratio = [v / w for v, w in zip(times(TO_XYZ, light), white)]
    x, y, z = (v ** (1 / 3) if v > 0.008856 else 7.787 * v + 16 / 116 for v in ratio)
    return 116 * y - 16, 500 * (x - y), 200 * (y - z)


def lifted(chroma):
    return math.sqrt(chroma ** 7 / (chroma ** 7 + 25 ** 7))


def difference(one, other):
    """CIEDE2000 of two colours in L*a*b*."""
    (l1, a1, b1), (l2, a2, b2) = one, other
    stretch = 1.5 - 0.5 * lifted((math.hypot(a1, b1) + math.hypot(a2, b2)) / 2)
    c1, c2 = math.hypot(stretch * a1, b1), math.hypot(stretch * a2, b2)
    h1, h2 = (math.degrees(math.atan2(b, stretch * a)) % 360 for a, b in ((a1, b1), (a2, b2)))
    turn = (h2 - h1 + 180) % 360 - 180 if c1 * c2 else 0
    hue = 2 * math.sqrt(c1 * c2) * math.sin(math.radians(turn / 2))
    lightness, chroma = (l1 + l2) / 2, (c1 + c2) / 2
    middle = (h1 + turn / 2) % 360 if c1 * c2 else h1 + h2

    def cosine(degrees):
        return math.cos(math.radians(degrees))
    t = (1 - 0.17 * cosine(middle - 30) + 0.24 * cosine(2 * middle) + 0.32 * cosine(3 * middle + 6)
         - 0.2 * cosine(4 * middle - 63))
    by_l = (l2 - l1) / (1 + 0.015 * (lightness - 50) ** 2 / math.sqrt(20 + (lightness - 50) ** 2))
    by_c, by_h = (c2 - c1) / (1 + 0.045 * chroma), hue / (1 + 0.015 * chroma * t)
    blue = -2 * lifted(chroma) * math.sin(math.radians(60 * math.exp(-((middle - 275) / 25) ** 2)))
    return math.sqrt(by_l ** 2 + by_c ** 2 + by_h ** 2 + blue * by_c * by_h)


def seen(rgb, matrix):
    return lab([min(1, max(0, v)) for v in times(matrix, linear(rgb))])


def contrast(one, other):
    light = [sum(w * v for w, v in zip((0.2126, 0.7152, 0.0722), linear(rgb))) + 0.05 for rgb in (one, other)]
    return max(light) / min(light)


def rgb_of(text):
    return tuple(int(text[k:k + 2], 16) for k in (0, 2, 4))


class Colours(unittest.TestCase):
    def setUp(self):
        legend = (SOURCE / "viewer/src/legend.js").read_text(encoding="utf-8")
        listed = re.search(r"FORCE_COLOURS = \{(.*?)\}", legend)[1]
        self.forces = {name: rgb_of(text) for name, text in re.findall(r"(\w+): '#(\w+)'", listed)}
        constant = {name: rgb_of(text) for name, text in re.findall(r"\b([A-Z_]+) = '#(\w{6})'", legend)}
        self.forces["parted"], self.halo, self.mark = constant["GONE"], constant["HALO"], constant["MARK"]
        self.ink = constant["INK"]

    def test_the_measure(self):
        """Pairs of Sharma's table."""
        for one, other, expected in (((50, 2.6772, -79.7751), (50, 0, -82.7485), 2.0425),
                                     ((50, 2.5, 0), (73, 25, -18), 27.1492),
                                     ((60.2574, -34.0099, 36.2677), (60.4626, -34.1751, 39.4387), 1.2644)):
            self.assertAlmostEqual(difference(one, other), expected, delta=1e-4)

    def test_forces_are_told_apart(self):
        self.assertEqual(len(self.forces), 5)
        for eyes, matrix in SEEN.items():
            for (a, one), (b, other) in itertools.combinations(self.forces.items(), 2):
                self.assertGreater(difference(seen(one, matrix), seen(other, matrix)), APART, f"{a}, {b}: {eyes}")

    def test_forces_stand_out_of_what_is_under_them(self):
        """By their white edge, which stands out of water, and they of it."""
        self.assertGreater(contrast(self.halo, WATER), CONTRAST)
        for name, rgb in self.forces.items():
            self.assertGreater(contrast(rgb, self.halo), CONTRAST, name)

    def test_marks_stand_out_by_their_edge(self):
        self.assertGreater(contrast(self.mark, self.ink), CONTRAST)
        for under in (WATER, (255, 255, 255)):
            self.assertGreater(contrast(self.ink, under), CONTRAST, under)


unittest.main()
