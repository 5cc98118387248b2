#!/usr/bin/env python3
"""Carry the libraries that a program or library needs beside those of every system, with their licences: copies under
FOLDER/lib/bundled and FOLDER/share/doc/fram/licences.

Licences are what Debian's packages of these libraries say, and the texts that they refer to.  Of a library that dpkg
does not know none is found, which is told: who hands the folder on must add it."""

import pathlib
import re
import subprocess
import sys

from words import words_of

# Of every system that runs glibc; carrying them would mix two of a kind in one process.
OF_THE_SYSTEM = re.compile(r"^(ld-linux.*|linux-vdso|libc|libm|libpthread|libdl|librt|libgcc_s|libstdc\+\+)\.so")
COMMON = pathlib.Path("/usr/share/common-licenses")


def needed(binary):
    """What it needs beside the system: name -> path."""
    found = {}
    told = subprocess.run(["ldd", binary], check=True, capture_output=True, text=True).stdout
    for name, path in re.findall(r"^\s*(\S+) => (\S+)", told, re.M):
        if path == "not":
            raise SystemExit(f"{name}, which {pathlib.Path(binary).name} needs, was not found")
        if not OF_THE_SYSTEM.match(name):
            found[name] = pathlib.Path(path)
    return found


def owners(paths):
    """The package of each file that dpkg knows, which may know it under its place before /usr was merged."""
    places = {place: path for path in paths
              for place in (str(path), str(path).removeprefix("/usr"), f"/usr{path}")}
    try:  # all at once: each call reads the lists of all packages
        told = subprocess.run(["dpkg-query", "-S", *places], capture_output=True, text=True, check=False).stdout
    except FileNotFoundError:
        return {}
    found = (line.partition(": ") for line in told.splitlines())
    return {places[place]: re.split("[:,]", packages)[0] for packages, _, place in found if place in places}


def texts(notices):
    """Notices with the licences that they refer to: name -> bytes."""
    found = dict(notices)
    for notice in notices.values():
        for name in re.findall(rb"/usr/share/common-licenses/([A-Za-z]+(?:-[\d.]*\d)?)", notice):
            path = COMMON / name.decode()
            if path.exists():
                found[f"{path.name}.txt"] = path.read_bytes()
    return found


def licences(paths):
    """Those of libraries, and the names of the libraries of which none was found."""
    notices, unknown, known = {}, [], owners(paths)
    for path in paths:
        package = known.get(path)
        notice = pathlib.Path(f"/usr/share/doc/{package}/copyright")
        if package and notice.exists():
            notices[f"{package}.txt"] = notice.read_bytes()
        else:
            unknown.append(path.name)
    return texts(notices), unknown


def tell_unknown(names):
    for name in names:
        print(f"no licence of {name} was found: add it before you hand this on", file=sys.stderr)


def main():
    words = words_of(__doc__)
    words.add_argument("binary", type=pathlib.Path)
    words.add_argument("folder", type=pathlib.Path)
    options = words.parse_args()
    bundled, notices = options.folder / "lib" / "bundled", options.folder / "share" / "doc" / "fram" / "licences"
    for folder in (bundled, notices):
        folder.mkdir(parents=True, exist_ok=True)
    libraries = needed(options.binary)
    for name, path in libraries.items():
        (bundled / name).write_bytes(path.read_bytes())
        (bundled / name).chmod(0o644)
    found, unknown = licences(libraries.values())
    for name, text in found.items():
        (notices / name).write_bytes(text)
    tell_unknown(unknown)


if __name__ == "__main__":
    main()
