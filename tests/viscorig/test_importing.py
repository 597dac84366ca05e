"""`import viscorig`: at once, with every name in sight, loaded when it is used."""

import ast
import runpy
import subprocess
import sys
from importlib.metadata import version
from pathlib import Path
from statistics import median

import pytest

import viscorig as vr

LIMIT_S = 0.3


def python(code, folder):
    """What a fresh process prints that was not started in the repository."""
    done = subprocess.run(
        [sys.executable, "-c", code], cwd=folder, capture_output=True, text=True, timeout=60
    )
    assert done.returncode == 0, done.stderr
    return done.stdout.strip()


@pytest.mark.timing
def test_it_is_imported_at_once(tmp_path):
    code = "from time import perf_counter as t; a = t(); import viscorig; print(t() - a)"
    assert median(float(python(code, tmp_path)) for _ in range(7)) < LIMIT_S


def test_importing_it_loads_nothing_heavy(tmp_path):
    heavy = {"numpy", "scipy", "matplotlib", "pandas", "h5py", "pydantic", "fitting", "instrument", "drivers"}
    loaded = python("import sys, viscorig; print(*sys.modules)", tmp_path).split()
    assert not heavy & set(loaded)


def test_nothing_is_drawn_until_it_is_asked_for(tmp_path):
    loaded = python("import sys, viscorig as vr; vr.identify, vr.Rig; print(*sys.modules)", tmp_path).split()
    assert "matplotlib" not in loaded
    assert "pandas" not in loaded


@pytest.mark.parametrize("name", vr.__all__)
def test_every_public_name_is_there(name):
    assert getattr(vr, name) is getattr(vr, name)
    assert name in dir(vr)


def test_type_checkers_see_the_same_names():
    tree = ast.parse(Path(vr.__file__).read_text(encoding="utf-8"))
    (block,) = (node for node in tree.body if isinstance(node, ast.If))
    seen = {alias.name for node in block.body if isinstance(node, ast.ImportFrom) for alias in node.names}
    assert seen | {"__version__"} == set(vr.__all__)
    assert Path(vr.__file__).with_name("py.typed").exists()


def test_every_name_but_two_has_a_home_and_no_other_name_has_one():
    homes = [name for names in vr._HOMES.values() for name in names]
    assert sorted([*homes, "__version__", "errors"]) == sorted(vr.__all__)


def test_another_name_is_refused_as_python_does():
    with pytest.raises(AttributeError, match="has no attribute 'identifi'"):
        vr.identifi  # noqa: B018


def test_its_version_is_the_distributions():
    assert vr.__version__ == version("viscorig")


def test_errors_are_the_projects_own():
    from fitting.errors import OutsideModel
    from instrument.errors import BadInput

    assert vr.errors.BadInput is BadInput
    assert vr.errors.OutsideModel is OutsideModel
    assert all(issubclass(getattr(vr.errors, name), Exception) for name in vr.errors.__all__)


def test_an_example_that_is_not_there_is_refused():
    with pytest.raises(vr.errors.BadInput, match=r"zn1\.toml"):
        vr.example_file("zn2.toml")


def test_the_package_runs_as_the_command(monkeypatch, capsys):
    monkeypatch.setattr(sys, "argv", ["viscorig", "--version"])
    # This process does not end with it, and goes on to hear Ctrl-C.
    monkeypatch.setattr("instrument.cli.main.hear_no_more", lambda **_: None)
    with pytest.raises(SystemExit) as ended:
        runpy.run_module("viscorig.__main__", run_name="__main__")
    assert ended.value.code == 0
    assert "version" in capsys.readouterr().out
