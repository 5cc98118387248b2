"""Small scenes, runs and files that the parts of the campaign work on; made once."""

import json
import shutil
import subprocess

import books

# Everything at once, small: breaking ice, lines, thrusters, positioning, frames, checkpoints.
SCENE = """
title: Everything at once
run: {duration: 1.2, time_step: 0.02, seed: 5}
vessel:
  mode: free
  hull: {length: 48, beam: 12, draught: 4, freeboard: 2}
  mooring: {depth: 60, lines: [{count: 4, spacing_deg: 90, distance: 300, pretension: 2.0e5}]}
  thrusters: [{x: 18}, {x: -18, kind: main, rudder_deg: 25}]
  positioning: {active: true}
ice: {concentration: 0.75, mean_floe_area: 100, thickness: 0.3, breakable: true}
domain: {x_min: -64, x_max: 64, y_min: -40, y_max: 40, boundary: open}
environment: {current_speed: 3, current_direction_deg: 180}
output: {frame_interval: 0.2, checkpoint_interval: 0.3, picture_interval: 0.5}
"""
LEVEL = """
title: Level ice, crushed and broken
run: {duration: 1, time_step: 0.02}
vessel: {mode: towed, x: -10, speed: 3, hull: {length: 48, beam: 12, draught: 4, freeboard: 2}}
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
FLOES = """{"type":"FeatureCollection","features":[
{"type":"Feature","properties":{"thickness":0.8},"geometry":
 {"type":"Polygon","coordinates":[[[0,0],[9,0],[9,8],[0,8],[0,0]]]}},
{"type":"Feature","properties":{},"geometry":
 {"type":"Polygon","coordinates":[[[12,0],[20,1],[19,9],[11,8],[12,0]]]}},
{"type":"Feature","properties":{},"geometry":
 {"type":"Polygon","coordinates":[[[0,12],[18,12],[10,15],[9,22],[0,12]]]}}]}
"""


def make(rig, folder):
    """scene.yaml, level.yaml, packed.yaml, floes.geojson, hull.obj; runs done, level and half (stopped midway)."""
    folder.mkdir(parents=True, exist_ok=True)
    for name, text in (("scene.yaml", SCENE), ("level.yaml", LEVEL), ("packed.yaml", PACKED),
                       ("floes.geojson", FLOES)):
        (folder / name).write_text(text, encoding="utf-8")
    shutil.copy(rig.root / "examples/hulls/ship_with_bulb.obj", folder / "hull.obj")
    for words in (("run", "scene.yaml", "-o", "done"), ("run", "level.yaml", "-o", "level"),
                  ("run", "scene.yaml", "-o", "half", "--until", "0.6")):
        subprocess.run([rig.fram.path, *words, "-q"], cwd=folder, check=True)
    return folder


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
            held[name] = path.read_bytes()
    return held
