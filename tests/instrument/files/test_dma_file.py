"""Tables of dynamic mechanical analysis whose columns are nearly ours."""

import pytest

from instrument.errors import BadInput
from instrument.files.dma_file import read_dma


@pytest.mark.parametrize(("unit", "times"), [("mpa", r"1e\+06"), ("kpa", "1000"), ("GPa", r"1e\+09")])
def test_a_modulus_in_another_unit_is_to_be_multiplied_not_renamed(tmp_path, unit, times):
    (tmp_path / "t.csv").write_text(f"frequency_hz,storage_modulus_{unit},loss_factor\n10,0.3,0.5\n")
    said = rf"found storage_modulus_{unit}: expected Pa, its values times {times} under that name"
    with pytest.raises(BadInput, match=said):
        read_dma(tmp_path / "t.csv", 0.49)


def test_another_name_is_asked_about(tmp_path):
    (tmp_path / "t.csv").write_text("frequency_hz,storage_moduls_pa,loss_factor\n10,0.3,0.5\n")
    with pytest.raises(BadInput, match="is it storage_moduls_pa"):
        read_dma(tmp_path / "t.csv", 0.49)
