"""The report's section of blows on the treated plate."""

from pathlib import Path

import numpy as np
import pytest
from sessions import configuration
from struck_cases import struck

from instrument.impact.record import Hit, ResponseChannel
from instrument.report.blocks import FigureBlock, Sentence, TableBlock
from instrument.report.struck import struck_sections
from instrument.session.contents import Contents, RecordedHit


def contents(*found, hits=0):
    record = Hit("hit", 1024.0, np.zeros(2048), (ResponseChannel("velocity", "velocity", np.zeros(2048)),))
    return Contents(
        Path("a.h5"),
        configuration(),
        struck=list(found),
        struck_hits=[RecordedHit(k + 1, True, "", 80.0, record) for k in range(hits)],
    )


def blocks(*given, **how):
    (section,) = struck_sections(contents(*given, **how))
    assert section.title == "Damped plate struck"
    return section.blocks


def said(found):
    return [b.text for b in found if isinstance(b, Sentence)]


def test_a_plate_that_was_not_struck_has_no_such_section():
    assert struck_sections(contents()) == []


@pytest.mark.parametrize(
    ("held", "words"),
    [
        ("free", "Hung free, 330.2 by 199.9 mm: struck at (285, 180) mm, read at (15, 20) mm"),
        ("clamped", "In its clamp: struck at (285, 180) mm, read where the laser was"),
    ],
)
def test_it_says_how_it_was_held_hit_and_read(held, words):
    found = blocks(struck(held), hits=3)
    assert said(found) == [f"{words}; 3 hits averaged, 2 lines about 1 resonances."]
    (table,) = [b for b in found if isinstance(b, TableBlock)]
    assert len(table.rows) == 3


def test_each_line_of_the_mobility_is_drawn_with_its_deviation():
    (picture,) = [b for b in blocks(struck()) if isinstance(b, FigureBlock)]
    above, below = picture.figure.axes
    (dots, _, (bars,)) = above.containers[0]
    np.testing.assert_allclose(dots.get_ydata(), np.abs([0.1, 0.2 + 0.1j]))
    np.testing.assert_allclose([np.ptp(s[:, 1]) for s in bars.get_segments()], [2e-3, 4e-3])
    np.testing.assert_allclose(below.containers[0][0].get_ydata(), np.degrees(np.angle([0.1, 0.2 + 0.1j])))


def test_what_was_not_ended_or_is_not_right_is_said():
    assert "gave no mobility" in said(blocks(hits=1))[0]
    assert said(blocks(struck(remarks=("the range is not calibrated",))))[1] == "The range is not calibrated."
