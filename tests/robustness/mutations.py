# SPDX-License-Identifier: GPL-3.0-only
"""Damaged inputs: meshes, tables, scenes and results with bytes flipped, ends cut off, lines swapped, numbers extreme, wrong types in
HDF5. Whatever a file holds, the program ends in time and memory with status 0, 1 or 2, and names the file with a reason. Run with
/usr/bin/python3; environment: SPRAG, the program, and SPRAG_SOURCE, the sources.

    mutations.py --count 1000 [--seed 1] [--kind mesh]    # tries so many"""

import argparse
import os
import random
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

import h5py
import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "support"))
from runs import SOURCE, SPRAG, sprag  # noqa: E402
from strip import MESH_22, MESH_41, SCRIPT, SOLID  # noqa: E402

SEED = 1
PATIENCE = 40  # s
ROOM = 1.5e9  # bytes
NUMBER = re.compile(rb"-?\b\d+(\.\d+)?([eE][-+]?\d+)?\b")
EXTREMES = (b"0", b"-1", b"1", b"3", b"-0.0", b"nan", b"inf", b"-inf", b"1e308", b"-1e308", b"1e-308", b"1e999", b"2147483648", b"4294967295",
            b"4294967296", b"9223372036854775807", b"18446744073709551616", b"1000000000", b"99999999999", b"1,5", b"0x10", b"", b"x",
            b"1e", b"--1", b"1 GPa", b"\xc2\xb5", b"\x00")  # fmt: skip
COARSE = ["Drive/Stroke=4", "Analysis/Step=4", "Mesh/Degree=1", "Output/Fields=none"]
CLOSED = "subsection Analysis\n  set Model = closed form\nend\n"
TIMES = np.linspace(0.0, 1.0, 21)
WAY = 30.0 * (1.0 - np.cos(2 * np.pi * TIMES)) / 2


def csv(header, *columns):
    return (header + "\n" + "".join(", ".join(f"{value:.6g}" for value in row) + "\n" for row in zip(*columns))).encode()


def scene(*settings):
    text = ""
    for setting in settings:
        name, value = setting.split("=", 1)
        section, entry = name.split("/")
        text += f"subsection {section}\n  set {entry} = {value}\nend\n"
    return text


SPEEDS, LOOP = np.array([0.0, 20.0, 60.0, 100.0, 200.0]), np.array([0.0, 10.0, 20.0, 30.0, 20.0, 10.0, 0.0])
TABLES = {
    "drive": ("Drive/Table", csv("time [s], x [mm]", TIMES, WAY), scene("Analysis/Model=closed form", "Drive/Profile=table")),
    "friction": ("Friction/Table", csv("speed [mm/s], mu", SPEEDS, [0.6, 0.7, 0.72, 0.75, 0.8]),
                 scene("Analysis/Model=closed form", "Friction/Law=table")),
    "loop": ("Isolation/Loop table", csv("x [mm], Q [N]", LOOP, [0.0, 3.0, 6.0, 9.0, -3.0, -1.0, 0.0]),
             scene("Analysis/Type=isolation", "Isolation/Damper=table", "Isolation/Duration=1")),
    "record": ("Isolation/Base table", csv("time [s], acceleration [m/s2]", TIMES, np.sin(20 * TIMES)),
               scene("Analysis/Type=isolation", "Isolation/Base motion=record", "Isolation/Duration=1")),
    "spectrum": ("Isolation/Base table", csv("frequency [Hz], density [(m/s2)^2/Hz]", 0.5 + 10 * TIMES, 1e-3 + TIMES),
                 scene("Analysis/Type=isolation", "Isolation/Base motion=random", "Isolation/Base spectrum=table", "Isolation/Duration=1",
                       "Isolation/Spectrum lines=20")),
}  # fmt: skip


# Changes of a file


def change_bytes(data, chance):
    data = bytearray(data)
    for _ in range(chance.choice((1, 1, 2, 5, 20))):
        data[chance.randrange(len(data))] ^= 1 << chance.randrange(8)
    return bytes(data)


def cut(data, chance):
    return data[: chance.randrange(len(data))]


def drop_piece(data, chance):
    begin = chance.randrange(len(data))
    return data[:begin] + data[begin + chance.randrange(1, 200) :]


def repeat_piece(data, chance):
    begin = chance.randrange(len(data))
    return data[:begin] + data[begin : begin + chance.randrange(1, 500)] * chance.choice((2, 3, 50)) + data[begin:]


