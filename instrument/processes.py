"""How many processes a diagnosis may use."""

import os
from contextlib import AbstractContextManager, nullcontext

from fitting.diagnosis.hands import ALONE, Hands, TwoHands

VARIABLE = "VISCORIG_PROCESSES"


def processors() -> int:
    """Those that this process may use."""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


def hands() -> AbstractContextManager[Hands]:
    """Two where the machine has two processors, unless `VISCORIG_PROCESSES` is 1."""
    if processors() < 2 or os.environ.get(VARIABLE) == "1":
        return nullcontext(ALONE)
    return TwoHands()
