import pytest
from hypothesis import given
from hypothesis import strategies as st

from drivers.errors import Garbled, Refused
from drivers.vibrometer import polytec
from drivers.vibrometer.polytec_models import MODELS, model_named

PAIRS = [
    (polytec.info("Controller", 0, "Name"), b"GetDevInfo,Controller,0,Name\r\n"),
    (polytec.info("SensorHead", 0, "Name"), b"GetDevInfo,SensorHead,0,Name\r\n"),
    (polytec.get("VeloDec", 0, "Name"), b"Get,VeloDec,0,Name\r\n"),
    (polytec.put("VeloDec", 1, "Range", "5mm/s/V"), b"Set,VeloDec,1,Range,5mm/s/V\r\n"),
    (polytec.get("VeloDec", 1, "Range"), b"Get,VeloDec,1,Range\r\n"),
    (polytec.get("VeloDec", 1, "MaxFreq"), b"Get,VeloDec,1,MaxFreq\r\n"),
    (polytec.get("SignalLevel", 0, "Value"), b"Get,SignalLevel,0,Value\r\n"),
    (polytec.put("SensorHead", 0, "AutoFocus", "Search"), b"Set,SensorHead,0,AutoFocus,Search\r\n"),
    (polytec.put("Interface", 0, "Echo", "Off"), b"Set,Interface,0,Echo,Off\r\n"),
    (polytec.put("Interface", 0, "Acknowledge", "On"), b"Set,Interface,0,Acknowledge,On\r\n"),
]


@pytest.mark.parametrize(("command", "sent"), PAIRS)
def test_commands_and_their_bytes(command, sent):
    assert polytec.encode(command) == sent
    assert polytec.parse_command(polytec.decode(sent)) == command


def test_a_command_is_read_whatever_its_case_and_blanks():
    assert polytec.parse_command("get, VeloDec, 1, Range") == polytec.get("VeloDec", 1, "Range")


@pytest.mark.parametrize(
    "line", ["", "Get", "Get,VeloDec,x,Range", "Set,VeloDec,1,Range", "Tell,VeloDec,1,Range"]
)
def test_a_line_that_is_no_command_is_garbled(line):
    with pytest.raises(Garbled, match="expected GetDevInfo"):
        polytec.parse_command(line)


@pytest.mark.parametrize(
    ("reply", "unit", "value"),
    [
        (b"5mm/s/V\n", "m/s/V", 5e-3),
        (b"1 m/s/V\r\n", "m/s/V", 1.0),
        (b"50mm/s/V LP\n", "m/s/V", 50e-3),
        (b"20 kHz\n", "Hz", 20e3),
        (b"1.5 MHz\n", "Hz", 1.5e6),
        (b"1.1 ms\r\n", "s", 1.1e-3),
        (b"8.16 us\n", "s", 8.16e-6),
        (b"8.16 \xb5s\n", "s", 8.16e-6),
        ("8.16 µs\n".encode(), "s", 8.16e-6),
        ("8.16 μs\n".encode(), "s", 8.16e-6),
    ],
)
def test_quantities_with_their_units(reply, unit, value):
    assert polytec.parse_quantity(polytec.decode(reply), unit) == pytest.approx(value, rel=1e-12)


@pytest.mark.parametrize("reply", ["", "kHz", "20 kV", "20", "20 xHz", "0x14 Hz", "nan Hz"])
def test_what_is_no_quantity_is_garbled(reply):
    with pytest.raises(Garbled, match="expected a number in Hz"):
        polytec.parse_quantity(reply, "Hz")


def test_an_option_that_is_missing_is_none():
    assert polytec.parse_optional_quantity("Not Available", "s") is None
    assert polytec.parse_optional_text("Not Available") is None


@pytest.mark.parametrize(("reply", "value"), [("On", True), ("off", False), ("1", True), ("0", False)])
def test_switches(reply, value):
    assert polytec.parse_switch(reply) is value


def test_integers():
    assert polytec.parse_integer("461") == 461
    for reply in ("", "4.6", "46a", "9" * 30):
        with pytest.raises(Garbled, match="whole number"):
            polytec.parse_integer(reply)


def test_an_acknowledge_may_say_no_and_its_yes_has_no_meaning():
    polytec.check_acknowledge("OK")
    polytec.check_acknowledge("whatever")
    for reply in ("Error 3", "Not Available"):
        with pytest.raises(Refused, match=reply):
            polytec.check_acknowledge(reply)


@given(st.binary(max_size=60))
def test_no_bytes_whatever_break_a_parser(line):
    text = polytec.decode(line)
    for parse in (polytec.parse_command, polytec.parse_text, polytec.parse_integer, polytec.parse_switch):
        try:
            parse(text)
        except Garbled:
            continue


@pytest.mark.parametrize("model", MODELS.values(), ids=MODELS)
def test_the_table_agrees_with_the_names_of_its_ranges(model):
    scales = [r.scale_m_s_v for r in model.ranges]
    assert scales == sorted(scales)
    assert len({r.name for r in model.ranges}) == len(scales)
    for one in model.ranges:
        assert polytec.parse_quantity(one.name, "m/s/V") == pytest.approx(one.scale_m_s_v, rel=1e-12)


def test_the_portable_one_reads_20_mm_s_at_its_most_sensitive():
    first = model_named("PDV-100").ranges[0]
    assert first.full_scale_m_s == pytest.approx(0.020)
    assert first.verified
    assert first.delay_s == pytest.approx(1.1e-3)


def test_an_unknown_model_is_refused_with_the_known_ones():
    with pytest.raises(Refused, match="known are OFV-5000"):
        model_named("LV-1")
