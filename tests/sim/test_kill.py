#!/usr/bin/env python3
"""kill -9 at random moments, then resume: nothing is lost beyond the last checkpoint, and no file is half-written.

A run with breaking ice, lines and dynamic positioning is killed again and again, wherever it is: while it builds,
steps, writes or ends.  After each kill every file is looked at, and resume must begin at the newest checkpoint.  In the
end all files are those of a run that nobody disturbed, byte for byte, but for the wall-clock times in them.
FRAM_KILLS says how often (4; `make test-kill`: 50).
"""
import csv
import json
import os
import pathlib
import random
import re
import subprocess
import tempfile

FRAM = os.environ["FRAM"]
KILLS = int(os.environ.get("FRAM_KILLS", "4"))
STEP = 0.02
SCENE = """
title: Killed and resumed
run: {duration: 12, time_step: 0.02, seed: 5}
vessel:
  mode: free
  hull: {length: 48, beam: 12, draught: 4, freeboard: 2}
  mooring: {depth: 60, lines: [{count: 4, spacing_deg: 90, distance: 300, pretension: 2.0e5}]}
  thrusters: [{x: 18}, {x: -18, kind: main, rudder_deg: 25}]
  positioning: {active: true}
ice: {concentration: 0.8, mean_floe_area: 64, thickness: 0.3, breakable: true}
domain: {x_min: -64, x_max: 64, y_min: -40, y_max: 40, boundary: open}
environment: {current_speed: 3, current_direction_deg: 180}
output: {frame_interval: 0.2, checkpoint_interval: 0.3}
"""
FOR_GOOD = ("record.fram", "fractures.csv", "scenario.yaml", "station.json", "peaks.fram")


def checkpoints(run):
    return sorted(run.glob("checkpoint-*.fram"))


def newest_step(run):
    found = checkpoints(run)
    return int(re.search(r"-(\d+)", found[-1].name).group(1)) if found else None


def look_at_files(run):
    """What has its name is whole; what is on its way has another name."""
    if (run / "run.json").exists():
        json.loads((run / "run.json").read_text())
    for name in run.glob("*.png"):
        assert name.read_bytes()[-8:-4] == b"IEND", f"{name} is half-written"
    for name in checkpoints(run):
        data = name.read_bytes()
        assert data[:8] == b"FRAMTAB\n" and int.from_bytes(data[16:24], "little") == len(data), f"{name} is cut short"
    assert len(checkpoints(run)) <= 3, checkpoints(run)


def kill_after(words, seconds):
    """True when it was killed before it ended by itself."""
    with subprocess.Popen([FRAM, *map(str, words), "-q"], stderr=subprocess.PIPE, text=True) as process:
        try:
            _, err = process.communicate(timeout=seconds)
            assert process.returncode == 0, err
            return False
        except subprocess.TimeoutExpired:
            process.kill()
            process.communicate()
            return True


def rows_without_wall(run):
    with open(run / "series.csv", newline="") as file:
        rows = list(csv.reader(file))
    wall = [i for i, name in enumerate(rows[0]) if "wall" in name]
    assert wall, rows[0]
    return [[v for i, v in enumerate(row) if i not in wall] for row in rows]


def compare(straight, run):
    for name in FOR_GOOD:
        assert (straight / name).read_bytes() == (run / name).read_bytes(), f"{name} is another than without the kills"
    assert rows_without_wall(straight) == rows_without_wall(run), "series.csv is another than without the kills"
    a, b = (json.loads((r / "run.json").read_text()) for r in (straight, run))
    assert a["state_hash"] == b["state_hash"] and b["status"] == "finished"
    left = [p.name for p in run.iterdir() if p.name.endswith(".new")]
    assert not left, f"temporary files are left: {left}"


def main():
    draw = random.Random(20261122)
    where = {"building": 0, "running": 0}
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)
        scene, straight, run = folder / "scene.yaml", folder / "straight", folder / "run"
        scene.write_text(SCENE)
        subprocess.run([FRAM, "run", scene, "-o", straight, "-q"], check=True)
        wall = json.loads((straight / "run.json").read_text())["wall_s"]
        killed, complete = 0, 0
        while killed < KILLS:
            before = newest_step(run) if run.exists() else None
            words = ["run", scene, "-o", run, "--force"] if before is None else ["resume", run]
            if not kill_after(words, draw.uniform(0, 0.35 * wall)):
                compare(straight, run)
                complete += 1
                subprocess.run(["rm", "-r", run], check=True)
                continue
            killed += 1
            if not run.exists():
                where["building"] += 1
                continue
            look_at_files(run)
            after = newest_step(run)
            where["building" if after is None else "running"] += 1
            assert before is None or after >= before, f"the checkpoint of step {before} is lost, {after} is the newest"
            if before is not None and after > before:
                status = json.loads((run / "run.json").read_text())["status"]
                assert status in ("running", "finished"), f"a run that was killed on its way after a resume is {status}"
            if after is not None:
                # Resume begins there, not at the one before, and not at the start.
                told = subprocess.run([FRAM, "resume", run, "--until", str((after + 1) * STEP)], check=True,
                                      capture_output=True, text=True).stderr
                assert f"resuming at t = {after * STEP:g} s" in told, told
                assert "trying the one before" not in told, told
        if run.exists() and newest_step(run) is not None:
            subprocess.run([FRAM, "resume", run, "-q"], check=True)
        else:
            subprocess.run([FRAM, "run", scene, "-o", run, "--force", "-q"], check=True)
        compare(straight, run)
    assert where["running"] > 0, "no kill met a run that had begun"
    print(f"{killed} kills, {where['running']} of them after the first checkpoint: nothing lost, nothing half-written; "
          f"{complete + 1} runs came to their end, all the same")


main()
