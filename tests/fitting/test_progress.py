"""Work tells how far it is, and does the same where nobody listens."""

from fitting.diagnosis.executor import ALONE
from fitting.progress import Report, unheard


def test_work_that_nobody_watches_is_the_same_work():
    told = list[float]()
    report: Report = told.append
    watched = list(ALONE.map(str, [1, 2, 3, 4], report))
    assert watched == list(ALONE.map(str, [1, 2, 3, 4], unheard)) == ["1", "2", "3", "4"]
    assert told[-1] == 1.0
    assert told == sorted(told)
