#!/usr/bin/env python3
"""Check that all files of a room can be compiled as one, and each by itself:  tools/check_together.py BUILD

The build compiles them several at once (FRAM_UNITY), in an order that moves with every new file.  What a file calls its
own must therefore be its room's only thing of that name.  Other builds compile each alone (make coverage, make wasm,
-DFRAM_UNITY=OFF) and ask for more: no local name may hide another of its file.  That is not looked at in batches, and
clang does not tell of it where the other is a type.  Prints the compiler's errors; exit code 1 when there is one.
"""

import collections
import concurrent.futures
import json
import os
import pathlib
import re
import subprocess
import sys

import tidy
from words import words_of


def units(build):
    """Commands of the batches that CMake made of each room's files, by the folder in which they stand."""
    found = collections.defaultdict(list)
    for entry in json.loads((build / "compile_commands.json").read_text()):
        if pathlib.Path(entry["file"]).parent.name == "Unity":
            found[pathlib.Path(entry["file"]).parent].append(entry)
    return found


def syntax(command, build, text=None):
    """Whether the compiler takes what a command compiles, or a text in its place; nothing is written."""
    source = "-" if text else command.rpartition(" -c ")[2]
    words = re.sub(r" -o .*$", f" -Werror -fsyntax-only -x c {source}", command)
    done = subprocess.run(words, shell=True, cwd=build, input=text, capture_output=True, text=True, check=False)
    sys.stderr.write(done.stderr)
    return done.returncode == 0


def alone(build):
    """Commands of the files of src, each by itself; kernels are never compiled in another way."""
    return [entry["command"] for entry in tidy.commands(build)
            if "/src/" in entry["file"] and not entry["file"].endswith("_kernel.c")]


def main():
    words = words_of(__doc__)
    words.add_argument("build", type=pathlib.Path, help="a build that was configured")
    build = words.parse_args().build.resolve()
    bad = 0
    found = units(build)
    for folder, entries in sorted(found.items()):
        everything = "".join(f'#include "{entry["file"]}"\n' for entry in entries)
        bad += not syntax(entries[0]["command"], build, everything)
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        bad += sum(not good for good in pool.map(lambda command: syntax(command, build), alone(build)))
    if not found:
        print("no files of this build are compiled together: nothing looked at")
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main())
