"""Modes of a specimen are computed once."""

import pytest

from fitting.dynamics import complex_modes as modes_of_a_plate
from fitting.dynamics.complex_modes import complex_modes
from fitting.plate.plate import Plate
from instrument.models.specimen_modes import edge_twist_remark, specimen_modes


def test_they_are_the_plate_s_own_to_the_bit_and_kept(coarse, monkeypatch):
    direct = complex_modes(Plate(coarse), coarse.core.law, 4)
    assert [m.eigenvalue for m in specimen_modes(coarse, 4)] == [m.eigenvalue for m in direct]
    monkeypatch.setattr(modes_of_a_plate, "_span", lambda *_: pytest.fail("computed again"))
    kept = specimen_modes(coarse, 4)
    assert [(m.frequency_hz, m.loss_factor) for m in kept] == [
        (m.frequency_hz, m.loss_factor) for m in direct
    ]


def test_those_of_another_law_are_others(coarse, zn1_table4):
    stiff, soft = coarse, coarse.with_law(zn1_table4.core.law)
    assert specimen_modes(stiff, 2)[0] != specimen_modes(soft, 2)[0] or stiff == soft


def test_what_a_bare_plates_modes_leave_out_at_its_edges_is_said(coarse):
    assert "free edges carry no twist" in edge_twist_remark(coarse.bare, 4)
    assert edge_twist_remark(coarse, 4) == ""
