"""Short forms of `python tests/by_hand/window.py SESSION.h5`."""

import pytest
from by_hand.window import (
    lateness,
    open_and_close,
    processor_stalls,
    repaint,
    replay,
    rig_in_real_time,
    stalls_of_a_run,
    turn,
)

from gui.frame.window import Window

MESH = "[mesh]\nelements_x = 8\nelements_y = 5\n"


@pytest.mark.long
def test_a_thousand_repaints_leave_nothing_behind(opened):
    assert repaint(opened, 1000) < 10


@pytest.mark.long
def test_replaying_again_and_again_leaves_nothing_behind(opened):
    assert replay(opened, 200) < 20


@pytest.mark.long
def test_windows_come_and_go_and_leave_nothing_behind(appearance, settings, session_path):
    assert open_and_close(lambda: Window(appearance, settings), session_path, 10) < 15


@pytest.mark.timing
@pytest.mark.long
def test_a_run_at_over_50_ks_a_second_with_its_fits_never_keeps_a_person_waiting(window, tmp_path):
    window.resize(1366, 768)
    with rig_in_real_time(tmp_path, points=6, mesh=MESH) as experiment:
        found = stalls_of_a_run(window, experiment, tmp_path)
    assert len(found.late_s) > 200
    assert found.percentile_s(99) < 0.05, str(found)
    # The longest, a page drawn for the first time: docs/evidence/window.md tells of it.


def test_a_stall_is_seen(qapp):
    import time

    with lateness() as found:
        turn(0.05)
        time.sleep(0.3)
        turn(0.05)
    assert found.largest_s > 0.28
    assert processor_stalls(0.1).late_s
