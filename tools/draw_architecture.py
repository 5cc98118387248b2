#!/usr/bin/env python3
"""Draw the two pictures of docs/architecture.md: the house, from what the files include, and a step's flow of data.

    tools/draw_architecture.py [--check]

The house is drawn from the code (floors from tools/check_rooms.py, arrows from #include lines), so the picture cannot
say what is not so; --check fails when a committed picture differs from what would be drawn now.
"""

import html
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT / "tools"))
from check_rooms import FLOOR  # noqa: E402
from words import words_of  # noqa: E402

INCLUDE = re.compile(r'^\s*#\s*include\s+"(\w+)/', re.M)
KNOWS = {
    "base": "vectors, tables of fields, errors, memory, threads, random numbers",
    "geometry": "polygons, clipping, triangle meshes, mass properties",
    "bodies": "pose, velocity, mass, shape",
    "dynamics": "pairs, contacts, joints, solvers, motion",
    "fluid": "buoyancy, drag, current, wind",
    "ice": "floes, fields, crushing, fracture",
    "vessel": "hull, mooring, thrusters, control",
    "model": "scenario and world: plain data",
    "io": "files to plain data and back",
    "sim": "scenario to world and its slips, the step, runs, re-runs",
    "results": "finished runs read again",
    "study": "conditions, seeds, many runs, summaries",
    "api": "implements include/fram",
    "cli": "commands; sees include/fram only",
}
# A step, stage by stage (sim/step.h, which numbers those of the mechanics): what it reads, and what it writes for the
# stages after it.
STEP = [
    ("1  External forces", "poses, velocities, media, stations", "loads on bodies; thrust, tensions, set points"),
    ("2  Detection", "poses, shapes, kept pairs", "pairs; contacts of convex pieces; pairs that need patches"),
    ("3  Crushing limits", "pairs that need patches, floes", "patches; their contacts, each with its cap"),
    ("4  Solve", "loads, contacts, joints, warm start", "velocities; impulse of every contact"),
    ("Ice loads", "contacts with impulses", "load on each vessel, by zone and kind"),
    ("5  Fracture", "patches with impulses, floes", "cracks: floes removed and made; events; books"),
    ("6  Integration", "velocities, contacts", "poses; overlap corrected"),
    ("Edge of the domain", "poses, velocities", "floes that leave, return or are fed; bodies put to sleep"),
]


def svg(width, height, body):
    style = ("text{font-family:DejaVu Sans,Arial,sans-serif;font-size:13px;fill:#1d2b36}"
             ".name{font-weight:bold}.small{font-size:11px;fill:#4a5a66}"
             ".room{fill:#eaf2f8;stroke:#4f7a99}.stage{fill:#f6efe2;stroke:#9a7b3c}"
             ".arrow{stroke:#9db4c4;fill:none;stroke-width:1.2}.flow{stroke:#4f7a99;fill:none;stroke-width:1.6}")
    marks = ('<defs><marker id="m" markerWidth="8" markerHeight="8" refX="7" refY="3" orient="auto">'
             '<path d="M0,0 L7,3 L0,6 z" fill="#4f7a99"/></marker></defs>')
    return (f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" width="{width}" '
            f'height="{height}"><style>{style}</style>{marks}<rect width="{width}" height="{height}" fill="#fff"/>'
            + "\n".join(body) + "</svg>\n")


def text(x, y, words, kind="", anchor="start"):
    return f'<text x="{x}" y="{y}" class="{kind}" text-anchor="{anchor}">{html.escape(words)}</text>'


def box(x, y, w, h, kind):
    return f'<rect x="{x}" y="{y}" width="{w}" height="{h}" rx="6" class="{kind}"/>'


def includes():
    """Room -> rooms that its files include."""
    found = {room: set() for room in FLOOR}
    for path in sorted((ROOT / "src").glob("*/*.[ch]")):
        room = path.parent.name
        found[room] |= {name for name in INCLUDE.findall(path.read_text()) if name in FLOOR and name != room}
    found["cli"] = {"api"}
    return found


