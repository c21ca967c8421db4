# SPDX-License-Identifier: GPL-3.0-only
"""Runs a script that draws and prints on stderr what is wrong with the layout of each figure that it saves: checked.py SCRIPT ARGUMENTS.

`run_in_copy()` does so in a copy of this process, which has loaded matplotlib already. A file that this process has open is open in the
copy as well: such a test needs a process of its own."""

import os
import runpy
import subprocess
import sys
import tempfile
import traceback
from pathlib import Path

from matplotlib import image
from matplotlib.backends.backend_agg import FigureCanvasAgg

from layout import problems


def print_checked(canvas, path, **options):
    """Writes what problems() has drawn."""
    for text in problems(canvas.figure):
        print(f"layout of {Path(path).name}: {text}", file=sys.stderr, flush=True)
    image.imsave(path, canvas.buffer_rgba(), format="png", origin="upper", dpi=canvas.figure.dpi, **options)


def run(script, arguments):
    """Exit status of the script as a program."""
    FigureCanvasAgg.print_png = print_checked
    sys.argv = [str(script), *map(str, arguments)]
    sys.path.insert(0, str(Path(script).parent))
    try:
        runpy.run_path(str(script), run_name="__main__")
    except SystemExit as end:
        if isinstance(end.code, str):
            print(end.code, file=sys.stderr)
        return end.code if isinstance(end.code, int) else int(end.code is not None)
    except BaseException:
        traceback.print_exc()
        return 1
    return 0


def run_in_copy(script, arguments):
    """Runs a script in a fork and returns the same as subprocess.run() of a program."""
    with tempfile.TemporaryFile() as out, tempfile.TemporaryFile() as errors:
        child = os.fork()
        if child == 0:
            os.dup2(out.fileno(), 1)
            os.dup2(errors.fileno(), 2)
            sys.stdout, sys.stderr = open(1, "w", encoding="utf-8", closefd=False), open(2, "w", encoding="utf-8", closefd=False)
            status = run(script, arguments)
            sys.stdout.flush()
            sys.stderr.flush()
            os._exit(status)
        status = os.waitstatus_to_exitcode(os.waitpid(child, 0)[1])
        texts = [(stream.seek(0), stream.read().decode("utf-8", "replace"))[1] for stream in (out, errors)]
        return subprocess.CompletedProcess([script, *arguments], status, *texts)


if __name__ == "__main__":
    sys.exit(run(sys.argv[1], sys.argv[2:]))
