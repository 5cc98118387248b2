#!/usr/bin/env python3
"""Check that every key of a scenario is set by a test or a ready scene: one that nothing sets may be wired to nothing.

Looks for each key of docs/input-reference.md as scenarios and --set write it, `word:` or `word=`; a key of the same
word in another section counts too.  Prints those that are not found; exit code 1 when there is one.
"""

import pathlib
import re
import sys

from words import words_of

ROOT = pathlib.Path(__file__).resolve().parent.parent
SUFFIXES = {".c", ".h", ".py", ".sh", ".yaml"}


def keys():
    section = ""
    for line in (ROOT / "docs/input-reference.md").read_text().splitlines():
        section = line[3:] if line.startswith("## ") else section
        row = re.match(r"\| `(\w+)` \|", line)
        if row:
            yield section, row.group(1)


def written():
    """Every word that stands before a colon or a sign of equality, without space, as no assignment of C does."""
    words = set()
    for folder in ("tests", "scenes"):
        for path in (ROOT / folder).rglob("*"):
            if path.suffix in SUFFIXES:
                words.update(re.findall(r"(\w+)[\"']?(?::|=(?!=))", path.read_text(errors="replace")))
    return words


def main():
    words_of(__doc__).parse_args()
    words, every = written(), list(keys())
    for section, key in every:
        if key not in words:
            print(f"docs/input-reference.md: no test and no scene sets {section}.{key}: add a test of its effect")
    if not every:
        print("docs/input-reference.md: no key was found")
    return 0 if every and all(key in words for _, key in every) else 1


if __name__ == "__main__":
    sys.exit(main())
