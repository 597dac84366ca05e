"""What is said of a fit of modes: that it leaves them, or which one does not go with the others."""

from dataclasses import replace
from types import SimpleNamespace

import numpy as np

from fitting.identification.doubt import Doubt
from fitting.mode_tables.misread import Misread
from fitting.mode_tables.table import ModalTable
from instrument.remarks.modal_remarks import remark_on_all, remark_on_fit, remark_on_misread, remark_on_unlike


def test_a_fit_that_leaves_the_modes_says_so():
    assumed = ModalTable(np.array([1, 2]), np.array([100.0, 200.0]), np.array([0.2, 0.2]))
    stated = replace(assumed, frequency_std_hz=np.full(2, 0.1), loss_factor_std=np.full(2, 0.01))
    tables = [stated]

    def fit(second_hz, loss, chi2):
        return SimpleNamespace(
            predicted_hz=(np.array([100.0, second_hz]),),
            predicted_loss=(np.array([0.2, loss]),),
            uncertainty=SimpleNamespace(chi2_per_dof=chi2),
        )

    assert remark_on_fit(fit(210.0, 0.2, 2.0), tables) == ()
    (said,) = remark_on_fit(fit(240.0, 0.2, 90.0), tables)
    assert said.startswith("the fit does not follow the modes (rms 14.1 % in frequency)")
    (said,) = remark_on_fit(fit(202.0, 0.1, 5.6), tables)
    assert said.startswith("chi-square per degree of freedom is 5.6 where the modes' errors leave 1")
    assert "1 % in frequency and 50 % in loss factor" in said
    assert "no damping ratios" in said
    (said,) = remark_on_fit(fit(202.0, 0.1, 5.6), [assumed])
    assert said.startswith("chi-square per degree of freedom is 5.6 where the assumed errors leave 1")


def test_the_row_that_does_not_go_with_the_others_is_named_with_its_file_and_where_they_have_it():
    def table(*f):
        return SimpleNamespace(
            mode=np.arange(2.0, 2 + len(f)), frequency_hz=np.array(f), loss_factor=0.1 * np.array(f)
        )

    odd = SimpleNamespace(place=3, frequency_hz=4.25, loss_factor=0.5)
    said = remark_on_misread(odd, [table(1.0, 2.0, 3.0), table(4.0, 5.0)])
    assert said.startswith("mode 2 of file 2 does not go with the others")
    assert "at 4.25 Hz with a loss factor of 0.5, the table at 4 Hz with 0.4" in said
    assert remark_on_misread(odd, [table(1.0, 2.0, 3.0, 4.0)]).startswith("mode 5 does not go")
    # A beam's motion along itself is among the model's modes, and seldom in a table.
    along = SimpleNamespace(place=3, frequency_hz=4.25, loss_factor=1e-12)
    said = remark_on_misread(along, [table(1.0, 2.0, 3.0, 4.0)])
    assert "at 4.25 Hz where layers stretch along the beam, nothing bends" in said
    assert "numbered past that one: is this mode 6?" in said


def test_the_row_that_a_law_bends_for_is_a_doubt_with_whichever_other_may_be_it():
    f = np.array([65.0, 330.0, 850.0])
    tables = [ModalTable(np.array([1, 2, 3]), f, np.array([0.15, 0.19, 0.16]))]
    other = Misread(1, 337.0, 0.18, SimpleNamespace(chi2=9.0), 46.0, plain=False)
    odd = Misread(0, 67.8, 0.168, SimpleNamespace(chi2=5.0), 46.0, plain=False, rivals=(other,))
    said = remark_on_unlike(odd, tables)
    assert isinstance(said, Doubt)
    assert said.startswith("mode 1 does not go with the others (chi-square 46 with it, 5 without;")
    assert "at 67.8 Hz with a loss factor of 0.168, the table at 65 Hz with 0.15" in said
    assert "or mode 2 in its place: they have that at 337 Hz with 0.18, the table at 330 Hz with 0.19" in said


def test_bends_and_moves_that_chance_does_not_have_together_are_a_doubt():
    assumed = ModalTable(np.array([1, 2]), np.array([100.0, 200.0]), np.array([0.2, 0.2]))
    stated = replace(assumed, frequency_std_hz=np.full(2, 0.1), loss_factor_std=np.full(2, 0.01))

    def fit(chi2):
        return SimpleNamespace(data=12, parameter_count=4, chi2=chi2)

    assert remark_on_all(fit(20.0), [stated]) == ()
    (said,) = remark_on_all(fit(46.0), [stated])
    assert "chi-square 46 where 8 is expected" in said
    assert isinstance(said, Doubt)
    assert remark_on_all(fit(46.0), [assumed]) == ()
