#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-only
"""Tries deliberate mistakes: each mutant of mutants.toml changes one line of the physics, and the tests that it names ought to fail.

    tests/mutants.py [NAME ...]           # tries these, or all
    tests/mutants.py --list               # tells all with what is wrong in each
    tests/mutants.py --check              # only whether each text occurs exactly once in its file
    tests/mutants.py --build DIR          # where copy and build are kept, build-mutants by default
    tests/mutants.py --jobs 2             # compiles so many files at once

The sources are copied, and only the copy is changed. Its build stays from one mutant to the next, so that each costs the files that it
changes. The exit status is 1 if no test sees a mutant or one does not compile, 2 if the unchanged program fails or an entry is wrong.
"""

import argparse
import functools
import os
import re
import shutil
import signal
import subprocess
import sys
import time
import tomllib
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
LIST = ROOT / "tests" / "mutants.toml"
FIELDS = {"file", "text", "becomes", "wrong", "tests"}
FOLDERS = ("base", "laws", "scene", "results", "model", "fe", "levers", "analysis", "run", "verification")
OUTSIDE = ("robustness", "postprocess")  # their tests start the program
REDUCED = ("-LE", "thorough")  # those that ./test runs


def mutants_listed():
    with open(LIST, "rb") as file:
        return tomllib.load(file)


def holds(test, pattern):
    """Tells if one of the suites, which the name of a test of ctest lists with commas, matches a pattern."""
    return any(re.search(pattern, suite) for suite in test.split(","))


def find_mistakes(name, mutant):
    """Returns the problems of an entry."""
    if set(mutant) != FIELDS:
        return [f"{name}: must have {', '.join(sorted(FIELDS))}"]
    path = ROOT / mutant["file"]
    if not path.is_file():
        return [f"{name}: there is no {mutant['file']}"]
    found = path.read_text(encoding="utf-8").count(mutant["text"])
    problems = []
    if found != 1:
        problems.append(f"{name}: its text occurs {found} times in {mutant['file']}: {mutant['text']}")
    if "\n" in mutant["text"] + mutant["becomes"]:
        problems.append(f"{name}: must change one line")
    if mutant["text"] == mutant["becomes"]:
        problems.append(f"{name}: changes nothing")
    if not find_targets(mutant["tests"]):
        problems.append(f"{name}: names no folder of tests")
    return problems


def find_targets(tests):
    """Programs that tests of these names need."""
    targets = {f"test_{folder}" for folder in FOLDERS if re.search(rf"\b{folder}\b", tests)}
    if any(re.search(rf"\b{folder}\b", tests) for folder in OUTSIDE):
        targets.add("sprag")
    return sorted(targets)


def copy_sources(to):
    """Makes the copy that of the files which git knows or would take; what is the same keeps its time, so that it is not built again."""
    listed = subprocess.run(
        ["git", "ls-files", "-z", "--cached", "--others", "--exclude-standard"], cwd=ROOT, capture_output=True, check=True
    )
    names = {Path(os.fsdecode(name)) for name in listed.stdout.split(b"\0") if name}
    names = {name for name in names if (ROOT / name).is_file()}
    for name in names:
        old = to / name
        if not old.is_file() or old.read_bytes() != (ROOT / name).read_bytes():
            old.parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(ROOT / name, old)
    for path in to.rglob("*"):
        place = path.relative_to(to)
        if path.is_file() and place.parts[0] != "build" and "__pycache__" not in place.parts and place not in names:
            path.unlink()


class Tree:
    """The copy and its build."""

    def __init__(self, folder, jobs):
        self.source = folder / "source"
        self.build = self.source / "build"
        self.logs = folder / "logs"
        self.jobs = jobs
        self.seconds = {}  # that each test took in the unchanged program
        self.source.mkdir(parents=True, exist_ok=True)
        self.logs.mkdir(exist_ok=True)
        copy_sources(self.source)

    def run(self, command, log, limit=None):
        """Returns the exit status, None after `limit` seconds, and the output, which goes into a log as well."""
        with subprocess.Popen(
            list(map(str, command)),
            cwd=self.source,
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
            errors="replace",
            start_new_session=True,
        ) as process:
            try:
                output, status = process.communicate(timeout=limit)[0], process.returncode
            except (KeyboardInterrupt, subprocess.TimeoutExpired) as error:
                os.killpg(process.pid, signal.SIGKILL)
                if isinstance(error, KeyboardInterrupt):
                    raise
                output, status = process.communicate()[0], None
        with open(self.logs / f"{log}.txt", "a", encoding="utf-8") as file:
            file.write(output)
        return status, output

    def configure(self):
        if (self.build / "build.ninja").exists():
            return True
        return self.run(["cmake", "--preset", "release"], "build")[0] == 0

    def compile(self, targets, log):
        """A build that somebody interrupts tells nothing about the mutant and is tried again."""
        for _ in range(3):
            status, output = self.run(["cmake", "--build", self.build, "-j", self.jobs, "--target", *targets], log)
            if status == 0 or "interrupted by user" not in output:
                break
        return status == 0

    @functools.cached_property
    def names(self):
        """Names of the tests of the unchanged program, once it is built."""
        _, output = self.run(["ctest", "--test-dir", self.build, "-N", *REDUCED], "build")
        return re.findall(r"^ *Test +#\d+: (\S+)", output, re.MULTILINE)

    def selection(self, pattern):
        """Options of ctest for the tests with a pattern."""
        return ["-R", "|".join(f"^{re.escape(name)}$" for name in self.names if holds(name, pattern))]

    def test(self, selection, log, limit=None):
        """Returns what failed of the tests selected, by name."""
        command = ["ctest", "--test-dir", self.build, "--output-on-failure", "--no-tests=error", *REDUCED, *selection]
        status, output = self.run(command, log, limit)
        for name, seconds in re.findall(r"Test +#\d+: (\S+) \.+ *Passed +([\d.]+) sec", output):
            self.seconds[name] = float(seconds)
        if status == 0:
            return []
        return failures_in(output) or ["time limit" if status is None else "ctest"]


