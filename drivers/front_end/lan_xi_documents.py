"""What a LAN-XI recorder and its client tell each other in JSON. Documents to values and back, no I/O.

Everything is below `/rest/rec`. Requests and the states they need:

    GET  /module/info                                      any
    GET  /onchange?last=N                                  any
    PUT  /open                                             Idle -> RecorderOpened
    PUT  /create                                           RecorderOpened -> RecorderConfiguring
    POST /channels/input/all/transducers/detect            before measuring
    GET  /channels/input/all/transducers
    GET  /channels/input/default
    PUT  /channels/input                                   RecorderConfiguring -> RecorderStreaming
    GET  /destination/socket                               RecorderStreaming
    POST /measurements                                     RecorderStreaming -> RecorderRecording
    PUT  /measurements/stop                                RecorderRecording -> RecorderStreaming
    PUT  /finish                                           back to RecorderOpened
    PUT  /close                                            RecorderOpened -> Idle

A request in another state is answered with 403. Keys and spellings are those that the maker's public
tutorials and public programs use. Not seen there, and so unverified: what `/module/info` says beside the keys
read here, which requests are answered in which state, and how firmwares before 2.10 differ.
"""

import re
from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any

from scipy import constants

from drivers.errors import Garbled, Refused
from drivers.front_end.interface import Transducer

IDLE = "Idle"
OPENED = "RecorderOpened"
CONFIGURING = "RecorderConfiguring"
STREAMING = "RecorderStreaming"
RECORDING = "RecorderRecording"

SOCKET = "socket"
OPEN_PARAMETERS = {"performTransducerDetection": False}
"""Detection is asked for when the recorder is open: then its end can be seen."""
BANDWIDTH_FACTOR = 2.56
"""Sample rate over bandwidth."""
HEADROOM = 10 ** (1.5 / 20)
"""Full scale of the converter over the nominal range: 1.5 dB."""

_UNITS = {"m/s2": 1.0, "g": 1 / constants.g, "N": 1.0, "degC": 1.0, "°C": 1.0}
"""From V over the unit to V over the SI one."""
_RANGE = re.compile(r"\s*([0-9.]+)\s*(m?)V\s*peak\s*", re.IGNORECASE)


@dataclass(frozen=True)
class ModuleInfo:
    """What a module is and can do."""

    type: str
    serial: str
    inputs: int
    sample_rates_hz: tuple[float, ...]
    ranges_v: tuple[float, ...]
    """Peak, ascending."""


@dataclass(frozen=True)
class ChannelSetup:
    """How an input is to be set."""

    number: int
    """From 1."""
    name: str
    range_v: float
    ccld: bool
    """Feed the sensor: IEPE."""


def read_module_info(document: Any) -> ModuleInfo:
    """Raises `Garbled`."""
    try:
        module = document.get("module", {})
        return ModuleInfo(
            type=str(module.get("type", {}).get("number", "LAN-XI")),
            serial=str(module.get("serial", "unknown")),
            inputs=int(document["numberOfInputChannels"]),
            sample_rates_hz=tuple(sorted(float(rate) for rate in document["supportedSampleRates"])),
            ranges_v=tuple(sorted(_range_v(name) for name in document["supportedRanges"])),
        )
    except (AttributeError, KeyError, TypeError, ValueError) as error:
        raise Garbled(f"/module/info: {error!r} in {str(document)[:80]!r}") from error


def write_module_info(info: ModuleInfo) -> dict[str, Any]:
    """The document that a module answers with, of what it says."""
    return {
        "module": {"type": {"number": info.type}, "serial": info.serial},
        "numberOfInputChannels": info.inputs,
        "numberOfOutputChannels": 0,
        "supportedSampleRates": [int(r) if r.is_integer() else r for r in info.sample_rates_hz],
        "supportedRanges": [range_name(r) for r in info.ranges_v],
        "supportedFilters": ["DC", "0.7 Hz", "7.0 Hz", "22.4 Hz"],
        "sdCardInserted": False,
    }


def choose_rate(info: ModuleInfo, asked_hz: float) -> float:
    """The device's own value of the rate asked for. Raises `Refused`, naming the nearest."""
    nearest = min(info.sample_rates_hz, key=lambda rate: abs(rate - asked_hz))
    if abs(nearest - asked_hz) > 1e-6 * nearest:
        raise Refused(
            f"{asked_hz:g} Hz is no sample rate of {info.type}: the nearest is {nearest:g} Hz "
            f"(bandwidth {bandwidth_name(nearest)})"
        )
    return nearest


def choose_range(info: ModuleInfo, asked_v: float) -> float:
    """The smallest range that holds `asked_v`. Raises `Refused`."""
    for range_v in info.ranges_v:
        if range_v >= asked_v * (1 - 1e-9):
            return range_v
    raise Refused(f"{asked_v:g} V is beyond the largest range of {info.type} ({info.ranges_v[-1]:g} V)")


def bandwidth_name(sample_rate_hz: float) -> str:
    """As `bandwidth` spells it: `51.2 kHz`, `800 Hz`."""
    bandwidth_hz = sample_rate_hz / BANDWIDTH_FACTOR
    return f"{bandwidth_hz / 1e3:.1f} kHz" if bandwidth_hz >= 999.5 else f"{bandwidth_hz:g} Hz"


def range_name(range_v: float) -> str:
    """As `range` spells it: `10 Vpeak`."""
    return f"{range_v:g} Vpeak"


