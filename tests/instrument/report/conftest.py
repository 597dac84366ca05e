"""One whole session, made once."""

import pytest
from session_cases import whole_session


@pytest.fixture(scope="session")
def session_path(tmp_path_factory):
    return whole_session(tmp_path_factory.mktemp("session"))
