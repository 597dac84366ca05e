"""What goes to a cluster together, and what alone."""

from hypothesis import given
from hypothesis import strategies as st

from instrument.batch.cluster import Bundles, outcomes_of
from instrument.batch.task import BatchTask

TASKS = [BatchTask(f"{k}.csv") for k in range(400)]


def taken(bundles, seconds, threads=2):
    """Every bundle, each of its rows taking so long."""
    while bundles:
        bundle = bundles.next(threads)
        bundles.took(len(bundle), seconds * len(bundle))
        yield bundle


@given(st.integers(0, 400), st.floats(0.0, 100.0), st.integers(1, 64))
def test_every_row_goes_out_once_and_in_order(rows, seconds, threads):
    bundles = taken(Bundles(TASKS[:rows]), seconds, threads)
    assert [task for bundle in bundles for task in bundle] == TASKS[:rows]


def test_short_rows_travel_together_up_to_a_second():
    sizes = [len(b) for b in taken(Bundles(TASKS), 0.2)]
    assert sizes[0] == 1
    assert max(sizes) == 5
    assert max(len(b) for b in taken(Bundles(TASKS), 1e-6)) == 8


def test_long_rows_and_the_last_ones_travel_alone():
    assert {len(b) for b in taken(Bundles(TASKS), 0.6)} == {1}
    assert [len(b) for b in taken(Bundles(TASKS), 0.01)][-10:] == [1] * 10


def test_one_slow_row_makes_the_next_bundle_small():
    bundles = Bundles(TASKS)
    bundles.took(1, 0.05)
    assert len(bundles.next(2)) == 8
    bundles.took(8, 8 * 2.0)
    assert len(bundles.next(2)) == 1


def test_rows_of_a_lost_worker_go_out_again_each_alone():
    bundles = Bundles(TASKS[:100])
    bundles.took(1, 0.05)
    lost = bundles.next(2)
    assert len(lost) > 1
    bundles.again(lost)
    again = [bundles.next(2) for _ in lost]
    assert all(len(bundle) == 1 for bundle in again)
    assert sorted(task.data for bundle in again for task in bundle) == sorted(task.data for task in lost)


def test_a_bundle_has_an_outcome_for_each_row_whatever_these_are():
    outcomes, seconds = outcomes_of([BatchTask("/nowhere/a.csv"), BatchTask("/nowhere/b.csv")])
    assert [outcome["failed"] is not None for outcome in outcomes] == [True, True]
    assert seconds > 0
