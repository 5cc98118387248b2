"""What every case of the validation ladder uses: the command, its channels, tables, figures and the verdict."""

import concurrent.futures
import csv
import dataclasses
import hashlib
import json
import math
import os
import pathlib
import shutil
import statistics
import subprocess
import threading

ROOT = pathlib.Path(__file__).resolve().parent.parent
FRAM = ROOT / "build" / "release" / "fram"
WORK = ROOT / "build" / "validation"
DATA = ROOT.parent / "shared" / "data"
JOBS = os.cpu_count() or 1  # runs side by side, one thread each
REUSED = []  # names of the runs that were read again, and were there before this command
MADE = set()  # names of the runs of this command


class Skipped(Exception):
    """The case cannot run here, and says why."""


@dataclasses.dataclass
class Case:
    """One page entry.  A check that fails is a finding, told beside the others; it is never removed."""

    title: str
    rung: int
    tests: str  # what is tested
    source: str  # where the numbers come from
    expected: str  # which agreement is expected, and why
    header: list = dataclasses.field(default_factory=list)
    rows: list = dataclasses.field(default_factory=list)
    checks: list = dataclasses.field(default_factory=list)  # (what, good)
    found: str = ""
    figures: list = dataclasses.field(default_factory=list)  # (file name, caption)

    def check(self, good, what):
        self.checks.append((what, bool(good)))

    @property
    def good(self):
        return bool(self.checks) and all(good for _, good in self.checks)


def whole_number(variable, least, most):
    """What a variable of the environment asks for; the most where it is not set."""
    text = os.environ.get(variable, str(most))
    if text not in [str(n) for n in range(least, most + 1)]:
        raise SystemExit(f"{variable}: expected {least} to {most}, found '{text}'")
    return int(text)


def answer(*words):
    """The JSON object with which a Fram command ends."""
    done = subprocess.run([str(FRAM), *map(str, words), "--json"], capture_output=True, text=True)
    last = json.loads(done.stdout.splitlines()[-1])
    if done.returncode != 0:
        raise RuntimeError(f"fram {' '.join(map(str, words))}: {last['error']['message']}")
    return last


def same_files(folder):
    """Whether the files that a run named (hulls, outlines, tables) are what it read."""
    for file in json.loads((folder / "run.json").read_text())["inputs"]:
        path = pathlib.Path(file["file"])
        if not path.is_file() or hashlib.sha256(path.read_bytes()).hexdigest() != file["sha256"]:
            return False
    return True


def run(scenario, name, **keys):
    """Runs a scenario (a path, or text) with keys replaced ("__" for "."), and returns its channels.

    A finished run of the same program, scenario, keys and files is read again instead: a ladder that was stopped goes
    on.
    """
    folder = WORK / name
    if not isinstance(scenario, pathlib.Path):
        path = WORK / f"{name}.yaml"
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(scenario)
        scenario = path
    sets = [f"--set={key.replace('__', '.')}={value}" for key, value in keys.items()]
    mark = json.dumps([sets, scenario.read_text(), os.stat(FRAM).st_mtime])
    done = folder / "validated"
    if not done.exists() or done.read_text() != mark or not same_files(folder):
        shutil.rmtree(folder, ignore_errors=True)
        folder.parent.mkdir(parents=True, exist_ok=True)
        answer("run", scenario, "-o", folder, "--quiet", "--threads", 1, *sets)
        done.write_text(mark)
        MADE.add(name)
    elif name not in MADE:
        REUSED.append(name)
    return channels(folder)


def side_by_side(work, items):
    """Results of work(item) in the order of the items, JOBS of them at a time."""
    with concurrent.futures.ThreadPoolExecutor(max_workers=JOBS) as pool:
        return list(pool.map(work, items))


def run_all(jobs):
    """Runs (scenario, name, keys) side by side, one thread each, and returns their channels in the order given."""
    return side_by_side(lambda job: run(job[0], job[1], **job[2]), jobs)


def table(path):
    """The columns of a CSV file of Fram as lists of numbers, by name without unit."""
    with open(path, newline="") as file:
        reader = csv.reader(file)
        names = [head.split("[")[0] for head in next(reader)]
        columns = list(zip(*([float(value) for value in row] for row in reader)))
    return dict(zip(names, columns or [()] * len(names)))


def channels(folder):
    """All channels of a run over time."""
    return table(folder / "series.csv")


