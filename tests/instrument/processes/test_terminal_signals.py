"""What a terminal sends."""

import signal

from instrument.processes.terminal_signals import BY_A_PERSON


def test_ctrl_c_is_one_everywhere_and_the_other_where_a_terminal_has_it():
    assert BY_A_PERSON[0] is signal.SIGINT
    assert [s.name for s in BY_A_PERSON[1:]] == ["SIGQUIT"] * hasattr(signal, "SIGQUIT")
