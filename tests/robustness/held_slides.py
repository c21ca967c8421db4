# SPDX-License-Identifier: GPL-3.0-only
"""Held slides from outside: what modal, stability, map and sprag-slip scenes are refused for, and what becomes of a slide that jams."""

import math
import re

import numpy as np

from bad_input import ProgramTest
from runs import SOURCE, RunTest, run_scene, sets, sprag


BEAM = {"Analysis/Model": "beam"}
MAP = {**BEAM, "Analysis/Type": "map"}
SLIP = {**BEAM, "Analysis/Type": "sprag slip"}
# {what is refused: (what is set, {setting: texts of the one message about it})}
REFUSED = {
    "map of other parameters": (MAP, {
        "Map/First parameter=Lever/Dept": ["Lever/Dept is no parameter with a number", "did you mean 'Lever/Depth'"],
        "Map/Second parameter=Friction/Law": ["no parameter with a number"],
        "Map/Coarsest=6": ["power of 2"],
    }),
    "map of bad ranges": ({**MAP, "Map/First to": 25, "Map/Second from": 0.5, "Map/Second to": 0.5, "Map/First from": 0}, {
        "Map/First parameter=Lever/Depth": ["Lever/Depth = 0 ", "> 0"],
        "Map/First points=1": [">= 2"],
        "Map/Second parameter=Friction/Factor": ["Friction/Factor must have a range, not 0.5 alone"],
        "Map/Second points=2.5": ["must be an integer >= 2"],
        "Map/Bisections=-1": ["Map/Bisections"],
    }),
    "map of one parameter": (
        {**MAP, "Map/First parameter": "Lever/Depth", "Map/First from": 3, "Map/First to": 9, "Map/Second from": 3, "Map/Second to": 9},
        {"Map/Second parameter=Lever/Depth": ["must be another than First parameter"]},
    ),
    **{f"{kind} that cannot be held": ({"Analysis/Type": kind}, {
        "Stability/Position=80": ["0 ... 65 mm"],
        "Contact/Type=ideal": ["must be compliant"],
        "Analysis/Model=closed form": ["which has no vibration"],
    }) for kind in ("modal", "stability", "sprag slip")},
    **{f"{kind} of what is not linear": ({"Analysis/Type": kind, "Analysis/Model": "condensed"}, {
        "Lever/Material=neo-Hookean": ["must be linear", "where a slide is held"],
        "Contact/Enforcement=augmented Lagrangian": ["must be penalty", "where a slide is held"],
    }) for kind in ("modal", "stability", "sprag slip", "map")},
    **{f"critical values {text}": ({**BEAM, "Analysis/Type": "stability"}, {f"Stability/Critical={text}": says}) for text, says in {
        "Lever/Depth -3 25": ["Lever/Depth = -3", "> 0"],
        "Lever/Depht 3 25": ["Lever/Depht is no parameter with a number", "did you mean 'Lever/Depth'"],
        "Lever/Material 0 1": ["Lever/Material is no parameter with a number"],
        "Lever/Depth 3 3": ["Lever/Depth must have a range, not 3 alone"],
        "Lever/Depth 3": ["must be auto, none or a list of SECTION/NAME FROM TO"],
        "Friction/Coefficient 0.1 1": ["Friction/Coefficient counts only with Friction/Law = Coulomb", "Friction/Factor"],
    }.items()},
    "ranges of one parameter": ({**BEAM, "Analysis/Type": "stability"}, {
        "Stability/Ranges=Contact/Damping 0.01 0.1; Contact/Damping 0.02 0.05": ["Contact/Damping must be there once only"],
    }),
    **{f"ranges of {text}": ({**BEAM, "Analysis/Type": "stability", "Stability/Position": 65}, {f"Stability/Ranges={text}": says}) for text, says in {
        "Stability/Position 20 40": ["Stability/Position is no constant"],
        "Drive/Stroke 50 70": ["with Drive/Stroke = 50: Stability/Position must lie on the drive, 0 ... 50 mm"],
        "Geometry/Interface offset 40 70; Lever/Depth 5 6": [
            "with Geometry/Interface offset = 70, Lever/Depth = 5: Geometry/Interface offset must be less than Cylinder radius R = 56 mm",
        ],
    }.items()},
    "sprag slip that cannot begin": ({**SLIP, "Sprag slip/Initial amplitude": 0.1}, {
        "Sprag slip/Final amplitude=0.01": ["more than Initial amplitude = 0.1"],
        "Sprag slip/Turn=70": ["0 ... 65 mm"],
    }),
    "continuation to where it begins": (
        {**SLIP, "Stability/Position": 30}, {"Sprag slip/Turn=30": ["must be another x than Stability/Position = 30 mm"]},
    ),
}  # fmt: skip


