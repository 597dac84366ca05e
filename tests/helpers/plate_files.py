"""A specimen file of a plate of three layers, written for the tests that need one of their own."""

LAYERS = """
[plate]
length_mm = 300.0
width_mm = 200.0
boundary = "{boundary}"
[substrate]
thickness_mm = 2.0
young_gpa = 69.0
poisson = 0.3
density_kg_m3 = 2700.0
[constraining]
thickness_mm = 0.5
young_gpa = 69.0
poisson = 0.3
density_kg_m3 = 2700.0
[core]
thickness_mm = 0.5
poisson = 0.49
density_kg_m3 = 1000.0
[core.law]
kind = "fractional-zener"
g0_mpa = 0.4
{law}
[mesh]
elements_x = {elements[0]}
elements_y = {elements[1]}
"""


def plate_text(boundary: str, law: str, elements: tuple[int, int]) -> str:
    """Its law begins at 0.4 MPa; `law` is the rest of it."""
    return LAYERS.format(boundary=boundary, law=law, elements=elements)
