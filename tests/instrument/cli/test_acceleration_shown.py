"""Commands that foretell show accelerations in the unit chosen, and keep them as they are in files."""

import json

import pytest
from attacked_files import write_files
from formula_rig import SWEEP, formula_rig

from instrument.cli.main import run
from instrument.cli.options import Level
from instrument.cli.output import Output
from instrument.cli.print_plan import print_plan
from instrument.facts.plan import LevelCompared, PlanResult
from instrument.files.acceleration import show_acceleration_in

PREDICT = "predict coarse.toml --frequencies 20"


@pytest.mark.parametrize(
    ("unit", "said"),
    [("", "9.81 m/s^2"), (" --acceleration m/s2", "9.81 m/s^2"), (" --acceleration g", "1.00034 g")],
)
def test_a_prediction_says_its_level_in_the_unit_chosen(tmp_path, monkeypatch, capsys, unit, said):
    write_files(tmp_path)
    monkeypatch.chdir(tmp_path)
    assert run((PREDICT + unit).split()) == 0
    assert capsys.readouterr().out.startswith(f"relative velocity at {said} base acceleration")


def test_a_check_says_level_and_limit_in_the_unit_chosen_and_its_result_both(tmp_path, capsys):
    with formula_rig(tmp_path, sweep=SWEEP) as (_, experiment):
        kept = []
        for unit, said in (
            ("m/s2", "base at 9.81 m/s^2, its limit 50 m/s^2"),
            ("g", "base at 1 g, its limit 5.099 g"),
        ):
            file = tmp_path / "check.json"
            assert run(["check", str(experiment.path), "--acceleration", unit, "--json", str(file)]) == 0
            assert said in capsys.readouterr().out
            kept.append(json.loads(file.read_text()))
    assert kept[0] == kept[1]


def test_a_plan_says_the_files_level_and_the_unit_chosen(capsys):
    levels = tuple(
        LevelCompared.model_construct(level_g=g, steps=3, seconds=6.0, worst_percent=2.0, why_not="")
        for g in (0.5, 1.0)
    )
    few = {
        "segments": (),
        "law": (),
        "spots": (),
        "effects": (),
        "notes": (),
        "limited_by": (),
        "not_judged": (),
    }
    found = PlanResult.model_construct(
        **few,
        levels=levels,
        steps=(),
        level_g=0.5,
        seconds=6.0,
        worst_percent=2.0,
        reached=True,
        band_low_hz=20.0,
        band_high_hz=300.0,
        noise_share_percent=0.2,
        noise_floor_m_s=5e-6,
        sweep_toml="[sweep]",
    )
    print_plan(Output(None), found)
    usual = capsys.readouterr().out
    assert "level_g 0.5 (4.905 m/s^2)" in usual
    assert "level/(m/s^2)" in usual
    show_acceleration_in("g")
    try:
        print_plan(Output(None), found)
    finally:
        show_acceleration_in("m/s2")
    in_g = capsys.readouterr().out
    assert "level_g 0.5 (0.5002 g)" in in_g
    assert "level/(g)" in in_g


@pytest.mark.parametrize(
    ("said", "level_g"), [("0.5", 0.5), ("0.5g", 0.5), ("4.905m/s2", 0.5), ("9.81 m/s2", 1.0)]
)
def test_a_level_is_given_in_either_unit(said, level_g):
    assert Level().convert(said, None, None) == pytest.approx(level_g)


@pytest.mark.parametrize("said", ["1,5", "9.81m/s", "0", "-1g", "nan", "1e5g"])
def test_a_level_that_is_none_is_refused_in_one_line(capsys, said):
    assert run(["plan", "nowhere.toml", "--level", said]) == 2
    line = capsys.readouterr().err.strip()
    assert "\n" not in line
    assert "expected" in line
