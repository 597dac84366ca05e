"""An effect among files and spots: in all alike, in one, in each of its own size."""

from types import SimpleNamespace

import numpy as np
import pytest

from fitting.diagnosis.several.among import among
from fitting.diagnosis.several.of_files import EACH, OfFiles, Place, copies_of, inner_of, own_unknowns
from fitting.effects import CATALOGUE

CLAMP, GAIN, STIFFNESS = (CATALOGUE[n] for n in ("clamp_compliance", "gain_error", "substrate_stiffness"))
LINE = CATALOGUE["clamp_line"]


def test_a_clamp_may_be_another_one_in_each_file():
    forms = among(CLAMP, 2, ()).variants()
    assert [f.file for f in forms] == [0, 1, 2, EACH]
    each = forms[-1]
    assert [q.key for q in each.parameters] == ["k", "k_2", "file"]
    assert each.places(Place(1)).tolist() == [0]
    assert each.places(Place(2)).tolist() == [1]
    assert each.holds(Place(2))


def test_what_goes_with_time_goes_otherwise_in_every_file():
    forms = among(CATALOGUE["temperature_drift"], 2, ()).variants()
    # What settles, what steps in a pause, what cycles, and what cycles unevenly.
    assert [f.file for f in forms] == [f for f in (0, 1, 2, EACH) for _ in range(4)]
    each = forms[-4]
    assert [q.key for q in each.parameters] == [
        "warming",
        "time_constant",
        "warming_2",
        "time_constant_2",
        "file",
    ]
    assert [(t.first, t.other) for t in each.ties] == [(0, 2), (1, 3)]


def test_a_clamp_line_hardly_moves_from_file_to_file_and_a_clamps_stiffness_does():
    line, clamp = OfFiles(LINE, 3, EACH), OfFiles(CLAMP, 3, EACH)
    assert [(t.first, t.other) for t in line.ties] == [(0, 2), (0, 4)]
    assert [(t.first, t.other) for t in clamp.ties] == [(0, 1), (0, 2)]
    # Metres and a logarithm: a root of 1 mm of give is 1 mm longer by a factor e, the line by 0.3 mm.
    assert {t.sigma for t in line.ties} == {3e-4}
    assert {t.sigma for t in clamp.ties} == {1.0}
    assert OfFiles(LINE, 3, 2).ties == OfFiles(LINE, 3).ties == ()


def test_a_clamp_of_each_file_starts_scales_and_is_limited_file_by_file():
    each = OfFiles(CLAMP, 2, EACH)
    start = each.starts(None, None)[0]
    assert start.tolist() == [5e13, 5e13, EACH]
    # Twice as strong is half as stiff.
    assert each.scaled(start, 2.0).tolist() == [2.5e13, 2.5e13, EACH]
    low, high = each.limits(None)
    assert low.tolist() == [1e12, 1e12, EACH]
    assert high.tolist() == [1e16, 1e16, 2]


def test_what_is_of_the_plate_is_in_all_files_of_one_plate():
    assert [f.file for f in among(STIFFNESS, 2, (), one_plate=True).variants()] == [0]
    assert [f.file for f in among(CLAMP, 2, (), one_plate=True).variants()] == [0, EACH]
    assert [f.file for f in among(STIFFNESS, 2, ()).variants()] == [0, 1, 2]


def test_one_channel_is_rarely_wrong_at_one_spot_alone():
    forms = among(GAIN, 1, (0, 1)).variants()
    assert [f.spot for f in forms] == [-1, 0, 1]
    assert forms[0].chance == GAIN.chance
    assert forms[1].chance == pytest.approx(GAIN.chance / 30)
    spot = among(CATALOGUE["spot_offset"], 1, (0, 1)).variants()
    assert {f.chance for f in spot} == {CATALOGUE["spot_offset"].chance}


