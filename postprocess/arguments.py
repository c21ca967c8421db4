# SPDX-License-Identifier: GPL-3.0-only
"""What the scripts have in common on the command line: where pictures go, in which format, and how they are written."""

import argparse
from pathlib import Path

FORMATS = ("png", "pdf", "svg")
DPI = 200


def parser_of(documentation):
    """A parser whose --help begins with what the script says of itself."""
    return argparse.ArgumentParser(description=documentation, formatter_class=argparse.RawDescriptionHelpFormatter)


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
    """Whether a path ends in a format of pictures."""
    return path is not None and path.suffix[1:] in FORMATS and not path.is_dir()


def picture_paths(options, default):
    """Where one picture goes: -o as it stands where it tells the format, else -o or the default, with each of the formats."""
    output = options.output
    if names_picture(output) and options.format is None:
        return [output]
    base = output / default.name if output is not None and output.is_dir() else output or default
    base = base.with_suffix("") if names_picture(base) else base
    return [base.with_name(f"{base.name}.{ending}") for ending in options.format or ("png",)]


def save(figure, paths, dpi=DPI):
    """Writes a picture, makes the folders it needs and says where it is."""
    for path in paths:
        path.parent.mkdir(parents=True, exist_ok=True)
        if path.suffix == ".png":
            # savefig() would draw twice.
            figure.set_dpi(dpi)
            figure.canvas.print_png(path, pil_kwargs={"compress_level": 2})
        else:
            figure.savefig(path, dpi=dpi)
        print(path)
