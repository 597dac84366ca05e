"""MATLAB files of which a bit has turned are refused before they are read: the library would fall."""

from contextlib import suppress

import numpy as np
import pytest
from scipy.io import savemat
from scipy.sparse import csc_array

from instrument.errors import BadInput
from instrument.files.mat import read_mat_variables
from instrument.files.mat_tags import check_tags

NUMBER = bytes([9, 0, 0, 0, 8, 0, 0, 0])
"""Tag of one double."""
VALID = {
    "arrays": {"a": np.arange(3.0), "b": np.array([[1 + 2j, 3j]]), "c": np.zeros((0, 0)), "d": np.int8(3)},
    "texts": {"name": "plate", "names": np.array(["a", "bc"], dtype=object), "none": ""},
    "structs": {"a": {"x": 1.0, "y": {"label": "s", "cells": np.array([1.0, "a"], dtype=object)}}, "b": {}},
    "sparse": {"a": csc_array(np.eye(3)), "b": csc_array(1j * np.eye(3)), "c": 0.5},
    "logical": {"a": np.array([True, False]), "b": 1.5},
}


def written(path, variables, **how):
    savemat(path, variables, **how)
    return path


@pytest.mark.parametrize("variables", VALID.values(), ids=VALID)
@pytest.mark.parametrize("packed", [False, True])
def test_what_is_whole_is_let_in(tmp_path, variables, packed):
    path = written(tmp_path / "a.mat", variables, do_compression=packed)
    check_tags(path)
    assert set(read_mat_variables(path)) == set(variables)


def test_other_versions_have_no_tags(tmp_path):
    check_tags(written(tmp_path / "a.mat", {"a": 1.0}, format="4"))


@pytest.mark.parametrize(
    ("place", "value"), [(0, 8), (0, 14), (0, 18), (1, 1), (6, 255)], ids=lambda n: f"{n}"
)
def test_a_turned_tag_is_refused_by_its_place(tmp_path, place, value):
    path = written(tmp_path / "a.mat", {"s": {"x": 1.1, "y": 2.2}})
    content = bytearray(path.read_bytes())
    at = content.index(NUMBER)
    content[at + place] = value
    path.write_bytes(content)
    with pytest.raises(BadInput, match=rf"a\.mat: damaged: byte {at}: "):
        read_mat_variables(path)


@pytest.mark.parametrize("seed", range(30))
def test_bits_turned_anywhere_do_no_harm(tmp_path, seed):
    rng = np.random.default_rng(seed)
    path = written(tmp_path / "a.mat", VALID["structs"] | VALID["arrays"])
    content = bytearray(path.read_bytes())
    for at in rng.integers(128, len(content), 4).tolist():
        content[at] ^= 1 << int(rng.integers(8))
    path.write_bytes(content)
    with suppress(BadInput):
        read_mat_variables(path)
