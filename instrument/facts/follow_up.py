"""A measurement that would tell rival explanations of a sweep apart."""

from typing import Literal

from instrument.facts.number import MaybeNumber, Number
from instrument.facts.result import Result

FollowUpKind = Literal[
    "frequencies", "level", "reversed", "spot", "added_mass", "bare_hammer", "damped_struck", "clamping"
]

Support = Literal["clamped", "free"]
"""How a treated plate is held that is struck."""


class FollowUp(Result):
    """One measurement that has not been made, what it costs and what it would tell."""

    kind: FollowUpKind
    needs_hands: bool
    """False: the rig can do it as it stands."""
    frequencies_hz: tuple[Number, ...] = ()
    """Steps in the order in which they are to be made; empty where none is (a blow)."""
    segments: tuple[int, ...] = ()
    """Of each step: its resonance region, numbered as in the sweep that was diagnosed; new ones follow."""
    level_g: MaybeNumber = None
    velocities_m_s: tuple[Number, ...] = ()
    """Foreseen at each step by the likeliest explanation, where the laser reads another spot than before."""
    spot_mm: tuple[Number, Number] | None = None
    """Where the laser is to point, x from the clamp and y from a long edge."""
    struck_mm: tuple[Number, Number] | None = None
    """Where the treated plate is to be struck, x from the clamp and y from a long edge."""
    held: Support | None = None
    """How the plate is held while it is struck."""
    mass_kg: MaybeNumber = None
    """To be put on the plate."""
    mass_at_mm: tuple[Number, Number] | None = None
    seconds: Number
    """Rig time, and a person's time where it needs one."""
    separation: Number
    """Expected gain of what explains the data over the nearest rival: nats of log Bayes factor."""
    probability_resolved: Number
    """Chance that one explanation holds 95 % afterwards."""
    then: FollowUpKind | None = None
    """What would follow best where this settles nothing; None where nothing would be worth it."""
    expected_seconds: MaybeNumber = None
    """Until one explanation is left, with what would follow; the question, left open, counts as an hour."""
    between: tuple[str, ...]
    """Explanations that it separates, the likeliest first: `none`, an effect, two joined by " + "."""
    why: str
    """One sentence for a person."""
    todo: str
    """One sentence for a person."""


class FollowedUp(Result):
    """A measurement that a run made after a diagnosis, and what came of it."""

    measured: FollowUp
    agreed_by: Literal["experiment", "person"]
    verdict_before: str
    """In words."""
    verdict_after: str = ""
    """Empty where no diagnosis followed."""
