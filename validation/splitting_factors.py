#!/usr/bin/env python3
"""Factors of the splitting load: an edge crack in a rectangular plate, opened by a pair of forces at its mouth.

The floe is a free plate of length 1 along the crack, which starts between two parts of widths s and t across it. With
the pair of forces P at the mouth, the compliance C between its lips grows with the crack's length a, and the crack's
energy release rate is G = P^2/2 dC/da = K^2/E (plane stress, thickness 1; K^2 = K_I^2 + K_II^2). The floe splits
unstably at the largest load with K = K_IC, P = F h K_IC sqrt(L), F = max over a of 1/sqrt(E G/P^2).

Finite elements: bilinear rectangles on a mesh graded towards the mouth and the crack's line, each part condensed to
that line. dC/da is the difference between neighbouring lengths on one mesh, so that the singularity under the forces
cancels. The error is of first order in the mesh; two meshes are extrapolated.

    validation/splitting_factors.py            convergence, limits known in closed form, and the table of
                                               src/ice/fracture_split.c with its error between the nodes (minutes)
"""

import math

import numpy

POISSON = 0.3  # of no consequence: tractions alone are given on a plate without holes
# Nodes of the table: the larger side over the length, the smaller side over the larger.
SIDES = [0.25, 0.375, 0.5, 0.625, 0.75, 0.875, 1.0, 1.25]
RATIOS = [i / 8 for i in range(9)]
NO_RATIO = 0.06  # stands for a smaller side of next to nothing


def element(dx, dy):
    """Stiffness of one rectangle, E = 1."""
    law = numpy.array([[1, POISSON, 0], [POISSON, 1, 0], [0, 0, (1 - POISSON) / 2]]) / (1 - POISSON**2)
    g, k = 1 / math.sqrt(3), numpy.zeros((8, 8))
    for s in (-g, g):
        for t in (-g, g):
            gx = numpy.array([-(1 - t), 1 - t, 1 + t, -(1 + t)]) / (2 * dx)
            gy = numpy.array([-(1 - s), -(1 + s), 1 + s, 1 - s]) / (2 * dy)
            b = numpy.zeros((3, 8))
            b[0, 0::2] = b[2, 1::2] = gx
            b[1, 1::2] = b[2, 0::2] = gy
            k += b.T @ law @ b * dx * dy / 4
    return k


def element_parts():
    """Matrices A, B, C of element(dx, dy) = A + B dx/dy + C dy/dx."""
    one, two, half_of = element(1, 1), element(2, 1), element(1, 2)
    # one = A + B + C, two = A + 2 B + C/2, half_of = A + B/2 + 2 C
    b = (4 * (two - one) + 2 * (half_of - one)) / 3
    c = 2 * (b - (two - one))
    return one - b - c, b, c


PARTS = element_parts()


def spaced(count, total, first):
    """Exponentially growing steps, the first about `first`, never shrinking."""
    at = numpy.arange(count + 1) / count
    low, high = 1e-9, 40.0
    for _ in range(100):
        middle = (low + high) / 2
        if total * math.expm1(middle / count) / math.expm1(middle) > first:
            low = middle
        else:
            high = middle
    return total * numpy.expm1(low * at) / math.expm1(low)


def half(xs, width, count):
    """Stiffness of one part, condensed to its nodes on the crack's line."""
    first, n = xs[1], 2 * len(xs)
    ys, condensed = spaced(count, width, 1.5 * first), numpy.zeros((n, n))
    place = 2 * numpy.arange(len(xs) - 1)[:, None] + numpy.array([0, 1, 2, 3, n + 2, n + 3, n, n + 1])
    for j in reversed(range(count)):
        ratio = (numpy.diff(xs) / (ys[j + 1] - ys[j]))[:, None, None]
        layer = numpy.zeros((2 * n, 2 * n))
        numpy.add.at(layer, (place[:, :, None], place[:, None, :]), PARTS[0] + PARTS[1] * ratio + PARTS[2] / ratio)
        side = layer[n:, :n]
        condensed = layer[:n, :n] - side.T @ numpy.linalg.solve(layer[n:, n:] + condensed, side)
    return condensed


