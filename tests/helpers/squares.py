"""Work for several processes to share."""

import os
import signal

from fitting.errors import OutsideModel


class Squares:
    """Something to be done, and who has done it."""

    def square(self, number: int) -> tuple[int, int]:
        return number**2, os.getpid()

    def niceness(self, number: int) -> int:
        return os.nice(0)

    def refuse(self, number: int) -> int:
        raise OutsideModel(f"not {number}")

    def end_the_other(self, first: int) -> int:
        if os.getpid() != first:
            os.kill(os.getpid(), signal.SIGKILL)
        return first

    def wait_in_the_other(self, first: int) -> int:
        if os.getpid() != first:
            signal.pause()
        return first
