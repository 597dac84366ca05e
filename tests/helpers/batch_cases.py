"""Folders of made-up sweeps and sessions: one plate, a law each a little off, noise of half a percent."""

from dataclasses import replace
from pathlib import Path

import numpy as np
from session_cases import SyntheticSession, configuration

from fitting.gravity import PUBLISHED_G_M_S2
from instrument.files.specimen_file import read_specimen
from instrument.models.specimen_models import Models
from instrument.paper_case import case_file
from instrument.stream.derived import PointMeasured
from instrument.stream.raw import SegmentBegan, SegmentEnded

NOISE = 0.005
CORRUPT = "velocity_re_m_s,velocity_im_m_s\n1,2\n"
_BAND_HZ = (14.0, 280.0)


def write_specimen(folder: Path, name="plate.toml", *, core_mm=0.5, exact=True) -> Path:
    """The paper's plate on its own 10 x 10 mesh."""
    text = case_file("zn1.toml").read_text(encoding="utf-8")
    text = text.replace("thickness_mm = 0.5 ", f"thickness_mm = {core_mm} ").replace(
        "thickness_mm = 0.5\n", f"thickness_mm = {core_mm}\n"
    )
    if not exact:
        text = text.replace("exact = true", "gain_percent = 1.0")
    path = folder / name
    path.write_text(text + "\n[mesh]\nelements_x = 10\nelements_y = 10\n", encoding="utf-8")
    return path


def write_sweeps(folder: Path, specimen: Path, count: int, points=(9,), seed=1) -> list[Path]:
    """Sweep k has `points[k % len(points)]` points, and a law that only it follows."""
    measured = _measured(read_specimen(specimen), points, seed)
    return [_write_sweep(folder / f"sweep-{k:04d}.csv", *measured(k)) for k in range(count)]


def write_sessions(folder: Path, count: int, points=(9,), seed=1) -> list[Path]:
    """Sessions as a run leaves them, samples and all, of the paper's plate on its 10 x 10 mesh.

    Samples are one run's for each number of points; what was measured follows session k's own law.
    """
    runs = {n: _run(n) for n in sorted(set(points))}
    plate = next(iter(runs.values())).configuration.the_specimen()
    measured = _measured(plate, points, seed)
    paths = []
    for k in range(count):
        run = runs[points[k % len(points)]]
        values = iter(zip(*measured(k), strict=True))
        recorded = run.events
        name = f"session-{k:04d}"
        run.configuration = run.configuration.model_copy(update={"name": name})
        run.events = [_with(e, values) if isinstance(e, PointMeasured) else e for e in recorded]
        paths.append(run.save(folder))
        run.events = recorded
    return paths


def _run(points: int) -> SyntheticSession:
    """One segment over the whole band, in geometric steps; neither calibrated nor struck."""
    low, high = _BAND_HZ
    config = configuration()
    own = config.experiment.model_dump(exclude_unset=True)
    own["hammer"] = None
    own["sweep"] |= {"segments": [{"low_hz": low, "high_hz": high, "points": points}], "calibration": False}
    run = SyntheticSession(configuration(experiment=own))
    run.begin()
    run.begin_sweep()
    run.emit(SegmentBegan(1, 1, low, high, points))
    for f in np.geomspace(low, high, points):
        run.step("step", 1, 1, float(f))
    run.emit(SegmentEnded(1, 1))
    run.end()
    return run


def _with(point: PointMeasured, values) -> PointMeasured:
    f, v, std = next(values)
    assert abs(point.frequency_hz - f) < 1e-9 * f
    over = point.base_m_s2 / PUBLISHED_G_M_S2
    v, std = v * over, std * abs(over)
    return replace(
        point, velocity_re_m_s=float(v.real), velocity_im_m_s=float(v.imag), velocity_std_m_s=float(std)
    )


def _measured(plate, points, seed):
    """What sweep k measured: frequencies (n,) in Hz, velocities and their standard deviations (n,) in m/s."""
    law = plate.core.law
    models = {}
    for n in sorted(set(points)):
        f = np.geomspace(*_BAND_HZ, n)
        models[n] = f, Models.of(plate, f)

    def measured(k):
        rng = np.random.default_rng([seed, k])
        f, model = models[points[k % len(points)]]
        own = law.with_values(law.values * np.exp(rng.normal(0, [0.05, 0.05, 0.05, 0.01])))
        v = model.predict(own, f)
        v = v * (1 + NOISE * (rng.standard_normal(len(f)) + 1j * rng.standard_normal(len(f))))
        return f, v, NOISE * np.abs(v)

    return measured


def _write_sweep(path: Path, f, v, std) -> Path:
    rows = [
        f"{a!r},{b.real!r},{b.imag!r},{c!r}"
        for a, b, c in zip(f.tolist(), v.tolist(), std.tolist(), strict=True)
    ]
    head = "frequency_hz,velocity_re_m_s,velocity_im_m_s,velocity_std_m_s"
    path.write_text("\n".join([head, *rows, ""]), encoding="utf-8")
    return path
