#!/usr/bin/env python3
"""How deep floes overlap, from a scene and the final poses of any program: one JSON line
with pairs, mean_m, p99_m, max_m and sum_per_floe_m.

Depth of a pair: the least overlap over the sides, tops and bottoms of both prisms (separating axis test), so that a
floe pushed under another is not taken for one inside it; of level floes it is the overlap of their outlines.  Of a
floe and a wall: how far it reaches beyond it.  Only overlaps count; touching within 1e-9 m is none.
"""

import argparse
import collections
import csv
import json
import math

import scene_file

TOUCHING = 1e-9


def read_scene(path):
    """Floes as (thickness, outline), and the walls."""
    head, floes = scene_file.read(path)
    words = [line.split() for line in head]
    walls = [[float(x) for x in word[1:5]] for word in words if word and word[0] == "domain"]
    return [(float(floe.thickness), floe.outline) for floe in floes], walls[-1] if walls else None


class Prism:
    """A placed floe: its corners, and for each of its faces the outward normal and its offset."""

    def __init__(self, floe, row):
        thickness, outline = floe
        x, y, z, w = (float(row[k]) for k in ("qx", "qy", "qz", "qw"))
        turn = ((1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)),
                (2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)),
                (2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)))
        centre = [float(row[k]) for k in ("x", "y", "z")]

        def turned(u, v, h):
            return tuple(r[0] * u + r[1] * v + r[2] * h for r in turn)

        half = thickness / 2
        self.corners = [tuple(c + p for c, p in zip(centre, turned(u, v, h)))
                        for u, v in outline for h in (-half, half)]
        self.box = (min(c[0] for c in self.corners), min(c[1] for c in self.corners),
                    max(c[0] for c in self.corners), max(c[1] for c in self.corners))
        self.faces = []
        for i, (u, v) in enumerate(outline):
            du, dv = u - outline[i - 1][0], v - outline[i - 1][1]
            length = math.hypot(du, dv)
            if length > 0:
                self.add_face(turned(dv / length, -du / length, 0), self.corners[2 * i])
        self.add_face(turned(0, 0, 1), self.corners[1])
        self.add_face(turned(0, 0, -1), self.corners[0])

    def add_face(self, normal, point):
        self.faces.append((*normal, sum(n * p for n, p in zip(normal, point))))


def least_overlap(p, q, least):
    """Least overlap of q behind the faces of p, 0 when one of them parts the two."""
    for nx, ny, nz, offset in p.faces:
        depth = offset - min(nx * x + ny * y + nz * z for x, y, z in q.corners)
        if depth <= TOUCHING:
            return 0.0
        least = min(least, depth)
    return least


def pair_depth(p, q):
    least = least_overlap(p, q, math.inf)
    return least and least_overlap(q, p, least)


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
    floes, walls = read_scene(scene)
    with open(poses, encoding="utf-8", newline="") as lines:
        placed = [Prism(floes[int(row["id"])], row) for row in csv.DictReader(lines)]
    boxes = [p.box for p in placed]
    found = [pair_depth(placed[i], placed[j]) for i, j in near_pairs(boxes)]
    if walls:
        for b in boxes:
            found += [walls[0] - b[0], walls[1] - b[1], b[2] - walls[2], b[3] - walls[3]]
    return sorted(d for d in found if d > TOUCHING), len(placed)


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
    words = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    words.add_argument("scene", help="a text scene (bench/peers/README.md)")
    words.add_argument("poses", help="a table of the final poses, CSV")
    given = words.parse_args()
    print(json.dumps(measure(given.scene, given.poses)))
