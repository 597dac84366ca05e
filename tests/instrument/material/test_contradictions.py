"""Results whose numbers cannot be of one fit are refused, and fits that are merely poor are not."""

import json

import numpy as np
import pytest
from found_law_cases import facts
from paper_law import TABLE_4

from fitting.laws.smooth import Smooth
from instrument.errors import BadInput
from instrument.material.contradictions import refuse_contradictions
from instrument.material.found_law import read_law


def written(tmp_path, change=lambda said: None):
    said = facts(TABLE_4)
    change(said)
    path = tmp_path / "identify.json"
    path.write_text(json.dumps(said), encoding="utf-8")
    return path


def scaled(key, times):
    def change(said):
        for row in said["law"]:
            row[key] *= times

    return change


def with_parameter(key, value):
    return lambda said: said["parameters"].update({key: value})


BAD = {
    "a negative modulus": (
        with_parameter("g0_pa", -2e5),
        "parameters.g0_pa = -200000, a fractional-zener has 100 to 1e+10: expected a result as",
    ),
    "an order beyond one": (with_parameter("alpha", 1.2), "parameters.alpha = 1.2, a fractional-zener has"),
    "moduli in MPa": (
        scaled("storage_modulus_pa", 1e-6),
        "storage_modulus_pa is 1e-06 times (median) what the",
    ),
    "moduli of another fit": (
        scaled("storage_modulus_pa", 100.0),
        "1e+02 times (median) what the parameters",
    ),
    "losses in percent": (scaled("loss_factor", 100.0), "no core has so much: is it in percent?"),
    "errors of nothing": (
        scaled("storage_modulus_standard_error_pa", 0.0),
        "storage_modulus_standard_error_pa is 0 in all rows",
    ),
}


@pytest.mark.parametrize("case", BAD)
def test_a_result_that_contradicts_itself_is_one_line(tmp_path, case):
    change, expected = BAD[case]
    path = written(tmp_path, change)
    with pytest.raises(BadInput) as refused:
        read_law(path)
    said = str(refused.value)
    assert said.startswith(f"{path}: ")
    assert expected in said
    assert "\n" not in said


@pytest.mark.parametrize(("times", "unit"), [(1e-6, "MPa"), (1e-3, "kPa"), (1e-9, "GPa")])
def test_the_unit_of_moduli_is_named(tmp_path, times, unit):
    with pytest.raises(BadInput, match=rf"is it in {unit}\?$"):
        read_law(written(tmp_path, scaled("storage_modulus_pa", times)))


@pytest.mark.parametrize(
    "change",
    [
        scaled("storage_modulus_pa", 7.0),
        scaled("storage_modulus_pa", 1 / 7.0),
        scaled("loss_factor", -1.0),
        scaled("storage_modulus_standard_error_pa", 1e3),
        with_parameter("alpha", 1.0 + 1e-9),
        lambda said: said.update(law_kind="of-another-package"),
    ],
)
def test_a_bend_and_a_poor_fit_are_no_contradiction(tmp_path, change):
    read_law(written(tmp_path, change))


def test_a_law_that_is_hardly_known_says_so(tmp_path):
    assert read_law(written(tmp_path)).hardly_known == ""
    poor = read_law(written(tmp_path, scaled("storage_modulus_standard_error_pa", 1e3)))
    assert poor.hardly_known.endswith("times G' (median): this law is hardly known")


def test_of_a_law_without_a_formula_limits_and_losses_are_asked(tmp_path):
    f = np.geomspace(10.0, 300.0, 5)
    law = Smooth((10.0, 300.0), (1e5, 1e6), (0.5, 0.8))
    parameters = dict(zip(law.names, law.values.tolist(), strict=True))
    G, eta = law.storage_and_loss(2 * np.pi * f)
    refuse_contradictions(tmp_path, law.kind, parameters, (f, G, eta, 0.1 * G))
    with pytest.raises(BadInput, match="is it in percent"):
        refuse_contradictions(tmp_path, law.kind, parameters, (f, G, 100 * eta, 0.1 * G))
    with pytest.raises(BadInput, match=r"parameters\.loss_factor_2 = 80, a smooth has"):
        refuse_contradictions(tmp_path, law.kind, parameters | {"loss_factor_2": 80.0}, (f, G, eta, 0.1 * G))
