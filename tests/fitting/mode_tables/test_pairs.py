"""Two effects together on a table of modes."""

from dataclasses import replace

from beam_tables import BEAM, FACE, begun, read

from fitting.mode_tables.pairs import best_pairs, called_for
from fitting.mode_tables.standing import standing

WANTED = ("substrate_stiffness", "constraining_thickness")
EFFECTS = [e for e in standing([BEAM]) if e.name in WANTED]
WRONG = replace(
    BEAM,
    substrate=replace(FACE, young_pa=1.35 * 70e9),
    constraining=replace(FACE, thickness_m=1.5e-3),
)


def singles_of(work):
    fits = [f for e in EFFECTS for f in work.fits(e, work.begun.none)]
    return sorted((work.scored(f) for f in fits), key=lambda t: t.cost)


def test_two_wrong_numbers_are_found_together_where_neither_explains_the_table():
    work = begun(read(WRONG))
    none, singles = work.scored(work.begun.none), singles_of(work)
    assert called_for(work, none, singles)
    told = []
    found = best_pairs(work, singles, EFFECTS, told.append)
    best = found[0]
    assert set(best.names) == {"substrate_stiffness", "constraining_thickness"}
    assert best.cost < singles[0].cost - 12
    assert best.fitted.chi2_per_dof < 1.5 < singles[0].fitted.chi2_per_dof
    assert [one.names for one in found[-2:]] == [(name,) for name in best.names]
    assert told[-1] == 1.0


def test_nothing_is_looked_for_beside_a_chance_find():
    work = begun(read(BEAM))
    assert not called_for(work, work.scored(work.begun.none), singles_of(work))
