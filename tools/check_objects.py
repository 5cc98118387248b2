#!/usr/bin/env python3
"""Check what the compiler made of the library's rooms:  tools/check_objects.py BUILD

  - no object calls a function of libm whose bits differ between machines (a macro or a header might have);
  - no object holds a fused multiply-add (-ffp-contract=off must reach every file, the wide kernels above all);
  - no object holds writable data: there is no global state;
  - no object but text.c's calls the C library's printf and strtod, which go by the locale of the program that calls.

The command is not looked at: a signal handler needs a flag.  Prints each breach; exit code 1 when there is one.
"""

import pathlib
import re
import subprocess
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
from libm import TRANSCENDENTAL  # noqa: E402
from words import words_of  # noqa: E402

FUSED = re.compile(r"\bv?f[n]?m(add|sub|addsub|subadd)[0-9]*[ps][sdh]\b")
LOCAL = re.compile(r"^(_*(v?sn?|f|v|vf|d|vd|as|vas)?printf(_chk)?|strto(d|f|ld)|atof)$")


def output(*command):
    return subprocess.run(command, capture_output=True, text=True, check=True).stdout


def members(text):
    """(member, lines) of each object in a listing of an archive."""
    name, lines = "", []
    for line in text.splitlines():
        head = re.match(r"^(\S+\.o):", line)
        if head:
            if name:
                yield name, lines
            name, lines = head.group(1), []
        else:
            lines.append(line)
    if name:
        yield name, lines


def breaches(archive):
    for name, lines in members(output("nm", "--undefined-only", archive)):
        for line in lines:
            symbol = line.split()[-1] if line.split() else ""
            if LOCAL.match(symbol) and name != "text.c.o":
                yield f"{name}: calls {symbol} of the program's locale; include base/text.h"
            if re.sub(r"^__(\w+)_finite$", r"\1", symbol) in TRANSCENDENTAL:
                yield f"{name}: calls libm's {symbol}"
    for name, lines in members(output("objdump", "--disassemble", "--no-show-raw-insn", archive)):
        fused = sum(bool(FUSED.search(line)) for line in lines)
        if fused:
            yield f"{name}: {fused} fused multiply-adds"
    for name, lines in members(output("objdump", "--syms", archive)):
        for line in lines:
            found = re.search(r"\sO\s+(\.t?data|\.t?bss|\*COM\*)(\.\S*)?\s+[0-9a-f]+\s+(?:\.hidden )?(\S+)", line)
            if found and not (found.group(2) or "").startswith(".rel.ro"):
                yield f"{name}: {found.group(3)} is a writable global"


def command_of(build):
    return pathlib.Path(build, "rooms", "libroom_cli.a")


def main():
    words = words_of(__doc__)
    words.add_argument("build", help="a build that is done")
    build = words.parse_args().build
    archives = sorted(set(pathlib.Path(build, "rooms").glob("libroom_*.a")) - {command_of(build)})
    if not archives:
        print(f"no archives in {build}/rooms: build first")
        return 1
    count = 0
    for archive in archives:
        for breach in breaches(archive):
            print(f"{archive.name}: {breach}")
            count += 1
    return 1 if count else 0


if __name__ == "__main__":
    sys.exit(main())
