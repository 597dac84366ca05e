"""Processes that let others go first: what measures, and what a person looks at.

Never a thread beside one that measures: while it waits for its turn it may hold the interpreter's lock.
"""

import os
import sys

VARIABLE = "VISCORIG_BACKGROUND"
"""Set for commands that a window runs beside a measurement."""
_NICE = 10


def step_back() -> None:
    """The whole process, where the system knows priorities."""
    if sys.platform != "win32":
        os.nice(_NICE)
