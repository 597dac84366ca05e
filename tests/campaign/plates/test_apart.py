"""Groups told apart by what is proposed: rigs that are measured again, and what is said of them."""

import json
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
from click.testing import CliRunner

from campaign.__main__ import campaign
from campaign.law import TrueLaw
from campaign.plates import apart, kept, remeasured, weak_effects
from campaign.plates.cases import PlateTruth, measured
from campaign.plates.channel import ChannelError
from campaign.plates.geometry import plate_named
from campaign.plates.grid import Fineness
from campaign.plates.hidden import HIDDEN
from campaign.plates.hidden.clamp import (
    HiddenClampCompliance,
    HiddenClampFriction,
    HiddenClampLine,
)
from campaign.plates.noise import draw_noise
from campaign.plates.remeasured import RemeasuredPlate
from campaign.plates.simulate import built, moduli_of, reading
from campaign.plates.stated import specimen_from, toml
from campaign.plates.struck import struck_plate
from campaign.run import Job
from campaign.schedule import Schedule
from fitting.gravity import PUBLISHED_G_M_S2
from instrument.facts.follow_up import FollowUp
from instrument.models.files import File

COARSE = Fineness(5, 3, (0.5, 2.0), (1.0,))
MODULI = (0.3e6, 1e6, 4e6)
P2 = plate_named("P2")
LAW = TrueLaw("fractional-zener", (0.35e6, 6e6, 1e-4, 0.6))
CLAMP = HiddenClampCompliance(3e13, 3e13, 4, 0.02, 0.4)
OFFSET_M = 3e-3


@pytest.fixture(scope="module", autouse=True)
def _coarse(tmp_path_factory):
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("VISCORIG_CACHE", str(tmp_path_factory.mktemp("cache")))
        patch.setattr(kept, "Fineness", lambda: COARSE)
        patch.setattr(kept, "MODULI_PA", MODULI)
        patch.setattr(remeasured, "built", lambda *given: built(*given, COARSE))
        patch.setattr(remeasured, "_models", lambda plate, spot_mm: None)
        patch.setattr(remeasured, "_struck_models", lambda *given, **more: None)
        patch.setattr(
            remeasured, "struck_plate", lambda *given, **more: struck_plate(*given, **more, fineness=COARSE)
        )
        kept.clean_plate.cache_clear()
        yield
        kept.clean_plate.cache_clear()


def rig(*effects):
    f = np.linspace(20.0, 26.0, 8)
    one = np.ones(8, np.intp)
    schedule = Schedule(f, one, one, np.full(8, 1.0), np.arange(8.0))
    noise = draw_noise(np.random.default_rng(0))
    truth = PlateTruth(P2, effects, LAW, noise, ChannelError(), (23.0,), 0.1)
    plate = built(P2, effects, moduli_of(LAW, f), COARSE)
    sweep = measured(truth, plate, schedule, np.random.default_rng(1))
    return RemeasuredPlate(truth, schedule, (File(sweep, specimen_from(toml(P2, None, 100.0))),), None, 7.0)


def proposed(kind, **more):
    given = {
        "kind": kind,
        "needs_hands": True,
        "frequencies_hz": (21.0, 22.0),
        "segments": (1, 1),
        "level_g": 1.0,
        "seconds": 300.0,
        "separation": 4.0,
        "probability_resolved": 0.9,
        "between": ("none", "gain_error"),
        "why": "",
        "todo": "",
    }
    return FollowUp.model_validate(given | more)


def rng():
    return np.random.default_rng(5)


def test_clamped_anew_is_a_file_of_its_own_whose_clamp_gives_more(monkeypatch):
    built_as = []
    monkeypatch.setattr(
        remeasured,
        "built",
        lambda plate, hidden, moduli: built_as.append(hidden) or built(plate, hidden, moduli, COARSE),
    )
    two = rig(CLAMP).after(proposed("clamping"), rng())
    assert [f.number for f in two.files] == [1, 2]
    assert len(two.files[1].sweep) == 2
    ((clamp, line),) = built_as
    # A fifth of the torque, to a power between 0.4 and 1, and some scatter.
    assert 0.1 < clamp.along_x_n_m3 / CLAMP.along_x_n_m3 < 0.8
    assert isinstance(line, HiddenClampLine)
    assert 0 < abs(line.longer_m) < 4e-4
    # The next one begins from the first clamp again.
    assert two.truth.effects == (CLAMP,)


def test_clamped_anew_the_laser_may_be_aimed_elsewhere():
    two = rig(CLAMP).after(proposed("clamping", spot_mm=(200.0, 50.0)), rng())
    assert [(f.number, f.pickup) for f in two.files] == [(1, 0), (2, 1)]
    assert [f.specimen.pickup_m for f in two.files] == [
        two.files[0].specimen.pickup_m,
        pytest.approx((0.2, 0.05)),
    ]
    first, anew = (np.abs(f.sweep.velocity_m_s[0]) for f in two.files)
    assert anew > 1.5 * first


