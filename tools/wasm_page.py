#!/usr/bin/env python3
"""Put the browser's simulator, its worker, the playback page and a scenario into one page that works from disk."""

import gzip
import json
import os
import pathlib

from words import words_of

HERE = pathlib.Path(__file__).resolve().parent.parent / "bindings" / "wasm"


def main():
    words = words_of(__doc__)
    words.add_argument("simulator", type=pathlib.Path, help="simulator.js of the build for browsers")
    words.add_argument("playback", type=pathlib.Path, help="playback.html of make viewer")
    words.add_argument("output", type=pathlib.Path, help="the page")
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
    new = output.with_suffix(".new")
    new.write_text(page)
    os.replace(new, output)
    print(f"{output}: {len(page) / 1e6:.1f} MB, {len(gzip.compress(page.encode())) / 1e6:.1f} MB compressed")


if __name__ == "__main__":
    main()
