"""What hits give: each alone, their average, and the modes of it. No Qt; not for the main thread."""

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from gui.pages.hammer.choice import Blow, blow_of
from gui.pages.hammer.traces import Surroundings
from instrument.errors import BadInput
from instrument.facts.damping import DampingResult
from instrument.impact.damping import Damping, damping_of_hits
from instrument.impact.judge import Judged
from instrument.impact.record import ResponseChannel
from instrument.impact.result import damping_from
from instrument.impact.scatter import Scatter, scatter_over_hits
from instrument.impact.spectra import Spectra, rolloff_hz, spectra
from instrument.session.contents import RecordedHit

Hits = tuple[RecordedHit, ...]
Look = Callable[[], None]
"""Called between two long sums; raises where the work is no longer wanted."""


@dataclass(frozen=True)
class HitSeen:
    """One hit by itself."""

    judged: Judged
    alone: Spectra
    usable_hz: float
    """Where its force spectrum has fallen by 20 dB."""


@dataclass(frozen=True)
class Averaged:
    """All hits that have samples, and the average of those that count."""

    hits: Hits
    seen: dict[int, HitSeen]
    """By number."""
    average: Spectra | None
    """None where no hit counts."""

    @property
    def usable_hz(self) -> float | None:
        """Up to which frequency the average is of use; None without an average."""
        return rolloff_hz(self.average) if self.average is not None else None

    @property
    def used(self) -> list[Judged]:
        """The hits that are averaged."""
        return [s.judged for s in self.seen.values() if s.judged.accepted]


@dataclass(frozen=True)
class ModesFound:
    """The modes that the average of the hits gives."""

    hits: Hits
    found: Damping | None
    """None where no hit counts; `why` says so."""
    scatter: tuple[Scatter | None, ...]
    around: tuple[Surroundings, ...]
    """For drawing."""
    result: DampingResult | None
    """As the run itself would record it."""
    why: str = ""


class Sight:
    """Sees hits; one that was seen before is not computed again."""

    def __init__(self) -> None:
        self._known: dict[Blow, HitSeen] = {}

    def average(self, hits: Hits, look: Look) -> Averaged:
        """Each hit and the average of those accepted."""
        seen = {}
        for hit in hits:
            look()
            if len(hit.record.force_n):
                seen[hit.number] = self._see(hit)
        self._known = {blow_of(h): seen[h.number] for h in hits if h.number in seen}
        used = [accelerated(s.judged) for s in seen.values() if s.judged.accepted]
        return Averaged(hits, seen, spectra(used) if used else None)

    def _see(self, hit: RecordedHit) -> HitSeen:
        known = self._known.get(blow_of(hit))
        if known is not None and known.judged.accepted == hit.accepted:
            return known
        judged = hit.judged()
        alone = known.alone if known is not None else spectra([accelerated(judged)])
        return HitSeen(judged, alone, known.usable_hz if known is not None else rolloff_hz(alone))


def accelerated(judged: Judged) -> Judged:
    """A hit as an accelerometer would have read it: of what a laser read little is left of slow swaying."""
    (read, *_) = judged.hit.responses
    if read.motion != "velocity":
        return judged
    samples = np.gradient(read.samples) * judged.hit.sample_rate_hz
    channel = ResponseChannel(read.name, "acceleration", samples)
    return replace(judged, hit=replace(judged.hit, responses=(channel,)))


def modes_of(averaged: Averaged, band_hz: tuple[float, float], look: Look) -> ModesFound:
    """Frequencies and damping by three methods, and how far single hits agree."""
    judged = [averaged.seen[h.number].judged for h in averaged.hits if h.number in averaged.seen]
    try:
        found = damping_of_hits(judged, band_hz=band_hz)
    except BadInput as error:
        return ModesFound(averaged.hits, None, (), (), None, str(error))
    look()
    scatter = scatter_over_hits(found)
    look()
    around = tuple(Surroundings.of(found, mode) for mode in found.modes)
    return ModesFound(averaged.hits, found, scatter, around, damping_from(found))
