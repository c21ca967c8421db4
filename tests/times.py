"""Runs tests and prints them by CPU time; run with /usr/bin/python3.

    tests/times.py                           # all tests of build/
    tests/times.py -R friction               # those with this in their name
    tests/times.py --label quick             # those with this label
    tests/times.py --mutants mutants.json    # beside each test the mistakes that it alone sees

A suite of GoogleTest is one test, with the CPU time of its dearest case in brackets (wall time of the case, as GoogleTest tells it).
`tests/mutants.py --write mutants.json` writes which test sees which mistake."""

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
ENVIRONMENT = {
    "OMP_NUM_THREADS": "1",
    "OPENBLAS_NUM_THREADS": "1",
    "OMPI_ALLOW_RUN_AS_ROOT": "1",
    "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1",
    "OMPI_MCA_pml": "ob1",
    "SPRAG_SOURCE": str(ROOT),
    "SPRAG_BUILD_TYPE": "Release",
}


def listed(build):
    """Name, command, labels and working directory of every test."""
    shown = subprocess.run(["ctest", "--show-only=json-v1"], cwd=build, capture_output=True, text=True, check=True)
    for test in json.loads(shown.stdout)["tests"]:
        properties = {entry["name"]: entry["value"] for entry in test.get("properties", [])}
        if "command" in test:
            yield test["name"], test["command"], properties.get("LABELS", []), properties.get("WORKING_DIRECTORY", str(build))


def dearest_case(report):
    """The case of a suite that takes longest, with its wall time [s]; empty where nothing was reported."""
    if not report.exists():
        return ""
    cases = xml.etree.ElementTree.parse(report).getroot().iter("testcase")
    times = sorted(((float(case.get("time", 0)), case.get("name")) for case in cases), reverse=True)
    return f"{times[0][1]} {times[0][0]:.1f}" if times else ""


def timed(test, build):
    """Runs a test; its CPU time with that of its children [s], its exit status and its dearest case."""
    name, command, _, folder = test
    with tempfile.TemporaryDirectory(prefix="sprag-times-") as temporary:
        report = Path(temporary) / "report.xml"
        environment = {**os.environ, **ENVIRONMENT, "SPRAG": str(build / "sprag"), "GTEST_OUTPUT": f"xml:{report}"}
        process = subprocess.Popen(command, cwd=folder, env=environment, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        _, status, usage = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
        return name, usage.ru_utime + usage.ru_stime, process.returncode, dearest_case(report)


def seen_alone(path):
    """Mistakes by the one suite that sees them."""
    result = {}
    for mistake, cases in json.loads(Path(path).read_text(encoding="utf-8")).items():
        suites = {case.partition(".")[0] for case in cases}
        if len(suites) == 1:
            result.setdefault(suites.pop(), []).append(mistake)
    return result


def suite_of(name):
    """BeamStatics of model.BeamStatics."""
    return name.partition(".")[2].partition(".")[0]


def main(arguments):
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", type=Path, default=ROOT / "build")
    parser.add_argument("-R", "--regex", default="")
    parser.add_argument("--label", default="")
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    parser.add_argument("--mutants")
    options = parser.parse_args(arguments)
    alone = seen_alone(options.mutants) if options.mutants else {}
    build = options.build.resolve()
    chosen = [test for test in listed(build) if re.search(options.regex, test[0]) and (not options.label or options.label in test[2])]
    with ThreadPoolExecutor(options.jobs) as pool:
        times = list(pool.map(lambda test: timed(test, build), chosen))
    labels = {test[0]: ", ".join(test[2]) for test in chosen}
    for name, seconds, status, case in sorted(times, key=lambda time: -time[1]):
        failed = f"  FAILED ({status})" if status else ""
        print(f"{seconds:8.1f} s  {labels[name]:9} {name}  [{case}]{failed}  {', '.join(alone.get(suite_of(name), []))}".rstrip())
    print(f"{sum(time[1] for time in times):8.1f} s  all {len(times)}")
    return 1 if any(status for _, _, status, _ in times) else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
