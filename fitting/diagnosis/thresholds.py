"""The numbers that a diagnosis is decided by, and why they are what they are.

`VERDICT` and `KIN` decide what is said, `SEARCH`, `STARTS`, `PAIRS`, `WIDE_VALLEYS` and `STOPPING` only what
is looked at on the way: more of it costs time and finds no other verdict, unless the cause was missed. What
each is for: docs/diagnosis-method.md; how often the verdicts are right: docs/evidence/diagnosis.md.
Tolerances of the arithmetic, and what shapes a model of an error, stand where they are used.
"""

from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True)
class VerdictThresholds:
    """What is named, what is refused, what counts as random."""

    credible: float = 0.95
    """Probability that a group of explanations must hold together, and above which one of them stands alone.
    A gain that more than one in twenty sweeps without any effect would show too names nothing."""
    least_doubted: float = 0.2
    """Probability of 'no effect' up to which an effect is named; in a clean sweep it is about four fifths."""
    favoured: float = 1.4
    """The best effect is named too where 'no effect' is at most so many times as likely; in a clean sweep it
    is twenty times as likely."""
    kin_favoured: float = 2.0
    """Nothing is named where a cause of its kind in no catalogue is more than so many times as likely."""
    stand_in: float = 0.6
    """Largest part, of the probability that both have, for effects that no reading shows by itself beside
    explanations that pass all checks: such an effect may stand in for a cause that is in no catalogue."""
    worth_saying: float = 0.1
    """Probability of an effect that is not named from which it is spoken of: one in ten is no surprise."""
    check_level: float = 1e-4
    """Tail probability below which an explanation fails; six checks refuse one true one in 1600 at most."""
    narrowed: float = 0.3
    """A stated number, or a sum of them, counts in the check of the tolerances only if the data take this
    share of its variance: what they say nothing of stays as stated, whatever the cause is."""
    doubted: float = 0.01
    """Tail probability in that check below which an explanation is not certain: one true one in a hundred."""
    poor: float = 3.0
    """Times the noise: another law whose error at held-out data is larger explains nothing, unless
    `hardly_better` lets it."""
    hardly_better: float = 0.5
    """Another law explains all the same where that error is at most this share of the one without any effect:
    it is half as large at least."""
    formula_share: float = 1e-4
    """Share of what an effect explains that any formula may leave: no channel's gain is one number to 1 %."""
    formula_shapes: float = 10.0
    """In about so many directions an error of a formula shows."""
    formula_along: float = 10.0
    """Times its share of chi-square: what an error of a formula adds to the scatter along frequency, where it
    is smooth."""
    noise_known_to: float = 0.08
    """Relative standard deviation of the noise itself, as local scatter or an instrument states it."""
    wider_along: float = 1.5
    """The model's error is marginalised, not gone: statistics along frequency scatter more than noise's."""
    longest_trace: int = 180
    """A curve of residuals counts as at most so many readings in tests along frequency. A choice: as three
    segments of a hundred together.

    Instruments wander by a tenth of a percent over some twenty readings. In a thousand of one piece that is
    plain, and no explanation leaves less.
    """
    overstated: float = 0.75
    """Times the noise's variance: where the best fit leaves less, local scatter was more than noise."""
    size: float = 1.35
    """Chi-square per degree of freedom above which a residual is more than noise: clean sweeps stay below."""
    runs_sigma: float = 5.0
    """Standard deviations in the runs test above which a residual is more than noise: clean sweeps of the
    solid plate stay below."""
    memory_sigma: float = 6.0
    """The same in Ljung-Box's test, whose tail is heavier."""
    bent_by_chance: float = 1e-4
    """Chance that the model's own error is as large: one clean sweep in ten thousand is called structured."""
    causes: int = 2
    """Most that an explanation may suppose at once: so many numbers as three have come near to anything."""
    sized: float = 2.0
    """Standard errors from nothing at which an effect beside another has a size. A choice."""
    freer_law_cost: float = float(2 * np.log(10.0))
    """Of -2 ln Z, that a law twice as free to bend has to gain: one material in ten is expected to need it. A
    choice."""
    law_of_none: float = 0.5
    """Share of the law without effects in the band where nothing explains the readings; the rest is that of
    what is akin to the nearest explanation. Both are wrong, and neither is known to be less so (decision 77).
    """


@dataclass(frozen=True)
class KinThresholds:
    """How likely a cause is that acts almost as an explanation does, and is in no catalogue."""

    chance: float = 0.125
    """That what an explanation explains is something of its kind that is in no catalogue. A choice: at one in
    twenty effects given 95 % and more were there in 94 of 100, and with the true one left out a sixth of
    solid plates were certain of another; at one in eight in 97, and a fiftieth (docs/evidence/diagnosis.md).
    """
    shares: tuple[float, ...] = (0.03, 0.1, 0.3, 1.0)
    """Of what is explained, that kin may differ by: one as likely as another. A choice."""
    another_cause: float = 0.3
    """From this share on, kin counts as a different cause, not as the same one with a slightly different
    formula. A choice: where the base rolls or a piece is missing, a mass explains it nearly, and the law
    found with it is off by 10 to 40 %, the one found without any effect by 4."""
    beyond_formula: float = 2.0
    """Times the error of an effect's own formula: within it kin is the effect itself. A choice."""


