"""Files of another kind, and what stands in hammer tests, tables of modes and other materials' data."""

import json
import re
from pathlib import Path

from mistakes.kinds import IDENTIFY, Mistake, text, wrong

OF_MODES = "identify modes.csv --specimen beam.toml"


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


def at_spot(number: str):
    """An FRF's lines at a spot of that number."""

    def do(folder: Path) -> None:
        head, *rows = (folder / "frf.csv").read_text().splitlines()
        lines = [f"{head},pickup", *(f"{row},{number}" for row in rows)]
        (folder / "frf.csv").write_text("\n".join(lines) + "\n")

    return do


def in_khz(folder):
    path = folder / "modes.csv"
    head, *rows = [line.split(",") for line in path.read_text().splitlines()]
    k = head.index("frequency_hz")
    for row in rows:
        row[k] = f"{float(row[k]) / 1000:.6g}"
    path.write_text("\n".join(",".join(row) for row in (head, *rows)) + "\n")


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
    wrong("simulate coarse.toml", "a specimen, expected a rig"),
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
    wrong("identify modes.csv --specimen coarse.toml", "modes.csv: no core.*another specimen", insists=True),
    text(
        "an FRF's frequency",
        "frf.csv",
        "frequency_hz",
        "freq",
        "identify frf.csv --specimen coarse.toml",
        "column frequency_hz missing, found freq",
    ),
    *(
        Mistake(f"an FRF at spot {n}", at_spot(n), "identify frf.csv --specimen coarse.toml", f"pickup = {n}")
        for n in ("0.5", "1e20")
    ),
    Mistake("a mode of nearly nothing", table_of_modes("74.3", "1e-200"), OF_MODES, "1e-200.*1e-06 Hz"),
    wrong("predict coarse.toml --frequencies 1e-30,20", "at least 1e-06 Hz"),
    wrong("plan coarse.toml --band 1e-6:1", "at least 0.01 Hz"),
    Mistake("modes in kHz", in_khz, OF_MODES, "modes.csv.*in kHz", True),
    Mistake("a loss in percent", table_of_modes(r"0\.221$", "22.1"), OF_MODES, "22.1.*in percent", True),
    Mistake("modes in kelvin", table_of_modes(r"$", ",293.0", ",temperature_c"), OF_MODES, "in K", True),
    Mistake("kHz to diagnose", in_khz, "diagnose modes.csv --specimen beam.toml", "modes.csv.*in kHz", True),
    Mistake("DMA in MPa", dma(r",300000,", ",0.3,"), f"{IDENTIFY} --with dma.csv", "dma.csv.*in MPa"),
    Mistake("DMA's loss modulus", dma(r",0\.8\n", ",240000\n"), f"{IDENTIFY} --with dma.csv", "loss modulus"),
    text("rate in kHz", "hits.csv", "1024.0", "1.024", "damping hits.csv", "not kHz"),
    pair("mass_kg", "573.0", "is it in g"),
    pair("thickness_mm", "0.006", "is it in m"),
    pair("outer_diameter_mm", "30000.0", "is it in um"),
]
