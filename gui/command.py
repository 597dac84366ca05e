"""`viscorig gui`: the window. Found by the command line through its entry point."""

from pathlib import Path

import click

from instrument.errors import BadInput


@click.command()
@click.argument("session", type=click.Path(path_type=Path, exists=True, dir_okay=False), required=False)
def gui(session: Path | None) -> None:
    """The window, with SESSION.h5 where one is given."""
    try:
        from gui.application import run
    except ImportError as error:
        raise BadInput(_missing(error)) from None
    run(session)


def _missing(error: ImportError) -> str:
    if error.name is not None and error.name.partition(".")[0] in ("PySide6", "pyqtgraph", "shiboken6"):
        return f"the window needs {error.name}: pip install 'viscorig[gui]'"
    return f"the window cannot start: {error}: apt-get install libegl1 libgl1 libxkbcommon0 libdbus-1-3"
