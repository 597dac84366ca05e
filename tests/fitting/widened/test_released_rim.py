"""Clamped edges of any plate, and stiffness along them."""

from dataclasses import replace

import numpy as np
import pytest

from fitting.dynamics.damping import viscous_damping
from fitting.plate.element import DOFS, W
from fitting.plate.plate import Plate
from fitting.stated.patches import Patch
from fitting.widened.full_plate import FullPlate
from fitting.widened.released_rim import clamped_edges, on_edge, treated_along
from instrument.files.specimen_file import read_specimen
from instrument.paper_case import case_file


def held(boundary, **changes):
    specimen = replace(read_specimen(case_file("zn1.toml")), elements=(8, 8), boundary=boundary, **changes)
    plate = Plate(specimen)
    return FullPlate(plate, viscous_damping(plate))


def test_edges_are_lines_of_nodes_from_corner_to_corner():
    full = held("free-clamped-clamped-free")
    near, end = clamped_edges(full)
    assert (near.across, end.across) == ("y", "x")
    places = full.loose.mesh.node_positions()
    assert np.all(places[near.nodes, 1] == 0)
    assert np.all(places[end.nodes, 0] == full.specimen.length_m)
    assert (near.step_m, end.step_m) == full.loose.mesh.sides_m


@pytest.mark.parametrize(("weight", "share"), [(None, 1.0), (np.linspace(0, 1, 9), 0.5)])
def test_a_stiffness_along_an_edge_is_its_length_times_its_weight(weight, share):
    full = held("free-clamped-free-free")
    (edge,) = clamped_edges(full)
    local = np.zeros((DOFS, DOFS))
    local[W, W] = 1.0
    lift = np.zeros((full.loose.mesh.nodes, DOFS))
    lift[:, W] = 1.0
    lift = lift.ravel()[full.loose.free]
    S = on_edge(full, edge, local, weight)
    assert lift @ S @ lift == pytest.approx(share * full.specimen.length_m)


def test_a_treatment_reaches_an_edge_where_a_patch_does():
    width = read_specimen(case_file("zn1.toml")).width_m
    full = held("clamped-free-clamped-free", patches=(Patch(0.0, 0.15, 0.0, width / 2),))
    root, end = (treated_along(full, edge) for edge in clamped_edges(full))
    assert root.tolist() == [1.0] * 5 + [0.0] * 4
    assert not end.any()
    assert treated_along(held("clamped-free-clamped-free"), clamped_edges(full)[0]) is None
