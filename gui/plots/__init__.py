"""The plots of the window: every one is a `Plot`."""

from gui.plots.plot import Axis, Plot

__all__ = ["Axis", "Plot"]