def test_a_spot_beside_another_mounting_is_a_spot_of_the_first_one():
    three = (
        rig(CLAMP).after(proposed("clamping"), rng()).after(proposed("spot", spot_mm=(200.0, 50.0)), rng())
    )
    assert [(f.number, f.pickup) for f in three.files] == [(1, 0), (2, 0), (1, 1)]
    assert three.files[2].specimen.pickup_m == pytest.approx((0.2, 0.05))


def test_more_steps_join_the_first_file_and_a_mass_has_one_of_its_own():
    more = rig().after(proposed("level", level_g=0.5), rng())
    (file,) = more.files
    assert file.sweep.commanded_m_s2[-2:] == pytest.approx([0.5 * PUBLISHED_G_M_S2] * 2)
    assert len(file.sweep) == 10
    heavier = more.after(proposed("added_mass", mass_kg=5e-3, mass_at_mm=(300.0, 50.0)), rng())
    assert [len(f.specimen.masses) for f in heavier.files] == [0, 1]
    light, heavy = (np.abs(f.sweep.velocity_m_s[:1]) for f in heavier.files)
    assert heavy != pytest.approx(light, rel=0.01)
    with pytest.raises(ValueError, match="damped_struck"):
        more.after(proposed("damped_struck"), rng())


HELD = {"struck_mm": (300.0, 160.0), "frequencies_hz": (), "segments": ()}


def test_struck_in_its_clamp_it_is_a_file_beside_the_first_whatever_was_clamped_since():
    clamped = rig(CLAMP).after(proposed("clamping"), rng())
    three = clamped.after(proposed("damped_struck", held="clamped", **HELD), rng())
    assert [(f.number, f.specimen.drive, f.specimen.boundary) for f in three.files] == [
        (1, "base", "cantilever"),
        (3, "force", "cantilever"),
        (2, "base", "cantilever"),
    ]
    first, hit, _ = three.files
    assert hit.specimen.pickup_m == first.specimen.pickup_m
    assert hit.specimen.force_m == pytest.approx((0.3, 0.16))
    assert hit.specimen.tolerances["gain"] == 0.01
    assert hit.sweep.frequency_hz.tolist() == first.sweep.frequency_hz.tolist()
    # The same plate in the same clamp: it rings where it rang.
    v = [np.abs(f.sweep.response_m_s) for f in (first, hit)]
    assert abs(int(np.argmax(v[0] * first.sweep.frequency_hz)) - int(np.argmax(v[1]))) <= 1


def test_hung_free_it_has_left_its_clamp_and_is_read_about_its_own_resonances():
    f = np.linspace(20.0, 200.0, 8)
    one = rig(CLAMP, HIDDEN["added_mass"](0.01, 0.3, 0.15, 8e-3))
    one = replace(one, schedule=replace(one.schedule, frequency_hz=f))
    offer = proposed("damped_struck", held="free", spot_mm=(16.0, 18.0), **HELD)
    _, hit = one.after(offer, rng()).files
    assert (hit.number, hit.pickup) == (2, None)
    assert (hit.specimen.boundary, hit.specimen.modal_ratios) == ("free", ())
    assert hit.specimen.pickup_m == pytest.approx((0.016, 0.018))
    assert set(np.bincount(hit.sweep.segment).tolist()) == {20}
    assert hit.sweep.frequency_hz.min() > 60
    # A clamp that it has left changes nothing of it, a mass does.
    other = replace(one, truth=replace(one.truth, effects=one.truth.effects[1:])).after(offer, rng()).files[1]
    assert other.sweep.velocity_m_s == pytest.approx(hit.sweep.velocity_m_s)
    bare = replace(one, truth=replace(one.truth, effects=())).after(offer, rng()).files[1]
    assert np.abs(bare.sweep.frequency_hz / hit.sweep.frequency_hz - 1).max() > 0.002


def test_a_clamp_that_rubs_takes_energy():
    f = np.linspace(18.0, 28.0, 60)
    one = np.ones(60, np.intp)
    schedule = Schedule(f, one, one, np.full(60, 1e-6), np.arange(60.0))
    rubs = HiddenClampFriction(**CLAMP.facts, loss=0.5)
    peaks = []
    for hidden in (CLAMP, rubs):
        plate = built(P2, (hidden,), moduli_of(LAW, f), COARSE)
        v = np.abs(reading(plate, P2, (hidden,), LAW, schedule, ChannelError()))
        peaks.append((v.max(), f[np.argmax(v)]))
    assert peaks[1][0] < 0.98 * peaks[0][0]
    assert peaks[1][1] == pytest.approx(peaks[0][1], rel=0.01)


