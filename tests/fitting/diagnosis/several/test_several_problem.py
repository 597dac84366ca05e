"""What several members have in common beyond their stated numbers."""

from dataclasses import replace

import numpy as np
import pytest
from shear_pair_cases import LAW, pair, sweep

from fitting.diagnosis.problem.small_problem import SmallProblem
from fitting.diagnosis.several.errors_between_files import alike
from fitting.diagnosis.several.of_files import Place
from fitting.diagnosis.several.several_problem import SeveralProblem
from fitting.errors import OutsideModel

MASSES_KG = (0.3, 0.6)


def members(misfits):
    each = zip(MASSES_KG, misfits, strict=True)
    return [replace(SmallProblem.of_small(sweep(pair(m), points=20), pair(m)), misfit=x) for m, x in each]


def of(misfits, files=(1, 2)):
    return SeveralProblem.of_members(members(misfits), [None, None], [Place(k) for k in files])


def common_rows(problem):
    """Rows of the model's error that reach both members. Shape (any, points)."""
    v = problem.sweep.response_m_s
    rows = problem.model_error(LAW, v)
    first = problem.starts_at[0].stop
    both = np.any(rows[:, :first] != 0, axis=1) & np.any(rows[:, first:] != 0, axis=1)
    return rows[both] / v


def test_files_with_a_misfit_share_a_gain_and_a_phase_of_its_size():
    problem = of((0.01, 0.02))
    size = np.sqrt((0.01**2 + 0.02**2) / 2)
    assert alike(problem.members, problem.belongs) == pytest.approx(size)
    gain, phase, *_ = common_rows(problem)
    np.testing.assert_allclose(gain, size)
    np.testing.assert_allclose(phase, 1j * size)


def test_accelerometers_that_read_every_mass_have_a_gain_and_a_delay_in_common():
    problem = of((0.0, 0.0))
    gain, delay = common_rows(problem)
    sizes = {n.kind: n.sigma for n in problem.members[0].nuisances.each}
    np.testing.assert_allclose(gain, sizes["gain"])
    np.testing.assert_allclose(delay, -1j * problem.sweep.omega * sizes["delay"])
    # The angle is one stated number of all files.
    assert [n.name for n in problem.nuisances.each].count("phase") == 1


@pytest.mark.parametrize(("misfits", "files"), [((0.0, 0.0), (1, 2)), ((0.01, 0.02), (1, 1))])
def test_no_misfit_is_shared_where_noise_explains_the_files_or_there_is_one(misfits, files):
    problem = of(misfits, files)
    assert alike(problem.members, problem.belongs) == 0.0
    assert len(common_rows(problem)) == (2 if len(set(files)) > 1 else 0)


def test_files_that_do_not_go_together_are_named_with_what_to_do():
    one, other = members((0.0, 0.0))
    amplitudes = replace(other, sweep=replace(other.sweep, velocity_m_s=np.abs(other.sweep.velocity_m_s)))
    places = [Place(1), Place(2), Place(3)]
    with pytest.raises(OutsideModel, match=r"\(phasors: file 1, 3; amplitudes: file 2\), expected .*leave"):
        SeveralProblem.of_members([one, amplitudes, one], 3 * [None], places)
    relative = replace(other, points=replace(other.points, reads="relative"))
    with pytest.raises(
        OutsideModel, match=r"\(absolute: file 1; relative: file 2\), expected .*correct reads"
    ):
        SeveralProblem.of_members([one, relative], 2 * [None], places[:2])


def test_files_without_times_are_told_where_others_have_them():
    first, second = members((0.0, 0.0))
    untimed = replace(second, points=replace(second.points, timed=False))
    timed = replace(first, points=replace(first.points, timed=True))

    def lacking(*each):
        return SeveralProblem.of_members(each, [None, None], [Place(1), Place(2)]).files_without_time

    assert lacking(timed, untimed) == (2,)
    assert lacking(untimed, untimed) == ()
    assert timed.files_without_time == ()
