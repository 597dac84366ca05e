"""The examples, installed for a test."""

import subprocess

import pytest
import warm_processes
from plugin_sites import EXAMPLES, install, python, python_path


@pytest.fixture(scope="session")
def site(tmp_path_factory):
    """Both examples, installed."""
    folder = tmp_path_factory.mktemp("site")
    for name in ("viscorig_example_plugin", "driver_template"):
        install(EXAMPLES / name, folder)
    return folder


@pytest.fixture(scope="module")
def warm_site(site):
    """Processes that find the examples begin with everything loaded, unless a test asks for `cold`."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("PYTHONPATH", python_path(site))
        with warm_processes.forking():
            patch.setattr(subprocess, "Popen", warm_processes.Popen)
            yield


@pytest.fixture
def viscorig(site, tmp_path):
    """Runs the command with the examples installed, in the test's folder."""
    return lambda *arguments: python(site, tmp_path, "-m", "instrument.cli", *arguments)
