"""A process that lets others go first."""

import os

import pytest

from instrument.processes import background


def test_a_process_in_the_background_has_ten_steps_less_of_priority(monkeypatch):
    by = []
    monkeypatch.setattr(os, "nice", by.append)
    background.step_back()
    assert by == [10]


def test_where_the_system_knows_no_priorities_nothing_is_done(monkeypatch):
    monkeypatch.setattr(background.sys, "platform", "win32")
    monkeypatch.setattr(os, "nice", lambda by: pytest.fail("asked for a priority"))
    background.step_back()
