"""A shear pair's sweep with its fit: every step of a diagnosis takes milliseconds."""

from shear_pair_cases import pair, sweep

from fitting.data.noise import noise_of
from fitting.diagnosis.diagnose import DiagnosisOptions, diagnose_problem
from fitting.diagnosis.executor import ALONE
from fitting.diagnosis.inference.begin import begin
from fitting.diagnosis.problem.small_problem import SmallProblem
from fitting.diagnosis.search.candidate_fits import CandidateFits
from fitting.diagnosis.search.catalogue_search import Search
from fitting.diagnosis.verdict.case import DiagnosisCase
from fitting.effects import CATALOGUE

PAIR = pair(0.2533)
GAIN, MASS, LAW = (CATALOGUE[name].standing_on(PAIR) for name in ("gain_error", "added_mass", "core_law"))
HIGH = 1.1
"""What the velocity channel reads of the truth."""


class ShearPairProblem:
    """A sweep, the fit without effects, and what can be done for each of some effects."""

    def __init__(self, factor):
        self.sweep = sweep(PAIR, points=60, factor=factor)
        self.noise = noise_of(self.sweep)
        self.problem = SmallProblem.of_small(self.sweep, PAIR)
        self.begun = begin(self.problem, None, self.noise, None, PAIR.core.law)

    def fits(self, *effects):
        return CandidateFits(self.begun.problem, self.begun.evidence, self.begun.none, effects)

    def search(self, *effects, executor=ALONE):
        return Search(self.begun.problem, self.begun.evidence, self.begun.none, effects, executor)

    def diagnosed(self, *effects, **options):
        case = DiagnosisCase(self.problem, effects, self.noise, PAIR.core.law)
        return diagnose_problem(case, options=DiagnosisOptions(**options))
