"""Runs a script that draws and tells on stderr what is wrong with the layout of each figure that it saves: checked.py SCRIPT ARGUMENTS."""

import runpy
import sys
from pathlib import Path

from matplotlib.figure import Figure

from layout import problems

save = Figure.savefig


def save_checked(figure, path, **options):
    for text in problems(figure):
        print(f"layout of {Path(path).name}: {text}", file=sys.stderr)
    save(figure, path, **options)


Figure.savefig = save_checked
del sys.argv[0]
sys.path.insert(0, str(Path(sys.argv[0]).parent))
runpy.run_path(sys.argv[0], run_name="__main__")
