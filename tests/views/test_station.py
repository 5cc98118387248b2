#!/usr/bin/env python3
"""Mooring lines, thrusters and propellers in the playback page, in headless Chromium.

Lines must lead from the fairlead, which the run's own forces tell, to the anchor, which follows from the scenario, and
hang as a catenary does; what parted or failed is told.  Skipped (77) without Chromium or without the viewer's page.
"""
import base64
import math
import os
import pathlib
import re
import subprocess
import sys
import tempfile

import chromium

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
from skipping import skip  # noqa: E402  (tests is no package)

FRAM = os.environ["FRAM"]
PAGE = pathlib.Path(os.environ["FRAM_SOURCE"]) / "build" / "viewer" / "playback.html"
# Numbers of lines count within a vessel: both have a first and a second one.  Those of the other ship end far outside
# what is drawn; hers is a turret.  All in coordinates of a map, where floats are a decimetre apart: the page counts
# from the middle of the domain.
SCENE = """
title: Two moored ships
run: {duration: 6, time_step: 0.02, seed: 3}
vessels:
  - name: near
    mode: free
    x: 2999990
    y: -1999994
    heading_deg: 30
    hull: {length: 48, beam: 12, draught: 4, freeboard: 2}
    mooring:
      depth: 60
      x: 4
      z: -3
      lines:
        - {count: 2, spacing_deg: 120, direction_deg: 45, fairlead_distance: 3, distance: 150, pretension: 2.0e5}
        - {direction_deg: 290, distance: 140, pretension: 2.0e5, release_time: 3}
        - {kind: spring, direction_deg: 200, distance: 140, pretension: 2.0e5, stiffness: 1.0e5}
    thrusters:
      - {x: 18, z: -3, setting: 0.5, direction_deg: 60, thrust: 4.0e5}
      - {kind: tunnel, x: -18, z: -3, setting: 0.5, thrust_astern: 3.0e5, failure_time: 2}
  - name: far
    mode: free
    x: 3000000
    y: -2000070
    hull: {length: 48, beam: 12, draught: 4, freeboard: 2}
    mooring:
      depth: 60
      turret: true
      lines: [{count: 2, spacing_deg: 180, fairlead_distance: 5, distance: 2000, pretension: 9.0e5}]
  - name: tug
    mode: free
    x: 3000040
    y: -2000020
    heading_deg: 90
    hull: {length: 36, beam: 10, draught: 4, freeboard: 2, stem_angle_deg: 80, entrance_angle_deg: 60,
           stern_angle_deg: 30, parallel_midbody: 0.2}
    propulsion: {bollard_pull: 4.0e5, open_water_speed: 5, speed: 0.5, propellers: 2, propeller_diameter: 3}
  - name: scow
    mode: free
    x: 2999955
    y: -1999965
    hull: {form: file, file: scow.obj}
    propulsion: {bollard_pull: 5.0e4, open_water_speed: 5, speed: 0.5, propeller_diameter: 1}
ice: {concentration: 0.3, mean_floe_area: 64, thickness: 0.3}
domain: {x_min: 2999936, x_max: 3000064, y_min: -2000110, y_max: -1999950, boundary: open}
environment: {current_speed: 0.5, current_direction_deg: 180}
output: {frame_interval: 0.5}
"""
# A box with ends that rake, the bow's far over: 26.5 m of waterline, from -11 to 15.5, of 35 m over all.
SCOW = """
v -9 -4 -2\nv -9 4 -2\nv 9 4 -2\nv 9 -4 -2\nv -13 -4 2\nv -13 4 2\nv 22 4 2\nv 22 -4 2
f 1 2 3 4\nf 5 8 7 6\nf 1 5 6 2\nf 4 3 7 8\nf 1 4 8 5\nf 2 6 7 3
"""
# Number of a vessel, of its line, fairleads at the start about the vessel's place, direction, distance of the anchor.
LINES = [(0, 1, 3, 45, 150), (0, 2, 3, 165, 150), (0, 3, 0, 290, 140), (0, 4, 0, 200, 140),
         (1, 1, 5, 0, 2000), (1, 2, 5, 180, 2000)]