def test_what_is_on_a_plate_is_seldom_on_it_in_one_file_alone():
    mass = CATALOGUE["added_mass"]
    chances = {f.file: f.chance for f in among(mass, 2, (), one_plate=True).variants()}
    assert chances == pytest.approx({0: mass.chance, 1: mass.chance / 30, 2: mass.chance / 30})
    assert {f.chance for f in among(mass, 2, ()).variants()} == {mass.chance}
    # A channel or a room may be another one on another day.
    assert {f.chance for f in among(GAIN, 2, (), one_plate=True).variants()} == {GAIN.chance}


def test_a_hammer_test_is_of_the_first_files_plate():
    class Bare:
        lowering_per_density = np.zeros(3)

    everywhere, second = OfFiles(STIFFNESS, 2, 0), OfFiles(STIFFNESS, 2, 2)
    assert everywhere.bare_shift(Bare, np.array([1.1, 0.0])) == pytest.approx(0.5 * np.log(1.1) * np.ones(3))
    assert second.bare_shift(Bare, np.array([1.1, 2.0])) == pytest.approx(np.zeros(3))


def test_a_spot_may_be_off_once_where_the_laser_is_aimed_at_it_in_every_file():
    forms = among(CATALOGUE["spot_offset"], 2, (0, 1)).variants()
    once = [f for f in forms if f.file == 1 and f.spot == 0]
    assert len(once) == 1
    assert [once[0].holds(Place(*p)) for p in ((1, 0), (1, 1), (2, 0))] == [True, False, False]
    u = dict(zip((q.key for q in once[0].parameters), (1e-3, 0.0, 1.0, 0.0), strict=True))
    assert once[0].story(u).startswith("in file 1 at pickup 0")
    assert not [f for f in among(GAIN, 2, (0, 1)).variants() if f.file == 1 and f.spot == 0]


def test_what_an_effect_contains_it_contains_in_each_file():
    uneven, masses = OfFiles(CATALOGUE["uneven_clamp"], 2, EACH), OfFiles(CATALOGUE["added_masses"], 3, 2)
    ((clamp, u),) = uneven.within(np.array([3e13, 2.0, 4e13, 0.7, EACH]))
    assert (clamp.name, clamp.file, clamp.files) == ("clamp_compliance", EACH, 2)
    assert u.tolist() == [3e13, 4e13, EACH]
    found = masses.within(np.array([1e-3, 0.1, 0.0, 2e-3, 0.2, 0.0, 2.0]))
    assert [(e.name, e.file, u.tolist()) for e, u in found] == [
        ("added_mass", 2, [1e-3, 0.1, 0.0, 2.0]),
        ("added_mass", 2, [2e-3, 0.2, 0.0, 2.0]),
    ]
    assert OfFiles(GAIN, 2).within(np.array([1.01, 0.0])) == ()


def test_what_has_a_meaning_in_one_file_alone_is_of_that_file():
    # Shaken, and hung free: there is a clamp and a base in the first alone.
    for name in ("clamp_compliance", "base_rocking"):
        (form,) = among(CATALOGUE[name], 2, (), one_plate=True, mounted=(1, 0)).variants()
        assert (form.file, form.chance) == (1, CATALOGUE[name].chance)
        assert [form.holds(Place(k)) for k in (1, 2)] == [True, False]


def test_a_clamp_is_one_in_all_files_of_one_mounting():
    # Shaken, struck in the same clamp, hung free, clamped anew.
    forms = among(CLAMP, 4, (), mounted=(1, 1, 0, 4)).variants()
    assert [f.file for f in forms] == [0, 1, 4, EACH]
    held = {f.file: [f.holds(Place(k)) for k in (1, 2, 3, 4)] for f in forms}
    assert held[0] == held[EACH] == [True, True, False, True]
    assert held[1] == [True, True, False, False]
    each = forms[-1]
    assert [q.key for q in each.parameters] == ["k", "k_4", "file"]
    assert [each.places(Place(k)).tolist() for k in (1, 2, 4)] == [[0], [0], [1]]
    assert each.story({"k": 5e13, "k_4": 5e13, "file": EACH}).startswith("in every file where it can be")
    # A channel is another matter in each.
    assert [f.file for f in among(GAIN, 4, (), mounted=(1, 1, 3, 4)).variants()] == [0, 1, 2, 3, 4]


