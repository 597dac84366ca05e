"""`viscorig identify` on tables of modes."""

from collections.abc import Sequence
from pathlib import Path

import click

from fitting.structures.beam import Beam
from instrument.cli.output import Output
from instrument.cli.print_modes import print_formulas, print_modal_law, print_modes
from instrument.cli.print_uncertainty import print_in_depth
from instrument.cli.reading import read_tables
from instrument.files.modal_table import read_modal_table
from instrument.finding.modal import identify_tables
from instrument.interchange.questions import question_modes, question_numbers
from instrument.progress import bar
from instrument.results.modal_from import modal_from
from instrument.results.numbers import to_error
from instrument.results.uncertainty_facts import by_profile, in_depth_facts, looked_at_hz


def identify_modes(
    out: Output,
    data: Sequence[Path],
    specimens: Sequence[Path],
    bare: Path | None = None,
    *,
    profiled: bool = False,
    insist: bool = False,
) -> None:
    """One law from all tables, each with its specimen. Raises `BadInput`, `FittingError`, `UsageError`.

    What no core comes near is refused unless someone insists.
    """
    tables, read = read_tables(data, specimens, insist=insist)
    if bare is not None and not all(isinstance(s, Beam) for s in read):
        raise click.UsageError(f"--bare with a {read[0].kind}: expected a beam")
    if not insist:
        question_numbers(tables, read, data)
    found = identify_tables(tables, read, bar, read_modal_table(bare) if bare is not None else None)
    if not insist:
        question_modes(tables, found.fit, data, read, bar, found.odd)
    result = modal_from(found, tables, [path.name for path in data])
    errors = result.standard_errors
    rows = [[n, to_error(v, errors[n]), f"{errors[n]:.2g}"] for n, v in result.parameters.items()]
    out.table(f"{result.law_kind} by modes", ["parameter", "value", "standard error"], rows)
    out.say()
    print_modes(out, result.modes)
    out.say()
    print_modal_law(out, result.law)
    by = "" if all(t.states_its_noise for t in tables) else ", by errors of the modes that are assumed"
    out.say(f"chi-square per degree of freedom {found.fit.uncertainty.chi2_per_dof:.3g}{by}")
    print_formulas(out, result.formulas)
    if profiled:
        f = found.begun.problem.frequency_hz
        looked = by_profile(found.begun.quantities(looked_at_hz(float(f.min()), float(f.max()))), bar)
        print_in_depth(out, looked)
        result = result.but(uncertainty=tuple(in_depth_facts(looked)))
    for text in result.warnings:
        out.say(f"note: {text}")
    out.result(result)
