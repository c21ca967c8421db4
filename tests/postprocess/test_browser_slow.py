# SPDX-License-Identifier: GPL-3.0-only
"""A report as a browser shows and prints it, where Chromium is installed; run with /usr/bin/python3."""

import os
import shutil
import subprocess
import sys
import unittest
from pathlib import Path

import numpy as np
from PIL import Image

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "support"))

from pictures import SOURCE, PictureTest  # noqa: E402
import sprag  # noqa: E402

SCENES = Path(os.environ.get("SPRAG_SOURCE", SOURCE)) / "params"
BROWSER = shutil.which("chromium")
DEVICE = (((0xD7, 0xE3, 0xEE), 2000), ((0xC9, 0x8F, 0x4A), 30))  # colours of lever and thin layer, and how many points have them


@unittest.skipUnless(BROWSER, "chromium is not installed")
class BrowserTest(PictureTest):
    def browse(self, *options):
        command = [BROWSER, "--headless", "--no-sandbox", "--disable-gpu", "--hide-scrollbars", f"--user-data-dir={self.folder}/profile"]
        subprocess.run([*command, *options, f"file://{self.pictures}/report.html"], check=True, capture_output=True, timeout=300)

    def test_device_and_pictures_are_seen(self):
        sprag.run(SCENES / "model-a.prm", {"Mesh/Face size": 2, "Analysis/Step": 4}, output=self.folder / "a")
        self.assertEqual(self.plot("--report", self.folder / "a").returncode, 0)
        shot = self.folder / "shot.png"
        self.browse("--window-size=1000,4600", f"--screenshot={shot}")
        seen = np.asarray(Image.open(shot).convert("RGB")).astype(int)
        for colour, least in DEVICE:
            self.assertGreater((np.abs(seen - colour).max(axis=2) < 3).sum(), least)
        # The fields are the last picture.
        inked = np.flatnonzero((seen.min(axis=2) < 200).any(axis=1))
        self.assertGreater(inked.max(), 2500)
        violet = np.abs(seen - (0x44, 0x01, 0x54)).max(axis=2) < 12  # no stress, in viridis
        self.assertGreater(violet.sum(), 2000)
        self.browse(f"--print-to-pdf={self.folder}/report.pdf", "--no-pdf-header-footer")
        pages = (self.folder / "report.pdf").read_bytes()
        self.assertTrue(pages.startswith(b"%PDF"))
        self.assertIn(b"/MediaBox [0 0 59", pages)  # A4, 595 x 842 points


if __name__ == "__main__":
    unittest.main()
