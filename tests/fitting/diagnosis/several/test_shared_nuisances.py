"""Stated numbers of several files as one set of unknowns."""

from types import SimpleNamespace

import numpy as np

from fitting.diagnosis.several.shared_nuisances import SharedNuisances


def test_a_hammer_test_feels_the_first_files_numbers_where_they_are_among_all():
    asked = []
    first = SimpleNamespace(of_bare_plate=[0, 2], bare_coefficients=lambda z: asked.append(z.tolist()))
    every = SharedNuisances(None, (), first=first, places=np.array([3, 0, 1]))
    assert every.of_bare_plate == [3, 1]
    every.bare_coefficients(np.array([10.0, 11.0, 12.0, 13.0]))
    assert asked == [[13.0, 10.0, 11.0]]
