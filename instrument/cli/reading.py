"""DATA of `identify` and `diagnose`, as their options have it."""

from collections.abc import Callable, Sequence
from dataclasses import replace
from pathlib import Path

import click

from fitting.laws.constant import ConstantModulus
from fitting.mode_tables.table import ModalTable
from fitting.specimen import PlateSpecimen
from fitting.structures import AnySpecimen
from instrument.cli.options import force_option
from instrument.cli.output import Output
from instrument.errors import BadInput
from instrument.files.modal_table import is_modal_table, read_modal_table, read_modal_tables
from instrument.files.plausible import question_specimen
from instrument.files.repeated import refuse_same_modes, refuse_same_points
from instrument.files.structure_file import read_structure
from instrument.interchange.cut_sweep import looks_cut
from instrument.interchange.given import Given, read_given
from instrument.interchange.questions import question_data, question_length, question_temperatures
from instrument.models.files import File
from instrument.progress import bar
from instrument.temperatures.members import AtTemperature

_NO_LAW = ConstantModulus(1e6, 0.0)
_OPTIONS = (
    click.option(
        "--specimen",
        type=click.Path(path_type=Path),
        multiple=True,
        help="SPECIMEN.toml; its law is the start. A session has its own. With several files one for each, "
        "in order, or one for all.",
    ),
    click.option(
        "--hammer",
        type=click.Path(path_type=Path),
        help="The bare plate's test, in a session or the JSON of 'viscorig damping': its ratios, and the "
        "substrate's stiffness. A session has its own.",
    ),
    force_option,
    click.option("--no-hammer", is_flag=True, help="Leave a session's own hammer test out."),
)


def reading_options(command: Callable[..., None]) -> Callable[..., None]:
    """`--specimen`, `--hammer`, `--no-hammer`, `--force`."""
    for option in reversed(_OPTIONS):
        command = option(command)
    return command


def read_each(
    out: Output,
    data: Sequence[Path],
    specimens: Sequence[Path],
    hammer: Path | None,
    *,
    no_hammer: bool,
    insist: bool,
    one_plate: bool = False,
    own_hammer: bool = False,
    at_temperatures: bool = False,
) -> list[Given]:
    """Read every file with its specimen, paired in order; one specimen serves all.

    Raises `BadInput`, `UsageError`.

    With `one_plate` a hammer test may come with several files, and is the first one's; with `own_hammer`
    sessions keep their own.

    Stated numbers and data that no such plate has are questioned, unless someone insists; so are files of
    several temperatures, unless they are `at_temperatures` of their own.
    """
    if len(specimens) > 1 and len(specimens) != len(data):
        raise click.UsageError(
            f"{len(specimens)} times --specimen for {len(data)} files, expected one for each or one for all"
        )
    if len(data) > 1 and hammer is not None and not one_plate:
        raise click.UsageError("--hammer with several files: expected one file")
    paired = list(specimens) if len(specimens) == len(data) else [*specimens, None][:1] * len(data)
    structures: dict[Path | None, AnySpecimen] = {}
    for specimen in dict.fromkeys(paired):
        if specimen is not None:
            # Whatever else is wrong with it is said on reading.
            structures[specimen] = read_structure(specimen)
            question_specimen(specimen, insist=insist)
    if not insist:
        for path, specimen in zip(data, paired, strict=True):
            if specimen is not None:
                question_length(path, structures[specimen])
    given = [
        _read_data(
            one,
            specimen,
            None if k else hammer,
            no_hammer=no_hammer or (len(data) > 1 and (hammer is None or k > 0) and not own_hammer),
        )
        for k, (one, specimen) in enumerate(zip(data, paired, strict=True))
    ]
    refuse_same_points(data, [one.sweep for one in given])
    cut = "" if at_temperatures else looks_cut(data, [one.sweep for one in given], paired)
    for remark in dict.fromkeys(said for said in (*(one.remark for one in given), cut) if said):
        out.say(f"{remark}\n")
    if hammer is not None and not isinstance(given[0].specimen, PlateSpecimen):
        raise click.UsageError(f"--hammer with a {given[0].specimen.kind}: expected a plate")
    if hammer is not None and len({_bare(one) for one in given}) > 1:
        raise click.UsageError("--hammer with plates of unlike substrates: expected one bare plate")
    if not insist:
        for one, path in zip(given, data, strict=True):
            question_data(one, path, bar)
        if not at_temperatures:
            question_temperatures([one.temperature_c for one in given], data)
    for remark in dict.fromkeys(one.level_remark for one in given if one.level_remark):
        out.say(f"{remark}\n")
    return given


def _bare(given: Given) -> object:
    return given.specimen.substrate if isinstance(given.specimen, PlateSpecimen) else None


