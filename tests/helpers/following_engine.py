"""An engine whose diagnoses are made up: they end in a group until something was measured after them.

A program: `Engine.start(order, FOLLOWING_ENGINE)`.
"""

import os
import sys
from pathlib import Path

from following_cases import BACKWARDS, SPOT, STRUCK, a_law, grouped

from instrument.engine.process import serve

FOLLOWING_ENGINE = (sys.executable, str(Path(__file__)))
STRIKING_ENGINE = (*FOLLOWING_ENGINE, "struck")

if __name__ == "__main__":
    commands, replies = os.fdopen(os.dup(0), "rb"), os.fdopen(os.dup(1), "wb")
    os.dup2(2, 1)
    offers = (STRUCK,) if "struck" in sys.argv[1:] else (SPOT, BACKWARDS)
    serve(commands, replies, fit=a_law, diagnose=grouped(*offers))
    os._exit(0)
