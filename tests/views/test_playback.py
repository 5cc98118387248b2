#!/usr/bin/env python3
"""The playback page as a user meets it, in headless Chromium: load, play, seek, pick, colours, cameras, export.

Hull, floes and water are looked for where the run says they are, in the pixels that were drawn; pictures and videos
that the page saves are opened; and the browser must have nothing to complain of.  Skipped (77) without Chromium or
without the viewer's page.
"""
import csv
import json
import math
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

import chromium
import twins

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
from skipping import skip  # noqa: E402  (tests is no package)

FRAM = os.environ["FRAM"]
SOURCE = pathlib.Path(os.environ["FRAM_SOURCE"])
PAGE = SOURCE / "build" / "viewer" / "playback.html"
# In coordinates of a map, where floats are a decimetre apart: the page counts from the middle of the domain.
MIDDLE = -1400000
TOWED = """
title: Playback test
run: {duration: 6, time_step: 0.02}
vessel:
  mode: towed
  x: -1400036
  y: 2000000
  speed: 4
  hull: {length: 48, beam: 12, draught: 4, freeboard: 2}
ice: {mean_floe_area: 64, concentration: 0.7}
domain: {x_min: -1400080, x_max: -1399920, y_min: 1999960, y_max: 2000040}
output: {frame_interval: 0.5}
"""
# Driven ice that breaks on a hull with lines and thrusters: arrows of every kind, and marks.
MOORED = """
title: "Moored <b>ship</b> # 2, \\"so\\" called"
run: {duration: 8, time_step: 0.02, seed: 3}
vessel:
  mode: free
  hull: {length: 48, beam: 12, draught: 4, freeboard: 2}
  mooring: {depth: 60, lines: [{count: 4, spacing_deg: 90, distance: 300, pretension: 2.0e5}]}
  thrusters: [{x: 18}, {x: -18}]
  positioning: {active: true}
ice: {concentration: 0.75, mean_floe_area: 64, thickness: 0.3, breakable: true}
domain: {x_min: -64, x_max: 64, y_min: -40, y_max: 40, boundary: open}
environment: {current_speed: 2.5, current_direction_deg: 180}
output: {frame_interval: 0.25}
"""
# A model in a tank: newtons on metres.
TANK = """
run: {duration: 2, time_step: 0.01, scale: 1}
vessel:
  mode: free
  hull: {length: 1.6, beam: 0.4, draught: 0.13, freeboard: 0.07}
  thrusters: [{x: -0.6, thrust: 20, setting: 1}]
ice: {mean_floe_area: 0.07, thickness: 0.03, concentration: 0.7}
domain: {x_min: -2, x_max: 3, y_min: -1.3, y_max: 1.3}
output: {frame_interval: 0.25}
"""
TITLE = 'Moored <b>ship</b> # 2, "so" called'
LOOK = """(() => {
    fram.scene.render();
    const gl = fram.scene.renderer.getContext(), out = new Uint8Array(4);
    const pixel = (x, y) => {
        const p = fram.scene.camera.position.clone().set(x, y, 0).project(fram.scene.camera);
        gl.readPixels((p.x + 1) / 2 * gl.drawingBufferWidth, (p.y + 1) / 2 * gl.drawingBufferHeight, 1, 1, gl.RGBA,
                      gl.UNSIGNED_BYTE, out);
        return [...out];
    };
    const pose = (b) => [...fram.poses.pose.subarray(7 * b.index, 7 * b.index + 3)];
    const ice = fram.record.bodies.filter((b) => b.material === 'ice' && fram.poses.shown[b.index]);
    const hull = pose(fram.hull), clear = (p) => Math.abs(p[0] - hull[0]) > 35 || Math.abs(p[1] - hull[1]) > 12;
    return { hull, hullPixel: pixel(hull[0], hull[1]), floes: ice.length, waterPixel: pixel(114, 0),
             floePixels: ice.map(pose).filter(clear).map((p) => pixel(p[0], p[1])), time: fram.time };
})()"""
# Of floes that lie clear of the vessel and of the boxes over the view: where on the page one is.
FLOE = """(() => {
    const c = fram.scene.camera, box = document.getElementById('view').getBoundingClientRect();
    for (const b of fram.record.bodies) {
        if (b.material !== 'ice' || !fram.poses.shown[b.index] || b.area < 40) continue;
        const at = 7 * b.index, p = c.position.clone().set(fram.poses.pose[at], fram.poses.pose[at + 1], 0).project(c);
        const x = box.left + (p.x + 1) / 2 * box.width, y = box.top + (1 - p.y) / 2 * box.height;
        if (x > 400 && x < box.width - 300 && y > 200 && y < box.height - 60) return [x, y, b.number];
    }
    return null;
})()"""


def is_deck(p):
    return p[0] > 1.2 * p[2] and p[0] > p[1] and p[0] > 60


def is_white(p):
    return min(p[:3]) > 150


def is_blue(p):
    return p[2] > 1.2 * p[0] and p[2] > 60


def make_run(folder, name, scene):
    (folder / f"{name}.yaml").write_text(scene)
    run = folder / name
    subprocess.run([FRAM, "run", folder / f"{name}.yaml", "-o", run, "--quiet"], check=True)
    subprocess.run([FRAM, "view", run, "--page", PAGE, "--quiet"], check=True)
    with open(run / "series.csv", newline="") as file:
        rows = [{k: float(v) for k, v in row.items()} for row in csv.DictReader(file)]
    return run, rows


def go(browser, time):
    browser.run(f"(fram.seek({time}), fram.draw())")
    browser.until("!fram.waiting || (fram.draw(), !fram.waiting)", "a frame from beside the page does not come")


