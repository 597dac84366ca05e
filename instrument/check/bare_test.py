"""Whether the hammer test of the bare specimen can find its modes: its places, its band and its record."""

from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import lru_cache

import numpy as np

from fitting.arrays import Array
from fitting.dynamics.real_modes import real_modes
from fitting.plate.plate import Plate
from fitting.specimen import PlateSpecimen
from fitting.structures import Beam
from fitting.structures.small_modes import small_modes
from instrument.files.experiment_file import MOST_RECORD_S, Hammer
from instrument.files.plausible_rig import LOWEST_BAND_HZ
from instrument.session.configuration import Experiment
from instrument.session.setup import LONGEST_RECORD_S, decay_s

_COARSE = (20, 14)
"""Elements along each side: a place is on a nodal line or not, a mode in the band or not. A choice."""
_PLATE_MODES, _BEAM_MODES = 24, 8
"""More than a tip rings as a rule; of a beam what its polynomials resolve."""
_ACROSS = 9
"""Places along each side at which a shape is looked at for its largest."""
_STILL = 1e-6
"""Of a shape's largest: nothing moves there."""
_NODAL = 0.02
"""Of a shape's largest: a fiftieth of the blow's worth is lost in the noise of a record. A choice."""
_LEFT = 0.5
"""Of the slowest mode at the record's end: with more the record is too short to tell its decay. Of records of
half that length one mode in four was missed. A choice."""
_END = 0.01
"""To which `auto` lets it fall."""


@dataclass(frozen=True)
class BareShapes:
    """Modes of the bare plate or beam."""

    frequency_hz: Array
    """Shape (modes,)."""
    plate: Plate | None
    """None for a beam, of which places are not looked at."""
    shapes: Array
    """Shape (n, modes)."""

    @classmethod
    @lru_cache(maxsize=4)
    def of(cls, specimen: PlateSpecimen | Beam) -> "BareShapes":
        """On a coarse mesh."""
        if isinstance(specimen, Beam):
            bare = replace(specimen, core=None, constraining=None, both_sides=False)
            f = np.array([m.frequency_hz for m in small_modes(bare, None, _BEAM_MODES)])
            return cls(f, None, np.empty((0, len(f))))
        plate = Plate(replace(specimen.bare, elements=specimen.elements or _COARSE))
        modes = real_modes(plate, 0.0, _PLATE_MODES)
        return cls(modes.omega / (2 * np.pi), plate, modes.shapes)

    def moves(self, x_m: float, y_m: float) -> Array:
        """How far each mode moves a place, of its largest. Shape (modes,)."""
        plate = self.plate
        if plate is None:
            return np.ones(len(self.frequency_hz))
        length, width = plate.specimen.length_m, plate.specimen.width_m
        grid = [(x, y) for x in np.linspace(0, length, _ACROSS) for y in np.linspace(0, width, _ACROSS)]
        largest = np.max([np.abs(plate.observe(*at) @ self.shapes) for at in grid], axis=0)
        return np.asarray(np.abs(plate.observe(x_m, y_m) @ self.shapes) / largest)


def bare_test_objections(experiment: Experiment, hammer: Hammer) -> Iterator[str]:
    """What leaves nothing to be found; the places lie on the specimen."""
    specimen = experiment.the_specimen()
    assert isinstance(specimen, PlateSpecimen | Beam)
    found = BareShapes.of(specimen)
    for what, x, y in _places(hammer):
        if _held(specimen, 1e-3 * x) or np.max(found.moves(1e-3 * x, 1e-3 * y)) < _STILL:
            yield (
                f"{experiment.path}: hammer.{what}_x_mm = {x:g}: in the clamp, where nothing moves, expected "
                "a place that does"
            )
    (low, high), rate = hammer.band_hz, experiment.rig.front_end.sample_rate_hz
    if high > rate / 2:
        yield (
            f"{experiment.path}: hammer.band_hz up to {high:g} Hz at {rate:g} samples/s, expected at most "
            f"{rate / 2:g} Hz"
        )
    f = found.frequency_hz
    # Below that it is asked whether it is in kHz.
    if high >= LOWEST_BAND_HZ and not np.any((f >= low) & (f <= high)) and low < f[-1]:
        yield (
            f"{experiment.path}: hammer.band_hz = [{low:g}, {high:g}] has none of the modes of the bare "
            f"{specimen.kind}, expected some of {_listed(f[:4])} Hz and above"
        )


def bare_test_remarks(experiment: Experiment, hammer: Hammer) -> Iterator[str]:
    """What a test will not find."""
    specimen = experiment.the_specimen()
    assert isinstance(specimen, PlateSpecimen | Beam)
    found = BareShapes.of(specimen)
    f = found.frequency_hz
    inside = (f >= hammer.band_hz[0]) & (f <= hammer.band_hz[1])
    for what, x, y in _places(hammer):
        lost = f[inside & (found.moves(1e-3 * x, 1e-3 * y) < _NODAL)]
        if len(lost):
            yield (
                f"hammer.{what} at {x:g}, {y:g} mm is on a nodal line of {len(lost)} of {inside.sum()} modes "
                f"of the bare plate ({_listed(lost)} Hz): they will not be found"
            )
    yield from _record_remarks(hammer, specimen)


def _record_remarks(hammer: Hammer, specimen: PlateSpecimen | Beam) -> Iterator[str]:
    """A record in which hardly anything decays, or one that `auto` cuts."""
    needed = decay_s(specimen)
    if hammer.record_s == "auto":
        if needed > LONGEST_RECORD_S:
            longer = f"{min(needed, MOST_RECORD_S):g}"
            yield (
                f'hammer.record_s = "auto" ends at {LONGEST_RECORD_S:g} s, its most, where the slowest mode '
                f"still has {100 * _END ** (LONGEST_RECORD_S / needed):.2g} % of its start: {needed:g} s "
                f"would leave {100 * _END:g} %: state record_s = {longer} if that mode counts"
            )
        return
    left = _END ** (hammer.record_s / needed)
    if left > _LEFT:
        if needed > MOST_RECORD_S:
            expected = (
                f"{needed:g} s would leave {100 * _END:g} %, {MOST_RECORD_S:g} s is the most a record may be"
            )
        else:
            expected = f"expected {needed:g} s" + (" as auto has it" if needed <= LONGEST_RECORD_S else "")
        yield (
            f"hammer.record_s = {hammer.record_s:g}: at its end the slowest mode still has "
            f"{100 * left:.0f} % of its start, too much to tell decays and neighbours apart: {expected}"
        )


def _held(specimen: PlateSpecimen | Beam, x_m: float) -> bool:
    """Whether a beam is clamped there; a plate's shapes tell it."""
    if isinstance(specimen, PlateSpecimen):
        return False
    ends = {"clamped-free": (0.0,), "clamped-clamped": (0.0, specimen.length_m)}
    return any(np.isclose(x_m, end) for end in ends.get(specimen.boundary, ()))


def _places(hammer: Hammer) -> tuple[tuple[str, float, float], ...]:
    return (
        ("hit", hammer.hit_x_mm, hammer.hit_y_mm),
        ("response", hammer.response_x_mm, hammer.response_y_mm),
    )


def _listed(frequency_hz: Array) -> str:
    return ", ".join(f"{f:.4g}" for f in frequency_hz)
