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
    goes with the level of a base is of those that one drives, where others are struck. Raises `BadInput` for
    a name that is none of them. What is in `without` takes along what contains it: a clamp that does not
    yield does not yield unevenly.
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
    return [found for found in standing.values() if not is_left_out(found[0], without)]


def is_left_out(effect: Effect, without: Collection[str]) -> bool:
    """Whether an effect, or the one that it contains, is among names that are not considered."""
    return not {effect.name, effect.extends}.isdisjoint(without)
