#!/usr/bin/env python3
"""Exports read by the programs they are for: VTK's own readers, xarray, h5py, pandas.

A run with breaking ice, mooring and thrusters is exported and read back; the numbers are compared with series.csv and
with each other.  Readers that are missing are skipped by name; without any the test is skipped (77).
"""
import importlib.util
import json
import math
import os
import pathlib
import random
import re
import shutil
import subprocess
import sys
import tempfile

import chromium

FRAM = os.environ["FRAM"]
READERS = ("vtkmodules", "xarray", "netCDF4", "h5py", "pandas")
# In coordinates of a map, where floats are a decimetre apart.
SCENE = """
title: Export test
run: {duration: 6, time_step: 0.02, seed: 3}
vessel:
  mode: free
  x: -1400000
  y: 2000000
  hull: {length: 48, beam: 12, draught: 4, freeboard: 2}
  mooring: {depth: 60, lines: [{count: 4, spacing_deg: 90, distance: 300, pretension: 2.0e5}]}
  thrusters: [{x: 18}]
ice: {concentration: 0.7, mean_floe_area: 64, thickness: 0.15, breakable: true}
domain: {x_min: -1400064, x_max: -1399936, y_min: 1999960, y_max: 2000040, boundary: open}
environment: {current_speed: 3, current_direction_deg: 180}
output: {frame_interval: 0.5}
"""


def have(name):
    return importlib.util.find_spec(name) is not None


def use_system_python():
    """Debian's modules belong to Debian's Python, which need not be the first on the path."""
    system = "/usr/bin/python3"
    if not have("vtkmodules") and os.path.exists(system) and "FRAM_TRIED" not in os.environ:
        os.execve(system, [system, *sys.argv], {**os.environ, "FRAM_TRIED": "1"})


def fram(*words):
    return subprocess.run([FRAM, *map(str, words)], check=True, capture_output=True, text=True).stdout


def close(a, b, tolerance):
    assert abs(a - b) <= tolerance, (a, b)


def rows_of(path):
    head, *lines = path.read_text().splitlines()
    return [dict(zip(head.split(","), map(float, line.split(",")))) for line in lines]


def read_vtp(path):
    from vtkmodules.vtkIOXML import vtkXMLPolyDataReader
    reader = vtkXMLPolyDataReader()
    reader.SetFileName(str(path))
    reader.Update()
    assert reader.GetErrorCode() == 0, path
    return reader.GetOutput()


def check_vtk(run, rows):
    import xml.etree.ElementTree as tree
    from vtkmodules.vtkCommonCore import vtkIdList
    fram("export", run, "--vtk", "-q")
    files = [d.attrib for d in tree.parse(run / "vtk" / "run.pvd").iter("DataSet")]
    assert len(files) == 3 * 13, len(files)
    assert sorted({f["part"] for f in files}) == ["0", "1", "2"]
    for f in files:
        data = read_vtp(run / "vtk" / f["file"])
        close(data.GetFieldData().GetArray("TimeValue").GetValue(0), float(f["timestep"]), 0)
    floes, cells = read_vtp(run / "vtk" / "data" / "floes_000012.vtp"), vtkIdList()
    data = floes.GetCellData()
    column = {data.GetArrayName(i): data.GetArray(i) for i in range(data.GetNumberOfArrays())}
    assert {"velocity [m/s]", "contact force [N]", "thickness [m]", "age [s]", "floe"} <= set(column), column.keys()
    number = {int(column["floe"].GetValue(i)) for i in range(floes.GetNumberOfCells())}
    assert len(number) == rows[-1]["floes[1]"], (len(number), rows[-1]["floes[1]"])
    # The first cell of the first floe is its top: as large as its area field says.
    floes.GetCellPoints(0, cells)
    ring = [floes.GetPoint(cells.GetId(i)) for i in range(cells.GetNumberOfIds())]
    area = sum(a[0] * b[1] - b[0] * a[1] for a, b in zip(ring, ring[1:] + ring[:1])) / 2
    close(area, column["area [m2]"].GetValue(0), 0.01 * area)
    forces = read_vtp(run / "vtk" / "data" / "forces_000012.vtp").GetCellData()
    lines = [i for i in range(forces.GetArray("kind").GetNumberOfTuples()) if forces.GetArray("kind").GetValue(i) == 2]
    assert len(lines) == 4, lines
    number, size = forces.GetArray("number"), forces.GetArray("magnitude [N]")
    assert [number.GetValue(i) for i in lines] == [1, 2, 3, 4]
    for i in range(size.GetNumberOfTuples()):
        close(size.GetValue(i), math.hypot(*forces.GetArray("force [N]").GetTuple3(i)), 1e-6 * size.GetValue(i))
    hull = read_vtp(run / "vtk" / "data" / "hull_000012.vtp").GetCellData()
    load = hull.GetArray("ice force, averaged [N]").GetTuple3(0)
    for value, axis in zip(load, "xyz"):
        close(value, rows[-1][f"ice_force_averaged_{axis}[N]"], 1e-6 * math.hypot(*load))
    assert hull.GetArray("vessel").GetValue(0) == 1
    pull = sum(forces.GetArray("force [N]").GetTuple3(i)[0] for i in lines)
    close(pull, rows[-1]["mooring_force_x[N]"], 3000)
    before = sorted(p.name for p in (run / "vtk").rglob("*"))
    assert not [n for n in before if n.endswith(".new")], before
    fram("export", run, "--vtk", "-q", "--every", 4)
    assert len(list(tree.parse(run / "vtk" / "floes.pvd").iter("DataSet"))) == 4
    return "VTK"


