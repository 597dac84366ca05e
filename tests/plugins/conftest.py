"""Packages that add something, installed for a test."""

import sys

import pytest
from plugin_sites import EXAMPLES, describe, install, python

from fitting import plugins


@pytest.fixture
def nothing_told(monkeypatch):
    """Installed packages are looked at anew, before and after."""
    monkeypatch.setenv(plugins.TOLD, "")
    plugins.entries.cache_clear()
    yield
    plugins.entries.cache_clear()


@pytest.fixture
def package(nothing_told, tmp_path, monkeypatch):
    """Adds an installed package: its name, its one module's text, and its entry points."""
    site = tmp_path / "site"
    site.mkdir()
    monkeypatch.syspath_prepend(site)

    def add(name: str, text: str, **named: dict[str, str]) -> None:
        module = f"plugin_{name.replace('-', '_')}"
        (site / f"{module}.py").write_text(text)
        monkeypatch.delitem(sys.modules, module, raising=False)
        groups = {f"viscorig.{group}": entries for group, entries in named.items()}
        places = {g: {e: f"{module}:{attribute}" for e, attribute in n.items()} for g, n in groups.items()}
        describe(site, name, "1.2", places)
        plugins.entries.cache_clear()

    return add


@pytest.fixture(scope="session")
def site(tmp_path_factory):
    """Both examples, installed."""
    folder = tmp_path_factory.mktemp("site")
    for name in ("viscorig_example_plugin", "driver_template"):
        install(EXAMPLES / name, folder)
    return folder


@pytest.fixture
def viscorig(site, tmp_path):
    """Runs the command with the examples installed, in the test's folder."""
    return lambda *arguments: python(site, tmp_path, "-m", "instrument.cli", *arguments)