def check_places(browser, expected_x, tolerance=1e-3):
    view = browser.run(LOOK)
    assert abs(view["hull"][0] + MIDDLE - expected_x) < tolerance, (view["hull"], expected_x)
    assert is_deck(view["hullPixel"]), f"no hull at its place: {view['hullPixel']}"
    assert is_blue(view["waterPixel"]), f"no water beside the field: {view['waterPixel']}"
    floes = len(view["floePixels"])
    white = sum(is_white(p) for p in view["floePixels"])
    assert floes > 30, "too few floes to look at"
    assert white >= 0.97 * floes, f"{white} of {floes} floes are drawn at their place"
    return view


def check_opening(browser, page):
    """The page plays by itself, looks at the vessel and colours by contact force; a narrow window hides nothing."""
    browser.call("Page.navigate", url=page.as_uri())
    browser.until("window.fram?.ready && fram.time > 0.5", "the page does not play when it is opened")
    assert browser.run("[camera.value, colour.value]") == ["follow", "force"]
    off = browser.run("""(() => { const at = fram.camera.centre().clone().project(fram.scene.camera);
        return Math.hypot(at.x, at.y); })()""")
    assert off < 0.1, f"the vessel is {off} of the window off its middle"
    browser.call("Emulation.setDeviceMetricsOverride", width=420, height=720, deviceScaleFactor=1, mobile=False)
    box = "const box = (q) => document.querySelector(q).getBoundingClientRect();"
    all_of = """['header', '#legend', '#timeline', ...[...document.querySelectorAll('#buttons > *')]
        .filter((b) => !b.hidden).map((b) => '#' + (b.id || b.querySelector('[id]').id))].map(box)"""
    for holds, complaint in (
            (f"{all_of}.every((b) => b.left >= 0 && b.right <= 420 && b.bottom <= 720)", "something lies outside"),
            ("Math.abs(box('#view').bottom - box('footer').top) <= 1", "the view goes on under the buttons"),
            ("box('header').bottom <= box('#legend').top", "the legend covers the title")):
        browser.until(f"innerWidth === 420 && (() => {{ {box} return {holds}; }})()",
                      f"in a window of 420 pixels {complaint}")
    check_whole_domain(browser, 390, 844)
    # A phone's window grows with what sticks out of its screen: the view takes the screen, also after a turn and back.
    for width, height in ((720, 420), (420, 720)):
        browser.call("Emulation.setDeviceMetricsOverride", width=width, height=height, deviceScaleFactor=1, mobile=True)
        browser.until(f"innerWidth === {width} && document.getElementById('view').clientWidth === {width}",
                      f"on a phone of {width} pixels window or view are not as wide")
    browser.call("Emulation.clearDeviceMetricsOverride")


def check_whole_domain(browser, width, height):
    """From the top and in orbit all corners of the domain are in a window of this shape."""
    browser.call("Emulation.setDeviceMetricsOverride", width=width, height=height, deviceScaleFactor=1, mobile=False)
    browser.until(f"innerWidth === {width} && document.getElementById('view').clientWidth === {width}",
                  "the view does not take the window")
    for camera in ("top", "orbit"):
        browser.choose("camera", camera)
        far = browser.run("""(() => { const { camera, box } = fram.scene;
            camera.updateMatrixWorld();
            return [box.min.x, box.max.x].flatMap((x) => [box.min.y, box.max.y].map((y) => {
                const p = camera.position.clone().set(x, y, 0).project(camera);
                return Math.max(Math.abs(p.x), Math.abs(p.y)); })); })()""")
        assert max(far) < 1.001, f"at {width} x {height} the view {camera} ends short of corners: {far}"
        assert max(far) > 0.9, f"at {width} x {height} the view {camera} is far off: {far}"
    browser.choose("camera", "follow")
    check_saved_head(browser)


def check_towed(browser, run, rows):
    browser.open(run / "playback.html")
    browser.choose("camera", "top")
    browser.choose("colour", "plain")
    go(browser, 0)
    check_places(browser, rows[0]["position_x[m]"] - 0.08)
    go(browser, "fram.end")
    end = check_places(browser, rows[-1]["position_x[m]"])
    assert end["floes"] == rows[-1]["floes[1]"]
    # A floe is where the run says at half time, which is between two frames too.
    go(browser, 3.25)
    half = check_places(browser, next(r for r in rows if abs(r["time[s]"] - 3.25) < 0.011)["position_x[m]"], 0.05)
    assert abs(half["time"] - 3.25) < 1e-9


def check_play(browser):
    go(browser, 0)
    browser.click_on("play")
    browser.until("fram.time > 0.5", "a click on play does not play")
    browser.click_on("play")
    stopped = browser.run("fram.time")
    browser.run("new Promise((done) => setTimeout(done, 150))")
    assert browser.run("fram.time") == stopped, "a click on pause does not stop"


def check_seek(browser):
    left, top, width, height = browser.box("timeline")
    for part in (0.75, 0.25):
        browser.click(left + part * width, top + height / 2)
        time, end = browser.run("[fram.time, fram.timeline.span]")
        assert abs(time - part * end) < 0.01 * end, f"a click at {part} of the timeline leads to {time} s of {end} s"
    before = browser.run("fram.time")
    browser.call("Input.dispatchKeyEvent", type="keyDown", code="ArrowRight", key="ArrowRight")
    step = browser.run("fram.time") - before
    assert 0 < step <= 0.5, f"an arrow key goes on by {step} s"
    # Between two frames to the one that is next; at a frame, be it to rounding, to that after it.
    times = browser.run("fram.record.frames.map((f) => f.time)")
    last, five, six = len(times) - 1, times[5], times[6]
    for at, back, on in ((five + 0.4 * (six - five), 5, 6), (five + 0.6 * (six - five), 5, 6), (six, 5, 7),
                         (six + 1e-9, 5, 7), (six - 1e-9, 5, 7), (0, 0, 1), (times[last], last - 1, last)):
        for key, expected in (("ArrowLeft", back), ("ArrowRight", on)):
            browser.run(f"fram.seek({at})")
            browser.call("Input.dispatchKeyEvent", type="keyDown", code=key, key=key)
            time = browser.run("fram.time")
            assert time == times[expected], f"{key} leads from {at} s to {time} s, not to {times[expected]} s"


