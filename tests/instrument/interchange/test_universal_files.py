"""Universal files of any origin: whose coherence is whose, and which records make a hit."""

import numpy as np
import pytest
from foreign_files import F, frf_set, time_set
from uff_files import write_sets

from instrument.errors import BadInput
from instrument.interchange.importing import import_file
from instrument.interchange.read_uff import read_uff

H = np.array([1.0, 0.5 + 0.1j, 0.25j, 0.1, 0.2j])
FORCE, ACCELERATION, DISPLACEMENT = 13, 12, 8


def ratio(node, *, reference=1, scale=1.0, **more):
    return frf_set(scale * H, ACCELERATION, FORCE, rsp_node=node, ref_node=reference, **more)


def coherence(node, value, *, reference=1, **more):
    """As large as `value` at every line."""
    size = {"func_type": 6, "rsp_node": node, "ref_node": reference, "id1": f"coherence {node}"}
    return frf_set(np.full(5, value), 0, 0) | size | more


def coherences(tmp_path, *sets):
    """Of every FRF in the order of the file: what it is everywhere, or None; and what was said."""
    write_sets(tmp_path / "a.uff", *sets)
    found = read_uff(tmp_path / "a.uff")
    return [None if c is None else float(c[0]) for _, _, c in found.frfs], found.said


def test_a_coherence_belongs_to_the_frf_of_its_own_points(tmp_path):
    sets = ratio(1), ratio(2), ratio(3), coherence(1, 0.9), coherence(2, 0.8), coherence(3, 0.7)
    assert coherences(tmp_path, *sets)[0] == [0.9, 0.8, 0.7]
    # Whatever comes first in the file.
    sets = coherence(3, 0.7), ratio(1), coherence(1, 0.9), ratio(3), ratio(2), coherence(2, 0.8)
    assert coherences(tmp_path, *sets)[0] == [0.9, 0.7, 0.8]


@pytest.mark.parametrize("other", [{"node": 2}, {"reference": 4}, {"rsp_dir": 1}, {"rsp_ent_name": "WING"}])
def test_a_coherence_of_other_points_is_nobodys_here_and_that_is_said(tmp_path, other):
    found, said = coherences(tmp_path, ratio(1), coherence(**{"node": 1, "value": 0.9} | other))
    assert found == [None]
    assert sum("a coherence that no one FRF here belongs to" in line for line in said) == 1


def test_a_coherence_on_other_lines_is_nobodys(tmp_path):
    assert coherences(tmp_path, ratio(1), coherence(1, 0.9, x=F + 0.5))[0] == [None]
    assert coherences(tmp_path, ratio(1), coherence(1, 0.9, x=F[:4], data=np.full(4, 0.9)))[0] == [None]


def test_passes_over_the_same_points_have_their_coherences_in_order(tmp_path):
    sets = ratio(1), coherence(1, 0.9), ratio(1, scale=2.0), coherence(1, 0.8)
    assert coherences(tmp_path, *sets)[0] == [0.9, 0.8]


def test_two_estimates_of_one_frf_share_its_coherence_and_of_three_nobody_knows_whose(tmp_path):
    both = ratio(1, id1="H1"), ratio(1, id1="H2")
    assert coherences(tmp_path, *both, coherence(1, 0.9))[0] == [0.9, 0.9]
    three = (coherence(1, value) for value in (0.9, 0.8, 0.7))
    found, said = coherences(tmp_path, *both, *three)
    assert found == [None, None]
    assert sum("no one FRF" in line for line in said) == 3


def test_a_function_of_another_kind_is_passed_over_by_name(tmp_path):
    write_sets(tmp_path / "a.uff", ratio(1), frf_set(H, 12, 0, func_type=2, id1="auto power"))
    found = read_uff(tmp_path / "a.uff")
    assert len(found.frfs) == 1
    assert "passed over: auto power: function type 2" in found.said


# Records


BLOW, RING = np.array([0.0, 5.0, 0.0, 0.0]), np.array([0.0, 1.0, -1.0, 0.5])


def hits(tmp_path, *sets):
    write_sets(tmp_path / "a.uff", *sets)
    return read_uff(tmp_path / "a.uff").hits


def test_each_force_has_the_responses_behind_it(tmp_path):
    first, second = hits(
        tmp_path,
        time_set(BLOW, FORCE),
        time_set(RING, ACCELERATION),
        time_set(2 * BLOW, FORCE),
        time_set(3 * RING, ACCELERATION),
        time_set(4 * RING, DISPLACEMENT),
    )
    assert [c.motion for c in first.responses] == ["acceleration"]
    assert [c.motion for c in second.responses] == ["acceleration", "displacement"]
    np.testing.assert_array_equal(second.force_n, 2 * BLOW)
    np.testing.assert_array_equal(second.responses[1].samples, 4 * RING)
    assert second.sample_rate_hz == pytest.approx(1000.0)


def test_a_single_force_has_the_responses_before_it_too(tmp_path):
    (hit,) = hits(tmp_path, time_set(RING, ACCELERATION), time_set(BLOW, FORCE), time_set(RING, DISPLACEMENT))
    assert [c.motion for c in hit.responses] == ["acceleration", "displacement"]


@pytest.mark.parametrize(
    ("sets", "said"),
    [
        ([time_set(BLOW, FORCE), time_set(RING[:3], ACCELERATION)], "a response of 3 samples"),
        (
            [time_set(BLOW, FORCE), time_set(RING, ACCELERATION, x=np.arange(4) / 500)],
            "a response of 4 samples at 500 Hz beside a force of 4 at 1000 Hz",
        ),
        ([time_set(BLOW, FORCE)], "no response beside the force"),
        (
            [time_set(BLOW, FORCE), time_set(BLOW, FORCE), time_set(RING, ACCELERATION)],
            "hit 1: no response beside the force",
        ),
    ],
)
def test_records_that_make_no_hit_are_refused(tmp_path, sets, said):
    with pytest.raises(BadInput, match=said):
        hits(tmp_path, *sets)


def test_records_without_a_force_are_passed_over(tmp_path):
    write_sets(tmp_path / "a.uff", time_set(RING, ACCELERATION), time_set(RING, DISPLACEMENT))
    found = read_uff(tmp_path / "a.uff")
    assert found.hits == []
    assert found.said == ["passed over: 2 time records without a force among them"]


def test_of_a_roving_hammers_frfs_each_file_says_which_points_it_is_between(tmp_path):
    write_sets(tmp_path / "a.uff", ratio(1), ratio(2))
    made = import_file(tmp_path / "a.uff", tmp_path / "out.csv")
    assert len(made.files) == 2
    for k, path in enumerate(made.files, start=1):
        assert f"node {k} Z over node 1 Z" in path.read_text().splitlines()[0]
        assert f"node {k} Z over node 1 Z" in made.said[k - 1]


def test_a_file_that_ends_within_a_set_is_refused(tmp_path):
    write_sets(tmp_path / "a.uff", ratio(1, format="ascii"), ratio(2, format="ascii"))
    whole = (tmp_path / "a.uff").read_bytes()
    (tmp_path / "b.uff").write_bytes(whole[: len(whole) - 40])
    with pytest.raises(BadInput, match=r"b\.uff: cut off in data set \d, expected -1 at its end"):
        read_uff(tmp_path / "b.uff")
