"""`kind = "template"` in RIG.toml."""

from contextlib import AbstractContextManager
from typing import Annotated, Literal

from pydantic import Field, model_validator

from drivers.vibrometer.driver import Optics, VibrometerDriver, VibrometerOptions
from drivers.vibrometer.interface import Range, Vibrometer
from vibrometer_template.protocol import RANGES


class TemplateOptions(VibrometerOptions):
    """A vibrometer that does not exist."""

    kind: Literal["template"] = "template"
    address: str
    """host:port."""
    timeout_s: Annotated[float, Field(ge=0.05, le=10)] = 1.0
    """For one answer."""

    @model_validator(mode="after")
    def _reachable(self) -> "TemplateOptions":
        host, _, port = self.address.rpartition(":")
        if self.is_addressed and (not host or not port.isdecimal()):
            raise ValueError(f"address: {self.address!r}, expected host:port")
        return self


class TemplateDriver(VibrometerDriver[TemplateOptions]):
    """Made by the entry point; what talks to devices is imported only when one is opened."""

    options = TemplateOptions

    def ranges(self, options: TemplateOptions) -> tuple[Range, ...]:
        """The same for every device of this kind."""
        return RANGES

    def open(self, options: TemplateOptions) -> Vibrometer:
        """At its address."""
        from vibrometer_template.device import TemplateVibrometer

        host, _, port = options.address.rpartition(":")
        return TemplateVibrometer(host, int(port), timeout_s=options.timeout_s)

    def simulated(self, options: TemplateOptions, optics: Optics) -> AbstractContextManager[str]:
        """The device of `simulated.py`, before the simulated rig's laser."""
        from vibrometer_template.simulated import SimulatedVibrometer

        return SimulatedVibrometer(optics)
