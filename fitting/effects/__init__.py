"""What a plate or a rig may do that the model lacks, one file each; a new file is found by itself.

Other packages add theirs (`fitting.plugins`).
"""

from importlib import import_module
from pkgutil import iter_modules
from typing import Any

from fitting.effects.base import Effect, EffectParameter
from fitting.effects.given import Points
from fitting.plugins import NoPlugin, Registry, derived_from
from fitting.specimen import StatedSpecimen
from fitting.widened.change import Change
from fitting.widened.span import Span

for _module in iter_modules(__path__):
    import_module(f"{__name__}.{_module.name}")

_OWN: dict[str, Effect] = {
    cls.name: cls()
    for cls in Effect.__subclasses__()
    # One without a name is a form that others take.
    if cls.__module__.startswith(f"{__name__}.") and "name" in vars(cls)
}
_span_classes: dict[str, type[Span]] = {}
"""Whose a span's name is."""


def _judge(name: str, found: Any) -> Effect:
    effect = derived_from(Effect, name, found, "name")()
    if effect.extends is not None and effect.extends not in _OWN:
        raise NoPlugin(f"it extends {effect.extends!r}, which is no effect of viscorig's own")
    if effect.sharp and (type(effect).swings is Effect.swings or type(effect).sharply is Effect.sharply):
        raise NoPlugin(
            "it is sharp, and says neither where a mass swings (swings) nor how it is felt (sharply)"
        )
    _claim(effect)
    return effect


def _claim(effect: Effect) -> None:
    """Names of spans are used by all effects together. Raises `NoPlugin` for one that is another's."""
    for span in spans_of(effect):
        if _span_classes.setdefault(span.name, type(span)) is not type(span):
            raise NoPlugin(f"its span {span.name!r} has the name of another one")


def spans_of(effect: Effect) -> list[Span]:
    """The spans that an effect needs, of all its variants."""
    return [span for variant in effect.variants() for span in variant.spans]


def all_spans(specimen: StatedSpecimen | None = None) -> list[Span]:
    """Every span of the catalogue once; of those effects that stand on a specimen, where one is given."""
    effects = [e for e in CATALOGUE.values() if specimen is None or e.standing_on(specimen)]
    return list({span.name: span for e in effects for span in spans_of(e)}.values())


def span_modules() -> list[str]:
    """Modules that say what the reduced plate must span, another package's effects among them."""
    spanning = {type(span).__module__ for span in all_spans()}
    return sorted(
        spanning | {type(e).__module__ for n, e in CATALOGUE.items() if n not in _OWN and spans_of(e)}
    )


for _effect in _OWN.values():
    _claim(_effect)

CATALOGUE: Registry[Effect] = Registry("viscorig.effects", _OWN, _judge)
"""Every effect by its name."""

__all__ = [
    "CATALOGUE", "Change", "Effect", "EffectParameter", "Points", "Span", "all_spans", "span_modules",
]  # fmt: skip
