"""A second process beside the first: the same answers, whoever gives them, and whatever becomes of it."""

import os

import pytest
from squares import Squares

from fitting.diagnosis.executor import ALONE
from fitting.errors import OutsideModel
from instrument.models.second_process import TwoProcesses, _learn


@pytest.fixture(scope="module")
def two():
    with TwoProcesses() as executor:
        yield executor


def test_answers_come_in_order_whoever_gives_them(two):
    numbers = list(range(200))
    alone, shared = (list(executor.each(Squares().square, numbers)) for executor in (ALONE, two))
    assert [a for a, _ in shared] == [a for a, _ in alone] == [n**2 for n in numbers]
    assert {pid for _, pid in alone} == {os.getpid()}


def test_several_methods_of_one_object_are_asked_in_one_go(two):
    squares = Squares()
    calls = [(squares.square, 3), (squares.niceness, 0), (squares.square, 4)]
    for executor in (ALONE, two):
        (nine, _), nice, (sixteen, _) = executor.together(calls)
        assert (nine, sixteen) == (9, 16)
        assert nice in (os.nice(0), min(19, os.nice(0) + 10))


def test_the_second_process_takes_its_share(two):
    def until_shared():
        for _ in range(100):
            if len({pid for _, pid in two.each(Squares().square, list(range(500)))}) == 2:
                return True
        return False

    assert until_shared()


def test_the_second_process_lets_others_go_first(two):
    own = os.nice(0)
    seen: set[int] = set()
    for _ in range(100):
        seen |= set(two.each(Squares().niceness, list(range(500))))
        if len(seen) == 2:
            break
    assert seen == {own, min(19, own + 10)}


def test_progress_ends_at_one(two):
    told = []
    list(two.each(Squares().square, list(range(20)), told.append))
    assert told == sorted(told)
    assert told[-1] == 1.0


def test_a_refusal_reaches_the_caller(two):
    with pytest.raises(OutsideModel, match="not"):
        list(two.each(Squares().refuse, list(range(20))))


def test_a_second_process_that_is_killed_leaves_its_work_to_the_first():
    with TwoProcesses() as executor:
        for _ in range(3):
            found = list(executor.each(Squares().end_the_other, [os.getpid()] * 50))
            assert found == [os.getpid()] * 50


def test_a_second_process_that_is_replaced_is_told_anew(two):
    squares = Squares()

    def shared_by_two():
        return any(
            len({pid for _, pid in two.each(squares.square, list(range(500)))}) == 2 for _ in range(100)
        )

    assert shared_by_two()
    # What a new process knows, where loky puts one in the place of another whose memory has grown.
    two._other.submit(_learn, 0, None).result()
    assert shared_by_two()
