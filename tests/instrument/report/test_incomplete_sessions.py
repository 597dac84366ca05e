"""The report of a session that lacks something says what."""

import re

from report_pages import page_of, section
from session_cases import SyntheticSession, configuration

from instrument.stream.derived import LimitWarned


def made(folder, act):
    synthetic = SyntheticSession(configuration())
    synthetic.begin()
    act(synthetic)
    return page_of(synthetic.save(folder))


def test_a_run_stopped_early_says_what_it_lacks(tmp_path):
    def act(synthetic):
        synthetic.calibrate()
        synthetic.sweep(segments=(1, 2), steps=4)
        synthetic.emit(LimitWarned(12, "base travel", 4.2e-3, 5e-3, "m"))
        synthetic.end("stopped safely", "step 17: velocity 1.2 m/s, limit 1: lower the level")

    page = made(tmp_path, act)
    words = section(page, "How it ended")
    assert "The rig stopped itself: step 17: velocity 1.2 m/s, limit 1: lower the level" in words
    assert "No hammer test was made." in words
    assert "Segment 2 of sweep 1 is not complete: 4 of 9 steps measured." in words
    assert "Segment 3 of sweep 1 was not begun." in words
    assert "base travel, 0.0042 m at step 12, limit 0.005" in words
    assert "There is no hammer test" in section(page, "Hammer test of the bare plate")
    identification = section(page, "Identification of the core")
    assert "without a hammer test" in identification
    assert "The run itself made no fit" in identification


def test_a_hammer_test_alone(tmp_path):
    def act(synthetic):
        synthetic.hammer(hits=1)
        synthetic.end("stopped by the user")

    page = made(tmp_path, act)
    assert "The user stopped the run." in section(page, "How it ended")
    assert "one hit has no coherence" in section(page, "Hammer test of the bare plate")
    assert "There is no point of a sweep" in section(page, "Sweep of the damped plate")
    assert "No law could be identified: no point of a sweep" in section(page, "Identification of the core")
    assert "There is no fit" in section(page, "What the fit cannot explain")


def test_hits_that_are_all_bad(tmp_path):
    page = made(tmp_path, lambda synthetic: synthetic.hammer(hits=2, rejected=(1,)))
    words = section(page, "Hammer test of the bare plate")
    assert "by the operator" in words
    assert "No damping: no good hit" in words
    assert "ended from outside" in section(page, "How it ended")


def test_too_few_points_for_a_law(tmp_path):
    page = made(tmp_path, lambda synthetic: synthetic.sweep(segments=(1,), steps=1))
    words = section(page, "Identification of the core")
    assert "Too few points: 2 (4 numbers) for 4 parameters" in words
    assert "without bands: these points carry no standard error" in words
    assert "Segment 1 of sweep 1 is not complete: 1 of 9" in section(page, "How it ended")


def test_points_without_a_calibration_are_remarked(tmp_path):
    page = made(tmp_path, lambda synthetic: synthetic.sweep(segments=(1,), steps=3))
    assert "was not calibrated in place" in section(page, "Calibration in place")
    assert "range 5mm/s/V is not calibrated" in section(page, "Sweep of the damped plate")


def test_a_session_with_nothing_in_it(tmp_path):
    page = made(tmp_path, lambda synthetic: synthetic.end("stopped safely", "no light"))
    assert "The rig stopped itself: no light" in section(page, "How it ended")
    assert "No sweep was made." in section(page, "How it ended")
    assert re.findall(r"<figcaption>(.*?)</figcaption>", page) == ["The specimen to scale"]
