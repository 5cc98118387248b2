#!/usr/bin/env python3
"""Name the functions that nothing in src/ calls, and the public ones that no C test calls:  tools/check_unused.py

A function that other files can see (extern, or static inline in a header) is used when its name stands in src/ or
include/ somewhere else than where it is declared and defined.  What only tests use is not the program's: it belongs
into tests/, or is listed here with the reason why it stays.  Prints file: message; exit code 1 when there is one.
"""

import collections
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT / "tools"))
from check_rooms import without_comments  # noqa: E402

# Used by tests only, and why it stays.
KEPT = {
    "overlay_triangulate": "the step under overlay_convex_pieces that GEOS's own triangulation is an oracle for",
    "sheet_edge_deflection": "the field between the breaking radius and the edge, against the closed form",
    "sheet_stress_strip": "the stress that the breaking radius of a strip is held against",
    "world_difference": "names the first field in which two worlds differ: what a failed test must say",
}

FUNCTION = re.compile(r"^(?!typedef\b|return\b|else\b|#)[A-Za-z_][\w \*]*?[ \*]([a-z_]\w*)\(", re.M)
WORD = re.compile(r"\b[a-z_]\w*\b")


def code_of(*patterns):
    found = {}
    for pattern in patterns:
        for path in sorted(ROOT.glob(pattern)):
            found[path] = without_comments(path.read_text())
    return found


def declared(code):
    """Function -> paths, one for each declaration or definition of it that other files may see."""
    places = collections.defaultdict(list)
    for path, text in code.items():
        for found in FUNCTION.finditer(text):
            if path.suffix == ".h" or not found.group().startswith("static "):
                places[found.group(1)].append(path)
    return places


def main():
    code = code_of("src/*/*.[ch]", "include/fram/*.h")
    used = collections.Counter(word for text in code.values() for word in WORD.findall(text))
    tests = {word for text in code_of("tests/**/*.[ch]").values() for word in WORD.findall(text)}
    places = declared(code)
    count = 0
    for name, paths in sorted(places.items()):
        where = paths[0].relative_to(ROOT)
        if name.startswith("fram_") and (ROOT / "include" / "fram") in [path.parent for path in paths]:
            if name not in tests:
                print(f"{where}: {name} is public and no C test calls it")
                count += 1
        elif used[name] <= len(paths) and name != "main" and name not in KEPT:
            print(f"{where}: nothing in src/ uses {name}: delete it, or move it to where it is used")
            count += 1
    for name in sorted(KEPT):
        if name not in places:
            print(f"tools/check_unused.py: {name} is listed as used by tests only, and there is no such function")
            count += 1
    return 1 if count else 0


if __name__ == "__main__":
    sys.exit(main())
