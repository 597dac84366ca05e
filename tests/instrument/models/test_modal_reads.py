"""Tables of modes that do not say how they were read, and those that do."""

from dataclasses import replace

import numpy as np
import pytest
from beam_tables import BEAM, poles_of

from fitting.laws import LAWS
from fitting.mode_tables.build import member_of, with_own_error
from fitting.mode_tables.fit import fit_modes
from fitting.mode_tables.table import ModalTable
from instrument.errors import BadInput
from instrument.files.modal_table import read_modal_table
from instrument.models.modal_reads import remark_on_reading

LAW = LAWS["fractional-zener"](1e6, 300e6, 3e-7, 0.5)
TRUE = replace(BEAM, core=replace(BEAM.core, law=LAW))
GUESS = replace(BEAM.core, law=LAWS["fractional-zener"](3e6, 300e6, 1e-6, 0.5))
STATED = replace(BEAM, core=GUESS, exact=False, tolerances=dict.fromkeys(BEAM.numbers, 1e-5))
"""All but exactly; exact specimens are simulations, whose modes are the model's own."""
COUNT = 7


@pytest.fixture(scope="module")
def read():
    f, eta = poles_of(TRUE, COUNT)
    return ModalTable(np.arange(1.0, COUNT + 1), f, eta, 1e-3 * f, 0.03 * eta)


def pulls(table):
    fit, at = fit_modes([table], [STATED]), table.frequency_hz
    omega = 2 * np.pi * np.geomspace(at[0], at[-1], 5)
    true, (G, eta) = LAW.modulus(omega), fit.law.storage_and_loss(omega)
    dG, deta = fit.uncertainty.law_band(fit.law, omega)
    return np.abs([(G - true.real) / dG, (eta - true.imag / true.real) / deta]).max()


def test_poles_are_no_modes_of_the_model_and_give_its_law_where_the_table_says_so(read):
    assert pulls(replace(read, read="poles")) < 0.3
    assert pulls(replace(read, read="model")) > 5
    # Nobody says: it is left open.
    assert pulls(read) < 1.5


def test_what_is_not_said_is_told_with_its_size(read):
    (said,) = remark_on_reading([member_of(read, STATED)], LAW)
    assert "+0.2" in said
    assert "% in frequency and +2.9 to +7.3 % in loss factor" in said
    assert "left open in the fit" in said
    (of_exact,) = remark_on_reading([member_of(read, BEAM)], LAW)
    assert "left open" not in of_exact
    for how in ("poles", "half-power", "model"):
        assert remark_on_reading([member_of(replace(read, read=how), STATED)], LAW) == ()
    few_losses = LAWS["constant"](3e6, 0.01)
    assert remark_on_reading([member_of(read, STATED)], few_losses) == ()


def test_an_exact_specimen_s_table_is_the_model_s(read):
    assert not with_own_error(member_of(read, TRUE), LAW).otherwise.any()
    assert with_own_error(member_of(read, STATED), LAW).otherwise.all()


def text(line):
    return f"{line}\nmode,frequency_hz,loss_factor\n1,20.0,0.1\n2,120.0,0.2\n3,300.0,0.2\n"


@pytest.mark.parametrize(
    ("line", "read"),
    [
        ("# read: poles", "poles"),
        ("#Read: Half-Power ", "half-power"),
        ("# read: model", "model"),
        ("# x", None),
    ],
)
def test_a_table_says_how_it_was_read(tmp_path, line, read):
    (tmp_path / "modes.csv").write_text(text(line))
    assert read_modal_table(tmp_path / "modes.csv").read == read


@pytest.mark.parametrize("line", ["# read: by eye", "# read: poles\n# read: half-power", "# read:"])
def test_another_word_for_it_is_refused(tmp_path, line):
    (tmp_path / "modes.csv").write_text(text(line))
    with pytest.raises(BadInput, match="expected one of model, poles, half-power"):
        read_modal_table(tmp_path / "modes.csv")
