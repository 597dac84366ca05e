"""The session's specimen as a SPECIMEN.toml that reads velocity as the session's rig did."""

import json
from typing import Any

from instrument.interchange.provenance import provenance
from instrument.session.contents import Contents


def specimen_toml(contents: Contents) -> str:
    """The file's text. `[pickup] reads` is the rig's."""
    tables: dict[str, Any] = contents.configuration.specimen.model_dump(exclude_none=True)
    if "pickup" in tables:
        tables["pickup"]["reads"] = contents.configuration.rig.vibrometer.reads
    head = "".join(f"# {line}\n" for line in provenance(contents))
    further = tables.pop("further_pickups", [])
    if further:
        tables["pickup"] = [tables["pickup"], *further]
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
