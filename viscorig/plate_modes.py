"""Complex modes of a specimen."""

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from instrument.facts.modes import ModesResult
from instrument.models.specimen_modes import edge_twist_remark, specimen_modes
from instrument.progress import bar
from instrument.remarks.theory import theory_remark
from instrument.results.law_words import aligned
from instrument.results.modes_from import modes_from
from viscorig.facts import Facts
from viscorig.shown import Columns, columns
from viscorig.specimen import Specimen

if TYPE_CHECKING:
    from matplotlib.axes import Axes

Array = NDArray[np.float64]


@dataclass(frozen=True, repr=False)
class Modes(Facts[ModesResult]):
    """Natural frequencies and modal loss factors: the JSON of `viscorig modes`."""

    @property
    def frequency_hz(self) -> Array:
        """Natural frequencies, the lowest first. Shape (modes,)."""
        return np.array([m.frequency_hz for m in self.result.modes], dtype=float)

    @property
    def loss_factor(self) -> Array:
        """Modal loss factors. Shape (modes,)."""
        return np.array([m.loss_factor for m in self.result.modes], dtype=float)

    def to_numpy(self) -> Columns:
        """The modes as a table, a row each."""
        return columns(self.result.modes)

    def lines(self) -> list[str]:
        """How many modes there are, and between which frequencies."""
        f = self.frequency_hz
        return [f"{len(f)} modes, {f.min():.4g} to {f.max():.4g} Hz" if len(f) else "no modes"]

    def printed(self) -> list[str]:
        """Frequencies and loss factors."""
        rows = [[f"{m.frequency_hz:.5g}", f"{m.loss_factor:.4g}"] for m in self.result.modes]
        return aligned(["frequency/Hz", "loss factor"], rows) if rows else []

    def plot(self, ax: "Axes | None" = None) -> "Axes":
        """Loss factors over frequency; the axes."""
        from viscorig.plots import plot_modes

        return plot_modes(ax, self.to_numpy())


def modes(specimen: Specimen, count: int = 8) -> Modes:
    """The first modes, the core's law taken at each mode's own frequency; rigid ones are left out.

    The same numbers as `viscorig modes`. Raises `OutsideModel`.
    """
    model = specimen.model
    law = model.core.law if model.core is not None else None
    found = specimen_modes(model, count, bar)
    theory = theory_remark(model, law, np.array([m.frequency_hz for m in found]))
    return Modes(modes_from(found, law, remarks=[edge_twist_remark(model, count), theory]))
