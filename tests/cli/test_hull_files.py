#!/usr/bin/env python3
"""Hull files as exporters write them: read, or refused with the right reason and a remedy that works on that
very file.

Every file is made here, with shapes whose volume, centre of buoyancy and water plane are known in closed form.
`--write FILE` also writes the table as a page of the manual (docs/hull-files.md)."""

import json
import math
import os
import random
import resource
import struct
import subprocess
import sys
import tempfile

FRAM = os.environ.get("FRAM", "fram")


# ---- shapes: vertices and polygons, counter-clockwise from outside ----

def box(x0, x1, y0, y1, z0, z1):
    v = [(x, y, z) for z in (z0, z1) for y in (y0, y1) for x in (x0, x1)]
    f = [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)]
    return v, f


def prism(outline, z0, z1):
    n = len(outline)
    v = [(x, y, z0) for x, y in outline] + [(x, y, z1) for x, y in outline]
    f = [tuple(range(n - 1, -1, -1)), tuple(range(n, 2 * n))]
    f += [(i, (i + 1) % n, n + (i + 1) % n, n + i) for i in range(n)]
    return v, f


def circle(radius, n, x=0.0, y=0.0):
    return [(x + radius * math.cos(2 * math.pi * i / n), y + radius * math.sin(2 * math.pi * i / n))
        for i in range(n)]


def wedge(length, beam, draught, freeboard):
    """A V: sharp keel in z = -draught, breadth beam in z = 0, straight sides to the deck."""
    top = 0.5 * beam * (draught + freeboard) / draught
    v = [(-length / 2, 0, -draught), (length / 2, 0, -draught), (-length / 2, top, freeboard), (length / 2,
        top, freeboard),
         (-length / 2, -top, freeboard), (length / 2, -top, freeboard)]
    return v, [(2, 3, 1, 0), (5, 4, 0, 1), (4, 5, 3, 2), (4, 2, 0), (3, 5, 1)]


def ellipsoid(a, b, c, n, m):
    v = [(0.0, 0.0, c)]
    for i in range(1, m):
        t = math.pi * i / m
        z = 0.0 if 2 * i == m else c * math.cos(t)
        v += [(a * math.sin(t) * math.cos(2 * math.pi * j / n), b * math.sin(t) * math.sin(2 * math.pi * j / n), z)
              for j in range(n)]
    v.append((0.0, 0.0, -c))
    f = [(0, 1 + j, 1 + (j + 1) % n) for j in range(n)]
    for i in range(m - 2):
        for j in range(n):
            p, q = 1 + i * n + j, 1 + i * n + (j + 1) % n
            f += [(p, p + n, q), (q, p + n, q + n)]
    last = len(v) - 1
    f += [(last, last - n + (j + 1) % n, last - n + j) for j in range(n)]
    return v, f


def join(*parts):
    v, f = [], []
    for pv, pf in parts:
        f += [tuple(i + len(v) for i in face) for face in pf]
        v += pv
    return v, f


def triangles(shape):
    return [(face[0], face[i], face[i + 1]) for face in shape[1] for i in range(1, len(face) - 1)]


def turned(shape):
    return shape[0], [tuple(reversed(face)) for face in shape[1]]


def moved(shape, dx=0.0, dy=0.0, dz=0.0, scale=1.0):
    return [(scale * (x + dx), scale * (y + dy), scale * (z + dz)) for x, y, z in shape[0]], shape[1]


# ---- formats ----

def stl_text(shape, end="\n", number="%.6e", noise=0.0):
    lines, wobble = ["solid exported by a program"], 0
    for t in triangles(shape):
        lines += ["  facet normal 0.0 0.0 0.0", "    outer loop"]
        for i in t:
            p = []
            for c in shape[0][i]:
                wobble = (wobble * 1103515245 + 12345) % 2147483648
                p.append(c + noise * (wobble / 1073741824 - 1))
            lines.append("      vertex " + " ".join(number % c for c in p))
        lines += ["    endloop", "  endfacet"]
    return (end.join(lines + ["endsolid exported by a program", ""])).encode()


def stl_binary(shape, header=b"binary", attribute=0, normal=(0, 0, 0)):
    faces = triangles(shape)
    out = [header.ljust(80, b" "), struct.pack("<I", len(faces))]
    for t in faces:
        out.append(struct.pack("<12fH", *normal, *[c for i in t for c in shape[0][i]], attribute))
    return b"".join(out)


