"""What each group asks of what other packages bring."""

import logging
from pathlib import Path

import numpy as np
import pytest

import fitting.effects
import fitting.laws
from fitting.effects import CATALOGUE, all_spans, span_modules
from fitting.laws import LAWS
from fitting.plugins import Registry
from gui.form import fields
from instrument.errors import BadInput
from instrument.files import devices
from instrument.files.rig_file import RigDocument
from instrument.files.toml import document_faults, read_document
from instrument.interchange import readers
from instrument.simulated_case import case_file

LAW = """
from dataclasses import dataclass
import numpy as np
from fitting.laws.base import CoreLaw, quantity

@dataclass(frozen=True)
class Law(CoreLaw):
    kind = "{kind}"
    source = "nobody"
    g_pa: float = quantity("g_mpa", to_si=1e6, lower=1.0, upper=1e9, search=(1e4, 1e7))
    def modulus(self, omega):
        return np.full(np.shape(omega), self.g_pa + 0j)
    def jacobian(self, omega):
        return np.ones((1, *np.shape(omega)), dtype=complex)
    @classmethod
    def alternatives(cls, near):
        return [cls(near.rest_and_rise_pa[0])]
"""
EFFECT = """
import numpy as np
from fitting.effects.base import Effect, EffectParameter
from fitting.widened.span import Span

class Motion(Span):
    name = "{span}"

class Odd(Effect):
    name, enters, source = "odd", "channel", "nobody"
    parameters = (EffectParameter("x", "1", 0.0, 1.0, 0.1),)
    spans = (Motion(),)
    extends = {extends}
"""
VIBROMETER = """
from typing import Literal
from drivers.vibrometer.driver import VibrometerDriver, VibrometerOptions

class Options(VibrometerOptions):
    kind: Literal["other"] = "other"
    lens_mm: float

class Driver(VibrometerDriver[Options]):
    options = Options
"""
READER = """
import numpy as np

def read(path):
    from instrument.interchange.found import Found
    f = np.array([10.0, 20.0])
    return Found(sweeps=[{"frequency_hz": f, "velocity_m_s": 1e-3 * f}], said=["a sweep"])

def fail(path):
    raise RuntimeError("of its own")
"""


def anew(monkeypatch, module, name):
    """The registry as a process begins with it."""
    old = getattr(module, name)
    fresh = Registry(old.group, old._own, old._judge)
    monkeypatch.setattr(module, name, fresh)
    return fresh


@pytest.fixture
def left_out(caplog):
    caplog.set_level(logging.WARNING)
    return lambda: [r.getMessage() for r in caplog.records if r.name == "fitting.plugins"]


def test_our_own_laws_and_effects_are_those_of_their_folders():
    assert all(LAWS.is_own(name) for name in LAWS)
    assert {type(CATALOGUE[name]).__module__.rpartition(".")[0] for name in CATALOGUE} == {"fitting.effects"}


def test_a_law_of_another_package_is_one_of_the_laws(package, monkeypatch, left_out):
    package("law-one", LAW.format(kind="other"), laws={"other": "Law"})
    laws = anew(monkeypatch, fitting.laws, "LAWS")
    assert laws["other"](5e5).names == ["g_pa"]
    assert list(laws)[-1] == "other"
    assert left_out() == []


def test_a_law_that_offers_itself_is_tried_last(package, monkeypatch):
    from fitting.effects import core_law
    from fitting.effects.given import Points

    package("law-one", LAW.format(kind="other"), laws={"other": "Law"})
    omega = 2 * np.pi * np.linspace(20.0, 300.0, 40)
    points = Points(omega, np.ones(40), np.arange(40.0), True, True, "relative")
    stated = LAWS["constant"](5e5, 0.5)
    before = CATALOGUE["core_law"].laws(stated, points)
    monkeypatch.setattr(core_law, "LAWS", anew(monkeypatch, fitting.laws, "LAWS"))
    after = CATALOGUE["core_law"].laws(stated, points)
    assert after[:-1] == before
    assert after[-1].kind == "other"


def test_a_law_under_another_name_than_its_kind_is_left_out(package, monkeypatch, left_out):
    package("law-one", LAW.format(kind="another"), laws={"other": "Law", "no": "np"})
    laws = anew(monkeypatch, fitting.laws, "LAWS")
    assert not {"other", "no"} & set(laws)
    assert any("its kind is 'another', expected the entry point's name" in line for line in left_out())
    assert any("is no class derived from fitting.laws.base.CoreLaw" in line for line in left_out())


def test_an_effect_of_another_package_is_spanned_and_its_sources_count(package, monkeypatch, left_out):
    package("effect-one", EFFECT.format(span="odd", extends=None), effects={"odd": "Odd"})
    before = [span.name for span in all_spans()]
    anew(monkeypatch, fitting.effects, "CATALOGUE")
    monkeypatch.setattr(fitting.effects, "_span_classes", dict(fitting.effects._span_classes))
    assert [span.name for span in all_spans()] == [*before, "odd"]
    assert "plugin_effect_one" in span_modules()
    assert left_out() == []


