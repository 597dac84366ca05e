"""How a curve is drawn."""

import numpy as np
import pytest

from gui.plots.curve import Curve, items_of

X = np.arange(3.0)


@pytest.mark.parametrize(("kind", "pixels"), [("line", 3.0), ("trace", 1.5)])
def test_a_line_is_as_wide_on_a_fine_screen_and_a_trace_is_quick(qapp, kind, pixels):
    curve = Curve(items_of("fit", kind), "model", kind, {})
    curve.style(2.0)
    assert curve.items[0].opts["pen"].widthF() == pixels


def test_a_band_is_exported_with_both_its_edges(qapp):
    curve = Curve(items_of(None, "band"), "model", "band", {})
    curve.show_between("law", X, X - 1, X + 1)
    assert list(curve.columns) == ["", "law low", "law high"]
    np.testing.assert_array_equal(curve.columns["law high"], [1, 2, 3])
