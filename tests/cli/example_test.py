# SPDX-FileCopyrightText: 2026 The wellknit authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The shipped example is what tools/make_example.py makes, byte for byte. Argument: the project's folder."""
import filecmp
import pathlib
import subprocess
import sys
import tempfile

project = pathlib.Path(sys.argv[1])
shipped = project / "testdata" / "example"
with tempfile.TemporaryDirectory() as made:
    subprocess.run([sys.executable, str(project / "tools" / "make_example.py"), made], check=True)
    names = sorted(p.name for p in pathlib.Path(made).iterdir())
    assert names == ["curved.csv", "example.GRDECL", "steep.dev"], names
    for name in names:
        assert filecmp.cmp(pathlib.Path(made) / name, shipped / name, shallow=False), f"{name} differs"
