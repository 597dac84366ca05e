"""Whether the instruments of RIG.toml answer: asked who they are and how they stand, no more."""

from collections.abc import Callable, Iterator

from drivers.errors import DriverError
from drivers.shaker import Shaker
from drivers.shaker.interface import Alarm
from instrument.facts.doctor import Finding
from instrument.files.devices import FRONT_ENDS, VIBROMETERS
from instrument.files.rig_file import RigDocument
from instrument.run.rig import open_chamber, open_shaker

_LEAST_LIGHT = 0.1
_CURES = {
    "shaker": "is it switched on, its cable in, its address and unit those of [shaker]?",
    "vibrometer": "is it switched on, the cable in, the port that of [vibrometer], and used by no other?",
    "chamber": "is it switched on, its address that of [chamber], its registers the maker's?",
    "front_end": "is it switched on, does `ping` reach it, is its address that of [front_end]?",
}


def visit(document: RigDocument) -> Iterator[Finding]:
    """One instrument after the other; one that does not answer stops none of the others."""
    looks: dict[str, Callable[[RigDocument], Finding]] = {
        "shaker": _shaker, "vibrometer": _vibrometer, "front_end": _front_end
    }  # fmt: skip
    if document.chamber is not None:
        looks["chamber"] = _chamber
    for name, look in looks.items():
        if document.is_simulated:
            said = "simulated: stood up for each run"
            yield Finding(group="instruments", name=name, state="good", found=said)
            continue
        try:
            yield look(document)
        except DriverError as error:
            yield _fault(name, str(error), _CURES[name])


def _shaker(document: RigDocument) -> Finding:
    shaker = open_shaker(document.shaker)
    try:
        return _shaker_stands(shaker)
    finally:
        shaker.close()


def _shaker_stands(shaker: Shaker) -> Finding:
    who, status = shaker.identity(), shaker.status()
    if status.alarm is not Alarm.NONE:
        return _fault("shaker", f"{who}: alarm {status.alarm.name}", "remove its cause and reset it")
    if status.interlock_open:
        return _fault("shaker", f"{who}: the interlock is open", "close it")
    limit = f"{who}, limit {status.limit_v:.3g} V"
    if status.running:
        said = f"{limit}: it is running"
        return Finding(group="instruments", name="shaker", state="remark", found=said, cure="stop it first")
    return _good("shaker", limit)


def _vibrometer(document: RigDocument) -> Finding:
    device = VIBROMETERS[document.vibrometer.kind].open(document.vibrometer)
    try:
        who, level = f"{device.identity()}, range {device.range().name}", device.signal_level()
    finally:
        device.close()
    found = f"{who}, light {level:.2f} of 1"
    if level < _LEAST_LIGHT:
        cure = "focus it; a dot of retro-reflective film on the spot"
        return Finding(group="instruments", name="vibrometer", state="remark", found=found, cure=cure)
    return _good("vibrometer", found)


def _front_end(document: RigDocument) -> Finding:
    return _good("front_end", FRONT_ENDS[document.front_end.kind].look(document.front_end))


def _chamber(document: RigDocument) -> Finding:
    device = open_chamber(document.chamber)
    assert device is not None
    try:
        return _good("chamber", f"{device.identity()}, {device.temperature_c():.1f} °C now")
    finally:
        device.close()


def _good(name: str, found: str) -> Finding:
    return Finding(group="instruments", name=name, state="good", found=found)


def _fault(name: str, found: str, cure: str) -> Finding:
    return Finding(group="instruments", name=name, state="fault", found=found, cure=cure)
