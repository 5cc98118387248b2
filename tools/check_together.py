#!/usr/bin/env python3
"""Check that all files of a room can be compiled as one:  tools/check_together.py BUILD

The build compiles them several at once (FRAM_UNITY), in an order that moves with every new file.  What a file calls its
own must therefore be its room's only thing of that name.  Prints the compiler's errors; exit code 1 when there is one.
"""

import collections
import json
import pathlib
import re
import subprocess
import sys


def units(build):
    """Commands of the batches that CMake made of each room's files, by the folder in which they stand."""
    found = collections.defaultdict(list)
    for entry in json.loads((build / "compile_commands.json").read_text()):
        if pathlib.Path(entry["file"]).parent.name == "Unity":
            found[pathlib.Path(entry["file"]).parent].append(entry)
    return found


def main():
    build = pathlib.Path(sys.argv[1]).resolve()
    bad = 0
    found = units(build)
    for folder, entries in sorted(found.items()):
        everything = "".join(f'#include "{entry["file"]}"\n' for entry in entries)
        command = re.sub(r" -o .*$", " -fsyntax-only -x c -", entries[0]["command"])
        bad += subprocess.run(command, shell=True, cwd=build, input=everything, text=True, check=False).returncode != 0
    if not found:
        print("no files of this build are compiled together: nothing looked at")
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main())
