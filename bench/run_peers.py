#!/usr/bin/env python3
"""Fram beside Bullet, ODE, Box3D and Jolt on the same scenes, in the same run.

  bench/run_peers.py [--repeat R] [--sizes N ...] [--covers C ...] [--programs P ...] [--core K] [--out BASE]
      speed: every program on every scene in turn, R times, one thread on one core
  bench/run_peers.py --threads-only [--sizes N ...]
      two threads against one on two cores, and whether two copies of one thread reach 1.9 at the same time
  bench/run_peers.py --loads SEEDS
      mean ship load over seeds of Fram, Bullet and ODE, with their spread
  bench/run_peers.py --forces [--repeat R] [--sizes N ...] [--covers C ...]
      Fram's exact water beside the peers' columns (their forces_ms), with each instruction set; prints, keeps nothing

--box3d DIR and --jolt DIR name the sources of engines that Debian does not have (github.com/erincatto/box3d,
github.com/jrouwe/JoltPhysics); they are built in build/bench, and left out by name without.
Results go to BASE.md, BASE.csv and BASE.json.  What BASE.json holds already is kept, with the machine and day of its
measuring, unless it is measured again, so that a long table can be made in pieces; --fresh begins anew.  A scene that
is measured with other options (rounds, step, iterations, times, solver) begins anew, too.

Ratios are taken inside each round and their median is told: the machine's speed may change between rounds.
"""

import argparse
import csv
import datetime
import json
import math
import os
import pathlib
import re
import statistics
import subprocess
import sys

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parent
sys.path[:0] = [str(HERE), str(HERE.parent / "tools")]
import penetration  # noqa: E402  (beside this script)
from machine import processor  # noqa: E402  (tools)

WORK = ROOT / "build" / "bench"
PEERS = HERE / "peers"
PACKED = 98  # from this cover on the ship stands still in open water, and the current packs the field against a wall


def command(*words, **more):
    return subprocess.run([str(w) for w in words], check=True, capture_output=True, text=True, **more).stdout


def answer(*words):
    """What a command says, nothing where it fails."""
    return subprocess.run([str(w) for w in words], capture_output=True, text=True).stdout.strip()


def flags(module):
    return command("pkg-config", "--cflags", "--libs", module).split()


def is_older(out, sources):
    return not out.exists() or out.stat().st_mtime < max(source.stat().st_mtime for source in sources)


def require(folder, entry, option):
    if not (folder / entry).exists():
        sys.exit(f"run_peers: {option} {folder}: there is no {entry} in it; name the folder of the engine's sources")
    return folder.resolve()


def build_box3d(folder):
    """The engine's own sources with the flags of the other peers."""
    out, engine = WORK / "box3d", WORK / "box3d_engine.a"
    sources = sorted(require(folder, "include/box3d/box3d.h", "--box3d").glob("src/*.c"))
    compiler = ("gcc", "-O2", "-march=native", "-DNDEBUG", "-std=gnu17", "-I", folder / "include")
    if is_older(engine, sources):
        rooms = WORK / "box3d_objects"
        rooms.mkdir(exist_ok=True)
        for source in sources:
            command(*compiler, "-w", "-I", folder / "src", "-c", source, "-o", rooms / f"{source.stem}.o")
        engine.unlink(missing_ok=True)
        command("ar", "qcs", engine, *sorted(rooms.glob("*.o")))
    if is_older(out, [PEERS / "box3d_floes.c", PEERS / "scene.h", engine]):
        command(*compiler, PEERS / "box3d_floes.c", engine, "-o", out, "-lm", "-lpthread")
    return out


def build_jolt(folder):
    """By the engine's own CMake project, for its flags and definitions."""
    build = WORK / "jolt"
    command("cmake", "-G", "Ninja", "-S", PEERS / "jolt", "-B", build,
            f"-DJOLT={require(folder, 'Jolt/Jolt.h', '--jolt')}")
    command("cmake", "--build", build, "--target", "jolt_floes")
    return build / "jolt_floes"


def is_asked(options, name):
    return not options.programs or name in options.programs


