"""What pictures show where texts are to stand: pixels.py WHAT FILE..., exit code 1 where it is otherwise."""
import base64
import os
import pathlib
import re
import sys

sys.path.insert(0, str(pathlib.Path(os.environ["FRAM_SOURCE"]) / "tests" / "views"))
import chromium  # noqa: E402


def read(path):
    """Of a page its first PNG."""
    data = pathlib.Path(path).read_bytes()
    if path.endswith(".html"):
        data = base64.b64decode(re.search(rb"data:image/png;base64,([^\"]+)", data)[1])
    width, height, channels, rows = chromium.pixels(data)
    return width, height, lambda x, y: tuple(rows[y][channels * x:channels * x + 3])


def longest(values):
    best = now = 0
    for v in values:
        now = now + 1 if v else 0
        best = max(best, now)
    return best


def scales(folders):
    """Frames of a video: the scale bar, and the colours from white to dark purple, unbroken; and its title."""
    for folder in folders:
        width, height, at = read(folder + "/frame-000000.png")
        under = range(height - 230, height - 100)
        bar = max(longest(max(at(x, y)) < 40 for x in range(width)) for y in under)
        ramp = max(longest(r > b + 15 and not (r, g, b) == (217, 115, 13) and b < 200 for r, g, b in
                           (at(x, y) for x in range(width))) for y in under)
        # A title that is too long ends before the axes.
        free = range(width - 99, width - 96) if "orbit" in folder else range(width - 73, width - 66)
        assert all(min(at(x, y)) > 200 for x in free for y in range(30)), (folder, "title and axes")
        # The half of the ramp that is told from white; of plans bars begin at ten pixels.
        assert bar >= 12 and ramp >= 30, (folder, bar, ramp)


def wet(files):
    """A hull that floats keel up: water is at the deck of the drawing, which is upright, and not at the keel."""
    water, dry = (204, 227, 245), (244, 244, 241)
    _, _, at = read(files[0])
    assert at(400, 112) == water and at(500, 236) == dry, (at(400, 112), at(500, 236))


def size(files):
    """Two pictures of the same size."""
    sizes = [read(f)[:2] for f in files]
    assert len(set(sizes)) == 1, sizes


def hulls(files):
    """As much of each picture is a hull's red."""
    red = []
    for file in files:
        width, height, at = read(file)
        red.append(sum(r > 1.6 * g for r, g, _ in (at(x, y) for x in range(width) for y in range(height))))
    assert max(red) > 1000 and max(red) - min(red) < 0.01 * max(red), red


def twin(files):
    """Plans have water in their middle, and as much of a hull above as below it."""
    for file in files:
        width, height, at = read(file)
        middle = (height + 20) // 2
        red = [y for y in range(64, height - 44) if at(width // 2, y)[0] > 200]
        above = sum(y < middle for y in red)
        assert middle not in red and above > 30 and abs(len(red) - 2 * above) < 4, (file, red)


def whole(folders):
    """The field ends before the sides of the picture, where only water is, and so do the words under it."""
    for folder in folders:
        width, height, at = read(folder + "/frame-000000.png")
        rows = range(60, height - 210)
        bright = [sum(at(x, y)[0] > 100 for y in rows) for x in range(width)]
        assert max(bright[0], bright[1], bright[-1], bright[-2]) == 0 and max(bright) > 9, (folder, bright)
        assert all(min(at(width - x, y)) > 200 for x in (1, 2, 3) for y in range(height - 200, height - 180)), folder


def seamless(files):
    """Panels that no ice met are one area: no pixel of another colour stands between two of theirs, beside or above."""
    hull = (209, 227, 243)
    for file in files:
        width, height, at = read(file)
        rows = [[at(x, y) for x in range(width)] for y in range(66, height - 46)]
        assert sum(row.count(hull) for row in rows) > 10000, file
        for line in rows + list(zip(*rows)):
            between = [here for before, here, after in zip(line, line[1:], line[2:]) if before == after == hull != here]
            assert not between, (file, between[:3])


def limit(files):
    """The footprint of a page of keeping station has the limit's circle, which is green."""
    _, _, at = read(files[0])
    green = sum(g > r + 60 and g > b + 20 for r, g, b in (at(x, y) for x in range(20, 640) for y in range(60, 620, 8)))
    assert green > 50, green


def apart(files):
    """The words of a page of keeping station end before its charts."""
    _, _, at = read(files[0])
    assert all(min(at(x, y)) > 200 for x in range(642, 664) for y in range(640, 1130)), "words in the charts"


def walls(files):
    """Plans have a wall on each of their four sides."""
    for file in files:
        width, height, at = read(file)

        def is_wall(x, y):
            return sum(abs(a - b) for a, b in zip(at(x, y), (115, 107, 102))) < 9
        across = [x for x in range(width) if all(is_wall(x, y) for y in range(120, 240, 8))]
        down = [y for y in range(64, height) if all(is_wall(x, y) for x in range(2 * width // 5, 3 * width // 5, 8))]
        for found, size in ((across, width), (down, height)):
            assert found and found[0] < size / 2 < found[-1], (file, found)


def head(files):
    """A title that is too long ends before the edge, in dots."""
    width, _, at = read(files[0])
    inked = [x for x in range(width) if any(max(at(x, y)) < 128 for y in range(20, 45))]
    assert inked[0] >= 38 and width - 80 < inked[-1] < width - 38, (inked[0], inked[-1])


if __name__ == "__main__":
    {"scales": scales, "wet": wet, "size": size, "hulls": hulls, "twin": twin, "whole": whole,
     "limit": limit, "apart": apart, "walls": walls, "head": head, "seamless": seamless}[sys.argv[1]](sys.argv[2:])
