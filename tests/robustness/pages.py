# SPDX-License-Identifier: GPL-3.0-only
"""Tests that the pages are true: commands are accepted with their options and settings, parameters and choices exist, scripts know their
options."""

import re
import shlex
from pathlib import Path

from pictures import draw
from folders import FolderTest
from runs import SOURCE, sprag

PAGES = {path: path.read_text(encoding="utf-8") for folder in ("", "params", "meshes", "postprocess", "src", "tests") for path in sorted((SOURCE / folder).glob("*.md"))}
PROGRAMS = ("./run", "sprag", "build/sprag")
# In place of what a page leaves to its reader.
MEANT = {"=K": "=1e5", "=TILT": "=1e-4", "=$depth": "=10", "SCENE.prm": "model-a.prm"}
UNTRIED = ("own/", "[", "...", "slip", "--new")  # files that the reader or the program makes, a synopsis, an analysis
PASSED_OVER = ("--output", "--overwrite", "--validate", "--verbose", "--print-parameters")  # with --print-parameters


def commands():
    """(page, words) of all commands that stand on lines of their own or in code, without what they are joined with."""
    for page, text in PAGES.items():
        text = re.sub(r"\\\n\s+", "", text)
        lines = [line.strip() for line in text.splitlines() if line.startswith("    ")]
        for line in [*lines, *re.findall(r"`([^`\n]*)`", text)]:
            if not line.startswith((*(f"{program} " for program in PROGRAMS), "postprocess/", "mpirun ")):
                continue
            for dummy, meant in MEANT.items():
                line = line.replace(dummy, meant)
            words = shlex.split(line.split(" && ")[0].split(" | ")[0], comments=True)
            if words[0] == "mpirun":
                words = words[words.index("build/sprag") :] if "build/sprag" in words else words[3:]
            yield page.name, words


def choices():
    """{parameter: its words, or none where it has none}"""
    found, section, comment = {}, "", ""
    for line in sprag("--print-parameters").stdout.splitlines():
        if line.startswith("subsection "):
            section = line.split(" ", 1)[1]
        elif line.strip().startswith("# "):
            comment += line.strip()[1:]
        elif match := re.match(r"\s+#set (.+?)\s+= ", line):
            words = re.search(r": one of ([^:]*?)\.$", comment.strip())
            found[f"{section}/{match[1]}"] = [word.strip() for word in words[1].split("|")] if words else []
            comment = ""
        elif not line.strip():
            comment = ""
    return found


class Pages(FolderTest):
    def test_commands_of_the_program(self):
        empty = self.folder / "FILE.prm"
        empty.write_text("")
        tried = set()
        for page, words in commands():
            if words[0] not in PROGRAMS or any(word.startswith(UNTRIED) for word in words):
                continue
            arguments = []
            for word in words[1:]:
                if word.endswith(".prm"):
                    arguments.append(str(SOURCE / word if (SOURCE / word).is_file() else empty))
                elif word not in PASSED_OVER and not word.startswith("output/"):
                    arguments.append(word)
            if not any(word.endswith(".prm") or word == "--help" for word in arguments):
                arguments = [str(empty), *arguments]
            if tuple(arguments) in tried:
                continue
            tried.add(tuple(arguments))
            with self.subTest(page=page, command=" ".join(words)):
                self.silent(sprag(*arguments, "--print-parameters"))
        self.assertGreater(len(tried), 60)

    def test_parameters_and_their_words(self):
        known = choices()
        self.assertIn("transient", known["Analysis/Type"])
        sections = {name.split("/")[0] for name in known}
        number = 0
        for page, text in PAGES.items():
            for code in re.findall(r"`([^`\n]*)`", text):
                name, _, value = (part.strip() for part in code.partition("="))
                if "/" not in name or name.split("/")[0] not in sections or name.endswith("..."):
                    continue
                number += 1
                name = re.sub(r" -?\d.*$", "", name)  # "Lever/Depth 3 mm 20 mm"
                with self.subTest(page=page.name, code=code):
                    self.assertTrue(name in known, "no such parameter")
                    if known[name] and value and not value.startswith(("`", "...")):
                        self.assertIn(value, known[name])
        self.assertGreater(number, 200)

    def test_models_of_the_first_page(self):
        known = choices()
        words = set(known["Analysis/Type"]) | set(known["Analysis/Model"])
        table = PAGES[SOURCE / "README.md"].split("## Which model when?")[1].split("\n\n")[1]
        cells = [line.split("|")[2] for line in table.splitlines()[2:]]
        self.assertGreater(len(cells), 5)
        for cell in cells:
            for word in re.findall(r"`([^`]*)`", cell):
                self.assertIn(word, words)

    def test_options_of_scripts(self):
        options = {}
        for page, words in commands():
            if re.match(r"postprocess/(?!test_)\w+\.py$", words[0]):
                named = {word.split("=")[0].strip("[") for word in words[1:] if word.strip("[").startswith("-")}
                options.setdefault(words[0], {}).setdefault(page, set()).update(named)
        self.assertGreater(len(options), 5)
        for script, pages in options.items():
            shown = draw(Path(script).name, "--help")
            self.assertEqual(shown.returncode, 0, script)
            for page, named in pages.items():
                for option in named:
                    with self.subTest(page=page, script=script):
                        self.assertRegex(shown.stdout, rf"(?m)(^|[\s\[,]){re.escape(option)}\b")
