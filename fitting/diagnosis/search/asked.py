"""What fits of candidates are asked for: one thing each, as it is handed to another process."""

from collections.abc import Sequence
from typing import NamedTuple

from fitting.arrays import Array
from fitting.diagnosis.inference.refitted import Refitted
from fitting.diagnosis.search.candidates import CandidateState
from fitting.diagnosis.search.looks import Start
from fitting.effects.base import Effect
from fitting.laws import CoreLaw

Form = tuple[str, int]
"""An effect by its name, and the number of its variant."""
State = list[CandidateState]
"""What is known of each variant of an effect."""


class OfEffect(NamedTuple):
    """An effect, and what is known of it so far."""

    name: str
    state: State


class BesideBest(NamedTuple):
    """An effect with what is known of it, to begin from the law of another one's fit."""

    name: str
    state: State
    best: Refitted


class OfForm(NamedTuple):
    """A form, and what is known of it so far."""

    form: Form
    known: CandidateState


class FormFit(NamedTuple):
    """A form and a fit: a rough one of it, or the one whose law it is to begin from."""

    form: Form
    fitted: Refitted


class FormStart(NamedTuple):
    """A start of a form, and the chi-square that it must come below to be among the best."""

    form: Form
    start: Start
    rival: float


class ToFollow(NamedTuple):
    """A fit of a form that is to go on, and the chi-square that it must come down to."""

    form: Form
    fitted: Refitted
    goal: float


class ToEnd(NamedTuple):
    """A rough fit of any effects that is to go to its end, and the chi-square that it must come down to."""

    fitted: Refitted
    goal: float


class Beside(NamedTuple):
    """Forms that are looked at beside a fit."""

    before: Refitted
    forms: Sequence[Form]


class Second(NamedTuple):
    """A form to be fitted beside a fit, its starts best first, and the chi-square it must come down to."""

    before: Refitted
    form: Form
    starts: list[Start]
    goal: float


class SecondWide(NamedTuple):
    """A form to be fitted beside a fit in a wide valley, and its starts there. Shape (parameters,) each."""

    before: Refitted
    form: Form
    starts: list[Array]


class LawBeside(NamedTuple):
    """An effect of another law, by its name, beside a fit, and the chi-square it must come down to."""

    before: Refitted
    name: str
    goal: float


class OneOfPair(NamedTuple):
    """A fit of two effects, and the one of them that stays."""

    pair: Refitted
    effect: Effect


class FromLaw(NamedTuple):
    """Effects with the law and unknowns that their fit begins from. Shape of `u` as in `Refitted`."""

    effects: Sequence[Effect]
    law: CoreLaw
    u: Array
