#!/usr/bin/env python3
"""The validation book: every case of the ladder, one page each.

  validation/run.py [--quick] [--only NAME ...] [--out DIR] [--jobs N]
  validation/run.py --index           the first page anew, which says what was made on other code than there is now

--quick leaves out the cases of many long runs.  Pages and figures go to DIR (docs/validation), with verdicts.json, from
which cases that are not run now keep their line on the first page.  Runs that the same program has finished on the
same files are read again (build/validation); remove that folder to begin anew.  Exit code 1 when a check fails: a
finding belongs on its page, and into docs/limits.md with its size.
"""

import argparse
import datetime
import importlib
import json
import pathlib
import subprocess
import sys
import time
import traceback

HERE = pathlib.Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parent / "tools")]
import ladder  # noqa: E402  (beside this script)
import status  # noqa: E402
from machine import processor  # noqa: E402  (tools)

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


def revision():
    """The commit; with "+" where what decides a result is not as committed."""
    def git(*words):
        command = ["git", "-C", str(ladder.ROOT), "--git-dir=.git", *words]
        return subprocess.run(command, capture_output=True, text=True).stdout.strip()

    changed = git("status", "--porcelain", "-uno", "--", "src", "include", "scenes", "validation", "CMakeLists.txt")
    return git("rev-parse", "--short", "HEAD") + ("+" if changed else "") or "no version control"


def program():
    """Version of Fram, and with which compiler and instruction set it runs."""
    done = subprocess.run([str(ladder.FRAM), "--version"], capture_output=True, text=True)
    ladder.run("run: {duration: 0.1}\nice: {source: floes, floes: [{length: 9, width: 9}]}\n", "about")
    about = json.loads((ladder.WORK / "about" / "run.json").read_text())
    return f"{done.stdout.splitlines()[0]} ({about['compiler']}, {about['isa']})"


def spent(seconds, reused):
    again = f", {reused} runs read again that were there" if reused else ""
    return f"{seconds:.0f} s{again}" if seconds < 600 else f"{seconds / 60:.0f} min{again}"


def all_cases(verdicts):
    """What the cases took together when each of them was made; nothing where one was not timed."""
    took = [v.get("seconds") for v in verdicts.values()]
    return "" if None in took else f"One after the other the cases of this edition took {sum(took) / 60:.0f} min. "


def page(name, case, cost, head):
    """The page of one case."""
    made = f"{head}; {cost}; again: `make validate VALIDATE_FLAGS=\"--only {name}\"`."
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


def index(book, names):
    """The book's first page: every case with its verdict, what did not agree, and what was not made."""
    verdicts, now = book["cases"], status.of_checkout()
    agree = sum(v["good"] for v in verdicts.values())
    lines = ["# Validation", "",
             "Made by `make validate`; `VALIDATE_FLAGS=--quick` runs the cases of a few minutes, `--only NAME` one. "
             "Each case says what it tests, where the numbers come from, which agreement is expected and why, and "
             "what was found, good or bad. Nothing is tuned to a case: parameters are those of its source or the "
             "defaults. Some bounds were set after a first run: their pages say so, and such a check shows that "
             "nothing has changed since, no more. What "
             "disagrees, and the size of each known error, stands in the [limits](../limits.md). The last column names "
             "the code that has changed since a page was made: its numbers may have changed with it "
             "(`make validate-status` compares with the present code of contacts, solver, fracture, water, "
             "geometry, and of the sealing of cracks where a case reads such hulls; scenes, defaults and what calls "
             "them are not compared).", "",
             f"{agree} of {len(verdicts)} cases agree. {all_cases(verdicts)}"
             + " ".join(book["times"][key] for key in ("whole", "quick") if key in book["times"]), ""]
    for rung, title in RUNGS.items():
        of_rung = {n: v for n, v in verdicts.items() if v["rung"] == rung}
        if not of_rung:
            continue
        lines += [f"## {rung}. {title}", "", "| case | verdict | checks | made | code changed since |",
                  "|---|---|---|---|---|"]
        for name, v in sorted(of_rung.items(), key=lambda item: item[1]["title"]):
            lines.append(f"| [{v['title']}]({name}.md) | {'agrees' if v['good'] else '**does not agree**'} | "
                         f"{v['checks'] - len(v['failed'])} of {v['checks']} | {v['made']} | "
                         f"{', '.join(status.changed(name, v, now)) or 'none'} |")
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


