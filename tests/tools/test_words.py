#!/usr/bin/env python3
"""Scripts of tools/ and bench/ say what they do when they are asked, refuse words that they do not know, and keep what
people wrote into their pages."""

import concurrent.futures
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
# What not every machine has; without it the script cannot begin.
LIBRARIES = ("matplotlib", "python3-markdown", "numpy", "cffi")


def scripts():
    for folder in ("tools", "tools/*", "bench"):  # bench/peers stays as it was written
        for path in sorted(ROOT.glob(f"{folder}/*.py")):
            with path.open(encoding="utf-8") as file:
                if file.readline().startswith("#!"):
                    yield path


def said(script, *words):
    # Not the library of this build: what is asked needs none.
    return subprocess.run([sys.executable, script, *words], capture_output=True, text=True, timeout=100, cwd="/",
                          env={**os.environ, "FRAM_LIBRARY": "/nowhere/libfram.so"})


class Words(unittest.TestCase):
    def test_every_script_tells_what_it_does(self):
        found = list(scripts())
        self.assertGreater(len(found), 25)
        with concurrent.futures.ThreadPoolExecutor(2) as pool:
            for script, done in zip(found, pool.map(lambda script: said(script, "--help"), found)):
                if done.returncode and any(library in done.stderr.splitlines()[-1] for library in LIBRARIES):
                    continue
                self.assertEqual((done.returncode, done.stderr), (0, ""), script)
                self.assertTrue(done.stdout.startswith(f"usage: {script.name}"), f"{script}: {done.stdout}")
                self.assertGreater(len(done.stdout.split("\n\n")), 2, f"{script} tells nothing: {done.stdout}")

    def test_words_that_are_not_known(self):
        for script, words, told in (("tools/answers.py", ["--wirte"], "unrecognized arguments: --wirte"),
                                    ("tools/check_rooms.py", ["src"], "unrecognized arguments: src"),
                                    ("tools/wasm_page.py", ["a.js"], "required: playback, output, licences"),
                                    ("bench/run_recording.py", ["demos"], "demos is none of managed_ice,"),
                                    ("bench/run_books.py", ["demos"], "there is no scenes/demos.yaml"),
                                    ("bench/run_books.py", ["other/demo.yaml"], "there is no scenes/demo.yaml"),
                                    ("bench/run_users.py", ["--write", "--only", "demo"], "leave out --only")):
            done = said(ROOT / script, *words)
            self.assertEqual(done.returncode, 2, script)
            self.assertIn(told, done.stderr)

    def test_scenes_by_name_or_file(self):
        sys.path.insert(0, str(ROOT / "bench"))
        import run_books
        import run_recording
        for word in ("demo", "scenes/demo.yaml"):
            self.assertEqual(run_recording.scene_of(word), "scenes/demo.yaml")
            self.assertEqual(run_books.name_of(word), "demo")
        self.assertEqual(run_recording.scene_of("playback"), "bench/playback.yaml")

    def test_pages_keep_what_stands_by_hand(self):
        sys.path.insert(0, str(ROOT / "bench"))
        import kept_page
        with tempfile.TemporaryDirectory() as folder:
            page = pathlib.Path(folder) / "page.md"
            kept_page.write(page, "# A\n")
            self.assertEqual(page.read_text(), "# A\n")
            below = kept_page.MARK + "Told by people.\n\n## More\n"
            page.write_text("# A\n\n| old |\n\n" + below)
            for _ in range(2):
                kept_page.write(page, "# A\n\n| new |\n")
                self.assertEqual(page.read_text(), "# A\n\n| new |\n\n" + below)
        self.assertIn(kept_page.MARK, (ROOT / "bench/results/users.md").read_text())


if __name__ == "__main__":
    unittest.main()
