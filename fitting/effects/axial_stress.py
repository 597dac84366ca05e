"""Clamps pull a beam or a plate along, or press it, by more than their tolerance."""

from collections.abc import Mapping

from fitting.arrays import Array, Complex
from fitting.digits import two_digits
from fitting.effects.base import Effect, EffectParameter
from fitting.effects.given import Points
from fitting.effects.number_off import changed_by_numbers
from fitting.plate.plate_numbers import moved as restated
from fitting.specimen import PlateSpecimen
from fitting.widened.change import Change
from fitting.widened.enriched_plate import EnrichedReducedPlate
from fitting.widened.full_plate import FullPlate, Snapshot
from fitting.widened.other_plates import changed_to, forces
from fitting.widened.span import Span

_STRESSES_PA = (-3e6, 20e6)
"""Whose motions are spanned. A choice."""


class Pulled(Span):
    """Motions of a plate that is pulled along x or y."""

    def __init__(self, along: str) -> None:
        self.along, self.name = along, f"pulled_{along}"

    def forces(self, full: FullPlate, at: Snapshot) -> Complex:
        return forces(full, at, [with_stress(full.specimen, self.along, s) for s in _STRESSES_PA])


def with_stress(specimen: PlateSpecimen, along: str, more_pa: float) -> PlateSpecimen:
    """The plate pulled by so much more, where clamps on opposite edges may pull it."""
    return restated(specimen, [f"axial_{along}"], [more_pa]) if along in specimen.pulled_along else specimen


def _stress(key: str) -> EffectParameter:
    return EffectParameter(key, "MPa", -50.0, 200.0, 3.0, spread=10.0, below=0.4, mounting=3.0)


class AxialStressEffect(Effect):
    """A force along a plate between clamps: its work is half of it times the integral of w_x^2, or w_y^2."""

    name = "axial_stress"
    enters = "stiffness"
    source = "Timoshenko, Vibration Problems in Engineering (1937), a bar with an axial force"
    needs = frozenset({"two clamps"})
    chance = 0.05
    discriminating_test = "one of its clamps loosened and tightened again, or clamped on one edge alone"

    def __init__(self, along: str = "x") -> None:
        self.along = along
        self.spans = (Pulled(along),)
        self.parameters = (_stress(f"stress_{along}"),)

    def on(self, kind: str) -> Effect | None:
        return AxialStressOfBeamEffect() if kind == "beam" else super().on(kind)

    def variants(self) -> tuple[Effect, ...]:
        return (self, AxialStressEffect("y"))

    def objection(self, points: Points, plate: EnrichedReducedPlate) -> str | None:
        pulled = self.along in plate.specimen.pulled_along
        return None if pulled else f"no clamps pull it along {self.along}"

    def change(self, plate: EnrichedReducedPlate, u: Array) -> Change:
        return changed_to(plate, with_stress(plate.specimen, self.along, 1e6 * float(u[0])))

    def story(self, u: Mapping[str, float]) -> str:
        return _story(f"the plate along {self.along}", u[f"stress_{self.along}"])


class AxialStressOfBeamEffect(AxialStressEffect):
    """The same of a beam, w_x alone."""

    def __init__(self) -> None:
        super().__init__()
        self.spans = ()
        self.parameters = (_stress("stress"),)

    def variants(self) -> tuple[Effect, ...]:
        return (self,)

    def objection(self, points: Points, plate: EnrichedReducedPlate) -> str | None:
        return None

    def change(self, plate: EnrichedReducedPlate, u: Array) -> Change:
        return changed_by_numbers(plate, {"axial": 1e6 * float(u[0])})

    def story(self, u: Mapping[str, float]) -> str:
        return _story("the beam along", u["stress"])


def _story(what: str, stress_mpa: float) -> str:
    verb = "pull" if stress_mpa > 0 else "press"
    return f"its clamps {verb} {what} with {two_digits(abs(stress_mpa))} MPa in its faces"
