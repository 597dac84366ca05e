"""Models kept on disk, named by a digest of everything they depend on.

A file that is damaged, of another version or not writable is never an error: the model is built again.
"""

import hashlib
import json
import os
import re
import tempfile
from collections.abc import Callable, Sequence
from dataclasses import asdict
from functools import cache
from importlib.util import find_spec
from pathlib import Path
from typing import Any, TypeVar

import numpy as np
import platformdirs
import scipy

import fitting
from instrument.models.arrays import pack, unpack

T = TypeVar("T")


def cache_folder() -> Path:
    """`VISCORIG_CACHE`, or the user's cache folder."""
    return Path(os.environ.get("VISCORIG_CACHE") or platformdirs.user_cache_dir("viscorig"))


def cached(
    name: str, depends_on: Any, cls: type[T], build: Callable[[], T], modules: Sequence[str] = ()
) -> T:
    """A `cls` from the cache, or built and kept.

    `depends_on` is anything JSON or dataclasses can say; the sources of the module that `cls` is from count
    too, and those of further `modules`.
    """
    digest = _digest([name, depends_on], (cls.__module__, *modules))
    path = cache_folder() / f"{name}-{digest[:32]}.npz"
    found = _load(path, digest, cls)
    if found is None:
        found = build()
        _store(path, digest, found)
        # As every later use will find it: arrays in another order in memory round in another way.
        found = _load(path, digest, cls) or found
    return found


def _load(path: Path, digest: str, cls: type[T]) -> T | None:
    try:
        with open(path, "rb") as opened, np.load(opened, allow_pickle=False) as file:
            packed = {key: file[key] for key in file.files}
        if str(packed.pop("digest")[()]) != digest:
            return None
        return unpack(cls, packed)
    except Exception:  # whatever a damaged file makes a reader raise, the answer is to build again
        return None


def _store(path: Path, digest: str, value: Any) -> None:
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        # Written beside and renamed: a reader sees the whole file or none.
        with tempfile.NamedTemporaryFile(dir=path.parent, suffix=".tmp", delete=False) as file:
            arrays: dict[str, Any] = {"digest": np.asarray(digest), **pack(value)}
            try:
                np.savez(file, **arrays)
            except OSError:
                os.unlink(file.name)
                raise
        os.replace(file.name, path)
    except OSError:
        return


def _digest(depends_on: Any, modules: tuple[str, ...]) -> str:
    said = json.dumps(
        [_sources(modules), np.__version__, scipy.__version__, depends_on], default=_plain, sort_keys=True
    )
    return hashlib.sha256(said.encode()).hexdigest()


def _plain(value: Any) -> Any:
    return [type(value).__name__, asdict(value)] if hasattr(value, "__dataclass_fields__") else value.tolist()


@cache
def _sources(modules: tuple[str, ...]) -> str:
    """A digest of the code that builds models: an older version's files are stale.

    Of some modules of `fitting` and all that they import from it, not of those that only use models. Of a
    module from elsewhere, an effect that another package adds, its whole package and what that imports.
    """
    folder = Path(fitting.__file__).parent
    digest, left, asked, seen = hashlib.sha256(), list(modules), set[str](), set[Path]()
    while left:
        module = left.pop()
        if module in asked:
            # What many import is looked for once: looking takes longer than reading.
            continue
        asked.add(module)
        for path in _files(folder, module):
            if path not in seen:
                seen.add(path)
                left += _IMPORTED.findall(path.read_text(encoding="utf-8"))
    for path in sorted(seen):
        digest.update(path.read_bytes())
    return digest.hexdigest()


_IMPORTED = re.compile(r"^from (fitting[\w.]*) import", re.MULTILINE)


def _files(folder: Path, module: str) -> list[Path]:
    if module.partition(".")[0] != fitting.__name__:
        return _elsewhere(module.partition(".")[0])
    place = folder.joinpath(*module.split(".")[1:])
    found = [place.with_suffix(".py"), place / "__init__.py"]
    return [path for path in found if path.is_file()]


def _elsewhere(package: str) -> list[Path]:
    """Every source of another package, or the file of a module that stands alone."""
    spec = find_spec(package)
    if spec is None:
        return []
    if spec.submodule_search_locations is not None:
        return sorted(path for place in spec.submodule_search_locations for path in Path(place).rglob("*.py"))
    return [Path(spec.origin)] if spec.origin is not None and Path(spec.origin).is_file() else []