def build_engines(options):
    """Those whose sources were named."""
    programs = {}
    for name, folder, build in (("box3d", options.box3d, build_box3d), ("jolt", options.jolt, build_jolt)):
        if not is_asked(options, name):
            continue
        if folder is None:
            print(f"run_peers: {name} is left out: --{name} names no sources", file=sys.stderr)
        else:
            programs[name] = build(folder)
    return programs


def build_peers(options):
    WORK.mkdir(parents=True, exist_ok=True)
    recipes = {
        "bullet_f32": ("g++", "-std=c++17", PEERS / "bullet_floes.cpp", "bullet"),
        "bullet_f64": ("g++", "-std=c++17", PEERS / "bullet_floes.cpp", "bullet-float64"),
        "ode": ("gcc", "-std=gnu11", PEERS / "ode_floes.c", "ode"),
    }
    programs = {}
    for name, (compiler, standard, source, module) in recipes.items():
        if not is_asked(options, name):
            continue
        out = WORK / name
        if is_older(out, [source, PEERS / "scene.h"]):
            command(compiler, "-O2", "-march=native", "-DNDEBUG", standard, source, "-o", out, *flags(module), "-lm")
        programs[name] = out
    return {**programs, **build_engines(options)}


def scene_of(size, cover, seed=1):
    path = WORK / "scenes" / f"n{size}_c{cover}_s{seed}.scene"
    if not path.exists():
        path.parent.mkdir(parents=True, exist_ok=True)
        current = ("0.3", "0") if cover >= 90 else ("0", "0")
        ship = ("--ship-speed", "0") if cover >= PACKED else ()
        command(sys.executable, PEERS / "gen_scene.py", "--n", size, "--coverage", cover / 100, "--seed", seed,
                "--current", *current, *ship, "-o", path)
    return path


def run_fram(options, scene, cores, *words):
    out = command("taskset", "-c", cores, options.fram, "bench", "--scene", scene, "--dt", options.dt, "--iterations",
                  options.iterations, "--time", options.time, "--warm", options.warm, "--solver", options.solver,
                  "--json", "--quiet", *words)
    return json.loads(out)


def run_peer(options, program, scene, *words):
    rounds = options.substeps if program.name == "box3d" else options.iterations
    out = command("taskset", "-c", options.core, program, scene, "--dt", options.dt, "--iters", rounds,
                  "--time", options.time, "--warm", options.warm, *words)
    found = dict(re.findall(r"(\S+)=(\S+)", out))
    return {
        "ms_per_step_median": float(found["ms_cpu_median"]),
        "collide_ms": float(found["collide_ms"]),
        "solve_ms": float(found["solve_ms"]),
        "forces_ms": float(found["forces_ms"]),
        "contact_points": float(found["contacts"]),
        "pairs": float(found["pairs"]),
        "ship_force_kN": float(found["ship_kN"]),
    }


def contestants(options, peers):
    """Name -> function of (scene, dump file)."""
    list_of = {"fram": lambda scene, dump: run_fram(options, scene, options.core, "--dump", dump)}
    if options.isa:
        list_of["fram " + options.isa] = lambda scene, dump: run_fram(
            options, scene, options.core, "--isa", options.isa, "--dump", dump)
    for name, program in peers.items():
        list_of[name] = lambda scene, dump, program=program: run_peer(options, program, scene, "--dump", dump)
    return {name: run for name, run in list_of.items() if is_asked(options, name)}


def version_of(folder):
    """Commit and date of an engine's sources, where they come with them."""
    return answer("git", "-C", folder, "log", "-1", "--format=%h of %as") or "of no known version"


def machine(options=None):
    engines = {name: getattr(options, name, None) for name in ("box3d", "jolt")}
    return {
        "date": datetime.date.today().isoformat(),
        "processor": processor(),
        "cores": len(os.sched_getaffinity(0)),
        "compiler": command("gcc", "--version").splitlines()[0],
        "bullet": answer("pkg-config", "--modversion", "bullet-float64") or "not installed",
        "ode": answer("pkg-config", "--modversion", "ode") or "not installed",
        **{name: version_of(folder) for name, folder in engines.items() if folder},
    }


def median_of(rounds, key):
    return statistics.median(r[key] for r in rounds)


