"""Beam and shear pair on the simulated rig over its wires: measured, fitted, diagnosed, replayed, told."""

import numpy as np
import pytest
from quick_run import no_fit

from drivers.simulated.plant.effects import Effects
from drivers.simulated.plant.law import maxwell_series
from drivers.simulated.plant.shaken import ShakenPlate
from fitting.errors import OutsideModel
from fitting.structures import Beam, ShearPair
from instrument.check.dry_run import all_faults, dry_run
from instrument.cli.main import main
from instrument.errors import BadInput
from instrument.facts.prediction import PredictionResult
from instrument.files.new_file import write_new
from instrument.files.structure_file import read_structure
from instrument.interchange.given import read_given
from instrument.interchange.specimen_toml import specimen_toml
from instrument.report.page import report_of
from instrument.run.experiment import run_experiment
from instrument.run.replay import replay
from instrument.session.configuration import read_whole_experiment
from instrument.session.contents import contents_of
from instrument.session.storage import SessionFile
from instrument.simulated_case import case_file
from instrument.simulated_case.structure import mounted_structure

SEGMENTS = {
    "shear-pair": ((60.0, 110.0, 16), (220.0, 420.0, 11)),
    "beam": ((35.0, 65.0, 9),),
}
CHANNELS = {"shear-pair": "\n[tolerances]\ngain_percent = 0.3\nphase_deg = 0.001\n", "beam": ""}
"""The rig's are not turned; between two accelerometers half a degree would be allowed for."""
PAIR_LAW = "g0_mpa = 4.0"
SOFTER = "g0_mpa = 3.0"


def write_files(folder, kind, noise=1.0):
    """An experiment on what `viscorig new` describes; the fit begins with another law than the rig has."""
    write_new(kind, folder / "true.toml")
    stated = (folder / "true.toml").read_text().replace(PAIR_LAW, SOFTER)
    (folder / "stated.toml").write_text(stated + CHANNELS[kind])
    rig = case_file("rig.toml").read_text() + f'noise = {noise}\nspecimen = "true.toml"\n'
    (folder / "rig.toml").write_text(rig)
    segments = "".join(
        f"[[sweep.segments]]\nlow_hz = {a}\nhigh_hz = {b}\npoints = {n}\n" for a, b, n in SEGMENTS[kind]
    )
    head = 'specimen = "stated.toml"\nrig = "rig.toml"\n[sweep]\nlevel_g = 1.0\n'
    path = folder / "experiment.toml"
    path.write_text(head + "sentinel = false\n" + segments)
    return path


def plant(specimen):
    return ShakenPlate(mounted=mounted_structure(specimen, Effects()))


@pytest.fixture(scope="module")
def pair_run(tmp_path_factory):
    folder = tmp_path_factory.mktemp("pair")
    return run_experiment(read_whole_experiment(write_files(folder, "shear-pair")), folder, ("sweep",))


@pytest.fixture(scope="module")
def beam_run(tmp_path_factory):
    """Without noise, and nothing fitted: what is left is the measurement's own error."""
    folder = tmp_path_factory.mktemp("beam")
    experiment = read_whole_experiment(write_files(folder, "beam", noise=0.0))
    return run_experiment(experiment, folder, ("sweep",), fit=no_fit)


@pytest.mark.parametrize(("kind", "which"), [("beam", "beam_run"), ("shear-pair", "pair_run")])
def test_every_step_reads_the_plants_steady_state(kind, which, request, tmp_path):
    run = request.getfixturevalue(which)
    write_new(kind, tmp_path / "true.toml")
    solid = plant(read_structure(tmp_path / "true.toml"))
    assert run.points
    for p in run.points:
        exact = solid.steady_state(p.frequency_hz)
        ratio = (p.velocity_m_s / p.base_m_s2) / (exact["spot_velocity"] / exact["base_acceleration"])
        assert ratio == pytest.approx(1.0, abs=1e-2)


def test_the_pairs_law_is_found_live_what_free_edges_give_way_counted(pair_run, tmp_path):
    """The plant is a solid: its discs are softer by 6 to 7 % than G A / t, which the template counts."""
    write_new("shear-pair", tmp_path / "true.toml")
    law = maxwell_series(read_structure(tmp_path / "true.toml").core.law.modulus)
    assert pair_run.fit.result is not None
    for row in pair_run.fit.result.law:
        G = complex(law.modulus(2 * np.pi * row.frequency_hz))
        assert row.storage_modulus_pa / G.real == pytest.approx(1.0, abs=0.01)
        assert row.loss_factor == pytest.approx(G.imag / G.real, rel=0.03)
    assert pair_run.diagnosis.result.verdict in ("none", "ambiguous")
    assert not set(pair_run.diagnosis.result.equivalent) - {"none", "added_mass"}


def test_a_session_of_a_pair_is_replayed_read_and_reported(pair_run, tmp_path):
    with SessionFile(pair_run.session) as session:
        assert replay(session).differences == []
        contents = contents_of(session)
    assert isinstance(contents.specimen, ShearPair)
    (tmp_path / "again.toml").write_text(specimen_toml(contents))
    assert read_structure(tmp_path / "again.toml") == contents.specimen
    page = report_of(contents).html()
    assert "Shear pair" in page
    assert "No law could be identified" not in page
    given = read_given(pair_run.session, None, None)
    assert given.specimen == contents.specimen
    with pytest.raises(BadInput, match="expected a plate"):
        _ = given.plate


