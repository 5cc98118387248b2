"""In how many runs of a study a vessel keeps its station: station.csv and the page, by the runs themselves."""
import csv
import json
import re
import subprocess
import unittest

from studies import FRAM, StudyTest

MOORED = """
run: {duration: 5, time_step: 0.04, transient: 1}
vessel:
  mode: free
  speed: 2
  hull: {length: 48, beam: 12, draught: 4, freeboard: 2}
  mooring:
    depth: 50
    lines: [{kind: spring, count: 4, spacing_deg: 90, direction_deg: 45, pretension: 1e5, stiffness: 2e4}]
ice: {concentration: 0.8, mean_floe_area: 64}
domain: {x_min: -64, x_max: 64, y_min: -40, y_max: 40}
"""
OFFSET, HEADING, LINES = "offset_largest[m]", "heading_deviation_largest[deg]", "lines_parted[1]"
# Clopper and Pearson's 95 % of 4 runs: 1 - 0.025^(1/4) at the end, and the root of the tail of two of four.
INTERVAL = {0: (0, 0.602365), 2: (0.067586, 0.932414), 4: (0.397635, 1)}


def luminance(colour):
    """Relative, of sRGB from 0 to 1 (WCAG 2.1)."""
    linear = [v / 12.92 if v <= 0.04045 else ((v + 0.055) / 1.055) ** 2.4 for v in colour]
    return sum(w * v for w, v in zip((0.2126, 0.7152, 0.0722), linear))