def failures_in(output):
    """Cases of GoogleTest and unittest that failed; of a test that tells none, its name and how it ended."""
    cases = re.findall(r"\[  FAILED  \] (\w\S*)(?:,| \()", output) + re.findall(r"^(?:FAIL|ERROR): (\w+)", output, re.MULTILINE)
    summary = output.rpartition("The following tests FAILED:")[2]
    for name, reason in re.findall(r"^\s*\d+ - (\S+) \(([^)]+)\)", summary, re.MULTILINE):
        suites = [suite.partition(".")[2] for suite in name.split(",")]
        if reason != "Failed" or not any(suite.partition(".")[0] in case or suite.startswith("test_") for suite in suites for case in cases):
            cases.append(f"{name} ({reason.lower()})")
    return list(dict.fromkeys(cases))


def check_unchanged(tree, mutants):
    """Returns the problems of the unchanged program and of the names of tests."""
    tests = sorted({mutant["tests"] for mutant in mutants.values()})
    targets = sorted(set().union(*map(find_targets, tests)))
    print(f"builds {', '.join(targets)} unchanged", flush=True)
    if not tree.configure() or not tree.compile(targets, "build"):
        return [f"the unchanged program does not build: see {tree.logs / 'build.txt'}"]
    unknown = [pattern for pattern in tests if not any(holds(name, pattern) for name in tree.names)]
    if unknown:
        return [f"no test has a name like {pattern}" for pattern in unknown]
    print(f"runs the tests of {len(mutants)} mutants unchanged", flush=True)
    return [f"the unchanged program fails {failure}" for failure in tree.test(tree.selection("|".join(tests)), "build")]


def find_verdict(tree, name, mutant):
    """Applies a mutant and returns how it ended and what saw it. The source is whole again afterwards."""
    path = tree.source / mutant["file"]
    whole = path.read_text(encoding="utf-8")
    (tree.logs / f"{name}.txt").unlink(missing_ok=True)
    path.write_text(whole.replace(mutant["text"], mutant["becomes"]), encoding="utf-8")
    try:
        if not tree.compile(find_targets(mutant["tests"]), name):
            return "did not compile", []
        usual = sum(seconds for test, seconds in tree.seconds.items() if holds(test, mutant["tests"]))
        seen = tree.test(tree.selection(mutant["tests"]), name, 60 + 20 * usual)
        return ("caught" if seen else "survived"), seen
    finally:
        path.write_text(whole, encoding="utf-8")


def short(seen):
    more = f" and {len(seen) - 2} more" if len(seen) > 2 else ""
    return ", ".join(seen[:2]) + more


def tell(mutants, results):
    wide = max(map(len, results))
    print(f"\n{'mutant':{wide}}  seconds  caught by")
    for name, (verdict, seen, seconds) in results.items():
        note = "" if verdict == "caught" else f"{verdict.upper()}{': ' if seen else ''}"
        print(f"{name:{wide}}  {seconds:7.0f}  {note}{short(seen)}")
    missed = [name for name, (verdict, _, _) in results.items() if verdict in ("survived", "did not compile")]
    for name in missed:
        print(f"\n{name}, {results[name][0]}: {mutants[name]['wrong']}\n    tests: {mutants[name]['tests']}")
    print(f"\n{len(results) - len(missed)} of {len(results)} mutants are seen by a test.")
    return bool(missed)


def try_all(mutants, options):
    tree = Tree(options.build.resolve(), options.jobs)
    if problems := check_unchanged(tree, mutants):
        print("\n".join(problems), file=sys.stderr)
        return 2
    results = {}
    for name, mutant in mutants.items():
        begin = time.monotonic()
        verdict, seen = find_verdict(tree, name, mutant)
        results[name] = (verdict, seen, time.monotonic() - begin)
        print(f"{name}: {verdict}{' by ' if seen else ''}{short(seen)}", flush=True)
    return int(tell(mutants, results))


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("names", nargs="*", metavar="NAME")
    parser.add_argument("--build", type=Path, default=ROOT / "build-mutants", metavar="DIR")
    parser.add_argument("--jobs", type=int, default=1)
    parser.add_argument("--list", action="store_true")
    parser.add_argument("--check", action="store_true")
    options = parser.parse_args()

    mutants = mutants_listed()
    if unknown := [name for name in options.names if name not in mutants]:
        parser.error(f"no mutant {', '.join(unknown)}; --list tells all")
    chosen = {name: mutant for name, mutant in mutants.items() if not options.names or name in options.names}
    if problems := [text for name, mutant in chosen.items() for text in find_mistakes(name, mutant)]:
        print("\n".join(problems), file=sys.stderr)
        return 2
    if options.check:
        print(f"{len(chosen)} mutants fit the sources")
        return 0
    if options.list:
        for name, mutant in chosen.items():
            print(f"{name}\n    {mutant['wrong']}\n    {mutant['file']}: {mutant['text']}\n    becomes {mutant['becomes']}")
            print(f"    tests: {mutant['tests']}")
        return 0
    return try_all(chosen, options)


if __name__ == "__main__":
    sys.exit(main())
