"""The session's specimen as a SPECIMEN.toml that reads velocity as the session's rig did."""

import json
from typing import Any

from instrument.impact.mobility import DELAY_S, GAIN
from instrument.interchange.provenance import provenance
from instrument.session.contents import Contents
from instrument.stream.derived import StruckFound


def specimen_toml(contents: Contents) -> str:
    """The text of a specimen file as the session has it. `[pickup] reads` is the rig's."""
    tables = _tables_of(contents)
    if "pickup" in tables:
        tables["pickup"]["reads"] = contents.configuration.rig.vibrometer.reads
    further = tables.pop("further_pickups", [])
    if further:
        tables["pickup"] = [tables["pickup"], *further]
    return _text(contents, tables)


def struck_specimen_toml(contents: Contents, struck: StruckFound) -> str:
    """SPECIMEN.toml of the plate as it was struck: its force, its spot, how well the force is known."""
    tables = _tables_of(contents)
    for gone in ("base", "further_pickups"):
        tables.pop(gone, None)
    if struck.held == "free":
        gripped = struck.size_mm[0] - tables["plate"]["length_mm"]
        tables["plate"] |= {"length_mm": struck.size_mm[0], "boundary": "free"}
        tables.pop("damping", None)
        for mass in tables.get("mass", []):
            mass["x_mm"] += gripped
    if struck.spot_mm is not None:
        tables["pickup"] = dict(zip(("x_mm", "y_mm"), struck.spot_mm, strict=True))
    tables["excitation"] = {"kind": "force", "x_mm": struck.struck_mm[0], "y_mm": struck.struck_mm[1]}
    known = {"gain_percent": 100 * GAIN, "delay_us": 1e6 * DELAY_S}
    tables["tolerances"] = tables.get("tolerances", {}) | known
    return _text(contents, tables)


def _tables_of(contents: Contents) -> dict[str, Any]:
    found: dict[str, Any] = contents.configuration.specimen.model_dump(exclude_none=True)
    return found


def _text(contents: Contents, tables: dict[str, Any]) -> str:
    head = "".join(f"# {line}\n" for line in provenance(contents))
    return head + "".join(_tables(name, table) for name, table in tables.items())


def _tables(name: str, given: dict[str, Any] | list[dict[str, Any]]) -> str:
    """One, or each of a list."""
    if isinstance(given, dict):
        return _table(name, given)
    return "".join(_table(name, table).replace(f"[{name}]", f"[[{name}]]", 1) for table in given)


def _table(name: str, table: dict[str, Any]) -> str:
    keys = [f"{key} = {_value(v)}\n" for key, v in table.items() if not isinstance(v, dict)]
    inner = [_table(f"{name}.{key}", v) for key, v in table.items() if isinstance(v, dict)]
    return "".join([f"\n[{name}]\n", *keys, *inner])


def _value(value: object) -> str:
    """Numbers, strings and lists of them: TOML writes these as JSON does."""
    return json.dumps(value, ensure_ascii=True, allow_nan=False)
