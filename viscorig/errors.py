"""What can go wrong, by its name: every message is one line that says what was found and what is expected."""

from drivers.errors import DriverError, Garbled, Missing, Refused, TimedOut, Unreachable
from fitting.errors import FittingError, OutsideModel, TooFewPoints
from instrument.errors import BadInput, RigStopped, StoppedByUser

__all__ = [
    "BadInput",
    "DriverError",
    "FittingError",
    "Garbled",
    "Missing",
    "OutsideModel",
    "Refused",
    "RigStopped",
    "StoppedByUser",
    "TimedOut",
    "TooFewPoints",
    "Unreachable",
]
