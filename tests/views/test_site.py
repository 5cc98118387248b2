#!/usr/bin/env python3
"""The documents' site in headless Chromium, from disk: words that are typed find their page, at a wide and a narrow
window, and nothing is complained of."""

import os
import pathlib
import subprocess
import sys
import tempfile

import chromium

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
from skipping import skip  # noqa: E402  (tests is no package)

ROOT = pathlib.Path(__file__).resolve().parents[2]
PYTHON = next((name for name in ("/usr/bin/python3", sys.executable) if os.path.exists(name) and
               not subprocess.run([name, "-c", "import markdown"], capture_output=True).returncode), None)
TYPE = """(() => {
    const field = document.getElementById("search");
    field.value = %r;
    field.dispatchEvent(new Event("input"));
    return [...document.querySelectorAll("#found a")].map((link) => link.href);
})()"""
FITS = "document.documentElement.scrollWidth <= document.documentElement.clientWidth"


def go_to(browser, page):
    browser.call("Page.navigate", url=page.as_uri())
    browser.until(f"location.href === {page.as_uri()!r} && document.readyState === 'complete'", "it does not load")


def check_told(browser):
    """What search finds is told to those who do not see the list."""
    told = "document.querySelector('[role=status]').textContent"
    assert browser.run(told) == "Nothing found.", browser.run(told)
    hits = browser.run(TYPE % "catenary breaking_load turret")
    assert browser.run(told) == f"{len(hits)} found.", (browser.run(told), len(hits))


def check_keys(browser):
    """Escape ends a search; the first stop of the Tab key leads to the text; where one is, is told."""
    browser.run(TYPE % "hull")
    browser.run("document.getElementById('search').focus()")
    browser.call("Input.dispatchKeyEvent", type="keyDown", key="Escape", code="Escape", windowsVirtualKeyCode=27)
    ended = browser.run("[document.getElementById('found').hidden, document.getElementById('menu').hidden,"
                        "document.getElementById('search').value]")
    assert ended == [True, False, ""], ended
    first = browser.run("document.querySelector('a, input, summary').hash")
    assert first and browser.run(f"Boolean(document.querySelector('main{first}'))"), first
    assert browser.run("[...document.querySelectorAll('[aria-current=page]')].map((a) => a.href)"
                       ".join() === location.href"), "the menu does not tell where one is"
    line = "getComputedStyle(document.querySelector('main p a')).textDecorationLine"
    assert browser.run(line) == "underline", "links of a text are told by their colour alone"


def main():
    if not chromium.path():
        skip("Chromium is not installed")
    if not PYTHON:
        skip("python3-markdown is not installed")
    with tempfile.TemporaryDirectory() as folder:
        site = pathlib.Path(folder) / "site"
        subprocess.run([PYTHON, ROOT / "tools/site/site.py", site], check=True, cwd=ROOT, capture_output=True)
        for width in (1200, 420):
            with chromium.Browser(width, 800) as browser:
                go_to(browser, site / "docs/theory.html")
                hits = browser.run(TYPE % "catenary breaking_load turret")
                assert any(hit.split("#")[0].endswith("docs/station.html") for hit in hits), hits
                for key, section in (("ice.fracture.brash", "icefracture"), ("vessels[1].hull.length", "vesselhull")):
                    hits = browser.run(TYPE % key)
                    assert hits[:1] and hits[0].endswith("docs/input-reference.html#" + section), (key, hits)
                assert browser.run(TYPE % "xyzzyplugh") == []
                check_told(browser)
                check_keys(browser)
                assert browser.run(TYPE % "") == []
                assert browser.run("document.getElementById('menu').hidden") is False
                for page in ("theory", "input-reference"):
                    go_to(browser, site / f"docs/{page}.html")
                    assert browser.run(FITS), f"{page} is wider than {width}"
                go_to(browser, site / "index.html")
                assert browser.run("[...document.images].every((image) => image.naturalWidth > 0)"), "no picture"
    print("search and pictures at two widths")


main()