def are_tables(data: Sequence[Path], specimens: Sequence[Path]) -> bool:
    """Whether DATA are tables of modes. Raises `UsageError` for tables beside other data."""
    found = [path.suffix.lower() == ".csv" and is_modal_table(path) for path in data]
    if any(found) and not all(found):
        raise click.UsageError("tables of modes beside other data: expected one of them")
    if any(found) and not specimens:
        raise click.UsageError("Missing option '--specimen': a table of modes does not say whose they are")
    return any(found)


def read_tables(
    data: Sequence[Path], specimens: Sequence[Path], *, insist: bool
) -> tuple[list[ModalTable], list[AnySpecimen]]:
    """Tables of modes with their specimens, paired in order. Raises `BadInput`, `UsageError`.

    Stated numbers that no such specimen has are questioned, unless someone insists.
    """
    paths = _specimen_of_each(data, specimens, "tables")
    read = [read_structure(path) for path in paths]
    for path in dict.fromkeys(paths):
        question_specimen(path, insist=insist)
    tables = [read_modal_table(path) for path in data]
    refuse_same_modes(data, tables)
    return tables, read


def read_tables_at(
    data: Sequence[Path], specimens: Sequence[Path], *, insist: bool
) -> tuple[list[AtTemperature], list[AnySpecimen]]:
    """Tables of modes at several temperatures, one or many in a file, and the specimens by their numbers.

    Files that name one specimen file are of one specimen. Raises `BadInput`, `UsageError`.
    """
    paths = _specimen_of_each(data, specimens, "tables")
    own = list(dict.fromkeys(paths))
    read = [read_structure(path) for path in own]
    for path in own:
        question_specimen(path, insist=insist)
    found, of, tables = [], list[Path](), list[ModalTable]()
    for path, specimen in zip(data, paths, strict=True):
        for table in read_modal_tables(path):
            assert table.temperature_c is not None
            T = float(table.temperature_c.mean())
            found.append(AtTemperature(table, T, path.name, 1 + own.index(specimen)))
            of.append(path)
            tables.append(table)
    refuse_same_modes(of, tables)
    return found, read


def _specimen_of_each(data: Sequence[Path], specimens: Sequence[Path], what: str) -> list[Path]:
    if len(specimens) not in (1, len(data)):
        raise click.UsageError(
            f"{len(specimens)} times --specimen for {len(data)} {what}, expected one for each or one for all"
        )
    return list(specimens) if len(specimens) == len(data) else [specimens[0]] * len(data)


def sweeps_at(
    given: Sequence[Given], data: Sequence[Path], specimens: Sequence[Path]
) -> tuple[list[AtTemperature], list[AnySpecimen]]:
    """Sweeps and sessions at several temperatures, and the specimens by their numbers.

    Files that name one specimen file, and sessions whose specimens are alike, are of one specimen. Raises
    `BadInput`.
    """
    keys: list[object] = []
    own: list[AnySpecimen] = []
    found = []
    for k, (one, path) in enumerate(zip(given, data, strict=True)):
        if one.temperature_c is None:
            raise BadInput(f"{path}: no temperature, expected a column temperature_c")
        if one.sweep.pickup is not None:
            raise BadInput(f"{path}: rows of several pickups with --shift, expected those of one spot")
        key: object = specimens[k] if len(specimens) == len(data) else _but_for_its_law(one.specimen)
        if key not in keys:
            keys.append(key)
            own.append(one.specimen)
        found.append(AtTemperature(one.sweep, one.temperature_c, path.name, 1 + keys.index(key)))
    return found, own


def _but_for_its_law(specimen: AnySpecimen) -> AnySpecimen:
    """With a law that says nothing: the stated one is where a fit starts."""
    core = specimen.core
    return specimen if core is None else replace(specimen, core=replace(core, law=_NO_LAW))


def files_of_data(given: Sequence[Given], data: Sequence[Path]) -> list[File]:
    """Make DATA files under one law, each of their spots apart.

    Raises `BadInput` for a session with known masses, clampings or blows beside other files.
    """
    if len(given) > 1 and any(one.with_masses for one in given):
        raise BadInput(
            "a session with a known mass put on, clamped anew or struck beside other files, expected it alone"
        )
    each = zip(given, data, strict=True)
    return [spot for number, (g, path) in enumerate(each, start=1) for spot in g.files(path.name, number)]


def _read_data(data: Path, specimen: Path | None, hammer: Path | None, *, no_hammer: bool) -> Given:
    """DATA, its specimen and its hammer test. Raises `BadInput`, `UsageError`."""
    if hammer is not None and no_hammer:
        raise click.UsageError("--hammer and --no-hammer exclude each other")
    return read_given(data, specimen, hammer, own_hammer=not no_hammer)