def obj(shape, negative=False, extras=False):
    lines = ["# exported", "mtllib hull.mtl", "o hull"] if extras else []
    lines += ["v %.9g %.9g %.9g" % p for p in shape[0]]
    if extras:
        lines += ["vt 0.0 0.0", "vn 0 0 1", "g side", "usemtl steel", "s off"]
    n = len(shape[0])
    for face in shape[1]:
        number = [i - n if negative else i + 1 for i in face]
        lines.append("f " + " ".join("%d/1/1" % i if extras else "%d" % i for i in number))
    return "\n".join(lines + [""]).encode()


def gdf(panels, isx, isy, words=("", "", ""), second=None, gravity=9.80665):
    lines = ["exported panels", f"1.000000 {gravity:.6f}" + words[0], "%d %d" % (isx, isy) + words[1],
             "%d" % len(panels) + ("" if second is None else " %d" % second) + words[2]]
    for p in panels:
        corner = list(p) + [p[-1]] * (4 - len(p))
        lines += ["%12.6f %12.6f %12.6f" % c for c in corner]
    return "\n".join(lines + [""]).encode()


def half_box_panels(length, beam, draught, n, m, crack=0):
    """Bottom, side and ends of the port half of a box, down from z = 0; the side's panels are divided
    otherwise than the
    bottom's, and with `crack` its lower edge is bowed off by that much: cracks as in panels of separate patches."""
    l, b = length / 2, beam / 2
    xs, xn = [-l + length * i / n for i in range(n + 1)], [-l + length * i / m for i in range(m + 1)]
    low = [-draught + (crack * 4 * (i / m) * (1 - i / m) if crack else 0) for i in range(m + 1)]
    p = [[(xs[i], 0, -draught), (xs[i], b, -draught), (xs[i + 1], b, -draught), (xs[i + 1], 0, -draught)]
         for i in range(n)]
    p += [[(xn[i], b, low[i]), (xn[i], b, 0), (xn[i + 1], b, 0), (xn[i + 1], b, low[i + 1])] for i in range(m)]
    p += [[(l, 0, -draught), (l, b, -draught), (l, b, 0), (l, 0, 0)]]
    p += [[(-l, b, -draught), (-l, 0, -draught), (-l, 0, 0), (-l, b, 0)]]
    return p


def fanned(outline, z0, z1):
    """A prism whose lids are fans about a corner in their middle, (0, 0)."""
    v, f = prism(outline, z0, z1)
    n = len(outline)
    lids = [face for i in range(n) for face in ((2 * n, (i + 1) % n, i), (2 * n + 1, n + i, n + (i + 1) % n))]
    return v + [(0.0, 0.0, z0), (0.0, 0.0, z1)], f[2:] + lids


def noisy(shape, most, seed=1):
    """Every corner of every triangle off by itself: a corner that many share has as many copies."""
    chance = random.Random(seed)
    corner = [tuple(c + chance.uniform(-most, most) for c in shape[0][i]) for t in triangles(shape) for i in t]
    return corner, [(i, i + 1, i + 2) for i in range(0, len(corner), 3)]


def column_panels(x, y, radius, draught, n, rings):
    """The wet part of an upright round column, fine at the waterline."""
    c = circle(radius, n, x, y)
    zs = [-draught] + [-draught * (1 - i / rings) ** 3 for i in range(1, rings + 1)]
    p = [[(x, y, -draught), c[(i + 1) % n] + (-draught,), c[i] + (-draught,)] for i in range(n)]
    for k in range(rings):
        p += [[c[i] + (zs[k],), c[(i + 1) % n] + (zs[k],), c[(i + 1) % n] + (zs[k + 1],), c[i] + (zs[k + 1],)]
              for i in range(n)]
    return p


# ---- closed forms ----

def polygon_area(n, radius):
    return 0.5 * n * radius * radius * math.sin(2 * math.pi / n)


BOX = box(-20, 20, -5, 5, -3, 2)
BOX_FLOATS = {"volume": 1200, "kb": 1.5, "plane": 400, "bm": 10 ** 2 / 36}


