"""Figures as files: known as this program's by their heads, and nobody else's written over."""

import ast
from inspect import getsource

import click
import pytest
from click.testing import CliRunner
from matplotlib.figure import Figure

from instrument.cli.main import BAD_INPUT, run
from instrument.cli.options import figures_option
from instrument.errors import BadInput
from instrument.files.replaceable import FIGURE, PNG, refuse_to_lose
from instrument.impact import figures as impact_figures
from instrument.material import overlay
from instrument.results import diagnosis_figures, plan_figures, pointwise_figures, shifted_figures
from instrument.results.saved_figures import save_figures

SMALL = (0.2, 0.2)


def test_what_was_saved_is_known_and_saved_anew_another_picture_is_not(tmp_path):
    (own,) = save_figures({"frf.png": Figure(figsize=SMALL)}, tmp_path / "new", 20)
    refuse_to_lose(own, FIGURE)
    other = tmp_path / "frf.png"
    Figure(figsize=SMALL).savefig(other)
    refuse_to_lose(other, PNG)
    with pytest.raises(BadInput, match=r"frf\.png: another file stands there and is not written over"):
        refuse_to_lose(other, FIGURE)


def test_a_command_says_so_before_its_work_and_draws_over_its_own(tmp_path):
    done = []

    @click.command()
    @figures_option("Draw.", "frf.png", "hits.png")
    def draw(figures):
        done.append(figures)

    assert CliRunner().invoke(draw, []).exit_code == 0
    save_figures({"frf.png": Figure(figsize=SMALL)}, tmp_path, 20)
    assert CliRunner().invoke(draw, ["--figures", str(tmp_path)]).exit_code == 0
    Figure(figsize=SMALL).savefig(tmp_path / "hits.png")
    said = CliRunner().invoke(draw, ["--figures", str(tmp_path)]).exception
    assert isinstance(said, BadInput)
    assert done == [None, tmp_path]


@pytest.mark.parametrize(
    ("command", "modules"),
    [
        ("damping", [impact_figures]),
        ("diagnose", [diagnosis_figures]),
        ("identify", [pointwise_figures, overlay, shifted_figures]),
        ("plan", [plan_figures]),
    ],
)
def test_a_command_looks_for_every_figure_that_it_saves(capsys, tmp_path, command, modules):
    texts = [n for m in modules for n in ast.walk(ast.parse(getsource(m))) if isinstance(n, ast.Constant)]
    names = {n.value for n in texts if isinstance(n.value, str) and n.value.endswith(".png")}
    assert names
    for name in names:
        folder = tmp_path / name
        folder.mkdir()
        (folder / name).write_text("notes")
        assert run([command, "--figures", str(folder), "none.csv"]) == BAD_INPUT
        assert f"{name}: another file stands there" in capsys.readouterr().err


def test_a_folder_that_cannot_be_made_is_refused(tmp_path):
    (tmp_path / "taken").write_text("a file")
    with pytest.raises(BadInput, match="taken"):
        save_figures({"a.png": Figure(figsize=SMALL)}, tmp_path / "taken" / "below", 20)
