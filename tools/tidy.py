#!/usr/bin/env python3
"""Analyse C files with clang-tidy, each once as it stands.

A file that was found clean is looked at again when anything that clang-tidy reads has changed: the file, every header
that it includes (as the compiler told ninja), its flags, .clang-tidy, how deep it is to look, or clang-tidy itself.
What is known to be clean is kept in BUILD/tidy, a file named by the hash of all that; without it, every file is
analysed.  Files that the build does not know have no flags to be analysed with and are passed over.  Several files a
run, since starting clang-tidy takes as long as looking at a small file; but one with a va_list is looked at alone:
clang-tidy 14 calls every va_list after a run's first file uninitialised.  Exit code 1 when there was a finding.
"""

import concurrent.futures
import functools
import hashlib
import json
import os
import pathlib
import re
import shlex
import subprocess
import sys

from words import words_of

ROOT = pathlib.Path(__file__).resolve().parent.parent


def analyzer(word):
    """A word for the static analyser's own configuration."""
    return [f"--extra-arg={part}" for part in ("-Xclang", "-analyzer-config", "-Xclang", word)]


# How far the static analyser goes, nine tenths of the time (docs/decisions/0300-what-the-gate-looks-at.md).
# In src it gives up a function after this many states instead of 225,000; TIDY_DEEP=1 leaves it at those.  Programs
# that no user runs are looked at by all checks but the analyser's: they run under sanitizers.
SOURCE = [] if os.environ.get("TIDY_DEEP") else analyzer("max-nodes=75000")
# Without the analyser clang-tidy keeps -Werror, and clang has warnings of its own that this build does not ask for.
OTHERS = ["--checks=-clang-analyzer-*", "--extra-arg=-Wno-error"]
PROGRAMS = ("tests/", "fuzz/", "bench/")
BATCH = 8  # files a run


def depth(file):
    return OTHERS if str(file).startswith(PROGRAMS) else SOURCE


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


@functools.lru_cache(maxsize=None)
def commands(build):
    """What the build compiles, file by file: files that are compiled together are in one that CMake made of them."""
    found = []
    for entry in json.loads((build / "compile_commands.json").read_text()):
        # What clang does not know; and shadowing is looked at here, where each file stands alone.
        command = re.sub(r" (-fno-ipa-modref|-m(memset|memcpy)-strategy=\S+|-Wno-shadow)(?= )", "", entry["command"])
        path = pathlib.Path(entry["file"])
        together = re.findall(r'^#include "(.*)"', path.read_text(), re.M) if path.parent.name == "Unity" else []
        found += [entry | {"file": file, "command": command.rpartition(" -c ")[0] + f" -c {shlex.quote(file)}"}
                  for file in together] or [entry | {"command": command}]
    return found


def once_each(build, folder):
    """Flags of each file once: a kernel is compiled for three instruction sets and looked at in its widest copy, the
    only one with vectors of eight, or in the only one there is."""
    found = {}
    for entry in commands(build):
        if entry["file"] not in found or "_kernels_avx512.dir" in entry["command"]:
            found[entry["file"]] = entry
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "compile_commands.json").write_text(json.dumps(list(found.values()), indent=1))
    return folder


def keys(build, files):
    """File -> hash of what clang-tidy reads of it, or None where that is not known; files of the build only."""
    common = output("clang-tidy", "--version") + content_hash(ROOT / ".clang-tidy")
    entries = {}
    for entry in commands(build):
        path = pathlib.Path(entry["directory"], entry["file"]).resolve()
        made = re.search(r" -o (\S+)", entry["command"])
        entries.setdefault(path, []).append((made.group(1) if made else "", entry["command"]))
    headers = headers_by_object(build)
    found = {}
    for file in files:
        path = (ROOT / file).resolve()
        if path not in entries:
            continue
        text, known = [common, str(file), *depth(file)], True
        for made, command in sorted(entries[path]):
            text.append(command)
            known = known and made in headers
            for header in sorted(headers.get(made, [])):
                known = known and header.is_file()
                text.append(f"{header} {content_hash(header)}" if known else "")
        found[file] = hashlib.sha256("\n".join(text).encode()).hexdigest() if known else None
    return found


def batches(files):
    """The files in runs of like depth; neighbours stand in different runs, since long files stand beside each other."""
    alone = [file for file in files if "va_list" in (ROOT / file).read_text()]
    runs = [[file] for file in alone]
    for programs in (False, True):
        like = [file for file in files if file not in alone and str(file).startswith(PROGRAMS) == programs]
        count = -(-len(like) // BATCH)
        runs += [like[i::count] for i in range(count)]
    return runs


def main():
    words = words_of(__doc__)
    words.add_argument("build", type=pathlib.Path, help="a build that was configured, by ninja")
    words.add_argument("jobs", type=int, help="how many files are looked at side by side")
    words.add_argument("files", nargs="*", help="those to look at, default all")
    options = words.parse_args()
    build, jobs, files = options.build.resolve(), options.jobs, options.files
    clean = build / "tidy"
    clean.mkdir(exist_ok=True)
    flags = once_each(build, build / "tidy-flags")
    known = keys(build, files or output(ROOT / "tools" / "sources.sh", "*.c").split())
    wanted = [file for file, key in known.items() if not key or not (clean / key).exists()]
    print(f"lint:   {len(wanted)} of {len(known)} files have changed since they were found clean", flush=True)
    runs = batches(wanted)
    bad = 0

    def analyse(run):
        """Output, and files without a finding: one by one where the run had any."""
        done = subprocess.run(["clang-tidy", "--quiet", *depth(run[0]), "-p", str(flags), *run], cwd=ROOT,
                              capture_output=True, text=True)
        if done.returncode == 0 or len(run) == 1:
            return done.stdout, run if done.returncode == 0 else []
        parts = [analyse([file]) for file in run]
        return "".join(text for text, _ in parts), [file for _, good in parts for file in good]

    with concurrent.futures.ThreadPoolExecutor(jobs) as pool:
        for run, (text, good) in zip(runs, pool.map(analyse, runs)):
            print(text, end="", flush=True)
            bad += len(run) - len(good)
            for file in good:
                if known[file]:
                    (clean / known[file]).touch()
    if not files:  # what no file has any more
        for path in clean.iterdir():
            if path.name not in known.values():
                path.unlink()
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main())
