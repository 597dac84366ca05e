"""Valid files of every format, spoiled at random with a seed, and what a command may do with them.

A command may do its work (0), or refuse in one line (2): no traceback, no warning of a library, no NaN said
as a number, no control character on the terminal, no file left by a refusal.
"""

import copy
import json
import math
import re
import shutil
import tomllib
from datetime import date
from pathlib import Path

import h5py
import numpy as np
import pyuff
from conftest import DATA
from scipy.io import savemat

from instrument.files.new_file import TEMPLATES

RATE_HZ, SAMPLES = 1024.0, 2048
NASTY = (
    "nan",
    "inf",
    "-inf",
    "1e308",
    "-1e308",
    "1e-308",
    "0",
    "-0.0",
    "-1",
    "1e400",
    "",
    "abc",
    "1,5",
    "\x1b[31mred",
    "\x1b]0;title\x07",
    "1e9",
    "1e-9",
    "99999999999999999999",
    "4294967296",
    "true",
    "[]",
    "null",
    "\u202e12",
    "2",
)
VALUES = (
    None,
    True,
    0,
    -1,
    1,
    1e308,
    1e-308,
    10**30,
    math.nan,
    math.inf,
    "",
    "x",
    "\x1b[2J",
    "../../x",
    "/tmp/x",
    {},
    [],
    [[]],
    [1, 2, 3],
    ["a"],
    {"a": 1},
    "9" * 400,
    1e9,
    65,
    0.5,
    [1e300] * 3,
    "a" * 3000,
)
_NUMBER = re.compile(r"(?<![A-Za-z_\d.])[-+]?\d+\.?\d*(?:[eE][-+]?\d+)?")
_CONTROL = re.compile(r"[\x00-\x08\x0b-\x1f\x7f-\x9f\u202a-\u202e\u2066-\u2069]")
_NOT_A_NUMBER = re.compile(r"(?<![\w./-])[-+]?(?:nan|inf)(?![\w./-])", re.I)

