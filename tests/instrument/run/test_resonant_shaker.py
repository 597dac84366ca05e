"""A shaker with a resonance beside an anti-resonance, crossed in coarse steps: what a fixture often has."""

from itertools import pairwise

import formula_rig
import numpy as np
import pytest
from formula_rig import FormulaPlate
from quick_run import no_fit

from instrument.errors import RigStopped
from instrument.run.experiment import run_experiment
from instrument.run.replay import replay
from instrument.session.storage import SessionFile
from instrument.stream.derived import PointMeasured
from instrument.stream.raw import ShakerCommanded

COARSE = """
[[sweep.segments]]
frequencies_hz = [140.0, 150.0, 160.0, 170.0]
"""


def fixture_gain(frequency_hz):
    """m/s^2 per V: 3 at the anti-resonance about 146 Hz, 25 at the resonance."""
    s, w = 2j * np.pi * frequency_hz, 2 * np.pi * 162.0
    return abs(7.0 + 1.4 * s**2 / (s**2 + 2 * 0.03 * w * s + w**2))


@pytest.fixture
def shaken(monkeypatch):
    """What the base was driven to at once, whenever a frequency changed, in m/s^2."""
    peaks = []

    def gain(output, frequency_hz):
        base = fixture_gain(frequency_hz)
        return base if output == "base_acceleration" else base / (2j * np.pi * frequency_hz)

    class Watched(FormulaPlate):
        def drive(self, piece):
            if piece.frequency_hz != self._pieces[-1].frequency_hz:
                peaks.append(piece.amplitude_at(piece.begin_s) * fixture_gain(piece.frequency_hz))
            super().drive(piece)

    monkeypatch.setattr(formula_rig, "gain", gain)
    monkeypatch.setattr(formula_rig, "FormulaPlate", Watched)
    return peaks


def measured(folder):
    with formula_rig.formula_rig(folder, sweep=COARSE) as (_, experiment):
        return run_experiment(experiment, folder, ("sweep",), fit=no_fit)


def test_a_resonance_is_not_entered_with_the_drive_of_an_anti_resonance(tmp_path, shaken):
    """3.3 V at 150 Hz would be 65 m/s^2 at 160 Hz, for as long as the ramp down takes."""
    finished = measured(tmp_path)
    assert [p.frequency_hz for p in finished.points] == [140.0, 150.0, 160.0, 170.0]
    assert all(abs(p.control_error_percent) < 1.0 for p in finished.points)
    assert max(shaken) < 1.2 * 9.81


def test_what_was_driven_on_the_way_to_a_step_is_recorded_and_replayed(tmp_path, shaken):
    session = measured(tmp_path).session
    with SessionFile(session) as file:
        assert replay(file, fit=no_fit).differences == []
        events = list(file.events(with_samples=False))
    commands = [e for e in events if isinstance(e, ShakerCommanded)]
    hops = [(a, b) for a, b in pairwise(commands) if a.frequency_hz != b.frequency_hz]
    assert len(hops) == 3
    assert all(a.drive_v <= 1.1 * b.drive_v for a, b in hops)
    # A step is still told from what came before it: one point each.
    assert sum(isinstance(e, PointMeasured) for e in events) == 4


def test_a_level_truly_exceeded_still_stops_the_run_and_says_at_what_frequency(tmp_path, monkeypatch):
    """A base that answers thrice as strongly to more than a loop check's drive: no gain foretells it."""
    at = FormulaPlate.at

    def louder(self, *asked):
        last = self._pieces[-1]
        return at(self, *asked) * (3.0 if last.amplitude_v > 0.2 or last.slope_v_s else 1.0)

    monkeypatch.setattr(FormulaPlate, "at", louder)
    with (
        formula_rig.formula_rig(tmp_path, sweep=COARSE) as (rig, experiment),
        pytest.raises(RigStopped, match=r"^at 140 Hz: base acceleration over its level"),
    ):
        run_experiment(experiment, tmp_path, ("sweep",), fit=no_fit)
    assert rig.device.log[-1].what == "silent"
