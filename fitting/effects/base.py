"""What an effect is: a physical cause the plate model lacks, with unknowns to be fitted.

To add one, put a file beside this one with a class derived from `Effect`. It says where the effect enters
by overriding some of the hooks; all others leave the response as it is.

    v = channel(i w (x + h y_p + t travel) a + added),   A x = load + t travel_load,   t = -1 / w^2,
    A = -w^2 M + i w C_1 + K_0 + G K_1 + changes
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import ClassVar, Literal, NamedTuple

import numpy as np
from numpy.typing import NDArray

from fitting.arrays import Array, Complex
from fitting.data.noise import Noise
from fitting.effects.given import BarePlateModes, ModulusAt, Points, Swings, Ways
from fitting.laws import CoreLaw
from fitting.specimen import KINDS, Kind, StatedSpecimen
from fitting.sweep import Sweep
from fitting.widened.change import Change
from fitting.widened.enriched_plate import EnrichedReducedPlate
from fitting.widened.span import Span

Entry = Literal["stiffness", "mass", "load", "observation", "channel", "time", "level", "core law", "damping"]
"""Where an effect enters. It decides, beside what people are told:

* `stiffness`, `damping`, `core law`: of the plate itself. No file of one plate has it alone.
* `mass`, `load`: on the plate, or of the rig that shakes it. Of files of one plate seldom one has it alone.
* `observation`: of how the plate is read. It may be in the readings at one spot alone.
* `channel`: what the electronics make of a reading. Seldom it is in the readings at one spot alone. A further
  measurement may have it or not.
* `time`: goes with the time of a reading. Where it may be there, a sweep in another order tells something. A
  plate that is struck afterwards does not have it.
* `level`: goes with the level of the drive. A file driven by a force lacks it where the base of another one
  moves, and a plate that is struck afterwards lacks it too.

Sweeps at several temperatures may share what enters by any but `core law`, `time` and `level`.
"""

PLATE_ONLY: frozenset[Kind] = frozenset({"plate"})
BASE, CLAMP, FORCE = frozenset({"base"}), frozenset({"clamp"}), frozenset({"force"})
ROOT = CLAMP | {"root"}
WHOLE, ONE_SIDE = frozenset({"whole"}), frozenset({"one side"})
CONSTRAINED, ONE_PIECE = frozenset({"constraining"}), frozenset({"one piece"})
PLATE_AND_BEAM: frozenset[Kind] = frozenset({"plate", "beam"})
EVERY_STRUCTURE = frozenset(KINDS)


@dataclass(frozen=True)
class EffectParameter:
    """One number of an effect. A fit moves it within its plausible range."""

    key: str
    unit: str
    lower: float
    upper: float
    typical: float
    """A size that matters: the scale of a fit's steps, and of the first look."""
    logarithmic: bool = False
    """Fitted in its logarithm."""
    neutral: float | None = 0.0
    """Where the effect is absent; None for an unknown that only says where or how."""
    shape: bool = False
    """Says how, and nothing by itself where the effect is weak: a stronger start has the same of it."""
    fixed: bool = False
    """Not moved by a fit: one of the starts."""
    complete: bool = False
    """A limit means that the effect is fully present: a fit that ends there is not suspect."""
    spread: float | None = None
    """How large such a thing is in a laboratory that has it, in `unit`: the scale of its prior. None: 3
    `typical`.

    An unknown without a neutral value is as likely anywhere within its limits, one with a logarithm in its
    logarithm.
    """
    below: float = 0.5
    """How likely it is to lie below its neutral value, where it may lie on both sides."""
    mounting: float | None = None
    """Standard deviation of how much it differs once the specimen was clamped anew with another torque, or
    was measured another time (`Effect.anew`): in its logarithm, or in `unit`. None for what that leaves as
    it is.
    """

    @property
    def says_how_much(self) -> bool:
        """Whether it is a size: what goes to its neutral value as the effect goes."""
        return self.neutral is not None and not self.fixed and not self.shape


class Tie(NamedTuple):
    """Two unknowns of an effect that are nearly one."""

    first: int
    other: int
    sigma: float
    """Standard deviation of their difference, as they are fitted: of their logarithms where they have one."""


@dataclass(frozen=True)
class ChannelFinding:
    """What a channel shows by itself, without any model of the plate."""

    values: Mapping[str, tuple[float, float, str]]
    """Key to value, standard error and unit."""
    aside: NDArray[np.bool_]
    """Points it spoils. Shape (points,)."""


