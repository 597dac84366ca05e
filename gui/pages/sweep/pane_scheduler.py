"""Which pane is drawn when: one at a time, with rests between, so that the window stays quick."""

from collections.abc import Callable
from time import perf_counter

from PySide6.QtCore import QObject, QTimer
from PySide6.QtWidgets import QWidget

_REST = 3.0
"""After drawing, so many times as long nothing is drawn ..."""
_LONGEST_REST_S = 0.2
"""... but no longer than this."""


class PaneScheduler(QObject):
    """Panes that no longer show what is known wait here for their turn.

    Parameters
    ----------
    page : QWidget
        Nothing is drawn while it is not seen.
    panes : callable
        Those a person sees at this moment.
    draw : callable
        Draws one.
    """

    def __init__(
        self, page: QWidget, panes: Callable[[], list[QWidget]], draw: Callable[[QWidget], None]
    ) -> None:
        super().__init__(page)
        self._page, self._panes, self._draw = page, panes, draw
        self._stale: set[QWidget] = set()
        self._last: QWidget | None = None
        self._rest = QTimer(self)
        self._rest.setSingleShot(True)
        self._rest.timeout.connect(self.go_on)

    def mark(self, *panes: QWidget) -> None:
        """These are to be drawn again."""
        self._stale.update(panes)

    def go_on(self) -> None:
        """Draw the next one, unless it is time to rest."""
        if self._rest.isActive() or not self._page.isVisible():
            return
        pane = next((p for p in self._in_turn() if p in self._stale), None)
        if pane is None:
            return
        began = perf_counter()
        self._draw_one(pane)
        self._rest.start(round(1e3 * min(_REST * (perf_counter() - began), _LONGEST_REST_S)))

    def at_once(self) -> None:
        """Draw all that is seen: a person did something and waits for it."""
        if self._page.isVisible():
            for pane in self._panes():
                if pane in self._stale:
                    self._draw_one(pane)

    def _draw_one(self, pane: QWidget) -> None:
        self._stale.discard(pane)
        self._last = pane
        self._draw(pane)

    def _in_turn(self) -> list[QWidget]:
        """Those behind the one drawn last come first."""
        panes = self._panes()
        behind = panes.index(self._last) + 1 if self._last in panes else 0
        return panes[behind:] + panes[:behind]
