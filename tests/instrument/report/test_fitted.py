"""The fit behind a page, of a session that is several files: every one has numbers of its own."""

from dataclasses import replace

import numpy as np
import pytest

from instrument.report.fitted import ReportedFit
from instrument.session.contents import TimedPoint

MASS = {"sweep": 3, "mass_kg": 0.005, "mass_at_mm": (280.0, 100.0)}
ANEW = {"sweep": 3, "mounting": 1}
BESIDE = {"sweep": 3, "pickup": 1, "spot_mm": (61.0, 139.9)}
"""Across the plate's axis, and a millimetre off: both spots are found nearer to each other."""


@pytest.fixture
def not_exact(contents):
    """The session on a plate that is stated within typical tolerances."""
    specimen = contents.configuration.specimen.model_copy(update={"tolerances": None})
    return replace(contents, configuration=contents.configuration.model_copy(update={"specimen": specimen}))


@pytest.mark.parametrize(
    ("changed", "own"), [(MASS, "mass_1 [2]"), (ANEW, "length [1]"), (BESIDE, "pickup_x [pickup 0]")]
)
def test_the_model_is_the_first_file_as_the_fit_has_it(not_exact, changed, own):
    first = not_exact.measured
    then = [replace(p, **changed) for p in first if p.segment == 1]
    both = [TimedPoint(p, float(k)) for k, p in enumerate((*first, *then))]
    reported = ReportedFit.of(replace(not_exact, points=both))
    fit = reported.fit.result.fit
    assert own in [one.name for one in fit.adjusted]
    count = len(reported.fit.files[0].sweep) - np.count_nonzero(reported.fit.why_aside[: len(first)] != "")
    sweep = reported.fit.sweep.take(np.arange(count))
    shown = reported.over_base(sweep.frequency_hz) * sweep.commanded_m_s2
    np.testing.assert_allclose(np.abs(shown), np.abs(fit.velocity_m_s[:count]), rtol=1e-3)
