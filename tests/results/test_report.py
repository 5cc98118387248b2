#!/usr/bin/env python3
"""The report of runs with a field that feeds itself and with level ice: its books close, and it says all it should.

The books are those of series.csv and of the frames, which know nothing of each other: what the first frame holds, plus
what came in, minus what went out, crushed, was lost or became brash, is what the last frame holds.
"""
import base64
import csv
import html.parser
import json
import os
import pathlib
import re
import struct
import subprocess
import tempfile
import zlib

FRAM = os.environ["FRAM"]
VESSEL = "hull: {length: 48, beam: 12, draught: 4, freeboard: 2}"
SCENES = {
    "feeding": f"""
run: {{duration: 14, time_step: 0.02, seed: 4, transient: 2}}
vessel:
  mode: free
  {VESSEL}
  mooring: {{depth: 60, lines: [{{count: 4, spacing_deg: 90, distance: 300, pretension: 2.0e5}}]}}
ice: {{concentration: 0.8, mean_floe_area: 64, thickness: 0.4, breakable: true}}
domain: {{x_min: -64, x_max: 64, y_min: -40, y_max: 40, boundary: feeding, drift_speed: 2, drift_direction_deg: 200}}
""",
    "level": f"""
run: {{duration: 12, time_step: 0.02, seed: 1, transient: 1}}
vessel: {{mode: towed, x: -28, speed: 3, ramp: 0.5, {VESSEL}}}
ice:
  {{source: level, thickness: 0.4, breakable: true, crush_trims: true, level: {{x_min: 0, x_max: 90}},
   strength: {{flexural_variation: 0.2, correlation_length: 7}}}}
domain: {{x_min: -64, x_max: 64, y_min: -40, y_max: 40, boundary: open}}
""",
}
CHANGED = ("scenario.yaml was changed since the run was made, or another Fram made it: what is told of the scenario is "
           "what stands there now")
TRANSIENT = {"feeding": 2, "level": 1}
# Under tow, and no ice to meet: across a hull with this heading the load is -0.
WATER = f"""
run: {{duration: 2, time_step: 0.02}}
vessel: {{mode: towed, speed: 1, heading_deg: 120, {VESSEL}}}
ice: {{source: none}}
"""
# A tongue of level ice that leads cut off: it hangs on nothing once the ship breaks it.
LOOSE = f"""
run: {{duration: 3, time_step: 0.02}}
vessel: {{mode: towed, x: -32, speed: 2, {VESSEL}}}
ice:
  source: level
  breakable: true
  thickness: 0.5
  level:
    x_min: -8
    anchored_x_min: false
    openings: [{{x: 12, length: 1, width: 24}}, {{x: 2, y: 11.5, length: 21, width: 1}},
               {{x: 2, y: -11.5, length: 21, width: 1}}]
domain: {{x_min: -60, x_max: 60, y_min: -40, y_max: 40}}
"""
SECTIONS = ("Scenario", "Ice load", "What makes the load", "Motion of the vessel", "Ice field",
            "Fracture", "Mass and energy", "Quality of the solution", "Origin", "Complete scenario")
CHARTS = ("Ice load over time", "Ice load by mechanism", "Histogram of the load",
          "Exceedance of the load", "Floe sizes", "Floes in the field", "Broken floes", "Energy", "Residual", "Overlap")
MECHANISMS = ("splitting of a floe", "bending of ice that has not broken", "crushing at the limit",
              "a chain of floes against fixed or driven ice, a wall or another vessel",
              "floes that other floes hold back",
              "turning and submerging of floes", "impact of floes that give way freely",
              "sliding friction along the hull")


COLUMNS = ("splitting", "bending", "crushing", "chain", "accumulation", "submersion", "impact", "friction")
ZONES = ("bow", "shoulder", "midbody", "stern", "bottom")


def check_heads(page):
    """A head stands over its column: right over numbers, left over words."""
    tables = re.findall(r"<thead><tr>(.*?)</tr></thead>\s*<tbody>\s*<tr>(.*?)</tr>", page, re.S)
    seen = set()
    for head, row in tables:
        heads, cells = ([kind == "n" for kind in re.findall(r'<t[hd](?: class="(.)")?(?: scope="(?:col|row)")?>', text)]
                        for text in (head, row))
        assert heads == cells, (head, row)
        seen |= set(heads)
    assert len(tables) > 4 and seen == {True, False}, tables


def check_structure(page, contents):
    """What who does not see the page goes by: its main part, headings with names for links, rows with theirs."""
    assert page.count("<main>") == page.count("</main>") == 1 and page.index("</header>") < page.index("<main>")
    names = re.findall(r'<h2 id="([a-z0-9-]+)">', page)
    assert len(names) == page.count("<h2") == len(set(names)) and "ice-load" in " ".join(names), names
    links = re.findall(r'<li><a href="#([^"]*)">', page)
    assert links == (names if contents else []), links
    assert len(re.findall('<th scope="row">', page)) > 40 and '<td>averaged, along X' not in page
    assert all('scope="' in head for head in re.findall("<th(?: [^>]*)?>", page))
    assert '<h1 dir="auto">' in page


