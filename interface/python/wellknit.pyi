# SPDX-FileCopyrightText: 2026 The wellknit authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Knits radial well meshes into corner-point grids.

Lengths are metres, depths positive down, everything else SI. Arrays have the names, shapes and units of the mesh file (docs/formats/hdf5.md);
integers that name cells, faces, vertices or wells have 32 bits here, -1 for none.
"""
import os
from typing import Any, Dict, Iterator, List, Literal, Optional, Sequence, Union

import numpy as np
import numpy.typing as npt

__version__: str

class Error(RuntimeError):
    """An input is wrong, or an output cannot be written; one line that says what and what to do."""

class Well:
    """A trajectory file, or a name and points (n rows x, y, depth), with what its radial mesh shall be. Without both: options for the deck's
    wells."""
    def __init__(self, file: Optional[Union[str, "os.PathLike[str]"]] = None, *, name: str = "", points: Optional[npt.ArrayLike] = None,
                 measured_depth: Optional[npt.ArrayLike] = None, radius: float = 15.0, bore_radius: float = 0.1, sectors: int = 10,
                 rings: int = 5, segments: Optional[int] = None, mode: Literal["auto", "layered", "swept"] = "auto",
                 skin: float = 0.0, growth: Optional[float] = None) -> None: ...

class Mesh:
    """A mesh in memory: a read-only mapping of names to arrays, which keep it alive."""
    def __getitem__(self, name: str) -> np.ndarray: ...
    def __contains__(self, name: str) -> bool: ...
    def __iter__(self) -> Iterator[str]: ...
    def __len__(self) -> int: ...
    def keys(self) -> List[str]: ...
    @property
    def wells(self) -> List[Dict[str, Any]]:
        """name, bore_radius, drainage_radius, injector, connections; of a build also meshed, mode, reason, length_in_rock, length_meshed, notes."""
    @property
    def notes(self) -> List[str]:
        """What was mended or ignored while the inputs were read."""
    def violations(self) -> List[str]:
        """What a valid mesh does not have; empty: valid."""
    def quality(self) -> Dict[str, float]:
        """The figures of `wellknit check --json`."""
    def write(self, path: Union[str, "os.PathLike[str]"], format: str = "", overwrite: bool = False) -> List[str]:
        """To a format of `wellknit formats`, by the extension where none is given. Notes come back."""

def build(case: Union[str, "os.PathLike[str]"], wells: Sequence[Union[str, "os.PathLike[str]", Well]] = (), deck_wells: str = "",
          deck_well_options: Optional[Well] = None, *, mapping: Literal["auto", "paper"] = "auto", optimise: Literal["off", "on", "edges", "vertices"] = "off",
          refine: Union[int, Literal["auto", "off"]] = "auto", fault_policy: Literal["stop", "heal"] = "stop", heal_throw: float = ...,
          fluxes: Literal["two-point", "consistent", "adapted"] = "two-point", threads: int = 0) -> Mesh:
    """deck_wells: "all", or names separated by commas."""

def read(path: Union[str, "os.PathLike[str]"]) -> Mesh:
    """A mesh file."""
