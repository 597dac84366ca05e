"""What a form of an effect takes over from it: the same cause in other files, or on another structure."""

from typing import Any

from fitting.effects.base import Effect

TAKEN_OVER = (
    "name",
    "enters",
    "source",
    "discriminating_test",
    "caution",
    "unexplained_share",
    "chance",
    "causes",
    "sharp",
    "needs_time",
    "of_a_segment",
    "beside_others",
)
"""What a form of an effect says of itself as that one does.

Not its unknowns, motions and needs, which are the form's; not `between_files`, `replaces_law`, `anew`,
`from_afar` and `structures`, which decide beforehand what forms there are; not `extends` and `twice`, which
speak of unknowns one after the other.
"""


def taken_over(effect: Effect) -> dict[str, Any]:
    """What a form takes over from an effect, by name."""
    return {name: getattr(effect, name) for name in TAKEN_OVER}
