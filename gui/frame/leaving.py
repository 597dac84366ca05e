"""What a person is asked who closes the window while a run goes on."""

from typing import NamedTuple

from gui.actions.controller import AppController
from gui.state.run import State

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
