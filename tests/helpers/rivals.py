"""Effects that a search looks at: what it costs goes with how many they are, hardly with the points."""

import pytest

from fitting.effects import CATALOGUE


def all_but(*names):
    """What to leave out where only these are looked at."""
    return set(CATALOGUE) - set(names)


def among(*rivals):
    """A test given `without`: the likeliest rivals are looked at, in the long tests the whole catalogue."""
    whole = pytest.param(set(), id="whole catalogue", marks=pytest.mark.long)
    return pytest.mark.parametrize("without", [pytest.param(all_but(*rivals), id="rivals"), whole])
