"""What the room computes is of the types it names: differences of a response are good to 1e-9 in no other."""

from typing import get_args, get_type_hints

import numpy as np
from beam_tables import BEAM, LAW, read
from shear_pair_cases import pair, sweep

from fitting.arrays import Array, Complex, Mask
from fitting.identification.result import LawBand, law_band
from fitting.identification.uncertainty import Uncertainty
from fitting.mode_tables.table import ModalTable

SWEEP = sweep(pair(0.2533), points=5)


def number(kind):
    """What an array of this type holds."""
    return np.dtype(get_args(get_args(kind)[1])[0])


def test_every_array_of_a_band_and_of_a_table_holds_what_it_says():
    band = law_band(SWEEP, LAW, Uncertainty(np.eye(2), {}, 1.0))
    for made, of in ((band, LawBand), (read(BEAM, 2), ModalTable)):
        said = [name for name, kind in get_type_hints(of).items() if kind in (Array, Array | None)]
        held = [getattr(made, name) for name in said]
        assert {a.dtype for a in held if a is not None} == {number(Array)} == {np.dtype(np.float64)}


def test_moduli_and_velocities_hold_complex_numbers_and_which_points_count_booleans():
    assert LAW.modulus(SWEEP.omega).dtype == SWEEP.velocity_m_s.dtype == number(Complex) == np.complex128
    assert (SWEEP.segment == 1).dtype == number(Mask) == np.bool_