def plated_box(n):
    """The box of strips across: n slivers, each cut in two triangles, on deck and bottom."""
    x = [-20 + 40 * i / n for i in range(n + 1)]
    v = [(p, y, z) for z in (-3.0, 2.0) for p in x for y in (-5.0, 5.0)]
    top, f = 2 * (n + 1), [(0, 2 * n + 2, 2 * n + 3, 1), (2 * n + 1, 4 * n + 3, 4 * n + 2, 2 * n)]
    for i in range(n):
        p, q = 2 * i, 2 * i + 1
        f += [(p, q, q + 2, p + 2), (top + p, top + p + 2, top + q + 2, top + q)]
        f += [(p, p + 2, top + p + 2, top + p), (q + 2, q, top + q, top + q + 2)]
    return v, f


def without(shape, *faces):
    return shape[0], [f for i, f in enumerate(shape[1]) if i not in faces]


def semi(touch):
    """Two pontoons and four columns: separate solids, or columns that stand on the pontoons."""
    parts = [box(-40, 40, y - 8, y + 8, -20, -12) for y in (-30, 30)]
    foot = -12 if touch else -11
    parts += [prism(circle(5, 48, x, y), foot, 15) for x in (-30, 30) for y in (-30, 30)]
    return join(*parts)


def semi_floats():
    column = polygon_area(48, 5)
    volume = 2 * 80 * 16 * 8 + 4 * column * 11
    return {"volume": volume, "plane": 4 * column, "kb": (2 * 80 * 16 * 8 * 4 + 4 * column * 11 * 14.5) / volume}


def ellipsoid_floats(a, b, c):
    return {"volume": 2 / 3 * math.pi * a * b * c, "plane": math.pi * a * b, "kb": 5 / 8 * c, "bm": 3 / 8 * b * b / c}


def bulb():
    """A bow with a bulb: a box, and a cylinder before it that grows out of its end (one skin)."""
    n = 16
    ring = [(0.8 * math.cos(2 * math.pi * i / n), -1.5 + 0.8 * math.sin(2 * math.pi * i / n)) for i in range(n)]
    v, f = BOX
    f = [face for face in f if face != (1, 3, 7, 5)]
    v = v + [(20.0, y, z) for y, z in ring] + [(24.0, y, z) for y, z in ring]
    s = 8
    f = f + [(s + i, s + (i + 1) % n, s + n + (i + 1) % n, s + n + i) for i in range(n)]
    f += [tuple(s + n + i for i in range(n))]
    # The end of the box around the ring, between its corners: -y -z, +y -z, +y +z, -y +z.
    corner = [7, 5, 1, 3]  # towards +y+z, -y+z, -y-z, +y-z by quarters of the ring from +y on
    for q in range(4):
        first = q * 4
        f += [(s + (first + k + 1) % n, s + first + k, corner[q]) for k in range(4)]
        f += [(s + (first + 4) % n, corner[q], corner[(q + 1) % 4])]
    return v, f


def moonpool():
    """A box with a square well through it."""
    outer, inner = [(-20, -5), (20, -5), (20, 5), (-20, 5)], [(-3, -2), (3, -2), (3, 2), (-3, 2)]
    v = [p + (z,) for z in (-3.0, 2.0) for p in outer + inner]
    f = []
    for i in range(4):
        j = (i + 1) % 4
        f += [(i, j, 8 + j, 8 + i), (4 + j, 4 + i, 12 + i, 12 + j), (j, i, 4 + i, 4 + j), (8 + i, 8 + j,
            12 + j, 12 + i)]
    return v, f


def keel_plates():
    """A box with bilge keels of 4 mm, each a solid of its own a millimetre off the side."""
    return join(BOX, box(-10, 10, 5.001, 5.4, -2.502, -2.498), box(-10, 10, -5.4, -5.001, -2.502, -2.498))


def moebius(n=24):
    v = []
    for i in range(n):
        a, h = 2 * math.pi * i / n, math.pi * i / n
        v += [((10 + w * math.cos(h)) * math.cos(a), (10 + w * math.cos(h)) * math.sin(a), w * math.sin(h))
            for w in (-2, 2)]
    f = [(2 * i, 2 * i + 1, 2 * i + 3, 2 * i + 2) for i in range(n - 1)]
    return v, f + [(2 * n - 2, 2 * n - 1, 0, 1)]


