"""Small scenes, runs and files that the parts of the campaign work on; made once."""

import json
import math
import shutil
import subprocess

import books

# Everything at once, small: breaking ice, lines, thrusters, positioning, frames, checkpoints.
SCENE = """
title: Everything at once
run: {duration: 2, time_step: 0.02, seed: 5}
vessel:
  mode: free
  speed: 5
  hull: {length: 48, beam: 12, draught: 4, freeboard: 2}
  mooring: {depth: 60, lines: [{count: 4, spacing_deg: 90, distance: 300, pretension: 2.0e5}]}
  thrusters: [{x: 18}, {x: -18, kind: main, rudder_deg: 25}]
  positioning: {active: true}
ice: {concentration: 0.8, mean_floe_area: 150, thickness: 0.3, breakable: true}
domain: {x_min: -64, x_max: 64, y_min: -40, y_max: 40, boundary: open}
environment: {current_speed: 3, current_direction_deg: 180}
output: {frame_interval: 0.2, checkpoint_interval: 0.3, picture_interval: 0.5}
"""
LEVEL = """
title: Level ice, crushed and broken
run: {duration: 1.6, time_step: 0.02}
vessel: {mode: towed, x: -10, speed: 4, hull: {length: 48, beam: 12, draught: 4, freeboard: 2}}
ice: {source: level, breakable: true, thickness: 0.3, level: {x_min: 12}}
domain: {x_min: -64, x_max: 64, y_min: -32, y_max: 32, boundary: open}
output: {frame_interval: 0.2, checkpoint_interval: 0.4}
"""
PACKED = """
title: Packed
run: {duration: 0.4, time_step: 0.02}
vessel: {mode: prescribed, speed: 1, hull: {length: 48, beam: 12, draught: 4, freeboard: 2}}
ice: {source: packed, concentration: 0.6, populations: [{diameter_min: 6, diameter_max: 12}]}
domain: {x_min: -48, x_max: 48, y_min: -24, y_max: 24, boundary: feeding}
environment: {current_speed: 1, current_direction_deg: 180}
output: {frame_interval: 0.1}
"""
STUDY = """
scenario: scene.yaml
set: {run.duration: 0.2, output.picture_interval: 0}
seeds: 2
vary: {grid: {environment.current_speed: [1, 2]}}
keep: series
"""
# A series to find extremes of: waves of two lengths that do not repeat.
TENSION = "time[s],tension[N]\n" + "".join(
    f"{i / 5:g},{1e5 + 2e4 * math.sin(i / 3) * math.sin(i / 7.1) + 3e3 * math.sin(i * i / 11):.6g}\n"
    for i in range(1500))
FLOES = """{"type":"FeatureCollection","features":[
{"type":"Feature","properties":{"thickness":0.8},"geometry":
 {"type":"Polygon","coordinates":[[[0,0],[9,0],[9,8],[0,8],[0,0]]]}},
{"type":"Feature","properties":{},"geometry":
 {"type":"Polygon","coordinates":[[[12,0],[20,1],[19,9],[11,8],[12,0]]]}},
{"type":"Feature","properties":{},"geometry":
 {"type":"Polygon","coordinates":[[[0,12],[18,12],[10,15],[9,22],[0,12]]]}}]}
"""


def make(rig, folder):
    """The inputs, by their names; runs done, level and half (stopped midway); a study, studied."""
    folder.mkdir(parents=True, exist_ok=True)
    for name, text in (("scene.yaml", SCENE), ("level.yaml", LEVEL), ("packed.yaml", PACKED),
                       ("study.yaml", STUDY), ("tension.csv", TENSION), ("floes.geojson", FLOES)):
        (folder / name).write_text(text, encoding="utf-8")
    shutil.copy(rig.root / "examples/hulls/ship_with_bulb.obj", folder / "hull.obj")
    for words in (("run", "scene.yaml", "-o", "done"), ("run", "level.yaml", "-o", "level"),
                  ("run", "scene.yaml", "-o", "half", "--until", "1.4"),
                  ("study", "study.yaml", "-o", "studied")):
        subprocess.run([rig.fram.path, *words, "-q"], cwd=folder, check=True)
    for run in ("done", "level", "half"):
        if not broke_ice(folder / run):
            raise RuntimeError(f"the run {run} of the fixture breaks no ice: a fault in it would touch nothing")
    return folder


def broke_ice(run):
    """Loads and breaks: what is injected meets contacts and fracture."""
    series = books.columns(run / "series.csv")
    return any(series["ice_force_x"]) and series["bendings"][-1] + series["splits"][-1] > 0


def get(rig):
    """The folder of the fixture."""
    return rig.once("fixture", lambda folder: make(rig, folder))


def copy(rig, folder):
    """A copy that a case may spoil."""
    shutil.rmtree(folder, ignore_errors=True)
    shutil.copytree(get(rig), folder)
    return folder


def contents(folder):
    """Name -> what a file holds that does not tell the time of computing."""
    held = {}
    for path in sorted(p for p in folder.rglob("*") if p.is_file()):
        name = str(path.relative_to(folder))
        if path.name.startswith("checkpoint-"):
            # Tells what recording has cost.
            held[name] = "a checkpoint"
        elif path.name == "series.csv":
            held[name] = books.without_wall(path)
        elif path.name == "run.json":
            run = json.loads(path.read_text())
            held[name] = {k: v for k, v in run.items()
                          if "wall" not in k and not k.startswith("recording") and k != "threads"}
        else:
            # A study notes where its scenario lies.
            held[name] = path.read_bytes().replace(str(folder.resolve()).encode(), b"")
    return held