def insert_noise(data, chance):
    begin = chance.randrange(len(data) + 1)
    noise = bytes(chance.randrange(256) for _ in range(chance.choice((1, 3, 100))))
    return data[:begin] + noise + data[begin:]


def change_lines(data, chance):
    lines = data.split(b"\n")
    one, other = chance.randrange(len(lines)), chance.randrange(len(lines))
    act = chance.randrange(4)
    if act == 0:
        lines[one], lines[other] = lines[other], lines[one]
    elif act == 1:
        del lines[one]
    elif act == 2:
        lines.insert(other, lines[one])
    else:
        lines[one] = lines[one] * chance.choice((2, 1000))
    return b"\n".join(lines)


def change_number(data, chance):
    for _ in range(chance.choice((1, 1, 3))):
        places = list(NUMBER.finditer(data))
        if places:
            place = chance.choice(places)
            data = data[: place.start()] + chance.choice(EXTREMES) + data[place.end() :]
    return data


TEXT_CHANGES = (change_bytes, cut, drop_piece, repeat_piece, insert_noise, change_lines, change_number, change_number, change_number)
BYTE_CHANGES = (change_bytes, change_bytes, cut, drop_piece, insert_noise)


def change_objects(path, chance):
    """Changes type, shape or place of one object of a file in HDF5."""
    with h5py.File(path, "r+") as file:
        names = []
        file.visit(names.append)
        name = chance.choice(sorted(names))
        parent, own = file[name].parent, name.split("/")[-1]
        values = file[name][()] if isinstance(file[name], h5py.Dataset) else None
        act = chance.randrange(12)
        if act == 0 and values is not None:
            file[name].attrs["unit"] = chance.choice(("N", "parsec", 5.0, ["a", "b"], np.void(b"x"), b"\xff\xfe", "mm" * 3000))
            return f"unit of {name}"
        if act == 1 and np.size(values) and np.asarray(values).dtype.kind == "f" and np.ndim(values):
            place = chance.randrange(np.size(values))
            with np.errstate(over="ignore"):
                values.flat[place] = chance.choice((np.nan, np.inf, -np.inf, 1e308, -1e308, 1e-308, 0.0))
            file[name][...] = values
            return f"a value of {name}"
        del parent[own]
        if act == 2:
            parent[own] = chance.choice(("text", b"\xff\xfe", ["a", "b"], 5, -1.5, True, np.void(b"abc")))
        elif act == 3:
            parent.create_group(own)["deeper"] = 1.0
        elif act == 4:
            parent.create_dataset(own, (chance.choice((0, 1 << 24, 1 << 40, 1 << 60)),), "f8", chunks=(1024,), maxshape=(None,))
        elif act == 5:
            parent[own] = np.arange(12.0).reshape(3, 2, 2)
        elif act == 6:
            parent[own] = np.zeros(4, [("a", "f8"), ("b", "i4")])
        elif act == 7:
            parent[own] = h5py.SoftLink(chance.choice(("/nothing", "/" + name, "/")))
        elif act == 8:
            parent[own] = h5py.ExternalLink(chance.choice(("/etc/passwd", "nothing.h5", str(path))), "/")
        elif act == 9:
            parent.create_dataset(own, (21,), "f8", external=[("/etc/passwd", 0, 168)])
        elif act == 10:
            parent[own] = np.asarray([1, 2, 3], ">i2")
        return f"{name} by {act}"


