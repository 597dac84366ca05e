"""The treated plate struck with the instrumented hammer: hung free, or in its clamp.

Hung free it has no clamp and no base, and how far a known force moves it tells its mass from its stiffness.
In its clamp nothing of the base is read, neither how it moves nor its accelerometer; the clamp is the same.
Each is asked where explanations differ in what it is about. One blow reads all frequencies at once.
"""

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from fitting.diagnosis.problem.base import DiagnosisProblem
from fitting.diagnosis.problem.plate_poles import PlatePoles
from fitting.diagnosis.several.of_files import inner_of
from fitting.diagnosis.several.sharing import OF_EACH_MOUNTING
from fitting.effects import CATALOGUE
from fitting.effects.base import BASE, CLAMP, Effect
from fitting.laws import CoreLaw
from fitting.nuisances.nuisances import Nuisances
from fitting.planning.candidates import resonances_hz
from fitting.planning.elsewhere import struck
from fitting.planning.exact_problem import exact_problem
from fitting.planning.free_plate import free_plate, free_specimen
from fitting.planning.further_readings import FurtherReadings
from fitting.planning.rival_forecasts import RivalForecasts
from fitting.planning.sensitivity import ReadingNoise
from fitting.reduced.reduced_plate import ReducedPlate
from fitting.specimen import PlateSpecimen
from fitting.stated.tolerances import of_scope
from instrument.impact.mobility import GAIN
from instrument.planning.measurement import HANDS_S, Measurable
from instrument.planning.steps import Steps, about, where
from instrument.stepped_sine.settings import SweepSettings

_STRUCK_AT = [(0.95, 0.5), (0.6, 0.5)]
"""Of length and width, where it is hit in its clamp. On the axis: the basis of a plate that its base drives
has motions even across the width alone."""
_APART_M = 0.03
"""From the laser's spot: a hammer must not hit the beam."""
_SHARE, _FLOOR = 0.01, 0.003
"""Of a reading, and of the largest: what some blows averaged scatter by. A choice."""
_MODES = 6
"""Of the free plate, the lowest in the band: a bound on time."""
_STATED = f'[excitation] kind = "force" and gain_percent = {100 * GAIN:g}'
_HANG = (
    "Take the plate out of its clamp, hang it by two threads, point the laser at {read}, strike it at "
    "{hit} with the instrumented hammer, and give its mobility about {hz} Hz as a file of its own, "
    'its specimen with boundary = "free", the whole length, ' + _STATED + "."
)
_STRIKE = (
    "Leave the plate in its clamp and the laser where it is, strike it at {hit} with the instrumented "
    "hammer, and give its mobility about the same resonances as a file of its own, its specimen with "
    + _STATED
    + "."
)
_NO_BASE = (
    "Struck in its clamp the plate reads nothing of the base, neither its motion nor its accelerometer."
)


def damped_struck(
    expecting: RivalForecasts, lines: Steps, settings: SweepSettings, whole_length_m: float | None = None
) -> Iterator[Measurable]:
    """What of it is worth asking; `lines` are those of the spectrum about the resonances of the sweep.

    `whole_length_m` is of all that hangs; None: as long as it stands out of its clamp.
    """
    stated = expecting.member.nuisances.specimen
    if not isinstance(stated, PlateSpecimen) or stated.boundary != "cantilever" or expecting.struck_already:
        return
    effects = [[inner_of(e) for e in known.fitted.effects] for known in expecting.learnt]
    if len({frozenset(e.name for e in each if not _of_the_mounting(e)) for each in effects}) > 1:
        hangs = free_specimen(stated, whole_length_m)
        yield from _hung_free(expecting, hangs, [e for each in effects for e in each], settings)
    if any(e.needs >= BASE for each in effects for e in each):
        yield from _in_clamp(expecting, stated, lines)


def _of_the_shaker(effect: Effect) -> bool:
    """Of a base that moves, of its level, or of a sweep's hour."""
    return effect.needs >= BASE or effect.enters in ("level", "time")