def files_of(folder):
    return {p.relative_to(folder).as_posix(): p.read_bytes() for p in folder.rglob("*") if p.is_file()}


def check_restart(folder, straight):
    """A series that was exported from half a run goes on after resume, and is that of a run in one go."""
    half = folder / "half"
    fram("run", folder / "scene.yaml", "-o", half, "-q", "--until", 3)
    fram("export", half, "--vtk", "-q")
    before = files_of(half / "vtk")
    fram("resume", half, "-q")
    fram("export", half, "--vtk", "-q")
    after = files_of(half / "vtk")
    fram("export", straight, "--vtk", "-q")
    assert after == files_of(straight / "vtk"), "a resumed run exports other files than one in one go"
    kept = [name for name, data in before.items() if "data/" in name and after[name] == data]
    # The velocities of a record's last frame are those of the frame before, until there is a next one.
    assert len(before) < len(after) and len(kept) >= 6 * 3, (len(before), len(after), len(kept))
    if "netcdf" in subprocess.run([FRAM, "--version"], capture_output=True, text=True, check=True).stdout:
        fram("export", half, "--netcdf", "-q")
        assert (half / "run.nc").stat().st_size > 0


def prisms(path):
    """By number of the floe: its fields, and the corners of top and bottom."""
    import numpy
    from vtkmodules.vtkCommonCore import vtkIdList
    floes, found, ids = read_vtp(path), {}, vtkIdList()
    fields = [floes.GetCellData().GetArray(i) for i in range(floes.GetCellData().GetNumberOfArrays())]
    for cell in range(floes.GetNumberOfCells()):
        told = {a.GetName(): a.GetTuple(cell) for a in fields}
        floes.GetCellPoints(cell, ids)
        rings = found.setdefault(int(told["floe"][0]), (told, []))[1]
        if len(rings) < 2:  # then come the sides
            rings.append(numpy.array([floes.GetPoint(ids.GetId(i)) for i in range(ids.GetNumberOfIds())]))
    return found


def centre_of(ring):
    """Of a flat ring: triangles of a fan, weighed by their areas."""
    import numpy
    arms = ring[1:] - ring[0]
    areas = numpy.cross(arms[:-1], arms[1:])[:, 2]
    return ring[0] + areas @ (arms[:-1] + arms[1:]) / 3 / areas.sum()


