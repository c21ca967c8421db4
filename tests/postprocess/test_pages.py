# SPDX-License-Identifier: GPL-3.0-only
"""The pages of postprocess lead to what there is; test_scenes_slow.py holds the names on them against results. Run with /usr/bin/python3."""

import os
import re
import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "support"))

from pages import PAGES  # noqa: E402
from pictures import FOLDER  # noqa: E402


class PagesTest(unittest.TestCase):
    def test_links_and_pictures_are_there(self):
        for page, text in PAGES.items():
            for target in re.findall(r"\]\(([^)#]+)(?:#[^)]*)?\)", text):
                self.assertTrue((FOLDER / target).exists(), f"{page}: {target}")
            for target, anchor in re.findall(r"\]\(([^)#]*)#([^)]+)\)", text):
                headings = re.findall(r"^#+ (.*)$", (FOLDER / (target or page)).read_text(encoding="utf-8"), re.MULTILINE)
                slugs = {re.sub(r"[^\w\- ]", "", heading.lower()).replace(" ", "-") for heading in headings}
                self.assertIn(anchor, slugs, page)

    def test_every_script_and_picture_has_its_place(self):
        every = "\n".join(PAGES.values())
        for path in FOLDER.glob("*.py"):
            if os.access(path, os.X_OK):
                self.assertIn(path.name, every)


if __name__ == "__main__":
    unittest.main()
