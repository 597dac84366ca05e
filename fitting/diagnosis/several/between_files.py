"""An effect that says how files differ: of one of them, or of each but the first."""

from collections.abc import Mapping

import numpy as np

from fitting.arrays import Array
from fitting.diagnosis.several.of_files import EACH, FILE, OfFiles, Place
from fitting.effects.base import Effect
from fitting.effects.given import Points
from fitting.widened.enriched_plate import EnrichedReducedPlate

_PAIR = 2
"""Files of which either may as well be the odd one."""
_SIGNS = 4
"""Patterns of signs that sizes begin with, less one, at most: a fit changes them."""


class BetweenFiles(OfFiles):
    """`inner` in one file (`file`, counted from 1), the law that of the others; the forms are tried apart.

    Of three files on also with a size of its own in each but the first, to which the law then belongs (`file`
    -1). Of two files either may as well be the one.
    """

    def __init__(self, inner: Effect, files: int, file: int = _PAIR) -> None:
        """`files` is two or more."""
        super().__init__(inner, files, file)
        self.from_afar = file == EACH or files == _PAIR

    @property
    def own(self) -> list[int]:
        numbers = list(range(1, self.files + 1))
        return numbers[1:] if self.file == EACH or self.files == _PAIR else numbers

    def holds(self, place: Place) -> bool:
        return place.file in self.own and self.file in (EACH, place.file)

    def starts(self, plate: EnrichedReducedPlate, points: Points) -> list[Array]:
        if self.file != EACH:
            return super().starts(plate, points)
        own = [np.outer(p, u).ravel() for u in self.inner.starts(plate, points) for p in self._patterns]
        return [np.append(u, float(EACH)) for u in own]

    @property
    def _patterns(self) -> Array:
        """Shares of a start in each file: growing from file to file, and some with either sign.

        Not all alike, which is the first file alone. Shape (patterns, files but the first).
        """
        ahead = np.arange(1, self.copies + 1)
        # Both signs turned are the same start: the last file's stays.
        numbers = range(1, min(_SIGNS, 2 ** (self.copies - 1)))
        signs = [np.where((number >> np.arange(self.copies)) & 1, -1.0, 1.0) for number in numbers]
        return np.array([ahead / self.copies, *signs])

    def objection(self, points: Points, plate: EnrichedReducedPlate) -> str | None:
        return None

    def within(self, u: Array) -> tuple[tuple[Effect, Array], ...]:
        if self.file != EACH:
            return ()
        sizes = np.vstack([np.zeros(len(self.inner.parameters)), np.array_split(u[:-1], self.copies)])
        others = (sizes.sum(axis=0) - sizes) / self.copies
        return tuple(
            (self.form(self.inner, k + 1), np.append(own - rest, k + 1.0))
            for k, (own, rest) in enumerate(zip(sizes, others, strict=True))
        )

    def variants(self) -> tuple[Effect, ...]:
        return tuple(self.form(form, k) for form in self.inner.variants() for k in self._numbers)

    @property
    def _numbers(self) -> list[int]:
        # The first form is the one that contains the others: plain starts are of the first.
        return [_PAIR] if self.files == _PAIR else [EACH, *range(1, self.files + 1)]

    def form(self, inner: Effect, file: int, *_: object) -> "BetweenFiles":
        return BetweenFiles(inner, self.files, file)

    def story(self, u: Mapping[str, float]) -> str:
        if u[FILE] != EACH:
            return f"{super().story(u)} than in the others"
        # The first of the numbers has the plain key, the others theirs behind it.
        keys = [q.key for q in self.inner.parameters]
        parts = []
        for k in self.own:
            mine = {key: u[key if k == self.own[0] else f"{key}_{k}"] for key in keys}
            parts.append(f"in file {k} {self.inner.story(mine)} than in file 1")
        return ", ".join(parts)
