"""A single effect that leads is tried in other places of its own."""

from types import SimpleNamespace

import numpy as np

from fitting.diagnosis.executor import ALONE
from fitting.diagnosis.search.catalogue_search import Search


class Placed:
    """Knows two other places."""

    replaces_law = False

    def elsewhere(self, plate, u):
        return [u + 1, u + 2]


def found(*effects):
    asked = []

    def fitted(*one):
        asked.append(one)
        return len(asked)

    search = SimpleNamespace(
        problem=SimpleNamespace(plate=None), executor=ALONE, work=SimpleNamespace(fit=fitted), judged=str
    )
    best = SimpleNamespace(effects=effects, law="law", z=np.zeros(2), of=lambda effect: np.array([5.0]))
    return Search.elsewhere(search, SimpleNamespace(fitted=best)), asked


def test_it_is_fitted_from_each_of_them_under_the_law_that_was_found():
    one = Placed()
    judged, asked = found(one)
    assert judged == ["1", "2"]
    assert [(effects, law, u.tolist()) for effects, law, u in asked] == [
        ([one], "law", [0, 0, 6]),
        ([one], "law", [0, 0, 7]),
    ]


def test_two_effects_stay_where_they_are():
    assert found(Placed(), Placed()) == ([], [])