class BadSlide(ProgramTest):
    def test_is_refused(self):
        scene = self.write("")
        for name, (changes, wrong) in REFUSED.items():
            with self.subTest(name):
                messages = self.refused(scene, *sets(changes), *sets([*wrong]), says=(), mistakes=len(wrong))
                for setting, texts in wrong.items():
                    (message,) = [each for each in messages if each.startswith(f"--set: {setting.replace('=', ' = ', 1)}: ")]
                    for text in texts:
                        self.assertIn(text, message)

    def test_turn_does_not_count_without_continuation(self):
        there = {**SLIP, "Stability/Position": 30, "Sprag slip/Turn": 30, "Sprag slip/Continuation": 0}
        self.silent(sprag(self.write(""), *sets(there), "--validate"))

    def test_values_that_cannot_be_judged_are_told(self):
        """The drive ends at 65 mm; 100 mm is a number like any other."""
        printed = self.completed("stability-a", ("Stability/Roles=off", "Stability/Critical=Stability/Position 40 100"))
        found = re.search(r"from 40 to 100 mm: stable, flutter from 5\d\.\d+ \+- \S+ mm; cannot be judged at (\S+) to 100 mm \(\d+ values\), as \S", printed)
        self.assertTrue(found, printed)
        self.assertTrue(65 < float(found.group(1)) <= 70, found.group(0))

    def test_processes_of_a_map(self):
        scene = SOURCE / "params" / "map-friction-depth-a.prm"
        for number in ("0", "-1", "x", "1.5", ""):
            with self.subTest(jobs=number):
                self.refused(scene, "--jobs", number, says=["--jobs"])


class JammedSlide(ProgramTest):
    """Model A moving back at x = 65 mm with 5 times the friction, mu = 3.6: s = 120 mm < mu e = 164 mm. Its own lever of 6 mm bends
    away: it slides at any friction, under forces that crush its layer. One of 20 mm locks soon after the rigid one."""

    JAMMED = ("Friction/Factor=5", "Lever/Depth=20")

    def test_is_a_verdict(self):
        for model in ("beam", "condensed"):
            with self.subTest(model=model):
                changes = ("Mesh/Face size=4", f"Analysis/Model={model}", "Stability/Critical=none")
                self.assertRegex(self.completed("stability-a", (*self.JAMMED, *changes)), r"verdict +jammed\n")
                found = self.read("summary")
                self.assertEqual((found["verdict"], found["status"]), ("jammed", "completed"))
                self.assertTrue(np.isnan(found.get("growth_rate", np.nan)))

    def test_has_modes(self):
        self.completed("stability-a", (*self.JAMMED, "Analysis/Type=modal"))
        self.assertTrue((self.read("modes")["frequency"] > 0).all())

    def test_cannot_be_perturbed(self):
        done = run_scene("stability-a", (*self.JAMMED, "Analysis/Type=sprag slip"), "--output", self.output)
        self.assertEqual(done.returncode, 1)
        self.assertEqual(len(done.stderr.splitlines()), 1, done.stderr)
        for text in ("no slide in contact", "x = 65 mm", "Try another Stability/Position or a smaller friction"):
            self.assertIn(text, done.stderr)
        found = self.read("summary")
        self.assertEqual(found["slide"], "jammed")
        self.assertIn("no slide in contact", found["status"])


