"""The functions give what the commands give, to the bit."""

import numpy as np
import pytest
from data_folder import DATA
from impact_cases import clean_hit, noisy_hits
from rivals import all_but
from timeless import timeless

import viscorig as vr
from instrument.files.impact_csv import write_impact_csv

COARSE, TABLE5 = DATA / "numbers" / "coarse.toml", vr.example_file("table5.csv")


@pytest.fixture(scope="module")
def records(tmp_path_factory):
    """A hammer test as a file."""
    path = tmp_path_factory.mktemp("hammer") / "hits.csv"
    write_impact_csv(path, noisy_hits(clean_hit(), np.random.default_rng(3)))
    return path


def test_identify_finds_what_the_command_finds(command, found):
    assert timeless(found.as_dict()) == timeless(command("identify", TABLE5, "--specimen", COARSE))


@pytest.mark.parametrize(
    ("options", "keywords"),
    [
        (["--method", "paper"], {"method": "paper"}),
        (["--no-viscous-damping"], {"viscous_damping": False}),
    ],
)
def test_identify_with_options(command, sweep, plate, options, keywords):
    expected = command("identify", TABLE5, "--specimen", COARSE, *options)
    assert timeless(vr.identify(sweep, plate, **keywords).as_dict()) == timeless(expected)


def test_identify_without_the_damping_of_a_plate_known_within_tolerances(command, tmp_path, sweep):
    path = tmp_path / "plate.toml"
    path.write_text(COARSE.read_text(encoding="utf-8").replace("exact = true", ""), encoding="utf-8")
    expected = command("identify", TABLE5, "--specimen", path, "--no-viscous-damping")
    found = vr.identify(sweep, vr.Specimen.from_file(path), viscous_damping=False)
    assert timeless(found.as_dict()) == timeless(expected)


def test_identify_without_a_law_too(command, tmp_path, plate):
    path = tmp_path / "sweep.csv"
    f = np.linspace(90.0, 110.0, 11)
    noise = np.random.default_rng(2).normal(size=(2, len(f)))
    v = vr.predict(plate, f).velocity_m_s * (1 + 2e-3 * (noise[0] + 1j * noise[1]))
    rows = [f"{a!r},{z.real!r},{z.imag!r}" for a, z in zip(f.tolist(), v.tolist(), strict=True)]
    path.write_text("\n".join(["frequency_hz,velocity_re_m_s,velocity_im_m_s", *rows]))
    expected = command("identify", path, "--specimen", COARSE, "--pointwise")
    assert timeless(vr.identify(vr.Sweep(f, v), plate, pointwise=True).as_dict()) == timeless(expected)


def test_identify_with_a_hammer_test(command, tmp_path, records, sweep, plate):
    tested = vr.damping(records)
    path = tested.to_json(tmp_path / "hammer.json")
    expected = timeless(command("identify", TABLE5, "--specimen", COARSE, "--hammer", path))
    for hammer in (tested, path, str(path), (tested.frequency_hz, tested.damping_ratio)):
        assert timeless(vr.identify(sweep, plate, hammer=hammer).as_dict()) == expected


def test_diagnose_finds_what_the_command_finds(command, sweep, plate):
    without = all_but("gain_error", "substrate_stiffness")
    words = [word for name in without for word in ("--without", name)]
    expected = command("diagnose", TABLE5, "--specimen", COARSE, "--resamples", 0, *words)
    found = vr.diagnose(sweep, plate, resamples=0, without=without)
    assert timeless(found.as_dict()) == timeless(expected)


def test_diagnose_on_your_word(command, sweep, plate):
    expected = command("diagnose", TABLE5, "--specimen", COARSE, "--accept", "spot_offset")
    found = vr.diagnose(sweep, plate, accept=["spot_offset"])
    assert timeless(found.as_dict()) == timeless(expected)
    assert list(found.effects) == ["spot_offset"]


def test_modes_are_those_of_the_command(command, plate):
    assert vr.modes(plate, 3).as_dict() == command("modes", COARSE, "--count", 3)


@pytest.mark.parametrize(("options", "keywords"), [([], {}), (["--real-modes"], {"real_modes": True})])
def test_predict_gives_what_the_command_gives(command, plate, options, keywords):
    expected = command("predict", COARSE, "--frequencies", "18.4,19.3,281.1", *options)
    assert vr.predict(plate, [18.4, 19.3, 281.1], **keywords).as_dict() == expected


def test_predict_with_what_was_found(command, tmp_path, plate, found):
    path = found.to_json(tmp_path / "found.json")
    for f in ("18.4,19.3", "18.4,450"):
        expected = command("predict", COARSE, "--frequencies", f, "--fit", path)
        assert vr.predict(plate, [float(x) for x in f.split(",")], fit=found).as_dict() == expected
    assert "extrapolation" in expected["notes"][0]


def test_predict_with_a_hammer_test(command, tmp_path, plate, records):
    path = vr.damping(records).to_json(tmp_path / "hammer.json")
    expected = command("predict", COARSE, "--frequencies", "18.4,19.3", "--hammer", path)
    assert vr.predict(plate, [18.4, 19.3], hammer=path).as_dict() == expected


def test_damping_is_that_of_the_command(command, records):
    expected = command("damping", records, "--band", "10:400", "--exponential", 5, "--estimator", "hv")
    found = vr.damping(records, band_hz=(10, 400), exponential_percent=5, estimator="hv")
    assert found.as_dict() == expected


def test_damping_at_named_modes(command, records):
    assert vr.damping([records], at_hz=[60.0]).as_dict() == command("damping", records, "--at", "60")


def test_damping_of_an_frf(command, tmp_path):
    f = np.linspace(10.0, 30.0, 401)
    H = -(f**2) / (20.0**2 - f**2 + 2j * 0.003 * 20.0 * f)
    rows = [f"{a!r},{h.real!r},{h.imag!r}" for a, h in zip(f.tolist(), H.tolist(), strict=True)]
    path = tmp_path / "frf.csv"
    path.write_text("\n".join(["frequency_hz,accelerance_re,accelerance_im", *rows]))
    assert vr.damping(path).as_dict() == command("damping", path)
    with pytest.raises(vr.errors.BadInput, match="one file at a time"):
        vr.damping([path, path])
