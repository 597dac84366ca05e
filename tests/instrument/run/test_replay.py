"""What a replay says of a derived event that is another one than recorded."""

import json
from dataclasses import dataclass

from instrument.run.replay import _first_difference
from instrument.stream.event import Derived


@dataclass(frozen=True)
class Found(Derived):
    number: int
    facts_json: str


def found(seconds, number=1):
    return Found(number, json.dumps({"verdict": "none", "next": [{"seconds": 1.0}, {"seconds": seconds}]}))


def test_the_innermost_place_is_named_not_the_same_begin_of_both():
    said = _first_difference(found(2.5), found(2.0))
    assert said == "Found.facts_json.next.1.seconds: 2.0 recorded, 2.5 computed"


def test_a_plain_field_is_named_by_itself():
    assert _first_difference(found(2.0, 3), found(2.0)) == "Found.number: 1 recorded, 3 computed"
