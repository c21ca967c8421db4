# SPDX-License-Identifier: GPL-3.0-only
"""Shares helpers between tests of the scripts that draw, and puts those scripts on the path."""

import subprocess
import sys
from pathlib import Path

import checked
from folders import FolderTest
from layout import problems

SOURCE = Path(__file__).resolve().parents[2]
FOLDER = SOURCE / "postprocess"
sys.path.insert(0, str(FOLDER))
from style import plt, use_print_style  # noqa: E402


def draw(script, *arguments, own_process=False):
    """Its stderr tells what is wrong with the layout, too. A test that has the drawn file open needs a process of its own."""
    if not own_process:
        return checked.run_in_copy(FOLDER / script, arguments)
    command = ["/usr/bin/python3", Path(__file__).parent / "checked.py", FOLDER / script, *arguments]
    return subprocess.run(command, capture_output=True, text=True, check=False)


class PictureTest(FolderTest):
    """Has a folder for results and one for pictures."""

    def setUp(self):
        super().setUp()
        self.pictures = self.folder / "pictures"
        use_print_style()
        self.addCleanup(plt.close, "all")

    def plot(self, *arguments, **options):
        return draw("plot.py", "--output", self.pictures, *arguments, **options)

    def expect_picture(self, done, name):
        """In the folder of the result a."""
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertIn(str(self.folder / "a" / f"{name}.png"), done.stdout.splitlines())

    def expect_pictures(self, done, names):
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertEqual(sorted(path.name for path in self.pictures.iterdir()), sorted(names))
        self.assertEqual(sorted(Path(line).name for line in done.stdout.splitlines()), sorted(names))

    def expect_layout(self, figure):
        """Nothing empty, cut, hidden or over one another."""
        self.assertEqual(problems(figure), [])

    def expect_refusal(self, done, *words):
        self.assertEqual(done.returncode, 2)
        self.assertEqual(done.stderr.count("\n"), 1, done.stderr)
        for word in words:
            self.assertIn(word, done.stderr)
