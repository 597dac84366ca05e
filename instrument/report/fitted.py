"""The identification behind the page, made when the page is written."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from fitting.arrays import Array, Complex
from fitting.errors import FittingError
from instrument.errors import BadInput
from instrument.interchange.identified import SessionFit, identify_session
from instrument.progress import Progress, quiet
from instrument.results.fit_file import found_law
from instrument.results.fitted_response import FittedModel
from instrument.results.identification_facts import identification_facts
from instrument.session.contents import Contents
from instrument.stream.jsonable import to_jsonable


@dataclass(frozen=True)
class Fitted:
    """A fit, or why there is none."""

    fit: SessionFit | None
    why: str = ""

    @classmethod
    def of(cls, contents: Contents, progress: Progress = quiet) -> "Fitted":
        """Identify, and never fail: a page without a law says so."""
        try:
            return cls(identify_session(contents, progress))
        except (FittingError, BadInput) as error:
            return cls(None, " ".join(str(error).removeprefix(f"{contents.path}: ").split()))

    @cached_property
    def facts(self) -> dict[str, object]:
        """The JSON of `viscorig identify`; empty without a fit."""
        return identification_facts(self.fit.identified, self.fit.sweep) if self.fit is not None else {}

    @cached_property
    def _model(self) -> FittedModel | None:
        """The plate that was fitted, not the one that was stated."""
        if self.fit is None:
            return None
        facts = to_jsonable(self.facts)
        if self.fit.bare is not None:
            facts["hammer"] = {"modal_ratios": list(self.fit.bare.ratios)}
        return FittedModel.of(self.fit.specimen, found_law(facts), self.fit.sweep.frequency_hz)

    def over_base(self, frequency_hz: Array) -> Complex | None:
        """The model's velocity over base acceleration in s at any frequency."""
        if self.fit is None:
            return None
        assert self._model is not None
        return np.asarray(self._model.velocity(frequency_hz) / self.fit.specimen.base_acceleration_m_s2)
