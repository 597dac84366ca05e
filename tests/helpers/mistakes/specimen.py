"""What a plate's file says: units, names, notation."""

import re
from pathlib import Path

from mistakes.kinds import IDENTIFY, MODES, Mistake, text


def stated(key: str, value: str, command: str = MODES, said: str = "", *, sure: bool = False) -> Mistake:
    """A number of the specimen; `sure`: beyond what the file may hold at all."""
    table, _, name = key.partition(".")

    def do(folder: Path) -> None:
        path = folder / "coarse.toml"
        head, mark, tail = path.read_text().partition(f"[{table}]\n")
        path.write_text(head + mark + re.sub(rf"(?m)^{name} = .*$", f"{name} = {value}", tail, count=1))

    return Mistake(f"{key} = {value}", do, command, said or rf"{key}", not sure)


def put(name: str, old: str, new: str, said: str, *, sure: bool = True) -> Mistake:
    return text(name, "coarse.toml", old, new, MODES, said, plausibility=not sure)


def law(unit: str, factor: str, *, sure: bool = False) -> Mistake:
    """Both moduli, stated in MPa, times a power of ten."""
    old = "g0_mpa = 0.40268\nginf_mpa = 4.1946"
    return put(f"law in {unit}", old, re.sub(r"(?m)$", factor, old), "core.law", sure=sure)


def tolerance(in_what: str, key: str, value: str, said: str) -> Mistake:
    return put(f"tolerance {in_what}", "exact = true ", f"{key} = {value} ", f"{key}.*{said}", sure=False)


SPECIMEN = [
    stated("plate.length_mm", "0.3002", said="plate.length_mm = 0.3002, is it in m", sure=True),
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
    law("Pa", "e6", sure=True),
    law("GPa", "e-3"),
    put("young_mpa", "young_gpa = 68.9", "young_mpa = 68900.0", "nearest.*young_gpa"),
    put("length_m", "length_mm = 300.2", "length_m = 0.3002", "nearest.*length_mm"),
    put("[substrat]", "[substrate]", "[substrat]", "nearest.*substrate"),
    put("decimal comma", "thickness_mm = 1.9", "thickness_mm = 1,9", "line 10.*decimal point"),
    stated("substrate.poisson", "0.03"),
    tolerance("as a fraction", "core_thickness_percent", "0.03", "fraction"),
    tolerance("in um", "pickup_mm", "300.0", "in um"),
    put("clamped", '"cantilever"', '"clamped"', "plate.boundary.*'cantilever'"),
    put("[core] twice", "[damping]", "[core]\n\n[damping]", "line 33"),
    put("no brackets", "[0.29, 0.13, 0.18, 0.21, 0.11, 0.07, 0.09, 0.04]", "0.29", "list"),
    put("a number in quotes", "= 68.9", '= "68.9"', "young_gpa: '68.9', expected a number"),
]
