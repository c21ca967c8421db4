# SPDX-License-Identifier: GPL-3.0-only
"""Runs tests and prints them by CPU time; run with /usr/bin/python3.

    tests/times.py                           # all tests of build/
    tests/times.py -R friction               # those with this in their name
    tests/times.py --label quick             # those with this label
    tests/times.py --mutants mutants.json    # beside each test the mistakes that it alone sees

Suites of GoogleTest are tested six at once; below them stand their cases of more than a second of wall time (--least SECONDS).
`tests/mutants.py --write mutants.json` writes which cases see which mistake."""

import argparse
import json
import os
import re
import subprocess
import sys
import tempfile
import xml.etree.ElementTree
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT / "tests" / "support"))
import environment  # noqa: E402
def listed(build):
    """Name, command, labels and working directory of every test."""
    shown = subprocess.run(["ctest", "--show-only=json-v1"], cwd=build, capture_output=True, text=True, check=True)
    for test in json.loads(shown.stdout)["tests"]:
        properties = {entry["name"]: entry["value"] for entry in test.get("properties", [])}
        if "command" in test:
            yield test["name"], test["command"], properties.get("LABELS", []), properties.get("WORKING_DIRECTORY", str(build))


def read_cases(report):
    """Cases of GoogleTest with their wall time [s]."""
    if not report.exists():
        return []
    return [(float(case.get("time", 0)), f"{case.get('classname')}.{case.get('name')}") for case in xml.etree.ElementTree.parse(report).getroot().iter("testcase") if case.get("status") == "run"]


def timed(test, build):
    """Runs a test; its CPU time with that of its children [s], its exit status and its cases."""
    name, command, _, folder = test
    with tempfile.TemporaryDirectory(prefix="sprag-times-") as temporary:
        report = Path(temporary) / "report.xml"
        settings = {**environment.make_environment(build), "GTEST_OUTPUT": f"xml:{report}"}
        process = subprocess.Popen(command, cwd=folder, env=settings, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        _, status, usage = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
        return name, usage.ru_utime + usage.ru_stime, process.returncode, read_cases(report)


def seen_alone(path):
    """Mistakes by the one case that sees them."""
    result = {}
    for mistake, cases in json.loads(Path(path).read_text(encoding="utf-8")).items():
        if len(cases) == 1:
            result.setdefault(cases[0], []).append(mistake)
    return result


def main(arguments):
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", type=Path, default=ROOT / "build")
    parser.add_argument("-R", "--regex", default="")
    parser.add_argument("--label", default="")
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    parser.add_argument("--least", type=float, default=1)
    parser.add_argument("--mutants", metavar="FILE")
    options = parser.parse_args(arguments)
    alone = seen_alone(options.mutants) if options.mutants else {}
    build = options.build.resolve()
    chosen = [test for test in listed(build) if re.search(options.regex, test[0]) and (not options.label or options.label in test[2])]
    with ThreadPoolExecutor(options.jobs) as pool:
        times = list(pool.map(lambda test: timed(test, build), chosen))
    labels = {test[0]: ", ".join(test[2]) for test in chosen}
    for name, seconds, status, cases in sorted(times, key=lambda time: -time[1]):
        failed = f"  FAILED ({status})" if status else ""
        print(f"{seconds:8.1f} s  {labels[name]:9} {name}{failed}  {', '.join(alone.get(name, []))}".rstrip())
        for wall, case in sorted(cases, reverse=True):
            if wall >= options.least or case in alone:
                print(f"{wall:18.1f} s  {case}  {', '.join(alone.get(case, []))}".rstrip())
    print(f"{sum(time[1] for time in times):8.1f} s  all {len(times)}")
    return 1 if any(status for _, _, status, _ in times) else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
