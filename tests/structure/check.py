# SPDX-License-Identifier: GPL-3.0-only
"""Holds the shape of the sources: include directions, the bound on the dimension, file lengths, comments that are no
fragments, identifiers in the field's words, scenes all described, pages whose links hold and that are not too long."""

import os
import pathlib
import re
import sys
import tokenize

ROOT = pathlib.Path(os.environ.get("SPRAG_SOURCE", pathlib.Path(__file__).parents[2]))

# A folder of src/ includes itself and what stands before it; the programs include any. An analysis knows no mesh.
PROGRAMS = ["main.cc", "main_models.cc"]
ORDER = ["base", "laws", "scene", "input", "results", "analytic", "report", "program", "model", "fe", "levers", "analysis", "estimate", "run"]
UNSEEN = {"analysis": ["fe"]}
# So do the rooms of a folder.
ROOMS = {
    "model": ["interface", "step", "structure", "contact", "lever"],
    "fe": ["algebra", "body", "mesh", "contact", "statics", "dynamics", "leaf", "fields"],
    "analysis": ["statics", "accuracy", "transient", "isolation", "stability", "limit_cycle", "task_farm", "map", "study", "calibration", "identification", "design"],
}
CODE = {".cc", ".h", ".py", ".sh", ".geo", ".cmake", ".txt"}
MAX_LINES = 600
LICENCE = "SPDX-License-Identifier: GPL-3.0-only"
# The longest page, in words as wc counts them. The references of all parameters and results are looked into, not read.
MAX_WORDS = 1500
REFERENCES = [pathlib.Path("params/parameters.md"), pathlib.Path("params/warnings.md"), *(pathlib.Path("postprocess") / name for name in ("results.md", "summary.md", "summary-of-analyses.md"))]
# In pieces, or this file would find itself.
UNFINISHED = re.compile(r"\b(TO" r"DO|FIX" r"ME)\b")

# A comment or docstring is a sentence with a verb, or names the thing itself: no fragment.
FRAGMENT = re.compile(r"""\s*(?:///?<? |# |\"{3})(Of|What|Whether|Where|How|By|As)\b""")

# Identifiers are the field's words: `stress`, `compute_stress`, `lever_stress`, not `stress_of` or `of_lever`.
UNNAMED = re.compile(r"\b(of|of_\w+|\w+_of(?:_\w+)?|(?:\w+_)?(?:told|given|wanted)(?:_\w+)?)\b")
NAMED = {"find_first_of", "find_last_of", "find_first_not_of", "find_last_not_of", "any_of", "all_of", "none_of", "is_any_of", "out_of_range",
         "pack_rtree_of_indices", "moment_of_inertia", "out_of_plane", "is_power_of_two"}  # fmt: skip
TEXT = re.compile(r"""/\*.*?\*/|//.*|"(?:\\.|[^"\\])*"|'(?:\\.|[^'\\])'|#include.*""")

problems = []


def report(path, line, text):
    problems.append(f"{path.relative_to(ROOT)}:{line}: {text}")


def own_files():
    """All files that are ours, without builds, results and whatever a tool left in a hidden folder."""
    for top in ["src", "tests", "meshes", "params", "postprocess", ".ci"]:
        yield from (path for path in sorted((ROOT / top).rglob("*")) if path.is_file() and "__pycache__" not in path.parts)
    yield from (path for path in sorted(ROOT.iterdir()) if path.is_file() and path.name != "LICENSE")


def allowed_places(place, order):
    """The names of an order that may be included from one of them."""
    return order[: order.index(place) + 1]


def check_includes(path, lines):
    place = path.relative_to(ROOT / "src").parts
    folder = place[0]
    if folder not in PROGRAMS + ORDER:
        report(path, 1, f"folder or file unknown here; src/ holds {', '.join(PROGRAMS + ORDER)}")
        return
    rooms = ROOMS.get(folder, [])
    if rooms and (len(place) != 3 or place[1] not in rooms):
        report(path, 1, f"src/{folder} has the rooms {', '.join(rooms)}")
        return
    reach = ORDER if folder in PROGRAMS else [name for name in allowed_places(folder, ORDER) if name not in UNSEEN.get(folder, [])]
    for number, line in enumerate(lines, 1):
        if found := re.match(r'\s*#\s*include\s*"([^"]*)"', line):
            to = found[1].split("/")
            if to[0] not in reach:
                report(path, number, f'includes "{found[1]}", but {folder} may include only {", ".join(reach)}')
            elif rooms and to[0] == folder and to[1] not in allowed_places(place[1], rooms):
                report(path, number, f'includes "{found[1]}", but {folder}/{place[1]} only {", ".join(allowed_places(place[1], rooms))}')
        if folder != "fe" and re.search(r"\bint\s+dim\b", line):
            report(path, number, "`int dim` belongs in src/fe")


def check_comments(path, lines):
    """Reports comments that begin as fragments; lines that go on with a comment count with its first."""
    goes_on = False
    for number, line in enumerate(lines, 1):
        if not goes_on and (found := FRAGMENT.match(line)):
            report(path, number, f"the comment begins as a fragment, with {found[1]}")
        goes_on = line.lstrip().startswith(("//", "#"))


