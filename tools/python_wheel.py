#!/usr/bin/env python3
"""The wheel of the Python package: the package, the public headers, libfram, the libraries that it needs beside the
C library and the C++ one, and the licences of all."""

import base64
import hashlib
import pathlib
import re
import sysconfig
import zipfile

import carried
from words import words_of

ROOT = pathlib.Path(__file__).resolve().parent.parent
WHEN = (2026, 1, 1, 0, 0, 0)  # one time for all files: the same wheel from the same build


def version():
    text = (ROOT / "include/fram/version.h").read_text()
    return ".".join(re.search(rf"FRAM_VERSION_{part} (\d+)", text)[1] for part in ("MAJOR", "MINOR", "PATCH"))


def libraries(build):
    """libfram under its soname, and what it needs, by name."""
    library = (build / "libfram.so").resolve()
    found = {f"libfram.so.{version().split('.')[0]}": library}
    found.update(carried.needed(library))
    return found


def content(build):
    """Name in the wheel and bytes of each file."""
    package = ROOT / "bindings/python/fram"
    for path in sorted(package.glob("*.py")) + [package / "py.typed"]:
        yield f"fram/{path.name}", path.read_bytes()
    for path in sorted((ROOT / "include/fram").glob("*.h")):
        yield f"fram/include/{path.name}", path.read_bytes()
    for name, path in sorted(libraries(build).items()):
        yield f"fram/lib/{name}", path.read_bytes()


def main():
    words = words_of(__doc__)
    words.add_argument("build", type=pathlib.Path, help="a build by the preset `python`")
    words.add_argument("output", type=pathlib.Path, help="folder for fram-VERSION-py3-none-PLATFORM.whl")
    options = words.parse_args()
    build, output = options.build, options.output
    platform = sysconfig.get_platform().replace("-", "_").replace(".", "_")
    info = f"fram-{version()}.dist-info"
    files = dict(content(build))
    files[f"{info}/METADATA"] = (f"Metadata-Version: 2.1\nName: fram\nVersion: {version()}\n"
                                 "Summary: Simulator of vessels in sea ice\n"
                                 "License: MIT; of the libraries in fram/lib see the files in licenses\n"
                                 "Requires-Python: >=3.9\n"
                                 "Requires-Dist: numpy\nRequires-Dist: cffi\n").encode()
    files[f"{info}/WHEEL"] = (f"Wheel-Version: 1.0\nGenerator: fram\nRoot-Is-Purelib: false\n"
                              f"Tag: py3-none-{platform}\n").encode()
    files[f"{info}/licenses/LICENSE"] = (ROOT / "LICENSE").read_bytes()
    notices, unknown = carried.licences(carried.needed((build / "libfram.so").resolve()).values())
    files.update({f"{info}/licenses/{name}": text for name, text in sorted(notices.items())})
    carried.tell_unknown(unknown)
    rows = []
    for name, data in files.items():
        digest = base64.urlsafe_b64encode(hashlib.sha256(data).digest()).rstrip(b"=").decode()
        rows.append(f"{name},sha256={digest},{len(data)}\n")
    files[f"{info}/RECORD"] = "".join(rows + [f"{info}/RECORD,,\n"]).encode()
    output.mkdir(parents=True, exist_ok=True)
    wheel = output / f"fram-{version()}-py3-none-{platform}.whl"
    with zipfile.ZipFile(wheel, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, data in files.items():
            entry = zipfile.ZipInfo(name, WHEN)
            entry.compress_type, entry.external_attr = zipfile.ZIP_DEFLATED, 0o644 << 16
            archive.writestr(entry, data)
    print(wheel)


main()