def ship_of(count):
    """A hull of about `count` triangles with a hollow bow."""
    n = int(math.sqrt(count))
    v, f = ellipsoid(100, 20, 10, n + n % 2, 2 * (n // 4))
    def waist(x, z):
        return 1 - (0.3 * math.exp(-((x - 70) / 15) ** 2) * (1 + z / 10) if z < 0 else 0)
    return [(x, y * waist(x, z), z) for x, y, z in v], f


def uneven(panels):
    """With the corners of z = 0 up to half a millimetre higher or lower, neighbours alike."""
    return [[(x, y, z or 5e-4 * math.sin(17 * x + 5 * y)) for x, y, z in panel] for panel in panels]


UNITS = (("feet", 0.3048, 32.174), ("inches", 0.0254, 386.09), ("centimetres", 0.01, 980.665),
         ("millimetres", 0.001, 9806.65))


def scaled(panels, factor):
    return [[tuple(factor * c for c in corner) for corner in panel] for panel in panels]


def shifted(panels, dx):
    return [[(x + dx, y, z) for x, y, z in panel] for panel in panels]


# ---- cases: name, what it is, bytes, arguments, expected ----

def read(floats=None, close=1e-6, **more):
    return dict(kind="read", floats=floats or {}, close=close, **more)


def refused(words, remedy=None, floats=None, close=1e-6):
    return dict(kind="refused", words=words, remedy=remedy, floats=floats or {}, close=close)


def cases():
    catamaran = join(box(-20, 20, -9, -6, -3, 2), box(-20, 20, 6, 9, -3, 2))
    fine = half_box_panels(40, 10, 3, 8, 8)
    lid = [(-20, 0, 0), (20, 0, 0), (20, 5, 0), (-20, 5, 0)]
    lidded = [[(x, y, z or 0.001) for x, y, z in p] for p in fine + [lid]]
    sides = [[BOX[0][i] for i in face] for face in without(BOX, 1)[1]]
    fore = [p for p in fine if min(c[0] for c in p) >= 0]
    whole = fine + [[(x, -y, z) for x, y, z in reversed(p)] for p in fine]
    columns = [p for x in (-30, 30) for y in (-30, 30) for p in column_panels(x, y, 5, 20, 2000, 2)]
    cylinder = {"volume": polygon_area(96, 4) * 3, "plane": polygon_area(96, 4), "kb": 1.5}
    cone = {"volume": 4 * polygon_area(2000, 5) * 20, "plane": 4 * polygon_area(2000, 5), "kb": 10}
    return [
        ("box_text.stl", "text STL, LF", stl_text(BOX), [], read(BOX_FLOATS)),
        ("box_crlf.stl", "text STL, CRLF, three digits after the point", stl_text(BOX, "\r\n", "%.3f"), [],
         read(BOX_FLOATS)),
        ("box_solid.stl", "binary STL whose header begins with \"solid\"", stl_binary(BOX,
         b"solid from a CAD program", 7), [],
         read(BOX_FLOATS)),
        ("box_normals.stl", "binary STL, normals that point inward", stl_binary(BOX, normal=(0, 0, -1)), [],
         read(BOX_FLOATS)),
        ("box_mm.stl", "binary STL in millimetres", stl_binary(moved(BOX, scale=1000.0)), ["--scale", "0.001"],
         read(BOX_FLOATS)),
        ("box_noise.stl", "text STL, corners of neighbours up to 20 micrometres apart", stl_text(BOX,
         number="%.7f", noise=1e-5), [],
         read(BOX_FLOATS, 1e-4)),
        *((f"fan_{n}.stl", f"binary STL, lids that are fans of {n} facets, corners up to 20 micrometres off",
           stl_binary(noisy(fanned(circle(5.5, n), -6, 4), 2e-5, seed=3)), [],
           read({"volume": 6 * polygon_area(n, 5.5), "plane": polygon_area(n, 5.5), "kb": 3}, 1e-4))
          for n in (100, 400)),
        ("wedge.obj", "OBJ, polygons, groups, vt and vn", obj(wedge(40, 10, 4, 2), extras=True), [],
         read({"volume": 800, "plane": 400, "kb": 8 / 3, "bm": 40 * 10 ** 3 / 12 / 800})),
        ("cylinder.obj", "OBJ, indices counted back from the end, lids of 96 corners", obj(prism(circle(4, 96), -3, 2),
         negative=True), [],
         read(cylinder)),
        ("catamaran.obj", "two hulls in one file", obj(catamaran), [],
         read({"volume": 720, "plane": 240, "kb": 1.5, "bm": 2 * (40 * 27 / 12 + 120 * 7.5 ** 2) / 720})),
        ("ellipsoid.stl", "binary STL, 19,800 triangles", stl_binary(ellipsoid(50, 10, 6, 100, 100)), [],
         read(ellipsoid_floats(50, 10, 6), 3e-3)),
        ("moonpool.obj", "a well through bottom and deck", obj(moonpool()), [],
         read({"volume": 1200 - 24 * 3, "plane": 376, "kb": 1.5,
             "bm": (40 * 1000 / 12 - 6 * 64 / 12) / (1200 - 72)})),
        ("bulb.obj", "a bulb that grows out of the bow", obj(bulb()), [],
         read({"volume": 1200 + 4 * polygon_area(16, 0.8), "plane": 400})),
        ("bilge_keels.stl", "plates of 4 mm a millimetre off the sides", stl_binary(keel_plates()), [],
         read({"volume": 1200 + 2 * 20 * 0.399 * 0.004, "plane": 400}, 1e-5)),
        ("half.gdf", "GDF, half of it (ISY 1)", gdf(fine, 0, 1), [], read(BOX_FLOATS, mirrored=(False, True))),
        ("words.gdf", "GDF, words after the numbers of its header",
         gdf(fine, 0, 1, (" ULEN GRAV", "   ISX  ISY", "  NPAN")), [], read(BOX_FLOATS)),
        ("remark.gdf", "GDF, a remark after its last panel", gdf(fine, 0, 1) + b"\n! end of file\n", [],
         read(BOX_FLOATS)),
        ("uneven_top.gdf", "GDF, the corners of its top up to half a millimetre off z = 0", gdf(uneven(fine), 0, 1), [],
         read(BOX_FLOATS, top=1)),
        ("uneven_top_8.gdf", "the same, with a freeboard and repaired", gdf(uneven(fine), 0, 1),
         ["--freeboard", "8", "--repair"], read(BOX_FLOATS, top=8)),
        *((f"{name}.gdf", f"GDF in {name}, as GRAV {gravity:g} says, with the scale that says so too",
           gdf(scaled(fine, 1 / metres), 0, 1, gravity=gravity), ["--scale", f"{metres:g}"], read(BOX_FLOATS, 1e-5))
          for name, metres, gravity in UNITS),
        ("feet_as_metres.gdf", "GDF in feet, as GRAV says, without a scale",
         gdf(scaled(fine, 1 / 0.3048), 0, 1, gravity=32.174), [],
         refused("GRAV 32.174 says that lengths are in feet; give a scale of 0.3048, or convert the file to metres",
                 ["--scale", "0.3048"], BOX_FLOATS, 1e-5)),
        ("feet_as_millimetres.gdf", "GDF in feet, as GRAV says, with the scale of millimetres",
         gdf(scaled(fine, 1 / 0.3048), 0, 1, gravity=32.174), ["--scale", "0.001"],
         refused("GRAV 32.174 says that lengths are in feet; give a scale of 0.3048")),
        ("lid.gdf", "GDF, lids a millimetre above the water plane", gdf(lidded, 0, 1), [],
         read(BOX_FLOATS, top=1.0013)),
        ("cracks.gdf", "GDF, sides and bottom divided otherwise, cracks of 15 mm", gdf(half_box_panels(40, 10,
         3, 8, 7, 0.015), 0, 1),
         [], read(BOX_FLOATS, 5e-3, crack=(0.01, 0.02))),
        ("columns.gdf", "GDF, four columns of 2,000 sides: edges finer than the seal is wide", gdf(columns, 0,
         0), [], read(cone, 1e-5)),
        ("slivers.stl", "binary STL, deck and bottom of 2,000 slivers", stl_binary(plated_box(2000)), [],
         read(BOX_FLOATS, 1e-5)),
        ("hollow.stl", "a plating of 10 mm, its outer and inner face as two closed parts",
         stl_binary(join(BOX, turned(box(-19.99, 19.99, -4.99, 4.99, -2.99, 1.99)))), [], read(BOX_FLOATS)),
        ("semi.stl", "semi-submersible of separate columns and pontoons", stl_binary(semi(False)), [],
         read(semi_floats(), 1e-5)),
        ("model.obj", "a model of 40 mm: small volumes keep their digits", obj(moved(BOX, scale=0.001)), [],
         read({k: v * 0.001 ** e for (k, v), e in zip(BOX_FLOATS.items(), (3, 1, 2, 1))}, says="displaced volume")),
        ("higher_order.gdf", "IGDEF 1 (B-splines)", gdf(fine, 0, 1, second=1), [], refused("IGDEF 1")),
        ("open_deck.obj", "no deck", obj(without(BOX, 1)), [], refused("freeboard", ["--freeboard", "1"],
                                                                      dict(BOX_FLOATS))),
        ("deck_hole.stl", "a triangle of the deck is missing",
         stl_binary((BOX[0], without(BOX, 1)[1] + [(4, 5, 7)])), [], refused("repair", ["--repair"], BOX_FLOATS)),
        ("deck_panel.gdf", "GDF, decked, a panel of the deck is missing", gdf(sides + [[BOX[0][i] for i in (4, 5, 7)]],
         0, 0), [], refused("repair", ["--repair"], BOX_FLOATS)),
        ("high_top.gdf", "GDF, open at 2 m above the water: decked there", gdf(sides, 0, 0), [],
         read(BOX_FLOATS, top=2)),
        ("hole.obj", "a side is missing", obj(without(BOX, 3)), [], refused("repair", ["--repair"], BOX_FLOATS)),
        ("half.obj", "half a hull, open along its centre plane", obj(without(box(-20, 20, 0, 5, -3, 2), 2)), [],
         refused("mirror it there")),
        ("half_off.obj", "half a hull, its centre plane a tenth of a millimetre off",
         obj(without(box(-20, 20, 0.0001, 5, -3, 2), 2)), [], refused("centre plane y = 0: mirror it there")),
        ("half_isy.gdf", "GDF, half of it, but ISY 0", gdf(fine, 0, 0), [], refused("set ISY to 1")),
        ("fore_isx.gdf", "GDF, a quarter of it, but ISX 0", gdf(fore, 0, 1), [], refused("set ISX to 1")),
        ("quarter.gdf", "GDF, a quarter of it, but ISX and ISY 0", gdf(fore, 0, 0), [],
         refused("set ISX and ISY to 1")),
        ("both_isy.gdf", "GDF, both sides of it, but ISY 1", gdf(whole, 0, 1), [], refused("set ISY to 0")),
        ("both_isx.gdf", "GDF, half of it, both ends, but ISX 1", gdf(half_box_panels(40, 10, 3, 1, 1), 1, 1), [],
         refused("its own mirror image; the file has both halves already: set ISX to 0")),
        ("both_ends_isx.gdf", "GDF, half of it, both ends, not about x = 0, but ISX 1", gdf(shifted(fine, 3), 1, 1), [],
         refused("the file has both halves already: set ISX to 0 in its third line")),
        ("whole_isx_isy.gdf", "GDF, all of it, not about x = 0, but ISX and ISY 1", gdf(shifted(whole, 3), 1, 1), [],
         refused("the file has both halves already: set ISX and ISY to 0 in its third line")),
        ("perpendicular_isx.gdf", "GDF, half of it, counted from its after end, but ISX 1",
         gdf(shifted(fine, 20), 1, 1), [],
         refused("set ISX to 0 in its third line; if it is half a hull instead, leave out its wall in x = 0")),
        ("inside_out.stl", "all triangles turned", stl_binary(turned(BOX)), [], refused("repair", ["--repair"],
         BOX_FLOATS)),
        ("one_turned.obj", "one face turned", obj((BOX[0], [BOX[1][0][::-1]] + BOX[1][1:])), [],
         refused("repair", ["--repair"], BOX_FLOATS)),
        ("wide_crack.gdf", "GDF, cracks of 80 mm", gdf(half_box_panels(40, 10, 3, 8, 7, 0.08), 0, 1), [],
         refused("seal width of", "seal", BOX_FLOATS, 2e-2)),
        ("flat.obj", "a triangle without area", obj((BOX[0] + [(0, -5, -3)], BOX[1] + [(0, 8, 1)])), [],
         refused("no area", ["--repair"], BOX_FLOATS)),
        ("few_digits.stl", "text STL, two digits after the point, a column of 200 sides",
         stl_text(prism(circle(5, 200), -10, 5), number="%.2f"), [],
         refused("has no area; the coordinates, multiples of 0.01, have too few digits here: export with more")),
        ("repaired_digits.stl", "the same in centimetres, repaired",
         stl_text(prism(circle(500, 200), -1000, 500), number="%.0f"), ["--scale", "0.01", "--repair"],
         refused("crosses or touches triangle 1 at (5, -0.16, -10); the coordinates, multiples of 1, have too few")),
        ("more_digits.stl", "text STL, the column with a digit more",
         stl_text(prism(circle(5, 200), -10, 5), number="%.3f"), [],
         read({"volume": 10 * polygon_area(200, 5), "plane": polygon_area(200, 5), "kb": 5}, 1e-4)),
        ("touching_semi.stl", "columns that stand on the pontoons as solids of their own", stl_binary(semi(True)), [],
         refused("unite the parts that cross or touch")),
        ("inner_wall.obj", "a bulkhead inside", obj((BOX[0], BOX[1] + [(0, 1, 7, 6)])), [], refused("inner walls")),
        ("moebius.obj", "one side only", obj(moebius()), ["--repair"], refused("Moebius")),
        ("sheet.obj", "a plate without thickness", obj((BOX[0], [BOX[1][0], BOX[1][0][::-1]])), [],
         refused("encloses no volume")),
        ("above.stl", "keel in z = 0: the water misses it", stl_binary(moved(BOX, dz=3.0)), [],
         refused("does not cut the hull", ["--draught", "3"], BOX_FLOATS)),
        ("huge.obj", "coordinates of 1e9", obj(moved(BOX, dx=1e9)), [], refused("about the origin")),
        ("ship.step", "STEP", b"ISO-10303-21;\nHEADER;\n", [], refused("STEP file, which has curved surfaces; export")),
        ("ship.stl", "text of IGES", b" " * 72 + b"S      1\n" + b"1H,,1H;,4HSHIP".ljust(72) + b"G      1\n", [],
         refused("IGES file, which has curved surfaces; export")),
        ("packed.stl.gz", "a packed file", b"\x1f\x8b\x08\x00", [], refused("unpack it")),
        ("utf16.stl", "text STL in UTF-16", stl_text(BOX).decode().encode("utf-16"), [], refused("plain text")),
        ("short.stl", "binary STL, cut short", stl_binary(BOX)[:-20], [], refused("cut short")),
        ("short_solid.stl", "binary STL whose header begins with \"solid\", cut short",
         stl_binary(BOX, b"solid from a CAD program", 7)[:-20], [], refused("it is cut short, or no STL file")),
        ("padded_solid.stl", "binary STL whose header begins with \"solid\", padded",
         stl_binary(BOX, b"solid from a CAD program", 7) + bytes(20), [], refused("it is padded, or no STL file")),
        ("fine.stl", "binary STL, 116,000 triangles, hollow bow", stl_binary(ship_of(116000)), [], read({},
         slow=True)),
    ]


# ---- the test ----

failures = []


def run(path, arguments):
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    done = subprocess.run([FRAM, "hull", path, "--json", *arguments], capture_output=True, text=True, check=False)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    seconds = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    return done.returncode, json.loads(done.stdout.splitlines()[-1]) if done.stdout else {}, seconds


def check(good, text):
    if not good:
        failures.append(text)


def compare(name, answer, floats, close):
    """The largest difference from the closed form, relative."""
    key = {"volume": "volume_m3", "kb": "kb_m", "plane": "waterplane_area_m2", "bm": "bm_transverse_m"}
    worst = 0.0
    for what, wanted in floats.items():
        off = abs(answer[key[what]] / wanted - 1)
        worst = max(worst, off)
        check(off <= close, f"{name}: {what} {answer[key[what]]:.9g} instead of {wanted:.9g}")
    return worst


def remedy_of(message, remedy):
    """The arguments that the message names."""
    if remedy == "seal":
        return ["--seal", message.split("seal width of ")[1].split()[0]]
    return remedy


def try_case(folder, case):
    name, what, data, arguments, expected = case
    path = os.path.join(folder, name)
    with open(path, "wb") as file:
        file.write(data)
    code, answer, seconds = run(name, arguments)
    message = answer.get("error", {}).get("message", "")
    words = " ".join(arguments)
    if expected["kind"] == "read":
        check(code == 0, f"{name}: exit code {code}: {message}")
        if code:
            return [name, what, words, "FAILED", "", seconds]
        off = compare(name, answer, expected["floats"], expected["close"])
        if "mirrored" in expected:
            check((answer["mirrored_x"], answer["mirrored_y"]) == expected["mirrored"], f"{name}: mirrored otherwise")
        if "top" in expected:
            check(abs(answer["box_hi_m"][2] - expected["top"]) < 1e-3, f"{name}: deck at {answer['box_hi_m'][2]}")
        if "crack" in expected:
            low, high = expected["crack"]
            check(low < answer["seal"]["widest_crack_m"] < high,
                f"{name}: crack of {answer['seal']['widest_crack_m']} m")
        if "says" in expected:
            text = subprocess.run([FRAM, "hull", name], capture_output=True, text=True, check=True).stdout
            line = [row for row in text.splitlines() if expected["says"] in row][0]
            check("1.2000e-06" in line or "0.0000012000" in line, f"{name}: digits are lost: {line}")
        return [name, what, words, f"read, {answer['triangles']} triangles",
                f"within {off:.0e}" if expected["floats"] else "no closed form", seconds]
    check(code == 2, f"{name}: exit code {code} instead of a refusal")
    check(expected["words"] in message, f"{name}: '{message}' lacks '{expected['words']}'")
    told = "refused: " + message
    compared = ""
    if expected["remedy"]:
        again = remedy_of(message, expected["remedy"])
        code, answer, _ = run(name, arguments + again)
        check(code == 0, f"{name}: its remedy {again} does not work: {answer.get('error')}")
        if code == 0:
            off = compare(name, answer, expected["floats"], expected["close"])
            compared = f"with `{' '.join(again)}` within {off:.0e}"
    return [name, what, words, told, compared, seconds]


PAGE = """# Hull files as they come

Written by `tests/cli/test_hull_files.py --write docs/hull-files.md`, which makes each of these files,
reads it with `fram hull`, and is itself a test. Where a file is refused, the remedy that the message names is applied,
and the file is then read.
Volume, centre of buoyancy, water plane and metacentric radius are compared with closed forms of box, wedge, cylinder,
ellipsoid and their sums; the last column but one is the largest relative difference. Of an ellipsoid the facets are
compared with the smooth body. Times are seconds of processor time of the whole command, convex pieces included, on a
2-core machine that others used at the same time.

A hull with hollows takes far longer: its cutting into convex pieces takes most of the time. An ellipsoid of
100 x 20 x 10 m whose heights are times 1 + 0.2 sin 3 phi, round its axis, ends at the most pieces, 64, and took
5.3 s with 12,640 triangles, 11.2 s with 28,560 and 39.8 s with 114,720; with `--pieces 1` the last two took 0.8
and 2.5 s. A semi-submersible of round columns of 2,000 sides, 48,000 triangles in 8 pieces, took 3.9 s. `--pieces 1`
shows the hydrostatics of such a file at once, and a coarser file loads as fast as a coarse one: pieces are within
a hundredth of the breadth of the surface at best, however fine it is.

| file | what | options | outcome | closed form | s |
|---|---|---|---|---|---|
"""


def main():
    page_path = os.path.abspath(sys.argv[sys.argv.index("--write") + 1]) if "--write" in sys.argv else None
    home = os.getcwd()
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        rows = [try_case(folder, case) for case in cases()]
        os.chdir(home)
    if page_path:
        with open(page_path, "w", encoding="utf-8") as page:
            page.write(PAGE)
            for row in rows:
                cells = [f"`{row[0]}`", row[1], f"`{row[2]}`" if row[2] else "", row[3].replace("|", "\\|"),
                    row[4], f"{row[5]:.1f}"]
                page.write("| " + " | ".join(cells) + " |\n")
    else:
        for row in rows:
            print(f"{row[0]:20} {row[5]:5.1f} s  {row[3][:150]} {row[4]}")
    for failure in failures:
        print("FAILED:", failure)
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
