#!/usr/bin/env python3
"""Analyse C files with clang-tidy, each once as it stands:  tools/tidy.py BUILD JOBS [FILE...]

A file that was found clean is looked at again when anything that clang-tidy reads has changed: the file, every header
that it includes (as the compiler told ninja), its flags, .clang-tidy, or clang-tidy itself.  What is known to be clean
is kept in BUILD/tidy, a file named by the hash of all that; without it, every file is analysed.  Files that the build
does not know have no flags to be analysed with and are passed over.  One file a run: given several, clang-tidy 14 calls
every va_list after the first file's uninitialised.  Exit code 1 when there was a finding.
"""

import concurrent.futures
import functools
import hashlib
import json
import pathlib
import re
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent


# Tests and fuzz targets are followed less far into what they call: a third of the time, for code that no user runs.
SHALLOW = [f"--extra-arg={word}" for word in ("-Xclang", "-analyzer-config", "-Xclang", "mode=shallow")]


def output(*command):
    return subprocess.run(command, capture_output=True, text=True, check=True).stdout


@functools.lru_cache(maxsize=None)
def content_hash(path):
    return hashlib.sha256(path.read_bytes()).hexdigest()


def headers_by_object(build):
    """Object -> files that it was compiled from, by ninja's own records; objects that are out of date are left out."""
    found, name = {}, None
    for line in output("ninja", "-C", str(build), "-t", "deps").splitlines():
        if line and not line.startswith((" ", "ninja:")):
            name = line.split(":")[0] if line.endswith("(VALID)") else None
            if name:
                found[name] = []
        elif line.strip() and name:
            found[name].append((build / line.strip()).resolve())
    return found


def keys(build, files):
    """File -> hash of what clang-tidy reads of it, or None where that is not known; files of the build only."""
    common = output("clang-tidy", "--version") + content_hash(ROOT / ".clang-tidy")
    entries = {}
    for entry in json.loads((build / "compile_commands.json").read_text()):
        path = pathlib.Path(entry["directory"], entry["file"]).resolve()
        made = re.search(r" -o (\S+)", entry["command"])
        entries.setdefault(path, []).append((made.group(1) if made else "", entry["command"]))
    headers = headers_by_object(build)
    found = {}
    for file in files:
        path = (ROOT / file).resolve()
        if path not in entries:
            continue
        text, known = [common, str(file)], True
        for made, command in sorted(entries[path]):
            text.append(command)
            known = known and made in headers
            for header in sorted(headers.get(made, [])):
                known = known and header.is_file()
                text.append(f"{header} {content_hash(header)}" if known else "")
        found[file] = hashlib.sha256("\n".join(text).encode()).hexdigest() if known else None
    return found


def main():
    build, jobs, files = pathlib.Path(sys.argv[1]).resolve(), int(sys.argv[2]), sys.argv[3:]
    clean = build / "tidy"
    clean.mkdir(exist_ok=True)
    known = keys(build, files or output(ROOT / "tools" / "sources.sh", "*.c").split())
    wanted = [file for file, key in known.items() if not key or not (clean / key).exists()]
    print(f"lint:   {len(wanted)} of {len(known)} files have changed since they were found clean", flush=True)
    bad = 0

    def analyse(file):
        depth = [] if file.startswith("src/") else SHALLOW
        done = subprocess.run(["clang-tidy", "--quiet", *depth, "-p", str(build), file], cwd=ROOT,
                              capture_output=True, text=True)
        return file, done.returncode, done.stdout

    with concurrent.futures.ThreadPoolExecutor(jobs) as pool:
        for file, code, text in pool.map(analyse, wanted):
            print(text, end="", flush=True)
            if code:
                bad += 1
            elif known[file]:
                (clean / known[file]).touch()
    if not files:  # what no file has any more
        for path in clean.iterdir():
            if path.name not in known.values():
                path.unlink()
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main())
