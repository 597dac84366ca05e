"""What of `identify`'s options goes together, and what of it is done to one sweep."""

import json
from pathlib import Path
from types import SimpleNamespace

import click
import pytest

from fitting.depth.posterior import SAMPLES
from instrument.cli.identify_asked import Asked
from instrument.cli.identify_sweeps import identify_sweeps
from instrument.cli.output import Output
from instrument.interchange.given import Given

PLAIN = Asked(
    method="direct",
    no_viscous_damping=False,
    pointwise=False,
    dma=None,
    with_budget=False,
    depths=(),
    samples=SAMPLES,
    shift=None,
    reference_c=None,
    temperature_k=None,
    vertical=False,
    bare=None,
    figures=None,
)
ONE_SWEEP = [{"pointwise": True}, {"method": "paper"}, {"dma": Path("dma.csv")}]


def asked(**options):
    return Asked(**{**vars(PLAIN), **options})


def test_samples_are_of_a_posterior_that_is_asked_for():
    asked(samples=3000, depths=("posterior",)).check()
    with pytest.raises(click.UsageError, match="--samples: expected --uncertainty posterior"):
        asked(samples=3000, depths=("profile",)).check()


def files(*kinds):
    return [SimpleNamespace(specimen=SimpleNamespace(kind=kind)) for kind in kinds]


@pytest.mark.parametrize("options", [*ONE_SWEEP, {"with_budget": True}])
def test_what_looks_at_sweeps_is_refused_with_tables(options):
    with pytest.raises(click.UsageError, match="with tables of modes: expected sweeps"):
        asked(**options).check_tables(hammer=False)


def test_tables_have_no_hammer_test_and_no_bare_beam_at_several_temperatures():
    PLAIN.check_tables(hammer=False)
    asked(bare=Path("bare.csv")).check_tables(hammer=False)
    with pytest.raises(click.UsageError, match="with tables of modes: expected sweeps"):
        PLAIN.check_tables(hammer=True)
    with pytest.raises(click.UsageError, match="expected tables of treated specimens alone"):
        asked(shift="wlf", bare=Path("bare.csv")).check_tables(hammer=False)


@pytest.mark.parametrize("options", [*ONE_SWEEP, {"with_budget": True}, {"no_viscous_damping": True}])
def test_a_shift_goes_with_its_own_options_alone(options):
    asked(shift="wlf", reference_c=20.0, vertical=True).check_shift()
    with pytest.raises(click.UsageError, match="--shift goes with"):
        asked(shift="wlf", **options).check_shift()


@pytest.mark.parametrize("options", [*ONE_SWEEP, {"no_viscous_damping": True}])
def test_several_files_are_not_one_sweep(options):
    asked(depths=("profile",), with_budget=True).check_together(files("plate", "plate"))
    with pytest.raises(click.UsageError, match="expected one plate read at one spot"):
        asked(**options).check_together(files("plate", "plate"))


@pytest.mark.parametrize(("kinds", "of"), [(("beam",), "a beam"), (("plate",) * 2, "several files or spots")])
def test_only_profiles_look_deeper_at_several_files_or_a_beam(kinds, of):
    with pytest.raises(click.UsageError, match=f"bootstrap with {of}: expected profile"):
        asked(depths=("profile", "bootstrap")).check_together(files(*kinds))


def test_what_the_papers_method_cannot_say_is_said_and_left_out(coarse, table5, tmp_path, capsys):
    out = Output(str(tmp_path / "found.json"))
    given = Given(coarse, table5, None)
    identify_sweeps(
        out, [Path("table5.csv")], [given], asked(method="paper", with_budget=True, depths=("profile",))
    )
    said = capsys.readouterr().out
    assert "no budget: these data give no uncertainty" in said
    assert "no profile: these data give no uncertainty" in said
    found = json.loads((tmp_path / "found.json").read_text())
    assert found["budget"] is None
    assert found["method"] == "paper"


def test_only_what_was_given_is_named_where_tables_refuse_it():
    with pytest.raises(click.UsageError, match=r"^--hammer and --budget with tables of modes"):
        asked(with_budget=True, depths=("profile",)).check_tables(hammer=True)


def test_only_profiles_look_deeper_at_tables_or_at_temperatures():
    asked(depths=("profile",)).check_tables(hammer=False)
    asked(depths=("profile",), shift="wlf").check_shift()
    with pytest.raises(click.UsageError, match="tables of modes: expected profile"):
        asked(depths=("posterior",)).check_tables(hammer=False)
    with pytest.raises(click.UsageError, match="--shift: expected profile"):
        asked(depths=("bootstrap",), shift="wlf").check_shift()
