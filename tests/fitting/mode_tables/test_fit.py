from dataclasses import replace

import numpy as np
import pytest
from beam_tables import fit_modes

from fitting.dynamics.complex_modes import complex_modes
from fitting.errors import OutsideModel, TooFewPoints
from fitting.laws import LAWS
from fitting.mode_tables.build import member_of, tapped, with_own_error
from fitting.mode_tables.problem import ModalProblem
from fitting.mode_tables.table import ModalTable
from fitting.plate.plate import Plate
from fitting.specimen import PlateSpecimen
from fitting.stated.layers import Core, Face
from fitting.structures.beam import Beam
from fitting.structures.small_modes import small_modes
from instrument.cli.main import run
from instrument.errors import BadInput
from instrument.files.modal_table import is_modal_table, read_modal_table

LAW = LAWS["fractional-zener"](5e5, 2e7, 1e-4, 0.6)
START = LAWS["fractional-zener"](1e6, 1e7, 3e-4, 0.5)
ALUMINIUM = Face(2e-3, 70e9, 0.3, 2700.0)


def beam(length_m=0.2, law=LAW, **more):
    core = Core(0.5e-3, 0.49, 1000.0, law)
    return Beam(length_m, 0.02, "clamped-free", ALUMINIUM, ALUMINIUM, core, **more)


def table(specimen, count, rng, f_std=1e-3, eta_std=0.03):
    modes = small_modes(specimen, specimen.core.law, count)
    f = np.array([m.frequency_hz for m in modes]) * (1 + f_std * rng.normal(size=count))
    eta = np.array([m.loss_factor for m in modes]) * (1 + eta_std * rng.normal(size=count))
    return ModalTable(np.arange(1.0, count + 1), f, eta)


def test_six_modes_give_the_law_within_its_band():
    rng = np.random.default_rng(3)
    found = fit_modes([table(beam(), 6, rng)], [beam(law=START)])
    omega = 2 * np.pi * np.geomspace(80, 1500, 7)
    G, eta = LAW.storage_and_loss(omega)
    found_G, found_eta = found.law.storage_and_loss(omega)
    G_error, eta_error = found.uncertainty.law_band(found.law, omega)
    assert np.sqrt(np.mean(((found_G - G) / G_error) ** 2)) < 2
    assert np.sqrt(np.mean(((found_eta - eta) / eta_error) ** 2)) < 2
    assert found.uncertainty.chi2_per_dof < 4
    assert {"core_thickness", "length", "substrate_young"} <= {one.name for one in found.adjusted}


def test_two_lengths_share_a_core_and_not_a_length():
    rng = np.random.default_rng(4)
    lengths = (0.2, 0.15)
    found = fit_modes([table(beam(x), 3, rng) for x in lengths], [beam(x, law=START) for x in lengths])
    names = [one.name for one in found.adjusted]
    assert names.count("core_thickness") == 1
    assert {"length [1]", "length [2]"} <= set(names)


def test_what_clamps_pull_is_of_each_table_though_the_beam_stays():
    held = replace(beam(), boundary="clamped-clamped")
    member = member_of(table(held, 3, np.random.default_rng(5)), held)
    both = ModalProblem.of([member, member], [1, 1])
    names = [n.name for n in both.each]
    assert [n for n in names if n.startswith("axial")] == ["axial [1]", "axial [2]"]
    assert names.count("length") == 1
    assert [n.name for n in ModalProblem.of([member]).each if n.kind == "axial"] == ["axial"]


def test_what_a_metal_may_lose_is_in_the_band_of_a_core_that_loses_little():
    firm = LAWS["fractional-zener"](2e7, 4e7, 1e-4, 0.3)
    lossy = replace(ALUMINIUM, loss_factor=1.5e-3)
    rows = table(replace(beam(law=firm), substrate=lossy, constraining=lossy), 6, np.random.default_rng(1))
    omega = 2 * np.pi * np.array([80.0])
    off = {}
    for known in (True, False):
        stated = beam(law=firm)
        metal = replace(ALUMINIUM, loss_is_stated=known)
        found = fit_modes([rows], [replace(stated, substrate=metal, constraining=metal)])
        error = found.uncertainty.law_band(found.law, omega)[1]
        off[known] = (found.law.storage_and_loss(omega)[1] - firm.storage_and_loss(omega)[1]) / error
    assert off[True] > 3
    assert abs(off[False]) < 2


def test_what_a_mesh_gets_wrong_of_a_plate_s_modes_is_taken_off():
    fine = complex_modes(Plate(tapped(replace(PLATE, elements=(48, 32)))), LAW, 6)
    rows = ModalTable(np.arange(1.0, 7), np.full(6, 50.0), np.full(6, 0.1), read="model")
    member = member_of(rows, replace(PLATE, modal_ratios=(0.0,)))
    with_mesh, without = (m.logs(LAW, np.zeros(13)) for m in (member, with_own_error(member, LAW)))
    true = np.log([m.frequency_hz for m in fine])
    assert np.abs(without.real - true).max() < 0.3 * np.abs(with_mesh.real - true).max()
    left = with_own_error(member, LAW).own_error[0]
    assert np.all(np.abs(without.real - true) < 2 * left)


def test_a_plate_of_which_no_ratios_are_stated_rings_too():
    plate = replace(PLATE, exact=False, modal_ratios=())
    rows = ModalTable(np.arange(1.0, 7), np.full(6, 50.0), np.full(6, 0.1))
    names = {n.name for n in member_of(rows, plate).stated.each}
    assert {f"damping_{k}" for k in range(1, 7)} <= names
    none = member_of(rows, replace(plate, modal_ratios=(0.0,)))
    assert not any(n.name.startswith("damping") for n in none.stated.each)


