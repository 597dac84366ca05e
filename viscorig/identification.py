"""A core's law as it was identified, just now or in a session."""

from dataclasses import dataclass
from math import isnan
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike, NDArray

from instrument.facts.doubts import doubts_of
from instrument.facts.identification import IdentificationResult
from instrument.results.fit_file import found_law
from instrument.results.law_words import LAW_COLUMNS, a_few, aligned, law_cells, sources_words
from instrument.results.numbers import with_error
from viscorig.checked import numbers
from viscorig.facts import Facts
from viscorig.shown import Columns, columns
from viscorig.specimen import Specimen

if TYPE_CHECKING:
    from matplotlib.axes import Axes

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]


@dataclass(frozen=True, repr=False)
class Identification(Facts[IdentificationResult]):
    """A core's law with its uncertainty, and what is left of the data: the JSON of `viscorig identify`."""

    specimen: Specimen
    """The specimen that was measured; the search began at its law."""

    @property
    def parameters(self) -> dict[str, float]:
        """Parameters of the law found by name, in SI units, which the names end with."""
        return dict(self.result.parameters)

    @property
    def standard_errors(self) -> dict[str, float | None]:
        """Standard errors of the law's parameters by name; None for one at its limit."""
        errors = self.result.standard_errors
        return {key: None if isnan(error) else error for key, error in errors.items()}

    @property
    def doubts(self) -> tuple[str, ...]:
        """Those `warnings` by which the law may be wrong by more than is known of it; empty for none."""
        return doubts_of(self.result)

    @property
    def frequency_hz(self) -> Array:
        """Frequencies at which the law is stated, over the measured band. Shape (frequencies,)."""
        return np.asarray(self.to_numpy()["frequency_hz"])

    @property
    def storage_modulus_pa(self) -> Array:
        """G' at `frequency_hz`. Shape (frequencies,)."""
        return np.asarray(self.to_numpy()["storage_modulus_pa"])

    @property
    def loss_factor(self) -> Array:
        """Loss modulus over storage modulus, G''/G' at `frequency_hz`. Shape (frequencies,)."""
        return np.asarray(self.to_numpy()["loss_factor"])

    @property
    def points(self) -> Columns:
        """Measured and predicted amplitude of every point, and their difference. Shape (points,) each."""
        return columns(self.result.points)

    @property
    def rms_percent(self) -> float:
        """The rms difference between measured and predicted amplitudes, in percent."""
        return self.result.rms_percent

    def modulus_pa(self, frequency_hz: ArrayLike) -> Complex | complex:
        """G* of the law found, in Pa; an extrapolation beyond the measured band. Shape of `frequency_hz`.

        A number for a number. Raises `BadInput` where a frequency is not above 0 and finite.
        """
        core = self.specimen.model.core
        assert core is not None
        omega = 2 * np.pi * numbers("frequency_hz", np.ravel(frequency_hz), float, above_zero=True)
        G = found_law(self.result).law(core.law).modulus(omega)
        return G.reshape(np.shape(frequency_hz)) if np.ndim(frequency_hz) else complex(G[0])

    def to_numpy(self) -> Columns:
        """The law over the measured band with its standard errors, a row a frequency."""
        return columns(self.result.law)

    def lines(self) -> list[str]:
        """Law, parameters, what is left, warnings."""
        errors = self.result.standard_errors
        found = ", ".join(f"{k} = {with_error(v, errors[k])}" for k, v in self.parameters.items())
        left = f"rms {self.rms_percent:.2f} %, largest {self.result.max_percent:.2f} %"
        notes = [f"note: {said}" for said in self.warnings]
        return [f"{self.result.law_kind}: {found}", f"difference in amplitude: {left}", *notes]

    def printed(self) -> list[str]:
        """G' and the loss factor at a few frequencies of the band, as the command prints them."""
        rows = law_cells(a_few(self.result.law), sign="±")
        sources = sources_words(self.result.method, self.result.noise)
        title = f"the law in the measured band, ± one standard error ({sources})"
        return [title, *aligned(LAW_COLUMNS, rows)]

    def plot(self, ax: "Axes | None" = None) -> "Axes":
        """G' and, on an axis of its own, the loss factor over frequency, with 95 % bands; the axes."""
        from viscorig.plots import plot_laws

        return plot_laws(ax, {"": self.to_numpy()})

    def plot_fit(self, ax: "Axes | None" = None) -> "Axes":
        """Measured and predicted amplitudes over frequency, and readings set aside; the axes."""
        from viscorig.plots import plot_amplitude, plot_set_aside

        f = self.points["frequency_hz"]
        ax = plot_amplitude(ax, f, self.points["measured_m_s"], "o", "measured")
        plot_set_aside(ax, self.result.points_set_aside)
        return plot_amplitude(ax, f, self.points["predicted_m_s"], "x", "fitted")
