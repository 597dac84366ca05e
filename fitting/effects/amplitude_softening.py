"""The core softens with strain (Payne effect): the harder the plate is driven, the softer it is."""

from collections.abc import Mapping
from dataclasses import replace
from itertools import product

import scipy.sparse as sp

from fitting.arrays import Array, Complex
from fitting.effects.base import Effect, EffectParameter
from fitting.effects.given import ModulusAt, Points, Ways
from fitting.effects.softened_core import SoftenedCore, softened_core
from fitting.laws.kraus import HALF, Kraus, strained, strained_along
from fitting.plate.element import core_shear_stiffness
from fitting.widened.enriched_plate import EnrichedReducedPlate
from fitting.widened.full_plate import FullPlate
from fitting.widened.span import Span

_LEVELS = 1.2
"""Of the largest force over the least: over less, strain is a function of frequency, as the law is."""

_K = EffectParameter("k", "1", -0.5, 0.8, 0.1, spread=0.15)
_SATURATION = EffectParameter("saturation", "1", 0.0, 4.0, 0.3, shape=True, spread=0.5)
"""Strain of the reference over that at which half of what can be lost is lost."""
_LOSS = EffectParameter("loss", "1", -0.3, 0.6, 0.03, spread=0.1)
"""Gained in loss modulus at the reference, over the mean, sqrt(G' G''), of what is not softened."""
_KEPT = EffectParameter("kept", "1", 0.0, 1.0, 0.7, shape=True, complete=True, spread=0.5)
"""Of what is lost, the share that the largest strain so far has taken and that does not come back."""
_EXPONENT = EffectParameter("exponent", "1", 0.2, 0.8, 0.52, neutral=HALF, shape=True, spread=0.1)
"""Kraus' m."""


class CoreStrain(Span):
    """The core's shear strain: mean square over its volume."""

    name = "strain"
    strains = True

    def matrices(self, full: FullPlate) -> Mapping[str, sp.sparray | Array]:
        s = full.specimen
        assert s.core is not None
        assert s.constraining is not None
        shape, layers = full.loose.mesh.shape, (s.core, s.substrate, s.constraining)
        shear = [(c.elements, core_shear_stiffness(shape, *layers, c.over)) for c in full.loose.cells]
        whole = sum(
            (full.loose.scatter(A, of) for of, A in shear[1:]), full.loose.scatter(shear[0][1], shear[0][0])
        )
        return {"mean_square": whole / (s.treated_m2 * s.core.thickness_m)}


class AmplitudeSofteningEffect(Effect):
    """The core's modulus by `Kraus`, s = strain / reference, the strain that of the softened plate.

    Without saturation it is first order in the strain: what little softening shows of. `keeps`: a share of
    what is lost goes by the largest strain so far (Mullins' effect).
    """

    name = "amplitude_softening"
    enters = "level"
    source = (
        "Payne, J. Appl. Polym. Sci. 6 (1962), first order in the strain amplitude; saturating, and with the "
        "loss that it gains: Kraus, J. Appl. Polym. Sci., Appl. Polym. Symp. 39 (1984), his exponent a half; "
        "what stays: Mullins, Rubber Chem. Technol. 42 (1969)"
    )
    parameters: tuple[EffectParameter, ...] = (_K,)
    spans = (CoreStrain(),)
    unexplained_share = 0.004
    chance = 0.03
    discriminating_test = "another level"

    def __init__(self, *, saturates: bool = False, rubs: bool = False, keeps: bool = False) -> None:
        self.saturates, self.rubs, self.keeps = saturates, rubs, keeps
        # Beside another effect softening that comes back is looked for first.
        self.beside_others = not keeps
        self.parameters = (
            _K,
            *[_SATURATION] * saturates,
            *[_LOSS] * rubs,
            *[_EXPONENT] * (saturates and rubs),
            *[_KEPT] * keeps,
        )

    def on(self, kind: str) -> Effect | None:
        own = {"shear-pair": PadSofteningEffect, "beam": BeamSofteningEffect}.get(kind)
        return own() if own else super().on(kind)

    def variants(self) -> tuple[Effect, ...]:
        each = product((False, True), repeat=3)
        return tuple(type(self)(saturates=c, rubs=b, keeps=kept) for kept, b, c in each)

    def objection(self, points: Points, plate: EnrichedReducedPlate) -> str | None:
        if self.keeps and not points.timed:
            return "the points carry no time: none is known to be the first"
        if points.drive == "base":
            enough = points.levels > 1 or not self.saturates
            return None if enough else "one level does not tell how softening saturates"
        if points.force_n is None:
            return "nothing says how large the force was"
        several = points.force_n.max() > _LEVELS * points.force_n.min()
        return None if several else "one size of the force does not tell softening from the law"

    def modulus(self, G: ModulusAt, points: Points, u: Array) -> Complex:
        core = self._core(G, points, u)
        return strained(G(), core.lost, core.gained)

    def modulus_along(self, G: ModulusAt, points: Points, u: Array, ways: Ways) -> Complex:
        core = self._core(G, points, u)
        lost, gained = core.along(ways(core.lost, core.gained if core.curve.loss else None))
        return strained_along(G(), lost, gained)

    def modulus_by(self, G: ModulusAt, points: Points, u: Array, step: Array) -> Complex:
        core = self._core(G, points, u)
        beside = [replace(core, curve=self._curve(v), kept=self._kept(v)) for v in (u + step, u - step)]
        lost, gained = core.along_own(beside)
        return strained_along(G(), lost, gained)

    def _core(self, G: ModulusAt, points: Points, u: Array) -> SoftenedCore:
        kept = self._kept(u)
        time_s = points.time_s.tobytes() if kept else b""
        return softened_core(self._curve(u), G.strain, len(points.omega), kept, time_s)

    def _kept(self, u: Array) -> float:
        return float(u[-1]) if self.keeps else 0.0

    def _curve(self, u: Array) -> Kraus:
        of = dict(zip((q.key for q in self.parameters), map(float, u), strict=True))
        return Kraus(of["k"], of.get("saturation", 0.0), of.get("loss", 0.0), of.get("exponent", HALF))

    def story(self, u: Mapping[str, float]) -> str:
        told = (
            f"the core {'softens' if u['k'] > 0 else 'stiffens'} with strain, by {100 * abs(u['k']):.2g} % "
            "at the largest strain of the sweep at 1 g (of a force: at 1 N)"
        )
        told = f"{told}, and {'gains' if u['loss'] > 0 else 'loses'} loss" if "loss" in u else told
        return f"{told}; {100 * u['kept']:.0f} % of it stays when the strain is gone" if "kept" in u else told


class BeamSofteningEffect(AmplitudeSofteningEffect):
    """The same of a beam, whose free layers do not shear."""

    def objection(self, points: Points, plate: EnrichedReducedPlate) -> str | None:
        if "strain.mean_square" not in plate.names:
            return "a free layer does not shear"
        return super().objection(points, plate)


class PadSofteningEffect(AmplitudeSofteningEffect):
    """The same of a pad in shear, seen from two levels on."""

    def objection(self, points: Points, plate: EnrichedReducedPlate) -> str | None:
        if points.drive == "force" or (self.keeps and not points.timed):
            return super().objection(points, plate)
        one_level = "one level does not tell softening from the law"
        return one_level if self.passes_for_a_law(points) else None

    def passes_for_a_law(self, points: Points) -> bool:
        # Over one level the strain of a pad goes up and down once over a wide band, as a law may.
        return points.drive == "base" and points.levels < 2
