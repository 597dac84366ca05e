"""Other processes beside the first: the same answers, whoever gives them, and whatever becomes of them."""

import os
from signal import SIG_BLOCK, SIGINT, SIGKILL, SIGQUIT, pthread_sigmask

import pytest
from squares import Squares

from fitting.diagnosis.executor import ALONE
from fitting.errors import OutsideModel
from instrument.errors import BadInput
from instrument.processes import other_processes
from instrument.processes.other_processes import VARIABLE, SeveralProcesses, end_all, learn, wanted


@pytest.fixture(scope="module")
def two():
    with SeveralProcesses(1) as executor:
        yield executor


@pytest.fixture(scope="module")
def three():
    with SeveralProcesses(2) as executor:
        yield executor


@pytest.mark.parametrize("several", ["two", "three"])
def test_answers_come_in_order_whoever_gives_them(request, several):
    numbers = list(range(200))
    executors = ALONE, request.getfixturevalue(several)
    alone, shared = (list(executor.map(Squares().square, numbers)) for executor in executors)
    assert [a for a, _ in shared] == [a for a, _ in alone] == [n**2 for n in numbers]
    assert {pid for _, pid in alone} == {os.getpid()}


def test_a_ctrl_c_while_another_process_loads_does_not_reach_it(capfd):
    with SeveralProcesses(1) as executor:
        pool = executor._others[0].pool
        (pid,) = pool._processes
        for number in (SIGINT, SIGQUIT):
            os.kill(pid, number)
        assert pool.submit(os.getpid).result() == pid
    assert not pthread_sigmask(SIG_BLOCK, ()) & {SIGINT, SIGQUIT}
    assert capfd.readouterr().err == ""


def test_several_methods_of_one_object_are_asked_in_one_go(two):
    squares = Squares()
    calls = [(squares.square, (3,)), (squares.niceness, (0,)), (squares.square, (4,))]
    for executor in (ALONE, two):
        (nine, _), nice, (sixteen, _) = executor.together(calls)
        assert (nine, sixteen) == (9, 16)
        assert nice in (os.nice(0), min(19, os.nice(0) + 10))


@pytest.mark.parametrize(("several", "count"), [("two", 2), ("three", 3)])
def test_every_process_takes_its_share(request, several, count):
    executor = request.getfixturevalue(several)

    def until_shared():
        for _ in range(200):
            if len({pid for _, pid in executor.map(Squares().square, list(range(500)))}) == count:
                return True
        return False

    assert until_shared()


def test_another_process_lets_others_go_first(two):
    own = os.nice(0)
    seen: set[int] = set()
    for _ in range(100):
        seen |= set(two.map(Squares().niceness, list(range(500))))
        if len(seen) == 2:
            break
    assert seen == {own, min(19, own + 10)}


def test_progress_ends_at_one(two):
    told = []
    list(two.map(Squares().square, list(range(20)), told.append))
    assert told == sorted(told)
    assert told[-1] == 1.0


def test_a_refusal_reaches_the_caller(two):
    with pytest.raises(OutsideModel, match="not"):
        list(two.map(Squares().refuse, list(range(20))))


@pytest.mark.parametrize("others", [1, 2])
def test_processes_that_are_killed_leave_their_work_to_the_first(others):
    with SeveralProcesses(others) as executor:
        for _ in range(3):
            found = list(executor.map(Squares().end_the_other, [os.getpid()] * 50))
            assert found == [os.getpid()] * 50


def test_of_several_one_that_is_killed_leaves_its_work_to_the_rest():
    squares = Squares()
    with SeveralProcesses(2) as executor:
        executor._others[0].pool.submit(os.kill, next(iter(executor._others[0].pool._processes)), SIGKILL)
        for _ in range(3):
            assert [n for n, _ in executor.map(squares.square, list(range(50)))] == [n**2 for n in range(50)]


def test_a_process_that_is_replaced_is_told_anew(two):
    squares = Squares()

    def shared_by_two():
        return any(
            len({pid for _, pid in two.map(squares.square, list(range(500)))}) == 2 for _ in range(100)
        )

    assert shared_by_two()
    # What a new process knows, where loky puts one in the place of another whose memory has grown.
    two._others[0].pool.submit(learn, 0, None).result()
    assert shared_by_two()


def test_what_is_given_up_leaves_no_process_behind():
    with SeveralProcesses(1) as executor:
        (pool,) = [other.pool for other in executor._others]
        # One that never comes to an end: whoever waited for it would wait for ever.
        given_up = pool.submit(Squares().wait_in_the_other, os.getpid())
        pids = list(pool._processes)
        end_all()
        assert given_up.exception(timeout=60) is not None
        for pid in pids:
            with pytest.raises(ProcessLookupError):
                os.kill(pid, 0)


@pytest.mark.parametrize(
    ("there", "said", "most", "taken"),
    [
        (1, "", 4, 1),
        (2, "", 4, 2),
        (16, "", 4, 4),
        (16, "", None, 16),
        (2, "1", None, 1),
        (2, "6", 4, 6),
    ],
)
def test_as_many_as_there_are_processors_or_as_it_is_told(monkeypatch, there, said, most, taken):
    monkeypatch.setattr(other_processes, "processors", lambda: there)
    monkeypatch.setenv(VARIABLE, said)
    assert wanted(most) == taken


@pytest.mark.parametrize("said", ["0", "-1", "two", "1.5"])
def test_what_is_no_number_of_processes_is_refused(monkeypatch, said):
    monkeypatch.setenv(VARIABLE, said)
    with pytest.raises(BadInput, match=r"VISCORIG_PROCESSES is '.*', not a number of processes"):
        wanted()