COMMANDS = {
    "sweep.csv": (
        "identify {} --specimen coarse.toml",
        "import {} --out out.csv",
    ),
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
    for kind in ("beam", "shear-pair", "experiment", "rig"):
        (folder / f"{kind}.toml").write_text(TEMPLATES[kind].read_text())
    (folder / "specimen.toml").write_text(TEMPLATES["plate"].read_text())
    _write_found(folder)
    _write_records(folder)
    if session is not None:
        shutil.copy(session, folder / "small.h5")


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


# Spoiling


def spoil(path: Path, rng, *, bytes_of_hdf=False) -> None:
    """One file, in place, in one of the ways of its format."""
    if path.suffix == ".h5" and not (bytes_of_hdf and rng.random() < 0.3):
        spoil_session(path, rng)
        return
    if path.suffix == ".mat" and rng.random() < 0.7:
        spoil_mat(path, rng)
        return
    content = path.read_bytes()
    if path.suffix == ".json" and rng.random() < 0.8:
        tree = spoil_tree(json.loads(content), rng)
        path.write_text(json.dumps(tree, default=str))
    elif path.suffix == ".toml" and rng.random() < 0.6:
        path.write_text(toml_text(spoil_tree(tomllib.loads(content.decode()), rng)))
    elif path.suffix in (".mat", ".h5") or rng.random() < 0.2:
        path.write_bytes(spoil_bytes(content, rng))
    else:
        path.write_text(spoil_text(content.decode(), rng), encoding="utf-8", errors="replace")


def spoil_bytes(content: bytes, rng) -> bytes:
    """Bits turned, stretches lost, repeated, zeroed; cut off."""
    b = bytearray(content)
    for _ in range(rng.choice((1, 1, 2, 8))):
        i = rng.randrange(max(1, len(b)))
        j = min(len(b), i + rng.choice((1, 4, 64, 512)))
        way = rng.randrange(6)
        if way == 0 and b:
            b[i] ^= 1 << rng.randrange(8)
        elif way == 1:
            del b[i:j]
        elif way == 2:
            b[i:i] = b[i:j] * rng.choice((1, 20))
        elif way == 3:
            b[i:j] = bytes(j - i)
        elif way == 4:
            b[i:j] = b"\xff" * (j - i)
        else:
            del b[i:]
    return bytes(b)


def spoil_text(text: str, rng) -> str:
    """Numbers, cells, columns and lines."""
    way = rng.randrange(6)
    lines = text.split("\n")
    if way <= 1:
        found = list(_NUMBER.finditer(text))
        for m in sorted(rng.sample(found, min(len(found), rng.choice((1, 1, 3)))), key=lambda m: -m.start()):
            text = text[: m.start()] + rng.choice(NASTY) + text[m.end() :]
        return text
    if way == 2:
        return "\n".join(lines[: rng.randrange(len(lines))])
    if way == 3:
        i, j = rng.randrange(len(lines)), rng.randrange(len(lines))
        lines[i] = rng.choice(
            (lines[j], "", lines[i] * 3, "\ufeff" + lines[i], '"' + lines[i], "[x]" + lines[i])
        )
        return "\n".join(lines)
    return "\n".join(_columns_spoiled(lines, rng))


def _columns_spoiled(lines, rng):
    separator = "\t" if "\t" in lines[-2] else ","
    first = next((k for k, line in enumerate(lines) if separator in line and not line.startswith("#")), 0)
    rows = [line.split(separator) for line in lines[first:] if line]
    at, way, value = rng.randrange(len(rows[0])), rng.randrange(6), rng.choice(NASTY)
    for k, row in enumerate(rows):
        if at >= len(row):
            continue
        if way == 0:
            del row[at]
        elif way == 1:
            row.append(row[at])
        elif way == 2 and k:
            row[at] = value
        elif way == 3 and k:
            row[at] = _scaled(row[at], 1e300 if at % 2 else -1.0)
        elif way == 4 and k == 0:
            row[at] = rng.choice(
                ("frequency_hz", "velocity_m_s", "hit", "time_s", "\x1b[2J", "weight", "coherence")
            )
    if way == 5:
        rows = rows[:1] + [rows[-1]] * rng.choice((1, 2, 40))
    return [*lines[:first], *(separator.join(row) for row in rows), ""]


def _scaled(cell, factor):
    try:
        return repr(float(cell) * factor)
    except ValueError:
        return cell


def spoil_tree(tree, rng):
    """Nodes of a JSON or TOML tree taken out, doubled, scaled, made something else."""
    tree = copy.deepcopy(tree)
    for _ in range(rng.choice((1, 1, 2))):
        places = list(_places(tree))
        if not places:
            return tree
        inside, key = rng.choice(places)
        way, old = rng.randrange(6), inside[key]
        if way == 0:
            del inside[key]
        elif way == 1 and isinstance(old, list):
            inside[key] = old * rng.choice((0, 2, 200))
        elif way <= 2 and isinstance(old, int | float) and not isinstance(old, bool):
            inside[key] = old * rng.choice((-1, 1e3, 1e-3, 1e9, 1e-9, 0))
        elif way == 3 and isinstance(inside, dict):
            inside[f"x_{key}"] = old
        else:
            inside[key] = rng.choice(VALUES)
    return tree


def _places(tree):
    items = tree.items() if isinstance(tree, dict) else enumerate(tree) if isinstance(tree, list) else ()
    for key, value in list(items):
        yield tree, key
        yield from _places(value)


def toml_text(tree) -> str:
    return "\n".join(f"{json.dumps(str(k))} = {_toml(v)}" for k, v in tree.items()) + "\n"


def _toml(v):
    if isinstance(v, float):
        return "nan" if v != v else ("inf" if v > 0 else "-inf") if math.isinf(v) else repr(v)
    if isinstance(v, list):
        return "[" + ", ".join(_toml(x) for x in v) + "]"
    if isinstance(v, dict):
        return "{" + ", ".join(f"{json.dumps(str(k))} = {_toml(x)}" for k, x in v.items()) + "}"
    if isinstance(v, date):
        return v.isoformat()
    return json.dumps(v if isinstance(v, bool | int) else str(v or ""))


def spoil_mat(path: Path, rng) -> None:
    """Variables of another shape, kind or name; structs without a field."""
    t = np.arange(64) / RATE_HZ
    variables = (lab_variables if path.name.startswith("lab") else mat_variables)(
        np.sin(40 * t), np.cos(30 * t)
    )
    odd = (
        np.zeros((0, 0)),
        np.zeros((3, 0)),
        np.ones((4, 4, 2)),
        np.ones(64) * 1j,
        np.full(64, np.nan),
        np.zeros(64),
        "text",
        np.array([["a", 1.0]], dtype=object),
        {},
        {"label": 3},
        5.0,
        np.ones(1),
        np.ones(64, bool),
        1e308,
        np.full(64, 1e300),
        np.arange(64.0)[::-1],
        np.array([]),
        -1.0,
    )
    inside, key = rng.choice(list(_places(variables)))
    if rng.random() < 0.2:
        del inside[key]
    else:
        inside[key] = rng.choice(odd)
    savemat(path, variables, oned_as=rng.choice(("column", "row")))


def spoil_session(path: Path, rng) -> None:
    """Event lines, the configuration, data sets of another kind."""
    with h5py.File(path, "r+") as file:
        way = rng.randrange(8)
        if way == 0:
            file["configuration"][()] = json.dumps(spoil_tree(json.loads(file["configuration"][()]), rng))
            return
        part = file["parts"][rng.choice(list(file["parts"]))]
        if way == 1:
            name = rng.choice(list(part))
            del part[name]
            odd = (
                np.zeros(3),
                np.zeros((2, 2)),
                5,
                "text",
                np.zeros((0, 4), np.int32),
                np.full((2, 9), 7, np.int32),
            )
            if rng.random() < 0.8:
                part[name] = rng.choice(odd)
            return
        lines = [json.loads(line) for line in part["events"][()]]
        k = rng.randrange(len(lines))
        if way == 2:
            del lines[k : k + rng.choice((1, 1, 5))]
        elif way == 3:
            lines.insert(rng.randrange(len(lines)), lines[k])
        else:
            lines[k] = spoil_tree(lines[k], rng)
        texts = [json.dumps(line) for line in lines]
        if way == 4 and texts:
            texts[0] = texts[0][:-3]
        del part["events"]
        part.create_dataset("events", data=texts, dtype=h5py.string_dtype())


# Judging


def faults_of(status: int, out: str, err: str, left: list[str], *, said_at_once: bool = False) -> list[str]:
    """What a command must not do; `left` are the files it made; `said_at_once`: all faults, a line each."""
    faults = []
    if status not in (0, 2, 3):
        faults.append(f"status {status}")
    if "Traceback" in err or "Warning" in err:
        faults.append("a traceback or a warning")
    if _CONTROL.search(out) or _CONTROL.search(err):
        faults.append("a control character")
    if _NOT_A_NUMBER.search(out):
        faults.append("NaN said as a number")
    if status == 2 and not said_at_once and len(err.strip().splitlines()) != 1:
        faults.append(f"{len(err.strip().splitlines())} lines of refusal")
    if status == 2 and left:
        faults.append(f"refused, but left {', '.join(left)}")
    return faults
