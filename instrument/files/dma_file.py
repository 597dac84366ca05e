"""A table of somebody's dynamic mechanical analysis: modulus and loss over frequency and temperature."""

import re
from dataclasses import dataclass
from pathlib import Path
from typing import Literal, get_args

import numpy as np

from fitting.arrays import Array
from instrument.errors import BadInput
from instrument.files.file_kind import refuse_another
from instrument.files.nearest import nearest
from instrument.files.table import number, read_rows
from instrument.files.text import read_text

Kind = Literal["shear", "tension", "bending"]
KINDS: tuple[str, ...] = get_args(Kind)
_ABOVE_ZERO = ("frequency_hz", "storage_modulus_pa", "storage_modulus_std_pa", "loss_factor_std")
_NUMBERS = (*_ABOVE_ZERO, "temperature_c", "loss_factor", "loss_modulus_pa")
REDUCED = "reduced_frequency_hz"
"""As a card of a law over temperatures names its frequencies."""
_SAID = re.compile(r"^\s*#\s*(kind|poisson)\s*:\s*(\S+)\s*$", re.MULTILINE)

_PA = {"kpa": 1e3, "mpa": 1e6, "gpa": 1e9}
_SOFTEST_PA, _LOSSIEST = 10.0, 10.0
"""Softer than any gel that keeps its shape; more than any polymer loses."""


@dataclass(frozen=True)
class DmaTable:
    """Moduli in shear, whatever was measured. Arrays have shape (rows,)."""

    path: Path
    kind: str
    poisson: float | None
    """By which tension became shear; None where nothing was to be converted."""
    frequency_hz: Array
    temperature_c: Array
    """NaN where not stated."""
    storage_modulus_pa: Array
    """G'."""
    loss_factor: Array
    storage_std: Array
    """Relative; NaN where not stated."""
    loss_factor_std: Array

    def temperatures(self) -> list[float]:
        """Temperatures that occur, ascending; one NaN where none is stated."""
        stated = np.unique(self.temperature_c)
        return [float(t) for t in stated] or [float("nan")]


def read_dma(path: Path, poisson: float) -> DmaTable:
    """Read a table. `poisson` is the core's own, where the file does not say another. Raises `BadInput`."""
    refuse_another(path, "a table", "a table of moduli over frequency")
    header, rows = read_rows(path, lambda header: _check(path, _plainly(header)))
    header = _plainly(header)
    columns = {
        name: np.array([_number(path, line, name, row[k]) for line, row in rows])
        for k, name in enumerate(header)
        if name in _NUMBERS
    }
    said = dict(_SAID.findall(read_text(path)))
    kind = said.get("kind", "shear")
    if kind not in KINDS:
        raise BadInput(f"{path}: kind: {kind!r}, expected one of {', '.join(KINDS)}")
    nu = poisson
    if "poisson" in said:
        nu = number(path, 1, "poisson", said["poisson"])
        if not -1 < nu <= 0.5:
            raise BadInput(f"{path}: poisson: {nu:g}, expected more than -1, at most 0.5")
    storage = columns["storage_modulus_pa"]
    if storage.min() < _SOFTEST_PA:
        raise BadInput(f"{path}: storage_modulus_pa = {storage.min():g}, expected Pa: is it in MPa?")
    nothing = np.full(len(storage), np.nan)
    eta = columns["loss_factor"] if "loss_factor" in columns else columns["loss_modulus_pa"] / storage
    if eta.max() > _LOSSIEST:
        raise BadInput(
            f"{path}: loss factor {eta.max():g}, expected E''/E': is it the loss modulus, or percent?"
        )
    return DmaTable(
        path,
        kind,
        None if kind == "shear" else nu,
        columns["frequency_hz"],
        columns.get("temperature_c", nothing),
        storage if kind == "shear" else storage / (2 * (1 + nu)),
        eta,
        columns["storage_modulus_std_pa"] / storage if "storage_modulus_std_pa" in columns else nothing,
        columns.get("loss_factor_std", nothing),
    )


def _plainly(header: list[str]) -> list[str]:
    """Of a card of a law over temperatures the reduced frequencies are those at its reference."""
    if "frequency_hz" in header:
        return header
    return ["frequency_hz" if name == REDUCED else name for name in header]


def _check(path: Path, header: list[str]) -> None:
    for name in ("frequency_hz", "storage_modulus_pa"):
        if name not in header:
            near = nearest(name, header)
            stem, _, unit = near.rpartition("_") if near else ("", "", "")
            if name == f"{stem}_pa" and unit.lower() in _PA:
                raise BadInput(
                    f"{path}: header: column {name} missing, found {near}: expected Pa, its values times "
                    f"{_PA[unit.lower()]:g} under that name"
                )
            found = f"is it {near}?" if near else f"found {', '.join(header)[:120]}"
            raise BadInput(f"{path}: header: column {name} missing, {found}")
    if "loss_factor" not in header and "loss_modulus_pa" not in header:
        raise BadInput(f"{path}: header: no loss, expected loss_factor or loss_modulus_pa")


def _number(path: Path, line: int, name: str, text: str) -> float:
    value = number(path, line, name, text)
    if name in _ABOVE_ZERO and value <= 0:
        raise BadInput(f"{path}: line {line}: {name} = {text}, expected more than 0")
    return value
