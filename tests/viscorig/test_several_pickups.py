"""Spots in one sweep are fitted together, as the commands do."""

import numpy as np
import pytest
from data_folder import DATA
from timeless import timeless

import viscorig as vr
from instrument.errors import BadInput
from instrument.files.new_file import write_new

SECOND = "[[pickup]]\nx_mm = 240.0\ny_mm = 40.0\n\n"


@pytest.fixture(scope="module")
def files(tmp_path_factory, plate):
    """A specimen with two pickups and a sweep of both, the second channel a hundredth too large."""
    folder = tmp_path_factory.mktemp("spots")
    text = (DATA / "numbers" / "coarse.toml").read_text().replace("[pickup]", "[[pickup]]")
    specimen = folder / "plate.toml"
    specimen.write_text(text.replace("[base]", SECOND + "[base]"))
    other = folder / "other.toml"
    other.write_text(
        (DATA / "numbers" / "coarse.toml").read_text().replace("60.0\ny_mm = 60.0", "240.0\ny_mm = 40.0")
    )
    f = np.linspace(90.0, 110.0, 11)
    noise = np.random.default_rng(4).normal(size=(2, 2, len(f)))
    rows = ["pickup,frequency_hz,velocity_re_m_s,velocity_im_m_s"]
    for k, of in enumerate((plate, vr.load_specimen(other))):
        v = vr.predict(of, f).velocity_m_s * (1 + 2e-3 * (noise[k, 0] + 1j * noise[k, 1]))
        rows += [f"{k},{a!r},{z.real!r},{z.imag!r}" for a, z in zip(f.tolist(), v.tolist(), strict=True)]
    sweep = folder / "sweep.csv"
    sweep.write_text("\n".join(rows))
    return sweep, specimen


@pytest.fixture(scope="module")
def loaded(files):
    plate = vr.load_specimen(files[1])
    return vr.load_sweep(files[0], plate), plate


def without_files(facts):
    """A sweep of the package has no file's name; it is one file."""
    facts = timeless(facts)
    assert len(facts.pop("files")) == 1
    return facts


def test_one_law_for_all_of_them(command, files, loaded):
    found = vr.identify(*loaded)
    expected = command("identify", files[0], "--specimen", files[1])
    assert without_files(found.as_dict()) == without_files(expected)


def test_an_effect_of_all_of_them_is_accepted_on_a_persons_word(command, files, loaded):
    found = vr.diagnose(*loaded, accept=["gain_error"])
    expected = command("diagnose", files[0], "--specimen", files[1], "--accept", "gain_error")
    assert without_files(found.as_dict()) == without_files(expected)


@pytest.mark.parametrize("keywords", [{"pointwise": True}, {"method": "paper"}])
def test_what_is_of_one_pickup_is_refused(loaded, keywords):
    with pytest.raises(BadInput, match=r"several pickups .* expected one pickup"):
        vr.identify(*loaded, **keywords)


def test_a_search_is_not_repeated_for_several_pickups(loaded):
    with pytest.raises(BadInput, match=r"resamples with several pickups, expected one pickup"):
        vr.diagnose(*loaded, resamples=2)


def test_a_beam_is_refused_by_its_name(tmp_path):
    path = tmp_path / "beam.toml"
    write_new("beam", path)
    with pytest.raises(BadInput, match=r"beam\.toml: a beam, expected a plate"):
        vr.load_specimen(path)
