"""The published case as a whole: what is asked of its tables, and what its figures show of the answers."""

from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest
from matplotlib.figure import Figure

from fitting.identification.result import LawBand
from fitting.numerics.chances import Z_95
from instrument.cli import demo_paper
from instrument.cli.output import Output
from instrument.paper_case import TABLE_4, TABLE_5_THEORY_M_S, demo, figures
from instrument.paper_case.demo import PaperRun, run_paper_case

F = np.array([18.0, 100.0, 300.0])


def found(table5, factor=1.0, method="direct"):
    """An identification by hand: Table 4's moduli times a factor, known to 2 %."""
    G, eta = TABLE_4.storage_and_loss(2 * np.pi * F)
    band = LawBand(F, factor * G, eta, 0.02 * G, 0.02 * eta)
    measured = np.abs(table5.velocity_m_s)
    difference = np.linspace(-4, 4, len(table5))
    result = SimpleNamespace(
        law=TABLE_4,
        band=band,
        method=method,
        measured_m_s=measured,
        predicted_m_s=measured * (1 + difference / 100),
        difference_percent=difference,
        rms_percent=2.5,
        fit=SimpleNamespace(iterations=7, criterion_met=method == "paper"),
        validation=SimpleNamespace(leave_one_out_rms_percent=6.5),
    )
    return SimpleNamespace(result=result)


@pytest.fixture
def run(zn1, table5):
    each = found(table5), found(table5, method="paper"), found(table5, 1.2)
    G, eta = TABLE_4.storage_and_loss(2 * np.pi * F)
    after = SimpleNamespace(band=LawBand(F, 0.9 * G, eta, 0.15 * G, 0.1 * eta))
    diagnosis = SimpleNamespace(result=SimpleNamespace(after=after))
    return PaperRun(zn1, table5, *each, diagnosis)


def lines(ax):
    return {line.get_label(): np.array(line.get_data()) for line in ax.lines}


def test_both_methods_one_without_viscous_damping_and_a_diagnosis_are_of_table_5(monkeypatch, zn1, table5):
    asked = []

    def identify(files, method, progress):
        asked.append((method, files[0].specimen.modal_ratios))
        np.testing.assert_array_equal(files[0].sweep.frequency_hz, table5.frequency_hz)
        return len(asked)

    monkeypatch.setattr(demo, "identify", identify)
    monkeypatch.setattr(demo, "diagnose", lambda files, progress: (len(files[0].sweep), files[0].specimen))
    made = run_paper_case()
    assert asked == [("direct", zn1.modal_ratios), ("paper", zn1.modal_ratios), ("direct", ())]
    assert (made.direct, made.paper, made.undamped) == (1, 2, 3)
    assert made.diagnosis == (9, made.specimen)


def test_the_law_is_drawn_with_and_without_the_viscous_damping_in_the_band_of_the_result(run, table5):
    left, right = figures.figure_10(run).axes
    G, eta = TABLE_4.storage_and_loss(2 * np.pi * F)
    drawn = lines(left)
    np.testing.assert_allclose(drawn["both dampings"], [F, G / 1e6])
    np.testing.assert_allclose(drawn["core damping alone"][1], 1.2 * G / 1e6)
    np.testing.assert_allclose(drawn["Table 4"][1], G / 1e6)
    np.testing.assert_allclose(lines(right)["Table 4"][1], eta)
    # A tick at each of the nine frequencies.
    ticks = [line.get_xdata()[0] for line in left.lines[4:]]
    np.testing.assert_allclose(ticks, table5.frequency_hz)
    np.testing.assert_allclose(drawn["result, after the diagnosis"], [F, 0.9 * G / 1e6])
    # The one band is the diagnosis's, not that of a fit alone.
    (band,) = [c.get_paths()[0].vertices[:, 1] for c in left.collections]
    assert band.max() == pytest.approx((G * (0.9 + Z_95 * 0.15)).max() / 1e6)


