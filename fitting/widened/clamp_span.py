"""Motions with clamps on springs: a root, or any clamped edges."""

from collections.abc import Sequence

import scipy.sparse as sp

from fitting.arrays import Array, Complex
from fitting.widened.full_plate import FullPlate, Snapshot
from fitting.widened.released_rim import Released, released_rim, rim_forces
from fitting.widened.released_root import released, root_forces
from fitting.widened.span import Span


class RootSpan(Span):
    """Motions with some of the root's degrees of freedom on springs; a plate without a root has none."""

    released: Sequence[int]

    def springs(self, full: FullPlate) -> Sequence[sp.sparray]:
        """At the clamps of the full plate, as stiff as is typical. Shape (n, n) each."""
        raise NotImplementedError

    def forces(self, full: FullPlate, at: Snapshot) -> Array | Complex:
        if "root" not in full.specimen.offers:
            return super().forces(full, at)
        return root_forces(full, at, self.released)

    def responses(self, full: FullPlate, at: Snapshot, answers: Complex) -> Complex:
        if "root" not in full.specimen.offers:
            return answers
        odd = self.odd or not full.only_even
        return released(full, at, self.released, answers, odd=odd).answers(full, self.springs(full))


class ClampSpan(RootSpan):
    """The same of every clamped edge, where a plate is held on others than a root."""

    released_along_x: Sequence[int]
    """Degrees of freedom that are released along edges parallel to x. A root lies along y: `released` is of
    edges along y."""

    def forces(self, full: FullPlate, at: Snapshot) -> Array | Complex:
        if not on_a_rim(full):
            return super().forces(full, at)
        return rim_forces(full, at, self._each)

    def responses(self, full: FullPlate, at: Snapshot, answers: Complex) -> Complex:
        if not on_a_rim(full):
            return super().responses(full, at, answers)
        return released_rim(full, at, self._each, answers).answers(full, self.springs(full))

    @property
    def _each(self) -> Released:
        return {"x": self.released, "y": self.released_along_x}


def on_a_rim(full: FullPlate) -> bool:
    """Whether it is clamped, and not on a root alone that is alike on both sides of the axis."""
    return "clamp" in full.specimen.offers and "root" not in full.specimen.offers
