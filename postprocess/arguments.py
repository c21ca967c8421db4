# SPDX-License-Identifier: GPL-3.0-only
"""Options that the scripts share: the place, the format and the writing of pictures."""

import argparse
import sys
import traceback
from functools import wraps
from pathlib import Path

from sprag.program import program
from sprag.results import NotAResult

FORMATS = ("png", "pdf", "svg")
DPI = 200


def make_parser(documentation):
    """A parser whose --help begins with what the script says of itself."""
    return argparse.ArgumentParser(description=documentation, formatter_class=argparse.RawDescriptionHelpFormatter)


def script(main):
    """The exit code of what a script does: 0, or 2 with one line on stderr where a result or file cannot be read or written. What a
    damaged result lacks shows anywhere, by any exception: the line tells what was read and where it failed."""

    name = Path(main.__code__.co_filename).name

    @wraps(main)
    def with_exit_code(arguments=None):
        try:
            main(arguments)
        except Exception as error:
            # Errors of HDF5 name neither a file nor a number of the system's.
            if isinstance(error, NotAResult) or isinstance(error, OSError) and error.errno is not None:
                print(f"{name}: {error}", file=sys.stderr)
                return 2
            place = traceback.extract_tb(error.__traceback__)[-1]
            what = f"{type(error).__name__}: {error}".splitlines()[0]
            where = f"{Path(place.filename).name}, line {place.lineno}"
            named_paths = ", ".join(word for word in map(str, arguments or sys.argv[1:]) if Path(word).exists())
            print(f"{name}: {named_paths}: a result is damaged or of another version of sprag: {what} ({where})", file=sys.stderr)
            return 2
        return 0

    return with_exit_code


def add_program(parser):
    parser.add_argument("--sprag", type=Path, default=program(), metavar="FILE", help="the program (the one built or installed with this script)")


def add_folders(parser, number="+", what="result folder, holding result.h5"):
    parser.add_argument("folders", nargs=number, metavar="DIR", type=Path, help=what)


def add_output(parser, metavar="FILE", default="beside the result", formats=FORMATS, usual="png"):
    """-o and --format. The format is None where it is not given: then the ending of -o FILE tells it, or it is the usual one."""

    def chosen(text):
        parts = tuple(part.strip() for part in text.split(","))
        unknown = sorted(set(parts) - set(formats))
        if unknown:
            raise argparse.ArgumentTypeError(f"unknown format {', '.join(unknown)}: {', '.join(formats[:-1])} or {formats[-1]}")
        return parts

    parser.add_argument("-o", "--output", type=Path, metavar=metavar, help=f"where it goes; default: {default}")
    words = f"{', '.join(formats)}, or several: {formats[0]},{formats[1]} ({usual})"
    parser.add_argument("--format", type=chosen, metavar="FORMAT", help=words)


def names_picture(path):
    """Tells if a path ends in a format of pictures."""
    return path is not None and path.suffix[1:] in FORMATS and not path.is_dir()


def picture_paths(options, default):
    """Returns the paths of one picture: -o as it stands if it names a format, else -o or the default with each of the formats."""
    output = options.output
    if names_picture(output) and options.format is None:
        return [output]
    base = output / default.name if output is not None and output.is_dir() else output or default
    base = base.with_suffix("") if names_picture(base) else base
    return [base.with_name(f"{base.name}.{ending}") for ending in options.format or ("png",)]


def save(figure, paths, dpi=DPI):
    """Writes a picture, makes the folders it needs, and says where it is."""
    for path in paths:
        path.parent.mkdir(parents=True, exist_ok=True)
        if path.suffix == ".png":
            # savefig() would draw twice.
            figure.set_dpi(dpi)
            figure.canvas.print_png(path, pil_kwargs={"compress_level": 2})
        else:
            figure.savefig(path, dpi=dpi)
    print(*paths, sep="\n")
