"""The covariance of a fit, looked at once more, where a step along it leaves the model."""

from dataclasses import replace

import numpy as np
from beam_tables import BEAM, FACE, LAW, read

from fitting.diagnosis.inference.posterior import posterior
from fitting.errors import OutsideModel
from fitting.mode_tables.fit import begin_modal, problem_of
from fitting.mode_tables.problem import ModalResponse


class OnlyThere(ModalResponse):
    """Has the table's modes at one place alone."""

    there = None

    def velocity(self, law, u):
        if not np.array_equal(u, self.there):
            raise OutsideModel("fewer modes")
        return super().velocity(law, u)

    def with_derivatives(self, law, u):
        if not np.array_equal(u, self.there):
            raise OutsideModel("fewer modes")
        return super().with_derivatives(law, u)


def test_where_a_step_finds_no_such_modes_chi_square_is_not_flat():
    table = read(replace(BEAM, substrate=replace(FACE, young_pa=1.35 * 70e9)))
    begun = begin_modal(problem_of([table], [replace(BEAM, exact=False)]), LAW)
    fitted = begun.none
    assert np.abs(fitted.z).max() > 1
    response = OnlyThere(begun.problem, [])
    response.there = fitted.u
    np.testing.assert_array_equal(posterior(response, begun.evidence, fitted), fitted.covariance)
