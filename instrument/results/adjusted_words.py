"""The stated numbers that a joint fit moved, as people read them: the most moved first."""

from collections.abc import Sequence

from fitting.identification.adjusted import Adjusted
from fitting.specimen import StatedSpecimen
from fitting.stated.number_names import kind_of
from fitting.stated.tolerances import OF_THEORY
from instrument.results.numbers import to_error

COLUMNS = ("stated number", "stated", "tolerance", "found", "standard error", "pull", "tolerance is")
MOST = 8


def adjusted_rows(found: Sequence[Adjusted], specimen: StatedSpecimen, most: int = MOST) -> list[list[str]]:
    """Rows of `COLUMNS`; the pull is how far the number was moved, in tolerances."""
    order = sorted(found, key=lambda one: -abs(one.pull))
    return [
        [
            one.name + ("" if one.unit == "1" else f" / {one.unit}"),
            f"{one.stated:.5g}",
            f"{one.tolerance:.2g}",
            to_error(one.found, one.standard_error),
            f"{one.standard_error:.2g}",
            f"{one.pull:+.2f}",
            _known_by(kind_of(one.name), specimen),
        ]
        for one in order[:most]
    ]


def more_adjusted(found: Sequence[Adjusted], most: int = MOST) -> str:
    """How many are not listed, and how little they were moved; empty for none."""
    rest = sorted((abs(one.pull) for one in found), reverse=True)[most:]
    return f"{len(rest)} more moved by {rest[0]:.2f} tolerances or less" if rest else ""


def _known_by(kind: str, specimen: StatedSpecimen) -> str:
    """Who says what its tolerance is."""
    if kind in OF_THEORY:
        return "the theory's"
    return "named" if kind in specimen.tolerances else "typical"
