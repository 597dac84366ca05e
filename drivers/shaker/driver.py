"""How a shaker of one kind is described in RIG.toml and opened; others derive theirs from this."""

from typing import Annotated, Any, ClassVar, Generic, TypeVar

from pydantic import Field

from drivers.options import DeviceOptions
from drivers.shaker.interface import Shaker


class ShakerOptions(DeviceOptions):
    """The shaker's controller or amplifier."""

    kind: str = "modbus-tcp"
    heartbeat_timeout_s: Annotated[float, Field(ge=0.5, le=10)] = 2.0
    """Told to the device: without a beat for so long it goes silent. The run beats five times a second."""


OptionsT = TypeVar("OptionsT", bound=ShakerOptions)


class ShakerDriver(Generic[OptionsT]):
    """Of one kind, the name of its entry point in the group `viscorig.shakers`.

    Made without arguments.
    """

    options: type[OptionsT]
    """The keys of `[shaker]` with this kind."""
    is_shared: ClassVar[bool] = False
    """Whether the device takes a second connection beside the run's: the stop button's own way."""

    def open(self, options: OptionsT, *, timeout_s: float = 1.0, retries: int = 2) -> Shaker:
        """The shaker at an address; it may be connected to when first used. Raises `DriverError`.

        `timeout_s` is for one answer, `retries` how often it is asked for again.
        """
        raise NotImplementedError


AnyShakerDriver = ShakerDriver[Any]
