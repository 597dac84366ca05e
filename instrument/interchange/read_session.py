"""A session's own sweep as another one sees it: beside its data."""

from pathlib import Path

import numpy as np

from fitting.gravity import PUBLISHED_G_M_S2
from instrument.errors import BadInput
from instrument.interchange.found import Found
from instrument.session.contents import contents_of
from instrument.session.storage import SessionFile
from instrument.stream.derived import PointMeasured


def read_session(path: Path) -> Found:
    """Steps of a session without its sentinels. Raises `BadInput`, also where it has none."""
    with SessionFile(path) as session:
        contents = contents_of(session, with_hits=False)
    points = [t.point for t in contents.points if t.point.purpose == "step"]
    if not points:
        raise BadInput(f"{path}: no point of a sweep, expected a session with one")
    return Found(sweeps=[_columns(points)])


def _columns(points: list[PointMeasured]) -> dict[str, np.ndarray]:
    v, base = np.array([p.velocity_m_s for p in points]), np.array([p.base_m_s2 for p in points])
    return {
        "frequency_hz": np.array([p.frequency_hz for p in points]),
        "velocity_re_m_s": v.real,
        "velocity_im_m_s": v.imag,
        "base_accel_re_m_s2": base.real,
        "base_accel_im_m_s2": base.imag,
        "level_g": np.array([p.level_m_s2 for p in points]) / PUBLISHED_G_M_S2,
    }
