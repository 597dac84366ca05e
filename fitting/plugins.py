"""Things by name that other packages may add: entry points, loaded when they are asked for.

One rule for every group: the project's own have the first word, then other packages by their names. What does
not load, is no such thing, or has a name that is taken is left out, and said in one line, once.
"""

import logging
import os
from collections.abc import Callable, Iterator, Mapping
from functools import cache, cached_property
from importlib.metadata import EntryPoint, entry_points
from typing import Any, Generic, TypeVar

GROUPS = {
    "viscorig.laws": "core law",
    "viscorig.effects": "effect",
    "viscorig.shakers": "shaker",
    "viscorig.vibrometers": "vibrometer",
    "viscorig.front_ends": "front-end",
    "viscorig.chambers": "chamber",
    "viscorig.readers": "file reader",
    "viscorig.pages": "page",
    "viscorig.commands": "command",
}
"""What an entry point of each group adds."""
OURS = "viscorig"
"""The package that every other one adds to."""
TOLD = "VISCORIG_PLUGINS_TOLD"
"""What was said already, for the processes this one starts: they need not say it again."""

T = TypeVar("T")

log = logging.getLogger(__name__)


class NoPlugin(Exception):
    """Why what was loaded is not what its group is for, in half a sentence."""


@cache
def entries() -> dict[str, tuple[EntryPoint, ...]]:
    """Entry points of every group, by package and name. Nothing is imported: names and places are text."""
    known = entry_points()
    return {
        group: tuple(sorted(known.select(group=group), key=lambda e: (package_of(e)[0], e.name)))
        for group in GROUPS
    }


def others() -> list[EntryPoint]:
    """What other packages add, in the order of groups. Nothing is imported."""
    return [e for found in entries().values() for e in found if package_of(e)[0] != OURS]


def packages() -> dict[str, str]:
    """Version of every other package that adds something."""
    return dict(sorted({package_of(e) for e in others()}))


def package_of(entry: EntryPoint) -> tuple[str, str]:
    """Name and version of the package an entry point comes with."""
    return (entry.dist.name, entry.dist.version) if entry.dist is not None else ("unknown", "unknown")


def leave_out(entry: EntryPoint, why: object) -> str:
    """Say that something of another package is not used, once for this process and those it starts."""
    words = " ".join(str(why).split())
    if isinstance(why, BaseException) and not isinstance(why, NoPlugin):
        words = f"{type(why).__name__}: {words}"
    line = f"plugin {entry.name!r} of package {package_of(entry)[0]} ({entry.group}) is left out: {words}"
    before = told()
    if line not in before:
        os.environ[TOLD] = "\n".join([*before, line])
        log.warning("%s", line)
    return words


def told() -> list[str]:
    """What was said of packages that are left out, here or by the process that started this one."""
    return os.environ.get(TOLD, "").splitlines()


class Registry(Mapping[str, T], Generic[T]):
    """Things of one group by name. Iterated, the project's own come first, in their order.

    Parameters
    ----------
    group
        Of the entry points; the name of one is the thing's.
    own
        The project's: the thing itself, or "module:attribute" for one that is imported when asked for.
    judge
        From what was loaded under a name to the thing. Raises `NoPlugin` for what is none.
    """

    def __init__(self, group: str, own: Mapping[str, T | str], judge: Callable[[str, Any], T]) -> None:
        self.group, self._own, self._judge = group, own, judge
        self._loaded: dict[str, T | None] = {}
        self._why: dict[str, str] = {}

    def __getitem__(self, name: str) -> T:
        """The thing of a name. Raises `KeyError` where there is none that can be used."""
        found = self._found(name)
        if found is None:
            raise KeyError(name)
        return found

    def __iter__(self) -> Iterator[str]:
        """Names, other packages' only where they can be used."""
        yield from self._own
        yield from (name for name in self._others if self._found(name) is not None)

    def __len__(self) -> int:
        return sum(1 for _ in self)

    def expected(self, name: object) -> str:
        """For a message about an unknown name: those there are, and why this one is none of them."""
        why = self._why.get(name) if isinstance(name, str) else None
        return f"expected one of {', '.join(sorted(self))}" + (f" (its plugin: {why})" if why else "")

    def taken(self, entry: EntryPoint) -> str:
        """Who else has an entry point's name, for people; empty where nobody has. Nothing is imported."""
        first = next(package_of(e)[0] for e in entries()[self.group] if e.name == entry.name)
        who = f"{OURS} itself" if entry.name in self._own else f"package {first}"
        is_first = entry.name not in self._own and first == package_of(entry)[0]
        return "" if is_first else f"{who} has a {GROUPS[self.group]} of this name"

    def leave_out(self, name: str, why: Exception) -> None:
        """No longer use another package's, which failed at its work; said in one line."""
        self._why[name] = leave_out(self._others[name], why)
        self._loaded[name] = None

    def is_own(self, name: str) -> bool:
        """Whether it is the project's."""
        return name in self._own

    def _found(self, name: str) -> T | None:
        if name not in self._loaded:
            self._loaded[name] = self._load(name)
        return self._loaded[name]

    def _load(self, name: str) -> T | None:
        others = self._others
        if name in self._own:
            own = self._own[name]
            return (
                self._judge(name, EntryPoint(name, own, self.group).load()) if isinstance(own, str) else own
            )
        if name not in others:
            return None
        try:
            return self._judge(name, others[name].load())
        except (Exception, SystemExit) as error:  # whatever another package does, the program goes on
            self._why[name] = leave_out(others[name], error)
            return None

    @cached_property
    def _others(self) -> dict[str, EntryPoint]:
        """Other packages', by name; the first of a name has it."""
        found: dict[str, EntryPoint] = {}
        for entry in entries()[self.group]:
            why = self.taken(entry)
            if why:
                leave_out(entry, NoPlugin(why))
            else:
                found[entry.name] = entry
        return found


def derived_from(base: type[T], name: str, found: Any, called: str) -> type[T]:
    """A class derived from `base` whose attribute `called` is the entry point's name. Raises `NoPlugin`."""
    if not (isinstance(found, type) and issubclass(found, base)) or found is base:
        raise NoPlugin(f"{found!r:.80} is no class derived from {base.__module__}.{base.__name__}")
    own = getattr(found, called, None)
    if isinstance(own, property):
        # That of the base, which names nothing.
        own = None
    if own != name:
        raise NoPlugin(f"its {called} is {own!r}, expected the entry point's name")
    return found
