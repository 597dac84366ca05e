"""The page of the experiment and its run."""

from gui.pages.run.page import RunPage

__all__ = ["RunPage"]
