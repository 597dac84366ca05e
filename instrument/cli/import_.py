"""`viscorig import`: another program's data to CSV files this one reads."""

from pathlib import Path

import click

from instrument.cli.options import file_argument, json_option
from instrument.cli.output import Output
from instrument.facts.written import ImportResult
from instrument.interchange.importing import import_file
from instrument.interchange.naming import Naming


@click.command("import")
@file_argument("file")
@click.option(
    "--out",
    type=click.Path(path_type=Path, dir_okay=False),
    help="Where it goes (.csv); the file's own name in the current folder otherwise, with "
    "-imported behind it where that is FILE. Only an earlier import that is named here is written over.",
)
@click.option(
    "--columns",
    metavar="NAMES",
    help="Of a text or a .mat: names in the place of its own, with their units. In the order of a text's "
    "columns, 'Frequency [Hz],FRF real [(m/s)/g],FRF imag [(m/s)/g],-' (- to pass over), or by its own "
    "names, 'f=Frequency [Hz],H=FRF [(m/s^2)/N]'.",
)
@json_option
def import_(file: Path, out: Path | None, columns: str | None, json_path: str | None) -> None:
    """FILE (.uff, .unv, .mat, .lvm, or text) as CSV for 'viscorig identify' and 'viscorig damping'.

    Text is .csv, .txt, .asc, .dat, .prn or .tsv. Velocity over base acceleration becomes a sweep, motion over
    force an FRF, a force with its responses an impact record, modes with loss factors a table of modes. What
    is found is listed.
    """
    output = Output(json_path)
    imported = import_file(file, out, None if columns is None else Naming.of(columns))
    for line in imported.said:
        output.say(line)
    for path in imported.files:
        output.say(f"wrote {path}")
    files = tuple(str(path) for path in imported.files)
    output.result(ImportResult(files=files, found=tuple(imported.said)))
