# SPDX-License-Identifier: GPL-3.0-only
"""A folder of its own for each test."""

import tempfile
import unittest
from pathlib import Path


class FolderTest(unittest.TestCase):
    """Has a new folder, gone at the end of the test."""

    def setUp(self):
        temporary = tempfile.TemporaryDirectory(prefix="sprag-test-")
        self.addCleanup(temporary.cleanup)
        self.folder = Path(temporary.name)
