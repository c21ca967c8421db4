# SPDX-License-Identifier: GPL-3.0-only
"""An installed program needs nothing of its sources. SPRAG must be the program in its build folder."""

import re
import shutil
import subprocess
import unittest
from pathlib import Path

from folders import FolderTest
from runs import SOURCE, SPRAG, TIMEOUT

CHEAP = ("--set", "Mesh/Face size=1", "--set", "Analysis/Step=8", "--set", "Output/Fields=none")


class Install(FolderTest):

    def setUp(self):
        super().setUp()
        self.prefix = self.folder / "prefix"
        self.call("cmake", "--install", Path(SPRAG).parent, "--prefix", self.prefix)
        self.data = self.prefix / "share" / "sprag"

    def call(self, *command, status=0):
        done = subprocess.run(
            [*map(str, command)], capture_output=True, text=True, check=False, timeout=TIMEOUT, cwd=self.folder
        )
        self.assertEqual(done.returncode, status, done.stderr)
        return done

    def test_runs_and_draws_from_anywhere_with_its_own_meshes(self):
        program, scene = self.prefix / "bin" / "sprag", self.data / "params" / "model-a.prm"
        self.call(program, scene, *CHEAP, "--output", "here")
        self.call(self.prefix / "bin" / "sprag-plot", "here")
        self.assertTrue((self.folder / "here" / "forces-over-x.png").is_file(), list((self.folder / "here").iterdir()))
        script = self.data / "meshes" / "lever.geo"
        script.write_text("Physical Surface(")
        message = self.call(program, scene, *CHEAP, "--output", "there", status=2).stderr
        self.assertIn(str(script), message)

    def test_python_finds_its_package(self):
        code = f"import sprag; print(sprag.run({str(self.data / 'params' / 'closed-form-a.prm')!r}).summary['status'])"
        environment = {"PYTHONPATH": str(self.prefix / "lib" / "python3" / "dist-packages"), "PATH": "/usr/bin:/bin", "OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"}
        done = subprocess.run(["/usr/bin/python3", "-c", code], capture_output=True, text=True, check=False, env=environment, cwd=self.folder)
        self.assertEqual((done.returncode, done.stdout.strip()), (0, "completed"), done.stderr)

    def completions(self, *words):
        """Returns the completions of bash for the last of the words."""
        code = 'source "$1"; shift; COMP_WORDS=("$@"); COMP_CWORD=$(($# - 1)); _sprag "$1"; printf "%s\\n" "${COMPREPLY[@]}"'
        script = self.prefix / "share" / "bash-completion" / "completions" / "sprag"
        return self.call("bash", "-c", code, "bash", script, self.prefix / "bin" / "sprag", *words).stdout.split("\n")[:-1]

    def test_bash_completes_its_words(self):
        self.assertEqual(self.completions("--set", "Lever/Dep"), ["Lever/Depth="])
        self.assertEqual(self.completions("--set", "Mesh/Face\\ s"), ["Mesh/Face\\ size="])
        self.assertEqual(self.completions("--help", "Lever/Dep"), ["Lever/Depth"])
        self.assertEqual(self.completions("--new", "own.prm", "--from", "model-"), ["model-a", "model-b"])
        self.assertEqual(self.completions("--over"), ["--overwrite"])
        (self.folder / "own.prm").touch()
        (self.folder / "own.txt").touch()
        self.assertEqual(self.completions("ow"), ["own.prm"])

    def test_manual_page_has_every_option(self):
        page = (self.prefix / "share" / "man" / "man1" / "sprag.1").read_text().replace("\\-", "-")
        printed = self.call(self.prefix / "bin" / "sprag", "--help").stdout
        for option in re.findall(r"^  (?:-h,)?(--[a-z-]+)", printed, re.MULTILINE):
            self.assertRegex(page, rf"(?m)^\.B\S* .*{option}\b", option)
        self.assertIn(self.call(self.prefix / "bin" / "sprag", "--version").stdout.split()[1], page)

    def test_nothing_of_it_names_the_sources(self):
        for path in self.prefix.rglob("*"):
            if path.is_file() and path.suffix in (".py", ".prm", ".geo", ".md"):
                self.assertNotIn(str(SOURCE), path.read_text(), path)

    def test_scenes_and_pages_are_all_there(self):
        for folder, suffix, to in (("params", ".prm", self.data), ("meshes", ".geo", self.data), ("postprocess", ".py", self.data)):
            for path in (SOURCE / folder).glob(f"*{suffix}"):
                self.assertTrue((to / folder / path.name).is_file(), path)
        pages = self.prefix / "share" / "doc" / "sprag"
        for path in ("README.md", "params/README.md", "postprocess/README.md", "postprocess/notebooks/my-device.ipynb"):
            self.assertTrue((pages / path).is_file(), path)


class Version(unittest.TestCase):
    def test_is_the_same_everywhere(self):
        printed = subprocess.run([SPRAG, "--version"], capture_output=True, text=True, check=True).stdout.split()[1]
        self.assertIn(f"\n## {printed} ", (SOURCE / "CHANGELOG.md").read_text())
        self.assertIn(f"\nversion: {printed}\n", (SOURCE / "CITATION.cff").read_text())
        self.assertIn(f" version = {{{printed}}},\n", (SOURCE / "README.md").read_text())
        if not shutil.which("git"):
            return
        tag = subprocess.run(["git", "-C", SOURCE, "describe", "--tags"], capture_output=True, text=True, check=False)
        if tag.returncode == 0:
            self.assertEqual(re.match(r"v?([0-9.]+)", tag.stdout).group(1), printed)
