"""Data beside the stated specimen before they are fitted: a wrong unit, sign, cable or plate is asked about.

Any core from soft to stiff is tried. Where none comes near, the same is asked of the data with one mistake
taken back; the mistake that explains by far the most is named. Whoever knows better insists.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np

from fitting.arrays import Array, Complex
from fitting.errors import FittingError
from fitting.identification.result import LOST_PERCENT
from fitting.specimen import PlateSpecimen, Reading
from fitting.structures import AnySpecimen, Beam
from fitting.sweep import Sweep
from instrument.mistakes.any_core import FURTHEST, AnyCore, Nearest, any_core
from instrument.mistakes.mistake_in_part import mistake_in_a_segment
from instrument.mistakes.response_mistakes import (
    Mistake,
    lacks_phase,
    mistakes,
    of_another_scale,
    response_of,
    words_of,
)
from instrument.mistakes.specimen_mistakes import specimen_mistakes
from instrument.mistakes.unstated_mass import unstated_mass
from instrument.progress import Progress, quiet

NEAR, DOUBTFUL, SCALED, FAR = 0.1, 0.35, 0.5, 0.65
"""Distance of the best core: nothing to ask below the first; phases are asked about above the second,
powers, dB and stated numbers above the third; another specimen is certain above the last."""
EXPLAINED, BETTER = 0.12, 0.35
"""A mistake taken back has to leave no more, and at most this part of the distance."""
LIKELY = 0.15
"""The same of a reading and of a sensor's mass."""
_LOWEST_HZ = 1.0
_ENOUGH = 150
"""Points, spread over the sweep: more say the same."""
_WITH_EFFECTS = 0.45
"""What effects of usual size leave at most."""
_NO_GAIN = 100.0
"""Times, or one over it: from where on a factor of no name is hardly a gain or a level, and wrong numbers of
the specimen explain it sooner. Each of those takes a model of its own. A choice."""
_MANY = 24
"""Numbers from which on they say more than a core and a factor can follow: fewer have to be far off."""
_DELAYS_S = np.linspace(-3e-3, 3e-3, 1201)
"""Of one channel beside the other: more than a decoder's, in steps that turn no phase below 2 kHz far."""
_LOOKED_AT = 3
"""Mistakes that come nearest on the grid of cores: the best is among them."""
_UNITS = {"rad/s": 1 / (2 * np.pi), "kHz": 1e3}
"""Units that frequencies may be in, and how many Hz each is."""
_MOST_KHZ = 20.0
"""Readings beyond what is heard are not of such specimens."""


def data_doubt(sweep: Sweep, specimen: AnySpecimen, progress: Progress = quiet) -> str:
    """What seems wrong with data of this specimen, in a sentence; empty where a core of some kind comes near.

    Of several spots the first one in the data is looked at. Raises `FittingError` where it cannot be modelled
    over these frequencies.
    """
    with np.errstate(all="ignore"):
        # What is meant otherwise may well divide by zero.
        return _doubt(sweep, specimen, progress)


def remarks_on_reading(
    sweep: Sweep, specimen: AnySpecimen, rms_percent: float, progress: Progress = quiet
) -> tuple[str, ...]:
    """That a fit which leaves `rms_percent` would follow readings of absolute velocities; empty otherwise."""
    if rms_percent < LOST_PERCENT or specimen.drive != "base" or specimen.reads != "relative":
        return ()
    sweep, specimen = _one_spot(sweep, specimen)
    with np.errstate(all="ignore"):
        model = any_core(specimen, sweep.frequency_hz, progress)
        absolute = _as_is(sweep, replace(model, reads="absolute")).distance
        if not _likely(absolute, _as_is(sweep, model).distance):
            return ()
    return (
        "read as absolute velocities the data are this specimen's nearly, as relative to its clamp they are "
        "not: if the pickup does not move with the base, [pickup] reads = 'absolute' is missing",
    )