class Effect:
    """A physical cause. `u` holds the values of `parameters`, in their units. Shape (parameters,)."""

    name: ClassVar[str]
    enters: ClassVar[Entry]
    """Where it enters: what follows from that, `Entry` says."""
    source: ClassVar[str]
    """Literature that it follows, for people only: nothing is decided by it."""
    parameters: tuple[EffectParameter, ...] = ()
    spans: tuple[Span, ...] = ()
    discriminating_test: ClassVar[str] = ""
    """The measurement that shows this effect apart from others."""
    caution: ClassVar[str] = ""
    """What its formula leaves out that readings hardly tell, where that matters to the law: a sentence."""
    replaces_law: ClassVar[bool] = False
    unexplained_share: ClassVar[float] = 0.0
    """Share of the chi-square it explains that its own formula may leave
    (`fitting.diagnosis.checks.predictive`)."""

    structures: ClassVar[frozenset[Kind]] = PLATE_ONLY
    """Kinds of specimens on which it has a meaning as it is."""

    needs: ClassVar[frozenset[str]] = frozenset()
    """What a specimen must offer: a `base` that moves, a `force` at a point, a `clamp`, a plate's `root`, one
    side treated as a `whole`; of a beam a `constraining` layer, `two clamps`, and to be `one piece`, not two
    halves about a driven centre."""

    chance: ClassVar[float] = 0.02
    """Prior probability that a laboratory's set-up has it, to be seen or not."""

    causes: ClassVar[int] = 1
    """How many independent causes it counts for: two, where it is two masses."""

    between_files: ClassVar[bool] = False
    """Whether it says how one file differs from the others: one alone cannot show it."""

    sharp: ClassVar[bool] = False
    """Whether it adds a resonance of its own to the plate: a mass that swings at one place (`swings`).

    What it does is computed at every point, not interpolated between nodes. To `change`, the reduced plate
    has one motion more (`EnrichedReducedPlate.with_part`).
    """

    anew: ClassVar[bool] = False
    """Whether it differs from file to file, as everything that depends on time does."""

    needs_time: ClassVar[bool] = False
    """Whether it follows from when each point was read, and an even pace is supposed where nobody says."""

    of_a_segment: ClassVar[bool] = False
    """Whether it is in one segment of a sweep alone: the others cannot foretell it."""

    from_afar: bool = False
    """Whether a rough fit that begins with inflated noise (in a wide valley) is tried too, however well the
    fits from the usual starts do.

    Law and stated numbers may imitate the effect so well that those fits never leave them.
    """

    beside_others: bool = True
    """Whether it is looked for beside another effect; a form that only says more of what another form finds
    need not be."""

    extends: ClassVar[str | None] = None
    """A simpler effect that this one contains."""

    twice: ClassVar[bool] = False
    """Whether it is two of what it extends, their unknowns one after the other."""

    def on(self, kind: str) -> Effect | None:
        """The form it has on a `plate`, `beam` or `shear-pair`; None where it has no meaning."""
        return self if kind in self.structures else None

    def form_on(self, specimens: Sequence[StatedSpecimen]) -> Effect | None:
        """The form it has on some specimens of one kind; None where it has no meaning."""
        return self.on(specimens[0].kind)

    def standing_on(self, specimen: StatedSpecimen) -> Effect | None:
        """The form it has on a specimen; None where that lacks what it needs."""
        form = self.form_on([specimen])
        return form if form is not None and form.needs <= specimen.offers else None

    def seen(self, sweep: Sweep, noise: Noise) -> ChannelFinding | None:
        """Its trace in the channels themselves."""
        return None

    def objection(self, points: Points, plate: EnrichedReducedPlate) -> str | None:
        """Why this effect cannot be judged by these data, or None."""
        return None

    def passes_for_a_law(self, points: Points) -> bool:
        """Whether these data show it as another law of the core, so that it is neither searched nor named.

        Then an explanation by another law may as well be this effect, and no law shows that it is absent.
        """
        return False

    def starts(self, plate: EnrichedReducedPlate, points: Points) -> list[Array]:
        """Values to look at first; the best of them by a linear step is followed.

        Shape (parameters,) each.
        """
        return [np.array([u.typical for u in self.parameters])]

    def variants(self) -> tuple[Effect, ...]:
        """Forms of it that are tried apart, the best one kept."""
        return (self,)

    def forms(self, points: Points, plate: EnrichedReducedPlate) -> tuple[Effect, ...]:
        """Variants to which these data raise no objection."""
        return tuple(form for form in self.variants() if form.objection(points, plate) is None)

    def laws(self, stated: CoreLaw, points: Points) -> list[CoreLaw]:
        """Laws to be tried in the place of the stated one."""
        return []

    def following(self, found: CoreLaw, stated: CoreLaw, points: Points) -> list[CoreLaw]:
        """Further laws to be tried, beside the one of `laws` that does best."""
        return []

    def within(self, u: Array) -> tuple[tuple[Effect, Array], ...]:
        """Simpler effects contained in this one, each with its unknowns at `u`.

        A fit may end where only one part of this effect acts: that part is then fitted alone, from there.
        Shapes (parameters,) each.
        """
        return ()

    def elsewhere(self, plate: EnrichedReducedPlate, u: Array) -> list[Array]:
        """Alternative positions for the same effect, each tried once where it explains most.

        Shape (parameters,) each.
        """
        return []

    @property
    def ties(self) -> tuple[Tie, ...]:
        """Unknowns known beside others of its own: the prior of `other` is about `first`."""
        return ()

    def shows(self, points: Points, resonances: Complex, u: Array) -> bool:
        """Whether points see it by itself. One that they do not see may stand in for anything smooth.

        `resonances`: poles of the structure without it, in and near the points, rad/s. Shape (poles,).
        """
        return True

    def is_beyond(self, u: Array) -> bool:
        """Whether it is more than is plausible where no limit of one unknown says so. Shape (parameters,)."""
        return False

    def scaled(self, u: Array, a: float) -> Array:
        """`u` with the effect `a` times as strong, by a linear guess. Shape (parameters,)."""
        found = u.copy()
        for k, q in enumerate(self.parameters):
            if q.neutral is None or not q.says_how_much:
                continue
            found[k] = u[k] / a if np.isinf(q.neutral) else q.neutral + a * (u[k] - q.neutral)
        return found

    def limits(self, plate: EnrichedReducedPlate) -> tuple[Array, Array]:
        """Least and largest values of the unknowns. Shape (parameters,) each."""
        return np.array([u.lower for u in self.parameters]), np.array([u.upper for u in self.parameters])

    def change(self, plate: EnrichedReducedPlate, u: Array) -> Change | None:
        """What it changes of the reduced plate; None: nothing. `u` of shape (parameters,)."""
        return None

    def coming_in(self, plate: EnrichedReducedPlate, u: Array) -> Change | None:
        """The same to first order as it comes in, but for `sharply`. `u` of shape (parameters,)."""
        return self.change(plate, u)

    def sharply(self, omega: Array, u: Array) -> Complex | None:
        """Factor on what `coming_in` makes of the reading; None: one. Shape of `omega`, in rad/s."""
        return None

    def swings(self, plate: EnrichedReducedPlate, u: Array) -> Swings | None:
        """What is `sharp`: the mass that is felt `sharply`, and where. `u` of shape (parameters,)."""
        return None

    def modulus(self, G: ModulusAt, points: Points, u: Array) -> Complex | None:
        """The core's modulus in Pa at every point; None: the law's at the point's frequency.

        Shape (..., points), as `G` gives it: its derivatives are of many laws at once.
        """
        return None

    def modulus_along(self, G: ModulusAt, points: Points, u: Array, ways: Ways) -> Complex | None:
        """Derivatives of `modulus` as the core is strained otherwise; None: it does not go by the strain.

        Shape (ways, points).
        """
        return None

    def modulus_by(self, G: ModulusAt, points: Points, u: Array, step: Array) -> Complex | None:
        """What `modulus` differs by from a step below to one above in its own numbers; None as `modulus`.

        Shape (points,), of `step` as of `u`.
        """
        up, down = (self.modulus(G, points, one) for one in (u + step, u - step))
        return None if up is None or down is None else up - down

    def pitch(self, omega: Array, u: Array) -> Complex | None:
        """Angular acceleration of the base over its acceleration, rad/m. Shape of `omega`."""
        return None

    def reading(self, v: Complex, points: Points, u: Array) -> Complex | None:
        """What the channels make of velocities `v` in m/s; None: nothing. Shape (..., points), as `v`.

        Each reading goes by its own point's velocity alone, and smoothly.
        """
        return None

    def longer_m(self, u: Array) -> float:
        """By how much more than its stated length the plate is free over; masses stay by the free end.

        `u` of shape (parameters,).
        """
        return 0.0

    def bare_shift(self, bare: BarePlateModes, u: Array) -> Array:
        """Change of ln f of the bare plate's modes. Shape (modes,)."""
        return np.zeros(len(bare.lowering_per_density))

    def bare_forms(self, u: Array) -> list[Array]:
        """Its unknowns as a bare plate may have them, where readings of the treated one do not say which.

        Each is as likely as another. Shape (parameters,) each.
        """
        return [u]

    def story(self, u: Mapping[str, float]) -> str:
        """What the plate or the rig does, in half a sentence with numbers."""
        raise NotImplementedError
