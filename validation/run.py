#!/usr/bin/env python3
"""The validation book: every case of the ladder, one page each.

  validation/run.py [--quick] [--only NAME ...] [--out DIR]

--quick leaves out the cases of many long runs.  Pages and figures go to DIR (docs/validation), with verdicts.json, from
which cases that are not run now keep their line on the first page.  Exit code 1 when a check fails: a finding belongs
on its page, and into docs/limits.md with its size.
"""

import argparse
import datetime
import importlib
import json
import pathlib
import platform
import subprocess
import sys
import time
import traceback

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


def page(name, case, seconds, head):
    """The page of one case."""
    made = (f"{head} ({seconds:.0f} s of computing with what was already there; "
            f"`make validate VALIDATE_FLAGS=\"--only {name}\"`).")
    lines = [f"# {case.title}", "", f"Rung {case.rung} of the [ladder](README.md). {made}", ""]
    lines += [f"**Tests.** {case.tests}", "", f"**Source.** {case.source}", "", f"**Expected.** {case.expected}", ""]
    lines += [f"**Verdict: {'agrees' if case.good else 'does not agree'}.** {case.found}".rstrip(), ""]
    if case.rows:
        lines += ["| " + " | ".join(case.header) + " |", "|" + "---|" * len(case.header)]
        lines += ["| " + " | ".join(ladder.number(cell) for cell in row) + " |" for row in case.rows] + [""]
    for file, caption in case.figures:
        lines += [f"![{caption}]({file})", "", f"*{caption}*", ""]
    lines += [f"- {'agrees' if good else '**does not agree**'}: {what}" for what, good in case.checks] + [""]
    return "\n".join(lines)


def index(verdicts, names):
    """The book's first page: every case with its verdict, what did not agree, and what was not made."""
    agree = sum(v["good"] for v in verdicts.values())
    lines = ["# Validation", "",
             "Made by `make validate`; `VALIDATE_FLAGS=--quick` runs the cases of a few minutes, `--only NAME` one. "
             "Each case says what it tests, where the numbers come from, which agreement is expected and why, and "
             "what was found, good or bad. Nothing is tuned to a case: parameters are those of its source or the "
             "defaults. Some bounds were set after a first run: their pages say so, and such a check shows that "
             "nothing has changed since, no more. What "
             "disagrees, and the size of each known error, stands in the [limits](../limits.md).", "",
             f"{agree} of {len(verdicts)} cases agree.", ""]
    for rung, title in RUNGS.items():
        of_rung = {n: v for n, v in verdicts.items() if v["rung"] == rung}
        if not of_rung:
            continue
        lines += [f"## {rung}. {title}", "", "| case | verdict | checks | made |", "|---|---|---|---|"]
        for name, v in sorted(of_rung.items(), key=lambda item: item[1]["title"]):
            lines.append(f"| [{v['title']}]({name}.md) | {'agrees' if v['good'] else '**does not agree**'} | "
                         f"{v['checks'] - len(v['failed'])} of {v['checks']} | {v['made']} |")
        lines.append("")
    failed = [(n, what) for n, v in verdicts.items() for what in v["failed"]]
    if failed:
        lines += ["## What does not agree", ""]
        lines += [f"- [{verdicts[n]['title']}]({n}.md): {what}" for n, what in failed] + [""]
    missing = [name for name in names if name not in verdicts]
    if missing:
        lines += ["## Not in this edition", "", "Cases that are written and were not run when this page was made: "
                  + ", ".join(f"`{name}`" for name in missing) + ".", ""]
    return "\n".join(lines)


def version():
    done = subprocess.run([str(ladder.FRAM), "--version"], capture_output=True, text=True)
    return done.stdout.splitlines()[0]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--quick", action="store_true")
    parser.add_argument("--only", nargs="+", metavar="NAME")
    parser.add_argument("--out", type=pathlib.Path, default=ladder.ROOT / "docs" / "validation")
    options = parser.parse_args()
    options.out.mkdir(parents=True, exist_ok=True)
    ladder.WORK.mkdir(parents=True, exist_ok=True)

    modules = {p.stem.removeprefix("case_"): importlib.import_module(p.stem) for p in sorted(HERE.glob("case_*.py"))}
    unknown = set(options.only or []) - set(modules)
    if unknown:
        parser.error(f"no case {', '.join(sorted(unknown))}; there are {', '.join(modules)}")
    kept = options.out / "verdicts.json"
    head = f"{version()}, revision {revision()}, {datetime.date.today()}, {machine()}"
    failed, begun = 0, time.monotonic()
    for name, module in modules.items():
        if options.only and name not in options.only:
            continue
        if options.quick and module.LONG:
            print(f"validation: {name} left out by --quick")
            continue
        start = time.monotonic()
        print(f"validation: {name}", flush=True)
        try:
            case = module.case(options.out)
        except ladder.Skipped as why:
            print(f"validation: {name} skipped: {why}")
            continue
        except Exception:  # one case that cannot be made must not cost the others
            traceback.print_exc()
            failed += 1
            continue
        seconds = time.monotonic() - start
        for what, good in case.checks:
            print(f"  {'good' if good else 'FAILED'}: {what}", flush=True)
        failed += not case.good
        (options.out / f"{name}.md").write_text(page(name, case, seconds, head))
        # Read anew: another run may have made other cases meanwhile.
        verdicts = json.loads(kept.read_text()) if kept.exists() else {}
        verdicts = {key: v for key, v in verdicts.items() if key in modules}
        verdicts[name] = {"title": case.title, "rung": case.rung, "good": case.good, "checks": len(case.checks),
                          "failed": [what for what, good in case.checks if not good],
                          "made": f"{datetime.date.today()}, {revision()}"}
        kept.write_text(json.dumps(verdicts, indent=1, sort_keys=True) + "\n")
        (options.out / "README.md").write_text(index(verdicts, modules))
    print(f"validation: {options.out / 'README.md'}, {time.monotonic() - begun:.0f} s")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
