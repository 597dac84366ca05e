"""The response at the pickup."""

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike, NDArray

from fitting.identification.bare_plate import fit_bare_plate, with_bare_plate
from instrument.errors import BadInput
from instrument.facts.prediction import PredictionResult
from instrument.models.specimen_models import Models
from instrument.progress import bar
from instrument.remarks.theory import theory_remark
from instrument.results.fit_file import found_law
from instrument.results.fitted_response import fitted_response
from instrument.results.prediction_from import of_spots, prediction_from, prediction_from_fit
from viscorig.checked import numbers
from viscorig.facts import Facts
from viscorig.hammer import HammerTest, hammer_modes_of
from viscorig.identification import Identification
from viscorig.shown import Columns, columns
from viscorig.specimen import Specimen

if TYPE_CHECKING:
    from matplotlib.axes import Axes

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]


@dataclass(frozen=True, repr=False)
class Response(Facts[PredictionResult]):
    """Velocity at the pickup under the specimen's base acceleration: the JSON of `viscorig predict`."""

    @property
    def frequency_hz(self) -> Array:
        """Frequencies of the prediction. Shape (points,)."""
        return np.asarray(self.to_numpy()["frequency_hz"])

    @property
    def velocity_m_s(self) -> Complex:
        """Velocity at the pickup, phasors of e^{+i omega t}, zero to peak. Shape (points,)."""
        table = self.to_numpy()
        return np.asarray(table["velocity_re_m_s"] + 1j * table["velocity_im_m_s"])

    def to_numpy(self) -> Columns:
        """The response as a table, a row a frequency."""
        return columns(self.result.points)

    def lines(self) -> list[str]:
        """How many frequencies were asked for, and what is noted of them."""
        f = self.frequency_hz
        return [f"response at {len(f)} frequencies, {f.min():g} to {f.max():g} Hz", *self.result.notes]

    def plot(self, ax: "Axes | None" = None) -> "Axes":
        """Amplitude over frequency; the axes."""
        from viscorig.plots import plot_amplitude

        return plot_amplitude(ax, self.frequency_hz, np.abs(self.velocity_m_s), "-", "predicted")


def predict(
    specimen: Specimen,
    frequency_hz: ArrayLike,
    *,
    fit: Identification | None = None,
    hammer: HammerTest | None = None,
    real_modes: bool = False,
) -> Response:
    """Velocity at the pickup under the specimen's law, at frequencies of shape (points,).

    `fit` puts the law and the plate that it found in their place and brings standard errors; `hammer` the
    bare plate's stiffness and ratios; `real_modes` takes the paper's uncoupled modes. The same numbers as
    `viscorig predict`. Raises `BadInput`, `OutsideModel`.
    """
    f = numbers("frequency_hz", frequency_hz, float, above_zero=True)
    if real_modes and fit is not None:
        raise BadInput("real_modes and fit: expected one of them")
    model, tested = specimen.model, hammer_modes_of(hammer)
    if tested is not None:
        model = with_bare_plate(model, fit_bare_plate(model, *tested))
    law = model.core.law if model.core is not None else None
    if fit is None:
        outside = law.outside(f) if law is not None else ""
        remarks = (outside, theory_remark(model, law, f))
        spots = [
            Models.of(model.at_pickup(k), f, bar).predict(law, f, real_modes=real_modes)
            for k in range(max(1, len(model.pickups_m)))
        ]
        return Response(of_spots([prediction_from(f, v, *remarks) for v in spots]))
    if model.further_pickups_m:
        raise BadInput("fit with several pickups, expected one")
    known = found_law(fit.result)
    found = fitted_response(model, known, f, bar)
    law = known.law(law) if law is not None else None
    return Response(prediction_from_fit(found, known.outside(f), theory_remark(model, law, f)))
