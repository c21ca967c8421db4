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

    def succeeded(self, done):
        """Returns a program that has ended well."""
        self.assertEqual(done.returncode, 0, done.stderr)
        return done

    def silent(self, done):
        """Returns one that has ended well and complained of nothing."""
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        return done
