"""A number that turned into another one on the disk is not read as data."""

import json

import h5py
import pytest
from session_cases import whole_session

from instrument.errors import BadInput
from instrument.session.contents import contents_of
from instrument.session.storage import SessionFile


def with_another_digit(path):
    """One digit of one event, its checksum as it was."""
    with h5py.File(path, "r+") as file:
        part = next(p for p in file["parts"].values() if any(b"PointMeasured" in e for e in p["events"][()]))
        events, sums = part["events"][()], dict(part["events"].attrs)
        k = next(k for k, e in enumerate(events) if b"PointMeasured" in e)
        digit = next(d for d in b"123456789" if bytes([d]) in events[k])
        events[k] = events[k].replace(bytes([digit]), bytes([digit ^ 1]), 1)
        part["events"][...] = events
        assert dict(part["events"].attrs) == sums


def read(path):
    with SessionFile(path) as file:
        return contents_of(file)


def test_a_digit_that_turned_is_said(tmp_path):
    path = whole_session(tmp_path)
    read(path)
    with_another_digit(path)
    with pytest.raises(BadInput, match="damaged: events: not as they were written"):
        read(path)


def test_a_block_that_claims_other_samples_than_are_there_is_said(tmp_path):
    path = whole_session(tmp_path)
    with h5py.File(path, "r+") as file:
        part = next(p for p in file["parts"].values() if "samples" in p)
        events = part["events"][()]
        k = max(k for k, e in enumerate(events) if b"BlockAcquired" in e)
        facts = json.loads(events[k])
        held = facts["samples"]
        events[k] = json.dumps(facts | {"samples": held + 1})
        part["events"][...] = events
        del part["events"].attrs["sha256"]
    with pytest.raises(BadInput, match=f"samples: {held} in a block of {held + 1}"):
        read(path)


def test_a_session_without_checksums_is_read(tmp_path):
    path = whole_session(tmp_path)
    before = read(path).measured
    with h5py.File(path, "r+") as file:
        for part in file["parts"].values():
            del part["events"].attrs["sha256"]
    assert read(path).measured == before
