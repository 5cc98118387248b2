#!/usr/bin/env python3
"""The site of the documents opens from disk: every link and picture of every page leads to a file of the site and to an
anchor that is there, nothing is asked of a network, and search has every section."""

import html.parser
import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest
import urllib.parse

ROOT = pathlib.Path(__file__).resolve().parents[2]
PYTHON = next((name for name in ("/usr/bin/python3", sys.executable) if os.path.exists(name) and
               not subprocess.run([name, "-c", "import markdown"], capture_output=True).returncode), None)
if not PYTHON:
    print("skipped: python3-markdown is not here")
    sys.exit(77)


class Page(html.parser.HTMLParser):
    def __init__(self, text):
        super().__init__()
        self.links, self.anchors, self.loaded = [], set(), []
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        for name, value in attributes:
            if name == "id":
                self.anchors.add(value)
            elif name in ("href", "src"):
                (self.links if tag == "a" else self.loaded).append(value)


class Site(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory(prefix="fram-site-")
        cls.addClassCleanup(cls.folder.cleanup)
        cls.site = pathlib.Path(cls.folder.name) / "site"
        subprocess.run([PYTHON, ROOT / "tools/site/site.py", cls.site], check=True, cwd=ROOT, capture_output=True)
        cls.pages = {path: Page(path.read_text(encoding="utf-8")) for path in cls.site.rglob("*.html")}

    def test_every_document_is_a_page(self):
        for path in (ROOT / "docs").rglob("*.md"):
            self.assertIn(self.site / path.relative_to(ROOT).with_suffix(".html"), self.pages)
        self.assertIn(self.site / "index.html", self.pages)

    def test_every_link_leads_somewhere(self):
        links = 0
        for path, page in self.pages.items():
            for link in page.links + page.loaded:
                if re.match(r"[a-z]+:", link):
                    self.assertIn(link, page.links, f"{path.name} loads from a network")
                    continue
                name, _, part = urllib.parse.unquote(link).partition("#")
                target = (path.parent / name).resolve() if name else path
                self.assertTrue(target.exists(), f"{path.relative_to(self.site)}: {link}")
                if part and target.suffix == ".html":
                    self.assertIn(part, self.pages[target].anchors, f"{path.relative_to(self.site)}: {link}")
                links += 1
        self.assertGreater(links, 1000)

    def test_a_title_says_what_page_it_is(self):
        titles = [re.search("<title>(.*?)</title>", path.read_text(encoding="utf-8"))[1] for path in self.pages]
        self.assertIn("Fram", titles)
        self.assertNotIn("Fram - Fram", titles)

    def test_search_has_every_section(self):
        text = (self.site / "index.js").read_text(encoding="utf-8")
        index = json.loads(text.removeprefix("const pages = ").rstrip().removesuffix(";"))
        self.assertEqual({entry["a"] for entry in index}, {str(path.relative_to(self.site)) for path in self.pages})
        for entry in index:
            anchors = self.pages[self.site / entry["a"]].anchors
            for _, anchor, words in entry["s"]:
                self.assertTrue(not anchor or anchor in anchors)
                self.assertTrue(words)

    def test_lists_and_tables_became_such(self):
        """A line of a list or table that is left as text shows that the Markdown was not understood."""
        for path in self.pages:
            text = re.sub(r"<pre.*?</pre>", "", path.read_text(encoding="utf-8"), flags=re.S)
            self.assertIsNone(re.search(r"<p>\|.*\|", text), path.name)
            self.assertIsNone(re.search(r"<p>[^<]*\n- ", text), path.name)


unittest.main()
