# SPDX-License-Identifier: GPL-3.0-only
"""What analyses of all kinds print: few lines, and every number with its unit. Run with /usr/bin/python3; environment: SPRAG, the
program, and SPRAG_SOURCE, the sources."""

import re
import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "support"))
from runs import SOURCE, RunTest, sprag  # noqa: E402

COARSE = ("Mesh/Face size=1",)
MAP = ("Analysis/Model=beam", "Map/Coarsest=2", "Map/First points=5", "Map/Second points=5", "Map/Bisections=1")
# Scene: settings that make it cheap, and the most lines that it may print before its warnings.
SCENES = {
    "closed-form-a": ((), 10),
    "fig10": ((), 3),
    "contact-law-a": (COARSE, 6),
    "calibration-a": (COARSE, 16),
    "modal-a": (COARSE, 12),
    "pair-modal-a": (COARSE, 12),
    "stability-a": ((), 23),
    "pair-stability-a": ((), 23),
    "isolation-free-a": ((), 12),
    "isolation-a": ((), 12),
    "isolation-ground-a": ((), 12),
    "onset-b": (("Sprag slip/Continuation=2",), 14),
    "map-position-depth-a": (MAP, 8),
    "study-a": (("Study/Vary=Mesh/Face size = 4, 2, 1", "Study/Reference=Mesh/Face size = 0.5"), 16),
    "study-offset-a": (("Study/Vary=Isolation/Initial displacement = 5, 60",), 10),
    "reversal-a": (("Analysis/Model=beam",), 20),
}

NUMBER = r"[-+]?\d+(?:\.\d+)?(?:e[-+]?\d+)?"
# Units, and what is counted.
UNIT = (
    r"(?:N mm/rad|N mm\^2|N/mm\^n|N/mm\^3|N/mm|N mm|N|MPa|t mm\^?2|mm/s\^2|mm/s|mm|Hz|1/s|s|rad|%)(?![\w/^])"
    r"|(?:of|more|runs|completed|failed|refused|steps|turns|stops|periods?|points|processes|values|in the grid|judged)\b"
)
WITH_UNIT = re.compile(rf"{NUMBER}(?:(?: to|,)? +{NUMBER})? (?:{UNIT})")
# Numbers that have none.
PURE = re.compile(
    rf"\b(?:mu =|n =|delta\^|peak|first harmonic|root mean square|transmissibility|tolerance|[\w /]+/(?:Degree|Modes|Factor|Damping) (?:=|from)) {NUMBER}(?: \(?(?:{NUMBER} )?to {NUMBER})?"
    rf"|flutter from {NUMBER} \(|order .*|x = 0\b|of degree \d|[a-z],? \d\."
)


def without_what_is_told(line):
    """The line less its numbers with units and those that need none."""
    return PURE.sub("", WITH_UNIT.sub("", line))


def numbers_without_unit(lines):
    """Lines with more numbers without a unit than the heading of their table has columns with one."""
    columns = 0
    for line in lines:
        left = re.findall(rf"(?<![\w/.^]){NUMBER}(?![\w/^])", without_what_is_told(line))
        if heading := re.findall(r"\[[^\]]+\]", line):
            columns = len(heading) + line.startswith("  reversal")
        elif not left:
            columns = 0 if re.search(r"\d", line) else columns
        if len(left) > columns:
            yield line


class Printed(RunTest):
    def lines_of(self, scene, *options):
        settings = [word for setting in SCENES[scene][0] for word in ("--set", setting)]
        done = sprag(SOURCE / "params" / f"{scene}.prm", *settings, *options, "--output", self.output, "--overwrite")
        self.assertEqual(done.returncode, 0, done.stderr)
        return re.split(r"\n\s*(?:Warning:|Lines for|Scenes:)", done.stdout)[0].splitlines()

    def test_few_lines_every_number_with_its_unit_and_nothing_that_does_not_apply(self):
        for scene, (_, most) in SCENES.items():
            with self.subTest(scene):
                lines = self.lines_of(scene)
                self.assertTrue(0 < len(lines) <= most, "\n".join(lines))
                self.assertEqual(list(numbers_without_unit(lines)), [])
                # Jamming and a support where there is none, numbers that nobody knows.
                if scene in ("modal-a", "contact-law-a", "isolation-free-a", "isolation-ground-a"):
                    self.assertNotRegex("\n".join(lines), r"\bnan\b|\binf\b|Jamming|support|harmonic balance")

    def test_a_number_without_unit_is_seen(self):
        table = ["  growth [1/s]  frequency [Hz]", "  as it is  77.39  186.1", "  cost  2 s of CPU time", "  as it is 1 2"]
        self.assertEqual(list(numbers_without_unit(["  margin  0.743", "  P = 3 N, Q = 4"])), ["  margin  0.743", "  P = 3 N, Q = 4"])
        self.assertEqual(list(numbers_without_unit(table)), table[-1:])

    def test_verbose_prints_the_rest(self):
        for scene, name in (("stability-a", "uniqueness"), ("isolation-a", "energy_residual"), ("modal-a", "frequency")):
            with self.subTest(scene):
                self.assertIn(name, "\n".join(self.lines_of(scene, "--verbose")))


if __name__ == "__main__":
    unittest.main()
