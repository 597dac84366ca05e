"""Held-out errors mean something where the other segments show the effect too."""

from types import SimpleNamespace as Of

import pytest

from instrument.results.foretelling import is_foretold


def found(name, equivalent=None, **values):
    parameters = {key: Of(value=value) for key, value in values.items()}
    points = [
        Of(segment=k, frequency_hz=f, file=k, pickup=k - 1)
        for k, each in ((1, (20.0, 25.0)), (2, (85.0, 125.0)))
        for f in each
    ]
    shown = (name,) if equivalent is None else equivalent
    return Of(points=points, effects=[Of(name=name, parameters=parameters)], equivalent=dict.fromkeys(shown))


@pytest.mark.parametrize(
    ("given", "said"),
    [
        (found("clamp_compliance", k=1e13), (True, True)),
        (found("segment_gain", **{"from": 85.0, "to": 125.0, "level": 0.0}), (True, False)),
        (found("added_mass", mass=0.02, file=1.0), (False, True)),
        (found("added_mass", mass=0.02, file=0.0), (True, True)),
        (found("temperature_difference", warmer=1.0, file=-1.0), (False, False)),
        (found("gain_error", factor=1.1, pickup=1.0), (True, False)),
        (found("gain_error", factor=1.1, pickup=-1.0), (True, True)),
        (found("fixture_resonance", (), **{"from": 20.0, "to": 125.0, "file": 1.0}), (True, True)),
    ],
)
def test_what_is_in_one_part_alone_is_not_foretold(given, said):
    assert (is_foretold(given, 1), is_foretold(given, 2)) == said
