"""The simulated instruments over their real wires, with plates made of formulas."""

from contextlib import contextmanager
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from drivers.chamber.registers import TemperatureRegisters
from drivers.simulated.drive import DrivePiece
from drivers.simulated.rig import SimulatedRig
from drivers.simulated.sensors import SimulatedSensor
from drivers.simulated.world import Laser, Wiring, World
from drivers.vibrometer.polytec_simulated import simulated_polytec
from instrument.session.configuration import Experiment, read_whole_experiment
from instrument.simulated_case import case_file

MODES = ((19.4, 0.1), (55.5, 0.1), (100.8, 0.14))
FREE = ((88.0, 0.05), (150.0, 0.05))
"""Of the damped plate hung free; it heaves too, and sways."""
BARE = ((17.72, 0.0029), (59.8, 0.0013), (110.1, 0.0018), (201.6, 0.0021))
PULSE_S = 1e-3
IMPULSE_N_S = 50 * PULSE_S
SWEEP = """
[[sweep.segments]]
low_hz = 95.0
high_hz = 107.0
points = 9
[[sweep.segments]]
low_hz = 180.0
high_hz = 190.0
points = 6
"""
HAMMER = """
[hammer]
hits = 2
hit_x_mm = 285.0
hit_y_mm = 25.0
response_x_mm = 270.0
response_y_mm = 170.0
record_s = 6.0
"""


CHAMBER = """
[chamber]
address = "{address}"
temperature_register = 100
set_point_register = 300
type = "int16"
scale_c = 0.1
"""
CHAMBER_REGISTERS = TemperatureRegisters(100, 300, "int16", 0.1)


class FormulaPlate:
    """Always at its steady state: no transients. Struck, it rings."""

    def __init__(self):
        self._pieces = [DrivePiece(0.0, 10.0, 0.0, 0.0, 0.0)]
        self._hits: list[float] | None = None

    def drive(self, piece: DrivePiece) -> None:
        self._pieces = [*self._pieces[-3:], piece]
        if piece.amplitude_v:
            self._hits = None

    def strike(self, hit_m, read_m, *, free: bool) -> None:
        self._hits, self._read_m = [], read_m

    def hit(self, now_s: float) -> None:
        self._hits.append(now_s + 0.1)

    def at(self, output: str, first_s: float, step_s: float, count: int) -> NDArray[np.float64]:
        t = first_s + step_s * np.arange(count)
        if self._hits is not None:
            return self._struck(output, t)
        y = np.zeros(count)
        ends = [p.begin_s for p in self._pieces[1:]] + [np.inf]
        for piece, end in zip(self._pieces, ends, strict=True):
            inside = (t >= piece.begin_s) & (t < end)
            amplitude = piece.amplitude_v + piece.slope_v_s * (t[inside] - piece.begin_s)
            angle = 2 * np.pi * piece.frequency_hz * (t[inside] - piece.begin_s) + piece.phase_rad
            y[inside] = (gain(output, piece.frequency_hz) * amplitude * np.exp(1j * angle)).imag
        return y

    def _struck(self, output: str, t: NDArray[np.float64]) -> NDArray[np.float64]:
        y = np.zeros(len(t))
        for number, hit in enumerate(self._hits):
            since = t - hit - PULSE_S / 2
            if output == "force":
                y += pulse(t - hit)
            elif output == "velocity":
                moved = sum(
                    np.exp(-ratio * 2 * np.pi * f * since) * np.cos(2 * np.pi * f * since)
                    for f, ratio in FREE
                )
                off = 1 + 1e-3 * (-1) ** number
                # At the other corner it goes the other way as a whole.
                y += np.where(since > 0, IMPULSE_N_S * off * (moved - np.cos(2 * np.pi * since)), 0)
        return y


def pulse(since: NDArray[np.float64]) -> NDArray[np.float64]:
    """A blow's force."""
    inside = (since >= 0) & (since < PULSE_S)
    return np.where(inside, 50 * (1 - np.cos(2 * np.pi * since / PULSE_S)), 0)


