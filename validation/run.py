#!/usr/bin/env python3
"""The validation book: every case of the ladder, one page.

  validation/run.py [--quick] [--only NAME ...] [--out DIR]

--quick leaves out the cases of many long runs.  The page and its figures go to DIR (docs/validation).  Exit code 1 when
a check fails: a finding belongs on the page, and into docs/limits.md with its size.
"""

import argparse
import datetime
import importlib
import pathlib
import platform
import subprocess
import sys
import time

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE))
import ladder  # noqa: E402  (beside this script)

RUNGS = {
    1: "Identities and conservation",
    2: "Analytic cases",
    3: "Convergence",
    4: "Cross-checks",
    5: "Published formulas",
    6: "Published tests",
    7: "Trends known from the literature",
    8: "Statistics",
}


def machine():
    name = platform.processor() or platform.machine()
    try:
        with open("/proc/cpuinfo") as file:
            name = next(line.split(":", 1)[1].strip() for line in file if line.startswith("model name"))
    except (OSError, StopIteration):
        pass
    return name


def revision():
    words = ["git", "-C", str(ladder.ROOT), "rev-parse", "--short", "HEAD"]
    done = subprocess.run(words, capture_output=True, text=True)
    return done.stdout.strip() or "no version control"


def entry(case, seconds):
    lines = [f"### {case.title}", ""]
    lines += [f"**Tests.** {case.tests}", "", f"**Source.** {case.source}", "", f"**Expected.** {case.expected}", ""]
    if case.rows:
        lines += ["| " + " | ".join(case.header) + " |", "|" + "---|" * len(case.header)]
        lines += ["| " + " | ".join(ladder.number(cell) for cell in row) + " |" for row in case.rows] + [""]
    for name, caption in case.figures:
        lines += [f"![{caption}]({name})", "", f"*{caption}*", ""]
    lines += [f"- {'agrees' if good else '**does not agree**'}: {what}" for what, good in case.checks] + [""]
    if case.found:
        lines += [f"**Found.** {case.found}", ""]
    return lines + [f"({seconds:.0f} s)", ""]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--quick", action="store_true")
    parser.add_argument("--only", nargs="+", metavar="NAME")
    parser.add_argument("--out", type=pathlib.Path, default=ladder.ROOT / "docs" / "validation")
    options = parser.parse_args()
    options.out.mkdir(parents=True, exist_ok=True)
    ladder.WORK.mkdir(parents=True, exist_ok=True)

    done, left_out, failed = [], [], 0
    for path in sorted(HERE.glob("case_*.py")):
        module = importlib.import_module(path.stem)
        name = path.stem.removeprefix("case_")
        if options.only and name not in options.only:
            continue
        if options.quick and module.LONG:
            left_out.append((name, "long: left out by --quick"))
            continue
        start = time.monotonic()
        print(f"validation: {name}", flush=True)
        try:
            case = module.case(options.out)
        except ladder.Skipped as why:
            left_out.append((name, str(why)))
            print(f"validation: {name} skipped: {why}")
            continue
        done.append((case, time.monotonic() - start))
        for what, good in case.checks:
            print(f"  {'good' if good else 'FAILED'}: {what}")
        failed += not case.good

    version = subprocess.run([str(ladder.FRAM), "--version"], capture_output=True, text=True).stdout.splitlines()[0]
    lines = ["# Validation", ""]
    lines += [
        f"{version}, revision {revision()}, {datetime.date.today()}, {machine()}.  Made by `make validate`; "
        f"{sum(c.good for c, _ in done)} of {len(done)} cases agree.  Nothing is tuned to a case.",
        "",
    ]
    for rung, title in RUNGS.items():
        cases = [(c, s) for c, s in done if c.rung == rung]
        if cases:
            lines += [f"## {rung}. {title}", ""]
            for case, seconds in cases:
                lines += entry(case, seconds)
    if left_out:
        lines += ["## Left out", ""] + [f"- `{name}`: {why}" for name, why in left_out] + [""]
    (options.out / "README.md").write_text("\n".join(lines))
    print(f"validation: {options.out / 'README.md'}")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