def check_alternatives(page, series):
    """Charts and plans tell in words what is to be seen."""
    alternatives = re.findall('alt="([^"]*)"', page)
    (load,) = [a for a in alternatives if a.startswith("Ice load over time: ")]
    told = re.fullmatch(r".*: force \[(k?)N\] from (\S+) to (\S+) over time \[s\] from (\S+) to (\S+); "
                        "along the vessel, each step; along X, averaged; along Y, averaged", load)
    assert told, load
    values = [float(row[f"ice_force_{c}[N]"]) / (1000 if told[1] else 1) for row in series
              for c in ("body_x", "averaged_x", "averaged_y")]
    for text, value in zip(told.groups()[1:], (min(values), max(values), float(series[0]["time[s]"]),
                                               float(series[-1]["time[s]"]))):
        assert abs(float(text) - value) <= 1e-3 * abs(value), (load, value)
    plans = [a for a in alternatives if a.startswith("The field at the ")]
    assert len(plans) == 2 and plans[0].startswith("The field at the start, seen from above: ") and any(
        re.search(r"the end, .*; t = [0-9.]+ s", a) for a in plans), plans
    assert len(alternatives) == len(set(alternatives)) and min(map(len, alternatives)) > 40, alternatives


class Tables(html.parser.HTMLParser):
    """First cell of every row, and the ones after it."""

    def __init__(self):
        super().__init__()
        self.rows, self.cells, self.text, self.heads = {}, None, None, []

    def handle_starttag(self, tag, attrs):
        if tag == "tr":
            self.cells = []
        elif tag in ("td", "th", "h2"):
            self.text = ""

    def handle_endtag(self, tag):
        if tag in ("td", "th") and self.cells is not None:
            self.cells.append(self.text)
        elif tag == "h2":
            self.heads.append(self.text)
        elif tag == "tr" and self.cells:
            self.rows.setdefault(self.cells[0], self.cells[1:])

    def handle_data(self, data):
        if self.text is not None:
            self.text += data


def number(text):
    return float(re.match(r"[-+0-9.eE]+", text.replace("\u2212", "-")).group())


def check(name, run, pictures):
    page = (run / "report.html").read_text()
    tables = Tables()
    tables.feed(page)
    with open(run / "series.csv", newline="") as file:
        series = list(csv.DictReader(file))
    last = series[-1]
    rows = tables.rows
    for section in SECTIONS:
        assert section in tables.heads, (name, section, tables.heads)
    for chart in CHARTS if pictures else ():
        assert f'alt="{chart}: ' in page, (name, chart)
    first, final = (number(rows[f"in the field at the {w} frame"][0]) for w in ("first", "last"))
    book = {k[:-4]: float(v) * 1e-3 for k, v in last.items() if k.startswith(("ice_mass_", "brash_mass"))}
    moved = (book["ice_mass_entered"] + book["ice_mass_gained"] - book["ice_mass_left"] - book["ice_mass_lost"]
             - book["ice_mass_crushed"] - book["brash_mass"])
    assert abs(first + moved - final) < 2e-3 * first, (name, first, moved, final)
    assert abs(number(rows["of the mass at the start"][0])) < 0.1, (name, rows["of the mass at the start"])
    assert float(last["fractures[1]"] if "fractures[1]" in last else last["bendings[1]"]) > 0, "nothing broke"
    if pictures:
        check_stack(page, series)
        assert ('alt="Roll and pitch: ' in page) == (name == "feeding")
        check_alternatives(page, series)
    if name == "feeding":
        assert book["ice_mass_entered"] > 0 and book["ice_mass_left"] > 0, book
        assert "Station keeping" in tables.heads and "unbounded field" in rows["domain"][0], rows["domain"]
        # Ice drifts against both axes: loads and their significant peaks are on that side.
        mean, _, least, _, significant = (number(v) for v in rows["averaged, along X"])
        assert least <= significant <= mean < 0, rows["averaged, along X"]
    else:
        assert book["ice_mass_lost"] + book["ice_mass_crushed"] > 0, book
    shares = [number(rows[m][0]) for m in MECHANISMS]
    assert abs(sum(shares) - 100) < 0.1 and max(shares) > 10, shares
    assert re.search(r"[0-9.]+ k?N, \d+ % of it by .*, from \d+ bod(y|ies).*\.$", rows["1"][1]), rows["1"]
    check_shares(series, TRANSIENT[name], shares, [f"mechanism_{m}" for m in COLUMNS])
    zones = [number(rows[z][0]) for z in ZONES]
    check_shares(series, TRANSIENT[name], zones, [f"ice_force_{z}" for z in ZONES])
    assert abs(sum(zones) - 100) < 0.1 and zones[0] > 10, zones
    check_channels(series, TRANSIENT[name], rows, {**ROWS, **(MOORED_ROWS if name == "feeding" else TOWED_ROWS)}, page)
    check_breaks(run, rows, page)
    check_heads(page)
    check_structure(page, contents=False)
    assert CHANGED not in page
    assert ("strength variation" in rows) == (name == "level"), rows.get("strength variation")
    mean_x, mean_y = (abs(number(rows[f"averaged, along {axis}"][0])) for axis in "XY")
    assert ("bow, along Y" in rows) == (mean_y > mean_x) == (name == "feeding"), (mean_x, mean_y)
    if name == "level":
        assert all(word in rows["strength variation"][0] for word in ("0.2", "7 m")), rows["strength variation"]
    for row in ("kinetic energy", "crushing work"):
        assert row in rows, (name, row)
    unit = {"J": 1, "kJ": 1e-3}[rows["kinetic energy"][0].split()[-1]]
    most = max(abs(float(row[f"{book}[J]"])) for row in series for book in ("kinetic_energy", "crushing_work"))
    assert unit == (1 if 0 < most < 1e4 else 1e-3), (name, rows["kinetic energy"], most)
    kinetic = float(last["kinetic_energy[J]"]) * unit
    assert abs(number(rows["kinetic energy"][0]) - kinetic) <= 1e-3 * abs(kinetic) + 1e-6, (rows, kinetic)
    # Where the sheet reaches out of the domain, and floes over its edge, the domain's part counts.
    cover, later = (number(v) for v in rows["ice area in the domain over domain area"][:2])
    whole = number(rows["ice area [m2]"][0]) / (128 * 80)
    if name == "level":
        assert abs(cover - 0.5) < 1e-3 and later < cover and abs(whole - 90 / 128) < 1e-3, (cover, later, whole)
    else:
        assert 0.7 < cover < 0.8 < whole, (cover, whole)
    before, after = (number(v) for v in rows["floes"][:2])
    assert before > 0 and after == float(last["floes[1]"]), (name, before, after, last["floes[1]"])
    for row in ("residual of the contact problem [m/s]", "largest overlap [m]", "computing time of a step [ms]"):
        assert all(number(v) >= 0 for v in rows[row]), (name, row, rows[row])
    times = re.fullmatch(r"median (\S+) ms, 99 % under (\S+) ms, 99.9 % under (\S+) ms, the longest (\S+) ms; .*",
                         rows["computing time of a step"][0])
    assert times and sorted(times.groups(), key=float) == list(times.groups()), rows["computing time of a step"]
    for row in ("Fram", "scenario", "state at the end"):
        assert row in rows, (name, row)
    return number(rows["of the mass at the start"][0])


