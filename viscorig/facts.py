"""A result that is the JSON of a command: the facts, and nothing that is not among them."""

from copy import deepcopy
from dataclasses import dataclass
from typing import Any

from viscorig.shown import Shown


@dataclass(frozen=True, repr=False)
class Facts(Shown):
    """What a command's `--json` writes, computed or recorded."""

    facts: dict[str, Any]

    def as_dict(self) -> dict[str, Any]:
        """The facts of the command, to the bit; NaN is None."""
        return deepcopy(self.facts)

    @property
    def warnings(self) -> tuple[str, ...]:
        """What speaks against the result."""
        return tuple(self.facts.get("warnings", ()))
