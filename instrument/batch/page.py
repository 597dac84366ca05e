"""batch.html: laws overlaid, verdicts counted, failures listed, all rows in a table; nothing is fetched."""

from collections import Counter
from collections.abc import Mapping, Sequence
from importlib.metadata import version
from itertools import islice
from pathlib import Path, PurePath

from instrument.batch.between import Between
from instrument.batch.columns import Cell, cells
from instrument.batch.counted import Counted
from instrument.batch.figure import MOST, laws_figure
from instrument.batch.run import BatchRow, Rows
from instrument.facts.comparison import SpreadSize
from instrument.files.at_once import write_at_once
from instrument.report.blocks import Block, FactsBlock, FigureBlock, ReportSection, Sentence, TableBlock
from instrument.report.html import html_page
from instrument.results.numbers import with_error

HTML = "batch.html"
_ROWS_SHOWN = 2000
_AGAIN = "Remarks of several rows, which have their numbers below"
_ERRORS = {
    "storage_modulus_pa": "storage_modulus_standard_error_pa",
    "loss_factor": "loss_factor_standard_error",
}
_SHOWN: Sequence[tuple[str, str, float]] = (
    ("points", "points", 1),
    ("lowest_hz", "from / Hz", 1),
    ("highest_hz", "to / Hz", 1),
    ("temperature_c", "T / °C", 1),
    ("middle_hz", "at / Hz", 1),
    ("storage_modulus_pa", "G' / MPa", 1e-6),
    ("loss_factor", "η", 1),
    ("rms_percent", "rms / %", 1),
    ("held_out_rms_percent", "held out / %", 1),
    ("verdict", "verdict", 1),
    ("effects", "effects", 1),
    ("warnings", "remarks", 1),
)


def write_page(
    rows: Rows, counted: Counted, between: Sequence[Between], without: Sequence[str], folder: Path
) -> Path:
    """Write the page of a batch, `without` saying what has no spread; its path."""
    title = f"{counted.rows} rows"
    head = [
        ("done", f"{counted.done} of {counted.rows}"),
        (
            "verdicts",
            ", ".join(f"{count} {name}" for name, count in counted.verdicts.most_common()) or "none",
        ),
        ("program", f"viscorig {version('viscorig')}"),
    ]
    sections = [
        ReportSection("Laws", _laws(rows, counted)),
        ReportSection("Between rows", _between(between, without)),
        ReportSection("Verdicts", _verdicts(counted)),
        ReportSection("Failures", _failures(counted)),
        ReportSection("Rows", _rows(rows)),
    ]
    path = folder / HTML
    write_at_once(path, html_page(title, head, sections))
    return path


def _laws(rows: Rows, counted: Counted) -> tuple[Block, ...]:
    if not counted.done:
        return (Sentence("No row has a law.", "note"),)
    every = 1 + (counted.done - 1) // MOST
    some = "" if every == 1 else f" One in {every} of them is drawn."
    said = f"G' and η of {counted.done} rows over the bands measured, with 95 % bands.{some}"
    return (FigureBlock(laws_figure(rows, counted.done), said),)


def _between(between: Sequence[Between], without: Sequence[str]) -> tuple[Block, ...]:
    missed = tuple(Sentence(line, "note") for line in without)
    if not between:
        return missed
    shown = [
        (
            one.material or "",
            "" if one.temperature_c is None else f"{one.temperature_c:g}",
            str(one.rows),
            f"{at.frequency_hz:.4g}",
            f"{1e-6 * at.storage_modulus_pa:.4g}",
            _percent(at.storage_modulus_spread),
            f"{at.loss_factor:.4g}",
            _percent(at.loss_factor_spread),
        )
        for one in (b.result for b in between)
        for at in one.frequencies
    ]
    heads = (
        "material",
        "T / °C",
        "rows",
        "at / Hz",
        "G' / MPa",
        "spread / % (95 %)",
        "η",
        "spread / % (95 %)",
    )
    said = (
        "The common law of rows of one material and temperature, and the standard deviation of single rows "
        "about it, what is not known of each row taken off. A tolerance that all rows share is not in it."
    )
    apart = [Sentence(line, "note") for one in between if one.spread.apart for line in one.lines[1:]]
    return (Sentence(said), *apart, *missed, TableBlock("", heads, tuple(shown)))