def loads(near, far, xs, longest):
    """(crack length, load over K sqrt(length 1)) for the pair of forces at the mouth."""
    other = far.copy()
    other[1::2] *= -1
    other[:, 1::2] *= -1
    n, found, last = 2 * len(xs), [], None
    for i in range(2, len(xs) - 1):
        if xs[i] > longest:
            break
        size = n + 2 * i
        k = numpy.zeros((size, size))
        k[:n, :n] = near
        of_far = numpy.concatenate([numpy.arange(n, n + 2 * i), numpy.arange(2 * i, n)])
        k[numpy.ix_(of_far, of_far)] += other
        free = numpy.setdiff1d(numpy.arange(size), [n - 1, n - 2, n - 3])  # three freedoms hold the plate
        force = numpy.zeros(size)
        force[1], force[n + 1] = 1, -1
        moved = numpy.zeros(size)
        moved[free] = numpy.linalg.solve(k[numpy.ix_(free, free)], force[free])
        compliance = moved[1] - moved[n + 1]
        if last:
            found.append((last[0], math.sqrt(2 * (xs[i] - last[0]) / (compliance - last[1]))))
        last = (xs[i], compliance)
    return found


def largest(found):
    """Crack length and load at the maximum, by a polynomial around it."""
    top = max(range(len(found)), key=lambda i: found[i][1])
    if not 2 < top < len(found) - 3:
        raise RuntimeError("the largest load is at the end of the lengths that were tried")
    x = numpy.array([a for a, _ in found[top - 3 : top + 4]]) / found[top][0] - 1
    fit = numpy.polyfit(x, [f for _, f in found[top - 3 : top + 4]], 4)
    fine = numpy.linspace(x[0], x[-1], 4001)
    value = numpy.polyval(fit, fine)
    return found[top][0] * (1 + fine[value.argmax()]), value.max()


def mesh(count, smaller):
    """Nodes along the crack's line; as fine at the mouth as the smaller side asks."""
    return spaced(count, 1.0, 0.25 / count * min(1, smaller / 0.25))


def factor_on(smaller, larger, count):
    xs = mesh(count, smaller)
    near = half(xs, smaller, count // 2)
    far = near if smaller == larger else half(xs, larger, count // 2)
    return largest(loads(near, far, xs, min(0.6, max(0.45 * larger, 1.5 * smaller))))[1]


def factor(smaller, larger, count=32):
    """F for the two sides over the length: two meshes, extrapolated."""
    return 2 * factor_on(smaller, larger, 2 * count) - factor_on(smaller, larger, count)


def read(table, smaller, larger):
    """What fracture_splitting_force makes of a table."""
    larger = min(larger, SIDES[-1])
    smaller, ratio = min(smaller, larger), min(smaller / larger, 1)
    i = max([k for k in range(len(SIDES) - 1) if SIDES[k] <= larger], default=0)
    k = min(int(8 * ratio), 7)
    u, v = max((larger - SIDES[i]) / (SIDES[i + 1] - SIDES[i]), 0), 8 * ratio - k
    mean = ((1 - u) * ((1 - v) * table[i][k] + v * table[i][k + 1]) +
            u * ((1 - v) * table[i + 1][k] + v * table[i + 1][k + 1]))
    return mean * math.sqrt(smaller)


def main():
    print("square floe, middle of a side:", *(f"{n}: {factor_on(0.5, 0.5, n):.5f}" for n in (24, 32, 48)))
    print("extrapolated:", *(f"{n}: {factor(0.5, 0.5, n):.5f}" for n in (24, 32, 48)))
    short = []
    for count in (24, 48):
        xs = spaced(count, 1.0, 0.01 / count)
        curve = loads(*2 * [half(xs, 1.5, count)], xs, 0.03)
        fit = numpy.polyfit([a for a, _ in curve[4:]], [math.sqrt(math.pi * a) / f for a, f in curve[4:]], 3)
        short.append(numpy.polyval(fit, 0.01))
    print(f"crack of 0.01: K sqrt(pi a)/P = {2 * short[1] - short[0]:.3f}; half plane 2.594 (Wigglesworth 1957)")
    table = []
    for larger in SIDES:
        row = []
        for ratio in RATIOS:
            smaller = larger * max(ratio, NO_RATIO)
            row.append(round(factor(smaller, larger) / math.sqrt(smaller), 4))
        print("    {" + ", ".join(f"{g:.4f}" for g in row) + "},", flush=True)
        table.append(row)
    worst = 0.0
    for larger in (0.1, 0.3333333, 0.44, 0.68, 0.93, 1.12, 2.0):
        for ratio in (0.07, 0.44, 0.6, 0.82, 1):
            exact = factor(ratio * larger, larger)
            off = read(table, ratio * larger, larger) / exact - 1
            worst = numpy.maximum(worst, abs(off))  # a NaN stays one
            print(f"sides {ratio * larger:.4f} {larger:.4f}: {exact:.4f}, table {100 * off:+.2f} %", flush=True)
    print(f"largest error of the table between its nodes {100 * worst:.2f} %")


if __name__ == "__main__":
    main()