class StationTest(StudyTest):
    def setUp(self):
        super().setUp()
        (self.at / "base.yaml").write_text(MOORED)

    def between(self, figure):
        """A limit that half of the runs of the plain study stay below."""
        sizes = sorted(float(r[figure]) for r in self.rows("plain"))
        self.assertLess(sizes[1], sizes[2])
        return 0.5 * (sizes[1] + sizes[2])

    def plain(self):
        self.fram(self.write("seeds: 4\n"), "-o", self.at / "plain")

    def page(self, folder):
        return (self.at / folder / "study.html").read_text().replace("\u200b", "")

    def test_maps_can_be_read_and_the_page_has_a_name(self):
        """Ink has a contrast of 4.5 at least on every cell, as WCAG 2.1 asks for (1.4.3, AA)."""
        study = self.write("seeds: 2\nvary: {grid: {vessel.station.offset_limit: [0.001, 1000],"
                           " vessel.speed: [1, 2]}}\n", "limits.yaml")
        self.fram(study, "-o", self.at / "out")
        page = self.page("out")
        self.assertIn("<title>Study limits.yaml of base.yaml</title>", page)
        ink = re.search("--ink:(#[0-9a-f]{6})", page)[1]
        cells = re.findall(r"background:color-mix\(in srgb,(#[0-9a-f]{6}) (\d+)%,#fff\)", page)
        for colour in ("#2e7d4f", "#d1603d"):
            self.assertGreaterEqual(max(int(part) for c, part in cells if c == colour), 60, colour)
        for colour, part in cells:
            mixed = [1 + (int(colour[i:i + 2], 16) / 255 - 1) * int(part) / 100 for i in (1, 3, 5)]
            self.assertGreaterEqual((luminance(mixed) + 0.05) / (luminance(
                [int(ink[i:i + 2], 16) / 255 for i in (1, 3, 5)]) + 0.05), 4.5, (colour, part))

    def test_runs_are_counted_by_what_is_required(self):
        self.plain()
        self.assertFalse((self.at / "plain" / "station.csv").exists())
        self.assertIn("Nothing is required of the station", self.page("plain"))
        offset, heading = self.between(OFFSET), self.between(HEADING)
        study = self.write(f"seeds: 4\nvary: {{grid: {{vessel.station.heading_limit_deg: [{heading!r}, 180],"
                           f" vessel.station.offset_limit: [{offset!r}, 1000]}}}}\n")
        self.fram(study, "-o", self.at / "out")
        runs, told = self.rows("out"), self.rows("out", "station.csv")
        self.assertEqual(len(told), 4)
        for row, limits in zip(told, ((heading, offset), (heading, 1000), (180, offset), (180, 1000))):
            of = [r for r in runs if r["condition"] == row["condition"]]
            far = [float(r[OFFSET]) > limits[1] for r in of]
            turned = [float(r[HEADING]) > limits[0] for r in of]
            kept = sum(not a and not b for a, b in zip(far, turned))
            self.assertEqual((float(row["heading_limit[deg]"]), float(row["offset_limit[m]"])), limits)
            self.assertEqual([int(row[k]) for k in ("runs", "kept", "beyond_offset", "beyond_heading", "lines_parted")],
                             [4, kept, sum(far), sum(turned), 0])
            self.assertEqual(float(row["share[1]"]), kept / 4)
            for end, is_end in zip(INTERVAL.get(kept, ()), ("low[1]", "high[1]")):
                self.assertAlmostEqual(float(row[is_end]), end, delta=1e-6)
        self.assertEqual([int(r["kept"]) for r in told][2:], [2, 4])
        page = self.page("out")
        self.assertIn(">50 (7 to 93)<", page)
        self.assertIn(">100 (40 to 100)<", page)
        self.assertIn("Runs that kept station [%]", page)
        self.assertIn("station was not kept in all runs at vessel.station.offset_limit", page)
        # Without limits the table of the study before goes.
        self.fram(self.write("seeds: 4\n"), "-o", self.at / "out")
        self.assertFalse((self.at / "out" / "station.csv").exists())

    def test_a_line_that_parts_loses_the_station_and_one_that_is_let_go_does_not(self):
        self.plain()
        load = self.between("line_tension_largest[N]")
        text = MOORED.replace("stiffness:", "breaking_load: 1e9, stiffness:")
        let_go = "{kind: spring, distance: 200, stiffness: 1e3, pretension: 1e4, release_time: 2}"
        (self.at / "base.yaml").write_text(text.replace("lines: [", f"lines: [{let_go}, "))
        study = self.write(f"seeds: 4\nvary: {{list: [{{vessel.mooring.lines.1.breaking_load: {load!r}}},"
                           " {vessel.mooring.lines.1.breaking_load: 1e9}]}\n")
        self.fram(study, "-o", self.at / "out")
        parted = [float(r[LINES]) > 1 for r in self.rows("out")]
        self.assertTrue(any(parted[:4]))
        self.assertEqual([float(r[LINES]) for r in self.rows("out")][4:], [1] * 4)
        told = self.rows("out", "station.csv")
        self.assertEqual([int(r["kept"]) for r in told], [4 - sum(parted[:4]), 4])
        self.assertEqual([int(r["lines_parted"]) for r in told], [sum(parted[:4]), 0])
        # One that parts at once is not let go later.
        study = self.write("seeds: 2\nkeep: series\nextremes: {duration: 1h}\n"
                           "set: {vessel.mooring.lines.0.breaking_load: 1e3, run.transient: 0.56}\n")
        self.fram(study, "-o", self.at / "early")
        # The difference of two times is told without its rounding.
        self.assertEqual({r["block[s]"] for r in self.rows("early", "extremes.csv")}, {"4.44"})
        self.assertEqual([(r[LINES], r["lines_broken[1]"]) for r in self.rows("early")], [("1", "1")] * 2)
        (told,) = self.rows("early", "station.csv")
        self.assertEqual((told["kept"], told["lines_parted"]), ("0", "2"))
        (run,) = (self.at / "early" / "runs").glob("*/1")
        said = subprocess.run([FRAM, "extremes", run, "--channel", "offset_x"], check=True, capture_output=True,
                              text=True)
        self.assertIn("parted in 1 of 1 runs", said.stdout)
        # One that was killed tells no events, and what is let go in the step after its last row was not.
        note = json.loads((run / "run.json").read_text())
        (run / "run.json").write_text(json.dumps({**note, "status": "running", "events": []}))
        text = (run / "scenario.yaml").read_text()
        for key, value, later in (("duration", 5, 500), ("release_time", 2, 5)):
            text, count = re.subn(rf"\b{key}: {value}\b", f"{key}: {later}", text)
            self.assertEqual(count, 1, text)
        (run / "scenario.yaml").write_text(text)
        said = subprocess.run([FRAM, "extremes", run, "--channel", "offset_x"], check=True, capture_output=True,
                              text=True)
        self.assertIn("parted in 1 of 1 runs", said.stdout)

    def test_a_tension_that_parts_a_line_is_known_and_levels_beyond_it_are_not_told(self):
        self.plain()
        # Little more than what half of the runs reach.
        load = self.between("line_tension_largest[N]")
        (self.at / "base.yaml").write_text(MOORED.replace("stiffness:", f"breaking_load: {load!r}, stiffness:"))
        study = self.write("seeds: 14\nkeep: series\nextremes: {duration: 3h, levels: [0.9], "
                           "hours: [100], annual: [1e-2]}\n")
        self.fram(study, "-o", self.at / "out")
        parted = [r for r in self.rows("out") if float(r[LINES]) > 0]
        whole = [r for r in self.rows("out") if float(r[LINES]) == 0]
        self.assertTrue(parted and whole)
        self.assertTrue(all(float(r["line_tension_largest[N]"]) > load for r in parted))
        self.assertTrue(all(float(r["line_tension_largest[N]"]) <= load for r in whole))
        told = {r["figure"]: r for r in self.rows("out", "extremes.csv")}
        self.assertGreater(float(told["load_largest"]["most_probable"]), 0)
        self.assertNotIn("parted", told["load_largest"]["note"])
        tension = told["line_tension_largest"]
        self.assertEqual([tension[k] for k in ("most_probable", "low", "high", "below_0.9")], [""] * 4)
        # They state no load that a line holds: of one that parts in the transient the others' tensions are left.
        self.assertIn(f"Lines parted in {len(parted)} of 14 runs, whose tensions from there on are those of a mooring "
                      "with fewer lines", tension["note"])
        self.assertIn(f"Lines parted in {len(parted)} of 14 runs", self.page("out"))
        # A vessel whose line has parted drifts on: its offset is what the run's end leaves of that.
        offset = told["offset_largest"]
        self.assertEqual([offset[k] for k in ("most_probable", "low", "high", "below_0.9")], [""] * 4)
        self.assertIn(f"Lines parted in {len(parted)} of 14 runs, and the vessel drifted on", offset["note"])
        # A run that failed is none of those.
        (row,) = (self.at / "out" / "runs").glob(f"*/{whole[0]['seed']}.row")
        kept = row.read_text()
        row.write_text(re.sub(r"(?m)^([a-z_]+) .+$", r"\1 ", kept.replace("\nfinished\n", "\nfailed\n"))
                       .replace("fram ", kept.splitlines()[0], 1))
        self.assertEqual(self.fram(study, "-o", self.at / "out")["failed"], 1)
        for told in self.rows("out", "extremes.csv")[1:]:
            self.assertIn(f"Lines parted in {len(parted)} of 13 runs", told["note"])
        row.write_text(kept)
        self.fram(study, "-o", self.at / "out")
        # The same of their series, one by one.
        run = [str(next((self.at / "out" / "runs").iterdir()) / r["seed"]) for r in (parted[0], whole[0])]
        for channel, tells in (("line_tension_max", True), ("line_1_tension", True), ("offset_x", True),
                               ("load", False)):
            done = subprocess.run([FRAM, "extremes", *run, "--channel", channel, "--json"], check=True,
                                  capture_output=True, text=True)
            for method in json.loads(done.stdout)["methods"]:
                self.assertEqual("Lines parted in 1 of 2 runs" in method["note"], tells, method)
                self.assertFalse(channel == "offset_x" and method["answered"], method)
                # No tension is told that the lines of the run did not hold.
                told = [l["level"] for l in (method["most_probable"], *method["levels"]) if l["level"] is not None]
                if channel == "line_tension_max":
                    self.assertTrue(all(t < float(parted[0]["line_tension_largest[N]"]) for t in told), method)
                    self.assertIn("of a mooring with fewer lines: levels from", method["note"])
        year = {r["figure"]: r for r in self.rows("out", "annual.csv")}
        self.assertNotEqual(year["load_largest"]["level"], "")
        for figure in ("line_tension_largest", "offset_largest"):
            self.assertEqual(year[figure]["level"], "")
            self.assertIn("lines parted in", year[figure]["note"])
        self.assertIn("of a mooring with fewer lines", year["line_tension_largest"]["note"])
        # The page has them too: a level of the load, and why there is none of the others.
        page = self.page("out")
        self.assertIn("Levels that are exceeded with a probability in a year", page)
        rows = [r for r in page.split("<tr>") if "<td>0.01</td>" in r]
        self.assertEqual(["No answer: lines parted in" in r for r in rows], [False, True, True])

    def test_a_series_tells_how_far_the_station_is_kept(self):
        self.plain()
        most = 1.01 * max(float(r[OFFSET]) for r in self.rows("plain"))
        study = self.write(f"seeds: 6\nset: {{vessel.station.offset_limit: {most!r}}}\n"
                           "vary: {grid: {vessel.speed: [1, 2, 4]}}\n")
        self.fram(study, "-o", self.at / "out")
        self.assertEqual([int(r["kept"]) for r in self.rows("out", "station.csv")], [6, 6, 0])
        page = self.page("out")
        self.assertIn("Station was kept in all runs up to vessel.speed 2 m/s.", page)
        limits = f"{{vessel.station.offset_limit: [{most / 1e6!r}, {most!r}, 100]}}"
        limits = self.write(f"seeds: 6\nvary: {{grid: {limits}}}\n")
        self.fram(limits, "-o", self.at / "limits")
        self.assertRegex(self.page("limits"), r"Station was kept in all runs from vessel.station.offset_limit \S+ m on")
        # The slowest meets no ice: its runs differ in nothing but rounding, and have no digits of that.
        self.assertRegex(page, r"<td>[0-9]\.[0-9]{2} ± 0\.00<")

    def test_lines_that_a_vessel_does_not_have_are_not_on_the_page(self):
        gear = "  thrusters: [{kind: azimuth, x: 20, z: -3, thrust: 5e5, turn_rate_deg: 90}, {x: -20, thrust: 5e5}]\n"
        bare = MOORED[:MOORED.index("  mooring:")] + gear + "  positioning: {active: true}\n" + \
            MOORED[MOORED.index("ice:"):]
        self.plain()
        self.assertIn("Largest line tension", self.page("plain"))
        (self.at / "base.yaml").write_text(bare)
        self.fram(self.write("seeds: 2\nkeep: series\n"), "-o", self.at / "bare")
        (series,) = (self.at / "bare" / "runs").glob("*/1/series.csv")
        with open(series, newline="") as file:
            power = [float(r["thruster_power[W]"]) for r in csv.DictReader(file) if float(r["time[s]"]) > 1]
        told = float(self.rows("bare")[0]["thruster_power_mean[W]"])
        self.assertAlmostEqual(told / (sum(power) / len(power)), 1, delta=1e-9)
        self.assertTrue(told < 0.99 * max(power))
        self.assertLessEqual({"load_mean[N]", "offset_largest[m]"}, self.check_means("bare"))
        self.assertLessEqual({"line_tension_largest[N]", "line_tension_range_equivalent[N]", "offset_largest[m]"},
                             self.check_means("plain"))
        self.assertIn("Largest offset", self.page("bare"))
        self.assertNotIn("tension", self.page("bare"))
        # Nor have the tables a 0 of them, or of thrusters where there are none.
        lines = ("line_tension_significant[N]", "line_tension_largest[N]", "line_tension_range_equivalent[N]",
                 "lines_parted[1]", "lines_broken[1]")
        for folder, empty, there in (("bare", lines, ["thruster_power_mean[W]"]),
                                     ("plain", ["thruster_power_mean[W]"], lines)):
            for row in self.rows(folder):
                self.assertEqual({row[k] for k in empty}, {""}, folder)
                self.assertNotIn("", [row[k] for k in there])
        self.refused("keep: {record_of_worst: 1, by: line_tension_largest}\n", "study.yaml:2: by", "mooring")
        self.fram("check", self.write("keep: {record_of_worst: 1, by: thruster_power_mean}\n"))

    def test_seeds_that_draw_nothing_are_told_where_no_ice_comes(self):
        (self.at / "base.yaml").write_text(re.sub("ice: .*", "ice: {source: none}", MOORED))
        study = self.write("seeds: 2\nset: {run.duration: 1.2}\n")
        done = subprocess.run([FRAM, "study", study, "-o", self.at / "out"], check=True, capture_output=True, text=True)
        self.assertIn("all runs came out the same, since nothing that run.seed draws acted", done.stderr)

    def test_a_vessel_without_a_station_has_no_part_on_the_page(self):
        (self.at / "base.yaml").write_text(MOORED[:MOORED.index("  mooring")].replace("mode: free", "mode: towed") +
                                           MOORED[MOORED.index("ice:"):])
        self.fram(self.write("seeds: 2\n"), "-o", self.at / "out")
        self.assertNotIn(">Station</h2>", self.page("out"))
        self.assertFalse((self.at / "out" / "station.csv").exists())
        # One that nothing holds, and that has limits all the same, has not kept them.
        limits = "vessel.station.offset_limit: 2, run.duration: 2.4"
        self.fram(self.write(f"seeds: 1\nset: {{vessel.mode: free, {limits}}}\n"), "-o", self.at / "adrift")
        self.assertEqual([r["kept"] for r in self.rows("adrift", "station.csv")], ["0"])


if __name__ == "__main__":
    unittest.main()
