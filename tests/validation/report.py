# SPDX-FileCopyrightText: 2026 The wellknit authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Tables and pictures of docs/validation.md from the results. A table stands between <!-- NAME --> and <!-- end -->;
the text
around it is written by hand."""
import json
import re
import statistics

import pictures
from fields import closer

HEAD = ("ours", "ours, consistent", "corner point, Peaceman", "corner point, consistent", "4 × 4 finer")
MESHES = ("knit", "knit_consistent", "corner_point", "corner_point_consistent", "finer")
SIZES = ("knit", "corner_point", "finer")


PATCHED = (("knit", "ours"), ("knit_consistent", "ours, consistent"), ("corner_point", "corner point"),
           ("corner_point_consistent", "corner point, consistent"))


def percent(value, digits=2):
    return f"{100 * value:.{digits}f}"


def table(head, rows):
    lines = ["| " + " | ".join(head) + " |", "| " + " | ".join("---" for _ in head) + " |"]
    return "\n".join(lines + ["| " + " | ".join(str(c) for c in row) + " |" for row in rows])


def compared(result):
    """Errors of the rates in %, by well; the largest error of the pressure along the line; cells."""
    rows = []

    def tube(w):
        by_index = f", {w['index_connections']} by index" if w["index_connections"] else ""
        return f"{w['mode']} {w['drainage_radius']:.3g} m{by_index}"

    for name, row in result.items():
        errors = [", ".join(percent(e) for e in row[m]["errors"]) for m in MESHES]
        line = [percent(max((abs(e) for _, e in row[m]["line"]), default=float("nan"))) for m in MESHES]
        wells = row["knit"]["wells"]
        tubes = ", ".join(tube(w) for w in wells)
        rows.append([name, *errors, " / ".join(line), " / ".join(f"{row[m]['cells']:,}" for m in SIZES), tubes])
    return table(["case", *(f"{h}, %" for h in HEAD), "pressure along a line, %", "cells", "our tubes"], rows)


def ours_alone(result):
    """Our mesh's errors in %: of the rate and of the pressure along the line, with two-point and consistent fluxes."""
    rows = []
    for name, row in result.items():
        cells = [f"{percent(row[m]['errors'][0])} / {percent(max(abs(e) for _, e in row[m]['line']))}" for m in ("knit", "knit_consistent")]
        rows.append([name, *cells, f"{row['knit']['cells']:,}"])
    return table(["case", "two-point: rate / line, %", "consistent: rate / line, %", "cells"], rows)


def adapted(result):
    """Errors of rates, of the pressure along the line, and of a linear pressure past shut wells."""
    rows = []
    kinds = ("two_point", "adapted", "consistent")
    for name, row in result.items():
        for n in range(len(row["adapted"])):
            label = name if n == 0 else f"{name}, one injects"
            rates = [", ".join(percent(e) for e in row[k][n]["errors"]) for k in kinds]
            line = " / ".join(percent(max(abs(e) for _, e in row[k][n]["line"])) for k in kinds)
            linear = ["", ""] if n else [" / ".join(percent(e, 1) for e in row[f"{k}_linear"]) for k in kinds[:2]]
            rows.append([label, *rates, line, *linear])
    head = ["case", "two-point, %", "adapted, %", "consistent, %", "pressure along a line, %",
            "linear pressure, two-point, %", "adapted, %"]
    return table(head, rows)


def dipping(result):
    rows = [[name, *(percent(row[m]["errors"][0]) for m in ("knit", "knit_consistent", "corner_point", "across"))]
            for name, row in result.items()]
    return table(["case", "ours, %", "ours, consistent, %", "corner point, Peaceman, %", "corner point, bore across layers, %"], rows)


def attribution(result):
    names = sorted({n for row in result.values() for n in row["parts"]})
    rows = [[name, percent(row["error"]), *(percent(row["parts"].get(n, 0.0)) for n in names)]
            for name, row in result.items()]
    return table(["case", "error, %", *names], rows)


def patch(result):
    rows = []
    for deform, row in result.items():
        for mesh, label in PATCHED:
            for kinds, (count, mean, high, most) in row[mesh]["flux"].items():
                rows.append([deform, label, kinds, count, percent(mean), percent(high), percent(most)])
    return table(["deform", "mesh", "connections", "number", "mean, %", "95 % below, %", "largest, %"], rows)


