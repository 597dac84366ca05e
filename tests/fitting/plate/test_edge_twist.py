"""What free edges lack in twist, of isotropic faces and of turned plies."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.sparse.linalg import splu

from fitting.dynamics.complex_modes import complex_modes
from fitting.dynamics.real_modes import lowest_scale, real_modes
from fitting.errors import OutsideModel
from fitting.plate.edge_twist import EDGE_WIDTH, EdgeTwist, wide_enough
from fitting.plate.element import face_plane_stress
from fitting.plate.plate import Plate
from fitting.stated.layers import Face, Orthotropy

PLY = Face(
    thickness_m=5e-3,
    young_pa=120e9,
    poisson=0.3,
    density_kg_m3=2700.0,
    rolled=Orthotropy(young_y_pa=10e9, shear_pa=5e9, angle_rad=0.0),
)


def turned(degrees, face=PLY):
    return replace(face, rolled=replace(face.rolled, angle_rad=np.radians(degrees)))


def test_an_isotropic_face_loses_the_same_however_it_is_written():
    plain = replace(PLY, young_pa=70e9, rolled=None)
    own = Orthotropy(young_y_pa=70e9, shear_pa=70e9 / 2.6, angle_rad=0.0)
    for degrees in (0.0, 30.0, 45.0):
        for along_x in (True, False):
            found = EdgeTwist.of(turned(degrees, replace(plain, rolled=own)), along_x=along_x)
            assert found.stiffness == pytest.approx(EdgeTwist.of(plain, along_x=along_x).stiffness)
            assert found.coupling == pytest.approx(0.0, abs=1e-12)


def test_about_its_own_axes_a_face_loses_its_own_twist():
    found = EdgeTwist.of(PLY, along_x=True)
    assert found.coupling == 0.0
    assert found.stiffness == pytest.approx(EDGE_WIDTH * 5e-3 * 5e9 * 5e-3**3 / 3)


@given(
    st.floats(0, 180),
    st.floats(0.02, 1.0),
    st.floats(0.02, 0.5),
    st.booleans(),
    st.floats(-3, 3),
    st.floats(-3, 3),
)
def test_no_edge_loses_more_than_it_holds(degrees, across, shear, along_x, twist, bend):
    """Curvatures along the edge and twisting, the edge free of moment across: energy lost, and held."""
    face = turned(degrees, replace(PLY, rolled=Orthotropy(across * 120e9, shear * 120e9, 0.0)))
    Q, s = face_plane_stress(face), [0 if along_x else 1, 2]
    n = [1 if along_x else 0]
    D = (Q[np.ix_(s, s)] - Q[np.ix_(s, n)] @ Q[np.ix_(n, s)] / Q[n[0], n[0]]) * 5e-3**3 / 12
    kappa = np.array([bend, 2 * twist])
    found = EdgeTwist.of(face, along_x=along_x)
    lost = found.stiffness * (twist + found.coupling * bend) ** 2 / 2
    assert lost <= EDGE_WIDTH * 5e-3 * (kappa @ D @ kappa) / 2 * (1 + 1e-9) + 1e-12


@pytest.mark.parametrize(
    ("degrees", "solid_hz"),
    [
        (45, [115.7, 177.8, 289.9, 389.7, 460.5, 534.4]),
        (30, [118.97, 222.0, 293.9, 386.3, 454.9, 541.0]),
    ],
)
def test_a_turned_ply_hung_free_is_near_a_solid_of_it(zn1, degrees, solid_hz):
    """Six elastic modes, of a solid's by finite elements of high order; no mode near zero."""
    plate = replace(
        zn1.bare,
        boundary="free",
        length_m=0.3,
        width_m=0.2,
        substrate=turned(degrees),
        elements=(18, 12),
        modal_ratios=(),
    )
    assert plate.lacks_edge_twist
    found = real_modes(Plate(plate), 0.0, 6).omega / (2 * np.pi)
    assert found == pytest.approx(solid_hz, rel=1.4e-2)
    assert (found > solid_hz).all()


def small(zn1, length_mm, width_mm, **changes):
    sides = {"length_m": length_mm * 1e-3, "width_m": width_mm * 1e-3, "pickup_m": None, "modal_ratios": ()}
    plate = replace(zn1, **sides, **changes)
    return replace(plate, elements=wide_enough(plate, plate.mesh))


def negative(specimen, modulus_pa=5e5):
    """How many values of the stiffness are: Sylvester's law, of its pivots. Rigid motions are given some."""
    plate = Plate(specimen)
    K = plate.K_0.real + modulus_pa * plate.K_1 + lowest_scale(plate) * plate.M
    return int(
        np.sum(splu(K.tocsc(), diag_pivot_thresh=0.0, options={"SymmetricMode": True}).U.diagonal() < 0)
    )


@pytest.mark.parametrize(
    ("sides_mm", "changes"),
    [
        ((60, 40), {}),
        ((45, 30), {}),
        ((30.02, 19.99), {"boundary": "free"}),
        ((120, 12), {}),
        ((60, 40), {"both_sides": True}),
        ((40, 30), {"faces_shear": True}),
    ],
)
def test_no_element_is_so_narrow_that_its_edge_loses_more_than_it_holds(zn1, sides_mm, changes):
    plate = small(zn1, *sides_mm, **changes)
    assert negative(plate) == 0
    assert negative(replace(plate, elements=tuple(2 * n for n in plate.elements))) > 0


def test_a_plate_of_many_thicknesses_keeps_its_mesh(zn1):
    assert wide_enough(zn1, zn1.mesh) == zn1.mesh
    assert wide_enough(small(zn1, 60, 40).bare, (40, 26)) == (40, 26)


def test_modes_of_a_small_plate_are_those_of_any_mesh_that_has_them(zn1):
    plate = small(zn1, 60, 40)
    found, coarser = (
        [m.frequency_hz for m in complex_modes(Plate(p), p.core.law, 8)]
        for p in (plate, replace(plate, elements=(16, 11)))
    )
    assert found == pytest.approx(coarser, rel=5e-3)
    assert found[0] == pytest.approx(389.5, abs=0.1)


def test_a_stated_mesh_too_fine_for_its_faces_is_refused_in_a_line(zn1):
    plate = replace(small(zn1, 60, 40), elements=(39, 26))
    with pytest.raises(OutsideModel, match=r"1\.54 x 1\.54 mm are too small .* about 21 x 14 of them"):
        complex_modes(Plate(plate), plate.core.law, 3)
    with pytest.raises(OutsideModel, match="too small"):
        real_modes(Plate(plate), 5e5, 60)
