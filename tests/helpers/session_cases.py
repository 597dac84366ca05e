"""Sessions made without a rig: samples synthesised, everything derived computed by the analysis itself."""

from dataclasses import replace
from datetime import date
from functools import cache
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np
import pytest
from impact_cases import TABLE_3, clean_hit
from paper_law import TABLE_4

from fitting.dynamics.bare_modes import bare_modes
from fitting.plate.plate import Plate
from instrument.files.experiment_file import ExperimentDocument
from instrument.files.rig_file import RigDocument
from instrument.files.specimen_file import SpecimenDocument, specimen_of
from instrument.files.toml import read_document
from instrument.models.specimen_models import Models
from instrument.paper_case import case_file
from instrument.run.analysis import Analysis
from instrument.run.live_fit import fit_points
from instrument.session.configuration import Configuration
from instrument.session.setup import setup_of
from instrument.session.storage import write_part, write_session
from instrument.stream.derived import PointMeasured
from instrument.stream.raw import (
    AcquisitionBegan,
    BlockAcquired,
    FitStarted,
    HammerTestEnded,
    OperatorDid,
    RangeSet,
    SegmentBegan,
    SegmentEnded,
    SessionBegan,
    SessionEnded,
    ShakerCommanded,
    SignalLevelRead,
    StepBegan,
)

RATE = 2048.0
SECONDS = 4.0
LEVEL_G = 0.5
SEGMENTS = ((18.0, 22.0), (108.0, 130.0), (190.0, 230.0))
GAIN, DELAY_S = 1.02, 1.1e-3
_COUNT_V = 1e-6
_RANGE = RangeSet("5mm/s/V", 5e-3, 100.0, 5000.0, None)


def configuration(**changes):
    """Of a plate on a coarse mesh; `changes` replace whole documents."""
    specimen = read_document(case_file("zn1.toml"), SpecimenDocument).model_dump()
    specimen["mesh"] = {"elements_x": 10, "elements_y": 10}
    experiment = {
        "title": "ZN_1 <second> & last",
        "operator": "A. Tester",
        "specimen": "zn1.toml",
        "rig": "rig.toml",
        "mounting": {"bolts": 6, "torque_n_m": 4.5, "remount": 1},
        "hammer": {
            "hits": 3,
            "hit_x_mm": 280.0,
            "hit_y_mm": 20.0,
            "response_x_mm": 60.0,
            "response_y_mm": 60.0,
            "record_s": SECONDS,
        },
        "sweep": {
            "level_g": LEVEL_G,
            "segments": [{"low_hz": a, "high_hz": b, "points": 9} for a, b in SEGMENTS],
            "calibration": {"frequencies_hz": [40.0, 80.0, 120.0, 160.0]},
        },
    }
    base = {
        "input": 1,
        "sensitivity_mv_per_unit": 10.2,
        "serial": "4711",
        "calibrated": date(2026, 3, 2),
        "iepe": True,
    }
    rig = {
        "name": "bench 2",
        "shaker": {"address": "127.0.0.1:502"},
        "vibrometer": {"address": "/dev/ttyS0", "model": "PDV-100", "reads": "absolute"},
        "front_end": {"address": "http://127.0.0.1:80", "sample_rate_hz": RATE},
        "channels": {
            "base": base,
            "velocity": {"input": 2},
            "force": {"input": 3, "sensitivity_mv_per_unit": 2.25},
            "response": {"input": 4, "sensitivity_mv_per_unit": 1.0, "mass_g": 0.6},
            "temperature": {"input": 5, "sensitivity_mv_per_unit": 10.0},
        },
    }
    return Configuration(
        name="zn1-20260401T080000Z",
        created_utc="2026-04-01T08:00:00+00:00",
        versions={"viscorig": "0.1.0", "numpy": "2.4.0"},
        experiment=ExperimentDocument.model_validate(changes.get("experiment", experiment)),
        rig=RigDocument.model_validate(changes.get("rig", rig)),
        specimen=SpecimenDocument.model_validate(changes.get("specimen", specimen)),
    )


def bare_modes_hz(specimen, hammer):
    """The bare plate's first modes, the accelerometer on it."""
    modes, edge = bare_modes(Plate(specimen.bare), 12, hammer.sensor if hammer is not None else None)
    return (modes.omega * (1 - edge))[:8] / (2 * np.pi)


