"""How a vibrometer of one kind is described in RIG.toml and opened; others derive theirs from this."""

from contextlib import AbstractContextManager
from typing import Any, Generic, Literal, Protocol, TypeVar

from drivers.errors import Missing
from drivers.options import DeviceOptions
from drivers.vibrometer.interface import Range, Vibrometer


class VibrometerOptions(DeviceOptions):
    """The laser vibrometer. Its samples come through the front-end."""

    kind: str = "polytec"
    reads: Literal["absolute", "relative"] = "absolute"
    """A laser on a tripod reads absolute velocity; one that rides with the clamp, relative."""

    @property
    def model_name(self) -> str:
        """Which instrument the rig file says it is, for the report; empty where it says none."""
        return ""


OptionsT = TypeVar("OptionsT", bound=VibrometerOptions)


class Optics(Protocol):
    """The simulated rig's laser, as a simulated vibrometer meets it. Any thread may call."""

    @property
    def signal_level(self) -> float:
        """How much light comes back, 0 to 1."""

    def choose(self, chosen: Range) -> None:
        """The range in use from now on: it scales the voltage that the front-end is given."""


class VibrometerDriver(Generic[OptionsT]):
    """Of one kind, the name of its entry point in the group `viscorig.vibrometers`.

    Made without arguments.
    """

    options: type[OptionsT]
    """The keys of `[vibrometer]` with this kind."""

    def ranges(self, options: OptionsT) -> tuple[Range, ...]:
        """From the most sensitive to the coarsest. Asked without a device, when an experiment is checked."""
        raise NotImplementedError

    def open(self, options: OptionsT) -> Vibrometer:
        """The vibrometer at an address, connected. Raises `DriverError`."""
        raise NotImplementedError

    def simulated(self, options: OptionsT, optics: Optics) -> AbstractContextManager[str]:
        """A simulated one for `address = "simulated"`: entered it answers at the address it gives.

        It speaks the device's protocol and chooses one of `ranges` at its beginning. Raises `Missing` where
        the driver brings none.
        """
        raise Missing(f"vibrometer {options.kind}: its driver brings no simulated one")

    @property
    def can_be_simulated(self) -> bool:
        """Whether the driver brings a simulated one."""
        return type(self).simulated is not VibrometerDriver.simulated


AnyVibrometerDriver = VibrometerDriver[Any]
