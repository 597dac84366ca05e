"""What a session leaves to be fitted: one file for every spot and every known mass on the plate."""

import numpy as np
import pytest
from following_cases import MASS, MASS_KG, MASS_MM, SPOT, SPOT_MM, run
from formula_rig import SWEEP, formula_rig
from scipy.io import savemat

from fitting.specimen import PlacedMass
from fitting.sweep import Sweep
from instrument.cli.main import run as viscorig
from instrument.errors import BadInput
from instrument.files.new_file import write_new
from instrument.files.specimen_file import read_specimen
from instrument.interchange.csv_export import export_csv
from instrument.interchange.exporting import export_session
from instrument.interchange.files_of import files_of
from instrument.interchange.given import at_its_spot, hammer_of, read_given
from instrument.interchange.identified import session_sweep
from instrument.interchange.importing import one_table
from instrument.interchange.read_uff import read_uff
from instrument.interchange.uff_export import export_uff
from instrument.paper_case import case_file
from instrument.session.configuration import read_whole_experiment
from instrument.session.contents import contents_of
from instrument.session.storage import SessionFile
from viscorig import identify, load_session

FOLLOWS = '[diagnosis]\nfollow_up = "do"\n'
PLACED = PlacedMass(MASS_KG, 1e-3 * MASS_MM[0], 1e-3 * MASS_MM[1])


@pytest.fixture(scope="module")
def finished(tmp_path_factory):
    """A sweep, the same with a known mass, then at another spot."""
    folder = tmp_path_factory.mktemp("masses")
    with formula_rig(folder, sweep=SWEEP) as (_, experiment):
        experiment.path.write_text(experiment.path.read_text() + FOLLOWS)
        return run(read_whole_experiment(experiment.path), folder, (MASS, SPOT))


def test_a_column_of_spots_that_the_specimen_lacks_says_how_many_it_has():
    one = np.ones(2, dtype=np.intp)
    of_two = Sweep(np.array([10.0, 20.0]), one + 0j, one * 1.0, one, one, pickup=np.array([0, 1]))
    plate = read_specimen(case_file("zn1.toml"))
    with pytest.raises(BadInput, match="pickup: 1, expected 0: the specimen is read at one spot"):
        at_its_spot("a.csv", plate, of_two)


def test_a_known_mass_that_a_run_put_on_is_on_the_plate_of_its_points(finished):
    given = read_given(finished.session, None, None)
    with_mass = [f for f in given.with_masses if f.specimen.masses]
    assert {f.specimen.masses for f in with_mass} == {(PLACED,)}
    assert sum(len(f.sweep) for f in given.with_masses) == len(finished.points)
    assert sum(len(f.sweep) for f in with_mass) == sum(p.mass_at_mm is not None for p in finished.points)
    assert {f.pickup for f in given.with_masses} <= {None, 0, 1}
    assert given.plate.further_pickups_m == ((1e-3 * SPOT_MM[0], 1e-3 * SPOT_MM[1]),)


def test_a_session_is_not_fitted_as_a_structure_of_another_kind(finished, tmp_path):
    write_new("beam", tmp_path / "beam.toml")
    with pytest.raises(BadInput, match=r"beam\.toml: a beam, expected a plate as the session's own"):
        read_given(finished.session, tmp_path / "beam.toml", None)


def test_as_long_as_nothing_was_changed_there_is_one_file(finished):
    with SessionFile(finished.session) as file:
        contents = contents_of(file)
    first = [k for k, p in enumerate(contents.measured) if p.sweep == 1]
    sweep = session_sweep(contents).take(np.array(first))
    (whole,) = files_of(sweep, [contents.measured[k] for k in first], contents.specimen)
    assert whole.specimen == contents.specimen
    assert len(whole.sweep) == len(first)


def test_its_export_is_not_taken_for_a_bare_sweep(capsys, finished, tmp_path):
    with SessionFile(finished.session) as file:
        written = export_csv(contents_of(file), tmp_path)
    sweep = next(p for p in written if p.suffix == ".csv")
    specimen = next(p for p in written if p.suffix == ".toml")
    assert viscorig(["identify", str(sweep), "--specimen", str(specimen)]) == 2
    line = capsys.readouterr().err.strip()
    assert "column mass_kg" in line
    assert "\n" not in line