WEIGHT = 1000  # of the lines, as the scenario's keys have it by themselves [N/m]
DEPTH = 60
STATE = """(() => {
    const { station, water } = fram.scene, xyz = (p) => p && [p.x, p.y, p.z];
    return { lines: station.lines.map((l) => ({ held: l.held, number: l.number, points: l.points.map(xyz) })),
        thrusters: station.thrusters.map((t) => ({ works: t.works, at: xyz(t.at), axis: xyz(t.axis), disc: t.disc,
            hull: [...fram.poses.pose.subarray(7 * t.hull.index, 7 * t.hull.index + 7)] })),
        forces: fram.poses.forces, gone: station.gone, edge: station.edge.map(xyz),
        drawn: [station.drawnLines.geometry.instanceCount, station.discs.count],
        legend: fram.legend.content.station.flat().map(([, name]) => name),
        calls: fram.scene.renderer.info.render.calls };
})()"""
# How many pixels about a point of the scene have the lines' green.
GREEN = """((x, y, z) => {
    fram.scene.render();
    const gl = fram.scene.renderer.getContext(), p = fram.scene.camera.position.clone().set(x, y, z);
    p.project(fram.scene.camera);
    const out = new Uint8Array(4 * 81);
    gl.readPixels((p.x + 1) / 2 * gl.drawingBufferWidth - 4, (p.y + 1) / 2 * gl.drawingBufferHeight - 4, 9, 9, gl.RGBA,
                  gl.UNSIGNED_BYTE, out);
    let n = 0;
    for (let i = 0; i < out.length; i += 4) n += out[i + 1] > 1.5 * out[i] && out[i + 1] > 1.5 * out[i + 2];
    return n;
})"""


# The pieces that a line is drawn in: [x, y, z, x, y, z] each.
STROKES = """(() => { const { station } = fram.scene, all = [...station.ends], n = all.length / station.lines.length;
    const mine = all.slice(%d * n), size = 6;
    return Array.from({ length: n / size }, (_, k) => mine.slice(size * k, size * (k + 1))); })()"""


def start_of(vessel, along, direction):
    """The place of a line's upper end, seen from above, or further along it, as the vessel is put [m]."""
    heading, x, y, centre = ((math.radians(30), -10, 36, 4), (0, 0, -40, 0))[vessel]
    angle = math.radians(direction)
    return (x + centre * math.cos(heading) + along * math.cos(angle),
            y + centre * math.sin(heading) + along * math.sin(angle))


def go(browser, time):
    browser.run(f"(fram.seek({time}), fram.draw())")
    if browser.run("fram.dirty"):
        browser.run("fram.draw()")
    return browser.run(STATE)


def near(a, b, tolerance):
    return math.dist(a, b) <= tolerance


def pulls_of(state):
    """Forces of lines by vessel: they come vessel by vessel."""
    forces = [f for f in state["forces"] if f["kind"] == "line"]
    turn = next(i for i in range(1, len(forces)) if forces[i]["which"] <= forces[i - 1]["which"])
    return {(v, f["which"]): f for v, part in enumerate((forces[:turn], forces[turn:])) for f in part}


def check_line(told, line, pull, edge):
    vessel, _, off, direction, distance = line
    points = told["points"]
    assert near(points[0], pull["point"], 0.01), f"{line}: begins at {points[0]}, fairlead {pull['point']}"
    anchor = (*start_of(vessel, off + distance, direction), -DEPTH)
    if vessel == 0:
        assert near(points[-1], anchor, 0.01), f"{line}: ends at {points[-1]}, anchor {anchor}"
    else:
        assert abs(points[-1][0] - (edge[1] if direction == 0 else edge[0])[0]) < 0.01, (line, points[-1], edge)
    first = [b - a for a, b in zip(points[0], points[1])]
    dot = sum(a * b for a, b in zip(first, pull["force"])) / math.hypot(*first) / math.hypot(*pull["force"])
    assert dot > 0.995, f"{line}: leads off by {math.degrees(math.acos(dot))} degrees from its pull"
    assert all(a[2] >= b[2] - 1e-6 for a, b in zip(points, points[1:])), f"{line}: goes up: {points}"


def check_catenary(told, pull):
    """Tension falls by the weight times the depth along a catenary, up to what it stretches (Faltinsen 1990): its slope
    half way down is that of this tension."""
    points, level = told["points"], math.hypot(*pull["force"][:2])
    for a, b in zip(points[2:8], points[3:9]):
        deep = points[0][2] - (a[2] + b[2]) / 2
        tension = math.hypot(*pull["force"]) - WEIGHT * deep
        slope = (a[2] - b[2]) / math.dist(a[:2], b[:2])
        expected = math.sqrt(max(0, (tension / level) ** 2 - 1))
        assert abs(slope - expected) < 0.03, (slope, expected)


