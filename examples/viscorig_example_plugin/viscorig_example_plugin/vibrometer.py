"""A vibrometer without an interface: one range, set by hand on its front, and stated in RIG.toml."""

from collections.abc import Iterator
from contextlib import AbstractContextManager, contextmanager
from typing import Annotated, Literal

from pydantic import Field

from drivers.errors import Refused
from drivers.vibrometer.driver import Optics, VibrometerDriver, VibrometerOptions
from drivers.vibrometer.interface import Range, Vibrometer

_RANGE = "by hand"


class AnalogOptions(VibrometerOptions):
    """A vibrometer of which nothing is known but its output."""

    kind: Literal["analog"] = "analog"
    address: str = "none"
    """There is nothing to connect to."""
    scale_mm_s_v: Annotated[float, Field(ge=1e-3, le=1e4)]
    """As the switch on its front says."""
    full_scale_v: Annotated[float, Field(ge=0.1, le=100)] = 10.0
    highest_hz: Annotated[float, Field(ge=10, le=1e7)] = 20e3


class AnalogVibrometer:
    """`Vibrometer`; what the rig file states is all there is to know."""

    def __init__(self, only: Range) -> None:
        self._only = only

    @property
    def ranges(self) -> tuple[Range, ...]:
        """The one."""
        return (self._only,)

    def identity(self) -> str:
        """It cannot be asked."""
        return f"vibrometer without an interface, {1e3 * self._only.scale_m_s_v:g} mm/s/V stated"

    def set_range(self, name: str) -> Range:
        """Refused for any but the one."""
        if name != self._only.name:
            raise Refused(f"vibrometer without an interface: range {name!r}, expected {self._only.name!r}")
        return self._only

    def range(self) -> Range:
        """The one."""
        return self._only

    def signal_level(self) -> float:
        """Unknown, taken as good: look at its bar."""
        return 1.0

    def signal_delay_s(self) -> float | None:
        """Unknown: it is measured in place."""
        return None

    def close(self) -> None:
        """Nothing to let go of."""


class AnalogDriver(VibrometerDriver[AnalogOptions]):
    """Of the kind `analog`."""

    options = AnalogOptions

    def ranges(self, options: AnalogOptions) -> tuple[Range, ...]:
        """The one, as stated."""
        scale, full = 1e-3 * options.scale_mm_s_v, options.full_scale_v
        return (Range(_RANGE, scale, full, options.highest_hz, None, verified=True),)

    def open(self, options: AnalogOptions) -> Vibrometer:
        """Nothing is connected."""
        return AnalogVibrometer(*self.ranges(options))

    def simulated(self, options: AnalogOptions, optics: Optics) -> AbstractContextManager[str]:
        """The simulated laser, its switch where the rig file says."""
        return _switched(self.ranges(options)[0], optics)


@contextmanager
def _switched(only: Range, optics: Optics) -> Iterator[str]:
    optics.choose(only)
    yield "none"
