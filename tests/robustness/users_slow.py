# SPDX-License-Identifier: GPL-3.0-only
"""Three users' ways through the pages: an engineer with a device, a student who verifies the contact, an engineer who isolates a
machine. Each takes at most 5 commands and 2 minutes of CPU time, which are printed with the answers. Answers are then checked by
another model or an integration of this file. Run with /usr/bin/python3; environment: SPRAG, the program, and SPRAG_SOURCE, the
sources."""

import math
import re
import resource
import shlex
import subprocess
import sys
import unittest
from pathlib import Path

import h5py
import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "support"))
from folders import FolderTest  # noqa: E402
from runs import SOURCE, SPRAG, TIMEOUT  # noqa: E402

sys.path.insert(0, str(SOURCE / "postprocess"))
import sprag  # noqa: E402

MOST_COMMANDS, MOST_SECONDS = 5, 120

DEVICE = """
subsection Geometry
  set Cylinder radius  = 40
  set Interface offset = 22
  set Pivot distance   = 150
  set Pivot height     = 10
end

subsection Rotational spring
  set Stiffness = 4e4
end

subsection Drive
  set Stroke = 60
  set Speed  = 100
end

subsection Lever
  set Length          = 170
  set Depth           = 8
  set Width           = 30
  set Young's modulus = 210 GPa
  set Poisson's ratio = 0.3
  set Density         = 7850 kg/m3
  set Inertia         = as built
end

subsection Friction layer
  set Thickness = 3
end

subsection Friction
  set Law   = table
  set Table = mu.csv
end
"""

FRICTION = "speed [mm/s], mu\n1, 0.42\n10, 0.50\n30, 0.58\n100, 0.70\n300, 0.76\n"

RANGES = "Contact/Damping 0.01 0.1; Friction/Factor 0.8 1.2"

MASS, STIFFNESS = 0.5, 12.6  # t, N/mm: 0.8 Hz

RECORD_STEP = 0.01  # s


def floor_record():
    """Acceleration of a floor [mm/s2] every RECORD_STEP: ground that resonates at 4 Hz, 60 lines from 0.2 to 19 Hz over 60 s."""
    random = np.random.default_rng(7)
    frequency = 0.2 * 1.08 ** np.arange(60)
    ratio = frequency / 4
    share = (0.8 * ratio) ** 2
    ground = np.sqrt((1 + share) / ((1 - ratio**2) ** 2 + share))
    amplitude = np.sqrt(frequency) * ground * frequency**2 / (0.8**2 + frequency**2)
    amplitude *= 150 / math.sqrt(np.sum(amplitude**2) / 2)
    phase = random.uniform(0, 2 * math.pi, len(frequency))
    time = RECORD_STEP * np.arange(6001)
    return time, np.sin(2 * math.pi * np.outer(time, frequency) + phase) @ amplitude


def transmissibility(acceleration, friction, parts=200):
    """Root mean square of the table's acceleration over the base's for constant friction [N]: steps of a part of RECORD_STEP by
    the semi-implicit Euler method, at each of which friction takes off what it can of the speed."""
    base = np.interp(np.arange(parts * (len(acceleration) - 1)) / parts, np.arange(len(acceleration)), acceleration)
    step, z, rate, squares = RECORD_STEP / parts, 0.0, 0.0, 0.0
    most = friction / MASS * step
    for value in base.tolist():
        before = rate
        rate -= (STIFFNESS / MASS * z + value) * step
        rate -= max(-most, min(most, rate))
        z += rate * step
        squares += ((rate - before) / step + value) ** 2
    return math.sqrt(squares / np.sum(base**2))


