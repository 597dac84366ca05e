"""The page of the sweep."""

from gui.pages.sweep.page import SweepPage

__all__ = ["SweepPage"]
