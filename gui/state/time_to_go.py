"""How long a run will still take, all of it, and how far it is. No Qt.

A piece of work is forecast before the run begins; each kind is then weighed with what its pieces took so far,
so that the forecast grows true as the run goes on. Measuring goes by the session's clock, waiting for a
person and computing by the wall's.
"""

from collections import deque
from dataclasses import dataclass, field

from instrument.check.piece import Kind, TimedPiece
from instrument.facts.follow_up import FollowUp
from instrument.planning.measurement import HANDS_S
from instrument.stream.derived import DiagnosisFound, FitUpdated, HitJudged, PointMeasured
from instrument.stream.event import Event
from instrument.stream.raw import (
    AcquisitionBegan,
    DiagnosisStarted,
    FitFailed,
    FitStarted,
    FollowUpDecided,
    FollowUpEnded,
    FollowUpProposed,
    HammerTestEnded,
    Held,
    OperatorDid,
    SoakBegan,
    SoakEnded,
    StepBegan,
)

_SETTLES = 0.53
"""Of the time from scratch that settling takes as a rule: a step begins near its end. Of twenty plans by
chance no forecast at 10, 30 and 60 % of a run is off by 15 % then (tests/by_hand/time_to_go.py)."""
_PRIOR = 2.0
"""So many pieces of a kind count as having gone as forecast."""
_PACE_KNOWN = 0.25
"""Of a diagnosis: its first share is faster or slower than the rest, the next ones are not. A choice."""
_DIDS: dict[str, Kind] = {"mounted": "mount", "aimed": "aim", "changed": "change"}
_POINTS: dict[str, Kind] = {"calibration": "calibration", "step": "step", "sentinel": "sentinel"}
_ON_WALL: tuple[Kind, ...] = ("mount", "aim", "change", "fit", "diagnosis")

_FOLLOWING: tuple[Kind, ...] = ("change", "step")
"""Of a measurement after a diagnosis."""


@dataclass
class _Pace:
    """Of one kind."""

    forecast_s: float = 0.0
    took_s: float = 0.0
    pieces: int = 0

    def learn(self, work: TimedPiece, took_s: float) -> None:
        self.forecast_s += _seconds(work)
        self.took_s += took_s
        self.pieces += 1

    @property
    def ratio(self) -> float:
        """Of what it takes to what was forecast."""
        if not self.pieces:
            return 1.0
        prior_s = _PRIOR * self.forecast_s / self.pieces
        return (self.took_s + prior_s) / (self.forecast_s + prior_s)


