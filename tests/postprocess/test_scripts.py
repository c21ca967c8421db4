# SPDX-License-Identifier: GPL-3.0-only
"""Every script is a program with --help, -o and --format."""

import os

from folders import FolderTest
from pages import PAGES
from pictures import FOLDER, draw

SCRIPTS = [path for path in sorted(FOLDER.glob("*.py")) if "def main(" in path.read_text(encoding="utf-8")]
# Needs ParaView's own Python, which knows no h5py.
PARAVIEW = "paraview_pictures.py"
# Writes CSV alone.
ONE_FORMAT = "measure.py"


class ScriptsTest(FolderTest):
    def test_scripts_alone_are_executable(self):
        names = {path.name for path in SCRIPTS}
        self.assertLessEqual({"plot.py", "fields.py", "mesh.py", "comparison.py", "export.py", "device.py", "figures.py"}, names)
        for path in FOLDER.glob("*.py"):
            self.assertEqual(os.access(path, os.X_OK), path.name in names, path.name)
        every = "\n".join(PAGES.values())
        self.assertEqual([name for name in names if name not in every], [])

    def test_they_choose_the_python_that_has_h5py(self):
        for path in SCRIPTS:
            first = path.read_text(encoding="utf-8").splitlines()[0]
            self.assertEqual(first, "#!/usr/bin/env pvpython" if path.name == PARAVIEW else "#!/usr/bin/python3", path.name)

    def test_help(self):
        for path in (path for path in SCRIPTS if path.name != PARAVIEW):
            with self.subTest(path.name):
                done = self.silent(draw(path.name, "--help"))
                for word in ("usage: ", "-o", "--output", *(() if path.name == ONE_FORMAT else ("--format",))):
                    self.assertIn(word, done.stdout)
