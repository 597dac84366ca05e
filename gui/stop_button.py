"""The stop button: red while there is something to stop, and larger than all others."""

from PySide6.QtCore import QEvent
from PySide6.QtGui import QColor, QPalette
from PySide6.QtWidgets import QPushButton, QSizePolicy, QWidget

from gui.theme import current_theme

_SIGNS = (
    QEvent.Type.Show,
    QEvent.Type.PaletteChange,
    QEvent.Type.ApplicationPaletteChange,
    QEvent.Type.ApplicationFontChange,
)


class StopButton(QPushButton):
    """Pressed, it acts: nobody is asked again."""

    _tinting = False

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__("STOP", parent)
        self.setToolTip("Silence the shaker at once, whatever hangs (F12, or Esc twice)")
        self.setSizePolicy(QSizePolicy.Policy.Fixed, QSizePolicy.Policy.Expanding)
        self._tint()

    def event(self, event: QEvent) -> bool:
        """Colours and type follow the window's."""
        if event.type() in _SIGNS and not self._tinting:
            self._tinting = True
            self._tint()
            self._tinting = False
        return bool(super().event(event))

    def _tint(self) -> None:
        theme, roles = current_theme(), QPalette.ColorRole
        palette = QPalette()
        for group in (QPalette.ColorGroup.Active, QPalette.ColorGroup.Inactive):
            palette.setColor(group, roles.Button, QColor(theme.stop))
            palette.setColor(group, roles.ButtonText, QColor(theme.stop_text))
        self.setPalette(palette)
        font = self.window().font()
        font.setBold(True)
        font.setPointSizeF(1.3 * font.pointSizeF())
        self.setFont(font)
        self.setMinimumWidth(self.fontMetrics().horizontalAdvance("STOP") * 2)