def rotation(angles):
    """Of axes that are rolled, then pitched, then turned, all in degrees."""
    import numpy
    (ch, sh), (cr, sr), (cp, sp) = ((math.cos(math.radians(a)), math.sin(math.radians(a))) for a in angles)
    return numpy.array([[ch * cp, ch * sp * sr - sh * cr, ch * sp * cr + sh * sr],
                        [sh * cp, sh * sp * sr + ch * cr, sh * sp * cr - ch * sr], [-sp, cp * sr, cp * cr]])


def check_floes(data, run):
    """Every column of the floes in run.nc by the prisms of the VTK files, whose corners know of no angles."""
    begin, now = (prisms(run / "vtk" / "data" / f"floes_{frame:06d}.vtp") for frame in (0, 11))
    angles = [[data[f"floe_{name}"].values[frame] for name in ("heading", "roll", "pitch")] for frame in (0, 11)]
    at = {n: v.values[11] if v.ndim == 2 else v.values for n, v in data.items()}
    time, tilted = data["frame"].values[11], 0
    assert {n for n, v in enumerate(data["floe"].values) if math.isfinite(at["floe_x"][n])} == \
        {n for n, v in enumerate(data["floe"].values) if int(v) in now}
    for k, (told, (top, bottom)) in ((list(data["floe"].values).index(n), f) for n, f in now.items()):
        centre, up = (centre_of(top) + centre_of(bottom)) / 2, centre_of(top) - centre_of(bottom)
        for name, value in (("velocity_x", told["velocity [m/s]"][0]), ("velocity_y", told["velocity [m/s]"][1]),
                            ("contact_force", told["contact force [N]"][0]), ("area", told["area [m2]"][0]),
                            ("thickness", told["thickness [m]"][0]), ("mass", told["mass [kg]"][0]),
                            ("birth", time - told["age [s]"][0]), ("parent", told["parent"][0])):
            close(at[f"floe_{name}"][k], value, 1e-6 * max(1, abs(value)))
        for axis, value in zip("xyz", centre):
            close(at[f"floe_{axis}"][k], value, 1e-3)
        turn = rotation([a[k] for a in angles[1]])
        assert abs(turn[:, 2] * told["thickness [m]"][0] - up).max() < 1e-3, (k, turn, up)
        tilted += abs(at["floe_roll"][k]) > 2 and abs(at["floe_pitch"][k]) > 2
        if int(told["floe"][0]) in begin:
            before = begin[int(told["floe"][0])][1][0]
            edge = turn @ rotation([a[k] for a in angles[0]]).T @ (before[1] - before[0])
            assert abs(edge - (top[1] - top[0])).max() < 5e-3, (k, edge)
    assert tilted > 0, "no floe is rolled and pitched"


def check_properties(data, run):
    """What a feature of the GeoJSON file tells is what run.nc tells at that frame."""
    import numpy
    fram("export", run, "--geojson", "--time", 5.5, "-q")
    row, broken = {int(n): k for k, n in enumerate(data["floe"].values)}, 0
    for feature in json.loads((run / "field-5.5.geojson").read_text())["features"]:
        told, (ring, *_) = feature["properties"], feature["geometry"]["coordinates"]
        if told["kind"] != "floe":
            continue
        at = data.isel(frame=11, floe=row[told["floe"]])
        for name in ("thickness", "area", "velocity_x", "velocity_y", "contact_force"):
            close(told[name], float(at[f"floe_{name}"]), 1e-6 * max(1, abs(told[name])))
        close(told["age"], 5.5 - float(at["floe_birth"]), 1e-9)
        assert (told.get("parent") or -1) == int(at["floe_parent"]), told
        broken += int(at["floe_parent"]) >= 0
        centre = centre_of(numpy.array([[*p, 0] for p in ring[:-1]]))
        for axis, value in zip("xy", centre):
            close(float(at[f"floe_{axis}"]), value, 0.1)  # a tilted floe is seen from above
    assert broken > 0, "no piece of a floe"