def patch_pressure(result):
    rows = [[deform, label, *(f"{e:.1e}" for e in row[mesh]["pressure"])]
            for deform, row in result.items() for mesh, label in PATCHED]
    return table(["deform", "mesh", "slope along x", "along y", "along depth"], rows)


def field(result):
    rows = []
    for boundary, label in (("closed", "closed sides"), ("sides", "sides held at 200 bar")):
        for reference, parts in (("finer4", "4 × 4"), ("finer5", "5 × 5")):
            errors, share = closer(result, boundary, reference)
            ours, theirs = ([abs(e[n]) for e in errors.values()] for n in (0, 1))
            rows.append([label, parts, f"{round(share * len(errors))} of {len(errors)}",
                         *(percent(sum(e) / len(e), 1) for e in (ours, theirs)),
                         *(percent(max(e), 1) for e in (ours, theirs))])
    cells = ", ".join(f"{result[m]['cells']:,}" for m in ("knit", "corner_point", "finer4", "finer5"))
    head = ["boundary", "reference", "ours closer", "mean error ours, %", "corner point, %", "largest ours, %",
            "corner point, %"]
    return table(head, rows) + f"\n\nCells of ours, the corner-point grid, 4 × 4, 5 × 5: {cells}."


REFERENCE = "7 across"
HOSTS = {"1 knit": "ours, model's columns", "1 adapted": "ours, adapted, model's columns",
         "1 peaceman": "corner point, model's columns", "3 knit": "ours, 3 × 3",
         "3 peaceman": "corner point, 3 × 3", "5 peaceman": "corner point, 5 × 5", "7 peaceman": "corner point, 7 × 7",
         "5 across": "bore across layers, 5 × 5"}


def errors_of(result, key, boundary, reference=REFERENCE):
    return {well: result[key][boundary][well] / rate - 1 for well, rate in result[reference][boundary].items()}


def field_hosts(result):
    """Against columns in 7 x 7 with the index of a bore across layers: means of errors, their spread, and wells nearer
    than the plain corner-point grid's."""
    rows = []
    for key, label in HOSTS.items():
        cells = []
        for boundary in ("closed", "sides"):
            errors = errors_of(result, key, boundary)
            plain = errors_of(result, "1 peaceman", boundary)
            nearer = sum(abs(e) < abs(plain[w]) for w, e in errors.items())
            values = list(errors.values())
            cells += [percent(statistics.mean(values)), percent(statistics.pstdev(values)),
                      "" if key == "1 peaceman" else f"{nearer} of {len(values)}"]
        rows.append([label, f"{result[key]['cells']:,}", *cells])
    head = ["wells and grid", "cells", *(f"{b}: {w}" for b in ("closed", "200 bar") for w in ("mean, %", "spread, %", "nearer"))]
    return table(head, rows)


def wells_of_hosts(result):
    """Closed sides, well by well; bold where the plain corner-point grid is nearer than ours."""
    keys = ("1 knit", "1 peaceman", "3 knit", "3 peaceman")
    errors = {key: errors_of(result, key, "closed") for key in keys}
    rows = []
    for well, rate in result[REFERENCE]["closed"].items():
        ours, plain, *fine = (errors[key][well] for key in keys)
        name = f"**{well}**" if abs(plain) <= abs(ours) else well
        rows.append([name, f"{rate:.4g}", *map(percent, (ours, plain, plain - ours, *fine))])
    head = ["well", "rate, m³/d", "ours, %", "corner point, %", "of it the well's cells, %", "ours, 3 × 3, %", "corner point, 3 × 3, %"]
    return table(head, rows)


def pore_volume(result):
    rows = [[model, region, f"{total:.6g}", f"{by_map:.1e}", f"{by_cell:.1e}"]
            for model, regions in result.items() for region, (total, by_map, by_cell) in regions.items()]
    head = ["model", "FIPNUM", "pore volume, m³", "error by the transfer map", "error by the cells' FIPNUM"]
    return table(head, rows)


def worst_of(result, chosen, mesh="knit"):
    return max(abs(e) for name, row in result.items() if chosen(name) for e in row[mesh]["errors"])