def test_one_mode_cannot_carry_four_parameters():
    one = replace(table(beam(), 1, np.random.default_rng(0)), name="t.csv")
    with pytest.raises(TooFewPoints, match=r"t\.csv: 1 mode with 2 numbers .* expected 3 modes"):
        fit_modes([one], [beam()])


TABLE = "mode,frequency_hz,loss_factor\n1,70.0,0.15\n2,311.0,0.12\n3,773.0,0.08\n4,1449.0,0.05\n"
LIKE_THE_NEW_BEAM = "mode,frequency_hz,loss_factor\n1,74.3,0.22\n2,365.6,0.22\n3,922.0,0.18\n4,1669.7,0.13\n"
FAULTS = {
    "half a mode": (TABLE.replace("2,311", "2.5,311"), "line 3: mode = 2.5"),
    "no loss": (TABLE.replace("0.12", "0"), "line 3: loss_factor = 0"),
    "no name": (TABLE.replace("loss_factor", "loss_facter"), "no loss_factor, the nearest is loss_facter"),
    "no column": ("mode,frequency_hz\n1,70.0\n", "no loss_factor; expected mode, frequency_hz, loss_factor"),
    "no mode": ("frequency_hz,loss_factor\n70.0,0.1\n", "no mode; expected mode"),
    "too high": (TABLE.replace("4,1449", "1000000000,1449"), "line 5: mode = 1000000000"),
    "twice": (TABLE.replace("2,311", "1,311"), "twice"),
    "too cold": (
        "mode,frequency_hz,loss_factor,temperature_c\n1,70.0,0.15,-400\n",
        "line 2: temperature_c = -400, expected degrees Celsius above -273.15",
    ),
}


@pytest.mark.parametrize(("text", "said"), FAULTS.values(), ids=FAULTS)
def test_a_bad_table_is_refused_in_one_line(tmp_path, text, said):
    (tmp_path / "t.csv").write_text(text)
    with pytest.raises(BadInput) as error:
        read_modal_table(tmp_path / "t.csv")
    assert said in str(error.value)
    assert is_modal_table(tmp_path / "t.csv")


@pytest.mark.parametrize(
    "header",
    [
        "frequency_hz,velocity_m_s,mode",
        "frequency_hz,storage_modulus_pa,loss_factor",
        "frequency_hz,mobility_re",
    ],
)
def test_other_tables_are_not_taken_for_tables_of_modes(tmp_path, header):
    (tmp_path / "t.csv").write_text(f"{header}\n{','.join('123'[: header.count(',') + 1])}\n")
    assert not is_modal_table(tmp_path / "t.csv")


def test_a_mode_beyond_the_model_names_the_file_and_what_to_do():
    beyond = replace(table(beam(), 6, np.random.default_rng(0)), mode=np.arange(6.0) + 600, name="t.csv")
    with pytest.raises(OutsideModel, match=r"t\.csv: mode 605, expected one of the .* from 1"):
        fit_modes([beyond], [beam()])


def test_the_command_takes_a_table(tmp_path):
    path = tmp_path / "t.csv"
    path.write_text(LIKE_THE_NEW_BEAM)
    assert is_modal_table(path)
    assert run(["new", "beam", str(tmp_path / "beam.toml")]) == 0
    assert run(["identify", str(path), "--specimen", str(tmp_path / "beam.toml")]) == 0


def test_derivatives_are_central_differences():
    specimen = beam()
    member = member_of(table(specimen, 3, np.random.default_rng(0)), specimen)
    by_differences(member)


def test_a_plate_s_derivatives_are_central_differences():
    # Damped, its faces lossy: every way into the equation.
    specimen = replace(
        PLATE, modal_ratios=(0.003, 0.002), substrate=replace(PLATE.substrate, loss_factor=0.004)
    )
    some = ModalTable(np.array([1.0, 2.0, 4.0]), np.array([23.0, 60.0, 130.0]), np.array([0.1, 0.1, 0.1]))
    by_differences(member_of(some, specimen))


def by_differences(member):
    n, count, h = len(LAW.names), len(member.stated), 1e-2
    x = np.concatenate([np.log(LAW.values), np.zeros(count)])

    def logs(x):
        return member.logs(LAW.with_logs(x[:n]), x[n:])

    _, found = member.with_derivatives(LAW, x[n:], (), ())
    for k in range(len(x)):
        step = h * (np.arange(len(x)) == k)
        expected = (logs(x + step) - logs(x - step)) / (2 * h)
        assert np.allclose(found[k], expected, rtol=3e-3, atol=1e-6), k


PLATE = PlateSpecimen(
    0.3,
    0.2,
    "cantilever",
    ALUMINIUM,
    Face(0.5e-3, 70e9, 0.3, 2700.0),
    Core(0.5e-3, 0.49, 1000.0, LAW),
    elements=(12, 8),
)


def test_a_plate_s_modes_are_those_of_all_its_degrees_of_freedom():
    rows = ModalTable(np.arange(1.0, 7), np.full(6, 50.0), np.full(6, 0.1))
    member = member_of(rows, replace(PLATE, modal_ratios=(0.0,)))
    found, true = member.logs(LAW, np.zeros(13)), complex_modes(Plate(tapped(PLATE)), LAW, 6)
    np.testing.assert_allclose(np.exp(found.real), [m.frequency_hz for m in true], rtol=1e-5)
    np.testing.assert_allclose(np.exp(found.imag / member.kappa), [m.loss_factor for m in true], rtol=1e-4)
