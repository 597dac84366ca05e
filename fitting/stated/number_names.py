"""The name of a stated number, as results and files list it, taken apart in one place.

pickup_y         the pickup's, along y
damping_3        of the third mode
place_2_x [1]    of the second mass, along x; whose it is of several files stands in brackets
"""

import re
from dataclasses import dataclass

from fitting.stated.tolerances import NUMBERS, StatedNumber

_WHICH = re.compile(r"(?:_(?P<item>\d+))?(?:_(?P<axis>[xy]))?")
"""What may follow the kind."""


@dataclass(frozen=True)
class NumberName:
    """Which number a name means."""

    kind: str
    """A key of `NUMBERS`."""
    counted: int | None = None
    """Of which mode, mass, patch or resonance, from 1 on; None: of none."""
    along: str = ""
    """`x` or `y`; empty for neither."""

    @property
    def number(self) -> StatedNumber:
        """What there is to know of its kind."""
        return NUMBERS[self.kind]

    @property
    def item(self) -> int:
        """Of which it is, from 0 on. Raises `LookupError` where it is of none."""
        if not self.counted:
            raise LookupError(f"{self.kind}: of which?")
        return self.counted - 1

    @property
    def axis(self) -> int:
        """0 along x, 1 along y. Raises `LookupError` where it is along neither."""
        if not self.along:
            raise LookupError(f"{self.kind}: along which axis?")
        return "xy".index(self.along)


def number_name(name: str) -> NumberName:
    """Which number is meant. Raises `ValueError` where none is called so.

    What else a name says after its kind, as older files do, says no item and no axis.
    """
    own = name.partition(" [")[0]
    # Some kinds have a line in their name, no kind with more after its name has.
    kind = own if own in NUMBERS else own.partition("_")[0]
    which = _WHICH.fullmatch(own.removeprefix(kind)) or _WHICH.fullmatch("")
    assert which is not None
    # A mode's damping: modes count from 1, and have no axis.
    of_no_mode = kind == "damping" and (not int(which["item"] or 0) or which["axis"] is not None)
    if kind not in NUMBERS or of_no_mode:
        raise ValueError(f"no stated number is called {own!r}")
    return NumberName(kind, int(which["item"]) if which["item"] else None, which["axis"] or "")


def kind_of(name: str) -> str:
    """The kind that one number is of: `pickup` of `pickup_x`. Raises `ValueError`."""
    return number_name(name).kind
