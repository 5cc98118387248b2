#!/usr/bin/env python3
"""Check the house: who includes whom, how long files are, which words and functions they use.

Rules (CONTRIBUTING.md says why):
  - a room includes itself and rooms on lower floors; the command includes fram/ and itself; a room below the API
    includes of the public headers only those in SHARED_HEADERS;
  - a test of a room obeys the floor of its room; it may include headers beside it and in tests/;
  - results and study do not include what FORBIDDEN lists, nor what builds a world who judges it;
  - a library's header is included only in the room that owns the library;
  - files of src/ that include each other in a circle are one module, and one of their headers says so: "one module
    with" and the names of the others;
  - files of src/ have at most 500 lines (kernels and all others 800) of at most 120 columns, no reminders of unfinished
    work and no paths of one machine;
  - docs/architecture.md names files that are there;
  - at the top stand the files of TOP and no other, such as what a run that was tried there left;
  - no libm function whose last bits differ between machines is called in src/.

Prints file:line: message for each breach; exit code 1 when there is one.
"""

import pathlib
import re
import subprocess
import sys

from words import words_of

ROOT = pathlib.Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT / "tools"))
from libm import TRANSCENDENTAL  # noqa: E402

TOP = {".clang-format", ".clang-tidy", ".gitignore", "CHANGELOG.md", "CITATION.cff", "CMakeLists.txt",
       "CMakePresets.json", "CONTRIBUTING.md", "LICENSE", "Makefile", "README.md"}
FLOOR = {
    "base": 1,
    "geometry": 2,
    "bodies": 3,
    "dynamics": 4,
    "fluid": 4,
    "ice": 5,
    "vessel": 5,
    "model": 6,
    "io": 7,
    "sim": 8,
    "results": 8,
    "study": 9,
    "api": 10,
    "cli": 11,
}
# What a room does not include though its floor would let it: docs/architecture.md says what it must not know.
FORBIDDEN = {
    "results": {"model/model.h", "model/world.h"},
    "study": {"model/world.h", "sim/build.h", "sim/run.h", "sim/step.h"},
}
# Headers that those who build a world do not include: they know nothing of who judges it.
BUILDING, JUDGING = "src/sim/build", "sim/sanity"
# Public headers that rooms below the API share: the words for failures, and the version.
SHARED_HEADERS = {"fram/error.h", "fram/version.h"}
# Which rooms may include a library's headers.
LIBRARY_ROOMS = {
    "geos_c.h": {"geometry"},
    "libfyaml.h": {"io"},
    "cairo": {"io"},
    "netcdf": {"io"},
    "microhttpd.h": {"results"},
    "png.h": {"io"},
    "zlib.h": {"base", "io"},
    "nettle/": {"base", "io"},
    "pthread.h": {"base"},
}

# Programs of other engines, kept as they were written.
KEPT_AS_WRITTEN = "bench/peers/"

LONGEST_FILE = 800
LONGEST_SOURCE = 500  # of src/, but for kernels
LONGEST_LINE = 120
LENGTH_SUFFIXES = {".c", ".h", ".py", ".sh", ".js", ".mjs", ".ts", ".cmake"}
TEXT_SUFFIXES = LENGTH_SUFFIXES | {".md", ".txt", ".yaml", ".yml", ".json", ".in", ".html", ".css"}
# Spelt in pieces so that this file does not contain them.
REMINDERS = re.compile(r"\b(" + "|".join(("TO" + "DO", "FIX" + "ME", "X" + "XX", "HA" + "CK")) + r")\b")
# A page that is not in the repository cannot be cited: name a source, docs/theory.md, docs/oracles.md or a decision.
OUTSIDE_PAGES = re.compile(r"\b(SPEC (section )?\d|oracles section \d)")
MACHINE_PATHS = re.compile(r"(?<![\w.])/(" + "|".join(("ho" + "me", "ro" + "ot", "wo" + "rk", "Us" + "ers")) + r")/\w")

INCLUDE = re.compile(r'^\s*#\s*include\s+(["<])([^">]+)[">]')
CALL = re.compile(r"(?<![\w.])(?<!->)(" + "|".join(sorted(TRANSCENDENTAL)) + r")\s*\(")
COMMENT_OR_TEXT = re.compile(r'/\*.*?\*/|//[^\n]*|"(?:\\.|[^"\\\n])*"|\'(?:\\.|[^\'\\\n])*\'', re.S)


def own_files():
    listing = subprocess.run([ROOT / "tools" / "sources.sh"], stdout=subprocess.PIPE, text=True, check=True)
    return [ROOT / name for name in listing.stdout.splitlines()]


def without_comments(text):
    """The code alone: comments and literals blanked, line breaks kept."""
    return COMMENT_OR_TEXT.sub(lambda found: re.sub(r"[^\n]", " ", found.group()), text)


def include_breach(path, bracket, target):
    """Why this file must not include target, or None."""
    place, room = path.parts[0], path.parts[1]
    if bracket == "<":
        for header, rooms in LIBRARY_ROOMS.items():
            if place == "src" and target.startswith(header) and room not in rooms:
                return f"<{target}> belongs to {' and '.join(sorted(rooms))}"
        return None
    head = target.split("/")[0]
    if head == "fram":
        if place == "src" and room not in ("api", "cli") and target not in SHARED_HEADERS:
            return f'"{target}" is public: below the API only {", ".join(sorted(SHARED_HEADERS))} are shared'
        return None
    if "/" in target and head in FLOOR:
        if room == "cli":
            return None if head == "cli" else f'"{target}": the command includes fram/ and cli/ only'
        if head != room and FLOOR[head] >= FLOOR[room]:
            return f'"{target}": {room} is on floor {FLOOR[room]}, {head} on floor {FLOOR[head]}'
        if place == "src" and target in FORBIDDEN.get(room, ()):
            return f'"{target}": {room} must not know it'
        if str(path).startswith(BUILDING) and target.startswith(JUDGING):
            return f'"{target}": what builds a world knows nothing of who judges it'
        return None
    if place == "tests" and (((ROOT / path).parent / target).exists() or (ROOT / "tests" / target).exists()):
        return None
    return f'"{target}" is not of the form "room/name.h"'


