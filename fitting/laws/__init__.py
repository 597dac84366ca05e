"""Core laws, one file each. A new file with a `CoreLaw` is found by itself; other packages add theirs."""

from importlib import import_module
from pkgutil import iter_modules
from typing import Any

from fitting.laws.base import CoreLaw, Quantity
from fitting.plugins import Registry, derived_from

for _module in iter_modules(__path__):
    import_module(f"{__name__}.{_module.name}")


def _judge(name: str, found: Any) -> type[CoreLaw]:
    return derived_from(CoreLaw, name, found, "kind")


def _kind_of(law: type[CoreLaw]) -> str | None:
    """Its name in files; None for a bent law, which has the kind of the law that it bends."""
    found = vars(law).get("kind")
    return found if isinstance(found, str) else None


LAWS: Registry[type[CoreLaw]] = Registry(
    "viscorig.laws",
    {
        kind: law
        for law in CoreLaw.__subclasses__()
        if law.__module__.startswith(f"{__name__}.") and (kind := _kind_of(law)) is not None
    },
    _judge,
)
"""Every law by its `kind`."""

__all__ = ["LAWS", "CoreLaw", "Quantity"]
