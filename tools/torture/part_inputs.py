"""Mutated inputs of every kind: a reader refuses them with a place and a reason, or takes them; nothing else."""

import fixture
import mangle
from finding import Case

NAME = "inputs"
SAYS = "scenarios, floes, meshes and tables with random damage, through the commands that read them"

TABLE_SCENE = """
run: {{duration: 0.1, time_step: 0.02}}
vessel: {{mode: free, hull: {{length: 48, beam: 12, draught: 4, freeboard: 2}}{vessel}}}
ice: {{source: {source}, mean_floe_area: 100{ice}}}
domain: {{x_min: -64, x_max: 64, y_min: -32, y_max: 32{domain}}}
environment: {{current_speed: 1{environment}}}
"""
DRIFT = b"time[s],x[m/s],y[m/s]\n0,-0.5,0\n300,-0.5,0.1\n600,-0.4,0.2\n"
FLOW = b"angle[deg],cx[1],cy[1],cn[1]\n0,1,0,0\n90,0,1,0.1\n180,-1,0,0\n"
LINE = b"offset[m],tension[N]\n-10,0\n0,100000\n50,900000\n"
HISTOGRAM = b"diameter_min[m],diameter_max[m],floes[1]\n5,8,10\n8,12,4\n"
PROFILE = b"depth[m],x[m/s],y[m/s]\n0,0.1,0\n5,0.05,0\n20,0,0\n"


def scene(**parts):
    whole = {"vessel": "", "source": "voronoi", "ice": "", "domain": "", "environment": "", **parts}
    return TABLE_SCENE.format(**whole).encode()


# name of the input, scene that reads it (None: the input itself is read), words
TABLES = (
    ("wind.csv", DRIFT, scene(environment=", wind_speed: 5, wind_file: wind.csv").replace(b"wind_speed: 5, ", b"")),
    ("current.csv", DRIFT, scene(environment=", current_file: current.csv").replace(b"current_speed: 1, ", b"")),
    ("profile.csv", PROFILE, scene(environment=", current_profile_file: profile.csv")),
    ("drift.csv", DRIFT, scene(domain=", boundary: feeding, drift_file: drift.csv")),
    ("flow.csv", FLOW, scene(vessel=", current_coefficients: {table_file: flow.csv}")),
    ("line.csv", LINE, scene(vessel=", mooring: {lines: [{kind: table, table_file: line.csv, distance: 300}]}")),
    ("histogram.csv", HISTOGRAM, scene(source="packed", ice=", concentration: 0.4, populations: "
                                       "[{size: histogram, histogram: histogram.csv}]")),
    ("templates.geojson", fixture.FLOES.encode(), scene(
        source="packed", ice=", concentration: 0.4, populations: [{shape: templates, templates: templates.geojson, "
        "diameter_min: 6, diameter_max: 12}]")),
    ("water.geojson", fixture.FLOES.encode(), scene(ice=", open_water_file: water.geojson")),
    ("floes.geojson", fixture.FLOES.encode(), scene(source="file", ice=", file: floes.geojson, bad_rings: repair")),
)


def seeds(rig):
    """(kind, data) of the files that a fuzzer begins with, and of the ready scenes."""
    def make(_):
        found = []
        for kind in ("scenario", "geojson", "outlines", "obj", "stl", "gdf", "scene"):
            for path in sorted((rig.root / "fuzz/corpus" / kind).iterdir()):
                found.append((kind, path.read_bytes()))
        for path in sorted((rig.root / "scenes").glob("*.yaml")):
            found.append(("scenario", path.read_bytes()))
        found.append(("obj", (rig.root / "examples/hulls/ship_with_bulb.obj").read_bytes()))
        return found
    return rig.once("seeds", make)


def words_for(draw, kind, folder, data):
    """The file written, and the call that reads it."""
    suffix = {"scenario": "yaml", "outlines": "wkt"}.get(kind, kind)
    name = "a." + suffix
    path = folder / name
    path.write_bytes(data)
    if kind == "scenario":
        return ["check", path] if draw.random() < 0.8 else ["field", path]
    if kind == "scene":
        return ["bench", "--scene", path, "--time", "0.05", "--warm", "0"]
    if kind in ("geojson", "outlines"):
        more = draw.choice(([], ["--bad", "drop"], ["--bad", "repair"], ["--bad", "repair", "--simplify", "0.5"],
                            ["--crop", "-10,-10,15,15"], ["-o", folder / "out.geojson"],
                            ["--table", folder / "t.csv", "--cover", folder / "c.png"]))
        return ["field", path, *more]
    more = draw.choice(([], ["--draught", "3"], ["--repair"], ["--repair", "--freeboard", "2"],
                        ["-o", folder / "o.stl"],
                        ["--draw", folder / "d.png"]))
    return ["hull", path, *more]


def case(rig, draw, folder):
    """One damaged input."""
    done = Case()
    if draw.random() < 0.5:
        name, data, text = draw.choice(TABLES)
        data = mangle.mangle(draw, data)
        (folder / name).write_bytes(data)
        (folder / "a.yaml").write_bytes(text)
        kind, words = name, ["run", folder / "a.yaml", "-o", folder / "run"]
        files = {name: data, "a.yaml": text.decode()}
    else:
        kind, data = draw.choice(seeds(rig))
        data = mangle.mangle(draw, data)
        words = words_for(draw, kind, folder, data)
        files = {words[words.index("--scene") + 1].name if kind == "scene" else words[1].name: data}
    outcome = rig.fram.call(*words, "--json")
    fault = outcome.fault(json_asked=True)
    done.counts["taken" if outcome.code == 0 else "refused" if outcome.code == 2 else "ended with a diagnosis"] += 1
    if fault:
        done.found(f"{kind}: {words[0]} {fault}", outcome, files)
    return done
