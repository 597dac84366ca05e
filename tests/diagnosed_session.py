"""A session with two fits and a diagnosis in it; the diagnosis is made by hand, of other points."""

from diagnosis_cases import facts
from session_cases import Tape, configuration

from instrument.run.live_fit import fit_points
from instrument.stream.derived import DiagnosisFound
from instrument.stream.raw import DiagnosisStarted, FitStarted


def diagnosed_session(folder, diagnosis=None, *, message=""):
    """Its path. `message` instead of a diagnosis: none was possible."""
    tape = Tape(configuration())
    tape.begin()
    tape.sweep((1,))
    _fit(tape, 1)
    tape.sweep((2, 3), begin=False)
    last = _fit(tape, 2)
    tape.emit(DiagnosisStarted(1, last))
    found = {} if message else diagnosis or facts()
    tape.events.append(DiagnosisFound(1, last, found, message))
    tape.end()
    return tape.save(folder)


def _fit(tape, number):
    last = max(p.step for p in tape.analysis.points)
    tape.emit(FitStarted(number, last))
    tape.events.append(
        fit_points(number, last, tape.analysis.points, None, tape.configuration.the_specimen())
    )
    return last
