#!/usr/bin/env python3
"""The playback page for those who see, hear or point otherwise, in headless Chromium: arrows that stand
out, colours that are forced, the view without a mouse, what moves by itself, what is read aloud and on paper.

Skipped (77) without Chromium or without the viewer's page.
"""
import os
import pathlib
import subprocess
import sys
import tempfile

import chromium

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
from skipping import skip  # noqa: E402  (tests is no package)

FRAM = os.environ["FRAM"]
PAGE = pathlib.Path(os.environ["FRAM_SOURCE"]) / "build" / "viewer" / "playback.html"
MOORED = """
title: Moored in drifting ice
run: {duration: 8, time_step: 0.02, seed: 3}
vessel:
  mode: free
  hull: {length: 48, beam: 12, draught: 4, freeboard: 2}
  mooring: {depth: 60, lines: [{count: 4, spacing_deg: 90, distance: 300, pretension: 2.0e5}]}
ice: {concentration: 0.75, mean_floe_area: 64, thickness: 0.3, breakable: true}
domain: {x_min: -64, x_max: 64, y_min: -40, y_max: 40, boundary: open}
environment: {current_speed: 2.5, current_direction_deg: 180}
output: {frame_interval: 0.25}
"""
# What part of the pixels that arrows of lines cover, without ice and lines, have their white edge within four pixels.
WHITE = """(() => {
    const { scene } = fram, canvas = document.createElement('canvas'), view = document.getElementById('view');
    const shown = [scene.mesh, scene.edges, ...scene.scene.children.filter((c) => c.isPoints || c.isLineSegments2)];
    for (const part of shown) part.visible = false;
    scene.render();
    for (const part of shown) part.visible = true;
    canvas.width = view.width; canvas.height = view.height;
    const g = canvas.getContext('2d');
    g.drawImage(view, 0, 0);
    fram.draw();
    const { data, width, height } = g.getImageData(0, 0, canvas.width, canvas.height);
    const has = (x, y, [r, h, b], off) => [r, h, b].every((v, k) => Math.abs(data[4 * (y * width + x) + k] - v) <= off);
    const pull = [0x00, 0x90, 0x58], white = [255, 255, 255];
    let drawn = 0, edged = 0;
    for (let y = 8; y < height - 8; y++)
        for (let x = 8; x < width - 8; x++) {
            if (!has(x, y, pull, 3)) continue;
            drawn++;
            edged += [-4, -3, -2, -1, 1, 2, 3, 4].some((d) => has(x + d, y, white, 25) || has(x, y + d, white, 25));
        }
    return edged / drawn;
})()"""


def make_page(folder, name, scene):
    (folder / f"{name}.yaml").write_text(scene)
    run = folder / name
    subprocess.run([FRAM, "run", folder / f"{name}.yaml", "-o", run, "--quiet"], check=True)
    subprocess.run([FRAM, "view", run, "--page", PAGE, "--quiet"], check=True)
    return run / "playback.html"


def go(browser, time):
    browser.run(f"(fram.seek({time}), fram.draw())")


def check_edges(browser):
    """Arrows have a white edge, by which they are seen on water."""
    browser.choose("camera", "orbit")
    browser.choose("colour", "plain")
    go(browser, "fram.end")
    edged = browser.run(WHITE)
    assert edged and edged > 0.8, f"{edged} of the arrows' pixels have white beside them"


BARE = """
title: Open water
run: {duration: 2, time_step: 0.1}
vessel: {mode: towed, speed: 2, hull: {length: 48, beam: 12, draught: 4, freeboard: 2}}
ice: {source: none}
domain: {x_min: -64, x_max: 64, y_min: -40, y_max: 40}
output: {frame_interval: 0.5}
"""


def emulate(browser, **features):
    browser.call("Emulation.setEmulatedMedia", features=[{"name": name.replace("_", "-"), "value": value}
                                                         for name, value in features.items()])