class LimitCycle(RunTest):
    """A beam of 7.5 mm, whose vibration repeats itself, and one of 6 mm, whose vibration does not."""

    def run_lever(self, depth):
        done = self.succeeded(run_scene("onset-a", (f"Lever/Depth={depth}", "Sprag slip/Continuation=0"), "--output", self.output, "--overwrite"))
        return done.stdout

    def test_tells_its_error(self):
        self.assertRegex(self.run_lever(7.5), r"errors, estimated +cycle_amplitude_P [\d.]+ %, cycle_frequency [\d.]+ %, cycle_vibrations [\d.]+ %\n")
        self.assertTrue(1e-3 < self.read("accuracy", "cycle_amplitude_P")["cycle_amplitude_P"] < 2e-2)
        self.assertRegex(self.run_lever(6), r"not estimated +cycle_amplitude_P, cycle_frequency, cycle_vibrations: .*P does not repeat itself")


class Damping(RunTest):
    """A beam of 15 mm moving out at x = 40 mm, which damping of the contact makes grow."""

    def summary(self, damping):
        changes = ("Analysis/Model=beam", "Lever/Depth=15", "Stability/Direction=forward", "Stability/Position=40", "Stability/Critical=none")
        self.assertIn("verdict holds", self.completed("stability-a", (*changes, f"Contact/Damping={damping}")))
        return self.read("summary")

    def test_is_told_with_the_verdict(self):
        found = self.summary(0.02)
        self.assertLess(found["growth_rate"], 0)
        limit = found["contact_damping_limit_high"]
        self.assertTrue(0.02 < limit < 0.1, limit)
        # 2 pi f c/k of P = 13068.5 N/mm^1.5 delta^1.5, c = 2 zeta sqrt(k J)/s at the largest P of the closed form and s there.
        stiffness = lambda P: 1.5 * 13068.5 ** (2 / 3) * P ** (1 / 3)
        damping = 2 * limit * math.sqrt(stiffness(25.71) * 6.45) / 120.05
        loss_factor = 2 * math.pi * found["frequency"] * damping / stiffness(found["P"])
        self.assertAlmostEqual(found["contact_loss_factor_limit_high"], loss_factor, delta=0.01 * loss_factor)
        self.assertLess(self.summary(0.96 * limit)["growth_rate"], 0)
        beyond = self.summary(1.04 * limit)
        self.assertGreater(beyond["growth_rate"], 0)
        self.assertAlmostEqual(beyond["contact_damping_limit_low"], limit, delta=0.01 * limit)


class FallingFriction(RunTest):
    """A beam moving back at x = 65 mm at 10 mm/s, mu = 0.6 + 0.3 exp(-v/10 mm/s)."""

    CHANGES = ("Analysis/Model=beam", "Stability/Critical=none", "Stability/Roles=off", "Friction/Law=Stribeck", "Friction/Stribeck speed=10", "Drive/Speed=10")

    def run_with(self, *changes):
        printed = self.completed("stability-a", (*self.CHANGES, *changes))
        return self.read("summary"), printed

    def stiffness_in_stick(self):
        """dP/d(delta)/2 at the largest P of the closed form, the Poisson ratio of the layer being 0."""
        l, e, R, k = 185.5, 45.6, 56.0, 7.4e4
        largest = 0
        for x in range(66):
            theta, start = math.asin((R - e) / (l - x)), math.asin((R - e) / l)
            s = (l - x) * math.cos(theta)
            for sign in (1, -1):
                slip = 10 * (math.cos(theta) - e * math.sin(theta) / s)
                largest = max(largest, k * (theta - start) / (s + sign * (0.6 + 0.3 * math.exp(-slip / 10)) * e))
        return 0.5 * 1.5 * 13068.5 ** (2 / 3) * largest ** (1 / 3)

    def test_limits_are_those_of_runs_with_these_values(self):
        found, printed = self.run_with()
        self.assertIn("no warnings", printed)
        k_t = self.stiffness_in_stick()
        for name, change in {
            "soft_stick": f"Contact/Tangential stiffness={0.1 * k_t}",
            "rigid_stick": "Contact/Tangential stiffness=1e10",
            "short_memory": "Friction/Memory length=1e-3",
            "long_memory": "Friction/Memory length=0.1",
        }.items():
            with self.subTest(name):
                other = self.run_with(change)[0]["growth_rate"]
                self.assertAlmostEqual(found["growth_rate_" + name], other, delta=0.01 * abs(other))

    def test_runs_away_where_shear_outweighs_memory(self):
        theta = math.asin(10.4 / 120.5)
        slip = 10 * (math.cos(theta) - 45.6 * math.sin(theta) / (120.5 * math.cos(theta)))
        P = self.run_with()[0]["P"]
        length = slip * 0.03 * math.exp(-slip / 10) * P / self.stiffness_in_stick()  # v mu' P / k_t
        for factor in (0.97, 1.03):
            with self.subTest(factor):
                printed = self.run_with(f"Friction/Memory length={factor * length}")[1]
                self.assertEqual("runaway_slip" in printed, factor < 1)


