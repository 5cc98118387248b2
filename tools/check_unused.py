#!/usr/bin/env python3
"""Name the functions that nothing in src/ calls, those that only their own file calls although a header declares
them, the public ones that no C test calls, and headers of which a .c file includes what it does not use:
tools/check_unused.py

A function that other files can see (extern, or static inline in a header) is used when its name stands in src/ or
include/ somewhere else than where it is declared and defined.  What only tests use is not the program's: it belongs
into tests/, or is listed here with the reason why it stays.  What one file of src/ uses, and no test or other program,
is static there.  An include is spare when the file names nothing that the header gives: who knows whom is told by
includes, and what is used of a header that came with another one is included by that one's name.  Prints file: message;
exit code 1 when there is one.
"""

import collections
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT / "tools"))
from check_rooms import INCLUDE, without_comments  # noqa: E402
from words import words_of  # noqa: E402

# Used by tests only, and why it stays.
KEPT = {
    "overlay_triangulate": "the step under overlay_convex_pieces that GEOS's own triangulation is an oracle for",
    "sheet_edge_deflection": "the field between the breaking radius and the edge, against the closed form",
    "sheet_stress_strip": "the stress that the breaking radius of a strip is held against",
    "world_difference": "names the first field in which two worlds differ: what a failed test must say",
}

# Used by their own file only, and why a header declares them.
ENGINE = "pages of the validation book are of this code as it is: static when it changes"
DECLARED = {
    "drift_tile_mass": ENGINE,
    "flooding_discharge": ENGINE,
    "fracture_has_parts": ENGINE,
    "island_leader": ENGINE,
    "triangle_moments": ENGINE,
    "world_row": "the header tells all that a handle of a world gives",
}

# Spare includes of files whose text pages of the validation book are of: they go when the code there changes.
SPARE = {
    "src/geometry/convex_piece.c": "geometry/polyhedron_build.h",
    "src/geometry/mesh_convex_pieces.c": "geometry/polyhedron_build.h",
    "src/geometry/polygon_clean.c": "geometry/predicate.h",
    "src/geometry/triangle_merge.c": "geometry/predicate.h",
    "src/ice/edge_way.c": "geometry/predicate.h",
    "src/ice/fracture.c": "geometry/predicate.h",
    "src/ice/fracture_dust.c": "base/transcendental.h",
    "src/ice/fracture_joint.c": "base/transcendental.h",
    "src/ice/fracture_sheet.c": "base/transcendental.h",
    "src/ice/fracture_split.c": "base/transcendental.h",
    "src/ice/pack_limit.c": "base/vec.h",
    "src/ice/wedge.c": "base/vec.h",
    "src/ice/wedge_ramp.c": "base/vec.h",
}

FUNCTION = re.compile(r"^(?!typedef\b|return\b|else\b|#)[A-Za-z_][\w \*]*?[ \*]([a-z_]\w*)\(", re.M)
WORD = re.compile(r"\b[a-z_]\w*\b")
NAME = re.compile(r"\b[A-Za-z_]\w*\b")
# What a header gives: macros; functions; types of functions; tags; typedefs and data.
GIVEN = re.compile(r"^[ \t]*#[ \t]*define[ \t]+(\w+)"
                   r"|\b(\w+)[ \t]*\((?!\*)"
                   r"|\(\*[ \t]*(\w+)\)"
                   r"|\b(?:struct|union|enum)[ \t]+(\w+)"
                   r"|(?:\}|\btypedef\b[^;{}]*?|\bextern\b[^;{}()]*?)[ \t*]*(\w+)(?:\[[^;]*\])?;", re.M)
ENUMERATORS = re.compile(r"\benum\b[^;{]*\{([^}]*)\}")
# Words of the language and its types, which no header gives.
LANGUAGE = set("bool char const double enum float for if int int32_t int64_t long return short size_t sizeof static "
               "struct switch uint8_t uint32_t uint64_t union unsigned void while".split())
MACRO_CALL = re.compile(r"\b[A-Z][A-Z0-9_]+\(")
STRUCT = re.compile(r"\b(?:struct|union)\b[^;{}()=]*\{")
MEMBER = re.compile(r"\b(\w+)(?:\[[^\]]*\])*\s*[;,]")
USED_MEMBER = re.compile(r"(?:->|\.)\s*(\w+)")


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