def check_forced(browser):
    """Where a system forces its colours, what is drawn in dark ink keeps its paper, and a list its colours."""
    browser.run("(fram.pick(fram.record.bodies.find((b) => b.number === 0)),"
                "fram.peaks.open(fram.peaks.vessel.peaks[0]), fram.pick(fram.picked ?? "
                "fram.record.bodies.find((b) => b.number === 0)), fram.draw())")
    swatch = "getComputedStyle(document.querySelector('#peak li'), '::before').backgroundColor"
    before = browser.run(swatch)
    emulate(browser, forced_colors="active", prefers_color_scheme="dark")
    for canvas in ("#timeline", "#history canvas"):
        paper = browser.run(f"getComputedStyle(document.querySelector('{canvas}')).backgroundColor")
        assert paper == "rgb(255, 255, 255)", f"under {canvas} is {paper}"
    assert browser.run(swatch) == before != "rgba(0, 0, 0, 0)", (browser.run(swatch), before)
    emulate(browser)
    browser.run("(fram.pick(null), fram.peaks.close())")


def press(browser, key, code, number, modifiers=0):
    text = {"text": key} if len(key) == 1 else {"text": "\r"} if key == "Enter" else {}
    browser.call("Input.dispatchKeyEvent", type="keyDown", key=key, code=code, windowsVirtualKeyCode=number,
                 modifiers=modifiers, **text)
    browser.call("Input.dispatchKeyEvent", type="keyUp", key=key, code=code, windowsVirtualKeyCode=number,
                 modifiers=modifiers)


SHIFT = 8
SEEN = "[fram.camera.controls.getAzimuthalAngle(), fram.camera.controls.getPolarAngle()," \
       "fram.camera.controls.getDistance(), ...fram.camera.controls.target]"


def check_turning(browser):
    """With the focus on the view, Shift with arrows turns it, + and - zoom, letters move it, and time stands still."""
    go(browser, 2)
    browser.run("document.getElementById('view').focus()")
    assert browser.run("document.activeElement.id") == "view", "the view cannot have the focus"
    start = browser.run(SEEN)
    for key, code, number, modifiers, changed in (
            ("ArrowLeft", "ArrowLeft", 37, SHIFT, 0), ("ArrowUp", "ArrowUp", 38, SHIFT, 1),
            ("+", "Equal", 187, SHIFT, 2), ("d", "KeyD", 68, 0, 3), ("w", "KeyW", 87, 0, 4)):
        before = browser.run(SEEN)
        press(browser, key, code, number, modifiers)
        after = browser.run(SEEN)
        assert abs(after[changed] - before[changed]) > 1e-3, f"{key} changes nothing: {before}"
        assert changed > 2 or all(abs(a - b) < 1e-6 for k, (a, b) in enumerate(zip(after, before))
                                  if k != changed), f"{key} changes {before} to {after}"
    assert browser.run(SEEN)[2] < start[2], "+ does not go nearer"
    for key, code, number, modifiers in (("a", "KeyA", 65, 0), ("s", "KeyS", 83, 0), ("-", "Minus", 189, 0),
                                         ("ArrowDown", "ArrowDown", 40, SHIFT),
                                         ("ArrowRight", "ArrowRight", 39, SHIFT)):
        press(browser, key, code, number, modifiers)
    back = browser.run(SEEN)
    assert all(abs(a - b) < 0.5 for a, b in zip(back, start)), f"there and back leads from {start} to {back}"
    assert browser.run("fram.time") == 2
    browser.run("document.getElementById('play').focus()")
    press(browser, "d", "KeyD", 68)
    assert browser.run(SEEN) == back, "a letter elsewhere moves the view"


