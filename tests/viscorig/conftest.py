"""Objects of the front door that several tests look at, made once; plots without a screen."""

import json

import matplotlib as mpl
import pytest
from data_folder import DATA
from session_cases import session_path as session_path

import viscorig as vr
from instrument.cli.main import run


@pytest.fixture(autouse=True)
def _without_a_screen():
    from matplotlib import pyplot

    mpl.use("Agg")
    yield
    pyplot.close("all")


@pytest.fixture
def command(capsys):
    """The JSON of a command."""

    def call(*arguments):
        status = run([*(str(a) for a in arguments), "--json", "-"])
        captured = capsys.readouterr()
        assert status == 0, captured.err
        return json.loads(captured.out)

    return call


@pytest.fixture(scope="session")
def plate():
    """On the paper's own mesh: quick."""
    return vr.load_specimen(DATA / "numbers" / "coarse.toml")


@pytest.fixture(scope="session")
def sweep(plate):
    return vr.load_sweep(vr.example_file("table5.csv"), plate)


@pytest.fixture(scope="session")
def found(sweep, plate):
    return vr.identify(sweep, plate)
