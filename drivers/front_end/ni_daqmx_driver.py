"""Front-ends of the kind `ni-daqmx`."""

from typing import Literal

from drivers.front_end.driver import FrontEndDriver, FrontEndOptions
from drivers.front_end.interface import FrontEnd


class NiDaqmxOptions(FrontEndOptions):
    """A device of NI's, through NI-DAQmx."""

    kind: Literal["ni-daqmx"] = "ni-daqmx"
    address: str
    """The device's name, as NI's configuration has it."""


class NiDaqmxDriver(FrontEndDriver[NiDaqmxOptions]):
    """NI-DAQmx, with `pip install 'viscorig[ni]'`."""

    options = NiDaqmxOptions

    def open(self, options: NiDaqmxOptions) -> FrontEnd:
        """Open the device by its name."""
        from drivers.front_end.ni_daqmx import NiDaqmxFrontEnd

        return NiDaqmxFrontEnd(options.address)
