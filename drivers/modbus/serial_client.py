"""A Modbus client on a serial port that says why the port does not open, and hears a late answer out.

The library's own tells its log, and has no ear between two questions.
"""

import errno
import re
import time

from pymodbus.client import ModbusSerialClient
from serial import serial_for_url

_CURES = {
    errno.ENOENT: "is its adapter plugged in, the address its port's?",
    errno.EACCES: "may this user open it? on Linux join the port's group, as a rule dialout, and log in anew",
    errno.EINVAL: "does the port have this baud, parity and number of stop bits?",
    errno.EAGAIN: "another program has it, maybe a run of this one: end that first",
    errno.EBUSY: "another program has it, maybe a run of this one: end that first",
}
_NO_PORT = "is the address a serial port's, and free?"
_LEAST_ANSWER_BYTES = 5
"""Unit, function, exception and two of the check sum. Fewer are noise."""
_PIECES_APART_S = 0.03
"""An answer has ended when nothing more came for so long: an adapter on USB keeps bytes for 16 ms."""
_LOOK_S = 0.002
"""Between two looks at what has come."""


class SerialClient(ModbusSerialClient):
    """`connect` raises `OSError` where the port does not open."""

    def connect(self) -> bool:
        """Open the port for this program alone, where it is not open."""
        if self.socket is not None:
            return True
        params = self.comm_params
        try:
            port = serial_for_url(
                params.host,
                timeout=params.timeout_connect,
                write_timeout=params.timeout_connect,
                bytesize=params.bytesize,
                stopbits=params.stopbits,
                baudrate=params.baudrate,
                parity=params.parity,
                exclusive=True,
            )
            port.inter_byte_timeout = self.inter_byte_timeout
        except OSError:
            raise
        except Exception as problem:
            # A speed that the port has not, or a driver's own: of no kind that pyserial names.
            code = problem.args[0] if problem.args else 0
            said = f"could not set up port {params.host}: {problem}"
            raise OSError(code if isinstance(code, int) else errno.EINVAL, said) from problem
        self.socket = port
        return True

    def listen(self, until_s: float) -> bool:
        """Drop what comes until one answer has, or until that moment of `time.monotonic`: whether one has.

        Raises `OSError` where the port is gone.
        """
        if (port := self.socket) is None:
            return False
        came, last_s = 0, time.monotonic()
        while (now_s := time.monotonic()) < until_s:
            if waiting := port.in_waiting:
                came += len(port.read(waiting))
                last_s = now_s
            elif came >= _LEAST_ANSWER_BYTES and now_s - last_s >= _PIECES_APART_S:
                break
            time.sleep(_LOOK_S)
        came += len(port.read(port.in_waiting))
        return came >= _LEAST_ANSWER_BYTES


def why_not_open(problem: OSError, tried: str) -> str:
    """In one line: the reason, how often it was `tried`, and what to do."""
    reason = re.sub(r"\[Errno \d+\] ", "", " ".join(str(problem).split()))
    # The system says once more which file it is of, and pyserial passes its words on as a tuple.
    reason = re.sub(r"\(\d+, '([^']*)'\)", r"\1", re.sub(r": '[^']*'$", "", reason))
    return f"{reason}, {tried}: {_CURES.get(problem.errno or 0, _NO_PORT)}"
