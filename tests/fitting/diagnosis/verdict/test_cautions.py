"""What is to be borne in mind beside a verdict."""

from types import SimpleNamespace as Like

import numpy as np

from fitting.diagnosis.verdict.cautions import NO_DRIFT, moved_beside, warnings_of
from fitting.effects import CATALOGUE
from fitting.identification.adjusted import Adjusted
from fitting.identification.doubt import doubts_among
from fitting.laws import LAWS
from fitting.sweep import Sweep

LAW = LAWS["fractional-zener"](1e6, 3e7, 1e-4, 0.6)
PARTS = np.repeat([1, 2, 3], 20)
SWEEP = Sweep(np.linspace(11.0, 70.0, 60), np.ones(60, complex), np.ones(60), PARTS, PARTS)
SEARCH = Like(problem=Like(points=Like(timed=True), sweep=SWEEP), stated=LAW, work=Like(parts=PARTS))


def said_of(too_large, *effects):
    accepted = Like(names=("core_thickness",), fitted=Like(law=LAW, effects=effects), too_large=too_large)
    judgement = Like(accepted=accepted, equivalent={}, group=(), by_hand=False)
    return warnings_of(SEARCH, judgement)


def test_an_effect_that_ends_where_no_more_of_it_is_plausible_leaves_its_law_in_doubt():
    assert said_of("") == ()
    (said,) = said_of("core_thickness")
    assert said.startswith("core_thickness ends at the limit of what is plausible")
    assert doubts_among([said])


def test_a_stated_number_far_outside_its_tolerance_leaves_what_is_named_in_doubt():
    numbers = [
        Adjusted(f"mass [{k}]", 0.4, 0.004, 0.4, 0.001, pull, "kg") for k, pull in ((1, -2.7), (2, 6.6))
    ]
    (said,) = moved_beside("effect", numbers)
    assert "mass [2] by +6.6" in said
    assert "mass [1]" not in said
    assert doubts_among([said])
    assert moved_beside("none", numbers[:1]) == ()
    assert moved_beside("unknown", numbers) == ()


def test_what_a_mass_leaves_out_is_said_and_is_no_doubt_by_itself():
    mass, pair = (CATALOGUE["added_mass"].on(kind) for kind in ("plate", "shear-pair"))
    (said,) = said_of("", mass)
    assert said.startswith("a mass is taken for a point: a tape or a strip")
    assert not doubts_among([said])
    assert said_of("", pair) == ()
    assert "stiffens the beam as well" in CATALOGUE["added_mass"].on("beam").caution


def test_of_a_sweep_in_one_piece_it_is_said_what_is_held_out():
    alone = Sweep(SWEEP.frequency_hz, SWEEP.velocity_m_s, np.ones(60), np.ones(60, int), PARTS)
    search = Like(problem=Like(points=Like(timed=True), sweep=alone), stated=LAW, work=Like(parts=PARTS))
    (said,) = warnings_of(search, Like(accepted=None, equivalent={}, group=(), by_hand=False))
    assert said.endswith("segments 1 to 3 are its stretches of 11 to 30, 31 to 50, 51 to 70 Hz")


def test_what_follows_from_times_is_named_with_a_caution_or_said_not_to_have_been_looked_for():
    drift = CATALOGUE["temperature_drift"]
    untimed = Like(points=Like(timed=False), sweep=SWEEP, files_without_time=())
    named = Like(accepted=None, equivalent={drift.name: (drift.name,)}, group=(), by_hand=False)
    nothing = Like(accepted=None, equivalent={}, group=(), by_hand=False)
    asked = Like(problem=untimed, stated=LAW, work=Like(parts=PARTS), effects=[drift], objected=())
    assert warnings_of(asked, named)[0].endswith("the drift assumes an even sweep upwards in frequency")
    assert warnings_of(asked, nothing) == ()
    objecting = Like(**{**vars(asked), "effects": [], "objected": (drift,)})
    assert warnings_of(objecting, nothing)[0] == NO_DRIFT
    without = Like(**{**vars(asked), "effects": [], "objected": (CATALOGUE["gain_error"],)})
    assert warnings_of(without, nothing) == ()


def test_of_several_files_it_is_said_which_carry_no_time():
    drift = CATALOGUE["temperature_drift"]
    nothing = Like(accepted=None, equivalent={}, group=(), by_hand=False)

    def said(*lacking):
        problem = Like(points=Like(timed=False), sweep=SWEEP, files_without_time=lacking)
        search = Like(problem=problem, stated=LAW, work=Like(parts=PARTS), effects=[], objected=(drift,))
        return warnings_of(search, nothing)[0]

    assert said(2) == f"file 2: {NO_DRIFT}"
    assert said(2, 3) == f"files 2, 3: {NO_DRIFT}"