def check_keyboard(browser):
    """A control that has the focus keeps its keys; elsewhere the space bar plays."""
    press = {"code": "Space", "key": " ", "windowsVirtualKeyCode": 32}
    for focused, expected in (("forces", [False, False]), ("forces", [True, False]), (None, [True, True])):
        browser.run(f"document.getElementById('{focused}').focus()" if focused else "document.activeElement.blur()")
        browser.call("Input.dispatchKeyEvent", type="keyDown", text=" ", **press)
        browser.call("Input.dispatchKeyEvent", type="keyUp", **press)
        seen = browser.run("[document.getElementById('forces').checked, fram.playing]")
        assert seen == expected, f"space with the focus on {focused}: {seen}"
    browser.run("fram.toggle()")
    # A list keeps the focus after its own keys, not after a pointer; Escape closes from there too.
    browser.run("(fram.pick(fram.record.bodies.find((b) => b.number === 0)), document.getElementById('speed').focus())")
    for code, number in (("ArrowDown", 40), ("Escape", 27)):
        browser.call("Input.dispatchKeyEvent", type="keyDown", code=code, key=code, windowsVirtualKeyCode=number)
        browser.call("Input.dispatchKeyEvent", type="keyUp", code=code, key=code)
    seen = browser.run("[document.activeElement.id, fram.picked, document.getElementById('speed').value]")
    assert seen == ["speed", None, "10"], f"after an arrow key and Escape on a list: {seen}"
    browser.run("""(() => { const list = document.getElementById('speed');
        list.dispatchEvent(new PointerEvent('pointerdown', { bubbles: true }));
        list.value = '5';
        list.dispatchEvent(new Event('change', { bubbles: true })); })()""")
    assert browser.run("document.activeElement.id") != "speed", "a list that was used with a pointer keeps the keys"


def check_names(browser):
    """What is drawn has a name to be read aloud, the time is a slider with a value, and messages are told at once."""
    go(browser, 2)
    nodes = [n for n in browser.call("Accessibility.getFullAXTree")["nodes"] if not n["ignored"]]
    named = {(n["role"]["value"], n["name"]["value"]) for n in nodes if "name" in n}
    for role in ("image", "slider", "button", "combobox", "checkbox"):
        assert all(name for r, name in named if r == role), (role, named)
    images = " ".join(name for role, name in named if role == "image")
    assert "legend: floe" not in images and "legend: ice, vessel" in images, images
    assert {("application", "the run in space"), ("slider", "time"), ("button", "play")} <= named, named
    slider = browser.run("['ariaValueNow', 'ariaValueText', 'ariaDescription'].map((k) => "
                         "document.getElementById('timeline')[k])")
    assert slider[:2] == ["2.0", "2.0 s"] and slider[2].startswith("ice load on the vessel"), slider
    assert browser.run("document.getElementById('note').role") == "alert"
    browser.run("fram.toggle()")
    assert browser.run("document.getElementById('play').ariaLabel") == "pause"
    browser.run("fram.toggle()")


def check_few(browser, folder):
    """No ice at all: water up to the walls.  A sheet that nothing has met is no floe; ends are told as they are."""
    for name, ice, clock in (("open", "{source: none}", "0 floes"),
                             ("sheet", "{source: level, level: {x_min: -1399956, tile_size: 20}}", "level ice")):
        scene = TOWED.replace("{mean_floe_area: 64, concentration: 0.7}", ice).replace("duration: 6", "duration: 0.8")
        run, _ = make_run(folder, name, scene)
        browser.open(run / "playback.html")
        browser.choose("camera", "top")
        browser.choose("colour", "plain")
        go(browser, 0)
        told = browser.run("document.getElementById('clock').textContent")
        assert told == f"t = 0.00 s of 0.5 s, {clock}", told
        corners = [browser.run(LOOK.replace("pixel(114, 0)", f"pixel({x}, {y})"))["waterPixel"]
                   for x, y in ((-76, -36), (-76, 36), (34, -36), (34, 36))]
        assert all(is_blue(p) for p in corners), (name, corners)
    check_open_water(browser, folder)


def check_open_water(browser, folder):
    """A ship without ice or walls stays on the water and in the cameras that show all, to the end of its domain; beside
    it the camera is near, and arrows are no longer than it, however large that is and far away another ship."""
    scene = TOWED.replace("{mean_floe_area: 64, concentration: 0.7}", "{source: none}").replace("speed: 4", "speed: 99")
    ship = scene[scene.index("vessel:"):scene.index("ice:")]
    first = ship.replace("vessel:\n  mode", "vessels:\n- name: one\n  mode")
    other = re.sub("mode.*", "mode: prescribed", re.sub("  speed.*\n|vessels:\n", "", first)).replace("one", "two")
    run, _ = make_run(folder, "sails", scene.replace(ship, first + other.replace("-1400036", "-1399330"))
                       .replace("x_max: -1399920", "x_max: -1399300, boundary: open"))
    browser.open(run / "playback.html")
    browser.choose("colour", "plain")
    for camera in ("top", "orbit"):
        browser.choose("camera", camera)
        go(browser, "fram.end")
        seen = browser.run(LOOK.replace("114, 0", "hull[0], hull[1] + 45"))
        assert seen["hull"][0] > 150, seen["hull"]
        assert is_deck(seen["hullPixel"]) and is_blue(seen["waterPixel"]), (camera, seen)
    browser.choose("camera", "below")
    reach = browser.run("""(() => { const { camera } = fram.scene, { index, vertices } = fram.hull, out = [];
        fram.draw(); camera.updateMatrixWorld();
        const [x, y, z] = fram.poses.pose.subarray(7 * index);
        for (let i = 0; i < vertices.length; i += 3)
            out.push(...camera.position.clone().set(x + vertices[i], y + vertices[i + 1], z + vertices[i + 2])
                .project(camera).toArray().slice(0, 2).map(Math.abs));
        return Math.max(...out); })()""")
    assert 0.3 < reach < 1, f"from below a ship reaches {reach} of the way to the edge of the view"
    browser.choose("camera", "follow")
    ends = """[-24, 24].map((x) => fram.camera.centre().add({ x, y: 0, z: 0 }).project(fram.scene.camera))
        .map((p) => [p.x / 2 * innerWidth, p.y / 2 * fram.room().height])"""
    long, (arrow, thick) = math.dist(*browser.run(ends)), browser.run("""[fram.colours.arrowScale *
        fram.colours.ends.pulls.value, fram.scene.arrowWidth]""")
    assert 250 < long < 1200, f"a ship of 48 m is {long} pixels long"
    assert 2 < arrow < 24 and thick < 12, f"arrows of {arrow} m and {thick} m beside a ship of 48 m"
    browser.choose("camera", "top")
    seen = browser.run("""(() => { const { box, camera } = fram.scene; box.max.x = 1e5; fram.placeCamera();
        return camera.position.distanceTo(fram.camera.controls.target) / camera.far; })()""")
    assert 0 < seen < 1, f"of a domain of 100 km the camera sees {1 / seen} of the way"


