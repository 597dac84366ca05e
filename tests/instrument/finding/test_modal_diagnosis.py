"""What tables of modes show beside a law."""

import json
from dataclasses import replace

import numpy as np
import pytest
import shear_pair_cases as pairs
from mode_cases import read_off, solid_modes, stated
from rivals import all_but, among
from scipy.optimize import root

from campaign.plates.geometry import plate_named
from campaign.plates.solid import Build, Patch
from fitting.dynamics.complex_modes import complex_modes
from fitting.laws import LAWS
from fitting.mode_tables.table import ModalTable
from fitting.plate.plate import Plate
from fitting.stated.layers import Core, Face
from fitting.structures.beam import Beam
from fitting.structures.small_modes import small_modes
from instrument.cli.main import run
from instrument.finding.modal import diagnose_tables

ALUMINIUM = Face(2e-3, 70e9, 0.3, 2700.0)
LAW = LAWS["fractional-zener"](5e5, 2e7, 1e-4, 0.6)
BEAM = Beam(0.2, 0.02, "clamped-free", ALUMINIUM, ALUMINIUM, Core(0.5e-3, 0.49, 1000.0, LAW))


@pytest.mark.long
def test_a_mass_on_a_solid_plate_is_named_and_placed():
    # A mode sees no side: the mass may be the mirrored one.
    true = plate_named("P8")
    x, y, mass = 0.9 * true.length_m, 0.8 * true.width_m, 4e-3
    modes = solid_modes("P8", build=Build(patches=(Patch(mass, x, y, 0.01),)))
    rng = np.random.default_rng([0, 7])
    specimen = stated("P8", rng)
    table = read_off(modes, rng)
    # Six modes hardly tell it from a piece that is missing elsewhere.
    for read in ("model", None):
        found = diagnose_tables([replace(table, read=read)], [specimen]).found
        best = found.judgement.accepted
        assert best.names == ("added_mass",)
        group = set(found.judgement.equivalent["added_mass"])
        assert group - {"added_masses"} == {"added_mass", "missing_piece"}
        m, x_found, y_found = best.fitted.of(best.fitted.effects[0])
        assert m == pytest.approx(mass, rel=0.4)
        assert x_found == pytest.approx(x, abs=0.01)
        assert min(abs(y_found - y), abs(true.width_m - y_found - y)) < 0.01


@pytest.mark.long
def test_a_beam_as_stated_leaves_nothing_and_one_that_is_not_does():
    def diagnosed(true):
        rng = np.random.default_rng(2)
        modes = small_modes(true, LAW, 6)
        table = read_off(
            (np.array([m.frequency_hz for m in modes]), np.array([m.loss_factor for m in modes])), rng
        )
        return diagnose_tables([table], [BEAM]).found

    assert diagnosed(BEAM).judgement.verdict == "none"
    stiffer = replace(BEAM, substrate=replace(ALUMINIUM, young_pa=1.3 * 70e9))
    found = diagnosed(stiffer).judgement
    # One face is as good as the other, and as stiff as a thicker one.
    assert found.verdict == "ambiguous"
    named = {name for group in found.equivalent.values() for name in group}
    assert named >= {"substrate_stiffness", "constraining_stiffness"}
    assert "none" not in named


def own_mode(specimen, more_kg):
    """Where the closed form of the wave in the pad has its pole, the law at the pole's real frequency."""
    area, t = specimen.discs * specimen.area_m2, specimen.core.thickness_m
    rubber = specimen.core.density_kg_m3

    def off(x):
        value = x[0] + 1j * x[1]
        G = pairs.LAW.modulus(np.array([np.sqrt(x[0])]))[0]
        k = np.sqrt(value * rubber / G)
        z = np.cos(k * t) - (specimen.mass_kg + more_kg) * value / (G * area * k) * np.sin(k * t)
        return [z.real, z.imag]

    guess = 8e6 * area / t / specimen.mass_kg
    x = root(off, [guess, 0.5 * guess], tol=1e-12).x
    return np.sqrt(x[0]) / (2 * np.pi), x[1] / x[0]


