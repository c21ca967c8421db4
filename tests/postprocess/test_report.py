# SPDX-License-Identifier: GPL-3.0-only
"""Reports: what stands in them, that they load nothing and run nothing of a stranger's file."""

import base64
import re
import shutil
from html.parser import HTMLParser

import h5py
import numpy as np

from pictures import PictureTest
import sketch
from apparatus import Geometry
from sprag import parameters
from sprag.results import read_result
from real_results import run_once

HOSTILE = "<script>alert(1)</script><img src=http://example.org/x onerror=alert(1)>"
DEVICE = {
    "Geometry/Cylinder radius": "56", "Geometry/Interface offset": "45.6", "Geometry/Pivot distance": "185.5", "Geometry/Pivot height": "0", "Lever/Length": "210", "Lever/Depth": "20",
    "Friction layer/Thickness": "1", "Drive/Stroke": "65", "Analysis/Type": "quasi-static",
}  # fmt: skip
LISTING = """subsection Analysis
  set Type = quasi-static
end
subsection Lever
  # Depth of the metal [mm]: a number > 0.
  set Depth = 12  # default: 20
  set Width = 40.0  # default: 40
  # Stiffness of the contact [N/mm^n]: a number > 0.
  set Contact = 9541  # default: 2000
end
"""


class Page(HTMLParser):
    """Tags with their attributes, and the text."""

    def __init__(self, text):
        super().__init__()
        self.tags, self.words = [], []
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        self.tags.append((tag, dict(attributes)))

    def handle_data(self, data):
        self.words.append(data)


