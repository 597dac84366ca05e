"""The pages of one window, each made and fed on its own: another package's takes no other one down.

The window's own pages are made when they are wanted: making all of them takes longer than showing the first.
"""

from gui.actions.controller import AppController
from gui.page import Page
from gui.pages import PAGES
from gui.state import SessionState

MOST_KEYS = 9
"""Ctrl+1 to Ctrl+9."""


class PageSet:
    """In the order of `PAGES`; a page's object name is its name there.

    Another package's are made at once: what cannot be made is left out before anything is shown of it.

    Attributes
    ----------
    kinds : dict
        Class of each page, by name: its title and hint are known before it is made.
    made : dict
        Pages there are so far, by name.
    """

    def __init__(self, controller: AppController) -> None:
        self._controller = controller
        self.kinds: dict[str, type[Page]] = {name: PAGES[name] for name in PAGES}
        self.made: dict[str, Page] = {}
        self._state: SessionState | None = None
        for name in [n for n in self.kinds if not PAGES.is_own(n)]:
            try:
                self.page(name)
            except Exception as error:  # whatever another package's page raises, the window opens without it
                PAGES.leave_out(name, error)
                del self.kinds[name]
        self._fed = set(self.kinds)

    def page(self, name: str) -> Page:
        """The page of a name, made now where there is none yet. Raises `KeyError`."""
        if name not in self.made:
            page = self.kinds[name](self._controller)
            page.setObjectName(name)
            self.made[name] = page
            if self._state is not None:
                page.show_state(self._state)
        return self.made[name]

    def redraw(self) -> None:
        """Draw every page that there is again, in the units that are set now."""
        for name, page in self.made.items():
            if name in self._fed:
                page.redraw()

    def show_state(self, state: SessionState | None) -> None:
        """Show a state on every page that there is. Another package's that fails is told nothing any more."""
        self._state = state
        for name, page in list(self.made.items()):
            if name not in self._fed:
                continue
            try:
                page.show_state(state)
            except Exception as error:  # whatever another package's page raises, the others are shown
                if PAGES.is_own(name):
                    raise
                PAGES.leave_out(name, error)
                page.setEnabled(False)
                self._fed.discard(name)


def key_of(number: int) -> str | None:
    """Of a page, counted from 0; None for one beyond the keys there are."""
    return f"Ctrl+{number + 1}" if number < MOST_KEYS else None
