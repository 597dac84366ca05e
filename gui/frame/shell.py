"""What the menus know of the window they belong to."""

from pathlib import Path

from PySide6.QtWidgets import QMainWindow

from gui.actions.controller import AppController
from gui.frame.log_pane import LogPane
from gui.frame.notice import Notice
from gui.frame.settings import Settings
from gui.page import Page
from gui.style.theme import Appearance


class Shell(QMainWindow):
    """Its parts, and what can be done with it as a whole."""

    controller: AppController
    notice: Notice
    settings: Settings
    appearance: Appearance
    log: LogPane

    @property
    def pages(self) -> tuple[Page, ...]:
        """All of them, in the order of their keys."""
        raise NotImplementedError

    @property
    def page_titles(self) -> dict[str, str]:
        """By the pages' names, in the order of their keys."""
        raise NotImplementedError

    def show_acceleration_in(self, name: str) -> None:
        """As `instrument.files.acceleration` calls it."""
        raise NotImplementedError

    def open(self, path: Path) -> None:
        """A session, an experiment, or other data; returns at once."""
        raise NotImplementedError

    def show_page(self, name: str) -> None:
        """As `gui.pages` calls it."""
        raise NotImplementedError
