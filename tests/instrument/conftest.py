"""What tests of figures and of sessions share."""

from pathlib import Path

import pytest
from matplotlib.figure import Figure
from session_cases import session_path as session_path
from sessions import contents_in


@pytest.fixture
def saved(monkeypatch):
    """Figures by the name of their files, none of them rendered."""
    figures = {}
    monkeypatch.setattr(Figure, "savefig", lambda f, path, **_: figures.setdefault(Path(path).name, f))
    return figures


@pytest.fixture(scope="module")
def contents(session_path):
    """Of that session."""
    return contents_in(session_path)
