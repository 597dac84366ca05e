"""It is told of, and never fitted."""

from fitting.effects import CATALOGUE
from fitting.effects.fixture_transfer import FixtureTransferEffect


def test_it_stands_on_shear_pairs_alone_and_is_tried_by_no_search():
    effect = CATALOGUE["fixture_transfer"]
    assert isinstance(effect, FixtureTransferEffect)
    assert [effect.on(kind) is None for kind in ("plate", "beam", "shear-pair")] == [True, True, False]
    assert "several masses" in effect.objection(None, None)
    assert effect.parameters == ()


def test_its_story_says_what_is_common_and_what_each_file_keeps():
    said = FixtureTransferEffect().story(
        {"size": 0.024, "gain": 0.003, "phase": 0.0175, "largest": 0.1, "own": 0.008}
    )
    assert "alike by 2.4 % (gain +0.3 % and phase +1.0 degrees" in said
    assert "each by itself by 0.8 % more" in said
