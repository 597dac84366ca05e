from dataclasses import dataclass

import numpy as np
import pytest
from numpy.typing import NDArray

from fitting.reduced.rational import RationalSweep
from instrument.models import cache
from instrument.models.arrays import pack, unpack


@dataclass(frozen=True)
class Inner:
    band: tuple[float, float]
    z: complex


@dataclass(frozen=True)
class Kept:
    x: NDArray[np.float64]
    n: float
    inner: Inner


VALUE = Kept(np.arange(3.0), 2.5, Inner((1.0, 2.0), 1 + 2j))


class Builder:
    def __init__(self):
        self.built = 0

    def __call__(self):
        self.built += 1
        return VALUE


@pytest.fixture
def folder(tmp_path, monkeypatch):
    monkeypatch.setenv("VISCORIG_CACHE", str(tmp_path / "cache"))
    return tmp_path / "cache"


def same(value):
    return np.array_equal(value.x, VALUE.x) and value.n == VALUE.n and value.inner == VALUE.inner


def test_dataclasses_of_arrays_come_back_from_flat_arrays():
    packed = pack(VALUE)
    assert set(packed) == {"x", "n", "inner.band", "inner.z"}
    assert same(unpack(Kept, packed))


def test_what_a_model_keeps_as_it_is_used_is_no_part_of_it():
    sweep = RationalSweep(np.array([1.0]), 1e6 + 0j, np.ones((1, 2), complex), np.full((1, 2), 1e-6 + 0j))
    before = sweep.with_derivative(np.array([1e6 + 1e5j]))
    packed = pack(sweep)
    assert set(packed) == {"omega", "G_ref", "c", "mu"}
    again = unpack(RationalSweep, packed).with_derivative(np.array([1e6 + 1e5j]))
    np.testing.assert_array_equal(again, before)


def test_second_use_does_not_build_again(folder):
    build = Builder()
    assert all(same(cache.cached("kept", {"a": 1}, Kept, build)) for _ in range(2))
    assert build.built == 1


def test_other_dependencies_build_their_own(folder):
    build = Builder()
    cache.cached("kept", {"a": 1}, Kept, build)
    cache.cached("kept", {"a": 2}, Kept, build)
    assert build.built == 2


@pytest.mark.parametrize("damage", ["truncated", "flipped", "empty", "text", "stale"])
def test_damaged_or_stale_file_is_built_again(folder, damage):
    build = Builder()
    cache.cached("kept", 1, Kept, build)
    (path,) = folder.iterdir()
    data = bytearray(path.read_bytes())
    if damage == "truncated":
        path.write_bytes(data[: len(data) // 2])
    elif damage == "flipped":
        middle = data.index(b"\x00" * 6 + b"\xf0?")  # the array's 1.0
        data[middle] ^= 0xFF
        path.write_bytes(data)
    elif damage == "empty":
        path.write_bytes(b"")
    elif damage == "text":
        path.write_text("no cache")
    else:
        np.savez(path, digest=np.asarray("of another version"), **pack(VALUE))
    assert same(cache.cached("kept", 1, Kept, build))
    assert build.built == 2
    assert same(cache.cached("kept", 1, Kept, build))
    assert build.built == 2


def test_pickled_content_is_not_loaded(folder):
    build = Builder()
    cache.cached("kept", 1, Kept, build)
    (path,) = folder.iterdir()
    np.savez(path, digest=np.asarray("x"), x=np.array([{"a": 1}], dtype=object))
    cache.cached("kept", 1, Kept, build)
    assert build.built == 2


def test_unwritable_folder_is_no_error(tmp_path, monkeypatch):
    (tmp_path / "file").write_text("not a folder")
    monkeypatch.setenv("VISCORIG_CACHE", str(tmp_path / "file" / "cache"))
    build = Builder()
    assert same(cache.cached("kept", 1, Kept, build))


def test_changed_sources_make_other_files(folder, monkeypatch):
    build = Builder()
    cache.cached("kept", 1, Kept, build)
    monkeypatch.setattr(cache, "_sources", lambda modules: "changed")
    cache.cached("kept", 1, Kept, build)
    assert build.built == 2


@pytest.fixture
def sources(tmp_path, monkeypatch):
    """A few modules: `a` imports `b`, `b` a package that imports `c`; `d` stands alone."""
    package = tmp_path / "fitting"
    (package / "effects").mkdir(parents=True)
    (package / "__init__.py").write_text("")
    (package / "a.py").write_text("from fitting.b import one\n")
    (package / "b.py").write_text("import numpy as np\nfrom fitting.effects import CATALOGUE\n")
    (package / "effects" / "__init__.py").write_text("from fitting.c import two\n")
    (package / "c.py").write_text("two = 2\n")
    (package / "d.py").write_text("three = 3\n")
    monkeypatch.setattr(cache.fitting, "__file__", str(package / "__init__.py"))
    return package


def digest(*modules):
    return cache._sources.__wrapped__(modules)


@pytest.mark.parametrize(
    ("changed", "counts"),
    [("a.py", True), ("b.py", True), ("effects/__init__.py", True), ("c.py", True), ("d.py", False)],
)
def test_sources_are_a_module_and_all_that_it_imports(sources, changed, counts):
    before = digest("fitting.a")
    (sources / changed).write_text((sources / changed).read_text() + "# another version\n")
    assert (digest("fitting.a") != before) == counts


def test_further_modules_count_too(sources):
    before = digest("fitting.a", "fitting.d")
    (sources / "d.py").write_text("three = 4\n")
    assert digest("fitting.a", "fitting.d") != before
    assert digest("fitting.a") != digest("fitting.a", "fitting.d")


def test_of_another_packages_effect_the_whole_package_counts(sources, tmp_path, monkeypatch):
    package = tmp_path / "another_package"
    package.mkdir()
    (package / "__init__.py").write_text("")
    (package / "effect.py").write_text("from fitting.d import three\n")
    (package / "helper.py").write_text("")
    monkeypatch.syspath_prepend(tmp_path)
    seen = [digest("fitting.a", "another_package.effect")]
    for changed in (package / "helper.py", sources / "d.py"):
        changed.write_text(changed.read_text() + "# another version\n")
        seen.append(digest("fitting.a", "another_package.effect"))
    assert len(set(seen)) == 3
