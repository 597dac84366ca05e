"""`viscorig card`: a law as the card of a simulation program."""

from dataclasses import replace
from pathlib import Path

import click

from instrument.cards.card import Card
from instrument.cards.formats import FORMATS
from instrument.cards.plain import card_result
from instrument.cli.options import NumberRange, file_argument, json_option
from instrument.cli.output import Output
from instrument.cli.printable import printable
from instrument.errors import BadInput
from instrument.files.at_once import write_at_once
from instrument.files.replaceable import refuse_ending, refuse_to_lose
from instrument.files.structure_file import read_structure
from instrument.material.found_law import read_law, stated_poisson
from instrument.progress import bar


@click.command()
@file_argument("found")
@click.option("--to", "to", type=click.Choice(list(FORMATS)), required=True, help="The program, or a table.")
@click.option(
    "--out",
    type=click.Path(path_type=Path, dir_okay=False, allow_dash=True),
    help="The card; beside FOUND as NAME-card otherwise. - for standard output.",
)
@click.option(
    "--specimen",
    type=click.Path(path_type=Path),
    help="SPECIMEN.toml: its name and the core's Poisson's ratio, which JSON does not hold.",
)
@click.option(
    "--error",
    "wanted",
    type=NumberRange(0.01, 50.0),
    default=1.0,
    show_default=True,
    help="Of the Prony series over the band, in percent: as few terms as reach it.",
)
@json_option
def card(
    found: Path, to: str, out: Path | None, specimen: Path | None, wanted: float, json_path: str | None
) -> None:
    """The law in FOUND as a material card: SESSION.h5, or the JSON of `identify` or `diagnose`.

    A session's law is that after its diagnosis, where it has one. Units are Pa, s and Hz.
    """
    if str(out) == "-" and json_path == "-":
        raise click.UsageError("--out - and --json -: standard output takes one of them")
    output = Output(json_path)
    form = FORMATS[to]
    path = out if out is not None else found.with_name(f"{found.stem}-card{form.endings[0]}")
    if str(path) != "-":
        refuse_ending(path, (*form.endings, f".{to}"))
        if not path.parent.is_dir():
            raise BadInput(f"{path}: no such folder to write to")
        refuse_to_lose(path, form.written)
    law = read_law(found, bar)
    if specimen is not None:
        read = read_structure(specimen)
        if read.core is None:
            raise BadInput(f"{specimen}: a bare {read.kind}, expected [core]")
        law = replace(law, specimen=specimen.name, poisson=stated_poisson(read))
    made = Card.of(law, wanted=wanted / 100)
    text = form.write(made)
    if str(path) == "-":
        click.echo("\n".join(printable(line) for line in text.split("\n")), nl=False)
        return
    write_at_once(path, text)
    for line in made.header():
        output.say(line)
    output.say(made.about_series())
    output.say(f"wrote {path}")
    output.result(card_result(made).but(card=str(path)))
