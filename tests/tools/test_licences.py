#!/usr/bin/env python3
"""What hands out the libraries of others hands out their licences: the wheel, the archive, the page for browsers."""

import os
import pathlib
import subprocess
import sys
import tempfile
import unittest
import zipfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tools"))
import carried  # noqa: E402  (tools)

LIBRARY = pathlib.Path(os.environ["FRAM_BUILD"]) / "libfram.so"
FREE = b"Permission is hereby granted"


def run(script, *words):
    return subprocess.run([sys.executable, ROOT / "tools" / script, *words], check=True, capture_output=True, text=True)


class Licences(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = pathlib.Path(scratch.name)

    def check_owners(self, libraries, notices):
        """Every library's owner has a notice, and what it refers to is there too."""
        self.assertGreater(len(libraries), 4)
        for package in carried.owners(libraries.values()).values():
            self.assertGreater(len(notices[f"{package}.txt"]), 500)
        if any(b"common-licenses/LGPL-2.1" in text for text in notices.values()):
            self.assertIn(b"GNU LESSER GENERAL PUBLIC LICENSE", notices["LGPL-2.1.txt"])

    def skip_where_dpkg_knows_nothing(self):
        libraries = carried.needed(LIBRARY).values()
        if set(carried.owners(libraries)) != set(libraries):
            self.skipTest("dpkg does not know where the libraries come from")

    def test_the_wheel(self):
        self.skip_where_dpkg_knows_nothing()
        run("python_wheel.py", LIBRARY.parent, self.folder)
        with zipfile.ZipFile(next(self.folder.glob("*.whl"))) as wheel:
            files = {name: wheel.read(name) for name in wheel.namelist()}
        notices = {name.partition("/licenses/")[2]: text for name, text in files.items() if "/licenses/" in name}
        self.assertIn(FREE, notices["LICENSE"])
        libraries = carried.needed(LIBRARY)
        self.check_owners(libraries, notices)
        self.assertEqual({name for name in files if name.startswith("fram/lib/") and "/libfram.so." not in name},
                         {f"fram/lib/{name}" for name in libraries})
        self.assertIn(b"\nLicense: MIT;", next(text for name, text in files.items() if name.endswith("/METADATA")))

    def test_the_archive(self):
        self.skip_where_dpkg_knows_nothing()
        run("carried.py", LIBRARY, self.folder)
        notices = {path.name: path.read_bytes() for path in (self.folder / "share/doc/fram/licences").iterdir()}
        libraries = carried.needed(LIBRARY)
        self.check_owners(libraries, notices)
        self.assertEqual({path.name for path in (self.folder / "lib/bundled").iterdir()}, set(libraries))

    def test_a_library_that_nobody_knows_is_told(self):
        own = self.folder / "libown.so.1"
        own.write_bytes(b"")
        self.assertEqual(carried.licences([own]), ({}, ["libown.so.1"]))

    def test_the_page_for_browsers(self):
        given = {"simulator.js": "let a;", "playback.html": "<p>", "page.html": "", "zlib.txt": "zlib's own",
                 "geos.txt": "LGPL <geos> & more: /usr/share/common-licenses/LGPL-2.1."}
        for name, text in given.items():
            (self.folder / name).write_text(text)
        run("wasm_page.py", *(self.folder / name for name in given))
        page = (self.folder / "page.html").read_text()
        text = page.partition('<details id="licences">')[2].partition("</details>")[0]
        for words in (FREE.decode(), "LGPL &lt;geos&gt; &amp; more", "zlib's own", "tools/wasm_libraries.sh",
                      "three.js"):
            self.assertIn(words, text)
        if (carried.COMMON / "LGPL-2.1").exists():
            self.assertIn("GNU LESSER GENERAL PUBLIC LICENSE", text)


if __name__ == "__main__":
    unittest.main()
