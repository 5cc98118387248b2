#!/usr/bin/env python3
"""The page of the simulator in a browser without its simulator, in headless Chromium: a stand-in for the worker tells
of a run.  The scene has room in narrow windows, what is read aloud is not rewritten all the time, and the focus stays.

Skipped (77) without Chromium or without the viewer's page.  test_wasm.py has the simulator itself.
"""
import os
import pathlib
import subprocess
import sys
import tempfile

import chromium

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
from skipping import skip  # noqa: E402  (tests is no package)

SOURCE = pathlib.Path(os.environ["FRAM_SOURCE"])
PLAYBACK = SOURCE / "build" / "viewer" / "playback.html"
# Tells of 1000 steps of a run at once when it is let go; keeps what is said in the page.
STAND_IN = """(() => {
    window.Worker = class {
        constructor() { window.stub = this; }
        postMessage(message) { window.asked = message; }
        terminate() {}
    };
    window.said = { heard: [], state: [] };
    for (const name of ['heard', 'state'])
        new MutationObserver(() => said[name].push(document.getElementById(name).textContent))
            .observe(document.getElementById(name), { childList: true, characterData: true, subtree: true });
})()"""
RUN = """(async () => {
    const tell = (data) => stub.onmessage({ data });
    tell({ work: 'packing', done: 1, total: 2 });
    tell({ begun: { duration: 100, floes: 9 } });
    await new Promise((done) => setTimeout(done, 0));
    for (let k = 1; k <= 1000; k++) {
        tell({ progress: { time: k / 10, steps: k, floes: 9, wall: k / 100 } });
        if (k % 10 === 0) await new Promise((done) => setTimeout(done, 0));
    }
    tell({ ended: { hash: 'ab', steps: 1000, time: 100, stopped: false }, files: [] });
    await new Promise((done) => setTimeout(done, 0));
    return said;
})()"""


def enter(browser):
    for kind in ("keyDown", "keyUp"):
        browser.call("Input.dispatchKeyEvent", type=kind, code="Enter", key="Enter", windowsVirtualKeyCode=13,
                     **({"text": "\r"} if kind == "keyDown" else {}))


def check_room(browser):
    for width, height in ((320, 640), (640, 400), (1200, 800)):
        browser.call("Emulation.setDeviceMetricsOverride", width=width, height=height, deviceScaleFactor=1,
                     mobile=False)
        browser.until(f"innerWidth === {width}", "the window keeps its width")
        _, _, wide, high = browser.box("scene")
        assert wide >= min(width, 700) and high >= 300, f"in {width} x {height} the scene is {wide} x {high}"
        fits, scrolls = browser.run("(({ scrollWidth, clientWidth, scrollHeight }) => [scrollWidth <= clientWidth, "
                                    "scrollHeight])(document.documentElement)")
        assert fits and scrolls >= browser.box("scene")[3], (width, fits, scrolls)
    browser.call("Emulation.clearDeviceMetricsOverride")


def check_said(browser):
    browser.run("document.getElementById('run').focus()")
    enter(browser)
    browser.until("window.stub?.onmessage && document.getElementById('state').textContent === 'loading ...'",
                  "Enter does not run")
    assert browser.run("document.activeElement.id") == "run", "the focus is lost"
    browser.run("(window.first = stub, 0)")
    enter(browser)
    assert browser.run("first === stub"), "a run is begun a second time"
    told = browser.run(RUN)
    heard = told["heard"]
    assert browser.run("document.querySelector('[role=status]').id") == "heard"
    assert "running" in heard and heard[-1].startswith("finished at"), heard
    assert 10 <= len(heard) <= 14, heard
    tenths = [text for text in heard if text.startswith("t = ")]
    assert [float(text.split()[2]) for text in tenths][:9] == [10 * k for k in range(1, 10)], tenths
    assert len(told["state"]) < 60, f"{len(told['state'])} texts in a moment"
    assert browser.run("document.activeElement.id") == "run"


def main():
    if not chromium.path():
        skip("Chromium is not installed")
    if not PLAYBACK.exists():
        skip("the viewer's page is not built (make viewer)")
    with tempfile.TemporaryDirectory(prefix="fram-wasm-page-") as name, chromium.Browser() as browser:
        folder = pathlib.Path(name)
        (folder / "simulator.js").write_text("", encoding="utf-8")
        (folder / "none.txt").write_text("no library", encoding="utf-8")
        page = folder / "fram.html"
        subprocess.run([sys.executable, SOURCE / "tools/wasm_page.py", folder / "simulator.js", PLAYBACK, page,
                        folder / "none.txt"], check=True, capture_output=True)
        browser.call("Page.navigate", url=page.as_uri())
        browser.until("window.simulation?.state === 'ready'", "the page does not get ready")
        browser.run(STAND_IN)
        check_room(browser)
        check_said(browser)
        assert not browser.complaints, browser.complaints
        browser.call("Emulation.setScriptExecutionDisabled", value=True)
        browser.call("Page.navigate", url=page.as_uri())
        browser.until("document.querySelector('noscript p')?.getBoundingClientRect().height > 0",
                      "nothing tells that JavaScript is off")
    print("the scene has room, what is read aloud is short, and the focus stays")


main()