ROWS = {"averaged, along X": "ice_force_averaged_x", "averaged, along Y": "ice_force_averaged_y",
        "each step, along the vessel": "ice_force_body_x", "each step, across the vessel": "ice_force_body_y",
        "each step, upwards": "ice_force_body_z", "bow, along X": "ice_force_bow_x",
        "shoulder, along X": "ice_force_shoulder_x", "midbody, along X": "ice_force_midbody_x",
        "stern, along X": "ice_force_stern_x", "bottom, along X": "ice_force_bottom_x",
        "crushing, along X": "ice_force_capped_x", "below the limit, along X": "ice_force_below_cap_x",
        "friction, along X": "ice_force_friction_x"}
TOWED_ROWS = {"towing carriage, along X": "tow_force_x", "towing carriage, along Y": "tow_force_y"}
MOORED_ROWS = {"along X [m]": "offset_x", "along Y [m]": "offset_y", "heading [deg]": "heading_deviation",
               "mooring, along X": "mooring_force_x", "mooring, along Y": "mooring_force_y",
               "largest line tension": "line_tension_max",
               **{f"tension of line {i}": f"line_{i}_tension" for i in range(1, 5)}}


def check_channels(series, transient, rows, names, page):
    """Mean, deviation, least and greatest of each row are those of the channel that its name tells."""
    factor = {"MN": 1e-6, "kN": 1e-3, "N": 1}
    loads, lines = (re.search(head + r" \[(.*?)\]", page) for head in ("load on the vessel", "lines and thrusters"))
    for name, channel in names.items():
        (head,) = [h for h in series[0] if h.startswith(channel + "[")]
        unit = lines if re.search("mooring,|line", name) else loads
        scale = factor[unit[1]] if head.endswith("[N]") else 1
        values = [float(row[head]) * scale for row in series if float(row["time[s]"]) > transient]
        mean = sum(values) / len(values)
        wanted = [mean, (sum((v - mean) ** 2 for v in values) / len(values)) ** 0.5, min(values), max(values)]
        size = max(map(abs, wanted))
        for told, value in zip(rows[name], wanted):
            assert abs(number(told) - value) <= 5e-3 * size, (name, rows[name], wanted)


def check_breaks(run, rows, page):
    """The first of each kind, in the table as in fractures.csv."""
    scale = {"MN": 1e-6, "kN": 1e-3, "N": 1}[re.search(r"load \[(\w+)\]</th>", page)[1]]
    with open(run / "fractures.csv", newline="") as file:
        events = list(csv.DictReader(file))[:25]
    for kind, name in (("1", "split"), ("2", "bending")):
        first = next((e for e in events if e["kind[1]"] == kind), None)
        assert (name in rows) == (first is not None), name
        for head, told in zip(("time[s]", "floe[1]", "place_x[m]", "place_y[m]", "load[N]", "crack_length[m]",
                               "floe_area[m2]", "pieces[1]"), rows[name] if first else ()):
            value = float(first[head]) * (scale if head == "load[N]" else 1)
            assert abs(number(told) - value) <= 1e-3 * abs(value) + 1e-6, (name, head, told, value)