@pytest.mark.parametrize(
    ("span", "extends", "why"),
    [("mass", None, "its span 'mass' has the name of another one"), ("odd", "'no'", "it extends 'no'")],
)
def test_an_effect_that_would_change_others_is_left_out(package, monkeypatch, left_out, span, extends, why):
    package("effect-one", EFFECT.format(span=span, extends=extends), effects={"odd": "Odd"})
    catalogue = anew(monkeypatch, fitting.effects, "CATALOGUE")
    assert list(catalogue) == [name for name in catalogue if catalogue.is_own(name)]
    assert why in left_out()[0]


def rig(path: Path, vibrometer: str) -> Path:
    text = case_file("rig.toml").read_text()
    path.write_text(text.replace('kind = "polytec"\n', vibrometer).replace('model = "OFV-5000"\n', ""))
    return path


@pytest.fixture
def vibrometers(package, monkeypatch):
    package("driver-one", VIBROMETER, vibrometers={"other": "Driver"})
    fresh = anew(monkeypatch, devices, "VIBROMETERS")
    monkeypatch.setitem(devices.DEVICES, "vibrometer", fresh)
    return fresh


def test_another_packages_driver_brings_its_own_keys(vibrometers, tmp_path):
    document = read_document(rig(tmp_path / "rig.toml", 'kind = "other"\nlens_mm = 2.5\n'), RigDocument)
    assert document.vibrometer.lens_mm == 2.5
    assert document.vibrometer.reads == "absolute"


def test_they_are_kept_with_a_session(vibrometers, tmp_path):
    document = read_document(rig(tmp_path / "rig.toml", 'kind = "other"\nlens_mm = 2.0\n'), RigDocument)
    kept = document.without_simulation()
    assert RigDocument.model_validate_json(kept.model_dump_json()) == kept
    assert RigDocument.model_validate_json(kept.model_dump_json()).vibrometer.lens_mm == 2.0


@pytest.mark.parametrize(
    ("table", "fault"),
    [
        ('kind = "other"\n', "vibrometer.lens_mm: missing"),
        ('kind = "other"\nlens_mm = "wide"\n', "vibrometer.lens_mm: 'wide', expected a number"),
        ('kind = "other"\nlens_mm = 1.0\nbaud = 9600\n', "vibrometer.baud: unknown key"),
        ('kind = "nobody"\n', "vibrometer.kind: 'nobody', expected one of other, polytec"),
        ("kind = 3\n", "vibrometer.kind: 3, expected one of other, polytec"),
    ],
)
def test_a_fault_of_a_device_is_one_line_with_its_place(vibrometers, tmp_path, table, fault):
    path = rig(tmp_path / "rig.toml", table)
    assert document_faults(path, RigDocument) == [f"{path}: {fault}"]
    with pytest.raises(BadInput) as refused:
        read_document(path, RigDocument)
    assert str(refused.value) == f"{path}: {fault}"


@pytest.mark.parametrize(
    ("device", "usual", "known"),
    [
        ("shaker", "modbus-tcp", "modbus-rtu, modbus-tcp"),
        ("vibrometer", "polytec", "polytec"),
        ("front_end", "lan-xi", "lan-xi, ni-daqmx"),
    ],
)
def test_an_unknown_kind_is_one_line_for_every_device(tmp_path, device, usual, known):
    path = tmp_path / "rig.toml"
    path.write_text(case_file("rig.toml").read_text().replace(f'kind = "{usual}"', 'kind = "nobody"'))
    (fault,) = document_faults(path, RigDocument)
    assert fault == f"{path}: {device}.kind: 'nobody', expected one of {known}"


def test_a_form_asks_what_the_driver_asks(vibrometers):
    (section,) = [s for s in fields.section_of(RigDocument).sections if s.key == "vibrometer"]
    assert section.fields[0].choices == ("other", "polytec")
    assert [f.key for f in fields.device_fields(section, "other")] == ["lens_mm"]
    assert [f.key for f in fields.device_fields(section, None)] == ["model", "baud"]
    assert fields.device_fields(section, "nobody") == ()


def test_a_form_asks_for_the_settings_of_a_shaker_s_serial_line():
    (section,) = [s for s in fields.section_of(RigDocument).sections if s.key == "shaker"]
    asked = {f.key: f.choices for f in fields.device_fields(section, "modbus-rtu")}
    assert asked.keys() >= {"unit", "baud", "parity", "stop_bits"}
    assert asked["parity"] == ("N", "E", "O")


def test_another_packages_reader_reads_its_ending(package, monkeypatch, tmp_path):
    package("reader-one", READER, readers={"dax": "read", "bad": "fail"})
    anew(monkeypatch, readers, "READERS")
    for ending in ("DAX", "bad", "none"):
        (tmp_path / f"x.{ending}").write_text("anything")
    assert readers.is_foreign(tmp_path / "x.DAX")
    assert ".dax" in readers.foreign_endings()
    assert readers.read_foreign(tmp_path / "x.DAX").said == ["a sweep"]
    with pytest.raises(BadInput, match=r"x\.bad: its reader failed: RuntimeError: of its own"):
        readers.read_foreign(tmp_path / "x.bad")
    with pytest.raises(
        BadInput, match=r"unknown ending '\.none', expected one of asc, bad, csv, dat, dax, lvm, mat"
    ):
        readers.read_foreign(tmp_path / "x.none")
