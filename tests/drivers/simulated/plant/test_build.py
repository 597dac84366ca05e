"""The shipped plate comes from the script: the same text, and the numbers of the solid solved anew."""

import sys
from pathlib import Path

import numpy as np
import pytest
from scipy.linalg import eigh

from drivers.simulated.plant.effects import Effects, PartialDebond
from drivers.simulated.plant.model import FILE, model_from, shipped
from drivers.simulated.plant.sandwich import sandwich

SCRIPTS = str(Path(__file__).parents[4] / "scripts")


@pytest.fixture(scope="module")
def script():
    sys.path.insert(0, SCRIPTS)
    try:
        import build_plant
    finally:
        sys.path.remove(SCRIPTS)
    return build_plant


def test_the_script_has_not_changed_since_the_file_was_built(script):
    with np.load(FILE, allow_pickle=False) as data:
        assert str(data["digest"]) == script.digest(), "run scripts/build_plant.py"


def test_the_file_is_small():
    assert FILE.stat().st_size < 3.1e6


@pytest.mark.long
def test_the_shipped_plate_answers_as_the_solid(script):
    """A full solution at a place that no snapshot was taken at: only this mesh gives these digits."""
    solid = script.Solid(script.Mesh())
    effects = Effects(partial_debond=PartialDebond("x", 0.1, 0.12))
    case = script.Case(0.71e6, effects, 31.0)
    free, omega = solid.order(True), 2 * np.pi * 31.0
    M = solid.mass(effects)
    Z = (solid.stiffness(0.71e6, effects) - omega**2 * M)[free][:, free]
    X = script.factorised(Z).solve(-np.ascontiguousarray((M @ solid.rigid)[free]))
    rows = solid.readings(np.array([0.06, 0.29]), np.array([0.06]), top=True)[:, free]
    model = shipped("sandwich")
    from drivers.simulated.plant import grid

    read = np.array([grid.on_plate(x, 0.06) @ model["w_top"] for x in (0.06, 0.29)])
    np.testing.assert_allclose(read @ script.displacement(model, case)[:, 0], rows @ X[:, 0], rtol=3e-4)


@pytest.mark.long
def test_a_coarse_plate_is_built_from_scratch(script):
    mesh = script.Mesh((6, 20), (), (), strips_x=6, air_panels=(9, 6))
    recipe = script.sandwich_recipe(mesh)
    few = script.replace(
        recipe, cases=(*recipe.cases[1:3], recipe.cases[-1]), modes=10, samples=60, kept=(20, 4)
    )
    arrays, solid = script.build(few)
    model = model_from(script.packed(arrays))
    s = sandwich(model=model).structure
    lam = eigh(s.K + 0.5e6 * s.branches[0].K, s.M, eigvals_only=True)
    known = np.array([20.68, 56.58, 100.93])
    assert (np.abs(np.sqrt(lam[:3]) / (2 * np.pi) / known - 1) < 0.05).all()
    assert np.abs(script.displacement(model, script.Case(1e6, frequency_hz=10.0))).max() > 0
    assert float(solid.mass(Effects()).sum()) / 3 == pytest.approx(0.4736, rel=1e-3)
