"""Tables of modes that are meant otherwise than they are read."""

from dataclasses import replace
from types import SimpleNamespace

import beam_tables
import numpy as np
import pytest

from fitting.laws.fractional_zener import FractionalZener
from fitting.mode_tables.table import ModalTable
from fitting.structures.small_modes import small_modes
from instrument.mistakes.modal_mistakes import table_doubt

LAW = FractionalZener(g0_pa=0.6e6, ginf_pa=25e6, tau_s=5e-5, alpha=0.55)
BEAM = replace(beam_tables.BEAM, core=replace(beam_tables.BEAM.core, law=LAW))
COUNT = 6


def read(seed):
    """Modes of a core that relaxes, with noise that the table states."""
    modes, rng = small_modes(BEAM, LAW, COUNT), np.random.default_rng(seed)
    f, eta = (np.array([getattr(m, name) for m in modes]) for name in ("frequency_hz", "loss_factor"))
    noisy = f * (1 + 1e-3 * rng.standard_normal(COUNT)), eta * (1 + 0.01 * rng.standard_normal(COUNT))
    return ModalTable(np.arange(1.0, COUNT + 1), *noisy, 1e-3 * f, 0.01 * eta)


RIGHT = read(3)


def doubt(table):
    return table_doubt([table], [BEAM], beam_tables.fit_modes([table], [BEAM]).uncertainty.chi2_per_dof)


def with_losses(factor):
    return replace(
        RIGHT, loss_factor=factor * RIGHT.loss_factor, loss_factor_std=factor * RIGHT.loss_factor_std
    )


@pytest.mark.parametrize(
    ("factor", "said"),
    [(0.5, "holds damping ratios"), (2.0, "twice what it should be"), (np.pi, "logarithmic decrements")],
)
def test_losses_of_another_kind_are_asked_about(factor, said):
    assert said in doubt(with_losses(factor))


@pytest.mark.parametrize("seed", range(3))
def test_a_right_table_is_not_asked_about(seed):
    assert doubt(read(seed)) == ""


def test_a_mode_that_is_missing_is_asked_about():
    rest = RIGHT.mode != 3
    columns = {name: v[rest] for name, v in vars(RIGHT).items() if isinstance(v, np.ndarray)}
    fewer = replace(RIGHT, **{**columns, "mode": np.arange(1.0, 6.0)})
    assert "a mode is missing before mode 3" in doubt(fewer)


@pytest.mark.parametrize(("place", "asked"), [(5, "a mode is missing before mode 5"), (1, "")])
def test_beside_an_odd_mode_only_its_own_number_is_asked_about(place, asked):
    """Of six modes the fifth is left out, and the last one taken for it."""
    rest = RIGHT.mode != 5
    columns = {name: v[rest] for name, v in vars(RIGHT).items() if isinstance(v, np.ndarray)}
    last = replace(RIGHT, **{**columns, "mode": np.arange(1.0, 6.0)})
    left = beam_tables.fit_modes([last], [BEAM]).uncertainty.chi2_per_dof
    said = table_doubt(
        [RIGHT, last], [BEAM, BEAM], left, odd=SimpleNamespace(place=COUNT + place - 1, plain=True)
    )
    assert asked in said
    assert bool(said) == bool(asked)


def test_nothing_is_fitted_anew_where_little_is_left():
    assert table_doubt([RIGHT], [None], 0.9) == ""
