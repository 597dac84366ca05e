import pytest

from fitting.errors import OutsideModel
from fitting.stated.edges import edges_of, named


def test_a_boundary_edge_by_edge_is_the_one_of_that_name():
    assert edges_of("clamped-free-free-free") == edges_of("cantilever")
    assert named("clamped-free-free-free") == "cantilever"
    assert named("simply-supported-simply-supported-simply-supported-simply-supported") == "simply-supported"


def test_a_boundary_without_a_name_is_written_edge_by_edge():
    boundary = "clamped-free-simply-supported-free"
    assert edges_of(boundary) == ("clamped", "free", "simply-supported", "free")
    assert named(boundary) == boundary


@pytest.mark.parametrize(
    "boundary", ["", "clamped", "clamped-free-free", "clamped-free-free-free-free", "Free"]
)
def test_any_other_boundary_is_refused(boundary):
    with pytest.raises(OutsideModel, match="expected 'cantilever'"):
        edges_of(boundary)