def _of_the_mounting(effect: Effect) -> bool:
    """What a plate that hangs free, and is read anew, has left behind."""
    return _of_the_shaker(effect) or effect.needs >= CLAMP or effect.name in ("spot_offset", "tether")


def _hung_free(
    expecting: RivalForecasts, free: PlateSpecimen, effects: list[Effect], settings: SweepSettings
) -> Iterator[Measurable]:
    band, law = expecting.member.sweep.frequency_hz, expecting.learnt[0].fitted.law
    spans = {s.name: s for e in effects if not _of_the_mounting(e) for s in e.spans}
    plate, reduced = free_plate(free, law, band, list(spans.values()))
    poles = resonances_hz(PlatePoles(plate, law), float(band.min()), float(band.max()))[:_MODES]
    if not len(poles):
        return
    lines = about(poles, 1, poles, settings)
    f, first = np.unique(lines.frequency_hz, return_index=True)
    there = exact_problem(f, lines.segment[first], 1.0, free, plate, reduced)
    each = tuple(
        replace(n, sigma=max(n.sigma, GAIN)) if n.kind == "gain" else n for n in there.nuisances.each
    )
    there = replace(there, nuisances=Nuisances(free, each))
    new = frozenset(OF_EACH_MOUNTING)
    gone = frozenset(n for n, e in CATALOGUE.items() if _of_the_mounting(e))
    assert free.force_m is not None
    assert free.pickup_m is not None
    todo = _HANG.format(read=_words(free.pickup_m), hit=_words(free.force_m), hz=where(poles))
    found = _measurable(_further(there, reduced, law, new, gone), todo, free.force_m)
    yield replace(found, spot_m=free.pickup_m, held="free")


def _in_clamp(expecting: RivalForecasts, stated: PlateSpecimen, lines: Steps) -> Iterator[Measurable]:
    member, reduced = expecting.member, expecting.reduced
    assert reduced is not None
    assert stated.pickup_m is not None
    read = np.array(stated.pickup_m)
    places = [(along * stated.length_m, across * stated.width_m) for along, across in _STRUCK_AT]
    point = next(p for p in places if np.hypot(*(read - p)) > _APART_M)
    plate, moved, nuisances = struck(member.plate, reduced, member.nuisances, point, GAIN)
    assert isinstance(nuisances.specimen, PlateSpecimen)
    f, first = np.unique(lines.frequency_hz, return_index=True)
    there = exact_problem(f, lines.segment[first], 1.0, nuisances.specimen, plate, moved)
    there = replace(there, nuisances=nuisances)
    gone = frozenset(n for n, e in CATALOGUE.items() if _of_the_shaker(e))
    further = _further(there, moved, expecting.learnt[0].fitted.law, frozenset(of_scope("channel")), gone)
    found = _measurable(further, _STRIKE.format(hit=_words(point)), point)
    yield replace(found, held="clamped", reason=_NO_BASE)


def _further(
    there: DiagnosisProblem,
    reduced: ReducedPlate,
    law: CoreLaw,
    new: frozenset[str],
    gone: frozenset[str],
) -> FurtherReadings:
    omega = there.points.omega
    mobility = omega * np.abs(there.rational.displacement(law.modulus(omega)))
    return FurtherReadings(
        there,
        np.arange(len(omega)),
        np.ones(len(omega)),
        same_errors=False,
        new=new,
        without=gone,
        noise=ReadingNoise(_FLOOR * float(mobility.max()), _SHARE),
        reduced=reduced,
        other_reference=True,
    )


def _measurable(further: FurtherReadings, todo: str, point_m: tuple[float, float]) -> Measurable:
    seconds = HANDS_S["damped_struck"]
    return Measurable(
        "damped_struck",
        further,
        further.at,
        (),
        (),
        0.0,
        seconds,
        todo,
        needs_hands=True,
        struck_m=point_m,
    )


def _words(place_m: tuple[float, float]) -> str:
    return f"({1e3 * place_m[0]:.0f}, {1e3 * place_m[1]:.0f}) mm"
