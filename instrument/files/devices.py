"""`kind` in RIG.toml: which driver a device has, and what other keys its table has."""

import json
from collections.abc import Callable
from typing import Any, TypeVar

from pydantic import ValidationError, ValidationInfo, WrapValidator
from pydantic_core import InitErrorDetails, PydanticCustomError

from drivers.chamber.driver import AnyChamberDriver, ChamberDriver, ChamberOptions
from drivers.front_end.driver import AnyFrontEndDriver, FrontEndDriver, FrontEndOptions
from drivers.options import DeviceOptions
from drivers.shaker.driver import AnyShakerDriver, ShakerDriver, ShakerOptions
from drivers.vibrometer.driver import AnyVibrometerDriver, VibrometerDriver, VibrometerOptions
from drivers.vibrometer.interface import Range
from fitting.plugins import NoPlugin, Registry

T = TypeVar("T")


def _judge(base: type[T], options: type[DeviceOptions]) -> Callable[[str, Any], T]:
    def judge(name: str, found: Any) -> T:
        if not (isinstance(found, type) and issubclass(found, base)):
            raise NoPlugin(f"{found!r:.80} is no class derived from {base.__module__}.{base.__name__}")
        model = getattr(found, "options", None)
        if not (isinstance(model, type) and issubclass(model, options)):
            raise NoPlugin(f"its options are no model derived from {options.__module__}.{options.__name__}")
        return found()

    return judge


SHAKERS: Registry[AnyShakerDriver] = Registry(
    "viscorig.shakers",
    {
        "modbus-tcp": "drivers.shaker.modbus_driver:ModbusTcpDriver",
        "modbus-rtu": "drivers.shaker.modbus_driver:ModbusRtuDriver",
    },
    _judge(ShakerDriver, ShakerOptions),
)
VIBROMETERS: Registry[AnyVibrometerDriver] = Registry(
    "viscorig.vibrometers",
    {"polytec": "drivers.vibrometer.polytec_driver:PolytecDriver"},
    _judge(VibrometerDriver, VibrometerOptions),
)
FRONT_ENDS: Registry[AnyFrontEndDriver] = Registry(
    "viscorig.front_ends",
    {
        "lan-xi": "drivers.front_end.lan_xi_driver:LanXiDriver",
        "ni-daqmx": "drivers.front_end.ni_daqmx_driver:NiDaqmxDriver",
    },
    _judge(FrontEndDriver, FrontEndOptions),
)
CHAMBERS: Registry[AnyChamberDriver] = Registry(
    "viscorig.chambers",
    {
        "modbus-tcp": "drivers.chamber.modbus_driver:ModbusTcpChamberDriver",
        "modbus-rtu": "drivers.chamber.modbus_driver:ModbusRtuChamberDriver",
        "serial": "drivers.chamber.serial_driver:SerialThermometerDriver",
    },
    _judge(ChamberDriver, ChamberOptions),
)
DEVICES: dict[str, Registry[Any]] = {
    "shaker": SHAKERS,
    "vibrometer": VIBROMETERS,
    "front_end": FRONT_ENDS,
    "chamber": CHAMBERS,
}
"""Drivers by the table of RIG.toml that names them."""


_OPTIONS: dict[str, type[DeviceOptions]] = {
    "shaker": ShakerOptions,
    "vibrometer": VibrometerOptions,
    "front_end": FrontEndOptions,
    "chamber": ChamberOptions,
}
_USUAL = {device: options.model_fields["kind"].default for device, options in _OPTIONS.items()}


def ranges_of(table: VibrometerOptions) -> tuple[Range, ...]:
    """Of the vibrometer a rig file names, from the most sensitive to the coarsest."""
    return VIBROMETERS[table.kind].ranges(table)


def by_kind(device: str) -> WrapValidator:
    """Checks a device's table against the model of the driver that its `kind` names, a line for each key."""

    def checked(given: Any, _: object, info: ValidationInfo) -> DeviceOptions:
        return _checked(device, given, as_json=info.mode == "json")

    return WrapValidator(checked)


def _checked(device: str, given: Any, *, as_json: bool) -> DeviceOptions:
    if isinstance(given, DeviceOptions):
        return given
    if not isinstance(given, dict):
        raise ValueError("expected a table")
    options = options_of(device, given.get("kind"))
    if options is None:
        raise _unknown(device, given["kind"])
    # A session's JSON has no dates and no tuples: what is strict differs.
    return options.model_validate_json(json.dumps(given)) if as_json else options.model_validate(given)


def options_of(device: str, kind: object) -> type[DeviceOptions] | None:
    """The model of a device's table; None where no driver is of this kind. Nothing said is the usual kind."""
    named = _USUAL[device] if kind is None else kind
    driver = DEVICES[device].get(named) if isinstance(named, str) else None
    return None if driver is None else driver.options


def _unknown(device: str, kind: object) -> ValidationError:
    error = PydanticCustomError("kind", "{words}", {"words": DEVICES[device].expected(kind)})
    return ValidationError.from_exception_data(
        device, [InitErrorDetails(type=error, loc=("kind",), input=kind)]
    )
