"""A session with two fits and a diagnosis in it; the diagnosis is made by hand, of other points."""

from copy import deepcopy
from functools import cache

from diagnosis_cases import diagnosis as by_hand
from session_cases import SyntheticSession, configuration

from instrument.run.live_fit import fit_points
from instrument.stream.derived import DiagnosisFound
from instrument.stream.raw import DiagnosisStarted, FitStarted


def diagnosed_session(folder, diagnosis=None, *, message=""):
    """Its path. `message` instead of a diagnosis: none was possible."""
    fitted, last = _fitted_twice()
    synthetic = deepcopy(fitted)
    synthetic.emit(DiagnosisStarted(1, last))
    found = None if message else diagnosis or by_hand()
    synthetic.events.append(DiagnosisFound(1, last, found, message))
    synthetic.end()
    return synthetic.save(folder)


@cache
def _fitted_twice():
    """A session up to its diagnosis, and the last step that was fitted."""
    synthetic = SyntheticSession(configuration())
    synthetic.begin()
    synthetic.sweep((1,))
    _fit(synthetic, 1)
    synthetic.sweep((2, 3), begin=False)
    return synthetic, _fit(synthetic, 2)


def _fit(synthetic, number):
    last = max(p.step for p in synthetic.analysis.points)
    synthetic.emit(FitStarted(number, last))
    synthetic.events.append(
        fit_points(number, last, synthetic.analysis.points, None, synthetic.configuration.the_specimen())
    )
    return last