def check_no_vessel(browser, folder):
    run, _ = make_run(folder, "ice", """
run: {duration: 0.1, time_step: 0.02}
vessel: {present: false}
ice: {source: floes, floes: [{x: 0, y: 0, length: 20, width: 10}]}
domain: {x_min: -40, x_max: 40, y_min: -30, y_max: 30}
output: {frame_interval: 0.02}
""")
    browser.open(run / "playback.html")
    browser.run("fram.draw()")
    told = browser.run("document.getElementById('timeline').ariaDescription")
    assert told == "no vessel", told


def check_tank(browser, folder):
    """What is told and drawn of a model is as large as it is: colours, loads, arrows, water, propellers."""
    run, rows = make_run(folder, "tank", TANK)
    browser.open(run / "playback.html")
    go(browser, "fram.end")
    most = max(math.hypot(r["ice_force_averaged_x[N]"], r["ice_force_averaged_y[N]"]) for r in rows)
    assert 0.1 < most < 1e3, f"loads of {most} N are not those of a model"
    told = browser.run("document.getElementById('load').textContent")
    found = re.fullmatch(r"averaged ice force: X (-?[0-9.]+) N, Y (-?[0-9.]+) N", told)
    told_x, x = float(found[1] if found else "nan"), rows[-1]["ice_force_averaged_x[N]"]
    assert math.isclose(told_x, x, abs_tol=0.005 * most), (told, x)
    unit, ends = browser.run("[fram.legend.content.unit, fram.legend.content.ends]")
    assert unit == "contact force [N]" and 0.1 < ends[1] < 100, (unit, ends)
    words = browser.run("fram.legend.words(fram.seen())")
    assert re.search(r"; [0-9.]+ m: [0-9.]+ N(;|$)", words), words
    # The same of loads of any size.
    told = browser.run("""(() => { const { timeline, colours } = fram, { most } = timeline, { force } = colours.ranges;
        const out = [0, 0.0023, 0.3, 9.9, 10, 41, 37000].map((m) => (timeline.most = m, fram.loadText(-290)));
        timeline.most = most;
        for (const end of [9, 10, 999, 3.7e7]) {
            colours.ranges.force = [0, end];
            out.push(Object.values(colours.scale('force')).join());
        }
        colours.ranges.force = force;
        return out; })()""")
    assert told[:7] == ["-290 N", "-290.00 N", "-290 N", "-290 N", "-290 N", "-290 N", "-290 N"], told
    assert told[7:] == ["contact force [N],0,9000", "contact force [kN],0,10", "contact force [kN],0,999",
                        "contact force [MN],0,37000"], told
    assert browser.run("fram.colours.ranges.force[1]") < 0.1, "no floe takes a colour"
    wide = browser.run("fram.scene.box.max.x - fram.scene.box.min.x")
    assert wide < 10, f"{wide} m for a tank of 5 m: the model is lost in it"
    disc = browser.run("fram.scene.station.thrusters[0].disc")
    assert math.isclose(disc, math.sqrt(4 * 20 / (math.pi * 45e3 / 30)), rel_tol=1e-6), disc
    assert browser.run("fram.scene.station.thrusters[0].axis.x") > 0.9


def check_late_contact(browser, folder):
    """A few frames, ice in the last of them alone: its arrows are as long as they should, and named."""
    run, _ = make_run(folder, "late", """
run: {duration: 2, time_step: 0.02}
vessel: {mode: towed, x: -20, speed: 4, hull: {length: 48, beam: 12, draught: 4, freeboard: 2}}
ice: {source: floes, floes: [{x: 16.5, y: 0, length: 12, width: 12}]}
domain: {x_min: -64, x_max: 96, y_min: -40, y_max: 40}
output: {frame_interval: 0.25}
""")
    # Of a page with its frames in files beside it too, of which few are looked at.
    beside = ["--page-limit", "0.1", "-o", run / "beside.html"]
    subprocess.run([FRAM, "view", run, "--page", PAGE, "--quiet", *beside], check=True)
    browser.open(run / "beside.html")
    met, kinds, longest = browser.run("""(() => { const { frames } = fram.record, { kinds, arrowScale } = fram.colours;
        return [frames.some((f) => !f.view && f.force[0] < 0), kinds,
                Math.max(...frames.map((f) => -f.force[0])) * arrowScale]; })()""")
    assert met and kinds == ["ice"] and 5 < longest < 40, (met, kinds, longest)
    browser.open(run / "playback.html")
    touched, kinds, longest, most, high = browser.run("""(() => {
        const frames = fram.record.frames.map((_, i) => fram.store.get(i));
        const pulls = frames.flatMap((f) => f.forces.map((one) => Math.hypot(...one.force)));
        const { kinds, arrowScale, ranges } = fram.colours;
        return [frames.map((f) => f.forces.length > 0), kinds, Math.max(...pulls) * arrowScale,
                Math.max(...frames.map((f) => f.contact[1])), ranges.force[1]]; })()""")
    assert not any(touched[:6]) and any(touched), f"ice is to be met late: {touched}"
    assert kinds == ["ice"], f"arrows without a name: {kinds}"
    assert 5 < longest < 40, f"the longest arrow has {longest} m beside a ship of 48 m"
    assert 0.5 * most < high <= most, f"colours end at {high} kN where {most} kN is the most"


