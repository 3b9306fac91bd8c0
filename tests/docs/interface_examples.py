# SPDX-FileCopyrightText: 2026 The wellknit authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The examples of docs/interfaces.md, as printed: Python is run, C, Fortran and C++ are compiled, linked and run.

    interface_examples.py BUILD CPP_PROGRAM    the program that CMake makes of the C++ example

The case is a small deck called FIELD.DATA, with an injector INJ1, and two paths P1.csv and P2.dev. Exit 77: no C or Fortran compiler.
"""
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

SOURCE = pathlib.Path(__file__).resolve().parent.parent.parent
sys.path.insert(0, str(SOURCE / "tests" / "cli"))
os.environ.setdefault("WELLKNIT", "wellknit")
os.environ.setdefault("WELLKNIT_SOURCE_DIR", str(SOURCE))
import whole_deck  # noqa: E402

C = """#include <stdio.h>
#include <stdlib.h>
#include "wellknit.h"
static void die(const char* text) { puts(text); exit(1); }
int main(void) {
%s
  printf("%%d pairs\\n", (int)pairs.rows);
  return pairs.rows > 0 && pairs.rows == T.rows && pairs.columns == 2 ? 0 : 1;
}
"""
FORTRAN = """program test
  use, intrinsic :: iso_c_binding
  use wellknit
  implicit none
  type(c_ptr) :: request, model
  real(c_double), pointer :: volume(:, :)
  integer(c_int32_t), pointer :: pairs(:, :)
%s
  if (size(volume, 2) == 0 .or. minval(pairs) /= 0) error stop 1
end program
"""
def main():
    build = pathlib.Path(sys.argv[1]).resolve()
    if not shutil.which("cc") or not shutil.which("gfortran"):
        print("skipped: no cc or no gfortran")
        return 77
    page = (SOURCE / "docs" / "interfaces.md").read_text()
    example = {language: text for language, text in re.findall(r"^```(\w+)\n(.*?)^```", page, re.S | re.M)}
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)

        def run(*command):
            print("+", *command, flush=True)
            subprocess.run([str(part) for part in command], cwd=folder, check=True,
                           env=dict(os.environ, PYTHONPATH=str(build / "interface/python"), LD_LIBRARY_PATH=str(build / "interface")))

        for file, text in whole_deck.files().items():
            path = folder / file.replace("CASE.DATA", "FIELD.DATA")
            path.parent.mkdir(exist_ok=True)
            path.write_text(text.replace("'I1'", "'INJ1'").replace(" I1 ", " INJ1 "))
        (folder / "P1.csv").write_text("MD,X,Y,TVD\n0,100,200,1995\n40,100,200,2035\n")
        (folder / "P2.dev").write_text("name P2\n300 100 1995 0\n300 100 2035 40\n")
        (folder / "a.py").write_text(example["python"])
        run("/usr/bin/python3", "a.py")
        library = ["-L", build / "interface", "-lwellknit"]
        (folder / "a.c").write_text(C % example["c"])
        run("cc", "-Wall", "-Werror", "-I", SOURCE / "interface", "a.c", "-o", "c", *library)
        run("./c")
        (folder / "a.f90").write_text(FORTRAN % example["fortran"])
        run("gfortran", SOURCE / "interface/fortran/wellknit.f90", "a.f90", "-o", "f", *library)
        run("./f")
        run(sys.argv[2])
    return 0


if __name__ == "__main__":
    sys.exit(main())
