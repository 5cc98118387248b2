"""A long run of a field that is fed: memory, descriptors and the cost of a step stay where they were."""

import os
import pathlib
import re
import statistics
import time

import books
from finding import Case

NAME = "soak"
SAYS = "a fed field for as long as there is time: memory, descriptors and the cost of a step stay flat"
# One of them runs at a time.
MOST = 1
SCENE = """
title: A fed field, soaked
run: {duration: DURATION, time_step: 0.02, seed: 3}
vessel: {mode: prescribed, speed: 0, hull: {length: 30, beam: 8, draught: 3, freeboard: 2}}
ice: {concentration: 0.6, mean_floe_area: 120, thickness: 0.4, breakable: true}
domain: {x_min: -48, x_max: 48, y_min: -32, y_max: 32, boundary: feeding}
environment: {current_speed: 1, current_direction_deg: 180}
output: {frame_interval: 5, checkpoint_interval: 20, csv_interval: 1}
"""
# Second half against first, after the first quarter.
MEMORY_GROWTH_MB = 8
COST_GROWTH = 1.5
LEAST_COST_ROWS = 1000
LONG_LIMIT_S = 100 * 3600  # of computing, for a soak by simulated hours
MASS_OPEN = 1e-6  # of the mass at the start [%]


def sample(pid):
    """(resident memory [MB], open descriptors)"""
    status = pathlib.Path(f"/proc/{pid}/status").read_text()
    resident = next(int(line.split()[1]) for line in status.splitlines() if line.startswith("VmRSS"))
    return resident / 1024, len(os.listdir(f"/proc/{pid}/fd"))


def watch(process, seconds, pause):
    """Samples over the time given or to the end, one every `pause` seconds."""
    samples, end = [], time.monotonic() + seconds
    while time.monotonic() < end and process.poll() is None:
        time.sleep(pause)
        try:
            samples.append(sample(process.pid))
        except (OSError, StopIteration):
            break
    return samples


def not_accounted_for(rig, run):
    """Ice that the report's balance misses at the end, of the mass at the start [%]; None when it tells none."""
    rig.fram.call("report", run, folder=run.parent)
    page = (run / "report.html").read_text(encoding="utf-8")
    row = re.search(r"of the mass at the start</t[dh]><td[^>]*>([-+.0-9e]+)", page)
    return float(row[1]) if row else None


def case(rig, draw, folder):
    """The share of time that the campaign gives it, or the simulated hours that were asked for."""
    del draw
    done = Case()
    scene, run = folder / "soak.yaml", folder / "run"
    text = SCENE.replace("DURATION", f"{rig.soak_hours * 3600:g}" if rig.soak_hours else "1000000")
    scene.write_text(text, encoding="utf-8")
    seconds = max(5.0, rig.minutes * 60 * 0.08)
    with open(folder / "err", "wb") as err:
        limit = {"cpu_limit": LONG_LIMIT_S} if rig.soak_hours else {}
        process = rig.fram.start(("run", scene, "-o", run, "--threads", "1", "-q"), stdout=err, stderr=err, **limit)
        if rig.soak_hours:
            samples, expected = watch(process, float("inf"), 2), 0
        else:
            samples, expected = watch(process, seconds, seconds / 100), 130
            process.terminate()
        code = process.wait()
    if code != expected or len(samples) < 20:
        done.found(f"soak: ends with exit code {code}", told=(folder / "err").read_text()[-2000:],
                   files={"soak.yaml": text})
        return done
    look_at(rig, done, samples, run, text)
    return done


def look_at(rig, done, samples, run, text):
    """Memory, descriptors, cost and books of the run."""
    files = {"soak.yaml": text}
    quarter = samples[len(samples) // 4:]
    growth = max(m for m, _ in quarter[len(quarter) // 2:]) - max(m for m, _ in quarter[:len(quarter) // 2])
    descriptors = {n for _, n in quarter}
    series = books.columns(run / "series.csv")
    walls = series["step_wall_time"]
    walls = walls[len(walls) // 4:]
    half = len(walls) // 2
    # Steps of a few seconds tell what else the machine did.
    cost = statistics.median(walls[half:]) / statistics.median(walls[:half]) if len(walls) >= LEAST_COST_ROWS else 1.0
    done.counts["simulated seconds"] = int(series["time"][-1])
    done.counts["steps"] = int(series["time"][-1] / 0.02)
    if growth > MEMORY_GROWTH_MB:
        done.found("soak: memory grows", told=f"by {growth:.1f} MB", files=files)
    if max(descriptors) - min(descriptors) > 3:
        done.found("soak: descriptors grow", told=f"{sorted(descriptors)}", files=files)
    if cost > COST_GROWTH:
        done.found("soak: steps become dearer", told=f"{cost:.2f} times", files=files)
    done.counts["of memory grown, in kB"] = int(1024 * max(0, growth))
    done.counts["cost of the second half, in % of the first"] = int(100 * cost)
    fault = books.forces_add_up(series)
    if fault:
        done.found("soak: " + fault, files=files)
    if rig.soak_hours:
        open_mass = not_accounted_for(rig, run)
        if open_mass is None or abs(open_mass) > MASS_OPEN:
            done.found("soak: the balance of the ice does not close", told=f"{open_mass} %", files=files)
