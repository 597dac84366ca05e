"""What is akin to an explanation of tables of modes."""

from dataclasses import replace

import numpy as np
from beam_tables import BEAM, FACE, begun, read

from fitting.diagnosis.thresholds import KIN
from fitting.mode_tables.kin import kin_of_modes
from fitting.mode_tables.standing import standing

STIFFER = next(e for e in standing([BEAM]) if e.name == "substrate_stiffness")
TABLE = read(replace(BEAM, substrate=replace(FACE, young_pa=1.35 * 70e9)))


def with_stiffer_face(table):
    work = begun(table)
    (fitted,) = work.fits(STIFFER, work.begun.none)
    return work.begun, fitted


def test_of_what_is_there_kin_has_no_more_than_its_chance():
    found = kin_of_modes(*with_stiffer_face(TABLE), 1.0)
    assert 0 < found.odds < KIN.chance


def beside(off):
    """A table whose modes lie by a share elsewhere, up and down in turn, and kin of a stiffer face there."""
    elsewhere = replace(TABLE, frequency_hz=TABLE.frequency_hz * (1 - off * (-1) ** TABLE.mode))
    return kin_of_modes(*with_stiffer_face(elsewhere), 1.0)


def test_modes_that_lie_elsewhere_speak_for_kin():
    assert beside(0.01).odds > 1e6 > beside(0.002).odds > 0.1


def test_kin_puts_every_mode_where_it_lies():
    places = beside(0.01).along[: len(TABLE.mode)]
    np.testing.assert_array_equal(np.sign(places), -((-1) ** TABLE.mode))


def test_it_is_not_asked_where_the_tables_errors_are_not_known():
    begun_so, fitted = with_stiffer_face(TABLE)
    unknown = replace(begun_so, evidence=replace(begun_so.evidence, scale_known=False))
    assert kin_of_modes(unknown, fitted, 1.0) is None
