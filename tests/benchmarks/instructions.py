# SPDX-License-Identifier: GPL-3.0-only
"""Counts the instructions of a command and of the processes that it makes."""

import re
import shutil
import subprocess
import tempfile
from pathlib import Path


class Perf:
    """Counts instructions by the processor's counters, where it lets programs read them."""

    def __init__(self, file):
        self.file = file
        self.command = ["perf", "stat", "-x,", "-e", "instructions:u", "-o", file]

    def count(self):
        return sum(map(int, re.findall(r"^(\d+),", self.file.read_text(), re.MULTILINE)))

    @staticmethod
    def works():
        if shutil.which("perf") is None:
            return False
        with tempfile.TemporaryDirectory() as folder:
            perf = Perf(Path(folder) / "counted")
            subprocess.run([*perf.command, "true"], check=False)
            return perf.file.exists() and perf.count() > 0


class Valgrind:
    """Counts instructions by executing them one by one, at a twentieth of the speed. A process that is made knows what its parent
    counted so far, which is written and forgotten before."""

    def __init__(self, file):
        self.file = file
        self.command = ["valgrind", "--tool=callgrind", "--trace-children=yes", "--dump-before=*fork*"]
        self.command += [f"--callgrind-out-file={file}.%p", f"--log-file={file}-log.%p"]

    def count(self):
        parts = self.file.parent.glob(f"{self.file.name}.*")
        return sum(int(number) for part in parts for number in re.findall(r"^totals: (\d+)", part.read_text(), re.MULTILINE))


def counter_class():
    return Perf if Perf.works() else Valgrind