# The reader of the playback page by itself; it needs no browser.
READ_RECORD = """
import { readFileSync } from 'node:fs';
import { FrameStore, readRecord } from './record.mjs';
const record = readRecord(Uint8Array.from(readFileSync(process.argv[2])).buffer), store = new FrameStore(record, null);
const frames = record.frames.map((f, n) => {
    const { poses, contact, forces } = store.get(n);
    return { time: f.time, force: f.force, order: [...f.order], poses: [...poses], contact: [...contact], forces };
});
console.log(JSON.stringify({ frames, origin: record.origin, fractures: record.fractures,
    bodies: record.bodies.map((b) => ({ ...b, outline: 0, vertices: 0, triangles: 0 })) }));
"""


# A ship in a sheet that drifts.
SHEET = """
run: {duration: 4, time_step: 0.02}
vessel: {mode: prescribed, x: -12, speed: 3, hull: {length: 40, beam: 10, draught: 4, freeboard: 2}}
ice: {source: level, thickness: 0.4, breakable: true, level: {x_min: 10, tile_size: 10}}
domain: {x_min: -40, x_max: 60, y_min: -30, y_max: 30, boundary: feeding, drift_speed: 1, drift_direction_deg: 180}
output: {frame_interval: 1}
"""
# A floe that the first frame alone has, in a domain without walls.
LONE = """
run: {duration: 1, time_step: 0.02}
vessel: {mode: prescribed, x: -20, speed: 3, hull: {length: 40, beam: 10, draught: 4, freeboard: 2}}
ice: {source: floes, thickness: 0.3, breakable: true, floes: [{length: 40, width: 60, x: 20.5}]}
domain: {x_min: -64, x_max: 64, y_min: -40, y_max: 44, boundary: open}
output: {frame_interval: 1}
"""
# Where floes are between frames, by their numbers: [x, y, speed, whether the next frame lacks them].
SHOW_POSES = """
import { readFileSync } from 'node:fs';
import { FrameStore, readRecord } from './record.mjs';
import { Poses } from './poses.mjs';
const record = readRecord(Uint8Array.from(readFileSync(process.argv[2])).buffer), out = [];
const poses = new Poses(record, new FrameStore(record, { lost: new Set() })), [east, north] = record.origin;
for (const when of process.argv.slice(3).map(Number)) {
    poses.show(when);
    out.push(Object.fromEntries(record.bodies.filter((b) => poses.shown[b.index] && b.number >= 0).map((b) =>
        [b.number, [poses.pose[7 * b.index] + east, poses.pose[7 * b.index + 1] + north, poses.speed[b.index],
                    b.death === Math.floor(when) + 1]])));
}
console.log(JSON.stringify(out));
"""


def ask_viewer(script, *words):
    """What files of the playback page say by themselves in Node."""
    with tempfile.TemporaryDirectory() as folder:
        for name in ("record", "poses"):
            shutil.copy(pathlib.Path(os.environ["FRAM_SOURCE"]) / f"viewer/src/{name}.js", f"{folder}/{name}.mjs")
        (pathlib.Path(folder) / "ask.mjs").write_text(script)
        return json.loads(subprocess.run(["node", f"{folder}/ask.mjs", *map(str, words)], check=True,
                                         capture_output=True, text=True).stdout)


def middle_of(ring):
    """Of what is seen of a floe from above."""
    x, y = ring[0]
    sides = [((a - x) * (d - y) - (c - x) * (b - y), a + c + x, b + d + y) for (a, b), (c, d) in zip(ring, ring[1:])]
    return [sum(s[0] * s[k] for s in sides) / sum(s[0] for s in sides) / 3 for k in (1, 2)]