def check_propellers(three):
    """They stand 0.45 lengths of the waterline abaft the centre of mass, 0.6 of the draught deep, 1.5 diameters apart,
    and face ahead; the hulls' ends overhang, and the tug's centre of mass lies far before amidships."""
    for propeller, length, side, draught, disc in zip(three, (36, 36, 26.5), (-2.25, 2.25, 0), (4, 4, 2), (3, 3, 1)):
        x, y, _, i, j, k, w = propeller["hull"]
        ahead = math.atan2(2 * (w * k + i * j), 1 - 2 * (j * j + k * k))
        place = (x - 0.45 * length * math.cos(ahead) - side * math.sin(ahead),
                 y - 0.45 * length * math.sin(ahead) + side * math.cos(ahead))
        at = propeller["at"]
        assert near(at[:2], place, 0.2) and abs(at[2] + 0.6 * draught) < 0.4, (propeller, place)
        assert propeller["works"] and propeller["disc"] == disc, propeller
        assert near(propeller["axis"], (math.cos(ahead), math.sin(ahead), 0), 0.05), propeller


def check_start(browser):
    state = go(browser, 1)
    assert state["drawn"] == [17 * 6, 5] and [t["number"] for t in state["lines"]] == [1, 2, 3, 4, 1, 2], state
    assert state["gone"] == 0 and state["legend"] == ["mooring line", "propeller, thruster"], state["legend"]
    check_propellers(state["thrusters"][2:])
    pulls = pulls_of(state)
    for told, line in zip(state["lines"], LINES):
        assert told["held"], line
        check_line(told, line, pulls[line[:2]], state["edge"])
    for k in (0, 1):
        check_catenary(state["lines"][k], pulls[(0, k + 1)])
    assert len(state["lines"][3]["points"]) == 2, "a spring is straight"
    for told, force in zip(state["thrusters"], [f for f in state["forces"] if f["kind"] == "thruster"]):
        size = math.hypot(*force["force"])
        assert size > 100 and near(told["at"], force["point"], 0.01), (told, force)
        assert near(told["axis"], [f / size for f in force["force"]], 1e-3), (told, force)
    # 45 kPa on the disc, at the larger thrust of the two ways.
    for told, most in zip(state["thrusters"], (4e5, 3e5)):
        assert abs(told["disc"] - math.sqrt(4 * most / math.pi / 45e3)) < 1e-6, told
    assert state["calls"] <= 20, state["calls"]
    return state["calls"]


def check_pixels(browser):
    """A line is seen, forces or not."""
    browser.choose("camera", "top")
    browser.click_on("forces")
    state = go(browser, 1)
    place = state["lines"][1]["points"][6]
    assert browser.run(f"{GREEN}({place[0]}, {place[1]}, {place[2]})") > 3, "no line at its place"
    assert browser.run(f"{GREEN}({place[0] + 12}, {place[1] + 12}, {place[2]})") == 0, "green beside the line"
    browser.click_on("forces")


def check_between(browser):
    """Between two frames a line keeps to its vessel, whose pose lies between theirs."""
    for time in (1.2, 1.3):
        state = go(browser, time)
        local = browser.run("""(() => { const { lines } = fram.scene.station, l = lines[0], k = 7 * l.hull.index;
            const p = fram.poses.pose.subarray(k, k + 7), q = l.points[0].clone();
            q.set(q.x - p[0], q.y - p[1], q.z - p[2]);
            return [...q.applyQuaternion(fram.scene.camera.quaternion.clone().set(p[3], p[4], p[5], p[6]).invert())];
        })()""")
        if time == 1.2:
            first = local
        assert near(local, first, 0.01), (local, first)
        assert near(state["lines"][0]["points"][-1], (*start_of(0, 153, 45), -DEPTH), 0.01)


