"""Tables for everything else: CSV, and JSON with the law, its table and its series."""

import json
from typing import Any

from instrument.cards.card import Card
from instrument.stream.jsonable import to_jsonable

_KEYS = (
    "frequency_hz",
    "storage_modulus_pa",
    "loss_factor",
    "storage_modulus_standard_error_pa",
    "loss_factor_standard_error",
)


def as_csv(card: Card) -> str:
    """G' and eta with standard errors; nothing where there is none."""
    columns = [getattr(card.law, key).tolist() for key in _KEYS]
    rows = [",".join("" if v != v else repr(v) for v in row) for row in zip(*columns, strict=True)]
    return "\n".join([*(f"# {line}" for line in card.header()), ",".join(_KEYS), *rows, ""])


def card_facts(card: Card) -> dict[str, Any]:
    """All of a card as JSON has it."""
    law, p = card.law, card.prony
    rows = zip(*(getattr(law, key).tolist() for key in _KEYS), strict=True)
    found: dict[str, Any] = to_jsonable(
        {
            "header": card.header(),
            "source": law.source,
            "specimen": law.specimen,
            "verdict": law.verdict,
            "band_hz": law.band_hz,
            "temperature_c": law.temperature_c,
            "poisson": card.poisson,
            "poisson_is_assumed": card.poisson_is_assumed,
            "law_kind": law.kind,
            "parameters": law.parameters,
            "standard_errors": law.standard_errors,
            "law": [dict(zip(_KEYS, row, strict=True)) for row in rows],
            "prony": {
                "g_inf_pa": p.g_inf_pa,
                "g_0_pa": p.g_0_pa,
                "terms": [
                    {"g_pa": G, "share": share, "tau_s": tau}
                    for G, share, tau in zip(p.g_pa, p.shares, p.tau_s, strict=True)
                ],
                "max_error_percent": 100 * p.max_error,
                "rms_error_percent": 100 * p.rms_error,
            },
        }
    )
    return found


def as_json(card: Card) -> str:
    """The same as text."""
    return json.dumps(card_facts(card), indent=1, allow_nan=False) + "\n"
