from importlib.util import find_spec

import pytest

from drivers.errors import Missing
from drivers.front_end.ni_daqmx import NiDaqmxFrontEnd
from drivers.front_end.ni_daqmx_driver import NiDaqmxDriver, NiDaqmxOptions


@pytest.mark.skipif(find_spec("nidaqmx") is not None, reason="NI's library is here: nothing is missing")
@pytest.mark.parametrize(
    "begin",
    [
        lambda: NiDaqmxFrontEnd("cDAQ1Mod1"),
        lambda: NiDaqmxDriver().open(NiDaqmxOptions(address="cDAQ1Mod1")),
    ],
    ids=["device", "driver"],
)
def test_without_nis_library_one_line_says_what_to_run(begin):
    with pytest.raises(Missing, match=r'run pip install "viscorig\[ni\]" and install NI\'s driver') as caught:
        begin()
    assert "\n" not in str(caught.value)