def table_of_pair(specimen, more_kg, rng):
    f, eta = own_mode(specimen, more_kg)
    return read_off((np.array([f]), np.array([eta])), rng)


@pytest.mark.long
def test_pairs_of_four_masses_name_what_all_of_them_lack():
    rng = np.random.default_rng(1)
    more = 0.3 * pairs.MASSES_KG[0]
    specimens = [pairs.pair(m) for m in pairs.MASSES_KG]
    found = diagnose_tables([table_of_pair(s, more, rng) for s in specimens], specimens).found
    assert found.judgement.verdict == "effect"
    best = found.judgement.accepted
    assert best.names == ("added_mass",)
    found_kg, file = best.fitted.of(best.fitted.effects[0])
    assert found_kg == pytest.approx(more, rel=0.2)
    assert file == 0


@pytest.fixture
def folder(tmp_path):
    assert run(["new", "beam", str(tmp_path / "beam.toml")]) == 0
    rows = "1,74.3,0.22\n2,365.6,0.223\n3,922.0,0.179\n4,1669.7,0.127\n"
    (tmp_path / "t.csv").write_text("mode,frequency_hz,loss_factor\n" + rows)
    return tmp_path


@among("core_thickness")
def test_the_command_writes_what_a_diagnosis_writes(folder, capsys, without):
    words = ["diagnose", str(folder / "t.csv"), "--specimen", str(folder / "beam.toml")]
    words += [word for name in without for word in ("--without", name)]
    assert run([*words, "--json", str(folder / "out.json")]) == 0
    found = json.loads((folder / "out.json").read_text())
    assert found["verdict"] in ("none", "effect", "ambiguous", "unknown")
    assert len(found["modes"]) == 4
    assert {"none", "core_law", "core_thickness"} - without <= {c["name"] for c in found["candidates"]}
    assert "rms difference in frequency" in capsys.readouterr().out


def test_what_does_not_go_with_tables_is_refused(folder, capsys):
    words = ["diagnose", str(folder / "t.csv"), "--specimen", str(folder / "beam.toml")]
    assert run([*words, "--resamples", "3"]) == 2
    assert "tables of modes" in capsys.readouterr().err
    assert run([*words, "--without", "gremlins"]) == 2
    assert "gremlins" in capsys.readouterr().err


def test_a_channel_is_not_looked_for_in_modes():
    modes = small_modes(BEAM, LAW, 4)
    table = ModalTable(
        np.arange(1.0, 5), np.array([m.frequency_hz for m in modes]), np.array([m.loss_factor for m in modes])
    )
    channels = ("gain_error", "channel_delay", "absolute_velocity")
    found = diagnose_tables([table], [BEAM], all_but("core_thickness", *channels)).found
    assert {n for s in found.scored for n in s.names} == {"core_thickness"}
    # Their errors are not stated: nothing can be said of their size.
    assert all(not s.checks for s in found.scored)


def test_a_table_of_a_plate_that_a_base_would_shake_off_its_axis_is_diagnosed(zn1):
    """Nothing drives or reads a table: effects of a base and a pickup have no meaning there."""
    specimen = replace(zn1, elements=(5, 4))
    assert specimen.pickup_m[1] != pytest.approx(specimen.width_m / 2)
    modes = complex_modes(Plate(specimen), specimen.core.law, 4)
    f, eta = np.array([m.frequency_hz for m in modes]), np.array([m.loss_factor for m in modes])
    table = ModalTable(np.arange(1.0, 5.0), f, eta, read="model")
    found = diagnose_tables([table], [specimen])
    assert found.found.judgement.verdict == "none"
    assert not {"base_roll", "base_rocking"} & {e.name for e in found.effects}
