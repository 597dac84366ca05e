"""Mistakes a new user makes: what is done to valid files, the command, and what its one line has to say."""

import json
import re
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import numpy as np

IDENTIFY = "identify sweep.csv --specimen coarse.toml"
MODES = "modes coarse.toml --count 2"
OF_MODES = "identify modes.csv --specimen beam.toml"


@dataclass(frozen=True)
class Mistake:
    """One; `said` is a regular expression."""

    name: str
    do: Callable[[Path], None]
    command: str
    said: str
    plausibility: bool = False
    """Whether `--force` goes on all the same."""


def stated(key: str, value: str, command: str = MODES, said: str = "", *, sure: bool = False) -> Mistake:
    """A number of the specimen; `sure`: beyond what the file may hold at all."""
    table, _, name = key.partition(".")

    def do(folder: Path) -> None:
        path = folder / "coarse.toml"
        head, mark, tail = path.read_text().partition(f"[{table}]\n")
        path.write_text(head + mark + re.sub(rf"(?m)^{name} = .*$", f"{name} = {value}", tail, count=1))

    return Mistake(f"{key} = {value}", do, command, said or rf"{key}", not sure)


def text(
    name: str, file: str, old: str, new: str, command: str, said: str, *, plausibility: bool = False
) -> Mistake:
    def do(folder: Path) -> None:
        content = (folder / file).read_text()
        assert old in content
        (folder / file).write_text(content.replace(old, new))

    return Mistake(name, do, command, said, plausibility)


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


def wrong(command: str, said: str, *, insists: bool = False) -> Mistake:
    """A file of another kind."""
    return Mistake(command, lambda folder: None, command, said, insists)


def made(name: str, command: str, said: str, content: str | None = None) -> Mistake:
    """`taken` is a folder, or a file with some content."""

    def do(folder: Path) -> None:
        if content is None:
            (folder / "taken").mkdir()
        else:
            (folder / "taken").write_text(content)

    return Mistake(name, do, command, said)


def pair(key: str, value: str, said: str) -> Mistake:
    """A number of the shear pair."""

    def do(folder: Path) -> None:
        path = folder / "shear-pair.toml"
        path.write_text(re.sub(rf"(?m)^{key} = \S+", f"{key} = {value}", path.read_text()))

    command = "predict shear-pair.toml --frequencies 20"
    return Mistake(f"shear-pair.{key} = {value}", do, command, rf"shear-pair\.{key}.*{said}", True)


def table_of_modes(pattern: str, by: str, column: str = ""):
    """Every row changed, and a column more."""

    def do(folder: Path) -> None:
        head, *rows = (folder / "modes.csv").read_text().splitlines()
        changed = [re.sub(pattern, by, row, count=1) for row in rows]
        (folder / "modes.csv").write_text("\n".join([head + column, *changed]) + "\n")

    return do


def dma(pattern: str, by: str):
    """A DMA's rows."""

    def do(folder: Path) -> None:
        path = folder / "dma.csv"
        path.write_text(re.sub(pattern, by, path.read_text()))

    return do


def in_khz(folder):
    path = folder / "modes.csv"
    head, *rows = [line.split(",") for line in path.read_text().splitlines()]
    k = head.index("frequency_hz")
    for row in rows:
        row[k] = f"{float(row[k]) / 1000:.6g}"
    path.write_text("\n".join(",".join(row) for row in (head, *rows)) + "\n")


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


def hammer(change):
    def do(folder: Path) -> None:
        found = json.loads((folder / "hammer.json").read_text())
        for mode in found["modes"]:
            change(mode)
        (folder / "hammer.json").write_text(json.dumps(found))

    return do


def of_another_plate(mode):
    mode["frequency_hz"] *= 1.37


def in_percent(mode):
    mode["damping_ratio"] *= 100


def commas(table):
    return table.replace(",", ";").replace(".", ",")