class Case:
    """An input that was made, and how the program is asked about it."""

    def __init__(self, folder, chance):
        self.folder, self.chance = folder, chance
        self.named = ""  # what a message has to name
        self.what = ""
        self.command = []

    def damage(self, path, changes=TEXT_CHANGES):
        change = self.chance.choice(changes)
        if change is change_objects:
            self.what = f"{path.name}: {change_objects(path, self.chance)}"
        else:
            path.write_bytes(change(path.read_bytes(), self.chance))
            self.what = f"{path.name}: {change.__name__}"
        self.named = path.name

    def ask(self, *words, settings=()):
        self.command = [SPRAG, *map(str, words)] + [word for setting in settings for word in ("--set", setting)]

    def mesh(self):
        name, text = self.chance.choice((("own.msh", MESH_22), ("own.msh", MESH_41), ("own.geo", SCRIPT), ("own.geo", SOLID)))
        (self.folder / name).write_text(text)
        self.damage(self.folder / name)
        (self.folder / "scene.prm").write_text(scene(f"Mesh/File={name}"))
        if text is SOLID:
            self.ask(self.folder / "scene.prm", "--validate", settings=[*COARSE, "Analysis/Dimension=3"])
        else:
            self.ask(self.folder / "scene.prm", "--output", self.folder / "out", settings=COARSE)

    def table(self):
        parameter, text, rest = self.chance.choice(list(TABLES.values()))
        (self.folder / "own.csv").write_bytes(text)
        self.damage(self.folder / "own.csv")
        (self.folder / "scene.prm").write_text(rest + scene(f"{parameter}=own.csv"))
        self.ask(self.folder / "scene.prm", "--output", self.folder / "out")

    def measured(self):
        """A stroke to identify from, as a text or as a result."""
        name = self.chance.choice(("stroke.csv", "stroke.h5"))
        if name == "stroke.h5":
            shutil.copy(ORIGINALS / "closed" / "result.h5", self.folder / name)
        else:
            (self.folder / name).write_bytes(csv("time [s], x [mm], P [N], Q [N]", TIMES, WAY, WAY + 1, 0.7 * WAY))
        self.damage(self.folder / name, TEXT_CHANGES if name.endswith("csv") else (*BYTE_CHANGES, *[change_objects] * 5))
        (self.folder / "scene.prm").write_text(scene("Analysis/Type=identification", f"Identification/Table={name}", "Identification/Unknowns=mu"))
        self.ask(self.folder / "scene.prm", "--output", self.folder / "out")

    def hdf5_table(self):
        parameter, text, rest = self.chance.choice(list(TABLES.values()))
        header, *rows = text.decode().splitlines()
        columns = np.array([[float(cell) for cell in row.split(",")] for row in rows]).T
        with h5py.File(self.folder / "own.h5", "w") as file:
            for title, values in zip(header.split(", "), columns):
                name, _, unit = title.partition(" [")
                file[name] = values
                file[name].attrs["unit"] = unit.rstrip("]")
        self.damage(self.folder / "own.h5", (*BYTE_CHANGES, *[change_objects] * 8))
        (self.folder / "scene.prm").write_text(rest + scene(f"{parameter}=own.h5"))
        self.ask(self.folder / "scene.prm", "--output", self.folder / "out")

    def scene(self):
        scenes = sorted((SOURCE / "params").glob("*.prm"))
        path = self.folder / "scene.prm"
        path.write_bytes(self.chance.choice(scenes).read_bytes())
        self.damage(path)
        shutil.copy(SOURCE / "params" / "identification-a.csv", self.folder)
        self.ask(path, self.chance.choice(("--validate", "--validate", "--print-parameters")))

    def earlier(self):
        """A result, a checkpoint or a journal in the folder of a run."""
        origin, name = self.chance.choice(
            (("closed", "result.h5"), ("killed", "run.checkpoint"), ("killed", "run.journal"), ("map", "map.journal"), ("closed", "run.log"))
        )
        if not (ORIGINALS / origin / name).exists():
            name = "result.h5"
        shutil.copytree(ORIGINALS / origin, self.folder / "out")
        self.damage(self.folder / "out" / name, (*BYTE_CHANGES, change_objects) if name.endswith(".h5") else BYTE_CHANGES)
        (self.folder / "scene.prm").write_text((ORIGINALS / f"{origin}.prm").read_text())
        self.ask(self.folder / "scene.prm", "--output", self.folder / "out")

    def picture(self):
        """A damaged result in the tools that read results."""
        origin = self.chance.choice(("closed", "fields"))
        shutil.copytree(ORIGINALS / origin, self.folder / "out")
        names = [path for path in sorted((self.folder / "out").iterdir()) if path.suffix in (".h5", ".xdmf")]
        path = self.chance.choice([self.folder / "out" / "result.h5", *names])
        self.damage(path, (*BYTE_CHANGES, *[change_objects] * 5) if path.suffix == ".h5" else TEXT_CHANGES)
        self.named = str(self.folder / "out")
        tool = self.chance.choice(("plot.py", "export.py", "export.py", "fields.py"))
        output = {"plot.py": "pictures", "export.py": "tables", "fields.py": "fields.png"}[tool]
        self.command = ["/usr/bin/python3", str(SOURCE / "postprocess" / tool), self.named, "--output", str(self.folder / output)]
        self.what = f"{tool}, {self.what}"


