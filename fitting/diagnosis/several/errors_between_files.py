"""What sets files apart, or is wrong in all of them alike, besides the errors that each has by itself."""

from collections.abc import Sequence

import numpy as np

from fitting.arrays import Array, Complex
from fitting.diagnosis.problem.base import DiagnosisProblem
from fitting.diagnosis.problem.small_problem import LEVEL
from fitting.diagnosis.several.joining import parts_of
from fitting.diagnosis.several.member_laws import law_at
from fitting.diagnosis.several.of_files import Place
from fitting.diagnosis.several.one_rig import alike_rows
from fitting.effects.temperature_drift import time_scale
from fitting.identification.validation import rms
from fitting.laws import CoreLaw

KELVIN = 0.1
"""Standard deviation of how much warmer a core is in one file than in another where nobody took care."""
Members = Sequence[DiagnosisProblem]


def of_one_rig(members: Members, of: Sequence[Place]) -> Complex:
    """Gain and delay that all masses of a shear pair have in common, besides each file's own.

    The same two accelerometers read them. Relative, one standard deviation each; shape (any, points).
    """
    pairs = all(m.specimen.kind == "shear-pair" for m in members)
    if not pairs or len({b.file for b in of}) < 2:
        return np.zeros((0, sum(len(m.sweep) for m in members)), complex)
    # The angle is one stated number of all of them.
    return alike_rows(members, ("gain", "delay"))


def own_temperatures(members: Members, of: Sequence[Place], law: CoreLaw, v: Complex) -> Complex:
    """What a core by `KELVIN` warmer in one file than in the others does to ln of the reading `v`.

    Shape (files, points); none of specimens that are exactly as stated.
    """
    files = sorted({b.file for b in of})
    rows = np.zeros((len(files), len(v)), complex)
    if members[0].specimen.exact or len(files) < 2:
        return rows[:0]
    for k, (m, b, part) in enumerate(zip(members, of, _parts(members), strict=True)):
        own, omega = law_at(law, k), m.sweep.omega
        change = np.log(own.modulus(omega * time_scale(KELVIN)) / own.modulus(omega))
        rows[files.index(b.file), part] = change * m.feels(own, v[part])
    return rows


def own_cores(members: Members, law: CoreLaw, v: Complex) -> Complex:
    """What a core a little stiffer in one file than in the others does to ln of the reading `v`, by `LEVEL`.

    No two files are at one temperature. Of members whose files have levels of their own
    (`DiagnosisProblem.errs_in_level`). Shape (members, points).
    """
    rows = np.zeros((len(members), len(v)), complex)
    for k, (m, part) in enumerate(zip(members, _parts(members), strict=True)):
        if m.errs_in_level:
            rows[k, part] = LEVEL * m.feels(law_at(law, k), v[part])
    return rows


def alike(members: Members, of: Sequence[Place]) -> float:
    """Gain and phase that all files have in common may be off by so much: as the files' misfit is.

    The same accelerometers have read every one of them. Zero where noise explains the files, and of one file
    alone, whose law would hide it.
    """
    if len({b.file for b in of}) < 2 or not all(m.errs_in_level for m in members):
        return 0.0
    misfits: Array = np.array([m.misfit for m in members])
    return rms(misfits)


def _parts(members: Members) -> list[slice]:
    return parts_of([m.sweep for m in members])
