"""Universal file, data set 58: time records and FRFs, ASCII or binary, by pyuff."""

import warnings
from pathlib import Path
from typing import Any

import numpy as np
import pyuff

from fitting.modal.frf import Frf, Motion
from instrument.errors import BadInput
from instrument.impact.record import Channel, Hit

_TIME, _FRF = 1, 4
_FORCE = 13
_MOTIONS: dict[int, Motion] = {8: "displacement", 11: "velocity", 12: "acceleration"}
_CODES = {motion: code for code, motion in _MOTIONS.items()}


def read_uff58(path: Path) -> list[Hit] | dict[str, Frf]:
    """The FRFs of a file where it holds any, else its time records in order: a force, then its responses."""
    sets = _sets(path)
    frfs = {
        f"{s['id1'].strip() or 'frf'} {k + 1}": _frf(path, s)
        for k, s in enumerate(sets)
        if s["func_type"] == _FRF
    }
    if frfs:
        return frfs
    hits: list[Hit] = []
    for s in (s for s in sets if s["func_type"] == _TIME):
        rate = 1 / float(s["abscissa_inc"])
        if s["ordinate_spec_data_type"] == _FORCE:
            hits.append(Hit(f"{path.name} hit {len(hits) + 1}", rate, np.asarray(s["data"], float), ()))
        elif s["ordinate_spec_data_type"] in _MOTIONS and hits:
            last = hits[-1]
            name = s["id1"].strip() or f"response {len(last.responses) + 1}"
            channel = Channel(name, _MOTIONS[s["ordinate_spec_data_type"]], np.asarray(s["data"], float))
            hits[-1] = Hit(last.source, last.sample_rate_hz, last.force_n, (*last.responses, channel))
    if not hits or not all(h.responses for h in hits):
        raise BadInput(f"{path}: no force with a response behind it, and no FRF (data set 58)")
    return hits


def write_frf(path: Path, frfs: dict[str, Frf], *, binary: bool = True) -> None:
    """FRFs as data set 58, double precision; uneven lines are kept as they are."""
    _write(path, [_frf_set(name, frf, binary=binary) for name, frf in frfs.items()])


def write_hits(path: Path, hits: list[Hit], *, binary: bool = True) -> None:
    """Each hit as its force and then its responses."""
    sets = []
    for hit in hits:
        sets.append(_time_set("force", _FORCE, hit.force_n, hit.sample_rate_hz, binary=binary))
        sets += [
            _time_set(c.name, _CODES[c.motion], c.samples, hit.sample_rate_hz, binary=binary)
            for c in hit.responses
        ]
    _write(path, sets)


def _sets(path: Path) -> list[dict[str, Any]]:
    if not path.is_file():
        raise BadInput(f"{path}: no such file")
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            read = pyuff.UFF(str(path)).read_sets()
    except Exception as error:
        raise BadInput(f"{path}: not a universal file: {error}") from None
    found = [s for s in (read if isinstance(read, list) else [read]) if s.get("type") == 58]
    if not found:
        raise BadInput(f"{path}: no data set 58")
    return found


def _frf(path: Path, s: dict[str, Any]) -> Frf:
    denominator = s.get("orddenom_spec_data_type", 0)
    if denominator not in (0, 1, _FORCE):
        raise BadInput(
            f"{path}: FRF over data type {denominator}, expected over a force: "
            "'viscorig import' takes a response over a base motion"
        )
    motion = _MOTIONS.get(s["ordinate_spec_data_type"])
    if motion is None:
        raise BadInput(
            f"{path}: FRF of data type {s['ordinate_spec_data_type']}, "
            "expected 8, 11 or 12 (displacement, velocity, acceleration)"
        )
    return Frf(np.asarray(s["x"], float), np.asarray(s["data"], complex), motion)


def _frf_set(name: str, frf: Frf, *, binary: bool) -> dict[str, Any]:
    steps = np.diff(frf.frequency_hz)
    even = bool(np.allclose(steps, steps[0], rtol=1e-9))
    return _common(name, binary=binary) | {
        "func_type": _FRF,
        "ord_data_type": 6,
        "abscissa_spacing": 1 if even else 0,
        "num_pts": len(frf.frequency_hz),
        "abscissa_min": float(frf.frequency_hz[0]),
        "abscissa_inc": float(steps[0]) if even else 0.0,
        "abscissa_spec_data_type": 18,
        "ordinate_spec_data_type": _CODES[frf.motion],
        "orddenom_spec_data_type": _FORCE,
        "data": frf.H,
        "x": frf.frequency_hz,
    }


def _time_set(name: str, code: int, samples: Any, rate: float, *, binary: bool) -> dict[str, Any]:
    return _common(name, binary=binary) | {
        "func_type": _TIME,
        "ord_data_type": 4,
        "abscissa_spacing": 1,
        "num_pts": len(samples),
        "abscissa_min": 0.0,
        "abscissa_inc": float(1 / rate),
        "abscissa_spec_data_type": 17,
        "ordinate_spec_data_type": code,
        "orddenom_spec_data_type": 0,
        "data": np.asarray(samples, float),
        "x": np.arange(len(samples)) / rate,
    }


def _common(name: str, *, binary: bool) -> dict[str, Any]:
    return {
        "type": 58,
        "binary": int(binary),
        "id1": name,
        "id2": "NONE",
        "id3": "NONE",
        "id4": "NONE",
        "id5": "NONE",
        "rsp_node": 1,
        "rsp_dir": 3,
        "ref_node": 1,
        "ref_dir": 3,
        "z_axis_value": 0.0,
    }


def _write(path: Path, sets: list[dict[str, Any]]) -> None:
    path.unlink(missing_ok=True)
    # The library's "overwrite" wipes a binary set's header; closing its file it leaves to the collector.
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", ResourceWarning)
        pyuff.UFF(str(path)).write_sets(sets, mode="add")