class NearLocking(RunTest):
    """A lever of 20 mm moving back at x = 65 mm: Newton's method misses the slide from the ideal lever at 2.3, 2.45 and 2.5."""

    def held(self, *coefficients):
        """Verdicts and P, which is not finite where it jams; a row of a study each."""
        changes = ("Analysis/Model=condensed", "Mesh/Face size=1", "Condensed/Modes=6", "Lever/Depth=20", "Friction/Law=Coulomb")
        changes += ("Analysis/Type=study", "Study/Type=stability", f"Study/Vary=Friction/Coefficient = {', '.join(map(str, coefficients))}", "Stability/Critical=none")
        changes += ("Stability/Roles=off", "Stability/Direction=backward", "Stability/Position=65", "Stability/Damping=off")
        self.completed("stability-a", changes, "--quiet")
        return self.read("runs", "verdict")["verdict"], self.read("table", "P")["P"]

    def test_is_followed_to_a_slide_and_jams_beyond_the_fold(self):
        """Equilibria end at mu = 2.6475, on faces of 0.5, 0.25 and 0.125 mm alike."""
        verdicts, forces = self.held(2.25, 2.3, 2.5, 2.635, 2.66)
        # The closed form grows by (s - 2.25 e)/(s - 2.5 e) = 2.9; a lever that bends less.
        self.assertTrue(forces[0] < forces[1] < forces[2] < 2.9 * forces[0], forces)
        self.assertGreater(forces[3], 700)
        self.assertEqual((verdicts[4], np.isfinite(forces[4])), ("jammed", False))


