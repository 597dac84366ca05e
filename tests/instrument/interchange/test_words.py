"""Names in German and French are read as English ones are."""

import numpy as np
import pytest

from instrument.files.modal_table import read_modal_rows
from instrument.files.sweep_file import read_sweep
from instrument.interchange.importing import import_file
from instrument.interchange.words import plain, words_of

V = [0.1 + 0.2j, 0.3 - 0.1j, -0.2 + 0.05j]


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("Basisbeschleunigung", ["base", "acceleration"]),
        ("Anregungskraft", ["excitation", "force"]),
        ("Fußpunktbeschleunigung", ["base", "acceleration"]),
        ("Spitzenbeschleunigung", ["spitzen", "acceleration"]),
        ("Schnelle Realteil", ["velocity", "real"]),
        ("Mobilité (partie réelle)", ["mobility", "partie", "real"]),
        ("Facteur de pertes", ["factor", "de", "loss"]),
        ("Dämpfungsgrad", ["damping", "ratio"]),
        ("base_accel_re_m_s2", ["base", "accel", "re", "m", "s2"]),
        ("weggang", ["weggang"]),
        ("Module 1 velocity", ["module", "1", "velocity"]),
        ("Module de la vitesse", ["magnitude", "de", "la", "velocity"]),
        ("Écart-type fréquence", ["std", "frequency"]),
    ],
)
def test_words_of_a_name(text, words):
    assert words_of(text) == words


def test_accents_and_greek_are_taken_off():
    assert plain("Kohärenz ω Maß") == "koharenz omega mass"


SWEEPS = {
    "parts": (
        "Frequenz [Hz];Schnelle Realteil [mm/s];Schnelle Imaginärteil [mm/s];Basisbeschleunigung [m/s²]",
        lambda v: (1e3 * v.real, 1e3 * v.imag, 9.81),
    ),
    "magnitude and phase": (
        "Frequenz / Hz;Betrag (Schnelle) / mm/s;Phase / Grad;Beschleunigung Fußpunkt / m/s²",
        lambda v: (1e3 * abs(v), np.degrees(np.angle(v)), 9.81),
    ),
    "French": (
        "Fréquence (Hz);Vitesse réelle (mm/s);Vitesse imaginaire (mm/s);Accélération entrée (m/s²)",
        lambda v: (1e3 * v.real, 1e3 * v.imag, 9.81),
    ),
}


@pytest.mark.parametrize("kind", SWEEPS)
def test_a_sweep_of_decimal_commas(tmp_path, kind):
    names, cells = SWEEPS[kind]
    rows = [";".join(f"{x:.9f}" for x in (20.0 + k, *cells(v))) for k, v in enumerate(V)]
    (tmp_path / "a.csv").write_text("\n".join([names, *rows]).replace(".", ","), encoding="cp1252")
    import_file(tmp_path / "a.csv", tmp_path / "b.csv")
    read = read_sweep(tmp_path / "b.csv").columns
    np.testing.assert_allclose(read["velocity_re_m_s"] + 1j * read["velocity_im_m_s"], V, rtol=1e-6)
    np.testing.assert_allclose(read["base_accel_re_m_s2"], 9.81)


@pytest.mark.parametrize(
    ("loss", "per"),
    [("Verlustfaktor", 1.0), ("Dämpfungsgrad [%]", 50.0), ("Facteur de perte", 1.0), ("Güte", None)],
)
def test_a_table_of_modes(tmp_path, loss, per):
    cell = 1 / 0.02 if per is None else 0.02 * per
    (tmp_path / "a.csv").write_text(f"Mode;Eigenfrequenz [Hz];{loss}\n1;24,5;{cell}\n2;150;{cell}\n")
    (tmp_path / "a.csv").write_text((tmp_path / "a.csv").read_text().replace(".", ","))
    import_file(tmp_path / "a.csv", tmp_path / "b.csv")
    rows = read_modal_rows(tmp_path / "b.csv")
    np.testing.assert_allclose(rows["loss_factor"], 0.02)
    np.testing.assert_allclose(rows["frequency_hz"], [24.5, 150.0])
