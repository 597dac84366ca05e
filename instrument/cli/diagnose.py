"""`viscorig diagnose`: which missing effect the residual of a sweep shows."""

from pathlib import Path

import click

from instrument.cli.diagnose_modes import diagnose_modes
from instrument.cli.naming import naming_files
from instrument.cli.options import figures_option, file_arguments, json_option, refuse_with_tables
from instrument.cli.output import Output
from instrument.cli.print_diagnosis import print_diagnosis
from instrument.cli.print_run import print_result
from instrument.cli.reading import are_tables, files_of_data, read_each, reading_options
from instrument.files.repeated import refuse_repeats
from instrument.finding.diagnosis import diagnose as diagnose_files
from instrument.models.files import lone_plate
from instrument.planning.into_experiment import begun
from instrument.planning.next_sweep import write_next
from instrument.planning.open_questions import with_open_questions
from instrument.progress import bar
from instrument.results.diagnosis_from import diagnosis_from
from instrument.results.session_result import Conditions, result_of


@click.command()
@file_arguments("data")
@reading_options
@click.option(
    "--without",
    multiple=True,
    metavar="NAME",
    help="Leave this effect, and what contains it, out of consideration; may be given several times.",
)
@click.option(
    "--accept",
    multiple=True,
    metavar="NAME",
    help="Add this effect on your word and search no further; may be given several times, `none` alone.",
)
@click.option(
    "--resamples",
    type=click.IntRange(0, 1000),
    help="Repeat the search on so many sweeps drawn without any effect (p-value), and with segments held "
    "out. For one sweep of a plate at one spot, and always done there for 30 points or fewer; 0 for never. "
    "Not with --accept: nothing is searched for then.",
)
@click.option(
    "--next",
    "experiment",
    type=click.Path(path_type=Path),
    help="Write what is advised first as the [sweep] of this experiment file; a new one where there is none.",
)
@figures_option(
    "Save residual, evidence and law as PNG.",
    "diagnosis-residual.png",
    "diagnosis-evidence.png",
    "diagnosis-law.png",
)
@json_option
@naming_files
def diagnose(
    data: tuple[Path, ...],
    specimen: tuple[Path, ...],
    hammer: Path | None,
    no_hammer: bool,
    insist: bool,
    without: tuple[str, ...],
    accept: tuple[str, ...],
    resamples: int | None,
    experiment: Path | None,
    figures: Path | None,
    json_path: str | None,
) -> None:
    """What the fit of DATA cannot explain, traced to a physical effect, with the error before and after.

    DATA is a sweep (.csv), a recorded session (.h5), or an FRF of the pickup over the base's acceleration
    (.csv, .uff, .unv, .mat), or a table of modes (.csv: mode, frequency_hz, loss_factor). Several are one
    experiment: an effect common to all is named once.
    """
    if resamples and accept:
        raise click.UsageError("--resamples with --accept: no search to repeat, expected one of them")
    out = Output(json_path)
    refuse_repeats(data)
    if are_tables(data, specimen):
        refuse_with_tables(
            {
                "--hammer": hammer is not None,
                "--accept": bool(accept),
                "--resamples": resamples is not None,
                "--next": experiment is not None,
                "--figures": figures is not None,
            }
        )
        diagnose_modes(out, data, specimen, frozenset(without), insist=insist)
        return
    # Said before the work, not after it.
    text = _begun(experiment, specimen) if experiment is not None else ""
    every = read_each(out, data, specimen, hammer, no_hammer=no_hammer, insist=insist, one_plate=True)
    declined, accepted = frozenset(without), _accepted(accept)
    files, given = files_of_data(every, data), every[0]
    alone = lone_plate(files) is not None
    if resamples is not None and not alone:
        raise click.UsageError(
            "--resamples with several files or spots, a beam or a shear pair: "
            "expected one sweep of a plate at one spot"
        )
    found = diagnose_files(files, given.modes, declined, bar, accepted, resamples)
    result = given.said(with_open_questions(diagnosis_from(found), found))
    print_diagnosis(out, result)
    if alone:
        out.say()
        print_result(out, result_of(None, result, Conditions.of_sweep(given.sweep, given.temperature_c)))
    if experiment is not None:
        out.say(f"\n{write_next(experiment, text, result.next_measurements)}")
    if figures is not None:
        from instrument.results.diagnosis_figures import save_diagnosis_figures

        for path in save_diagnosis_figures(result, figures):
            out.say(f"saved {path}")
    out.result(result)


def _begun(experiment: Path, specimen: tuple[Path, ...]) -> str:
    if not experiment.exists() and not specimen:
        raise click.UsageError(f"--next {experiment}: a new file, expected --specimen for it to name")
    return begun(experiment, specimen[0] if specimen else experiment)


def _accepted(names: tuple[str, ...]) -> tuple[str, ...] | None:
    """None where nothing was said; nothing where all are declined."""
    if "none" in names and len(names) > 1:
        raise click.UsageError("--accept none excludes every other")
    return tuple(n for n in names if n != "none") if names else None