def check_picking(browser):
    """N and P pick floes that are seen, the nearest to the middle first, and what is told of them is read aloud."""
    browser.run("(fram.pick(null), document.getElementById('view').focus())")
    picked = []
    for key, code, number in (("n", "KeyN", 78),) * 3 + (("p", "KeyP", 80),):
        press(browser, key, code, number)
        picked.append(browser.run("fram.picked?.number ?? -1"))
    assert len(set(picked[:3])) == 3 and -1 not in picked and picked[3] == picked[1], picked
    far = browser.run("""(() => { const { pose } = fram.poses, { x, y } = fram.camera.controls.target;
        const far = (n) => { const k = 7 * fram.record.bodies.find((b) => b.number === n).index;
            return Math.hypot(pose[k] - x, pose[k + 1] - y); };
        return %s.map(far); })()""" % picked[:3])
    assert far == sorted(far), f"floes are not picked from the middle on: {far}"
    assert browser.run("document.getElementById('history').ariaLive") == "polite"
    assert f"Floe {picked[3]}" in browser.run("document.getElementById('history').textContent")
    press(browser, "Escape", "Escape", 27)
    assert browser.run("fram.picked") is None


def check_peak(browser):
    """Enter on the timeline leads into the panel of the peak, and closing it back."""
    browser.run("document.getElementById('timeline').focus()")
    press(browser, "Enter", "Enter", 13)
    assert browser.run("document.activeElement.id") == "larger", browser.run("document.activeElement.id")
    press(browser, "Escape", "Escape", 27)
    told = browser.run("[document.getElementById('peak').hidden, document.activeElement.id]")
    assert told == [True, "timeline"], told


def check_paper(browser):
    """On a sheet the buttons and the load follow the scene, whatever the window was."""
    browser.run("fram.resize = () => {}")  # as on paper, for which nothing is drawn anew
    browser.call("Emulation.setEmulatedMedia", media="print")
    browser.call("Emulation.setDeviceMetricsOverride", width=816, height=1056, deviceScaleFactor=1, mobile=False)
    browser.until("innerWidth === 816", "the window keeps its width")
    view, foot, ratio = browser.run("""(() => { const box = (q) => document.querySelector(q).getBoundingClientRect();
        const view = document.getElementById('view'), b = box('#view');
        return [[b.left, b.right, b.bottom], [box('footer').top, box('footer').bottom],
                b.width / b.height * view.height / view.width]; })()""")
    assert abs(foot[0] - view[2]) < 8 and foot[1] <= 1056, f"the view ends at {view[2]}, below is {foot}"
    assert view[:2] == [0, 816] and abs(ratio - 1) < 0.01, (view, ratio)
    browser.call("Emulation.setEmulatedMedia", media="")
    browser.call("Emulation.clearDeviceMetricsOverride")
    browser.run("delete fram.resize")


def check_still(browser, page):
    """It does not play by itself where things shall not move."""
    emulate(browser, prefers_reduced_motion="reduce")
    browser.call("Page.navigate", url=page.as_uri())
    browser.until("window.fram?.ready", "the page does not get ready")
    browser.run("new Promise((done) => setTimeout(done, 300))")
    assert browser.run("[fram.playing, fram.time]") == [False, 0], "it plays"
    emulate(browser)


def check_bare(browser, page):
    """Without ice nothing is coloured by what it does; the window's title is that of the run."""
    browser.open(page)
    told = browser.run("(fram.draw(), document.getElementById('legend').ariaLabel)")
    assert "vessel" in told and "contact force" not in told and "ice" not in told, told
    assert browser.run("document.title") == "Open water - Fram playback"


def main():
    if not chromium.path():
        skip("Chromium is not installed")
    if not PAGE.exists():
        skip("the viewer's page is not built (make viewer)")
    with tempfile.TemporaryDirectory() as name, chromium.Browser() as browser:
        folder = pathlib.Path(name)
        moored = make_page(folder, "moored", MOORED)
        browser.open(moored)
        for check in (check_edges, check_forced, check_turning, check_picking, check_peak, check_paper):
            check(browser)
        check_still(browser, moored)
        check_bare(browser, make_page(folder, "bare", BARE))
        assert not browser.complaints, browser.complaints
    print("the playback page is seen, heard and used without a mouse")


main()
