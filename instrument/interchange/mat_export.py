"""A session as a MATLAB file: one struct a part, and the same structs again in `units`."""

from pathlib import Path
from typing import Any

import numpy as np
from scipy.io import savemat, whosmat

from instrument.facts.damping import METHODS
from instrument.files.at_once import at_once
from instrument.files.replaceable import refuse_another_file
from instrument.impact.spectra import spectra
from instrument.interchange.point_table import PointColumn, columns
from instrument.interchange.provenance import provenance, reading
from instrument.results.session_result import recorded_result
from instrument.session.contents import Contents


def export_mat(contents: Contents, folder: Path) -> list[Path]:
    """`sweep`, `hits`, `hammer_frf`, `damping`, `calibration`: what there is, and `units` and `about`."""
    parts = {
        "sweep": _sweep(contents) if contents.points else [],
        "hits": _hits(contents),
        "hammer_frf": _hammer_frf(contents),
        "damping": _damping(contents),
        "calibration": _calibration(contents),
    }
    there = {name: table for name, table in parts.items() if table}
    content: dict[str, Any] = {name: {c.name: c.values for c in table} for name, table in there.items()}
    content["units"] = {name: {c.name: c.unit or "text" for c in table} for name, table in there.items()}
    said = [*provenance(contents), *reading(contents)]
    if contents.points:
        said.append(f"result: {recorded_result(contents).words}")
    content["about"] = np.array(said, dtype=object)
    path = folder / f"{contents.configuration.name}.mat"
    if path.is_file() and not _is_exported(path):
        refuse_another_file(path)
    with at_once(path) as draft:
        savemat(draft, content, oned_as="column", do_compression=True)
    return [path]


def _is_exported(path: Path) -> bool:
    """Whether a file has what every export has, or nothing."""
    try:
        return not path.stat().st_size or {"about", "units"} <= {name for name, *_ in whosmat(path)}
    except Exception:  # the reader's own refusals are of any kind
        return False


def _sweep(contents: Contents) -> list[PointColumn]:
    """As in the CSV, phasors complex."""
    by_name = {c.name: c for c in columns(contents)}
    table = []
    for name, c in by_name.items():
        if "_re_" in name:
            imaginary = by_name[name.replace("_re_", "_im_")].values
            table.append(PointColumn(name.replace("_re_", "_"), c.unit, c.values + 1j * imaginary))
        elif "_im_" not in name:
            table.append(c)
    return table


def _hits(contents: Contents) -> list[PointColumn]:
    """Samples as columns, a column a hit."""
    if not contents.hits:
        return []
    records = [h.record for h in contents.hits]
    return [
        PointColumn("sample_rate_hz", "Hz", np.array(records[0].sample_rate_hz)),
        PointColumn("accepted", "1", np.array([h.accepted for h in contents.hits])),
        PointColumn("why", "", np.array([h.why for h in contents.hits], dtype=object)),
        PointColumn("force_n", "N", np.column_stack([r.force_n for r in records])),
        PointColumn("acceleration_m_s2", "m/s^2", np.column_stack([r.responses[0].samples for r in records])),
    ]


def _hammer_frf(contents: Contents) -> list[PointColumn]:
    good = [h.judged() for h in contents.good_hits]
    if not good:
        return []
    found = spectra(good)
    frf = found.frfs["response"]
    table = [
        PointColumn("frequency_hz", "Hz", frf.frequency_hz),
        PointColumn("accelerance", "(m/s^2)/N", frf.H),
    ]
    if found.coherence is not None and len(good) > 1:
        table.append(PointColumn("coherence", "1", found.coherence["response"]))
    return table


def _damping(contents: Contents) -> list[PointColumn]:
    """Adopted values and each method's, NaN where a method refused."""
    if contents.damping is None or not contents.damping.result.modes:
        return []
    modes = contents.damping.result.modes
    table = [
        PointColumn("frequency_hz", "Hz", _floats([m.frequency_hz for m in modes])),
        PointColumn("damping_ratio", "1", _floats([m.damping_ratio for m in modes])),
        PointColumn("accepted", "1", np.array([m.accepted for m in modes])),
    ]
    for method in METHODS:
        said = [m.by(method) for m in modes]
        table += [
            PointColumn(f"{method}_ratio", "1", _floats([e.ratio if e else None for e in said])),
            PointColumn(f"{method}_std", "1", _floats([e.standard_error if e else None for e in said])),
        ]
    return table


def _calibration(contents: Contents) -> list[PointColumn]:
    found = list(contents.calibrations.values())
    if not found:
        return []
    keys = (("gain", "1"), ("gain_std", "1"), ("delay_s", "s"), ("delay_std_s", "s"))
    table = [PointColumn(key, unit, _floats([getattr(c, key) for c in found])) for key, unit in keys]
    return [PointColumn("range", "", np.array([c.range_name for c in found], dtype=object)), *table]


def _floats(values: list[Any]) -> np.ndarray:
    return np.array([np.nan if v is None else v for v in values], dtype=float)
