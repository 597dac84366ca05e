"""How a chamber of one kind is described in RIG.toml and opened; others derive theirs from this."""

from typing import Any, Generic, TypeVar

from drivers.chamber.interface import Chamber
from drivers.options import DeviceOptions


class ChamberOptions(DeviceOptions):
    """The climate chamber, or a thermometer alone."""

    kind: str = "modbus-tcp"

    @property
    def has_set_point(self) -> bool:
        """Whether it can be told a temperature. Asked without a device, when an experiment is checked."""
        return False


OptionsT = TypeVar("OptionsT", bound=ChamberOptions)


class ChamberDriver(Generic[OptionsT]):
    """Of one kind, the name of its entry point in the group `viscorig.chambers`.

    Made without arguments.
    """

    options: type[OptionsT]
    """The keys of `[chamber]` with this kind."""

    def open(self, options: OptionsT) -> Chamber:
        """The chamber at an address; it may be connected to when first used. Raises `DriverError`."""
        raise NotImplementedError


AnyChamberDriver = ChamberDriver[Any]
