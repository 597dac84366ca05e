"""Candidates as rows: how they stand, which of them cannot be told apart. No Qt."""

from dataclasses import dataclass
from inspect import getdoc, getmodule
from typing import Literal

from fitting.diagnosis.verdict.kin import UNLISTED
from fitting.digits import times
from fitting.effects import CATALOGUE
from gui.actions.rediagnosis import effects_of
from instrument.facts.diagnosis import DiagnosisResult
from instrument.results.diagnosis_words import log_odds, parameter_words, probability_words
from instrument.results.standing import Standing, standing
from instrument.results.typeset import typeset

RowStanding = Standing | Literal["not fitted"]
WORDS: dict[RowStanding, str] = {
    "found": "found",
    "equal": "not told apart",
    "none": "no effect",
    "other": "",
    "not fitted": "not fitted",
}


@dataclass(frozen=True)
class CandidateRow:
    """A candidate."""

    name: str
    standing: RowStanding
    gain: float | None = None
    """Ln odds over the fit without any effect."""
    probability: str = "–"
    """One of all that were tried being right, in words."""
    chi2_per_dof: float | None = None
    parameters: tuple[str, ...] = ()

    @property
    def gain_words(self) -> str:
        """The meaning of the row's bar in words."""
        if self.gain is None:
            return "not among the candidates of this search"
        if self.gain < 0:
            return f"no effect is {times(-self.gain)} as likely as this"
        return f"{times(self.gain)} as likely as no effect"


def ranked(found: DiagnosisResult) -> list[CandidateRow]:
    """Likeliest first; then what the catalogue holds beside them, so that it can be accepted too."""
    gains = dict(zip((c.name for c in found.candidates), log_odds(found), strict=True))
    rows = [
        CandidateRow(
            c.name,
            standing(c.name, found),
            gains[c.name],
            probability_words(c, found).replace("-", "–"),
            c.chi2_per_dof,
            tuple(typeset(parameter_words(key, p)) for key, p in c.parameters.items()),
        )
        for c in found.likeliest_first
    ]
    single = {row.name for row in rows}
    return rows + [CandidateRow(name, "not fitted") for name in sorted(CATALOGUE) if name not in single]


def group_words(found: DiagnosisResult) -> str:
    """Which effects these data cannot tell apart; empty where there are none."""
    groups = [group for group in found.equivalent.values() if len(group) > 1]
    return "\n".join(f"One group, not to be told apart by these data: {', '.join(g)}." for g in groups)


def about(name: str) -> str:
    """What an effect is, and what would show it by itself."""
    if name == "none":
        return "The specimen as stated with its best law, no effect added."
    if name == UNLISTED:
        return (
            "Something in no catalogue that does almost what the likeliest effects do. It has no formula: it "
            "can neither be accepted nor declined."
        )
    return "\n\n".join(_about_one(one) for one in effects_of([name]) if one in CATALOGUE)


def _about_one(name: str) -> str:
    effect = CATALOGUE[name]
    module = getmodule(type(effect))
    what = (getdoc(module) or "").splitlines()[0] if module is not None else ""
    shown = f"\nShown apart by: {effect.discriminating_test}." if effect.discriminating_test else ""
    return f"{name}: {what}\nEnters: {effect.enters}. After {effect.source}.{shown}"


class Decisions:
    """What a person accepts and declines, by the names of effects."""

    def __init__(self) -> None:
        self.accepted: tuple[str, ...] = ()
        self.declined: tuple[str, ...] = ()
        self.nothing = False
        """Every effect is declined."""

    def accept(self, name: str) -> None:
        """A candidate, `none` among them; again to take it back."""
        if name == UNLISTED:
            return
        if name == "none":
            again = not self.nothing
            self.clear()
            self.nothing = again
            return
        one = effects_of([name])
        self.nothing = False
        self.declined = tuple(n for n in self.declined if n not in one)
        if set(one) <= set(self.accepted):
            self.accepted = tuple(n for n in self.accepted if n not in one)
        else:
            self.accepted = tuple(dict.fromkeys((*self.accepted, *one)))

    def decline(self, name: str) -> None:
        """Leave it out of the search; again to take it back."""
        if name == UNLISTED:
            return
        one = effects_of([name])
        self.nothing = False
        self.accepted = tuple(n for n in self.accepted if n not in one)
        if set(one) <= set(self.declined):
            self.declined = tuple(n for n in self.declined if n not in one)
        else:
            self.declined = tuple(dict.fromkeys((*self.declined, *one)))

    def clear(self) -> None:
        """Nothing is decided."""
        self.accepted = self.declined = ()
        self.nothing = False

    @property
    def any(self) -> bool:
        """Whether there is something to compute."""
        return bool(self.accepted or self.declined or self.nothing)

    @property
    def accept_argument(self) -> tuple[str, ...] | None:
        """None where the catalogue is to be searched."""
        return self.accepted if self.accepted or self.nothing else None

    @property
    def words(self) -> str:
        """What is computed when a person asks for it, in words."""
        if self.nothing:
            return "fit without any effect"
        if self.accepted:
            return f"fit with {' and '.join(self.accepted)}"
        if self.declined:
            along = {e.extends for e in CATALOGUE.values()} & set(self.declined)
            return f"search again without {', '.join(self.declined)}{' and what contains it' * bool(along)}"
        return ""

    def of(self, name: str) -> str:
        """The word on a candidate."""
        if name == "none":
            return "accepted" if self.nothing else ""
        one = set(effects_of([name]))
        if one <= set(self.accepted):
            return "accepted"
        return "declined" if one & set(self.declined) else ""
