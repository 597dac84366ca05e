"""Vibrometers of the kind `polytec`."""

from typing import Annotated, Literal

from pydantic import Field

from drivers.vibrometer.driver import VibrometerDriver, VibrometerOptions
from drivers.vibrometer.interface import Range, Vibrometer
from drivers.vibrometer.polytec_models import model_named


class PolytecOptions(VibrometerOptions):
    """A Polytec vibrometer on a serial port."""

    kind: Literal["polytec"] = "polytec"
    address: str
    """A serial port."""
    model: Literal["OFV-5000", "OFV-5000 VD-08", "PDV-100"] = "OFV-5000"
    baud: Annotated[int, Field(gt=0)] = 115200

    @property
    def model_name(self) -> str:
        """As in `drivers.vibrometer.polytec_models`."""
        return self.model


class PolytecDriver(VibrometerDriver[PolytecOptions]):
    """Polytec's serial language. The simulated rig's own vibrometer speaks it (`drivers.simulated`)."""

    options = PolytecOptions

    def ranges(self, options: PolytecOptions) -> tuple[Range, ...]:
        """Of the model."""
        return model_named(options.model).ranges

    def open(self, options: PolytecOptions) -> Vibrometer:
        """On its port."""
        from drivers.vibrometer.polytec_vibrometer import PolytecVibrometer

        return PolytecVibrometer(options.address, model=options.model, baud=options.baud)
