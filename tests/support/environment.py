# SPDX-License-Identifier: GPL-3.0-only
"""The environment in which ctest runs the tests of a build, for scripts that start them or the program by themselves."""

import os
import re
from pathlib import Path


def make_environment(build):
    """This process' environment with what `environment.cmake` of a build sets."""
    text = (Path(build) / "tests" / "environment.cmake").read_text(encoding="utf-8")
    return {**os.environ, **dict(re.findall(r'^set\(ENV\{(\w+)\} "?([^")]*)"?\)', text, re.MULTILINE))}
