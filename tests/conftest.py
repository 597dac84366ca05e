"""Specimens, models and made-up packages the tests share; models are cached in a folder of the test run."""

import gc
import os
import signal
import subprocess
import sys
from dataclasses import replace

import numpy as np
import pytest
import warm_processes
from hypothesis import settings
from paper_law import TABLE_4
from plugin_sites import describe

from fitting import plugins
from fitting.discrepancy import model_error
from fitting.discrepancy.mesh_error import MeshError
from fitting.laws.constant import ConstantModulus
from fitting.plate.plate import Plate
from fitting.reduced.domain import domain_of
from fitting.specimen import PlateSpecimen
from fitting.stated.layers import Core, Face
from instrument.files.specimen_file import read_specimen
from instrument.files.sweep_file import read_sweep
from instrument.models.specimen_models import Models
from instrument.paper_case import case_file
from instrument.processes.other_processes import VARIABLE as PROCESSES

settings.register_profile("ci", deadline=None, max_examples=40, derandomize=True)
settings.load_profile("ci")

if signal.getsignal(signal.SIGINT) == signal.SIG_IGN:
    # A run in the background of a shell ignores Ctrl-C, and so would every command it starts.
    signal.signal(signal.SIGINT, signal.default_int_handler)


@pytest.hookimpl(wrapper=True)
def pytest_collection():
    """Modules and collected tests are there to stay: the collector walks through them once, at the end."""
    gc.disable()
    try:
        return (yield)
    finally:
        gc.enable()
        gc.collect()
        gc.freeze()


@pytest.fixture(scope="session", autouse=True)
def cache_of_this_run(tmp_path_factory):
    folder = tmp_path_factory.getbasetemp()
    if "PYTEST_XDIST_WORKER" in os.environ:
        folder = folder.parent
    os.environ["VISCORIG_CACHE"] = str(folder / "cache")
    # The tests fill both processors by themselves.
    os.environ[PROCESSES] = "1"


@pytest.fixture(scope="session")
def forking():
    with warm_processes.forking():
        yield


@pytest.fixture(scope="module")
def warm(forking):
    """Processes begin with everything loaded, unless a test asks for `cold`."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(subprocess, "Popen", warm_processes.Popen)
        yield


@pytest.fixture
def cold(monkeypatch):
    monkeypatch.delenv(warm_processes.FORK_AT, raising=False)


@pytest.fixture(scope="session")
def zn1() -> PlateSpecimen:
    return read_specimen(case_file("zn1.toml"))


@pytest.fixture(scope="session")
def zn1_table4(zn1) -> PlateSpecimen:
    return zn1.with_law(TABLE_4)


@pytest.fixture(scope="session")
def coarse(zn1) -> PlateSpecimen:
    """The paper's plate on its own 10 x 10 mesh: quick."""
    return replace(zn1, elements=(10, 10))


@pytest.fixture(scope="module")
def mesh_is_right():
    """A coarse mesh is taken as exact: where data are of the very same one, or nothing is said of them."""

    def right(specimen, wavenumber, G):
        return MeshError(*np.zeros((4, len(wavenumber))))

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(model_error, "mesh_error", right)
        patch.setattr(model_error, "beside_edges", lambda specimen, G, **_: (np.zeros(len(G)),) * 2)
        yield


@pytest.fixture(scope="session")
def coarse_plate(coarse) -> Plate:
    return Plate(coarse)


@pytest.fixture(scope="session")
def zn1_plate(zn1) -> Plate:
    return Plate(zn1)


@pytest.fixture(scope="session")
def table5(zn1):
    return read_sweep(case_file("table5.csv")).sweep(zn1.base_acceleration_m_s2)


@pytest.fixture(scope="session")
def zn1_models(zn1, table5) -> Models:
    return Models(zn1, domain_of(zn1, table5.frequency_hz))


@pytest.fixture(scope="session")
def johnson_kienholz() -> PlateSpecimen:
    """Simply supported sandwich plate, Johnson and Kienholz 1982."""
    face = Face(thickness_m=0.762e-3, young_pa=68.9e9, poisson=0.3, density_kg_m3=2740.0)
    core = Core(0.254e-3, 0.49, 999.0, ConstantModulus(0.896e6, 0.5))
    return PlateSpecimen(0.348, 0.3048, "simply-supported", face, face, core)


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