SPECIMEN = [
    stated("substrate.young_gpa", "68900.0"),
    stated("substrate.young_gpa", "68.9e9", sure=True),
    stated("substrate.young_gpa", "0.0689"),
    stated("constraining.young_gpa", "209000.0"),
    stated("constraining.young_gpa", "0.209"),
    stated("substrate.density_kg_m3", "2.7"),
    stated("constraining.density_kg_m3", "7.89"),
    stated("core.density_kg_m3", "0.7895"),
    stated("substrate.density_kg_m3", "2.7e6"),
    stated("substrate.thickness_mm", "0.0019"),
    stated("substrate.thickness_mm", "1900.0"),
    stated("core.thickness_mm", "0.0005"),
    stated("core.thickness_mm", "500.0"),
    stated("constraining.thickness_mm", "0.0003"),
    stated("constraining.thickness_mm", "300.0"),
    stated("plate.length_mm", "0.3002", sure=True, said="plate|pickup"),
    stated("plate.length_mm", "300200.0"),
    stated("plate.width_mm", "0.1999", sure=True, said="plate|pickup"),
    stated("plate.width_mm", "199900.0"),
    stated("pickup.x_mm", "0.06", IDENTIFY),
    stated("pickup.x_mm", "60e3", sure=True),
    stated(
        "damping.modal_percent", "[0.0029, 0.0013, 0.0018, 0.0021, 0.0011, 0.0007, 0.0009, 0.0004]", IDENTIFY
    ),
    stated("damping.modal_percent", "[29, 13, 18, 21, 11, 7, 9, 4]", IDENTIFY),
    stated("base.acceleration_m_s2", "9810.0", "predict coarse.toml --frequencies 20"),
    stated("core.poisson", "49.0", sure=True),
    stated("core.density_kg_m3", "789500.0"),
    text(
        "law in Pa",
        "coarse.toml",
        "g0_mpa = 0.40268\nginf_mpa = 4.1946",
        "g0_mpa = 402680.0\nginf_mpa = 4194600.0",
        MODES,
        "core.law",
    ),
    text(
        "law in GPa",
        "coarse.toml",
        "g0_mpa = 0.40268\nginf_mpa = 4.1946",
        "g0_mpa = 0.00040268\nginf_mpa = 0.0041946",
        MODES,
        "core.law",
        plausibility=True,
    ),
    text("young_mpa", "coarse.toml", "young_gpa = 68.9", "young_mpa = 68900.0", MODES, "nearest.*young_gpa"),
    text("length_m", "coarse.toml", "length_mm = 300.2", "length_m = 0.3002", MODES, "nearest.*length_mm"),
    text("[substrat]", "coarse.toml", "[substrate]", "[substrat]", MODES, "nearest.*substrate"),
    text(
        "decimal comma",
        "coarse.toml",
        "thickness_mm = 1.9",
        "thickness_mm = 1,9",
        MODES,
        "line 10.*decimal point",
    ),
]
SPECIMEN += [
    stated("substrate.poisson", "0.03"),
    text(
        "tolerance as a fraction",
        "coarse.toml",
        "exact = true ",
        "core_thickness_percent = 0.03 ",
        MODES,
        "core_thickness_percent.*fraction",
        plausibility=True,
    ),
    text(
        "tolerance in um",
        "coarse.toml",
        "exact = true ",
        "pickup_mm = 300.0 ",
        MODES,
        "pickup_mm.*in um",
        plausibility=True,
    ),
    text("clamped", "coarse.toml", '"cantilever"', '"clamped"', MODES, "plate.boundary.*'cantilever'"),
    text("[core] twice", "coarse.toml", "[damping]", "[core]\n\n[damping]", MODES, "line 33"),
    text(
        "no brackets",
        "coarse.toml",
        "[0.29, 0.13, 0.18, 0.21, 0.11, 0.07, 0.09, 0.04]",
        "0.29",
        MODES,
        "list",
    ),
    text("a number in quotes", "coarse.toml", "= 68.9", '= "68.9"', MODES, "young_gpa.*valid number"),
]
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
    column("real and imaginary part swapped", turned, "plate"),
]
FILES = [
    Mistake("hammer of another plate", hammer(of_another_plate), f"{IDENTIFY} --hammer hammer.json", "mode"),
    Mistake("hammer in percent", hammer(in_percent), f"{IDENTIFY} --hammer hammer.json", "percent"),
    wrong("damping frf.csv --at 28,5", "decimal comma|decimal point"),
    wrong("identify coarse.toml --specimen coarse.toml", "coarse.toml"),
    wrong("identify sweep.csv --specimen rig.toml", "rig.toml"),
    wrong("identify sweep.csv", "--specimen"),
    wrong("identify sweep.csv --specimen coarse.toml --hammer found.json", "found.json"),
    wrong("identify hits.csv --specimen coarse.toml", "hits.csv"),
    wrong("diagnose found.json --specimen coarse.toml", "found.json"),
    wrong("modes sweep.csv", "sweep.csv"),
    wrong("modes rig.toml", "rig.toml"),
    wrong("predict experiment.toml --frequencies 20", "experiment.toml"),
    wrong("damping sweep.csv", "sweep.csv"),
    wrong("damping coarse.toml", "coarse.toml"),
    wrong("check coarse.toml", "coarse.toml"),
    wrong("run rig.toml", "rig.toml"),
    wrong("report sweep.csv", "sweep.csv"),
    wrong("replay coarse.toml", "coarse.toml"),
    wrong("export found.json --to csv", "found.json"),
    wrong("card sweep.csv --to csv", "sweep.csv"),
    wrong("compare coarse.toml found.json", "coarse.toml"),
    wrong("batch coarse.toml", "coarse.toml"),
    wrong("recover sweep.csv", "sweep.csv"),
    wrong("import coarse.toml", "coarse.toml"),
    wrong("identify nowhere.csv --specimen coarse.toml", "nowhere.csv"),
    wrong("predict coarse.toml --frequencies 20;30", "20;30"),
]
PLACES = [
    wrong(
        "modes coarse.toml --count 2 --json coarse.toml", "coarse.toml: read by this command.*another name"
    ),
    wrong("damping hits.csv --json hits.csv", "hits.csv: read by this command"),
    wrong("card found.json --to json --out found.json", "found.json: read by this command"),
    made("--json is a folder", "modes coarse.toml --count 2 --json taken", "taken: is a folder"),
    made("a folder for the data", "identify taken --specimen coarse.toml", "taken: Is a directory"),
    made("a folder for the specimen", "modes taken", "taken: Is a directory"),
    made("a folder for the sensors", "sensors taken", "taken: Is a directory"),
    made("a folder for a new file", "new plate taken", "taken: there is a file already"),
    made("a card into a folder", "card found.json --to abaqus --out taken", "'taken' is a directory"),
    made(
        "a batch into a file", "batch sweep.csv --specimen coarse.toml --out taken", "'taken' is a file", "x"
    ),
    made("figures into a file", "plan coarse.toml --figures taken", "'taken' is a file", "x"),
    made("sessions into a file", "run experiment.toml --out taken", "'taken' is a file", "x"),
    wrong("modes coarse.toml --count 2 --json nowhere/x.json", "no such folder"),
    wrong("card found.json --to abaqus --out nowhere/x.inp", "no such folder"),
    wrong("plan coarse.toml --experiment nowhere/e.toml", "no such folder"),
    wrong("new plate coarse.toml", "coarse.toml: there is a file already"),
    wrong("new plate sheet.csv", "ending '.csv', expected .toml"),
    wrong("identify sweep.csv ./sweep.csv --specimen coarse.toml", "sweep.csv: named twice"),
    wrong("compare found.json found.json", "found.json: named twice"),
    wrong("damping hits.csv hits.csv", "hits.csv: named twice"),
    made("a batch of nothing", "batch taken", "begins with a column 'data'", ""),
    made(
        "a batch by semicolons", "batch taken", "commas between its columns", "data;specimen\na.csv;b.toml\n"
    ),
    made("sensors in an empty file", "sensors taken", "empty", ""),
    made("a law in an empty file", "compare found.json taken", "empty", ""),
    made("no session", "export taken --to csv", "not a session", "x"),
    wrong("plan beam.toml", "a beam, expected a plate"),
    wrong("plan coarse.toml --level 9.81m/s", "0.5g or 4.9m/s2"),
    wrong("plan coarse.toml --band 10,300", "LOW:HIGH"),
    wrong("doctor sweep.csv", "sweep.csv"),
    wrong("compare found.json", "one file, expected two"),
    wrong("modes grö\u00dfe².toml", "grö\u00dfe².toml: No such file"),
    wrong("identify modes.csv --specimen coarse.toml", "modes.csv: no core.*another specimen", insists=True),
    Mistake("modes in kHz", in_khz, OF_MODES, "modes.csv.*in kHz", True),
    Mistake("a loss in percent", table_of_modes(r"0\.221$", "22.1"), OF_MODES, "22.1.*in percent", True),
    Mistake("modes in kelvin", table_of_modes(r"$", ",293.0", ",temperature_c"), OF_MODES, "in K", True),
    Mistake("kHz to diagnose", in_khz, "diagnose modes.csv --specimen beam.toml", "modes.csv.*in kHz", True),
    Mistake("DMA in MPa", dma(r",300000,", ",0.3,"), f"{IDENTIFY} --with dma.csv", "dma.csv.*in MPa"),
    Mistake("DMA's loss modulus", dma(r",0\.8\n", ",240000\n"), f"{IDENTIFY} --with dma.csv", "loss modulus"),
    text("rate in kHz", "hits.csv", "1024.0", "1.024", "damping hits.csv", "not kHz"),
    wrong("identfy sweep.csv", "is it 'identify'"),
    wrong("sweep.csv", "a file, expected a command before it"),
    made(
        "a report for a word processor",
        "report taken --out report.docx",
        "ending '.docx', expected .html",
        "x",
    ),
    made(
        "sheets with a page's ending", "report taken --pdf report.html", "ending '.html', expected .pdf", "x"
    ),
    wrong("predict coarse.toml --frequencies 14:310", "A:B:STEP"),
    wrong("predict coarse.toml --frequencies 0,20", "above 0 Hz"),
    wrong("modes coarse.toml --count 0", "range"),
    text(
        "segment upside down",
        "experiment.toml",
        "low_hz = 235.0\nhigh_hz = 295.0",
        "low_hz = 295.0\nhigh_hz = 235.0",
        "check experiment.toml",
        "low_hz = 295 is not below",
    ),
    text("no hits", "experiment.toml", "hits = 4", "hits = 0", "check experiment.toml", "hammer.hits"),
    text("hit beside it", "experiment.toml", "= 285.0", "= 385.0", "check experiment.toml", "off the plate"),
    text(
        "level in m/s2",
        "experiment.toml",
        "level_g = 1.0",
        "level_g = 9.81",
        "check experiment.toml",
        "limit 50",
    ),
    text(
        "hit in m",
        "experiment.toml",
        "= 285.0",
        "= 0.285",
        "check experiment.toml",
        "hit_x_mm.*in m",
        plausibility=True,
    ),
    text(
        "band upside down",
        "experiment.toml",
        "[10.0, 550.0]",
        "[550.0, 10.0]",
        "check experiment.toml",
        "lower frequency first",
    ),
    text(
        "band in kHz",
        "experiment.toml",
        "[10.0, 550.0]",
        "[0.01, 0.55]",
        "check experiment.toml",
        "in kHz",
        plausibility=True,
    ),
    text(
        "torque in N mm",
        "experiment.toml",
        "torque_n_m = 25.0",
        "torque_n_m = 25000.0",
        "check experiment.toml",
        "in N mm",
        plausibility=True,
    ),
    text(
        "sensitivity in V",
        "rig.toml",
        "= 10.0 ",
        "= 0.01 ",
        "check experiment.toml",
        "base.*in V",
        plausibility=True,
    ),
    text(
        "sensitivity per g",
        "rig.toml",
        "= 10.0 ",
        "= 1000.0 ",
        "check experiment.toml",
        "mV per g",
        plausibility=True,
    ),
    text(
        "hammer per kN",
        "rig.toml",
        "= 20.0 ",
        "= 20000.0 ",
        "run experiment.toml",
        "mV per kN",
        plausibility=True,
    ),
    text(
        "limit in mm/s",
        "rig.toml",
        "= 1.0\ntravel",
        "= 1000.0\ntravel",
        "check experiment.toml",
        "in mm/s",
        plausibility=True,
    ),
    text(
        "travel in m",
        "rig.toml",
        "travel_mm = 5.0",
        "travel_mm = 0.005",
        "check experiment.toml",
        "in m",
        plausibility=True,
    ),
    text(
        "drive in mV",
        "rig.toml",
        "drive_v = 5.0",
        "drive_v = 5000.0",
        "check experiment.toml",
        "in mV",
        plausibility=True,
    ),
    text(
        "sensor in kg",
        "rig.toml",
        "mass_g = 0.6",
        "mass_g = 0.0006",
        "check experiment.toml",
        "in kg",
        plausibility=True,
    ),
    text("one input twice", "rig.toml", "input = 2", "input = 1", "check experiment.toml", "both base and"),
    text(
        "rate of a rig in kHz", "rig.toml", "= 8192.0", "= 8.192", "check experiment.toml", "sample_rate_hz"
    ),
    pair("mass_kg", "573.0", "is it in g"),
    pair("thickness_mm", "0.006", "is it in m"),
    pair("outer_diameter_mm", "30000.0", "is it in um"),
]
"""Files that are no file, names taken, the same twice, and other specimens."""
MISTAKES = [*SPECIMEN, *SHEETS, *DATA, *FILES, *PLACES]
