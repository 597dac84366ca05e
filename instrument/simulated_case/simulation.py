"""From RIG.toml's [simulation] to the simulated rig: its plates, sensors, and what it hides."""

from collections.abc import Iterator
from contextlib import AbstractContextManager, contextmanager
from dataclasses import MISSING, fields
from pathlib import Path
from typing import Any, get_args, get_type_hints

from drivers.chamber.modbus_driver import ModbusTcpChamberOptions
from drivers.front_end.interface import Transducer
from drivers.front_end.lan_xi_documents import write_transducer
from drivers.shaker.modbus_driver import ModbusOptions
from drivers.shaker.register_map import DEFAULT
from drivers.simulated.climate import Climate
from drivers.simulated.plant.built import refuse_effects
from drivers.simulated.plant.effects import Effects, OtherLaw
from drivers.simulated.plant.law import MaxwellLaw
from drivers.simulated.plant.shaken import ShakenPlate
from drivers.simulated.plates import DampedPlate, OnShaker, SimulatedBarePlate
from drivers.simulated.rig import OWN_MODEL, Ports, SimulatedChamber, SimulatedRig, VibrometerPeer
from drivers.simulated.sensors import SimulatedSensor
from drivers.simulated.world import Laser, MountedPlate, Wiring, World
from drivers.vibrometer.driver import Optics
from drivers.vibrometer.polytec_driver import PolytecOptions
from fitting.specimen import Specimen
from instrument.errors import BadInput
from instrument.files.devices import VIBROMETERS, ranges_of
from instrument.files.rig_file import Channels, RigDocument, Simulation
from instrument.progress import Progress, quiet
from instrument.simulated_case.plate import plate_mount, plate_struck
from instrument.simulated_case.structure import mounted_structure, stands_on

_QUANTITIES = {
    "base": "base_acceleration",
    "velocity": "laser",
    "force": "force",
    "response": "response_acceleration",
    "temperature": "temperature",
}
_NOISE_V = 1e-4
"""Of a sensor and its cable, broadband, at noise 1."""
_LASER_NOISE_V = 5e-2
"""Of the vibrometer's output in good light: speckle."""
_SENSOR_LIMIT_V = 10.0

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


@contextmanager
def simulated_rig(
    document: RigDocument,
    path: Path,
    *,
    virtual_time: bool,
    log: Path | None = None,
    ports: tuple[int, int] = (0, 0),
    progress: Progress = quiet,
) -> Iterator[dict[str, str]]:
    """Stand up the rig a file describes; its addresses. Raises `BadInput`."""
    simulation = document.simulation
    if simulation is None:
        raise BadInput(f"{path}: [simulation] is missing, expected it for a rig to simulate; it may be empty")
    _refuse_without_peer(document, path)
    chamber = _chamber(document, simulation)
    try:
        climate = chamber.climate if chamber else None
        plates = _plates(document, simulation, path, climate, progress)
        world = _world(document, simulation, virtual_time, plates)
    except (ValueError, TypeError) as error:
        raise BadInput(f"{path}: simulation: {error}") from None
    shaker, vibrometer = document.shaker, document.vibrometer
    modbus = shaker if isinstance(shaker, ModbusOptions) else None
    rig = SimulatedRig(
        world,
        model=vibrometer.model if isinstance(vibrometer, PolytecOptions) else OWN_MODEL,
        signal_level=simulation.signal_level,
        delay_s={},
        limit_v=document.limits.drive_v,
        registers=DEFAULT.with_addresses(modbus.registers) if modbus is not None else DEFAULT,
        unit=modbus.unit if modbus is not None else 1,
        ports=Ports(*ports),
        log=log or (path.parent / simulation.log if simulation.log else None),
        vibrometer=_peer(document),
        chamber=chamber,
        transducers=_memories(document.channels, simulation),
    )
    with rig as addresses:
        yield addresses


def refuse_simulation(document: RigDocument, path: Path) -> None:
    """Raises `BadInput` for what `[simulation]` cannot be, as far as can be told without making the plate."""
    if document.simulation is None:
        return
    try:
        effects, _ = _effects(document.simulation)
        for name in document.simulation.memory:
            if name == "velocity" or name not in document.channels.named():
                raise ValueError(f"memory.{name}: no such sensor on this rig")
        if document.simulation.specimen is not None:
            refuse_effects(stands_on(document.simulation, path).kind, effects)
        log = document.simulation.log
        if log is not None and not (path.parent / log).parent.is_dir():
            raise ValueError(f"log: {log}: no such folder")
    except (ValueError, TypeError) as error:
        raise BadInput(f"{path}: simulation: {error}") from None
    _refuse_without_peer(document, path)