class Stroke(RunTest):
    """A beam of 10 mm of model A, which is stable moving back and flutters on its way out."""

    STROKE = ("Stability/Position=auto", "Stability/Direction=both", "Lever/Depth=10", "Stability/Critical=none", "Stability/Roles=off")

    def run_with(self, *changes):
        done = self.succeeded(run_scene("stability-a", changes, "--output", self.output, "--overwrite"))
        return done.stdout

    PLACES = np.linspace(3.25, 65, 32)

    def dense(self, depths):
        """Growth of slides held one by one: [depth, forward or backward, place]."""
        vary = f"Lever/Depth = {', '.join(map(str, depths))}; Stability/Direction = forward, backward; Stability/Position = {', '.join(map(str, self.PLACES))}"
        self.run_with(*self.STROKE, "Analysis/Type=study", "Study/Type=stability", f"Study/Vary={vary}")
        return self.read("table")["growth_rate"].reshape(len(depths), 2, -1)

    def test_is_looked_at_both_ways(self):
        printed = self.run_with(*self.STROKE)
        found = self.read("summary")
        self.assertRegex(printed, r"looked at +modes up to [\d.e+]+ Hz, x = 3.25 mm to 65 mm, \d+ judged\n")
        self.assertRegex(printed, r"forward +growth at most [\d.]+ 1/s, unstable at x = [\d.]+ to [\d.]+ mm")
        places = self.PLACES
        for way, growth in zip(("forward", "backward"), self.dense((10,))[0]):
            # A parabola between slides 2 mm apart: its top is nearer to the next one than a tenth of the growth's range.
            self.assertAlmostEqual(found[f"largest_growth_rate_{way}"], growth.max(), delta=0.02 * np.ptp(growth))
            unstable = places[growth > 0]
            if unstable.size == 0:
                self.assertTrue(np.isnan(found[f"unstable_{way}_from"]))
                continue
            for end, x in (("from", unstable[0]), ("to", unstable[-1])):
                self.assertAlmostEqual(found[f"unstable_{way}_{end}"], x, delta=places[1] - places[0])
        self.assertGreater(found["unstable_forward_to"], found["unstable_forward_from"] + 10)
        # The verdict says that it looked at one place.
        printed = self.run_with(*self.STROKE, "Stability/Position=65", "Stability/Direction=backward")
        self.assertRegex(printed, r"verdict +stable")
        self.assertRegex(printed, r"looked at +modes up to [\d.e+]+ Hz, x = 65 mm, 1 judged\n")
        self.assertNotRegex(printed, "forward +growth|unstable at")

    def test_soft_stick_that_turns_the_verdict_stands_with_it(self):
        text = "but unstable with a tenth of the stiffness in stick"
        self.assertNotIn(text, self.run_with(*self.STROKE))
        self.assertIn(text, self.run_with(*self.STROKE, "Lever/Depth=20"))
        soft = self.read("summary")["growth_rate_soft_stick"]
        # dP/d(delta)/2 of the law at the largest P of the closed form, 25.71 N, is 1230 N/mm.
        self.run_with(*self.STROKE, "Lever/Depth=20", "Contact/Tangential stiffness=123")
        self.assertAlmostEqual(self.read("summary")["growth_rate"], soft, delta=0.02 * soft)

    def test_own_value_is_among_those_tried(self):
        # A narrow range that flutters, far from the points of a wide search.
        support = ("Support/Type=sprung", "Support/Mass=1e-4", "Support/Stiffness=3000", "Support/Damping=0.005")
        contact = ("Contact/Exponent=1", "Contact/Stiffness=2000", "Contact/Damping=0.005")
        printed = self.run_with("Analysis/Model=rigid", *support, *contact, "Friction/Law=Coulomb", "Friction/Coefficient=0.55", "Stability/Position=40",
                                "Stability/Direction=forward", "Stability/Roles=off", "Stability/Critical=Contact/Stiffness 20 2e5")  # fmt: skip
        self.assertRegex(printed, "verdict +flutter")
        low, high = (self.read("summary")[f"critical_contact_stiffness_{i}"] for i in (1, 2))
        self.assertTrue(low < 2000 < high, (low, high))

    def test_error_of_a_limit_is_that_of_growth_over_its_slope(self):
        changes = ("Lever/Depth=12", "Analysis/Model=condensed", "Mesh/Face size=1", "Contact/Damping=0.1", "Stability/Direction=forward", "Stability/Roles=off")
        printed = self.run_with(*changes, "Stability/Position=auto", "Stability/Critical=Friction/Factor 0.3 0.9")
        limit, half_width = (self.read("summary")["critical_friction_factor_1" + part] for part in ("", "_error"))
        x = re.search(r"forward at x = ([\d.]+) mm", printed).group(1)
        growth = []
        for share in (0.96, 1.04, 1):
            self.run_with(*changes, f"Stability/Position={x}", "Stability/Critical=none", f"Friction/Factor={share * limit}")
            growth.append(self.read("summary")["growth_rate"])
        error = self.read("accuracy")["growth_rate"] * abs(growth[2])
        slope = (growth[1] - growth[0]) / (0.08 * limit)
        self.assertAlmostEqual(half_width, error / slope + 1e-3 * 0.6, delta=0.02 * half_width)

    def test_ranges_give_the_worst_of_their_ends(self):
        damping, friction = (0.005, 0.1), (0.8, 1.2)
        place = (*self.STROKE, "Lever/Depth=13", "Stability/Position=40")
        self.run_with(*place, "Stability/Ranges=Contact/Damping 0.005 0.1; Friction/Factor 0.8 1.2")
        found = self.read("summary")["growth_rate"]
        vary = f"Contact/Damping = 0.02, {damping[0]}, {damping[1]}; Friction/Factor = 1, {friction[0]}, {friction[1]}; Stability/Direction = forward, backward"
        self.run_with(*place, "Analysis/Type=study", "Study/Type=stability", f"Study/Vary={vary}")
        table = self.read("table")
        corner = [(z == 0.02) == (f == 1) for z, f in zip(table["contact_damping"], table["friction_factor"])]
        self.assertAlmostEqual(found, table["growth_rate"][corner].max(), delta=1e-6 * abs(found))
        # Levers of 8, 20 and 24 mm are stable there, those between 8 and 14 mm flutter.
        printed = self.run_with(*self.STROKE, "Lever/Depth=20", "Stability/Position=40", "Stability/Direction=forward", "Stability/Ranges=Lever/Depth 8 24")
        self.assertRegex(printed, r"verdict +flutter")
        self.assertRegex(printed, r"Lever/Depth=10\b")


