#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-only
"""Runs the tests of a Python file, which finds those beside it and in support/: script.py FILE [names of tests, options of unittest].
Environment: SPRAG, the program, and SPRAG_SOURCE, the sources; else those of this tree. Exits 1 where one fails or there is none."""

import importlib
import sys
import unittest
from pathlib import Path

FILE = Path(sys.argv[1]).resolve()
sys.path[:0] = [str(FILE.parent), str(Path(__file__).resolve().parent / "support")]
result = unittest.main(importlib.import_module(FILE.stem), argv=sys.argv[1:], exit=False).result
sys.exit(not result.wasSuccessful() or not (result.testsRun or result.skipped))
