"""Files that are fitted together, each with its specimen, and what the commands are told of them. No Qt."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

from gui.files.short_name import short_name
from instrument.interchange.given import is_session

SPECIMEN_ENDING = ".toml"


@dataclass(frozen=True)
class PairedFile:
    """Data, and what they were measured on."""

    data: Path
    specimen: Path | None = None
    """None where the data are a session, which has its own."""


def paired(
    data: Sequence[Path], before: Sequence[PairedFile], known: Mapping[Path, Path]
) -> tuple[PairedFile, ...]:
    """More files behind those there are, each once, with the specimen that is likeliest.

    The one that these data had last; else the file of their name beside them; else, for all but sessions,
    the same as the file before.
    """
    found = list(before)
    for path in data:
        if any(_same(path, one.data) for one in found):
            continue
        found.append(PairedFile(path, known.get(path.resolve()) or _beside(path) or _as_before(path, found)))
    return tuple(found)


def with_specimen(files: Sequence[PairedFile], row: int | None, specimen: Path) -> tuple[PairedFile, ...]:
    """Of one row, or of all. One that has it while others have none is given to these too.

    A session that is alone in having its own keeps it.
    """
    return tuple(
        replace(one, specimen=specimen)
        if row in (None, k) or (one.specimen is None and not is_session(one.data))
        else one
        for k, one in enumerate(files)
    )


def fault_of(files: Sequence[PairedFile]) -> str:
    """Why these cannot be fitted together, in a line; empty where they can be tried."""
    if not files:
        return "Add a file, or several of one core."
    if len(files) == 1 and files[0].specimen is None and is_session(files[0].data):
        return "A session by itself is opened (Ctrl+O): add others, or choose a specimen for it."
    for k, one in enumerate(files, start=1):
        if one.specimen is None and not is_session(one.data):
            return f"File {k}, {short_name(one.data.name)}: no specimen, expected one: choose it."
    own = [k for k, one in enumerate(files, start=1) if one.specimen is None]
    if own and len(own) < len(files):
        said = ", ".join(map(str, own))
        return f"File {said}: a session with its own specimen beside chosen ones: choose one for it too."
    return ""


def arguments_of(files: Sequence[PairedFile], hammer: Path | None = None) -> list[str]:
    """Of the command line: data, then a specimen for each, or one for all; the bare plate's hammer test."""
    said = [str(one.data) for one in files]
    specimens = [str(one.specimen) for one in files if one.specimen is not None]
    if len(set(specimens)) == 1:
        specimens = specimens[:1]
    said += [word for name in specimens for word in ("--specimen", name)]
    return said if hammer is None else [*said, "--hammer", str(hammer)]


def _same(one: Path, other: Path) -> bool:
    return one.resolve() == other.resolve()


def _beside(data: Path) -> Path | None:
    named = data.with_suffix(SPECIMEN_ENDING)
    return named if not is_session(data) and named.is_file() else None


def _as_before(data: Path, before: Sequence[PairedFile]) -> Path | None:
    return next((one.specimen for one in reversed(before)), None) if not is_session(data) else None
