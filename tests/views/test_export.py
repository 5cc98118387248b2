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
import subprocess
import sys
import tempfile

FRAM = os.environ["FRAM"]
READERS = ("vtkmodules", "xarray", "netCDF4", "h5py", "pandas")
SCENE = """
title: Export test
run: {duration: 6, time_step: 0.02, seed: 3}
vessel:
  mode: free
  hull: {length: 48, beam: 12, draught: 4, freeboard: 2}
  mooring: {depth: 60, lines: [{count: 4, spacing_deg: 90, distance: 300, pretension: 2.0e5}]}
  thrusters: [{x: 18}]
ice: {concentration: 0.7, mean_floe_area: 64, thickness: 0.5, breakable: true}
domain: {x_min: -64, x_max: 64, y_min: -40, y_max: 40, boundary: open}
environment: {current_speed: 1.5, current_direction_deg: 180}
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


def check_netcdf(run, rows):
    done = []
    fram("export", run, "--netcdf", "-q")
    if have("xarray") and have("netCDF4"):
        import xarray
        with xarray.open_dataset(run / "run.nc") as data:
            assert data.sizes["time"] == len(rows) and data.sizes["frame"] == 13
            assert data["ice_force_x"].attrs["units"] == "N"
            for name in ("position_x", "mooring_force_y", "kinetic_energy"):
                unit = data[name].attrs["units"]
                assert data[name].values[-1] == rows[-1][f"{name}[{unit}]"], name
            late = data["position_x"].sel(time=4.0, method="nearest")
            close(float(late), rows[199]["position_x[m]"], 0)
            assert int(data["floe_x"].isel(frame=-1).notnull().sum()) == rows[-1]["floes[1]"]
            speed = data["floe_velocity_x"].isel(frame=5, floe=0) * 0.5
            way = data["floe_x"].isel(floe=0)
            close(float(speed), float(way[6] - way[5]), 1e-4)
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
    assert kinds.count("vessel") == 1 and abs(kinds.count("floe") - rows[-6]["floes[1]"]) <= 2
    vessel = field["features"][kinds.index("vessel")]["geometry"]["coordinates"][0]
    xs = [p[0] for p in vessel]
    assert vessel[0] == vessel[-1] and 47 < max(xs) - min(xs) < 56
    fram("field", run / "field-5.9.geojson", "-q", "--json")  # Fram reads what it writes
    bad = subprocess.run([FRAM, "export", run, "--geojson", "--time", "7"], capture_output=True, text=True, check=False)
    assert bad.returncode == 2 and "ends at 6 s" in bad.stderr, bad.stderr
    return "json"


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
        head, *lines = (run / "series.csv").read_text().splitlines()
        rows = [dict(zip(head.split(","), map(float, line.split(",")))) for line in lines]
        assert all(math.isfinite(v) for row in rows for v in row.values())
        done = [check_geojson(run, rows)]
        if have("vtkmodules"):
            done.append(check_vtk(run, rows))
            check_restart(pathlib.Path(folder), run)
        if "netcdf" in subprocess.run([FRAM, "--version"], capture_output=True, text=True, check=True).stdout:
            done += check_netcdf(run, rows)
        if have("pandas"):
            done.append(check_csv(run))
    print("read by " + ", ".join(done) + (f"; skipped, not installed: {', '.join(missing)}" if missing else ""))


main()