def test_every_kind_has_a_weak_effect_and_a_segment_has_forty_points_at_the_highest_level():
    for kind in weak_effects.WEAK:
        assert weak_effects.weak(kind, rng(), P2).name == kind
    segment = np.repeat([1, 1, 2], [100, 100, 30])
    level = np.repeat([9.81, 2.0, 9.81], [100, 100, 30])
    at = weak_effects._thinned(segment, level)
    assert np.bincount(segment[at]).tolist() == [0, 40, 30]
    assert level[at].min() == 9.81
    assert {0, 99, 200, 229} <= set(at.tolist())


def found(verdict, *names, group=()):
    effects = [SimpleNamespace(name=n) for n in names]
    rivals = SimpleNamespace(names=tuple(n for n, _ in group), each=tuple((None, p) for _, p in group))
    return SimpleNamespace(
        result=SimpleNamespace(verdict=verdict, effects=effects, rivals=rivals if group else None)
    )


class Told:
    """A rig of which diagnoses are known beforehand."""

    seconds = 80.0
    truth = SimpleNamespace(names=("gain_error",), facts={"plate": "P2", "effects": {"gain_error": {}}})

    def __init__(self, *said):
        self.said = said

    def diagnosed(self):
        return self.said[0]

    def after(self, follow_up, rng):
        return Told(*self.said[1:])


GROUP = found("ambiguous", "gain_error", group=(("gain_error", 0.6), ("spot_offset", 0.395), ("none", 0.005)))
RIGHT, WRONG = found("effect", "gain_error"), found("effect", "spot_offset")


def judged(monkeypatch, *said, asked=None):
    monkeypatch.setattr(apart, "draw_weak", lambda kind, seed: Told(*said))
    spot = proposed("spot", spot_mm=(200.0, 50.0), todo="Aim there.")

    def ranked(diagnosed, possible):
        if asked is not None:
            asked.append(possible.measurements)
        return (spot,) if diagnosed.result.verdict == "ambiguous" else ()

    monkeypatch.setattr(apart, "rank_follow_ups", ranked)
    return apart.judge_apart(Job("gain_error", 1))


def test_what_is_proposed_is_measured_until_one_is_left_and_twice_at_most(monkeypatch):
    assert judged(monkeypatch, RIGHT)["measured"] == []
    one = judged(monkeypatch, GROUP, RIGHT)
    assert [m["said"] for m in one["measured"]] == ["right"]
    assert one["measured"][0]["probability_resolved"] == 0.9
    assert (one["measured"][0]["steps"], one["measured"][0]["todo"]) == (2, "Aim there.")
    asked = []
    never = judged(monkeypatch, GROUP, GROUP, GROUP, GROUP, asked=asked)
    assert [m["said"] for m in never["measured"]] == ["ambiguous", "ambiguous"]
    # The second time nothing can follow.
    assert asked == [2, 1]
    json.dumps([one, never])


def test_a_certain_wrong_name_is_told_from_a_group_that_stays(monkeypatch, tmp_path):
    lines = [
        judged(monkeypatch, RIGHT),
        judged(monkeypatch, GROUP, GROUP, RIGHT),
        judged(monkeypatch, GROUP, WRONG),
        judged(monkeypatch, GROUP, GROUP, GROUP),
    ]
    text = apart.write_apart_summary(lines, tmp_path)
    assert (tmp_path / "summary.md").read_text() == text
    assert "4 cases; 1 right after one sweep; 3 groups: 1 ambiguous, 1 right, 1 wrong." in text
    assert (
        "median 600 s, longest 600 s. Of 5 measurements 4.5 were foretold to settle the matter, 2 did."
        in text
    )
    assert "| gain_error | ambiguous: gain_error 0.60, spot_offset 0.40 | spot, 300 s | 0.90 |" in text
    assert "| spot_offset: wrong |" in text


def test_the_command_draws_kinds_in_turn_and_refuses_those_that_it_has_not(monkeypatch, tmp_path):
    asked = []
    monkeypatch.setattr("campaign.__main__.run_apart", lambda jobs, *a, **k: asked.extend(jobs) or [])
    monkeypatch.setattr("campaign.__main__.write_apart_summary", lambda *a: "said")
    result = CliRunner().invoke(campaign, ["apart", str(tmp_path), "--count", "8", "--seed", "3"])
    assert result.output.strip() == "said"
    assert [job.kind for job in asked] == [*weak_effects.WEAK, weak_effects.WEAK[0]]
    assert [job.seed for job in asked] == list(range(3, 11))
    refused = CliRunner().invoke(campaign, ["apart", str(tmp_path), "--kind", "mains_hum"])
    assert refused.exit_code != 0