def measure_speed(options):
    programs = contestants(options, build_peers(options))
    scenes = []
    for size in options.sizes:
        for cover in options.covers:
            scene = scene_of(size, cover)
            rounds, depth = {name: [] for name in programs}, {}
            for k in range(options.repeat):
                for name, run in programs.items():
                    dump = WORK / "poses.csv"
                    rounds[name].append(run(scene, dump))
                    if k == 0:
                        depth[name] = penetration.measure(scene, dump)
            rows = {}
            for name, r in rounds.items():
                ms = [x["ms_per_step_median"] for x in r]
                rows[name] = {
                    "ms": statistics.median(ms),
                    "ms_least": min(ms),
                    "us_per_floe": 1e3 * statistics.median(ms) / size,
                    "fram_is_faster_by": statistics.median(
                        a["ms_per_step_median"] / b["ms_per_step_median"] for a, b in zip(r, rounds["fram"]))
                    if "fram" in rounds else math.nan,
                    **{k: median_of(r, k) for k in ("collide_ms", "solve_ms", "forces_ms", "contact_points", "pairs",
                                                    "ship_force_kN")},
                    "penetration": depth[name],
                }
            scenes.append({"floes": size, "cover": cover, "programs": rows,
                           "options": {k: getattr(options, k) for k in
                                       ("repeat", "dt", "iterations", "warm", "time", "solver")}})
            print_scene(scenes[-1], sys.stderr)
    return {"scenes": scenes}


HEAD = ("| program | ms a step | us per floe | Fram is faster by | collide | solve | forces | points | pairs |"
        " ship kN |"
        " overlap mean mm | p99 mm | largest mm |")


def print_scene(scene, file):
    o = scene["options"]
    packed = ", pressed against a wall by the current" if scene["cover"] >= PACKED else ""
    print(f"\n### {scene['floes']} floes, {scene['cover']} % cover{packed}\n", file=file)
    print(f"Median of {o['repeat']} interleaved runs; time step {o['dt']} s, {o['iterations']} iterations,"
          f" {o['time']:g} s of which {o['warm']:g} s unmeasured; Fram's solver: {o['solver']}.\n", file=file)
    print(HEAD, file=file)
    print("|" + "---|" * 13, file=file)
    for name, r in scene["programs"].items():
        p = r["penetration"]
        print(f"| {name} | {r['ms']:.3f} | {r['us_per_floe']:.3f} | {r['fram_is_faster_by']:.2f} |"
              f" {r['collide_ms']:.3f} |"
              f" {r['solve_ms']:.3f} | {r['forces_ms']:.3f} | {r['contact_points']:.0f} | {r['pairs']:.0f} |"
              f" {r['ship_force_kN']:.0f} | {1e3 * p['mean_m']:.3f} | {1e3 * p['p99_m']:.2f} |"
              f" {1e3 * p['max_m']:.2f} |",
              file=file, flush=True)


def same_row(a, b, keys):
    return all(a.get(k) == b.get(k) for k in keys)


def measured(result):
    """Every row that a machine was measured for: programs of scenes, threads and loads."""
    programs = [row for scene in result.get("scenes", []) for row in scene["programs"].values()]
    return programs + result.get("threads", []) + result.get("loads", [])


def merged(old, new, now):
    """What was measured before and not again, each with its machine, and what is new, by the machine of now."""
    for result, machine_then in ((old, old.get("machine")), (new, now)):
        for row in measured(result):
            row.setdefault("machine", machine_then)
    out = {"machine": now}
    for part, keys in (("scenes", ("floes", "cover")), ("threads", ("floes",)),
                       ("loads", ("floes", "cover", "program"))):
        fresh, kept = new.get(part, []), []
        for row in old.get(part, []):
            again = next((f for f in fresh if same_row(row, f, keys)), None)
            if not again:
                kept.append(row)
            elif part == "scenes" and row["options"] == again["options"]:
                again["programs"] = {**row["programs"], **again["programs"]}
        out[part] = sorted(kept + fresh, key=lambda r: [str(r[k]).zfill(9) for k in keys])
    return out


