"""The fits that one law over temperatures may need, each tried where the one before leaves doubt."""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from fitting.errors import FittingError
from fitting.temperature.causes import Cause, causes_of, common, explains
from fitting.temperature.joint import TemperatureProblem, fit_shifted
from fitting.temperature.members import Alone
from fitting.temperature.shifted_fit import ShiftedFit
from fitting.temperature.shifts import Shift
from fitting.temperature.simple import AGREED, OddOne, in_doubt
from fitting.temperature.spots import spots_moved
from fitting.temperature.tables import Tables
from fitting.temperature.thermometers import each_its_own
from instrument.processes.other_processes import executor
from instrument.progress import Progress
from instrument.remarks.modal_reads import remark_on_reading
from instrument.remarks.theory import check_each_theory
from instrument.temperatures.members import Members
from instrument.temperatures.temperature_remarks import remarks_at_temperatures

_FREER = 2
"""Times that a law is let bend further before it is refused. A choice."""
_ROUNDS = 2
"""Fits of tables after the first, each about the law that the one before has found. A choice."""
_ENOUGH_LEFT = 3
"""Members that have to go together for another one to be the odd one. A choice."""
_ASIDE = 3.0
"""Standard deviations of a spot's place: one that is aimed anew lies no further off. A choice."""


@dataclass(frozen=True)
class TemperatureFits:
    """Members under one law, shifted so, and every fit of them that may be asked for."""

    members: Members
    shift: Shift
    vertical: bool
    progress: Progress

    def fitted(self, *, with_effects: bool) -> tuple[list[Alone], TemperatureProblem, ShiftedFit]:
        """Each temperature by itself, then all of them; with models that effects can change, or without."""
        with self.progress("each temperature by itself") as report:
            alone = self.members.alone(report, with_effects=with_effects)
        with self.progress("one law for all"):
            return alone, *self._fit_of(self._task(alone, self.shift), alone)

    def _task(self, alone: Sequence[Alone], shift: Shift) -> TemperatureProblem:
        joined = self.members.joined([a.begun for a in alone])
        return TemperatureProblem(joined, shift, self.vertical).near([a.begun.none.law for a in alone])

    def _fit_of(
        self, problem: TemperatureProblem, alone: Sequence[Alone]
    ) -> tuple[TemperatureProblem, ShiftedFit]:
        """A fit; of tables of modes fits after it, with the model's errors as the law before them has them.

        These go with the law: peaks differ from the model's modes twice as much in a transition as beside it.
        """
        begun = [a.begun for a in alone]
        laws, z = [b.none.law for b in begun], problem.stated([b.none.z for b in begun])
        fit = fit_shifted(problem, laws, z)
        for _ in range(_ROUNDS):
            again = problem.erring_at(fit.joint)
            if again is None:
                break
            problem, fit = again, fit_shifted(again, laws, z)
        return problem, fit

    def read_otherwise(self, alone: Sequence[Alone]) -> str:
        """As `Members.read_otherwise`."""
        with self.progress("reading the modes otherwise"):
            return self.members.read_otherwise(alone)

    def freer(self, problem: TemperatureProblem, fit: ShiftedFit) -> ShiftedFit:
        """One law that bends further, where that is all that one law lacks; else the fit as it is."""
        with self.progress("a law that bends further"):
            tried = fit
            for _ in range(_FREER):
                found = problem.freer(tried) if in_doubt(tried) else None
                if found is None:
                    break
                tried = found
        return fit if in_doubt(tried) else tried

    def with_own_spots(self, alone: Sequence[Alone]) -> tuple[TemperatureProblem, ShiftedFit] | None:
        """A fit in which the laser was aimed anew at each sweep; None where one law serves no better so.

        Nor is it one where a spot would have to lie further off than it is stated to.
        """
        numbers = self.members.numbers
        if self.members.are_tables or len(set(numbers)) == len(numbers):
            return None
        again = replace(self, members=replace(self.members, own_spots=True))
        task = again._task(alone, self.shift)
        if not len(spots_moved(task.joined, np.zeros(len(task.joined.each)))):
            return None
        with self.progress("a spot of its own for each temperature"):
            problem, fit = again._fit_of(task, alone)
        if in_doubt(fit) and explains(fit):
            fit = again.freer(problem, fit)
        near = np.all(np.abs(spots_moved(problem.joined, fit.one.z)) <= _ASIDE)
        return (problem, fit) if near and fit.one.converged and not in_doubt(fit) else None

    def each_apart(self, alone: Sequence[Alone]) -> ShiftedFit | None:
        """One law with a factor for every member, whatever its temperature; None where it is no other."""
        if self.shift.kind == "free" and len(np.unique(self.shift.temperature_c)) == len(alone):
            return None
        with self.progress("a factor for each of them"):
            return self._fit_of(self._task(alone, each_its_own(self.shift)), alone)[1]

    def odd_ones(self, alone: Sequence[Alone]) -> list[OddOne]:
        """The members without any one of which one law explains all others; none where that is most."""
        p = []
        with self.progress("the others, without each in turn") as report:
            for k in range(len(alone)):
                p.append(self._p_without(k, alone))
                report((k + 1) / len(alone))
        found = [OddOne(k, one) for k, one in enumerate(p) if one >= AGREED]
        return found if len(found) <= len(alone) / 2 else []

    def _p_without(self, k: int, alone: Sequence[Alone]) -> float:
        """Zero where not even a law for each of the others explains them, or they are too few to disagree."""
        others = [i for i in range(len(alone)) if i != k]
        T = self.shift.temperature_c[others]
        if len(others) < _ENOUGH_LEFT or len(np.unique(T)) <= self.shift.fewest:
            return 0.0
        its = replace(
            self,
            members=replace(self.members, every=[self.members.every[i] for i in others], remarks=[]),
            shift=replace(self.shift, temperature_c=T),
        )
        rest = [alone[i] for i in others]
        try:
            fit = its._fit_of(its._task(rest, its.shift), rest)[1]
        except FittingError:
            return 0.0
        return fit.p_value if explains(fit) else 0.0

    def common_causes(
        self, alone: Sequence[Alone], problem: TemperatureProblem, fit: ShiftedFit
    ) -> list[Cause]:
        """What all may have in common: channels first, which ask for no other model of the specimen."""
        effects, join = common(self.members.effects), self.members.joined
        with executor() as workers:
            with self.progress("a common cause in the channels") as report:
                plain = [e for e in effects if not e.spans]
                found = causes_of(alone, problem, fit, plain, join, workers, report)
            if any(c.serves for c in found):
                return found
            spanned, problem, fit = self.fitted(with_effects=True)
            with self.progress("a common cause in specimen and rig") as report:
                return causes_of(spanned, problem, fit, effects, join, workers, report)

    def remarks(self, problem: TemperatureProblem, fit: ShiftedFit) -> tuple[str, ...]:
        """What is to be said of data, specimens and theory. Raises `OutsideModel`."""
        of_members = remarks_at_temperatures(self.members, vertical=self.vertical)
        said = (*self.members.remarks, *of_members, *_theories(self.members, fit))
        if isinstance(problem.joined, Tables):
            tables = problem.joined.problem.members
            said += remark_on_reading(tables, [fit.joint.at(k) for k in range(len(tables))])
        return said


def _theories(members: Members, fit: ShiftedFit) -> tuple[str, ...]:
    """Raises `OutsideModel` where the theory of layers does not hold for the law at one temperature."""
    said = dict[str, None]()
    for k, (one, band) in enumerate(zip(members.every, fit.bands_hz, strict=True)):
        law = fit.joint.at(k) if members.are_tables else fit.own_law(k)
        said |= dict.fromkeys(check_each_theory([members.specimen(one)], law, [np.array(band)]))
    return tuple(said)
