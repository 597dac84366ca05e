"""What is diagnosed, apart from how: data and plate, what is looked for, and where fits begin."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

from fitting.data.noise import Noise
from fitting.diagnosis.inference.evidence import BareModes
from fitting.diagnosis.problem.base import DiagnosisProblem
from fitting.effects.base import Effect
from fitting.laws import CoreLaw
from fitting.reduced.reduced_plate import ReducedPlate
from fitting.sweep import Sweep


@dataclass(frozen=True)
class DiagnosisCase:
    """A sweep with its plate, and the effects that may be in it."""

    problem: DiagnosisProblem
    """It holds the points in use."""
    effects: Sequence[Effect]
    """What is looked for."""
    noise: Noise
    """Of the points in use."""
    start: CoreLaw
    """What the fit without effects begins with."""
    bare: BareModes | None = None
    """The hammer test of the bare plate, where there is one."""
    reduced: ReducedPlate | None = None
    """The plate without what effects need, which tells the model's error; None of small structures."""
    remade: Callable[[Sweep], DiagnosisProblem] | None = None
    """The problem of some of the points; None where a search cannot be repeated."""
