"""A serial cable inside the computer."""

import asyncio
import os
import pty
import tty
from contextlib import suppress


class PseudoTerminals:
    """Two pseudo-terminals back to back: the device opens one, the master the other."""

    def __init__(self, loop: asyncio.AbstractEventLoop) -> None:
        self._loop = loop
        here, device = pty.openpty()
        there, master = pty.openpty()
        # Both far ends stay open here, so a master may come and go.
        self._open = (here, device, there, master)
        self.device_path, self.master_path = os.ttyname(device), os.ttyname(master)
        for end in (device, master):
            tty.setraw(end)
        for end in (here, there):
            os.set_blocking(end, False)
        loop.add_reader(here, self._pass_on, here, there)
        loop.add_reader(there, self._pass_on, there, here)

    def close(self) -> None:
        """Both ends gone, as if unplugged."""
        self._loop.remove_reader(self._open[0])
        self._loop.remove_reader(self._open[2])
        for end in self._open:
            os.close(end)

    def _pass_on(self, source: int, target: int) -> None:
        # As on a cable, what nobody reads is lost.
        with suppress(BlockingIOError):
            os.write(target, os.read(source, 1024))