def told(m):
    """A machine in words."""
    peers = "".join(f", {word} {m[name]}" for name, word in (("box3d", "Box3D"), ("jolt", "Jolt")) if name in m)
    return f"{m['processor']}, {m['cores']} cores; {m['compiler']}; Bullet {m['bullet']}, ODE {m['ode']}{peers}"


def print_earlier(rows, now, file):
    """Names of the rows that were not measured by the machine and on the day of the page's head; rows: (name, row)."""
    earlier = {}
    for name, row in rows:
        if row["machine"] != now:
            earlier.setdefault(f"{row['machine']['date']}, {told(row['machine'])}", []).append(name)
    for where, names in earlier.items():
        print(f"\nMeasured {where}: {'; '.join(names)}.", file=file)


def write_csv(result, path):
    columns = ("ms", "ms_least", "us_per_floe", "fram_is_faster_by", "collide_ms", "solve_ms", "forces_ms",
               "contact_points", "pairs", "ship_force_kN")
    with open(path, "w", encoding="utf-8", newline="") as file:
        out = csv.writer(file)
        out.writerow(("floes", "cover", "program", *columns, "overlap_mean_m", "overlap_p99_m", "overlap_max_m"))
        for scene in result["scenes"]:
            for name, r in scene["programs"].items():
                p = r["penetration"]
                out.writerow((scene["floes"], scene["cover"], name, *(f"{r[c]:.6g}" for c in columns),
                              *(f"{p[k]:.6g}" for k in ("mean_m", "p99_m", "max_m"))))


def goal_rows(result):
    """(scene, goal, found, met) of everything that was measured."""
    rows = []
    for scene in result["scenes"]:
        programs, name = scene["programs"], f"{scene['floes']} floes, {scene['cover']} %"
        if "fram" not in programs:
            continue
        for peer, factor in (("bullet_f64", 8), ("ode", 4), ("box3d", 2)):
            if peer in programs and not (peer == "ode" and scene["cover"] >= PACKED):
                found = programs[peer]["fram_is_faster_by"]
                if math.isnan(found):  # measured alone: nothing to compare with in its rounds
                    continue
                rows.append((name, f"{factor} times faster than {peer}", f"{found:.1f}", found >= factor))
        if "bullet_f64" in programs:
            fram, bullet = (programs[p]["penetration"] for p in ("fram", "bullet_f64"))
            for key, word in (("mean_m", "mean"), ("max_m", "largest")):
                rows.append((name, f"{word} overlap no worse than bullet_f64",
                             f"{1e3 * fram[key]:.3f} against {1e3 * bullet[key]:.3f} mm",
                             round(fram[key], 6) <= round(bullet[key], 6)))
    for cover in sorted({r["cover"] for r in result["loads"]}):
        for size in sorted({r["floes"] for r in result["loads"]}):
            loads = {r["program"]: r["kN"] for r in result["loads"] if (r["floes"], r["cover"]) == (size, cover)}
            if not {"fram", "bullet_f64", "ode"} <= set(loads):
                continue
            mean = {p: statistics.mean(kN) for p, kN in loads.items()}
            spread = {p: statistics.stdev(kN) / mean[p] for p, kN in loads.items()}
            # The spread of a mean of n seeds is that of one over sqrt(n).
            error = {p: 2 * spread[p] * mean[p] / math.sqrt(len(loads[p])) for p in ("bullet_f64", "ode")}
            low, high = min(mean[p] - e for p, e in error.items()), max(mean[p] + e for p, e in error.items())
            rows.append((f"{size} floes, {cover} %", "mean load within the peers' (two standard errors)",
                         f"{mean['fram']:.0f} in {low:.0f} to {high:.0f} kN", low <= mean["fram"] <= high))
            rows.append((f"{size} floes, {cover} %", "variation of the load at most 1.2 times bullet_f64's",
                         f"{spread['fram'] / spread['bullet_f64']:.2f}", spread["fram"] <= 1.2 * spread["bullet_f64"]))
    for r in result["threads"]:
        # Pairs count only while the machine has two cores to give.
        counted = [g for g, c in zip(r["gain"], r["copies"]) if c >= 1.9]
        gain = statistics.median(counted or r["gain"])
        note = f" ({len(counted)} pairs)" if counted else f", not counted: copies {statistics.median(r['copies']):.2f}"
        rows.append((f"{r['floes']} floes, 90 %", "two threads 1.7 times one while two copies reach 1.9",
                     f"{gain:.2f}{note}", bool(counted) and gain >= 1.7))
    return rows


