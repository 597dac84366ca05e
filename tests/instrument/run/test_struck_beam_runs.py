"""A bare beam on the simulated rig: struck, read, its modes and their damping found, then its sweep."""

from dataclasses import replace

import numpy as np
import pytest
from quick_run import no_fit

from fitting.structures.small_modes import small_modes
from instrument.check.dry_run import all_faults, dry_run
from instrument.files.new_file import write_new
from instrument.files.structure_file import read_structure
from instrument.interchange.csv_export import export_csv
from instrument.interchange.given import read_given
from instrument.report.page import report_of
from instrument.run.experiment import run_experiment
from instrument.session.configuration import read_whole_experiment
from instrument.session.contents import contents_of
from instrument.session.storage import SessionFile
from instrument.simulated_case import case_file

HAMMER = """[hammer]
hits = 2
record_s = 6.0
hit_x_mm = 185.0
hit_y_mm = 5.0
response_x_mm = 120.0
response_y_mm = 5.0
band_hz = [20.0, 1000.0]
"""


def write_files(folder, *changes):
    write_new("beam", folder / "beam.toml")
    (folder / "rig.toml").write_text(case_file("rig.toml").read_text() + 'specimen = "beam.toml"\n')
    text = 'specimen = "beam.toml"\nrig = "rig.toml"\n' + HAMMER
    text += "[sweep]\nlevel_g = 1.0\nsentinel = false\n"
    text += "[[sweep.segments]]\nlow_hz = 40.0\nhigh_hz = 60.0\npoints = 5\n"
    for old, new in changes:
        text = text.replace(old, new)
    (folder / "experiment.toml").write_text(text)
    return folder / "experiment.toml"


def shapes(at):
    """A cantilever's first three, of unit mean square, at a share of its length."""
    b = np.array([1.875104, 4.694091, 7.854757])
    s = (np.cosh(b) + np.cos(b)) / (np.sinh(b) + np.sin(b))
    return np.cosh(b * at) - np.cos(b * at) - s * (np.sinh(b * at) - np.sin(b * at))


@pytest.fixture(scope="module")
def struck(tmp_path_factory):
    folder = tmp_path_factory.mktemp("struck")
    experiment = read_whole_experiment(write_files(folder))
    return run_experiment(experiment, folder, ("hammer", "sweep"), fit=no_fit)


@pytest.mark.long
def test_its_modes_and_their_damping_are_found(struck, tmp_path):
    write_new("beam", tmp_path / "beam.toml")
    bare = replace(read_structure(tmp_path / "beam.toml"), core=None, constraining=None)
    theory = np.array([m.frequency_hz for m in small_modes(bare, None, 3)])
    found = [m for m in struck.damping.result.modes if m.accepted]
    # Rayleigh: 0.6 g sit at 0.6 of the length of 10.8 g. A solid's clamp holds the width too.
    theory = theory / np.sqrt(1 + 0.6 / 10.8 * shapes(0.6) ** 2)
    np.testing.assert_allclose([m.frequency_hz for m in found[:3]], theory, rtol=0.008)
    np.testing.assert_allclose([m.damping_ratio for m in found[:3]], 1e-3, rtol=0.1)


@pytest.mark.long
def test_its_session_is_read_told_and_exported(struck, tmp_path):
    with SessionFile(struck.session) as session:
        contents = contents_of(session)
    assert len(contents.hits) >= 2
    given = read_given(struck.session, None, None)
    assert given.modes is None
    assert len(given.sweep) == 5
    assert "--hammer" not in next(p for p in export_csv(contents, tmp_path) if p.suffix == ".csv").read_text()
    assert "Hammer test of the bare beam" in [s.title for s in report_of(contents).sections]


def test_a_dry_run_foretells_its_record(tmp_path):
    foretold = dry_run(write_files(tmp_path, ("record_s = 6.0\n", "")))
    # 2 mm of aluminium, 200 mm long: 41 Hz at 0.1 % falls to 1 % in 18 s.
    assert 14 < foretold.hammer_record_s < 22


@pytest.mark.parametrize(
    ("change", "said"),
    [
        (
            ("hit_x_mm = 185.0", "hit_x_mm = 205.0"),
            "hammer.hit_x_mm = 205 is off the beam, expected 0 to 200",
        ),
        (("response_y_mm = 5.0", "response_y_mm = 12.0"), "hammer.response_y_mm = 12 is off the beam"),
    ],
)
def test_a_place_off_it_is_refused(tmp_path, change, said):
    assert any(said in fault for fault in all_faults(write_files(tmp_path, change)))


def test_one_driven_in_its_centre_is_not_struck(tmp_path):
    path = write_files(tmp_path)
    text = (tmp_path / "beam.toml").read_text().replace('"clamped-free"', '"centre-driven"')
    (tmp_path / "beam.toml").write_text(text.replace("x_mm = 150.0", "x_mm = 90.0"))
    assert any("driven in its centre is not struck" in fault for fault in all_faults(path))
