"""How a front-end of one kind is described in RIG.toml and opened; others derive theirs from this."""

from typing import Annotated, Any, Generic, TypeVar

from pydantic import Field

from drivers.front_end.interface import FrontEnd, InputChannel
from drivers.options import DeviceOptions


class FrontEndOptions(DeviceOptions):
    """The data acquisition."""

    kind: str = "lan-xi"
    sample_rate_hz: Annotated[float, Field(ge=100, le=1e6)] = 8192.0
    paced_by_reader: bool = False
    """Of a `viscorig simulate --virtual-time` alone: it makes samples as they are asked for."""


OptionsT = TypeVar("OptionsT", bound=FrontEndOptions)


class FrontEndDriver(Generic[OptionsT]):
    """Of one kind, the name of its entry point in the group `viscorig.front_ends`.

    Made without arguments.
    """

    options: type[OptionsT]
    """The keys of `[front_end]` with this kind."""

    def open(self, options: OptionsT) -> FrontEnd:
        """The front-end at an address, connected, not sampling. Raises `DriverError`."""
        raise NotImplementedError

    def look(self, options: OptionsT) -> str:
        """Who answers at the address, the device left as it is where that can be done. Raises `DriverError`.

        Opened and closed again unless a driver knows a gentler way.
        """
        device = self.open(options)
        try:
            return device.identity()
        finally:
            device.close()

    def objection(self, options: OptionsT, channels: tuple[InputChannel, ...]) -> str:
        """Why the device there cannot sample these; empty where it can, or nobody knows before it does.

        As `look`, it leaves the device as it is. Raises `DriverError`.
        """
        return ""


AnyFrontEndDriver = FrontEndDriver[Any]
