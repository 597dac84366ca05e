"""A response of another sign in some hits than in the others: a cable swapped, a polarity switched."""

from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np

from fitting.arrays import Array
from fitting.modal.frf import Frf
from instrument.impact.judge import Judged

_TURNED = -0.3
"""Correlation of two hits' FRFs from which one is the other's opposite. A choice: of a hit at another place
modes turn each for itself, and it is nearer nothing."""


def turned_alike(
    good: Sequence[Judged], alone: Sequence[Mapping[str, Frf]], band_hz: tuple[float, float]
) -> tuple[list[Judged], list[str]]:
    """The hits with every response as in most of them, and what was turned, for people.

    `alone` are the FRFs of each hit by itself. Damping does not depend on the sign; the mean of hits does.
    """
    hits, said = list(good), list[str]()
    for name in alone[0]:
        signs = _signs(np.array([one[name].between(*band_hz).H for one in alone]))
        for k in np.flatnonzero(signs < 0).tolist():
            responses = tuple(
                replace(c, samples=-c.samples) if c.name == name else c for c in hits[k].hit.responses
            )
            hits[k] = replace(hits[k], hit=replace(hits[k].hit, responses=responses))
            said.append(f"{hits[k].hit.source}: {name} has the other hits' opposite sign: turned")
    return hits, said


def _signs(H: Array) -> Array:
    """Of each hit, 1 for as in most, or as in the first where as many are not. Shape (hits,)."""
    size = np.maximum(np.linalg.norm(H, axis=1), 1e-300)
    alike = (H @ H.conj().T).real / np.outer(size, size)
    to_first = np.where(alike[0] < _TURNED, -1, 1)
    return to_first if 2 * np.sum(to_first > 0) >= len(H) else -to_first