def reachable(found, start, without):
    seen, todo = set(), [n for n in found[start] if n != without]
    while todo:
        room = todo.pop()
        if room not in seen:
            seen.add(room)
            todo += found[room]
    return seen


def draw_house():
    floors = sorted({floor for floor in FLOOR.values()}, reverse=True)
    width, high, gap = 860, 58, 34
    place, body = {}, []
    for row, floor in enumerate(floors):
        rooms = [room for room in FLOOR if FLOOR[room] == floor]
        wide = 400 if len(rooms) == 1 else 370
        first = (width - len(rooms) * wide - (len(rooms) - 1) * 30) / 2
        for i, room in enumerate(rooms):
            place[room] = (first + i * (wide + 30), 20 + row * (high + gap), wide)
    found = includes()
    for room, below in found.items():
        for other in sorted(below):
            # An arrow that a way over other rooms tells already is left out.
            if other in reachable(found, room, other):
                continue
            x, y, w = place[room]
            ox, oy, ow = place[other]
            body.append(f'<path class="flow" marker-end="url(#m)" d="M{x + w / 2:g},{y + high:g} '
                        f'L{ox + ow / 2:g},{oy:g}"/>')
    for room, (x, y, w) in place.items():
        body += [box(x, y, w, high, "room"), text(x + 12, y + 23, f"src/{room}", "name"),
                 text(x + 12, y + 43, KNOWS[room], "small"),
                 text(x + w - 12, y + 23, str(FLOOR[room]), "small", "end")]
    return svg(width, 20 + len(floors) * (high + gap), body)


def draw_step():
    width, high, gap, left, wide = 980, 46, 22, 350, 250
    right = left + wide + 50
    body = [text(20, 24, "reads", "name"), text(left, 24, "stage", "name"), text(right, 24, "writes", "name")]
    for i, (name, reads, writes) in enumerate(STEP):
        y = 40 + i * (high + gap)
        body += [box(left, y, wide, high, "stage"), text(left + 14, y + 28, name, "name"),
                 text(20, y + 28, reads, "small"), text(right, y + 28, writes, "small"),
                 f'<path class="arrow" d="M{left - 90},{y + 24} L{left - 6},{y + 24}" marker-end="url(#m)"/>',
                 f'<path class="arrow" d="M{left + wide},{y + 24} L{left + wide + 42},{y + 24}" marker-end="url(#m)"/>']
        if i + 1 < len(STEP):
            body.append(f'<path class="flow" marker-end="url(#m)" d="M{left + wide / 2:g},{y + high} '
                        f'L{left + wide / 2:g},{y + high + gap - 2}"/>')
    y = 40 + len(STEP) * (high + gap)
    body += [text(20, y + 14, "Nothing flows back within a step.  State outlives it in tables of fields; all else is "
                  "written anew.  The recorder reads, and writes nothing that moves.", "small"),
             text(20, y + 32, "Stages with a number are the mechanics.  Of those without, one keeps account of what "
                  "the ice did, and one settles who is there in the next step, and who sleeps.", "small")]
    return svg(width, y + 52, body)


def main():
    words = words_of(__doc__)
    words.add_argument("--check", action="store_true", help="draw nothing; exit code 1 where a picture is another")
    check, stale = words.parse_args().check, 0
    for name, draw in (("house.svg", draw_house), ("step.svg", draw_step)):
        path = ROOT / "docs" / "pictures" / name
        drawn = draw()
        if check:
            if not path.exists() or path.read_text() != drawn:
                print(f"{path.relative_to(ROOT)} is not what the code draws now: run tools/draw_architecture.py")
                stale = 1
        else:
            path.write_text(drawn)
    return stale


if __name__ == "__main__":
    sys.exit(main())
