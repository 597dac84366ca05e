"""The page of the law found."""

from gui.pages.material.page import MaterialPage

__all__ = ["MaterialPage"]
