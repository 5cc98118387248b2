#!/usr/bin/env python3
"""No message of the library names an option of the command: a program that uses the library has none."""

import pathlib
import re
import sys

SOURCE = pathlib.Path(__file__).resolve().parents[2]
CALL = re.compile(r"\b(?:error_set|error_add|log_write|fail_at|refuse|note_|tell|snprintf)\w*\(.*?\);", re.S)
# Options of another program that has them by the same name.
OTHERS = {("src/api/study.c", "--quiet")}  # sbatch's
TEXT = re.compile(r'"(?:[^"\\]|\\.)*"')


def named(text, options):
    """Options in the string literals of the calls that tell something."""
    for call in CALL.finditer(text):
        said = "".join(literal[1:-1] for literal in TEXT.findall(call.group()))
        yield from (option for option in re.findall(r"--[a-z][a-z-]*", said) if option in options)


def main():
    options = set()
    for path in (SOURCE / "src/cli").glob("*.c"):
        options |= set(re.findall(r'"(--[a-z][a-z-]*)"', path.read_text()))
    assert {"--set", "--vessel", "--formula"} <= options, options
    assert list(named('error_set(error, "name one, "\n "--vessel NAME");', options)) == ["--vessel"]
    bad = [f"{path.relative_to(SOURCE)}: a message names {option}"
           for path in sorted((SOURCE / "src").rglob("*.c")) if path.parent.name != "cli"
           for option in named(path.read_text(), options)
           if (str(path.relative_to(SOURCE)), option) not in OTHERS]
    print("\n".join(bad))
    return bool(bad)


sys.exit(main())
