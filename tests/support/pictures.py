"""What tests of the scripts that draw share."""

import subprocess
from pathlib import Path

from folders import FolderTest

PLOT = Path(__file__).resolve().parents[2] / "postprocess" / "plot.py"


class PictureTest(FolderTest):
    """Has a folder for results and one for pictures."""

    def setUp(self):
        super().setUp()
        self.pictures = self.folder / "pictures"

    def plot(self, *arguments):
        command = ["/usr/bin/python3", PLOT, "--output", self.pictures, *arguments]
        return subprocess.run(command, capture_output=True, text=True, check=False)

    def expect_pictures(self, done, names):
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertEqual(sorted(path.name for path in self.pictures.iterdir()), sorted(names))
        for path in self.pictures.iterdir():
            self.assertGreater(path.stat().st_size, 5000)

    def expect_refusal(self, done, *words):
        self.assertEqual(done.returncode, 2)
        self.assertEqual(done.stderr.count("\n"), 1, done.stderr)
        for word in words:
            self.assertIn(word, done.stderr)
