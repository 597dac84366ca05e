"""Fits that are to be made, and from where, as a search holds them until `CandidateFits` makes them."""

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


class FormFit(NamedTuple):
    """A form, and a rough fit of it."""

    form: Form
    fitted: Refitted


class FormStart(NamedTuple):
    """A start of a form, and the chi-square that it must come below to be among the best."""

    form: Form
    start: Start
    rival: float


class ToFollow(NamedTuple):
    """A rough fit of a form that is to go on, and the chi-square that it must come down to."""

    form: Form
    fitted: Refitted
    goal: float


class Beside(NamedTuple):
    """Forms that are looked at beside a fit."""

    before: Refitted
    forms: Sequence[Form]


class FromLaw(NamedTuple):
    """Effects with the law and unknowns that their fit begins from. Shape of `u` as in `Refitted`."""

    effects: Sequence[Effect]
    law: CoreLaw
    u: Array
