"""A line that is shortened where there is no room for it; all of it is in its tool tip then."""

from PySide6.QtCore import QEvent, QSize, Qt
from PySide6.QtGui import QResizeEvent
from PySide6.QtWidgets import QLabel, QSizePolicy, QWidget


class ElidedLabel(QLabel):
    """Takes what room it is given, and makes nothing wider.

    Parameters
    ----------
    text : str
        What it says; plain text.
    tip : str
        Of its own, below what was shortened.
    """

    def __init__(self, text: str = "", tip: str = "", parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._whole, self._tip = "", tip
        self.setTextFormat(Qt.TextFormat.PlainText)
        self.setSizePolicy(QSizePolicy.Policy.Preferred, QSizePolicy.Policy.Preferred)
        self.say(text)

    @property
    def said(self) -> str:
        """All of it."""
        return self._whole

    def say(self, text: str, tip: str | None = None) -> None:
        """Instead of what it said; `tip` in place of its own where one is given."""
        if tip is not None:
            self._tip = tip
        if text != self._whole:
            self._whole = text
            self.updateGeometry()
        self._show()

    def minimumSizeHint(self) -> QSize:
        """A sign or two."""
        return QSize(self.fontMetrics().horizontalAdvance("0\u2026"), super().minimumSizeHint().height())

    def sizeHint(self) -> QSize:
        """All of it on one line."""
        return QSize(self.fontMetrics().horizontalAdvance(self._whole), super().sizeHint().height())

    def resizeEvent(self, event: QResizeEvent) -> None:
        """More of it, or less."""
        super().resizeEvent(event)
        self._show()

    def changeEvent(self, event: QEvent) -> None:
        """Type follows the window's."""
        super().changeEvent(event)
        if event.type() == QEvent.Type.FontChange and hasattr(self, "_whole"):
            self.updateGeometry()
            self._show()

    def _show(self) -> None:
        room = max(self.contentsRect().width(), self.minimumSizeHint().width())
        shown = self.fontMetrics().elidedText(self._whole, Qt.TextElideMode.ElideRight, room)
        if shown != self.text():
            self.setText(shown)
        cut = self._whole if shown != self._whole else ""
        self.setToolTip("\n".join(filter(None, (cut, self._tip))))
