"""A long run of a field that is fed: memory, descriptors and the cost of a step stay where they were."""

import os
import pathlib
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
run: {duration: 1000000, time_step: 0.02, seed: 3}
vessel: {mode: prescribed, speed: 0, hull: {length: 30, beam: 8, draught: 3, freeboard: 2}}
ice: {concentration: 0.6, mean_floe_area: 120, thickness: 0.4, breakable: true}
domain: {x_min: -48, x_max: 48, y_min: -32, y_max: 32, boundary: feeding}
environment: {current_speed: 1, current_direction_deg: 180}
output: {frame_interval: 5, checkpoint_interval: 20, csv_interval: 1}
"""
# Second half against first, after the first quarter.
MEMORY_GROWTH_MB = 8
COST_GROWTH = 1.5
LEAST_COST_S = 60


def sample(pid):
    """(resident memory [MB], open descriptors)"""
    status = pathlib.Path(f"/proc/{pid}/status").read_text()
    resident = next(int(line.split()[1]) for line in status.splitlines() if line.startswith("VmRSS"))
    return resident / 1024, len(os.listdir(f"/proc/{pid}/fd"))


def watch(process, seconds):
    """Samples over the time given, one every hundredth of it."""
    samples, end = [], time.monotonic() + seconds
    while time.monotonic() < end and process.poll() is None:
        time.sleep(seconds / 100)
        try:
            samples.append(sample(process.pid))
        except (OSError, StopIteration):
            break
    return samples


def case(rig, draw, folder):
    """The share of time that the campaign gives it."""
    del draw
    done = Case()
    scene, run = folder / "soak.yaml", folder / "run"
    scene.write_text(SCENE, encoding="utf-8")
    seconds = max(5.0, rig.minutes * 60 * 0.08)
    with open(folder / "err", "wb") as err:
        process = rig.fram.start(("run", scene, "-o", run, "--threads", "1", "-q"), stdout=err, stderr=err)
        samples = watch(process, seconds)
        process.terminate()
        code = process.wait()
    if code != 130 or len(samples) < 20:
        done.found(f"soak: ends with exit code {code}", told=(folder / "err").read_text()[-2000:],
                   files={"soak.yaml": SCENE})
        return done
    quarter = samples[len(samples) // 4:]
    growth = max(m for m, _ in quarter[len(quarter) // 2:]) - max(m for m, _ in quarter[:len(quarter) // 2])
    descriptors = {n for _, n in quarter}
    series = books.columns(run / "series.csv")
    walls = series["step_wall_time"]
    walls = walls[len(walls) // 4:]
    half = len(walls) // 2
    # Steps of a few seconds tell what else the machine did.
    cost = statistics.median(walls[half:]) / statistics.median(walls[:half]) if seconds >= LEAST_COST_S else 1.0
    done.counts["simulated seconds"] = int(series["time"][-1])
    done.counts["steps"] = int(series["time"][-1] / 0.02)
    if growth > MEMORY_GROWTH_MB:
        done.found("soak: memory grows", told=f"by {growth:.1f} MB", files={"soak.yaml": SCENE})
    if max(descriptors) - min(descriptors) > 3:
        done.found("soak: descriptors grow", told=f"{sorted(descriptors)}", files={"soak.yaml": SCENE})
    if cost > COST_GROWTH:
        done.found("soak: steps become dearer", told=f"{cost:.2f} times", files={"soak.yaml": SCENE})
    fault = books.forces_add_up(series)
    if fault:
        done.found("soak: " + fault, files={"soak.yaml": SCENE})
    return done
