"""Figures of plans, of a core band by band and of several temperatures: what is drawn where."""

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
from shear_pair_temperatures import LOG_A, REFERENCE, T, alone, fitted, shifted

from fitting.effects import CATALOGUE
from fitting.identification.pointwise import PointwiseLaw
from fitting.identification.result import LawBand
from fitting.numerics.chances import Z_95
from fitting.temperature.simple import Verdict
from instrument.errors import BadInput
from instrument.facts.plan import LawOutlook, PlannedStep, PlanResult, SpotCompared
from instrument.finding.pointwise import Pointwise
from instrument.results.plan_figures import errors_figure, save_plan_figures, spots_figure
from instrument.results.pointwise_figures import pointwise_figure, save_pointwise_figure
from instrument.results.shifted_figures import save_shifted_figures
from instrument.temperatures.shifted import Shifted

F = np.array([10.0, 30.0, 100.0])


def lines(ax):
    """By name."""
    return {line.get_label(): np.array(line.get_data()) for line in ax.lines}


# A plan


def spot(x_mm, worst_percent, *, stated=False):
    same = {"y_mm": 60.0, "steps": 9, "seconds": 60.0, "limit_percent": 1.0, "reached": True}
    return SpotCompared(x_mm=x_mm, worst_percent=worst_percent, stated=stated, **same)


def plan(*spots):
    return PlanResult.model_construct(
        target_percent=2.0,
        law=tuple(
            LawOutlook(frequency_hz=f, storage_modulus_percent=1.0 + f / 100, loss_factor_percent=3.0)
            for f in F
        ),
        steps=tuple(
            PlannedStep(frequency_hz=f, segment=1, seconds=5.0, teaches=what)
            for f, what in ((11.0, "law"), (12.0, "causes"), (13.0, "law"))
        ),
        spots=spots,
    )


def test_a_plan_s_errors_stand_over_its_target_and_its_steps():
    (ax,) = errors_figure(plan()).axes
    drawn = lines(ax)
    np.testing.assert_allclose(drawn["G'"], [F, 1 + F / 100])
    np.testing.assert_allclose(drawn["loss factor"][1], 3.0)
    assert set(drawn["target"][1]) == {2.0}
    assert drawn["steps for the law"][0].tolist() == [11.0, 13.0]
    assert drawn["steps that separate causes"][0].tolist() == [12.0]
    assert ax.get_ylim()[0] == 0


def test_the_map_has_a_number_a_spot_and_a_cross_where_the_specimen_is_read():
    ax, *_ = spots_figure(plan(spot(60.0, 1.234, stated=True), spot(30.0, 5.0), spot(90.0, 0.5))).axes
    assert [text.get_text() for text in ax.texts] == ["5", "0.5"]
    np.testing.assert_allclose(ax.collections[0].get_offsets(), [[30, 60], [90, 60]])
    np.testing.assert_allclose(lines(ax)["stated spot"], [[60], [60]])


def test_a_plan_without_spots_has_no_map(saved, tmp_path):
    assert [p.name for p in save_plan_figures(plan(), tmp_path / "new")] == ["plan-errors.png"]
    save_plan_figures(plan(spot(30.0, 5.0), spot(90.0, 0.5)), tmp_path)
    assert sorted(saved) == ["plan-errors.png", "plan-spots.png"]


def test_a_folder_that_cannot_be_made_is_refused(tmp_path):
    (tmp_path / "taken").write_text("a file")
    for save in (
        lambda folder: save_plan_figures(plan(), folder),
        lambda folder: save_pointwise_figure(Pointwise(bands(), None, ""), BAND, folder),
    ):
        with pytest.raises(BadInput, match="taken"):
            save(tmp_path / "taken" / "below")


# Band by band


BAND = LawBand(F, np.full(3, 2e6), np.full(3, 0.5), np.full(3, 1e5), np.full(3, 0.02))


def bands(error=(0.02, 0.2, 0.02)):
    """Three bands of 2 (1 + 0.5i) MPa, so well known; where nothing is found, NaN."""
    error = np.array(error)
    G = np.where(np.isfinite(error), 2e6 * (1 + 0.5j), np.nan)
    covariance = (2e6 * error)[:, None, None] ** 2 * np.eye(2)
    count, found = len(F), np.isfinite(error)
    reasons = tuple("" if ok else "nothing is felt here" for ok in found)
    none = np.zeros((0, count, 2))
    return PointwiseLaw(F, G, covariance, none, error, found, reasons, np.full(count, 5), np.zeros(count))


def test_bands_have_bars_of_95_percent_over_the_law_s_own_band():
    left, right = pointwise_figure(bands(), BAND).axes
    np.testing.assert_allclose(lines(left)["fitted law"], [F, np.full(3, 2.0)])
    np.testing.assert_allclose(lines(right)["fitted law"][1], 0.5)
    law = left.collections[0].get_paths()[0].vertices
    assert (law[:, 1].min(), law[:, 1].max()) == pytest.approx((2 - Z_95 * 0.1, 2 + Z_95 * 0.1))
    # Those hardly known stand faint behind, those well known in front.
    faint, well = left.containers
    assert faint.lines[0].get_xdata().tolist() == [30.0]
    assert well.lines[0].get_xdata().tolist() == [10.0, 100.0]
    (low, high) = well.lines[2][0].get_segments()[0][:, 1]
    assert (low, high) == pytest.approx((2 - Z_95 * 0.04, 2 + Z_95 * 0.04))


