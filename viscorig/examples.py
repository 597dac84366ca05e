"""The cases that the package ships: a published plate and a whole experiment on simulated instruments."""

from pathlib import Path

from instrument import paper_case, simulated_case
from instrument.errors import BadInput

_CASES = {
    **dict.fromkeys(("zn1.toml", "isd112.toml", "table5.csv"), paper_case.case_file),
    **dict.fromkeys(simulated_case.FILES, simulated_case.case_file),
}


def example_file(name: str) -> Path:
    """Path of a shipped file. Raises `BadInput` naming those there are.

    `zn1.toml` and `table5.csv` are the published plate and its nine measured points, `isd112.toml` another
    plate; `experiment.toml`, `rig.toml` and `specimen.toml` an experiment on the simulated rig.
    """
    if name not in _CASES:
        raise BadInput(f"example {name!r}, expected one of {', '.join(_CASES)}")
    return _CASES[name](name)