class ReportTest(PictureTest):
    def result(self, name, listing=LISTING, warning=None):
        """A copy of a run with another listing of its parameters, and a warning."""
        folder = shutil.copytree(run_once("closed-form-a"), self.folder / name)
        with h5py.File(folder / "result.h5", "r+") as file:
            del file["parameters"]
            file["parameters"] = listing
            file["accuracy/P"] = 0.0123
            if warning:
                file["warnings/hostile"] = warning
                file["warnings/hostile"].attrs["remedy"] = f"remedy {warning}"
        return folder

    def report(self, *folders):
        done = self.silent(self.plot("--report", *folders))
        path = self.pictures / "report.html"
        self.assertEqual(done.stdout.splitlines()[-1], str(path))
        text = path.read_text(encoding="utf-8")
        return Page(text), " ".join(re.sub(r"<[^>]*>", " ", text.replace("<wbr>", "")).split())

    def test_of_one_run(self):
        page, words = self.report(self.result("a"))
        for said in ("largest P forward 14.68 N, backward", "peak_P_backward", "25.71", "\N{PLUS-MINUS SIGN} 1.2 %", "0.07969 N/mm", "Completed, no warnings.", "Lever/Depth 12 mm 20", "Lever/Contact 9541 N/mm^n 2000"):
            self.assertIn(said, words)
        self.assertNotIn("Lever/Width", words)
        scene = next(data for data in page.words if "subsection" in data)
        self.assertEqual({name: value.text for name, value in parameters.parse(scene).items()}, {"Lever/Depth": "12", "Lever/Contact": "9541"})
        pictures = [attributes["src"] for tag, attributes in page.tags if tag == "img"]
        self.assertEqual(len(pictures), 1)  # forces
        for source in pictures:
            self.assertTrue(base64.b64decode(source.removeprefix("data:image/png;base64,")).startswith(b"\x89PNG"))

    def test_of_several(self):
        page, words = self.report(self.result("a"), self.result("b", LISTING.replace("12", "16")))
        self.assertIn("Comparison of 2 results", words)
        self.assertIn("Lever/Depth 12 mm 16 mm", words)
        self.assertIn("Comparison of 2 results Lever/Depth 12 mm quasi-static, folder a", words)

    def test_limits_are_those_of_the_answer(self):
        """The answer rounds a limit of 5.60535 mm to the stable side, 5.606 mm."""
        folder = self.result("a")
        with h5py.File(folder / "result.h5", "a") as file:
            for name, value in (("critical_lever_depth_1", 5.60535432), ("critical_lever_depth_1_error", 0.18011955)):
                file["summary"][name] = value
                file["summary"][name].attrs.update(unit="mm", headline=1)
        _, words = self.report(folder)
        self.assertRegex(words, "critical_lever_depth_1 .*5.60535 \N{PLUS-MINUS SIGN} 0.18 mm mm")
        self.assertNotIn("critical_lever_depth_1_error", words)

    def test_a_lever_that_does_not_isolate_is_not_drawn(self):
        result = read_result(self.result("a"))
        known = {name: parameters.Parameter(text, "1") for name, text in DEVICE.items()}
        self.assertIn("<svg", sketch.device_svg(result, known))
        for damper, drawn in (("lever", True), ("viscous", False)):
            for study in ({"Analysis/Type": "isolation"}, {"Analysis/Type": "study", "Study/Type": "isolation"}):
                texts = {**study, "Isolation/Damper": damper}
                known.update({name: parameters.Parameter(text, "1") for name, text in texts.items()})
                self.assertEqual(sketch.device_svg(result, known) is not None, drawn)

    def test_nothing_is_loaded_or_run(self):
        hostile = LISTING.replace("= 12 ", f"= {HOSTILE} ") + "subsection Friction\n  set Law = </pre><script>alert(2)</script>  # default: Coulomb\nend\n"
        page, words = self.report(self.result("a", hostile, HOSTILE))
        self.assertIn("alert(1)", " ".join(page.words))  # it is shown
        self.assertFalse({"script", "iframe", "object", "link", "a"} & {tag for tag, _ in page.tags})
        for tag, attributes in page.tags:
            self.assertFalse([name for name in attributes if name.startswith("on")])
            self.assertTrue(attributes.get("src", "data:").startswith("data:"), attributes)
        policy = [attributes["content"] for tag, attributes in page.tags if attributes.get("http-equiv") == "Content-Security-Policy"]
        self.assertEqual(len(policy), 1)
        self.assertIn("default-src 'none'", policy[0])

    def test_device_to_scale(self):
        """The lever's face touches the cylinder in the picture."""
        geometry = Geometry(56.0, 45.6, np.array((185.5, 0.0)), 65.0, 0.0)
        drawing = sketch.drawn(geometry, 210.0, 20.0, 1.0, {})
        circle = re.search(r'class="cylinder" cx="([\d.-]+)" cy="([\d.-]+)" r="([\d.]+)"', drawing)
        centre, radius = np.array((float(circle[1]), float(circle[2]))), float(circle[3])
        begin, end = np.array([pair.split(",") for pair in re.search(r'class="layer" points="([^"]+)"', drawing)[1].split()], dtype=float)[:2]
        along = (end - begin) / np.linalg.norm(end - begin)
        away = centre - begin
        self.assertAlmostEqual(abs(along[0] * away[1] - along[1] * away[0]), radius, delta=2e-3)
        self.assertAlmostEqual(np.linalg.norm(end - begin), 210, delta=2e-3)

    def test_verdict_along_the_path(self):
        """Stretches that are not stable lie on the line of their direction."""
        summary = {"looked_from": 3.25, "looked_to": 65.0, "largest_growth_rate_forward": -5.0, "largest_growth_rate_backward": 60.0}
        found = sketch.stretches({**summary, "unstable_backward": "14.66 to 18.21 mm, 56.3 to 65 mm"})
        self.assertEqual(found["forward"], [(3.25, 65.0, sketch.STABLE)])
        self.assertEqual([line[:2] for line in found["backward"]], [(3.25, 65.0), (14.66, 18.21), (56.3, 65.0)])
        self.assertEqual(sketch.stretches({"growth_rate": 5.0}), {})
        drawing = sketch.drawn(Geometry(56.0, 45.6, np.array((185.5, 0.0)), 65.0, 0.0), 210.0, 20.0, 1.0, found)
        lines = re.findall(r'class="verdict" x1="([\d.]+)" x2="([\d.]+)" y1="(-?[\d.]+)"', drawing)
        self.assertEqual([(float(a), float(b), float(y) > 0) for a, b, y in lines], [(3.25, 65, False), *((*line[:2], True) for line in found["backward"])])

    def test_a_run_that_goes_on(self):
        self.result("a")
        with h5py.File(self.folder / "a/result.h5", "r+") as file:
            del file["summary"], file["meta"]
        _, words = self.report(self.folder / "a")
        self.assertIn("goes on, or was killed", words)
