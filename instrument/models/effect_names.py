"""Names of effects as someone wrote them."""

from collections.abc import Iterable

from fitting.effects import CATALOGUE
from instrument.errors import BadInput
from instrument.files.nearest import nearest


def refuse_unknown_effects(names: Iterable[str]) -> None:
    """Raises `BadInput` for the first that no effect has, with the one that was probably meant."""
    for name in sorted(set(names) - set(CATALOGUE)):
        meant = nearest(name, CATALOGUE)
        expected = meant if meant is not None else f"one of {', '.join(sorted(CATALOGUE))}"
        raise BadInput(f"effect {name!r}, expected {expected}")