def check_level(browser, folder):
    """What is told of a tile of level ice that is no more: of those that break together one has a fracture, and what a
    hull cuts has none.  None of them left."""
    scene = """
run: {{duration: 6, time_step: 0.02}}
vessel: {{mode: towed, x: -24, speed: 4, hull: {{length: 48, beam: 12, draught: 4, freeboard: 2}}}}
ice: {{source: level, level: {{x_min: 0, tile_size: {size}}}, thickness: 0.4, breakable: {breaks}}}
domain: {{x_min: -64, x_max: 64, y_min: -32, y_max: 32}}
output: {{frame_interval: 0.25}}
"""
    for name, breaks, size, fates, origin in (
            ("breaks", "true", 16, ["broke with a neighbour, or was cut by a hull"], "what the break of tile "),
            ("cut", "false", 6, ["cut by a hull by ", "or was cut by a hull"], "what is left of tile ")):
        run, _ = make_run(folder, name, scene.format(breaks=breaks, size=size))
        browser.open(run / "playback.html")
        told = browser.run("""(() => {
            const { bodies, fractures, frames } = fram.record, broke = new Set(fractures.map((f) => f.floe));
            const tell = (b) => (fram.pick(b), document.getElementById('history').innerText);
            const tiles = bodies.filter((b) => b.level), gone = tiles.filter((b) => b.death < frames.length);
            return [gone.filter((b) => !broke.has(b.number)).map(tell), tiles.filter((b) => b.parent >= 0).map(tell),
                    gone.filter((b) => broke.has(b.number)).map(tell)]; })()""")
        unnamed, pieces, named = told
        assert len(unnamed) > 1 and len(pieces) > 1 and (len(named) > 1) == (breaks == "true"), told
        assert all(any(fate in text for fate in fates) and "\nleft at " not in text for text in unnamed), unnamed
        assert all(any(fate in text for text in unnamed) for fate in fates), unnamed
        assert all(origin in text for text in pieces), pieces
        assert all("broke at " in text or "came loose at " in text for text in named), named


def check_waiting(browser, folder):
    """A page that follows a run says that it waits, and in the end that there was nothing to wait for."""
    page = folder / "follows.html"
    page.write_text(PAGE.read_text().replace("<!--BESIDE-->", "").replace("<!--RECORD-->", ""))
    browser.call("Page.navigate", url=page.as_uri())
    state = "['waiting', 'note'].map((k) => document.getElementById(k)).map((e) => !e.hidden && e.textContent)"
    browser.until("window.framEnd", "the page follows nothing")
    assert browser.run(state) == ["waiting for the first frame ...", ""], browser.run(state)
    browser.run("framEnd()")
    assert browser.run(state) == [False, "The run left no frames."], browser.run(state)


def check_long_title(browser):
    """It takes two lines beside the legend, and neither that nor the history lies on it."""
    heads = browser.run("""(() => { const title = document.getElementById('title'), before = title.textContent;
        title.textContent = 'word '.repeat(100);
        const history = document.getElementById('history');
        history.hidden = false;
        const box = (q) => document.querySelector(q).getBoundingClientRect();
        const out = [box('header').right <= box('#legend').left, box('header').bottom <= box('#history').top];
        history.hidden = true;
        title.textContent = before;
        return out; })()""")
    assert heads == [True, True], heads


def check_pick(browser):
    browser.choose("camera", "top")
    go(browser, "fram.end / 2")
    x, y, number = browser.run(FLOE)
    browser.click(x, y)
    assert browser.run("fram.picked?.number") == number, "a click on a floe does not pick it"
    text = browser.run("document.getElementById('history').innerText")
    assert f"Floe {number}" in text and "m thick" in text, text
    browser.run("fram.draw()")
    inked = browser.run("""(() => { const c = document.querySelector('#history canvas');
        const d = c.getContext('2d').getImageData(0, 0, c.width, c.height).data;
        let n = 0; for (let i = 3; i < d.length; i += 4) n += d[i] > 0; return n / (c.width * c.height); })()""")
    assert inked > 0.02, f"the history of a floe is blank: {inked}"
    scrolled = browser.run("""(() => { const { history } = fram, { style } = document.getElementById('history');
        const { fate } = history;
        return [() => 'a line<br>'.repeat(99), fate].map((tell) => {
            Object.assign(history, { fate: tell }).grow(); return style.pointerEvents; }); })()""")
    assert scrolled == ["auto", ""], f"the pointer on a history that grows and shrinks again: {scrolled}"
    check_ratio(browser)
    if browser.run("!document.getElementById('whole').hidden"):
        check_whole_history(browser)
    assert browser.run("fram.history.rows.size === Math.min(fram.picked.death, fram.record.frames.length) - "
                       "fram.picked.birth"), "the history has not all frames"
    browser.click(browser.box("view")[2] / 2, 4)
    assert browser.run("document.getElementById('history').hidden"), "a click on the water does not let go"
    more = browser.run("""(() => { const gl = fram.scene.renderer.getContext(), { createBuffer, deleteBuffer } = gl;
        let buffers = 0;
        gl.createBuffer = () => (buffers++, createBuffer.call(gl));
        gl.deleteBuffer = (b) => (buffers--, deleteBuffer.call(gl, b));
        const floes = fram.record.bodies.filter((b) => fram.poses.shown[b.index] && b.number >= 0);
        floes.slice(0, 8).forEach((b) => { fram.pick(b); fram.draw(); });
        fram.pick(null);
        Object.assign(gl, { createBuffer, deleteBuffer });
        return buffers; })()""")
    assert more < 3, f"eight picks leave {more} buffers behind"


