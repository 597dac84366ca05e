from importlib.util import find_spec

import pytest

from drivers.errors import Missing
from drivers.front_end.ni_daqmx import NiDaqmxFrontEnd


@pytest.mark.skipif(find_spec("nidaqmx") is not None, reason="NI's library is here: nothing is missing")
def test_without_nis_library_one_line_says_what_to_run():
    with pytest.raises(Missing, match=r'run pip install "viscorig\[ni\]" and install NI\'s driver') as caught:
        NiDaqmxFrontEnd("cDAQ1Mod1")
    assert "\n" not in str(caught.value)
