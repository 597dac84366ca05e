"""A shear pair's file, right and wrong, and the commands that take it."""

import numpy as np
import pytest
from shear_pair_cases import sweep

from instrument.cli.main import run
from instrument.errors import BadInput
from instrument.files.structure_file import read_structure

PAIR = """
[shear-pair]
mass_kg = 0.3
discs = 2
outer_diameter_mm = 33.5
inner_diameter_mm = 11.8
thickness_mm = 6.0
[core]
density_kg_m3 = 1100.0
[core.law]
kind = "fractional-zener"
g0_mpa = 4.0
ginf_mpa = 30.0
tau_s = 1.0e-4
alpha = 0.6
"""
FAULTS = {
    "no shape": (PAIR.replace("outer_diameter_mm = 33.5\ninner_diameter_mm = 11.8\n", ""), "area_mm2"),
    "both shapes": (PAIR.replace("discs = 2", "discs = 2\narea_mm2 = 700.0"), "area_mm2"),
    "hole": (PAIR.replace("11.8", "34.0"), "inner_diameter_mm = 34"),
    "two kinds": (PAIR + "\n[plate]\n", "[plate] and [shear-pair]"),
    "another's tolerance": (
        PAIR + "[tolerances]\nlength_mm = 0.3\n",
        "tolerances.length_mm: a shear-pair has no",
    ),
    "two pickups": (PAIR + 2 * "[[pickup]]\n", "pickup: [[pickup]], expected one table [pickup]"),
    "unknown key": (PAIR.replace("mass_kg", "mass_g"), "mass_g"),
    "no law": (PAIR.replace('"fractional-zener"', '"rubber"'), "core.law.kind"),
}


@pytest.mark.parametrize("key", ["thickness_percent", "core_thickness_percent"])
def test_the_tolerance_of_a_pads_thickness_has_two_names(tmp_path, key):
    path = tmp_path / "pair.toml"
    path.write_text(PAIR + f"[tolerances]\n{key} = 2.0\nmass_percent = 0.5\n")
    stated = read_structure(path).tolerances
    assert stated["core_thickness"] == pytest.approx(0.02)
    assert stated["mass"] == pytest.approx(0.005)


@pytest.mark.parametrize(("text", "said"), FAULTS.values(), ids=FAULTS)
def test_a_bad_shear_pair_is_refused_in_one_line(tmp_path, text, said):
    path = tmp_path / "pair.toml"
    path.write_text(text)
    with pytest.raises(BadInput) as error:
        read_structure(path)
    assert said in str(error.value)
    assert "\n" not in str(error.value)


def test_the_commands_take_shear_pairs(tmp_path, capsys):
    (tmp_path / "pair.toml").write_text(PAIR)
    s = sweep(read_structure(tmp_path / "pair.toml"), points=60)
    a = s.velocity_m_s * 2j * np.pi * s.frequency_hz
    rows = [
        f"{f!r},{z.real!r},{z.imag!r},9.81,0"
        for f, z in zip(s.frequency_hz.tolist(), a.tolist(), strict=True)
    ]
    header = "frequency_hz,acceleration_re_m_s2,acceleration_im_m_s2,base_accel_re_m_s2,base_accel_im_m_s2"
    for name, mine in (("a.csv", rows[::2]), ("b.csv", rows[1::2])):
        (tmp_path / name).write_text("\n".join([header, *mine]) + "\n")
    pair_toml = str(tmp_path / "pair.toml")
    for words in (
        ["identify", str(tmp_path / "a.csv"), "--specimen", pair_toml],
        ["identify", str(tmp_path / "a.csv"), str(tmp_path / "b.csv"), "--specimen", pair_toml],
        ["diagnose", str(tmp_path / "a.csv"), "--specimen", pair_toml],
        ["modes", pair_toml],
        ["predict", pair_toml, "--frequencies", "50,100"],
    ):
        assert run([*words, "--json", str(tmp_path / f"{words[0]}.json")]) == 0, words
    assert run(["identify", str(tmp_path / "a.csv"), *["--specimen", pair_toml] * 2]) == 2
    assert "2 times --specimen for 1 files" in capsys.readouterr().err
    words = ["identify", str(tmp_path / "a.csv"), "--specimen", pair_toml, "--uncertainty", "bootstrap"]
    assert run(words) == 2
    assert "bootstrap with a shear-pair: expected profile" in capsys.readouterr().err
