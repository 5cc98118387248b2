#!/usr/bin/env python3
"""Checkpoints that are damaged, of another version or another scenario are refused, and the reason is told.

A damaged newest one is passed over for the one before, with a warning; resume of another scenario never goes on.
"""
import os
import pathlib
import re
import shutil
import struct
import subprocess
import tempfile
import zlib

FRAM = os.environ["FRAM"]
SCENE = """
run: {duration: 2, time_step: 0.02}
vessel: {mode: towed, x: -30, speed: 2, hull: {length: 48, beam: 12, draught: 4, freeboard: 2}}
ice: {mean_floe_area: 100, concentration: 0.5}
domain: {x_min: -60, x_max: 60, y_min: -40, y_max: 40}
output: {checkpoint_interval: 0.5}
"""
# Types of blocks of earlier layouts, and the ones of today that took their place (io/record_layout.h).
EARLIER_BLOCKS = {3: 7, 5: 15, 8: 15}


def resume(run):
    done = subprocess.run([FRAM, "resume", run], capture_output=True, text=True, check=False)
    return done.returncode, done.stderr


def with_sums(data):
    """The file with its checksums set right, so that what is inside is looked at."""
    data = bytearray(data)
    struct.pack_into("<I", data, 24, zlib.crc32(data[32:]))
    struct.pack_into("<I", data, 28, zlib.crc32(data[:28]))
    return bytes(data)


def other_version(data):
    data = bytearray(data)
    struct.pack_into("<I", data, 8, struct.unpack_from("<I", data, 8)[0] + 1)
    return with_sums(data)


def flipped(at):
    def change(data):
        data = bytearray(data)
        data[at] ^= 0x10
        return bytes(data)
    return change


def swapped(data):
    data = bytearray(data)
    data[12:16] = data[12:16][::-1]
    return with_sums(data)


def other_program(data):
    """As another version of Fram would have written it."""
    name = b"fram_version"
    at = data.index(name) + len(name)
    size = struct.unpack_from("<Q", data, at)[0]
    version = bytearray(data[at + 8:at + 8 + size])
    version[-1] = ord("9")
    return with_sums(data[:at + 8] + bytes(version) + data[at + 8 + size:])


def lost_index(data):
    """A row of a vessel's body that no table has; every checksum fits."""
    data, name = bytearray(data), struct.pack("<I", 6) + b"vessel"
    at = data.index(name) + len(name)
    fields, at = struct.unpack_from("<I", data, at)[0], at + 4
    for _ in range(fields):
        at += 4 + struct.unpack_from("<I", data, at)[0] + 8
    assert struct.unpack_from("<i", data, at)[0] == 1, "one vessel"
    struct.pack_into("<i", data, at + 4, 1 << 20)
    return with_sums(bytes(data))


def moved_body(data):
    """The first body stands elsewhere by the last bit of its x, which no check of a state can know; every checksum
    fits."""
    data, name = bytearray(data), struct.pack("<I", 4) + b"body"
    at = data.index(name) + len(name)
    fields, at = struct.unpack_from("<I", data, at)[0], at + 4
    for k in range(fields):
        size = struct.unpack_from("<I", data, at)[0]
        assert k > 0 or data[at + 4:at + 4 + size] == b"position", "the first field"
        at += 4 + size + 8
    assert struct.unpack_from("<i", data, at)[0] > 1, "bodies"
    data[at + 4] ^= 1
    return with_sums(bytes(data))


def other_components(data):
    """The first field of the first body table has a number more in each row; every checksum fits."""
    data, name = bytearray(data), struct.pack("<I", 4) + b"body"
    at = data.index(name) + len(name) + 4
    at += 4 + struct.unpack_from("<I", data, at)[0] + 4
    struct.pack_into("<I", data, at, struct.unpack_from("<I", data, at)[0] + 1)
    return with_sums(bytes(data))


def with_inputs(text):
    """The list of the scenario's files, which is empty in this scene, is this text; every checksum fits."""
    def change(data):
        name = struct.pack("<I", 6) + b"inputs"
        at = data.index(name) + len(name)
        assert struct.unpack_from("<Q", data, at)[0] == 0, "no files"
        data = bytearray(data[:at] + struct.pack("<Q", len(text)) + text + data[at + 8:])
        struct.pack_into("<Q", data, 16, len(data))
        return with_sums(bytes(data))
    return change


def longer(data):
    """More bytes behind the last table, told in the head; every checksum fits."""
    data = bytearray(data) + b"more"
    struct.pack_into("<Q", data, 16, len(data))
    return with_sums(bytes(data))