def check_between(folder, run):
    """Between frames the page has floes where the library has them, those too that break before the next one, of which
    none in a sheet that drifts rests, though it broke from one that no frame has."""
    (folder / "sheet.yaml").write_text(SHEET)
    fram("run", folder / "sheet.yaml", "-o", folder / "sheet", "-q")
    for run, span, *whens in (run, 0.5, 6.6, 11.6), (folder / "sheet", 1, 1.6, 3.6):
        gone = 0
        for when, seen in zip(whens, ask_viewer(SHOW_POSES, run / "record.fram", *whens), strict=True):
            fram("export", run, "--geojson", "--time", f"{span * when:g}", "-q")
            field = json.loads((run / f"field-{span * when:g}.geojson").read_text())["features"]
            floes = [(f["properties"], f["geometry"]["coordinates"][0]) for f in field
                     if f["properties"]["kind"] == "floe"]
            assert {str(told["floe"]) for told, _ in floes} == set(seen)
            for told, ring in floes:
                x, y, speed, ends = seen[str(told["floe"])]
                assert math.dist((x, y), middle_of(ring)) < 0.1, (run, when, told, x, y, middle_of(ring))
                close(speed, math.hypot(told["velocity_x"], told["velocity_y"]), 1e-3)
                assert speed > 0 or run.name != "sheet", told
                gone += ends and speed * 0.6 * span > 0.2
        assert gone > 3, f"{gone} floes that are fast break in {run}"
    (folder / "lone.yaml").write_text(LONE)
    fram("run", folder / "lone.yaml", "-o", folder / "lone", "-q")
    (seen,) = ask_viewer(SHOW_POSES, folder / "lone" / "record.fram", 0.5)
    assert seen["0"][2:] == [0, True], seen


