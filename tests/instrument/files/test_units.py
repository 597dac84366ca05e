"""Units as other programs spell them."""

import pytest

from fitting.gravity import STANDARD_GRAVITY_M_S2
from instrument.files.units import unit_of

G = STANDARD_GRAVITY_M_S2


@pytest.mark.parametrize(
    ("text", "quantity", "factor", "per"),
    [
        ("m/s", "velocity", 1.0, None),
        ("mm/s", "velocity", 1e-3, None),
        ("m/s²", "acceleration", 1.0, None),
        ("m/s^2", "acceleration", 1.0, None),
        ("m/s2", "acceleration", 1.0, None),
        ("m/s/s", "acceleration", 1.0, None),
        ("[ g ]", "acceleration", G, None),
        ("µm", "displacement", 1e-6, None),
        ("N", "force", 1.0, None),
        ("g/N", "acceleration", G, "force"),
        ("(m/s^2)/N", "acceleration", 1.0, "force"),
        ("m/s/N", "velocity", 1.0, "force"),
        ("mm/s/g", "velocity", 1e-3 / G, "acceleration"),
        ("(m/s)/(m/s^2)", "velocity", 1.0, "acceleration"),
        ("s", "velocity", 1.0, "acceleration"),
        ("1/kg", "acceleration", 1.0, "force"),
        ("s/kg", "velocity", 1.0, "force"),
        ("s²/kg", "displacement", 1.0, "force"),
        ("cm/s", "velocity", 1e-2, None),
        ("mm/s^2", "acceleration", 1e-3, None),
        ("in/s²", "acceleration", 0.0254, None),
        ("ips", "velocity", 0.0254, None),
        ("mil", "displacement", 2.54e-5, None),
        ("MM/S2", "acceleration", 1e-3, None),
        ("(M/S)/G", "velocity", 1 / G, "acceleration"),
        ("LBF", "force", 4.4482216152605, None),
    ],
)
def test_a_known_unit_has_its_quantity_and_its_factor_to_si(text, quantity, factor, per):
    unit = unit_of(text)
    assert (unit.quantity, unit.per) == (quantity, per)
    assert unit.factor == pytest.approx(factor, rel=1e-12)


@pytest.mark.parametrize("text", ["", "V", "Pa", "furlong/s", "m/s/V", "dB", "g/g/g", "MN", "Gm"])
def test_unknown_units_are_not_guessed(text):
    assert unit_of(text) is None
