"""`viscorig identify` on a session."""

import json

import pytest
from called import call, facts
from data_folder import DATA
from paper_law import TABLE_4
from session_cases import SyntheticSession, configuration

from instrument.paper_case import case_file
from instrument.session.contents import contents_of
from instrument.session.storage import SessionFile
from instrument.stream.derived import DampingFound


def test_the_law_behind_the_session_is_found(capsys, session_path):
    found = facts(capsys, "identify", session_path)
    for name, truth in zip(TABLE_4.names, TABLE_4.values, strict=True):
        assert abs(found["parameters"][name] - truth) < 4 * found["standard_errors"][name] + 1e-3 * truth
    assert found["session"] == "zn1-20260401T080000Z"
    assert found["reads"] == "absolute"
    assert len(found["hammer"]["modes"]) == 8


def test_it_is_what_the_live_fit_had(capsys, session_path):
    found = facts(capsys, "identify", session_path)
    with SessionFile(session_path) as file:
        live = contents_of(file, with_hits=False).fit.result
    assert found["parameters"] == pytest.approx(live.parameters, rel=1e-8)
    assert found["rms_percent"] == pytest.approx(live.rms_percent, rel=1e-6)


def test_the_hammer_test_can_be_left_out(capsys, session_path):
    found = facts(capsys, "identify", session_path, "--no-hammer")
    assert "hammer" not in found


def test_a_hammer_test_beyond_use_is_refused_and_can_be_left_out(capsys, tmp_path):
    """A quarter of critical damping on a bare plate: something else was hit."""
    synthetic = SyntheticSession(configuration())
    synthetic.begin()
    synthetic.hammer()
    (at,) = (k for k, e in enumerate(synthetic.events) if isinstance(e, DampingFound))
    first, *rest = synthetic.events[at].result.modes
    wrong = synthetic.events[at].result.but(modes=(first.but(damping_ratio=0.25), *rest))
    synthetic.events[at] = DampingFound(wrong)
    synthetic.sweep(segments=(1, 2))
    path = synthetic.save(tmp_path)
    status, _, err = call(capsys, "identify", path)
    assert (status, err.count("\n")) == (2, 1)
    assert "hammer test: modes.0.damping_ratio: 0.25" in err
    assert "hammer" not in facts(capsys, "identify", path, "--no-hammer")


def test_another_hammer_test_can_take_its_place(capsys, session_path, tmp_path):
    with SessionFile(session_path) as file:
        damping = contents_of(file, with_hits=False).damping.result.as_json()
    for mode in damping["modes"]:
        mode["frequency_hz"] *= 1.01
    path = tmp_path / "other.json"
    path.write_text(json.dumps(damping))
    own = facts(capsys, "identify", session_path)["hammer"]["substrate_young_pa"]
    other = facts(capsys, "identify", session_path, "--hammer", path)["hammer"]["substrate_young_pa"]
    assert other / own == pytest.approx(1.02, abs=2e-3)


def test_another_specimen_is_read_as_the_rig_says(capsys, session_path, tmp_path):
    """The paper's file says nothing of reading, which means relative; the session's laser read absolute."""
    coarse = tmp_path / "coarse.toml"
    coarse.write_text(case_file("zn1.toml").read_text() + "\n[mesh]\nelements_x = 10\nelements_y = 10\n")
    found = facts(capsys, "identify", session_path, "--specimen", coarse)
    assert found["reads"] == "absolute"
    assert found["parameters"]["g0_pa"] == pytest.approx(TABLE_4.g0_pa, rel=1e-3)


def test_levels_are_those_commanded(capsys, session_path):
    """Half a g: the amplitudes of the list are at that level."""
    found = facts(capsys, "identify", session_path)
    with SessionFile(session_path) as file:
        point = contents_of(file, with_hits=False).measured[0]
    response = abs(point.velocity_m_s / point.base_m_s2) * point.level_m_s2
    assert found["points"][0]["measured_m_s"] == pytest.approx(response, rel=1e-12)


def test_a_person_is_told_what_was_read(capsys, session_path):
    status, out, _ = call(capsys, "identify", session_path)
    assert status == 0
    assert "31 points, velocity absolute, its hammer test with 8 modes" in out


@pytest.mark.parametrize(
    ("arguments", "word"),
    [
        (("--hammer", "x.json", "--no-hammer"), "exclude"),
        (("--specimen", "none.toml"), "none.toml"),
        (("--hammer", "none.json"), "none.json"),
    ],
)
def test_bad_options_are_refused_in_a_line(capsys, session_path, arguments, word):
    status, _, err = call(capsys, "identify", session_path, *arguments)
    assert (status, err.count("\n")) == (2, 1)
    assert word in err


def test_a_csv_still_needs_its_specimen(capsys):
    status, _, err = call(capsys, "identify", DATA / "practice-002.csv")
    assert status == 2
    assert "--specimen" in err


def test_a_session_without_points_is_refused(capsys, tmp_path):
    synthetic = SyntheticSession(configuration())
    synthetic.begin()
    synthetic.hammer()
    synthetic.end("stopped by the user")
    status, _, err = call(capsys, "identify", synthetic.save(tmp_path))
    assert (status, err.count("\n")) == (2, 1)
    assert "no point of a sweep" in err


def test_what_is_no_session_is_refused(capsys, tmp_path):
    path = tmp_path / "other.h5"
    path.write_bytes(b"not HDF5")
    status, _, err = call(capsys, "identify", path)
    assert status == 2
    assert "not a session file" in err
