"""The result of `viscorig card`, and its card of the format `json`."""

from instrument.facts.number import MaybeNumber, Number
from instrument.facts.result import Result
from instrument.facts.rows import LawRow


class PronyTerm(Result):
    """One Maxwell element."""

    g_pa: Number
    share: Number
    """Share of the instantaneous modulus."""
    tau_s: Number


class PronySeries(Result):
    """A generalised Maxwell solid that stands for the law over its band."""

    g_inf_pa: Number
    """Long-time modulus."""
    g_0_pa: Number
    """Instantaneous modulus."""
    terms: tuple[PronyTerm, ...]
    max_error_percent: Number
    """Of G*, over the band."""
    rms_error_percent: Number
    words: str | None = None
    """How well it stands for the law, and what is left at rest; None in files of older versions."""


class CardResult(Result):
    """A law as a simulation program's material card has it."""

    header: tuple[str, ...]
    """The lines it begins with, without the format's comment sign."""
    source: str
    """Name of the file the law comes from."""
    specimen: str
    verdict: str
    """Of the diagnosis, or that there was none."""
    band_hz: tuple[Number, Number]
    """Outside it the law is not to be used."""
    temperature_c: MaybeNumber
    """None where it was not measured."""
    poisson: Number
    poisson_is_assumed: bool
    law_kind: str
    parameters: dict[str, Number]
    """In SI units, which the keys end with."""
    standard_errors: dict[str, Number]
    law: tuple[LawRow, ...]
    prony: PronySeries
    card: str | None = None
    """Path of the file that was written; not in a card itself."""
