"""From RIG.toml's [simulation] to the simulated rig: its plates, sensors, and what it hides."""

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path
from typing import Any

from drivers.chamber.modbus_driver import ModbusTcpChamberOptions
from drivers.front_end.interface import Transducer
from drivers.front_end.lan_xi_documents import write_transducer
from drivers.shaker.modbus_driver import ModbusOptions
from drivers.shaker.register_map import DEFAULT
from drivers.simulated.climate import Climate
from drivers.simulated.mounted_plate import MountedPlate
from drivers.simulated.plant.effects import Effects
from drivers.simulated.plant.sandwich import sandwich
from drivers.simulated.plant.shaken import ShakenPlate
from drivers.simulated.plates import DampedPlate, HammerInHand, Mount, OnShaker, SimulatedBarePlate, Struck
from drivers.simulated.rig import Ports, SimulatedChamber, SimulatedRig
from drivers.simulated.sensors import SimulatedSensor
from drivers.simulated.world import Laser, Wiring, World
from fitting.specimen import PlateSpecimen
from fitting.structures import Beam
from instrument.errors import BadInput
from instrument.files.devices import VIBROMETERS, ranges_of
from instrument.files.rig_file import Channels, RigDocument, Simulation
from instrument.progress import Progress, quiet
from instrument.simulated_case.plate import plate_hung, plate_mount, plate_struck
from instrument.simulated_case.stated import effects_of, refuse_without_peer
from instrument.simulated_case.structure import beam_struck, mounted_structure, stands_on

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
_PLATE_KG = 0.3
"""Of the plate that the simulated hand strikes at its full strength: the published one's."""


@contextmanager
def simulated_rig(
    document: RigDocument,
    path: Path,
    *,
    virtual_time: bool,
    log: Path | None = None,
    ports: tuple[int, int] = (0, 0),
    spot_m: tuple[float, float] | None = None,
    progress: Progress = quiet,
) -> Iterator[dict[str, str]]:
    """Stand up the rig a file describes; its addresses. Raises `BadInput`.

    `spot_m` is where the published plate is read, in m; what a specimen file puts there says it itself.
    """
    simulation = document.simulation
    if simulation is None:
        raise BadInput(f"{path}: [simulation] is missing, expected it for a rig to simulate; it may be empty")
    refuse_without_peer(document, path)
    chamber = _chamber(document, simulation)
    try:
        climate = chamber.climate if chamber else None
        plates = _plates(document, simulation, path, climate, spot_m, progress)
        world = _world(document, simulation, virtual_time, plates)
    except (ValueError, TypeError) as error:
        raise BadInput(f"{path}: simulation: {error}") from None
    shaker, vibrometer = document.shaker, document.vibrometer
    modbus = shaker if isinstance(shaker, ModbusOptions) else None
    rig = SimulatedRig(
        world,
        vibrometer=lambda optics: VIBROMETERS[vibrometer.kind].simulated(vibrometer, optics),
        signal_level=simulation.signal_level,
        limit_v=document.limits.drive_v,
        registers=DEFAULT.with_addresses(modbus.registers) if modbus is not None else DEFAULT,
        unit=modbus.unit if modbus is not None else 1,
        ports=Ports(*ports),
        log=log or (path.parent / simulation.log if simulation.log else None),
        chamber=chamber,
        transducers=_memories(document.channels, simulation),
    )
    with rig as addresses:
        yield addresses


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
    _, channel = effects_of(simulation)
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
    document: RigDocument,
    simulation: Simulation,
    path: Path,
    climate: Climate | None,
    spot_m: tuple[float, float] | None,
    progress: Progress,
) -> dict[str, MountedPlate]:
    """What can stand there, by name: the published plate, or what `[simulation]` names."""
    effects, _ = effects_of(simulation)
    alike, mount, struck, stated = _of_the_bare_plate(effects), published_mount(spot_m), None, None
    if simulation.specimen is not None:
        stands = stands_on(simulation, path)
        if not isinstance(stands, PlateSpecimen):
            found = mounted_structure(stands, effects, progress)
            plant = ShakenPlate(effects, climate=climate, mounted=found)
            on_shaker: dict[str, MountedPlate] = {"damped": OnShaker(plant, effects, climate)}
            if isinstance(stands, Beam) and stands.boundary != "centre-driven":
                struck = beam_struck(stands, alike)
                on_shaker["bare"] = _struck(document, simulation, alike, struck, _as_heavy(stands))
            return on_shaker
        stated = stands
        mount, struck = plate_mount(stands, effects, progress), plate_struck(stands, alike, progress)
    bare = _struck(document, simulation, alike, struck)
    hang, hand = (
        plate_hung(stated, effects, progress),
        HammerInHand(simulation.double_hit_every, simulation.seed),
    )
    return {"damped": DampedPlate(effects, climate, mount, hang, hand), "bare": bare}


def published_mount(spot_m: tuple[float, float] | None) -> Mount:
    """The published plate, read at `spot_m` until somebody aims elsewhere."""
    return lambda effects, by_hand: sandwich(
        effects, by_hand=replace(by_hand, spot_m=by_hand.spot_m or spot_m)
    )


def _struck(
    document: RigDocument,
    simulation: Simulation,
    alike: Effects,
    struck: Struck | None,
    softly: float = 1.0,
) -> SimulatedBarePlate:
    response = document.channels.response
    return SimulatedBarePlate(
        alike,
        sensor_mass_kg=1e-3 * response.mass_g if response else 0.0,
        double_hit_every=simulation.double_hit_every,
        seed=simulation.seed,
        struck=struck,
        softly=softly,
    )


def _as_heavy(beam: Beam) -> float:
    """Share of the blow for a plate that a hand gives a lighter thing: else its sensor is overloaded."""
    face = beam.substrate
    return min(1.0, face.thickness_m * face.density_kg_m3 * beam.length_m * beam.width_m / _PLATE_KG)


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
