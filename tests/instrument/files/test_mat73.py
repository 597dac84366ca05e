"""MATLAB 7.3 files: numbers, complex ones, structs and text as the older format has them."""

import h5py
import numpy as np
import pytest
from scipy.io import savemat

from instrument.errors import BadInput
from instrument.files.mat import read_mat_variables
from instrument.files.mat73 import NOT_READ, read_mat73_variables
from instrument.interchange.importing import import_file
from instrument.interchange.naming import Naming

F = np.linspace(20.0, 30.0, 11)
H = np.exp(0.3j * F) / F


def written(path, fill):
    """As MATLAB writes it: a head of 512 bytes before the HDF5 file, rows and columns exchanged."""
    with h5py.File(path, "w", userblock_size=512) as file:
        fill(file)
    with path.open("r+b") as file:
        file.write(b"MATLAB 7.3 MAT-file, Platform: GLNXA64".ljust(124) + b"\x00\x02IM")
    return path


def complex_(x):
    pairs = np.empty(x.shape, [("real", "f8"), ("imag", "f8")])
    pairs["real"], pairs["imag"] = x.real, x.imag
    return pairs


def matlab(file, name, values, kind="double"):
    file.create_dataset(name, data=values).attrs["MATLAB_class"] = np.bytes_(kind)


def usual(file):
    matlab(file, "f", F[None, :])
    matlab(file, "H", complex_(H)[None, :])
    matlab(file, "blows", np.arange(6.0).reshape(2, 3))
    matlab(file, "note", np.array([[ord(c)] for c in "plate"], "u2"), "char")
    run = file.create_group("run")
    matlab(run, "fs", np.array([[1024.0]]))
    file.create_group("#refs#")
    file.create_dataset("cells", data=np.array([file.ref]), dtype=h5py.ref_dtype)


def test_variables_are_as_the_older_format_has_them(tmp_path):
    found = read_mat_variables(written(tmp_path / "a.mat", usual))
    older = {"f": F, "H": H, "blows": np.arange(6.0).reshape(2, 3).T, "note": "plate", "run": {"fs": 1024.0}}
    savemat(tmp_path / "b.mat", older)
    expected = read_mat_variables(tmp_path / "b.mat")
    assert found.pop("cells") is NOT_READ
    assert found.keys() == expected.keys()
    for name in ("f", "H", "blows"):
        np.testing.assert_array_equal(found[name], expected[name])
    assert found["note"] == expected["note"]
    assert found["run"]["fs"] == expected["run"]["fs"]


def test_a_file_of_version_7_3_is_imported_as_any_other(tmp_path):
    path = written(tmp_path / "a.mat", usual)
    import_file(path, tmp_path / "a.csv", Naming.of("f=Frequency [Hz],H=FRF [g/N]"))
    rows = np.loadtxt(tmp_path / "a.csv", delimiter=",", skiprows=2)
    np.testing.assert_allclose(rows[:, 1] + 1j * rows[:, 2], H * 9.80665)


def test_what_is_empty_is_empty(tmp_path):
    def fill(file):
        matlab(file, "x", np.array([0, 0], "u8"))
        file["x"].attrs["MATLAB_empty"] = 1

    assert read_mat73_variables(written(tmp_path / "a.mat", fill))["x"].size == 0


def test_a_file_that_links_to_itself_is_refused(tmp_path):
    def fill(file):
        file["a"] = file.create_group("b")
        file["b"]["a"] = file["a"]

    with pytest.raises(BadInput, match="structs within structs"):
        read_mat_variables(written(tmp_path / "a.mat", fill))


def test_other_files_are_not_followed(tmp_path):
    matlab_file = written(tmp_path / "a.mat", usual)
    with h5py.File(matlab_file, "r+") as file:
        file["other"] = h5py.ExternalLink(str(tmp_path / "b.mat"), "/")
        file["soft"] = h5py.SoftLink("/f")
    assert {"other", "soft"}.isdisjoint(read_mat73_variables(matlab_file))


@pytest.mark.parametrize("keep", [600, 700, 2000])
def test_one_that_is_cut_off_is_refused(tmp_path, keep):
    path = written(tmp_path / "a.mat", usual)
    path.write_bytes(path.read_bytes()[:keep])
    with pytest.raises(BadInput, match="that can be read"):
        read_mat_variables(path)


def refused(path, said):
    with pytest.raises(BadInput, match=said):
        read_mat_variables(path)


def test_structs_that_share_others_have_an_end(tmp_path):
    def fill(file):
        group = file.create_group("a")
        matlab(group, "x", F)
        for _ in range(6):
            above = file.create_group(f"{group.name}b")
            for k in range(10):
                above[f"s{k}"] = group
            group = above

    refused(written(tmp_path / "a.mat", fill), "more than 10000 variables")


def test_arrays_beyond_any_measurement_are_refused_before_they_are_read(tmp_path):
    def fill(file):
        for k in range(2):
            file.create_dataset(f"x{k}", (80_000_000,), "f8", chunks=(1000,))

    refused(written(tmp_path / "a.mat", fill), "more than 1 GB of arrays")


def test_numbers_that_lie_in_other_files_are_left_out(tmp_path):
    (tmp_path / "secret").write_bytes(bytes(80))

    def fill(file):
        matlab(file, "f", F)
        file.create_dataset("out", (10,), "f8", external=[(str(tmp_path / "secret"), 0, 80)])
        layout = h5py.VirtualLayout((10,), "f8")
        layout[:] = h5py.VirtualSource(str(tmp_path / "b.mat"), "x", (10,))
        file.create_virtual_dataset("seen", layout)

    found = read_mat73_variables(written(tmp_path / "a.mat", fill))
    assert found["out"] is found["seen"] is NOT_READ
    np.testing.assert_array_equal(found["f"], F)


def test_what_is_no_number_is_left_out_and_said(tmp_path):
    def fill(file):
        matlab(file, "f", F)
        matlab(file, "frf_g_per_n", complex_(H))
        file.create_dataset("cells", data=np.array([file.ref]), dtype=h5py.ref_dtype)
        file.create_dataset("none", data=h5py.Empty("f8"))
        matlab(file, "long", np.zeros(1_000_001, "u2"), "char")

    found = import_file(written(tmp_path / "a.mat", fill), tmp_path / "a.csv")
    assert "passed over: a.mat: cells, long, none: no array of numbers" in found.said


@pytest.mark.long
def test_the_older_format_has_the_same_limit(tmp_path):
    savemat(tmp_path / "a.mat", {"x": np.zeros((8000, 8000))}, do_compression=True)
    refused(tmp_path / "a.mat", "more than 1 GB of arrays")
