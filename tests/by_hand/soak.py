"""A long stretch of samples from the simulated front-end through its real wire and the analysis.

    python tests/by_hand/soak.py --million 50

Prints how much faster than real time it went, what was lost, and how memory grew.
"""

import argparse
import resource
import tempfile
import time
from dataclasses import dataclass
from pathlib import Path

from drivers.front_end import InputChannel
from drivers.front_end.lan_xi import LanXiFrontEnd
from instrument.files.rig_file import RigDocument
from instrument.files.toml import read_document
from instrument.session.journal import SessionJournal
from instrument.session.recorder import Recorder
from instrument.simulated_case import write_case
from instrument.simulated_case.simulation import simulated_rig
from instrument.stepped_sine.sine_fit import sine_fit
from instrument.stream.raw import AcquisitionBegan, BlockAcquired

CHANNELS = (InputChannel(1, "base"), InputChannel(2, "velocity"))
BLOCK = 8192


@dataclass(frozen=True)
class Soaked:
    """What a soak showed."""

    samples: int
    gaps: int
    """Blocks that did not begin where the last one ended."""
    seconds: float
    sample_rate_hz: float
    grown_mb: float
    """Peak memory of the second half over that of the first."""

    @property
    def times_real_time(self) -> float:
        """Sample time over wall time."""
        return self.samples / self.sample_rate_hz / self.seconds


def soak(samples: int, folder: Path, *, rate_hz: float = 8192.0) -> Soaked:
    """Read, fit and record so many samples a channel; parts are removed as they are sealed."""
    path = write_case(folder).parent / "rig.toml"
    document = read_document(path, RigDocument)
    journal = SessionJournal(folder / "soak.running")
    journal.folder.mkdir()
    with simulated_rig(document, path, virtual_time=True) as addresses:
        front_end = LanXiFrontEnd(addresses["frontend_url"], paced_by_reader=True)
        front_end.start(CHANNELS, rate_hz)
        began, gaps, done, half_mb = time.monotonic(), 0, 0, 0.0
        with Recorder(journal, [], lambda events: _forget(journal)) as recorder:
            recorder.record(AcquisitionBegan(1, "sweep", rate_hz, ("base", "velocity")))
            while done < samples:
                block = front_end.read(BLOCK)
                gaps += block.first_sample != done
                done += block.samples
                event = _event(block)
                sine_fit(event.volts, block.first_sample, rate_hz, 100.0)
                recorder.record(event)
                if not half_mb and done > samples / 2:
                    half_mb = _peak_mb()
        seconds = time.monotonic() - began
        front_end.stop()
        front_end.close()
    return Soaked(done, gaps, seconds, rate_hz, _peak_mb() - half_mb)


def _event(block) -> BlockAcquired:
    return BlockAcquired(
        block.first_sample,
        block.samples,
        tuple(float(v) for v in block.volts_per_count),
        tuple(float(v) for v in block.full_scale_v),
        tuple(bool(v) for v in block.overload),
        tuple(bool(v) for v in block.cable_fault),
        block.counts,
    )


def _forget(journal: SessionJournal) -> None:
    for part in journal.folder.glob("part-*.h5"):
        part.unlink()


def _peak_mb() -> float:
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024


def main() -> None:
    """Soak and print."""
    options = argparse.ArgumentParser(description=__doc__)
    options.add_argument("--million", type=float, default=50.0)
    with tempfile.TemporaryDirectory() as folder:
        found = soak(int(1e6 * options.parse_args().million), Path(folder))
    print(found, f"{found.times_real_time:.0f} times real time")


if __name__ == "__main__":
    main()
