# SPDX-License-Identifier: GPL-3.0-only
"""Checks the syntax of each source file alone, without the files it is grouped with and without precompiled headers, so that each
includes what it uses. Takes some 15 minutes of CPU time; run with /usr/bin/python3."""

import json
import os
import shlex
import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
OPTIONS = ("-DSPRAG_UNITY=OFF", "-DSPRAG_PRECOMPILE=OFF", "-DCMAKE_EXPORT_COMPILE_COMMANDS=ON", "-DCMAKE_CXX_COMPILER_LAUNCHER=env")


def check_syntax(entry):
    """Returns the first lines of what the compiler says against a file."""
    command = [word for word in shlex.split(entry["command"]) if word not in ("-c", "-o")]
    command = [word for word in command if not word.endswith(".o")] + ["-fsyntax-only"]
    done = subprocess.run(command, cwd=entry["directory"], capture_output=True, text=True, check=False)
    return "".join(line + "\n" for line in done.stderr.splitlines()[:5]) if done.returncode else ""


def main():
    with tempfile.TemporaryDirectory(prefix="sprag-alone-") as build:
        subprocess.run(["cmake", "--preset", "release", "-B", build, *OPTIONS], cwd=ROOT, check=True, stdout=subprocess.DEVNULL)
        entries = [entry for entry in json.loads((Path(build) / "compile_commands.json").read_text(encoding="utf-8")) if f"{ROOT}/src/" in entry["file"]]
        with ThreadPoolExecutor(os.cpu_count()) as pool:
            problems = [text for text in pool.map(check_syntax, entries) if text]
    print(f"{len(entries)} files, {len(problems)} with errors\n" + "".join(problems), end="")
    return 1 if problems or not entries else 0


if __name__ == "__main__":
    sys.exit(main())
