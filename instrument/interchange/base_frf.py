"""A sweep from another program's file: FRFs of the pickup over the base's acceleration, or over a force."""

from dataclasses import replace
from pathlib import Path

import numpy as np

from fitting.diagnosis.several.joining import joined
from fitting.modal.frf import Frf
from fitting.specimen import Drive
from fitting.sweep import Sweep, segments_by_gap
from instrument.errors import BadInput
from instrument.files.impact_csv import FRF_STEMS, frfs_of
from instrument.files.sweep_file import SweepFile, sweep_of_columns
from instrument.files.table import check_whole, number, read_header, read_rows
from instrument.interchange.importing import one_table
from instrument.interchange.readers import read_foreign

_TIMES_I_OMEGA = {"displacement": 1, "velocity": 0, "acceleration": -1}


def is_frf_csv(path: Path) -> bool:
    """Whether a CSV's columns are an FRF's and not a sweep's."""
    header = read_header(path)
    return any(f"{stem}_re" in header for stem in FRF_STEMS) and not any("velocity" in n for n in header)


def sweep_of_frf_csv(path: Path, amplitude: float) -> Sweep:
    """Its one FRF, or one of each `pickup`, as responses to a drive of that amplitude. Raises `BadInput`."""
    header, rows = read_rows(path)
    if "pickup" not in header:
        return _sweep(path, _only(path, frfs_of(path, header, rows)), amplitude)
    at = header.index("pickup")
    spots: dict[int, list[tuple[int, list[str]]]] = {}
    for line, row in rows:
        spot = number(path, line, "pickup", row[at])
        check_whole(f"{path}: line {line}", "pickup", spot, row[at])
        spots.setdefault(int(spot), []).append((line, row))
    each = [_sweep(path, _only(path, frfs_of(path, header, some)), amplitude) for some in spots.values()]
    which = np.repeat(np.array(list(spots), dtype=np.intp), [len(s) for s in each])
    return replace(joined(each), pickup=which)


def _only(path: Path, found: dict[str, Frf]) -> Frf:
    if len(found) != 1:
        raise BadInput(f"{path}: {len(found)} FRFs, expected one: the pickup over what drives the plate")
    return next(iter(found.values()))


def sweep_of_foreign(path: Path, amplitude: float, drive: Drive = "base") -> Sweep:
    """The FRFs over a base's motion, or the one over a force, of a foreign file. Raises `BadInput`."""
    if drive == "base":
        return file_of_foreign(path).sweep(amplitude)
    found = read_foreign(path)
    if len(found.frfs) != 1:
        raise BadInput(f"{path}: {len(found.frfs)} responses over a force, expected one")
    return _sweep(path, found.frfs[0][1], amplitude)


def file_of_foreign(path: Path) -> SweepFile:
    """Its responses over a base's motion as rows of a sweep. Raises `BadInput`."""
    found = read_foreign(path)
    if not found.sweeps:
        raise BadInput(
            f"{path}: {'; '.join(found.said)}: no response over a base's acceleration, expected one"
        )
    table = one_table(found.sweeps)
    return sweep_of_columns(path, table, found.reads, found.lines_of(len(table["frequency_hz"])))


def _sweep(path: Path, frf: Frf, amplitude: float) -> Sweep:
    good = (frf.frequency_hz > 0) & (frf.H != 0)
    if not good.any():
        raise BadInput(f"{path}: no line with a value above 0 Hz")
    f = frf.frequency_hz[good]
    over_drive = frf.H[good] * (2j * np.pi * f) ** _TIMES_I_OMEGA[frf.motion]
    level = np.full(len(f), amplitude)
    return Sweep(
        frequency_hz=f,
        velocity_m_s=over_drive * amplitude,
        commanded_m_s2=level,
        segment=segments_by_gap(f),
        sweep=np.ones(len(f), dtype=np.intp),
    )
