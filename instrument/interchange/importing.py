"""Foreign data to this program's CSV files: sweeps, FRFs, impact records."""

import re
from collections import Counter
from collections.abc import Callable, Collection
from dataclasses import dataclass
from filecmp import cmp
from pathlib import Path
from typing import Any

import numpy as np

from fitting.sweep import segments_by_gap
from instrument.errors import BadInput, system_words
from instrument.files.at_once import write_at_once
from instrument.files.impact_csv import write_frf_csv, write_impact_csv
from instrument.files.modal_table import read_modal_rows
from instrument.files.point_columns import understood
from instrument.files.replaceable import Written, refuse_to_lose
from instrument.files.sweep_file import read_sweep, sweep_of_columns
from instrument.impact.record import Hit
from instrument.interchange.found import Columns, Found, Modes
from instrument.interchange.naming import Naming
from instrument.interchange.provenance import one_line
from instrument.interchange.readers import read_foreign

_READ_BY: dict[str, Callable[[Path], object]] = {"sweep": read_sweep, "modes": read_modal_rows}
"""What reads a kind of file, where that is more than a table of numbers."""
_FIRST = "# imported from "
_IMPORTED = Written(re.compile(_FIRST.encode()))
"""How every file begins that was written here."""


@dataclass(frozen=True)
class Imported:
    """Files written, and what was found in the foreign one."""

    files: tuple[Path, ...]
    said: tuple[str, ...]


def import_file(path: Path, out: Path | None, naming: Naming | None = None) -> Imported:
    """Read a foreign file and write what it holds. Raises `BadInput` where there is nothing of use in it.

    `naming` has names in the place of the file's own.

    One kind of thing goes to `out` itself; several get its name with `-sweep`, `-frf`, `-hits` or `-modes`
    behind it. Another file is not written over; what was imported before is, where `out` names it.
    """
    found = read_foreign(path, naming)
    if found.sweeps:
        # Said by its own rows: nobody has seen those that would be written.
        table = one_table(found.sweeps)
        sweep_of_columns(path, table, lines=found.lines_of(len(table["frequency_hz"])))
    target = out if out is not None else _default_name(path)
    if target.suffix.lower() != ".csv":
        raise BadInput(f"{target}: ending {target.suffix!r}, expected .csv")
    kinds: dict[str, list[Any]] = {
        "sweep": [_sweep_text(found)] if found.sweeps else [],
        "frf": found.frfs,
        "hits": _alike(found.hits),
        "modes": [_modes_text(one) for one in found.modes],
    }
    plan = _names(target, {kind: len(items) for kind, items in kinds.items()})
    if any(p.exists() and p.samefile(path) for p in plan.values()):
        raise BadInput(f"{path}: would be written over, expected another --out")
    for file in plan.values() if out is not None else ():
        refuse_to_lose(file, _IMPORTED)
    unproven = {key: file.with_name(f".{file.name}.part") for key, file in plan.items()}
    try:
        for (kind, k), file in unproven.items():
            _write(file, kind, kinds[kind][k])
            _say_where_from(file, path, kinds[kind][k][0] if kind == "frf" else "")
        # What was written has to be what the program reads.
        for (kind, k), file in unproven.items():
            if kind in _READ_BY:
                _prove(_READ_BY[kind], file, plan[kind, k])
        if out is None:
            _refuse_others(unproven, plan)
        for key, file in unproven.items():
            file.replace(plan[key])
    except OSError as error:
        raise BadInput(f"{target}: {system_words(error)}") from None
    finally:
        for file in unproven.values():
            file.unlink(missing_ok=True)
    if found.sweeps:
        found.said.append(
            f"velocity is {found.reads} as it says itself: [pickup] reads in the specimen has to say so too"
            if found.reads
            else "relative to the clamp or absolute velocity? [pickup] reads in the specimen says it"
        )
    return Imported(tuple(plan.values()), tuple(map(one_line, found.said)))


def _default_name(path: Path) -> Path:
    """In the current folder; another than the file's own, which stands there where it is a CSV."""
    own = Path(f"{path.stem}.csv")
    return Path(f"{path.stem}-imported.csv") if own.exists() and own.samefile(path) else own


def _refuse_others(written: dict[tuple[str, int], Path], plan: dict[tuple[str, int], Path]) -> None:
    """Raise `BadInput` where a file of another content stands in a place that nobody named."""
    for key, file in plan.items():
        if file.exists() and not cmp(file, written[key], shallow=False):
            raise BadInput(
                f"{file}: there is a file already, expected --out: another, or this one if imported"
            )