class BeamError(RunTest):
    """Growth that is smaller than what the elements of a beam may be off: eight, then up to 32."""

    UNDAMPED = ("Lever/Modal damping=0",)

    def test_leaves_a_verdict_undecided(self):
        changes = ("Analysis/Type=stability", "Friction/Coefficient=0.45", "Lever/Depth=10.3333", "Stability/Direction=forward", "Stability/Critical=none", "Stability/Roles=off")
        # 64 elements grow by 0.07573 1/s, eight by 0.079. The condensed lever does not decide it.
        for model, verdict in (("beam", r"flutter, growth 0\.0757"), ("condensed", r"undecided, growth \S+")):
            printed = self.completed("map-friction-depth-a", (*changes, *self.UNDAMPED, f"Analysis/Model={model}"))
            self.assertRegex(printed, rf"verdict +{verdict}\d* 1/s, at 3[56]\d")
        printed = self.completed("map-friction-depth-a", changes)
        self.assertRegex(printed, r"verdict +stable, growth -22")
        # The condensed lever grows by 0.02 1/s; a beam that grows by 1e-8 |lambda| does not say that it is stable.
        thin = ("Lever/Depth=3.5", "Contact/Damping=0", "Friction/Factor=0.3", "Stability/Direction=backward", "Stability/Position=10")
        printed = self.completed("stability-a", (*thin, *self.UNDAMPED, "Stability/Critical=none", "Stability/Roles=off"))
        self.assertRegex(printed, r"verdict +undecided, growth 0\.00\d+ 1/s, at 25\d\d")

    def test_of_another_mode_leaves_a_verdict_undecided(self):
        # All but one die out by more than they are off; that one is not the slowest to do so.
        place = ("Lever/Depth=6", "Contact/Damping=0.005", "Stability/Direction=forward", "Stability/Position=25")
        printed = self.completed("stability-a", (*place, *self.UNDAMPED, "Stability/Critical=none", "Stability/Roles=off"))
        self.assertRegex(printed, r"verdict +undecided, growth -2\.06\d* 1/s, at 45\d")

    def test_leaves_cells_of_a_map_undecided(self):
        changes = ("Map/First points=2", "Map/Second points=5", "Map/Coarsest=1", "Map/Bisections=0", *self.UNDAMPED)
        self.completed("map-friction-depth-a", changes, "--quiet")
        cells, summary = self.read("map"), self.read("summary")
        rate, error = (cells[name + "_forward"] for name in ("growth_rate", "growth_error"))
        self.assertAlmostEqual(summary["undecided_forward"], np.mean(abs(rate) < error))
        self.assertAlmostEqual(summary["unstable_forward"], np.mean(rate > error))

    def test_moves_a_critical_value(self):
        depth = ("Stability/Critical=Lever/Depth 8 10", "Stability/Roles=off")
        self.completed("stability-a", depth)
        limit, half_width = (self.read("summary")["critical_lever_depth_1" + part] for part in ("", "_error"))
        found = {}
        for share in (0.96, 1, 1.04):
            self.completed("stability-a", (f"Lever/Depth={share * limit}", "Stability/Critical=none", "Stability/Roles=off"))
            found[share] = self.read("summary")
        slope = (found[1.04]["growth_rate"] - found[0.96]["growth_rate"]) / (0.08 * limit)
        self.assertAlmostEqual(half_width, 9e-4 / 4**3 * 2 * np.pi * found[1]["frequency"] / abs(slope), delta=0.01 * half_width)
        # Without damping its error is wider than a limit of friction.
        friction = (*self.UNDAMPED, "Lever/Depth=20", "Contact/Damping=0", "Stability/Critical=Friction/Factor 0 3", "Stability/Roles=off")
        self.assertRegex(self.completed("stability-a", friction), r"stable, undecided, flutter from 0\.114\d* \(mu")
        self.assertGreater(self.read("summary")["critical_friction_factor_1_error"], 0.114)


