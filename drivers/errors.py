"""What can go wrong with a device.

DriverError
  +- Unreachable    nobody answers at the address, or the connection was lost and did not come back
  +- TimedOut       connected, but no answer within the time allowed
  +- Garbled        an answer that the protocol does not allow
  +- Refused        the device understood and said no
  +- Missing        a library or a vendor's driver is not installed

Every message names the device and its address, what was expected, and what came instead, in one line.
"""


class DriverError(Exception):
    """A device cannot do its part. The run ends safely."""


class Unreachable(DriverError):
    """Nobody answers at the address, or the connection was lost and did not come back."""


class TimedOut(DriverError):
    """Connected, but no answer within the time allowed."""


class Garbled(DriverError):
    """An answer that the protocol does not allow."""


class Refused(DriverError):
    """The device understood and said no."""


class Missing(DriverError):
    """A library or a vendor's driver is not installed."""
