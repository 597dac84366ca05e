"""The standards' formulas on a beam's modes, one by one, beside what the full model makes of all of them.

ASTM E756 where the bare beam's modes were measured too (Oberst, van Oort, Ross-Kerwin-Ungar), the central
impedance method where the beam is driven in its centre.
"""

from dataclasses import dataclass

import numpy as np

from fitting.errors import OutsideModel
from fitting.laws import CoreLaw
from fitting.mode_tables.table import ModalTable
from fitting.structures.beam import Beam
from fitting.structures.central_impedance import bending_stiffness, mass_per_length
from fitting.structures.e756 import LayerFound, oberst, sandwich, van_oort, young_of_bare

_ALIKE = 0.02
"""Relative difference of two faces beyond which the formula of equal faces is not theirs."""


@dataclass(frozen=True)
class ByFormula:
    """What one mode gives by itself."""

    mode: int
    frequency_hz: float
    method: str
    """`oberst`, `van-oort`, `ross-kerwin-ungar` or `central-impedance`."""
    loss_factor: float
    """Of the layer; by central impedance of the whole beam."""
    storage_modulus_pa: float | None = None
    """Of the layer in shear, Poisson's ratio as stated; None by central impedance."""
    bending_stiffness_n_m2: float | None = None
    """Of the whole beam, equivalent; None by the other methods."""
    full_storage_modulus_pa: float | None = None
    """The full model's law there, and its loss factor."""
    full_loss_factor: float | None = None
    objections: tuple[str, ...] = ()


def by_formula(
    table: ModalTable, beam: Beam, law: CoreLaw, bare: ModalTable | None = None
) -> tuple[ByFormula, ...]:
    """Every mode that a formula can be asked for. Raises `OutsideModel` where `bare` is of no use."""
    if bare is not None:
        return _e756(table, beam, law, bare)
    if beam.boundary != "centre-driven":
        return ()
    mass = mass_per_length(beam)
    return tuple(
        ByFormula(
            int(n),
            float(f),
            "central-impedance",
            float(eta),
            bending_stiffness_n_m2=bending_stiffness(int(n), float(f), mass, beam.length_m),
        )
        for n, f, eta in zip(table.mode, table.frequency_hz, table.loss_factor, strict=True)
    )


def _e756(table: ModalTable, beam: Beam, law: CoreLaw, bare: ModalTable) -> tuple[ByFormula, ...]:
    if beam.boundary != "clamped-free":
        raise OutsideModel(f"--bare with a {beam.boundary} beam: the formulas of ASTM E756 are clamped-free")
    if beam.masses:
        raise OutsideModel("--bare with [[mass]]: the formulas of ASTM E756 are of a beam that carries none")
    assert beam.core is not None
    measured = dict(zip(bare.mode.astype(int).tolist(), bare.frequency_hz.tolist(), strict=True))
    method = _method(beam)
    found = []
    for n, f, eta in zip(table.mode.astype(int), table.frequency_hz, table.loss_factor, strict=True):
        if int(n) not in measured:
            continue
        one = _of_mode(beam, method, int(n), float(f), float(eta), measured[int(n)])
        shear = one.modulus_pa / (1 if method == _SANDWICH else 2 * (1 + beam.core.poisson))
        G, loss = law.storage_and_loss(2 * np.pi * np.array([f]))
        found.append(
            ByFormula(
                int(n),
                float(f),
                method,
                one.loss_factor,
                shear,
                None,
                float(G[0]),
                float(loss[0]),
                one.objections + _of_faces(beam),
            )
        )
    if not found:
        raise OutsideModel("--bare holds none of the table's modes, expected the same modes of the bare beam")
    return tuple(found)


_SANDWICH = "ross-kerwin-ungar"


def _method(beam: Beam) -> str:
    if beam.is_doubled:
        raise OutsideModel("the standard has no formula for constrained layers on both sides, expected one")
    if beam.constraining is not None:
        return _SANDWICH
    return "van-oort" if beam.both_sides else "oberst"


def _of_mode(beam: Beam, method: str, n: int, f: float, eta: float, bare_hz: float) -> LayerFound:
    face, core = beam.substrate, beam.core
    assert core is not None
    young = young_of_bare(n, bare_hz, beam.length_m, face.thickness_m, face.density_kg_m3)
    D = core.density_kg_m3 / face.density_kg_m3
    if method == _SANDWICH:
        return sandwich(
            young_pa=young,
            face_thickness_m=face.thickness_m,
            core_thickness_m=core.thickness_m,
            density_ratio=D,
            length_m=beam.length_m,
            mode=n,
            bare_hz=bare_hz,
            treated_hz=f,
            loss_factor=eta,
        )
    formula = oberst if method == "oberst" else van_oort
    return formula(young, core.thickness_m / face.thickness_m, D, f / bare_hz, eta, n)


def _of_faces(beam: Beam) -> tuple[str, ...]:
    other = beam.constraining
    if other is None:
        return ()
    pairs = (
        (getattr(beam.substrate, name), getattr(other, name))
        for name in ("thickness_m", "young_pa", "density_kg_m3")
    )
    alike = all(abs(a / b - 1) < _ALIKE for a, b in pairs)
    return () if alike else ("the formula is of two equal faces",)
