"""Impact records and FRFs of any kind, by the file's ending; what a file does not say, options do."""

import shlex
from collections.abc import Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np

from fitting.arrays import Array
from fitting.modal.frf import Frf
from instrument.errors import BadInput
from instrument.files.file_kind import refuse_another
from instrument.files.guard import checked_frf, checked_hits, said_of
from instrument.files.impact_csv import MOTIONS, read_impact_csv
from instrument.files.lvm import read_lvm
from instrument.files.mat import read_mat_variables
from instrument.files.table import rate_of_times
from instrument.files.text import refuse_workbook
from instrument.files.uff58 import FRF, TIME, Function, read_uff58
from instrument.files.units import KNOWN_MOTIONS, unit_of
from instrument.impact.record import Hit, ResponseChannel


@dataclass(frozen=True)
class Named:
    """Channels named on the command line, where the file does not say which is which."""

    force: str | None = None
    responses: tuple[str, ...] = ()
    """NAME or NAME:UNIT."""
    rate_hz: float | None = None


def read_records(path: Path, named: Named) -> list[Hit] | dict[str, Frf]:
    """Hits, or FRFs. Raises `BadInput` with one line."""
    with said_of(path):
        found = _read(path, named)
        if isinstance(found, dict):
            return {name: checked_frf(path, name, frf) for name, frf in found.items()}
        return checked_hits(path, found)


def _read(path: Path, named: Named) -> list[Hit] | dict[str, Frf]:
    ending = path.suffix.lower()
    refuse_another(path, ("a table", "a session"), "impact records or an FRF")
    if not path.is_file():
        raise BadInput(f"{path}: no such file")
    if ending == ".csv" and (named.force or named.responses):
        raise BadInput(f"{path}: the columns of a CSV say what they are; --force and --response do not apply")
    if ending == ".csv":
        return read_impact_csv(path, named.rate_hz)
    if ending in (".uff", ".unv"):
        return _universal(path)
    if ending == ".lvm":
        return [
            _hit(
                path,
                k,
                s.names,
                dict(zip(s.names, s.units, strict=True)),
                s.samples.T,
                s.sample_rate_hz,
                named,
            )
            for k, s in enumerate(read_lvm(path), start=1)
        ]
    if ending == ".mat":
        return [_mat(path, named)]
    refuse_workbook(path)
    if ending in (".h5", ".hdf5"):
        export = shlex.join(["viscorig", "export", str(path), "--to", "csv"])
        raise BadInput(
            f"{path}: a session, expected impact records: {export} writes its hits; 'viscorig identify' "
            "takes the session itself, with --hammer too"
        )
    raise BadInput(f"{path}: unknown ending {ending!r}, expected .csv, .lvm, .uff, .unv or .mat")


def _hit(
    path: Path,
    k: int,
    names: tuple[str, ...],
    units: dict[str, str],
    samples: Array,
    rate: float,
    named: Named,
) -> Hit:
    columns = dict(zip(names, samples, strict=True))
    force = named.force or next((n for n in names if n.lower() in ("f", "force", "hammer")), None)
    if force is None or force not in columns:
        raise BadInput(f"{path}: which channel is the force? found {', '.join(names)}, say --force NAME")
    wanted = named.responses or tuple(n for n in names if n != force and n)
    channels = tuple(_channel(path, columns, units, w) for w in wanted)
    if not channels:
        raise BadInput(f"{path}: no response beside {force}, say --response NAME:UNIT")
    return Hit(f"{path.name} hit {k}", named.rate_hz or rate, columns[force], channels)


def _channel(path: Path, columns: dict[str, Array], units: dict[str, str], wanted: str) -> ResponseChannel:
    name, _, unit = wanted.partition(":")
    if name not in columns:
        raise BadInput(f"{path}: no channel {name}, found {', '.join(columns)}")
    unit = unit or units.get(name, "")
    known = unit_of(unit)
    if known is None or known.per is not None or known.quantity == "force":
        raise BadInput(
            f"{path}: channel {name} has unit {unit or 'missing'!r}, say --response {name}:UNIT "
            f"with one of {KNOWN_MOTIONS}"
        )
    return ResponseChannel(name, known.quantity, columns[name] * known.factor)


