"""Measure damping materials from Python: arrays in, a core's complex modulus and its uncertainty out.

    import viscorig as vr

    specimen = vr.load_specimen("specimen.toml")
    found = vr.identify(vr.load_sweep("sweep.csv", specimen), specimen)
    found.plot()

Every name is loaded when it is first used (PEP 562), so that importing the package costs next to nothing.
"""

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from viscorig import errors
    from viscorig.diagnosis import Diagnosis
    from viscorig.examples import example_file
    from viscorig.fits import diagnose, identify
    from viscorig.hammer import Damping, Hit, damping
    from viscorig.identification import Identification
    from viscorig.plate_modes import Modes, modes
    from viscorig.response import Response, predict
    from viscorig.rig import Rig, run
    from viscorig.session import Session, load_session
    from viscorig.specimen import Specimen, load_specimen
    from viscorig.sweep import Sweep, load_sweep

    __version__: str

__all__ = [
    "Damping",
    "Diagnosis",
    "Hit",
    "Identification",
    "Modes",
    "Response",
    "Rig",
    "Session",
    "Specimen",
    "Sweep",
    "__version__",
    "damping",
    "diagnose",
    "errors",
    "example_file",
    "identify",
    "load_session",
    "load_specimen",
    "load_sweep",
    "modes",
    "predict",
    "run",
]

_HOMES = {
    "diagnosis": ("Diagnosis",),
    "examples": ("example_file",),
    "fits": ("diagnose", "identify"),
    "hammer": ("Damping", "Hit", "damping"),
    "identification": ("Identification",),
    "plate_modes": ("Modes", "modes"),
    "response": ("Response", "predict"),
    "rig": ("Rig", "run"),
    "session": ("Session", "load_session"),
    "specimen": ("Specimen", "load_specimen"),
    "sweep": ("Sweep", "load_sweep"),
}
"""Which file of this package defines a name."""


def __getattr__(name: str) -> Any:
    """A name on its first use; from then on it is here."""
    globals()[name] = found = _load(name)
    return found


def _load(name: str) -> Any:
    if name == "__version__":
        return import_module("importlib.metadata").version("viscorig")
    if name == "errors":
        return import_module(f"{__name__}.errors")
    for home, names in _HOMES.items():
        if name in names:
            return getattr(import_module(f"{__name__}.{home}"), name)
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")


def __dir__() -> list[str]:
    """The public names, loaded or not."""
    return list(__all__)
