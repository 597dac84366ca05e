"""Front-ends of the kind `lan-xi`."""

from typing import Literal, Self

from pydantic import model_validator

from drivers.front_end.driver import FrontEndDriver, FrontEndOptions
from drivers.front_end.interface import FrontEnd, InputChannel
from drivers.front_end.lan_xi_address import host_of


class LanXiOptions(FrontEndOptions):
    """A module of HBK's LAN-XI."""

    kind: Literal["lan-xi"] = "lan-xi"
    address: str
    """The module's URL."""

    @model_validator(mode="after")
    def _reachable(self) -> Self:
        if self.is_addressed:
            host_of(self.address)
        return self


class LanXiDriver(FrontEndDriver[LanXiOptions]):
    """HBK LAN-XI's open interface."""

    options = LanXiOptions

    def open(self, options: LanXiOptions) -> FrontEnd:
        """At its URL."""
        from drivers.front_end.lan_xi import LanXiFrontEnd

        return LanXiFrontEnd(options.address, paced_by_reader=options.paced_by_reader)

    def look(self, options: LanXiOptions) -> str:
        """Asked, not taken over: another program may be recording with it."""
        from drivers.front_end.lan_xi import module_identity

        return module_identity(options.address)

    def objection(self, options: LanXiOptions, channels: tuple[InputChannel, ...]) -> str:
        """By what the module says of its rates, inputs and ranges."""
        from drivers.front_end.lan_xi import module_objection

        return module_objection(options.address, channels, options.sample_rate_hz)
