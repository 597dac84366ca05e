"""One message beside the tabs, until it is read: over nothing that can be pressed."""

from PySide6.QtCore import QEvent, QObject, Qt
from PySide6.QtGui import QColor, QPainter, QPaintEvent
from PySide6.QtWidgets import QFrame, QHBoxLayout, QLabel, QTabWidget, QWidget

from gui.files.bare_names import bare_names
from gui.style.theme import Role, current_theme
from gui.widgets.basic import tool

_EDGE_PX = 4
_GAP_PX = 12
_FOOT_PX = 2
"""Of the row of tabs stays in view."""


class Notice(QFrame):
    """Not seen where there is nothing to say."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._role: Role = "good"
        self._tabs: QTabWidget | None = None
        self._whole = self._said = ""
        """As it came, with the paths of files; as it is shown, with their names."""
        self._label = QLabel()
        self._label.setWordWrap(True)
        self._label.setTextFormat(Qt.TextFormat.PlainText)
        self._label.setTextInteractionFlags(Qt.TextInteractionFlag.TextSelectableByMouse)
        self._close = close = tool("close", "Dismiss (Esc)")
        close.clicked.connect(self.hide)
        self._row = row = QHBoxLayout(self)
        row.setContentsMargins(10, 2, 4, 2)
        row.addWidget(self._label, 1)
        row.addWidget(close)
        self.hide()

    def float_beside(self, tabs: QTabWidget) -> None:
        """Lie in the row of these tabs, right of the last one, and follow it; a long text grows downwards."""
        self.setParent(tabs)
        self._tabs = tabs
        tabs.installEventFilter(self)
        self.hide()

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """The tabs have another size."""
        if event.type() == QEvent.Type.Resize:
            self._place()
        return False

    def _place(self) -> None:
        if self._tabs is None:
            return
        bar, whole = self._tabs.tabBar(), self._tabs.width()
        last = bar.mapTo(self._tabs, bar.tabRect(bar.count() - 1).topRight()).x()
        left = min(last + _GAP_PX, whole // 2)
        self._fit(whole - left)
        height = max(bar.height() - _FOOT_PX, self._row.totalHeightForWidth(whole - left))
        self.setGeometry(left, 0, whole - left, height)

    @property
    def text(self) -> str:
        """What it says; empty while it is not seen."""
        return self._said if not self.isHidden() else ""

    def refuse(self, message: str) -> None:
        """Something could not be done."""
        self._show(message, "bad")

    def say(self, message: str) -> None:
        """Something was done."""
        self._show(message, "good")

    def paintEvent(self, event: QPaintEvent) -> None:
        """On a ground of its own; the edge says which kind it is."""
        painter = QPainter(self)
        painter.fillRect(self.rect(), QColor(current_theme().note))
        painter.fillRect(0, 0, _EDGE_PX, self.height(), current_theme().color(self._role))
        painter.end()

    def _fit(self, room: int) -> None:
        """A word that no line has room for loses its middle; the tool tip has all of it, and whole paths."""
        margins, metrics = self._row.contentsMargins(), self._label.fontMetrics()
        room -= margins.left() + margins.right() + self._close.sizeHint().width() + self._row.spacing()
        middle = Qt.TextElideMode.ElideMiddle
        shown = " ".join(metrics.elidedText(word, middle, room) for word in self._said.split(" "))
        self._label.setText(shown)
        self._label.setToolTip(self._whole if shown != self._whole else "")

    def _show(self, message: str, role: Role) -> None:
        self._role = role
        self._whole, self._said = message, bare_names(message)
        self._fit(self.width())
        self._place()
        self.show()
        self.raise_()
        self.update()
