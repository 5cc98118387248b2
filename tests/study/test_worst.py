#!/usr/bin/env python3
"""The worst runs of a study: made again with a record when all have ended, one click away on its page."""
import json
import os
import pathlib
import re
import shutil
import subprocess
import time
import unittest

from studies import FRAM, StudyTest

PAGE = pathlib.Path(os.environ["FRAM_SOURCE"]) / "build" / "viewer" / "playback.html"
VARY = "vary: {grid: {ice.thickness: [0.5, 1], vessel.speed: [1.5, 2]}}\n"


class Worst(StudyTest):
    def worst_of(self, folder, count, column="load_largest[N]"):
        """Names in DIR/worst of the runs with the largest values, in falling order."""
        ids = [r["id"] for r in self.rows(folder, "index.csv")]
        rows = [r for r in self.rows(folder) if r[column]]
        rows.sort(key=lambda r: -float(r[column]))
        return [f"{ids[int(r['condition']) - 1]}-{r['seed']}" for r in rows[:count]]

    def there(self, folder):
        return sorted(p.name for p in (self.at / folder / "worst").iterdir() if p.is_dir())

    def check(self, folder, names):
        at = self.at / folder / "worst"
        self.assertEqual(self.there(folder), sorted(names))
        for name in names:
            id, seed = name.split("-")
            row = self.at / folder / "runs" / id / f"{seed}.row"
            self.assertEqual((at / f"{name}.row").read_bytes(), row.read_bytes())
            # The record itself: frames at 1 s of a run of 3 s.
            self.assertGreater((at / name / "record.fram").stat().st_size, 4 * 500)
            note = json.loads((at / name / "run.json").read_text())
            self.assertIn(note["state_hash"], row.read_text())
            if PAGE.exists():
                self.assertGreater((at / name / "playback.html").stat().st_size, 500000)
                self.assertFalse((at / f"{name}.log").exists())

    def links(self, folder):
        return re.findall('/([^/]*)/playback.html">playback</a></td>', (self.at / folder / "study.html").read_text())

    def test_the_worst_have_their_record_and_the_tables_are_the_same(self):
        plain = self.write("seeds: 3\n" + VARY, "plain.yaml")
        self.fram(plain, "-o", self.at / "plain")
        study = self.write("seeds: 3\nset: {output.frame_interval: 0}\n"
                           "keep: {each: series, record_of_worst: 3}\n" + VARY)
        told = self.fram(study, "-o", self.at / "out")
        self.assertEqual((told["runs"], told["made"]), (12, 12))
        names = self.worst_of("out", 3)
        self.check("out", names)
        if PAGE.exists():
            self.assertEqual(self.links("out"), names)
        for table in ("summary.csv", "conditions.csv"):
            self.assertEqual((self.at / "out" / table).read_bytes(), (self.at / "plain" / table).read_bytes(), table)
        self.assertIn("keep: {each: series, record_of_worst: 3, by: load_largest}\n",
                      (self.at / "out" / "effective.yaml").read_text())
        # Nothing is made twice.
        before = {p: p.stat().st_mtime_ns for p in (self.at / "out" / "worst").glob("*/record.fram")}
        self.fram(study, "-o", self.at / "out")
        self.assertEqual({p: p.stat().st_mtime_ns for p in before}, before)
        # By another figure, and fewer: what is no longer among them goes, what somebody else put there stays.
        (self.at / "out" / "worst" / "mine").mkdir()
        # And what a study that was killed had half written.
        half = self.at / "out" / "worst" / "0123456789ab-1.row.0123456789abcdef.new"
        half.write_text("fram study")
        self.fram(self.write("seeds: 3\nset: {output.frame_interval: 0}\n"
                             "keep: {record_of_worst: 2, by: fractures}\n" + VARY), "-o", self.at / "out")
        self.assertTrue((self.at / "out" / "worst" / "mine").is_dir())
        (self.at / "out" / "worst" / "mine").rmdir()
        self.assertFalse(half.exists())
        # Of equal values the first.
        ids = [r["id"] for r in self.rows("out", "index.csv")]
        self.check("out", [f"{ids[0]}-1", f"{ids[0]}-2"])

    def test_kills_and_more_seeds_leave_the_worst_of_all(self):
        keep = "keep: {record_of_worst: 4, by: load_significant}\n"
        first = self.write("seeds: 2\n" + keep + VARY)
        for moment in (0.05, 0.25, 0.35, 0.45, 0.55, 0.65):
            process = subprocess.Popen([FRAM, "study", first, "-o", self.at / "out", "--quiet"],
                                       stderr=subprocess.DEVNULL)
            time.sleep(moment)
            process.kill()
            process.wait()
        more = self.write("seeds: 4\n" + keep + VARY)
        self.fram(more, "-o", self.at / "out")
        self.check("out", self.worst_of("out", 4, "load_significant[N]"))
        self.fram(more, "-o", self.at / "once")
        for table in ("summary.csv", "study.html"):
            self.assertEqual((self.at / "out" / table).read_bytes(), (self.at / "once" / table).read_bytes(), table)
        names = lambda folder: sorted(str(p.relative_to(self.at / folder)) for p in (self.at / folder).rglob("*"))
        self.assertEqual(names("out"), names("once"))

    def test_a_record_of_another_run_is_no_record(self):
        study = self.write("set: {run.duration: 2}\nseeds: 1\n")
        self.fram(study, "-o", self.at / "out")
        (row,) = (self.at / "out" / "runs").glob("*/1.row")
        text = row.read_text()
        row.write_text(re.sub("load_mean .*", "load_mean 7", text))
        study = self.write("set: {run.duration: 2}\nseeds: 1\nkeep: {record_of_worst: 1}\n")
        error = self.fram(study, "-o", self.at / "out", code=2)["error"]
        self.assertIn("other figures than its row", error["message"])
        self.assertEqual(error["key"], "record_of_worst")
        self.assertEqual(list((self.at / "out" / "worst").glob("*.row")), [])
        # The tables are whole all the same; and with its row the run has its record.
        self.assertEqual(self.rows("out")[0]["load_mean[N]"], "7")
        row.write_text(text)
        self.fram(study, "-o", self.at / "out")
        self.check("out", self.worst_of("out", 1))

    def test_without_the_page_of_the_viewer_the_record_stays_and_nothing_is_promised(self):
        alone = self.at / "bin" / "fram"
        alone.parent.mkdir()
        shutil.copy(FRAM, alone)
        study = self.write("set: {output.frame_interval: 0.5}\nseeds: 1\nkeep: {record_of_worst: 2}\n" + VARY)
        call = lambda *words: subprocess.run([alone, "study", *map(str, words)], capture_output=True, text=True)
        self.assertIn("without playbacks: the viewer's page is not beside", call("check", study).stdout)
        self.assertEqual(json.loads(call("check", study, "--json").stdout)["playbacks"], 0)
        done = call(study, "-o", self.at / "out")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("its playback was not made: --page: the viewer's page is not there", done.stderr)
        names, page = self.worst_of("out", 2), (self.at / "out" / "study.html").read_text()
        for name in names:
            self.assertIn(f"<code>fram view worst/{name}</code> makes it from the record", page)
            self.assertTrue((self.at / "out" / "worst" / name / "record.fram").exists())
        # No link leads to what is not there; runs without a record have the command that makes one.
        for link in re.findall('href="([^"#:]*)"', page):
            self.assertTrue((self.at / "out" / link).exists(), link)
        self.assertEqual(page.count("&amp;&amp; fram view worst/"), 2)
        self.assertEqual(page.count(" output.frame_interval=0.5 <i>-o</i> worst/"), 2)
        # A record that is kept beside the run is the one to be viewed.
        for interval, known in ((0.5, True), (0, False)):
            study = self.write("set: {run.duration: 1, run.transient: 0, output.frame_interval: %g}\nseeds: 1\n"
                               "keep: all\n" % interval)
            self.fram(study, "-o", self.at / f"kept{interval}")
            (run,) = (self.at / f"kept{interval}" / "runs").glob("*/1")
            page = (self.at / f"kept{interval}" / "study.html").read_text()
            self.assertEqual(f"<code>fram view runs/{run.parent.name}/1</code> makes it" in page, known)
            self.assertEqual(" output.frame_interval=1 <i>-o</i>" in page, not known)

    def test_runs_whose_figures_meant_something_else_are_made_again(self):
        study = self.write("seeds: 2\nkeep: {record_of_worst: 1}\n")
        self.fram(study, "-o", self.at / "out")
        whole = (self.at / "out" / "summary.csv").read_bytes()
        # As a Fram left them which counted contacts otherwise; a later one that is unknown here is no other matter.
        for seed, head in ((1, "fram study row 7"), (2, "fram study row 999, mechanisms 999")):
            (row,) = (self.at / "out" / "runs").glob(f"*/{seed}.row")
            text = re.sub("share_chain .*", "share_chain 0.25", row.read_text())
            row.write_text(head + text[text.index("\n"):])
        for made in (2, 0):
            done = subprocess.run([FRAM, "study", study, "-o", self.at / "out", "--json"], capture_output=True,
                                  text=True)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertEqual(json.loads(done.stdout.splitlines()[-1])["made"], made)
            self.assertEqual(done.stderr.count("figures mean something else"), made > 0, done.stderr)
            self.assertEqual((self.at / "out" / "summary.csv").read_bytes(), whole)

    def test_what_it_takes_is_told_and_mistakes_are_refused(self):
        study = self.write("seeds: 3\nkeep: {each: series, record_of_worst: 2}\n")
        told = self.fram("check", study)
        self.assertEqual(told["records"], 2)
        self.fram(study, "-o", self.at / "out")
        for name in self.worst_of("out", 2) if PAGE.exists() else []:
            size = sum(p.stat().st_size for p in (self.at / "out" / "worst" / name).iterdir())
            self.assertTrue(0.6 < told["record_bytes"] / size < 1.6, (told["record_bytes"], size))
        self.refused("keep: {each: sries}\n", "study.yaml:2: each", "summary, series or all")
        self.refused("keep: {record_of_worst: 3, by: load_lrgest}\n", "study.yaml:2: by", "did you mean load_largest?")
        self.refused("keep: {record_of_worst: 101}\n", "study.yaml:2: record_of_worst", "100")
        self.refused("keep: {record_of_worst: 1.5}\n", "study.yaml:2: record_of_worst", "whole")
        self.refused("keep: {record_of_wrst: 2}\n", "record_of_wrst", "did you mean record_of_worst?")
        self.refused("keep: {by: load_largest}\n", "study.yaml:2: keep", "record_of_worst")
        self.refused("keep: {record_of_worst: 1, by: line_tension_largest}\n", "study.yaml:2: by", "mooring")
        self.refused("keep: [all]\n", "study.yaml:2: keep")
        self.refused("set: {ice.thickness: 1}\nvary: {grid: {ice.thickness: [0.5, 1]}}\n",
                     "study.yaml:2: ice.thickness", "`set` and in `vary`")


if __name__ == "__main__":
    unittest.main()
