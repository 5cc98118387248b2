#!/usr/bin/env python3
"""Put the browser's simulator, its worker, the playback page and a scenario into one page that works from disk."""

import gzip
import html
import json
import os
import pathlib

import carried
from words import words_of

ROOT = pathlib.Path(__file__).resolve().parent.parent
HERE = ROOT / "bindings" / "wasm"
ABOUT = """\
This page holds Fram, under the MIT licence; GEOS (LGPL-2.1), nettle (LGPL-3 or GPL-2), libfyaml, libpng and zlib, which
its simulator is linked with, and emscripten's C and C++ library; and, in the playback, three.js (MIT, the Three.js
Authors).  The sources of these libraries are Debian's; tools/wasm_libraries.sh in the sources of Fram fetches them and
builds them, changed ones too, and `make wasm` links the simulator with what it built.
"""


def licences(paths):
    """Fram's own, what the files say of the libraries, and the licences that they refer to."""
    notices = {path.name: path.read_bytes() for path in paths}
    found = {"Fram": (ROOT / "LICENSE").read_bytes(), **carried.texts(notices)}
    return ABOUT + "".join(f"\n======== {name.removesuffix('.txt')} ========\n\n{text.decode()}"
                           for name, text in found.items())


def main():
    words = words_of(__doc__)
    words.add_argument("simulator", type=pathlib.Path, help="simulator.js of the build for browsers")
    words.add_argument("playback", type=pathlib.Path, help="playback.html of make viewer")
    words.add_argument("output", type=pathlib.Path, help="the page")
    words.add_argument("licences", nargs="+", type=pathlib.Path, help="NAME.txt of each library in the simulator")
    options = words.parse_args()
    simulator, playback, output = options.simulator, options.playback, options.output
    parts = {
        "worker": simulator.read_text() + "\n" + (HERE / "worker.js").read_text(),
        # A playback without a record waits for one.
        "playback": playback.read_text().replace("<!--BESIDE-->", "").replace("<!--RECORD-->", ""),
        "scenario": (HERE / "scenario.yaml").read_text(),
    }
    page = (HERE / "page.html").read_text()
    # "</" would end the element that holds it.
    page = page.replace("<!--PARTS-->", json.dumps(parts).replace("</", "<\\/").replace("<!--", "<\\u0021--"))
    page = page.replace("/*SCRIPT*/", (HERE / "page.js").read_text())
    page = page.replace("<!--LICENCES-->", html.escape(licences(options.licences), quote=False))
    new = output.with_suffix(".new")
    new.write_text(page)
    os.replace(new, output)
    print(f"{output}: {len(page) / 1e6:.1f} MB, {len(gzip.compress(page.encode())) / 1e6:.1f} MB compressed")


if __name__ == "__main__":
    main()
