# SPDX-FileCopyrightText: 2026 The wellknit authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The part of the suite that is a test. A limit is a little above what docs/validation.md has; lower it when the
figure falls."""
import cases
import patch_test

PLAIN = ("knit", "corner_point")


def worst(result, mesh="knit"):
    return max(abs(e) for row in result.values() for e in row[mesh]["errors"])


def run(program):
    failed = 0

    def check(what, value, limit):
        nonlocal failed
        failed += value > limit
        print(f"{'ok  ' if value <= limit else 'FAIL'} {what}: {value:.2e}, limit {limit:.2e}", flush=True)

    # The suite's own exact solutions and indices: a box grid with Peaceman's index is right to 0.1 %.
    thiem = {d: cases.thiem(program, (50.0,), (d,), PLAIN) for d in cases.DEFORMATIONS}
    check("Thiem, corner point, deform 0", worst(thiem[0.0], "corner_point"), 1e-3)
    for deform, limit in LIMITS["thiem"].items():
        check(f"Thiem, deform {deform:g}", worst(thiem[deform]), limit)
        check(f"Thiem, consistent fluxes, deform {deform:g}", worst(thiem[deform], "knit_consistent"), LIMITS["consistent"])
    for name, problem in (("layered", cases.layered_problem(0.0, meshes=PLAIN)),
                          ("boundary", cases.boundary_problem(30.0, 0.0, meshes=PLAIN)),
                          ("two_wells", cases.two_wells_problem(0.0, meshes=PLAIN))):
        check(name.replace("_", " "), worst({0: cases.compare(program, problem)}), LIMITS[name])
    for (kind, ratio, deform), limit in LIMITS["line"].items():
        result = {0: cases.compare(program, cases.line_problem(kind, ratio, deform, meshes=("knit",)))}
        check(f"{kind} well, k_v/k_h {ratio:g}, deform {deform:g}", worst(result), limit)
    patch = patch_test.run(program, (0.0,))["0"]
    check("patch test of a box grid", max(patch["corner_point"]["pressure"]), 1e-10)
    check("patch test with a well", max(patch["knit"]["pressure"]), LIMITS["patch"])
    check("patch test of a box grid, consistent fluxes", max(patch["corner_point_consistent"]["pressure"]), 1e-10)
    check("patch test with a well, consistent fluxes", max(patch["knit_consistent"]["pressure"]), LIMITS["patch_consistent"])
    return 1 if failed else 0


LIMITS = {
    "thiem": {0.0: 0.001, 0.5: 0.0105, 1.0: 0.038},
    "layered": 0.001,
    "boundary": 0.003,
    "two_wells": 0.001,
    "line": {("slanted", 1.0, 0.0): 0.0065, ("slanted", 0.1, 0.0): 0.0095, ("slanted", 0.01, 0.0): 0.006,
             ("horizontal", 1.0, 0.0): 0.0035, ("horizontal", 0.1, 0.0): 0.016, ("horizontal", 0.01, 0.0): 0.012,
             ("slanted", 0.1, 0.5): 0.006, ("horizontal", 0.1, 0.5): 0.0125},
    "patch": 0.0045,
    "consistent": 0.004,
    "patch_consistent": 0.002,
}
