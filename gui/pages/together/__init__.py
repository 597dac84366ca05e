"""The page of several files under one law."""

from gui.pages.together.page import TogetherPage

__all__ = ["TogetherPage"]
