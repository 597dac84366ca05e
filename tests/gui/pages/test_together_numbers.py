"""What is said of several files, without a window."""

import numpy as np
import pytest
from diagnosis_cases import diagnosis
from pair_files import write_pair
from result_cases import identification

from fitting.data.aside import DISTURBED, LOST
from gui.files.pairing import PairedFile
from gui.pages.together.fits import FAR_STD, fitted_files, has_stages
from gui.pages.together.looked import look
from gui.pages.together.numbers import (
    candidate_rows,
    count_of,
    headline,
    left_rows,
    number_rows,
    owner_lines,
    owners,
)
from instrument.errors import BadInput
from instrument.facts.diagnosis import CandidateFitted, EffectFound, ParameterFound, PointLeft, Residual
from instrument.facts.modal import ModalResult
from instrument.facts.rows import AdjustedNumber, PointSetAside, StretchSetAside

FILES = ("light.csv", "heavy.csv")


def point(f, file, *, measured=0.1, predicted=0.11, segment=None):
    return {
        "frequency_hz": f,
        "segment": segment or file,
        "file": file,
        "measured_m_s": measured,
        "predicted_m_s": predicted,
        "difference_percent": 100 * (predicted / measured - 1),
    }


FIT = identification(points=[point(30.0, 1), point(20.0, 1), point(25.0, 2, measured=0.2)], files=FILES)


def left(f, file, percent, whitened):
    before = Residual(amplitude_percent=5.0, whitened=(9.0, 0.0))
    after = Residual(amplitude_percent=percent, whitened=whitened)
    more = {"segment": file, "sweep": 1, "level_m_s2": 9.81, "noise_percent": 0.1, "file": file}
    return PointLeft(frequency_hz=f, before=before, after=after, **more)


POINTS = (left(30.0, 1, 0.5, (0.1, -3.5)), left(20.0, 1, 0.1, (1.0, 1.0)), left(25.0, 2, -0.2, (2.9, 0.0)))


def found_in(file, **parameters):
    keys = {"mass": 0.02, **parameters, "file": file}
    return {k: ParameterFound(value=v, standard_error=0.001, unit="kg") for k, v in keys.items()}


def test_each_file_has_its_points_in_order_and_the_fit_s_line():
    one, other = fitted_files(FIT)
    assert (one.title, other.title) == ("1 light.csv", "2 heavy.csv")
    assert one.frequency_hz.tolist() == [20.0, 30.0]
    assert one.predicted.tolist() == [0.11, 0.11]
    assert one.difference_percent == pytest.approx([10.0, 10.0])
    assert not one.far.any()


def test_a_file_alone_has_its_name_though_its_result_says_none():
    alone = identification(points=[point(20.0, 1) | {"file": None}])
    assert alone.files is None
    (one,) = fitted_files(alone, names=("plate.csv",))
    assert one.title == "1 plate.csv"


def test_segments_of_a_file_are_not_joined():
    fit = identification(points=[point(20.0, 1), point(90.0, 1, segment=2)], files=FILES)
    (one,) = fitted_files(fit)
    assert np.isnan(one.frequency_hz).tolist() == [False, True, False]


def test_with_a_diagnosis_the_line_is_that_of_its_stage():
    found = diagnosis().but(points=POINTS, files=FILES)
    before, _ = fitted_files(FIT, found, "before")
    after, _ = fitted_files(FIT, found, "after")
    assert before.difference_percent == pytest.approx([5.0, 5.0])
    assert after.difference_percent == pytest.approx([0.1, 0.5])
    assert (before.far.tolist(), after.far.tolist()) == ([True, True], [False, True])


def test_a_point_measured_twice_has_both_residuals():
    fit = identification(points=[point(30.0, 1), point(30.0, 1)], files=FILES)
    found = diagnosis().but(points=(left(30.0, 1, 1.0, (0, 0)), left(30.0, 1, 2.0, (0, 0))))
    (one,) = fitted_files(fit, found, "after")
    assert one.difference_percent == pytest.approx([1.0, 2.0])


def test_a_point_that_the_diagnosis_set_aside_has_no_line():
    found = diagnosis().but(points=POINTS[1:])
    one, _ = fitted_files(FIT, found, "after")
    assert np.isnan(one.predicted).tolist() == [False, True]


def modes():
    row = {"mode": 1, "frequency_hz": 40.0, "predicted_hz": 41.0}
    losses = {"loss_factor": 0.10, "predicted_loss_factor": 0.11}
    return ModalResult.model_validate(
        {
            **identification().as_json(),
            "method": "modes",
            "files": FILES,
            "modes": [row | losses | {"file": k} for k in (1, 2)],
            "chi2_per_dof": 1.2,
        }
    )


def test_modes_are_at_the_frequencies_measured_and_those_of_the_law():
    one, other = fitted_files(modes())
    assert (one.frequency_hz[0], one.predicted_hz[0], one.measured[0], one.predicted[0]) == (
        40,
        41,
        0.1,
        0.11,
    )
    assert other.title == "2 heavy.csv"
    assert not has_stages(modes())
    assert has_stages(FIT)


def adjusted(name, unit="kg", pull=0.5):
    more = {"stated": 1.0, "tolerance": 0.012345, "found": 1.00617283, "standard_error": 0.0098765}
    return AdjustedNumber(name=name, unit=unit, pull=pull, **more)


