"""`viscorig new`: a commented file to start from."""

from pathlib import Path

import click

from instrument.cli.options import json_option
from instrument.cli.output import Output
from instrument.facts.written import NewResult
from instrument.files.new_file import TEMPLATES, write_new


@click.command()
@click.argument("kind", type=click.Choice(list(TEMPLATES)))
@click.argument("path", type=click.Path(path_type=Path), required=False)
@json_option
def new(kind: str, path: Path | None, json_path: str | None) -> None:
    """A commented file of KIND to start from, valid as it stands, in PATH or KIND.toml here."""
    out = Output(json_path)
    where = write_new(kind, path)
    out.say(f"wrote {where}")
    out.result(NewResult(kind=kind, path=str(where)))
