"""One coarse plate for all."""

import pytest
from solved_in_full import Full


@pytest.fixture(scope="session")
def full():
    return Full()
