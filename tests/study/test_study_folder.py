#!/usr/bin/env python3
"""Folders of studies: of another scenario they are told, of something else they are left alone; who starts a study may
ignore how programs end; and what is told meanwhile is of the study."""
import fcntl
import json
import os
import re
import resource
import shutil
import signal
import subprocess
import unittest

from studies import FRAM, StudyTest


class Folders(StudyTest):
    def check_newtons(self, folder):
        """Loads that are all under 10 kN are told in newtons."""
        most = max(float(r["load_largest[N]"]) for r in self.rows(folder))
        self.assertTrue(0 < most < 1e4, most)
        page = (self.at / folder / "study.html").read_text()
        heads = set(re.findall("<th[^>]*>((?:Mean|Significant|Largest) load.*?)</th>", page))
        self.assertEqual(heads, {"Mean load [N]", "Significant load [N]", "Largest load [N]"})
        largest = re.search("Worst runs.*?<tbody>.*?<tr>" + "<td[^>]*>([^<]*)</td>" * 3, page, re.S)[3]
        self.assertAlmostEqual(float(largest), most, delta=0.006 * most)
        done = subprocess.run([FRAM, "study", "list", self.at / folder], check=True, capture_output=True, text=True)
        self.assertRegex(done.stdout, r" \d\S* N +\d\S* N  ")

    def test_a_folder_of_a_study_of_another_scenario_is_told(self):
        short = "set: {run.duration: 0.1, run.transient: 0}\nseeds: 1\n"
        self.fram(self.write(short), "-o", self.at / "out")
        base = (self.at / "base.yaml").read_text()
        (self.at / "other.yaml").write_text(base + "title: another\n")
        study = self.write(short)
        for name, tells in (("base.yaml", False), ("other.yaml", True), ("other.yaml", False)):
            study.write_text(f"scenario: {name}\n{short}# {name}\n")
            done = subprocess.run([FRAM, "study", study, "-o", self.at / "out"], check=True, capture_output=True,
                                  text=True)
            self.assertEqual("was of a study of " in done.stderr, tells, done.stderr)
            self.assertEqual("base.yaml" in done.stderr, tells)
        # The study as it was read is of the same scenario, one of the same name elsewhere is of another; where it is
        # the same there too it was moved, here with a seed and a condition more.
        record, away = self.at / "out" / "effective.yaml", self.at / "away"
        away.mkdir()
        (away / "other.yaml").write_text(base + "title: elsewhere\n")
        (away / "study.yaml").write_text(study.read_text())
        for path, tells in ((record, False), (study, False), (away / "study.yaml", True)):
            done = subprocess.run([FRAM, "study", path, "-o", self.at / "out"], check=True, capture_output=True,
                                  text=True)
            self.assertEqual(f"was of a study of {self.at}/other.yaml" in done.stderr, tells, done.stderr)
            self.assertEqual("warning" in done.stderr, tells, done.stderr)
        moved = self.at / "moved"
        shutil.copytree(away, moved)
        (moved / "study.yaml").write_text(study.read_text().replace("seeds: 1", "seeds: 2")
                                          + "vary: {grid: {vessel.speed: [1, 2]}}\n")
        done = subprocess.run([FRAM, "study", moved / "study.yaml", "-o", self.at / "out"], check=True,
                              capture_output=True, text=True)
        self.assertNotIn("was of a study of", done.stderr)
        self.assertIn("3 carried out now", done.stderr)
        # The record of a study from when an interval wider than its mean was taken is read all the same.
        text = record.read_text()
        wide = re.sub("seeds: .*", "seeds: {least: 2, most: 3, mean_within: 5}", text).replace("other.yaml", "old.yaml")
        record.write_text(wide)
        self.assertEqual(self.fram("list", self.at / "out")["conditions"], 2)
        done = subprocess.run([FRAM, "study", study, "-o", self.at / "out"], check=True, capture_output=True, text=True)
        self.assertIn("old.yaml: its runs stay", done.stderr)
        # One of something else is left alone, --force or not.
        (self.at / "mine").mkdir()
        (self.at / "mine" / "letter").write_text("")
        error = self.fram(study, "-o", self.at / "mine", "--force", code=2)["error"]
        self.assertEqual(error["message"], "the folder holds something else than a study; name another one")
        self.assertEqual([p.name for p in (self.at / "mine").iterdir()], ["letter"])

    def test_a_folder_whose_name_is_no_utf_8_is_known_again(self):
        folder = self.at / os.fsdecode(b"n\xe9")
        folder.mkdir()
        (folder / "study.yaml").write_text("scenario: base.yaml\nset: {run.duration: 0.1, run.transient: 0}\n")
        for title in ("one", "two"):
            (folder / "base.yaml").write_text((self.at / "base.yaml").read_text() + f"title: {title}\n")
            self.assertNotIn("was of a study", "".join(self.warned(folder / "study.yaml", "-o", self.at / "out")))
        self.assertEqual((self.at / "out" / "effective.yaml").read_text("utf-8").count("n\ufffd/base.yaml"), 2)

    def warned(self, *words):
        """The warnings of a study, all of which come before its runs."""
        done = subprocess.run([FRAM, "study", *words], check=True, capture_output=True, text=True)
        lines = done.stderr.splitlines()
        first = next((i for i, line in enumerate(lines) if line.endswith(" runs")), len(lines))
        self.assertEqual([line for line in lines[first:] if line.startswith("warning: ")], [])
        return [line for line in lines[:first] if line.startswith("warning: ")]

    def refused_and_warned(self, *words):
        """The warnings of a study that is refused."""
        done = subprocess.run([FRAM, "study", *words], capture_output=True, text=True)
        self.assertEqual(done.returncode, 2, done.stderr)
        return [line for line in done.stderr.splitlines() if line.startswith("warning: ")]

    def test_each_warning_of_a_scenario_is_told_once_with_its_condition(self):
        """Of sentences that differ in their numbers alone those of three conditions, and how many have others."""
        study = self.write("set: {run.duration: 0.1, run.transient: 0, vessel.mode: free, ice.source: none,"
                           " environment.wind_speed: 80}\nkeep: summary\n"
                           "vary: {grid: {vessel.centre_of_gravity_z: [0, 5, 5.5, 5.75, 6, 6.5]}}\n")
        told = self.warned(study, "-o", self.at / "out")
        self.assertEqual(len(set(told)), len(told))
        of = "warning: condition {} (vessel.centre_of_gravity_z={}): "
        self.assertEqual([line.split(" is outside")[0] for line in told if "wind_speed" in line],
                         [of.format(1, 0) + "environment.wind_speed: 80 m/s"])
        self.assertEqual([line.split(": its")[0] for line in told if "capsizes" in line],
                         [of.format(*c) + "the vessel capsizes" for c in ((2, 5), (3, 5.5), (4, 5.75))])
        self.assertEqual(told[-1], "warning: 2 more conditions have warnings like these, with other numbers")
        self.assertEqual(self.warned("check", study), told)
        # Not of conditions that are there, nor where nothing is to be told.
        self.assertEqual(self.warned(study, "-o", self.at / "out"), [])
        self.assertEqual(self.warned("check", study, "--quiet"), [])
        # A key is without effect where it is under every condition: not the concentration, for one of three has ice.
        study.write_text("scenario: base.yaml\nset: {ice.sleep_time: 7}\n"
                         "vary: {grid: {ice.source: [none, voronoi, none]}}\n")
        idle = ["warning: condition 1 (ice.source=none): ice.sleep_time: without effect, since ice.sleep_speed is 0:"
                " nothing sleeps"]
        self.assertEqual(self.warned(study, "-o", self.at / "idle", "--on", "slurm", "--dry-run"), idle)
        self.assertEqual(self.warned("check", study), idle)
        # That is told where all were looked at, after a first look that came to a vessel which sinks.
        study.write_text("scenario: base.yaml\nset: {ice.sleep_time: 7}\n"
                         "vary: {grid: {vessel.mass: [1.28e6, 1.29e8, 1.30e6]}}\n")
        words = (study, "-o", self.at / "half", "--on", "slurm", "--dry-run")
        self.assertEqual(self.refused_and_warned(*words), [])
        study.write_text(study.read_text().replace("e8", "e6"))
        idle = [idle[0].replace("ice.source=none", "vessel.mass=1.28e6")]
        self.assertEqual(self.warned(*words), idle)
        self.assertEqual(self.warned(*words), [])

    def test_a_key_without_effect_is_told_where_it_is_set(self):
        """For two reasons, with one that only the second condition sets, and of a vessel that only this one has."""
        ship = "mode: towed, hull: {form: box, length: 20, beam: 6, draught: 2, freeboard: 2}"
        (self.at / "two.yaml").write_text(
            "run: {duration: 3, time_step: 0.01, transient: 1}\nice: {source: voronoi}\n"
            f"vessels:\n  - {{name: ship, x: -20, speed: 1, {ship}}}\n"
            f"  - {{name: breaker, x: 20, path: [{{time: 0, x: 20}}, {{time: 3, x: 23}}], {ship}}}\n"
            "domain: {x_min: -60, x_max: 60, y_min: -40, y_max: 40}\n")
        study = self.at / "study.yaml"
        study.write_text(
            "scenario: two.yaml\nkeep: summary\nvessel: ship\n"
            "set: {ice.level.x_min: 5, ice.level.x_max: 9, environment.current_direction_deg: 30,"
            " environment.wind_direction_deg: 9}\nvary: {list: [\n"
            "  {vessels.breaker.present: false, environment.water: true, ice.level.y_min: auto,"
            " environment.wind_speed: 5},\n"
            "  {vessels.breaker.present: true, environment.water: false, ice.level.y_min: 3,"
            " environment.wind_speed: 0}]}\n")
        told = self.warned(study, "-o", self.at / "two", "--on", "slurm", "--dry-run")
        self.assertEqual([re.fullmatch(r"warning: condition (\d) \(.*?\): (.*): without effect, .*", line).groups()
                          for line in told],
                         [("1", "ice.level.x_min and 1 more"), ("1", "environment.current_direction_deg"),
                          ("2", "vessels[1].x"), ("2", "ice.level.y_min")])

    def test_what_goes_by_what_is_made_is_told_by_that(self):
        """How thick the floes of a file are is known where `check` makes them; the current of a file, and how a ship
        lies on her mooring, is known of all conditions."""
        file, dry = self.at / "floes.geojson", ("--on", "slurm", "--dry-run")
        (self.at / "file.yaml").write_text(
            "run: {duration: 3, time_step: 0.01, transient: 1}\nice: {source: file, file: floes.geojson}\n"
            "vessel: {mode: towed, speed: 1, x: -20, hull: {form: box, length: 20, beam: 6, draught: 0.9,"
            " freeboard: 2}}\ndomain: {x_min: -60, x_max: 60, y_min: -40, y_max: 40}\n")
        study, plain = self.at / "study.yaml", "scenario: file.yaml\nkeep: summary\n"
        thick = "warning: ice.file: 3 m is more than the draught of the vessel, 0.9 m"
        for thickness, told in ((0.3, []), (3, [thick])):
            ring = [[10, -10], [30, -10], [30, 10], [10, 10], [10, -10]]
            file.write_text(json.dumps({"type": "FeatureCollection", "features": [{
                "type": "Feature", "properties": {"thickness": thickness},
                "geometry": {"type": "Polygon", "coordinates": [ring]}}]}))
            study.write_text(plain + "set: {ice.breakable: true, ice.crushing_exponent: -0.5}\n")
            self.assertEqual(self.warned(study, "-o", self.at / f"file{thickness}", *dry), [])
            study.write_text(plain)
            self.assertEqual(self.warned("check", study), told)
        # Of a vessel that cannot be made the error alone is told; of ice, which is made last, what its keys tell.
        file.write_text("{}")
        study.write_text(plain + "set: {ice.thickness: 3}\n")
        self.assertEqual(self.refused_and_warned("check", study), [thick.replace("file", "thickness")])
        (self.at / "aside.csv").write_text("time,x,y\n0,0,-0.5\n600,0,-0.5\n")
        (self.at / "moored.yaml").write_text(
            "run: {duration: 3, time_step: 0.05, transient: 1}\nice: {source: none}\n"
            "environment: {current_file: aside.csv}\nvessel:\n  mode: free\n"
            "  hull: {form: box, length: 60, beam: 12, draught: 4, freeboard: 3}\n"
            "  mooring: {depth: 80, lines: [{kind: spring, count: 4, spacing_deg: 90, direction_deg: 45,"
            " distance: 300, stiffness: 2.0e4, pretension: 5.0e5}]}\n")
        study.write_text("scenario: moored.yaml\nkeep: summary\n")
        for told in (self.warned(study, "-o", self.at / "moored", *dry), self.warned("check", study)):
            self.assertEqual([line.split(" and environment")[0] for line in told],
                             ["warning: vessel: a current of 0.5 m/s comes across the hull,"])
        study.write_text("scenario: moored.yaml\nset: {vessel.mass: 9.0e7, environment.wind_speed: 80}\n")
        self.assertEqual(self.refused_and_warned(study, "-o", self.at / "sinks", *dry), [])
        (self.at / "free.yaml").write_text(
            "run: {duration: 3}\nice: {source: none}\nenvironment: {wind_speed: 80}\nvessel:\n  mode: free\n"
            "  hull: {form: box, length: 60, beam: 12, draught: 4, freeboard: 3}\n")
        study.write_text("scenario: free.yaml\nkeep: summary\n")
        told = self.warned("check", study)
        self.assertTrue(told[0].startswith("warning: environment.wind_speed: 80 m/s is outside"), told)
        study.write_text("scenario: free.yaml\nkeep: summary\nset: {vessel.mass: 9.0e7}\n")
        self.assertEqual(self.refused_and_warned("check", study), [])

    def contents(self, folder):
        return {p.relative_to(folder): p.read_bytes() for p in folder.rglob("*") if p.is_file()}

    def test_what_a_study_reads_is_not_written_over(self):
        own, out, begun = self.at / "own", self.at / "out", self.at / "begun"
        short = f"scenario: {self.at}/base.yaml\nset: {{run.duration: 0.1, run.transient: 0}}\n"
        # A study file of one's own, with other files or without, makes no folder of a study.
        own.mkdir()
        (own / "study.yaml").write_text(short + "vary: {table: conditions.csv}\n")
        (own / "conditions.csv").write_text("ice.thickness\n1\n")
        other = self.at / "other.yaml"
        other.write_text(short)
        for effective in (None, short):
            if effective:
                (own / "effective.yaml").write_text(effective)
            before = self.contents(own)
            for path in (own / "study.yaml", other):
                error = self.fram(path, "-o", own, code=2)["error"]
                self.assertEqual(error["message"], "the folder holds something else than a study; name another one")
            self.assertEqual(self.contents(own), before)
        begun.mkdir()
        (begun / "study.yaml").write_text(short + "seeds: 1\n")
        for path in (begun / "study.yaml", other):
            self.fram(path, "-o", begun, code=2)
        # One that was killed with its first file, or refused in its conditions, goes on, corrected or not.
        (begun / "study.yaml").write_text(short)
        self.fram(other, "-o", begun, "--on", "slurm", "--dry-run")
        other.write_text(short + "vary: {grid: {vessel.mass: [1.0e8]}}\n")
        self.fram(other, "-o", out, code=2)
        other.write_text(short)
        self.assertEqual(self.fram(other, "-o", out)["made"], 1)
        # Files in the places of results: the table, the scenario, one that the scenario names.
        (out / "annual.csv").write_text("time[s],x[m/s],y[m/s]\n0,1,0\n")
        (out / "extremes.csv").write_bytes((self.at / "base.yaml").read_bytes())
        os.link(out / "conditions.csv", self.at / "table.csv")
        (self.at / "table.csv").write_text("ice.thickness\n1\n")
        before = self.contents(out)
        for text, name in ((short + "vary: {table: table.csv}\n", "conditions.csv"),
                           ("scenario: out/extremes.csv\n", "extremes.csv"),
                           (short.replace("0}", "0, environment.wind_file: out/annual.csv}"), "annual.csv")):
            other.write_text(text)
            error = self.fram(other, "-o", out, code=2)["error"]
            self.assertIn(f"would write its own {name} over it", error["message"])
            after = self.contents(out)
            self.assertEqual({p: after[p] for p in before if p.name != "study.yaml"},
                             {p: before[p] for p in before if p.name != "study.yaml"})
        # The study of the folder itself is no such file.
        for name in ("effective.yaml", "study.yaml"):
            self.assertEqual(self.fram(out / name, "-o", out)["made"], 0)
        # A script that is only looked at leaves what the folder tells of its study.
        other.write_text(short + "seeds: 7\n")
        before = self.contents(out)
        self.fram(other, "-o", out, "--on", "slurm", "--dry-run")
        self.assertEqual(self.contents(out), before)

    def test_files_of_one_name_make_one_condition_where_they_are_the_same(self):
        for month, wind in (("jan", 5), ("feb", 9), ("mar", 5)):
            (self.at / month).mkdir()
            (self.at / month / "wind.csv").write_text(f"time[s],x[m/s],y[m/s]\n0,{wind},0\n")
        study = self.write("set: {run.duration: 0.1, run.transient: 0}\nkeep: summary\n"
                           "vary: {grid: {environment.wind_file: [jan/wind.csv, feb/wind.csv, mar/wind.csv]}}\n")
        told = self.fram("check", study)
        self.assertEqual((told["conditions"], told["different"], told["runs_most"]), (3, 2, 2))
        self.assertEqual(self.fram(study, "-o", self.at / "out")["made"], 2)

    def test_pages_tell_conditions_apart(self):
        """Values are shortened as far as those of their key stay different, but into nothing longer."""
        study = self.write("keep: summary\nset: {run.duration: 0.1, run.transient: 0, ice.source: none,"
                           " domain.x_min: -1400064, domain.x_max: -1399936}\nvary:\n  list:\n"
                           "    - {vessel.x: -1400010, vessel.speed: 2.00000123456, vessel.hull.beam: 12.3456789}\n"
                           "    - {vessel.x: -1400000, vessel.speed: 2.00000223456, vessel.hull.beam: 12.5}\n")
        self.fram(study, "-o", self.at / "out")
        page = (self.at / "out" / "study.html").read_text()
        for row in (("-1400010", "2.000001", "12.35"), ("-1400000", "2.000002", "12.5")):
            self.assertIn("".join(f"<td>{value}</td>" for value in row), page)

    def test_a_study_that_begins_in_the_same_folder_takes_nothing_away(self):
        """The first file of a study is there under another name for a moment, which is no leftover then."""
        path, folder = self.write("seeds: 1\nset: {run.duration: 3, ice.thickness: 0.001}\n"), self.at / "out"
        folder.mkdir()
        first = folder / "study.yaml.0123456789abcdef.new"
        first.write_text("half of it")
        lock = os.open(folder, os.O_RDONLY)
        fcntl.flock(lock, fcntl.LOCK_EX)
        self.assertIn("another study is writing", self.fram(path, "-o", folder, code=2)["error"]["message"])
        self.assertEqual(first.read_text(), "half of it")
        os.close(lock)
        self.assertEqual(self.fram(path, "-o", folder)["runs"], 1)
        self.assertFalse(first.exists())
        self.check_newtons("out")
        # Beside something else it is no folder of a study.
        shutil.rmtree(folder)
        folder.mkdir()
        first.write_text("half of it")
        (folder / "mine").write_text("mine")
        self.fram(path, "-o", folder, code=2)
        self.assertTrue(first.exists())

    def test_a_folder_of_a_run_that_cannot_be_opened_ends_the_study(self):
        study = self.write("set: {run.duration: 0.1, run.transient: 0}\nkeep: {record_of_worst: 1}\n")
        self.fram(study, "-o", self.at / "out", "--on", "slurm", "--dry-run")
        (runs,) = (self.at / "out" / "runs").iterdir()
        worst = self.at / "out" / "worst"
        worst.mkdir()
        for path in (runs / "1", worst / f"{runs.name}-1"):
            path.write_text("")
            done = subprocess.run([FRAM, "study", study, "-o", self.at / "out", "--json"], capture_output=True,
                                  text=True, timeout=60)
            self.assertEqual(done.returncode, 2, done.stderr)
            error = json.loads(done.stdout.splitlines()[-1])["error"]
            self.assertEqual((error["file"], error["message"]), (str(path), "cannot open the folder: Not a directory"))
            path.unlink()

    def test_a_folder_that_cannot_be_read_is_not_one_of_no_study(self):
        record = self.at / "effective.yaml"
        for folder in (self.at, self.at / "base.yaml"):
            self.assertIn("holds no study", self.fram("list", folder, code=2)["error"]["message"])
        record.symlink_to(record)
        error = self.fram("list", self.at, code=2)["error"]
        self.assertEqual((error["file"], error["message"]),
                         (str(record), "cannot read: Too many levels of symbolic links"))

    def limited(self, study, kilobytes):
        """What is said where no file may be larger, as a cluster may hand on."""
        bound = [1000 * kilobytes] * 2
        done = subprocess.run([FRAM, "study", study, "-o", self.at / "out", "--json"], capture_output=True, text=True,
                              timeout=60, preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, bound))
        self.assertEqual(done.returncode, 1, done.stderr)
        return json.loads(done.stdout.splitlines()[-1])["error"]

    def test_files_that_find_no_room_end_the_study(self):
        study = self.write("set: {run.duration: 0.1, run.transient: 0}\nkeep: summary\nseeds: 1\n")
        # A run that could not write is made again by the same command.
        self.assertIn("a run could not write: File too large", self.limited(study, 16)["message"])
        told = self.fram(study, "-o", self.at / "out")
        self.assertEqual((told["made"], told["failed"]), (1, 0))
        # Of study.nc, or without NetCDF of the page, HDF5 kept what it could not write, and the program died of it.
        error = self.limited(study, 60)
        self.assertRegex(error["file"], r"/study\.(nc|html)$")
        self.assertEqual(error["message"], "cannot write: File too large")

    def test_runs_end_well_where_the_starter_ignored_sigchld(self):
        study = self.write("set: {run.duration: 0.1, run.transient: 0}\nseeds: 1\n")
        done = subprocess.run([FRAM, "study", study, "-o", self.at / "out"], capture_output=True, text=True,
                              preexec_fn=lambda: signal.signal(signal.SIGCHLD, signal.SIG_IGN))
        self.assertEqual(done.returncode, 0, done.stderr)

    def test_files_that_are_read_at_once_are_not_told(self):
        """A second after the first run had ended its file was told as being read, 0 %, by that of each later one."""
        study = self.write("seeds: 4\nset: {run.duration: 10}\n")
        done = subprocess.run([FRAM, "study", study, "-o", self.at / "out", "--jobs", "1"], check=True,
                              capture_output=True, text=True)
        self.assertNotIn("reading", done.stderr)


if __name__ == "__main__":
    unittest.main()
