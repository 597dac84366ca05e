"""Reduced plates kept on disk, named by a digest of all that they depend on, their own code included.

`instrument.models.cache` also counts the sources of `fitting`, which have no part in these.
"""

import ast
import hashlib
import json
import os
import tempfile
from collections.abc import Callable
from dataclasses import asdict, replace
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import scipy

from campaign.plates import brick, grid, reduced, solid
from campaign.plates.geometry import TruePlate
from campaign.plates.grid import Fineness
from campaign.plates.reduced import MODULI_PA, ReducedSolid
from campaign.plates.solid import Build, RootSprings, Solid
from drivers.simulated.plant import air
from instrument.models.arrays import pack, unpack
from instrument.models.cache import cache_folder

BARE_SPRINGS_N_M3 = 1e14
"""Of the softer of two clamps that a bare plate is kept with."""
_BARE_MODES = 24
STRUCK_MODES = 26
"""Of a struck plate, twelve more than its band has resonances at most."""
_EDGE = (0.3, 1.2)
WHERE_FREE = Fineness(16, 12, _EDGE, _EDGE, _EDGE)
"""All four edges alike. Of P2 (1 MPa) the first eleven resonances are 0.002 to 0.025 % above those of a mesh
finer by a quarter and at the edges, the twelfth 0.07 %."""
WHERE_CLAMPED = Fineness(16, 12, near_edge=_EDGE, near_tip=_EDGE)
Point = tuple[float, float]


@cache
def clean_plate(plate: TruePlate, fineness: Fineness | None = None) -> ReducedSolid:
    """The treated plate without any effect, from the cache or built (about 10 s) and kept."""
    fineness = fineness or Fineness()
    said = ["treated", _made_of(plate), asdict(fineness), MODULI_PA]
    return _kept("plate", said, lambda: reduced.reduced(Solid(plate, None, fineness), MODULI_PA))


@cache
def bare_plate(plate: TruePlate, sprung: bool, fineness: Fineness | None = None) -> ReducedSolid:
    """The substrate alone, in a rigid clamp or in one of `BARE_SPRINGS_N_M3`."""
    fineness = fineness or Fineness()
    said = ["bare", _made_of(plate.bare), asdict(fineness), sprung, BARE_SPRINGS_N_M3]

    return _kept("bare-plate", said, lambda: bare_solid(plate.bare, Build(), sprung, fineness))


@cache
def struck_plate(plate: TruePlate, points_m: tuple[Point, ...], *, free: bool) -> ReducedSolid:
    """The treated plate without any effect, hung free or in its clamp, able to answer forces at points."""
    fineness = WHERE_FREE if free else WHERE_CLAMPED
    said = ["struck", _made_of(plate), asdict(fineness), MODULI_PA, points_m, free, STRUCK_MODES]

    def build() -> ReducedSolid:
        solid = Solid(plate, Build(free=free), fineness)
        return reduced.reduced(solid, MODULI_PA, points_m=points_m, modes=STRUCK_MODES)

    return _kept("struck-plate", said, build)


def _made_of(plate: TruePlate) -> dict[str, Any]:
    """Neither the spot nor the damping has a part in it."""
    return asdict(replace(plate, spot_m=(0.0, 0.0), ratios=()))


def bare_solid(
    plate: TruePlate, build: Build, sprung: bool, fineness: Fineness | None = None
) -> ReducedSolid:
    """The same as `build` has it, never kept."""
    root = RootSprings(_even, _even) if sprung else None
    return reduced.reduced(Solid(plate, replace(build, root=root), fineness), modes=_BARE_MODES)


def _even(y: np.ndarray[Any, Any]) -> np.ndarray[Any, Any]:
    return np.full(y.shape, BARE_SPRINGS_N_M3)


def _kept(name: str, said: Any, build: Callable[[], ReducedSolid]) -> ReducedSolid:
    text = json.dumps([_sources(), np.__version__, scipy.__version__, said], sort_keys=True)
    digest = hashlib.sha256(text.encode()).hexdigest()
    path = cache_folder() / f"campaign-{name}-{digest[:32]}.npz"
    found = _load(path)
    if found is None:
        found = build()
        _store(path, found)
    return found


def _load(path: Path) -> ReducedSolid | None:
    """None for a file that is not there, torn or of another version: it is built again."""
    try:
        with np.load(path, allow_pickle=False) as file:
            return unpack(ReducedSolid, {key: file[key] for key in file.files})
    except Exception:  # whatever a damaged file makes a reader raise, the answer is the same
        return None


def _store(path: Path, plate: ReducedSolid) -> None:
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        # Written beside and renamed: another process sees the whole file or none.
        with tempfile.NamedTemporaryFile(dir=path.parent, suffix=".tmp", delete=False) as file:
            arrays: dict[str, Any] = pack(plate)
            np.savez(file, **arrays)
        os.replace(file.name, path)
    except OSError:
        return


@cache
def _sources() -> str:
    digest = hashlib.sha256()
    for module in (air, brick, grid, reduced, solid):
        # As the parser sees it: neither comments nor line breaks change a plate.
        tree = ast.parse(Path(str(module.__file__)).read_text(encoding="utf-8"))
        digest.update(ast.dump(tree).encode())
    return digest.hexdigest()
