"""What is said of other programs' data once they are read: where they are to be found, or why nowhere."""

from collections.abc import Sequence
from pathlib import Path

import numpy as np

from fitting.arrays import Array
from instrument.check.piece import Region
from instrument.interchange.found import Found

_KILO = 1e3


def laid_words(path: Path, found: Found, *, has_session: bool) -> str:
    """Where they are to be found."""
    sweeps = found.sweeps
    where = "laid beside the session" if has_session else "read"
    if sweeps and all("force_re_n" in columns for columns in sweeps):
        where += "; over a force, so not drawn on Sweep: Diagnosis takes it"
    elif sweeps and not has_session:
        where += "; Diagnosis takes it with its specimen"
    if found.modes:
        where += "; a law of them: Several files"
    if (found.frfs or found.hits) and not has_session:
        where += "; drawn on Hammer once a session with hits is open"
    if found.hits:
        where += f"; damping ratios of records in time: viscorig damping {path.name}"
    return where


def unseen_words(found: Found, regions: Sequence[Region]) -> str:
    """Why no pane of Sweep shows a point; empty where one does, or there is nothing for it to show."""
    hertz = [columns["frequency_hz"] for columns in found.sweeps if "force_re_n" not in columns]
    if not regions or not hertz:
        return ""
    frequency_hz = np.concatenate(hertz)
    if _inside(frequency_hz, regions):
        return ""
    own, shown = _from_to(frequency_hz), _from_to(np.array([ends for _, *ends in regions]))
    kilo = ": is it in kHz?" if _inside(_KILO * frequency_hz, regions) else ""
    return f"{own} is outside all segments ({shown}), no pane shows it{kilo}"


def _inside(frequency_hz: Array, regions: Sequence[Region]) -> bool:
    return any(np.any((frequency_hz >= low) & (frequency_hz <= high)) for _, low, high in regions)


def _from_to(frequency_hz: Array) -> str:
    return f"{frequency_hz.min():.4g} to {frequency_hz.max():.4g} Hz"
