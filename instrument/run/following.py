"""After the sweep: diagnose, measure what would tell the explanations left apart, diagnose again."""

from collections.abc import Callable
from dataclasses import dataclass

from fitting.specimen import PlateSpecimen
from fitting.structures import AnySpecimen
from instrument.check.forecast import distinct
from instrument.facts.follow_up import FollowUp, Support
from instrument.files.experiment_file import DiagnosisTable
from instrument.run.analysis import Analysis
from instrument.run.follow_up_steps import clamped_again, follow_up_segments, possible
from instrument.run.rig import Rig
from instrument.run.runner import Runner
from instrument.run.sweep_part import SweepPart
from instrument.stepped_sine.settings import Limits
from instrument.stream.derived import DiagnosisFound, PointMeasured
from instrument.stream.event import Event
from instrument.stream.raw import (
    ClampedAnew,
    FollowUpDecided,
    FollowUpEnded,
    FollowUpProposed,
    MassPut,
    SpotMoved,
    StrikingBegan,
)


@dataclass(frozen=True)
class Earlier:
    """What a run that was broken off has behind it."""

    found: tuple[DiagnosisFound, ...]
    """The first of the sweep alone, one more after each measurement."""
    proposed: dict[int, FollowUpProposed]
    decided: dict[tuple[int, int], FollowUpDecided]
    """What was decided, by numbers of measurement and offer."""
    ended: frozenset[int]
    spots: tuple[SpotMoved, ...]
    mounting: int = 0
    """How often the plate was clamped anew."""

    @classmethod
    def of(cls, events: list[Event]) -> "Earlier":
        """From its events."""
        return cls(
            tuple(e for e in events if isinstance(e, DiagnosisFound)),
            {e.number: e for e in events if isinstance(e, FollowUpProposed)},
            {(e.number, e.offer): e for e in events if isinstance(e, FollowUpDecided)},
            frozenset(e.number for e in events if isinstance(e, FollowUpEnded)),
            tuple(e for e in events if isinstance(e, SpotMoved)),
            max((e.mounting for e in events if isinstance(e, ClampedAnew)), default=0),
        )


