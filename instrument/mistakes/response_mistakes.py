"""Mistakes that files are made with, and what each makes of a response: a wrong unit, sign, column, motion.

Most are a factor at all frequencies, a power of i omega, or a conjugate: whatever is left of the response up
to these says which, and the factor says the unit. The others are taken back one by one.
"""

from collections.abc import Callable, Iterator
from dataclasses import dataclass

import numpy as np

from fitting.arrays import Complex
from fitting.gravity import STANDARD_GRAVITY_M_S2
from fitting.specimen import Drive
from fitting.sweep import Sweep

_INCH_M, _POUND_N = 0.0254, 4.448222
_SAME = 0.1
"""Of ln of a factor: what the nearest core leaves open of a unit."""
_BEYOND_HABITS = 2.0
"""ln of a factor that none of `_HABITS` comes near, 7: what is beyond is hardly anything else than a unit."""
_FAR = 4.0
"""ln of a factor that no effect, spot or habit comes near: 50."""
_NO_PHASE = 1e-6
"""Rad between all phases of a sweep."""
_SAME_TURN = 0.35
"""Of its phase, rad."""
SLIGHT = (0.45, 2.2)
"""Factors between may be ones of a calibration, which a diagnosis finds."""
_READINGS = {
    1e3: "the pickup is read in mm (mm/s, mm/s^2), expected m",
    1e6: "the pickup is read in um (um/s), expected m",
    1e9: "the pickup is read in nm (nm/s), expected m",
    1e2: "the pickup is read in cm (cm/s), expected m",
    1 / _INCH_M: "the pickup is read in inches, expected m",
}
_BASES = {
    STANDARD_GRAVITY_M_S2: "the base acceleration is in g, or level_g in m/s^2",
    1e-3: "the base acceleration is in mm/s^2, or the pickup's reading 1000 times too small",
    1e-6: "the base is read in um, or the pickup's reading a million times too small",
    1e3 * STANDARD_GRAVITY_M_S2: "the pickup is read in mm (mm/s) and the base acceleration in g",
    1e6 * STANDARD_GRAVITY_M_S2: "the pickup is read in um (um/s) and the base acceleration in g",
    1 / STANDARD_GRAVITY_M_S2: (
        "the pickup's acceleration is in g, or the reading is for 1 m/s^2 (an FRF: mobility_re, mobility_im)"
    ),
}
_FORCES = {
    1e-3: "the force is in mN, or the pickup's reading 1000 times too small",
    1e3: "the pickup is read in mm (mm/s), expected m, or the force in kN",
    STANDARD_GRAVITY_M_S2: "the force is in kgf, expected N",
    _POUND_N: "the force is in lbf, expected N",
    1 / STANDARD_GRAVITY_M_S2: "the pickup's acceleration is in g, expected m/s^2",
}
_HABITS = {
    2**-0.5: "the pickup's reading is rms and the {drive} an amplitude",
    2**0.5: "the {drive} is rms and the pickup's reading an amplitude",
    2.0: "the pickup's reading is peak to peak and the {drive} an amplitude",
    0.5: "the {drive} is peak to peak and the pickup's reading an amplitude",
    8**0.5: "the pickup's reading is peak to peak and the {drive} rms",
    8**-0.5: "the {drive} is peak to peak and the pickup's reading rms",
}
_MOTIONS = {
    -1: "displacement stands for velocity, or velocity for acceleration",
    -2: "displacement stands for acceleration",
    1: "acceleration stands for velocity, or velocity for the base's acceleration",
    2: "displacement stands for the base's acceleration",
}


@dataclass(frozen=True)
class Mistake:
    """One that may have been made, up to a factor."""

    taken_back: Callable[[Sweep], Complex | None]
    """The response for a unit drive as it should have been, but for a factor; None where it cannot be.
    Shape (points,)."""
    motion: int = 0
    """Power of i omega that the response has too many."""
    conjugated: bool = False
    words: str = ""
    """Where it is neither."""

    def is_slight(self, factor: complex) -> bool:
        """Whether it is no more than a factor that a calibration or a habit may be off by."""
        alone = not (self.motion or self.conjugated or self.words)
        turned = abs(np.angle(factor)) >= _SAME_TURN
        return alone and not turned and SLIGHT[0] < abs(factor) < SLIGHT[1]

    def is_unit(self, factor: complex, drive: Drive) -> bool:
        """Whether it is a known unit of size alone, far from one."""
        size = abs(factor)
        known = any(_is_same(size, value) for value in _units(drive))
        alone = not (self.motion or self.conjugated or self.words)
        return alone and known and abs(np.log(size)) > _FAR and bool(abs(np.angle(factor)) < _SAME_TURN)

    def is_nameless(self, factor: complex, drive: Drive) -> bool:
        """Whether its size is no unit's, no habit's and no calibration's: words of it say a number."""
        size = abs(factor)
        known = any(_is_same(size, value) for value in {**_units(drive), **_HABITS})
        return not (self.words or known or SLIGHT[0] < size < SLIGHT[1])

    def is_habit(self, factor: complex) -> bool:
        """Whether it is one of rms, amplitude and peak to peak."""
        return any(_is_same(abs(factor), value) for value in _HABITS)


def _is_same(size: float, value: float) -> bool:
    """Whether a factor is a known one; beyond habits it may be less near."""
    return bool(abs(np.log(size / value)) < (_SAME if abs(np.log(value)) < _BEYOND_HABITS else 2 * _SAME))


