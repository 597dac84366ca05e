"""Shaker: what any controller or amplifier offers, and its drivers."""

from drivers.shaker.interface import Alarm, Echo, Shaker, ShakerStatus

__all__ = ["Alarm", "Echo", "Shaker", "ShakerStatus"]