def test_each_resonance_has_its_measured_points_among_three_models(monkeypatch, run, table5):
    asked = []

    class Models:
        def predict(self, law, f, *, real_modes):
            asked.append((law, real_modes))
            return 0.1 * f * (1 + 1j * real_modes)

    monkeypatch.setattr(figures, "Models", SimpleNamespace(of=lambda *_: Models()))
    axes = figures.figure_9(run).axes
    assert [ax.get_title() for ax in axes] == [f"{n} resonance region" for n in ("First", "Third", "Fifth")]
    for number, ax in zip(np.unique(table5.segment), axes, strict=True):
        f, v = lines(ax)["measured (Table 5)"]
        inside = table5.segment == number
        np.testing.assert_array_equal(f, table5.frequency_hz[inside])
        np.testing.assert_array_equal(v, np.abs(table5.velocity_m_s[inside]))
        at, direct = lines(ax)["direct fit"]
        assert at[0] < f.min()
        assert at[-1] > f.max()
        np.testing.assert_allclose(direct, 0.1 * at)
        np.testing.assert_allclose(lines(ax)["paper's method"][1], 0.1 * np.sqrt(2) * at)
    assert [real for _, real in asked] == 3 * [False, True, True]


def test_two_dampings_are_drawn_over_the_whole_band_and_near_the_first_resonance(monkeypatch):
    monkeypatch.setattr(
        figures, "_amplitude", lambda specimen, f, progress: f * (1 + len(specimen.modal_ratios))
    )
    whole, near = figures.figure_6().axes
    for ax in (whole, near):
        f, alone = lines(ax)["core damping alone"]
        np.testing.assert_allclose(alone, f)
        assert (lines(ax)["core and viscous damping"][1] > 1.9 * f).all()
    assert (near.lines[0].get_xdata().min(), near.lines[0].get_xdata().max()) == pytest.approx(
        (15, 22), abs=0.1
    )


def test_all_three_figures_are_saved_under_the_paper_s_numbers(monkeypatch, run, tmp_path):
    for name in ("figure_6", "figure_9", "figure_10"):
        monkeypatch.setattr(figures, name, lambda *_: Figure(figsize=(0.1, 0.1)))
    saved = []
    monkeypatch.setattr(Figure, "savefig", lambda figure, path, **_: saved.append(Path(path).name))
    paths = figures.save_figures(run, tmp_path)
    assert [p.name for p in paths] == saved
    assert [name[:5] for name in saved] == ["fig06", "fig09", "fig10"]


def test_the_case_is_told_beside_the_published_theory_and_kept_as_results(monkeypatch, capsys, run, tmp_path):
    monkeypatch.setattr(demo_paper, "run_paper_case", lambda progress: run)
    monkeypatch.setattr(demo_paper, "print_identification", lambda out, *_: out.say("<identified>"))
    monkeypatch.setattr(demo_paper, "print_story", lambda out, found: out.say("<story>"))
    monkeypatch.setattr(demo_paper, "print_before_after", lambda out, found: out.say("<before and after>"))
    monkeypatch.setattr(demo_paper, "print_law", lambda out, found: out.say(f"<law of the {found.of}>"))
    monkeypatch.setattr(
        demo_paper,
        "result_of",
        lambda fit, found, at: SimpleNamespace(words=f"{fit}, {found.of}, {at.points}"),
    )
    monkeypatch.setattr(demo_paper, "save_figures", lambda run, folder, progress: [folder / "fig10.png"])

    class Result:
        def __init__(self, of):
            self.of = of

        def as_json(self):
            return {"of": self.of}

    monkeypatch.setattr(
        demo_paper, "identification_from", lambda identified, *_: Result(identified.result.method)
    )
    monkeypatch.setattr(demo_paper, "diagnosis_from", lambda *_: Result("diagnosis"))
    demo_paper.show_paper_case(Output(None), tmp_path)
    said = capsys.readouterr().out
    order = [
        "Identified, before the diagnosis:",
        "<identified>",
        "Table 5 beside",
        "<story>",
        "<before and after>",
        "<law of the diagnosis>",
        f"saved {tmp_path / 'fig10.png'}",
        "result: None, diagnosis, 9",
    ]
    assert sorted(order, key=said.index) == order
    # Every measured amplitude beside the printed and both fitted ones.
    rows = [line.split() for line in said.splitlines() if line.strip()[:1].isdigit()]
    assert len(rows) == 9
    for k, row in enumerate(rows):
        assert float(row[1]) == pytest.approx(run.direct.result.measured_m_s[k], abs=1e-4)
        assert float(row[2]) == pytest.approx(TABLE_5_THEORY_M_S[k], abs=1e-4)
    assert "rms: direct 2.50 %, the paper's method 2.50 % after 7 iterations (5 % criterion met)" in said
    assert "6.5 % when each point is predicted from the others" in said
    kept = {p.name: p.read_text() for p in tmp_path.iterdir()}
    assert sorted(kept) == ["diagnose-paper.json", "identify-direct.json", "identify-paper.json"]
    assert '"paper"' in kept["identify-paper.json"]