@dataclass
class TimeToGo:
    """Follows one run; `plan` it first."""

    _left: dict[Kind, deque[TimedPiece]] = field(default_factory=dict)
    _paces: dict[Kind, _Pace] = field(default_factory=dict)
    _done_s: float = 0.0
    """Of all pieces that are done, as long as they took."""
    _session_s: float = 0.0
    """Where the piece in progress began, on the session's clock."""
    _wall_s: float = 0.0
    """The same on the wall's."""
    _held: bool = False
    _fit_began_s: float | None = None
    _fraction: float | None = None
    """Of the computation in progress."""
    _planned: bool = False
    _offers: tuple[FollowUp, ...] = ()
    _computed: dict[Kind, float] = field(default_factory=dict)
    """How long each computation took the last time."""

    def plan(self, work: tuple[TimedPiece, ...], wall_s: float) -> None:
        """All there is to do."""
        for one in work:
            self._left.setdefault(one.kind, deque()).append(one)
        self._paces = {kind: _Pace() for kind in self._left}
        self._wall_s, self._planned = wall_s, True

    def take(self, event: Event, session_s: float, wall_s: float) -> None:
        """One event, and both clocks."""
        match event:
            case AcquisitionBegan():
                self._session_s = session_s
            case Held():
                self._held = True
            case SoakBegan():
                self._held, self._session_s = False, session_s
            case SoakEnded():
                self._finish("soak", event.seconds, session_s, wall_s)
            case StepBegan() if self._held:
                # Nobody's pace is the worse for a pause.
                self._held, self._session_s = False, session_s
            case HitJudged() if event.accepted:
                self._finish("hit", session_s - self._session_s, session_s, wall_s)
            case HammerTestEnded():
                self._left.pop("hit", None)
            case PointMeasured() if event.purpose in _POINTS:
                self._finish(_POINTS[event.purpose], session_s - self._session_s, session_s, wall_s)
            case OperatorDid() if event.what in _DIDS:
                self._finish(_DIDS[event.what], wall_s - self._wall_s, session_s, wall_s)
            case FitStarted():
                self._fit_began_s = wall_s
            case FitFailed():
                self._fit_began_s = None
            case FitUpdated() if self._fit_began_s is not None:
                self._fitted(wall_s - self._fit_began_s, session_s, wall_s)
            case DiagnosisStarted():
                self._left.pop("fit", None)
                self._wall_s, self._fraction = wall_s, None
            case DiagnosisFound():
                self._left.pop("diagnosis", None)
                self._computed["diagnosis"] = wall_s - self._wall_s
            case FollowUpProposed():
                self._offers = event.offers
            case FollowUpDecided() if event.agreed and event.offer < len(self._offers):
                self._session_s, self._wall_s = session_s, wall_s
                self._add(self._offers[event.offer])
            case FollowUpEnded():
                for kind in _FOLLOWING:
                    self._left.pop(kind, None)

    def _add(self, offer: FollowUp) -> None:
        """What is measured after a diagnosis, and what is computed again then."""
        hands_s, steps = HANDS_S.get(offer.kind, 0.0), len(offer.frequencies_hz)
        work = [TimedPiece("change", hands_s)] * offer.needs_hands
        work += [TimedPiece("step", (offer.seconds - hands_s) / steps)] * steps if steps else []
        work += [TimedPiece(kind, took_s) for kind, took_s in self._computed.items()]
        for one in work:
            self._left.setdefault(one.kind, deque()).append(one)
            self._paces.setdefault(one.kind, _Pace())

    def computed(self, fraction: float | None) -> None:
        """The diagnosis in progress is so far."""
        self._fraction = fraction

    def measuring_s(self, session_s: float) -> float | None:
        """Still to be measured, on the session's clock; None before there is a plan."""
        if not self._planned:
            return None
        pieces = [k for k in self._left if k not in _ON_WALL]
        begun = 0.0 if self._held else session_s - self._session_s
        return self._rest(pieces, begun)

    def beside_s(self, wall_s: float) -> float | None:
        """Still to be waited for and computed, on the wall's clock."""
        if not self._planned:
            return None
        pieces = [k for k in self._left if k in _ON_WALL]
        begun = wall_s - self._wall_s if not self._measuring else 0.0
        if self._fraction and list(self._left) == ["diagnosis"]:
            # Its first shares say little of the pace: the forecast gives way to it as it goes on.
            rest, own = 1 - self._fraction, min(1.0, self._fraction / _PACE_KNOWN)
            return rest * (own * begun / self._fraction + (1 - own) * self._rest(pieces, 0.0))
        return self._rest(pieces, begun)

    def fraction(self, session_s: float, wall_s: float) -> float | None:
        """Of the whole run, 0 to 1."""
        measuring, beside = self.measuring_s(session_s), self.beside_s(wall_s)
        if measuring is None or beside is None:
            return None
        begun = session_s - self._session_s if self._measuring else wall_s - self._wall_s
        done = self._done_s + (0.0 if self._held else begun)
        return done / (done + measuring + beside) if done + measuring + beside > 0 else 1.0

    @property
    def _measuring(self) -> bool:
        return any(k not in _ON_WALL for k in self._left)

    def _rest(self, kinds: list[Kind], begun_s: float) -> float:
        """Of these kinds, less what the first piece has behind it: never less than a bit of that piece."""
        each = [_seconds(w) * self._ratio(k) for k in kinds for w in self._left[k]]
        if not each:
            return 0.0
        return sum(each) - min(begun_s, 0.9 * min(each))

    def _ratio(self, kind: Kind) -> float:
        """A sentinel is a step; what steps took counts for it too."""
        return self._paces["step" if kind == "sentinel" and "step" in self._paces else kind].ratio

    def _finish(self, kind: Kind, took_s: float, session_s: float, wall_s: float) -> None:
        self._session_s, self._wall_s = session_s, wall_s
        pieces = self._left.get(kind)
        if not pieces:
            return
        work = pieces.popleft()
        if not pieces:
            del self._left[kind]
        self._done_s += max(took_s, 0.0)
        # What was measured before a break took no time of this run's.
        if took_s > 0:
            self._paces[kind].learn(work, took_s)

    def _fitted(self, took_s: float, session_s: float, wall_s: float) -> None:
        """Fits during the sweep tell how long the last one will take."""
        self._fit_began_s, self._computed["fit"] = None, took_s
        if "fit" in self._left:
            self._left["fit"] = deque([TimedPiece("fit", took_s)])
            if not self._measuring:
                self._finish("fit", took_s, session_s, wall_s)


def _seconds(work: TimedPiece) -> float:
    return work.fixed_s + _SETTLES * work.settling_s