def check_viewer(data, run, rows):
    """The playback page reads of a record what the library reads of it."""
    import numpy
    record = ask_viewer(READ_RECORD, run / "record.fram")
    frame, row = record["frames"][11], {int(n): k for k, n in enumerate(data["floe"].values)}
    assert [f["time"] for f in record["frames"]] == list(data["frame"].values)
    at, floes = {n: v.values[11] if v.ndim == 2 else v.values for n, v in data.items()}, 0
    origin = dict(zip("xyz", (*record["origin"], 0)))
    for place, index in enumerate(frame["order"]):
        body, (*centre, x, y, z, w) = record["bodies"][index], frame["poses"][7 * place:7 * place + 7]
        if body["material"] != "ice":
            continue
        k, floes = row[body["number"]], floes + 1
        for name, value in zip(("x", "y", "z", "contact_force", "area", "thickness", "mass", "parent"),
                               (*centre, 1e3 * frame["contact"][place], body["area"], body["thickness"],
                                body["area"] * body["thickness"] * body["density"], body["parent"])):
            close(at[f"floe_{name}"][k] - origin.get(name, 0), value, 1e-5 * max(1, abs(value)))
        # The page tells floes from their first frame on.
        assert 0 <= record["frames"][body["birth"]]["time"] - at["floe_birth"][k] < 0.5
        turn = rotation([at[f"floe_{name}"][k] for name in ("heading", "roll", "pitch")])
        own = numpy.array([[1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
                           [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
                           [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)]])
        assert abs(turn - own).max() < 1e-5, (body["number"], turn, own)
    assert floes == numpy.isfinite(at["floe_x"]).sum()
    for axis, value in zip("xyz", frame["force"]):
        close(value, rows[274][f"ice_force_averaged_{axis}[N]"], 1e-6)
    lines = [f for f in frame["forces"] if f["kind"] == "line"]
    assert [f["which"] for f in lines] == [1, 2, 3, 4]
    close(sum(f["force"][0] for f in lines), rows[274]["mooring_force_x[N]"], 3000)
    for told, event in zip(record["fractures"], rows_of(run / "fractures.csv"), strict=True):
        assert told["kind"] == ("", "split", "bending", "loose")[int(event["kind[1]"])]
        for name, head in (("time", "time[s]"), ("floe", "floe[1]"), ("pieces", "pieces[1]"), ("load", "load[N]"),
                           ("crack", "crack_length[m]"), ("area", "floe_area[m2]")):
            close(told[name], event[head], 1e-6 * abs(event[head]))
        for axis, value in zip("xyz", told["place"]):
            close(value, event[f"place_{axis}[m]"] - origin[axis], 1e-5)


def check_netcdf(run, rows):
    done = []
    fram("export", run, "--netcdf", "-q")
    if have("xarray") and have("netCDF4"):
        import xarray
        with xarray.open_dataset(run / "run.nc") as data:
            assert data.sizes["time"] == len(rows) and data.sizes["frame"] == 13
            assert data["ice_force_x"].attrs["units"] == "N"
            breaks = rows_of(run / "fractures.csv")
            assert breaks and data.sizes["fracture"] == len(breaks)
            for table, prefix in ((rows, ""), (breaks, "fracture_")):
                for head in table[0]:
                    name, unit = head[:-1].split("[")
                    column = data[prefix + name]
                    assert column.attrs["units"] == unit and list(column.values) == [r[head] for r in table], head
            birth, between = dict(zip(data["floe"].values, data["floe_birth"].values)), 0
            assert "break" in data["floe_birth"].attrs["long_name"]
            for event in breaks:
                first, time = int(event["first_piece[1]"]), event["time[s]"]
                for number in range(first, first + int(event["pieces[1]"])):
                    close(birth.get(number, time), time, 1e-9)
                    between += number in birth and abs(time / 0.5 - round(time / 0.5)) > 1e-6
            assert between > 0, "no floe broke between two frames"
            late = data["position_x"].sel(time=4.0, method="nearest")
            close(float(late), rows[199]["position_x[m]"], 0)
            assert int(data["floe_x"].isel(frame=-1).notnull().sum()) == rows[-1]["floes[1]"]
            speed = data["floe_velocity_x"].isel(frame=5, floe=0) * 0.5
            way = data["floe_x"].isel(floe=0)
            close(float(speed), float(way[6] - way[5]), 1e-4)
            if have("vtkmodules"):
                check_floes(data, run)
            check_properties(data, run)
            if shutil.which("node"):
                check_viewer(data, run, rows)
                done.append("the playback page")
        done.append("xarray")
    if have("h5py"):
        import h5py
        with h5py.File(run / "run.nc") as file:
            assert file["time"].shape == (len(rows),)
            assert file["floe_contact_force"].shape[0] == 13
        done.append("h5py")
    return done


def check_csv(run):
    import pandas
    table = pandas.read_csv(run / "series.csv")
    assert table["time[s]"].is_monotonic_increasing and not table.isna().any().any()
    events = pandas.read_csv(run / "fractures.csv")
    assert "load[N]" in events.columns
    return "pandas"


def check_geojson(run, rows):
    fram("export", run, "--geojson", "--time", 5.9, "-q")
    field = json.loads((run / "field-5.9.geojson").read_text())
    close(field["time"], 5.9, 1e-9)
    kinds = [f["properties"]["kind"] for f in field["features"]]
    before = rows[-26]  # of the frame at 5.5 s: what breaks after it is whole until the next one
    assert kinds.count("vessel") == 1 and abs(kinds.count("floe") - before["floes[1]"]) <= 2
    vessel = field["features"][kinds.index("vessel")]["geometry"]["coordinates"][0]
    xs = [p[0] for p in vessel]
    assert vessel[0] == vessel[-1] and 47 < max(xs) - min(xs) < 56
    fram("field", run / "field-5.9.geojson", "-q", "--json")  # Fram reads what it writes
    bad = subprocess.run([FRAM, "export", run, "--geojson", "--time", "7"], capture_output=True, text=True, check=False)
    assert bad.returncode == 2 and "ends at 6 s" in bad.stderr, bad.stderr
    return "json"


CATAMARAN = """
run: {duration: 0.04, time_step: 0.02}
vessels:
  - {name: cat, mode: prescribed, x: -1400000, y: 700, heading_deg: 90, hull: {form: file, file: cat.obj}}
  - {name: ship, mode: prescribed, x: -1399950, y: 700, hull: {form: box, length: 20, beam: 8, draught: 3}}
ice: {source: floes, floes: [{x: -1400000, y: 740, length: 6, width: 6}]}
domain: {x_min: -1400050, x_max: -1399900, y_min: 650, y_max: 750, boundary: open}
output: {frame_interval: 0.02}
"""


def pontoon(y, first):
    """Of 40 by 4 m, as an OBJ file has it whose vertices begin with the first."""
    corners = [f"v {x} {y + dy} {z}" for z in (-3, 2) for dy in (-2, 2) for x in (-20, 20)]
    faces = ((0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5))
    return "\n".join([*corners, *("f " + " ".join(str(first + k) for k in face) for face in faces), ""])


def fine_box(y, cells, place):
    """The same box with squares of triangles on its faces, as an OBJ file has them.  place: of each vertex, grows."""
    corner = [(-20, y - 2, -3), (20, y + 2, 2)]
    at = [[low + (high - low) * i / cells for i in range(cells + 1)] for low, high in zip(*corner)]
    faces = []
    for axis in range(3):
        p, q = (axis + 1) % 3, (axis + 2) % 3
        for end in (0, cells):
            for i in range(cells):
                for k in range(cells):
                    square = []
                    for di, dk in ((0, 0), (1, 0), (1, 1), (0, 1)):
                        index = [0, 0, 0]
                        index[axis], index[p], index[q] = end, i + di, k + dk
                        point = tuple(at[n][index[n]] for n in range(3))
                        square.append(place.setdefault(point, len(place) + 1))
                    square = square if end else square[::-1]
                    faces += [(square[0], square[1], square[2]), (square[0], square[2], square[3])]
    return faces


def check_fine_hull(folder):
    """A catamaran of thousands of triangles in any order has the same two parts, and takes no longer for that."""
    place = {}
    faces = fine_box(-8, 20, place) + fine_box(8, 20, place)
    random.Random(3).shuffle(faces)
    (folder / "cat.obj").write_text("".join(f"v {x} {y} {z}\n" for x, y, z in place) +
                                    "".join("f {} {} {}\n".format(*face) for face in faces))
    run = folder / "fine"
    fram("run", folder / "cat.yaml", "-o", run, "-q")
    subprocess.run([FRAM, "export", run, "--geojson", "--time", "0.02", "-q"], check=True, timeout=20)
    told = json.loads((run / "field-0.02.geojson").read_text())["features"][0]["geometry"]
    assert told["type"] == "MultiPolygon" and len(told["coordinates"]) == 2, told["type"]


def check_open_hull(folder):
    """Water between the hulls of a catamaran is no hull, in files and in pictures."""
    (folder / "cat.obj").write_text(pontoon(-8, 1) + pontoon(8, 9))
    (folder / "cat.yaml").write_text(CATAMARAN)
    run = folder / "cat"
    fram("run", folder / "cat.yaml", "-o", run, "-q")
    fram("export", run, "--geojson", "--time", 0.02, "-q")
    told = json.loads((run / "field-0.02.geojson").read_text())["features"]
    assert [(f["properties"]["kind"], f["geometry"]["type"]) for f in told] == [
        ("vessel", "MultiPolygon"), ("vessel", "Polygon"), ("floe", "Polygon")], told
    assert [f["properties"]["id"] for f in told] == [0, 1, 2] and told[0]["properties"]["name"] == "cat"
    (one, *none), (two, *none_either) = told[0]["geometry"]["coordinates"]
    assert not none and not none_either and one[0] == one[-1]
    for ring, x in zip(sorted((one, two), key=min), (-1400008, -1399992)):
        sides = [[f(p[k] for p in ring) for f in (min, max)] for k in (0, 1)]
        for found, wanted in zip(sides, ((x - 2, x + 2), (680, 720))):
            close(found[0], wanted[0], 0.01)
            close(found[1], wanted[1], 0.01)
    said = json.loads(fram("field", run / "field-0.02.geojson", "--json"))
    assert said["floes"] == 1, said
    if "cairo" in subprocess.run([FRAM, "--version"], capture_output=True, text=True, check=True).stdout:
        fram("video", run, "--pictures", "--camera", "plan", "--fps", 1, "--width", 320, "--height", 360, "-q")
        width, height, channels, rows = chromium.pixels((run / "video" / "frame-000000.png").read_bytes())
        red = [[row[channels * x] > 1.6 * row[channels * x + 1] for x in range(width)] for row in rows]
        parts = [sum(a and not b for a, b in zip(row, row[1:])) for row in red]
        assert parts.count(3) > 5 and parts.count(2) > 2 * parts.count(3), parts  # two hulls, and the ship in some rows


def check_bare_videos(folder):
    """Without a vessel there is no load to tell of; ships without ice are seen in all of their domain, and as large as
    ever, with their arrows, by the camera that goes with them; beside ice arrows go by what is seen, not the domain."""
    def picture(name, camera, scene):
        (folder / "cat.yaml").write_text(scene)
        fram("run", folder / "cat.yaml", "-o", folder / name, "-q")
        fram("video", folder / name, "--pictures", "--camera", camera, "--fps", 1, "--width", 640, "--height", 480,
             "-q")
        _, _, channels, rows = chromium.pixels((folder / name / "video" / "frame-000000.png").read_bytes())
        return [[row[at:at + 3] for at in range(0, len(row), channels)] for row in rows]
    nobody = "vessel: {present: false}\n" + re.sub("vessels:|  - .*", "", CATAMARAN)
    inked = [x for row in picture("nobody", "plan", nobody)[362:373] for x, p in enumerate(row) if max(p) < 100]
    assert 40 < len(inked) and max(inked) < 100, f"more than 'no vessel' over the curve, to pixel {max(inked)}"
    water, seen = re.sub("ice: .*", "ice: {source: none}", CATAMARAN), []
    moored = [scene.replace("prescribed, x: -1400000", "free, x: -1400000, mooring: {depth: 60, lines: [{count: 4, "
                            "spacing_deg: 90, distance: 300, pretension: 2.0e5}]}") for scene in (water, CATAMARAN)]
    for name, camera, scene in ("all", "orbit", water), ("beside", "follow", moored[0]), ("ice", "orbit", moored[1]):
        for x in "-1400050", "-1400450":
            space = sum(picture(f"{name}{x}", camera, scene.replace("-1400050", x))[:360], [])
            seen.append([sum(p[0] > 1.6 * p[1] for p in space), sum(p[1] > 1.5 * max(p[0], p[2]) for p in space)])
    (near, _), (far, _), *beside = seen[:4]
    assert near > 2 * far > 0, f"ships of {near} and {far} pixels in domains of 150 and 550 m"
    assert beside[0] == beside[1] and min(beside[0]) > 200, f"pixels of ships and arrows beside them: {beside}"
    space = sum(picture("apart", "follow", re.sub("-1400050|-1399950", "-1400450", moored[0]))[:360], [])
    assert sum(p[0] > 1.6 * p[1] for p in space) > 0.4 * beside[0][0], "a ship is seen from far where another is"
    assert seen[4] == seen[5] and seen[4][1] > 50, f"pixels of ships and arrows over a field of ice: {seen[4:]}"


def main():
    use_system_python()
    missing = [name for name in READERS if not have(name)]
    if len(missing) == len(READERS):
        print("skipped: none of " + ", ".join(READERS) + " is installed")
        sys.exit(77)
    with tempfile.TemporaryDirectory() as folder:
        run = pathlib.Path(folder) / "run"
        (pathlib.Path(folder) / "scene.yaml").write_text(SCENE)
        fram("run", pathlib.Path(folder) / "scene.yaml", "-o", run, "-q")
        rows = rows_of(run / "series.csv")
        assert all(math.isfinite(v) for row in rows for v in row.values())
        done = [check_geojson(run, rows)]
        check_open_hull(pathlib.Path(folder))
        check_fine_hull(pathlib.Path(folder))
        if "cairo" in subprocess.run([FRAM, "--version"], capture_output=True, text=True, check=True).stdout:
            check_bare_videos(pathlib.Path(folder))
        if shutil.which("node"):
            check_between(pathlib.Path(folder), run)
        if have("vtkmodules"):
            done.append(check_vtk(run, rows))
            check_restart(pathlib.Path(folder), run)
        if "netcdf" in subprocess.run([FRAM, "--version"], capture_output=True, text=True, check=True).stdout:
            done += check_netcdf(run, rows)
        if have("pandas"):
            done.append(check_csv(run))
    print("read by " + ", ".join(done) + (f"; skipped, not installed: {', '.join(missing)}" if missing else ""))


main()
