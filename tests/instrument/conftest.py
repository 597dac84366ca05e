"""What tests of figures share."""

from pathlib import Path

import pytest
from matplotlib.figure import Figure


@pytest.fixture
def saved(monkeypatch):
    """Figures by the name of their files, none of them rendered."""
    figures = {}
    monkeypatch.setattr(Figure, "savefig", lambda f, path, dpi: figures.setdefault(Path(path).name, f))
    return figures
