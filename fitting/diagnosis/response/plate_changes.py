"""What effects and stated numbers change of a plate, from the unknowns of a response."""

from collections.abc import Collection
from functools import reduce

from fitting.arrays import Array
from fitting.diagnosis.problem.base import DiagnosisProblem
from fitting.diagnosis.response.unknowns import Unknowns
from fitting.effects.base import Effect
from fitting.widened.change import Change
from fitting.widened.enriched_plate import EnrichedReducedPlate


class PlateChanges:
    """What stated numbers and effects change of one problem's `plate`. `u` has shape (unknowns,)."""

    def __init__(
        self,
        problem: DiagnosisProblem,
        unknowns: Unknowns,
        plate: EnrichedReducedPlate,
        without: Collection[int] = (),
    ) -> None:
        """`without` the effects of these numbers."""
        self.plate, self._unknowns, self._nuisances = plate, unknowns, problem.nuisances
        self._at_base = problem.points.drive == "base"
        changing = [k for k, e in enumerate(unknowns.effects) if type(e).change is not Effect.change]
        self.effects = [k for k in changing if k not in without]
        """Numbers of those that change a plate."""
        self._latest: tuple[bytes, Change] | None = None

    def every(self, u: Array) -> Change:
        """By all effects, and by what is stated."""
        found = [self.of(k, u, self.plate) for k in self.effects]
        return reduce(Change.and_then, [*found, *self.stated(u)], Change())

    def of(self, k: int, u: Array, plate: EnrichedReducedPlate) -> Change:
        """By effect k, on a plate that has its motions."""
        own, effect = self._unknowns.of(k, u), self._unknowns.effects[k]
        change = self.moving(effect.change(plate, own))
        longer = effect.longer_m(own)
        if longer and self._nuisances.masses:
            moved = self._nuisances.masses_moved(plate, u[self._unknowns.stated], longer)
            change = change.and_then(self.moving(moved))
        return change

    def stated(self, u: Array) -> list[Change]:
        """By the stated numbers, if any of them does; the latest is kept."""
        if self._nuisances.change_nothing:
            return []
        z = u[self._unknowns.stated]
        if self._latest is None or self._latest[0] != z.tobytes():
            self._latest = z.tobytes(), self._nuisances.change(self.plate, z)
        return [self._latest[1]]

    def moving(self, change: Change | None) -> Change:
        """As the drive feels it: only a moving base carries along what sits on the plate."""
        change = change or Change()
        return change if self._at_base else change.at_rest

    def key(self, u: Array) -> bytes:
        """Alike where nothing is changed otherwise."""
        own = b"".join(self._unknowns.of(k, u).tobytes() for k in self.effects)
        return own + u[self._unknowns.stated].tobytes()