def fractures(name):
    """The floes that broke in a run that run() made under this name."""
    return table(WORK / name / "fractures.csv")


def after(series, name, start):
    """Values of a channel after a time: the row at it is of the step that ends there."""
    return [v for t, v in zip(series["time"], series[name]) if t - start > 1e-9 * t]


def greatest(first, *others):
    """As max(), but a NaN where one is among them: max() passes over one that is not the first, and a check with it."""
    return _outermost(max, first, others)


def least(first, *others):
    """As min(), in the same way."""
    return _outermost(min, first, others)


def _outermost(choose, first, others):
    values = [first, *others] if others else list(first)
    return next((value for value in values if math.isnan(value)), choose(values))


def rises(values):
    """Whether none is less than the one before it; not with a NaN among them, which sorted() leaves where it is."""
    return all(a <= b for a, b in zip(values, values[1:]))


def mean_and_error(values):
    """Mean and its standard error; stdev() raises an error of its own where one of them is a NaN."""
    mean = statistics.fmean(values)
    spread = statistics.stdev(values) if len(values) > 1 and not math.isnan(mean) else math.nan
    return mean, spread / math.sqrt(len(values))


def means_and_errors(each):
    """Of what several runs give, number by number."""
    return [mean_and_error(values) for values in zip(*each)]


def significant(values):
    """The mean of the highest third of the peaks between upcrossings of the mean."""
    level, peaks, peak = statistics.fmean(values), [], -math.inf
    for before, now in zip(values, values[1:]):
        if before <= level < now:
            peak = now
        elif now > level:
            peak = max(peak, now)
        elif before > level and peak > -math.inf:
            peaks.append(peak)
            peak = -math.inf
    peaks.sort(reverse=True)
    top = peaks[: max(1, len(peaks) // 3)]
    return statistics.fmean(top) if top else math.nan


def observed_order(errors):
    """Orders of convergence from errors at steps that are halved each time."""
    return [math.log2(a / b) if a > 0 and b > 0 else math.nan for a, b in zip(errors, errors[1:])]


def number(value, digits=4):
    return f"{value:.{digits}g}" if isinstance(value, float) else str(value)


def figure(case, out, name, caption, draw, size=(7.2, 3.4), panels=1):
    """One picture: draw(axes) fills it; with more panels, side by side, it gets a list of axes."""
    import matplotlib

    matplotlib.use("Agg")
    import matplotlib.pyplot as plt

    plt.rcParams.update({"font.size": 9, "axes.grid": True, "grid.alpha": 0.3, "figure.dpi": 110})
    picture, axes = plt.subplots(1, panels, figsize=size, layout="constrained")
    draw(axes)
    for ax in picture.axes:
        low, high = ax.get_ylim()
        if low == 0 and ax.get_yscale() == "linear":  # room above what a fixed lower limit left tight
            ax.set_ylim(low, 1.06 * high)
    picture.savefig(out / f"{name}.png", metadata={"Software": None})
    plt.close(picture)
    case.figures.append((f"{name}.png", caption))


def box_obj(path, lo, hi, turn=None):
    """Writes a box as OBJ; turn maps a corner (x, y, z)."""
    boxes_obj(path, [(lo, hi)], turn)


def boxes_obj(path, boxes, turn=None):
    """The same of several, each from lo to hi."""
    corners, faces = [], []
    for lo, hi in boxes:
        n = len(corners)
        faces += [[n + k for k in f]
                  for f in [(1, 3, 4, 2), (5, 6, 8, 7), (1, 2, 6, 5), (3, 7, 8, 4), (1, 5, 7, 3), (2, 4, 8, 6)]]
        corners += [(x, y, z) for z in (lo[2], hi[2]) for y in (lo[1], hi[1]) for x in (lo[0], hi[0])]
    write_obj(path, [turn(*c) if turn else c for c in corners], faces)


def write_obj(path, corners, faces):
    path.parent.mkdir(parents=True, exist_ok=True)
    lines = ["v %.17g %.17g %.17g" % tuple(c) for c in corners] + ["f " + " ".join(map(str, f)) for f in faces]
    # Whole or not there: runs side by side may read the same hull.
    beside = path.with_suffix(f".{threading.get_ident()}")
    beside.write_text("\n".join(lines) + "\n")
    beside.replace(path)