def _universal(path: Path) -> list[Hit] | dict[str, Frf]:
    """The FRFs of a file where it holds any, else its time records in order: a force, then its responses."""
    functions = read_uff58(path, over="force").functions
    frfs = {f"{f.label or 'frf'} {k}": _frf(path, f) for k, f in enumerate(functions, 1) if f.kind == FRF}
    if frfs:
        return frfs
    hits: list[Hit] = []
    for f in (f for f in functions if f.kind == TIME):
        if f.unit.quantity == "force":
            hits.append(Hit(f"{path.name} hit {len(hits) + 1}", f.rate_hz, f.values, ()))
        elif hits:
            last = hits[-1]
            channel = ResponseChannel(
                f.label or f"response {len(last.responses) + 1}", f.unit.quantity, f.values
            )
            hits[-1] = replace(last, responses=(*last.responses, channel))
    if not hits or not all(h.responses for h in hits):
        raise BadInput(f"{path}: no force with a response behind it, and no FRF (data set 58)")
    return hits


def _frf(path: Path, f: Function) -> Frf:
    if f.unit.per != "force":
        raise BadInput(
            f"{path}: FRF over {f.unit.per}, expected over a force: "
            "'viscorig import' takes a response over a base motion"
        )
    if f.unit.quantity == "force":
        raise BadInput(f"{path}: FRF of a force, expected displacement, velocity or acceleration")
    return Frf(f.x, f.values, f.unit.quantity)


def _no_vectors(content: Mapping[str, Any]) -> str:
    """What there is in their place."""
    shapes = [
        f"{name} {' x '.join(map(str, v.shape))}" for name, v in content.items() if isinstance(v, np.ndarray)
    ]
    return f"found no vector but {', '.join(shapes) or 'nothing'}, expected a vector a channel, a file a hit"


def _mat(path: Path, named: Named) -> Hit:
    """MATLAB 5 to 7.2: numeric vectors only. Names carry the unit (`acceleration_m_s2`) or the options do."""
    content = read_mat_variables(path)
    vectors = {
        name: np.asarray(v, float)
        for name, v in content.items()
        if isinstance(v, np.ndarray) and v.ndim == 1 and v.dtype.kind in "fiu"
    }
    rate = named.rate_hz or _mat_rate(path, content, vectors)
    if rate is None:
        raise BadInput(
            f"{path}: no sample rate, expected sample_rate_hz or time_s among its variables, or --rate"
        )
    force = named.force or ("force_n" if "force_n" in vectors else None)
    if force is None or force not in vectors:
        found = f"found {', '.join(vectors)}, say --force NAME" if vectors else _no_vectors(content)
        raise BadInput(f"{path}: which variable is the force? {found}")
    lengths = {n: v for n, v in vectors.items() if len(v) == len(vectors[force])}
    units = {n: u for n in lengths for u in [_unit_in_name(n)] if u}
    named_here = Named(force, named.responses or tuple(n for n in units if n != force), rate)
    return _hit(path, 1, tuple(lengths), units, np.array(list(lengths.values())), rate, named_here)


def _mat_rate(path: Path, content: dict[str, Any], vectors: dict[str, Array]) -> float | None:
    if "sample_rate_hz" in content and np.ndim(content["sample_rate_hz"]) == 0:
        return float(content["sample_rate_hz"])
    if "time_s" in vectors and len(vectors["time_s"]) > 1:
        rate = rate_of_times(vectors["time_s"])
        if rate is None:
            raise BadInput(f"{path}: time_s is not evenly spaced, expected a constant step")
        return rate
    return None


def _unit_in_name(name: str) -> str:
    units = {"acceleration": "m/s^2", "velocity": "m/s", "displacement": "m"}
    return units[MOTIONS[name]] if name in MOTIONS else ""
