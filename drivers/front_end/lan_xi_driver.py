"""Front-ends of the kind `lan-xi`."""

from typing import Literal

from drivers.front_end.driver import FrontEndDriver, FrontEndOptions
from drivers.front_end.interface import FrontEnd


class LanXiOptions(FrontEndOptions):
    """A module of HBK's LAN-XI."""

    kind: Literal["lan-xi"] = "lan-xi"
    address: str
    """The module's URL."""


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
