"""`python -m instrument.engine`: commands on standard input, messages on standard output."""

import faulthandler
import os
import sys

from instrument.engine.process import serve


def main() -> None:
    """Run one order."""
    faulthandler.enable()
    # The pipes are ours alone: whatever else is printed goes to standard error.
    commands, replies = os.fdopen(os.dup(0), "rb"), os.fdopen(os.dup(1), "wb")
    nothing = os.open(os.devnull, os.O_RDONLY)
    os.dup2(nothing, 0)
    os.dup2(2, 1)
    serve(commands, replies)
    sys.stderr.flush()
    # No thread that still waits for something may keep the process.
    os._exit(0)


if __name__ == "__main__":
    main()
