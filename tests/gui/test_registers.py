"""Through whole runs, nothing is shown as of now that the instruments had more than half a second ago."""

import pytest
from register_runs import one_run

from gui.state.readings import FRESH_S

SECONDS = 1.5


@pytest.mark.timing
@pytest.mark.parametrize("what", ["hold-resume-stop", "front-end-hangs"])
def test_what_is_shown_is_what_the_instruments_have_or_is_marked(window, tmp_path, what):
    looks = one_run(window, tmp_path / "run", what, SECONDS)
    assert looks.old == []
    for seen in looks.seen.values():
        assert len(seen.ages_s) > 10 * SECONDS
        assert seen.oldest_s <= FRESH_S
