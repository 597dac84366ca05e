"""A result that is the JSON of a command: the facts, and nothing that is not among them."""

from dataclasses import dataclass
from typing import Any, Generic, TypeVar

from instrument.facts.result import Result
from viscorig.shown import Shown

R = TypeVar("R", bound=Result, covariant=True)


@dataclass(frozen=True, repr=False)
class Facts(Shown, Generic[R]):
    """What a command's `--json` writes, computed or recorded."""

    result: R

    def as_dict(self) -> dict[str, Any]:
        """The facts of the command, to the bit; NaN is None."""
        return self.result.as_json()

    @property
    def warnings(self) -> tuple[str, ...]:
        """What speaks against the result."""
        return tuple(getattr(self.result, "warnings", ()))
