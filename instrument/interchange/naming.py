"""Names that somebody gives to what a file holds: of its columns in order, or of some by their own names."""

import re
from collections.abc import Iterable
from dataclasses import dataclass, field

from instrument.errors import BadInput

OF_ARRAYS = (
    "'viscorig import' with --columns 'f=Frequency [Hz],H=FRF [(m/s^2)/N]' names what is called f and H"
)
"""For people."""
PASSED_OVER = "-"
"""The name of what is left out."""
_BETWEEN = re.compile(r",(?![^\[\]]*\])")
"""Names, not what stands in the brackets of a unit."""
_SHOWN = 100


@dataclass(frozen=True)
class Naming:
    """One of both."""

    in_order: tuple[str, ...] = ()
    """Empty or `-` for what is passed over."""
    by_own: dict[str, str] = field(default_factory=dict)
    """From a file's own name to what it is called instead."""

    @classmethod
    def of(cls, text: str) -> "Naming":
        """`Frequency [Hz],FRF [g/N],-`, or `f=Frequency [Hz],H=FRF [g/N]`; raises `BadInput` for both."""
        names = [name.strip() for name in _BETWEEN.split(text)]
        pairs = [[part.strip() for part in name.split("=", 1)] for name in names]
        if all(len(pair) == 1 for pair in pairs):
            return cls(tuple(names))
        for name, pair in zip(names, pairs, strict=True):
            if len(pair) == 1 or not all(pair):
                raise BadInput(f"--columns: {name!r}, expected OWN=NAME as of the others")
        owns = [own for own, _ in pairs]
        for own in owns:
            if owns.count(own) > 1:
                raise BadInput(f"--columns: {own} twice, expected each once")
        names = [name for _, name in pairs if name != PASSED_OVER]
        for name in names:
            if names.count(name) > 1:
                raise BadInput(f"--columns: {name} twice, expected a name for each")
        return cls((), dict(pairs))

    def named(self, where: str, owns: Iterable[str]) -> list[str]:
        """Names of some columns in the place of their own. Raises `BadInput` where one is not there."""
        there = list(owns)
        for own in self.by_own:
            if own not in there:
                raise BadInput(
                    f"{where}: no {own} as --columns has it, found {', '.join(there)[:_SHOWN] or 'nothing'}"
                )
        return [self.by_own.get(own, own) for own in there]
