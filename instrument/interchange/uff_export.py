"""A session as universal files: the sweep and the hammer test as FRFs, the hits as time records.

One file each: readers that look for time records pass over a file with FRFs in it, and average all the
hits they find, so that those that do not count have a file of their own.
"""

import re
import warnings
from collections.abc import Iterable
from datetime import datetime
from pathlib import Path
from typing import Any

import numpy as np
import pyuff
from numpy.typing import NDArray

from fitting.modal.frf import Frf
from instrument.files.at_once import at_once
from instrument.files.replaceable import Written, refuse_to_lose
from instrument.files.uff58 import CODES, COHERENCE, FRF, TIME
from instrument.impact.spectra import spectra
from instrument.session.contents import Contents, RecordedHit, TimedPoint

_VELOCITY, _ACCELERATION, _FORCE = CODES["velocity"], CODES["acceleration"], CODES["force"]
_SECONDS, _HERTZ = 17, 18
_NODES = {"velocity": 1, "base": 2, "force": 3, "response": 4}
_FURTHER_SPOTS = 10
"""Node of a further spot, less its number."""
_LEAST_LINES = 2
"""The library takes the step from the first two."""
_EXPORTED = Written(re.compile(rb"\s*-1\s+151\s.*\bviscorig ", re.DOTALL))
"""A data set 151 that names this program comes first."""


def export_uff(contents: Contents, folder: Path) -> tuple[list[Path], list[str]]:
    """Files written, and what data set 58 could not carry."""
    name = contents.configuration.name
    sweep, left_out = _sweep_sets(contents)
    files = {
        f"{name}-sweep.uff": sweep,
        f"{name}-hammer-frf.uff": _hammer_sets(contents),
        f"{name}-hits.uff": [s for h in contents.hits if h.accepted for s in _hit_sets(contents, h)],
        f"{name}-hits-rejected.uff": [
            s for h in contents.hits if not h.accepted for s in _hit_sets(contents, h)
        ],
    }
    for file in files:
        refuse_to_lose(folder / file, _EXPORTED)
    written = []
    for file, sets in files.items():
        if sets:
            _write(folder / file, [*_headers(contents), *sets])
            written.append(folder / file)
    return written, left_out


def _sweep_sets(contents: Contents) -> tuple[list[dict[str, Any]], list[str]]:
    """Velocity over base acceleration, a set for each segment of each sweep; its level on the z axis."""
    groups: dict[tuple[int, int, float, int], list[TimedPoint]] = {}
    every = [p for p in contents.points if p.point.purpose == "step"]
    steps = [p for p in every if not p.point.mass_kg and not p.point.mounting]
    for p in steps:
        key = p.point.sweep, p.point.segment, p.point.level_m_s2, p.point.pickup
        groups.setdefault(key, []).append(p)
    said = []
    if len(every) < len(contents.points):
        said.append(
            f"{len(contents.points) - len(every)} sentinel points are not in the universal file: "
            "a data set has one value a frequency"
        )
    if len(steps) < len(every):
        said.append(
            f"{len(every) - len(steps)} points with a known mass or clamped anew are not in the universal "
            "file: a data set cannot say so"
        )
    sets = []
    for (sweep, segment, level, spot), points in groups.items():
        points.sort(key=lambda p: p.point.frequency_hz)
        if len(points) < _LEAST_LINES:
            said.append(f"sweep {sweep} segment {segment}: one point is too few for a data set")
            continue
        node = {"rsp_node": _FURTHER_SPOTS + spot} if spot else {}
        sets.append(_sweep_set(contents, f"sweep {sweep} segment {segment}", level, points) | node)
    return sets, said


def _sweep_set(contents: Contents, which: str, level_m_s2: float, points: list[TimedPoint]) -> dict[str, Any]:
    f = np.array([p.point.frequency_hz for p in points])
    H = np.array([p.point.velocity_m_s / p.point.base_m_s2 for p in points])
    reads = contents.configuration.rig.vibrometer.reads
    return (
        _common(contents, f"{reads} velocity over base acceleration", which, "velocity", "base")
        | _on_lines(f, even=False)
        | {
            "func_type": FRF,
            "ord_data_type": 6,
            "data": H,
            "ordinate_spec_data_type": _VELOCITY,
            "ordinate_axis_units_lab": "m/s",
            "orddenom_spec_data_type": _ACCELERATION,
            "orddenom_axis_units_lab": "m/s^2",
            "z_axis_spec_data_type": _ACCELERATION,
            "z_axis_axis_units_lab": "m/s^2",
            "z_axis_value": float(level_m_s2),
        }
    )


