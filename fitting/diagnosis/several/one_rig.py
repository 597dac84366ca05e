"""What the instruments of one rig read wrongly alike in all its sweeps, besides each sweep's own."""

from collections.abc import Sequence

import numpy as np

from fitting.arrays import Complex
from fitting.diagnosis.problem.base import DiagnosisProblem


def alike_rows(problems: Sequence[DiagnosisProblem], kinds: Sequence[str]) -> Complex:
    """Of gain, delay or phase, as large as each sweep's own. Relative, one standard deviation each.

    None of a kind that is exact in all of them. Shape (any, points), sweep after sweep.
    """
    omega = np.concatenate([p.sweep.omega for p in problems])
    by = {"gain": np.ones(len(omega)), "delay": -1j * omega, "phase": np.full(len(omega), 1j)}
    rows = [by[kind] * np.concatenate([_size(p, kind) for p in problems]) for kind in kinds]
    return np.array([row for row in rows if row.any()], complex).reshape(-1, len(omega))


def _size(problem: DiagnosisProblem, kind: str) -> np.ndarray:
    sigma = sum(n.sigma for n in problem.nuisances.each if n.kind == kind)
    return np.full(len(problem.sweep), sigma)
