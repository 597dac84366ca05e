"""Impact records and FRFs as CSV."""

from pathlib import Path

import numpy as np

from fitting.arrays import Array
from fitting.modal.frf import Frf, Motion
from instrument.errors import BadInput
from instrument.files.at_once import write_at_once
from instrument.files.rates import CONTRADICTION
from instrument.files.table import check_frequency, number, rate_of_times, read_rows, stated_rate_hz
from instrument.impact.record import Hit, ResponseChannel

MOTIONS: dict[str, Motion] = {
    "acceleration_m_s2": "acceleration",
    "velocity_m_s": "velocity",
    "displacement_m": "displacement",
}
FRF_STEMS: dict[str, Motion] = {
    "accelerance": "acceleration",
    "mobility": "velocity",
    "receptance": "displacement",
}


def is_frf(header: list[str]) -> bool:
    """Whether a header is that of an FRF."""
    return "frequency_hz" in header


def read_impact_csv(path: Path, rate_hz: float | None = None) -> list[Hit] | dict[str, Frf]:
    """Hits of a record, or the FRFs of a file that begins with `frequency_hz`. Raises `BadInput`."""
    header, rows = read_rows(path)
    if is_frf(header):
        return frfs_of(path, header, rows)
    names = [n for n in header if n in MOTIONS]
    if "force_n" not in header or not names:
        raise BadInput(
            f"{path}: header: found {', '.join(header)[:100]}, expected force_n and one of "
            f"{', '.join(MOTIONS)} (units are part of the name), or an FRF with frequency_hz"
        )
    columns = {n: _column(path, header, rows, n) for n in ("force_n", *names, "time_s", "hit") if n in header}
    rate = _rate(path, columns, rate_hz)
    which = columns.get("hit", np.ones(len(rows)))
    hits = []
    for number_of_hit in np.unique(which):
        inside = which == number_of_hit
        source = f"{path.name} hit {number_of_hit:g}" if "hit" in columns else path.name
        channels = tuple(ResponseChannel(n, MOTIONS[n], columns[n][inside]) for n in names)
        hits.append(Hit(source, rate, columns["force_n"][inside], channels))
    return hits


def write_impact_csv(path: Path, hits: list[Hit]) -> None:
    """The hits of one test in one file."""
    channels = [c.name for c in hits[0].responses]
    lines = [f"# sample_rate_hz: {float(hits[0].sample_rate_hz)!r}", ",".join(["hit", "force_n", *channels])]
    for k, hit in enumerate(hits, start=1):
        table = np.column_stack([hit.force_n, *(c.samples for c in hit.responses)])
        lines += [",".join([str(k), *(repr(float(v)) for v in row)]) for row in table]
    write_at_once(path, "\n".join(lines) + "\n")


def write_frf_csv(path: Path, frf: Frf, coherence: Array | None = None) -> None:
    """One FRF; `coherence` on its lines, shape (lines,)."""
    stem = next(s for s, motion in FRF_STEMS.items() if motion == frf.motion)
    header = ["frequency_hz", f"{stem}_re", f"{stem}_im"] + (["coherence"] if coherence is not None else [])
    table = [frf.frequency_hz, frf.H.real, frf.H.imag] + ([coherence] if coherence is not None else [])
    rows = [",".join(repr(float(v)) for v in row) for row in np.column_stack(table)]
    write_at_once(path, "\n".join([",".join(header), *rows]) + "\n")


def frfs_of(path: Path, header: list[str], rows: list[tuple[int, list[str]]]) -> dict[str, Frf]:
    """The FRFs of some rows of a file, by their stems. Raises `BadInput`."""
    if "frequency_hz" not in header:
        raise BadInput(f"{path}: header: column frequency_hz missing, found {', '.join(header)[:100]}")
    f = _column(path, header, rows, "frequency_hz")
    for (line, row), value in zip(rows, f, strict=True):
        check_frequency(f"{path}: line {line}", "frequency_hz", value, row[header.index("frequency_hz")])
    if np.any(np.diff(f) <= 0) or len(f) < 5 or f[0] < 0:
        raise BadInput(f"{path}: frequency_hz, expected 5 or more lines, ascending from 0 or above")
    found = {}
    for stem, motion in FRF_STEMS.items():
        if f"{stem}_re" in header and f"{stem}_im" in header:
            H = _column(path, header, rows, f"{stem}_re") + 1j * _column(path, header, rows, f"{stem}_im")
            found[stem] = Frf(f, H, motion)
    if not found:
        raise BadInput(
            f"{path}: header: no FRF, expected accelerance_re and accelerance_im, "
            "or mobility_*, or receptance_*"
        )
    return found


def _column(path: Path, header: list[str], rows: list[tuple[int, list[str]]], name: str) -> Array:
    k = header.index(name)
    return np.array([number(path, line, name, row[k]) for line, row in rows])


def _rate(path: Path, columns: dict[str, Array], rate_hz: float | None) -> float:
    """The rate the file states or its times give; the option where neither does. They must not contradict."""
    stated = stated_rate_hz(path)
    said = [r for r in (rate_hz, stated) if r is not None]
    if "time_s" in columns or not said:
        said.append(_rate_of(path, columns))
    if max(said) > min(said) * (1 + CONTRADICTION):
        raise BadInput(
            f"{path}: sample rates contradict: {', '.join(f'{r:.6g}' for r in said)} Hz "
            "(--rate, sample_rate_hz, time_s)"
        )
    return said[0]


def _rate_of(path: Path, columns: dict[str, Array]) -> float:
    if "time_s" not in columns:
        raise BadInput(f"{path}: no sample rate, expected time_s, a line '# sample_rate_hz: ...' or --rate")
    t = columns["time_s"]
    if "hit" in columns:
        t = t[columns["hit"] == columns["hit"][0]]
    rate = rate_of_times(t)
    if rate is None:
        raise BadInput(f"{path}: time_s is not evenly spaced, expected a constant step")
    return rate
