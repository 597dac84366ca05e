"""An effect among several files: common to all of them, or of one."""

from collections.abc import Mapping

import numpy as np

from fitting.arrays import Array
from fitting.effects.base import Effect, EffectParameter, Points
from fitting.effects.enriched_plate import EnrichedReducedPlate

FILE = "file"


class OfFiles(Effect):
    """`inner` in every file (`file` 0) or in one, counted from 1; the forms are tried apart."""

    def __init__(self, inner: Effect, files: int, file: int = 0) -> None:
        self.inner, self.files, self.file = inner, files, file
        q = EffectParameter(FILE, "1", 0.0, float(files), float(file), neutral=None, fixed=True)
        vars(self).update(
            name=inner.name,
            enters=inner.enters,
            source=inner.source,
            chance=inner.chance,
            unexplained_share=inner.unexplained_share,
            discriminating_test=inner.discriminating_test,
            parameters=(*inner.parameters, q),
            spans=inner.spans,
        )

    def objection(self, points: Points, plate: EnrichedReducedPlate) -> str | None:
        return self.inner.objection(points, plate)

    def starts(self, plate: EnrichedReducedPlate, points: Points) -> list[Array]:
        return [np.append(u, self.file) for u in self.inner.starts(plate, points)]

    def limits(self, plate: EnrichedReducedPlate) -> tuple[Array, Array]:
        low, high = self.inner.limits(plate)
        return np.append(low, 0.0), np.append(high, self.files)

    def scaled(self, u: Array, a: float) -> Array:
        return np.append(self.inner.scaled(u[:-1], a), self.file)

    def variants(self) -> tuple[Effect, ...]:
        forms = self.inner.variants()
        return tuple(OfFiles(form, self.files, k) for k in range(self.files + 1) for form in forms)

    def story(self, u: Mapping[str, float]) -> str:
        where = "in every file" if not u[FILE] else f"in file {u[FILE]:.0f}"
        return f"{where} {self.inner.story(u)}"
