"""One validated way in for other programs' files: what is beyond a record or an FRF is refused by place."""

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import numpy as np

from fitting.modal.frf import Frf
from instrument.errors import BadInput
from instrument.files.table import LARGEST, SMALLEST
from instrument.impact.record import Hit

_RATES_HZ = (20.0, 1e8)
"""Slower than any blow; a rate in kHz is below."""
_LEAST_SAMPLES = 8
_LONGEST = 100
_FAULTS = (ArithmeticError, AttributeError, LookupError, MemoryError, TypeError, ValueError)
"""What a reader meets where a file is not what it says it is."""


@contextmanager
def said_of(path: Path) -> Iterator[None]:
    """Say what a reader met of its file, in one line; what numpy would warn of, too. Raises `BadInput`."""
    try:
        with np.errstate(divide="raise", over="raise", invalid="raise"):
            yield
    except BadInput:
        raise
    except FloatingPointError as error:
        raise BadInput(f"{path}: values that are none, or beyond {LARGEST:g}") from error
    except _FAULTS as error:
        said = " ".join(str(error).split())[:_LONGEST]
        raise BadInput(f"{path}: not as its format has it: {type(error).__name__}: {said}") from error


def checked_hits(path: Path, hits: list[Hit]) -> list[Hit]:
    """Hits as given, if each has real finite samples, all channels equally long. Raises `BadInput`."""
    for hit in hits:
        where = _placed(path, hit.source)
        if not _RATES_HZ[0] <= hit.sample_rate_hz <= _RATES_HZ[1]:
            raise BadInput(
                f"{where}: {hit.sample_rate_hz:g} samples/s, expected {_RATES_HZ[0]:g} to "
                f"{_RATES_HZ[1]:g} (Hz, not kHz)"
            )
        for name, samples in (("force", hit.force_n), *((c.name, c.samples) for c in hit.responses)):
            said = _fault(samples, len(hit.force_n))
            if said or len(samples) < _LEAST_SAMPLES:
                why = said or f"{len(samples)} samples, expected {_LEAST_SAMPLES} or more"
                raise BadInput(f"{where}: channel {name}: {why}")
    return hits


def checked_frf(path: Path, name: str, frf: Frf) -> Frf:
    """An FRF as it is given, if of ascending frequencies and as many finite values. Raises `BadInput`."""
    f = np.asarray(frf.frequency_hz)
    said = _fault(f, np.size(f)) or _fault(frf.H, np.size(f), complex_too=True)
    if not said and (len(f) < 2 or np.any(np.diff(f) <= 0) or f[0] < 0):
        said = "frequencies, expected ascending from 0 or above"
    if not said and not np.any(frf.H):
        said = "zero everywhere, expected a response"
    if said:
        raise BadInput(f"{_placed(path, name)}: {said}")
    return frf


def _placed(path: Path, name: str) -> str:
    """What a fault is of: a file, and what in it; readers often name the file in the latter."""
    return f"{path}{name.removeprefix(path.name)}" if name.startswith(path.name) else f"{path}: {name}"


def _fault(values: object, count: int, *, complex_too: bool = False) -> str:
    """What keeps an array from being a channel; empty for a good one."""
    a = np.asarray(values)
    if a.ndim != 1 or a.dtype.kind not in ("fiuc" if complex_too else "fiu"):
        return f"shape {a.shape} of {a.dtype}, expected one row of numbers"
    if len(a) != count:
        return f"{len(a)} values beside {count}, expected equally many"
    size = np.abs(a[a != 0])
    if not np.all(np.isfinite(size)) or (size.size and (size.max() > LARGEST or size.max() < SMALLEST)):
        return f"values beyond {LARGEST:g}, below {SMALLEST:g} or none, expected finite numbers"
    return ""
