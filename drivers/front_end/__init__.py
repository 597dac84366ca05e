"""Front-end: what any data acquisition offers, and its drivers."""

from drivers.front_end.interface import Block, FrontEnd, InputChannel

__all__ = ["Block", "FrontEnd", "InputChannel"]