def _doubt(sweep: Sweep, specimen: AnySpecimen, progress: Progress) -> str:
    f = sweep.frequency_hz
    if f.max() < _LOWEST_HZ:
        if _is_ordered(np.abs(sweep.velocity_m_s)) and not _is_ordered(f):
            return (
                f"{f.min():g} to {f.max():g} Hz, not in order, beside readings that are: it looks as if the "
                "columns of frequency and reading are exchanged"
            )
        return f"{f.min():g} to {f.max():g} Hz: the frequencies are in kHz, expected Hz"
    others = _other_spots(sweep, specimen)
    sweep, specimen = _one_spot(sweep, specimen)
    try:
        model = any_core(specimen, sweep.frequency_hz, progress)
    except FittingError:
        distance, words = _in_another_unit(sweep, specimen, progress)
        if distance > _WITH_EFFECTS:
            raise
        return f"it looks as if {words}"
    look = _Look(sweep, specimen, others, model, _as_is(sweep, model), progress)
    if look.distance < look.near:
        return ""
    for least, suspicion in _SUSPICIONS:
        if look.distance < least:
            return ""
        said = suspicion(look)
        if said is not None:
            return f"it looks as if {said}" if said else ""
    return (
        f"no core makes this {specimen.kind} answer so (typically {np.exp(_median(look)):.2g} "
        "times off): another specimen or layer, unit, level, pickup or way it reads"
    )


@dataclass(frozen=True)
class _Look:
    """What every suspicion is judged by."""

    sweep: Sweep
    specimen: AnySpecimen
    others: Sequence[tuple[str, AnySpecimen]]
    """Where the spot may be instead, and words for each."""
    model: AnyCore
    as_is: Nearest
    """The core that comes nearest to the data as they are."""
    progress: Progress

    @property
    def distance(self) -> float:
        """Of that core."""
        return self.as_is.distance

    @property
    def near(self) -> float:
        """Distance below which nothing is asked."""
        return NEAR if len(self.sweep) * (1 + self.sweep.has_phase) >= _MANY else SCALED


# Each suspicion says it in words; "" where there is nothing to ask, None where the next one has to say it.


def _read_otherwise(look: _Look) -> str | None:
    """The other reading comes near: a word in the specimen file is sooner wrong than a channel.

    That a laser reads absolute velocities where relative ones are stated is the diagnosis's to say.
    """
    otherwise = _as_is(look.sweep, replace(look.model, reads=_other(look.model))).distance
    if not (otherwise < NEAR or _likely(otherwise, look.distance)):
        return None
    absolute = look.model.reads == "absolute"
    return "the pickup's reading is relative to the clamp: [pickup] reads says absolute" if absolute else ""


def _of_another_spot(look: _Look) -> str | None:
    """Another spot that is stated explains them: two rows, exchanged, need no mistake in any number."""
    for words, elsewhere in look.others:
        if _explains(_distance_of(look.sweep, elsewhere, look.progress), look.distance):
            return words
    return None


def _sensor_s_mass(look: _Look) -> str | None:
    """A beam carries a sensor that is not stated: common, and a mass moves modes as no core does.

    Asked only where more than something slight is wrong, and of no beam driven and read at its centre.
    """
    beam = look.specimen
    if look.distance <= 2 * NEAR or not isinstance(beam, Beam) or beam.boundary == "centre-driven":
        return None
    left, words = unstated_mass(beam, lambda carrying: _distance_of(look.sweep, carrying, look.progress))
    return words if _likely(left, look.distance) else None


def _frequencies(look: _Look) -> str | None:
    """Frequencies in another unit: after the channels' units, which leave the resonances where they are."""
    distance, words = _in_another_unit(look.sweep, look.specimen, look.progress)
    return words if distance < EXPLAINED else None


def _stated_wrongly(look: _Look) -> str | None:
    """A stated number in another unit or place: of many, so only where the data are far off."""
    for words, other in specimen_mistakes(look.specimen):
        if _explains(_distance_of(look.sweep, other, look.progress), look.distance):
            return words
    return None


