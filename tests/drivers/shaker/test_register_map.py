import pytest

from drivers.shaker.register_map import COMMAND, DEFAULT, ECHO, STATUS, RegisterMap, RegisterRun


def test_one_transaction_carries_a_command_a_status_a_receipt():
    assert DEFAULT.spans(COMMAND) == (RegisterRun(0, COMMAND, 7),)
    assert DEFAULT.spans(STATUS) == (RegisterRun(20, STATUS, 8),)
    assert DEFAULT.spans(ECHO) == (RegisterRun(28, ECHO, 7),)


def test_types_take_the_registers_they_need():
    widths = {
        name: DEFAULT[name].width
        for name in ("control", "drive_v", "serial_number", "echo_sample", "identity")
    }
    assert widths == {"control": 1, "drive_v": 2, "serial_number": 2, "echo_sample": 4, "identity": 16}


def test_moved_registers_leave_the_others_where_they_were():
    moved = DEFAULT.with_addresses({"echo_sample": 500, "limit_v": 600})
    assert moved["echo_sample"].address == 500
    assert moved["echo_sequence"] == DEFAULT["echo_sequence"]
    assert moved.spans(ECHO) == (
        RegisterRun(28, ("echo_sequence",), 1),
        RegisterRun(33, ("echo_drive_v",), 2),
        RegisterRun(500, ("echo_sample",), 4),
    )


def test_the_command_block_moves_whole():
    addresses = {"frequency_hz": 1000, "drive_v": 1002, "ramp_v_s": 1004, "command_sequence": 1006}
    assert DEFAULT.with_addresses(addresses).spans(COMMAND) == (RegisterRun(1000, COMMAND, 7),)


@pytest.mark.parametrize(
    ("addresses", "says"),
    [
        ({"drive": 3}, "no register is called drive: known are frequency_hz"),
        ({"alarm": 20}, "status at 20 to 20 overlaps alarm at 20"),
        ({"heartbeat": 32}, "echo_sample at 29 to 32 overlaps heartbeat at 32"),
        ({"limit_v": 65535}, "limit_v at 65535 with 2 registers is outside 0 to 65535"),
        ({"status": -1}, "status at -1 with 1 registers is outside"),
        ({"drive_v": 100}, "drive_v at 100 does not follow frequency_hz, which ends at 1"),
    ],
)
def test_a_map_that_cannot_be_is_refused_in_one_line(addresses, says):
    with pytest.raises(ValueError, match=says) as refusal:
        DEFAULT.with_addresses(addresses)
    assert "\n" not in str(refusal.value)


def test_the_last_address_can_be_used():
    assert DEFAULT.with_addresses({"limit_v": 65534})["limit_v"].end == 65536


def test_a_span_ends_where_one_read_can_carry_no_more():
    strings = tuple(
        type(DEFAULT["identity"])(f"text_{k}", 100 + 40 * k, "string", False, "", characters=80)
        for k in range(4)
    )
    registers = RegisterMap(DEFAULT.registers + strings)
    assert [s.width for s in registers.spans(tuple(r.name for r in strings))] == [120, 40]