def _refuse_without_peer(document: RigDocument, path: Path) -> None:
    """Raises `BadInput` for a device that nothing here can play."""
    for name, device in document.devices().items():
        played = _PLAYED.get(name, (device.kind,))
        if document.is_simulated and device.kind not in played:
            said = " or ".join(played)
            raise BadInput(f"{path}: {name}.kind: {device.kind!r} is not simulated, expected {said}")
    kind = document.vibrometer.kind
    if kind != "polytec" and not VIBROMETERS[kind].can_be_simulated:
        raise BadInput(f"{path}: vibrometer.kind: {kind!r}: its driver brings no simulated one")


def _peer(document: RigDocument) -> VibrometerPeer | None:
    """The simulated vibrometer that another package's driver brings."""
    table = document.vibrometer
    if isinstance(table, PolytecOptions):
        return None

    def peer(optics: Optics) -> AbstractContextManager[str]:
        return VIBROMETERS[table.kind].simulated(table, optics)

    return peer


def _chamber(document: RigDocument, simulation: Simulation) -> SimulatedChamber | None:
    """The one around the plate; of another kind than the simulated rig plays there is none."""
    table = document.chamber
    if not isinstance(table, ModbusTcpChamberOptions):
        return None
    climate = Climate(simulation.chamber.air_s, simulation.chamber.plate_s)
    return SimulatedChamber(climate, table.registers, table.unit)


def _world(
    document: RigDocument,
    simulation: Simulation,
    virtual_time: bool,
    plates: dict[str, MountedPlate],
) -> World:
    _, channel = _effects(simulation)
    delay = simulation.vibrometer_delay_s + channel.get("channel_delay", {}).get("delay_s", 0.0)
    gain = channel.get("gain_error", {}).get("factor", 1.0)
    absolute = document.vibrometer.reads == "absolute" or "absolute_velocity" in channel
    chosen = ranges_of(document.vibrometer)[0]
    laser = Laser(
        chosen.scale_m_s_v,
        chosen.full_scale_v,
        delay,
        simulation.signal_level,
        gain=gain,
        rides_with_base=not absolute,
    )
    wiring = Wiring(
        _inputs(document.channels, simulation, channel.get("level_error", {}).get("factor", 1.0)),
        simulation.skew_samples,
        simulation.hum_v + channel.get("mains_hum", {}).get("amplitude_v", 0.0),
        simulation.mains_hz,
        simulation.seed,
    )
    return World(plates, wiring, laser, virtual_time)


def _plates(
    document: RigDocument, simulation: Simulation, path: Path, climate: Climate | None, progress: Progress
) -> dict[str, MountedPlate]:
    """What can stand there, by name: the published plate, or what `[simulation]` names."""
    effects, _ = _effects(simulation)
    alike, mount, struck = _of_the_bare_plate(effects), None, None
    if simulation.specimen is not None:
        stands = stands_on(simulation, path)
        if not isinstance(stands, Specimen):
            found = mounted_structure(stands, effects, progress)
            plant = ShakenPlate(effects, climate=climate, mounted=found)
            return {"damped": OnShaker(plant, effects, climate)}
        mount, struck = plate_mount(stands, effects, progress), plate_struck(stands, alike, progress)
    response = document.channels.response
    bare = SimulatedBarePlate(
        alike,
        sensor_mass_kg=1e-3 * response.mass_g if response else 0.0,
        double_hit_every=simulation.double_hit_every,
        seed=simulation.seed,
        struck=struck,
    )
    return {"damped": DampedPlate(effects, climate, mount), "bare": bare}


def _of_the_bare_plate(effects: Effects) -> Effects:
    """What the bare plate shares: its metal and the air. The clamp is another mounting."""
    return Effects(substrate_stiffness=effects.substrate_stiffness, air_added_mass=effects.air_added_mass)


def _inputs(channels: Channels, simulation: Simulation, level_factor: float) -> dict[int, SimulatedSensor]:
    """What hangs on each input, in the plant's units."""
    inputs = {}
    for name, sensor in channels.named().items():
        laser = name == "velocity"
        per_unit = (-1.0 if sensor.invert else 1.0) if laser else 1 / sensor.units_per_volt
        if name == "base":
            per_unit *= level_factor
        noise = simulation.noise * (_LASER_NOISE_V if laser else _NOISE_V)
        inputs[sensor.input] = SimulatedSensor(_QUANTITIES[name], per_unit, noise, _SENSOR_LIMIT_V)
    return inputs


def _memories(channels: Channels, simulation: Simulation) -> dict[int, dict[str, Any]]:
    """What sensors say of themselves, by input, as the front-end hands it on."""
    units = {"base": "m/s^2", "response": "m/s^2", "force": "N", "temperature": "degC"}
    return {
        channels.named()[name].input: write_transducer(
            Transducer(one.model, one.serial, one.sensitivity_mv_per_unit), units[name]
        )
        for name, one in simulation.memory.items()
    }


def _effects(simulation: Simulation) -> tuple[Effects, dict[str, dict[str, Any]]]:
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