def print_goals(result, file):
    rows = goal_rows(result)
    if not rows:
        return
    print("\n### Against the goals\n", file=file)
    print("| scene | goal | found | met |\n|---|---|---|---|", file=file)
    for scene, goal, found, met in rows:
        print(f"| {scene} | {goal} | {found} | {'yes' if met else 'no'} |", file=file)


def write_report(new, options):
    base = pathlib.Path(options.out)
    base.parent.mkdir(parents=True, exist_ok=True)
    store = base.with_suffix(".json")
    old = json.loads(store.read_text(encoding="utf-8")) if store.exists() and not options.fresh else {}
    result = merged(old, new, machine(options))
    store.write_text(json.dumps(result, indent=1) + "\n", encoding="utf-8")
    write_csv(result, base.with_suffix(".csv"))
    with open(base.with_suffix(".md"), "w", encoding="utf-8") as file:
        m = result["machine"]
        print(f"# Fram beside Bullet, ODE, Box3D and Jolt, {m['date']}\n", file=file)
        print(f"{told(m)}.  One thread on one core unless told; ratios are medians of those inside each round.",
              file=file)
        for scene in result["scenes"]:
            print_scene(scene, file)
            print_earlier(scene["programs"].items(), m, file)
        if result["loads"]:
            print("\n### Mean load on the ship over seeds\n", file=file)
            print("| floes | cover % | program | seeds | mean kN | coefficient of variation | least | largest |\n"
                  "|---|---|---|---|---|---|---|---|", file=file)
        for r in result["loads"]:
            print(f"| {r['floes']} | {r['cover']} | {r['program']} | {len(r['kN'])} | {statistics.mean(r['kN']):.0f} |"
                  f" {statistics.stdev(r['kN']) / statistics.mean(r['kN']):.3f} | {min(r['kN']):.0f} |"
                  f" {max(r['kN']):.0f} |", file=file)
        print_earlier([(f"{r['floes']} floes, {r['cover']} %, {r['program']}", r) for r in result["loads"]], m, file)
        if result["threads"]:
            print("\n### Two threads, 90 % cover\n", file=file)
            print("| floes | rounds | two threads against one | two copies of one thread |\n|---|---|---|---|",
                  file=file)
        for r in result["threads"]:
            print(f"| {r['floes']} | {len(r['gain'])} | {statistics.median(r['gain']):.2f} |"
                  f" {statistics.median(r['copies']):.2f} |", file=file)
        print_earlier([(f"{r['floes']} floes", r) for r in result["threads"]], m, file)
        print_goals(result, file)


def measure_threads(options):
    """Two threads against one, and what two independent copies can reach at the same time."""
    rows = []
    for size in options.sizes:
        scene = scene_of(size, 90)
        gains, copies = [], []
        for _ in range(options.repeat):
            one = run_fram(options, scene, "0,1")["ms_wall_median"]
            two = run_fram(options, scene, "0,1", "--threads", 2)["ms_wall_median"]
            words = [str(w) for w in ("taskset", "-c", 0, options.fram, "bench", "--scene", scene, "--dt", options.dt,
                                      "--iterations", options.iterations, "--time", options.time,
                                      "--warm", options.warm,
                                      "--solver", options.solver, "--json", "--quiet")]
            both = [subprocess.Popen(words[:2] + [str(k)] + words[3:], stdout=subprocess.PIPE, text=True)
                    for k in (0, 1)]
            walls = [json.loads(p.communicate()[0])["ms_wall_median"] for p in both]
            gains.append(one / two)
            copies.append(sum(one / w for w in walls))
            print(f"{size} floes: two threads {gains[-1]:.2f} times one, two copies {copies[-1]:.2f}", flush=True)
        rows.append({"floes": size, "gain": gains, "copies": copies})
    return {"threads": rows}


