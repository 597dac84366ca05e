"""Heaps of strings that do not end are refused: the library would read them for ever."""

import h5py
import pytest
from session_cases import whole_session

from instrument.errors import BadInput
from instrument.session.heaps import check_heaps
from instrument.session.storage import SessionFile

HEAD_BYTES = 16


@pytest.fixture
def session(tmp_path):
    return whole_session(tmp_path).rename(tmp_path / "a.h5")


def heaps_of(path):
    """Where a file keeps strings."""
    content = path.read_bytes()
    at, found = content.find(b"GCOL"), []
    while at >= 0:
        found.append(at)
        at = content.find(b"GCOL", at + 1)
    return found


def spoilt(path, at, content):
    with path.open("r+b") as file:
        file.seek(at)
        file.write(content)


def events_of(path):
    with SessionFile(path) as file:
        return sum(1 for _ in file.events(with_samples=False))


def test_heaps_as_a_run_leaves_them_have_an_end(session):
    assert len(heaps_of(session)) > 1
    with h5py.File(session) as file:
        for part in file["parts"].values():
            check_heaps(part["events"])
    assert events_of(session) > 0


@pytest.mark.parametrize(
    "content", [bytes(HEAD_BYTES), bytes(8) + b"\xff" * 8], ids=["zeroed", "of any size"]
)
def test_an_object_that_leads_nowhere_is_refused(session, content):
    at = heaps_of(session)[-1]
    spoilt(session, at + HEAD_BYTES, content)
    with pytest.raises(BadInput, match=f"a.h5: damaged: its strings at byte {at} have no end"):
        events_of(session)


def test_what_is_no_heap_the_library_says(session):
    spoilt(session, heaps_of(session)[-1], b"HEAP")
    with pytest.raises(BadInput, match=r"a\.h5: damaged: "):
        events_of(session)


def test_strings_that_are_not_in_chunks_are_left_to_the_library(tmp_path):
    with h5py.File(tmp_path / "a.h5", "w") as file:
        file["plain"] = ["a", "b"]
        check_heaps(file["plain"])
