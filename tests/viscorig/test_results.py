"""Results in a notebook: shown, as numpy and pandas, as JSON, plotted."""

import json
import sys

import numpy as np
import pytest

import viscorig as vr
from instrument.facts.damping import DampingResult
from instrument.facts.modes import ModesResult


@pytest.fixture(scope="module")
def diagnosis(sweep, plate):
    return vr.diagnose(sweep, plate, resamples=0)


@pytest.fixture(scope="module")
def results(sweep, plate, found, diagnosis):
    return [sweep, plate, found, diagnosis, vr.modes(plate, 2), vr.predict(plate, np.arange(15.0, 35.0))]


def test_arrays_come_out_with_units_in_their_names(found):
    assert found.frequency_hz.shape == found.storage_modulus_pa.shape == found.loss_factor.shape
    assert set(found.parameters) == set(found.standard_errors) == {"g0_pa", "ginf_pa", "tau_s", "alpha"}
    assert found.points["measured_m_s"].shape == (9,)
    assert found.rms_percent == found.as_dict()["rms_percent"]


def test_the_law_found_is_a_function_of_frequency(found):
    G = found.modulus_pa(found.frequency_hz)
    np.testing.assert_allclose(G.real, found.storage_modulus_pa, rtol=1e-12)
    np.testing.assert_allclose(G.imag / G.real, found.loss_factor, rtol=1e-12)


@pytest.mark.parametrize("f", [100.0, 100, np.float64(100.0), np.array(100.0)])
def test_one_frequency_gives_one_modulus(found, f):
    G = found.modulus_pa(f)
    assert isinstance(G, complex)
    assert found.modulus_pa([100.0])[0] == G


@pytest.mark.parametrize("f", [0.0, -1.0, np.inf, [10.0, np.nan], [[10.0], [-1.0]]])
def test_the_law_has_no_modulus_at_what_is_no_frequency(found, f):
    with pytest.raises(vr.errors.BadInput, match=r"^frequency_hz.*expected (more than 0|finite numbers)$"):
        found.modulus_pa(f)


def test_what_was_found_cannot_be_changed_by_accident(found):
    found.as_dict()["parameters"]["g0_pa"] = 0.0
    found.parameters["g0_pa"] = 0.0
    assert found.parameters["g0_pa"] > 0
    with pytest.raises(AttributeError):
        found.result = None


def test_a_diagnosis_says_what_it_found(diagnosis):
    assert diagnosis.verdict in ("none", "effect", "ambiguous", "unknown")
    assert diagnosis.to_numpy()["delta_bic"].shape == diagnosis.to_numpy()["name"].shape
    assert set(diagnosis.before) == set(diagnosis.after)
    assert diagnosis.lines()[0].startswith(diagnosis.verdict)


def test_everything_is_a_table_in_a_notebook(results):
    for one in results:
        html = one._repr_html_()
        assert html.count("<th>") == len(one.to_numpy())
        assert html.count("<tr>") == html.count("</tr>") <= 14
        assert one.lines()[0] in repr(one)


def test_what_is_printed_has_its_numbers(found, plate):
    heading, columns, *rows = str(vr.modes(plate, 2)).splitlines()
    assert heading.startswith("2 modes")
    assert columns.split("/")[0].strip() == "frequency"
    assert [float(row.split()[0]) for row in rows] == pytest.approx(vr.modes(plate, 2).frequency_hz, rel=1e-4)
    mode = {"frequency_hz": 17.66, "frequency_standard_error_hz": 0.01, "damping_ratio": 0.012}
    mode["rational_fit"] = {"ratio": 0.012, "standard_error": 0.0005}
    refused = {"frequency_hz": 50.0, "accepted": False, "why": "too narrow"}
    made = vr.Damping(DampingResult.model_validate({"modes": [mode, refused], "warnings": ["a remark"]}))
    assert [" ".join(line.split()) for line in str(made).splitlines()] == [
        "1 modes of 2 accepted",
        "frequency/Hz damping ratio/%",
        "17.660 ± 0.010 1.200 ± 0.050",
        "a remark",
    ]


def test_what_holds_arrays_or_files_is_shown_in_a_line(tmp_path):
    hit = vr.Hit(np.zeros(4096), 8192.0, velocity_m_s=np.zeros(4096), name="third")
    assert repr(hit) == "<Hit: third, 4096 samples at 8192 Hz, velocity_m_s>"
    path = tmp_path / "rig.toml"
    path.write_bytes(vr.example_file("rig.toml").read_bytes())
    assert repr(vr.Rig.from_file(path)) == f"<Rig: simulated rig, simulated, {path}>"


def test_html_of_a_name_stays_text(plate):
    class Named(vr.Modes):
        def lines(self):
            return ["<b>x</b> & y"]

    assert "&lt;b&gt;x&lt;/b&gt; &amp; y" in Named(ModesResult(modes=()))._repr_html_()


def test_everything_becomes_pandas(results):
    for one in results:
        frame, arrays = one.to_dataframe(), one.to_numpy()
        assert list(frame.columns) == list(arrays)
        assert all(len(frame) == len(values) for values in arrays.values())


def test_without_pandas_one_line_says_what_to_install(monkeypatch, found):
    monkeypatch.setitem(sys.modules, "pandas", None)
    with pytest.raises(vr.errors.BadInput, match=r"pip install 'viscorig\[notebook\]'") as refusal:
        found.to_dataframe()
    assert "\n" not in str(refusal.value)


def test_everything_becomes_json(results, tmp_path):
    for k, one in enumerate(results):
        path = one.to_json(tmp_path / f"{k}.json")
        assert json.loads(path.read_text(encoding="utf-8")) == one.as_dict()


def test_json_into_no_folder_is_refused(found, tmp_path):
    with pytest.raises(vr.errors.BadInput, match="nowhere"):
        found.to_json(tmp_path / "nowhere" / "found.json")


def test_plots_have_units_and_legends(found, diagnosis, sweep, plate):
    modes, response = vr.modes(plate, 2), vr.predict(plate, [20.0, 21.0])
    plots = [
        found.plot,
        found.plot_fit,
        diagnosis.plot,
        diagnosis.plot_law,
        sweep.plot,
        modes.plot,
        response.plot,
    ]
    for plot in plots:
        ax = plot()
        assert ax.get_xlabel() == "Frequency / Hz"
        assert ax.get_ylabel()
        assert any(a.get_legend() is not None for a in ax.figure.axes)


def test_plots_go_onto_given_axes(sweep, found):
    from matplotlib.figure import Figure

    ax = Figure().subplots()
    assert sweep.plot(ax) is ax
    assert found.plot(ax) is ax
    assert {a.get_ylabel() for a in ax.figure.axes} == {"Storage modulus G' / MPa", "Loss factor η"}


def test_damping_is_drawn_method_by_method():
    method = {"ratio": 0.003, "standard_error": 1e-5}
    mode = {
        "frequency_hz": 17.7, "damping_ratio": 0.003, "accepted": True, "why": "half power refused",
        "rational_fit": method, "half_power": None, "lscf": method,
    }  # fmt: skip
    found = vr.Damping(DampingResult(modes=[mode], hits=[], warnings=["one hit"]))
    assert np.isnan(found.to_numpy()["half_power_ratio"][0])
    assert found.lines() == ["1 modes of 1 accepted", "one hit"]
    names = [text.get_text() for text in found.plot().get_legend().get_texts()]
    assert names == ["rational fit", "half power", "LSCF"]