def _prove(read: Callable[[Path], object], written: Path, named: Path) -> None:
    """Raises `BadInput`, which names the file as it would have been."""
    try:
        read(written)
    except BadInput as error:
        raise BadInput(str(error).replace(str(written), str(named))) from None


def _names(target: Path, counts: dict[str, int]) -> dict[tuple[str, int], Path]:
    """A file for each thing found."""
    several = sum(counts.values()) > 1
    kinds = sum(count > 0 for count in counts.values())
    names = {}
    for kind, count in counts.items():
        for k in range(count):
            tail = (f"-{kind}" if kinds > 1 else "") + (f"-{k + 1}" if count > 1 else "")
            names[kind, k] = target.with_name(target.stem + tail + ".csv") if several else target
    return names


def _write(file: Path, kind: str, item: object) -> None:
    if isinstance(item, str):
        write_at_once(file, item)
    elif isinstance(item, list):
        write_impact_csv(file, item)
    elif isinstance(item, tuple):
        write_frf_csv(file, item[1], item[2])


def _say_where_from(file: Path, source: Path, what: str) -> None:
    """`what` of the source it is, where that has several."""
    said = one_line(f"{source.name}: {what}" if what else source.name)
    write_at_once(file, f"{_FIRST}{said}\n" + file.read_text(encoding="utf-8"))


def _alike(hits: list[Hit]) -> list[list[Hit]]:
    """Hits of one rate, length and kind share a file; a second response of a kind gets its own file."""
    groups: dict[tuple[object, ...], list[Hit]] = {}
    for hit in hits:
        for n, channels in enumerate(_layers(hit)):
            one = Hit(hit.source, hit.sample_rate_hz, hit.force_n, channels)
            key = n, hit.sample_rate_hz, len(hit.force_n), tuple(c.name for c in channels)
            groups.setdefault(key, []).append(one)
    return list(groups.values())


def _layers(hit: Hit) -> list[tuple]:  # type: ignore[type-arg]
    """Responses so that no name occurs twice."""
    layers: list[dict[str, object]] = []
    for channel in hit.responses:
        free = next((layer for layer in layers if channel.name not in layer), None)
        if free is None:
            layers.append(free := {})
        free[channel.name] = channel
    return [tuple(layer.values()) for layer in layers]


def one_table(sweeps: list[Columns]) -> Columns:
    """All sweeps of a file in one; overlapping ones that say nothing are passes of their own.

    Raises `BadInput` where they are of different kinds.
    """
    sweeps = _told_apart(sweeps)
    unsaid = {column.name: column.unsaid for column in understood() if column.unsaid is not None}
    names = list(dict.fromkeys(name for s in sweeps for name in s))
    missing = [n for n in names if n not in unsaid and not all(n in s for s in sweeps)]
    if missing:
        raise BadInput(
            f"its sweeps differ in {', '.join(missing)}: expected all of one kind, import them apart"
        )
    return {
        n: np.concatenate([s.get(n, np.full(len(s["frequency_hz"]), unsaid.get(n, 0.0))) for s in sweeps])
        for n in names
    }


def _sweep_text(found: Found) -> str:
    table = one_table(found.sweeps)
    said = f"# velocity is {found.reads}\n" if found.reads else ""
    return said + _rows_text(table, {column.name for column in understood() if column.whole})


def _rows_text(table: Columns, whole: Collection[str]) -> str:
    rows = (
        ",".join(_cell(float(v), whole=n in whole) for n, v in zip(table, row, strict=True))
        for row in zip(*table.values(), strict=True)
    )
    return "\n".join([",".join(table), *rows]) + "\n"


def _modes_text(modes: Modes) -> str:
    said = f"# read: {modes.read}\n" if modes.read is not None else ""
    return said + _rows_text(modes.columns, {"mode"})


def _cell(value: float, *, whole: bool) -> str:
    """Empty for what is not known."""
    if value != value:
        return ""
    return f"{value:.0f}" if whole else repr(value)


def _told_apart(sweeps: list[Columns]) -> list[Columns]:
    """Passes of each spot numbered; as they are where a file numbers them or has but one."""
    if len(sweeps) == 1 or any("sweep" in s for s in sweeps):
        return sweeps
    passes: Counter[float] = Counter()
    told = []
    for s in sweeps:
        spot = float(s["pickup"][0]) if "pickup" in s else 0.0
        passes[spot] += 1
        numbered = {
            "sweep": np.full(len(s["frequency_hz"]), float(passes[spot])),
            "segment": segments_by_gap(s["frequency_hz"]).astype(float),
        }
        told.append(s | numbered)
    return told
