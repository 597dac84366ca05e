"""When this program itself did not run."""

import os
import signal
import subprocess
import sys
import time

from instrument.run.stood_still import StoodStill, Ticking

PROGRAM = """
import sys, time
from instrument.run.stood_still import TICKING
began = time.monotonic()
TICKING.since(began)
print("ready", flush=True)
sys.stdin.readline()
print(TICKING.since(began), flush=True)
"""


def test_a_time_without_a_tick_is_one_it_stood_still_and_counts_from_when_it_is_asked_for():
    now = [0.0]
    stood = StoodStill(lambda: now[0])
    for now[0] in (0.1, 0.2, 4.2, 4.3):
        stood.tick()
    assert stood.since(0.0) == 4.0
    assert stood.since(3.2) == 1.0
    assert stood.since(4.25) == 0.0


def test_whoever_asks_before_the_next_tick_hears_of_it_too():
    now = [0.0]
    stood = StoodStill(lambda: now[0])
    now[0] = 3.0
    assert stood.since(0.0) == 3.0


def test_a_thread_that_waits_is_no_program_that_stands_still():
    ticking, began = Ticking(), time.monotonic()
    ticking.since(began)
    time.sleep(0.8)
    assert ticking.since(began) < 0.8


def test_a_program_that_was_stopped_by_a_signal_knows_it():
    program = subprocess.Popen(
        [sys.executable, "-c", PROGRAM], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True
    )
    with program:
        assert program.stdout.readline() == "ready\n"
        os.kill(program.pid, signal.SIGSTOP)
        time.sleep(1.0)
        os.kill(program.pid, signal.SIGCONT)
        said, _ = program.communicate("go on\n")
    assert float(said) > 0.9
