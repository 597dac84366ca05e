"""What the reduced plate must span so that it can carry an effect."""

from collections.abc import Mapping

import numpy as np
import scipy.sparse as sp

from fitting.arrays import Array, Complex
from fitting.widened.full_plate import FullPlate, Snapshot

UNIT_RESPONSE = 0.3
"""Size assumed for a unit response where forces do not say how large an effect makes it. Motions smaller than
`enriching.TOLERANCE` of a typical change are left out, which is a hundredth of such a response. A choice."""


class Span:
    """Motions a family of effects needs beside those of the unchanged plate, and matrices it works with."""

    name: str
    odd: bool = False
    """Whether it couples to motions odd in y."""
    overlaps: bool = False
    """Whether its motions hold some of the plate's own: a condensed plate has lost those."""
    strains: bool = False
    """Whether its effects go by the core's strain."""
    columns: int = 40
    """At most as many of either parity."""

    def matrices(self, full: FullPlate) -> Mapping[str, sp.sparray | Array]:
        """Symmetric matrices over the full plate, by name; an (n, r) array stands for L L^T."""
        return {}

    def vectors(self, full: FullPlate) -> Mapping[str, Array]:
        """Loads over the full plate, by name. Shape (n,) each."""
        return {}

    def forces(self, full: FullPlate, at: Snapshot) -> Array | Complex:
        """Of typical changes, as large as the effect makes them; their responses are spanned.

        Shape (n, any).
        """
        return np.empty((len(at.x), 0))

    def responses(self, full: FullPlate, at: Snapshot, answers: Complex) -> Complex:
        """What is to be spanned: the held plate's `answers` to `forces`, or what follows from them.

        Shape (n, any).
        """
        return answers


class UnitSpan(Span):
    """Motions of forces that do not say how large an effect makes them: all of one usual size."""

    def responses(self, full: FullPlate, at: Snapshot, answers: Complex) -> Complex:
        """The answers, each of the size `UNIT_RESPONSE`. Shape (n, any)."""
        return UNIT_RESPONSE * full.unit(answers)
