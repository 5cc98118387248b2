#!/usr/bin/env python3
"""tools/deps.sh tells sizes before it installs, asks a person at a terminal and nobody else: with an apt-get and a
dpkg-query that are made up."""

import os
import pathlib
import pty
import re
import subprocess
import tempfile
import unittest

DEPS = pathlib.Path(__file__).resolve().parents[2] / "tools/deps.sh"
APT = """#!/bin/sh
case "$*" in
*--assume-no*)
    echo "Need to get 12.3 MB of archives."
    echo "After this operation, 45.6 MB of additional disk space will be used."
    exit 1 ;;
*install*) touch "$MARK" ;;
esac
"""
DPKG = """#!/bin/sh
[ -e "$MARK" ] && echo installed
"""


class Deps(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="fram-deps-")
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        for name, text in {"apt-get": APT, "dpkg-query": DPKG, "sudo": '#!/bin/sh\nexec "$@"\n'}.items():
            (self.folder / name).write_text(text)
            (self.folder / name).chmod(0o755)
        self.mark = self.folder / "installed"
        self.environment = os.environ | {"PATH": f"{self.folder}:/usr/bin:/bin", "MARK": str(self.mark)}
        self.environment.pop("FRAM_YES", None)

    def at_a_terminal(self, answer, **more):
        """Exit code and text of a session whose keyboard types the answer."""
        try:
            mine, theirs = pty.openpty()
        except OSError as why:  # a root without /dev/pts
            self.skipTest(f"there is no terminal: {why}")
        os.write(mine, answer.encode())
        process = subprocess.Popen(["sh", DEPS, "--install", "validate"], stdin=theirs, stdout=theirs, stderr=theirs,
                                   env=self.environment | more)
        os.close(theirs)
        text = b""
        try:
            while part := os.read(mine, 4096):
                text += part
        except OSError:  # the terminal's other end is closed
            pass
        os.close(mine)
        return process.wait(), text.decode()

    def test_without_a_terminal_it_tells_and_installs(self):
        done = subprocess.run(["sh", DEPS, "--install", "validate"], stdin=subprocess.DEVNULL, env=self.environment,
                              capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertIn("to download: 12.3 MB", done.stdout)
        self.assertIn("on disk: 45.6 MB", done.stdout)
        self.assertLess(done.stdout.index("12.3 MB"), done.stdout.index("installing"))
        self.assertTrue(self.mark.exists())

    def test_a_person_says_no(self):
        code, text = self.at_a_terminal("n\n")
        self.assertEqual(code, 1, text)
        self.assertLess(text.index("45.6 MB"), text.index("[Y/n]"))
        self.assertIn("apt-get install --no-install-recommends python3-cffi python3-matplotlib", text)
        self.assertFalse(self.mark.exists())

    def test_a_person_says_yes(self):
        for answer in ("y\n", "\n"):
            self.mark.unlink(missing_ok=True)
            code, text = self.at_a_terminal(answer)
            self.assertEqual(code, 0, text)
            self.assertTrue(self.mark.exists())

    def test_who_said_yes_before_is_not_asked(self):
        code, text = self.at_a_terminal("n\n", FRAM_YES="1")
        self.assertEqual(code, 0, text)
        self.assertNotIn("[Y/n]", text)
        self.assertTrue(self.mark.exists())

    def test_packages_of_a_bare_machine_are_named(self):
        """dpkg-buildpackage asks for build-essential, which no package of the group brings."""
        done = subprocess.run(["sh", DEPS, "core", "deb"], env=self.environment, capture_output=True, text=True)
        self.assertIn("build-essential", done.stdout.split())

    def test_commands_of_make_install_what_their_scripts_call(self):
        """wasm.sh calls cmake and ninja, pictures.py the maker of the site."""
        makefile = (DEPS.parents[1] / "Makefile").read_text(encoding="utf-8")
        for command, groups in {"wasm": ("core", "wasm"), "pictures": ("views", "site")}.items():
            needs = re.search(f"^{command}: (.*) ## ", makefile, re.M)[1].split()
            for group in groups:
                self.assertIn(f"$(STAMPS)/{group}", needs, command)


unittest.main()
