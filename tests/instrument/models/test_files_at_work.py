"""Which points of files take part, and what is said of what they are worth."""

import numpy as np
import pytest
from shear_pair_cases import pair, sweep

from fitting.diagnosis.glitch import Glitch
from instrument.models.files import File
from instrument.models.files_at_work import FilesAtWork, SetAside
from instrument.progress import quiet

FILES = [File(sweep(pair(m), points=30), pair(m), name) for m, name in ((0.2533, "a.csv"), (0.573, "b.csv"))]


def test_stretches_of_one_file_that_touch_are_one():
    work = FilesAtWork(FILES, quiet, with_effects=False)
    for one in ((1, 100.0, 120.0, 10), (1, 121.0, 130.0, 30), (1, 200.0, 210.0, 5), (2, 118.0, 125.0, 5)):
        file, low_hz, high_hz, points = one
        work._add(SetAside(file, Glitch(low_hz, high_hz, 1e-3 * points, 1e-4 * points), points))
    assert [(s.file, s.glitch.low_hz, s.glitch.high_hz, s.points) for s in work.aside] == [
        (1, 100.0, 130.0, 40),
        (1, 200.0, 210.0, 5),
        (2, 118.0, 125.0, 5),
    ]
    whole = work.aside[0]
    assert whole.glitch.largest == 0.03
    # By the points that each had.
    assert whole.glitch.rms**2 * 40 == pytest.approx(10 * 1e-3**2 + 30 * 3e-3**2)
    assert whole.words(FILES).startswith("a.csv: 100 to 130 Hz is a local disturbance (up to 3 %)")


def test_a_stretch_between_two_joins_both():
    work = FilesAtWork(FILES, quiet, with_effects=False)
    for low_hz, high_hz in ((100.0, 120.0), (200.0, 240.0), (121.0, 195.0)):
        work._add(SetAside(1, Glitch(low_hz, high_hz, 0.01, 0.001), 10))
    assert [(s.glitch.low_hz, s.glitch.high_hz, s.points) for s in work.aside] == [(100.0, 240.0, 30)]


def test_two_lobes_of_one_disturbance_are_one_stretch():
    work = FilesAtWork(FILES, quiet, with_effects=False)
    for low_hz, high_hz in ((200.0, 264.0), (280.5, 373.6), (600.0, 700.0)):
        work._add(SetAside(1, Glitch(low_hz, high_hz, 0.01, 0.001), 10))
    assert [(s.glitch.low_hz, s.glitch.high_hz) for s in work.aside] == [(200.0, 373.6), (600.0, 700.0)]


def test_what_lies_between_lobes_is_set_aside_with_them():
    work = FilesAtWork(FILES, quiet, with_effects=False)
    for low_hz, high_hz in ((200.0, 264.0), (280.5, 373.6)):
        work._add(SetAside(1, Glitch(low_hz, high_hz, 0.01, 0.001), 10))
    f = np.array([190.0, 250.0, 270.0, 275.0, 300.0, 400.0])
    already = np.array([False, True, False, False, True, False])
    assert f[work._between(1, f, already)].tolist() == [270.0, 275.0]
    assert not work._between(2, f, already).any()
    assert [one.points for one in work.aside] == [22]


@pytest.mark.parametrize(
    ("misfit", "lawless", "said"),
    [
        ([0.004, 0.0], False, "where a fixture resonates"),
        ([0.004, 0.02], True, "follow no one law"),
        ([0.3, 0.02], True, "more than any rig is off"),
    ],
)
def test_what_readings_are_worth_is_said_by_its_reason(misfit, lawless, said):
    work = FilesAtWork(FILES, quiet, with_effects=False)
    work.misfit, work._lawless = misfit, lawless
    assert said in work.about_misfit()
    assert f"{100 * misfit[0]:.2g}" in work.about_misfit()