def read_code(path, lines):
    """Yields the numbers of lines and their code without texts and comments. The name of a test in Python is a sentence."""
    if path.suffix != ".py":
        yield from ((number, TEXT.sub("", line)) for number, line in enumerate(lines, 1))
        return
    for token in tokenize.generate_tokens(iter([line + "\n" for line in lines]).__next__):
        if token.type == tokenize.NAME and not token.string.startswith("test_"):
            yield token.start[0], token.string


def check_identifiers(path, lines):
    for number, code in read_code(path, lines):
        for name in set(UNNAMED.findall(code)) - NAMED:
            report(path, number, f"the identifier {name} says no quantity or action of the field")


n_sources = 0
for path in own_files():
    try:
        lines = path.read_text(encoding="utf-8").splitlines()
    except UnicodeDecodeError:
        continue  # pictures
    if (path.suffix in CODE or path.name in ("run", "test")) and len(lines) > MAX_LINES:
        report(path, len(lines), f"{len(lines)} lines; the limit is {MAX_LINES}")
    if path.suffix in {".cc", ".h", ".py", ".sh", ".geo", ".cmake", ".in"} and not any(LICENCE in line for line in lines[:2]):
        report(path, 1, f"one of the first two lines must say {LICENCE}")
    for number, line in enumerate(lines, 1):
        if found := UNFINISHED.search(line):
            report(path, number, f"{found[1]} left")
    if path.is_relative_to(ROOT / "src") and path.suffix in (".cc", ".h"):
        n_sources += 1
        check_includes(path, lines)
    if path.suffix in (".cc", ".h", ".py"):
        check_comments(path, lines)
        check_identifiers(path, lines)

scenes = sorted((ROOT / "params").glob("*.prm"))
readme = ROOT / "params" / "README.md"
described = readme.read_text(encoding="utf-8") if readme.exists() else ""
for scene in scenes:
    # A name of its own: model-a.prm is not described by stiff-model-a.prm.
    if not re.search(r"(?<![\w-])" + re.escape(scene.name), described):
        report(scene, 1, "not in params/README.md")


def heading_anchor(heading):
    return re.sub(r"[^\w\- ]", "", heading.lower()).replace(" ", "-")


def check_words(page):
    words = len(page.read_text(encoding="utf-8").split())
    if words > MAX_WORDS and page.relative_to(ROOT) not in REFERENCES:
        report(page, 1, f"{words} words; over {MAX_WORDS} a page wants to be two")


def check_links(page):
    """Reports links of a page to files or headings that do not exist."""
    for number, line in enumerate(page.read_text(encoding="utf-8").splitlines(), 1):
        for link in re.findall(r"\]\(([^)\s]+)\)", line):
            name, _, anchor = link.partition("#")
            to = page.parent / name if name else page
            if "://" in link:
                continue
            if not to.exists():
                report(page, number, f"links to {name}, which is not there")
            elif anchor and anchor not in map(heading_anchor, re.findall(r"^#+ (.*)$", to.read_text(encoding="utf-8"), re.MULTILINE)):
                report(page, number, f"links to {link}, where there is no such heading")


def check_places(page):
    """Reports source files that a page of theory names and that do not exist, and functions that the last file named lacks."""
    text = ""
    for number, line in enumerate(page.read_text(encoding="utf-8").splitlines(), 1):
        for name, function in re.findall(r"`(?:(src/[\w/.]+)|(\w+)\(\))`", line):
            if name:
                beside = [ROOT / name, *(ROOT / name).parent.glob(pathlib.Path(name).stem + ".*")]
                text = "".join(path.read_text(encoding="utf-8") for path in beside if path.exists())
                if not (ROOT / name).exists():
                    report(page, number, f"names {name}, which is not there")
            elif not re.search(rf"\b{function}\(", text):
                report(page, number, f"names {function}(), which the file named before it does not have")


def check_named_files(page, sources):
    """Reports sources that a page names, from any folder on, and that do not exist."""
    for number, line in enumerate(page.read_text(encoding="utf-8").splitlines(), 1):
        for name in re.findall(r"`([\w/.-]+\.(?:cc|h|py))`", line):
            if not any(path.endswith("/" + name) for path in sources):
                report(page, number, f"names {name}, which is not there")


def shared_types(folder):
    """The types that the headers of a folder share with others, each with its header."""
    return {
        name: path
        for path in (ROOT / folder).rglob("*.h")
        for name in re.findall(r"^  (?:struct|class) (\w+)$", path.read_text(encoding="utf-8"), re.MULTILINE)
    }


# A linker takes the members of one of them for both.
types = shared_types("src")
for name, path in shared_types("tests").items():
    if name in types:
        report(path, 0, f"names a type {name}, as {types[name].name} does")

pages = [*ROOT.glob("*.md"), *(path for path in own_files() if path.suffix == ".md")]
paths = ["/" + path.relative_to(ROOT).as_posix() for path in own_files()]
for page in pages:
    check_links(page)
    check_named_files(page, paths)
    check_words(page)
    if page.name.startswith("theory"):
        check_places(page)

if n_sources == 0 or not scenes:
    problems.append(f"nothing to check in {ROOT}")
print("\n".join(problems) or f"{n_sources} source files and {len(scenes)} scenes in order, links of {len(pages)} pages hold")
sys.exit(bool(problems))