def check_ratio(browser):
    """On a screen with finer pixels the view is drawn with as many, and the time stays at its place of a history."""
    mark = """(() => { fram.draw();
        const c = document.querySelector('#history canvas'), view = document.getElementById('view');
        const g = new OffscreenCanvas(c.width, 1).getContext('2d', { willReadFrequently: true });
        g.drawImage(c, 0, 1 - c.height);
        const d = g.getImageData(0, 0, c.width, 1).data;
        let first = -1;
        for (let i = 0; i < d.length && first < 0; i += 4) if (d[i] > 150 && d[i + 1] < 90 && d[i + 3] > 200) first = i;
        return [first / 4 / c.width, view.width / view.clientWidth, devicePixelRatio]; })()"""
    at, *before = browser.run(mark)
    size = {name: browser.run(f"inner{name.title()}") for name in ("width", "height")}
    browser.call("Emulation.setDeviceMetricsOverride", **size, deviceScaleFactor=2, mobile=False)
    browser.until("fram.scene.renderer.getPixelRatio() === 2", "the view does not hear of a screen with finer pixels")
    then, *after = browser.run(mark)
    assert before == [1, 1] and after == [2, 2], f"pixels of the view and of the screen: {before}, {after}"
    assert at > 0.05 and abs(then - at) < 0.02, f"the time in the history goes from {at} to {then} of its width"
    for ratio in (1.25, 1.5, 1):
        browser.call("Emulation.setDeviceMetricsOverride", **size, deviceScaleFactor=ratio, mobile=False)
        browser.until(f"devicePixelRatio === {ratio} && fram.scene.renderer.getPixelRatio() === {ratio}",
                      f"the view does not hear of a change to {ratio} pixels")
    browser.call("Emulation.clearDeviceMetricsOverride")


def check_whole_history(browser):
    """Of a page with files beside it, on a click: file after file, told, to the last frame; the same as of one file."""
    assert "frames of its history" in browser.run("document.getElementById('whole').textContent")
    browser.run("""(fram.told = [], new MutationObserver(() =>
        fram.told.push(document.getElementById('whole').textContent)).observe(document.getElementById('whole'),
        { childList: true }), 0)""")
    browser.click_on("whole")
    browser.until("document.getElementById('whole').hidden", "the history is not fetched")
    told = browser.run("fram.told")
    assert any(" of " in t and t.startswith("file ") for t in told), told
    assert browser.run("fram.chunks.kept.size") <= 4, "all files are kept at once"


def check_colours(browser):
    """Each way to colour changes the picture and names its unit; age tells broken floes from others."""
    seen = {}
    go(browser, "fram.end")
    for mode in ("plain", "speed", "force", "thickness", "age"):
        browser.choose("colour", mode)
        browser.run("fram.draw()")
        seen[mode] = (browser.run("fram.legend.content.unit"), browser.run("[...fram.colours.rgb]"))
    units = [unit for unit, _ in seen.values()]
    assert units[0] is None and all("[" in unit for unit in units[1:]), units
    for mode in ("speed", "force", "age"):
        assert seen[mode][1] != seen["plain"][1], f"colour by {mode} changes nothing"
    # What is left of a tile of level ice has a parent, but it is not what broke off.
    ages = browser.run("""(() => {
        const piece = fram.record.bodies.find((b) => b.parent >= 0);
        const age = () => (fram.colours.tabulate(), fram.colours.brokeAt[piece.index]);
        piece.level = true;
        const tile = age();
        piece.level = false;
        return [Number.isNaN(tile), Number.isNaN(age())]; })()""")
    assert ages == [True, False], f"what has no age: tile, piece: {ages}"
    # The ages of a run that grows go by its length, wherever the view stands.
    oldest = browser.run("""(() => {
        const { end } = fram;
        fram.end = fram.record.frames[0].time + 400;
        fram.findRanges();
        const [, oldest] = fram.colours.ranges.age;
        fram.end = end;
        fram.findRanges();
        return oldest; })()""")
    assert oldest == 100, oldest
    browser.choose("colour", "plain")


def check_speeds(browser):
    """Where there is no next pose, at the end and of a floe that breaks, a speed is that of the way from the frame
    before."""
    at_end, at_break, off = browser.run("""(() => {
        const { poses, record } = fram, { frames, bodies } = record, last = frames.length - 1, speeds = [[], []];
        const show = (f) => (poses.show(f), poses.pose.slice());
        let off = 0;
        for (let f = 1; f <= last; f++) {
            const before = show(f - 1), now = show(f), span = frames[f].time - frames[f - 1].time;
            for (const b of bodies) {
                if (!b.moves || b.birth >= f || (f === last ? b.death <= f : b.death !== f + 1)) continue;
                const k = 7 * b.index, way = Math.hypot(now[k] - before[k], now[k + 1] - before[k + 1]);
                speeds[f === last ? 0 : 1].push(poses.speed[b.index]);
                off = Math.max(off, Math.abs(poses.speed[b.index] - way / span));
            }
        }
        return [...speeds, off]; })()""")
    assert len(at_end) > 30 and max(at_end) > 0.5, "all is at rest in the last frame"
    assert len(at_break) > 2 and max(at_break) > 0.5, f"floes rest before they break: {at_break}"
    assert off < 1e-5, off