def test_bands_that_say_nothing_are_ticks_at_the_foot_and_an_unknown_law_error_has_no_band():
    band = LawBand(F, BAND.storage_modulus_pa, BAND.loss_factor, np.full(3, np.nan), np.full(3, np.nan))
    left, _ = pointwise_figure(bands((0.02, np.nan, 0.02)), band).axes
    assert lines(left)["not determined here"][0].tolist() == [30.0]
    assert "95 % band of the law" not in [c.get_label() for c in left.collections]


def test_a_refuted_causal_core_is_drawn_and_called_so():
    causal = SimpleNamespace(frequency_hz=F, consistent=False, modulus=lambda omega: 1e6 + 1e3j * omega)
    left, right = pointwise_figure(bands(), BAND, causal).axes
    f, eta = lines(right)["nearest causal core (refuted)"]
    np.testing.assert_allclose(eta, 2e-3 * np.pi * f)
    np.testing.assert_allclose(lines(left)["nearest causal core (refuted)"][1], 1.0)


def test_a_core_band_by_band_is_one_file(saved, tmp_path):
    path = save_pointwise_figure(Pointwise(bands(), None, ""), BAND, tmp_path / "new")
    assert path == tmp_path / "new" / "pointwise-law.png"
    assert list(saved) == [path.name]


# Several temperatures


@pytest.fixture(scope="module")
def temperatures():
    _, fit, each = fitted(shifted())
    f = np.geomspace(50, 4000, 9)
    G, eta = fit.law.storage_and_loss(2 * np.pi * f)
    band = LawBand(f, G, eta, 0.01 * G, 0.01 * eta)
    return Shifted(fit, Verdict(True, 0.5, 1.0, "simple"), band, alone(each), None, 1.0)


def test_the_nomogram_has_a_diagonal_for_each_temperature(temperatures, saved, tmp_path):
    paths = save_shifted_figures(temperatures, tmp_path / "new")
    assert [p.name for p in paths] == list(saved) == ["nomogram.png", "simplicity.png"]
    left, right = saved["nomogram.png"].axes
    np.testing.assert_allclose(
        lines(left)["eta"], [temperatures.band.frequency_hz, temperatures.band.loss_factor]
    )
    assert f"reference {REFERENCE:g} °C" in left.get_xlabel()
    assert [text.get_text() for text in right.texts] == [f"{t:g} °C" for t in T]
    # Beside its line and inside the frame.
    frame = left.get_window_extent()
    for text, line in zip(right.texts, right.lines, strict=True):
        box = text.get_window_extent()
        assert frame.x0 < box.x0 < box.x1 < frame.x1
        ends = right.transData.transform(np.column_stack(line.get_data()))
        for y in (box.y0, box.y1):
            x = np.interp(y, ends[:, 1], ends[:, 0])
            assert not box.x0 <= x <= box.x1
    assert left.yaxis.get_ticklabels()[0].get_fontsize() == right.yaxis.get_ticklabels()[0].get_fontsize()
    assert [c.get_label() for c in left.collections] == ["G' / MPa, 95 %", "eta, 95 %"]
    # Reduced readings lie on the one law, where the material is simple.
    points = [line.get_data() for line in left.lines[2:]]
    assert len(points) == 2 * len(T)
    law = temperatures.fit.law.storage_and_loss(2 * np.pi * points[0][0])[0] / 1e6
    np.testing.assert_allclose(points[0][1], law, rtol=0.1)
    for line, log_a in zip(right.lines, temperatures.fit.log_shift, strict=True):
        reduced, plain = line.get_data()
        np.testing.assert_allclose(np.log(reduced / plain), log_a)


def test_figures_say_that_their_law_is_refused_or_which_effect_is_counted_in(temperatures, saved, tmp_path):
    u = SimpleNamespace(of=lambda effect: np.array([q.typical for q in effect.parameters]))
    late = SimpleNamespace(effect=CATALOGUE["channel_delay"], fit=SimpleNamespace(one=u))
    refused, useless = Verdict(False, 0.0, 9.0, ""), Verdict(None, 0.0, 9.0, "", law_stands=False)
    for changed, said in (
        ({}, ""),
        ({"verdict": refused}, "refused: no one law serves"),
        ({"verdict": useless}, "not to be used: nothing explains"),
        ({"cause": late}, "counted in at all temperatures: the velocity channel"),
    ):
        saved.clear()
        save_shifted_figures(replace(temperatures, **changed), tmp_path)
        for figure in saved.values():
            assert figure.get_supxlabel().startswith(said)
            assert bool(figure.get_supxlabel()) == bool(said)


def test_curves_of_all_temperatures_fall_on_one_where_the_material_is_simple(temperatures, saved, tmp_path):
    save_shifted_figures(temperatures, tmp_path)
    wicket, cole, shifts, curves = saved["simplicity.png"].axes
    (f, G) = curves.lines[-1].get_data()
    for line in curves.lines[:-1]:
        at, own = line.get_data()
        np.testing.assert_allclose(own, np.interp(np.log(at), np.log(f), G), rtol=0.1)
    assert [line.get_label() for line in wicket.lines] == [*(f"{t:g} °C" for t in T), "one law"]
    storage, lost = cole.lines[-1].get_data()
    np.testing.assert_allclose(lost / storage, temperatures.band.loss_factor)
    measured = shifts.containers[0].lines[0].get_data()
    np.testing.assert_allclose(measured[1], LOG_A / np.log(10), atol=0.02)
