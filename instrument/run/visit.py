"""Whether the instruments of RIG.toml answer: asked who they are and how they stand, no more."""

from collections.abc import Callable, Iterator

from drivers.errors import DriverError
from drivers.front_end.interface import InputChannel
from drivers.shaker import Shaker
from drivers.shaker.interface import Alarm
from drivers.shaker.protocol import limit_objection
from instrument.facts.doctor import Finding
from instrument.files.devices import FRONT_ENDS, VIBROMETERS
from instrument.files.rig_file import RigDocument
from instrument.run.beats import LOST
from instrument.run.rig import open_chamber, open_shaker

_LEAST_LIGHT = 0.1
_NEARLY = 1.0 + 1e-6
"""A device's limit is a float32."""
_CURES = {
    "shaker": "is it switched on, its cable in, its address and unit (on a serial line baud and parity too) "
    "those of [shaker]?",
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
        return _shaker_stands(shaker, document.limits.drive_v)
    finally:
        shaker.close()


def _shaker_stands(shaker: Shaker, most_v: float) -> Finding:
    who, status = shaker.identity(), shaker.status()
    if status.alarm is not Alarm.NONE:
        return _fault("shaker", f"{who}: alarm {status.alarm.name}", "remove its cause and reset it")
    if status.interlock_open:
        return _fault("shaker", f"{who}: the interlock is open", "close it")
    if objection := limit_objection(status.limit_v):
        return _fault("shaker", f"{who}: {objection}", "set the device's own limit of the drive")
    limit = f"{who}, limit {status.limit_v:.3g} V"
    if status.running:
        return _remark("shaker", f"{limit}: it is running", "stop it first")
    if status.limit_v > _NEARLY * most_v:
        return _remark(
            "shaker",
            f"{limit}, above limits.drive_v = {most_v:g} V: it does not protect what this rig cannot bear",
            "set the device's own limit to that of [limits]",
        )
    if lost := status.lost_answers:
        said = f"{lost} answer{'' if lost == 1 else 's'} lost or damaged"
        return _remark("shaker", f"{limit}: {said}", LOST)
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
        return _remark("vibrometer", found, cure)
    return _good("vibrometer", found)


def _front_end(document: RigDocument) -> Finding:
    driver, options = FRONT_ENDS[document.front_end.kind], document.front_end
    who = driver.look(options)
    sensors = document.channels.named().items()
    channels = tuple(InputChannel(one.input, name, one.iepe, one.range_v) for name, one in sensors)
    if objection := driver.objection(options, channels):
        return _fault("front_end", f"{who}: {objection}", "change it in [front_end] or [channels]")
    return _good("front_end", who)


def _chamber(document: RigDocument) -> Finding:
    device = open_chamber(document.chamber)
    assert device is not None
    try:
        return _good("chamber", f"{device.identity()}, {device.temperature_c():.1f} °C now")
    finally:
        device.close()


def _good(name: str, found: str) -> Finding:
    return Finding(group="instruments", name=name, state="good", found=found)


def _remark(name: str, found: str, cure: str) -> Finding:
    return Finding(group="instruments", name=name, state="remark", found=found, cure=cure)


def _fault(name: str, found: str, cure: str) -> Finding:
    return Finding(group="instruments", name=name, state="fault", found=found, cure=cure)
