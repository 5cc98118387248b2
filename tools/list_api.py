#!/usr/bin/env python3
"""Which test holds each function of include/fram: writes the table of docs/api.md; --check says whether it is so.

A test that is named stays so as long as it calls the function; a new function gets the one that calls it most often.
Tests of what is refused say nothing of what a function answers: one that they alone call is the command's, whose
answers tests/cli reads, and the row names the file of the command that calls it."""

import pathlib
import re
import sys

from words import words_of

ROOT = pathlib.Path(__file__).resolve().parent.parent
PAGE = ROOT / "docs/api.md"
MARK = "<!-- written by tools/list_api.py from here on -->\n"


def functions():
    for header in sorted((ROOT / "include/fram").glob("*.h")):
        text = re.sub(r"/\*.*?\*/", "", header.read_text(), flags=re.S)
        for name in re.findall(r"FRAM_API[^;]*?\b(fram_[a-z0-9_]+)\(", text):
            yield header.name, name


# What goes everywhere and keeps its form, and handles, of which only pointers are known.
KEEP_THEIR_FORM = {"fram_error", "fram_body_id"}


def unsized():
    """Functions that fill a struct, or free what one holds, without being told its size (decision 0255)."""
    for header in sorted((ROOT / "include/fram").glob("*.h")):
        text = re.sub(r"/\*.*?\*/", "", header.read_text(), flags=re.S)
        structs = set(re.findall(r"^\} (fram_[a-z_]+);", text, flags=re.M)) - KEEP_THEIR_FORM
        for declaration in re.findall(r"FRAM_API ([^;]*);", text):
            name = re.search(r"\b(fram_[a-z0-9_]+)\(", declaration).group(1)
            filled = re.findall(r"(?<!const )\b(fram_[a-z_]+) \*[a-z]", declaration.split("(", 1)[1])
            macro = f"#define {name}(" in text
            if structs.intersection(filled) and not (macro and re.search(r"size_t size\)$", declaration)):
                yield f"{header.name}: {name}"


# Calls that cannot be, programs of older versions, calls while another one has not returned.
OF_REFUSALS = {"test_misuse.c", "test_live_misuse.c", "test_definitions.c", "test_older_programs.c", "test_one_call.c"}


def named():
    """The file that the page names for each function."""
    return dict(re.findall(r"^\| `(fram_[a-z0-9_]+)` \| `[a-z]+\.h` \| \[([a-z_]+\.c)\]", PAGE.read_text(), re.M))


def sources(folder, left_out=frozenset()):
    return {path.name: path.read_text() for path in sorted((ROOT / folder).glob("*.c")) if path.name not in left_out}


def most_calls(name, texts, before):
    """The file that calls a function most often, or the one that was named; None where none does."""
    calls = {file: len(re.findall(rf"\b{name}\(", text)) for file, text in texts.items()}
    best = before if calls.get(before) else max(calls, key=lambda file: (calls[file], file))
    return best if calls[best] else None


def table():
    before = named()
    places = {"tests/api": sources("tests/api", OF_REFUSALS), "src/cli": sources("src/cli")}
    rows, missing = [], []
    for header, name in functions():
        for folder, texts in places.items():
            best = most_calls(name, texts, before.get(name))
            if best:
                rows.append(f"| `{name}` | `{header}` | [{best}](../{folder}/{best}) |\n")
                break
        else:
            missing.append(name)
    return "| function | header | its test |\n|---|---|---|\n" + "".join(rows), missing, len(rows)


def main():
    words = words_of(__doc__)
    words.add_argument("--check", action="store_true", help="write nothing; exit code 1 where the table is another")
    check = words.parse_args().check
    text, missing, count = table()
    head = PAGE.read_text().split(MARK)[0]
    page = head + MARK + "\n" + text
    for name in missing:
        print(f"FAILED: neither the command nor a C test that reads its answer calls {name}")
    late = list(unsized())
    for name in late:
        print(f"FAILED: {name} fills a struct and is not told its size")
    if check:
        if PAGE.read_text() != page:
            print("FAILED: docs/api.md is not what tools/list_api.py writes; run it")
            return 1
    else:
        PAGE.write_text(page)
    if count < 50:
        print(f"FAILED: found {count} functions in include/fram")
        return 1
    print(f"{count} functions of include/fram are held by a test")
    return 1 if missing or late else 0


if __name__ == "__main__":
    sys.exit(main())
