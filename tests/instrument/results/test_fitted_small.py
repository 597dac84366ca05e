"""The curve of a fit to a shear pair: the same as of a pair whose numbers are stated as found."""

from dataclasses import replace

import numpy as np
import pytest

from fitting.laws.constant import ConstantModulus
from fitting.laws.fractional_zener import FractionalZener
from fitting.specimen import PlacedMass
from fitting.stated.layers import Core, Face
from fitting.structures.beam import Beam
from fitting.structures.shear_pair import ShearPair, disc
from fitting.structures.small_modes import small_velocity
from instrument.errors import BadInput
from instrument.results.fit_file import FoundLaw
from instrument.results.fitted_response import fitted_response
from instrument.results.fitted_small import FittedSmall

LAW = FractionalZener(4e6, 30e6, 1e-4, 0.6)
PAIR = ShearPair(0.5, 2, disc(30e-3, 10e-3)[0], Core(6e-3, 0.4999, 1100.0, LAW))
F = np.array([60.0, 200.0, 350.0])
FACE = Face(2e-3, 70e9, 0.3, 2700.0, 0.0)
BEAM = Beam(
    *(0.3, 0.02, "clamped-free", FACE, FACE, Core(0.5e-3, 0.49, 1000.0, LAW)),
    pickup_m=0.29,
    masses=(PlacedMass(1e-3, 0.2, 0.0),),
)


def found(**moved):
    """A fit's JSON, with numbers given as stated, tolerance and found."""
    rows = [{"name": n, "stated": s, "tolerance": sigma, "found": f} for n, (s, sigma, f) in moved.items()]
    names = [*LAW.names, *moved]
    sizes = [0.01] * len(LAW.names) + [0.5] * len(moved)
    lower = [[0.0] * k + [sizes[k] ** 2] for k in range(len(names))]
    return FoundLaw.model_validate(
        {
            "law_kind": LAW.kind,
            "parameters": dict(zip(LAW.names, LAW.values.tolist(), strict=True)),
            "standard_errors": dict.fromkeys(LAW.names, 1e4),
            "correlations": {},
            "adjusted": rows,
            "posterior": {"names": names, "rows": lower},
        }
    )


def test_a_law_of_another_kind_than_the_specimens_is_refused():
    with pytest.raises(
        BadInput, match="the law found is fractional-zener, expected the specimen's own, constant"
    ):
        found().law(ConstantModulus(1e6, 0.3))


def test_moved_numbers_are_another_pair_read_by_another_channel():
    fit = found(mass=(0.5, 0.001, 0.51), core_thickness=(6.0, 0.18, 6.2), gain=(1.0, 0.003, 1.002))
    moved = replace(PAIR, mass_kg=0.51, core=replace(PAIR.core, thickness_m=6.2e-3))
    expected = 1.002 * small_velocity(moved, F)
    np.testing.assert_allclose(FittedSmall.of(PAIR, fit).velocity(F), expected, rtol=1e-9)


def test_of_several_files_a_beam_is_the_first_one_s():
    own = {
        "length [1]": (300.0, 0.3, 300.5),
        "place_1_x [1]": (200.0, 0.5, 201.0),
        "mass [1]": (1.0, 0.02, 1.1),
    }
    other = {
        "length [2]": (300.0, 0.3, 290.0),
        "place_2_x [2]": (100.0, 0.5, 110.0),
        "gain [2]": (1, 0.003, 2),
    }
    plain = {name.partition(" [")[0]: moved for name, moved in own.items()}
    several, alone = (fitted_response(BEAM, found(**each), F) for each in (own | other, plain))
    np.testing.assert_array_equal(several.velocity_m_s, alone.velocity_m_s)
    np.testing.assert_array_equal(several.amplitude_standard_error_m_s, alone.amplitude_standard_error_m_s)
    moved = replace(BEAM, length_m=0.3005, masses=(PlacedMass(1.1e-3, 0.201, 0.0),))
    np.testing.assert_allclose(several.velocity_m_s, small_velocity(moved, F), rtol=2e-3)
    assert np.all(np.abs(several.velocity_m_s / small_velocity(BEAM, F) - 1) > 4e-3)


def test_a_place_of_a_mass_that_a_beam_does_not_have_is_refused_in_a_line():
    with pytest.raises(BadInput, match=r"^adjusted: place_2_x, expected a number that the specimen states$"):
        FittedSmall.of(BEAM, found(place_2_x=(100.0, 0.5, 100.1)))


def test_errors_are_those_of_everything_that_was_fitted():
    fit = found(gain=(1.0, 0.003, 1.0))
    alone = fitted_response(PAIR, fit, F)
    law = sum(
        np.abs(0.01 * d / alone.velocity_m_s).real ** 2
        for d in FittedSmall.of(PAIR, fit).derivatives(F)[: len(LAW.names)]
    )
    assert np.all(alone.amplitude_standard_error_m_s > 0.5 * 0.003 * np.abs(alone.velocity_m_s))
    together = (alone.amplitude_standard_error_m_s / np.abs(alone.velocity_m_s)) ** 2
    assert np.all(together < law + (0.5 * 0.003) ** 2 + 1e-12)
    assert alone.phase_standard_error_rad == pytest.approx(
        np.sqrt(
            sum(
                (0.01 * (d / alone.velocity_m_s).imag) ** 2
                for d in FittedSmall.of(PAIR, fit).derivatives(F)[: len(LAW.names)]
            )
        )
    )
