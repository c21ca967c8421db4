"""Holds the shape of the sources: include directions, the bound on the dimension, file lengths, scenes all described."""

import os
import pathlib
import re
import sys

ROOT = pathlib.Path(os.environ.get("SPRAG_SOURCE", pathlib.Path(__file__).parents[2]))

# A folder of src/ includes itself and what stands before it; main.cc includes any.
ORDER = ["base", "laws", "scene", "results", "model", "fe", "analysis"]
CODE = {".cc", ".h", ".py", ".sh", ".geo", ".cmake", ".txt"}
MAX_LINES = 500
# In pieces, or this file would find itself.
UNFINISHED = re.compile(r"\b(TO" r"DO|FIX" r"ME)\b")

problems = []


def report(path, line, text):
    problems.append(f"{path.relative_to(ROOT)}:{line}: {text}")


def own_files():
    """All files that are ours, without builds, results and whatever a tool left in a hidden folder."""
    for top in ["src", "tests", "meshes", "params", "postprocess", ".ci"]:
        yield from (path for path in sorted((ROOT / top).rglob("*")) if path.is_file() and "__pycache__" not in path.parts)
    yield from (path for path in sorted(ROOT.iterdir()) if path.is_file() and path.name != "LICENSE")


def check_includes(path, lines):
    folder = path.relative_to(ROOT / "src").parts[0]
    if folder != "main.cc" and folder not in ORDER:
        report(path, 1, f"folder or file unknown here; src/ holds main.cc and {', '.join(ORDER)}")
        return
    reach = ORDER if folder == "main.cc" else ORDER[: ORDER.index(folder) + 1]
    for number, line in enumerate(lines, 1):
        if found := re.match(r'\s*#\s*include\s*"([^"]*)"', line):
            if found[1].split("/")[0] not in reach:
                report(path, number, f'includes "{found[1]}", but {folder} may include only {", ".join(reach)}')
        if folder != "fe" and re.search(r"\bint\s+dim\b", line):
            report(path, number, "`int dim` belongs in src/fe")


n_sources = 0
for path in own_files():
    try:
        lines = path.read_text(encoding="utf-8").splitlines()
    except UnicodeDecodeError:
        continue  # pictures
    if (path.suffix in CODE or path.name in ("run", "test")) and len(lines) > MAX_LINES:
        report(path, len(lines), f"{len(lines)} lines; over {MAX_LINES} a file wants to be two")
    for number, line in enumerate(lines, 1):
        if found := UNFINISHED.search(line):
            report(path, number, f"{found[1]} left")
    if path.is_relative_to(ROOT / "src") and path.suffix in (".cc", ".h"):
        n_sources += 1
        check_includes(path, lines)

scenes = sorted((ROOT / "params").glob("*.prm"))
readme = ROOT / "params" / "README.md"
described = readme.read_text(encoding="utf-8") if readme.exists() else ""
for scene in scenes:
    # A name of its own: model-a.prm is not described by stiff-model-a.prm.
    if not re.search(r"(?<![\w-])" + re.escape(scene.name), described):
        report(scene, 1, "not in params/README.md")

if n_sources == 0 or not scenes:
    problems.append(f"nothing to check in {ROOT}")
print("\n".join(problems) or f"{n_sources} source files and {len(scenes)} scenes in order")
sys.exit(bool(problems))
