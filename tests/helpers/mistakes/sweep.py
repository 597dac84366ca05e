"""A sweep's table, its notation and its numbers."""

from collections.abc import Callable
from pathlib import Path

import numpy as np

from mistakes.kinds import IDENTIFY, Mistake, text
from mistakes.specimen import stated


def column(name: str, change: Callable[[dict[str, np.ndarray]], None], said: str) -> Mistake:
    """The sweep's numbers, by column."""

    def do(folder: Path) -> None:
        lines = (folder / "sweep.csv").read_text().splitlines()
        head = lines[0].split(",")
        table = np.array([[float(x or "nan") for x in line.split(",")] for line in lines[1:]])
        columns = dict(zip(head, table.T.copy(), strict=True))
        change(columns)
        rows = [",".join(f"{x:.12g}" for x in row) for row in zip(*columns.values(), strict=True)]
        (folder / "sweep.csv").write_text("\n".join([",".join(columns), *rows]) + "\n")

    return Mistake(name, do, IDENTIFY, said, True)


def sheet(name: str, change: Callable[[str], str | bytes], said: str, command: str = IDENTIFY) -> Mistake:
    """The sweep's text."""

    def do(folder: Path) -> None:
        made = change((folder / "sweep.csv").read_text())
        (folder / "sweep.csv").write_bytes(made if isinstance(made, bytes) else made.encode())

    return Mistake(name, do, command, said)


def velocity(c, factor):
    """Both parts times a number, or a number a row."""
    v = (c["velocity_re_m_s"] + 1j * c["velocity_im_m_s"]) * factor
    c["velocity_re_m_s"], c["velocity_im_m_s"] = v.real, v.imag


def frequency(c, factor):
    c["frequency_hz"] = c["frequency_hz"] * factor


def swapped(c):
    for part in ("re", "im"):
        v, a = f"velocity_{part}_m_s", f"base_accel_{part}_m_s2"
        c[v], c[a] = c[a], c[v]


def base_in_g(c):
    for part in ("re", "im"):
        c[f"base_accel_{part}_m_s2"] = c[f"base_accel_{part}_m_s2"] / 9.80665


def turned(c):
    c["velocity_re_m_s"], c["velocity_im_m_s"] = c["velocity_im_m_s"], c["velocity_re_m_s"]


def conjugated(c):
    for name in ("velocity_im_m_s", "base_accel_im_m_s2"):
        c[name] = -c[name]


def commas(table):
    return table.replace(",", ";").replace(".", ",")


SHEETS = [
    sheet("level for level_g", lambda t: t.replace("level_g", "level"), "level.*nearest.*level_g"),
    sheet("freq_hz", lambda t: t.replace("frequency_hz", "freq_hz"), "frequency_hz missing.*freq_hz"),
    sheet("velocity_re_mm_s", lambda t: t.replace("velocity_re_m_s", "velocity_re_mm_s"), "velocity_re_m_s"),
    sheet("no imaginary part", lambda t: t.replace("velocity_im_m_s", "remark"), "velocity_im_m_s"),
    sheet("semicolons", lambda t: t.replace(",", ";"), "semicolon"),
    sheet("semicolons and decimal commas", commas, "semicolon.*decimal comma"),
    sheet("tabs", lambda t: t.replace(",", "\t"), "tab"),
    sheet("UTF-16", lambda t: t.encode("utf-16"), "UTF-16"),
    sheet("empty", lambda t: "", "empty"),
    sheet("a header alone", lambda t: t.splitlines()[0], "no rows"),
    sheet("doubled rows", lambda t: t + t.splitlines()[-1] + "\n", "same point"),
    sheet("units below the head", lambda t: t.replace("\n", "\n-,-,g,Hz,m/s,m/s,m/s2,m/s2,s\n", 1), "line 2"),
    sheet("capitals", lambda t: t.replace("frequency_hz", "Frequency_Hz"), "is it Frequency_Hz"),
    sheet("a frequency of nearly nothing", lambda t: t.replace(",14,", ",1e-30,", 1), "1e-06 Hz"),
    sheet("a cell without end", lambda t: t.replace(",14,", f",{'x' * 3000},", 1), r"'x{60}\.\.\.'"),
    sheet("a column twice", lambda t: t.replace("time_s", "level_g", 1), "level_g twice"),
    sheet("a row cut short", lambda t: t.rstrip().rpartition(",")[0] + "\n", "8 columns, expected 9"),
    sheet("a word for a number", lambda t: t.replace("0.", "o.", 1), "expected a number"),
]
DATA = [
    column("kelvin", lambda c: c.update(temperature_c=np.full_like(c["level_g"], 293.15)), "in K"),
    column("velocity in mm/s", lambda c: velocity(c, 1e3), "mm/s"),
    column("velocity in um/s", lambda c: velocity(c, 1e6), "um/s"),
    column("velocity in km/s", lambda c: velocity(c, 1e-3), "1000 times"),
    column("frequency in kHz", lambda c: frequency(c, 1e-3), "kHz"),
    column("frequency in rad/s", lambda c: frequency(c, 2 * np.pi), "rad/s"),
    column("conjugated", conjugated, "conjugate"),
    column("sign", lambda c: velocity(c, -1.0), "sign"),
    column("swapped cables", swapped, "swapped"),
    column("base in g", base_in_g, "in g"),
    column(
        "displacement for velocity",
        lambda c: velocity(c, 1 / (2j * np.pi * c["frequency_hz"])),
        "displacement",
    ),
    column(
        "acceleration for velocity", lambda c: velocity(c, 2j * np.pi * c["frequency_hz"]), "acceleration"
    ),
    stated("substrate.thickness_mm", "4.0", IDENTIFY, "plate|layer"),
    stated("plate.length_mm", "180.0", IDENTIFY, "plate"),
    text(
        "length and width swapped",
        "coarse.toml",
        "length_mm = 300.2          # x, from the clamp\nwidth_mm = 199.9",
        "length_mm = 199.9\nwidth_mm = 300.2",
        IDENTIFY,
        "plate",
        plausibility=True,
    ),
    column("real and imaginary part swapped", turned, "exchanged"),
]