class SyntheticSession:
    """Emits events, raw ones through the analysis; what is kept becomes a session."""

    def __init__(self, config):
        self.configuration = config
        self.analysis = Analysis(setup_of(config))
        self.events = []
        self.rng = np.random.default_rng(7)
        self._sample = self._step = 0
        truth = specimen_of(config.specimen).with_law(TABLE_4)
        self._truth = replace(truth, reads=config.rig.vibrometer.reads)
        self._bare_hz = bare_modes_hz(truth, setup_of(config).hammer)
        self._models = Models.of(self._truth, np.array([18.0, 230.0]))

    def emit(self, event):
        derived = self.analysis.feed(event)
        self.events += [event, *derived]
        return derived

    def begin(self, utc="2026-04-01T08:00:05+00:00", *, resumed=False):
        instruments = {"shaker": "Shaker 1", "vibrometer": "PDV-100 no. 7", "front_end": "LAN-XI 3050"}
        self.emit(SessionBegan(utc, "0.1.0", instruments, ("5mm/s/V", "25mm/s/V"), resumed))

    def block(self, volts):
        counts = np.round(np.array(volts) / _COUNT_V).astype(np.int32)
        n = len(counts)
        event = BlockAcquired(
            self._sample, counts.shape[1], (_COUNT_V,) * n, (10.0,) * n, (False,) * n, (False,) * n, counts
        )
        self._sample += counts.shape[1]
        return self.emit(event)

    def acquire(self, part, channels):
        self._sample = 0
        self.emit(AcquisitionBegan(1, part, RATE, channels))

    # The hammer test

    def hammer(self, hits=3, *, rejected=()):
        """Hits of the bare plate, a double one in second place."""
        self.emit(OperatorDid("mounted", "bare"))
        self.acquire("hammer", ("force", "response"))
        force, response = clean_hit(self._bare_hz, TABLE_3, seconds=SECONDS + 1, rate=RATE)
        quiet = round(0.5 * RATE)
        for k in range(hits):
            f, x = 0.02 * self.rng.normal(size=(2, quiet + len(force)))
            f[quiet:] += (1 + 0.1 * k) * force
            x[quiet:] += (1 + 0.1 * k) * response
            if k == 1:
                f[quiet + 100 : quiet + 104] += 60.0
            self.block([f * 2.25e-3, x * 1e-3])
        for number in rejected:
            self.emit(OperatorDid("rejected", "", number))
        self.emit(HammerTestEnded())

    # The sweep

    def calibrate(self):
        self.emit(OperatorDid("aimed", "base"))
        self.acquire("calibration", ("base", "velocity", "temperature"))
        self.emit(_RANGE)
        f = self.configuration.experiment.sweep.calibration.frequencies_hz
        self.emit(SegmentBegan(1, 0, min(f), max(f), len(f)))
        for frequency in f:
            self.step("calibration", 1, 0, frequency)
        self.emit(SegmentEnded(1, 0))

    def begin_sweep(self):
        """Aim, acquire, set the range."""
        self.emit(OperatorDid("aimed", "pickup"))
        self.acquire("sweep", ("base", "velocity", "temperature"))
        self.emit(_RANGE)

    def sweep(self, segments=(1, 2, 3), *, steps=9, begin=True):
        """Segments with the sentinel before the first and after each; `steps` of the last one."""
        if begin:
            self.begin_sweep()
        for k, number in enumerate(segments):
            low, high = SEGMENTS[number - 1]
            if k == 0 and begin:
                self.step("sentinel", number, 1, 20.0)
            self.emit(SegmentBegan(number, 1, low, high, 9))
            count = steps if number == segments[-1] else 9
            for frequency in np.linspace(low, high, 9)[:count]:
                self.step("step", number, 1, round(float(frequency), 4))
            if count == 9:
                self.emit(SegmentEnded(number, 1))
                self.step("sentinel", number, 1, 20.0)

    def step(self, purpose, segment, sweep, frequency_hz):
        """One step, its response steady from the first sample on."""
        self._step += 1
        level = LEVEL_G * 9.81
        # Light fades at one point, so that there is one with a remark.
        self.emit(SignalLevelRead(0.05 if frequency_hz == 19.0 else 0.8))
        self.emit(StepBegan(self._step, purpose, segment, sweep, frequency_hz, level, 0.5, 60.0))
        self.emit(ShakerCommanded(self._step, frequency_hz, 0.5, 0.05, self._sample))
        base = level * np.exp(0.3j) * 1.002
        reading = self._velocity(purpose, frequency_hz) * base
        reading *= GAIN * np.exp(-2j * np.pi * frequency_hz * DELAY_S)
        for _ in range(400):
            n = max(self.analysis.wanted, 1)
            t = (self._sample + np.arange(n)) / RATE
            wave = np.exp(2j * np.pi * frequency_hz * t)
            noise = self.rng.normal(size=(2, n))
            volts = [
                ((base * wave).real + 2e-3 * noise[0]) * 10.2e-3,
                ((reading * wave).real + 2e-5 * noise[1]) / 5e-3,
                np.full(n, 0.215),
            ]
            if any(isinstance(e, PointMeasured) for e in self.block(volts)):
                return
        raise AssertionError(f"{frequency_hz} Hz never measured")

    def _velocity(self, purpose, frequency_hz):
        """Over base acceleration: of the base itself in calibration, of the plate otherwise."""
        if purpose == "calibration":
            return 1 / (2j * np.pi * frequency_hz)
        v = self._models.predict(TABLE_4, np.array([frequency_hz]))[0]
        return v / self._truth.base_acceleration_m_s2

    def fit(self):
        """As the live identification would have it."""
        a = self.analysis
        last = max(p.step for p in a.points)
        self.emit(FitStarted(1, last))
        specimen = self.configuration.the_specimen()
        self.events.append(fit_points(1, last, a.points, a.damping, specimen))

    def end(self, why="done", message=""):
        self.emit(SessionEnded(why, message))

    def save(self, folder) -> Path:
        """A session file: a part for each acquisition."""
        parts, start = [], 0
        edges = [k for k, e in enumerate(self.events) if isinstance(e, AcquisitionBegan) and k] or []
        for number, stop in enumerate([*edges, len(self.events)], start=1):
            part = folder / f"part-{number:06d}.h5"
            write_part(part, self.events[start:stop])
            parts.append(part)
            start = stop
        path = folder / f"{self.configuration.name}.h5"
        write_session(path, self.configuration, parts)
        return path


def whole_session(folder) -> Path:
    """Hammer test, calibration, three segments, a fit, done."""
    path = folder / f"{configuration().name}.h5"
    path.write_bytes(_whole_session())
    return path


@cache
def _whole_session() -> bytes:
    synthetic = SyntheticSession(configuration())
    synthetic.begin()
    synthetic.hammer()
    synthetic.calibrate()
    synthetic.sweep()
    synthetic.fit()
    synthetic.end()
    with TemporaryDirectory() as folder:
        return synthetic.save(Path(folder)).read_bytes()


@pytest.fixture(scope="session")
def session_path(tmp_path_factory):
    return whole_session(tmp_path_factory.mktemp("session"))
