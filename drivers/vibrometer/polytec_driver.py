"""Vibrometers of the kind `polytec`."""

from collections.abc import Iterator
from contextlib import contextmanager
from typing import Annotated, Literal

from pydantic import Field

from drivers.vibrometer.driver import Optics, VibrometerDriver, VibrometerOptions
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
        """The model as the table of `polytec_models` names it."""
        return self.model


class PolytecDriver(VibrometerDriver[PolytecOptions]):
    """Polytec's serial language, and a simulated vibrometer that speaks it."""

    options = PolytecOptions

    def ranges(self, options: PolytecOptions) -> tuple[Range, ...]:
        """Measuring ranges of the chosen model."""
        return model_named(options.model).ranges

    def open(self, options: PolytecOptions) -> Vibrometer:
        """On its port."""
        from drivers.vibrometer.polytec_vibrometer import PolytecVibrometer

        return PolytecVibrometer(options.address, model=options.model, baud=options.baud)

    @contextmanager
    def simulated(self, options: PolytecOptions, optics: Optics) -> Iterator[str]:
        """On a pseudo-terminal."""
        from drivers.vibrometer.polytec_simulated import simulated_polytec

        with simulated_polytec(optics, options.model) as server:
            yield server.path
