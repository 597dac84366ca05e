import pytest
from pydantic import ValidationError

from drivers.options import DeviceOptions


@pytest.mark.parametrize(("address", "own"), [("simulated", False), ("-", False), ("10.0.0.7:502", True)])
def test_only_an_address_of_the_device_itself_is_judged(address, own):
    assert DeviceOptions(kind="a", address=address).is_addressed is own


@pytest.mark.parametrize(
    "table", [{"kind": "a"}, {"kind": "a", "address": 5}, {"kind": "a", "address": "b", "x": 1}]
)
def test_a_key_that_is_missing_of_another_type_or_unknown_is_refused(table):
    with pytest.raises(ValidationError):
        DeviceOptions.model_validate(table)
