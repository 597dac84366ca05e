"""Vibrometer: what any laser vibrometer offers, and its drivers."""

from drivers.vibrometer.interface import Range, Vibrometer

__all__ = ["Range", "Vibrometer"]
