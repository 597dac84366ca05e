"""A line in the colour of its meaning."""

from html import escape

from PySide6.QtCore import QEvent, Qt
from PySide6.QtWidgets import QLabel, QWidget

from gui.style.theme import Role, current_theme


class Mark(QLabel):
    """Colour and size of type follow the window's."""

    def __init__(self, parent: QWidget | None = None, *, large: bool = False) -> None:
        super().__init__(parent)
        self._size = "large" if large else "medium"
        self._said: tuple[str, Role, bool] = ("", "text", False)
        self.setTextFormat(Qt.TextFormat.RichText)
        self.setTextInteractionFlags(Qt.TextInteractionFlag.TextSelectableByMouse)

    @property
    def said(self) -> str:
        """The text beside the mark."""
        return self._said[0]

    def say(self, text: str, role: Role, *, bold: bool = False) -> None:
        """A line and its colour."""
        self._said = text, role, bold
        self._paint()

    def changeEvent(self, event: QEvent) -> None:
        """Another theme."""
        super().changeEvent(event)
        if event.type() == QEvent.Type.PaletteChange and hasattr(self, "_said"):
            self._paint()

    def _paint(self) -> None:
        text, role, bold = self._said
        style = f"color: {current_theme().color(role).name()}; font-size: {self._size}"
        weight = "bold" if bold else "normal"
        self.setText(f'<span style="{style}; font-weight: {weight}">{escape(text)}</span>' if text else "")
