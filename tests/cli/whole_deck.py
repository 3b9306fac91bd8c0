# SPDX-FileCopyrightText: 2026 The wellknit authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""A small whole deck with most of what the conversion has to rewrite: oil and water, a fault, includes, operations on
arrays, an aquifer, four wells (one with segments), and changes in time."""

NX, NY, NZ, DX, DZ, TOP = 9, 9, 4, 40.0, 6.0, 2000.0


def _values(items):
    return " ".join(f"{item:g}" for item in items)


def _coord():
    return [v for j in range(NY + 1) for i in range(NX + 1) for v in (DX * i, DX * j, TOP - 50, DX * i, DX * j, TOP + 150)]


def _zcorn():
    """Dips by 0.5 m a cell along i; east of column 6 everything lies 4 m lower."""
    out = []
    for k in range(2 * NZ):
        for _ in range(2 * NY):
            for i in range(2 * NX):
                cell = i // 2
                out.append(TOP + DZ * ((k + 1) // 2) + 0.5 * ((i + 1) // 2) + (4.0 if cell >= 6 else 0.0))
    return out


def files():
    """Name and text of each file; the main one is CASE.DATA."""
    cells = NX * NY * NZ
    grid = f"""-- the grid
COORD
{_values(_coord())}
/
ZCORN
{_values(_zcorn())}
/
"""
    regions = f"""-- regions, by box
FIPNUM
 {cells}*1 /
EQUALS
 FIPNUM 2 1 4 /
/
-- end of the regions
"""
    main = f"""-- A small deck.
RUNSPEC
TITLE
 SMALL
DIMENS
 {NX} {NY} {NZ} / cells
OIL
WATER
METRIC
START
 1 JAN 2020 /
NONNC
ENDSCALE
/
TABDIMS
 2* 20 20 /
EQLDIMS
/
REGDIMS
 2 /
AQUDIMS
 0 0 1 36 1 200 /
WELLDIMS
 6 8 2 6 /   room
WSEGDIMS
 1 20 2 /
UNIFOUT

GRID   -------
INCLUDE
 'grid/small.grdecl' /
PORO
 {cells}*0.2 /
PERMX
 81*100 81*300 81*50 81*200 /
COPY
 PERMX PERMY /
 PERMX PERMZ /
/
MULTIPLY
 PERMZ 0.1 /
/
NTG
 {cells}*0.9 /

PROPS
-- water
PVTW
 200 1.0 4E-5 0.5 0 /
PVDO
 10 1.15 1
 200 1.1 1
 500 1.05 1.1 /
ROCK
 200 5E-5 /
DENSITY
 850 1000 1 /
SWOF
 0.2 0 0.9 0.2
 0.5 0.1 0.3 0.05
 0.8 0.4 0 0 /
SWL   -- by operations
 {cells}*0.2 /
BOX
 1 3 1 {NY} 1 2 /
SWL
 {3 * NY * 2}*0.25 /
ENDBOX

REGIONS
INCLUDE
 regions.inc /

SOLUTION
EQUIL
 2010 200 2022 0 /
AQUCT
 1 2010 200 100 0.2 1E-4 500 20 90 1 1 /
/
AQUANCON
 1 1 {NX} 1 1 1 {NZ} J- / the south
/
RPTRST
 BASIC=2 /

SUMMARY
FOPR
FWPR
FPR
BPR
 1 1 1 /
 5 5 2 /
/
WBHP
/
WOPR
 P1
 B1
/
WWPR
/
WWIR
/
COFR
 P1 5 5 2 /
 'H1' 3 8 3 /
/
WBP5
/
RPR
/

SCHEDULE
RPTRST
 BASIC=2 /
WELSPECS
 P1 G 5 5 1* OIL /  a producer
 'I1' G 2 3 2005 WATER /
 H1 G 7 8 1* OIL /
 B1 G 8 2 1* OIL /
/
COMPORD
 'P1' TRACK /
/
COMPDAT
-- the first two layers of P1 only
 P1 2* 1 2 OPEN 2* 0.2 / upper part
 'I1' 2 3 1 4 OPEN 1* 12.5 0.2 400 /
 H1 3 8 3 3 OPEN 2* 0.2 3* X /
 H1 4 8 3 3 OPEN 2* 0.2 1* 1.5 1* X /
 H1 5 8 3 3 OPEN 2* 0.2 3* X /
 B1 2* 1 4 OPEN 2* 0.2 /
/
WELSEGS
 B1 2000 0 1E-5 INC HF- /
 2 2 1 1 4 4 0.15 1E-4 /
 3 3 1 2 6 6 0.15 1E-4 /
 4 4 1 3 6 6 0.15 1E-4 /
 5 5 1 4 6 6 0.15 1E-4 /
/
COMPSEGS
 B1 /
 8 2 1 1 1 7 /
 8 2 2 1 7 13 /
 8 2 3 1 13 19 /
 8 2 4 1 19 25 /
/
WCONPROD
 P1 OPEN BHP 5* 180 /
 H1 OPEN LRAT 3* 60 1* 100 /
 B1 OPEN LRAT 3* 40 1* 100 /
/
WCONINJE
 I1 WATER OPEN RATE 150 1* 350 /
/
TSTEP
 1 9 20 /
COMPDAT
 P1 5 5 3 4 OPEN 2* 0.2 1* 2 /
/
TSTEP
 30 /
WELOPEN
 P1 SHUT 5 5 1 /
 B1 SHUT 0 0 4 /
/
WPIMULT
 I1 0.5 2 3 2 /
 H1 0.8 /
/
TSTEP
 2*30 /
END
after the end
"""
    return {"CASE.DATA": main, "grid/small.grdecl": grid, "regions.inc": regions}
