"""The response of a law that was found, with its errors."""

import json

import numpy as np
import pytest
from paper_law import TABLE_4

from instrument.cli.main import run
from instrument.errors import BadInput
from instrument.models.specimen_models import Models
from instrument.paper_case import case_file
from instrument.results.fit_file import FoundLaw, read_fit
from instrument.results.fitted_response import fitted_response

ZN1 = case_file("zn1.toml")
F = np.array([17.0, 19.3, 101.0, 280.0])


def found(errors=0.01, correlation=0.0):
    names = TABLE_4.names
    return FoundLaw(
        law_kind=TABLE_4.kind,
        parameters=dict(zip(names, TABLE_4.values, strict=True)),
        standard_errors={
            n: None if errors is None else errors * v for n, v in zip(names, TABLE_4.values, strict=True)
        },
        correlations={a: {b: 1.0 if a == b else correlation for b in names} for a in names},
    )


def test_errors_are_what_drawn_laws_scatter(coarse):
    """Laws drawn from the covariance, each predicted by itself, scatter as the standard errors say."""
    response = fitted_response(coarse, found(1e-3), F)
    rng = np.random.default_rng(5)
    logs = np.log(TABLE_4.values) + 1e-3 * rng.normal(size=(400, len(TABLE_4.values)))
    models = Models.of(coarse, F)
    drawn = np.array([models.predict(TABLE_4.with_logs(p), F) for p in logs])
    np.testing.assert_allclose(
        np.abs(drawn).std(axis=0), response.amplitude_standard_error_m_s, rtol=0.15, atol=0
    )
    scatter = np.angle(drawn / response.velocity_m_s).std(axis=0)
    np.testing.assert_allclose(scatter, response.phase_standard_error_rad, rtol=0.15, atol=0)


def test_a_fit_without_errors_has_no_band(coarse):
    assert np.isnan(fitted_response(coarse, found(None), F).amplitude_standard_error_m_s).all()


def test_a_parameter_at_its_limit_does_not_move():
    one = found()
    one.standard_errors["tau_s"] = None
    covariance = one.covariance(TABLE_4.names)
    k = TABLE_4.names.index("tau_s")
    assert not covariance[k].any()
    assert covariance[k - 1, k - 1] == pytest.approx(1e-4)


def test_predict_takes_the_law_of_a_fit(capsys, tmp_path):
    path = tmp_path / "fit.json"
    path.write_text(found().model_dump_json())
    asked = ["predict", ZN1, "--frequencies", "19.3,101", "--fit", path, "--json", "-"]
    assert run([str(a) for a in asked]) == 0
    points = json.loads(capsys.readouterr().out)["points"]
    assert all(0 < p["velocity_standard_error_m_s"] < 0.05 * p["velocity_m_s"] for p in points)
    assert all(0 < p["phase_standard_error_rad"] < 0.05 for p in points)


def test_what_lies_beyond_the_measured_band_is_said_and_errors_are_printed(capsys, tmp_path):
    path = tmp_path / "fit.json"
    rows = [{"frequency_hz": f} for f in (18.0, 110.0)]
    path.write_text(json.dumps(json.loads(found().model_dump_json()) | {"law": rows}))
    asked = ["predict", str(ZN1), "--fit", str(path), "--frequencies"]
    assert run([*asked, "19.3,101"]) == 0
    inside = capsys.readouterr().out
    assert "extrapolation" not in inside
    assert "+-/(m/s)" in inside
    assert "+-/deg" in inside
    assert run([*asked, "19.3,300"]) == 0
    assert "the law was found from 18 to 110 Hz" in capsys.readouterr().out


def test_what_is_no_fit_is_refused(tmp_path, coarse):
    path = tmp_path / "fit.json"
    path.write_text("{}")
    with pytest.raises(BadInput, match="viscorig identify"):
        read_fit(path)
    other = found()
    other.law_kind = "constant"
    with pytest.raises(BadInput, match="specimen's own"):
        fitted_response(coarse, other, F)


def test_a_law_over_temperatures_is_sent_to_a_card(tmp_path):
    path = tmp_path / "shifted.json"
    path.write_text('{"shift": "wlf", "law_kind": "constant"}', encoding="utf-8")
    with pytest.raises(BadInput, match=r"over several temperatures.*viscorig card"):
        read_fit(path)
