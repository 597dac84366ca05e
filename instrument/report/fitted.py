"""The identification behind the page, made when the page is written."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from fitting.arrays import Array, Complex
from fitting.errors import FittingError
from fitting.specimen import PlateSpecimen
from instrument.errors import BadInput
from instrument.facts.identification import IdentificationResult
from instrument.facts.rows import PointSetAside
from instrument.finding.identification import Identified
from instrument.interchange.identified import identify_session
from instrument.progress import Progress, quiet
from instrument.results.fit_file import found_law
from instrument.results.fitted_response import FittedModel
from instrument.results.fitted_small import FittedSmall
from instrument.results.identification_from import identification_from
from instrument.results.rows_from import points_set_aside_from
from instrument.session.contents import Contents


@dataclass(frozen=True)
class ReportedFit:
    """A fit, or why there is none."""

    fit: Identified | None
    why: str = ""

    @classmethod
    def of(cls, contents: Contents, progress: Progress = quiet) -> "ReportedFit":
        """Identify, and never fail: a page without a law says so."""
        try:
            return cls(identify_session(contents, progress))
        except (FittingError, BadInput) as error:
            return cls(None, " ".join(str(error).removeprefix(f"{contents.path}: ").split()))

    @cached_property
    def result(self) -> IdentificationResult | None:
        """That of `viscorig identify`; None without a fit."""
        fit = self.fit
        return identification_from(fit) if fit is not None else None

    @property
    def points_set_aside(self) -> tuple[PointSetAside, ...]:
        """Points that the fit has left out."""
        if self.fit is None:
            return ()
        return points_set_aside_from(self.fit.given, self.fit.why_aside)

    @cached_property
    def _model(self) -> FittedModel | FittedSmall | None:
        """The specimen that was fitted, not the one that was stated."""
        if self.fit is None or self.result is None:
            return None
        specimen, found = self.fit.files[0].specimen, found_law(self.result)
        if not isinstance(specimen, PlateSpecimen):
            return FittedSmall.of(specimen, found)
        return FittedModel.of(specimen, found, self.fit.given.frequency_hz)

    def over_base(self, frequency_hz: Array) -> Complex | None:
        """The model's velocity over base acceleration in s at any frequency. Shape (points,)."""
        if self.fit is None:
            return None
        assert self._model is not None
        return np.asarray(
            self._model.velocity(frequency_hz) / self.fit.files[0].specimen.base_acceleration_m_s2
        )