def _hammer_sets(contents: Contents) -> list[dict[str, Any]]:
    """Accelerance by H1 over the accepted hits, and its coherence where there are several."""
    good = [h.judged() for h in contents.good_hits]
    if not good:
        return []
    found = spectra(good)
    frf = found.frfs["response"]
    sets = [_hammer_frf(contents, frf, len(good))]
    if found.coherence is not None and len(good) > 1:
        coherence = _common(
            contents, "coherence of the hammer test", f"{len(good)} hits", "response", "force"
        )
        coherence |= _on_lines(frf.frequency_hz, even=True)
        sets.append(
            coherence | {"func_type": COHERENCE, "ord_data_type": 4, "data": found.coherence["response"]}
        )
    return sets


def _hammer_frf(contents: Contents, frf: Frf, hits: int) -> dict[str, Any]:
    return (
        _common(contents, "accelerance of the bare plate, H1", f"{hits} hits", "response", "force")
        | _on_lines(frf.frequency_hz, even=True)
        | {
            "func_type": FRF,
            "ord_data_type": 6,
            "data": frf.H,
            "ordinate_spec_data_type": _ACCELERATION,
            "ordinate_axis_units_lab": "m/s^2",
            "orddenom_spec_data_type": _FORCE,
            "orddenom_axis_units_lab": "N",
        }
    )


def _hit_sets(contents: Contents, hit: RecordedHit) -> list[dict[str, Any]]:
    """Force, then response, as caught."""
    record, verdict = hit.record, "accepted" if hit.accepted else f"rejected: {hit.why}"
    return [
        _common(contents, label, f"hit {hit.number} {verdict}", channel, "force")
        | {
            "func_type": TIME,
            "ord_data_type": 4,
            "abscissa_spacing": 1,
            "num_pts": len(samples),
            "abscissa_min": 0.0,
            "abscissa_inc": 1 / record.sample_rate_hz,
            "abscissa_spec_data_type": _SECONDS,
            "abscissa_axis_units_lab": "s",
            "ordinate_spec_data_type": code,
            "ordinate_axis_units_lab": unit,
            "data": samples,
            "x": np.arange(len(samples)) / record.sample_rate_hz,
        }
        for label, channel, code, unit, samples in (
            ("force", "force", _FORCE, "N", record.force_n),
            ("acceleration_m_s2", "response", _ACCELERATION, "m/s^2", record.responses[0].samples),
        )
    ]


def _on_lines(f: NDArray[np.float64], *, even: bool) -> dict[str, Any]:
    return {
        "abscissa_spacing": int(even),
        "num_pts": len(f),
        "abscissa_min": float(f[0]),
        "abscissa_inc": float(f[1] - f[0]) if even else 0.0,
        "abscissa_spec_data_type": _HERTZ,
        "abscissa_axis_units_lab": "Hz",
        "x": f,
    }


def _common(contents: Contents, what: str, which: str, response: str, reference: str) -> dict[str, Any]:
    c = contents.configuration
    when = datetime.fromisoformat(c.created_utc)
    return {
        "type": 58,
        "binary": 1,
        "id1": _line(what),
        "id2": _line(which),
        "id3": f"{when:%d-%b-%y %H:%M:%S}".upper(),
        "id4": _line(c.name),
        "id5": _line(c.experiment.title),
        "rsp_ent_name": response.upper(),
        "rsp_node": _NODES[response],
        "rsp_dir": 3,
        "ref_ent_name": reference.upper(),
        "ref_node": _NODES[reference],
        "ref_dir": 3,
        "orddenom_spec_data_type": 0,
        "z_axis_value": 0.0,
    }


def _headers(contents: Contents) -> list[dict[str, Any]]:
    """Data sets 151, who and when, and 164, units: SI."""
    c = contents.configuration
    when = datetime.fromisoformat(c.created_utc)
    created = {"date_db_created": f"{when:%d-%b-%y}".upper(), "time_db_created": f"{when:%H:%M:%S}"}
    program = f"viscorig {c.versions.get('viscorig', '')}"
    return [
        {
            "type": 151,
            "model_name": _line(c.name),
            "description": _line(c.experiment.title),
            "db_app": program,
            "program": program,
            **created,
        },
        {
            "type": 164,
            "units_code": 1,
            "units_description": "SI: metre (newton)",
            "temp_mode": 1,
            "length": 1.0,
            "force": 1.0,
            "temp": 1.0,
            "temp_offset": 273.15,
        },
    ]


def _line(text: str) -> str:
    """An ID line: 80 characters of ASCII, never blank."""
    return " ".join(text.split()).encode("ascii", "replace").decode()[:80] or "NONE"


def _write(path: Path, sets: Iterable[dict[str, Any]]) -> None:
    # The library's "overwrite" wipes a binary set's header; closing its file it leaves to the collector.
    with at_once(path) as draft, warnings.catch_warnings():
        warnings.simplefilter("ignore", ResourceWarning)
        try:
            pyuff.UFF(str(draft)).write_sets(list(sets), mode="add")
        except Exception as error:  # the library says of a full disk no more than that it failed
            raise OSError(f"{error}: is the disk full?") from error