@dataclass
class Following:
    """Measurements of one run that follow its diagnosis."""

    table: DiagnosisTable
    limits: Limits
    specimen: AnySpecimen
    analysis: Analysis
    sweep: SweepPart
    earlier: Earlier
    emit: Callable[[Event], object]
    diagnose: Callable[[], DiagnosisFound | None]
    strike: Callable[[], None] | None
    """The bare plate's hammer test; None where there is none to make."""
    blows: Callable[[], None] | None = None
    """On the treated plate; None where there is no hammer."""
    whole_length_m: float | None = None
    """Of the treated plate, what its clamp grips included; None: it is not known, and not hung free."""

    def __post_init__(self) -> None:
        plate = self.specimen
        self._spots = dict(enumerate(plate.pickups_m if isinstance(plate, PlateSpecimen) else ()))
        for moved in self.earlier.spots:
            x, y = moved.spot_mm
            self._spots[moved.pickup] = (1e-3 * x, 1e-3 * y)
        # Spot, and whether a mass is on the plate, as this run has them.
        self._at, self._loaded = 0, False
        self._mounting = self.earlier.mounting
        self._clamping: FollowUp | None = None
        """That the plate has to be clamped for once more: nobody knows what happened to it meanwhile."""
        self._left_s = self.table.follow_up_most_s
        self.found: DiagnosisFound | None = None
        """The last diagnosis."""

    def run(self, rig: Rig, runner: Runner, ready: Callable[[], None]) -> None:
        """Until one explanation is left, nobody wants more, or it is enough.

        `ready` is called before anything is driven. Raises as `Runner.sweep`.
        """
        for number in range(1, self.table.follow_up_at_most + 1):
            offer = self._taken(number, rig) if self._diagnosed(number) else None
            if offer is None:
                return
            self._left_s -= offer.seconds
            if number in self.earlier.ended:
                self._clamping = _to_clamp(offer) or self._clamping
            else:
                ready()
                self._measure(number, offer, rig, runner)
                self.emit(FollowUpEnded(number))
        self._diagnosed(self.table.follow_up_at_most + 1)

    def _diagnosed(self, number: int) -> bool:
        known = self.earlier.found
        self.found = known[number - 1] if len(known) >= number else self.diagnose()
        return self.found is not None and self.found.result is not None

    def _taken(self, number: int, rig: Rig) -> FollowUp | None:
        """What is to be measured; None where nothing can or may be."""
        for k, offer in enumerate(self._offers(number)):
            decided = self.earlier.decided.get((number, k))
            if decided is None:
                alone = not offer.needs_hands and not (self._at or self._loaded or self._clamping)
                by_itself = self.table.follow_up == "do" and alone
                agreed = by_itself or rig.operator.agree(offer)
                decided = FollowUpDecided(number, k, agreed, "experiment" if by_itself else "person")
                self.emit(decided)
            if decided.agreed:
                return offer
        return None

    def _offers(self, number: int) -> tuple[FollowUp, ...]:
        """As they were, or are, proposed."""
        proposed = self.earlier.proposed.get(number)
        if proposed is None:
            assert self.found is not None
            assert self.found.result is not None
            offers = possible(
                self.found.result.next_measurements,
                self._steps,
                self.limits,
                most_s=self._left_s,
                can_strike=self.strike is not None and self.analysis.damping is None,
                held=self._held,
            )
            if not offers:
                return ()
            proposed = FollowUpProposed(number, self.found.number, offers)
            self.emit(proposed)
        return proposed.offers

    @property
    def _held(self) -> tuple[Support, ...]:
        """How the treated plate can be struck."""
        if self.blows is None:
            return ()
        return ("clamped",) if self.whole_length_m is None else ("clamped", "free")

    @property
    def _steps(self) -> list[PointMeasured]:
        return [p for p in self.analysis.points if p.purpose == "step"]

    def _measure(self, number: int, offer: FollowUp, rig: Rig, runner: Runner) -> None:
        if offer.kind == "bare_hammer":
            assert self.strike is not None
            self.strike()
            self.emit(rig.operator.mount("damped"))
            self._at = 0
            self.sweep.fit_again()
            return
        if self._loaded:
            # First of all: a plate mounted anew is taken for one that is seen where it was at first.
            self.emit(rig.operator.mount("damped"))
            self._loaded = False
        if offer.kind == "damped_struck" and offer.held == "free":
            self._blows(offer, rig)
            self._clamping = clamped_again(offer)
            return
        clamping = offer if offer.kind == "clamping" else self._clamping
        if clamping is not None:
            self._clamp(clamping, rig, aim=offer.spot_mm is None)
        if offer.spot_mm is not None:
            # What is to be done to the clamp has been asked for.
            self.emit(rig.operator.change(offer.but(kind="spot", todo=_aimed(offer.spot_mm))))
            self._at = self._number_of(offer.spot_mm)
            self.emit(SpotMoved(self._at, offer.spot_mm))
        elif self._at:
            self.emit(rig.operator.aim("pickup"))
            self._at = 0
        if offer.kind == "damped_struck":
            self._blows(offer, rig)
            return
        if offer.mass_kg is not None and offer.mass_at_mm is not None:
            self.emit(rig.operator.change(offer))
            self.emit(MassPut(offer.mass_kg, offer.mass_at_mm))
            self._loaded = True
        own = [p for p in self._steps if p.pickup == 0 and p.mass_at_mm is None]
        every = distinct(rig.vibrometer.ranges)
        calibrated = tuple(r for r in every if r.name in self.analysis.calibrations)
        segments = follow_up_segments(offer, own, self.sweep.passes + number, calibrated or every)
        self.sweep.follow(runner, segments, self._mounting)

    def _blows(self, offer: FollowUp, rig: Rig) -> None:
        plate = self.specimen
        assert self.blows is not None
        assert isinstance(plate, PlateSpecimen)
        assert offer.struck_mm is not None
        assert offer.held is not None
        length_m = self.whole_length_m if offer.held == "free" else plate.length_m
        assert length_m is not None
        self.emit(rig.operator.change(offer))
        size_mm = round(1e3 * length_m, 6), round(1e3 * plate.width_m, 6)
        self.emit(StrikingBegan(offer.held, offer.struck_mm, offer.spot_mm, size_mm, self._mounting))
        self.blows()

    def _clamp(self, clamping: FollowUp, rig: Rig, *, aim: bool) -> None:
        self.emit(rig.operator.change(clamping.but(spot_mm=None)))
        self._mounting += 1
        self.emit(ClampedAnew(self._mounting))
        self._clamping = None
        if aim:
            # The plate is not quite where it was.
            self.emit(rig.operator.aim("pickup"))
        self._at = 0

    def _number_of(self, spot_mm: tuple[float, float]) -> int:
        """Of a spot; a new one comes after all others."""
        at = (1e-3 * spot_mm[0], 1e-3 * spot_mm[1])
        known = [k for k, p in self._spots.items() if p == at]
        number = known[0] if known else len(self._spots)
        self._spots[number] = at
        return number


def _to_clamp(done: FollowUp) -> FollowUp | None:
    """What has to be done to the clamp once more, after a measurement of a run that was broken off."""
    if done.kind == "clamping":
        return done
    return clamped_again(done) if done.held == "free" else None


def _aimed(spot_mm: tuple[float, float]) -> str:
    return f"Point the laser at ({spot_mm[0]:.0f}, {spot_mm[1]:.0f}) mm."