def check_arrows_and_marks(browser):
    go(browser, "fram.end")
    kinds = browser.run("fram.poses.forces.map((f) => f.kind)")
    assert {"ice", "line", "thruster"} <= set(kinds), kinds
    shown, marks = browser.run("[fram.scene.arrows.count, fram.scene.markers.geometry.drawRange.count]")
    assert 0 < shown <= len(kinds) and marks > 0, (shown, len(kinds), marks)
    browser.click_on("forces")
    browser.run("fram.draw()")
    assert browser.run("fram.scene.arrows.count") == 0, "arrows stay when they are switched off"
    browser.click_on("forces")


def check_cameras(browser):
    """Top looks straight down with Y up; follow keeps its distance to the hull; Y points to the same side as drawn."""
    views = {}
    for camera in ("orbit", "follow", "top"):
        browser.choose("camera", camera)
        go(browser, "fram.end / 2")
        views[camera] = browser.run("[...fram.scene.camera.position, fram.seen().angle]")
    assert len({tuple(v[:3]) for v in views.values()}) == 3, views
    assert abs(views["top"][3]) < 0.02, f"north is not up in the view from the top: {views['top']}"
    assert -1.2 < views["orbit"][3] < -0.2, f"Y points up and left in the orbit view: {views['orbit']}"
    browser.choose("camera", "follow")
    away = "[...fram.scene.camera.position.clone().sub(fram.camera.centre())]"
    go(browser, 0.5)
    first = browser.run(away)
    go(browser, "fram.end")
    assert all(abs(a - b) < 1e-3 for a, b in zip(first, browser.run(away))), "the camera does not follow"


def check_saved_head(browser):
    """In a picture that is saved a long title ends before the legend: the water is seen between them."""
    seen = browser.run("""(() => { const title = document.getElementById('title'), before = title.textContent;
        title.textContent = 'word '.repeat(50);
        fram.draw();
        const view = document.getElementById('view'), ratio = view.width / view.clientWidth;
        const [out, raw] = [0, 1].map(() => document.createElement('canvas'));
        for (const c of [out, raw]) c.getContext('2d', { willReadFrequently: true });
        fram.film.compose(out);
        raw.width = out.width; raw.height = out.height;
        raw.getContext('2d').drawImage(view, 0, 0);
        title.textContent = before;
        const left = view.clientWidth - fram.legend.width - 12;
        return [20, left - 6, left + 6].map((x) => [out, raw].map((c) =>
            c.getContext('2d').getImageData(x * ratio, 30 * ratio, 1, 1).data.join())); })()""")
    assert [a == b for a, b in seen] == [False, True, False], f"box of the title, gap, legend: {seen}"


def check_still(browser):
    check_saved_head(browser)
    browser.click_on("picture")
    png = browser.file(".png").read_bytes()
    width, height, *_ = chromium.pixels(png)
    assert [width, height] == browser.run("[document.getElementById('view').width,"
                                          "document.getElementById('view').height]")
    assert chromium.colours(png) > 200, "the picture is blank"


def check_video(browser):
    # Slowly until it has some pictures, however long the machine takes for one.
    browser.run("(fram.drawn = 0, fram.film.compose = function (out) { fram.drawn++;"
                "return Object.getPrototypeOf(this).compose.call(this, out); }, 0)")
    browser.choose("speed", "0.25")
    go(browser, 0)
    browser.click_on("film")
    browser.until("fram.drawn > 8", "the video gets no pictures")
    browser.choose("speed", "20")
    video = browser.file(".webm")
    assert browser.run("fram.time >= fram.end && !fram.playing"), "the video does not go to the end"
    assert video.stat().st_size > 10000, video.stat().st_size
    if shutil.which("ffprobe"):
        answer = subprocess.run(["ffprobe", "-v", "error", "-count_packets", "-select_streams", "v", "-show_entries",
                                 "stream=codec_name,width,nb_read_packets", "-of", "csv=p=0", video],
                                capture_output=True, text=True, check=True).stdout
        codec, _, packets = answer.strip().split(",")
        assert codec in ("vp8", "vp9") and int(packets) > 1, answer


def check_blank(browser):
    png = browser.picture()
    assert chromium.colours(png) > 100, "the window is blank"


POSES = """(async (times) => {
    const out = [];
    for (const t of times) {
        fram.seek(t);
        for (fram.draw(); fram.waiting; fram.draw()) await new Promise((done) => setTimeout(done, 10));
        const there = fram.record.bodies.map((b) => b.index).filter((k) => fram.poses.shown[k]);
        out.push(there.map((k) => [k, fram.poses.contact[k], fram.poses.speed[k],
                                   ...fram.poses.pose.subarray(7 * k, 7 * k + 7)]),
                 fram.poses.forces);
    }
    return out;
})"""