def _beside_effects(look: _Look) -> str | None:
    """What takes back most of a distance that is hopeless, and leaves no more than effects do.

    Something is asked here anyway.
    """
    sweep, specimen, model = look.sweep, look.specimen, look.model
    alone, left = _most_likely(sweep, model, [Mistake(response_of)])
    if left.distance < _WITH_EFFECTS and alone.is_unit(left.factor, specimen.drive):
        # Data with an effect are as far off in the right unit, and nothing else makes a thousand of it.
        return words_of(alone, left.factor, specimen.drive) or None
    mistake, found = _most_likely(sweep, model, list(mistakes(sweep)))
    in_unit, words = _in_another_unit(sweep, specimen, look.progress)
    if min(found.distance, in_unit) > min(_WITH_EFFECTS, BETTER * look.distance):
        return None
    # A factor of one has no words.
    return words if in_unit < found.distance else words_of(mistake, found.factor, specimen.drive) or None


def _explains(distance: float, as_is: float) -> bool:
    return distance < min(EXPLAINED, BETTER * as_is)


def _likely(distance: float, as_is: float) -> bool:
    """As `_explains`, with a looser limit for common mistakes.

    Over decades of frequency a core of one slope follows a beam less closely.
    """
    return distance < min(LIKELY, BETTER * as_is)


def _of_data(look: _Look) -> str | None:
    """One mistake in the data explains them, as of units, signs, columns; a diagnosis finds slight ones."""
    sweep, model, as_is, drive = look.sweep, look.model, look.as_is, look.specimen.drive
    mistake, found = _most_likely(sweep, model, list(mistakes(sweep)))
    if _explains(found.distance, as_is.distance):
        if as_is.distance >= SCALED:
            # Two mistakes at once come near to decibels, and far less near than one does.
            distance, words = _in_another_scale(sweep, model)
            if _explains(distance, found.distance):
                return words
        slight = mistake.is_slight(found.factor) and not mistake.is_habit(found.factor)
        # A factor of no name is less of an explanation than a name without a factor.
        named = mistake.is_nameless(found.factor, drive) and _frequencies(look)
        if not named and abs(np.log(found.factor)) > np.log(_NO_GAIN):
            named = _stated_wrongly(look)
        return "" if slight else named or words_of(mistake, found.factor, drive)
    in_part = mistake_in_a_segment(sweep, model, as_is, drive)
    if in_part is not None:
        return in_part
    if lacks_phase(sweep):
        return (
            "real and imaginary parts have no phase, expected velocity_m_s where amplitudes alone are known"
        )
    if as_is.distance < DOUBTFUL:
        return None
    of_size = _sizes(response_of(sweep), model)
    if _explains(of_size, as_is.distance) and of_size < BETTER * found.distance:
        if _is_late(sweep, model):
            return ""
        return "the amplitudes are this specimen's and the phases are not: unit, sign, delay or filter"
    if as_is.distance < SCALED:
        return None
    distance, words = _in_another_scale(sweep, model)
    return words if _explains(distance, min(of_size, as_is.distance)) else None


def _in_another_scale(sweep: Sweep, model: AnyCore) -> tuple[float, str]:
    """Distance with the response as a power, in dB or the like, whichever is least, and words for it."""
    return min(
        (_sizes(response, model), mistake.words)
        for mistake in of_another_scale()
        if (response := mistake.taken_back(sweep)) is not None
    )


_SUSPICIONS: tuple[tuple[float, Callable[[_Look], str | None]], ...] = (
    (0.0, _read_otherwise),
    (0.0, _of_another_spot),
    (0.0, _sensor_s_mass),
    (0.0, _of_data),
    (0.0, _frequencies),
    (SCALED, _stated_wrongly),
    (FAR, _beside_effects),
)
"""In the order in which they are asked, each with the distance from which on: what is common comes first, and
what data with an effect look like too comes last, where they are hopeless otherwise."""


def _sizes(response: Complex, model: AnyCore) -> float:
    """Distance of amplitudes alone, up to a factor."""
    return model.nearest(response, has_phase=False, free=True).distance