class Users(FolderTest):
    def setUp(self):
        super().setUp()
        self.commands, self.cpu_seconds = 0, 0.0

    def write(self, name, text):
        (self.folder / name).write_text(text, encoding="utf-8")

    def call(self, line):
        """Calls a command as it is typed in the folder of the sources, from that of the test."""
        words = shlex.split(line)
        words[0] = SPRAG if words[0] == "sprag" else SOURCE / words[0]
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        done = subprocess.run(words, capture_output=True, text=True, check=False, timeout=3 * TIMEOUT, cwd=self.folder)
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        self.assertEqual(done.returncode, 0, f"{line}\n{done.stdout}{done.stderr}")
        seconds = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
        return done.stdout, seconds

    def user(self, line):
        printed, seconds = self.call(line)
        self.commands += 1
        self.cpu_seconds += seconds
        print(f"{seconds:6.1f} CPU s  {line}")
        return printed

    def answer(self, text):
        print(f"    {text}")

    def expect_way_end(self, user):
        print(f"{user}: {self.commands} commands, {self.cpu_seconds:.0f} CPU s", flush=True)
        self.assertLessEqual(self.commands, MOST_COMMANDS)
        self.assertLess(self.cpu_seconds, MOST_SECONDS)

    def summary(self, run, name):
        return sprag.read(self.folder / run).summary[name]

    def study(self, output, changes):
        """Verdicts of slides, all of the condensed lever without roles and critical values."""
        sets = {"Analysis/Type": "study", "Analysis/Model": "condensed", "Study/Type": "stability"}
        sets |= {"Stability/Roles": "off", "Stability/Critical": "none"} | changes
        self.call(f"sprag lever.prm --output {output} " + " ".join(f"--set {shlex.quote(f'{k}={v}')}" for k, v in sets.items()))
        with h5py.File(self.folder / output / "result.h5") as file:
            return file["runs/verdict"].asstr()[:], file["table/growth_rate"][:]

    def test_engineer_with_a_device(self):
        self.write("lever.prm", DEVICE)
        self.write("mu.csv", FRICTION)
        self.user("sprag lever.prm --output strokes")
        entries = ("peak_P_backward", "peak_Q_forward", "friction_work", "largest_pressure", "largest_lever_stress")
        for name in entries:
            value = self.summary("strokes", name)
            self.assertGreater(abs(value), 0)
            self.answer(f"{name} = {float(value):.4g} {value.unit}")
        self.user("postprocess/export.py strokes")
        rows = np.genfromtxt(self.folder / "strokes/table.csv", delimiter=",", names=True, deletechars="")
        self.assertAlmostEqual(rows["P_[N]"].max() / self.summary("strokes", "peak_P_backward"), 1, delta=1e-12)

        law = dict(re.findall(r"set (Stiffness|Exponent) *= (\S+)", self.user("sprag lever.prm --set 'Analysis/Type=contact law' --output law")))
        contact = " ".join(f"--set Contact/{name}={number}" for name, number in law.items())
        stability = f"--set Analysis/Type=stability --set 'Stability/Ranges={RANGES}'"
        printed = self.user(f"sprag lever.prm {contact} {stability} --set Analysis/Model=beam --set 'Stability/Critical=Lever/Depth 2 12' --output depths")
        found = re.search(r"Lever/Depth from 2 to 12 mm: flutter, stable from (\S+) mm \((.*)\)", printed)
        self.assertIsNotNone(found, printed)
        depth = math.ceil(2 * float(found.group(1))) / 2
        self.answer(f"stable from {found.group(1)} mm on, {found.group(2)}: {depth} mm")
        self.user(f"sprag lever.prm {stability} --set Analysis/Model=condensed --set Stability/Critical=none --set Lever/Depth={depth} --output chosen")
        self.assertEqual(self.summary("chosen", "verdict"), "stable")
        self.answer(f"{depth} mm, condensed: stable, growth {float(self.summary('chosen', 'growth_rate')):.3g} 1/s")
        self.expect_way_end("Engineer")

        # The slide is held at each mm both ways at all corners of the ranges.
        dense = "Stability/Direction = forward, backward; Contact/Damping = 0.01, 0.1; Friction/Factor = 0.8, 1.2"
        verdicts, growth = self.study("dense", {"Lever/Depth": depth, "Study/Vary": f"Stability/Position = 1 ... 60 : 60; {dense}"})
        self.assertEqual(len(verdicts), 60 * 8)
        self.assertEqual(set(verdicts), {"stable"})
        self.answer(f"{len(verdicts)} slides checked, growth at most {growth.max():.3g} 1/s")
        # The same check sees a lever that is too thin.
        verdicts, growth = self.study("thin", {"Lever/Depth": depth / 2, "Study/Vary": f"Stability/Position = 5 ... 60 : 12; {dense}"})
        self.assertIn("flutter", verdicts)

    def test_student_who_verifies_the_contact(self):
        self.write("lever.prm", DEVICE)
        self.write("mu.csv", FRICTION)
        for name in ("penalty", "augmented Lagrangian"):
            self.user(f"sprag lever.prm --set 'Contact/Enforcement={name}' --output {name.split()[0]}")
        self.user("postprocess/plot.py penalty augmented -o compared")
        self.assertTrue((self.folder / "compared/pressure.png").is_file())
        printed = self.user("sprag lever.prm --set Analysis/Type=study --set 'Mesh/Faces in contact=0' --set 'Study/Vary=Mesh/Face size = 2, 1.4, 1, 0.7, 0.5, 0.35, 0.25' --set 'Study/Reference=Mesh/Face size = 0.1' --output convergence")
        orders = {name: float(order) for name, order in re.findall(r"(\w+) (\d\.\d+)[,\n]", printed[printed.index("observed order") :])}
        self.answer(f"observed orders {orders}")
        for name in ("P", "Q", "loop_area", "largest_pressure"):
            self.assertGreater(orders[name], 1.4, name)
        for name, tolerance in (("peak_P_backward", 1e-3), ("peak_Q_forward", 1e-3), ("friction_work", 1e-3), ("largest_pressure", 1e-2)):
            one, other = (self.summary(run, name) for run in ("penalty", "augmented"))
            self.answer(f"{name}: penalty {one / other - 1:.2g} off")
            self.assertAlmostEqual(one / other, 1, delta=tolerance)
        for way in ("forward", "backward"):
            soft, hard = (sprag.read(self.folder / run).face(30, way) for run in ("penalty", "augmented"))
            inside = np.linspace(*np.quantile(hard.xi[hard.pressure > 0], (0.1, 0.9)), 50)
            curves = [np.interp(inside, *np.array(sorted(zip(face.xi, face.pressure))).T) for face in (soft, hard)]
            difference = np.abs(curves[0] - curves[1]).max() / curves[1].max()
            self.answer(f"p(x) {way} at x = 30 mm: {difference:.2g} of the peak apart in the inner 80 % of the contact")
            self.assertLess(difference, 0.03)
        self.expect_way_end("Student")

    def test_engineer_who_isolates_a_machine(self):
        time, acceleration = floor_record()
        self.write("floor.csv", "time [s], acceleration [mm/s2]\n" + "".join(f"{t:.2f}, {a:.6f}\n" for t, a in zip(time, acceleration)))
        machine = f"--set Isolation/Mass='{1000 * MASS} kg' --set Isolation/Stiffness={STIFFNESS} --set 'Isolation/Base frequency=0.8'"
        self.user(f"sprag {SOURCE / 'params/design-machine.prm'} {machine} --set 'Design/Judge in time=off' --output design")
        self.assertEqual(self.summary("design", "meets_demands"), 1)
        lever = [f"{float(self.summary('design', name)):.4g}" for name in ("geometry_cylinder_radius", "geometry_interface_offset", "geometry_pivot_distance", "rotational_spring_stiffness")]
        self.answer("R, e, l [mm], k [N mm/rad] = " + ", ".join(lever))
        floor = "design/design-best.prm --set 'Isolation/Base motion=record' --set 'Isolation/Base table=../floor.csv' --set 'Isolation/Drift correction=on' --set Isolation/Duration=60"
        printed = self.user(f"sprag {floor} --set Analysis/Type=study --set Study/Type=isolation --set 'Study/Vary=Isolation/Damper = none, constant friction, lever; Isolation/Friction force = 5, 10, 20, 50, 100' --output dampers")
        best = re.search(r"transmissibility_rms .*least for Isolation/Damper = ([\w ]+), Isolation/Friction force = (\S+) N", printed)
        self.assertIsNotNone(best, printed)
        with h5py.File(self.folder / "dampers/result.h5") as file:
            dampers = file["runs/isolation_damper"].asstr()[:]
            forces, ratios = file["table/isolation_friction_force"][:], file["table/transmissibility_rms"][:]
        force = float(forces[dampers == "constant friction"][np.argmin(ratios[dampers == "constant friction"])])
        for damper in dict.fromkeys(dampers):
            self.answer(f"{damper}: lets through {ratios[dampers == damper].min():.3g}")
        self.answer(f"least: {best.group(1)}, {best.group(2)} N")
        for damper in ("lever", "constant friction"):
            self.user(f"sprag {floor} --set Analysis/Type=isolation --set 'Isolation/Damper={damper}' --set 'Isolation/Friction force={force}' --output {damper.split()[0]}")
        self.user("postprocess/plot.py lever constant -o compared")
        self.assertTrue((self.folder / "compared/curves.png").is_file())
        self.expect_way_end("Isolation")

        self.assertEqual((best.group(1), float(best.group(2))), ("constant friction", force))
        self.assertLess(ratios[dampers == "lever"].min(), ratios[dampers == "none"].min())
        # The drift correction takes a line off the record, which is far below its errors here.
        for damper, friction in (("none", 0.0), ("constant friction", force)):
            run = (dampers == damper) & ((forces == friction) | (damper == "none"))
            self.assertAlmostEqual(ratios[run][0] / transmissibility(acceleration, friction), 1, delta=0.02, msg=damper)


if __name__ == "__main__":
    unittest.main()
