"""Folders of small made-up sweeps: one plate, a law each a little off, noise of half a percent."""

from pathlib import Path

import numpy as np

from instrument.files.specimen_file import read_specimen
from instrument.models.specimen_models import Models
from instrument.paper_case import case_file

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
    plate = read_specimen(specimen)
    law = plate.core.law
    models = {}
    for n in sorted(set(points)):
        f = np.geomspace(*_BAND_HZ, n)
        models[n] = f, Models.of(plate, f)
    paths = []
    for k in range(count):
        rng = np.random.default_rng([seed, k])
        f, model = models[points[k % len(points)]]
        own = law.with_values(law.values * np.exp(rng.normal(0, [0.05, 0.05, 0.05, 0.01])))
        v = model.predict(own, f)
        v = v * (1 + NOISE * (rng.standard_normal(len(f)) + 1j * rng.standard_normal(len(f))))
        std = NOISE * np.abs(v)
        rows = [
            f"{a!r},{b.real!r},{b.imag!r},{c!r}"
            for a, b, c in zip(f.tolist(), v.tolist(), std.tolist(), strict=True)
        ]
        path = folder / f"sweep-{k:04d}.csv"
        head = "frequency_hz,velocity_re_m_s,velocity_im_m_s,velocity_std_m_s"
        path.write_text("\n".join([head, *rows, ""]), encoding="utf-8")
        paths.append(path)
    return paths