def check_shares(series, transient, told, parts):
    """Shares in percent are those of the mean load, along it: not of the loads of stretches, each along its own."""
    counted = [row for row in series if float(row["time[s]"]) > transient]
    mean = [[sum(float(row[f"{part}_{axis}[N]"]) for row in counted) / len(counted) for axis in "xy"]
            for part in parts]
    load = [sum(axis) for axis in zip(*mean)]
    for part, told_share, (x, y) in zip(parts, told, mean):
        share = 100 * (x * load[0] + y * load[1]) / (load[0] ** 2 + load[1] ** 2)
        assert abs(told_share - share) <= 1e-3 * abs(share) + 1e-6, (part, told_share, share)


def check_stack(page, series):
    """Each mechanism that carries something has a band, and none goes from one side of zero to the other: it would
    leave a gap where it does."""
    data = re.search(r'alt="Ice load by mechanism: [^"]*" src="data:image/svg\+xml;base64,([^"]+)"', page).group(1)
    bands = re.findall(r'fill:rgb[^"]*" d="M ([^MZ]*) Z', base64.b64decode(data).decode())
    points = [[[float(x) for x in point.split()] for point in band.split(" L ")] for band in bands]
    heights = [[y for _, y in p] for p in points if len(p) > 4]
    zero = heights[0][0]
    heads = [[f"mechanism_{part}_{axis}[N]" for axis in "xy"] for part in COLUMNS[:-1]]
    carrying = 1 + sum(any(float(row[head]) for row in series for head in part) for part in heads)
    assert len(heights) >= carrying >= len(MECHANISMS) - 1, (len(heights), carrying)
    for h in heights:
        assert max(h) < zero + 0.01 or min(h) > zero - 0.01, f"a band from {min(h)} to {max(h)} about {zero}"
    # All parts together are the load, which pushes with itself: more goes up than down.
    area = {True: 0.0, False: 0.0}
    for p in points:
        around = sum(a[0] * b[1] - b[0] * a[1] for a, b in zip(p, p[1:] + p[:1]))
        area[max(y for _, y in p) < zero + 0.01] += abs(around) / 2
    assert area[True] > area[False], area
    # What pushes against the load goes down, where it is enough to be drawn.
    against = pushed = 0.0
    for row in series:
        parts = [[float(row[head]) for head in part] for part in heads]
        load = [sum(axis) for axis in zip(*parts)]
        along = [sum(a * b for a, b in zip(part, load)) for part in parts]
        pushed += sum(x for x in along if x > 0)
        against -= sum(x for x in along if x < 0)
    assert area[False] > 0 or against < 1e-3 * pushed, (area, against / pushed)


def check_times(folder):
    """Frames that end before the series: the balance is of the last frame's time, or nothing is said of it."""
    file = folder / "feeding.yaml"
    for interval, unknown in (("0", False), ("3", True)):
        run = folder / f"frames-{interval}"
        subprocess.run([FRAM, "run", file, "-o", run, "-q", "--set", "output.frame_interval=5", "--set",
                        f"output.csv_interval={interval}"], check=True)
        subprocess.run([FRAM, "report", run, "-q"], check=True)
        page = (run / "report.html").read_text()
        assert ("parts are those of the steps that it has" in page) == (interval != "0"), "what a bin of parts is"
        tables = Tables()
        tables.feed(page)
        rows = tables.rows
        assert "heading 0 deg, from which it begins at the equilibrium" in rows["motion"][0], rows["motion"]
        if unknown:
            assert rows["not accounted for"][0].startswith("unknown"), rows["not accounted for"]
        else:
            left = number(rows["of the mass at the start"][0])
            assert abs(left) < 0.1, f"{left} % of the ice is not accounted for at the last frame"
            with open(run / "series.csv", newline="") as series:
                table = list(csv.DictReader(series))
            entered = [float(row["ice_mass_entered[kg]"]) for row in table if abs(float(row["time[s]"]) - 10) < 0.01]
            start = number(rows["in the field at the first frame"][0]) * 1e3
            late = float(table[-1]["ice_mass_entered[kg]"]) - entered[0]
            assert late > 0.002 * start, "too little came in after the last frame for this test to tell"


def move_series(series, x, column="position_x[m]"):
    """The same run so many metres along X."""
    head, *rows = (row.split(",") for row in series.read_text().splitlines())
    at = head.index(column)
    rows = [[*row[:at], repr(float(row[at]) + x), *row[at + 1:]] for row in rows]
    series.write_text("\n".join(map(",".join, [head, *rows])) + "\n")


def line_height(page, title):
    """Of the highest line in a chart of a page [pixels]."""
    data = re.search(rf'alt="{title}: [^"]*" src="data:image/svg\+xml;base64,([^"]+)"', page).group(1)
    lines = [re.findall(r"[ML] \S+ (\S+)", line) for line in
             re.findall(r' d="(M [^"]*)"', base64.b64decode(data).decode())]
    heights = [max(map(float, line)) - min(map(float, line)) for line in lines if len(line) > 20]
    return max(heights, default=0)