@dataclass(frozen=True)
class StartThresholds:
    """How many starts and forms of one effect are tried, and what they have to promise for it."""

    followed: int = 2
    """Starts of an effect that are fitted roughly. A bound on time."""
    followed_with_place: int = 4
    """The same number for an effect whose place is to be found: places have valleys of their own."""
    further: int = 36
    """Further starts of an effect with a place that a thorough search tries for a few steps."""
    further_continued: int = 8
    """Of the further starts, how many go on after those steps: of 36 the best was among the first five."""
    last: int = 30
    """Starts beyond the further ones that are tried where every leading explanation fails a check
    (`Singles._misplaced`)."""
    forms: int = 2
    """Forms of an effect that are fitted to the end where they do alike so far. A bound on time."""
    finished: int = 2
    """Rough fits of a kind that a thorough search follows to their end. A bound on time."""
    laws_finished: int = 2
    """Other laws that are fitted to the end, of those fitted roughly. A bound on time."""
    least_promise: float = 3.0
    """Chi-square that a start must promise to be followed, unless it is the first."""
    least_share_of_best_promise: float = 0.1
    """Share of what the best start promises that another one must promise too."""
    least_share_of_best_gain: float = 0.2
    """Share of the chi-square that an effect explaining everything gains, which another effect must promise
    from its law to begin there. A place must promise the same share from the first law."""
    least_gain: float = 1.0
    """Change of chi-square in a few steps from which a start that promises little is followed after all."""


@dataclass(frozen=True)
class PairThresholds:
    """When a second effect is looked for, beside which first ones, and how many pairs are fitted."""

    nothing_left_chi2_per_dof: float = 0.5
    """Chi-square per degree of freedom below which one effect leaves nothing to a second one."""
    one_suffices_chi2_per_dof: float = 1.08
    """Chi-square per degree of freedom up to which one effect suffices; above, a second one is looked for
    beside every leading effect, not beside the best and those near it alone."""
    data_per_parameter: int = 10
    """Data per parameter below which no second effect is looked for."""
    will_do_chi2_per_dof: float = 1.25
    """Chi-square per degree of freedom up to which a pair that fails no check will do: strong effects may
    leave so much."""
    least_promise: float = 12.0
    """Chi-square that a second effect must promise where the first one leaves little; another law that gains
    so much is tried in its further forms."""
    close_leaders: int = 8
    """Effects beside which a second one is looked for where the best leaves little, of those that are near it
    in cost: a pair of the campaign was led by the sixth. A bound on time."""
    fitted: int = 16
    """Pairs that are fitted in full."""
    fitted_a_leader: int = 5
    """Pairs of one leader among them, so that every leader has its say."""
    exchanges: int = 6
    """Effects of the best pairs that are kept, one after the other, while their partner is exchanged."""
    exchanged: int = 4
    """Partners that are fitted beside each effect that is kept."""


@dataclass(frozen=True)
class WideValleyThresholds:
    """How pairs are looked for in wide valleys (`inference/wide_valley.py`), where no other pair will do."""

    leaders: int = 2
    """Leading effects beside which every other one is begun in a wide valley."""
    followed: int = 32
    """Pairs of those that are followed there, among them `PAIRS.fitted_a_leader` of each leader."""
    measured: int = 3
    """Best fits so far that are followed in wide valleys, to learn how much a good pair leaves there."""
    times_least_left: float = 2.0
    """A pair goes on only if its wide valley leaves at most so many times what the best of these leave, as of
    what is really there only noise is left. A choice."""
    falls_by: float = 2.0
    """Factor by which a pair may still come down in its wide valley after a few steps: with stated numbers
    held, none of 36 that were followed came down by more than 1.3."""
    read: int = 16
    """Pairs from wide valleys that are then followed with the noise as it is."""


@dataclass(frozen=True)
class StoppingThresholds:
    """How far one fit is followed, and which fits are given up on the way."""

    cost_near_best: float = 40.0
    """Cost above the best one's up to which an effect may still come to matter and is followed."""
    cost_near_best_settled: float = 12.0
    """The same where little will change any more: the law is a good place to begin from, or fits have
    converged, or two forms of one effect are compared."""
    explained_chi2_per_dof: float = 1.1
    """Chi-square per degree of freedom above which the first pass may have missed the cause."""
    least_gain_in_cost: float = 5.0
    """Cost below that of no effect that an effect must have for all others to begin from its law: less is a
    chance find."""
    rough_chi2_factor: float = 4.0
    """Rough fits of one effect or of two that leave more than so many times the least chi-square are not
    followed to the end."""
    wrong_law_chi2_per_dof: float = 2.0
    """Chi-square per degree of freedom above which the law so far is no place to begin."""
    hopeless_chi2_per_dof: float = 30.0
    """Chi-square per degree of freedom above which finer grids mend nothing."""
    least_owed: float = 0.1
    """A fit that may still gain more chi-square than this has not converged: it is a tenth of what a standard
    error is worth."""
    times_owed: float = 2.0
    """Times the chi-square that a linear step would gain: so much the rest of its way may bring a rough fit.
    Of 140 that were followed, of sizes within a decade, two gained more than 1.7 times as much: 4 and 800,
    which did not bring them near."""
    reported_cost: float = 12.0
    """Cost above the best one's, tempered, up to which (one in 400) fits are followed to their very end."""
    past_help: float = 1e-12
    """Tail probability of a check that no further steps of a fit will mend. A choice."""


@dataclass(frozen=True)
class SearchThresholds:
    """How many effects a search goes into."""

    leaders: int = 5
    """Effects that are gone into twice, and beside which a second one is looked for."""
    first: int = 4
    """Effects that promise most and are fitted before all others: one may explain everything."""
    at_a_time: int = 2
    """Effects that are gone into twice together, until one explains everything."""


VERDICT, KIN, SEARCH = VerdictThresholds(), KinThresholds(), SearchThresholds()
STARTS, PAIRS, WIDE_VALLEYS = StartThresholds(), PairThresholds(), WideValleyThresholds()
STOPPING = StoppingThresholds()
