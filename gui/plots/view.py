"""A plot's view whose menu is made when it is first opened: a window has thirty plots, and few menus are."""

from collections.abc import Callable
from typing import Any

import pyqtgraph as pg
from pyqtgraph.graphicsItems.ViewBox.ViewBoxMenu import ViewBoxMenu
from PySide6.QtWidgets import QMenu

Fill = Callable[[QMenu], None]
"""Puts entries into a menu."""


class View(pg.ViewBox):  # type: ignore[misc]
    """The plot library's view with a context menu of our own.

    `fills` put in their entries, in their order, once there is a menu.
    """

    def __init__(self) -> None:
        super().__init__(enableMenu=False)
        self.state["enableMenu"] = True
        self.menu: QMenu | None = None
        self.fills: list[Fill] = []

    def getMenu(self, ev: object = None) -> QMenu:
        """What a right click opens."""
        if self.menu is None:
            self.menu = menu = ViewBoxMenu(self)
            self.updateViewLists()
            for fill in self.fills:
                menu.addSeparator()
                fill(menu)
        return self.menu

    def getContextMenus(self, event: object) -> list[Any]:
        """Its entries, for what lies above the view."""
        return list(self.getMenu().actions())