def gain(output: str, frequency_hz: float) -> complex:
    """Output per volt of drive."""
    w = 2 * np.pi * frequency_hz
    base = 5 * (1 + frequency_hz / 300)
    if output == "base_acceleration":
        return base
    if output == "base_velocity":
        return base / (1j * w)
    relative = sum(
        w**2 / ((2 * np.pi * f) ** 2 * (1 + 1j * eta) - w**2) / (k + 1) for k, (f, eta) in enumerate(MODES)
    )
    return base / (1j * w) * (1 + relative)


class FormulaBare:
    """Rings after a blow."""

    def __init__(self):
        self._hits: list[float] = []

    def drive(self, piece: DrivePiece) -> None:
        """Not shaken."""

    def hit(self, now_s: float) -> None:
        self._hits.append(now_s + 0.1)

    def at(self, output: str, first_s: float, step_s: float, count: int) -> NDArray[np.float64]:
        t = first_s + step_s * np.arange(count)
        y = np.zeros(count)
        for hit in self._hits:
            if output == "force":
                y += pulse(t - hit)
                continue
            since = np.maximum(t - hit - PULSE_S / 2, 0)
            for f, ratio in BARE:
                w = 2 * np.pi * f
                y += 2 * np.exp(-ratio * w * since) * np.cos(w * since) * (since > 0)
        return y


@contextmanager
def formula_rig(
    folder: Path,
    *,
    sweep: str = SWEEP,
    hammer: bool = False,
    virtual: bool = True,
    temperature: str = "",
    **options,
):
    """The rig and an experiment on it; `temperature` is what stands in its table of that name."""
    inputs = {
        1: SimulatedSensor("base_acceleration", 0.01, 1e-5, 10.0),
        2: SimulatedSensor("laser", 1.0, 1e-3, 10.0),
        3: SimulatedSensor("force", 0.02, 1e-5, 10.0),
        4: SimulatedSensor("response_acceleration", 0.005, 1e-5, 10.0),
    }
    world = World(
        {"damped": FormulaPlate(), "bare": FormulaBare()}, Wiring(inputs), Laser(5e-3, 10.0, 1.1e-3), virtual
    )

    @contextmanager
    def polytec(optics):
        with simulated_polytec(optics) as rig.vibrometer:
            yield rig.vibrometer.path

    rig = SimulatedRig(world, vibrometer=polytec, signal_level=0.8, limit_v=5.0, **options)
    with rig as addresses:
        yield rig, write_experiment(folder, addresses, sweep, hammer, virtual, temperature)


def write_experiment(
    folder: Path, addresses, sweep: str, hammer: bool, virtual: bool, temperature: str = ""
) -> Experiment:
    """Files as a lab would have them, with these addresses."""
    rig = case_file("rig.toml").read_text().split("\n[simulation]")[0]
    for device, address in (
        ("[shaker]", addresses["modbus_tcp"]),
        ("[vibrometer]", addresses["vibrometer_tty"]),
        ("[front_end]", addresses["frontend_url"]),
    ):
        head, tail = rig.split(device)
        rig = head + device + tail.replace('"simulated"', f'"{address}"', 1)
    if addresses.get("chamber_tcp"):
        rig += CHAMBER.format(address=addresses["chamber_tcp"])
    if virtual:
        rig = rig.replace("[front_end]", "[front_end]\npaced_by_reader = true")
    (folder / "rig.toml").write_text(rig)
    (folder / "specimen.toml").write_text(case_file("specimen.toml").read_text())
    (folder / "experiment.toml").write_text(
        'specimen = "specimen.toml"\nrig = "rig.toml"\n'
        + (HAMMER if hammer else "")
        + (f"[temperature]\n{temperature}\n" if temperature else "")
        + "[sweep]\nsentinel = false\ncalibration = false\n"
        + sweep
    )
    return read_whole_experiment(folder / "experiment.toml")