DAMAGE = {
    "a field of other components": (other_components, "of another, in which the type of the field position"),
    "bytes behind the last table": (longer, "in which the end of the file is not the same"),
    "a list of files that is none": (with_inputs(b"\0\xffhull.obj\n"), "expected a list of files"),
    "a list of files that is cut": (with_inputs(b"0" * 64 + b"  /hull.obj"), "found something else at byte 0 of it"),
    "empty": (lambda data: b"", "too short|cut short|expected"),
    "cut in its head": (lambda data: data[:20], "short|expected"),
    "cut in its middle": (lambda data: data[:len(data) // 2], r"of \d+ bytes, found"),
    "one byte too long": (lambda data: data + b"x", "bytes|long|expected"),
    "flipped in its head": (flipped(9), "damaged|version"),
    "flipped in its state": (flipped(-900), "damaged|checksum"),
    "another kind of file": (lambda data: b"GIF89a" + data[6:], "another kind|expected a"),
    "another version": (other_version, "version"),
    "an index that names nothing": (lost_index, r"vessel\[0\].body: |the state cannot be: found 1048576"),
    "another byte order": (swapped, "byte order"),
    "a body that was moved with care": (moved_body, "state is not the one"),
    "a state that was changed with care": (lambda data: with_sums(flipped(-1)(data)), "state is not the one|expected"),
}


def with_blocks(data, before, now):
    """The record with blocks of another type (layout: io/record.h)."""
    data, at = bytearray(data), 24
    while at < len(data):
        kind, size = struct.unpack_from("<IQ", data, at + 4)
        if kind == now:
            struct.pack_into("<I", data, at + 4, before)
            struct.pack_into("<I", data, at + 20, zlib.crc32(data[at:at + 20]))
        at += 24 + (size + 7) // 8 * 8
    return bytes(data)


def refused(run, words):
    """resume says the words and changes no file; what it says."""
    before = {p.name: p.read_bytes() for p in run.iterdir()}
    code, told = resume(run)
    assert code == 2 and words in told, (run.name, code, told)
    assert {p.name: p.read_bytes() for p in run.iterdir()} == before, f"{run.name}: the refusal changed files"
    return told


def main():
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)
        (folder / "scene.yaml").write_text(SCENE)
        subprocess.run([FRAM, "run", folder / "scene.yaml", "-o", folder / "run", "--until", "1.2", "-q"], check=True)
        for name, (change, reason) in DAMAGE.items():
            run = folder / "damaged"
            shutil.copytree(folder / "run", run)
            files = sorted(run.glob("checkpoint-*.fram"))
            assert len(files) == 2, files
            files[1].write_bytes(change(files[1].read_bytes()))
            code, told = resume(run)
            assert code == 0 and files[1].name in told and "trying the one before" in told, (name, code, told)
            assert re.search(reason, told) and "resuming at t = 1 s" in told, (name, told)
            shutil.rmtree(run)
            shutil.copytree(folder / "run", run)
            for file in files:
                file.write_bytes(change(file.read_bytes()))
            before = {p.name: p.read_bytes() for p in run.iterdir()}
            code, told = resume(run)
            assert code == 2 and re.search(reason, told), (name, code, told)
            assert {p.name: p.read_bytes() for p in run.iterdir()} == before, f"{name}: the refusal changed files"
            shutil.rmtree(run)
        run = folder / "other"
        shutil.copytree(folder / "run", run)
        text = (run / "scenario.yaml").read_text()
        (run / "scenario.yaml").write_text(text.replace("thickness: 1", "thickness: 1.25", 1))
        assert (run / "scenario.yaml").read_text() != text
        code, told = resume(run)
        assert code == 2 and "another scenario" in told, (code, told)
        assert "begun by another Fram: restore it, continue with that Fram" in told, told
        for name in run.glob("checkpoint-*.fram"):
            name.unlink()
        code, told = resume(run)
        assert code == 2 and "no checkpoint" in told, (code, told)
        assert "run its scenario again" in told and "output.checkpoint_interval" in told, told
        # One of another version of Fram is told as that, and nothing older is taken in its place.
        run = folder / "version"
        shutil.copytree(folder / "run", run)
        for file in run.glob("checkpoint-*.fram"):
            file.write_bytes(other_program(file.read_bytes()))
        refused(run, "continue the run with that version")
        # Nor is one that lists other files, or is the state that a program saved from a world.
        for name, text, words in (("files", b"0" * 64 + b"  /hull.obj\n", "was started with was changed since"),
                                  ("program", b"0" * 64, "found a state that a program saved from a world")):
            run = folder / name
            shutil.copytree(folder / "run", run)
            for file in run.glob("checkpoint-*.fram"):
                file.write_bytes(with_inputs(text)(file.read_bytes()))
            refused(run, words)
        # Streams that are shorter than the checkpoint says are no run to go on with.
        for name in ("record.fram", "series.csv"):
            run = folder / f"short-{name}"
            shutil.copytree(folder / "run", run)
            with open(run / name, "r+b") as file:
                file.truncate(200)
            refused(run, name)
        # A flipped byte in a block of the record is told by all that read it, and by what would go on with it.
        run = folder / "flipped"
        shutil.copytree(folder / "run", run)
        record = run / "record.fram"
        record.write_bytes(flipped(record.stat().st_size // 2)(record.read_bytes()))
        page = folder / "viewer.html"
        page.write_text("<html></html>")
        for words in (["report", run], ["export", run, "--vtk"], ["view", run, "--page", page], ["resume", run]):
            done = subprocess.run([FRAM, *words], capture_output=True, text=True, check=False)
            assert re.search(r"warning: .*record.fram: damaged block at byte \d+", done.stderr), (words, done.stderr)
        # Nor is a record of an earlier layout, in which frames of two layouts would stand.
        for earlier in EARLIER_BLOCKS.items():
            run = folder / f"earlier-{earlier[0]}"
            shutil.copytree(folder / "run", run)
            record = run / "record.fram"
            record.write_bytes(with_blocks(record.read_bytes(), *earlier))
            told = refused(run, "record.fram: an earlier version of Fram wrote this record")
            done = subprocess.run([FRAM, "report", run], capture_output=True, text=True, check=False)
            assert (done.returncode, done.stderr) == (2, told), (done.stderr, told)
    print(f"{len(DAMAGE)} ways of damage and {7 + len(EARLIER_BLOCKS)} of disagreement are refused with the reason")


main()
