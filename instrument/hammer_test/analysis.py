"""The hammer test as it goes on: samples and the operator's word in, hits and modes out. Pure."""

from dataclasses import dataclass, replace

import numpy as np

from fitting.arrays import Array
from fitting.dynamics.bare_modes import CarriedSensor
from instrument.errors import BadInput
from instrument.hammer_test.trigger import Trigger
from instrument.impact.damping import damping_of_hits
from instrument.impact.judge import Judged, judge
from instrument.impact.record import Hit, ResponseChannel
from instrument.impact.result import damping_from, sensor_from
from instrument.stream.derived import DampingFound, HitJudged, HitRevised
from instrument.stream.event import Derived
from instrument.stream.raw import BlockAcquired, HammerTestEnded, OperatorDid
from instrument.stream.scaling import Scaling

WEAK = 0.3
"""Share of the median good blow below which one is too weak to average with the others."""


@dataclass(frozen=True)
class HammerSettings:
    """How hits are recorded and read."""

    hits: int
    """Good ones wanted."""
    record_s: float
    pre_trigger_s: float
    band_hz: tuple[float, float]
    sensor: CarriedSensor | None = None
    """The response sensor on the plate."""


@dataclass
class _Caught:
    judged: Judged
    peak_n: float
    accepted: bool


class HammerAnalysis:
    """Follows a hammer test."""

    response = "response"
    """Channel of what answers."""

    def __init__(self, settings: HammerSettings, scaling: Scaling, sample_rate_hz: float) -> None:
        self._settings, self._scaling, self._rate = settings, scaling, sample_rate_hz
        self._trigger = Trigger(sample_rate_hz, settings.record_s, settings.pre_trigger_s)
        self._hits: list[_Caught] = []

    @property
    def accepted(self) -> int:
        """Good hits so far."""
        return sum(h.accepted for h in self._hits)

    @property
    def complete(self) -> bool:
        """Whether there are as many as wanted."""
        return self.accepted >= self._settings.hits

    @property
    def accepted_of_caught(self) -> tuple[int, int]:
        """Good hits, and all of them: changes with every hit and every decision."""
        return self.accepted, len(self._hits)

    @property
    def rejected_in_a_row(self) -> list[str]:
        """Why each of the last hits is no good, back to the last good one."""
        good = max((k + 1 for k, h in enumerate(self._hits) if h.accepted), default=0)
        return [h.judged.why or "rejected" for h in self._hits[good:]]

    @property
    def ready(self) -> bool:
        """Whether the trigger has heard enough quiet for a first blow."""
        return self._trigger.level is not None

    @property
    def record_s(self) -> float:
        """Length of a record."""
        return self._settings.record_s

    def wanted(self) -> int:
        """Samples worth waiting for."""
        return self._trigger.wanted

    def block(self, block: BlockAcquired) -> list[Derived]:
        """Samples in; the hits that are whole now."""
        row = self._scaling.rows
        rows = self._rows(block)
        overload = np.array([block.overload[row["force"]], block.overload[row[self.response]]])
        return [
            self._judged(first, record, flags)
            for first, record, flags in self._trigger.feed(block.first_sample, rows, overload)
        ]

    def operator(self, did: OperatorDid) -> list[Derived]:
        """Accept, reject or undo one hit; 0 means the last one."""
        number = did.hit or len(self._hits)
        if did.what not in ("accepted", "rejected", "undone") or not 1 <= number <= len(self._hits):
            return []
        hit = self._hits[number - 1]
        hit.accepted = hit.judged.accepted if did.what == "undone" else did.what == "accepted"
        return [HitRevised(number, hit.accepted)]

    def ended(self, _: HammerTestEnded) -> list[Derived]:
        """The plate's modes from the accepted hits; none where no hit is good."""
        hits = [
            replace(h.judged, accepted=h.accepted, why=h.judged.why or ("" if h.accepted else "rejected"))
            for h in self._hits
        ]
        try:
            result = damping_from(damping_of_hits(hits, band_hz=self._settings.band_hz))
        except BadInput:
            return []
        if self._settings.sensor is not None:
            result = result.but(sensor=sensor_from(self._settings.sensor))
        return [DampingFound(result)]

    def _rows(self, block: BlockAcquired) -> Array:
        """Force and what answers, in their units. Shape (2, samples)."""
        return self._scaling.blow(block.volts)

    def _channel(self, samples: Array) -> ResponseChannel:
        """What answers a blow."""
        return ResponseChannel("response", "acceleration", samples)

    def _judged(self, first: int, record: Array, overload: np.ndarray) -> HitJudged:
        number = len(self._hits) + 1
        hit = Hit(f"hit {number}", self._rate, record[0], (self._channel(record[1]),))
        judged = judge(hit)
        faults = [judged.why] if judged.why else []
        faults += [
            f"overload of the {n}" for n, over in zip(("force", self.response), overload, strict=True) if over
        ]
        peak = self._trigger.peaks[-1]
        # What was refused says nothing of how one should strike: it may have been too hard.
        earlier = [h.peak_n for h in self._hits if h.accepted]
        if earlier and peak < WEAK * float(np.median(earlier)):
            faults.append(f"weak: {peak:.3g} N, the others about {np.median(earlier):.3g} N")
        good = not faults
        judged = Judged(judged.hit, good, "; ".join(faults), judged.notes, judged.pulse)
        self._hits.append(_Caught(judged, peak, good))
        return HitJudged(number, first, record.shape[1], peak, good, "; ".join(faults))
