"""What is said of a pair's discs before anything is fitted."""

from dataclasses import replace

import numpy as np
import pytest
from shear_pair_cases import sweep, transmissibility

from fitting.identification.validation import HeldOutSegment
from fitting.laws.constant import ConstantModulus
from fitting.stated.layers import Core
from fitting.structures import ShearPair
from fitting.structures.shear_pair import EDGE
from instrument.models.files import File
from instrument.remarks.file_remarks import (
    remarks_on_edges,
    remarks_on_files,
    remarks_on_holder,
    remarks_on_one_specimen,
    remarks_on_rest,
    remarks_on_scale,
    remarks_on_strain,
)

CORE = Core(6e-3, 0.5, 1100.0, ConstantModulus(5e6, 0.3))
PAIR = ShearPair(mass_kg=0.5, discs=2, area_m2=1.2e-3, core=CORE, gyration_m=1.0e-2)


def percent(pair):
    (said,) = remarks_on_edges(pair)
    return float(said.split("G' up to ")[1].split(" %")[0])


def test_what_edges_give_way_is_said_as_the_modulus_will_show_it():
    share = PAIR.softer_by_edges
    assert percent(PAIR) == pytest.approx(100 * share / (1 - share), rel=0.05)


def test_bending_that_is_counted_is_missing_no_more():
    assert 0 < percent(replace(PAIR, bending=True)) < percent(PAIR)


def test_where_only_an_area_is_stated_a_full_disc_stands_for_it():
    full = replace(PAIR, gyration_m=(PAIR.area_m2 / np.pi) ** 0.5 / 2)
    assert percent(replace(PAIR, gyration_m=None)) == pytest.approx(percent(full), rel=0.05)


def test_nothing_is_said_of_edges_that_are_counted_or_hardly_count():
    assert remarks_on_edges(replace(PAIR, edges=True)) == ()
    assert remarks_on_edges(replace(PAIR, core=replace(CORE, thickness_m=2e-4))) == ()


@pytest.mark.parametrize(("times", "asked"), [(0.05, True), (0.2, False), (6.0, False), (39.0, True)])
def test_a_modulus_far_from_where_its_file_begins_is_asked_about(times, asked):
    said = remarks_on_scale(PAIR, ConstantModulus(5e6 * times, 0.3), np.array([50.0, 100.0]))
    assert bool(said) is asked
    if asked:
        assert f"{times:.2g} times" in said[0]


def test_a_modulus_that_no_core_has_is_not_asked_about_twice():
    """The fit asks; 5 MPa is where this pair's file begins."""
    assert remarks_on_scale(PAIR, ConstantModulus(350e6, 0.3), np.array([50.0, 100.0])) == ()


def test_discs_thicker_than_wide_are_said_to_be_beyond_what_counts_their_edges():
    """Of the solid disc itself 4 % more gives way at 1.5 times: `test_solid_pad.py` has its size."""
    width = EDGE * CORE.thickness_m / PAIR.softer_by_edges
    as_wide, thicker = (replace(CORE, thickness_m=times * width) for times in (1.0, 1.5))
    assert remarks_on_edges(replace(PAIR, edges=True, core=as_wide)) == ()
    (said,) = remarks_on_edges(replace(PAIR, edges=True, core=thicker))
    assert said.startswith("the discs are 1.5 times as thick as r_o - r_i")


def edges_of(*files):
    return [said for said in remarks_on_files(files) if "edges" in said]


def test_what_holds_of_all_files_is_said_once_and_of_some_by_their_names():
    thinner = replace(PAIR, core=replace(CORE, thickness_m=3e-3))
    a, b, c = (File(sweep(PAIR, points=30), p, n) for n, p in zip("abc", (PAIR, PAIR, thinner), strict=True))
    (said,) = edges_of(a, b)
    assert said.startswith("what the discs' free edges")
    both, alone = edges_of(a, b, c)
    assert both.startswith("a, b: what the discs'")
    assert alone.startswith("c: what the discs'")


