#!/usr/bin/env python3
"""How deep floes overlap, from a scene and the final poses of any program.

  bench/penetration.py SCENE POSES.csv       one JSON line: pairs, mean_m, p99_m, max_m, sum_per_floe_m

Plan view: every outline turned by its body's orientation and dropped on the plane.  Depth of a pair: the least overlap
over the edge normals of both (separating axis test); of a floe and a wall: how far it reaches beyond it.  Only overlaps
count; touching within 1e-9 m is none.
"""

import collections
import csv
import json
import math
import sys

TOUCHING = 1e-9


def read_scene(path):
    outlines, walls = [], None
    with open(path, encoding="utf-8") as lines:
        for line in lines:
            word = line.split()
            if word and word[0] == "floe":
                v = [float(x) for x in word[6:]]
                outlines.append(list(zip(v[0::2], v[1::2])))
            elif word and word[0] == "domain":
                walls = [float(x) for x in word[1:5]]
    return outlines, walls


def place(outline, row):
    """The outline of a floe in the global plan view."""
    x, y, z, w = (float(row[k]) for k in ("qx", "qy", "qz", "qw"))
    a, b = 1 - 2 * (y * y + z * z), 2 * (x * y - w * z)
    c, d = 2 * (x * y + w * z), 1 - 2 * (x * x + z * z)
    px, py = float(row["x"]), float(row["y"])
    return [(px + a * u + b * v, py + c * u + d * v) for u, v in outline]


def gap_beyond(p, q, least):
    """Least overlap of q along the normals of p's edges, or None when some normal parts them."""
    for i, (x, y) in enumerate(p):
        ex, ey = p[i - 1]
        nx, ny = y - ey, ex - x  # outward for counter-clockwise outlines: the edge runs from i - 1 to i
        length = math.hypot(nx, ny)
        if length == 0:
            continue
        depth = (nx * x + ny * y - min(nx * u + ny * v for u, v in q)) / length
        if depth <= TOUCHING:
            return None
        least = min(least, depth)
    return least


def pair_depth(p, q):
    least = gap_beyond(p, q, math.inf)
    least = least and gap_beyond(q, p, least)
    return least or 0.0


def near_pairs(boxes):
    """Pairs whose bounds overlap, by a grid of the largest box's size."""
    cell = max(max(b[2] - b[0], b[3] - b[1]) for b in boxes)
    grid = collections.defaultdict(list)
    for i, b in enumerate(boxes):
        at = (math.floor(b[0] / cell), math.floor(b[1] / cell))
        for dx in (-1, 0, 1):
            for dy in (-1, 0, 1):
                for j in grid[at[0] + dx, at[1] + dy]:
                    c = boxes[j]
                    if b[0] < c[2] and c[0] < b[2] and b[1] < c[3] and c[1] < b[3]:
                        yield i, j
        grid[at].append(i)


def depths(scene, poses):
    outlines, walls = read_scene(scene)
    with open(poses, encoding="utf-8", newline="") as lines:
        rows = list(csv.DictReader(lines))
    plans = [place(outlines[int(row["id"])], row) for row in rows]
    boxes = [(min(x for x, _ in p), min(y for _, y in p), max(x for x, _ in p), max(y for _, y in p)) for p in plans]
    found = [pair_depth(plans[i], plans[j]) for i, j in near_pairs(boxes)]
    if walls:
        for b in boxes:
            found += [walls[0] - b[0], walls[1] - b[1], b[2] - walls[2], b[3] - walls[3]]
    return sorted(d for d in found if d > TOUCHING), len(plans)


def measure(scene, poses):
    found, floes = depths(scene, poses)
    n = len(found)
    return {
        "pairs": n,
        "mean_m": sum(found) / n if n else 0.0,
        "p99_m": found[math.ceil(0.99 * n) - 1] if n else 0.0,
        "max_m": found[-1] if n else 0.0,
        "sum_per_floe_m": sum(found) / floes,
    }


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    print(json.dumps(measure(sys.argv[1], sys.argv[2])))
