"""A session that holds a fit that failed: put together, carried on, replayed, that fit is not made again."""

import pytest
from formula_rig import formula_rig
from quick_run import no_fit, run
from session_cases import SyntheticSession, configuration

from instrument.cli.main import run as viscorig
from instrument.errors import RigStopped
from instrument.run.companion import Companion
from instrument.run.control import RunControl
from instrument.run.experiment import run_experiment
from instrument.run.replay import replay
from instrument.session.storage import SessionFile
from instrument.stream.derived import FitUpdated
from instrument.stream.raw import FitFailed, FitStarted


class Aborting(Companion):
    """Ends the run as soon as a fit has failed."""

    def __init__(self, control):
        self._control = control

    def happened(self, event):
        if isinstance(event, FitFailed):
            self._control.abort("broken off")


def fails(*_):
    raise MemoryError


def broken_off(experiment, folder):
    """A run up to its first fit, which failed; its folder."""
    control = RunControl()
    with pytest.raises(RigStopped, match="broken off"):
        run_experiment(
            experiment, folder, ("sweep",), fit=fails, control=control, companion=Aborting(control)
        )
    (running,) = folder.glob("*.running")
    return running


def replayed(path, fit=no_fit):
    """What came of it, events of fits that were watched, and number and last step of each fit made."""
    watched, fitted = [], []

    def counted(number, last_step, *rest):
        fitted.append((number, last_step))
        return fit(number, last_step, *rest)

    with SessionFile(path) as file:
        again = replay(file, fit=counted, watch=watched.append)
    return again, [e for e in watched if isinstance(e, FitStarted | FitFailed | FitUpdated)], fitted


def test_a_recovered_session_whose_fit_failed_is_replayed_without_it(tmp_path):
    with formula_rig(tmp_path) as (_, experiment):
        running = broken_off(experiment, tmp_path)
    assert viscorig(["recover", str(running)]) == 0
    again, watched, fitted = replayed(running.with_suffix(".h5"), fails)
    assert again.differences == []
    assert len(again.points) >= 9
    assert again.fit is None
    assert fitted == []
    assert [type(e) for e in watched] == [FitStarted, FitFailed]
    assert watched[1].words == "fit 1 failed: no memory left"


def test_carried_on_a_fit_that_has_the_failed_one_s_number_is_made_again_in_a_replay(tmp_path):
    with formula_rig(tmp_path) as (_, experiment):
        finished = run(experiment, tmp_path, resume=broken_off(experiment, tmp_path))
    again, watched, fitted = replayed(finished.session)
    assert again.differences == []
    assert [type(e) for e in watched[:4]] == [FitStarted, FitFailed, FitStarted, FitUpdated]
    assert [e.number for e in watched[:4]] == [1, 1, 1, 1]
    assert fitted == [(e.number, e.last_step) for e in watched[2:] if isinstance(e, FitStarted)]
    assert again.fit == finished.fit


def test_a_fit_that_was_recorded_before_it_was_said_to_fail_is_compared(tmp_path):
    synthetic = SyntheticSession(configuration())
    synthetic.begin()
    synthetic.sweep((1,))
    points = synthetic.analysis.points
    last = max(p.step for p in points)
    fit = no_fit(1, last, points, None, None)
    synthetic.events += [FitStarted(1, last), fit, FitFailed(1, "no memory left")]
    again, _, fitted = replayed(synthetic.save(tmp_path))
    assert again.differences == []
    assert fitted == [(1, last)]
