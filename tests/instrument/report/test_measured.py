"""What a page draws beside the points, and how it prints a terminal's words."""

from dataclasses import replace

import numpy as np
import pytest
from diagnosed_session import diagnosed_session
from diagnosis_cases import diagnosis

from instrument.report.blocks import typeset
from instrument.report.measured import explained, segments_of
from instrument.session.contents import contents_of
from instrument.session.storage import SessionFile


def test_the_response_with_what_was_found_is_drawn_beside_the_points(tmp_path):
    path = diagnosed_session(tmp_path)
    with SessionFile(path) as file:
        contents = contents_of(file)
    measured = segments_of(contents)[0]
    left = {p.frequency_hz: p.after for p in diagnosis().points}
    at_hz, with_effects = explained(measured, diagnosis())
    both = [k for k, f in enumerate(measured.frequency_hz) if f in left]
    off = [0.01 * complex(left[f].re_percent, left[f].im_percent) for f in at_hz]
    assert list(at_hz) == list(measured.frequency_hz[both])
    assert with_effects == pytest.approx(measured.over_base[both] * (1 + np.array(off)))
    assert explained(measured, diagnosis(verdict="unknown")) is None
    assert explained(measured, diagnosis(phase=False)) is None
    elsewhere = replace(measured, frequency_hz=measured.frequency_hz + 0.1)
    assert explained(elsewhere, diagnosis()) is None


def test_a_page_prints_what_a_terminal_writes_in_ascii_and_leaves_names_alone():
    assert typeset("k 2 +- 1 N/m^3, 0.3 -> 0.4 m/s^2") == "k 2 ± 1 N/m³, 0.3 → 0.4 m/s²"
    assert typeset("a->b^2+-c.toml") == "a->b^2+-c.toml"
