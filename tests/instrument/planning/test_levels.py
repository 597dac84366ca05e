"""Which level is proposed, which steps complete a plan, and the [sweep] it becomes."""

from dataclasses import dataclass, field, replace
from types import SimpleNamespace

import numpy as np
import pytest
from planning_cases import aims, sensitivity

from instrument.errors import BadInput
from instrument.facts.plan import PlannedStep
from instrument.files.new_file import write_new
from instrument.files.specimen_file import read_specimen
from instrument.paper_case import case_file
from instrument.planning.into_experiment import begun, without_sweep, write_into
from instrument.planning.levels import at_level, chosen_level, levels_of
from instrument.planning.outlook import usual_band, visible
from instrument.planning.plan import LEAST_A_REGION, catalogue, completed, counted
from instrument.planning.result import sweep_toml
from instrument.planning.wish import LEVELS_G, Wish


def level(level_g, seconds, worst, *, reached=True, why_not=""):
    choice = SimpleNamespace(worst=np.array([1.0, worst]), seconds=np.array([0.0, seconds]), reached=reached)
    return SimpleNamespace(level_g=level_g, choice=choice, why_not=why_not)


def test_the_lowest_level_is_driven_that_takes_hardly_longer():
    assert chosen_level([level(0.1, 300, 0.02), level(0.5, 109, 0.02), level(1, 100, 0.02)]).level_g == 0.5


def test_a_level_that_the_rig_cannot_drive_is_not_chosen_while_another_can():
    levels = [level(0.1, 300, 0.02), level(1, 100, 0.02, why_not="travel")]
    assert chosen_level(levels).level_g == 0.1
    assert chosen_level(levels[1:]).level_g == 1


def test_where_no_level_reaches_the_target_the_least_error_counts_before_time():
    levels = [level(0.1, 50, 0.10, reached=False), level(1, 100, 0.05, reached=False)]
    assert chosen_level(levels).level_g == 1


@dataclass
class Still:
    """A plate seen at a few candidates, its readings as of 1 m/s^2."""

    band_hz: tuple = (10.0, 100.0)
    candidates: SimpleNamespace = field(
        default_factory=lambda: SimpleNamespace(
            seconds=np.ones(4), dwell_s=np.ones(4), region=np.array([1, 1, 2, 2])
        )
    )

    def sensitivity(self, level_m_s2, noise):
        s = replace(sensitivity([1e3, 2e3, 2e3, 1e3]), velocity_m_s=0.01 * np.ones(4, complex))
        return s.with_noise(noise.std_m_s(s.velocity_m_s, np.ones(4)))


def test_velocity_grows_with_the_level_and_noise_not_below_its_floor():
    wish = Wish()
    one = Still().sensitivity(1.0, wish.noise)
    high = at_level(one, Still(), wish, 1.0)
    assert np.abs(high.velocity_m_s) == pytest.approx(0.01 * 9.81, rel=1e-3)
    assert one.sigma_m_s[0] < high.sigma_m_s[0] < 9.8 * one.sigma_m_s[0]
    # The same readings, less noisy in proportion.
    ratio = 9.80665 * one.sigma_m_s / high.sigma_m_s
    assert high.rows == pytest.approx(ratio[:, None, None] * one.rows, rel=1e-3)


def test_a_level_beyond_the_travel_of_the_base_is_listed_with_its_reason():
    found = levels_of(Still(), aims(), Wish())
    assert [x.level_g for x in found] == list(LEVELS_G)
    reasons = [x.why_not for x in found]
    # 9.81 m/s^2 at 10 Hz is 2.48 mm, of which 4 mm are near the limit of 5.
    assert reasons[:4] == ["", "", "", ""]
    assert reasons[4].startswith("travel of the base 4.97 mm, limit 5 mm")
    (one,) = levels_of(Still(), aims(), Wish(level_g=0.3))
    assert one.level_g == 0.3


def test_a_plan_has_both_ends_and_enough_of_every_region_the_loudest_first():
    n = 20
    region = np.repeat([1, 2], 10)
    outlook = SimpleNamespace(candidates=type("C", (), {"region": region, "__len__": lambda _: n})())
    loud = SimpleNamespace(velocity_m_s=np.arange(n) + 1.0, sigma_m_s=np.ones(n))
    found = completed(np.array([3, 3, 4]), outlook, loud).tolist()
    assert found[:4] == [3, 4, 0, 19]
    assert sorted(found[4:]) == [8, 9, 15, 16, 17, 18]
    assert [sum(region[found] == r) for r in (1, 2)] == [LEAST_A_REGION] * 2
    assert counted(5, [0, 3, 3]).tolist() == [1, 0, 0, 2, 0]


def test_what_a_plan_forecasts_is_in_the_order_of_names():
    plate = read_specimen(case_file("zn1.toml"))
    names = [e.name for e in catalogue(plate)]
    assert names == sorted(names)
    assert {"added_mass", "base_roll", "graded_core"} <= set(names)
    free = replace(plate, boundary="free", force_m=(0.02, 0.02), both_sides=True)
    struck = {e.name for e in catalogue(free)}
    assert not struck & {"base_roll", "graded_core", "clamp_compliance"}
    assert "added_mass" in struck


def setup(displacement):
    """A plate that answers so, per frequency in Hz."""
    reduced = SimpleNamespace(displacement=lambda omega, _: displacement(omega / 2 / np.pi) / omega)
    core = SimpleNamespace(law=SimpleNamespace(modulus=lambda omega: omega))
    return SimpleNamespace(reduced=reduced, specimen=SimpleNamespace(core=core))


def test_a_usual_band_is_around_the_first_three_resonances_that_the_spot_sees():
    poles = np.array([20, 50, 100, 200, 400]) * (1 + 0.05j)
    blind_at_50 = setup(lambda f: np.where(np.isclose(f, 50), 1e-3, 1.0))
    assert visible(blind_at_50, poles).tolist() == [True, False, True, True, True]
    assert visible(blind_at_50, poles[:0]).tolist() == []
    # 2.6 times the loss factor's half, 13 %, beyond the outer ones.
    assert usual_band(blind_at_50, poles) == (17.4, 226.0)


STEPS = tuple(
    PlannedStep(frequency_hz=f, segment=k, seconds=1.0, teaches="law")
    for f, k in ((20.5, 1), (22.0, 1), (100.0, 2))
)


def test_a_plan_takes_the_place_of_an_experiments_sweep_and_leaves_the_rest(tmp_path):
    path = tmp_path / "experiment.toml"
    write_new("experiment", path)
    before = path.read_text()
    write_into(path, begun(path, tmp_path / "specimen.toml"), sweep_toml(STEPS, 0.5))
    after = path.read_text()
    assert without_sweep(after).rstrip() == without_sweep(before).rstrip()
    assert after.endswith(
        "[sweep]\nlevel_g = 0.5\n\n[[sweep.segments]]\nfrequencies_hz = [20.5, 22]\n\n"
        "[[sweep.segments]]\nfrequencies_hz = [100]\n"
    )


def test_a_new_experiment_names_the_specimen_from_its_own_folder(tmp_path):
    (tmp_path / "runs").mkdir()
    text = begun(tmp_path / "runs" / "e.toml", tmp_path / "plates" / "p.toml")
    assert 'specimen = "../plates/p.toml"' in text
    with pytest.raises(BadInput, match="no such folder to write to"):
        begun(tmp_path / "nowhere" / "e.toml", tmp_path / "p.toml")
