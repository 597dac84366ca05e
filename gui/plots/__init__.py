"""The plots of the window: every one is a `Plot`."""

from gui.plots.axis import Axis
from gui.plots.plot import Plot

__all__ = ["Axis", "Plot"]
