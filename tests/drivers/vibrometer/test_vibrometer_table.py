"""`[vibrometer]` of RIG.toml: what it refuses, and what is known of a model before it is opened."""

from itertools import pairwise
from types import SimpleNamespace

import pytest
from pydantic import ValidationError

from drivers.errors import Missing
from drivers.vibrometer.driver import VibrometerDriver, VibrometerOptions
from drivers.vibrometer.interface import Range
from drivers.vibrometer.polytec_driver import PolytecDriver, PolytecOptions
from drivers.vibrometer.polytec_models import MODELS


@pytest.mark.parametrize("change", [{"model": "OFV-1"}, {"reads": "both"}, {"baud": 0}])
def test_what_no_vibrometer_is_is_refused(change):
    with pytest.raises(ValidationError, match=next(iter(change))):
        PolytecOptions.model_validate({"address": "/dev/ttyS9"} | change)


@pytest.mark.parametrize("model", MODELS)
def test_a_models_ranges_are_known_without_it_from_the_most_sensitive_on(model):
    options = PolytecOptions(address="/dev/ttyS9", model=model)
    assert options.model_name == model
    ranges = PolytecDriver().ranges(options)
    assert ranges == MODELS[model].ranges
    assert all(one.full_scale_m_s <= other.full_scale_m_s for one, other in pairwise(ranges))


def test_full_scale_is_the_velocity_at_the_most_volts():
    assert Range("20 mm/s/V", 0.02, 10.0, 20e3, None, verified=True).full_scale_m_s == pytest.approx(0.2)


@pytest.mark.parametrize("model", MODELS)
def test_a_simulated_polytec_chooses_a_range_at_its_beginning_and_answers(model):
    chosen = []
    optics = SimpleNamespace(signal_level=0.7, choose=chosen.append)
    driver, options = PolytecDriver(), PolytecOptions(address="simulated", model=model)
    assert driver.can_be_simulated
    with driver.simulated(options, optics) as port:
        assert [r.name for r in chosen] == ["5mm/s/V"]
        vibrometer = driver.open(options.model_copy(update={"address": port}))
        assert vibrometer.range() in driver.ranges(options)
        vibrometer.close()


def test_a_driver_without_a_simulated_one_says_so():
    class Plain(VibrometerDriver[VibrometerOptions]):
        pass

    class Playing(Plain):
        def simulated(self, options, optics):
            return optics

    assert Playing().can_be_simulated
    assert not Plain().can_be_simulated
    with pytest.raises(Missing, match=r"^vibrometer own: its driver brings no simulated one$"):
        Plain().simulated(VibrometerOptions(kind="own", address="simulated"), None)
