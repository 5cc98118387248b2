#!/usr/bin/env python3
"""What scheduling costs a study on Slurm (root; make slurm-overhead).

A Slurm of one node is started here, and makes a study of so many runs of so many seconds of processor time each,
one run a task, one at a time.  What the study took beyond its runs, from the command's start to its end, is told as a
part of the time of the runs (by their own clocks, so that other programs of the machine lengthen both), beside the same
study made here by one process at a time.  Exit code 1 when the tables differ, or when Slurm took more than 5 % of runs
that take 10 s or more."""
import argparse
import json
import os
import pathlib
import subprocess
import sys
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT / "tests" / "slurm"))
import cluster  # noqa: E402

FRAM = pathlib.Path(os.environ.get("FRAM", ROOT / "build" / "release" / "fram")).resolve()
MOST = 0.05
BASE = """
run: {{duration: {duration}, time_step: 0.02, transient: 1}}
vessel: {{mode: towed, x: -100, speed: 1, ramp: 1}}
ice: {{concentration: 0.8, mean_floe_area: 100}}
domain: {{x_min: -200, x_max: 200, y_min: -100, y_max: 100}}
output: {{frame_interval: 0, checkpoint_interval: 0}}
"""


def seconds_of(folder):
    return [json.loads(p.read_text())["wall_s"] for p in sorted(folder.glob("runs/*/*/run.json"))]


def make(study, folder, words, environment):
    begin = time.monotonic()
    subprocess.run([FRAM, "study", study, "-o", folder, "--quiet", *words], check=True, env=environment)
    took = time.monotonic() - begin
    runs = seconds_of(folder)
    part = (took - sum(runs)) / sum(runs)
    print(f"{folder.name:6} {len(runs)} runs of {min(runs):.1f} to {max(runs):.1f} s, {sum(runs):.1f} s in all; "
          f"the study {took:.1f} s: {100 * part:.1f} % more", flush=True)
    return part, min(runs)


def duration_for(at, seconds):
    """How long runs are simulated so that they take so many seconds of processor time."""
    (at / "base.yaml").write_text(BASE.format(duration=8))
    before = os.times()
    subprocess.run([FRAM, "run", at / "base.yaml", "-o", at / "try", "--threads", "1", "--quiet"], check=True)
    after = os.times()
    return 8 * seconds / (after.children_user + after.children_system - before.children_user - before.children_system)


def main():
    words = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    words.add_argument("runs", nargs="?", type=int, default=20, help="%(default)s")
    words.add_argument("seconds", nargs="?", type=float, default=12, help="of a run (%(default)s)")
    options = words.parse_args()
    runs, seconds = options.runs, options.seconds
    why = cluster.missing()
    if why:
        sys.exit(why)
    with tempfile.TemporaryDirectory(prefix="fram-overhead-") as name:
        at = pathlib.Path(name)
        at.chmod(0o755)
        (at / "base.yaml").write_text(BASE.format(duration=round(duration_for(at, seconds), 1)))
        study = at / "study.yaml"
        study.write_text(f"scenario: base.yaml\nseeds: {runs}\nkeep: series\n")
        slurm = cluster.Cluster(1)
        try:
            part, least = make(study, at / "slurm", ["--on", "slurm", "--runs-per-task", "1"], slurm.environment)
        finally:
            slurm.stop()
        make(study, at / "here", ["--jobs", "1"], None)
        same = (at / "slurm" / "summary.csv").read_bytes() == (at / "here" / "summary.csv").read_bytes()
        print("the tables are the same to the byte" if same else "the tables differ")
        sys.exit(0 if same and (part <= MOST or least < 10) else 1)


if __name__ == "__main__":
    main()
