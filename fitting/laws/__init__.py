"""Core laws, one file each. A new file with a `CoreLaw` in it is found by itself."""

from importlib import import_module
from pkgutil import iter_modules

from fitting.laws.base import CoreLaw, Quantity

for _module in iter_modules(__path__):
    import_module(f"{__name__}.{_module.name}")

LAWS: dict[str, type[CoreLaw]] = {law.kind: law for law in CoreLaw.__subclasses__()}
"""Every law by its `kind`."""

__all__ = ["LAWS", "CoreLaw", "Quantity"]
