"""What is said of how a specimen is held."""

from dataclasses import replace

import pytest

from fitting.laws.constant import ConstantModulus
from fitting.specimen import PlateSpecimen
from fitting.stated.layers import Core, Face
from fitting.structures import Beam
from instrument.remarks.clamp_remarks import remarks_on_clamps

STEEL = Face(2e-3, 210e9, 0.3, 7850.0)
PERCENT = 100 * 0.0246 / 2 * 12 * 1e6 * 0.25**2 / (210e9 * 2e-3**2)
"""A bar with N L^2/(E I) = 12 sigma L^2/(E h^2): Blevins has (1 + 0.0246 times that)^(1/2)."""


def higher_percent(said):
    return float(said.split("up to ")[1].split(" %")[0])


def test_what_two_clamps_pull_is_said_of_a_beam_between_them():
    beam = Beam(0.25, 0.02, "clamped-clamped", STEEL)
    (said,) = [one for one in remarks_on_clamps(beam) if "pull" in one]
    assert higher_percent(said) == pytest.approx(PERCENT, rel=0.05)
    assert "allowed for is 2 MPa (axial_mpa)" in said
    assert "allowed for is 0.5 MPa" in remarks_on_clamps(replace(beam, tolerances={"axial": 0.5e6}))[1]
    assert "allowed for is nothing, it is exact" in remarks_on_clamps(replace(beam, exact=True))[1]
    assert not any("pull" in one for one in remarks_on_clamps(replace(beam, boundary="clamped-free")))


def test_a_constraining_layer_that_two_clamps_may_not_grip_is_asked_to_be_looked_at():
    core = Core(0.5e-3, 0.49, 1000.0, ConstantModulus(1e6, 0.5))
    beam = Beam(0.25, 0.02, "clamped-clamped", STEEL, STEEL, core)
    (said,) = [one for one in remarks_on_clamps(beam) if "grip" in one]
    assert "where it ends short of both nothing shows" in said
    others = (
        replace(beam, exact=True),
        replace(beam, constraining=None),
        replace(beam, boundary="clamped-free"),
        replace(beam, boundary="free-free"),
    )
    assert not any("grip the constr" in one for other in others for one in remarks_on_clamps(other))


def test_of_a_free_layer_it_is_said_what_becomes_of_one_that_ends_at_its_clamp():
    core = Core(3e-3, 0.42, 1300.0, ConstantModulus(2e8, 0.5))
    beam = Beam(0.2, 0.012, "clamped-free", STEEL, core=core)
    (said,) = [one for one in remarks_on_clamps(beam) if "grip" in one]
    assert "some 10 % too low" in said
    others = (
        replace(beam, exact=True),
        replace(beam, constraining=STEEL),
        replace(beam, boundary="free-free"),
        replace(beam, core=replace(core, thickness_m=1e-4)),
        replace(beam, core=None),
    )
    assert not any("grip the free" in one for other in others for one in remarks_on_clamps(other))


def test_of_a_plate_with_clamps_on_opposite_edges_too():
    plate = PlateSpecimen(0.4, 0.25, "free-clamped-free-clamped", STEEL)
    (said,) = remarks_on_clamps(plate)
    assert higher_percent(said) == pytest.approx(PERCENT, rel=0.05)
    assert "allowed for is 2 MPa (axial_mpa)" in said
    for boundary in ("cantilever", "free", "clamped-clamped-free-free"):
        assert remarks_on_clamps(PlateSpecimen(0.4, 0.25, boundary, STEEL)) == ()
