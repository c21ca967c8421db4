# SPDX-License-Identifier: GPL-3.0-only
"""Tests the output of a run: the lines that answer its question, everything with --verbose, and all of it again in run.log."""

import fcntl
import os
import pty
import re
import struct
import subprocess
import termios


from runs import SOURCE, SPRAG, TIMEOUT, RunTest, run_scene, sets, sprag

SHORT = {
    "model-a": ("Mesh/Face size=1", "Analysis/Step=4", "Output/Fields=none"),
    "closed-form-a": (),
    "reversal-a": ("Analysis/Model=rigid",),
    "support-a": ("Analysis/Model=rigid",),
}
MANY_TURNS = ("Analysis/Model=rigid", "Contact/Type=ideal", "Drive/Cycles=10")
MOST_LINES = 20


class Output(RunTest):
    def run_scene(self, scene, *options, **environment):
        done = self.succeeded(run_scene(scene, SHORT[scene], *options, "--output", self.output, "--overwrite", env={**os.environ, **environment}))
        return done

    def test_a_few_lines_say_what_applies_and_the_log_has_all(self):
        for scene in SHORT:
            with self.subTest(scene):
                done = self.run_scene(scene)
                lines = done.stdout.partition("Warning:")[0].splitlines()
                self.assertLess(len(lines), MOST_LINES)
                self.assertFalse([line for line in lines if "nan" in line or "inf" in line.split()])
                self.assertEqual(any("on the ground" in line for line in lines), scene == "support-a")
                self.assertEqual(any("largest stress" in line for line in lines), scene == "model-a")
                self.expect_log(scene, done)
                if scene == "model-a":
                    self.expect_file_peaks(next(line for line in lines if "largest P" in line))

    def expect_file_peaks(self, line):
        for way, printed in re.findall(r"(forward|backward) (\S+) N", line):
            self.assertAlmostEqual(float(printed) / self.read("summary")[f"peak_P_{way}"], 1, delta=1e-3)

    def on_a_terminal(self, *arguments, columns=0, typed="", **environment):
        """Returns the output of a run on a terminal and its exit status."""
        ours, its = pty.openpty()
        fcntl.ioctl(its, termios.TIOCSWINSZ, struct.pack("HHHH", 24, columns, 0, 0))
        os.write(ours, typed.encode())
        inherited = {name: value for name, value in os.environ.items() if name != "NO_COLOR"}
        with subprocess.Popen([SPRAG, *map(str, arguments)], stdin=its, stdout=its, stderr=its, env={**inherited, **environment}) as run:
            os.close(its)
            got = b""
            try:
                while more := os.read(ours, 4096):
                    got += more
            except OSError:  # the end of a pseudo-terminal
                pass
            os.close(ours)
            return got.decode(), run.wait(TIMEOUT)

    def test_a_terminal_alone_gets_colours(self):
        settings = ("Friction/Law=Coulomb", "Friction/Coefficient=2.62")
        warned = (SOURCE / "params/closed-form-a.prm", *sets(settings), "--output", self.output)
        text, status = self.on_a_terminal(*warned)
        self.assertEqual(status, 0, text)
        self.assertIn("\033[33mWarning: near_locking\033[0m", text)
        log = (self.output / "run.log").read_text()
        self.assertIn("\nWarning: near_locking\n", log)
        self.assertNotIn("\033", log)
        for environment, arguments in (({"NO_COLOR": "1"}, (*warned, "--overwrite")), ({"NO_COLOR": "1"}, (self.folder / "none.prm",))):
            self.assertNotIn("\033", self.on_a_terminal(*arguments, **environment)[0])
        text, status = self.on_a_terminal(self.folder / "none.prm")
        self.assertEqual(status, 2)
        self.assertTrue(text.startswith("\033[31m"), text)
        self.assertNotIn("\033", sprag(self.folder / "none.prm").stderr)
        # On all cores mpirun gives the processes a pseudo-terminal, whatever its own output is.
        small = sets(("Map/First points=2", "Map/Second points=2", "Map/Coarsest=1", "Map/Bisections=0"))
        small += ["--jobs", "2", "--output", self.output / "map"]
        for show, colours in ((lambda *words: sprag(*words).stdout, 0), (lambda *words: self.on_a_terminal(*words)[0], 1)):
            text = show(SOURCE / "params/map-offset-inclination.prm", *small, "--overwrite")
            self.assertEqual((text.count("Warning: defaults_of_model_a"), text.count("\033[33m")), (1, colours), text)

    def test_lines_are_no_wider_than_the_terminal(self):
        columns = 60
        text, status = self.on_a_terminal(SOURCE / "params/model-a.prm", *sets(SHORT["model-a"]), "--output", self.output, columns=columns)
        self.assertEqual(status, 0, text)
        self.assertRegex(text, r" %  +\d+:\d\d left")
        self.assertLessEqual(max(map(len, re.split(r"[\r\n]+", text))), columns)
        log = (self.output / "run.log").read_text().splitlines()
        self.assertGreater(max(map(len, log)), columns)
        self.assertTrue(set(" ".join(log).split()) >= set(text.rpartition("largest P")[2].partition("\033")[0].split()), text)

    def test_a_new_scene_is_asked_for(self):
        new = self.folder / "press.prm"
        text, status = self.on_a_terminal("--new", new, typed="40\n12 kg\n22\n150\n\n\n\n170\n" + 20 * "\n")
        self.assertEqual(status, 0, text)
        self.assertIn("Geometry/Interface offset, e, from the pivot to the friction face, less than R [12 mm]: ", text)
        self.assertIn("'kg' has the dimension kg", text)
        self.assertEqual(sprag(new, "--validate").returncode, 0)
        scene = new.read_text()
        for name, value in (("Cylinder radius", "40"), ("Interface offset", "22"), ("Pivot distance", "150"), ("Stroke", "40 mm")):
            self.assertRegex(scene, rf"set {name} += {value} +# ")
        # Another law has other parameters.
        (self.folder / "mu.csv").write_text("speed,mu\n0,0.6\n10,0.65\n30,0.7\n100,0.8\n")
        for law, asked, typed in (("table", "Table", "mu.csv"), ("Stribeck", "Stribeck speed", "0.8\n0.5\n20"), ("cork on aluminium", "", "")):
            new = self.folder / f"{law.split()[0]}.prm"
            text, status = self.on_a_terminal("--new", new, typed=12 * "\n" + f"{law}\n{typed}\n" + 9 * "\n")
            self.assertEqual(status, 0, text)
            self.assertIn(f"Friction/{asked}", text)
            self.assertNotIn("Friction/Coefficient", text)
            self.assertEqual(sprag(new, "--validate").returncode, 0)
            self.assertIn(typed.rpartition("\n")[2], new.read_text())

    def test_many_reversals_are_a_table_with_an_end(self):
        lines = self.run_scene("reversal-a", *sets(MANY_TURNS)).stdout.splitlines()
        turns = sum(name.endswith("_verdict") for name in self.read("summary"))
        self.assertGreater(turns, 12)
        self.assertTrue(any(f"and {turns - 12} more in /summary" in line for line in lines), lines)

    def test_verbose_prints_all(self):
        text = self.run_scene("reversal-a", "--verbose").stdout
        for name in self.read("summary"):
            self.assertIn(name, text)

    def expect_log(self, scene, done):
        log = (self.output / "run.log").read_text()
        self.assertRegex(log, r"\Asprag \d+\.\d+\.\d+( \(\w+\+?\))?, \d{4}-\d\d-\d\d \d\d:\d\d:\d\d ")
        self.assertIn(f"{scene}.prm", log.splitlines()[1])
        for setting in SHORT[scene]:
            self.assertIn(setting.replace("=", " = "), log)
        for line in (done.stdout + done.stderr).splitlines():
            self.assertIn(line, log)

    def test_of_a_progress_bar_the_log_has_the_last_line(self):
        scene = (SOURCE / "params/reversal-a.prm", "--set", "Analysis/Model=rigid", "--output", self.output)
        text, status = self.on_a_terminal(*scene, columns=100)
        self.assertEqual(status, 0, text)
        self.assertGreater(text.count(" %  x "), 1)
        self.assertEqual((self.output / "run.log").read_text().count(" %  x "), 1)

    def test_the_log_tells_of_a_failure(self):
        settings = (*SHORT["model-a"], "Analysis/Maximum deviation=1e-6")
        done = run_scene("model-a", settings, "--output", self.output)
        self.assertEqual(done.returncode, 1, done.stdout)
        self.assertIn(done.stderr.splitlines()[-1], (self.output / "run.log").read_text())
