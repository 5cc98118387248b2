#!/usr/bin/env python3
"""Makes tests/data/floes.geojson: an ice field as somebody might outline it in pictures, for tests of import and runs.

Generated, so that it belongs to nobody: 72 ragged floes of 20 to 600 corners, most of them concave, every ring open,
some clockwise, two that cross themselves.  Lengths are those of satellite pictures: times 0.01 they suit a ship.

    python3 tests/data/make_floes.py > tests/data/floes.geojson
"""
import json
import math
import random

random.seed(20260)
COLUMNS, ROWS, CELL = 12, 6, 12800.0  # of a grid that the floes stand on, jittered
CROSSED = {17, 40}  # floes whose outline crosses itself


def outline(corners, radius):
    """Radius against angle: a few waves, and a rough edge by a walk that closes; now and then a bay."""
    waves = [(k, random.gauss(0, 0.16 / k), random.uniform(0, 2 * math.pi)) for k in range(2, 7)]
    walk = [0.0]
    for _ in range(corners):
        walk.append(walk[-1] + random.gauss(0, 0.25 / math.sqrt(corners)))
    bay = random.uniform(0, 2 * math.pi) if random.random() < 0.4 else None
    points = []
    for i in range(corners):
        angle = 2 * math.pi * i / corners
        r = 1 + sum(a * math.cos(k * angle + phase) for k, a, phase in waves) + walk[i] - walk[-1] * i / corners
        if bay is not None:
            away = abs((angle - bay + math.pi) % (2 * math.pi) - math.pi)
            r *= 1 - 0.55 * math.exp(-((away / 0.22) ** 2))
        r = max(r, 0.25)
        points.append((radius * r * math.cos(angle), 0.8 * radius * r * math.sin(angle)))
    turn = random.uniform(0, 2 * math.pi)
    c, s = math.cos(turn), math.sin(turn)
    return [(c * x - s * y, s * x + c * y) for x, y in points]


features = []
for n in range(COLUMNS * ROWS):
    size = CELL * random.choice([0.22, 0.35, 0.42, 0.55])
    points = outline(int(20 * 30 ** random.random()), size)
    x = (n % COLUMNS + 0.5 - COLUMNS / 2 + random.uniform(-0.2, 0.2)) * CELL
    y = (n // COLUMNS + 0.5 - ROWS / 2 + random.uniform(-0.2, 0.2)) * 1.6 * CELL
    ring = [[round(x + px, 1), round(y + py, 1)] for px, py in points]
    if n % 7 == 3:
        ring.reverse()
    if n in CROSSED:
        ring[4], ring[9] = ring[9], ring[4]
    features.append(json.dumps({"type": "Feature", "properties": {"id": n},
                                "geometry": {"type": "Polygon", "coordinates": [ring]}}, separators=(",", ":")))
print('{"type":"FeatureCollection","features":[\n' + ",\n".join(features) + "\n]}")