def check_end(browser):
    """One line is let go at 3 s and lies on the bottom; a thruster failed at 2 s and stays where it was."""
    before = go(browser, 1)["thrusters"][1]
    state = go(browser, 6)
    assert [t["held"] for t in state["lines"]] == [True, True, False, True, True, True], state["lines"]
    assert all(abs(p[2] + DEPTH) < 1e-6 for p in state["lines"][2]["points"]), state["lines"][2]
    assert near(state["lines"][2]["points"][-1][:2], start_of(0, 140, 290), 0.01)
    # Drawn with gaps, from its beginning to its end: it is told from the others without its colour.
    drawn = browser.run(STROKES % 2)
    assert all(not near(a[3:], b[:3], 1) for a, b in zip(drawn, drawn[1:])), drawn
    assert near(drawn[0][:3], state["lines"][2]["points"][0], 0.01), drawn
    assert near(drawn[-1][3:], state["lines"][2]["points"][-1], 0.01), drawn
    whole = browser.run(STROKES % 0)
    assert all(near(a[3:], b[:3], 1e-3) for a, b in zip(whole, whole[1:])), whole
    assert [t["works"] for t in state["thrusters"]] == [True, False, True, True, True] and state["gone"] == 2
    assert near(state["thrusters"][1]["at"], before["at"], 3), (state["thrusters"][1], before)
    assert state["legend"] == ["mooring line", "propeller, thruster", "parted or failed"], state["legend"]
    pulls = pulls_of(state)
    for told, line in zip(state["lines"], LINES):
        if told["held"]:
            check_line(told, line, pulls[line[:2]], state["edge"])
    # Back again nothing is gone.
    assert go(browser, 1)["gone"] == 0


STUDIED = """
run: {duration: 0.2, time_step: 0.02}
vessel:
  mode: free
  hull: {length: 48, beam: 12, draught: 4, freeboard: 2}
  mooring: {depth: 60, lines: [{count: 4, spacing_deg: 90, distance: 300, pretension: 2.0e5}]}
ice: {source: floes, floes: [{x: 30.5, y: 0, length: 12, width: 12}]}
domain: {x_min: -64, x_max: 64, y_min: -40, y_max: 40}
environment: {current_speed: 2, current_direction_deg: 180}
output: {frame_interval: 0}
"""
STUDY = """
scenario: studied.yaml
seeds: 2
vary:
  grid: {ice.thickness: [0.5, 1], ice.density: [900, 910], environment.current_speed: [2], environment.wind_speed: [0]}
"""


def check_study_printed(browser, folder):
    """Of the page of a study, whose tables are wide, paper has every column."""
    (folder / "studied.yaml").write_text(STUDIED)
    (folder / "study.yaml").write_text(STUDY)
    subprocess.run([FRAM, "study", folder / "study.yaml", "-o", folder / "study", "--quiet"], check=True,
                   stdout=subprocess.DEVNULL)
    browser.call("Page.navigate", url=(folder / "study" / "study.html").as_uri())
    browser.until("document.readyState === 'complete' && document.title.startsWith('Study ')",
                  "a study's page does not load")
    # Without shrinking the page as a whole, at the width of its own paper less the margins of 14 mm.
    sheet = base64.b64decode(browser.call("Page.printToPDF", preferCSSPageSize=True)["data"])
    points = float(re.search(rb"/MediaBox ?\[0 0 ([0-9.]+)", sheet)[1])
    browser.call("Emulation.setEmulatedMedia", media="print")
    browser.call("Emulation.setDeviceMetricsOverride", width=int(points / 72 * 96 - 2 * 14 / 25.4 * 96), height=700,
                 deviceScaleFactor=1, mobile=False)
    beyond = browser.run("""[...document.querySelectorAll('table')].map((t) => t.getBoundingClientRect().right)
        .filter((right) => right > document.documentElement.clientWidth)""")
    heads = browser.run("document.querySelector('table').rows[0].cells.length")
    assert heads >= 11, f"a table of {heads} columns is not wide enough for this test to tell"
    assert beyond == [], f"tables go on beyond the paper, to {beyond} pixels"
    browser.call("Emulation.setEmulatedMedia", media="")
    browser.call("Emulation.clearDeviceMetricsOverride")


def main():
    if not chromium.path():
        skip("Chromium is not installed")
    if not PAGE.exists():
        skip("the viewer's page is not built (make viewer)")
    with tempfile.TemporaryDirectory() as folder, chromium.Browser() as browser:
        scene, run = pathlib.Path(folder) / "moored.yaml", pathlib.Path(folder) / "moored"
        scene.write_text(SCENE)
        (scene.parent / "scow.obj").write_text(SCOW)
        subprocess.run([FRAM, "run", scene, "-o", run, "--quiet"], check=True)
        subprocess.run([FRAM, "view", run, "--page", PAGE, "--quiet"], check=True)
        browser.open(run / "playback.html")
        browser.choose("colour", "plain")
        calls = check_start(browser)
        for check in (check_pixels, check_between, check_end):
            check(browser)
        check_study_printed(browser, pathlib.Path(folder))
        assert not browser.complaints, browser.complaints
    print(f"six lines, two thrusters and three propellers stand where the run has them, in {calls} draw calls")


main()
