"""The law from a recorded session: its points, its specimen, its hammer test."""

from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from fitting.identification.bare_plate import BarePlateFit, fit_bare_plate, with_bare_plate
from fitting.specimen import Specimen
from fitting.sweep import Sweep
from instrument.errors import BadInput
from instrument.identification import Identified, identify
from instrument.interchange.contents import Contents
from instrument.points import sweep_of
from instrument.progress import Progress, quiet

Array = NDArray[np.float64]


@dataclass(frozen=True)
class SessionFit:
    """An identification and what went into it."""

    identified: Identified
    sweep: Sweep
    specimen: Specimen
    """Stiffness and ratios as the hammer test has them, where it took part."""
    bare: BarePlateFit | None


def identify_session(contents: Contents, progress: Progress = quiet) -> SessionFit:
    """As the live identification does: all points, jointly with the session's hammer test.

    Raises `BadInput` without points, `FittingError` where these points carry no law.
    """
    specimen, bare = contents.specimen, None
    modes = session_modes(contents)
    if modes is not None:
        bare = fit_bare_plate(specimen, *modes)
        specimen = with_bare_plate(specimen, bare)
    sweep = session_sweep(contents, specimen)
    return SessionFit(identify(sweep, specimen, "direct", progress), sweep, specimen, bare)


def session_sweep(contents: Contents, specimen: Specimen) -> Sweep:
    """Steps and sentinels, each at its commanded level. Raises `BadInput` where there are none."""
    if not contents.points:
        raise BadInput(f"{contents.path}: no point of a sweep in this session, expected a measured sweep")
    return replace(
        sweep_of(contents.measured, specimen.base_acceleration_m_s2),
        commanded_m_s2=np.array([p.level_m_s2 for p in contents.measured]),
        time_s=np.array([p.time_s for p in contents.points]),
    )


def session_modes(contents: Contents) -> tuple[Array, Array] | None:
    """Frequencies in Hz and ratios (NaN where there is none) of the hammer test's accepted modes, if any."""
    found: dict[str, Any] = contents.damping.facts_json if contents.damping is not None else {"modes": []}
    modes = [m for m in found["modes"] if m["accepted"]]
    if not modes:
        return None
    ratios = [np.nan if m["damping_ratio"] is None else m["damping_ratio"] for m in modes]
    return np.array([m["frequency_hz"] for m in modes]), np.array(ratios)
