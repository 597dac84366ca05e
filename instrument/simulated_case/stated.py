"""What `[simulation]` of RIG.toml hides, and what of it cannot be; nothing is stood up."""

from dataclasses import MISSING, fields
from pathlib import Path
from typing import Any, get_args, get_type_hints

from drivers.simulated.plant.built import refuse_effects, refuse_placeless
from drivers.simulated.plant.effects import Effects, OtherLaw
from drivers.simulated.plant.law import MaxwellLaw
from instrument.errors import BadInput
from instrument.files.devices import VIBROMETERS
from instrument.files.rig_file import RigDocument, Simulation
from instrument.simulated_case.structure import stands_on

_PLAYED = {
    "shaker": ("modbus-tcp", "modbus-rtu"),
    "front_end": ("lan-xi",),
    "chamber": ("modbus-tcp",),
}
"""Kinds that the simulated rig plays by itself."""

CHANNEL_EFFECTS = {
    "channel_delay": ("delay_s",),
    "gain_error": ("factor",),
    "level_error": ("factor",),
    "mains_hum": ("amplitude_v",),
    "absolute_velocity": (),
}
"""What the channels may do undeclared; the plate's own are in `drivers.simulated.plant.effects`."""


def refuse_simulation(document: RigDocument, path: Path) -> None:
    """Raises `BadInput` for what `[simulation]` cannot be, as far as can be told without making the plate."""
    if document.simulation is None:
        return
    try:
        effects, _ = effects_of(document.simulation)
        for name in document.simulation.memory:
            if name == "velocity" or name not in document.channels.named():
                raise ValueError(f"memory.{name}: no such sensor on this rig")
        stands = "plate"
        if document.simulation.specimen is not None:
            stands = stands_on(document.simulation, path).kind
            refuse_effects(stands, effects)
        refuse_placeless(stands, effects)
        log = document.simulation.log
        if log is not None and not (path.parent / log).parent.is_dir():
            raise ValueError(f"log: {log}: no such folder")
    except (ValueError, TypeError) as error:
        raise BadInput(f"{path}: simulation: {error}") from None
    refuse_without_peer(document, path)


def refuse_without_peer(document: RigDocument, path: Path) -> None:
    """Raises `BadInput` for a device that nothing here can play."""
    for name, device in document.devices().items():
        played = _PLAYED.get(name, (device.kind,))
        if document.is_simulated and device.kind not in played:
            said = " or ".join(played)
            raise BadInput(f"{path}: {name}.kind: {device.kind!r} is not simulated, expected {said}")
    kind = document.vibrometer.kind
    if not VIBROMETERS[kind].can_be_simulated:
        raise BadInput(f"{path}: vibrometer.kind: {kind!r}: its driver brings no simulated one")


def effects_of(simulation: Simulation) -> tuple[Effects, dict[str, dict[str, Any]]]:
    """The plate's and the channels'. Raises `ValueError`, `TypeError` naming what is wrong."""
    kinds = {name: get_args(hint)[0] for name, hint in get_type_hints(Effects).items()}
    plate: dict[str, Any] = {}
    channel: dict[str, dict[str, Any]] = {}
    for name, values in simulation.effects.items():
        if name in CHANNEL_EFFECTS:
            unknown = set(values) ^ set(CHANNEL_EFFECTS[name])
            if unknown:
                raise ValueError(f"effects.{name}: {', '.join(sorted(unknown))} missing or unknown")
            if not all(isinstance(v, float | int) for v in values.values()):
                raise ValueError(f"effects.{name}: expected numbers")
            channel[name] = values
        elif name == "core_law":
            plate[name] = OtherLaw(_law(values))
        elif name in kinds:
            known = {f.name for f in fields(kinds[name])}
            needed = {f.name for f in fields(kinds[name]) if f.default is MISSING}
            if not needed <= set(values) <= known:
                raise ValueError(
                    f"effects.{name}: expected {', '.join(sorted(known))}, found {', '.join(values)}"
                )
            plate[name] = kinds[name](**values)
        else:
            known_names = ", ".join(sorted([*kinds, *CHANNEL_EFFECTS]))
            raise ValueError(f"effects.{name}: unknown, expected one of {known_names}")
    if simulation.core:
        plate["core_law"] = OtherLaw(_law(simulation.core))
    return Effects(**plate), channel


def _law(values: dict[str, Any]) -> MaxwellLaw:
    """A Maxwell series from g_inf_mpa, g_mpa, tau_s."""
    if set(values) != {"g_inf_mpa", "g_mpa", "tau_s"}:
        raise ValueError(f"core: expected g_inf_mpa, g_mpa, tau_s, found {', '.join(values)}")
    return MaxwellLaw(
        1e6 * values["g_inf_mpa"], tuple(1e6 * g for g in values["g_mpa"]), tuple(values["tau_s"])
    )