def test_what_a_channel_shows_by_itself_is_said_of_its_spot_or_file():
    lost, seen = CATALOGUE["signal_dropout"], {"readings": 1.0, "size": 1e-3}
    of_spot, of_both = OfFiles(lost, 1, spots=(0, 1)), OfFiles(lost, 2, spots=(0, 1))
    assert of_spot.story({**seen, "pickup": 1.0}).startswith("at pickup 1 one reading")
    assert of_both.story({**seen, "file": 2.0, "pickup": 0.0}).startswith("in file 2 at pickup 0 one reading")


def test_another_place_is_one_in_every_file():
    part, plate = CATALOGUE["loose_part"], SimpleNamespace(length_m=0.3, width_m=0.2)
    u = np.array([1e-3, 90.0, 0.05, 0.1, 0.1])
    form = OfFiles(part, 3)
    assert form.sharp
    found = form.elsewhere(plate, np.append(u, 0.0))
    assert len(found) == len(part.elsewhere(plate, u)) > 5
    assert all(one[-1] == 0.0 and (one[:3] == u[:3]).all() for one in found)
    assert not OfFiles(CATALOGUE["gain_error"], 2).elsewhere(plate, np.array([1.0, 0.0]))


def test_two_masses_count_for_two_causes_among_files_too():
    forms = among(CATALOGUE["added_masses"], 2, ()).variants()
    assert {e.causes for e in forms} == {2}


def test_what_is_of_one_segment_is_so_at_several_spots():
    assert OfFiles(CATALOGUE["segment_gain"], 1, spots=(0, 1)).of_a_segment


def test_a_drift_too_fast_to_believe_in_any_file_is_beyond():
    drift = CATALOGUE["temperature_drift"]
    calm, wild = np.array([1.0, 600.0]), np.array([20.0, 1.0])
    each = OfFiles(drift, 2, EACH)
    assert drift.is_beyond(wild)
    assert each.is_beyond(np.array([*calm, *wild, EACH]))
    assert not each.is_beyond(np.array([*calm, *calm, EACH]))
    assert OfFiles(drift, 2, 2).is_beyond(np.array([*wild, 2]))


def test_a_part_that_swings_between_the_points_of_all_files_is_not_shown_by_itself():
    part = CATALOGUE["loose_part"].variants()[0]
    points = SimpleNamespace(omega=2 * np.pi * np.linspace(50.0, 60.0, 101))
    frequency = [q.key for q in part.parameters].index("frequency")
    seen = np.array([q.typical for q in part.parameters])
    seen[frequency] = 55.0
    unseen = seen.copy()
    unseen[frequency] = 90.0
    poles = np.empty(0, complex)
    common = OfFiles(part, 2)
    assert common.shows(points, poles, np.append(seen, 0.0))
    assert not common.shows(points, poles, np.append(unseen, 0.0))
    each = OfFiles(part, 2, EACH)
    assert each.shows(points, poles, np.array([*unseen, *seen, EACH]))


def test_an_effect_s_own_unknowns_are_those_of_its_place_or_none():
    each, second = OfFiles(CLAMP, 2, EACH), OfFiles(CLAMP, 2, 2)
    assert own_unknowns(each, Place(2)).tolist() == [1]
    assert own_unknowns(second, Place(1)) is None
    assert own_unknowns(CLAMP, Place(2)).tolist() == [0]
    assert inner_of(second) is inner_of(CLAMP) is CLAMP


def test_an_effect_has_the_unknowns_of_the_inner_one_once_for_each_size():
    assert [own.tolist() for own in copies_of(OfFiles(LINE, 2, EACH))] == [[0, 1], [2, 3]]
    assert [own.tolist() for own in copies_of(OfFiles(LINE, 2, 2))] == [[0, 1]]
    assert [own.tolist() for own in copies_of(LINE)] == [[0, 1]]
