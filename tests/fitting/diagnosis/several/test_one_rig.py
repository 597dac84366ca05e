"""What one rig's instruments read wrongly alike in all its sweeps."""

from dataclasses import replace

import numpy as np
import pytest
from shear_pair_cases import pair, sweep

from fitting.diagnosis.problem.small_problem import SmallProblem
from fitting.diagnosis.several.one_rig import alike_rows


def problem(**more):
    specimen = pair(0.2533, **more)
    return SmallProblem.of_small(sweep(specimen, points=7), specimen)


def test_each_kind_is_as_large_as_every_sweep_s_own():
    two = [problem(), problem(tolerances={"gain": 0.02, "delay": 1e-5, "phase": 0.1})]
    gain, delay, phase = alike_rows(two, ("gain", "delay", "phase"))
    sizes = [{n.kind: n.sigma for n in p.nuisances.each} for p in two]
    for rows, kind, by in ((gain, "gain", 1.0), (phase, "phase", 1j)):
        np.testing.assert_allclose(rows, by * np.repeat([s[kind] for s in sizes], 7))
    omega = np.concatenate([p.sweep.omega for p in two])
    np.testing.assert_allclose(delay, -1j * omega * np.repeat([s["delay"] for s in sizes], 7))


@pytest.mark.parametrize("kinds", [("gain", "delay", "phase"), ("gain",)])
def test_what_is_exact_reads_nothing_wrongly(kinds):
    assert alike_rows([problem(exact=True)], kinds).shape == (0, 7)


def test_a_kind_that_is_exact_is_left_out():
    known = problem(tolerances={"gain": 0.0})
    rows = alike_rows([known], ("gain", "phase"))
    assert len(rows) == 1
    assert not rows.real.any()
    free = replace(known, nuisances=replace(known.nuisances, each=()))
    assert alike_rows([free], ("phase",)).shape == (0, 7)
