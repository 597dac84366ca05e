"""What `viscorig plan` prints of a plan made by hand."""

import pytest

from instrument.cli.output import Output
from instrument.cli.print_plan import print_plan
from instrument.facts.plan import EffectForecast, NotJudged, PlanResult


@pytest.mark.parametrize(
    ("parameter", "size", "unit", "said"),
    [
        ("dx", 0.0003, "m", "dx 0.3 mm"),
        ("mass", 0.002, "kg", "mass 2 g"),
        ("scale", 1.00042, "1", "scale 1.0004"),
        ("delay", 2e-5, "s", "delay 2e-05 s"),
        ("mass", None, "kg", "mass -"),
        (None, None, None, "any"),
    ],
)
def test_it_says_from_which_size_it_sees_an_effect_in_a_workshop_s_units(capsys, parameter, size, unit, said):
    seen = EffectForecast(
        name="one", parameter=parameter, unit=unit, seen_at=size, seen_at_best=None, chance_seen=0.5
    )
    found = PlanResult(
        target_percent=2.0,
        band_low_hz=20.0,
        band_high_hz=300.0,
        reached=True,
        worst_percent=2.0,
        limit_percent=1.0,
        seconds=6.0,
        level_g=0.5,
        x_mm=270.0,
        y_mm=30.0,
        noise_floor_m_s=5e-6,
        noise_share_percent=0.2,
        steps=(),
        segments=(),
        law=(),
        effects=(seen,),
        not_judged=(NotJudged(name="other", why="no time"),),
        sweep_toml="[sweep]",
    )
    print_plan(Output(None), found)
    printed = [" ".join(line.split()) for line in capsys.readouterr().out.splitlines()]
    assert f"one {said} 50 %" in printed
    assert "other: no time" in printed
