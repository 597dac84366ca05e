"""Files of every format, spoiled at random with a seed, and what a command may do with them.

A command may do its work (0), or refuse in one line (2): no traceback, no warning of a library, no NaN said
as a number, no control character on the terminal, no file left by a refusal.
"""

import copy
import json
import math
import re
import tomllib
from datetime import date
from pathlib import Path

import h5py
import numpy as np
from attacked_files import RATE_HZ, lab_variables, mat_variables
from scipy.io import savemat

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
