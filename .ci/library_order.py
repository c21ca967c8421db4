# SPDX-License-Identifier: GPL-3.0-only
"""Prints the libraries in which the dynamic loader finds most symbols when it loads the one named, most first, a path a line.

The loader looks for each symbol in one library after the other, in the order in which the program names them; what they bring comes
behind. With deal.II that is 190,000 symbols in 200 libraries. Those of linear algebra, which have functions of the same names, keep
the order that they have among themselves.
"""

import collections
import os
import re
import subprocess
import sys
import tempfile

FIRST = 45
LINEAR_ALGEBRA = re.compile(r"/lib(lapack|blas|openblas)\b")


def loaded(library):
    """Returns the libraries in the loader's own order."""
    return re.findall(r"=> (/\S+)", subprocess.run(["ldd", library], check=True, capture_output=True, text=True).stdout)


def first_ones(found, linear_algebra):
    for library in found:
        yield from linear_algebra if library in linear_algebra else [library]


with tempfile.TemporaryDirectory() as folder:
    environment = {**os.environ, "LD_PRELOAD": sys.argv[1], "LD_DEBUG": "bindings", "LD_DEBUG_OUTPUT": f"{folder}/bindings"}
    environment.pop("LD_BIND_NOW", None)
    program = subprocess.Popen(["/bin/true"], env=environment)
    program.wait()
    with open(f"{folder}/bindings.{program.pid}", encoding="utf-8", errors="replace") as bindings:
        found = collections.Counter(line.split(" to ")[1].split(" ")[0] for line in bindings if " to /" in line)
linear_algebra = [library for library in loaded(sys.argv[1]) if LINEAR_ALGEBRA.search(library)]
order = first_ones([library for library, _ in found.most_common(FIRST)], linear_algebra)
print("\n".join(dict.fromkeys(order)))