def check_water(folder, pictures):
    """Of no load there is no distribution, of a given motion no roll and pitch; a failure's message is told whole."""
    file, run = folder / "water.yaml", folder / "water"
    file.write_text(WATER)
    subprocess.run([FRAM, "run", file, "-o", run, "-q"], check=True)
    move_series(run / "series.csv", -1301150)
    note = json.loads((run / "run.json").read_text())
    message = "what went wrong takes many words, " * 14 + "and the last ones say what to do"
    assert 480 < len(message) < 512
    told = [f"ship_{i}.applied_force_x_of_a_long_name" for i in range(200)]
    events = [{"time_s": i, "kind": "beset", "value": 0, "text": "-"} for i in range(41)]
    (run / "run.json").write_text(json.dumps({**note, "status": "failed", "message": message, "told": told,
                                              "events": events, "events_left_out": 2169}, indent=2))
    subprocess.run([FRAM, "report", run, "-q"], check=True)
    page = (run / "report.html").read_text()
    with open(run / "series.csv", newline="") as table:
        series = list(csv.DictReader(table))
    if pictures:
        # Names of folders are any bytes; a page shows a sign for each that is no text.
        named = os.fsencode(folder) + b"/b\xff\x1b[1m"
        os.symlink(run, named)
        # The way from where it began, 1.5 or 2 m, which far from the origin is as high as a chart.
        assert line_height(page, "Position") > 100, "no way is seen"
        said = subprocess.run([FRAM, "compare", run, named, "-q", "-o", folder / "both.html"], check=True,
                              capture_output=True, text=True, errors="replace").stdout
        both = Tables()
        both.feed((folder / "both.html").read_text("utf-8"))
        assert "b\ufffd\ufffd[1m" in (folder / "both.html").read_text("utf-8")
        assert line_height((folder / "both.html").read_text(), "Position along X") > 100, "no way is seen"
        # Far from the origin a place has its decimetres, and is no part of another.
        x = f"{float(series[-1]['position_x[m]']):.1f}"
        assert both.rows["x at the end [m]"] == [x, x, "0", "\u2013"], both.rows["x at the end [m]"]
        assert re.search(rf"x at the end \[m\] +{x} +{x} +0\n", said) and x.startswith("-13011"), said
    assert message in page, page[page.index("The run failed"):][:600]
    assert "The first 40 of 2210 events; run.json lists the first 41." in page, re.findall("The first .*events.*", page)
    # What is significant of a value that is held is the value.
    tables = Tables()
    tables.feed(page)
    assert tables.rows["contact points"] == ["0"] * 5, tables.rows["contact points"]
    assert any(row["ice_force_body_y[N]"] == "-0" for row in series), "nothing that could be told as -0"
    assert tables.rows["each step, across the vessel"] == ["0"] * 5, tables.rows["each step, across the vessel"]
    assert tables.rows["told by a program"] == [
        f"the rows above are the scenario's, in place of which were {', '.join(told[:16])} and 184 more"]
    if pictures:
        assert 'alt="Position: ' in page
        for chart in ("Histogram of the load", "Exceedance of the load", "Roll and pitch"):
            assert f'alt="{chart}: ' not in page, chart


def turn_loads(series):
    """What was along X is along Y, as of a ship that goes there."""
    head, rows = series.read_text().split("\n", 1)
    series.write_text(re.sub(r"((?:ice|tow)_force_\w*)(x|y)\[", lambda m: m[1] + "yx"["xy".index(m[2])] + "[", head)
                      + "\n" + rows)


def check_along_y(run, page):
    """Where the load lies along Y, zones and parts are told along it too."""
    tables = Tables()
    tables.feed(page)
    with open(run / "series.csv", newline="") as file:
        series = list(csv.DictReader(file))
    along_x = {name: channel for name, channel in {**ROWS, **TOWED_ROWS}.items() if name.endswith("along X")}
    along_y = {name[:-1] + "Y": channel[:-1] + "y" for name, channel in along_x.items()}
    assert len(along_y) == 10 and any(float(row["ice_force_bow_y[N]"]) for row in series)
    check_channels(series, 0, tables.rows, {**along_x, **along_y}, page)


def check_loose(folder):
    """A part of a sheet that comes loose did not break, in bending least of all."""
    file, run = folder / "loose.yaml", folder / "loose"
    file.write_text(LOOSE)
    subprocess.run([FRAM, "run", file, "-o", run, "-q"], check=True)
    move_series(run / "fractures.csv", -1400000, "place_x[m]")
    turn_loads(run / "series.csv")
    subprocess.run([FRAM, "report", run, "-q"], check=True)
    page = (run / "report.html").read_text()
    check_along_y(run, page)
    with open(run / "fractures.csv", newline="") as file:
        kinds, places = zip(*((row["kind[1]"], float(row["place_x[m]"])) for row in csv.DictReader(file)))
    assert all(f'<td class="n">{x:.1f}</td>' in page for x in places[:25]), "places far from the origin"
    bent = kinds.count("2")
    assert kinds.count("3") == 1 and bent > 0 and len(kinds) == bent + 1, kinds
    assert f"broke: {bent} in bending, 0 by splitting." in page and "1 part of the sheet came loose" in page
    assert page.count("<td>bending</td>") == bent and page.count("<td>came loose</td>") == 1


def keep_rows(series, since):
    """Leaves the rows of a series from a time on."""
    head, *rows = series.read_text().splitlines()
    series.write_text("\n".join([head, *(row for row in rows if float(row.split(",")[0]) >= since)]) + "\n")


def shrink_loads(series):
    """As of little ice."""
    head, *rows = (row.split(",") for row in series.read_text().splitlines())
    loads = [i for i, name in enumerate(head)
             if name.startswith(("ice_force_averaged_", "kinetic_energy", "crushing_work"))]
    rows = [[repr(1e-6 * float(v)) if i in loads else v for i, v in enumerate(row)] for row in rows]
    series.write_text("\n".join(map(",".join, [head, *rows])) + "\n")