def check_files_beside(browser, run):
    """Frames in files beside the page are those of the page that holds all; they come as they are needed."""
    times = "[7.9, 0.3, 4.1, 2.2, 6.03, 0, fram.end]"
    whole = browser.run(POSES + f"({times})")
    page = run / "in pieces.html"
    answer = subprocess.run([FRAM, "view", run, "--page", PAGE, "-o", page, "--json", "--page-limit", "0.63"],
                            check=True, capture_output=True, text=True).stdout
    told, files = json.loads(answer), sorted((run / "in pieces-frames").iterdir())
    assert told["files"] == len(files) > 3 and told["frames_left_out"] == 0, (answer, files)
    assert told["frames"] == len(browser.run("fram.record.frames.map((f) => f.time)"))
    assert page.stat().st_size < PAGE.stat().st_size + 120000, page.stat().st_size
    browser.open(page)
    browser.choose("colour", "plain")
    assert browser.run(POSES + f"({times})") == whole, "frames from beside the page are not those of the run"
    assert browser.run("fram.chunks.kept.size") <= 4, "all files are kept at once"
    go(browser, 0)
    browser.click_on("play")
    browser.until("fram.time >= fram.end && !fram.playing", "the page does not play through its files")
    check_pick(browser)
    # Of a shorter page after it no files are left; a total limit leaves frames out.
    subprocess.run([FRAM, "view", run, "--page", PAGE, "-o", page, "-q"], check=True)
    assert not (run / "in pieces-frames").exists() and not list(run.glob("*.new"))
    answer = subprocess.run([FRAM, "view", run, "--page", PAGE, "-o", page, "--json", "--total-limit", "0.66"],
                            check=True, capture_output=True, text=True).stdout
    assert json.loads(answer)["frames_left_out"] > 0, answer
    # What does not belong to the page is told before the work, and nothing is touched.
    foreign = run / "in pieces-frames" / "notes.txt"
    foreign.parent.mkdir()
    foreign.write_text("mine")
    before = page.read_bytes()
    answer = subprocess.run([FRAM, "view", run, "--page", PAGE, "-o", page, "--page-limit", "0.63"], check=False,
                            capture_output=True, text=True)
    assert answer.returncode == 2 and "notes.txt" in answer.stderr, answer
    assert foreign.read_text() == "mine" and page.read_bytes() == before and not list(run.glob("*.new"))
    foreign.unlink()
    # A file that is gone is named.
    subprocess.run([FRAM, "view", run, "--page", PAGE, "-o", page, "-q", "--page-limit", "0.63"], check=True)
    files[-1].unlink()
    files[-2].write_text("")  # as a copy leaves it that ends early
    browser.open(page)
    browser.run("fram.seek(7.4)")
    browser.until("document.getElementById('note').textContent.includes('is missing')", "a missing file is not named")
    # A moment of it is not waited for: the page says so and stops playing there, and goes on at others.
    said = "document.getElementById('waiting')"
    browser.until(f"!{said}.hidden && {said}.textContent.includes('missing')", "a moment that is gone is waited for")
    browser.run("fram.seek(0)")
    browser.until(f"{said}.hidden", "a moment that is there is said to be gone")
    browser.choose("speed", "5")  # so that a slow picture does not leap over the gap
    browser.click_on("play")
    browser.until(f"!fram.playing && fram.time < fram.end && !{said}.hidden", "the page plays on where a file is gone")
    # Neither that nor one that brings nothing stops the history of a floe, which has all other frames.
    browser.run("(fram.seek(0), fram.pick(fram.record.bodies.find((b) => b.number === 0)))")
    browser.click_on("whole")
    browser.until("!fram.history.loading && document.getElementById('whole').hidden", "a missing file stops a history")
    told, there, lost = browser.run("[fram.history.rows.size, fram.record.frames.filter((f) => !fram.chunks.lost.has("
                                    "f.chunk)).length, fram.chunks.lost.size]")
    assert told == there and lost == 2, f"the history has {told} of {there} frames that are there, {lost} files lost"
    browser.complaints = [c for c in browser.complaints if files[-1].name not in c]
    check_gaps(browser, run, page)


def check_gaps(browser, run, page):
    """Frames beside a gap are there: the last before it, which needs no other, and the first after it."""
    subprocess.run([FRAM, "view", run, "--page", PAGE, "-o", page, "-q", "--page-limit", "0.63"], check=True)
    gone = [sorted((run / "in pieces-frames").iterdir())[k] for k in (0, 3)]
    for file in gone:
        file.unlink()
    browser.open(page)
    for frame, lost in ("findLast((f) => f.chunk === 2)", 3), ("find((f) => f.chunk === 1)", 0):
        browser.run(f"(fram.chunks.ask({lost}), fram.seek(fram.record.frames.{frame}.time))")
        browser.until(f"fram.chunks.lost.has({lost}) && !fram.dirty && !fram.waiting",
                      f"a frame beside a gap is waited for: {frame}")
    browser.complaints = [c for c in browser.complaints if not any(file.name in c for file in gone)]
    # Made anew it is whole.
    subprocess.run([FRAM, "view", run, "--page", PAGE, "-o", page, "-q", "--page-limit", "0.63"], check=True)
    assert all(file.exists() for file in gone) and not list(run.glob("*.new"))


def main():
    if not chromium.path():
        skip("Chromium is not installed")
    if not PAGE.exists():
        skip("the viewer's page is not built (make viewer)")
    twins.check()
    with tempfile.TemporaryDirectory() as folder, chromium.Browser() as browser:
        towed, rows = make_run(pathlib.Path(folder), "towed", TOWED)
        moored, _ = make_run(pathlib.Path(folder), "moored", MOORED)
        check_towed(browser, towed, rows)
        browser.open(moored / "playback.html")
        browser.choose("camera", "orbit")
        browser.choose("colour", "plain")
        assert browser.run("document.getElementById('title').textContent") == TITLE
        for check in (check_blank, check_names, check_play, check_seek, check_keyboard, check_long_title, check_pick,
                      check_colours, check_speeds, check_arrows_and_marks, check_cameras, check_still, check_video):
            check(browser)
        calls = browser.run("(fram.draw(), fram.scene.renderer.info.render.calls)")
        assert calls <= 20, calls
        check_files_beside(browser, moored)
        check_opening(browser, towed / "playback.html")
        check_few(browser, pathlib.Path(folder))
        check_no_vessel(browser, pathlib.Path(folder))
        check_tank(browser, pathlib.Path(folder))
        check_late_contact(browser, pathlib.Path(folder))
        check_level(browser, pathlib.Path(folder))
        check_waiting(browser, pathlib.Path(folder))
        assert not browser.complaints, browser.complaints
    print(f"the playback page loads, plays, seeks, picks and exports in {calls} draw calls")


main()