def test_a_fits_curve_goes_through_the_points_of_its_session(pair_run, tmp_path):
    """`predict --fit`, which the window draws its curve by."""
    with SessionFile(pair_run.session) as session:
        contents = contents_of(session, with_hits=False)
    (tmp_path / "s.toml").write_text(specimen_toml(contents))
    fit = tmp_path / "fit.json"
    fit.write_text(pair_run.fit.result.model_dump_json())
    out = tmp_path / "p.json"
    f = ",".join(repr(p.frequency_hz) for p in pair_run.points)
    arguments = ["predict", str(tmp_path / "s.toml"), "--fit", str(fit), "--frequencies", f]
    with pytest.raises(SystemExit, match="0"):
        main([*arguments, "--json", str(out)])
    found = PredictionResult.model_validate_json(out.read_text())
    for point, p in zip(found.points, pair_run.points, strict=True):
        read = abs(p.velocity_m_s / p.base_m_s2) * contents.specimen.base_acceleration_m_s2
        assert point.velocity_m_s == pytest.approx(read, rel=6e-3)
        assert 0 < point.velocity_standard_error_m_s < 0.01 * point.velocity_m_s


def test_a_pair_is_driven_across_the_rigs_own_resonance_in_coarse_steps(tmp_path):
    """The fixture's, at 162 Hz beside an anti-resonance: seven times the gain from 150 to 160 Hz."""
    path = write_files(tmp_path, "shear-pair")
    touching = "".join(
        f"[[sweep.segments]]\nlow_hz = {low}\nhigh_hz = {high}\npoints = 15\n"
        for low, high in ((60, 200), (200, 400))
    )
    path.write_text(path.read_text().split("sentinel = false")[0] + touching)
    run = run_experiment(read_whole_experiment(path), tmp_path, ("sweep",), fit=no_fit)
    assert len(run.points) == 33
    assert all(abs(p.control_error_percent) < 1 for p in run.points)


def test_a_dry_run_foretells_a_beam(tmp_path):
    path = write_files(tmp_path, "beam")
    assert all_faults(path) == []
    found = dry_run(path)
    assert isinstance(found.specimen, Beam)
    assert found.segments[0].steps == 9
    named = {t.name for t in found.result.tolerances}
    assert named >= {"substrate_young_percent", "length_mm", "pickup_mm"}
    assert "held_width_mm" not in named


@pytest.mark.parametrize(
    ("change", "said"),
    [
        (('specimen = "true.toml"\n', ""), 'expected [simulation] specimen = "stated.toml"'),
        (('specimen = "true.toml"', 'specimen = "plate.toml"'), "stands a plate"),
        (('specimen = "true.toml"', 'specimen = "pair.toml"'), "stands a shear-pair"),
        (("noise = ", "effects.clamp_friction = { loss_factor = 0.1 }\nnoise = "), "not on a beam"),
    ],
)
def test_what_cannot_stand_on_the_rig_is_said_before_it_moves(tmp_path, change, said):
    path = write_files(tmp_path, "beam")
    write_new("plate", tmp_path / "plate.toml")
    write_new("shear-pair", tmp_path / "pair.toml")
    rig = tmp_path / "rig.toml"
    rig.write_text(rig.read_text().replace(*change))
    assert any(said in line for line in all_faults(path))


def test_no_shear_pair_is_struck(tmp_path):
    path = write_files(tmp_path, "shear-pair")
    hammer = "[hammer]\nhits = 2\nhit_x_mm = 1.0\nhit_y_mm = 1.0\nresponse_x_mm = 1.0\nresponse_y_mm = 1.0\n"
    path.write_text(path.read_text() + hammer)
    assert any("hammer test is of a bare plate or beam" in line for line in all_faults(path))


def test_a_free_beam_has_no_base(tmp_path):
    path = write_files(tmp_path, "beam")
    for name in ("true.toml", "stated.toml"):
        text = (tmp_path / name).read_text()
        (tmp_path / name).write_text(text.replace('"clamped-free" ', '"free-free" '))
    said = all_faults(path)
    assert any("stands on no shaker" in line for line in said) or any("no base" in line for line in said)
    with pytest.raises((BadInput, OutsideModel)):
        dry_run(path)


def test_edges_are_counted_where_the_discs_are_described(tmp_path):
    path = tmp_path / "pair.toml"
    write_new("shear-pair", path)
    plain = path.read_text().replace("edges = true", "# edges = true")

    def read_with(more, text=plain):
        path.write_text(text.replace("discs = 2", f"{more}\ndiscs = 2"))
        return read_structure(path)

    assert read_with("edges = true").edges
    with pytest.raises(BadInput, match="expected one"):
        read_with("edges = true\nbending = true")
    area = plain.replace("outer_diameter_mm = 30.0", "area_mm2 = 600.0").replace(
        "inner_diameter_mm", "# inner"
    )
    with pytest.raises(BadInput, match="edges = true with area_mm2"):
        read_with("edges = true", area)
