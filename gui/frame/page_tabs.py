"""The pages of a window. None of them makes it larger than the screen: STOP would be outside."""

from PySide6.QtCore import QSize
from PySide6.QtWidgets import QTabWidget

_REST_PX, _REST_LINES = 200, 2
"""What bar, log, replay and menus take of a window's height, the latter in lines of its type."""


class PageTabs(QTabWidget):
    """Qt's tabs, no larger than the screen. A page that asks for more than the screen has is cut."""

    def minimumSizeHint(self) -> QSize:
        """No more than the screen has beside what is always seen."""
        screen = self.screen().availableSize()
        rest = _REST_PX + _REST_LINES * self.fontMetrics().lineSpacing()
        return super().minimumSizeHint().boundedTo(QSize(screen.width(), screen.height() - rest))