def measure_loads(options):
    """Mean ship load of each program over seeds of the scene."""
    programs = contestants(options, build_peers(options))
    rows = []
    for size in options.sizes:
        for cover in options.covers:
            loads = {name: [] for name in programs}
            for seed in range(1, options.loads + 1):
                scene = scene_of(size, cover, seed)
                for name, run in programs.items():
                    loads[name].append(run(scene, WORK / "poses.csv")["ship_force_kN"])
            rows += [{"floes": size, "cover": cover, "program": name, "kN": kN} for name, kN in loads.items()]
    return {"loads": rows}


def exact_water(options, scene):
    """Milliseconds of Fram's exact water: alone (bench/fluid_bench, other memory between the calls), and the whole
    stage of external forces in a step."""
    took = {}
    bench = pathlib.Path(options.fram).parent / "bench" / "fluid_bench"
    for line in command("taskset", "-c", options.core, bench, scene, 9).splitlines():
        found = re.match(r"(\w+)\s+water\s+cold.*fluid ([0-9.]+) ms", line)
        if found:
            took[f"Fram's water, {found[1]}"] = float(found[2])
            took[f"Fram's stage of forces, {found[1]}"] = run_fram(
                options, scene, options.core, "--exact-water", "--isa", found[1])["forces_ms"]
    return took


def measure_forces(options):
    peers = build_peers(options)
    for size in options.sizes:
        for cover in options.covers:
            scene, rounds = scene_of(size, cover), []
            for _ in range(options.repeat):
                took = {name: run_peer(options, program, scene)["forces_ms"] for name, program in peers.items()}
                rounds.append({**took, **exact_water(options, scene)})
            print(f"\n{size} floes, {cover} % cover, {options.repeat} rounds in turn, medians\n")
            print("| program | forces ms | over bullet_f64 | over bullet_f32 | over ode |\n|---|---|---|---|---|")
            for name in rounds[0]:
                ratios = [statistics.median(r[name] / r[peer] for r in rounds)
                          for peer in ("bullet_f64", "bullet_f32", "ode")]
                print(f"| {name} | {median_of(rounds, name):.3f} | " + " | ".join(f"{x:.2f}" for x in ratios) + " |",
                      flush=True)


def words_of_runs(about, covers, time, warm):
    """A parser with the words of every script that runs scenes by run_fram: which ones, how, and how often."""
    words = argparse.ArgumentParser(description=about, formatter_class=argparse.RawDescriptionHelpFormatter)
    words.add_argument("--repeat", type=int, default=3)
    words.add_argument("--covers", type=int, nargs="+", default=covers)
    words.add_argument("--dt", type=float, default=0.02)
    words.add_argument("--iterations", type=int, default=10)
    words.add_argument("--time", type=float, default=time)
    words.add_argument("--warm", type=float, default=warm)
    words.add_argument("--solver", default="fast")
    words.add_argument("--core", default="1")
    words.add_argument("--fram", default=str(ROOT / "build" / "release" / "fram"))
    return words


def main():
    words = words_of_runs(__doc__, covers=[75, 90], time=20, warm=5)
    words.add_argument("--sizes", type=int, nargs="+", default=[1000, 5000, 10000])
    words.add_argument("--isa", default="baseline", help="the second row of Fram; empty: none")
    words.add_argument("--programs", nargs="+", metavar="P",
                       help="some of fram, 'fram baseline', bullet_f32, bullet_f64, ode, box3d and jolt")
    words.add_argument("--box3d", type=pathlib.Path, metavar="DIR", help="sources of Box3D")
    words.add_argument("--jolt", type=pathlib.Path, metavar="DIR", help="sources of Jolt")
    words.add_argument("--substeps", type=int, default=4, help="of Box3D, which has no iterations")
    words.add_argument("--fresh", action="store_true", help="forget what was measured before")
    words.add_argument("--out", default=str(WORK / "peers"))
    words.add_argument("--threads-only", action="store_true")
    words.add_argument("--forces", action="store_true")
    words.add_argument("--loads", type=int, default=0, metavar="SEEDS")
    options = words.parse_args()
    if options.threads_only:
        write_report(measure_threads(options), options)
    elif options.forces:
        measure_forces(options)
    elif options.loads:
        write_report(measure_loads(options), options)
    else:
        write_report(measure_speed(options), options)


if __name__ == "__main__":
    main()
