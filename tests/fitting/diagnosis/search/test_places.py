"""Of many places where an effect may be, those that have come furthest after a few steps are followed."""

from types import SimpleNamespace

import numpy as np

from fitting.diagnosis.executor import ALONE
from fitting.diagnosis.search.singles import Singles
from fitting.diagnosis.search.tasks import FormStart
from fitting.diagnosis.thresholds import STARTS

MANY = 3 * STARTS.further_continued


class Work:
    """Chi-square falls by a tenth on the way; places are numbers, the better the lower."""

    def __init__(self):
        self.followed = []

    def set_out(self, form, start):
        _, place = start
        return SimpleNamespace(place=place, chi2=1.0 + place, gone_on=False)

    def go_on(self, form, begun, rival):
        self.followed.append((form, begun.place, rival))
        return SimpleNamespace(place=begun.place, chi2=0.9 * begun.chi2, gone_on=True)


def followed(asked):
    work = Work()
    search = SimpleNamespace(work=work, executor=ALONE, beside_the_law=[], effects=[])
    return Singles(search, lambda fraction: None)._followed(asked), work.followed


def asked_of(name, count, rival=np.inf):
    return [FormStart((name, 0), (9.0, place), rival) for place in reversed(range(count))]


def test_the_best_of_many_places_go_on_and_all_are_told_in_order():
    fits, on = followed(asked_of("mass", MANY))
    assert [f.place for f in fits] == list(reversed(range(MANY)))
    assert sorted(f.place for f in fits if f.gone_on) == list(range(STARTS.further_continued))
    assert len(on) == STARTS.further_continued


def test_each_effect_has_its_own_best_and_its_rival():
    fits, on = followed([*asked_of("mass", MANY, 5.0), *asked_of("strip", 4, 7.0)])
    assert sum(form == ("mass", 0) and rival == 5.0 for form, _, rival in on) == STARTS.further_continued
    assert sum(form == ("strip", 0) and rival == 7.0 for form, _, rival in on) == 4
    assert all(f.gone_on for f in fits[MANY:])