def _is_late(sweep: Sweep, model: AnyCore) -> bool:
    """Whether phases are those of a delay: a diagnosis finds it."""
    if not sweep.has_phase:
        return False
    core = model.nearest(response_of(sweep), has_phase=False, free=False).core
    off = np.log(response_of(sweep)) - model.log_velocity(core[None])[0]
    turned = np.exp(1j * (off.imag + sweep.omega * _DELAYS_S[:, None]))
    left = np.abs(np.angle(turned)).mean(axis=1).min()
    return bool(np.hypot(np.minimum(np.abs(off.real), FURTHEST).mean(), left) < EXPLAINED)


def _distance_of(sweep: Sweep, specimen: AnySpecimen, progress: Progress) -> float:
    try:
        return _as_is(sweep, any_core(specimen, sweep.frequency_hz, progress)).distance
    except FittingError:
        return float("inf")


def _other(model: AnyCore) -> Reading:
    return "relative" if model.reads == "absolute" else "absolute"


def _one_spot(sweep: Sweep, specimen: AnySpecimen) -> tuple[Sweep, AnySpecimen]:
    """Of not too many points."""
    if sweep.pickup is not None and isinstance(specimen, PlateSpecimen | Beam):
        first = int(sweep.pickup.min())
        sweep = replace(sweep.take(sweep.pickup == first), pickup=None)
        specimen = specimen.at_pickup(first)
    return sweep.thinned(_ENOUGH), specimen


def _other_spots(sweep: Sweep, specimen: AnySpecimen) -> list[tuple[str, AnySpecimen]]:
    """Where the first spot in the data may be instead, of those that are stated, and words for each."""
    if sweep.pickup is None or not isinstance(specimen, PlateSpecimen | Beam):
        return []
    first, *others = (int(k) for k in np.unique(sweep.pickup))
    return [
        (
            f"spots {first} and {k} are exchanged: what stands as pickup {first} is read at {k}",
            specimen.at_pickup(k),
        )
        for k in others
    ]


def _as_is(sweep: Sweep, model: AnyCore) -> Nearest:
    return model.nearest(response_of(sweep), has_phase=sweep.has_phase, free=False)


def _most_likely(sweep: Sweep, model: AnyCore, some: Sequence[Mistake]) -> tuple[Mistake, Nearest]:
    tried: list[tuple[float, int, Mistake, Complex]] = []
    for mistake in some:
        response = mistake.taken_back(sweep)
        if response is None:
            continue
        rough = model.nearest(response, has_phase=sweep.has_phase, free=True, refine=False)
        tried.append((rough.distance, len(tried), mistake, response))
    tried.sort(key=lambda one: one[:2])
    refined = [
        (mistake, model.nearest(response, has_phase=sweep.has_phase, free=True))
        for _, _, mistake, response in tried[:_LOOKED_AT]
    ]
    return min(refined, key=lambda one: one[1].distance)


def _is_ordered(values: Array) -> bool:
    """Whether all of them rise, or all fall, as frequencies of a sweep do. Shape (points,)."""
    steps = np.diff(values)
    return bool(np.all(steps > 0) or np.all(steps < 0))


def _median(look: _Look) -> float:
    off = np.log(response_of(look.sweep)) - look.model.log_velocity(look.as_is.core[None])[0]
    return float(np.median(np.abs(off.real)))


def _in_another_unit(sweep: Sweep, specimen: AnySpecimen, progress: Progress) -> tuple[float, str]:
    """Distance with the frequencies in the unit in which it is least, and words for it."""
    found = [(float("inf"), "")]
    if not isinstance(specimen, PlateSpecimen | Beam):
        # Of a pair any frequency is as good: its modulus goes along.
        return found[0]
    for unit, hz in _UNITS.items():
        if unit == "kHz" and sweep.frequency_hz.max() > _MOST_KHZ:
            continue
        meant = replace(sweep, frequency_hz=sweep.frequency_hz * hz)
        distance = _distance_of(meant, specimen, progress)
        found.append((distance, f"the frequencies are in {unit}, expected Hz"))
    return min(found)
