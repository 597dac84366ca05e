"""What lies between files: of one of them, or of each but the first."""

import numpy as np
import pytest

from fitting.diagnosis.several.between_files import BetweenFiles
from fitting.diagnosis.several.effect_among_files import among
from fitting.diagnosis.several.of_files import EACH, Place
from fitting.effects import CATALOGUE

WARMER = CATALOGUE["temperature_difference"]
THREE = BetweenFiles(WARMER, 3, EACH)


def held(effect, files=3):
    return [k for k in range(1, files + 1) if effect.holds(Place(k))]


def test_any_file_may_be_the_odd_one_or_each_another():
    forms = among(WARMER, 3, ()).variants()
    assert [f.file for f in forms] == [EACH, 1, 2, 3]
    assert [held(f) for f in forms] == [[2, 3], [1], [2], [3]]
    assert all(f.objection(None, None) is None for f in forms)


def test_of_two_files_one_form_says_all():
    (form,) = among(WARMER, 2, ()).variants()
    assert (form.file, held(form, 2)) == (2, [2])
    assert [q.key for q in form.parameters] == ["warmer", "file"]


def test_one_file_alone_has_the_effect_that_objects():
    assert among(WARMER, 1, (0, 1)) is WARMER


def test_each_file_but_the_first_has_a_size_of_its_own():
    assert [q.key for q in THREE.parameters] == ["warmer", "warmer_3", "file"]
    assert (THREE.places(Place(2)).tolist(), THREE.places(Place(3)).tolist()) == ([0], [1])
    said = THREE.story({"warmer": 1.0, "warmer_3": -2.0, "file": EACH})
    assert said == (
        "in file 2 the core is 1 K warmer than in file 1, in file 3 the core is 2 K colder than in file 1"
    )
    assert BetweenFiles(WARMER, 3, 2).story({"warmer": 1.0, "file": 2}) == (
        "in file 2 the core is 1 K warmer than in the others"
    )


def test_it_begins_with_files_that_grow_warmer_and_with_either_sign():
    starts = np.array(THREE.starts(None, None))
    assert starts[:, -1].tolist() == [EACH] * len(starts)
    assert starts[0, :2] == pytest.approx([1.0, 2.0])
    # All of them alike would be the first one alone, the other way: a form of its own.
    assert not np.any(np.isclose(starts[:, 0], starts[:, 1]))
    assert len(BetweenFiles(WARMER, 4, EACH).starts(None, None)) == 4


def test_each_of_its_own_contains_one_alone():
    contained = {form.file: u.tolist() for form, u in THREE.within(np.array([3.0, 0.0, EACH]))}
    assert contained == {1: [-1.5, 1], 2: [3.0, 2], 3: [-1.5, 3]}
    assert BetweenFiles(WARMER, 3, 2).within(np.array([3.0, 2.0])) == ()
