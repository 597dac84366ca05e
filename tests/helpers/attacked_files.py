"""A valid file of every format, and the commands that read it."""

import json
import shutil
from pathlib import Path

import numpy as np
import pyuff
from data_folder import DATA
from scipy.io import savemat

from instrument.files.new_file import TEMPLATES

RATE_HZ, SAMPLES = 1024.0, 2048

COMMANDS = {
    "sweep.csv": (
        "identify {} --specimen coarse.toml",
        "import {} --out out.csv",
    ),
    "dma.csv": ("identify sweep.csv --specimen coarse.toml --with {}",),
    "modes.csv": ("identify {} --specimen beam.toml",),
    "sensors.toml": ("sensors {}",),
    "frf.csv": ("damping {}", "import {} --out out.csv"),
    "hits.csv": ("damping {}",),
    "hits.lvm": ("damping {}",),
    "hits.mat": ("damping {}", "import {} --out out.csv"),
    "lab.mat": ("import {} --out out.csv", "damping {}"),
    "hits.uff": ("damping {}", "import {} --out out.csv"),
    "frf.uff": ("damping {}", "import {} --out out.csv"),
    "coarse.toml": ("modes {} --count 2", "predict {} --frequencies 20,100"),
    "beam.toml": ("modes {} --count 2",),
    "shear-pair.toml": ("predict {} --frequencies 20,100",),
    "experiment.toml": ("check {}",),
    "rig.toml": ("check experiment.toml",),
    "found.json": ("card {} --to abaqus --out out.inp", "compare {} found2.json"),
    "hammer.json": ("identify sweep.csv --specimen coarse.toml --hammer {}",),
    "small.h5": (
        "export {} --to csv --out out",
        "export {} --to uff --out out",
        "card {} --to csv --out out.csv",
    ),
}
"""What is spoiled, and the commands that read it; run in the folder of the files."""
SLOW = {"small.h5": ("report {} --out out.html", "replay {}", "identify {}", "diagnose {}")}


def write_files(folder: Path, session: Path | None = None) -> None:
    """A valid file of each format."""
    shutil.copy(DATA / "numbers" / "coarse.toml", folder)
    sweep = (DATA / "practice-005.csv").read_text().splitlines()
    (folder / "sweep.csv").write_text("\n".join([sweep[0], *sweep[1::8]]) + "\n")
    for kind in ("beam", "shear-pair", "experiment", "rig", "sensors"):
        (folder / f"{kind}.toml").write_text(TEMPLATES[kind].read_text())
    (folder / "specimen.toml").write_text(TEMPLATES["plate"].read_text())
    _write_tables(folder)
    _write_found(folder)
    _write_records(folder)
    if session is not None:
        shutil.copy(session, folder / "small.h5")


def _write_tables(folder: Path) -> None:
    """A rheometer's, and a sandwich beam's modes as its template predicts them."""
    rows = [f"{f},{t},{3e5 * f**0.2:.6g},0.8" for t in (10, 30) for f in (1, 10, 30, 100)]
    head = "frequency_hz,temperature_c,storage_modulus_pa,loss_factor\n"
    (folder / "dma.csv").write_text(head + "\n".join(rows) + "\n")
    modes = "1,74.3,0.221\n2,365.6,0.223\n3,922.2,0.179\n4,1670,0.126\n"
    (folder / "modes.csv").write_text("mode,frequency_hz,loss_factor\n" + modes)


def _write_found(folder: Path) -> None:
    f = np.geomspace(10, 300, 12)
    law = [
        {
            "frequency_hz": x,
            "storage_modulus_pa": 3e5 * x**0.2,
            "loss_factor": 0.8,
            "storage_modulus_standard_error_pa": 3e3,
            "loss_factor_standard_error": 0.01,
        }
        for x in f.tolist()
    ]
    parameters = {"g0_pa": 3e5, "ginf_pa": 4e6, "tau_s": 1.4e-4, "alpha": 0.89}
    found = {"law_kind": "fractional-zener", "parameters": parameters, "law": law, "temperature_c": 21.5}
    found["standard_errors"] = {k: v / 100 for k, v in parameters.items()}
    for name in ("found", "found2"):
        (folder / f"{name}.json").write_text(json.dumps(found, indent=1))
    ratio = {"ratio": 0.0029, "standard_error": 1e-5}
    mode = {"damping_ratio": 0.0029, "channel": "response", "half_power": ratio, "rational_fit": ratio}
    mode |= {"lscf": None, "lines_in_bandwidth": 9.0, "accepted": True, "why": ""}
    modes = [{"frequency_hz": f, **mode} for f in (17.71, 59.85, 110.12)]
    (folder / "hammer.json").write_text(json.dumps({"modes": modes, "hits": [], "warnings": []}, indent=1))


