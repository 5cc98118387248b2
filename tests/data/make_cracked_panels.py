#!/usr/bin/env python3
"""Writes tests/data/cracked_panels.gdf: the port half of a barge with a round bow, as WAMIT panels that end in
the water
plane.  Bottom and side are divided by unlike numbers,
    as a program meshes patch by patch: their chords leave cracks of
up to 47 mm along the bow in z = -12.  Length 160, beam 44, draught 12 m.  Usage: make_cracked_panels.py FILE"""

import math
import sys

AFT, BOW, RADIUS, DRAUGHT = -80.0, 58.0, 22.0, 12.0
ALONG_BOTTOM, ALONG_SIDE, ACROSS, ROWS = 8, 7, 2, 3
ARC_BOTTOM, ARC_SIDE = 12, 20


def steps(lo, hi, n):
    return [lo + (hi - lo) * i / n for i in range(n + 1)]


def arc(n):
    return [(BOW + RADIUS * math.sin(math.pi / 2 * i / n), RADIUS * math.cos(math.pi / 2 * i / n))
        for i in range(n + 1)]


def panels():
    x, y, z = steps(AFT, BOW, ALONG_BOTTOM), steps(0, RADIUS, ACROSS), steps(-DRAUGHT, 0, ROWS)
    for i in range(ALONG_BOTTOM):
        for j in range(ACROSS):
            yield [(x[i], y[j], -DRAUGHT), (x[i], y[j + 1], -DRAUGHT), (x[i + 1], y[j + 1], -DRAUGHT),
                (x[i + 1], y[j], -DRAUGHT)]
    rim = arc(ARC_BOTTOM)
    for p, q in zip(rim, rim[1:]):
        yield [(BOW, 0, -DRAUGHT), p + (-DRAUGHT,), q + (-DRAUGHT,), q + (-DRAUGHT,)]
    side = [(p, RADIUS) for p in steps(AFT, BOW, ALONG_SIDE)][:-1] + arc(ARC_SIDE)
    stern = [(AFT, p) for p in y]
    for line in (stern, side):
        for p, q in zip(line, line[1:]):
            for low, high in zip(z, z[1:]):
                yield [p + (low,), p + (high,), q + (high,), q + (low,)]


def main():
    rows = list(panels())
    with open(sys.argv[1], "w", encoding="ascii") as file:
        file.write("barge with a round bow, half, cracks between patches\n")
        file.write("1.0 9.81  ULEN GRAV\n0 1  ISX ISY\n%d\n" % len(rows))
        for row in rows:
            for corner in row:
                file.write("%.5f %.5f %.5f\n" % corner)


main()
