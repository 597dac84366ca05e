"""Stated numbers that the fit moved, by file; what it leaves unexplained; whose an effect is. No Qt."""

import re
from collections.abc import Sequence
from dataclasses import dataclass

from fitting.data.aside import DISTURBED
from fitting.diagnosis.several.of_files import ALIKE, EACH, FILE
from gui.actions.together import Fitted
from gui.files.short_name import short_name
from gui.pages.together.fits import FAR_STD, FittedFile
from instrument.facts.diagnosis import CandidateFitted, DiagnosisResult
from instrument.facts.identification import IdentificationResult
from instrument.facts.modal import ModalResult
from instrument.facts.rows import AdjustedNumber, PointSetAside, StretchSetAside
from instrument.results.diagnosis_words import probability_words
from instrument.results.numbers import format_number, with_error
from instrument.results.set_aside import NAME, words_of
from instrument.results.standing import Standing, standing
from instrument.results.typeset import typeset

_OF_FILE = re.compile(r"(?P<kind>.*?) \[(?P<file>\d+)(, (?P<spot>.*))?\]$")
_EVERY = "all"


@dataclass(frozen=True)
class NumberRow:
    """A stated number and what was found."""

    name: str
    file: str
    """Its number and name; `all` of one that is common."""
    stated: str
    found: str
    pull: float
    """In tolerances."""


@dataclass(frozen=True)
class LeftRow:
    """A stretch or a point that nothing explains."""

    file: str
    where: str
    what: str
    off_percent: str


def number_rows(adjusted: Sequence[AdjustedNumber], files: Sequence[str]) -> list[NumberRow]:
    """What all files share first, then each kind of number, file by file."""
    rows, order = [], []
    kinds: list[str] = []
    for one in adjusted:
        match = _OF_FILE.match(one.name)
        kind, number = (match["kind"], int(match["file"])) if match else (one.name, 0)
        spot = f", {match['spot']}" if match and match["spot"] else ""
        unit = "" if one.unit == "1" else f" / {_unit(one.unit)}"
        if kind not in kinds:
            kinds.append(kind)
        order.append((number > 0, kinds.index(kind), number))
        rows.append(
            NumberRow(
                kind + spot + unit,
                _titled(number, files) if number else _EVERY,
                with_error(one.stated, one.tolerance),
                with_error(one.found, one.standard_error),
                one.pull,
            )
        )
    return [rows[k] for k in sorted(range(len(rows)), key=order.__getitem__)]


def left_rows(
    fitted: Sequence[FittedFile],
    aside: Sequence[StretchSetAside],
    points: Sequence[PointSetAside] = (),
    *,
    judged: bool,
) -> list[LeftRow]:
    """Stretches and points set aside, then points further off than noise and model error, where `judged`."""
    rows = [
        LeftRow(
            f"{s.file} {s.name}",
            f"{s.from_hz:.4g} to {s.to_hz:.4g}",
            f"{s.points} points set aside: no law does this",
            f"{s.largest_percent:.2g} at most",
        )
        for s in aside
    ]
    for one in fitted:
        for why in dict.fromkeys(p.why for p in points if p.why != DISTURBED):
            its = [p for p in points if (p.why, p.file or 1) == (why, one.number)]
            if its:
                f = sorted(p.frequency_hz for p in its)
                where = f"{f[0]:.4g}" + (f" to {f[-1]:.4g}" if len(f) > 1 else "")
                rows.append(LeftRow(one.title, where, f"{len(f)} {NAME}: {words_of(why)}", ""))
    for one in fitted if judged else ():
        off = one.difference_percent
        for k in one.far.nonzero()[0]:
            said = f"further off than {FAR_STD:g} standard deviations"
            rows.append(LeftRow(one.title, f"{one.frequency_hz[k]:.4g}", said, f"{off[k]:+.2g}"))
    return rows


def count_of(fit: Fitted) -> str:
    """How many files it is of, in words."""
    count = len(fit.files or ("",))
    return f"{count} file" + ("s" if count > 1 else "")


def headline(fit: Fitted) -> str:
    """The law of all files in a line."""
    counted = f"{len(fit.modes)} modes" if isinstance(fit, ModalResult) else f"{len(fit.points)} points"
    of = "frequency" if isinstance(fit, ModalResult) else "amplitude"
    said = [
        f"{fit.law_kind} law of {count_of(fit)}, {counted}",
        f"rms {format_number(fit.rms_percent, 2)} % in {of}",
    ]
    if fit.chi2_per_dof is not None:
        said.append(f"chi² per degree {format_number(fit.chi2_per_dof, 3)}")
    if isinstance(fit, IdentificationResult) and fit.hammer is not None:
        said.append("with the bare plate's hammer test")
    return ", ".join(said)


@dataclass(frozen=True)
class CandidateRow:
    """An explanation that was tried, for a glance; all of it is on Diagnosis."""

    name: str
    file: str
    probability: str
    standing: Standing


def candidate_rows(found: DiagnosisResult, most: int = 8) -> list[CandidateRow]:
    """Best first, with the file that each belongs to; `none` is always among them."""
    shown = found.candidates[:most]
    shown += tuple(c for c in found.candidates[most:] if c.name == "none")
    return [
        CandidateRow(
            c.name,
            _of_candidate(c, found.files or ()),
            probability_words(c, found).replace("-", "–"),
            standing(c.name, found),
        )
        for c in shown
    ]


def _of_candidate(candidate: CandidateFitted, files: Sequence[str]) -> str:
    """Whose it is; of two effects together each has its own, with its name before the key."""
    its = [p for key, p in candidate.parameters.items() if key.rpartition(".")[2] == FILE]
    return ", ".join(dict.fromkeys(_whose(round(p.value), files) for p in its))


def _whose(number: int, files: Sequence[str]) -> str:
    return {ALIKE: "all alike", EACH: "each its own"}.get(number) or _titled(number, files)


def owners(found: DiagnosisResult) -> dict[int, list[str]]:
    """Of each file that an effect belongs to, from 1, the effects by name."""
    owned: dict[int, list[str]] = {}
    for effect in found.effects:
        its = effect.parameters.get(FILE)
        if its is not None and its.value >= 1:
            owned.setdefault(round(its.value), []).append(effect.name)
    return owned


def owner_lines(found: DiagnosisResult) -> list[str]:
    """The files that effects belong to, by their names."""
    said = []
    for effect in found.effects:
        its = effect.parameters.get(FILE)
        if its is None:
            continue
        number = round(its.value)
        if number == ALIKE:
            said.append(f"{effect.name}: of all files alike.")
        elif number == EACH:
            said.append(f"{effect.name}: in each file its own.")
        else:
            said.append(f"{effect.name}: of file {_titled(number, found.files or ())} alone.")
    return said


def _unit(unit: str) -> str:
    return typeset(f"1 {unit}").removeprefix("1 ").replace("^2", "²").replace("^3", "³")


def _titled(number: int, files: Sequence[str]) -> str:
    return f"{number} {short_name(files[number - 1])}" if number <= len(files) else str(number)