def _write_records(folder: Path) -> None:
    t = np.arange(SAMPLES) / RATE_HZ
    force = np.where((t > 0.02) & (t < 0.025), 100 * np.sin(np.pi * (t - 0.02) / 5e-3), 0.0)
    since = np.maximum(t - 0.02, 0)
    response = sum(np.exp(-0.03 * f * since) * np.sin(2 * np.pi * f * since) for f in (17.7, 59.8, 110.1))
    rows = [f"{a:.5f},{b:.5f}" for a, b in zip(force, response, strict=True)]
    head = f"# sample_rate_hz: {RATE_HZ}\nforce_n,acceleration_m_s2\n"
    (folder / "hits.csv").write_text(head + "\n".join(rows) + "\n")
    f = np.arange(5.0, 130.0, 0.25)
    w = 2 * np.pi * f
    H = sum(
        -(w**2) / ((2 * np.pi * r) ** 2 - w**2 + 2j * 0.003 * 2 * np.pi * r * w) for r in (17.7, 59.8, 110.1)
    )
    table = [f"{x},{h.real:.7g},{h.imag:.7g}" for x, h in zip(f, H, strict=True)]
    (folder / "frf.csv").write_text("frequency_hz,accelerance_re,accelerance_im\n" + "\n".join(table) + "\n")
    lines = [f"{x:.6f}\t{a:.5f}\t{b:.5f}" for x, a, b in zip(t, force, response, strict=True)]
    (folder / "hits.lvm").write_text(_LVM.format(samples=SAMPLES, step=1 / RATE_HZ) + "\n".join(lines) + "\n")
    savemat(folder / "hits.mat", mat_variables(force, response), oned_as="column")
    savemat(folder / "lab.mat", lab_variables(force, response), oned_as="column")
    _write_uff(folder / "hits.uff", [("force", 13, force), ("response", 12, response)])
    common = {"type": 58, "func_type": 4, "abscissa_spacing": 1, "abscissa_inc": 0.25, "abscissa_min": 5.0}
    units = {"abscissa_spec_data_type": 18, "ordinate_spec_data_type": 12, "orddenom_spec_data_type": 13}
    names = {"rsp_node": 1, "rsp_dir": 3, "ref_node": 3, "ref_dir": 3, "binary": 0}
    frf = {**common, **units, **names, "num_pts": len(f), "data": H, "x": f, "id1": "FRF", "ord_data_type": 6}
    pyuff.UFF(str(folder / "frf.uff")).write_sets([frf], mode="overwrite")


def _write_uff(path, channels):
    sets = [
        {
            "type": 58,
            "func_type": 1,
            "abscissa_spacing": 1,
            "abscissa_inc": 1 / RATE_HZ,
            "abscissa_min": 0.0,
            "abscissa_spec_data_type": 17,
            "ordinate_spec_data_type": code,
            "orddenom_spec_data_type": 0,
            "rsp_node": 1,
            "rsp_dir": 3,
            "ref_node": 3,
            "ref_dir": 3,
            "binary": 0,
            "num_pts": SAMPLES,
            "data": samples,
            "x": np.arange(SAMPLES) / RATE_HZ,
            "id1": name,
            "ord_data_type": 4,
        }
        for name, code, samples in channels
    ]
    pyuff.UFF(str(path)).write_sets(sets, mode="overwrite")


def mat_variables(force, response):
    """As this program's own names have it."""
    return {"force_n": force, "acceleration_m_s2": response, "sample_rate_hz": RATE_HZ}


def lab_variables(force, response):
    """A struct a function, as an LMS Test.Lab export has it."""
    axis = {
        "start_value": 0.0,
        "increment": 1 / RATE_HZ,
        "number_of_values": SAMPLES,
        "quantity": {"label": "s"},
    }
    return {
        name: {"x_values": axis, "y_values": {"values": samples, "quantity": {"label": unit}}}
        for name, unit, samples in (("Force", "N", force), ("Accel", "m/s^2", response))
    }


_LVM = (
    "LabVIEW Measurement\t\nWriter_Version\t2\nReader_Version\t2\nSeparator\tTab\nDecimal_Separator\t.\n"
    "Multi_Headings\tNo\nX_Columns\tOne\nTime_Pref\tRelative\n***End_of_Header***\t\n\n"
    "Channels\t2\nSamples\t{samples}\t{samples}\nY_Unit_Label\tN\tm/s^2\nX_Dimension\tTime\tTime\n"
    "X0\t0\t0\nDelta_X\t{step}\t{step}\n***End_of_Header***\nX_Value\tForce\tAcceleration\tComment\n"
)
