"""One table as a fit sees it: readings in ln f and ln eta of equal worth, and the modes it asks for."""

from dataclasses import replace

import numpy as np
import pytest
from beam_tables import BEAM, LAW, read
from hypothesis import given
from hypothesis import strategies as st

from fitting.errors import OutsideModel
from fitting.laws.constant import ConstantModulus
from fitting.laws.fractional_zener import FractionalZener
from fitting.mode_tables.as_read import READS
from fitting.mode_tables.build import member_of
from fitting.mode_tables.member import Member
from fitting.mode_tables.standing import standing
from fitting.structures.small_modes import small_modes

TABLE = read(BEAM, 3)
MEMBER = member_of(TABLE, BEAM)
STATED = np.zeros(len(MEMBER.stated))
ZENER = FractionalZener(5e5, 2e7, 1e-4, 0.6)
"""So that a mode's own frequency moves the law too."""
STIFFER = next(e for e in standing([BEAM]) if e.name == "substrate_stiffness")


@given(own=st.floats(0.0, 0.05), of_loss=st.floats(0.0, 0.2))
def test_both_parts_of_a_reading_are_known_equally_well(own, of_loss):
    member: Member = replace(MEMBER, own_error=(np.array([own]), np.array([of_loss])))
    f, eta = member.std
    np.testing.assert_allclose(f, np.hypot(1e-3, own), rtol=1e-2)
    np.testing.assert_allclose(member.kappa * eta, f)
    np.testing.assert_allclose(np.exp(member.measured.real), TABLE.frequency_hz)
    np.testing.assert_allclose(np.exp(member.measured.imag / member.kappa), TABLE.loss_factor)


def test_modes_are_those_of_the_beam_that_the_table_names():
    some = replace(TABLE, **{k: getattr(TABLE, k)[[0, 2]] for k in TABLES})
    member, every = member_of(some, BEAM), small_modes(BEAM, LAW, 3)
    found = member.logs(LAW, STATED)
    np.testing.assert_allclose(np.exp(found.real), [every[k].frequency_hz for k in (0, 2)], rtol=1e-6)
    np.testing.assert_allclose(
        np.exp(found.imag / member.kappa), [every[k].loss_factor for k in (0, 2)], rtol=1e-6
    )
    np.testing.assert_allclose(np.exp(MEMBER.logs(LAW, STATED).real), [m.frequency_hz for m in every])


TABLES = ("mode", "frequency_hz", "loss_factor", "frequency_std_hz", "loss_factor_std")


def test_a_mode_that_the_model_lacks_is_refused():
    many = replace(TABLE, mode=np.array([1.0, 2.0, 4000.0]))
    with pytest.raises(OutsideModel, match="mode 4000, expected one of the"):
        member_of(many, BEAM).logs(LAW, STATED)


def test_a_mode_without_losses_has_a_logarithm_too():
    lossless = ConstantModulus(2e6, 0.0)
    assert np.isfinite(replace(MEMBER, own_error=(0.0, 0.0)).logs(lossless, STATED)).all()


@pytest.mark.parametrize("read", READS)
def test_derivatives_of_what_is_read_are_central_differences(read):
    member, h = replace(MEMBER, table=replace(TABLE, read=read)), 1e-4
    value, by = member.with_derivatives(ZENER, STATED, (), ())
    np.testing.assert_allclose(value, member.logs(ZENER, STATED))
    for k, step in enumerate(h * np.eye(len(ZENER.names))):
        up, down = (member.logs(ZENER.with_logs(np.log(ZENER.values) + s * step), STATED) for s in (1, -1))
        expected = (up - down) / (2 * h)
        # How steep the core is is taken as it stands: a share of what the losses do.
        within = 2e-4 if read == "model" else 0.1
        np.testing.assert_allclose(by[k], expected, atol=within * np.abs(expected).max())


@pytest.mark.parametrize("g_pa", [1e6, 3e8])
def test_derivatives_to_stated_numbers_are_central_differences_of_a_soft_core_and_of_a_glassy_one(g_pa):
    law, h = ConstantModulus(g_pa, 0.02), 1e-3
    z = np.resize([2.0, -3.0, 1.0], len(STATED))
    _, by = MEMBER.with_derivatives(law, z, (), ())
    for row, step in zip(by[len(law.names) :], h * np.eye(len(STATED)), strict=True):
        expected = (MEMBER.logs(law, z + step) - MEMBER.logs(law, z - step)) / (2 * h)
        np.testing.assert_allclose(row, expected, atol=1e-6 + 2e-3 * np.abs(expected).max())


def test_a_steep_core_is_read_lossier_than_it_is():
    f, eta = MEMBER.reads_otherwise(ZENER, STATED, "half-power")
    assert np.all(eta > 0)
    by_pole_f, by_pole = MEMBER.reads_otherwise(ZENER, STATED, "poles")
    np.testing.assert_allclose(by_pole, eta, atol=0.02)
    assert np.abs(f).max() < 0.02 > np.abs(by_pole_f).max()
    own = MEMBER.reads_otherwise(ZENER, STATED, "model")
    np.testing.assert_allclose(own, 0.0, atol=1e-12)


def test_what_an_effect_does_to_modes_is_that_of_central_differences():
    law, u, h = ZENER, np.array([1.1]), 1e-3

    def logs(u):
        return MEMBER.logs(law, STATED, [(STIFFER, u)])

    value, by = MEMBER.with_derivatives(law, STATED, [(STIFFER, u)], [np.array([1e-4])])
    np.testing.assert_allclose(value, logs(u))
    np.testing.assert_allclose(by[-1], (logs(u + h) - logs(u - h)) / (2 * h), rtol=1e-3, atol=1e-6)
    assert (logs(u).real > logs(np.ones(1)).real).all()