def test_numbers_stand_by_kind_then_by_file_and_common_ones_first():
    given = [adjusted("mass [1]"), adjusted("gain [1]", "1"), adjusted("mass [2]"), adjusted("area", "mm^2")]
    rows = number_rows([*given, adjusted("gain [2, pickup 1]", "1")], FILES)
    assert [(r.name, r.file) for r in rows] == [
        ("area / mm²", "all"),
        ("mass / kg", "1 light.csv"),
        ("mass / kg", "2 heavy.csv"),
        ("gain", "1 light.csv"),
        ("gain, pickup 1", "2 heavy.csv"),
    ]
    assert (rows[0].stated, rows[0].found) == ("1.000 ± 0.012", "1.0062 ± 0.0099")


def test_what_is_left_are_stretches_then_points_that_were_judged():
    aside = StretchSetAside(
        file=1, name="light.csv", from_hz=200.0, to_hz=300.0, largest_percent=4.23, points=12
    )
    fitted = fitted_files(FIT, diagnosis().but(points=POINTS), "after")
    stretch, far = left_rows(fitted, [aside], judged=True)
    assert (stretch.file, stretch.where, stretch.off_percent) == ("1 light.csv", "200 to 300", "4.2 at most")
    assert (far.file, far.where, far.off_percent) == ("1 light.csv", "30", "+0.5")
    assert f"{FAR_STD:g} standard deviations" in far.what
    assert left_rows(fitted, [aside], judged=False) == [stretch]


def test_the_law_of_all_files_is_said_in_a_line():
    assert headline(FIT) == "constant law of 2 files, 3 points, rms 1 % in amplitude"
    assert headline(modes()).startswith(
        "constant law of 2 files, 2 modes, rms 1 % in frequency, chi² per degree"
    )
    assert count_of(FIT) == "2 files"
    assert count_of(FIT.but(files=None)) == "1 file"


@pytest.mark.parametrize(
    ("file", "owned", "said"),
    [
        (2, {2: ["added_mass"]}, "added_mass: of file 2 heavy.csv alone."),
        (0, {}, "added_mass: of all files alike."),
        (-1, {}, "added_mass: in each file its own."),
    ],
)
def test_whose_an_effect_is_is_said_by_name(file, owned, said):
    effect = EffectFound(name="added_mass", parameters=found_in(file))
    found = diagnosis().but(effects=(effect,), files=FILES)
    assert owners(found) == owned
    assert owner_lines(found) == [said]


def test_candidates_say_whose_they_are_and_none_is_among_them():
    pair = {"added_mass.mass": 0.02, "added_mass.file": 2, "gain_error.factor": 1.1, "gain_error.file": 0}
    values = {k: ParameterFound(value=v, standard_error=0.1, unit="1") for k, v in pair.items()}
    rows = [("added_mass", found_in(2), 0.9), ("added_mass + gain_error", values, 0.08), ("none", {}, 0.02)]
    candidates = [
        CandidateFitted(name=name, delta_bic=float(k), probability=p, parameters=parameters)
        for k, (name, parameters, p) in enumerate(rows)
    ]
    found = diagnosis().but(
        candidates=tuple(candidates), files=FILES, equivalent={"added_mass": ("added_mass",)}
    )
    said = [(r.name, r.file, r.probability, r.standing) for r in candidate_rows(found)]
    assert said[0] == ("added_mass", "2 heavy.csv", "90.0 %", "found")
    assert said[1][1] == "2 heavy.csv, all alike"
    assert [r.name for r in candidate_rows(found, most=1)] == ["added_mass", "none"]


def test_a_look_says_what_a_file_holds_and_what_it_was_measured_on(tmp_path):
    data = write_pair(tmp_path, "light", 0.2533)
    looked = look(PairedFile(data, data.with_suffix(".toml")))
    assert looked.specimen == "shear pair, 0.2533 kg"
    assert looked.data == "24 points, 136.1 to 907.5 Hz"


def test_a_look_at_a_damaged_file_is_refused_in_a_line(tmp_path):
    data = write_pair(tmp_path, "light", 0.2533)
    data.write_text("frequency_hz\n10\n")
    with pytest.raises(BadInput) as refused:
        look(PairedFile(data, data.with_suffix(".toml")))
    assert "\n" not in str(refused.value)


def test_readings_set_aside_are_drawn_by_themselves_and_listed_by_file():
    rest = {"segment": 1, "sweep": 1, "level_m_s2": 9.81, "measured_m_s": 0.001, "file": 1}
    aside = [PointSetAside(frequency_hz=f, why=LOST, **rest) for f in (22.0, 21.0)]
    aside.append(PointSetAside(frequency_hz=250.0, why=DISTURBED, **rest))
    one, other = fitted_files(FIT.but(points_set_aside=tuple(aside)))
    assert one.aside_hz.tolist() == [22.0, 21.0, 250.0]
    assert not other.aside_hz.size
    (row,) = left_rows([one, other], [], aside, judged=False)
    assert (row.file, row.where) == ("1 light.csv", "21 to 22")
    assert row.what.startswith("2 set aside, not fitted: far off")
