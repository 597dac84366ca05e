"""The examples, installed for a test."""

import pytest
from plugin_sites import EXAMPLES, install, python


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