def _percent(spread: SpreadSize) -> str:
    low, high = spread.interval_95_percent
    shown = (f"{value:.0f}" if value >= 10 else f"{value:.2g}" for value in (spread.percent, low, high))
    return "{} ({} to {})".format(*shown)


def _verdicts(counted: Counted) -> tuple[Block, ...]:
    blocks: list[Block] = [
        TableBlock(
            "", ("verdict", "rows"), tuple((name, str(n)) for name, n in counted.verdicts.most_common())
        )
    ]
    if counted.effects:
        found = tuple((name, str(n)) for name, n in counted.effects.most_common())
        blocks.append(TableBlock("Effects named", ("effect", "rows"), found))
    if counted.borrowed:
        said = f"{counted.borrowed} rows were worked out on the reduced model of a specimen like theirs."
        blocks.append(FactsBlock("", (("models", said),)))
    return tuple(blocks)


def _failures(counted: Counted) -> tuple[Block, ...]:
    if not counted.failures:
        return (Sentence("None."),)
    return (TableBlock("", ("data", "why"), tuple(counted.failures)),)


def _rows(rows: Rows) -> tuple[Block, ...]:
    shown = []
    some = list(islice(rows, _ROWS_SHOWN))
    names = short_names([row.task.data for row in some])
    again = _said_again(some)
    for row, name in zip(some, names, strict=True):
        found = cells(row)
        if row.outcome["failed"]:
            found["warnings"] = row.outcome["failed"]
        elif again:
            found["warnings"] = _with_numbers(row.outcome["warnings"], again)
        shown.append((name, *(_text(found, key, scale) for key, _, scale in _SHOWN)))
    heads = ("data", *(head for _, head, _ in _SHOWN))
    blocks: list[Block] = []
    if len(rows) > _ROWS_SHOWN:
        blocks.append(Sentence(f"The first {_ROWS_SHOWN}; batch.csv has all of them.", "note"))
    if again:
        said = tuple(
            (f"[{k}]", remark, str(count)) for k, (remark, count) in enumerate(again.items(), start=1)
        )
        blocks.append(TableBlock(_AGAIN, ("", "remark", "rows"), said))
    return (*blocks, TableBlock("", heads, tuple(shown), words=("effects", "remarks")))


def _said_again(rows: Sequence[BatchRow]) -> dict[str, int]:
    """Remarks that more than one row has, the most frequent first, and how many have them."""
    count = Counter(remark for row in rows if not row.outcome["failed"] for remark in row.outcome["warnings"])
    return {remark: n for remark, n in count.most_common() if n > 1}


def _with_numbers(remarks: Sequence[str], again: Mapping[str, int]) -> str:
    """A row's own in words, those of several by their numbers."""
    number = {remark: f"[{k}]" for k, remark in enumerate(again, start=1)}
    known = [number[remark] for remark in remarks if remark in number]
    return "; ".join([*([" ".join(known)] if known else []), *(r for r in remarks if r not in number)])


def _text(found: Mapping[str, Cell], key: str, scale: float) -> str:
    cell = found.get(key)
    if cell is None:
        return ""
    if not isinstance(cell, int | float):
        return cell
    error = found.get(_ERRORS.get(key, ""))
    return with_error(cell, error, scale) if isinstance(error, float) else f"{cell * scale:.4g}"


def short_names(paths: Sequence[str]) -> list[str]:
    """The end of each path, as much of it as tells it from the others: the table in CSV has them whole."""
    parts = [PurePath(path).parts for path in paths]
    for depth in range(1, max((len(p) for p in parts), default=1)):
        names = ["/".join(p[-depth:]) for p in parts]
        if len(set(names)) == len(set(paths)):
            return names
    return list(paths)
