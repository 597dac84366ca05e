"""Two files that have each other's specimens are said to, and nothing is named in their place."""

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
from shear_pair_cases import pair, sweep

from fitting.errors import OutsideModel
from instrument.finding import exchanged as exchange
from instrument.finding.diagnosis import diagnose
from instrument.finding.exchanged import exchanged, leaves_much
from instrument.finding.identification import identify
from instrument.models.files import File

MASSES_KG = (0.2533, 0.573, 1.196)


def files(order=(0, 1, 2)):
    """Data of ascending masses; `order` says whose specimen each has."""
    stated = [pair(m) for m in MASSES_KG]
    return [
        File(sweep(stated[k], seed=k, points=40), stated[other], f"{MASSES_KG[k]} kg")
        for k, other in enumerate(order)
    ]


def test_files_with_their_own_specimens_are_left_alone():
    assert exchanged(files()) is None


def test_one_file_is_nobody_s():
    assert exchanged(files()[:1]) is None


def test_two_that_are_exchanged_are_found():
    found = exchanged(files((0, 2, 1)))
    assert found is not None
    assert found.names == ("0.573 kg", "1.196 kg")
    assert found.exchanged < 0.01 < 0.1 < found.as_given


def test_a_mass_that_is_stated_wrongly_is_no_exchange():
    given = files()
    wrong = replace(given[2].specimen, mass_kg=1.1 * MASSES_KG[2])
    assert exchanged([*given[:2], replace(given[2], specimen=wrong)]) is None


def test_identify_says_so_first():
    said = identify(files((0, 2, 1))).result.warnings[0]
    assert said.startswith("0.573 kg and 1.196 kg seem to have each other's specimens")


def test_a_fit_that_leaves_as_much_as_its_readings_is_asked_whatever_its_noise():
    begun = SimpleNamespace(
        problem=SimpleNamespace(sweep=SimpleNamespace(response_m_s=np.array([1.0, 2.0j]), has_phase=True)),
        none=SimpleNamespace(velocity_m_s=np.array([1.02, 2.02j])),
    )
    assert not leaves_much(begun)
    begun.none.velocity_m_s = np.array([0.5, 2.0j])
    assert leaves_much(begun)


def test_diagnose_names_no_temperature_in_its_place():
    with pytest.raises(OutsideModel, match=r"each other's specimens.*exchange them"):
        diagnose(files((0, 2, 1)))


def test_of_many_lines_some_are_looked_at(monkeypatch):
    stated = [pair(m) for m in MASSES_KG[:2]]
    many = [File(sweep(s, points=3000), other, "") for s, other in zip(stated, stated[::-1], strict=True)]
    looked = []
    begun = exchange.begin

    def counted(problem, *given, **how):
        looked.append(len(problem.sweep))
        return begun(problem, *given, **how)

    monkeypatch.setattr(exchange, "begin", counted)
    assert exchanged(many) is not None
    assert max(looked) <= 200
