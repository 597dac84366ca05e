"""Every number that a diagnosis is decided by, and why it is what it is.

`VERDICT` decides what is said, `SEARCH` only what is looked at on the way: more of it costs time and finds no
other verdict, unless the cause was missed. What each is for: docs/diagnosis-method.md; how often the verdicts
are right: docs/evidence/diagnosis.md.
"""

from dataclasses import dataclass


@dataclass(frozen=True)
class VerdictThresholds:
    """What is named, what is refused, what counts as random."""

    credible: float = 0.95
    """Probability that a group of explanations must hold together, and above which one of them stands alone.
    A gain that more than one in twenty sweeps without any effect would show too names nothing."""
    least_doubted: float = 0.2
    """Probability of 'no effect' up to which an effect is named; in a clean sweep it is about four fifths."""
    favoured: float = 2.0
    """The best effect is named too where 'no effect' is at most so many times as likely; in a clean sweep it
    is twenty times as likely. Beside a cause of its kind in no catalogue, the same limit holds."""
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
    """Times the noise: a law that predicts held-out segments worse explains nothing ..."""
    hardly_better: float = 0.5
    """... where that is not half the error without any effect either."""
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
    """Of the runs test: clean sweeps of the solid plate stay below."""
    memory_sigma: float = 6.0
    """Of Ljung-Box's test, the same; its tail is heavier."""
    bent_by_chance: float = 1e-4
    """Chance that the model's own error is as large: one clean sweep in ten thousand is called structured."""


@dataclass(frozen=True)
class SearchThresholds:
    """What is looked for, gone into twice, followed to the end."""

    nothing_left: float = 0.5
    """Chi-square per degree of freedom below which no second effect is looked for."""
    clean_enough: float = 1.08
    """Chi-square per degree of freedom above which a second effect is looked for beside all leading ones."""
    numbers_a_parameter: int = 10
    """Data per parameter below which no second effect is looked for."""
    will_do: float = 1.25
    """Chi-square per degree of freedom that strong effects may leave."""
    least_expected: float = 12.0
    """Chi-square that a second effect must promise where the first leaves little."""
    near: float = 40.0
    """In cost above the best: effects so near are gone into twice, where the law is no place to begin."""
    nearer: float = 12.0
    """The same, where it is."""
    unclear: float = 1.1
    """Chi-square per degree of freedom above which the first pass may have missed the cause."""
    promising: float = 5.0
    """In cost below none's: less explains nothing that all others could begin from."""
    left_behind: float = 4.0
    """Times the least chi-square: rough fits beyond, of one effect or of two, are not followed to the end."""
    wrong: float = 2.0
    """Chi-square per degree of freedom beyond which the law so far is no place to begin."""
    hopeless: float = 30.0
    """Chi-square per degree of freedom that finer grids will not mend."""
    able: float = 0.2
    """Of what the best explains: what another effect must promise, from where the best has got to."""
    least_promise: float = 3.0
    """Chi-square that a further start must promise ..."""
    promise: float = 0.1
    """... and its share of the best start's."""
    least_gain: float = 1.0
    """Chi-square gained, or still to be made good, after a few steps: then a start is followed after all."""

    least_owed: float = 0.1
    """Chi-square that a fit good enough to compare must still gain to have been on its way: a tenth of what a
    standard error is worth."""
    more_than_owed: float = 2.0
    """Times the chi-square that a linear step would gain: what the rest of its way may bring a rough fit. Of
    140 that were followed, of sizes within a decade, two gained more than 1.7 times as much: 4 and 800, which
    did not bring them near."""
    reported: float = 12.0
    """In cost above the best, tempered: up to there (one in 400) fits are followed to their very end."""

    past_help: float = 1e-12
    """Tail probability of a check that no further steps of a fit will mend. A choice."""

    # How many

    leaders: int = 5
    """Effects that are gone into twice, and that a second one is looked for beside."""
    close_leaders: int = 8
    """The latter where the best leaves little, of those `near` it: a pair of the campaign was led by the
    sixth. A bound on time."""
    forms: int = 2
    """Forms of an effect that are followed to their end where they do alike so far. A bound on time."""
    first: int = 4
    """Effects that are fitted before all others, where they promise most."""
    at_a_time: int = 2
    """Effects that are gone into twice together, until one explains everything."""
    pairs: int = 16
    """Pairs fitted in full ..."""
    pairs_a_leader: int = 5
    """... and of those, with one leader: each has its say."""
    exchanges: int = 6
    """Effects of pairs near the best that are kept while the other one is exchanged ..."""
    exchanged: int = 4
    """... and others that are fitted beside each that is kept."""
    every_second: int = 2
    """Leaders beside which every other effect is begun in wide valleys where no pair will do ..."""
    wide: int = 32
    """... pairs of those that are followed in wide valleys, `pairs_a_leader` of each among them ..."""
    measured: int = 3
    """... and of the best so far, how many say what may be left there: ..."""
    leaves: float = 2.0
    """... what leaves more than so many times as much there goes no further, as of what is really there noise
    alone is left (a choice) ..."""
    comes_down: float = 2.0
    """... by which factor what has begun there may still come down: with what is stated taken at its word
    none of 36 that were followed did by more than 1.3 ..."""
    rough: int = 16
    """... and fits of those that are then followed as the readings are."""
    followed: int = 2
    """Of an effect's starts, how many are fitted roughly ..."""
    followed_places: int = 4
    """... and of one with a place to be found."""
    more_places: int = 36
    """Further starts of the latter, in a thorough search ..."""
    places_followed: int = 8
    """... of those, how many go on after a few steps: of 36 the best was among the first five by then ..."""
    most_places: int = 30
    """... and of the rest, where every leading explanation fails a check (`Singles._misplaced`)."""
    finished: int = 2
    """Rough fits of a kind that are followed to the end by a thorough search."""
    laws_finished: int = 2
    """Other laws that are fitted to the end, of those fitted roughly."""


VERDICT, SEARCH = VerdictThresholds(), SearchThresholds()
