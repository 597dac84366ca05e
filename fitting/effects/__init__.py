"""What a plate or a rig may do that the model lacks, one file each; a new file is found by itself."""

from importlib import import_module
from pkgutil import iter_modules

from fitting.effects.base import Effect, EffectParameter, Points
from fitting.effects.change import Change
from fitting.effects.span import Span

for _module in iter_modules(__path__):
    import_module(f"{__name__}.{_module.name}")

CATALOGUE: dict[str, Effect] = {cls.name: cls() for cls in Effect.__subclasses__()}
"""Every effect by its name."""

SPANS: list[Span] = list(
    {span.name: span for e in CATALOGUE.values() for v in e.variants() for span in v.spans}.values()
)
"""Every span once."""

__all__ = ["CATALOGUE", "SPANS", "Change", "Effect", "EffectParameter", "Points", "Span"]