def _units(drive: Drive) -> dict[float, str]:
    return {**_READINGS, **(_BASES if drive == "base" else _FORCES)}


def response_of(sweep: Sweep) -> Complex:
    """As given, for a unit drive. Shape (points,)."""
    return np.asarray(sweep.response_m_s / sweep.commanded_m_s2, dtype=complex)


def mistakes(sweep: Sweep) -> Iterator[Mistake]:
    """All that these data may have been made with, the first of them none but a factor."""
    for conjugated in (False, True) if sweep.has_phase else (False,):
        for motion in (0, *_MOTIONS):
            yield Mistake(_moved(motion, conjugated), motion, conjugated)
    for motion in (0, -2, 2):
        words = "what the pickup reads and what drives are swapped: cables, or columns"
        yield Mistake(_uncrossed(motion), words=words)
    for unit, turn in (("degrees", np.pi / 180), ("rad", 1.0)) if sweep.has_phase else ():
        for motion in (0, 1, -1):
            words = f"amplitude and phase (in {unit}) stand for real and imaginary part"
            yield Mistake(_from_polar(turn, motion), words=words)


def of_another_scale() -> tuple[Mistake, ...]:
    """Those that leave amplitudes on another scale: to be asked where none of the others comes near."""
    return (
        Mistake(_root, words="the response is a power (a square), expected an amplitude"),
        Mistake(_from_decibels, words="the response is in dB, expected an amplitude"),
    )


def lacks_phase(sweep: Sweep) -> bool:
    """Whether phasors all have one phase, which no resonance leaves them."""
    return sweep.has_phase and len(sweep) > 2 and float(np.ptp(np.angle(response_of(sweep)))) < _NO_PHASE


def _moved(motion: int, conjugated: bool) -> Callable[[Sweep], Complex]:
    def taken_back(sweep: Sweep) -> Complex:
        H = response_of(sweep)
        return np.asarray((H.conj() if conjugated else H) * (1j * sweep.omega) ** -motion)

    return taken_back


def _uncrossed(motion: int) -> Callable[[Sweep], Complex | None]:
    """Where the pickup's column is a velocity; `motion` where it is another one."""

    def taken_back(sweep: Sweep) -> Complex | None:
        if sweep.base_m_s2 is None:
            return None
        return np.asarray((1j * sweep.omega) ** motion / response_of(sweep))

    return taken_back


def _root(sweep: Sweep) -> Complex | None:
    return np.asarray(np.sqrt(np.abs(response_of(sweep))), dtype=complex)


def _from_decibels(sweep: Sweep) -> Complex | None:
    read = np.abs(sweep.velocity_m_s)
    if not 1 < np.median(read) < 400:
        return None
    return np.asarray(10 ** (read / 20), dtype=complex)


def _from_polar(turn: float, motion: int) -> Callable[[Sweep], Complex | None]:
    """Where the pickup's column is a velocity; `motion` where it is another one."""

    def taken_back(sweep: Sweep) -> Complex | None:
        by = (1j * sweep.omega) ** motion
        read, base = sweep.velocity_m_s * by, sweep.base_m_s2
        if np.any(read.real <= 0):
            return None
        v = read.real * np.exp(1j * turn * read.imag) / by
        return np.asarray(v / (sweep.commanded_m_s2 if base is None else base))

    return taken_back


def words_of(mistake: Mistake, factor: complex, drive: Drive) -> str:
    """What seems to have been done, in a phrase."""
    if mistake.words:
        return mistake.words
    said = [*_size(abs(factor), drive), *_turned(mistake, factor)]
    if mistake.motion:
        said.append(f"{_MOTIONS[mistake.motion]}: a column's name says what it holds")
    return ", and ".join(said)


def _turned(mistake: Mistake, factor: complex) -> list[str]:
    turn = float(np.angle(factor))
    conjugated = ["the phase is conjugated, expected e^{+i omega t}"] if mistake.conjugated else []
    if abs(turn) < _SAME_TURN:
        return conjugated
    if abs(abs(turn) - np.pi) < _SAME_TURN:
        if mistake.conjugated:
            # An acceleration or a displacement that is conjugated is a velocity conjugated and turned.
            return [f"{conjugated[0]} (if it is a velocity, its sign is turned too)"]
        return ["the sign is turned, expected the pickup's and the drive's in one direction"]
    if abs(abs(turn) - np.pi / 2) < _SAME_TURN:
        if mistake.conjugated:
            return ["real and imaginary part of one channel are exchanged"]
        return ["one channel is turned by 90 degrees: are real and imaginary part exchanged?"]
    return [*conjugated, f"one channel is turned by {np.degrees(turn):.0f} degrees at all frequencies"]


def _size(size: float, drive: Drive) -> list[str]:
    if abs(np.log(size)) < _SAME:
        return []
    name = "base acceleration" if drive == "base" else "force"
    known = {**_units(drive), **_HABITS}
    nearest = min(known, key=lambda value: abs(np.log(size / value)))
    if _is_same(size, nearest):
        return [known[nearest].format(drive=name)]
    if SLIGHT[0] < size < SLIGHT[1]:
        return []
    return [
        f"the reading is {size:.2g} times this specimen's at all frequencies alike: unit, level, gain or the "
        "pickup's place"
    ]
