import pytest

from fitting.stated.layers import Orthotropy
from fitting.stated.patches import Patch
from instrument.files.layer_tables import GluePart, PatchPart, StatedLayer, refuse_patches

METAL = {"thickness_mm": 1.0, "poisson": 0.3, "density_kg_m3": 2700.0}


def patch(*sides):
    return PatchPart(**dict(zip(("from_x_mm", "to_x_mm", "from_y_mm", "to_y_mm"), sides, strict=True)))


def test_a_layer_is_isotropic_or_has_axes_of_its_own():
    assert StatedLayer(young_gpa=70.0, **METAL).face().rolled is None
    face = StatedLayer(young_x_gpa=72.0, young_y_gpa=66.0, shear_gpa=25.0, **METAL).face()
    assert (face.young_pa, face.rolled) == (72e9, Orthotropy(66e9, 25e9, 0.0))


def test_glue_and_patches_come_in_si_units():
    glue = GluePart(thickness_mm=0.05, shear_mpa=400.0, density_kg_m3=1100.0).glue()
    assert (glue.thickness_m, glue.shear_pa) == (pytest.approx(5e-5), 400e6)
    assert patch(10.0, 20.0, 0.0, 50.0).patch() == Patch(0.01, 0.02, 0.0, 0.05)


def test_a_patch_that_is_a_sliver_is_refused():
    with pytest.raises(ValueError, match=r"^patch\.1 is 0\.1 mm long along y, expected 1 mm at least$"):
        refuse_patches([patch(0.0, 50.0, 0.0, 90.0), patch(0.0, 50.0, 40.0, 40.1)], 100.0, 90.0)


def test_patches_may_touch_and_not_overlap():
    refuse_patches([patch(0.0, 50.0, 0.0, 90.0), patch(50.0, 100.0, 0.0, 90.0)], 100.0, 90.0)
    with pytest.raises(ValueError, match="overlap"):
        refuse_patches([patch(0.0, 51.0, 0.0, 90.0), patch(50.0, 100.0, 0.0, 90.0)], 100.0, 90.0)