def read_book(path, names):
    """Verdicts of earlier runs, by case, and what whole runs took."""
    book = json.loads(path.read_text()) if path.exists() else {}
    cases = {name: v for name, v in book.get("cases", {}).items() if name in names}
    return {"cases": cases, "times": book.get("times", {})}


def write_book(out, book, names):
    (out / "verdicts.json").write_text(json.dumps(book, indent=1, sort_keys=True) + "\n")
    (out / "README.md").write_text(index(book, names))


def unmade(verdict, why, made):
    """The verdict of a case that could not be made: its page stays that of before."""
    reason = (str(why).splitlines() or [""])[0].replace(f"{ladder.ROOT}/", "")
    told = f"could not be made ({datetime.date.today()}, {made}): {type(why).__name__}: {reason}"
    return {**verdict, "good": False, "checks": 1, "failed": [told]}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--quick", action="store_true")
    parser.add_argument("--only", nargs="+", metavar="NAME")
    parser.add_argument("--out", type=pathlib.Path, default=ladder.ROOT / "docs" / "validation")
    parser.add_argument("--index", action="store_true")
    parser.add_argument("--jobs", type=int, default=ladder.JOBS, help="runs side by side (one a core)")
    options = parser.parse_args()
    ladder.JOBS = options.jobs
    options.out.mkdir(parents=True, exist_ok=True)
    ladder.WORK.mkdir(parents=True, exist_ok=True)

    modules = {p.stem.removeprefix("case_"): importlib.import_module(p.stem) for p in sorted(HERE.glob("case_*.py"))}
    if options.index:
        write_book(options.out, read_book(options.out / "verdicts.json", modules), modules)
        return 0
    unknown = set(options.only or []) - set(modules)
    if unknown:
        parser.error(f"no case {', '.join(sorted(unknown))}; there are {', '.join(modules)}")
    chosen = [n for n, module in modules.items() if not (options.only and n not in options.only
                                                        or options.quick and module.LONG)]
    made = revision()  # once: the program and the cases are those of now, whatever is committed meanwhile
    head = f"{program()}, revision {made}, {datetime.date.today()}, {processor()}, {options.jobs} runs at a time"
    code = status.of_checkout()
    failed, skipped, begun, reused_before = 0, 0, time.monotonic(), len(ladder.REUSED)
    for name in chosen:
        start, before = time.monotonic(), len(ladder.REUSED)
        print(f"validation: {name}", flush=True)
        try:
            case = modules[name].case(options.out)
        except ladder.Skipped as why:
            print(f"validation: {name} skipped: {why}")
            skipped += 1
            continue
        except Exception as why:  # one case that cannot be made must not cost the others
            traceback.print_exc()
            failed += 1
            skipped += 1
            book = read_book(options.out / "verdicts.json", modules)
            if name in book["cases"]:  # one that never was stands among those that are not in this edition
                book["cases"][name] = unmade(book["cases"][name], why, made)
                write_book(options.out, book, modules)
            continue
        seconds, reused = time.monotonic() - start, len(ladder.REUSED) - before
        cost = spent(seconds, reused)
        for what, good in case.checks:
            print(f"  {'good' if good else 'FAILED'}: {what}", flush=True)
        print(f"  {cost}", flush=True)
        failed += not case.good
        (options.out / f"{name}.md").write_text(page(name, case, cost, head))
        # Read anew: another run may have made other cases meanwhile.
        book = read_book(options.out / "verdicts.json", modules)
        if reused:  # what it takes to make them too is known from before, if at all
            seconds = book["cases"].get(name, {}).get("seconds")
        book["cases"][name] = {"title": case.title, "rung": case.rung, "good": case.good, "checks": len(case.checks),
                               "failed": [what for what, good in case.checks if not good],
                               "made": f"{datetime.date.today()}, {made}", "code": code,
                               "seconds": seconds and round(seconds)}
        write_book(options.out, book, modules)
    seconds = time.monotonic() - begun
    if not options.only and not skipped:
        book = read_book(options.out / "verdicts.json", modules)
        of = f"The quick part, {len(chosen)} cases," if options.quick else f"The whole book, {len(chosen)} cases,"
        book["times"]["quick" if options.quick else "whole"] = (
            f"{of} in one command: {spent(seconds, 0)} ({head}).")
        write_book(options.out, book, modules)
    print(f"validation: {options.out / 'README.md'}, {spent(seconds, len(ladder.REUSED) - reused_before)}")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
