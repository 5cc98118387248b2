#!/usr/bin/env python3
"""The playback page for those who see, hear or point otherwise, in headless Chromium: arrows that stand out.

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


def main():
    if not chromium.path():
        skip("Chromium is not installed")
    if not PAGE.exists():
        skip("the viewer's page is not built (make viewer)")
    with tempfile.TemporaryDirectory() as name, chromium.Browser() as browser:
        folder = pathlib.Path(name)
        moored = make_page(folder, "moored", MOORED)
        browser.open(moored)
        for check in (check_edges,):
            check(browser)
        assert not browser.complaints, browser.complaints
    print("the playback page is seen")


main()
