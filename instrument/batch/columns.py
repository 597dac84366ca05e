"""The columns of batch.csv: what a row's outcome is as plain cells."""

from collections.abc import Iterable, Mapping
from typing import Any

from instrument.batch.run import BatchRow
from instrument.facts.doubts import doubts_in

Cell = str | float | int | bool | None
Marks = Mapping[int, Mapping[str, Cell]]
"""What a row is among the others, by its place: cells beside its own."""

_BEFORE = (
    "data",
    "specimen",
    "hammer",
    "temperature_c",
    "material",
    "status",
    "reason",
    "verdict",
    "effects",
    "points",
    "lowest_hz",
    "highest_hz",
    "converged",
    "rms_percent",
    "held_out_rms_percent",
    "chi2_per_dof",
    "middle_hz",
    "storage_modulus_pa",
    "storage_modulus_standard_error_pa",
    "loss_factor",
    "loss_factor_standard_error",
    "law_kind",
)
_AFTER = ("borrowed_model", "repeat_of", "apart_p_value", "warnings")
_LAW = _BEFORE[-5:-1]
DONE, FAILED = "done", "failed"
NOT_DIAGNOSED = "not diagnosed"


def is_doubted(row: BatchRow) -> bool:
    """Whether a law that nobody has diagnosed says of itself that it may be wrong."""
    o = row.outcome
    return not o["failed"] and o["verdict"] is None and bool(doubts_in(o))


def columns_of(rows: Iterable[BatchRow]) -> list[str]:
    """All there are; the parameters of every law that occurs, in the order in which they first do."""
    names: dict[str, None] = {}
    for row in rows:
        for name in row.outcome.get("parameters") or {}:
            names[name] = None
    parameters = [cell for name in names for cell in (name, error_name(name))]
    return [*_BEFORE, *parameters, *_AFTER]


def error_name(name: str) -> str:
    """g0_pa -> g0_standard_error_pa, alpha -> alpha_standard_error."""
    for unit in ("_pa", "_rad_s", "_s"):
        if name.endswith(unit):
            return f"{name.removesuffix(unit)}_standard_error{unit}"
    return f"{name}_standard_error"


def cells(row: BatchRow) -> dict[str, Cell]:
    """Of one row; columns that say nothing of it are left out."""
    task, o = row.task, row.outcome
    temperature = task.temperature_c if task.temperature_c is not None else o.get("temperature_c")
    found: dict[str, Cell] = {
        "data": task.data,
        "specimen": task.specimen,
        "hammer": task.hammer,
        "temperature_c": temperature,
        "material": task.material,
        "status": FAILED if o["failed"] else DONE,
        "reason": o["failed"],
    }
    if o["failed"]:
        return found
    found |= {key: o[key] for key in ("points", "lowest_hz", "highest_hz", "converged", "law_kind")}
    found |= {key: o[key] for key in ("rms_percent", "chi2_per_dof", "borrowed_model")}
    one_by_one = o["leave_one_out_rms_percent"]
    found["held_out_rms_percent"] = o["held_out_rms_percent"] if one_by_one is None else one_by_one
    found["verdict"] = o["verdict"] or NOT_DIAGNOSED
    found["effects"] = " ".join(o["effects"])
    found["warnings"] = "; ".join(o["warnings"])
    for name, value in o["parameters"].items():
        found[name] = value
        found[error_name(name)] = o["standard_errors"].get(name)
    return found | middle(o["law"], o["lowest_hz"], o["highest_hz"])


def middle(law: Mapping[str, Any], low_hz: float, high_hz: float) -> dict[str, Cell]:
    """G' and eta where the law is listed nearest to the middle of its band, on a logarithmic scale."""
    f = law.get("frequency_hz") or []
    if not f:
        return {}
    k = min(range(len(f)), key=lambda i: abs(f[i] / (low_hz * high_hz) ** 0.5 - 1))
    return {"middle_hz": f[k], **{key: law[key][k] for key in _LAW}}
