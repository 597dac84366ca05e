"""A session as CSV: sweep, hits, the treated plate struck, and what `viscorig identify` needs beside them."""

import csv
import io
import json
import re
from pathlib import Path

import numpy as np

from instrument.files.at_once import write_at_once
from instrument.files.replaceable import JSON, Written, refuse_another_text, refuse_to_lose
from instrument.interchange.identified import session_modes
from instrument.interchange.point_table import PointColumn, columns
from instrument.interchange.provenance import one_line, provenance, reading
from instrument.interchange.specimen_toml import specimen_toml, struck_specimen_toml
from instrument.results.session_result import recorded_result
from instrument.session.contents import Contents, RecordedHit
from instrument.stream.derived import StruckFound

_EXPORTED = Written(re.compile(rb"# session [^\n]* exported from "))
"""As `provenance` begins every table."""


def export_csv(contents: Contents, folder: Path) -> list[Path]:
    """Sweep, hits, their damping, the law to sign, the specimen as read here: what there is."""
    name, texts = contents.configuration.name, dict[str, str]()
    if contents.points:
        texts[f"{name}.csv"] = sweep_text(contents)
    for hit in contents.hits:
        verdict = "" if hit.accepted else "-rejected"
        texts[f"{name}-hit-{hit.number:02d}{verdict}.csv"] = hit_text(contents, hit)
    if contents.damping is not None:
        texts[f"{name}-damping.json"] = json.dumps(contents.damping.result.as_json(), indent=1) + "\n"
    result = recorded_result(contents)
    if result.law:
        texts[f"{name}-result.json"] = json.dumps(result.as_json(), indent=1) + "\n"
    for k, struck in enumerate(contents.struck, start=1):
        texts[f"{name}-struck-{k}.csv"] = struck_text(contents, struck, f"{name}-struck-{k}-specimen.toml")
        texts[f"{name}-struck-{k}-specimen.toml"] = struck_specimen_toml(contents, struck)
    texts[f"{name}-specimen.toml"] = specimen_toml(contents)
    for file, text in texts.items():
        _refuse_to_lose(folder / file, text)
    for file, text in texts.items():
        write_at_once(folder / file, text)
    return [folder / file for file in texts]


def _refuse_to_lose(path: Path, text: str) -> None:
    """A specimen may have been edited since: only the very same one is written again. Raises `BadInput`."""
    if path.suffix == ".toml":
        refuse_another_text(path, text)
    else:
        refuse_to_lose(path, JSON if path.suffix == ".json" else _EXPORTED)


def sweep_text(contents: Contents) -> str:
    """The text of a sweep's CSV file. Floats are written so that they come back to the bit."""
    reference, table = contents.specimen.base_acceleration_m_s2, columns(contents)
    said = [
        *provenance(contents),
        *reading(contents),
        f"level_g times [base] acceleration_m_s2 = {reference!r} is the commanded level",
        "velocity_std_m_s is of each part of the phasor, the base channel's noise carried over",
        one_line(f"viscorig identify {_read_back(contents)}"),
    ]
    return "".join(f"# {line}\n" for line in said) + _rows(table)


def hit_text(contents: Contents, hit: RecordedHit) -> str:
    """One hit as it was caught, in N and m/s^2, nothing set right."""
    record = hit.record
    verdict = "accepted" if hit.accepted else f"not accepted: {hit.why or 'rejected by the operator'}"
    said = [
        *provenance(contents),
        f"hit {hit.number}, {verdict}",
        f"sample_rate_hz: {record.sample_rate_hz!r}",
    ]
    table = [
        PointColumn("force_n", "N", record.force_n),
        PointColumn("acceleration_m_s2", "m/s^2", record.responses[0].samples),
    ]
    return "".join(f"# {line}\n" for line in said) + _rows(table)


def struck_text(contents: Contents, struck: StruckFound, specimen: str) -> str:
    """The mobility of the treated plate as a sweep of its own: every line the velocity for 1 N."""
    lines = len(struck.frequency_hz)
    held = "hung free" if struck.held == "free" else "in its clamp"
    said = [
        *provenance(contents),
        f"the damped plate struck, {held}: {struck.hits} hits averaged",
        *struck.remarks,
        "velocity_std_m_s is of each part of the mean",
        f"its specimen: {specimen}",
    ]
    columns = {
        "frequency_hz": ("Hz", struck.frequency_hz),
        "velocity_re_m_s": ("m/s", struck.mobility_re_m_s_n),
        "velocity_im_m_s": ("m/s", struck.mobility_im_m_s_n),
        "velocity_std_m_s": ("m/s", struck.mobility_std_m_s_n),
        "force_re_n": ("N", (1.0,) * lines),
        "force_im_n": ("N", (0.0,) * lines),
        "segment": ("1", struck.segment),
    }
    table = [PointColumn(key, unit, np.array(values)) for key, (unit, values) in columns.items()]
    return "".join(f"# {one_line(line)}\n" for line in said) + _rows(table)


def _read_back(contents: Contents) -> str:
    """The arguments that give the session's own result again."""
    name = contents.configuration.name
    hammer = f" --hammer {name}-damping.json" if session_modes(contents) is not None else ""
    return f"{name}.csv --specimen {name}-specimen.toml{hammer}"


def _rows(table: list[PointColumn]) -> str:
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow([c.name for c in table])
    writer.writerows(zip(*([_cell(v) for v in c.values] for c in table), strict=True))
    return text.getvalue()


def _cell(value: object) -> str:
    if isinstance(value, np.generic):
        value = value.item()
    return "" if value is None or value != value else str(value)