@pytest.mark.parametrize("kind", ["csv", "mat"])
def test_nor_is_what_comes_back_from_it(capsys, finished, tmp_path, kind):
    with SessionFile(finished.session) as file:
        written = export_session(contents_of(file), kind, tmp_path).files
    foreign = next(p for p in written if p.suffix == f".{kind}")
    back = tmp_path / "back.csv"
    assert viscorig(["import", str(foreign), "--out", str(back)]) == 0
    assert viscorig(["identify", str(back), "--specimen", str(case_file("zn1.toml"))]) == 2
    assert "column mass_kg" in capsys.readouterr().err


def test_a_universal_file_has_its_spots_apart_and_leaves_out_what_it_cannot_say(finished, tmp_path):
    with SessionFile(finished.session) as file:
        contents = contents_of(file)
    written, notes = export_uff(contents, tmp_path)
    with_mass = [p for p in contents.measured if p.mass_kg and p.purpose == "step"]
    assert any(note.startswith(f"{len(with_mass)} points with a known mass") for note in notes)
    columns = one_table(read_uff(next(p for p in written if "sweep" in p.name)).sweeps)
    steps = [p for p in contents.measured if not p.mass_kg and p.purpose == "step"]
    assert sorted(columns["pickup"]) == sorted(p.pickup for p in steps)


def test_a_notebook_is_told_to_use_the_command(finished):
    with pytest.raises(BadInput, match="known mass"):
        identify(load_session(finished.session))


def test_several_spots_of_a_file_take_a_hammer_test(tmp_path):
    write_new("plate", tmp_path / "plate.toml")
    text = (tmp_path / "plate.toml").read_text().replace("[pickup] ", "[[pickup]] ", 1)
    (tmp_path / "plate.toml").write_text(text + "\n[[pickup]]\nx_mm = 250.0\ny_mm = 100.0\n")
    rows = [f"{f},{1e-3 * f},{k}" for k in (0, 1) for f in (15, 16, 17, 18)]
    (tmp_path / "sweep.csv").write_text("\n".join(["frequency_hz,velocity_m_s,pickup", *rows]))
    (tmp_path / "hammer.json").write_text('{"modes": [{"frequency_hz": 18.0, "damping_ratio": 0.003}]}')
    given = read_given(tmp_path / "sweep.csv", tmp_path / "plate.toml", tmp_path / "hammer.json")
    assert sorted(set(given.sweep.pickup)) == [0, 1]
    assert given.modes.frequency_hz.tolist() == [18.0]


def test_a_session_lends_its_hammer_test_to_other_data(session_path, finished):
    with SessionFile(session_path) as file:
        damping = contents_of(file, with_hits=False).damping.result
    hammer = hammer_of(session_path)
    assert hammer.frequency_hz.tolist() == [m.frequency_hz for m in damping.modes if m.accepted]
    assert len(hammer.ratios) == len(hammer.frequency_hz) > 0
    with pytest.raises(BadInput, match=r"no accepted mode of a bare plate in this session"):
        hammer_of(finished.session)


def test_known_masses_in_another_program_s_file_are_asked_about_too(tmp_path):
    variables = {"frequency_hz": [20.0, 21.0], "velocity_m_s": [1.0, 2.0], "mass_kg": [0.0, 0.01]}
    savemat(tmp_path / "a.mat", {k: np.array(v) for k, v in variables.items()})
    with pytest.raises(BadInput, match="column mass_kg: a known mass was on the plate in some rows"):
        read_given(tmp_path / "a.mat", case_file("zn1.toml"), None)


def test_columns_of_nearly_a_known_name_are_remarked_on(tmp_path):
    (tmp_path / "a.csv").write_text("frequency_hz,velocity_m_s,time\n20,0.1,0\n40,0.2,5\n")
    assert "time (is it time_s?)" in read_given(tmp_path / "a.csv", case_file("zn1.toml"), None).remark