def breaches_of(path, text):
    """(line, message) for each broken rule of one file."""
    relative = path.relative_to(ROOT)
    lines = text.splitlines()
    kept = str(relative).startswith(KEPT_AS_WRITTEN)
    source = relative.parts[0] == "src" and not path.stem.endswith("_kernel")
    longest = LONGEST_SOURCE if source else LONGEST_FILE
    if path.suffix in LENGTH_SUFFIXES and len(lines) > longest:
        yield len(lines), f"{len(lines)} lines; at most {longest}: make two topics of it"
    for number, line in enumerate(lines, 1):
        if path.suffix in LENGTH_SUFFIXES and len(line) > LONGEST_LINE and not kept:
            yield number, f"{len(line)} columns; at most {LONGEST_LINE}"
        if REMINDERS.search(line):
            yield number, "a reminder of unfinished work: open an issue instead"
        if OUTSIDE_PAGES.search(line) and path.suffix in (".c", ".h", ".md"):
            yield number, "cites a page that is not in the repository"
        if MACHINE_PATHS.search(line):
            yield number, "a path of one machine"
    if path.suffix not in (".c", ".h") or len(relative.parts) < 3:
        return
    place, room = relative.parts[0], relative.parts[1]
    if place not in ("src", "tests"):
        return
    if place == "src" and room not in FLOOR:
        yield 1, f"src/{room} is no room of the house"
        return
    code = without_comments(text).splitlines()
    for number, line in enumerate(lines, 1):
        found = INCLUDE.match(line)
        if found and room in FLOOR:
            breach = include_breach(relative, *found.groups())
            if breach:
                yield number, breach
    if place == "src":
        for number, line in enumerate(code, 1):
            for name in CALL.findall(line):
                yield number, f"{name}() of libm differs between machines: see base/transcendental.h"


def modules_of_source():
    """Module ("room/name" of name.c and name.h) -> modules it includes."""
    found = {}
    for path in sorted((ROOT / "src").glob("*/*.[ch]")):
        name = f"{path.parent.name}/{path.stem}"
        targets = (INCLUDE.match(line) for line in path.read_text().splitlines())
        includes = {t.group(2)[:-2] for t in targets if t and t.group(1) == '"' and t.group(2).endswith(".h")}
        found.setdefault(name, set()).update(includes - {name})
    return found


def circles(modules):
    """Lists of modules that include each other round (strongly connected, more than one)."""
    def reach(start, arrows):
        seen, to_do = set(), [start]
        while to_do:
            for name in arrows.get(to_do.pop(), ()):
                if name not in seen and name in modules:
                    seen.add(name)
                    to_do.append(name)
        return seen

    ways = {name: reach(name, modules) for name in modules}
    left = {name for name in modules if name in ways[name]}
    while left:
        first = min(left)
        circle = sorted(name for name in left if name in ways[first] and first in ways[name])
        left -= set(circle)
        yield circle


def circle_breaches(modules):
    """(path, message) for each circle that no header of its names."""
    for circle in circles(modules):
        names = [module.split("/")[1] for module in circle]
        for module in circle:
            header = ROOT / "src" / f"{module}.h"
            head = " ".join(header.read_text().split("*/")[0].split()) if header.exists() else ""
            others = [name for name in names if name != module.split("/")[1]]
            if "one module with" in head.lower() and all(re.search(rf"\b{name}\b", head) for name in others):
                break
        else:
            yield f"src/{circle[0]}.h", ("a circle of files: " + ", ".join(names) + '; cut it, or let a header of its '
                                         'say "one module with" and name the others')


def page_breaches():
    """(path, line, message) for each file that docs/architecture.md names and that is not there."""
    page = ROOT / "docs" / "architecture.md"
    for number, line in enumerate(page.read_text().splitlines() if page.exists() else (), 1):
        for name in re.findall(r"`([a-z_]+/[\w/.-]+\.(?:c|h|sh|py|yaml))`", line):
            if not any((ROOT / place / name).exists() for place in ("", "src", "include")):
                yield "docs/architecture.md", number, f"there is no {name}"


def main():
    words_of(__doc__).parse_args()
    count = 0
    for path, message in circle_breaches(modules_of_source()):
        print(f"{path}:1: {message}")
        count += 1
    for path, line, message in page_breaches():
        print(f"{path}:{line}: {message}")
        count += 1
    for path in own_files():
        if path.parent == ROOT and path.name not in TOP:
            print(f"{path.name}:1: at the top of the tree stands none but {', '.join(sorted(TOP))}")
            count += 1
        if path.suffix not in TEXT_SUFFIXES and path.name not in ("Makefile", "run"):
            continue
        try:
            text = path.read_text(encoding="utf-8")
        except UnicodeDecodeError:
            continue  # malformed on purpose: inputs of tests
        for line, message in breaches_of(path, text):
            print(f"{path.relative_to(ROOT)}:{line}: {message}")
            count += 1
    return 1 if count else 0


if __name__ == "__main__":
    sys.exit(main())
