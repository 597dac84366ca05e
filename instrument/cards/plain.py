"""Tables for everything else: CSV, and JSON with the law, its table and its series."""

import json
from math import nan

from instrument.cards.card import Card
from instrument.facts.card import CardResult, PronySeries, PronyTerm
from instrument.facts.rows import LawRow
from instrument.files.dma_file import REDUCED

_KEYS = (
    "frequency_hz",
    "storage_modulus_pa",
    "loss_factor",
    "storage_modulus_standard_error_pa",
    "loss_factor_standard_error",
)


def as_csv(card: Card) -> str:
    """G' and eta with standard errors; nothing where there is none.

    Of a law over temperatures the frequencies are named as the reduced ones that they are.
    """
    names = [REDUCED if key == _KEYS[0] and card.law.shift is not None else key for key in _KEYS]
    columns = [getattr(card.law, key).tolist() for key in _KEYS]
    rows = [",".join("" if v != v else repr(v) for v in row) for row in zip(*columns, strict=True)]
    return "\n".join([*(f"# {line}" for line in card.header()), ",".join(names), *rows, ""])


def card_result(card: Card) -> CardResult:
    """All of a card, typed."""
    law, p = card.law, card.prony
    rows = zip(*(getattr(law, key).tolist() for key in _KEYS), strict=True)
    terms = zip(p.g_pa.tolist(), p.shares.tolist(), p.tau_s.tolist(), strict=True)
    return CardResult(
        header=tuple(card.header()),
        source=law.source,
        specimen=law.specimen,
        verdict=law.verdict,
        band_hz=law.band_hz,
        temperature_c=law.temperature_c,
        poisson=card.poisson,
        poisson_is_assumed=card.poisson_is_assumed,
        law_kind=law.kind,
        parameters=law.parameters,
        standard_errors={key: nan if error is None else error for key, error in law.standard_errors.items()},
        law=tuple(LawRow(**dict(zip(_KEYS, row, strict=True))) for row in rows),
        prony=PronySeries(
            g_inf_pa=p.g_inf_pa,
            g_0_pa=p.g_0_pa,
            terms=tuple(PronyTerm(g_pa=G, share=share, tau_s=tau) for G, share, tau in terms),
            max_error_percent=100 * p.max_error,
            rms_error_percent=100 * p.rms_error,
            words=card.about_series(),
        ),
    )


def as_json(card: Card) -> str:
    """The card's result as JSON text."""
    return json.dumps(card_result(card).as_json(), indent=1, allow_nan=False) + "\n"
