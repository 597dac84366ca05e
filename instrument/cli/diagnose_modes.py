"""`viscorig diagnose` on tables of modes."""

from collections.abc import Collection, Sequence
from pathlib import Path

from instrument.cli.output import Output
from instrument.cli.print_diagnosis import print_diagnosis
from instrument.cli.reading import read_tables
from instrument.finding.modal import diagnose_tables, first_fit_of, refuse_to_diagnose
from instrument.interchange.questions import question_modes, question_numbers
from instrument.planning.unseen import with_unseen_in_tables
from instrument.progress import bar
from instrument.results.modal_diagnosis_from import modal_diagnosis_from


def diagnose_modes(
    out: Output, data: Sequence[Path], specimens: Sequence[Path], without: Collection[str], *, insist: bool
) -> None:
    """The effect behind what one law leaves. Raises `BadInput`, `FittingError`, `UsageError`.

    What no core comes near is refused unless someone insists.
    """
    tables, read = read_tables(data, specimens, insist=insist)
    refuse_to_diagnose(read, without)
    if not insist:
        question_numbers(tables, read, data)
        # Of tables that are misread no effect is looked for, which takes a minute.
        first, odd = first_fit_of(tables, read, bar)
        question_modes(tables, first, data, read, bar, odd)
    found = diagnose_tables(tables, read, without, bar)
    result = with_unseen_in_tables(modal_diagnosis_from(found, tables, [path.name for path in data]), found)
    print_diagnosis(out, result)
    out.result(result)
