"""What a sweep is said not to see, beside fits of sweeps that have it."""

from dataclasses import replace

import numpy as np
import pytest
from data_folder import DATA
from rig_plate import plate_of_the_rig

from fitting.data.noise import noise_of
from fitting.diagnosis.inference.begin import begin
from fitting.diagnosis.response.sweep_response import SweepResponse
from fitting.diagnosis.verdict.result import Rivals
from fitting.effects import CATALOGUE
from fitting.planning.confusion import SEEN
from fitting.planning.unseen import unseen
from instrument.files.sweep_file import read_sweep
from instrument.models.set_up import set_up

ASKED = [
    CATALOGUE[name]
    for name in (
        "temperature_drift",
        "core_thickness",
        "viscous_damping",
        "channel_delay",
        "absolute_velocity",
    )
]


@pytest.fixture(scope="module")
def once():
    return read_sweep(DATA / "practice-005.csv").sweep(9.81).take(slice(None, None, 3))


def twice(sweep):
    """Every segment once more, an hour later."""
    both = {
        key: np.tile(getattr(sweep, key), 2)
        for key in ("frequency_hz", "velocity_m_s", "commanded_m_s2", "base_m_s2", "segment")
    }
    later = np.concatenate([sweep.time_s, sweep.time_s + 3600.0])
    again = np.concatenate([sweep.sweep, sweep.sweep + 1])
    return replace(sweep, **both, sweep=again, time_s=later, weight=None, std_m_s=None)


class Clean:
    """A sweep without any effect, its noise left out, and its fit."""

    def __init__(self, sweep):
        specimen = replace(plate_of_the_rig(), exact=False)
        self.ready = set_up(sweep, specimen)
        self.law, self.stated = specimen.core.law.lifted(), self.ready.problem.as_stated
        self.begun = self.fitted(SweepResponse(self.ready.problem, ()).velocity(self.law, self.stated))

    def fitted(self, v):
        problem = self.ready.problem
        measured = replace(problem.sweep, velocity_m_s=v, base_m_s2=None, std_m_s=3e-3 * np.abs(v))
        return begin(replace(problem, sweep=measured), self.ready.reduced, noise_of(measured), None, self.law)

    def unseen(self, effects=ASKED):
        b = self.begun
        return {u.name: u for u in unseen(Rivals(b.problem, b.evidence, ((b.none, 1.0),)), effects)}


@pytest.fixture(scope="module")
def clean(once):
    return Clean(once)


@pytest.mark.parametrize("name", ["core_thickness", "viscous_damping"])
def test_what_is_said_of_a_size_is_what_a_fit_without_the_effect_gets_wrong(clean, name, monkeypatch):
    """A law that is fitted without the effect is off by as much as was said, and nothing shows."""
    monkeypatch.setattr("fitting.planning.unseen._MATTERS", 0.5)
    said = clean.unseen()[name]
    response = SweepResponse(clean.begun.problem, [CATALOGUE[name]])
    begun = clean.fitted(response.velocity(clean.law, np.append(clean.stated, said.size)))
    f = clean.ready.problem.sweep.frequency_hz
    G, eta = begun.none.law.storage_and_loss(2 * np.pi * f)
    true_G, true_eta = clean.law.storage_and_loss(2 * np.pi * f)
    assert np.abs(G / true_G - 1).max() == pytest.approx(said.storage_modulus, rel=0.3)
    assert np.abs(eta / true_eta - 1).max() == pytest.approx(said.loss_factor, rel=0.3)
    assert begun.none.chi2 < SEEN**2


def test_a_drift_hides_in_one_pass_and_shows_in_two(once, clean):
    assert "temperature_drift" in clean.unseen()
    assert "temperature_drift" not in Clean(twice(once)).unseen()


def test_what_shows_or_does_not_matter_is_not_said(clean):
    said = clean.unseen()
    assert not said.keys() & {"absolute_velocity", "channel_delay"}
    assert all(u.errors >= 2.0 for u in said.values())
    assert [u.errors for u in said.values()] == sorted((u.errors for u in said.values()), reverse=True)


def test_what_was_found_is_not_said_of_itself(clean):
    b = clean.begun
    found = replace(b.none, effects=(CATALOGUE["viscous_damping"],), u=np.append(b.none.u, 1.0))
    rivals = Rivals(b.problem, b.evidence, ((found, 1.0),))
    assert not [u for u in unseen(rivals, [CATALOGUE["viscous_damping"]]) if u.name == "viscous_damping"]