def verdicts(results):
    """What the suite asks for, and what there is."""
    rows = []

    def row(what, limit, value, unit=" %", scale=100):
        met = "yes" if scale * value <= limit else "**no**"
        rows.append([what, f"{limit:g}{unit}", f"{scale * value:.3g}{unit}" if unit else f"{value:.1e}", met])

    def both(what, limit, result, chosen):
        cells = []
        for mesh in ("knit", "knit_consistent"):
            value = 100 * worst_of(result, chosen, mesh)
            cells.append(f"{value:.3g} %, " + ("met" if value <= limit else "**not met**"))
        rates.append([what, f"{limit:g} %", *cells])

    rates = []
    for deform, limit in (("0", 0.5), ("0.5", 1), ("1", 2)):
        if "thiem" in results:
            both(f"Thiem, deform {deform}", limit, results["thiem"], lambda n: n.endswith(f"deform {deform}"))
    for name, what, limit in (("boundary", "well near a boundary", 2), ("two_wells", "two wells", 2),
                              ("layered", "layers of a factor 1,000", 1)):
        for deform in ("0", "0.5", "1"):
            if name in results:
                both(f"{what}, deform {deform}", limit, results[name], lambda n: n.endswith(f"deform {deform}"))
    for kind in ("slanted", "horizontal"):
        for ratio in ("1", "0.1", "0.01"):
            for deform in ("0", "0.5", "1"):
                if "line_wells" in results:
                    both(f"{kind} well, k_v/k_h {ratio}, deform {deform}", 2, results["line_wells"],
                         lambda n: n == f"{kind}, k_v/k_h {ratio}, deform {deform}")
                if "line_wells_metric" in results and ratio != "1":
                    both("the same with `--metric permeability`", 2, results["line_wells_metric"],
                         lambda n: n == f"{kind}, k_v/k_h {ratio}, deform {deform}")
    if "patch" in results:
        for mesh, label in (("corner_point", "box grid without a well"), ("knit", "box grid with a shut well"),
                            ("corner_point_consistent", "box grid without a well, consistent fluxes"),
                            ("knit_consistent", "box grid with a shut well, consistent fluxes")):
            row(f"linear pressure, {label}", 1e-10, max(results["patch"]["0"][mesh]["pressure"]), "", 1)
    for model in ("SPE9", "MODEL5"):
        if f"field_{model}" in results:
            share = closer(results[f"field_{model}"], "closed", "finer4")[1]
            rows.append([f"{model}: wells closer to the 4 × 4 grid, closed sides", "80 %", f"{100 * share:.0f} %",
                         "yes" if share >= 0.8 else "**no**"])
    if "pore_volume" in results:
        row("pore volume of regions, by the transfer map", 1e-9,
            max(abs(r[1]) for m in results["pore_volume"].values() for r in m.values()), "", 1)
    return (table(["largest error of a well's rate", "limit", "two-point fluxes", "consistent fluxes"], rates) + "\n\n" +
            table(["other figures", "limit", "largest", "met"], rows))


TABLES = {"thiem": compared, "boundary": compared, "two_wells": compared, "line_wells": compared, "line_wells_metric": ours_alone,
          "layered": compared, "adapted": adapted, "dipping": dipping,
          "attribution": attribution, "patch": patch, "patch_pressure": patch_pressure, "field_SPE9": field,
          "field_MODEL5": field, "hosts_SPE9": field_hosts, "wells_SPE9": wells_of_hosts, "pore_volume": pore_volume}
FILES = {"patch_pressure": "patch", "wells_SPE9": "hosts_SPE9"}


def write(work, docs):
    page = docs / "validation.md"
    text = page.read_text(encoding="utf-8")
    results = {}
    for name, make in TABLES.items():
        path = work / f"{FILES.get(name, name)}.json"
        if not path.exists():
            print(f"{name}: no results in {work}, its table stays")
            continue
        results[name] = json.loads(path.read_text(encoding="ascii"))
        block = f"<!-- {name} -->\n{make(results[name])}\n<!-- end -->"
        text, count = re.subn(rf"<!-- {name} -->\n.*?<!-- end -->", lambda _: block, text, flags=re.DOTALL)
        if count != 1:
            raise SystemExit(f"{page}: expected one <!-- {name} -->, found {count}")
    block = f"<!-- verdicts -->\n{verdicts(results)}\n<!-- end -->"
    text = re.sub(r"<!-- verdicts -->\n.*?<!-- end -->", lambda _: block, text, flags=re.DOTALL)
    page.write_text(text, encoding="utf-8")
    pictures.write(results, docs / "images")
