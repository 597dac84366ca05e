"""Sees to it that the stop key and the stop button work wherever the keyboard and the mouse are.

A filter of the whole application: keys are seen before any widget, menu or dialog gets them; and no dialog is
modal, whoever opens it, because Qt would hold back what goes to the window below it.
"""

from collections.abc import Callable
from time import monotonic

from PySide6.QtCore import QEvent, QObject, Qt
from PySide6.QtGui import QKeyEvent, QMouseEvent, QShowEvent, QWindow
from PySide6.QtWidgets import QApplication, QDialog, QPushButton

_TWICE_S = 1.0
"""Two presses of Esc within this time are meant."""
_KEYS = (QEvent.Type.KeyPress, QEvent.Type.ShortcutOverride)


class StopGuard(QObject):
    """Of one window; sees to nothing until it is on duty.

    Parameters
    ----------
    button : QPushButton
        Pressed with the mouse while a menu or a list is open, it acts: Qt would only close that.
    stop : callable
        What to do.
    escaped : callable
        Told at the first Esc.
    """

    def __init__(
        self, button: QPushButton, stop: Callable[[], object], escaped: Callable[[], object]
    ) -> None:
        super().__init__(button)
        self._button, self._stop, self._escaped = button, stop, escaped
        self._escaped_s = -_TWICE_S
        self._on_duty = False

    def be_on_duty(self, wanted: bool) -> None:
        """While a run goes on or is about to begin.

        Else nothing can be stopped; and a filter is asked about every event there is, thirty thousand of them
        while the pages are made.
        """
        application = QApplication.instance()
        if wanted == self._on_duty or application is None:
            return
        self._on_duty = wanted
        if wanted:
            application.installEventFilter(self)
        else:
            application.removeEventFilter(self)

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """True where the event has done its work here."""
        # By class: asking every event of a busy window for its type would cost more than all else here.
        if isinstance(event, QKeyEvent):
            return event.type() in _KEYS and self._key(watched, event)
        if isinstance(event, QShowEvent):
            if isinstance(watched, QDialog) and watched.isModal():
                watched.setWindowModality(Qt.WindowModality.NonModal)
        elif isinstance(event, QMouseEvent) and event.type() == QEvent.Type.MouseButtonPress:
            self._pressed(event)
        return False

    def _key(self, watched: QObject, event: QKeyEvent) -> bool:
        pressed = event.type() == QEvent.Type.KeyPress
        if event.key() == Qt.Key.Key_F12:
            # Claimed before any shortcut; the key itself comes next.
            event.accept()
            if pressed:
                self._stop()
            return True
        # A key goes from the window down to a widget and up again; at the window it is seen once.
        if event.key() == Qt.Key.Key_Escape and pressed and isinstance(watched, QWindow):
            self._escape()
        return False

    def _escape(self) -> None:
        """Once closes what is open, twice stops the shaker."""
        now = monotonic()
        twice, self._escaped_s = now - self._escaped_s < _TWICE_S, now
        if twice:
            self._stop()
        else:
            self._escaped()

    def _pressed(self, event: QMouseEvent) -> None:
        open_now = QApplication.activePopupWidget()
        if open_now is None or not self._button.isVisible() or not self._button.isEnabled():
            return
        at = event.globalPosition().toPoint()
        if open_now.geometry().contains(at):
            return
        if self._button.rect().contains(self._button.mapFromGlobal(at)):
            self._stop()