KINDS = {"mesh": 5, "table": 9, "hdf5_table": 7, "measured": 4, "scene": 3, "earlier": 2, "picture": 1}
ORIGINALS = Path()


def make_originals(folder):
    global ORIGINALS
    ORIGINALS = folder
    (folder / "closed.prm").write_text(CLOSED)
    (folder / "fields.prm").write_text(scene("Mesh/Face size=4"))
    (folder / "map.prm").write_text(
        scene("Analysis/Type=map", "Analysis/Model=rigid", "Map/First points=3", "Map/Second parameter=Stability/Position",
              "Map/Second from=10", "Map/Second to=60", "Map/Second points=3")
    )  # fmt: skip
    (folder / "killed.prm").write_text(scene("Analysis/Type=transient", "Analysis/Model=rigid", "Time/Tolerance=1e-6"))
    for name in ("closed", "fields"):
        words = ["--set", "Drive/Stroke=8"] if name == "fields" else []
        done = sprag(folder / f"{name}.prm", "--output", folder / name, *words)
        assert done.returncode == 0, done.stderr
    for name, progress in (("killed", "run.checkpoint"), ("map", "map.journal")):
        environment = {**os.environ, "SPRAG_CHECKPOINT_SECONDS": "0"}
        process = subprocess.Popen([SPRAG, str(folder / f"{name}.prm"), "--output", str(folder / name)], env=environment,
                                   stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, start_new_session=True)  # fmt: skip
        while process.poll() is None and not (folder / name / progress).exists():
            time.sleep(0.002)
        time.sleep(0.02)
        try:
            os.killpg(process.pid, signal.SIGKILL)
        except ProcessLookupError:
            pass
        process.wait()


def outcome(case):
    """(exit status, output, bytes of the largest process)"""
    with tempfile.TemporaryFile() as output:
        begin = time.monotonic()
        process = subprocess.Popen(case.command, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=output, start_new_session=True)
        status = used = None
        while status is None:
            pid, state, usage = os.wait4(process.pid, os.WNOHANG)
            if pid:
                status, used = os.waitstatus_to_exitcode(state), usage.ru_maxrss * 1024
            elif time.monotonic() - begin > PATIENCE:
                os.killpg(process.pid, signal.SIGKILL)
                os.wait4(process.pid, 0)
                status, used = "hangs", 0
            else:
                time.sleep(0.003)
        process.returncode = 0
        output.seek(0)
        return status, output.read().decode(errors="replace"), used


def objection(case, status, text, used):
    """Returns the problem of an answer, empty without one."""
    if status not in (0, 1, 2):
        return f"ends with {status}"
    if used > ROOM:
        return f"needs {used / 1e9:.1f} GB"
    for sign in ("Traceback", "crashed", "terminate called", "ERROR: ", "HDF5-DIAG", "basic_string", "bad_alloc", "vector::", "std::"):
        if sign in text:
            return f"says '{sign}'"
    if status != 0 and len(text.strip()) < 20:
        return "fails without a message"
    if status == 2 and not any(name in text for name in (case.named, str(case.folder))):
        return "names no file"
    return ""


def tried(kind, seed):
    """(case, objection, text)"""
    chance = random.Random(f"{kind} {seed}")
    with tempfile.TemporaryDirectory(prefix="sprag-mutation-") as folder:
        case = Case(Path(folder), chance)
        getattr(case, kind)()
        status, text, used = outcome(case)
        return case, objection(case, status, text, used), text


class Damage(unittest.TestCase):
    kinds, count, seed = list(KINDS), sum(KINDS.values()), 0

    def test_of_any_kind_is_survived_and_told(self):
        total = sum(KINDS[kind] for kind in self.kinds)
        with tempfile.TemporaryDirectory(prefix="sprag-mutation-") as folder:
            make_originals(Path(folder))
            for kind in self.kinds:
                for number in range(self.seed, self.seed + max(1, round(self.count * KINDS[kind] / total))):
                    with self.subTest(kind=kind, seed=number):
                        case, wrong, text = tried(kind, number)
                        self.assertEqual(wrong, "", f"{case.what}\n{text}")


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--count", type=int)
    parser.add_argument("--seed", type=int, default=SEED)
    parser.add_argument("--kind", choices=list(KINDS), action="append")
    arguments = parser.parse_args()
    if arguments.count is not None:
        Damage.kinds, Damage.count, Damage.seed = arguments.kind or list(KINDS), arguments.count, arguments.seed
    unittest.main(argv=sys.argv[:1])