class SearchProgress(RunTest):
    def test_ends_near_all_of_it(self):
        """Slides differ in number by ten between values of a search."""
        place = ("Stability/Position=40", "Stability/Direction=forward", "Stability/Ranges=Contact/Damping 0.01 0.1; Friction/Factor 0.8 1.2")
        changes = ("Analysis/Model=condensed", "Mesh/Face size=2", "Stability/Critical=Lever/Depth 9 25", "Stability/Roles=off", *place)
        done = run_scene("stability-a", changes, "--output", self.output)
        shares = [int(share) for share in re.findall(r"(\d+) %", done.stderr)]
        self.assertEqual(shares[-1], 100, done.stderr)
        self.assertGreaterEqual(shares[-2], 80, done.stderr)
        self.assertLess(np.diff(shares).max(), 25, done.stderr)


class StiffLever(RunTest):
    """Tests a lever far stiffer than the spring at its pivot, as verdicts leave out flexure."""

    def test_is_condensed(self):
        changes = ("Analysis/Model=condensed", "Mesh/Face size=2", "Lever/Young's modulus=7e8", "Stability/Critical=none", "Stability/Roles=off")
        self.assertRegex(self.completed("stability-a", changes), r"verdict +stable")


class LeverOfAnyDepth(RunTest):
    """Condensed; thin ones next to parts that are much stiffer, such as the elements of a leaf spring."""

    DEPTHS = "3, 5, 6, 8, 12, 20, 30"
    FLANGE = ("Lever frame/Flange=1",)
    SPACE = ("Analysis/Dimension=3", "Mesh/Face size=6", "Mesh/Elements across=2")
    SCENES = (("leaf-a",), ("plate-a", *FLANGE), ("apparatus-a", *FLANGE), ("pair-modal-a",), ("leaf-a", *SPACE))

    def frequencies(self, scene, *changes, model="condensed"):
        """Returns those of modes 1 to 3, each over the depths."""
        sweep = ("Analysis/Type=study", "Study/Type=modal", f"Study/Vary=Lever/Depth = {self.DEPTHS}", f"Analysis/Model={model}")
        self.completed(scene, ("Mesh/Face size=2", *sweep, *changes), "--quiet")
        self.assertEqual(set(self.read("runs", "outcome")["outcome"]), {"completed"}, self.read("runs", "reason"))
        return np.array([self.read("table")[f"frequency_{mode}"] for mode in (1, 2, 3)])

    def test_on_a_leaf_spring_vibrates_as_a_beam(self):
        lone = ("leaf-a", "Stability/Contact=open")
        condensed, beam = self.frequencies(*lone), self.frequencies(*lone, model="beam")
        np.testing.assert_allclose(condensed[:, :5], beam[:, :5], rtol=0.015)
        np.testing.assert_allclose(condensed[0], beam[0], rtol=2e-3)

    def test_vibrates_faster_with_each_part(self):
        for scene in self.SCENES:
            with self.subTest(scene):
                self.assertTrue((np.diff(np.log(self.frequencies(*scene))) > -1e-3).all())
