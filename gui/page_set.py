"""The pages of one window, each made and fed on its own: another package's takes no other one down."""

from gui.controller import AppController
from gui.page import Page
from gui.pages import PAGES
from gui.state import SessionState

MOST_KEYS = 9
"""Ctrl+1 to Ctrl+9."""


class PageSet:
    """Made once, in the order of `PAGES`; a page's object name is its name there."""

    def __init__(self, controller: AppController) -> None:
        made = ((name, _made(name, controller)) for name in PAGES)
        self.by_name: dict[str, Page] = {name: page for name, page in made if page is not None}
        self._fed = dict(self.by_name)

    @property
    def all(self) -> tuple[Page, ...]:
        """In the order of their keys."""
        return tuple(self.by_name.values())

    def show_state(self, state: SessionState | None) -> None:
        """To every page. Another package's that fails is told nothing any more."""
        for name, page in list(self._fed.items()):
            try:
                page.show_state(state)
            except Exception as error:
                if PAGES.is_own(name):
                    raise
                PAGES.leave_out(name, error)
                page.setEnabled(False)
                del self._fed[name]


def key_of(number: int) -> str | None:
    """Of a page, counted from 0; None for one beyond the keys there are."""
    return f"Ctrl+{number + 1}" if number < MOST_KEYS else None


def _made(name: str, controller: AppController) -> Page | None:
    try:
        page = PAGES[name](controller)
    except Exception as error:
        if PAGES.is_own(name):
            raise
        PAGES.leave_out(name, error)
        return None
    page.setObjectName(name)
    return page
