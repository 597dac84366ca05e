"""Small experiments and sessions for tests."""

from pathlib import Path

import numpy as np

from instrument.files.experiment_file import ExperimentDocument
from instrument.files.rig_file import RigDocument
from instrument.files.specimen_file import SpecimenDocument
from instrument.files.toml import read_document
from instrument.paper_case import case_file
from instrument.session.configuration import Configuration
from instrument.session.contents import Contents, contents_of
from instrument.session.storage import SessionFile
from instrument.stream.derived import PointMeasured
from instrument.stream.event import Event
from instrument.stream.raw import BlockAcquired

RIG = {
    "shaker": {"address": "127.0.0.1:502"},
    "vibrometer": {"address": "/dev/ttyUSB0"},
    "front_end": {"address": "http://127.0.0.1"},
    "channels": {"base": {"input": 1, "sensitivity_mv_per_unit": 10.0}, "velocity": {"input": 2}},
}
EXPERIMENT = {
    "specimen": "zn1.toml",
    "rig": "rig.toml",
    "sweep": {"segments": [{"low_hz": 15.0, "high_hz": 25.0, "points": 5}]},
}


def configuration() -> Configuration:
    return Configuration(
        name="test",
        created_utc="2026-01-01T00:00:00+00:00",
        versions={"viscorig": "0"},
        experiment=ExperimentDocument.model_validate(EXPERIMENT),
        rig=RigDocument.model_validate(RIG),
        specimen=read_document(Path(case_file("zn1.toml")), SpecimenDocument),
    )


def block(first: int = 0, samples: int = 8, value: int = 7) -> BlockAcquired:
    return BlockAcquired(
        first,
        samples,
        (1e-6, 1e-6),
        (10.0, 10.0),
        (False, False),
        (False, False),
        np.full((2, samples), value, dtype=np.int32) + np.arange(samples, dtype=np.int32),
    )


def point(step: int = 1, frequency_hz: float = 20.0, **changes) -> PointMeasured:
    facts = {
        "step": step,
        "purpose": "step",
        "segment": 1,
        "sweep": 1,
        "frequency_hz": frequency_hz,
        "level_m_s2": 9.81,
        "sample": 0,
        "dwell_s": 1.0,
        "settle_s": 0.5,
        "drive_v": 2.0,
        "base_accel_re_m_s2": 9.8,
        "base_accel_im_m_s2": 0.1,
        "base_accel_std_m_s2": 1e-3,
        "velocity_re_m_s": 0.05,
        "velocity_im_m_s": -0.02,
        "velocity_std_m_s": 1e-5,
        "control_error_percent": -0.1,
        "base_distortion_percent": 0.2,
        "velocity_distortion_percent": 0.1,
        "range_name": "20mm/s/V",
        "signal_level": 0.8,
        "temperature_c": None,
        "remarks": (),
    }
    return PointMeasured(**{**facts, **changes})


def contents_in(path: Path, **how) -> Contents:
    with SessionFile(path) as file:
        return contents_of(file, **how)


def events_of(path: Path, *, with_samples: bool = False) -> list[Event]:
    with SessionFile(path) as file:
        return list(file.events(with_samples=with_samples))


def points_of(path: Path) -> list[PointMeasured]:
    return [e for e in events_of(path) if isinstance(e, PointMeasured)]
