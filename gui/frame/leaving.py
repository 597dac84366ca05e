"""What a person is asked who closes the window while a run goes on, and how the run is then ended."""

from typing import NamedTuple

from PySide6.QtCore import QObject, QTimer
from PySide6.QtWidgets import QMessageBox, QWidget

from gui.actions.controller import AppController
from gui.state.run import State
from gui.widgets.asking import ask_word
from instrument.engine.client import ENDS_S

_COMPUTING: dict[State, str] = {"identifying": "The last fit", "diagnosing": "The diagnosis"}


class Question(NamedTuple):
    """In words."""

    text: str
    yes: str


_DRIVEN = Question("Stop the shaker, end the run and close? What is complete is kept.", "Stop and close")


def leaving_question(controller: AppController) -> Question:
    """Of the shaker, wherever it is not known to be at rest; else of what is still computed."""
    if not controller.commands.at_rest or controller.state is None:
        return _DRIVEN
    what = _COMPUTING.get(controller.state.run.state, "The run")
    text = f"{what} goes on; the shaker is at rest. End it and close? What was measured is kept."
    return Question(text, "End and close")


class Leaving(QObject):
    """Of one window, which it closes once the run has ended."""

    def __init__(self, window: QWidget, controller: AppController) -> None:
        super().__init__(window)
        self._window, self._controller = window, controller
        self._closing = False
        self._asked: QMessageBox | None = None
        """Whether to close although a run goes on."""

    def ask(self) -> None:
        """Whether the run may end, unless that was said."""
        if not self._closing:
            self._ask()

    def insist(self) -> bool:
        """Take a question that stands there for agreed to; whether one did."""
        if self._asked is None or not (self._controller.running and self._asked.isVisible()):
            return False
        self._asked.close()
        self._leave()
        return True

    def turn(self) -> None:
        """Close where the run has ended meanwhile; ask anew where the question is another one by now."""
        if not self._controller.running:
            if self._asked is not None:
                # There is nothing left to ask.
                self._asked.close()
                self._asked = None
            if self._closing:
                self._window.close()
        elif (box := self._asked) is not None and box.isVisible() and box.text() != self._question.text:
            # What is measured after a diagnosis has the shaker again.
            self._ask()

    @property
    def _question(self) -> Question:
        return leaving_question(self._controller)

    def _ask(self) -> None:
        self._asked = ask_word(self._window, "A run goes on", *self._question, self._leave)

    def _leave(self) -> None:
        self._closing = True
        commands = self._controller.commands
        if commands.at_rest:
            commands.abort()
            # One that hangs is ended as one that drives is; where it has ended, nothing is left to stop.
            QTimer.singleShot(round(1e3 * ENDS_S), self, commands.stop)
        else:
            commands.stop()
