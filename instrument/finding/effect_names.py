"""Effects by the names that someone wrote, and which of them have a meaning on specimens."""

from collections.abc import Collection, Iterable, Sequence

from fitting.effects import CATALOGUE, Effect
from fitting.effects.base import BASE, FORCE, ROOT
from fitting.specimen import StatedSpecimen
from instrument.errors import BadInput
from instrument.files.nearest import nearest


def refuse_unknown_effects(names: Iterable[str]) -> None:
    """Raises `BadInput` for the first that no effect has, with the one that was probably meant."""
    for name in sorted(set(names) - set(CATALOGUE)):
        meant = nearest(name, CATALOGUE)
        expected = meant if meant is not None else f"one of {', '.join(sorted(CATALOGUE))}"
        raise BadInput(f"effect {name!r}, expected {expected}")


def effects_among(
    specimens: Sequence[StatedSpecimen], without: Collection[str] = (), accept: Sequence[str] | None = None
) -> list[tuple[Effect, tuple[bool, ...]]]:
    """Effects on some specimens of one kind, and on which of these each has a meaning.

    A base that moves, or a clamp, is of those that have one; all must offer what else an effect needs. What
    goes with the level of a base is of those that one drives, where others are struck. What is in `without`
    takes along what contains it: a clamp that does not yield does not yield unevenly. Raises `BadInput` for
    a name that is none of them, and for one that is accepted and left out.
    """
    refuse_unknown_effects([*without, *(accept or ())])
    first = specimens[0]
    standing = {}
    for name, effect in CATALOGUE.items():
        form = effect.form_on(specimens)
        if form is None or not all(form.needs - (BASE | FORCE | ROOT) <= s.offers for s in specimens):
            continue
        of_level = form.enters == "level" and any(s.drive == "base" for s in specimens)
        stands = tuple(form.needs <= s.offers and not (of_level and s.drive == "force") for s in specimens)
        if any(stands):
            standing[name] = form, stands
    for name in accept or ():
        if name not in standing:
            drives = " or ".join(sorted({s.drive for s in specimens}))
            raise BadInput(
                f"effect {name!r} has no meaning on this {first.kind} driven by a {drives}, "
                f"expected one of {', '.join(sorted(standing))}"
            )
    left = left_out([form for form, _ in standing.values()], without)
    for name in accept or ():
        if name in left:
            along = "" if name in without else f" with {standing[name][0].extends!r}"
            raise BadInput(f"effect {name!r} both accepted and left out{along}, expected one of them")
    return [found for name, found in standing.items() if name not in left]


def left_out(effects: Iterable[Effect], without: Collection[str]) -> set[str]:
    """Names of those effects that are not considered: what is in `without`, and what contains one of it."""
    by_name = {effect.name: effect for effect in effects}
    declined = by_name.keys() & set(without)
    return {name for name, effect in by_name.items() if {name, effect.extends} & declined}