def default_setup(info: ModuleInfo) -> dict[str, Any]:
    """All inputs enabled, highest bandwidth, stored on the card: as a module proposes it."""
    bandwidth = bandwidth_name(info.sample_rates_hz[-1])
    channels = [
        {
            "bandwidth": bandwidth,
            "ccld": False,
            "channel": number,
            "destinations": ["sd"],
            "enabled": True,
            "filter": "7.0 Hz",
            "floating": False,
            "name": f"Channel {number}",
            "polvolt": False,
            "range": range_name(info.ranges_v[0]),
            "transducer": plain_transducer(),
        }
        for number in range(1, info.inputs + 1)
    ]
    return {"channels": channels, "name": "Default setup", "recordingMode": "Single"}


def plain_transducer() -> dict[str, Any]:
    """None: one volt is one volt. A detected one would make the scale factor another unit's."""
    nothing = {"model": "", "number": "None", "prefix": "", "variant": ""}
    return {
        "requires200V": False,
        "requiresCcld": False,
        "sensitivity": 1,
        "serialNumber": 0,
        "type": nothing,
        "unit": "V",
    }


def fill_setup(default: Any, channels: Iterable[ChannelSetup], sample_rate_hz: float) -> dict[str, Any]:
    """The module's default setup with the asked channels enabled, streamed and set. Raises `Garbled`."""
    wanted = {channel.number: channel for channel in channels}
    # A fed sensor has a bias, so it needs a high-pass: the lowest, and on every channel, so that its phase
    # cancels in their ratios.
    high_pass = "0.7 Hz" if any(channel.ccld for channel in wanted.values()) else "DC"
    try:
        entries = [dict(entry) for entry in default["channels"]]
        for index, entry in enumerate(entries, start=1):
            number = int(entry.get("channel", index))
            entry |= {
                "bandwidth": bandwidth_name(sample_rate_hz),
                "destinations": [SOCKET],
                "enabled": number in wanted,
                "polvolt": False,
                "transducer": plain_transducer(),
            }
            if number in wanted:
                channel = wanted[number]
                entry |= {
                    "ccld": channel.ccld,
                    "name": channel.name,
                    "range": range_name(channel.range_v),
                    "filter": high_pass,
                }
        return {**default, "channels": entries}
    except (AttributeError, KeyError, TypeError, ValueError) as error:
        raise Garbled(f"/channels/input/default: {error!r} in {str(default)[:80]!r}") from error


def read_setup(document: Any) -> tuple[tuple[ChannelSetup, ...], float]:
    """The enabled channels and the sample rate, as a module reads a setup. Raises `Garbled`."""
    try:
        enabled = [entry for entry in document["channels"] if entry["enabled"]]
        channels = tuple(
            ChannelSetup(int(e["channel"]), str(e["name"]), _range_v(e["range"]), bool(e["ccld"]))
            for e in enabled
        )
        bandwidths = {str(entry["bandwidth"]) for entry in enabled}
        if len(bandwidths) != 1 or any(entry["destinations"] != [SOCKET] for entry in enabled):
            raise ValueError("bandwidth and destination are to be the same on all channels")
        number, unit = bandwidths.pop().split()
        return channels, float(number) * {"Hz": 1.0, "kHz": 1e3}[unit] * BANDWIDTH_FACTOR
    except (AttributeError, KeyError, TypeError, ValueError) as error:
        raise Garbled(f"/channels/input: {error!r}") from error


def read_status(document: Any) -> tuple[str, int, bool]:
    """State, update tag and whether sensors are being detected, of `/onchange`. Raises `Garbled`."""
    try:
        return (
            str(document["moduleState"]),
            int(document["lastUpdateTag"]),
            bool(document["transducerDetectionActive"]),
        )
    except (KeyError, TypeError, ValueError) as error:
        raise Garbled(f"/onchange: {error!r} in {str(document)[:80]!r}") from error


def read_transducers(document: Any) -> tuple[Transducer | None, ...]:
    """Each detected sensor, None where there is none. Raises `Garbled`.

    `sensitivity` is taken to be in V over `unit`, as a plain volt of a setup has 1 and V: unverified.
    """
    try:
        return tuple(t and _transducer(t) for t in document)
    except (KeyError, TypeError, ValueError) as error:
        raise Garbled(f"/channels/input/all/transducers: {error!r}") from error


def _transducer(t: dict[str, Any]) -> Transducer:
    factor = _UNITS.get(str(t.get("unit", "")).replace("²", "2").replace("^", ""))
    volts = t.get("sensitivity")
    mv = 1e3 * float(volts) * factor if factor is not None and volts else None
    return Transducer(str(t["type"]["number"]), str(t["serialNumber"]), mv)


def write_transducer(transducer: Transducer, unit: str) -> dict[str, Any]:
    """The same the other way, its sensitivity over `unit`."""
    assert transducer.mv_per_unit is not None
    return {
        **plain_transducer(),
        "sensitivity": transducer.mv_per_unit / 1e3,
        "serialNumber": transducer.serial,
        "type": {**plain_transducer()["type"], "number": transducer.type},
        "unit": unit,
    }


def read_port(document: Any) -> int:
    """Where the stream is to be had. Raises `Garbled`."""
    try:
        return int(document["tcpPort"])
    except (KeyError, TypeError, ValueError) as error:
        raise Garbled(f"/destination/socket: {error!r} in {str(document)[:80]!r}") from error


def _range_v(name: str) -> float:
    found = _RANGE.fullmatch(name)
    if found is None:
        raise ValueError(f"{name!r}: expected a range such as '10 Vpeak'")
    return float(found[1]) * (1e-3 if found[2] else 1.0)
