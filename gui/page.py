"""What every page of the window is."""

from collections.abc import Callable
from typing import ClassVar

from PySide6.QtGui import QShowEvent
from PySide6.QtWidgets import QWidget

from gui.actions.controller import AppController
from gui.state import SessionState, Topic


class Page(QWidget):
    """One view of the session state. Subclasses say `title` and draw in `refresh`.

    Parameters
    ----------
    controller : AppController
        What a person can do here.
    """

    title: ClassVar[str] = ""
    hint: ClassVar[str] = ""
    """What it shows, for the tool tip."""

    def __init__(self, controller: AppController) -> None:
        super().__init__()
        self.controller = controller
        self._state: SessionState | None = None
        self._drawn: SessionState | None = None
        self._version = -1
        self._seen: dict[Topic, int] = {}

    def refresh(self, state: SessionState) -> None:
        """Draw what has changed. Called while the page is seen, at most 30 times a second."""
        raise NotImplementedError

    def begin(self) -> None:
        """Forget the session so far: another one is drawn next. Nothing by default."""

    def clear(self) -> None:
        """There is no session (any more). Nothing by default."""

    @property
    def unsaved(self) -> bool:
        """Whether a person's changes would be lost with the window. Nothing by default."""
        return False

    def before_lost(self, then: Callable[[], object]) -> None:
        """Ask what becomes of them, and go on with `then` unless they are to stay."""
        then()

    def news(self, *topics: Topic) -> bool:
        """Whether one of the topics changed since this was last asked; also true for another session."""
        assert self._state is not None
        fresh = False
        for topic in topics:
            now = self._state.changed[topic]
            fresh |= self._seen.get(topic, -1) != now
            self._seen[topic] = now
        return fresh

    def show_state(self, state: SessionState | None) -> None:
        """From the window, at every turn: the state there is now."""
        self._state = state
        if self.isVisible():
            self._draw()

    def redraw(self) -> None:
        """Draw all of it again, or when it is next seen: other units count from now on."""
        self._version = -1
        self._seen.clear()
        if self.isVisible():
            self._draw()

    def showEvent(self, event: QShowEvent) -> None:
        """Catch up with what changed meanwhile."""
        super().showEvent(event)
        self._draw()

    def _draw(self) -> None:
        if self._state is None:
            if self._drawn is not None:
                self._drawn, self._version = None, -1
                self.begin()
                self.clear()
            return
        if self._state is not self._drawn:
            self._drawn, self._version = self._state, -1
            self._seen.clear()
            self.begin()
        if self._state.version != self._version:
            self._version = self._state.version
            self.refresh(self._state)