def own(code, places, elsewhere):
    """Functions that a header declares and one .c file alone names, the one that defines them."""
    named = collections.Counter()
    in_headers = collections.Counter()
    for path, text in code.items():
        words = WORD.findall(text)
        if path.suffix == ".h":
            in_headers.update(words)
        else:
            named.update(set(words))
    for name, paths in sorted(places.items()):
        headers = sum(path.suffix == ".h" for path in paths)
        if 0 < headers < len(paths) and named[name] == 1 and in_headers[name] == headers and name not in elsewhere:
            yield name


def inside(code, start, brackets="()"):
    """What stands in the brackets that open before `start`."""
    depth, end = 1, start
    while depth and end < len(code):
        depth += {brackets[0]: 1, brackets[1]: -1}.get(code[end], 0)
        end += 1
    return code[start:end]


def given(code):
    """Names that a header gives to who includes it; of macros that make some, all that stands in their brackets."""
    names = {name for found in GIVEN.findall(code) for name in found if name}
    for listed in ENUMERATORS.findall(code):
        names.update(re.findall(r"(?:^|,)\s*(\w+)", listed))
    for call in MACRO_CALL.finditer(code):
        names.update(NAME.findall(inside(code, call.end())))
    return names - LANGUAGE


def members(code):
    return {name for struct in STRUCT.finditer(code) for name in MEMBER.findall(inside(code, struct.end(), "{}"))}


def included(text):
    """The headers of Fram that a file includes, in order."""
    found = (INCLUDE.match(line) for line in text.splitlines())
    names = [f.group(2) for f in found if f and f.group(1) == '"' and f.group(2).endswith(".h")]
    return [ROOT / ("include" if name.startswith("fram/") else "src") / name for name in names]


def reach(headers, includes):
    """These headers, and those that come with them."""
    seen, to_do = set(), list(headers)
    while to_do:
        header = to_do.pop()
        if header not in seen and header in includes:
            seen.add(header)
            to_do += includes[header]
    return seen


def spare(code):
    """(file, header) for each include of which nothing is used."""
    includes = {path: included(path.read_text()) for path in code}
    gives = {path: given(text) for path, text in code.items() if path.suffix == ".h"}
    parts = {path: members(text) for path, text in code.items()}
    for path, text in code.items():
        if path.suffix == ".h":
            continue
        body = re.sub(r"^[ \t]*#[ \t]*include.*$", "", text, flags=re.M)
        names, used = set(NAME.findall(body)), set(USED_MEMBER.findall(body))
        for header in includes[path]:
            own = header.with_suffix(".c") == path or header.parent.name == "fram"
            if own or header not in gives or not gives[header].isdisjoint(names):
                continue
            # A struct that a pointer leads to need not be named: its members are, and no others are called so.
            with_others = reach([h for h in includes[path] if h != header], includes)
            known = parts[path].union(*(parts[h] for h in with_others))
            if header in with_others or not parts[header] & used - known:
                yield path, header


def spare_breaches(code):
    """(file, message) for each include that is spare and not listed, or listed and not spare."""
    found = {(str(path.relative_to(ROOT)), str(header.relative_to(ROOT / "src"))) for path, header in spare(code)}
    listed = {(path, header) for path, headers in SPARE.items() for header in headers.split()}
    for path, header in sorted(found - listed):
        yield path, f'"{header}" is included and nothing of it used: delete it, or include what is used instead'
    for path, header in sorted(listed - found):
        yield "tools/check_unused.py", f"{header} in {path} is listed with a reason to stay, and is not spare there"


def main():
    words_of(__doc__).parse_args()
    code = code_of("src/*/*.[ch]", "include/fram/*.h")
    used = collections.Counter(word for text in code.values() for word in WORD.findall(text))
    programs = code_of("tests/**/*.[ch]", "fuzz/*.[ch]", "bench/*.[ch]", "bindings/**/*.[ch]")
    elsewhere = {word for text in programs.values() for word in WORD.findall(text)}
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
    for name in own(code, places, elsewhere):
        if used[name] > len(places[name]) and name not in DECLARED:
            print(f"{places[name][0].relative_to(ROOT)}: only its own file uses {name}: make it static")
            count += 1
    for path, message in spare_breaches(code):
        print(f"{path}: {message}")
        count += 1
    for name in sorted({**KEPT, **DECLARED}):
        if name not in places:
            print(f"tools/check_unused.py: {name} is listed with a reason to stay, and there is no such function")
            count += 1
    return 1 if count else 0


if __name__ == "__main__":
    sys.exit(main())
