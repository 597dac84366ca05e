"""Which stated numbers several members have in common."""

from types import SimpleNamespace

import numpy as np

from fitting.diagnosis.several.of_files import Place
from fitting.diagnosis.several.sharing import shared, with_narrow
from fitting.nuisances.narrow import NarrowResonance, NarrowResonances
from fitting.nuisances.nuisance import Nuisance
from fitting.specimen import PlateSpecimen

NUMBERS = (Nuisance("gain", "gain", 0.003), Nuisance("length", "length", 1e-3))


def member(length_m=0.3, drive="base", numbers=NUMBERS):
    specimen = object.__new__(PlateSpecimen)
    object.__setattr__(specimen, "length_m", length_m)
    nuisances = SimpleNamespace(each=numbers)
    return SimpleNamespace(specimen=specimen, nuisances=nuisances, points=SimpleNamespace(drive=drive))


def names(members, of, stays=None):
    return [n.name for n in shared(members, of, stays or tuple(range(len(members))), stays)[0]]


def test_of_what_stays_where_it_is_only_the_channels_are_apart():
    two = [member(), member()]
    assert names(two, [Place(1), Place(2)], (0, 0)) == ["gain [1]", "length", "gain [2]"]


def test_mounted_anew_a_plate_has_another_length_in_each_file():
    two = [member(), member()]
    said = names(two, [Place(1), Place(2)])
    assert said == ["gain [1]", "length [1]", "gain [2]", "length [2]"]


def test_what_clamps_pull_is_of_each_file_though_the_specimen_stays():
    one = member(numbers=(Nuisance("axial_x", "axial", 2e6), Nuisance("length", "length", 1e-3)))
    object.__setattr__(one.specimen, "axial_pa", (0.0, None))
    said = names([one, one, one], [Place(1), Place(2, 0), Place(2, 1)], (0, 0, 0))
    assert said == ["axial_x [1]", "length", "axial_x [2]"]


def test_spots_of_one_file_share_its_plate_and_not_their_gain():
    two = [member(), member()]
    numbers, places, owners = shared(two, [Place(1, 0), Place(1, 1)], (0, 0))
    assert [n.name for n in numbers] == ["gain [pickup 0]", "length", "gain [pickup 1]"]
    assert [p.tolist() for p in places] == [[0, 1], [2, 1]]
    assert owners == ((0,), (0, 1), (1,))


def test_what_is_stated_otherwise_is_another_number():
    two = [member(), member(0.25)]
    assert names(two, [Place(1), Place(2)]) == ["gain [1]", "length [1]", "gain [2]", "length [2]"]


def test_specimens_that_stay_apart_have_each_its_own_numbers_at_all_their_temperatures():
    four = [member() for _ in range(4)]
    said = names(four, [Place(k + 1) for k in range(4)], (0, 1, 0, 1))
    assert said == ["gain [1]", "length [1, 3]", "gain [2]", "length [2, 4]", "gain [3]", "gain [4]"]


def test_files_that_are_driven_alike_have_one_angle_between_their_channels():
    phase = (Nuisance("phase", "phase", 0.01),)
    shaken, struck = (member(drive=drive, numbers=phase) for drive in ("base", "force"))
    said = names([shaken, struck, shaken], [Place(1), Place(2), Place(3)])
    assert said == ["phase [1, 3]", "phase [2]"]


def narrow(f, length_m=0.3):
    specimen = SimpleNamespace(length_m=length_m)
    each = NarrowResonances((NarrowResonance(2, f, 1e-3, 1e-3, 0.01, 1e-4, 1e-4),))
    return SimpleNamespace(specimen=specimen, nuisances=SimpleNamespace(narrow=each))


def test_a_narrow_resonance_of_one_plate_is_one_in_all_files_where_it_lies_there():
    here, colder = narrow(200.0), narrow(210.0)
    again = SimpleNamespace(specimen=here.specimen, nuisances=narrow(200.1).nuisances)
    elsewhere = SimpleNamespace(specimen=here.specimen, nuisances=colder.nuisances)
    of = [Place(1), Place(2), Place(3)]
    first = tuple(np.array([0]) for _ in of)
    numbers, places, owners = with_narrow(NUMBERS[:1], first, ((0, 1, 2),), [here, again, elsewhere], of)
    said = ["gain", "resonance_2 [1, 2]", "loss_2 [1, 2]", "theory", "resonance_2 [3]", "loss_2 [3]"]
    assert [n.name for n in numbers] == said
    assert [p.tolist() for p in places] == [[0, 1, 2, 3], [0, 1, 2, 3], [0, 4, 5, 3]]
    assert owners[3] == (0, 1, 2)