def test_of_one_level_the_strains_are_said_that_its_law_is_of():
    resting = replace(PAIR, reads="relative")
    at_one = [File(sweep(PAIR, points=30, noise=0.0, level=one), PAIR) for one in (9.81, 9.7)]
    (said,) = remarks_on_strain(at_one)
    T = transmissibility(PAIR, at_one[0].sweep.frequency_hz, CORE.law.modulus(at_one[0].sweep.omega))
    most = 100 * np.max(np.abs(T - 1) * 9.81 / at_one[0].sweep.omega ** 2 / CORE.thickness_m)
    assert float(said.split(" to ")[1].split(" %")[0]) == pytest.approx(most, rel=0.06)
    assert remarks_on_strain([at_one[0], File(sweep(PAIR, points=30, level=3.0), PAIR)]) == ()
    assert remarks_on_strain([File(at_one[0].sweep, replace(PAIR, exact=True))]) == ()
    # What is read relative to the base is the strain itself.
    moving = File(replace(at_one[0].sweep, velocity_m_s=1j * at_one[0].sweep.omega * 6e-5), resting)
    assert "(1 to 1 % in the pads)" in remarks_on_strain([moving])[0]


def test_files_far_off_one_law_that_share_one_pair_are_asked_whether_they_do():
    files = [File(sweep(PAIR, points=9), specimen) for specimen in (PAIR, PAIR)]
    (said,) = remarks_on_one_specimen(files, 41.0)
    assert said.startswith("all files are taken to be of the one shear-pair")
    assert "differ in mass" in said
    assert remarks_on_one_specimen(files, 4.0) == remarks_on_one_specimen(files[:1], 41.0) == ()
    other = replace(files[1], specimen=replace(PAIR, mass_kg=1.0))
    assert remarks_on_one_specimen([files[0], other], 41.0) == ()


def test_a_fit_that_leaves_far_more_than_noise_says_so_though_tolerances_explain_it():
    held_out = [HeldOutSegment(1, 3.1, 0.2), HeldOutSegment(2, 3.2, 0.2)]
    (said,) = remarks_on_rest(1.6, held_out)
    assert said.startswith("the fit leaves 1.6 % of the readings (rms), 8 times their noise")
    assert remarks_on_rest(0.7, held_out) == ()
    assert remarks_on_rest(1.6, ()) == ()
    assert remarks_on_rest(1.6, [HeldOutSegment(1, 3.1, float("nan"))]) == ()


def test_a_file_whose_noise_is_not_seen_says_whose_it_is_taken_for():
    specimen = replace(PAIR, exact=True)
    few, many = (sweep(specimen, points=n) for n in (5, 60))
    alone = remarks_on_files([File(few, specimen, name="few.csv")])
    beside = remarks_on_files([File(few, specimen, name="few.csv"), File(many, specimen, name="many.csv")])
    (said,) = (one for one in alone if "do not show their noise" in one)
    assert "the model's own error is not in them" in said
    (said,) = (one for one in beside if "do not show their noise" in one)
    assert said.startswith("few.csv: 5 points")
    assert "taken for that of the other files" in said


@pytest.mark.parametrize(("resonance_hz", "low"), [(300.0, ""), (1000.0, "4.9 %"), (1500.0, "11 %")])
def test_pads_as_stiff_as_their_holder_are_asked_about(resonance_hz, low):
    G = PAIR.mass_kg / 4 * (2 * np.pi * resonance_hz) ** 2 * CORE.thickness_m / (2 * PAIR.area_m2)
    pair = replace(PAIR, mass_kg=0.125, core=replace(CORE, density_kg_m3=1.0, law=ConstantModulus(G, 0.05)))
    read = sweep(pair, points=1000)
    said = remarks_on_holder(read, pair)
    assert len(said) == bool(low)
    if low:
        assert f"leaves G' and the loss factor {low} low there" in said[0]
    assert remarks_on_holder(read, replace(pair, exact=True)) == ()
    beside = replace(read, velocity_m_s=read.velocity_m_s - read.commanded_m_s2 / (1j * read.omega))
    assert remarks_on_holder(beside, replace(pair, reads="relative")) == said
    above = read.take(read.frequency_hz > 1.05 * resonance_hz)
    assert remarks_on_holder(above, pair) == ()
