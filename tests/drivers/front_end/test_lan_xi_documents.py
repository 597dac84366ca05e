import pytest

from drivers.errors import Garbled, Refused
from drivers.front_end import lan_xi_documents as documents
from drivers.front_end.interface import Transducer
from drivers.front_end.lan_xi_documents import ChannelSetup, ModuleInfo

INFO = ModuleInfo("3050", "100123", 6, (4096.0, 65536.0, 131072.0), (10.0, 31.6))


def test_module_information_round_trip():
    assert documents.read_module_info(documents.write_module_info(INFO)) == INFO


@pytest.mark.parametrize(
    ("rate_hz", "name"), [(131072, "51.2 kHz"), (65536, "25.6 kHz"), (4096, "1.6 kHz"), (2048, "800 Hz")]
)
def test_bandwidths_are_spelled_as_the_device_does(rate_hz, name):
    assert documents.bandwidth_name(rate_hz) == name


def test_a_rate_that_there_is_not_is_refused_with_the_nearest():
    assert documents.choose_rate(INFO, 65536) == 65536
    with pytest.raises(
        Refused, match=r"51200 Hz is no sample rate of 3050: the nearest is 65536 Hz \(bandwidth 25.6"
    ):
        documents.choose_rate(INFO, 51200)


def test_the_next_larger_range_is_taken():
    assert [documents.choose_range(INFO, v) for v in (0.1, 10.0, 10.1)] == [10.0, 10.0, 31.6]
    with pytest.raises(Refused, match="40 V is beyond the largest range"):
        documents.choose_range(INFO, 40.0)


def test_a_filled_setup_is_read_back():
    channels = (ChannelSetup(2, "base", 10.0, True), ChannelSetup(5, "laser", 31.6, False))
    filled = documents.fill_setup(documents.default_setup(INFO), channels, 65536.0)
    assert documents.read_setup(filled) == (channels, pytest.approx(65536.0))
    assert [entry["enabled"] for entry in filled["channels"]] == [False, True, False, False, True, False]
    assert {entry["filter"] for entry in filled["channels"] if entry["enabled"]} == {"0.7 Hz"}


def test_a_detected_sensor_leaves_the_scale_in_volts():
    default = documents.default_setup(INFO)
    default["channels"][0]["transducer"] = {"sensitivity": 0.01, "unit": "m/s^2"}
    filled = documents.fill_setup(default, (ChannelSetup(1, "base", 10.0, True),), 4096.0)
    assert filled["channels"][0]["transducer"] == documents.plain_transducer()


def test_detected_sensors_have_type_and_serial_number():
    document = [None, {"type": {"number": "4507"}, "serialNumber": 31}]
    assert documents.read_transducers(document) == (None, Transducer("4507", "31"))


@pytest.mark.parametrize(
    ("unit", "sensitivity", "mv"),
    [("m/s^2", 0.01, 10.0), ("g", 0.0980665, 10.0), ("Pa", 0.05, None)],
)
def test_a_sensors_own_sensitivity_is_read_per_si_unit(unit, sensitivity, mv):
    document = [{"type": {"number": "4507"}, "serialNumber": 31, "sensitivity": sensitivity, "unit": unit}]
    (found,) = documents.read_transducers(document)
    assert found.mv_per_unit == (None if mv is None else pytest.approx(mv))


@pytest.mark.parametrize(
    ("read", "document"),
    [
        (documents.read_module_info, {}),
        (documents.read_module_info, []),
        (documents.read_module_info, {**documents.write_module_info(INFO), "supportedRanges": ["wide"]}),
        (documents.read_status, {"moduleState": "Idle"}),
        (documents.read_transducers, [{"type": {}}]),
        (documents.read_port, {"tcpPort": "no"}),
        (documents.read_setup, documents.default_setup(INFO)),
    ],
)
def test_a_document_without_what_is_needed_is_garbled(read, document):
    with pytest.raises(Garbled):
        read(document)