def with_head(data, at, size, *fields):
    """A head with other fields, and its checksum after them (layout: io/record.h)."""
    for form, offset, value in fields:
        struct.pack_into(form, data, at + offset, value)
    struct.pack_into("<I", data, at + size - 4, zlib.crc32(data[at:at + size - 4]))


def other_version(data):
    with_head(data, 0, 24, ("<I", 8, 99))
    return data


def shorter_peak(data):
    """The first peak has four bytes less, as of another layout; every checksum fits."""
    at, kind, length = 24, None, 0
    while kind != 12:
        at += kind is not None and 24 + (length + 7) // 8 * 8
        kind, length = struct.unpack_from("<IQ", data, at + 4)
    end, rest = at + 24 + length - 4, data[at + 24 + (length + 7) // 8 * 8:]
    with_head(data, at, 24, ("<Q", 8, length - 4), ("<I", 16, zlib.crc32(data[at + 24:end])))
    return data[:end] + bytes(-(length - 4) % 8) + rest


def check_peaks(folder):
    """A report lacks only the peaks that another version of Fram wrote."""
    run = folder / "feeding"
    peaks, page = run / "peaks.fram", run / "report.html"
    kept = peaks.read_bytes()
    peaks.write_bytes(other_version(bytearray(kept)))
    done = subprocess.run([FRAM, "why", run, "--peak", "1"], capture_output=True, text=True)
    assert done.returncode == 2 and "another version of Fram wrote it: read it with that one" in done.stderr, done
    peaks.write_bytes(shorter_peak(bytearray(kept)))
    done = subprocess.run([FRAM, "report", run], check=True, capture_output=True, text=True)
    assert done.stderr.count("warning: the report tells no peaks: ") == 1 and "does not fit" in done.stderr, done.stderr
    assert "The largest peaks are not told: peaks.fram cannot be read." in page.read_text()
    peaks.write_bytes(kept)


def check_late(folder):
    """A recording that began on the way, as one of a program does: from when on, and what was lost before it."""
    run = folder / "feeding"
    scenario, series, note = run / "scenario.yaml", run / "series.csv", run / "run.json"
    scenario.write_text(re.sub("offset_limit: auto.*", "offset_limit: 50", scenario.read_text()))
    keep_rows(series, 5)
    shrink_loads(series)
    (run / "record.fram").unlink()
    lacking = "he run has no record, as a study keeps with `series`: nothing is told of its ice field"
    for lost, told in ((None, "The vessel held its station from 5 s on."),
                       (1.5, "The vessel held its station from 5 s on."),
                       (3, "The offset passed its limit of 50 m at 3 s, before the recording began; the rows reach")):
        # Those of a vessel on station are all in a file of its own.
        more, left = ([], 0) if lost is None else ([{"time_s": 9, "kind": "ram", "value": 0, "text": "-"}] * 38,
                                                   7 if lost == 3 else 0)
        events = [] if lost is None else [{"time_s": lost, "kind": "position_lost", "value": 60, "text": "lost"},
                                          {"time_s": lost + 0.25, "kind": "position_regained", "value": 1, "text": "-"},
                                          {"time_s": 9, "kind": "band", "value": 0, "text": "-"}, *more]
        note.write_text(json.dumps({**json.loads(note.read_text()), "recorded_from_s": 5, "events": events,
                                    "events_left_out": left}))
        done = subprocess.run([FRAM, "report", run], check=True, capture_output=True, text=True)
        page = (run / "report.html").read_text()
        assert CHANGED in done.stderr and CHANGED in page, done.stderr
        assert (lacking in done.stderr) == (lacking in page) == (lost is None), done.stderr
        scenario.write_text(re.sub("frame_interval: .*", "frame_interval: 0", scenario.read_text()))
        assert told in page, (lost, page[page.index("verdict"):][:900])
        listed = re.search(r"The first 40 of .*?events; (.*?)\.</p>", page)
        assert (listed and listed[1]) == {None: None, 1.5: "run.json lists all", 3:
            "run.json lists the first 41, station.json those of its vessel"}[lost], (lost, listed)
        assert "recorded from 5 to 14 s of 14; Fram" in page and "5 to 14" in page
        band = "The vessel reached the band of the ice field, whose floes nothing pushes aside, at 9 s." in page
        assert band == ("verdict bad" in page) == (lost is not None), (lost, band)
        # A single vessel has no name that a column could tell.
        assert ('time [s]</th><th class="w" scope="col">event</th>' in page) == (lost is not None), "the events' heads"
    # It is named where the run has written it.
    (run / "station.json").unlink()
    subprocess.run([FRAM, "report", run, "-q"], check=True)
    assert "events; run.json lists the first 41.</p>" in (run / "report.html").read_text()
    assert "did not hold its station" in page and "as far as the run went" not in page
    tables = Tables()
    tables.feed(page)
    assert all(tables.rows[row][0].endswith(" J") for row in ("kinetic energy", "crushing work")), tables.rows
    # Lines are told in their own unit, however little ice there is.
    assert ">load on the vessel [N]<" in page and ">lines and thrusters [kN]<" in page, re.findall("<th.*?</th>", page)


def drop_frame(record):
    """Takes the first frame out of a record; False where there is none."""
    data, block = record.read_bytes(), (24, 24)
    while block[1] < len(data):
        kind, length = struct.unpack_from("4xIQ", data, block[1])
        block = (block[1], block[1] + 24 + (length + 7) // 8 * 8)
        if kind == 15:
            record.write_bytes(data[:block[0]] + data[block[1]:])
            return True
    return False


def check_late_frames(folder):
    """Of runs of earlier versions the first frame tells whether a recording began late, however far apart rows are; the
    first frame or row tells when."""
    run = folder / "water"
    note = json.loads((run / "run.json").read_text())
    assert note.pop("recorded_from_s") == 0
    (run / "run.json").write_text(json.dumps(note))
    scenario, series, record = run / "scenario.yaml", run / "series.csv", run / "record.fram"
    rows = series.read_text()
    scenario.write_text(re.sub("csv_interval: 0 ", "csv_interval: 1.8 ", scenario.read_text()))
    keep_rows(series, 1.79)
    for told in (False, True):
        subprocess.run([FRAM, "report", run, "-q"], check=True)
        page = (run / "report.html").read_text()
        assert ("recorded from 1 to 2 s of 2; Fram" in page) == told, re.search("<p.*Fram.*", page)
        assert drop_frame(record)
    # What is left is the frame at 2 s.
    series.write_text(rows)
    keep_rows(series, 0.499)
    subprocess.run([FRAM, "report", run, "-q"], check=True)
    page = (run / "report.html").read_text()
    assert "recorded from 0.5 to 2 s of 2; Fram" in page, re.search("<p.*Fram.*", page)
    while drop_frame(record):
        pass
    subprocess.run([FRAM, "report", run, "-q"], check=True)
    assert "floes at the start" in page and "floes at the start" not in (run / "report.html").read_text()


FLOES = """
run: {duration: 0.02, time_step: 0.02}
vessel: {mode: towed, x: -30, speed: 1, %s}
ice: {density: 900, %%s}
domain: {x_min: -60, x_max: 60, y_min: -40, y_max: 40, boundary: open}
output: {frame_interval: 0.02}
""" % VESSEL


def check_ice(folder):
    """The ice that is told is that which there was, not what ice.thickness and the strengths beside it say."""
    (folder / "thick.geojson").write_text(json.dumps({"type": "Polygon", "coordinates": [
        [[10, 0], [20, 0], [20, 10], [10, 10], [10, 0]]]}).join(
            ('{"type": "Feature", "properties": {"thickness": 1.5}, "geometry": ', "}")))
    strengths = "; crushing strength 2000 kPa, flexural strength 500 kPa, does not break"
    for ice, told, populations in (
            ("source: file, file: thick.geojson, thickness: 0.8", f"observed floes, 1.5 m thick, 900 kg/m3{strengths}",
             None),
            ("source: floes, floes: [{x: 20, length: 9, width: 9, thickness: 0.3}, {x: 40, length: 9, width: 9, "
             "thickness: 0.25}]", f"listed floes, 0.25 to 0.3 m thick, 900 kg/m3{strengths}", None),
            ("source: voronoi, concentration: 0.5, breakable: true, populations: [{size: constant, diameter: 20, "
             "thickness: 0.2, crushing_strength: 1.0e+6, breakable: false}]",
             "managed ice (Voronoi cells), 0.2 m thick, 900 kg/m3",
             "1: 0.2 m thick, crushing strength 1000 kPa, flexural strength 500 kPa, does not break"),
            ("source: voronoi, concentration: 0.5", f"managed ice (Voronoi cells), 1 m thick, 900 kg/m3{strengths}",
             None)):
        file, run = folder / "ice.yaml", folder / "ice"
        file.write_text(FLOES % ice)
        subprocess.run([FRAM, "run", file, "-o", run, "-q", "--force"], check=True)
        subprocess.run([FRAM, "report", run, "-q"], check=True)
        tables = Tables()
        tables.feed((run / "report.html").read_text())
        assert tables.rows["ice"] == [told], (tables.rows["ice"], told)
        assert tables.rows.get("populations") == (populations and [populations]), tables.rows["populations"]
    assert "floes are cut from cells of 400 m2 on average" in tables.rows["field"][0], tables.rows["field"]


def check_killed(folder):
    """A run that was killed tells all breaks that its series counts, and which of them fractures.csv lacks."""
    run = folder / "loose"
    note, table = run / "run.json", run / "fractures.csv"
    kept, events = note.read_text(), table.read_text()
    head, *rows = events.splitlines()
    kinds, bent = [row.split(",")[head.split(",").index("kind[1]")] for row in rows], events.count("\n") - 2
    assert kinds.count("2") == bent > 1, kinds
    note.write_text(json.dumps({**json.loads(kept), "status": "running"}))
    first = kinds.index("2") + 1
    for lines, said in ((rows, None), (rows[:first], f"are not in fractures.csv: {bent - 1} of those that the series"),
                        ([], "Of these events none is in fractures.csv yet")):
        table.write_text("\n".join([head, *lines]) + "\n")
        subprocess.run([FRAM, "report", run, "-q"], check=True)
        page = (run / "report.html").read_text()
        assert f"<b>{bent} <small></small></b><span>floes that broke</span>" in page, re.findall(".*that broke<", page)
        assert f"broke: {bent} in bending, 0 by splitting." in page
        assert (said or "</html>") in page, said
        assert ("not in fractures.csv" in page or "none is in fractures.csv" in page) == (said is not None), said
        assert page.count("<td>bending</td>") == len([k for k in kinds[:len(lines)] if k == "2"])
    # Of a recording that began on the way the series has counted what broke before it.
    note.write_text(json.dumps({**json.loads(kept), "recorded_from_s": 0.5}))
    series = run / "series.csv"
    keep_rows(series, 0.5)
    move_series(series, 100, "bendings[1]")
    table.write_text(events)
    subprocess.run([FRAM, "report", run, "-q"], check=True)
    assert f"broke: {bent} in bending" in (run / "report.html").read_text()


SHORT = f"""
title: "\u0645\u0631\u062d\u0628\u0627"
run: {{duration: 0.1, time_step: 0.02}}
vessels:
  - {{name: first, mode: towed, x: -30, speed: 1, {VESSEL}}}
  - {{name: second, mode: towed, x: 30, speed: 1, {VESSEL}}}
ice: {{source: floes, floes: [{{x: 20, y: 18, length: 9, width: 9}}]}}
domain: {{x_min: -60, x_max: 90, y_min: -40, y_max: 40, boundary: open}}
"""


def check_short(folder, pictures):
    """A run that ends before its second frame has one field to tell; two vessels, a list of sections."""
    file, run = folder / "short.yaml", folder / "short"
    file.write_text(SHORT, "utf-8")
    subprocess.run([FRAM, "run", file, "-o", run, "-q"], check=True)
    # What rounding leaves of nothing; what is small by itself is no such rest, and told as it is.
    head, *rows = (run / "series.csv").read_text().splitlines()
    at = {i: "-1.6e-10" for i, name in enumerate(head.split(",")) if re.match("first.*ice_force_averaged_[xy]", name)}
    assert len(at) == 2, head
    small = {"solver_residual[m/s]": "8.768e-11", "overlap_mean[m]": "1e-13", "overlap_max[m]": "1.5e-12",
             "step_wall_time[s]": "1.25e-12"}
    at |= {head.split(",").index(name): value for name, value in small.items()}
    rows = [",".join(at.get(i, v) for i, v in enumerate(row.split(","))) for row in rows]
    (run / "series.csv").write_text("\n".join([head, *rows]) + "\n")
    subprocess.run([FRAM, "report", run, "-q"], check=True)
    page = (run / "report.html").read_text("utf-8")
    tables = Tables()
    tables.feed(page)
    assert tables.rows["floes"] == ["1"] and page.count(">at 0 s<") == 1, tables.rows["floes"]
    assert tables.rows["averaged, along X"] == ["0"] * 5, tables.rows["averaged, along X"]
    for name, value in (("residual of the contact problem [m/s]", "8.768e-11"), ("largest overlap [m]", "1.500e-12"),
                        ("mean overlap of touching bodies [m]", "1.000e-13"),
                        ("computing time of a step [ms]", "1.250e-09")):
        assert tables.rows[name][0] == value and tables.rows[name][3] == value, (name, tables.rows[name])
    done = subprocess.run([FRAM, "compare", run, run, "-o", folder / "both.html"], capture_output=True, text=True,
                          check=True)
    both = Tables()
    both.feed((folder / "both.html").read_text("utf-8"))
    for name, value, shown in (("first: ice load along X, mean", "0", "0"),
                               ("residual, mean", "8.768e-11", "8.768e-11"),
                               ("largest overlap", "1.5e-12", "1.500e-12"),
                               ("computing time of a step, mean", "1.25e-09", "1.250e-09")):
        line, = [line for line in done.stdout.splitlines() if line.startswith(name + " [")]
        assert line.split()[-3:] == [value, value, "0"], line
        row, = [row for head, row in both.rows.items() if head.startswith(name)]
        assert row[:2] == [shown, shown] or row[1:3] == [shown, shown], (name, row)
    assert "The field at the end" not in page and "after" not in re.findall('alt="Floe sizes: ([^"]*)"', page)[:1]
    assert page.count('alt="The field at the start') == (1 if pictures else 0)
    check_structure(page, contents=True)


def main():
    pictures = "cairo" in subprocess.run([FRAM, "--version"], capture_output=True, text=True, check=True).stdout
    said = []
    with tempfile.TemporaryDirectory() as folder:
        for name, scene in list(SCENES.items())[:1 if os.environ.get("FRAM_TEST_SHORT") else None]:
            file, run = pathlib.Path(folder) / f"{name}.yaml", pathlib.Path(folder) / name
            file.write_text(scene)
            subprocess.run([FRAM, "run", file, "-o", run, "-q"], check=True)
            subprocess.run([FRAM, "report", run, "-q"], check=True)
            said.append(f"{name}: {check(name, run, pictures):g} %")
        check_times(pathlib.Path(folder))
        check_water(pathlib.Path(folder), pictures)
        check_late_frames(pathlib.Path(folder))
        check_loose(pathlib.Path(folder))
        check_killed(pathlib.Path(folder))
        check_ice(pathlib.Path(folder))
        check_short(pathlib.Path(folder), pictures)
        check_peaks(pathlib.Path(folder))
        check_late(pathlib.Path(folder))
    print("mass not accounted for, " + ", ".join(said))


main()
