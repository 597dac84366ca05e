"""Climate chamber or thermometer: what any of them offers, and its drivers."""

from drivers.chamber.interface import Chamber

__all__ = ["Chamber"]
